//! The five rungs together.

use std::fmt::Display;

use serde::{Serialize, Serializer};

use super::agreed::Agreed;
use super::certificate::Optimal;
use super::complete::Complete;
use super::convergence::Convergence;
use super::reason::Reason;
use super::rung::Rung;
use super::status::Status;
use super::verified::Verified;

/// What is known about each rung. A rung may be reached without those below it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ladder {
    /// A solver's own residual is below its tolerance.
    pub converged: Status<Convergence>,
    /// Solvers agree, and the statics judge finds every bar in balance.
    pub agreed: Status<Agreed>,
    /// Interval arithmetic proves that exactly one equilibrium lies in a stated box.
    pub verified: Status<Verified>,
    /// A census proves that there is no other equilibrium outside the listed boxes.
    pub complete: Status<Complete>,
    /// A certificate proves that no configuration has less energy.
    pub optimal: Status<Optimal>,
}

/// One rung in a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Statement {
    /// The rung.
    pub rung: Rung,
    /// Whether it was reached.
    pub reached: bool,
    /// How it was reached, or why not.
    pub how: String,
}

impl Ladder {
    /// Whether a rung was reached.
    pub fn is_reached(&self, rung: Rung) -> bool {
        self.reason(rung).is_none()
    }

    /// Why a rung was not reached; nothing if it was.
    pub fn reason(&self, rung: Rung) -> Option<&Reason> {
        match rung {
            Rung::Converged => self.converged.reason(),
            Rung::Agreed => self.agreed.reason(),
            Rung::Verified => self.verified.reason(),
            Rung::Complete => self.complete.reason(),
            Rung::Optimal => self.optimal.reason(),
        }
    }

    /// How a rung was reached, or why not: a sentence once it is formatted. The alternate form,
    /// `{:#}`, tells what is only rounding as a bound.
    pub fn status(&self, rung: Rung) -> &dyn Display {
        match rung {
            Rung::Converged => &self.converged,
            Rung::Agreed => &self.agreed,
            Rung::Verified => &self.verified,
            Rung::Complete => &self.complete,
            Rung::Optimal => &self.optimal,
        }
    }

    /// How a rung was reached, or why not, in a sentence.
    pub fn how(&self, rung: Rung) -> String {
        self.status(rung).to_string()
    }

    /// The highest rung reached, if any is.
    pub fn highest(&self) -> Option<Rung> {
        Rung::ALL.into_iter().rev().find(|rung| self.is_reached(*rung))
    }

    /// Take back what was reached above `converged`: a complete census proves that the answer is at
    /// this distance of every equilibrium, in units of the total length.
    pub fn refute(&mut self, distance: f64) {
        let reason = || Reason::RefutedByCensus { distance };
        self.agreed = Status::Open(reason());
        self.verified = Status::Open(reason());
        self.complete = Status::Open(reason());
        self.optimal = Status::Open(reason());
    }

    /// Whether a check that was made of this answer has failed: solvers disagree, the judge refuses
    /// it, or a census refutes it. That something was not tried or not decided is no failure.
    pub fn failed(&self) -> bool {
        Rung::ALL.into_iter().any(|rung| {
            matches!(
                self.reason(rung),
                Some(
                    Reason::SolversDisagree(_)
                        | Reason::JudgeRefuses { .. }
                        | Reason::RefutedByCensus { .. }
                )
            )
        })
    }

    /// One statement for each rung, lowest first.
    ///
    /// ```
    /// let evidence = model::Evidence::new("residual of (40)", 1e-15, 1e-12, 7);
    /// let reached = evidence.ladder.statements().map(|statement| statement.reached);
    /// assert_eq!(reached, [true, false, false, false, false]);
    /// ```
    pub fn statements(&self) -> [Statement; 5] {
        Rung::ALL.map(|rung| Statement {
            rung,
            reached: self.is_reached(rung),
            how: self.how(rung),
        })
    }

    /// How the solver ended, converged or not; nothing if that is not known.
    pub fn convergence(&self) -> Option<&Convergence> {
        match &self.converged {
            Status::Reached(convergence) | Status::Open(Reason::AboveTolerance(convergence)) => {
                Some(convergence)
            }
            Status::Open(_) => None,
        }
    }

    pub(super) fn convergence_mut(&mut self) -> Option<&mut Convergence> {
        match &mut self.converged {
            Status::Reached(convergence) | Status::Open(Reason::AboveTolerance(convergence)) => {
                Some(convergence)
            }
            Status::Open(_) => None,
        }
    }
}

/// A rung in JSON: the words, and the numbers beside them.
#[derive(Serialize)]
#[serde(tag = "rung", rename_all = "lowercase")]
enum Entry<'a> {
    Converged(Line<'a, Convergence>),
    Agreed(Line<'a, Agreed>),
    Verified(Line<'a, Verified>),
    Complete(Line<'a, Complete>),
    Optimal(Line<'a, Optimal>),
}

#[derive(Serialize)]
struct Line<'a, P> {
    reached: bool,
    how: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<&'a P>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a Reason>,
}

impl<'a, P: Display> Line<'a, P> {
    fn of(status: &'a Status<P>) -> Self {
        Self {
            reached: status.is_reached(),
            how: status.to_string(),
            proof: status.proof(),
            reason: status.reason(),
        }
    }
}

impl Serialize for Ladder {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq([
            Entry::Converged(Line::of(&self.converged)),
            Entry::Agreed(Line::of(&self.agreed)),
            Entry::Verified(Line::of(&self.verified)),
            Entry::Complete(Line::of(&self.complete)),
            Entry::Optimal(Line::of(&self.optimal)),
        ])
    }
}
