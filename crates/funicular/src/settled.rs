//! What a system that has been changed comes to rest in.

use std::sync::Arc;

use model::system::{Refusal, System, SystemEquilibrium};
use model::{Rung, Vector};
use numerics::vector::{minus, norm};
use serde::Serialize;
use validate::systems::SystemFailure;

use crate::error::Error;
use crate::extremes::Extremes;
use crate::solve::{Solve, SolveAnswer};
use crate::weakest::Weakest;

/// Distances that differ by less than this part of them are the same but for rounding.
const ROUNDING: f64 = 1e-9;

/// What a system that has been changed comes to rest in.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Settled {
    /// Sag, lowest joint, largest forces.
    #[serde(flatten)]
    pub extremes: Extremes,
    /// The lowest joint by name.
    pub lowest_joint: String,
    /// The joint that moves farthest from where it was.
    pub moves: String,
    /// How far, m.
    pub moves_m: f64,
    /// The member that is nearest to breaking, where members have strengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weakest: Option<Weakest>,
    /// The highest rung of evidence.
    pub rung: Option<Rung>,
    /// Whether both solvers answered and agree, and the judge finds both in balance.
    pub agrees: bool,
    #[serde(skip)]
    pub(crate) check_failed: bool,
    #[serde(skip)]
    pub(crate) is_decided: bool,
}

/// Why nothing more is said of a system that has been changed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Unsettled {
    /// What becomes of it.
    pub outcome: Outcome,
    /// Why, in words.
    pub reason: String,
}

/// What becomes of a system that does not hang as before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Nothing holds a part of it.
    Falls,
    /// It does not rest near its drawing: it folds, or snaps through.
    Leaves,
    /// Nothing is left that moves or weighs.
    NoLoad,
    /// No solver has an answer.
    Unknown,
}

/// Where a system comes to rest whose joints were at `before_m`, m, if that is known; the system as it was
/// solved, and its first equilibrium.
pub(crate) fn settle(
    solve: &Solve,
    system: System,
    before_m: &[Vector],
) -> Result<(Settled, Arc<System>, SystemEquilibrium), Unsettled> {
    let refused = |refusal: Refusal| Unsettled {
        outcome: match refusal {
            Refusal::Unconnected { .. } | Refusal::Falls { .. } => Outcome::Falls,
            Refusal::NothingMoves
            | Refusal::NoLoad
            | Refusal::LoadOnAnchors
            | Refusal::LoadsCancel => Outcome::NoLoad,
            _ => Outcome::Unknown,
        },
        reason: refusal.to_string(),
    };
    system.refusal().map_err(refused)?;
    let unknown = |reason: String| Unsettled { outcome: Outcome::Unknown, reason };
    let answer = solve.run_here(&system.into()).map_err(|error| {
        let Error::Unsolved(answer) = &error else { return unknown(error.to_string()) };
        let all = |is: fn(&SystemFailure) -> bool| answer.failures().iter().all(is);
        let outcome = if all(SystemFailure::falls) {
            Outcome::Falls
        } else if all(SystemFailure::is_unloaded) {
            // Its members are limp: it folds.
            Outcome::Leaves
        } else {
            return unknown(error.to_string());
        };
        let reason = answer.failures().first().map_or_else(String::new, ToString::to_string);
        Unsettled { outcome, reason }
    })?;
    let leaves = |reason: String| Unsettled { outcome: Outcome::Leaves, reason };
    if let Some(near) = answer.near() {
        let stays = answer.agrees() || answer.equilibria()[0].stability.index_in_space == 0;
        if !near.is_neighbour {
            let (joint, moved_m) = (&near.joint, near.moved_m);
            let reason = format!("joint {joint:?} comes to rest {moved_m:.3} m from its drawing");
            return Err(leaves(reason));
        }
        if !stays {
            return Err(leaves("the equilibrium near its drawing is unstable".to_owned()));
        }
    }
    let settled = Settled::of(&answer, before_m);
    let (system, found) = answer.into_parts();
    let first = found.into_iter().next();
    let all = settled.zip(first).map(|(settled, first)| (settled, system, first));
    all.ok_or_else(|| unknown("no equilibrium".to_owned()))
}

impl Settled {
    fn of(answer: &SolveAnswer, before_m: &[Vector]) -> Option<Self> {
        let (system, first) = (answer.system(), answer.equilibria().first()?);
        let extremes = Extremes::of(system, first)?;
        let before_m = if before_m.is_empty() { &first.joints_m } else { before_m };
        let moved = first.joints_m.iter().zip(before_m).map(|(a, b)| norm(minus(*a, *b)));
        // Of joints that move as far, but for rounding, the first.
        let (moves, moves_m) = moved
            .enumerate()
            .reduce(|most, next| if next.1 > (1.0 + ROUNDING) * most.1 { next } else { most })?;
        let name = |joint: usize| system.joints()[joint].name.to_string();
        Some(Self {
            lowest_joint: name(extremes.lowest_joint),
            extremes,
            moves: name(moves),
            moves_m,
            weakest: Weakest::of(system, first),
            rung: answer.rung(),
            agrees: answer.agrees(),
            check_failed: answer.check_failed(),
            is_decided: answer.is_decided(),
        })
    }

    /// The same with other numbers of the members.
    pub(crate) fn numbered(mut self, number: impl Fn(usize) -> usize) -> Self {
        let Extremes { tension_n, compression_n, .. } = &mut self.extremes;
        for (bar, _) in [tension_n, compression_n].into_iter().flatten() {
            *bar = number(*bar);
        }
        if let Some(weakest) = &mut self.weakest {
            weakest.bar = number(weakest.bar);
            if let Some(unjudged) = &mut weakest.unjudged {
                unjudged.bar = number(unjudged.bar);
            }
        }
        self
    }

    /// Whether it is as strong as wanted; no value without strengths.
    pub fn is_strong(&self) -> Option<bool> {
        self.weakest.map(|weakest| weakest.suffices())
    }
}
