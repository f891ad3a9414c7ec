//! Answers from elsewhere, judged.

mod object;
mod page;
mod subject;

use std::sync::Arc;

use ::formats::answer::{Answer, Forces, Joints};
use model::system::System;
use validate::foreign::bounds::TOLERANCE;
use validate::foreign::{ForcesJudged, judge_foreign};

pub use ::formats::answer::parse;
pub use validate::foreign::{Finding, ForeignAnswer, GivenError, Judgement, Law, Violation};

pub use self::subject::{Ruling, Subject};
use crate::error::Error;
use crate::picture::Seen;
use crate::problem::Problem;
use crate::threads;
use crate::weakest::Weakest;

/// Judges joint positions, and member forces if there are some, from any program or publication:
/// what is broken, how large the error is, and how far the answer is proved.
///
/// ```
/// use funicular::prelude::*;
/// use funicular::judge::ForeignAnswer;
/// // A lamp of 2 kg on two cables of 5 m between anchors 6 m apart, read off a drawing to a
/// // millimetre.
/// let cord = Bar::homogeneous(5.0, 0.0)?;
/// let system = System::builder("a lamp")
///     .gravity_m_s2(10.0)
///     .joint(Joint::anchor("A", [-3.0, 0.0, 0.0]))
///     .joint(Joint::anchor("B", [3.0, 0.0, 0.0]))
///     .joint(Joint::free("lamp").with_mass(2.0))
///     .cable("A", "lamp", cord)
///     .cable("lamp", "B", cord)
///     .build()?;
/// let drawn = [("A", [-3.0, 0.0, 0.0]), ("B", [3.0, 0.0, 0.0]), ("lamp", [0.0, 0.0, -4.001])];
/// let drawn = drawn.map(|(name, place)| (name.to_owned(), place));
/// let answer = ForeignAnswer::by_name(&system, "a drawing", drawn)?;
/// // Wrong to six digits: both cables are 0.8 mm too long; right to a millimetre in three metres.
/// let problem = Problem::from(system);
/// let judged = Judge::new().run(&problem, &answer)?;
/// assert!(judged.judgement().is_refuted());
/// assert!((judged.judgement().violations[0].value - 0.0008).abs() < 1e-6);
/// assert!(Judge::new().tolerance(1e-3).run(&problem, &answer)?.judgement().is_confirmed());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judge {
    tolerance: f64,
    threads: usize,
}

impl Default for Judge {
    fn default() -> Self {
        Self { tolerance: TOLERANCE, threads: 0 }
    }
}

/// An answer with its judgement; what it serialises to names joints and members.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    system: Arc<System>,
    judgement: Judgement,
}

impl Judge {
    /// Answers that are taken to know six digits.
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// How well answers are taken to know their numbers: positions in units of the size of the
        /// system, forces of the largest one. From 1e-13 to 0.1.
        tolerance: f64,
        /// How many threads the solvers may use, 0 (the default) for those of the pool that it is
        /// called from.
        threads: usize,
    }

    /// Judge an answer.
    ///
    /// # Errors
    /// [`Error::Tolerance`] when the tolerance is out of range.
    pub fn run(&self, problem: &Problem, answer: &ForeignAnswer) -> Result<Judged, Error> {
        self.run_watched(problem, answer, &|_| {})
    }

    /// The same, with `watch` told what is being done.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        answer: &ForeignAnswer,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<Judged, Error> {
        threads::on(self.threads, || {
            let system = problem.system();
            let judgement = judge_foreign(&system, answer, self.tolerance, watch)?;
            Ok(Judged { system, judgement })
        })?
    }
}

impl Judged {
    /// What was judged against.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The judgement.
    pub fn judgement(&self) -> &Judgement {
        &self.judgement
    }

    /// The member that is nearest to breaking under the forces that were judged, and of an answer without forces under
    /// those of the nearest equilibrium if these are worse: within the tolerance of the places a stiff member may bear
    /// far more than what balances best. `None` where no member has a strength.
    pub fn weakest(&self) -> Option<Weakest> {
        let Judgement { answer, forces, .. } = &self.judgement;
        let nearest = self.judgement.nearest().filter(|_| *forces != ForcesJudged::Given);
        let found = std::iter::once(answer).chain(nearest.map(|nearest| &nearest.equilibrium));
        let weakest = found.filter_map(|found| Weakest::of(&self.system, found));
        weakest.max_by(|a, b| a.demand().total_cmp(&b.demand()))
    }

    /// Whether all members are as strong as wanted under these forces; no value where none has a strength.
    pub fn is_strong(&self) -> Option<bool> {
        self.weakest().map(|weakest| weakest.suffices())
    }

    /// The judgement as a page that needs nothing else: the verdict, what is broken, a picture.
    /// `notes` are sentences about how the system was read; the picture is seen from `seen`.
    pub fn html(&self, notes: &[String], seen: Seen) -> String {
        page::html(self, notes, seen)
    }
}

/// Fit an answer of a file to the joints and members of a system.
///
/// # Errors
/// [`GivenError`]: names or counts that do not fit.
///
/// ```
/// use funicular::Problem;
/// let system = Problem::case("three-equal-bars")?.system();
/// let answer = funicular::judge::parse("joint,x_m,y_m,z_m\n0,0,0,0\n1,0,0,-1\n", "table.csv")?;
/// let error = funicular::judge::fit(&system, answer[0].clone()).unwrap_err();
/// assert_eq!(error.to_string(), "the answer has no place for joint \"2\"");
/// # Ok::<(), funicular::Error>(())
/// ```
pub fn fit(system: &System, answer: Answer) -> Result<ForeignAnswer, GivenError> {
    let Answer { source, joints, forces, reactions_n } = answer;
    let fitted = match joints {
        Joints::Named(places) => ForeignAnswer::by_name(system, source, places)?,
        Joints::InOrder(places) => ForeignAnswer::in_order(system, source, places, None)?,
    };
    let fitted = match forces {
        Forces::None => fitted,
        Forces::Named(forces) => fitted.with_forces(system, forces)?,
        Forces::InOrder(forces) => {
            let ForeignAnswer { source, joints_m, .. } = fitted;
            ForeignAnswer::in_order(system, source.as_str().to_owned(), joints_m, Some(forces))?
        }
        Forces::Numbered(members) => numbered(system, fitted, &members)?,
    };
    match reactions_n {
        None => Ok(fitted),
        Some(reactions) => fitted.with_reactions(system, reactions),
    }
}

/// Members by the numbers of their joints, all with forces or none: every one of them must be in
/// the system.
fn numbered(
    system: &System,
    answer: ForeignAnswer,
    members: &[(usize, usize, Option<f64>)],
) -> Result<ForeignAnswer, GivenError> {
    let joints = system.joints();
    let name =
        |k: usize| joints.get(k).map_or_else(|| format!("number {k}"), |j| j.name.to_string());
    let with_forces = members.iter().all(|(_, _, force)| force.is_some());
    let named = members.iter().map(|(a, b, force)| (name(*a), name(*b), force.unwrap_or_default()));
    // Without forces the fit is made all the same, to see that the lines are the members.
    let checked = answer.clone().with_forces(system, named)?;
    Ok(if with_forces { checked } else { answer })
}
