//! Both solvers on every case of the registry: the disagreement is stored first and judged
//! afterwards.

use std::fmt::Write as _;

use model::cases::Case;
use model::{Equilibrium, Problem, Rung};
use rayon::prelude::*;
use serde::Serialize;

use crate::compare::{Agreement, compare};
use crate::tolerances::Tolerances;
use crate::units::Units;

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
    /// Difference in the unit of its budget (total length, force, weight times length).
    pub difference: f64,
}

/// What became of one case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaseResult {
    /// Name of the case.
    pub case: String,
    /// What it is.
    pub about: String,
    /// Number of bars.
    pub bars: usize,
    /// Differences and verdict; nothing if a solver gave no answer.
    pub agreement: Option<Agreement>,
    /// The largest differences in the units of their budgets: joints (beyond the rounding of their
    /// coordinates), forces, energy, statics.
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
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.agreement.as_ref().is_some_and(Agreement::agrees)
    }
}

/// Both answers to one problem, judged; of `lagrange` by the paper's equations.
///
/// # Errors
///
/// The message of the solver that gave no answer.
pub fn both(
    problem: &Problem,
    tolerances: &Tolerances,
) -> Result<([Equilibrium; 2], Agreement), String> {
    let lagrange = lagrange::solve(problem, &lagrange::Settings::default());
    let energy = energy::minimise(problem, &energy::Settings::default());
    let mut answers = [
        lagrange.map_err(|error| format!("lagrange: {error}"))?.equilibrium,
        energy.map_err(|error| format!("energy: {error}"))?.equilibrium,
    ];
    let agreement = compare(problem, &mut answers, tolerances);
    Ok((answers, agreement))
}

/// Both solvers on the given cases, in parallel; the order of the results is that of the cases.
#[must_use]
pub fn table(cases: &[Case], tolerances: &Tolerances) -> Vec<CaseResult> {
    cases.par_iter().map(|case| run(case, tolerances)).collect()
}

fn run(case: &Case, tolerances: &Tolerances) -> CaseResult {
    let problem = case.problem();
    let mut result = CaseResult {
        case: case.name.to_owned(),
        about: case.about.to_owned(),
        bars: problem.chain().bars().len(),
        agreement: None,
        scaled: None,
        rung: None,
        failure: None,
        rows: Vec::new(),
    };
    match both(&problem, tolerances) {
        Err(message) => result.failure = Some(message),
        Ok((answers, agreement)) => {
            let units = Units::new(problem.chain(), &answers[0].multipliers_n);
            let statics = agreement.statics.iter().map(crate::statics::Statics::largest);
            result.scaled = Some([
                // What the rounding of the coordinates does not explain; NaN stays NaN.
                (agreement.joints_m - units.rounding_m.min(agreement.joints_m)) / units.length_m,
                agreement.forces_n / units.force_n,
                agreement.energy_j / units.energy_j,
                statics.fold(0.0, f64::max),
            ]);
            result.rung = answers[0].evidence.rung();
            result.rows = rows(case.name, &answers, &agreement, &units);
            result.agreement = Some(agreement);
        }
    }
    result
}

/// The observables of one case, one by one.
fn rows(case: &str, answers: &[Equilibrium; 2], agreement: &Agreement, units: &Units) -> Vec<Row> {
    let [first, second] = answers;
    let mut rows = Vec::new();
    let mut row = |observable: String, lagrange: f64, energy: f64, unit: f64| {
        let difference = (lagrange - energy).abs() / unit;
        rows.push(Row { case: case.to_owned(), observable, lagrange, energy, difference });
    };
    row("energy_j".to_owned(), first.energy_j, second.energy_j, units.energy_j);
    let (sin, cos) = agreement.turned_rad.unwrap_or(0.0).sin_cos();
    let last = first.joints_m.len() - 1;
    let origin = second.joints_m[0];
    for k in (0..=last).filter(|k| last <= LISTED_BARS || *k == 0 || *k == last) {
        let [x, y, z] = std::array::from_fn(|c| second.joints_m[k][c] - origin[c]);
        let joint = [origin[0] + cos * x - sin * y, origin[1] + sin * x + cos * y, origin[2] + z];
        let [x, y, z] = second.multipliers_n[k];
        let force = [cos * x - sin * y, sin * x + cos * y, z];
        for (c, axis) in ["x", "y", "z"].into_iter().enumerate() {
            // The end joints are the anchors, whoever computes.
            if k != 0 && k != last {
                row(format!("joint[{k}].{axis}_m"), first.joints_m[k][c], joint[c], units.length_m);
            }
            row(format!("force[{k}].{axis}_n"), first.multipliers_n[k][c], force[c], units.force_n);
        }
    }
    for (k, (ours, theirs)) in
        first.axial_n.iter().zip(&second.axial_n).enumerate().take(LISTED_BARS)
    {
        row(format!("axial[{}]_n", k + 1), *ours, *theirs, units.force_n);
    }
    rows
}

/// All rows as CSV.
#[must_use]
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
