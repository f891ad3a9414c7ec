//! Section VIII, Solution 1: the example, the search, and the position (ix).

use std::f64::consts::FRAC_PI_2;

use energy::example::{
    Branch, LARGEST_THETA_COSINE, PAPER_STEP_RAD, ScanMinimum, alpha, candidates,
};
use model::{Anchors, Chain, InPlane, InSpace, Problem};

use super::{ANGLE_RAD, ENERGY_MGL, Facts, Finding, largest, printed_degrees};
use crate::printed::{Assessment, Paper, Printed};
use crate::sentence::Sentence;
use model::number::Number;

pub(super) fn judge(facts: &Facts, printed: &Printed) -> Option<Finding> {
    let scan = &facts.example.energy.scan;
    match printed.id.as_str() {
        "vertical" => Some(vertical(facts)),
        "span" => Some(span(facts)),
        "solutions" => Some(solutions(facts, printed)),
        "branches" => Some(branches()),
        "minima" => Some(minima(facts)),
        "scan-ix" => Some(scanned(facts.paper, "ix", &scan.first)),
        "scan-x" => Some(scanned(facts.paper, "x", &scan.second)),
        "ix-theta" => Some(angle(facts, printed, 0)),
        "ix-alpha" => Some(angle(facts, printed, 1)),
        "ix-beta" => Some(angle(facts, printed, 2)),
        "ix-energy" => Some(energy(facts, printed)),
        _ => None,
    }
}

/// The numbers of one position of the scan: value and name of the claim that prints it.
pub(super) fn numbers<'a>(
    paper: &'a Paper,
    position: &str,
    found: &ScanMinimum,
) -> Vec<(Option<&'a Printed>, f64)> {
    [
        ("theta", printed_degrees(found.theta_rad)),
        ("alpha", printed_degrees(found.alpha_rad)),
        ("beta", printed_degrees(found.beta_rad)),
        ("energy", found.energy_mgl),
    ]
    .into_iter()
    .map(|(quantity, value)| (paper.claim(&format!("{position}-{quantity}")), value))
    .collect()
}

/// The scan returns the printed numbers.
fn scanned(paper: &Paper, position: &str, found: &ScanMinimum) -> Finding {
    let numbers = numbers(paper, position, found);
    let same = numbers.iter().filter(|(claim, value)| claim.is_some_and(|c| c.rounds_to(*value)));
    let same = same.count();
    let verdict = Assessment::Refuted.unless(same == numbers.len());
    let what = Sentence::filled(
        "of the four printed numbers to the last digit; point {} of {}, theta = {} rad",
        [found.point.into(), found.points.into(), Number::decimals(found.theta_rad, 3).into()],
    );
    Finding::new(verdict, same as f64, what).energy(same as f64)
}

/// An angle of (ix): what both solvers find, and how far the printed one is from it in steps of the
/// scan.
fn angle(facts: &Facts, printed: &Printed, bar: usize) -> Finding {
    let example = facts.example;
    let lagrange = example.by_lagrange(&example.lagrange.e1).angles_rad[bar];
    let energy = example.by_energy_e1().angles_rad[bar];
    let minimum = &example.energy.minimum;
    let curve = [minimum.theta_rad, minimum.alpha_rad, minimum.beta_rad][bar];
    let reference = facts.paper.reference(["e1-theta", "e1-alpha", "e1-beta"][bar]).to_radians();
    let spread = largest([lagrange, energy, curve].map(|value| value - reference));
    let agreed = spread <= ANGLE_RAD && (lagrange - energy).abs() <= ANGLE_RAD;

    let first = &example.energy.scan.first;
    let scanned = [first.theta_rad, first.alpha_rad, first.beta_rad][bar];
    let steps = (printed.value() - printed_degrees(lagrange)).to_radians() / PAPER_STEP_RAD;
    let verdict = if printed.rounds_to(printed_degrees(lagrange)) {
        Assessment::Confirmed
    } else if printed.rounds_to(printed_degrees(scanned)) && steps.abs() < 1.0 {
        Assessment::Explained
    } else {
        Assessment::Refuted
    };
    let what = Sentence::filled(
        "printed less true, in steps of the scan (0.001 rad), whose point this is; solvers and reference agree to {} \
         rad",
        [Number::size(spread, 0).into()],
    );
    Finding::new(verdict.if_shown(agreed), steps, what)
        .lagrange(printed_degrees(lagrange))
        .energy(printed_degrees(energy))
}

