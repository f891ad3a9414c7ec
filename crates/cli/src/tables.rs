//! Tables for the terminal.

use std::fmt::Write as _;

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, presets};
use model::cases::Case;
use model::{Equilibrium, SystemSummary, Vector};
use validate::claims::Claim;
use validate::paper::{Printed, Verdict};
use validate::seeds::Survey;
use validate::{Agreement, Reproduction};

/// Chains up to this many bars are printed joint by joint; longer ones by their ends (`--csv` and
/// `--json` have all).
const PRINTED_BARS: usize = 40;

/// Width of tables where no terminal says its own.
const WIDTH: u16 = 120;

/// A table in the house style: thin rules, as wide as its content or the terminal.
pub fn table<const N: usize>(head: [&str; N]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_HORIZONTAL_ONLY.row_separator(LineStyle::none()))
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_header(head);
    if table.width().is_none() {
        table.set_width(WIDTH);
    }
    table
}

/// Right-align the columns from `first` on.
fn numbers_from(table: &mut Table, first: usize) {
    for column in table.column_iter_mut().skip(first) {
        column.set_cell_alignment(CellAlignment::Right);
    }
}

/// The answer of `solve`, for people.
pub fn answer(
    system: &SystemSummary,
    equilibria: &[Equilibrium],
    agreement: Option<&Agreement>,
    summary: bool,
) -> String {
    let mut text = format!(
        "{}: {} bars, {} m long, {} kg, anchors {} m apart, g = {} m/s^2\n\n",
        system.name,
        system.bars,
        short(system.total_length_m),
        short(system.total_mass_kg),
        short(system.span_m),
        short(system.gravity_m_s2),
    );
    text += &overview(equilibria);
    if !summary && let Some(first) = equilibria.first() {
        text += &shape(first, system.bars);
    }
    text += &ladder(equilibria);
    if let Some(agreement) = agreement {
        text += &self::agreement(agreement);
    }
    text
}

fn overview(equilibria: &[Equilibrium]) -> String {
    let mut table = table([
        "solver",
        "energy / J",
        "force at start / N",
        "force at end / N",
        "in plane",
        "in space",
        "residual",
        "steps",
        "time",
    ]);
    for e in equilibria {
        table.add_row([
            e.solver.to_string(),
            long(e.energy_j),
            vector(e.reactions_n.start),
            vector(e.reactions_n.end),
            format!("{} ({})", word(&e.stability.in_plane), e.stability.index_in_plane),
            format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space),
            format!("{:.1e}", e.evidence.residual),
            e.evidence.iterations.to_string(),
            duration(e.evidence.solve_s),
        ]);
    }
    numbers_from(&mut table, 1);
    format!("{table}\n(in brackets: the number of directions in which the energy falls)\n\n")
}

/// Joints and forces of one equilibrium; the other solver's agree with it or the verdict says so.
fn shape(e: &Equilibrium, bars: usize) -> String {
    if bars > PRINTED_BARS {
        return format!("{bars} bars are not printed: --csv FILE or --json have them all.\n\n");
    }
    let mut table = table([
        "joint",
        "x / m",
        "y / m",
        "z / m",
        "force x / N",
        "force y / N",
        "force z / N",
        "bar to the next",
        "axial / N",
    ]);
    for (k, (joint, force)) in e.joints_m.iter().zip(&e.multipliers_n).enumerate() {
        let axial = e.axial_n.get(k);
        table.add_row([
            k.to_string(),
            short(joint[0]),
            short(joint[1]),
            short(joint[2]),
            short(force[0]),
            short(force[1]),
            short(force[2]),
            axial.map_or_else(String::new, |a| {
                if *a < 0.0 { "compression" } else { "tension" }.to_owned()
            }),
            axial.map_or_else(String::new, |a| short(*a)),
        ]);
    }
    numbers_from(&mut table, 1);
    format!(
        "Joints, and the forces at them (on the bar before the joint; at joint 0 on bar 1), by {}:\n{table}\n\n",
        e.solver
    )
}

