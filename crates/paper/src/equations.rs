//! Every numbered equation of the paper, evaluated as it is printed and as it should be.
//!
//! [`audit`] types the equations in once more and measures each against something that does not
//! come from the same line of print: a product of matrices, a configuration that is closed by
//! construction, a numeric derivative, Newton's law, or the equilibrium of lowest energy. Where the
//! fault is in the notation (a bracket that is missing, a number used twice, a citation that leads
//! nowhere) the number is a count. No verdict is written down: each follows from the two numbers of
//! its row. What is no error of the argument but of the print, or of the copy of it that was typed
//! in, is told apart as a fault of form ([`Fault`]).
//!
//! | module | section of the paper | equations |
//! |---|---|---|
//! | `rotations` | III | (1)-(5) |
//! | `constraints` | III, IV | (6)-(22) |
//! | `inertia` | V | (23)-(32) |
//! | `motion` | VI | (33)-(39) |
//! | `equilibrium` | abstract, VII | (40), (41), what is counted and cited |
//! | `minimum` | VIII, solution 1 | (i)-(x) |
//! | `multipliers` | VIII, solution 2 | (xi)-(xxvi) |
//!
//! # References
//!
//! Paper, eqs. (1)-(41) and (i)-(xxvi).

mod constraints;
mod equilibrium;
mod inertia;
mod minimum;
mod motion;
mod multipliers;
mod rotations;
mod sample;
pub(crate) use sample::largest;

use serde::Serialize;

/// Largest residual of an identity of sines and cosines that is only rounded.
///
/// Entries are of order 1 to 10 (lengths up to 1.5 l, moments of inertia up to 2), a dozen
/// operations each; measured worst of 1000 states: below 1e-14.
pub const ROUNDING: f64 = 1e-12;

/// Largest residual of an identity that is held against a numeric derivative.
///
/// The stencils (see `sample`) leave some 1e-11 of truncation and as much of rounding.
pub const NUMERIC: f64 = 1e-9;

/// Largest residual at an equilibrium that a solver handed over, in mg or l.
///
/// The solvers converge to about 1e-12 of these units.
pub const SOLVED: f64 = 1e-9;

/// What the numbers say of an equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Validity {
    /// It holds as printed.
    Holds,
    /// It fails as printed and holds as corrected.
    Corrected,
    /// It fails as printed, and no correction of the print would save it.
    Refuted,
    /// It names something; there is nothing to fail.
    Definition,
    /// It holds as printed; the number is worth knowing and no fault.
    Remark,
}

/// What kind of fault a failing row shows, from the lightest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// Layout and notation: brackets, line breaks, dots, rows and numbers lost or out of place. "As
    /// printed" is what the copy at hand has, whose formulas are scrambled in places; such a fault
    /// may be the copy's.
    Form,
    /// Right to the step of the paper's scan, and not to all digits printed.
    Digits,
    /// The formula or the statement is wrong, however it is laid out.
    Substance,
}

/// One equation, or one statement of the text, and the numbers that judge it.
///
/// An equation of several parts with different fates has several rows of the same number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EquationAudit {
    /// Number in the paper, `(5)` or `(xxiv)`; for a statement of the text, where it stands.
    pub number: &'static str,
    /// Section of the paper.
    pub section: &'static str,
    /// What the equation says, or what is wrong with it.
    pub what: &'static str,
    /// What the two residuals measure, with the unit.
    pub measure: &'static str,
    /// Whether the residuals count something; otherwise 0 means rounding.
    pub counts: bool,
    /// Residual of the equation as printed; for a definition what [`measure`](Self::measure) says
    /// of what it defines.
    pub as_printed: f64,
    /// Residual of the corrected equation.
    pub as_corrected: Option<f64>,
    /// The corrected form; empty if there is nothing to correct.
    pub corrected: &'static str,
    /// The judgement.
    pub verdict: Validity,
    /// What kind of fault it is, if the row fails as printed.
    pub fault: Option<Fault>,
}

/// A row of which nothing is measured yet.
fn says(number: &'static str, section: &'static str, what: &'static str) -> EquationAudit {
    EquationAudit {
        number,
        section,
        what,
        measure: "nothing measured",
        counts: false,
        as_printed: 0.0,
        as_corrected: None,
        corrected: "",
        verdict: Validity::Definition,
        fault: None,
    }
}

impl EquationAudit {
    /// The residual as printed: it holds within the tolerance (a NaN does not) or is refuted.
    fn measured(mut self, measure: &'static str, as_printed: f64, tolerance: f64) -> Self {
        self.measure = measure;
        self.as_printed = as_printed;
        (self.verdict, self.fault) = if as_printed.abs() <= tolerance {
            (Validity::Holds, None)
        } else {
            (Validity::Refuted, Some(Fault::Substance))
        };
        self
    }

