use std::ops::Range;

use model::{Ends, Finish, Problem};
use rayon::prelude::*;

use crate::error::SweepError;
use crate::identify::Members;
use crate::reached::{Discovered, Reached};
use crate::record::{Chunk, Failure, Outcomes};
use crate::settings::Settings;
use crate::solver::{Finds, Solvers};
use crate::starts::Starts;
use crate::store::compute::Compute;
use crate::summary::{OpenSummary, Summary};

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
    /// What seeds reach beside the members where these are not complete: nothing yet.
    nothing: Option<Reached>,
    starts: Starts,
    solvers: Solvers,
}

/// Most seeds solved at a time, in the memory of one chunk: results do not depend on it.
const BLOCK: u64 = 1024;

/// Most bars of seeds solved at a time: their angles and the directions by two solvers take 20 MB.
const BLOCK_BARS: u64 = 1 << 19;

/// Bars of a chunk where the list is not complete: a fraction of a second of work, after which the
/// number of equilibria found is told.
const TOLD_BARS: u64 = 1 << 14;

/// Fewest seeds of such a chunk: several are solved side by side.
const TOLD_SEEDS: u64 = 16;

/// Chunks in memory for each thread before they are counted.
const WAVE: usize = 4;

/// Seeds of chains of so many bars that are solved at a time.
fn block(bars: usize) -> u64 {
    (BLOCK_BARS / (bars as u64).max(1)).clamp(1, BLOCK)
}

impl Sweep {
    /// Prepare a sweep: validate, and list the equilibria that are proved.
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
        let members = Members::of(problem, &settings)?;
        let open = !members.complete();
        let nothing = open.then(|| Reached::new(problem, members.list().len()));
        Ok(Self { settings, bars, members, nothing, starts, solvers })
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The solvers.
    pub fn solvers(&self) -> &Solvers {
        &self.solvers
    }

    /// The proven list, by which outcomes are numbered first.
    pub fn members(&self) -> &Members {
        &self.members
    }

    /// The angles of a run of seeds, rad: n for each seed.
    pub fn angles_rad(&self, seeds: Range<u64>) -> Vec<f64> {
        let mut angles = vec![];
        self.starts.fill(seeds, self.bars, &mut angles);
        angles
    }

    /// What becomes of a run of seeds. All columns are in memory: about 20 bytes per seed and
    /// solver. What is not in the proven list is [`Failure::Unlisted`].
    pub fn run_chunk(&self, seeds: Range<u64>) -> Chunk {
        self.run_blocks(seeds, None)
    }

