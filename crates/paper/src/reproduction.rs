//! The whole reproduction as one value: what `funicular reproduce` shows and writes.

use std::time::Instant;

use model::system::System;
use model::{Equilibrium, Ladder, NoAnswer, Rung, SolverName, Stability, cases};
use serde::Serialize;
use validate::completeness::certify_by_census;
use validate::field::entry::Entry;
use validate::field::record::field;
use validate::systems::{compare, judge_without};
use validate::table::{CaseResult, Row, table};
use validate::tolerances::Tolerances;

use crate::bounds::Bounds;
use crate::claims::{Assessment, Claim, claims};
use crate::completeness::Completeness;
use crate::equations::{E1State, EquationAudit, Fault, FaultyEquations, Validity, audit};
use crate::example::{Example, ExampleError};
use crate::figures::Figures;
use crate::printed::Paper;
use crate::seeds::{SEEDS, Survey, surveys};

/// Version of the JSON object; raised when a key that others rely on changes its meaning.
pub const SCHEMA_VERSION: u32 = 3;

/// What the paper claims, what two solvers find, and where it is wrong.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reproduction {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// The paper.
    pub paper: &'static str,
    /// The equilibria of its example.
    pub equilibria: Vec<Position>,
    /// That there are no others, and that (x) is none of them.
    pub completeness: Completeness,
    /// The energy of all its configurations, bounded without a guess.
    pub bounds: Bounds,
    /// Its claims, in its order.
    pub claims: Vec<Claim>,
    /// Its equations, in its order, as printed and as corrected.
    pub equations: Vec<EquationAudit>,
    /// Both solvers on every case of the registry.
    pub cases: Vec<CaseResult>,
    /// Both solvers from many random seeds.
    pub seeds: Vec<Survey>,
    /// What others have published of cables and nets, judged by the same means.
    pub field: Vec<Entry>,
    /// What there is to draw.
    pub figures: Figures,
    /// The same in a few numbers.
    pub summary: Summary,
    /// Whether every verdict is the expected one and every case agrees.
    pub all_as_expected: bool,
    /// Wall-clock time, s. With the times of the surveys and of single solves the only number that
    /// differs from run to run.
    pub seconds: f64,
}

/// An equilibrium of the example in the paper's numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Position {
    /// E1, E1', E2, E2'.
    pub name: &'static str,
    /// theta, alpha, beta by `lagrange`, deg, signed.
    pub lagrange_deg: [f64; 3],
    /// The same by `energy`, which finds only minima.
    pub energy_deg: Option<[f64; 3]>,
    /// V by `lagrange`, mgl.
    pub lagrange_mgl: f64,
    /// V by `energy`, mgl.
    pub energy_mgl: Option<f64>,
    /// Reactions and joint forces at O, A, B, D, mg: horizontal and vertical.
    pub forces_mg: [[f64; 2]; 4],
    /// Axial forces of OA, AB, BD, mg, tension positive.
    pub axial_mg: [f64; 3],
    /// Second-order behaviour.
    pub stability: Stability,
    /// Nullity of the Jacobian of the 30 equations.
    pub nullity: usize,
    /// How far it is proved.
    pub ladder: Ladder,
}

impl Position {
    /// The highest rung reached.
    pub fn rung(&self) -> Option<Rung> {
        self.ladder.highest()
    }
}

/// The reproduction in a few numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Claims judged.
    pub claims: usize,
    /// True as printed.
    pub confirmed: usize,
    /// Not true as printed; a number shows where it comes from.
    pub explained: usize,
    /// Wrong as printed; the corrected form holds.
    pub corrected: usize,
    /// False.
    pub refuted: usize,
    /// Without a verdict. Must be 0.
    pub undecided: usize,
    /// Names of the claims whose verdict is not the expected one. Must be empty.
    pub unexpected_claims: Vec<String>,
    /// Rows of the audit of equations.
    pub equations: usize,
    /// Rows that fail as printed and hold as corrected.
    pub equations_corrected: usize,
    /// Rows that fail as printed without a correction of the print.
    pub equations_refuted: usize,
    /// Whether exactly those equations fail that `validation/paper.toml` lists.
    pub equations_as_expected: bool,
    /// The numbered equations that fail, by the kind of fault.
    pub faulty_equations: FaultyEquations,
    /// Cases of the registry.
    pub cases: usize,
    /// Of these, both solvers agree and the statics judge passes both.
    pub cases_agreed: usize,
    /// The largest difference between the solvers, of all observables of all cases, in the unit of
    /// its budget.
    pub largest_difference: Option<Row>,
}

/// Reproduce the paper.
///
/// `progress` is told what comes next, for people's patience.
///
/// # Errors
///
/// [`ExampleError`] when a solver fails on the paper's example: there is then nothing to judge.
pub fn reproduce(progress: impl FnMut(&str)) -> Result<Reproduction, ExampleError> {
    reproduce_with(SEEDS, progress)
}

