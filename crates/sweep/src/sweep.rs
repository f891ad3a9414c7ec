//! A sweep over seeds.

use std::ops::Range;

use model::{Ends, Finish, Problem};
use rayon::prelude::*;

use crate::error::SweepError;
use crate::identify::Members;
use crate::record::{Chunk, Failure, Outcomes};
use crate::settings::Settings;
use crate::solver::Solvers;
use crate::starts::Starts;
use crate::store::compute::Compute;
use crate::summary::Summary;

/// Many seeds of one problem through one or several solvers.
///
/// What becomes of a seed depends on the problem, the settings and its number alone: not on the
/// other seeds of a chunk, the threads, or the machine. For an example see
/// [`BatchSolver`](crate::BatchSolver).
#[derive(Debug, Clone)]
pub struct Sweep {
    settings: Settings,
    bars: usize,
    members: Members,
    starts: Starts,
    solvers: Solvers,
}

/// Most seeds solved at a time, in the memory of one chunk: results do not depend on it.
const BLOCK: u64 = 1024;

/// Most bars of seeds solved at a time: their angles and directions take 24 MB.
const BLOCK_BARS: u64 = 1 << 20;

/// Seeds of chains of so many bars that are solved at a time, of at most `most`.
pub(crate) fn block(bars: usize, most: u64) -> u64 {
    (BLOCK_BARS / (bars as u64).max(1)).clamp(1, most)
}

impl Sweep {
    /// Prepare a sweep: validate, and make the list of equilibria.
    ///
    /// # Errors
    ///
    /// [`SweepError`].
    pub fn new(
        problem: &Problem,
        settings: Settings,
        solvers: Solvers,
    ) -> Result<Self, SweepError> {
        settings.validate()?;
        solvers.check()?;
        let bars = problem.chain().bars().len();
        let starts = settings.source.ready(settings.number, bars)?;
        let members = Members::of(problem, &settings, &solvers)?;
        Ok(Self { settings, bars, members, starts, solvers })
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The solvers.
    #[must_use]
    pub fn solvers(&self) -> &Solvers {
        &self.solvers
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
        self.starts.fill(seeds, self.bars, &mut angles);
        angles
    }

    /// What becomes of a run of seeds. All columns are in memory: about 20 bytes per seed and
    /// solver.
    #[must_use]
    pub fn run_chunk(&self, seeds: Range<u64>) -> Chunk {
        let mut angles = vec![];
        let mut ends = Ends::default();
        let named = |solver: &str| Outcomes { solver: solver.to_owned(), ..Outcomes::default() };
        let outcomes = self.solvers.names().map(named).collect();
        let mut chunk = Chunk { seeds: seeds.clone(), outcomes };
        let mut start = seeds.start;
        while start < seeds.end {
            let end = seeds.end.min(start.saturating_add(block(self.bars, BLOCK)));
            self.starts.fill(start..end, self.bars, &mut angles);
            for (solver, outcomes) in self.solvers.asked.iter().zip(&mut chunk.outcomes) {
                solver.solve(&angles, &mut ends);
                self.record(&ends, outcomes);
            }
            start = end;
        }
        chunk
    }

    /// Add where a block of seeds ended.
    fn record(&self, ends: &Ends, outcomes: &mut Outcomes) {
        outcomes.iterations.extend_from_slice(&ends.iterations);
        outcomes.residual.extend_from_slice(&ends.residual);
        outcomes.energy_j.extend_from_slice(&ends.energy_j);
        let ends = ends.finish.iter().zip(&ends.energy_j).zip(ends.directions.chunks(self.bars));
        outcomes.outcome.extend(ends.map(|((finish, energy_j), directions)| match finish {
            Finish::Converged => self.identified(directions, *energy_j),
            Finish::IterationLimit => Failure::IterationLimit as i16,
            Finish::Stalled => Failure::Stalled as i16,
            Finish::NonFinite => Failure::NonFinite as i16,
        }));
    }

    fn identified(&self, directions: &[[f64; 2]], energy_j: f64) -> i16 {
        self.members.identify(directions, energy_j).unwrap_or(Failure::Unlisted as i16)
    }

    /// Run all seeds of a range on the given number of threads (0: one per processor) and sum up.
    /// Memory does not grow with the number of seeds.
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
    fn chunk_seeds(&self) -> u64 {
        8 * block(self.bars, BLOCK)
    }

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
