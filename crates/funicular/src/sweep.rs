//! Many starts, and where each of them leads.

use std::ops::Range;
use std::path::Path;

use model::{Problem as ChainProblem, SystemSummary};
use sweep::{
    Axis, Manifest, Member, Run, RunSettings, SCHEMA_VERSION, Settings, Shard, Source, Summary,
    SystemText,
};
use validate::Solvers;

use crate::error::Error;
use crate::problem::Problem;
use crate::starts::solvers;
use crate::threads::MOST_THREADS;

/// Starts after which whoever watches is told: a fraction of a second.
const TOLD: u64 = 1_000_000;

/// Runs starts with random angles through the solvers and tells which equilibrium each reaches.
///
/// ```
/// use funicular::prelude::*;
/// let found = Sweep::new(2000).run(&Problem::case("three-equal-bars")?)?;
/// assert!(found.complete);
/// // The four equilibria of the census, and nothing else.
/// let lagrange = found.summary.tally().of("lagrange").unwrap();
/// assert_eq!(lagrange.0.keys().copied().collect::<Vec<_>>(), [0, 1, 2, 3]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    seeds: u64,
    number: u64,
    spread: Spread,
    solvers: Solvers,
    threads: usize,
    shard: Shard,
    angles: bool,
    format: Format,
}

/// How starts are spread over the angles of the bars.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spread {
    /// At random, every angle by itself.
    #[default]
    Uniform,
    /// Sobol's sequence: evenly, with a random shift.
    Sobol,
    /// A regular grid: the number of starts must be a power with the number of bars.
    Grid,
}

impl Spread {
    /// As the manifest of a folder names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Sobol => "sobol",
            Self::Grid => "grid",
        }
    }
}

/// The form of the rows on disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// Apache Parquet: small, with units.
    #[default]
    Parquet,
    /// Comma-separated values.
    Csv,
}

impl Format {
    /// As the manifest of a folder names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Parquet => "parquet",
            Self::Csv => "csv",
        }
    }
}

impl Sweep {
    /// So many starts at random angles, through both solvers, on all processors.
    #[must_use]
    pub fn new(seeds: u64) -> Self {
        Self {
            seeds,
            number: 1,
            spread: Spread::default(),
            solvers: Solvers::default(),
            threads: 0,
            shard: Shard::WHOLE,
            angles: false,
            format: Format::default(),
        }
    }

    /// The number that all starts come from (1); another one gives others.
    #[must_use]
    pub fn number(self, number: u64) -> Self {
        Self { number, ..self }
    }

    /// How the starts are spread.
    #[must_use]
    pub fn spread(self, spread: Spread) -> Self {
        Self { spread, ..self }
    }

    /// Which solvers to ask.
    #[must_use]
    pub fn solvers(self, solvers: Solvers) -> Self {
        Self { solvers, ..self }
    }

    /// How many threads, 0 (the default) for one per processor. The result does not depend on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// Only one of several parts, to be joined by [`merge`](sweep::merge); for
    /// [`PreparedSweep::write`].
    #[must_use]
    pub fn shard(self, shard: Shard) -> Self {
        Self { shard, ..self }
    }

    /// Write the angles of the starts, too; for [`PreparedSweep::write`].
    #[must_use]
    pub fn angles(self, angles: bool) -> Self {
        Self { angles, ..self }
    }

    /// The form of the rows; for [`PreparedSweep::write`].
    #[must_use]
    pub fn format(self, format: Format) -> Self {
        Self { format, ..self }
    }

    /// Run all starts, and count what becomes of them.
    ///
    /// # Errors
    ///
    /// As [`prepare`](Self::prepare), and [`Error::Sweep`] when the threads cannot be started.
    pub fn run(&self, problem: &Problem) -> Result<SweepAnswer, Error> {
        self.run_watched(problem, &|_| {})
    }

