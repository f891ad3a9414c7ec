//! The paper's claims, each judged by numbers worked out at run time.
//!
//! What is printed comes from `validation/paper.toml`; what is true comes from the two solvers; the
//! verdict follows from both, and has to be the one that the file expects.
//!
//! | module | claims |
//! |---|---|
//! | `counts` | how many equations, unknowns, freedoms |
//! | `scan` | section VIII, Solution 1: the search and the position (ix) |
//! | `second` | the position (x), which is no equilibrium, and E2, which is one |
//! | `plane` | section VIII, Solution 2: multipliers and reactions |
//! | `space` | conclusions: turns, infinities, initial conditions |

mod counts;
mod multiplier_system;
mod plane;
mod scan;
mod second;
mod space;

use serde::Serialize;

use crate::completeness::Completeness;
use crate::equations::largest;
use crate::example::Example;
pub use crate::printed::Assessment;
use crate::printed::{Paper, Printed};
use crate::seeds::Survey;
use crate::sentence::Sentence;
pub use multiplier_system::{Misfit, misfit};

/// Both solvers' angles agree with each other and with the reference digits to this, rad: the
/// accuracy that the reproduction has set itself. Measured: 3e-16.
pub const ANGLE_RAD: f64 = 1e-10;
/// The same for the energy, mgl. Measured: 9e-16.
pub const ENERGY_MGL: f64 = 1e-12;
/// The same for joint forces, mg, the difference quotients of the least energy included. Measured:
/// 4e-13.
pub const FORCE_MG: f64 = 1e-10;

/// A claim of the paper, judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// The claim as printed: `id`, `says`, `where`, `printed`, `unit`, `digits`, `expected`.
    #[serde(flatten)]
    pub printed: Printed,
    /// What `lagrange` finds, in the unit of the claim.
    pub lagrange: Option<f64>,
    /// What `energy` finds, in the unit of the claim.
    pub energy: Option<f64>,
    /// The verdict that the numbers support.
    pub verdict: Assessment,
    /// The number behind the verdict.
    pub number: Option<f64>,
    /// What that number is.
    pub number_is: Sentence,
    /// Whether the verdict is the expected one.
    pub as_expected: bool,
}

/// What a judge of one claim says.
#[derive(Debug, Clone, PartialEq)]
struct Finding {
    lagrange: Option<f64>,
    energy: Option<f64>,
    verdict: Assessment,
    number: f64,
    number_is: Sentence,
}

impl Finding {
    /// A finding with the number behind it.
    fn new(verdict: Assessment, number: f64, number_is: impl Into<Sentence>) -> Self {
        Self { lagrange: None, energy: None, verdict, number, number_is: number_is.into() }
    }

    fn lagrange(self, value: f64) -> Self {
        Self { lagrange: Some(value), ..self }
    }

    fn energy(self, value: f64) -> Self {
        Self { energy: Some(value), ..self }
    }
}

/// What the judges know.
struct Facts<'a> {
    paper: &'a Paper,
    example: &'a Example,
    surveys: &'a [Survey],
    completeness: Completeness,
}

/// Judge every claim of the paper.
pub fn claims(paper: &Paper, example: &Example, surveys: &[Survey]) -> Vec<Claim> {
    let completeness = Completeness::new(paper, example);
    let facts = Facts { paper, example, surveys, completeness };
    paper
        .claims
        .iter()
        .map(|printed| {
            let judges = [counts::judge, scan::judge, second::judge, plane::judge, space::judge];
            let finding = judges.iter().find_map(|judge| judge(&facts, printed));
            let finding = finding.unwrap_or_else(|| {
                Finding::new(Assessment::Undecided, f64::NAN, "nobody judges this claim")
            });
            Claim::new(printed.clone(), finding)
        })
        .collect()
}

impl Claim {
    fn new(printed: Printed, finding: Finding) -> Self {
        // NaN and infinity support nothing, and have no place in a file.
        let finite = |x: &f64| x.is_finite();
        let number = Some(finding.number).filter(finite);
        let verdict = finding.verdict.if_shown(number.is_some());
        Self {
            as_expected: verdict == printed.expected,
            printed,
            lagrange: finding.lagrange.filter(finite),
            energy: finding.energy.filter(finite),
            verdict,
            number,
            number_is: finding.number_is,
        }
    }
}

/// The smallest of some sizes; NaN if one is.
fn smallest(sizes: impl IntoIterator<Item = f64>) -> f64 {
    sizes.into_iter().fold(f64::INFINITY, |least: f64, size| {
        if least.is_nan() || size.is_nan() { f64::NAN } else { least.min(size.abs()) }
    })
}

/// An angle in degrees as the paper prints it, in [0, 360).
fn printed_degrees(angle_rad: f64) -> f64 {
    angle_rad.to_degrees().rem_euclid(360.0)
}
