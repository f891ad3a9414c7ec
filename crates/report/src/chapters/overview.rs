//! The first page: what came out.

use paper::Reproduction;
use paper::equations::Fault;

use crate::block::{Block, heading, text};
use crate::figures;
use crate::numbers::{fixed, in_words};

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    let s = &r.summary;
    let of_form = r.equations.iter().filter(|row| row.fault == Some(Fault::Form)).count();
    let outcome = if r.all_as_expected {
        "Every verdict is the expected one."
    } else {
        "**Not every verdict is the expected one.**"
    };
    vec![
        heading(1, "top", &format!("Reproduction of “{}”", r.paper)),
        text(
            "The paper finds where three bars, hung between two points, come to rest under their own weight: once by \
             searching for the least potential energy, once by Lagrange multipliers. Here both ways are \
             programmed again, independently of each other (`energy`, `lagrange`), held against each other, against Newton's laws, and against \
             everything the paper prints. Every verdict below rests on a number worked out when this report was made.",
        ),
        heading(2, "outcome", "What came out"),
        text(format!(
            "{} claims: {} confirmed, {} explained, {} corrected, {} refuted. {} parts of equations and statements \
             of the text: {} hold only as corrected ({} of them in form alone), {} not at all. Both solvers agree on {} of {} cases. {outcome}",
            s.claims,
            s.confirmed,
            s.explained,
            s.corrected,
            s.refuted,
            s.equations,
            s.equations_corrected,
            of_form,
            s.equations_refuted,
            s.cases_agreed,
            s.cases,
        )),
        Block::List(findings(r)),
        heading(2, "mechanism", "The mechanism"),
        Block::Figure(figures::mechanism()),
    ]
}

/// The main results, each with its number and where to read on.
fn findings(r: &Reproduction) -> Vec<String> {
    let number = |id: &str| {
        let claim = r.claims.iter().find(|claim| claim.printed.id == id);
        let number = claim.and_then(|claim| claim.number);
        number.map_or_else(|| "?".to_owned(), |x| in_words(x, 4))
    };
    let mut items = Vec::new();
    if let Some(e1) = r.equilibria.first() {
        let [theta, alpha, beta] = e1.lagrange_deg.map(|angle| fixed(angle, 5));
        items.push(format!(
            "**The first position is right to its grid.** The minimum lies at θ, α, β = {theta}, {alpha}, {beta} degrees with V \
             = {} mgl, by both solvers; the printed angles are those of the [nearest point of a scan](#scan) with the step \
             0.001 rad.",
            fixed(e1.lagrange_mgl, 8)
        ));
    }
    items.push(format!(
        "**The second position is no equilibrium.** It is the first point of the same scan on another branch, on a slope of \
         {} mgl/rad; the best multipliers leave {} mg of its equations.",
        in_words(r.figures.slope_at_x, 4),
        number("x-multipliers")
    ));
    if let Some(e2) = r.equilibria.iter().find(|p| p.name == "E2") {
        let [theta, alpha, beta] = e2.lagrange_deg.map(|angle| fixed(angle, 5));
        items.push(format!(
            "**There is a second equilibrium**, at {theta}, {alpha}, {beta} degrees with V = {} mgl: the [first one upside \
             down](#positions), a maximum, which a search for minima cannot find.",
            fixed(e2.lagrange_mgl, 8)
        ));
    }
    let faulty = &r.summary.faulty_equations;
    items.push(format!(
        "**Of {} equations, [{} are wrong in substance](#equations)**, from the rotation matrix (5) to the moments of bar 3 in \
         (xxiv); one of them, the second position (x), cannot be saved. {} more are wrong in form alone (a number used twice, \
         brackets and dots, some of which the copy at hand may have lost), and {} is right to the step of its scan. With the \
         corrections all others hold to rounding, and the system has 30 equations for 30 unknowns, not 18.",
        faulty.numbered,
        faulty.substance.len(),
        faulty.form.len(),
        faulty.digits.join(", "),
    ));
    items.push(format!(
        "**There are exactly {} equilibria in the plane**, and {} circles of them in space, and the second position is none of \
         them: [proved](#census).",
        r.completeness.planar, r.completeness.circles
    ));
    items.push(format!(
        "**E1 is the lowest of all positions, E2 the highest**: [the bounds](#positions) of their stress matrices are \
         {} mgl away.",
        in_words(r.bounds.gap_to_e1_mgl.max(r.bounds.gap_to_e2_mgl), 2)
    ));
    items
}
