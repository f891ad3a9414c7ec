//! `report.md`: the reproduction as a document.

use std::fmt::{self, Write as _};

use validate::Reproduction;
use validate::equations::{EquationAudit, Verdict};

use crate::tables::word;
use crate::verdicts::{claim_number, claim_printed, claim_value, seeds_reached};

/// The report in Markdown. The same numbers as in the terminal, and the equations one by one.
pub fn markdown(r: &Reproduction) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = write_report(&mut text, r);
    text
}

fn write_report(text: &mut String, r: &Reproduction) -> fmt::Result {
    head(text, r)?;
    equilibria(text, r)?;
    claims(text, r)?;
    equations(text, r)?;
    seeds(text, r)?;
    cases(text, r)
}

fn head(text: &mut String, r: &Reproduction) -> fmt::Result {
    let s = &r.summary;
    writeln!(text, "# Reproduction of \"{}\"\n", r.paper)?;
    writeln!(
        text,
        "{} claims: {} confirmed, {} explained, {} corrected, {} refuted. {} rows of equations: {} hold only as \
         corrected, {} not at all. Both solvers agree on {} of {} cases.{}\n",
        s.claims,
        s.confirmed,
        s.explained,
        s.corrected,
        s.refuted,
        s.equations,
        s.equations_corrected,
        s.equations_refuted,
        s.cases_agreed,
        s.cases,
        if r.all_as_expected {
            " Every verdict is the expected one."
        } else {
            " **Not every verdict is the expected one.**"
        },
    )?;
    Ok(())
}

fn equilibria(text: &mut String, r: &Reproduction) -> fmt::Result {
    writeln!(text, "## The equilibria of the example\n")?;
    writeln!(
        text,
        "Angles from the descending vertical in degrees, energies in mgl with the paper's zero (6 mgl below joint O).\n"
    )?;
    writeln!(
        text,
        "| | theta | alpha | beta | V, lagrange | V, energy | in plane | in space | nullity |\n|---|---|---|---|---|---|---|---|---|"
    )?;
    for p in &r.equilibria {
        let [theta, alpha, beta] = p.lagrange_deg;
        writeln!(
            text,
            "| {} | {theta:.10} | {alpha:.10} | {beta:.10} | {:.12} | {} | {:?} ({}) | {:?} ({}) | {} |",
            p.name,
            p.lagrange_mgl,
            p.energy_mgl.map_or_else(|| "no minimum".to_owned(), |v| format!("{v:.12}")),
            p.stability.in_plane,
            p.stability.index_in_plane,
            p.stability.in_space,
            p.stability.index_in_space,
            p.nullity,
        )?;
    }

    let b = &r.bounds;
    writeln!(
        text,
        "\nNo configuration has less energy than {:.12} mgl nor more than {:.12} mgl: semidefinite programmes without any \
         guess, rounded to proofs. E1 lies {:.0e} mgl above the first, E2 {:.0e} mgl below the second. (With bars as cables \
         the lower bound is only {:.6} mgl: bar 3 is in compression.)",
        b.lower_mgl, b.upper_mgl, b.gap_to_e1_mgl, b.gap_to_e2_mgl, b.cables_mgl,
    )?;
    Ok(())
}

fn claims(text: &mut String, r: &Reproduction) -> fmt::Result {
    writeln!(
        text,
        "\n## The claims\n\n| claim | where | printed | lagrange | energy | verdict | the number behind it |\n|---|---|---|---|---|---|---|"
    )?;
    for claim in &r.claims {
        let p = &claim.printed;
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {}{} | {} |",
            cell(&p.says),
            cell(&p.place),
            cell(&claim_printed(p)),
            claim_value(claim, claim.lagrange),
            claim_value(claim, claim.energy),
            claim.verdict,
            if claim.as_expected { "" } else { " (not expected)" },
            cell(&claim_number(claim)),
        )?;
    }
    Ok(())
}

fn equations(text: &mut String, r: &Reproduction) -> fmt::Result {
    writeln!(
        text,
        "\n## The equations\n\nEvaluated at run time as printed and as corrected; definitions have nothing to measure.\n"
    )?;
    writeln!(
        text,
        "| equation | what it says, or what is wrong | measured | as printed | as corrected | verdict |\n|---|---|---|---|---|---|"
    )?;
    for row in &r.equations {
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} |",
            row.number,
            cell(row.what),
            cell(row.measure),
            residual(row.verdict, Some(row.as_printed)),
            correction(row),
            verdict_word(row.verdict),
        )?;
    }
    Ok(())
}

fn seeds(text: &mut String, r: &Reproduction) -> fmt::Result {
    writeln!(
        text,
        "\n## Random seeds\n\n| solver | seeds | converged | where to | without help | steps: median, 95 %, most |\n|---|---|---|---|---|---|"
    )?;
    for survey in &r.seeds {
        writeln!(
            text,
            "| {} | {} {} | {} ({:.2} %) | {} | {} | {}, {}, {} |",
            survey.solver,
            survey.seeds,
            word(&survey.kind),
            survey.converged,
            100.0 * survey.rate(),
            seeds_reached(survey),
            survey.direct.map_or_else(|| "-".to_owned(), |d| d.to_string()),
            survey.median_iterations,
            survey.most_iterations_of_95_percent,
            survey.most_iterations,
        )?;
    }
    Ok(())
}

fn cases(text: &mut String, r: &Reproduction) -> fmt::Result {
    writeln!(text, "\n## Both solvers on the registry of cases\n")?;
    writeln!(
        text,
        "Largest differences in the units of their budgets (`validation/tolerances.toml`); statics is the largest violation of Newton's laws.\n"
    )?;
    writeln!(
        text,
        "| case | bars | joints | forces | energy | statics | evidence | verdict |\n|---|---|---|---|---|---|---|---|"
    )?;
    for case in &r.cases {
        let [joints, forces, energy, statics] = case.scaled.unwrap_or([f64::NAN; 4]);
        writeln!(
            text,
            "| {} | {} | {joints:.1e} | {forces:.1e} | {energy:.1e} | {statics:.1e} | {} | {} |",
            case.case,
            case.bars,
            case.rung.map_or_else(|| "-".to_owned(), |rung| rung.to_string()),
            case.failure.clone().unwrap_or_else(|| if case.agrees() {
                "agreed"
            } else {
                "disagreed"
            }
            .to_owned()),
        )?;
    }
    if let Some(row) = &r.summary.largest_difference {
        writeln!(
            text,
            "\nThe largest difference of all: {} of {}, {:.1e} of its unit.",
            row.observable, row.case, row.difference
        )?;
    }
    Ok(())
}

fn residual(verdict: Verdict, value: Option<f64>) -> String {
    match value {
        Some(value) if verdict != Verdict::Definition => format!("{value:.1e}"),
        _ => "-".to_owned(),
    }
}

fn correction(row: &EquationAudit) -> String {
    let value = residual(row.verdict, row.as_corrected);
    if row.corrected.is_empty() { value } else { format!("{value} ({})", cell(row.corrected)) }
}

fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Corrected => "corrected",
        Verdict::Refuted => "refuted",
        Verdict::Definition => "definition",
    }
}

/// Text inside a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}
