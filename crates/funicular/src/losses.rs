//! What becomes of a system that loses a member.

use std::sync::Arc;

use model::system::{System, SystemRefusal};
use model::{Rung, Vector};
use rayon::prelude::*;
use serde::{Serialize, Serializer};
use validate::UseCensus;

use crate::equilibria::system_of;
use crate::error::Error;
use crate::extremes::Extremes;
use crate::modes::Summary;
use crate::problem::Problem;
use crate::solve::{SCHEMA_VERSION, Solve, SolveAnswer};
use crate::weakest::{Weakest, from_one};

/// Distances that differ by less than this part of them are the same but for rounding.
const ROUNDING: f64 = 1e-9;

/// The loss of one member.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Loss {
    /// The member that is lost, from 0; in JSON from 1.
    #[serde(serialize_with = "from_one")]
    pub bar: usize,
    /// What hangs then, or why nothing does.
    #[serde(flatten, serialize_with = "either")]
    pub left: Result<Left, NothingLeft>,
}

/// What hangs after a loss. Members keep the numbers that they had before it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Left {
    /// Sag, lowest joint, largest forces.
    #[serde(flatten)]
    pub extremes: Extremes,
    /// The lowest joint by name.
    pub lowest_joint: String,
    /// The joint that moves farthest from where it was.
    pub moves: String,
    /// How far, m.
    pub moves_m: f64,
    /// The member that is nearest to breaking then, where members have strengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weakest: Option<Weakest>,
    /// The highest rung of evidence.
    pub rung: Option<Rung>,
    /// Whether both solvers answered and agree, and the judge finds both in balance.
    pub agrees: bool,
    #[serde(skip)]
    check_failed: bool,
    #[serde(skip)]
    is_decided: bool,
}

/// Why nothing more is said of what is left.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NothingLeft {
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

/// What the loss of each member does.
#[derive(Debug, Clone, PartialEq)]
pub struct LossesAnswer {
    system: Arc<System>,
    losses: Vec<Loss>,
}

fn either<S: Serializer>(
    left: &Result<Left, NothingLeft>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match left {
        Ok(left) => left.serialize(serializer),
        Err(reason) => reason.serialize(serializer),
    }
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
    ///
    /// As [`run`](Self::run) for the whole system. What has no answer after a loss is no error: it says
    /// why.
    pub fn without_each(&self, problem: &Problem) -> Result<LossesAnswer, Error> {
        self.without_each_watched(problem, &|| {})
    }

    /// The same, with `watch` told of each loss that is done.
    ///
    /// # Errors
    ///
    /// As [`without_each`](Self::without_each).
    pub fn without_each_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn() + Sync),
    ) -> Result<LossesAnswer, Error> {
        let system = system_of(problem);
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

/// What is left of a system without a member.
fn left(
    solve: &Solve,
    system: &System,
    bar: usize,
    before_m: &[Vector],
) -> Result<Left, NothingLeft> {
    let (rest, joints) = system.without(bar);
    let before_m: Vec<Vector> = joints.iter().filter_map(|k| before_m.get(*k).copied()).collect();
    let refused = |refusal: SystemRefusal| NothingLeft {
        outcome: match refusal {
            SystemRefusal::Unconnected { .. } | SystemRefusal::Falls { .. } => Outcome::Falls,
            SystemRefusal::NothingMoves | SystemRefusal::NoLoad | SystemRefusal::LoadOnAnchors => {
                Outcome::NoLoad
            }
            _ => Outcome::Unknown,
        },
        reason: refusal.to_string(),
    };
    rest.refusal().map_err(refused)?;
    let unknown = |reason: String| NothingLeft { outcome: Outcome::Unknown, reason };
    let answer = solve.run_here(&rest.into()).map_err(|error| unknown(error.to_string()))?;
    if let Some(near) = answer.near().filter(|near| !near.is_neighbour) {
        let (joint, moved_m) = (&near.joint, near.moved_m);
        let reason = format!("joint {joint:?} comes to rest {moved_m:.3} m from its drawing");
        return Err(NothingLeft { outcome: Outcome::Leaves, reason });
    }
    Left::of(&answer, bar, &before_m).ok_or_else(|| unknown("no equilibrium".to_owned()))
}

impl Left {
    fn of(answer: &SolveAnswer, lost: usize, before_m: &[Vector]) -> Option<Self> {
        let (system, first) = (answer.system(), answer.equilibria().first()?);
        let before = |bar: usize| if bar >= lost { bar + 1 } else { bar };
        let mut extremes = Extremes::of(system, first)?;
        for largest in [&mut extremes.tension_n, &mut extremes.compression_n].into_iter().flatten()
        {
            largest.0 = before(largest.0);
        }
        let weakest = Weakest::of(system, first);
        let moved = first.joints_m.iter().zip(before_m).map(|(a, b)| {
            let [x, y, z] = [0, 1, 2].map(|k| a[k] - b[k]);
            x.hypot(y).hypot(z)
        });
        // Of joints that move as far, but for rounding, the first.
        let (moves, moves_m) = moved
            .enumerate()
            .reduce(|most, next| if next.1 > (1.0 + ROUNDING) * most.1 { next } else { most })?;
        let name = |joint: usize| system.joints()[joint].name.clone();
        Some(Self {
            lowest_joint: name(extremes.lowest_joint),
            extremes,
            moves: name(moves),
            moves_m,
            weakest: weakest.map(|weakest| Weakest { bar: before(weakest.bar), ..weakest }),
            rung: answer.rung(),
            agrees: answer.agrees(),
            check_failed: answer.check_failed(),
            is_decided: answer.is_decided(),
        })
    }

    /// Whether what is left is as strong as wanted; no value without strengths.
    #[must_use]
    pub fn is_strong(&self) -> Option<bool> {
        self.weakest.map(|weakest| weakest.suffices())
    }
}

impl LossesAnswer {
    /// The system before any loss.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// A loss for each member, in their order.
    #[must_use]
    pub fn losses(&self) -> &[Loss] {
        &self.losses
    }

    /// Whether a check of a solver's answer has failed.
    #[must_use]
    pub fn check_failed(&self) -> bool {
        self.left().any(|left| left.check_failed)
    }

    /// Whether it is known of each loss whether what is left hangs, and how.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.losses.iter().all(|loss| match &loss.left {
            Ok(left) => left.is_decided,
            Err(reason) => reason.outcome != Outcome::Unknown,
        })
    }

    /// Whether the system survives the loss of any one member: all of it still hangs, and what has a
    /// strength is as strong as wanted.
    #[must_use]
    pub fn survives(&self) -> bool {
        self.losses.iter().all(|loss| match &loss.left {
            Ok(left) => left.is_strong().unwrap_or(true),
            Err(reason) => reason.outcome == Outcome::NoLoad,
        })
    }

    fn left(&self) -> impl Iterator<Item = &Left> {
        self.losses.iter().filter_map(|loss| loss.left.as_ref().ok())
    }
}

/// As `funicular solve --without each --json` prints it.
impl Serialize for LossesAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Object<'a> {
            schema_version: u32,
            system: Summary,
            losses: &'a [Loss],
        }
        let system = Summary::new(&self.system);
        Object { schema_version: SCHEMA_VERSION, system, losses: &self.losses }
            .serialize(serializer)
    }
}