    /// A count that has to be 0, as [`measured`](Self::measured) without rounding.
    fn counted(self, measure: &'static str, as_printed: f64) -> Self {
        Self { counts: true, ..self.measured(measure, as_printed, ROUNDING) }
    }

    /// A definition that the program uses as it is printed, to the number just measured.
    fn definition(mut self) -> Self {
        if self.verdict == Validity::Holds {
            self.verdict = Validity::Definition;
        }
        self
    }

    /// If it fails, it fails so.
    fn fault(mut self, fault: Fault) -> Self {
        self.fault = self.fault.map(|_| fault);
        self
    }

    /// A number that is worth knowing and no fault of the print. A NaN stays refuted.
    fn remark(mut self) -> Self {
        if self.as_printed.is_finite() {
            (self.verdict, self.fault) = (Validity::Remark, None);
        }
        self
    }

    /// Whether it judges an equation with a number, not a statement of the text between them.
    pub fn is_numbered(&self) -> bool {
        self.number.starts_with('(') && self.number.matches('(').count() == 1
    }

    /// The residual of the corrected form. What holds as printed keeps its verdict.
    fn corrected(mut self, corrected: &'static str, as_corrected: f64, tolerance: f64) -> Self {
        self = self.replaced(corrected, as_corrected);
        if self.verdict == Validity::Refuted && as_corrected.abs() <= tolerance {
            self.verdict = Validity::Corrected;
        }
        self
    }

    /// The residual of what is true instead, which is no correction of the print.
    fn replaced(mut self, truth: &'static str, its_residual: f64) -> Self {
        self.corrected = truth;
        self.as_corrected = Some(its_residual);
        self
    }
}

/// The numbered equations that fail as printed, each by its gravest fault.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FaultyEquations {
    /// Numbered equations of the paper.
    pub numbered: usize,
    /// Wrong in substance.
    pub substance: Vec<&'static str>,
    /// Right to the step of the scan, and not to all digits printed.
    pub digits: Vec<&'static str>,
    /// Wrong in form alone.
    pub form: Vec<&'static str>,
}

impl FaultyEquations {
    /// Sort the numbered equations of an audit.
    pub fn of(audit: &[EquationAudit]) -> Self {
        let mut numbers: Vec<&str> =
            audit.iter().filter(|row| row.is_numbered()).map(|row| row.number).collect();
        numbers.dedup();
        let gravest = |number| {
            audit.iter().filter(|row| row.number == number).filter_map(|row| row.fault).max()
        };
        let with = |fault| {
            let equations = numbers.iter().copied();
            equations.filter(|number| gravest(*number) == Some(fault)).collect()
        };
        Self {
            numbered: numbers.len(),
            substance: with(Fault::Substance),
            digits: with(Fault::Digits),
            form: with(Fault::Form),
        }
    }
}

/// The equilibrium of lowest energy of the paper's example, from a solver.
///
/// Angles from the descending vertical in rad. In the coordinates of section VIII they are
/// $\varphi_1, \varphi_2, \varphi_3$, with $\psi_i = 0$ and $\theta_i = \pi/2$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct E1State {
    /// Angle of bar OA, rad.
    pub theta: f64,
    /// Angle of bar AB, rad.
    pub alpha: f64,
    /// Angle of bar BD, rad.
    pub beta: f64,
    /// $\lambda_1 \dots \lambda_{12}$ in mg, three at each of O, A, B, D.
    pub multipliers_mg: [[f64; 3]; 4],
}

impl E1State {
    /// The three angles in the order of the bars.
    fn angles(&self) -> [f64; 3] {
        [self.theta, self.alpha, self.beta]
    }

    /// The multiplier of the paper's number 1..=12.
    fn lambda(&self, number: usize) -> f64 {
        self.multipliers_mg[(number - 1) / 3][(number - 1) % 3]
    }
}

/// Audit every numbered equation of the paper, in the paper's order.
///
/// Random states come from a fixed seed, so that two audits of the same `e1` agree to the last bit.
pub fn audit(e1: &E1State) -> Vec<EquationAudit> {
    let mut rows = equilibrium::counted();
    rows.extend(rotations::rows());
    rows.extend(constraints::rows());
    rows.extend(inertia::rows());
    rows.extend(motion::rows());
    let ending = equilibrium::rows(e1);
    let [before, after] = equilibrium::citations(last_number(rows.iter().chain(&ending)));
    rows.push(before);
    rows.extend(ending);
    rows.push(after);
    rows.extend(minimum::rows(e1));
    rows.extend(multipliers::rows(e1));
    rows
}

/// The largest arabic number of an equation: a citation beyond it leads nowhere.
fn last_number<'a>(rows: impl Iterator<Item = &'a EquationAudit>) -> u32 {
    rows.filter_map(|row| row.number.strip_prefix('(')?.strip_suffix(')')?.parse().ok())
        .max()
        .unwrap_or(0)
}
