//! What the search finds, before it is put into a list.

use std::time::Instant;

use model::Chain;
use rayon::prelude::*;

use crate::census::estimate::{Kept, refuse_long};
use crate::census::{Census, Statistics};
use crate::closure::Pattern;
use crate::count::topology::Topology;
use crate::degenerate::bound::Bound;
use crate::enclosure::krawczyk::Zero;
use crate::enclosure::polish::{PreciseSystem, polish};
use crate::equilibrium::ProvenEquilibrium;
use crate::error::CensusError;
use crate::plane::cell::Cell;
use crate::plane::loads::JointLoads;
use crate::plane::system::System;
use crate::search::merge::{Zeros, merge};
use crate::search::undecided::{Reason, Undecided, gather};
use crate::search::{Progress, Settled, search};
use crate::settings::Settings;
use crate::slack::families::families;
use crate::slack::moments::Exact;
use crate::slack::straight::Straight;
use crate::slack::unloaded::unloaded;

/// Below so many equilibria, threads cost more than they save: each takes tens of microseconds.
const WORTH_THREADS: usize = 64;

/// The zeros of the closure, each once, and all else that a census says.
pub(crate) struct Gathered {
    pub(crate) system: System,
    precise: PreciseSystem,
    zeros: Zeros,
    /// Equilibria with a bar that carries next to nothing.
    unloaded: Vec<ProvenEquilibrium>,
    /// Zeros whose index or finite pull is not proved.
    without_index: Vec<(Pattern, Cell)>,
    /// Slack families that may or may not exist.
    maybe: Vec<Vec<i8>>,
    /// Without its list of equilibria.
    census: Census,
    start: Instant,
}

impl Gathered {
    /// Search the pulls of a chain with loads at its joints.
    pub(crate) fn of(
        chain: &Chain,
        loads: &JointLoads,
        settings: &Settings,
        kept: Kept,
        watch: &dyn Fn(Progress),
    ) -> Result<Self, CensusError> {
        let start = Instant::now();
        settings.validate()?;
        refuse_long(chain, loads, settings, kept)?;
        let system = System::new(chain, loads);
        let exact = Exact::new(chain, loads);
        let unloaded = unloaded(&system, &exact);
        let straight = Straight::of(&system, &exact);
        let settled = Settled { unloaded: &unloaded, straight: &straight };
        let patterns = (0..1_u32 << system.bars()).map(Pattern).collect();
        let search = search(&system, settings, &settled, patterns, watch);

        let (zeros, unclear) = merge(&system, search.zeros);
        let mut undecided: Vec<Undecided> = vec![];
        let all = unloaded.equilibria.is_empty() && unloaded.degenerate.is_empty();
        for task in gather(search.undecided) {
            let reason = if search.exhausted {
                Reason::Budget
            } else if task.cell.is_at_unloaded_bar() {
                Reason::Unloaded
            } else {
                Reason::Degenerate
            };
            let mut open = Undecided::new(&system, reason, &task.cell, &task.patterns);
            if let (Reason::Degenerate, [pattern]) = (reason, &task.patterns[..]) {
                open.bound = Bound::of(&system, &task.cell, *pattern, &zeros, all);
            }
            // None besides those listed: decided.
            if open.bound.is_none_or(|bound| bound.at_most > 0) {
                undecided.push(open);
            }
        }
        for (pattern, zero) in unclear {
            undecided.push(Undecided::new(&system, Reason::Unclear, &zero.tight, &[pattern]));
        }
        let (families, mut maybe) = families(&system, exact.sides.as_ref());
        maybe.retain(|signs| !unloaded.is_one_position(&system, &exact, signs));
        let census = Census {
            equilibria: vec![],
            families,
            straight: straight.positions,
            degenerate: unloaded.degenerate,
            undecided,
            complete: false,
            circles: system.vertical,
            topology: Topology::of_system(&system),
            statistics: Statistics {
                bars: system.bars(),
                cells: search.cells,
                tests: search.tests,
                proofs: search.proofs,
                levels: search.levels,
                seconds: 0.0,
            },
        };
        Ok(Self {
            precise: PreciseSystem::new(chain, loads, &system),
            system,
            zeros,
            unloaded: unloaded.equilibria,
            without_index: vec![],
            maybe,
            census,
            start,
        })
    }

    /// The equilibria with a bar that carries next to nothing.
    pub(crate) fn take_unloaded(&mut self) -> Vec<ProvenEquilibrium> {
        std::mem::take(&mut self.unloaded)
    }

    /// What is made of the signs and the zero of each other equilibrium; one of which nothing can
    /// be made becomes undecided.
    pub(crate) fn each<T: Send>(
        &mut self,
        of: impl Fn(&System, &[i8], &Zero) -> Option<T> + Sync,
    ) -> Vec<T> {
        let zeros = std::mem::take(&mut self.zeros);
        let (system, precise) = (&self.system, &self.precise);
        let one = |(pattern, zero): &(Pattern, Zero)| {
            let signs: Vec<i8> = pattern.signs(system.bars()).collect();
            let zero = polish(system, precise, &signs, zero);
            of(system, &signs, &zero).ok_or((*pattern, zero.tight))
        };
        let made: Vec<_> = if zeros.len() < WORTH_THREADS {
            zeros.iter().map(one).collect()
        } else {
            zeros.par_iter().map(one).collect()
        };
        drop(zeros);
        let mut all = Vec::with_capacity(made.len());
        for result in made {
            match result {
                Ok(one) => all.push(one),
                Err(open) => self.without_index.push(open),
            }
        }
        all
    }

    /// The system, and the census without its list of equilibria.
    pub(crate) fn finish(self) -> (System, Census) {
        let Self { system, without_index, maybe, mut census, start, .. } = self;
        let open = without_index.iter().map(|(pattern, tight)| {
            Undecided::new(&system, Reason::Index, tight, std::slice::from_ref(pattern))
        });
        census.undecided.extend(open);
        census.undecided.extend(maybe.into_iter().map(|signs| Undecided::slack(&system, signs)));
        census.statistics.seconds = start.elapsed().as_secs_f64();
        (system, census)
    }
}