/// V of (ix): flat at a minimum, so that the scan has all its printed digits right.
fn energy(facts: &Facts, printed: &Printed) -> Finding {
    let example = facts.example;
    let lagrange = example.by_lagrange(&example.lagrange.e1).v_mgl;
    let energy = example.by_energy_e1().v_mgl;
    let curve = example.energy.minimum.energy_mgl;
    let reference = facts.paper.reference("e1-energy");
    let spread = largest([lagrange, energy, curve].map(|value| value - reference));
    let agreed = spread <= ENERGY_MGL && (lagrange - energy).abs() <= ENERGY_MGL;
    let all = [lagrange, energy, curve].into_iter().all(|value| printed.rounds_to(value));
    let verdict = Assessment::Refuted.unless(all);
    let what = "printed less true, mgl: within half a unit of the last digit";
    Finding::new(verdict.if_shown(agreed), printed.value() - lagrange, what)
        .lagrange(lagrange)
        .energy(energy)
}

/// OD = l is printed; (i) and all results need 2 l.
fn span(facts: &Facts) -> Finding {
    let example = facts.example;
    let reach = |angles: [f64; 3]| model::sum(angles.map(f64::cos));
    let lagrange = reach(example.by_lagrange(&example.lagrange.e1).angles_rad);
    let energy = reach(example.by_energy_e1().angles_rad);
    let printed = numbers(facts.paper, "ix", &example.energy.scan.first);
    let printed =
        reach([0, 1, 2].map(|k| printed[k].0.map_or(f64::NAN, Printed::value).to_radians()));
    // The printed angles close a span of 2 l to their printed digits: 3 angles, half a unit of 1e-5
    // deg each.
    let rounding = 3.0 * 0.5e-5_f64.to_radians();
    let shown =
        largest([lagrange - 2.0, energy - 2.0]) <= ANGLE_RAD && (printed - 2.0).abs() <= rounding;
    let sum = "l: the sum of the cosines of the printed angles (ix)";
    let what = match theta_with_half_the_span(facts) {
        Some(theta) => Sentence::from([
            sum.into(),
            "; with OD = l theta would be ".into(),
            Number::decimals(theta, 5).into(),
            " deg".into(),
        ]),
        None => sum.into(),
    };
    Finding::new(Assessment::Corrected.if_shown(shown), printed, what)
        .lagrange(lagrange)
        .energy(energy)
}

/// theta of the chain with the span as printed, deg, if both solvers agree on it.
fn theta_with_half_the_span(facts: &Facts) -> Option<f64> {
    let chain = facts.example.problem.chain();
    let start_m = chain.anchors().start_m;
    let end_m = [start_m[0], start_m[1], start_m[2] - facts.example.units.l_m];
    let anchors = Anchors { start_m, end_m };
    let bars = chain.bars().to_vec();
    let printed = Chain::new("OD = l", chain.gravity_m_s2(), anchors, bars).ok()?;
    let problem = Problem::new(printed).ok()?;
    let theta = |joints: &[model::Vector]| {
        let [x, y, z]: model::Vector = std::array::from_fn(|k| joints[1][k] - joints[0][k]);
        x.hypot(y).atan2(-z)
    };
    let lagrange = lagrange::solve(&problem, &lagrange::Settings::default()).ok()?.equilibrium;
    let energy = energy::minimise(&problem, &energy::Settings::default()).ok()?.equilibrium;
    let [a, b] = [theta(&lagrange.joints_m), theta(&energy.joints_m)];
    ((a - b).abs() <= ANGLE_RAD).then_some(a.to_degrees())
}

/// The angles are said to be from a vertical axis Ox, while the weights of (35) act along -Z.
fn vertical(facts: &Facts) -> Finding {
    let weight = lagrange::load_vector(facts.example.problem.chain())
        .fixed_rows::<3>(0)
        .into_owned()
        .normalize();
    let [from_x, from_down] = [weight.x, -weight.z].map(|cos| cos.acos().to_degrees());
    let verdict = Assessment::Corrected.unless(from_x <= f64::EPSILON);
    let what =
        "deg between Ox and the weights, which (35) has along -Z: the angles are from the axis -OZ";
    Finding::new(verdict.if_shown(from_down <= f64::EPSILON), from_x, what).lagrange(from_x)
}

