//! Both solvers on every case of the registry: the disagreement is stored first and judged
//! afterwards.

use std::fmt::Write as _;

use model::cases::Case;
use model::system::{Row as Bars, System, SystemEquilibrium};
use model::{Chain, Rung};
use serde::Serialize;

use crate::free::stored_rounding_m;
use crate::question::{Equations, Question, UseCensus};
use crate::systems::turn::turned_onto;
use crate::systems::{SystemAgreement, SystemStatics, ask_with};
use numerics::in_parallel;
use numerics::vector::{beyond, norm, worse};

/// Joints and joint forces are listed one by one up to this many bars; of longer chains the ends,
/// the energy and the largest differences.
const LISTED_BARS: usize = 10;

/// One observable of one case by both solvers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Name of the case.
    pub case: String,
    /// What is compared, with its unit.
    pub observable: String,
    /// Value by `lagrange`.
    pub lagrange: f64,
    /// Value by `energy`, turned onto the first where the chain turns freely.
    pub energy: f64,
    /// Difference in units of total length, largest joint force, weight times length.
    pub difference: f64,
}

/// What became of one case.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct CaseResult {
    /// Name of the case.
    pub case: String,
    /// What it is.
    pub about: String,
    /// Number of bars.
    pub bars: usize,
    /// Differences and verdict; nothing if a solver gave no answer.
    pub agreement: Option<SystemAgreement>,
    /// The largest differences in units of total length (beyond the rounding of coordinates), largest
    /// joint force, weight times length; and of the violations of statics.
    pub scaled: Option<[f64; 4]>,
    /// Highest rung of the answer.
    pub rung: Option<Rung>,
    /// What a solver said instead of an answer.
    pub failure: Option<String>,
    /// The observables one by one.
    pub rows: Vec<Row>,
}

impl CaseResult {
    /// Whether both solvers answered and agree.
    pub fn agrees(&self) -> bool {
        self.agreement.as_ref().is_some_and(SystemAgreement::agrees)
    }
}

/// Both solvers on the given cases, in parallel; the order of the results is that of the cases.
pub fn table(cases: &[Case]) -> Vec<CaseResult> {
    in_parallel(cases.len(), 1, |k| run(&cases[k]))
}

fn run(case: &Case) -> CaseResult {
    let problem = case.problem();
    let chain = problem.chain();
    let mut result = CaseResult {
        case: case.name.to_owned(),
        about: case.about.to_owned(),
        bars: chain.bars().len(),
        ..CaseResult::default()
    };
    let system = System::from(chain);
    let answer = ask_with(&system, &question(), &|_| {});
    let rows = system.as_row().and_then(|row| rows(case.name, &system, row, &answer.equilibria));
    let Some((agreement, rows)) = answer.agreement.zip(rows) else {
        let why: Vec<_> = answer.failures.iter().map(ToString::to_string).collect();
        result.failure = Some(why.join("; "));
        return result;
    };
    let units = Units::new(chain, &answer.equilibria[0]);
    result.scaled = Some([
        // What the rounding of the coordinates does not explain; NaN stays NaN.
        beyond(agreement.joints_m, stored_rounding_m(chain)) / units.length_m,
        agreement.forces_n / units.force_n,
        agreement.energy_j / units.energy_j,
        agreement.statics.iter().map(SystemStatics::largest).fold(0.0, worse),
    ]);
    result.rung = answer.equilibria[0].evidence.rung();
    result.rows = rows;
    result.agreement = Some(agreement);
    result
}

/// Both solvers, `lagrange` by the paper's equations, and no census.
fn question() -> Question {
    Question { equations: Equations::Full, census: UseCensus::Never, ..Question::default() }
}

/// Units in which differences are told.
struct Units {
    /// Total length, m.
    length_m: f64,
    /// The larger of the total weight and the largest joint force, N.
    force_n: f64,
    /// Total weight times total length, J.
    energy_j: f64,
}

impl Units {
    /// The units of a chain, with the forces of an answer.
    fn new(chain: &Chain, answer: &SystemEquilibrium) -> Self {
        let length_m = chain.total_length_m();
        let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
        let forces_n = answer.start_forces_n.iter().chain(&answer.end_forces_n);
        Self {
            length_m,
            force_n: forces_n.map(|force| norm(*force)).fold(weight_n, worse),
            energy_j: weight_n * length_m,
        }
    }
}

/// The observables of one case, one by one; without value unless there are two complete answers.
fn rows(
    case: &str,
    system: &System,
    bars: &Bars,
    answers: &[SystemEquilibrium],
) -> Option<Vec<Row>> {
    let [first, second] = answers else { return None };
    let units = Units::new(bars.problem().chain(), first);
    let (turned, _) = turned_onto(system, first, second, &vec![false; system.joints().len()]);
    let first = bars.chain_equilibrium(first)?;
    let second = bars.chain_equilibrium(&turned)?;
    let mut rows = Vec::new();
    let mut row = |observable: String, lagrange: f64, energy: f64, unit: f64| {
        let difference = (lagrange - energy).abs() / unit;
        rows.push(Row { case: case.to_owned(), observable, lagrange, energy, difference });
    };
    row("energy_j".to_owned(), first.energy_j, second.energy_j, units.energy_j);
    let last = first.joints_m.len() - 1;
    for k in (0..=last).filter(|k| last <= LISTED_BARS || *k == 0 || *k == last) {
        for (c, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let [joints, forces] = [
                [first.joints_m[k][c], second.joints_m[k][c]],
                [first.multipliers_n[k][c], second.multipliers_n[k][c]],
            ];
            // The end joints are the anchors, whoever computes.
            if k != 0 && k != last {
                row(format!("joint[{k}].{axis}_m"), joints[0], joints[1], units.length_m);
            }
            row(format!("force[{k}].{axis}_n"), forces[0], forces[1], units.force_n);
        }
    }
    for (k, (ours, theirs)) in
        first.axial_n.iter().zip(&second.axial_n).enumerate().take(LISTED_BARS)
    {
        row(format!("axial[{}]_n", k + 1), *ours, *theirs, units.force_n);
    }
    Some(rows)
}

/// All rows as CSV.
pub fn csv(results: &[CaseResult]) -> String {
    let mut text = "case,observable,lagrange,energy,difference\n".to_owned();
    for row in results.iter().flat_map(|result| &result.rows) {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{},{:e},{:e},{:.2e}",
            row.case, row.observable, row.lagrange, row.energy, row.difference
        );
    }
    text
}

#[cfg(test)]
mod tests;
