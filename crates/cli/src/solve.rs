//! `funicular solve`: one system, both solvers, one verdict.

use std::fmt::Write as _;

use miette::miette;
use model::{Equilibrium, Problem, SystemSummary, system_file};
use serde::Serialize;
use validate::{Agreement, Tolerances, compare, compare::judge_alone};

use crate::answer;
use crate::args::{Solve, Which};
use crate::cases;
use crate::diagnostics::SystemFileReport;
use crate::exit::{Exit, Failure};
use crate::output;
use crate::progress::Progress;

/// Version of the JSON object; raised when a key that others rely on changes its meaning.
pub const SCHEMA_VERSION: u32 = 1;

/// What `solve --json` prints.
#[derive(Debug, Serialize)]
struct Answer {
    schema_version: u32,
    system: SystemSummary,
    equilibria: Vec<Equilibrium>,
    agreement: Option<Agreement>,
}

/// Run the command.
pub fn run(arguments: &Solve) -> Result<Exit, Failure> {
    let problem = read(arguments)?;
    let progress = Progress::start();
    let mut equilibria = Vec::new();
    if arguments.solver != Which::Energy {
        progress.say("lagrange: constraints and multipliers");
        let found = lagrange::solve(&problem, &lagrange::Settings::default());
        equilibria
            .push(found.map_err(|e| Failure::undecided(miette!("lagrange: {e}")))?.equilibrium);
    }
    if arguments.solver != Which::Lagrange {
        progress.say("energy: minimisation");
        let found = energy::minimise(&problem, &energy::Settings::default());
        equilibria.push(found.map_err(|e| Failure::undecided(miette!("energy: {e}")))?.equilibrium);
    }
    progress.say("the judges");
    let (equilibria, agreement) = judge(&problem, equilibria);
    drop(progress);

    if let Some(path) = &arguments.csv {
        output::write_whole(path, &joints_csv(&equilibria))?;
    }
    let exit = match &agreement {
        Some(agreement) if !agreement.agrees() => Exit::CheckFailed,
        _ => Exit::Done,
    };
    let found = Answer {
        schema_version: SCHEMA_VERSION,
        system: problem.chain().summary(),
        equilibria,
        agreement,
    };
    if arguments.json {
        output::print(&json(&found, arguments.summary)?)?;
    } else {
        output::print(&answer::answer(
            &found.system,
            &found.equilibria,
            found.agreement.as_ref(),
            arguments.summary,
        ))?;
    }
    Ok(exit)
}

/// The problem of the file or of the named case.
fn read(arguments: &Solve) -> Result<Problem, Failure> {
    match (&arguments.file, &arguments.case) {
        (Some(file), _) => system_file::read_problem(file)
            .map_err(|error| Failure::bad_input(SystemFileReport::from(error))),
        (None, Some(name)) => cases::find(name).map(model::cases::Case::problem),
        // clap asks for one of them.
        (None, None) => Err(Failure::bad_input(miette!("name a system file or a case"))),
    }
}

/// Two answers are compared; a single one is only judged by Newton's laws.
fn judge(
    problem: &Problem,
    mut equilibria: Vec<Equilibrium>,
) -> (Vec<Equilibrium>, Option<Agreement>) {
    if let Ok(mut both) = <[Equilibrium; 2]>::try_from(equilibria.clone()) {
        let agreement = compare(problem, &mut both, &Tolerances::project());
        return (both.into(), Some(agreement));
    }
    for answer in &mut equilibria {
        let statics = judge_alone(problem, answer);
        let why = format!(
            "only one solver was asked; the statics judge finds every bar in balance to {:.1e}",
            statics.largest()
        );
        answer.evidence.miss(model::Rung::Agreed, why);
    }
    (equilibria, None)
}

/// The answer as JSON, with or without the arrays over joints and bars.
fn json(answer: &Answer, summary: bool) -> Result<String, Failure> {
    let broken =
        |error| Failure::undecided(miette!("the answer cannot be written as JSON: {error}"));
    let mut value = serde_json::to_value(answer).map_err(broken)?;
    if summary && let Some(equilibria) = value["equilibria"].as_array_mut() {
        for equilibrium in equilibria.iter_mut().filter_map(serde_json::Value::as_object_mut) {
            for key in ["joints_m", "multipliers_n", "axial_n"] {
                equilibrium.remove(key);
            }
        }
    }
    serde_json::to_string_pretty(&value).map(|text| text + "\n").map_err(broken)
}

/// A line per solver and joint: position, force of bar k+1 on bar k (at joint 0 of the ground on bar 1, at
/// joint n of the ground on bar n), and the axial force of the bar that ends there.
fn joints_csv(equilibria: &[Equilibrium]) -> String {
    let mut text = "solver,joint,x_m,y_m,z_m,force_x_n,force_y_n,force_z_n,axial_n\n".to_owned();
    for e in equilibria {
        for (k, ([x, y, z], [fx, fy, fz])) in e.joints_m.iter().zip(&e.multipliers_n).enumerate() {
            // Writing to a String cannot fail.
            let _ = write!(text, "{},{k},{x:?},{y:?},{z:?},{fx:?},{fy:?},{fz:?},", e.solver);
            let _ = match k.checked_sub(1).and_then(|bar| e.axial_n.get(bar)) {
                Some(axial) => writeln!(text, "{axial:?}"),
                None => writeln!(text),
            };
        }
    }
    text
}
