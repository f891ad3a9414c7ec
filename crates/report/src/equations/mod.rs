//! The numbered equations of the paper, typeset: as printed, as corrected, and what they say.
//!
//! Two macros mark the difference: `\wrong{...}` around what is printed wrong, `\fixed{...}` around
//! what belongs there; `\range{1,3}` is the paper's overline for i = 1, 2, 3. The verdict and the
//! numbers behind it are no part of this table: they come from [`paper::equations`], evaluated at
//! run time.
//!
//! | module | section of the paper | equations |
//! |---|---|---|
//! | `rotations` | III | (1)-(5) |
//! | `constraints` | III, IV | (6)-(22) |
//! | `inertia` | V | (23)-(32) |
//! | `motion` | VI, VII | (33)-(41) |
//! | `minimum` | VIII, solution 1 | (i)-(x) |
//! | `multipliers` | VIII, solution 2 | (xi)-(xxvi) |

/// The equations of a section: number, what it says, what is printed in LaTeX, and if it differs what belongs there.
macro_rules! equations {
    ($($number:literal $says:literal $printed:literal $(=> $corrected:literal)?;)*) => {
        pub(super) const EQUATIONS: &[super::Equation] =
            &[$(super::Equation::new($number, $printed, &[$($corrected)?], $says)),*];
    };
}

mod constraints;
mod inertia;
mod minimum;
mod motion;
mod multipliers;
mod rotations;

use paper::equations::{EquationAudit, Fault, Validity};

use crate::badge::Badge;

/// One numbered equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Equation {
    /// Its number in the paper, `(5)` or `(xxiv)`.
    pub number: &'static str,
    /// LaTeX of what is printed.
    pub printed: &'static str,
    /// LaTeX of the correction, or of what is true instead.
    pub corrected: Option<&'static str>,
    /// What it says, in a line or two.
    pub says: &'static str,
}

impl Equation {
    const fn new(
        number: &'static str,
        printed: &'static str,
        corrected: &[&'static str],
        says: &'static str,
    ) -> Self {
        let corrected = if let [corrected] = corrected { Some(*corrected) } else { None };
        Self { number, printed, corrected, says }
    }
}

/// All numbered equations, in the order of the paper: (1)-(41), (i)-(xxvi).
pub fn all() -> impl Iterator<Item = &'static Equation> {
    [
        rotations::EQUATIONS,
        constraints::EQUATIONS,
        inertia::EQUATIONS,
        motion::EQUATIONS,
        minimum::EQUATIONS,
        multipliers::EQUATIONS,
    ]
    .into_iter()
    .flatten()
}

/// An equation with the rows of the audit that judge it.
#[derive(Debug, Clone)]
pub struct Judged<'a> {
    /// The equation.
    pub equation: &'static Equation,
    /// Section of the paper.
    pub section: &'a str,
    /// The rows of the audit, at least one.
    pub rows: Vec<&'a EquationAudit>,
    /// The severest of their verdicts.
    pub verdict: Validity,
    /// The gravest of their faults.
    pub fault: Option<Fault>,
}

impl Judged<'_> {
    /// The verdict for the eye.
    pub fn badge(&self) -> Badge {
        Badge::of_equation(self.verdict, self.fault)
    }

    /// What the second form of the equation is.
    pub fn instead(&self) -> &'static str {
        if self.verdict == Validity::Refuted { "What is true instead" } else { "As corrected" }
    }
}

/// All equations with their rows, in the order of the paper.
pub fn judged(audit: &[EquationAudit]) -> Vec<Judged<'_>> {
    all()
        .map(|equation| {
            let rows: Vec<_> = audit.iter().filter(|row| row.number == equation.number).collect();
            Judged {
                equation,
                section: rows.first().map_or("", |row| row.section),
                verdict: severest(&rows),
                fault: rows.iter().filter_map(|row| row.fault).max(),
                rows,
            }
        })
        .collect()
}

/// The rows of the audit that judge no numbered equation but a statement of the text between them.
pub fn statements(audit: &[EquationAudit]) -> impl Iterator<Item = &EquationAudit> {
    audit.iter().filter(|row| all().all(|equation| equation.number != row.number))
}

/// Refuted before corrected before holding; a remark or a definition only if nothing else is said.
fn severest(rows: &[&EquationAudit]) -> Validity {
    let any = |verdict| rows.iter().any(|row| row.verdict == verdict);
    [Validity::Refuted, Validity::Corrected, Validity::Holds]
        .into_iter()
        .find(|&verdict| any(verdict))
        .unwrap_or(Validity::Definition)
}
