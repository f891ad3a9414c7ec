//! A sweep over seeds.

use std::ops::Range;

use model::Problem;
use rayon::prelude::*;

use crate::compute::Compute;
use crate::error::SweepError;
use crate::identify::Members;
use crate::record::{Chunk, Failure, Outcomes};
use crate::settings::{Settings, Solvers};
use crate::source::Spring;
use crate::summary::Summary;

/// Many seeds of one problem through one or both solvers.
///
/// What becomes of a seed depends on the problem, the settings and its number alone: not on the other seeds
/// of a chunk, the threads, or the machine.
///
/// ```
/// use sweep::{Settings, Sweep};
/// let sweep = Sweep::new(&model::cases::paper(), Settings::default())?;
/// let summary = sweep.run(0..2000, 2)?;
/// let lagrange = summary.tally().lagrange.as_ref().ok_or("not asked")?;
/// // The four equilibria of the census, and nothing else.
/// assert_eq!(lagrange.0.keys().copied().collect::<Vec<_>>(), [0, 1, 2, 3]);
/// assert_eq!(lagrange.0.values().map(|row| row.count).sum::<u64>(), 2000);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Sweep {
    settings: Settings,
    bars: usize,
    members: Members,
    spring: Spring,
    newton: Option<lagrange::batch::Batch>,
    descent: Option<energy::batch::Batch>,
}

/// Seeds solved at a time, in the memory of one chunk: results do not depend on it.
const BLOCK: u64 = 1024;

impl Sweep {
    /// Prepare a sweep: validate, and make the list of equilibria.
    ///
    /// # Errors
    ///
    /// [`SweepError`].
    pub fn new(problem: &Problem, settings: Settings) -> Result<Self, SweepError> {
        settings.validate()?;
        let bars = problem.chain().bars().len();
        let spring = settings.source.ready(settings.number, bars)?;
        let members = Members::of(problem, &settings)?;
        let newton = match settings.solvers {
            Solvers::Energy => None,
            _ => Some(lagrange::batch::Batch::new(problem, settings.lagrange)?),
        };
        let descent = match settings.solvers {
            Solvers::Lagrange => None,
            _ => Some(energy::batch::Batch::new(problem, settings.energy)?),
        };
        Ok(Self { settings, bars, members, spring, newton, descent })
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The list by which outcomes are numbered.
    #[must_use]
    pub fn members(&self) -> &Members {
        &self.members
    }

    /// The angles of a run of seeds, rad: n for each seed.
    #[must_use]
    pub fn angles_rad(&self, seeds: Range<u64>) -> Vec<f64> {
        let mut angles = vec![];
        self.spring.fill(seeds, self.bars, &mut angles);
        angles
    }

    /// What becomes of a run of seeds. All columns are in memory: about 20 bytes per seed and solver.
    #[must_use]
    pub fn run_chunk(&self, seeds: Range<u64>) -> Chunk {
        let mut angles = vec![];
        let mut points = lagrange::batch::Ends::default();
        let mut minima = energy::batch::Ends::default();
        let mut chunk = Chunk {
            seeds: seeds.clone(),
            lagrange: self.newton.is_some().then(Outcomes::default),
            energy: self.descent.is_some().then(Outcomes::default),
        };
        let mut start = seeds.start;
        while start < seeds.end {
            let end = seeds.end.min(start.saturating_add(BLOCK));
            self.spring.fill(start..end, self.bars, &mut angles);
            if let (Some(batch), Some(outcomes)) = (&self.newton, &mut chunk.lagrange) {
                batch.solve(&angles, &mut points);
                outcomes.iterations.extend_from_slice(&points.iterations);
                outcomes.residual.extend_from_slice(&points.residual);
                outcomes.energy_j.extend_from_slice(&points.energy_j);
                for (seed, finish) in points.finish.iter().enumerate() {
                    use lagrange::batch::Finish;
                    let u = &points.directions[seed * self.bars..(seed + 1) * self.bars];
                    outcomes.outcome.push(match finish {
                        Finish::Converged => self.identified(u, points.energy_j[seed]),
                        Finish::IterationLimit => Failure::IterationLimit as i16,
                        Finish::NonFinite => Failure::NonFinite as i16,
                    });
                }
            }
            if let (Some(batch), Some(outcomes)) = (&self.descent, &mut chunk.energy) {
                batch.minimise(&angles, &mut minima);
                outcomes.iterations.extend_from_slice(&minima.iterations);
                outcomes.residual.extend_from_slice(&minima.residual);
                outcomes.energy_j.extend_from_slice(&minima.energy_j);
                for (seed, finish) in minima.finish.iter().enumerate() {
                    use energy::batch::Finish;
                    let u = &minima.directions[seed * self.bars..(seed + 1) * self.bars];
                    outcomes.outcome.push(match finish {
                        Finish::Minimum => self.identified(u, minima.energy_j[seed]),
                        Finish::IterationLimit => Failure::IterationLimit as i16,
                        Finish::Stalled => Failure::Stalled as i16,
                        Finish::NonFinite => Failure::NonFinite as i16,
                    });
                }
            }
            start = end;
        }
        chunk
    }

    fn identified(&self, directions: &[[f64; 2]], energy_j: f64) -> i16 {
        self.members.identify(directions, energy_j).unwrap_or(Failure::Unlisted as i16)
    }

    /// Run all seeds of a range on the given number of threads (0: one per processor) and sum up. Memory does
    /// not grow with the number of seeds.
    ///
    /// # Errors
    ///
    /// [`SweepError::Threads`] when they cannot be started.
    pub fn run(&self, seeds: Range<u64>, threads: usize) -> Result<Summary, SweepError> {
        let size = self.settings.chunk;
        let chunks = seeds.end.saturating_sub(seeds.start).div_ceil(size);
        let nothing = || Summary::new(self.members.list(), self.members.energy_unit_j());
        let add = |mut summary: Summary, k: u64| {
            let start = seeds.start + k * size;
            summary.add(&self.run_chunk(start..seeds.end.min(start.saturating_add(size))));
            summary
        };
        let merge = |mut one: Summary, other: Summary| {
            one.merge(&other);
            one
        };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|error| SweepError::Threads { threads, reason: error.to_string() })?;
        Ok(pool.install(|| (0..chunks).into_par_iter().fold(nothing, add).reduce(nothing, merge)))
    }
}

impl Compute for Sweep {
    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        self.run_chunk(seeds)
    }

    fn angles(&self, seeds: Range<u64>) -> Vec<Vec<f64>> {
        let rows = self.angles_rad(seeds);
        (0..self.bars)
            .map(|bar| rows.iter().skip(bar).step_by(self.bars).copied().collect())
            .collect()
    }
}
