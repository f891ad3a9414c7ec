//! The first page: what came out.

use paper::Reproduction;
use paper::equations::Verdict;

use crate::block::{Block, heading, text};
use crate::figures;
use crate::numbers::{fixed, in_words, measured};

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    let s = &r.summary;
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
             programmed anew and independently (`energy`, `lagrange`), held against each other, against Newton's laws, and against \
             everything the paper prints. Every verdict below rests on a number worked out when this report was made.",
        ),
        heading(2, "outcome", "What came out"),
        text(format!(
            "{} claims: {} confirmed, {} explained, {} corrected, {} refuted. {} parts of equations and statements \
             of the text: {} hold only as corrected, {} not at all. Both solvers agree on {} of {} cases. {outcome}",
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
        claim.and_then(|claim| claim.number).map_or_else(|| "?".to_owned(), |x| measured(x, 4))
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
        measured(r.figures.slope_at_x, 4),
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
    let judged = crate::equations::judged(&r.equations);
    let with = |verdict| judged.iter().filter(|j| j.verdict == verdict).count();
    items.push(format!(
        "**Of {} equations, [{} need a correction](#equations)**, from a wrong index to a lost weight, and {}, the second \
         position, cannot be saved. With the corrections all others hold to rounding, and the system has 30 equations for 30 \
         unknowns, not 18.",
        judged.len(),
        with(Verdict::Corrected),
        with(Verdict::Refuted),
    ));
    items.push(format!(
        "**There are exactly {} equilibria in the plane**, and {} circles of them in space, and the second position is none of \
         them: [proved](#census).",
        r.completeness.planar, r.completeness.circles
    ));
    items.push(format!(
        "**E1 is the lowest of all positions, E2 the highest**: [semidefinite bounds](#positions) without any guess are \
         {} mgl away.",
        in_words(r.bounds.gap_to_e1_mgl.max(r.bounds.gap_to_e2_mgl), 2)
    ));
    items
}
