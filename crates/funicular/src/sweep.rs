//! Many starts, and where each of them leads.

use std::ops::Range;
use std::path::Path;
use std::time::Instant;

use model::Problem as ChainProblem;
use model::budget::Budget;
use serde::Serialize;
use sweep::{
    Axis, Manifest, Member, Run, RunSettings, SCHEMA_VERSION, Settings, Shard, Source, Summary,
    SystemText,
};
use validate::Solvers;

use crate::equilibria;
use crate::error::Error;
use crate::followed::{Follow, Followed};
use crate::problem::Problem;
use crate::starts::{FromPlaces, solvers};
use crate::text::tables::word;
use crate::threads::{self, MOST_THREADS};

/// Starts after which whoever watches is told: a fraction of a second.
const TOLD: u64 = 1_000_000;

/// Memory that starts take in each thread, bytes.
const BYTES_PER_THREAD: u64 = 50_000_000;

/// Runs random starts through the solvers and says which equilibrium each reaches.
///
/// A start of a chain between two anchors is an angle for each bar, in the plane of the anchors; of
/// any other system, a place for each joint in space: members point anywhere from the joints they
/// hang on, and loops need not close.
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
    pub(crate) number: u64,
    spread: Spread,
    solvers: Solvers,
    threads: usize,
    shard: Shard,
    angles: bool,
    format: Format,
}

/// How starts are spread over the angles of the bars; in the manifest of a folder by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "program", derive(clap::ValueEnum))]
pub enum Spread {
    /// At random, every angle by itself.
    #[default]
    Uniform,
    /// Sobol's sequence: evenly, with a random shift.
    Sobol,
    /// A regular grid: the number of starts must be a power with the number of bars.
    Grid,
}

/// The form of the rows on disk; in the manifest of a folder by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "program", derive(clap::ValueEnum))]
pub enum Format {
    /// Apache Parquet: small, with units.
    #[default]
    Parquet,
    /// Comma-separated values.
    Csv,
}

impl Sweep {
    /// So many starts at random angles, through both solvers, on all processors.
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

    setters! {
        /// The number that all starts come from (1); another one gives others.
        number: u64,
        /// How the starts are spread.
        spread: Spread,
        /// Which solvers to ask.
        solvers: Solvers,
        /// How many threads, 0 (the default) for one per processor. The result does not depend on it.
        threads: usize,
        /// Only one of several parts, to be joined by [`merge`](sweep::merge); for
        /// [`PreparedSweep::write`].
        shard: Shard,
        /// Write the angles of the starts, too; for [`PreparedSweep::write`].
        angles: bool,
        /// The form of the rows; for [`PreparedSweep::write`].
        format: Format,
    }

    /// Run all starts, and count what becomes of them.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare), and [`Error::Sweep`] when the threads cannot be started.
    pub fn run(&self, problem: &Problem) -> Result<SweepAnswer, Error> {
        self.run_watched(problem, &|_| {})
    }