/// [`reproduce`] with another number of random seeds of each kind.
///
/// # Errors
///
/// [`ExampleError`], as [`reproduce`].
pub fn reproduce_with(
    seeds: usize,
    mut progress: impl FnMut(&str),
) -> Result<Reproduction, ExampleError> {
    let clock = Instant::now();
    let paper = Paper::project();
    progress("the paper's example by both solvers");
    let example = Example::solve()?;
    progress("all its equilibria, by the census");
    let completeness = Completeness::new(&paper, &example);
    progress("bounds on the energy of all configurations");
    let bounds = Bounds::compute(&example)?;
    progress(&format!("{seeds} random seeds of each kind, by each solver"));
    let seeds = surveys(&example, seeds);
    progress("the claims");
    let claims = claims(&paper, &example, &seeds);
    progress("the equations as printed and as corrected");
    let equations = audit(&e1_state(&example));
    progress("both solvers on every case");
    let cases = table(cases::all());
    progress("what others have published of cables and nets");
    let field = field();
    let summary = Summary::new(&paper, &claims, &equations, &cases);
    Ok(Reproduction {
        schema_version: SCHEMA_VERSION,
        paper: "Equilibrium of a System of Bars Using a Multibody Type Method",
        equilibria: positions(&example),
        all_as_expected: summary.as_expected() && bounds.are_tight() && completeness.is_closed(),
        completeness,
        bounds,
        claims,
        equations,
        cases,
        seeds,
        field,
        figures: Figures::compute(&example),
        summary,
        seconds: clock.elapsed().as_secs_f64(),
    })
}

/// E1 as the audit of the equations takes it: angles by the search for the least energy, forces by
/// virtual work.
///
/// The audit uses the matrices of `lagrange`, so that "(40) holds" is no solver's own residual.
fn e1_state(example: &Example) -> E1State {
    let e1 = example.by_energy_e1();
    let [theta, alpha, beta] = e1.angles_rad;
    E1State { theta, alpha, beta, multipliers_mg: e1.forces_mg }
}

fn positions(example: &Example) -> Vec<Position> {
    let by_energy = &example.energy;
    let energy = [
        Some((example.by_energy_e1(), &by_energy.e1)),
        Some((example.by_energy_in_plane(&by_energy.e1_mirrored), &by_energy.e1_mirrored)),
        None,
        None,
    ];
    ["E1", "E1'", "E2", "E2'"]
        .into_iter()
        .zip(example.lagrange.all())
        .zip(energy)
        .map(|((name, found), energy)| {
            let (energy, answer) = energy.unzip();
            let lagrange = example.by_lagrange(found);
            Position {
                name,
                lagrange_deg: lagrange.angles_rad.map(f64::to_degrees),
                energy_deg: energy.map(|found| found.angles_rad.map(f64::to_degrees)),
                lagrange_mgl: lagrange.v_mgl,
                energy_mgl: energy.map(|found| found.v_mgl),
                forces_mg: lagrange.forces_mg.map(|[_, y, z]| [y, z]),
                axial_mg: std::array::from_fn(|bar| {
                    found.equilibrium.axial_n[bar] / example.units.mg_n
                }),
                stability: found.equilibrium.stability,
                nullity: found.nullity,
                ladder: ladder(example, &found.equilibrium, answer),
            }
        })
        .collect()
}

/// How far an equilibrium is proved by both solvers, the statics judge, the census and the
/// certificate; without `energy` where that, looking for minima, has no answer.
fn ladder(example: &Example, found: &Equilibrium, answer: Option<&energy::Solution>) -> Ladder {
    let problem = &example.problem;
    let system = System::from(problem.chain());
    let row = system.as_row().expect("the paper's bars are in a row");
    let mut found = found.clone();
    let mut first = row.equilibrium(found.clone());
    match answer {
        Some(answer) => {
            let mut both = [first, row.equilibrium(answer.equilibrium.clone())];
            // What the comparison finds is written into the evidence of both.
            let _ = compare(&system, &mut both, &Tolerances::project());
            [first, _] = both;
        }
        None => {
            judge_without(&system, &mut first, SolverName::ENERGY, NoAnswer::MinimaOnly);
        }
    }
    found.evidence = first.evidence;
    certify_by_census(problem, &example.census, &mut found);
    found.evidence.ladder
}

impl Summary {
    fn new(
        paper: &Paper,
        claims: &[Claim],
        equations: &[EquationAudit],
        cases: &[CaseResult],
    ) -> Self {
        let with = |verdict| claims.iter().filter(|claim| claim.verdict == verdict).count();
        let numbers = |pick: &dyn Fn(&EquationAudit) -> bool| -> Vec<&str> {
            equations.iter().filter(|row| pick(row)).map(|row| row.number).collect()
        };
        let corrected = numbers(&|row| row.verdict == Validity::Corrected);
        let refuted = numbers(&|row| row.verdict == Validity::Refuted);
        let form = numbers(&|row| row.fault == Some(Fault::Form));
        let rows = cases.iter().flat_map(|case| &case.rows);
        Self {
            claims: claims.len(),
            confirmed: with(Assessment::Confirmed),
            explained: with(Assessment::Explained),
            corrected: with(Assessment::Corrected),
            refuted: with(Assessment::Refuted),
            undecided: with(Assessment::Undecided),
            unexpected_claims: claims
                .iter()
                .filter(|claim| !claim.as_expected)
                .map(|claim| claim.printed.id.clone())
                .collect(),
            equations: equations.len(),
            equations_corrected: corrected.len(),
            equations_refuted: refuted.len(),
            equations_as_expected: [corrected, refuted, form] == paper.failing,
            faulty_equations: FaultyEquations::of(equations),
            cases: cases.len(),
            cases_agreed: cases.iter().filter(|case| case.agrees()).count(),
            largest_difference: rows.max_by(|a, b| a.difference.total_cmp(&b.difference)).cloned(),
        }
    }

    /// Whether every verdict is the expected one and every case agrees.
    pub fn as_expected(&self) -> bool {
        self.claims > 0
            && self.unexpected_claims.is_empty()
            && self.undecided == 0
            && self.equations_as_expected
            && self.cases > 0
            && self.cases_agreed == self.cases
    }
}
