//! What becomes of a system that loses a member.

use std::sync::Arc;

use model::Vector;
use model::system::{Member, System};
use numerics::vector::{minus, norm};
use rayon::prelude::*;
use serde::Serialize;
use validate::UseCensus;

use crate::error::Error;
use crate::object::{either, head};
use crate::problem::Problem;
use crate::settled::{Outcome, Settled, Unsettled, settle};
use crate::solve::Solve;
use crate::weakest::from_one;

/// The loss of one member.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Loss {
    /// The member that is lost, from 0; in JSON from 1.
    #[serde(serialize_with = "from_one")]
    pub bar: usize,
    /// What hangs then, or why nothing does. Members keep the numbers that they had before.
    #[serde(flatten, serialize_with = "either")]
    pub left: Result<Settled, Unsettled>,
}

/// What the loss of each member does; it serialises to what `funicular solve --without each --json` prints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LossesAnswer {
    #[serde(flatten, serialize_with = "head")]
    system: Arc<System>,
    losses: Vec<Loss>,
}

impl Solve {
    /// Take each member away in turn and find where what is left comes to rest, with which forces: the
    /// accidental limit state. Each by both solvers and the judge, without a census.
    ///
    /// ```
    /// use funicular::{Outcome, prelude::*};
    /// // 300 N hang on two ropes by a hanger, and each rope bears 300 N.
    /// let text = "gravity_m_s2 = 10\n\
    ///             joints = { A = { at_m = [-4, 0, 0] }, B = { at_m = [4, 0, 0] }, P = {}, Q = { mass_kg = 30 } }\n\
    ///             bars = [{ from = 'A', to = 'P', length_m = 5, mass_kg = 0, strength_n = 300 },\n\
    ///                     { from = 'B', to = 'P', length_m = 5, mass_kg = 0, strength_n = 300 },\n\
    ///                     { from = 'P', to = 'Q', length_m = 1, mass_kg = 0 }]";
    /// let found = Solve::new().without_each(&Problem::parse(text, "net.toml")?)?;
    /// let [left, right, hanger] = found.losses() else { panic!("three members") };
    /// // Without one of them all hangs on the other.
    /// for (loss, bar) in [(left, 1), (right, 0)] {
    ///     let weakest = loss.left.as_ref().expect("the other").weakest.expect("a strength");
    ///     assert!(weakest.bar == bar && (weakest.utilisation - 1.0).abs() < 1e-9);
    /// }
    /// assert!(hanger.left.as_ref().is_err_and(|reason| reason.outcome == Outcome::Falls));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`run`](Self::run) for the whole system. What has no answer after a loss is no error: it says
    /// why.
    pub fn without_each(&self, problem: &Problem) -> Result<LossesAnswer, Error> {
        self.without_each_watched(problem, &|| {})
    }

    /// The same, with `watch` told of each loss that is done.
    ///
    /// # Errors
    /// As [`without_each`](Self::without_each).
    pub fn without_each_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn() + Sync),
    ) -> Result<LossesAnswer, Error> {
        let system = problem.system();
        let solve = self.census(UseCensus::Never);
        let before = solve.run(problem)?;
        let places = before.equilibria().first().map_or(&[][..], |e| &e.joints_m);
        let loss = |bar: usize| {
            let left = left(&solve, &system, bar, places);
            watch();
            Loss { bar, left }
        };
        let all = 0..system.members().len();
        let losses = solve.on_threads(|| all.into_par_iter().map(loss).collect())?;
        Ok(LossesAnswer { system, losses })
    }
}

/// A member that rises by more than this part of its length and falls by more than it afterwards has turned over, as the guys
/// of a mast do that is gone: one that is nearly level may sink.
const OVER: f64 = 0.25;

/// Whether a member has turned over from one shape to the other.
fn is_overturned(system: &System, from_m: &[Vector], to_m: &[Vector]) -> bool {
    let rise = |places: &[Vector], [a, b]: [usize; 2]| {
        let d = minus(places[b], places[a]);
        d[2] / norm(d)
    };
    let mut spans = system.members().iter().flat_map(Member::spans);
    spans.any(|span| {
        let [before, after] = [from_m, to_m].map(|places| rise(places, span));
        before * after < 0.0 && before.abs().min(after.abs()) > OVER
    })
}

/// What is left of a system without a member. Cables alone have one shape, far from their drawing or not: what stood and
/// hangs there upside down has left it.
fn left(
    solve: &Solve,
    system: &System,
    bar: usize,
    before_m: &[Vector],
) -> Result<Settled, Unsettled> {
    let (rest, joints) = system.without(bar);
    let before_m: Vec<Vector> = joints.iter().filter_map(|k| before_m.get(*k).copied()).collect();
    let (left, rest, found) = settle(solve, rest, &before_m).map_err(|mut why| {
        if why.outcome == Outcome::Unknown {
            why.reason += " (members are counted without the lost one)";
        }
        why
    })?;
    let is_known = before_m.len() == found.joints_m.len();
    if is_known && rest.drawing().is_some() && is_overturned(&rest, &before_m, &found.joints_m) {
        let Settled { moves, moves_m, .. } = left;
        let reason = format!("joint {moves:?} comes to rest {moves_m:.3} m from where it was");
        return Err(Unsettled { outcome: Outcome::Leaves, reason });
    }
    Ok(left.numbered(|k| if k >= bar { k + 1 } else { k }))
}

impl LossesAnswer {
    /// The system before any loss.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// A loss for each member, in their order.
    pub fn losses(&self) -> &[Loss] {
        &self.losses
    }

    /// Whether a check of a solver's answer has failed.
    pub fn check_failed(&self) -> bool {
        self.left().any(|left| left.check_failed)
    }

    /// Whether it is known of each loss whether what is left hangs, and how.
    pub fn is_decided(&self) -> bool {
        self.losses.iter().all(|loss| match &loss.left {
            Ok(left) => left.is_decided,
            Err(reason) => reason.outcome != Outcome::Unknown,
        })
    }

    /// Whether the system survives the loss of any one member: all of it still hangs, and what has a
    /// strength is as strong as wanted.
    pub fn survives(&self) -> bool {
        self.losses.iter().all(|loss| match &loss.left {
            Ok(left) => left.is_strong().unwrap_or(true),
            Err(reason) => reason.outcome == Outcome::NoLoad,
        })
    }

    fn left(&self) -> impl Iterator<Item = &Settled> {
        self.losses.iter().filter_map(|loss| loss.left.as_ref().ok())
    }
}