    /// The same, with `watch` told every million starts how many are done.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(u64) + Sync),
    ) -> Result<SweepAnswer, Error> {
        let prepared = self.prepare(problem)?;
        let manifest = prepared.manifest;
        let (summary, discovered) = match &prepared.compute {
            Compute::Angles(sweep) => {
                let mut swept = sweep.begin();
                let mut done = 0;
                while done < self.seeds {
                    let next = self.seeds.min(done.saturating_add(TOLD));
                    sweep.go_on(&mut swept, done..next, self.threads)?;
                    done = next;
                    watch(done);
                }
                swept.finish()
            }
            Compute::Places(starts) => {
                let count = || starts.count(0..self.seeds, watch);
                (threads::on(self.threads, count)?, None)
            }
        };
        let discovered = discovered.unwrap_or_default();
        let proven = manifest.equilibria.iter().cloned();
        Ok(SweepAnswer {
            equilibria: proven.chain(discovered.equilibria).collect(),
            complete: manifest.equilibria_complete,
            listed_below_j: discovered.below_j,
            summary,
            manifest,
        })
    }

    /// List the equilibria that are proved: all, where the census is complete; else, of starts in
    /// space, those that 256 other starts lead to.
    ///
    /// # Errors
    /// [`Error::GridSeeds`] when a grid cannot have so many points, [`Error::Sweep`] for settings
    /// out of range and chains without a list, [`Error::TooManyThreads`].
    pub fn prepare(&self, problem: &Problem) -> Result<PreparedSweep, Error> {
        if self.threads > MOST_THREADS {
            return Err(Error::TooManyThreads(self.threads));
        }
        let threads = if self.threads == 0 { rayon::current_num_threads() } else { self.threads };
        Budget::default().fits(threads as u64 * BYTES_PER_THREAD)?;
        let Some(chain) = problem.row() else { return self.prepare_places(problem) };
        let source = match self.spread {
            Spread::Uniform => Source::Uniform,
            Spread::Sobol => Source::Sobol,
            Spread::Grid => self.grid(chain.chain().bars().len())?,
        };
        let settings = Settings { number: self.number, source, ..Settings::default() };
        let sweep = sweep::Sweep::new(chain, settings, self.asked(chain)?)?;
        let of = SweptBy {
            system: SystemText::from(&*problem.system()),
            source: word(&self.spread),
            solvers: sweep.solvers().names().map(str::to_owned).collect(),
            angles: if self.angles { chain.chain().bars().len() } else { 0 },
            list: sweep.members().list(),
            complete: sweep.members().complete(),
        };
        Ok(PreparedSweep { manifest: self.manifest(of), compute: Compute::Angles(Box::new(sweep)) })
    }

    /// The same of any system, from places of its joints in space.
    fn prepare_places(&self, problem: &Problem) -> Result<PreparedSweep, Error> {
        if self.spread != Spread::Uniform || self.angles {
            return Err(Error::ChainsOnly("a grid or a sequence of angles"));
        }
        let known = equilibria::all(problem, crate::simulate::CENSUS_BARS)?;
        let starts = threads::on(self.threads, || {
            Followed::new(problem, &known, self.number, FromPlaces(self.solvers))
        })??;
        let of = SweptBy::places(&starts, Manifest::PLACES, known.complete);
        Ok(PreparedSweep {
            manifest: self.manifest(of),
            compute: Compute::Places(Box::new(starts)),
        })
    }

    /// The solvers that are asked of a chain.
    fn asked(&self, chain: &ChainProblem) -> Result<sweep::Solvers, Error> {
        let both = solvers(chain)?;
        Ok(both.only(&FromPlaces(self.solvers).names()))
    }

    /// Processor time that the starts take, s: from a few starts, good to a factor of three.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare).
    pub fn expected_time_s(&self, problem: &Problem) -> Result<f64, Error> {
        /// Starts in space that are timed.
        const TIMED: u64 = 4;
        let seeds = self.seeds.div_ceil(self.shard.of.max(1));
        if let Some(chain) = problem.row() {
            let settings = Settings { number: self.number, ..Settings::default() };
            return Ok(sweep::expected_time_s(chain, &settings, &self.asked(chain)?, seeds)?);
        }
        let (system, start) = (problem.system(), Instant::now());
        for k in 0..TIMED {
            FromPlaces(self.solvers).follow(&system, k);
        }
        Ok(start.elapsed().as_secs_f64() / TIMED as f64 * seeds as f64)
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

    pub(crate) fn manifest(&self, of: SweptBy<'_>) -> Manifest {
        Manifest {
            schema_version: SCHEMA_VERSION,
            program: concat!("funicular ", env!("CARGO_PKG_VERSION")).to_owned(),
            system: of.system,
            seeds: self.seeds,
            seed_number: self.number,
            source: of.source,
            solvers: of.solvers,
            release: None,
            angles: (1..=of.angles).map(|bar| format!("theta_{bar}_rad")).collect(),
            equilibria: of.list.to_vec(),
            equilibria_complete: of.complete,
            format: word(&self.format),
            part_seeds: 0,
            shard: Shard::WHOLE,
            range: 0..0,
        }
        .with_shard(self.shard)
    }
}

/// What differs between starts over angles and starts in space.
pub(crate) struct SweptBy<'a> {
    system: SystemText,
    source: String,
    solvers: Vec<String>,
    /// Columns of starting values.
    angles: usize,
    list: &'a [Member],
    complete: bool,
}

impl<'a> SweptBy<'a> {
    /// Of starts that are places of joints.
    pub(crate) fn places<F: Follow>(starts: &'a Followed<F>, source: &str, complete: bool) -> Self {
        let source = source.to_owned();
        let (system, solvers, list) = (starts.text(), starts.names(), starts.list());
        Self { system, source, solvers, angles: 0, list, complete }
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
    compute: Compute,
    manifest: Manifest,
}

/// Where starts are.
#[derive(Debug, Clone)]
enum Compute {
    /// Angles of the bars of a chain, in the plane of its anchors.
    Angles(Box<sweep::Sweep>),
    /// Places of the joints of any system.
    Places(Box<Followed<FromPlaces>>),
}

impl PreparedSweep {
    /// Everything that the rows depend on, as the folder will say it.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The starts of this shard.
    pub fn range(&self) -> Range<u64> {
        self.manifest.range.clone()
    }

    /// Write a row per start into a folder, or go on with one.
    ///
    /// # Errors
    /// [`Error::Store`]; the folder is left as it was if it holds something else.
    pub fn write(&self, folder: &Path, settings: &RunSettings<'_>) -> Result<Run, Error> {
        Ok(match &self.compute {
            Compute::Angles(sweep) => sweep::run(folder, &self.manifest, &**sweep, settings)?,
            Compute::Places(starts) => sweep::run(folder, &self.manifest, &**starts, settings)?,
        })
    }
}

impl SweepAnswer {
    /// The counts as JSON, with the keys of `funicular sweep --json`: `solvers`, `comparisons`, `disagreements`.
    pub fn outcomes(&self) -> serde_json::Value {
        crate::text::sweep::object(&self.manifest, &self.summary)
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