/// How far each equilibrium is proved, rung by rung.
fn ladder(equilibria: &[Equilibrium]) -> String {
    let mut text = String::new();
    for e in equilibria {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "Evidence for the answer of {}: {}", e.solver, e.evidence.rung());
        for s in e.evidence.ladder() {
            let _ = writeln!(
                text,
                "  {} {:<10} {}",
                if s.reached { "+" } else { "-" },
                s.rung.to_string(),
                s.how
            );
        }
    }
    text + "\n"
}

fn agreement(agreement: &Agreement) -> String {
    format!(
        "Agreement: {} (joints {:.1e} m, forces {:.1e} N, energy {:.1e} J)\n",
        agreement.verdict, agreement.joints_m, agreement.forces_n, agreement.energy_j
    )
}

/// The reproduction, for people: what the paper claims, what two solvers find, where it is wrong.
pub fn reproduction(r: &Reproduction) -> String {
    let mut text = format!("{}\n\nThe claims of the paper:\n", r.paper);
    let mut claims = table(["claim", "printed", "lagrange", "energy", "verdict"]);
    for claim in &r.claims {
        claims.add_row([
            claim.printed.says.clone(),
            claim_printed(&claim.printed),
            claim_value(claim, claim.lagrange),
            claim_value(claim, claim.energy),
            format!("{}{}", claim.verdict, if claim.as_expected { "" } else { " (!)" }),
        ]);
    }
    text += &format!("{claims}\n\nWhere the paper is wrong, and the number that shows it:\n");
    let mut wrong = table(["claim", "verdict", "number", "which is"]);
    for claim in r.claims.iter().filter(|c| c.verdict != Verdict::Confirmed) {
        wrong.add_row([
            format!("{} [{}]", claim.printed.says, claim.printed.place),
            claim.verdict.to_string(),
            claim.number.map_or_else(|| "-".to_owned(), |n| significant(n, 4)),
            claim.number_is.clone(),
        ]);
    }
    text += &format!(
        "{wrong}\n\nEquilibria of the example, degrees from the descending vertical and mgl:\n"
    );
    let mut equilibria =
        table(["", "theta", "alpha", "beta", "V, lagrange", "V, energy", "in plane", "in space"]);
    for p in &r.equilibria {
        let [theta, alpha, beta] = p.lagrange_deg.map(|a| format!("{a:.8}"));
        equilibria.add_row([
            p.name.to_owned(),
            theta,
            alpha,
            beta,
            format!("{:.10}", p.lagrange_mgl),
            p.energy_mgl.map_or_else(|| "no minimum".to_owned(), |v| format!("{v:.10}")),
            format!("{} ({})", word(&p.stability.in_plane), p.stability.index_in_plane),
            format!("{} ({})", word(&p.stability.in_space), p.stability.index_in_space),
        ]);
    }
    numbers_from(&mut equilibria, 1);
    text += &format!(
        "{equilibria}\n(in brackets: the number of directions in which the energy falls)\n\nRandom seeds:\n"
    );
    let mut seeds =
        table(["solver", "seeds", "converged", "where to", "steps: median, 95 %, most"]);
    for s in &r.seeds {
        seeds.add_row([
            s.solver.to_string(),
            format!("{} {}", s.seeds, word(&s.kind)),
            format!("{:.2} %", 100.0 * s.rate()),
            seeds_reached(s),
            format!(
                "{}, {}, {}",
                s.median_iterations, s.most_iterations_of_95_percent, s.most_iterations
            ),
        ]);
    }
    text += &format!(
        "{seeds}\n\nNo configuration has less energy than {:.12} mgl nor more than {:.12} mgl (semidefinite \
         programmes, rounded to proofs):\nE1 is the global minimum to {:.0e} mgl, E2 the global maximum to {:.0e} mgl.\n",
        r.bounds.lower_mgl, r.bounds.upper_mgl, r.bounds.gap_to_e1_mgl, r.bounds.gap_to_e2_mgl,
    );
    let s = &r.summary;
    text += &format!(
        "\n{} claims: {} confirmed, {} explained, {} corrected, {} refuted. {} rows of equations: {} hold \
         only as corrected, {} not at all (--out DIR lists them).\n",
        s.claims,
        s.confirmed,
        s.explained,
        s.corrected,
        s.refuted,
        s.equations,
        s.equations_corrected,
        s.equations_refuted,
    );
    text += &format!(
        "Both solvers agree on {} of {} cases, and the third judge finds every bar in balance.\n",
        s.cases_agreed, s.cases
    );
    if !s.unexpected_claims.is_empty() {
        text += &format!("NOT AS EXPECTED: {}\n", s.unexpected_claims.join(", "));
    }
    if !s.equations_as_expected {
        text += "NOT AS EXPECTED: the list of equations that do not hold\n";
    }
    text += &format!(
        "{} in {:.1} s.\n",
        if r.all_as_expected {
            "Every verdict is the expected one,"
        } else {
            "The reproduction failed,"
        },
        r.seconds
    );
    text
}

