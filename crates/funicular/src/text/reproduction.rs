//! The reproduction for people: what the paper claims, what two solvers find, where it is wrong.

use std::fmt;

use paper::Reproduction;
use paper::claims::Claim;
use paper::printed::{Assessment, Printed};

use super::tables::{fitted, numbers_from, short, significant, table, word};
use crate::reproduce::ReproduceAnswer;

/// As `funicular reproduce` prints it.
impl fmt::Display for ReproduceAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&fitted(&reproduction(self.reproduction())))
    }
}

/// The whole text, section by section.
fn reproduction(r: &Reproduction) -> String {
    [
        format!("{}\n\nThe claims of the paper:\n{}", r.paper, claims(r)),
        format!("Where the paper is wrong, and the number that shows it:\n{}", wrong(r)),
        format!(
            "Equilibria of the example, degrees from the descending vertical and mgl:\n{}",
            equilibria(r)
        ),
        complete(r),
        format!("Random seeds:\n{}", seeds(r)),
        bounds(r),
        summary(r),
    ]
    .join("\n\n")
        + "\n"
}

fn claims(r: &Reproduction) -> String {
    let mut table = table(["claim", "printed", "lagrange", "energy", "verdict"]);
    for claim in &r.claims {
        table.add_row([
            claim.printed.says.clone(),
            claim_printed(&claim.printed),
            claim_value(claim, claim.lagrange),
            claim_value(claim, claim.energy),
            format!("{}{}", claim.verdict, if claim.as_expected { "" } else { " (!)" }),
        ]);
    }
    table.to_string()
}

fn wrong(r: &Reproduction) -> String {
    let mut table = table(["claim", "verdict", "number", "which is"]);
    for claim in r.claims.iter().filter(|c| c.verdict != Assessment::Confirmed) {
        table.add_row([
            format!("{} [{}]", claim.printed.says, claim.printed.place),
            claim.verdict.to_string(),
            claim.number.map_or_else(|| "-".to_owned(), |n| significant(n, 4)),
            claim.number_is.to_string(),
        ]);
    }
    table.to_string()
}

fn equilibria(r: &Reproduction) -> String {
    let mut table =
        table(["at", "theta", "alpha", "beta", "V lagrange", "V energy", "index", "proved"]);
    for p in &r.equilibria {
        let [theta, alpha, beta] = p.lagrange_deg.map(|a| format!("{a:.5}"));
        table.add_row([
            p.name.to_owned(),
            theta,
            alpha,
            beta,
            format!("{:.8}", p.lagrange_mgl),
            p.energy_mgl.map_or_else(|| "no minimum".to_owned(), |v| format!("{v:.8}")),
            format!("{}, {}", p.stability.index_in_plane, p.stability.index_in_space),
            p.rung().map_or_else(|| "-".to_owned(), |rung| rung.to_string()),
        ]);
    }
    numbers_from(&mut table, 1);
    format!(
        "{table}\n(index: in how many directions the energy falls, in the plane and in space; with 0 it is stable. \
         proved: the highest rung of evidence)"
    )
}

/// Section VIII, closed.
fn complete(r: &Reproduction) -> String {
    let c = &r.completeness;
    if !c.is_closed() {
        return format!(
            "NOT PROVED that these are all equilibria, or that (x) is none of them: {} listed, complete: {}.",
            c.planar, c.complete
        );
    }
    format!(
        "Proved: these are all. The example has exactly {} equilibria in the plane ({}) and {} circles of them in space, \
         and no others: each lies alone in a box of relative width {:.0e}, and interval arithmetic excludes all {} patterns \
         of tension and compression everywhere else ({} cells of pulls). Exact root counting of the sextic finds {} cosines, \
         and the Euler characteristic {} of the closure curve comes out.\n\
         Proved: (x) is none of them. Wherever the angles round to the printed ones, V has a slope of at least {:.4} mgl/rad, \
         and the nearest equilibrium is {:.4} deg away; for (ix) that is {:.4} deg.",
        c.planar,
        c.indices(),
        c.circles,
        c.width,
        c.patterns,
        c.cells,
        c.sextic_roots.unwrap_or_default(),
        c.alternating_sum,
        c.second.least_slope_mgl(),
        c.second.nearest_deg,
        c.first.nearest_deg,
    )
}

fn seeds(r: &Reproduction) -> String {
    let mut table =
        table(["solver", "seeds", "converged", "where to", "steps: median, 95 %, most"]);
    for s in &r.seeds {
        table.add_row([
            s.solver.to_string(),
            format!("{} {}", s.seeds, word(&s.kind)),
            format!("{:.2} %", 100.0 * s.rate()),
            s.led_to("'"),
            format!(
                "{}, {}, {}",
                s.median_iterations, s.most_iterations_of_95_percent, s.most_iterations
            ),
        ]);
    }
    table.to_string()
}

fn bounds(r: &Reproduction) -> String {
    let b = &r.bounds;
    format!(
        "No configuration has less energy than {:.12} mgl nor more than {:.12} mgl (stress \
         matrices of E1 and E2): E1 is the global minimum to {:.0e} mgl, E2 the global maximum to {:.0e} mgl.",
        b.lower_mgl, b.upper_mgl, b.gap_to_e1_mgl, b.gap_to_e2_mgl,
    )
}

fn summary(r: &Reproduction) -> String {
    let s = &r.summary;
    let faulty = &s.faulty_equations;
    let mut lines = vec![
        format!(
            "{} claims: {} confirmed, {} explained, {} corrected, {} refuted.",
            s.claims, s.confirmed, s.explained, s.corrected, s.refuted
        ),
        format!(
            "{} numbered equations: {} wrong in substance ({}), {} in form alone ({}), {} right to the step of a scan (--out DIR lists them).",
            faulty.numbered,
            faulty.substance.len(),
            faulty.substance.join(", "),
            faulty.form.len(),
            faulty.form.join(", "),
            faulty.digits.join(", "),
        ),
        format!(
            "Both solvers agree on {} of {} cases, and the third judge finds every bar in balance.",
            s.cases_agreed, s.cases
        ),
    ];
    if !s.unexpected_claims.is_empty() {
        lines.push(format!("NOT AS EXPECTED: {}", s.unexpected_claims.join(", ")));
    }
    if !s.equations_as_expected {
        lines.push("NOT AS EXPECTED: the list of equations that do not hold".to_owned());
    }
    let verdict = if r.all_as_expected {
        "Every verdict is the expected one,"
    } else {
        "The reproduction failed,"
    };
    lines.push(format!("{verdict} in {:.1} s.", r.seconds));
    lines.join("\n")
}

/// A value in the unit of its claim, with the printed number of decimals and three more.
fn claim_value(claim: &Claim, value: Option<f64>) -> String {
    match (value, claim.printed.digits) {
        (None, _) => "-".to_owned(),
        (Some(value), _) if claim.printed.is_count() => short(value),
        (Some(value), Some(digits)) => format!("{value:.*}", digits + 3),
        (Some(value), None) => short(value),
    }
}

/// What is printed, with its unit where it is a number.
fn claim_printed(printed: &Printed) -> String {
    match &printed.unit {
        Some(unit) if printed.digits.is_some() => format!("{} {unit}", printed.printed),
        _ => printed.printed.clone(),
    }
}
