//! A published number with its source, what is computed here, and the verdict that follows.

use std::fmt::{self, Display, Formatter};

use model::{Rung, SolverName};
use serde::Serialize;

/// What a published number is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FieldVerdict {
    /// It is what is computed here, to the tolerance of its source.
    Confirmed,
    /// It is off by more than that, and the right number stands beside it.
    Corrected,
    /// It breaks a law that can be checked by hand.
    Refuted,
    /// It was not judged.
    NotJudged,
}

impl Display for FieldVerdict {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Confirmed => "confirmed",
            Self::Corrected => "corrected",
            Self::Refuted => "refuted",
            Self::NotJudged => "not judged",
        })
    }
}

/// A number as published and as computed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// What it is, with its unit.
    pub what: String,
    /// As published.
    pub printed: String,
    /// Its value.
    pub published: f64,
    /// As computed here.
    pub ours: f64,
    /// How far apart they may be: the tolerance that the source states, or half a unit of its last
    /// digit.
    pub allowed: f64,
    /// Whether the source only says that the number is no larger than this.
    pub at_most: bool,
    /// Significant digits of our number that do not hang on the rounding of a processor.
    pub digits: usize,
}

impl Compared {
    /// A number as printed, which may be off by this part of it, or by half of its last digit.
    pub(super) fn new(what: &str, printed: &str, ours: f64, tolerance: Option<f64>) -> Self {
        let published: f64 = printed.parse().unwrap_or(f64::NAN);
        let part = tolerance.map(|tolerance| tolerance * published.abs());
        Self {
            what: what.to_owned(),
            printed: printed.to_owned(),
            published,
            ours,
            allowed: part.unwrap_or_else(|| half_digit(printed)),
            at_most: false,
            // The force of a nearly taut line loses seven of the sixteen digits of its length.
            digits: 8,
        }
    }

    /// Whether the published number stands. NaN never does.
    pub fn stands(&self) -> bool {
        if self.at_most {
            self.ours <= self.published
        } else {
            (self.published - self.ours).abs() <= self.allowed
        }
    }
}

/// A half of the last digit of a number as printed.
fn half_digit(printed: &str) -> f64 {
    let (digits, exponent) = printed.split_once(['e', 'E']).unwrap_or((printed, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let exponent = exponent.parse().unwrap_or(0) - i32::try_from(decimals).unwrap_or(0);
    0.5 * 10.0_f64.powi(exponent)
}

/// A law that published numbers must keep whatever the rest, for anyone to check.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HandCheck {
    /// The law, in words.
    pub law: &'static str,
    /// By how much the published numbers break it, N.
    pub broken_n: f64,
    /// What their digits explain, N.
    pub allowed_n: f64,
}

/// What both solvers make of a published system.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum BothSolvers {
    /// A cable as a run of elastic members.
    Run {
        /// How many.
        members: usize,
        /// Largest difference of an end force from the closed form, in units of the largest of
        /// them; nothing where the solver has no answer.
        off: Vec<(SolverName, Option<f64>)>,
    },
    /// The published positions judged as an answer from elsewhere.
    Judged {
        /// The finding in a word.
        finding: &'static str,
        /// Distance of the nearest equilibrium, m.
        joints_m: f64,
        /// The highest rung of the answer.
        rung: Option<Rung>,
    },
    /// The least energy of a chain.
    Least {
        /// How far apart the solvers are, J.
        apart_j: f64,
        /// How much less than theirs the published energy is, J.
        below_j: f64,
    },
}

/// One entry of the record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Entry {
    /// What was computed: the system in a few words.
    pub title: String,
    /// Where it is published.
    pub source: &'static str,
    /// The numbers.
    pub numbers: Vec<Compared>,
    /// The check by hand, if there is one.
    pub by_hand: Option<HandCheck>,
    /// What both solvers make of the system.
    pub solvers: Option<BothSolvers>,
    /// Why it was not judged.
    pub not_judged: Option<&'static str>,
}

impl Entry {
    /// An entry that is not judged, with its reason.
    pub fn not_judged(
        title: impl Into<String>,
        source: &'static str,
        because: &'static str,
    ) -> Self {
        Self {
            title: title.into(),
            source,
            numbers: vec![],
            by_hand: None,
            solvers: None,
            not_judged: Some(because),
        }
    }

    /// The verdict, from the numbers alone.
    pub fn verdict(&self) -> FieldVerdict {
        // NaN breaks the law.
        let broken =
            |check: &HandCheck| check.broken_n.is_nan() || check.broken_n > check.allowed_n;
        if self.not_judged.is_some() || self.numbers.is_empty() {
            FieldVerdict::NotJudged
        } else if self.by_hand.as_ref().is_some_and(broken) {
            FieldVerdict::Refuted
        } else if self.numbers.iter().all(Compared::stands) {
            FieldVerdict::Confirmed
        } else {
            FieldVerdict::Corrected
        }
    }
}