/// A value in the unit of its claim, with the printed number of decimals and three more.
pub fn claim_value(claim: &Claim, value: Option<f64>) -> String {
    match (value, claim.printed.digits) {
        (None, _) => "-".to_owned(),
        (Some(value), Some(digits)) => format!("{value:.*}", digits + 3),
        (Some(value), None) => short(value),
    }
}

/// What is printed, with its unit where it is a number.
pub fn claim_printed(printed: &Printed) -> String {
    match &printed.unit {
        Some(unit) if printed.digits.is_some() => format!("{} {unit}", printed.printed),
        _ => printed.printed.clone(),
    }
}

/// The number behind the verdict and what it is.
pub fn claim_number(claim: &Claim) -> String {
    claim.number.map_or_else(
        || claim.number_is.clone(),
        |n| format!("{}: {}", claim.number_is, significant(n, 4)),
    )
}

/// Where the seeds of a survey led.
pub fn seeds_reached(s: &Survey) -> String {
    let mut parts: Vec<_> = s
        .reached
        .iter()
        .filter(|r| r.seeds > 0)
        .map(|r| format!("{} {}", r.seeds, r.equilibrium))
        .collect();
    if s.elsewhere > 0 {
        parts.push(format!("{} elsewhere", s.elsewhere));
    }
    parts.extend(s.lost.iter().map(|l| format!("{} lost: {}", l.seeds, l.why)));
    parts.join(", ")
}

/// The registry.
pub fn cases(cases: &[Case]) -> String {
    let mut table = table(["case", "what it is"]);
    for case in cases {
        table.add_row([case.name, case.about]);
    }
    format!("{table}\n")
}

/// A number for reading: six significant digits.
fn short(x: f64) -> String {
    significant(x, 6)
}

/// A number for comparing: fifteen significant digits.
fn long(x: f64) -> String {
    significant(x, 15)
}

/// `digits` significant digits, in plain notation where that is readable.
fn significant(x: f64, digits: usize) -> String {
    if x.abs() < f64::MIN_POSITIVE {
        return "0".to_owned();
    }
    let exponent = x.abs().log10().floor();
    if !(-4.0..7.0).contains(&exponent) {
        return format!("{x:.*e}", digits - 1);
    }
    // Between 0 and digits + 3, by the test above.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small and not negative"
    )]
    let decimals = (digits as f64 - 1.0 - exponent).max(0.0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

fn vector(v: Vector) -> String {
    format!("({})", v.map(short).join(", "))
}

/// The serialised name of a unit variant.
pub fn word(value: &impl serde::Serialize) -> String {
    serde_json::to_value(value).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
}

fn duration(seconds: f64) -> String {
    if seconds < 1e-3 {
        format!("{:.1} us", seconds * 1e6)
    } else if seconds < 1.0 {
        format!("{:.1} ms", seconds * 1e3)
    } else {
        format!("{seconds:.2} s")
    }
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn numbers_keep_their_digits_and_drop_their_zeros() {
        assert_eq!(significant(1.0, 6), "1");
        assert_eq!(significant(-0.648_944_835_9, 6), "-0.648945");
        assert_eq!(significant(1.234_567_89e-9, 6), "1.23457e-9");
        assert_eq!(significant(123_456_789.0, 6), "1.23457e8");
        assert_eq!(significant(0.0, 6), "0");
        assert_eq!(significant(1200.0, 3), "1200");
    }
}