    /// The same, with `watch` told every million starts how many are done.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &dyn Fn(u64),
    ) -> Result<SweepAnswer, Error> {
        let prepared = self.prepare(problem)?;
        let mut swept = prepared.sweep.begin();
        let mut done = 0;
        while done < self.seeds {
            let next = self.seeds.min(done.saturating_add(TOLD));
            prepared.sweep.go_on(&mut swept, done..next, self.threads)?;
            done = next;
            watch(done);
        }
        let members = prepared.sweep.members();
        let (summary, discovered) = swept.finish();
        let discovered = discovered.unwrap_or_default();
        Ok(SweepAnswer {
            manifest: prepared.manifest.clone(),
            equilibria: members.list().iter().cloned().chain(discovered.equilibria).collect(),
            complete: members.complete(),
            listed_below_j: discovered.below_j,
            summary,
        })
    }

    /// List the equilibria that are proved: all, where the census is complete.
    ///
    /// # Errors
    ///
    /// [`Error::GridSeeds`] when a grid cannot have so many points, [`Error::Sweep`] for settings
    /// out of range and chains without a list, [`Error::TooManyThreads`].
    pub fn prepare(&self, problem: &Problem) -> Result<PreparedSweep, Error> {
        let chain = problem.chain_for("a sweep")?;
        if self.threads > MOST_THREADS {
            return Err(Error::TooManyThreads { threads: self.threads });
        }
        let source = match self.spread {
            Spread::Uniform => Source::Uniform,
            Spread::Sobol => Source::Sobol,
            Spread::Grid => self.grid(chain.chain().bars().len())?,
        };
        let both = solvers(chain)?;
        let asked = match self.solvers {
            Solvers::Lagrange => both.only(&["lagrange"]),
            Solvers::Energy => both.only(&["energy"]),
            Solvers::Both => both,
        };
        let settings = Settings { number: self.number, source, ..Settings::default() };
        let sweep = sweep::Sweep::new(chain, settings, asked)?;
        let manifest = self.manifest(chain, &sweep);
        Ok(PreparedSweep { system: chain.chain().summary(), sweep, manifest })
    }

    /// Processor time that the starts take, s: from a few starts, good to a factor of three.
    ///
    /// # Errors
    ///
    /// As [`prepare`](Self::prepare).
    pub fn expected_time_s(&self, problem: &Problem) -> Result<f64, Error> {
        let chain = problem.chain_for("a sweep")?;
        let both = solvers(chain)?;
        let asked = match self.solvers {
            Solvers::Lagrange => both.only(&["lagrange"]),
            Solvers::Energy => both.only(&["energy"]),
            Solvers::Both => both,
        };
        let settings = Settings { number: self.number, ..Settings::default() };
        let shards = self.shard.of.max(1);
        Ok(sweep::expected_time_s(chain, &settings, &asked, self.seeds.div_ceil(shards))?)
    }

    fn grid(&self, bars: usize) -> Result<Source, Error> {
        let side = side_of(self.seeds, bars);
        let points = |side| points(side, bars);
        if points(side) != Some(self.seeds) {
            let near = [side, side + 1];
            let nearest = near.into_iter().filter_map(|side| Some((side, points(side)?))).collect();
            return Err(Error::GridSeeds { seeds: self.seeds, bars, nearest });
        }
        Ok(Source::Grid(vec![Axis::full(side); bars]))
    }

    fn manifest(&self, problem: &ChainProblem, sweep: &sweep::Sweep) -> Manifest {
        let angles = if self.angles { problem.chain().bars().len() } else { 0 };
        Manifest {
            schema_version: SCHEMA_VERSION,
            program: concat!("funicular ", env!("CARGO_PKG_VERSION")).to_owned(),
            system: SystemText::of(problem.chain()),
            seeds: self.seeds,
            seed_number: self.number,
            source: self.spread.name().to_owned(),
            solvers: sweep.solvers().names().map(str::to_owned).collect(),
            release: None,
            angles: (1..=angles).map(|bar| format!("theta_{bar}_rad")).collect(),
            equilibria: sweep.members().list().to_vec(),
            equilibria_complete: sweep.members().complete(),
            format: self.format.name().to_owned(),
            part_seeds: 0,
            shard: Shard::WHOLE,
            range: 0..0,
        }
        .with_shard(self.shard)
    }
}

/// Points of a regular grid with so many on each side.
fn points(side: u64, bars: usize) -> Option<u64> {
    side.checked_pow(u32::try_from(bars).unwrap_or(u32::MAX))
}

/// The side of the largest grid that has not more points than this.
fn side_of(seeds: u64, bars: usize) -> u64 {
    let mut side = 1;
    // Binary digits from above; a side of two is too much for 64 bars.
    let mut step = 1_u64 << 40;
    while step > 0 {
        if points(side + step, bars).is_some_and(|points| points <= seeds) {
            side += step;
        }
        step /= 2;
    }
    side
}

/// A sweep with its list of equilibria, ready to run.
#[derive(Debug, Clone)]
pub struct PreparedSweep {
    system: SystemSummary,
    sweep: sweep::Sweep,
    manifest: Manifest,
}

impl PreparedSweep {
    /// What is swept.
    #[must_use]
    pub fn system(&self) -> &SystemSummary {
        &self.system
    }

    /// Everything that the rows depend on, as the folder will say it.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The starts of this shard.
    #[must_use]
    pub fn range(&self) -> Range<u64> {
        self.manifest.range.clone()
    }

    /// Write a row per start into a folder, or go on with one.
    ///
    /// # Errors
    ///
    /// [`Error::Store`]; the folder is left as it was if it holds something else.
    pub fn write(&self, folder: &Path, settings: &RunSettings<'_>) -> Result<Run, Error> {
        Ok(sweep::run(folder, &self.manifest, &self.sweep, settings)?)
    }
}

/// What became of all starts.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepAnswer {
    /// The equilibria that outcomes 0, 1, 2, ... stand for.
    pub equilibria: Vec<Member>,
    /// Whether it is proved that there are no others.
    pub complete: bool,
    /// Energy, J, from which on equilibria that were reached are not in the list: there were too
    /// many, and these are the lowest. None where all are listed.
    pub listed_below_j: Option<f64>,
    /// The counts.
    pub summary: Summary,
    pub(crate) manifest: Manifest,
}
