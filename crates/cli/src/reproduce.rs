//! `funicular reproduce`: the paper, judged.

use energy::example::{Branch, CurvePoint, PAPER_STEP_RAD, ScanMinimum, curve, scan};
use miette::miette;
use serde::Serialize;
use validate::Reproduction;
use validate::table::csv;

use crate::args::Reproduce;
use crate::exit::{Exit, Failure};
use crate::output;
use crate::progress::Progress;
use crate::report;
use crate::verdicts;

/// Points of the closure curve in `results.json`: half a degree of arc or less between neighbours.
const CURVE_POINTS: usize = 721;

/// What `reproduce --json` prints and `results.json` holds.
#[derive(Debug, Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    reproduction: &'a Reproduction,
    figures: Figures,
}

/// What there is to draw: angles in degrees from the descending vertical, energies in mgl.
#[derive(Debug, Serialize)]
struct Figures {
    /// Closed chains: theta, alpha, beta, V.
    closure_curve: Vec<[f64; 4]>,
    /// The points of the paper's scan on each of its two branches: theta, V.
    scan_points: [Vec<[f64; 2]>; 2],
    /// The results of the scan, (ix) and (x): theta, alpha, beta, V.
    scan_results: Vec<[f64; 4]>,
}

/// Run the command.
pub fn run(arguments: &Reproduce) -> Result<Exit, Failure> {
    if let Some(folder) = &arguments.out {
        // Before the work, not after it.
        output::make_folder(folder)?;
    }
    let progress = Progress::start();
    let reproduction = validate::reproduce(|what| progress.say(what))
        .map_err(|error| Failure::undecided(miette!("{error}")))?;
    drop(progress);
    let json = || {
        let results = Results { reproduction: &reproduction, figures: figures() };
        serde_json::to_string_pretty(&results)
            .map(|text| text + "\n")
            .map_err(|error| Failure::undecided(miette!("the results cannot be written: {error}")))
    };
    if let Some(folder) = &arguments.out {
        output::write_whole(&folder.join("results.json"), &json()?)?;
        output::write_whole(&folder.join("report.md"), &report::markdown(&reproduction))?;
        output::write_whole(&folder.join("comparison.csv"), &csv(&reproduction.cases))?;
    }
    if arguments.json {
        output::print(&json()?)?;
    } else {
        output::print(&verdicts::reproduction(&reproduction))?;
        if let Some(folder) = &arguments.out {
            output::print(&format!(
                "Written to {}: report.md, results.json, comparison.csv\n",
                folder.display()
            ))?;
        }
    }
    Ok(if reproduction.all_as_expected { Exit::Done } else { Exit::CheckFailed })
}

fn figures() -> Figures {
    let point = |theta: f64, alpha: f64, beta: f64, energy: f64| {
        [theta.to_degrees(), alpha.to_degrees(), beta.to_degrees(), energy]
    };
    let on_curve = |p: &CurvePoint| point(p.theta_rad, p.alpha_rad, p.beta_rad, p.energy_mgl);
    let result = |m: &ScanMinimum| point(m.theta_rad, m.alpha_rad, m.beta_rad, m.energy_mgl);
    let found = scan(PAPER_STEP_RAD);
    let points = found.as_ref().map_or(0, |found| found.first.points);
    let scanned = |branch: Branch| {
        (1..=points)
            .filter_map(|k| {
                let theta = k as f64 * PAPER_STEP_RAD;
                let alpha = energy::example::alpha(theta, branch)?;
                Some([theta.to_degrees(), energy::example::potential(theta, alpha)])
            })
            .collect()
    };
    Figures {
        closure_curve: curve(CURVE_POINTS).iter().map(on_curve).collect(),
        scan_points: Branch::BOTH.map(scanned),
        scan_results: found.iter().flat_map(|f| [result(&f.first), result(&f.second)]).collect(),
    }
}