/// Squared twice to be rid of the sines, (viii) does not know their signs: besides the two alpha
/// that close the chain it has two that do not.
fn solutions(facts: &Facts, printed: &Printed) -> Finding {
    let theta = facts.example.energy.scan.first.theta_rad;
    let all = candidates(theta);
    // None of the four is nearly another.
    let shown = all.iter().all(|found| (found.closure.abs() <= ANGLE_RAD) == found.closes);
    let degrees = |closes: bool, k: usize| {
        let mut of = all.iter().filter(|found| found.closes == closes);
        Number::decimals(of.nth(k).map_or(f64::NAN, |found| found.alpha_rad.to_degrees()), 3)
    };
    let what = Sentence::filled(
        "solutions at theta = {} rad: alpha = {} and {} deg close the chain, {} and {} deg, added by squaring, do not",
        [
            Number::decimals(theta, 3).into(),
            degrees(true, 0).into(),
            degrees(true, 1).into(),
            degrees(false, 0).into(),
            degrees(false, 1).into(),
        ],
    );
    let count = all.len() as f64;
    let verdict = Assessment::Corrected.unless((count - printed.value()).abs() < 0.5);
    Finding::new(verdict.if_shown(shown), count, what).energy(count)
}

/// Points of the closure curve at which the quadrants are looked up.
const CURVE_POINTS: i32 = 2000;

/// Alpha of (viii): in the first and fourth quadrant as printed, but only up to theta = 60 deg; at
/// the theta of E2 both are in the fourth.
fn branches() -> Finding {
    let first = |theta: f64| alpha(theta, Branch::FirstQuadrant).unwrap_or(f64::NAN);
    let as_printed = |theta: f64| {
        let fourth = alpha(theta, Branch::FourthQuadrant).unwrap_or(f64::NAN);
        (0.0..FRAC_PI_2).contains(&first(theta)) && (-FRAC_PI_2..0.0).contains(&fourth)
    };
    let largest = LARGEST_THETA_COSINE.acos();
    // Where alpha_1 passes zero.
    let (mut low, mut high) = (0.0, largest);
    for _ in 0..f64::MANTISSA_DIGITS {
        let middle = 0.5 * (low + high);
        if first(middle) > 0.0 { low = middle } else { high = middle }
    }
    let points = || (1..CURVE_POINTS).map(|k| largest * f64::from(k) / f64::from(CURVE_POINTS));
    let before = points().filter(|theta| *theta < low).all(as_printed);
    let after = points().filter(|theta| *theta > high).any(as_printed);
    let verdict = match (before, after, high < largest) {
        (true, _, false) => Assessment::Confirmed,
        (true, false, true) => Assessment::Refuted,
        _ => Assessment::Undecided,
    };
    let what = Sentence::filled(
        "deg: from this theta on, up to {} deg, both alpha lie in the fourth quadrant",
        [Number::decimals(largest.to_degrees(), 1).into()],
    );
    Finding::new(verdict, low.to_degrees(), what).energy(low.to_degrees())
}

/// E2 is an equilibrium and no minimum.
fn minima(facts: &Facts) -> Finding {
    let found = &facts.example.lagrange.e2.equilibrium;
    let at_e2 = &facts.example.energy.at_e2;
    let equilibrium =
        largest([found.evidence.residual, at_e2.residual, at_e2.gap]) <= FORCE_BALANCE;
    let unstable = [found.stability, at_e2.stability]
        .iter()
        .all(|s| s.in_plane == InPlane::Maximum && s.in_space == InSpace::Unstable);
    let index = found.stability.index_in_space as f64;
    let what = "independent motions that lower the energy at E2, an equilibrium";
    Finding::new(Assessment::Refuted.if_shown(equilibrium && unstable), index, what)
        .lagrange(index)
        .energy(at_e2.stability.index_in_space as f64)
}

/// A residual this small is that of an equilibrium, in units of mg and l: both solvers converge to
/// 1e-12.
const FORCE_BALANCE: f64 = 1e-11;