    /// The same, with numbers behind the proven ones for what is reached beside them: of every
    /// seed first by the solvers that find minima, whose index is known.
    fn run_blocks(&self, seeds: Range<u64>, mut reached: Option<&mut Reached>) -> Chunk {
        let mut angles = vec![];
        let mut ends = vec![Ends::default(); self.solvers.asked.len()];
        let named = |solver: &str| Outcomes { solver: solver.to_owned(), ..Outcomes::default() };
        let outcomes = self.solvers.names().map(named).collect();
        let mut chunk = Chunk { seeds: seeds.clone(), outcomes };
        let mut start = seeds.start;
        while start < seeds.end {
            let end = seeds.end.min(start.saturating_add(block(self.bars)));
            self.starts.fill(start..end, self.bars, &mut angles);
            for (solver, ends) in self.solvers.asked.iter().zip(&mut ends) {
                solver.solve(&angles, ends);
            }
            for (ends, outcomes) in ends.iter().zip(&mut chunk.outcomes) {
                self.record(ends, outcomes);
            }
            if let Some(reached) = reached.as_deref_mut() {
                self.number(&ends, &mut chunk, reached);
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
            Finish::Converged => {
                self.members.identify(directions, *energy_j).unwrap_or(Failure::Unlisted as i16)
            }
            Finish::IterationLimit => Failure::IterationLimit as i16,
            Finish::Stalled => Failure::Stalled as i16,
            Finish::NonFinite => Failure::NonFinite as i16,
        }));
    }

    /// Number what the last block of a chunk reached beside the proven list.
    fn number(&self, ends: &[Ends], chunk: &mut Chunk, reached: &mut Reached) {
        let mut order: Vec<usize> = (0..ends.len()).collect();
        order.sort_by_key(|k| self.solvers.asked[*k].finds() != Finds::Minima);
        let seeds = ends.iter().map(|ends| ends.finish.len()).min().unwrap_or(0);
        for seed in 0..seeds {
            for solver in &order {
                let (ends, outcome) = (&ends[*solver], &mut chunk.outcomes[*solver].outcome);
                let row = outcome.len() - seeds + seed;
                if outcome[row] == Failure::Unlisted as i16 {
                    let is_minimum = self.solvers.asked[*solver].finds() == Finds::Minima;
                    let u = &ends.directions[seed * self.bars..(seed + 1) * self.bars];
                    outcome[row] = reached.number(u, ends.energy_j[seed], is_minimum.then_some(0));
                }
            }
        }
    }

    /// Nothing reached yet; none where the proven list is complete.
    pub fn nothing_reached(&self) -> Option<Reached> {
        self.nothing.clone()
    }

    /// Chunks of `size` seeds on all threads of the pool of whoever asks, each handed on in order,
    /// with the numbers of `reached`. The numbers of the final list follow from them:
    /// [`Reached::renumber`].
    pub fn run_chunks(
        &self,
        seeds: Range<u64>,
        size: u64,
        reached: &mut Reached,
        each: &mut dyn FnMut(Chunk),
    ) {
        let size = size.max(1);
        let mut start = seeds.start;
        while start < seeds.end {
            let wave = (WAVE * rayon::current_num_threads()) as u64;
            let end = seeds.end.min(start.saturating_add(wave.saturating_mul(size)));
            let own = |k: u64| {
                let mut own = reached.nothing();
                let first = start + k * size;
                let chunk = self.run_blocks(first..end.min(first + size), Some(&mut own));
                (chunk, own)
            };
            let chunks: Vec<_> =
                (0..(end - start).div_ceil(size)).into_par_iter().map(own).collect();
            for (mut chunk, mut own) in chunks {
                own.hand_over(reached).apply_to(&mut chunk);
                each(chunk);
            }
            start = end;
        }
    }

    /// Nothing counted yet, for [`go_on`](Self::go_on).
    pub fn begin(&self) -> Swept {
        let summary = Summary::new(self.members.list(), self.members.energy_unit_j());
        match &self.nothing {
            None => Swept(Counts::Complete(Box::new(summary))),
            Some(nothing) => {
                let list = self.members.list().to_vec();
                let counts = OpenSummary::new(summary, list);
                Swept(Counts::Open(Box::new((counts, nothing.clone()))))
            }
        }
    }

    /// Count the seeds of a range, on the given number of threads (0: one per processor). Memory
    /// does not grow with the number of seeds.
    ///
    /// # Errors
    ///
    /// [`SweepError::Threads`] when they cannot be started.
    pub fn go_on(
        &self,
        swept: &mut Swept,
        seeds: Range<u64>,
        threads: usize,
    ) -> Result<(), SweepError> {
        match &mut swept.0 {
            Counts::Complete(summary) => summary.merge(&self.run_complete(seeds, threads)?),
            Counts::Open(open) => {
                let (counts, reached) = &mut **open;
                let size = self.settings.chunk.min(self.chunk_seeds());
                let mut each = |chunk: Chunk| counts.add(&chunk);
                pool(threads)?.install(|| self.run_chunks(seeds, size, reached, &mut each));
            }
        }
        Ok(())
    }

    /// Run all seeds of a range and sum up, as [`go_on`](Self::go_on) does.
    ///
    /// # Errors
    ///
    /// [`SweepError::Threads`] when the threads cannot be started.
    pub fn run(&self, seeds: Range<u64>, threads: usize) -> Result<Summary, SweepError> {
        let mut swept = self.begin();
        self.go_on(&mut swept, seeds, threads)?;
        Ok(swept.finish().0)
    }

    /// Where the list is complete, in whatever order.
    fn run_complete(&self, seeds: Range<u64>, threads: usize) -> Result<Summary, SweepError> {
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
        let all = || (0..chunks).into_par_iter().fold(nothing, add).reduce(nothing, merge);
        Ok(pool(threads)?.install(all))
    }
}

fn pool(threads: usize) -> Result<rayon::ThreadPool, SweepError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| SweepError::Threads { threads, reason: error.to_string() })
}

/// What a sweep in memory has counted so far.
#[derive(Debug, Clone)]
pub struct Swept(Counts);

#[derive(Debug, Clone)]
enum Counts {
    Complete(Box<Summary>),
    Open(Box<(OpenSummary, Reached)>),
}

impl Swept {
    /// The counts by the final numbers, and what these stand for behind the proven list, where that
    /// is not complete.
    pub fn finish(self) -> (Summary, Option<Discovered>) {
        match self.0 {
            Counts::Complete(summary) => (*summary, None),
            Counts::Open(open) => {
                let (counts, mut reached) = *open;
                let (discovered, renumbering) = reached.finish();
                (counts.finish(&discovered, &renumbering), Some(discovered))
            }
        }
    }
}

impl Compute for Sweep {
    fn chunk_seeds(&self) -> u64 {
        let all = 8 * block(self.bars);
        let few = (TOLD_BARS / (self.bars as u64).max(1)).max(TOLD_SEEDS);
        if self.nothing.is_some() { all.min(few) } else { all }
    }

    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        self.run_chunk(seeds)
    }

    fn chunk_reaching(&self, seeds: Range<u64>, reached: &mut Reached) -> Chunk {
        self.run_blocks(seeds, Some(reached))
    }

    fn angles(&self, seeds: Range<u64>) -> Vec<Vec<f64>> {
        let rows = self.angles_rad(seeds);
        (0..self.bars)
            .map(|bar| rows.iter().skip(bar).step_by(self.bars).copied().collect())
            .collect()
    }
}
