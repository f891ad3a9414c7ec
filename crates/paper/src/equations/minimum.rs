//! Section VIII, solution 1: eqs. (i)-(x).

use std::f64::consts::{FRAC_PI_2, TAU};

use matrices::dense::{apply, least_squares};
use nalgebra::{DVector, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::equilibrium::{load, planar, reactions};
use super::sample::{LargestEntry, angles, largest, worst};
use super::{E1State, EquationAudit, Fault, ROUNDING, SOLVED, says};

/// Half a unit of the last digit that (ix) and (x) print, with room for the rounding of a tie.
const LAST_DIGIT: f64 = 5.01e-6;

/// The angles of (ix), deg.
const PRINTED_IX: [f64; 3] = [19.709_75, 38.583_06, 286.074_20];

/// The same rounded from the true minimum.
const CORRECTED_IX: [f64; 3] = [19.694_87, 38.599_14, 286.079_41];

/// The angles of (x), deg.
const PRINTED_X: [f64; 3] = [0.057_30, 299.942_74, 59.942_67];

/// Distance of the anchors in (i).
const SPAN: f64 = 2.0;

/// Residual of (i), (iii), (xxv) and of (ii), (iv), (xxvi), l = 1.
pub(super) fn closure(phi: [f64; 3], span: f64) -> [f64; 2] {
    [phi.iter().map(|a| a.cos()).sum::<f64>() - span, phi.iter().map(|a| a.sin()).sum()]
}

/// Three angles that close the chain, by elementary geometry: bars 2 and 3 are the equal sides of a
/// triangle over what bar 1 leaves, which they span if cos(theta) > 1/4.
fn closed(rng: &mut ChaCha8Rng) -> [f64; 3] {
    let theta = rng.random_range(-1.3..1.3_f64);
    let (down, aside) = (SPAN - theta.cos(), -theta.sin());
    let (middle, half) = (aside.atan2(down), (down.hypot(aside) / 2.0).acos());
    let half = if rng.random_range(0.0..1.0) < 0.5 { half } else { -half };
    [theta, middle + half, middle - half]
}

/// Potential energy in mgl from the heights of the centres above D.
fn heights([theta, alpha, beta]: [f64; 3]) -> f64 {
    let rise = |angle| lagrange::direction(0.0, FRAC_PI_2, angle).z;
    let (a, b) = (rise(theta), rise(theta) + rise(alpha));
    let centres = [rise(theta) / 2.0, a + rise(alpha) / 2.0, b + rise(beta) / 2.0];
    centres.iter().map(|z| SPAN + z).sum()
}

/// Eq. (v).
fn energy([theta, alpha, beta]: [f64; 3]) -> f64 {
    6.0 - 2.5 * theta.cos() - 1.5 * alpha.cos() - 0.5 * beta.cos()
}

/// The second equation (viii).
fn quadratic(theta: f64, alpha: f64) -> f64 {
    let (c, x) = (theta.cos(), alpha.cos());
    (20.0 - 16.0 * c) * x * x + 2.0 * (26.0 * c - 20.0 - 8.0 * c * c) * x + 16.0 * c * c + 25.0
        - 40.0 * c
        - 4.0 * theta.sin().powi(2)
}

/// theta of (ix), rad: a point of the paper's scan.
const THETA_IX: f64 = 0.344;

/// Intervals of a turn in which the changes of sign are counted.
const INTERVALS: i32 = 3600;

/// Zeros of a function of an angle, by its changes of sign over a whole turn.
fn roots(f: impl Fn(f64) -> f64) -> f64 {
    let at = |k: i32| f(TAU * (f64::from(k) + 0.5) / f64::from(INTERVALS));
    (0..INTERVALS).filter(|k| at(*k) * at(k + 1) < 0.0).count() as f64
}

/// What the sides of (vii), squared and summed, leave of 1: bar 3 reaches D where it vanishes.
fn open(theta: f64, alpha: f64) -> f64 {
    (2.0 - theta.cos() - alpha.cos()).powi(2) + (theta.sin() + alpha.sin()).powi(2) - 1.0
}

/// Difference of an axis from the direction of the weights in the load vector.
fn down_from(axis: Vector3<f64>) -> f64 {
    let paper = model::cases::paper();
    let weight = lagrange::load_vector(paper.chain()).fixed_rows::<3>(0).into_owned().normalize();
    (weight - axis).largest_entry()
}

/// Smallest norm that any multipliers leave of (40), in mg; NaN if an angle is.
fn left_of_40(phi: [f64; 3]) -> f64 {
    let q = planar(phi);
    let columns: Vec<_> = (0..12)
        .map(|k| {
            let mut unit = DVector::zeros(12);
            unit[k] = 1.0;
            reactions(&q, &unit)
        })
        .collect();
    let load = load(true);
    let columns = nalgebra::DMatrix::from_columns(&columns);
    let Some(multipliers) = least_squares(&columns, &load, ROUNDING) else { return f64::NAN };
    (load - apply(&columns, &multipliers)).norm()
}

/// Difference of two angles in deg, modulo a turn.
fn difference_deg(printed_deg: f64, rad: f64) -> f64 {
    let turn = 360.0;
    let difference = (printed_deg - rad.to_degrees()).rem_euclid(turn);
    difference.min(turn - difference)
}

/// How far an angle lies outside the first quadrant, deg.
fn outside_first_quadrant(angle: f64) -> f64 {
    let deg = angle.to_degrees();
    // The distance from the middle of the quadrant less half its width.
    if (0.0..=90.0).contains(&deg) { 0.0 } else { largest([deg - 45.0]) - 45.0 }
}

pub(super) fn rows(e1: &E1State) -> Vec<EquationAudit> {
    let mut rows = relations(e1);
    rows.extend(results(e1));
    rows
}

/// The smaller of two distances; NaN if one is.
fn nearer(a: f64, b: f64) -> f64 {
    if a.is_nan() || a <= b { a } else { b }
}

fn relations(e1: &E1State) -> Vec<EquationAudit> {
    let [down, aside] = closure(e1.angles(), SPAN);
    let at_closed = |f: fn([f64; 3]) -> f64| worst(|rng| f(closed(rng)));
    let squared = at_closed(|[theta, alpha, beta]| {
        largest([
            beta.cos() - (2.0 - theta.cos() - alpha.cos()),
            beta.sin() + theta.sin() + alpha.sin(),
        ])
    });
    let configurations = "largest difference, 1000 random closed configurations";
    // E2 is E1 upside down. For its theta, (viii) has the roots alpha and beta: bars 2 and 3 can be
    // swapped.
    let e2 = upside_down(e1);
    let no_first = nearer(outside_first_quadrant(e2[1]), outside_first_quadrant(e2[2]));
    let both = largest([quadratic(e2[0], e2[1]), quadratic(e2[0], e2[2])]);
    vec![
        says("before (i)", "VIII", "the angles are measured from the vertical descending axis Ox, where (35) has the weight along -Z")
            .measured("difference of the axis from the direction of the weights", down_from(Vector3::x()), ROUNDING)
            .corrected("from the axis -OZ", down_from(-Vector3::z()), ROUNDING),
        says("before (i)", "VIII", "OD = l, where (i) needs OD = 2l")
            .measured("residual of (i) at E1 with this OD, l", closure(e1.angles(), 1.0)[0], SOLVED)
            .corrected("OD = 2l", down, SOLVED),
        says("(i)", "VIII", "the chain closes along the vertical")
            .measured("residual at E1, l", down, SOLVED),
        says("(ii)", "VIII", "the chain closes across the vertical")
            .measured("residual at E1, l", aside, SOLVED),
        says("(iii)", "VIII", "(i) over l").measured("residual at E1", down, SOLVED),
        says("(iv)", "VIII", "(ii) over l").measured("residual at E1", aside, SOLVED),
        says("(v)", "VIII", "the potential energy, zero at the height of D")
            .measured(
                "largest difference from the heights of the centres, 1000 random states, mgl",
                worst(|rng| {
                    let phi = angles(rng);
                    energy(phi) - heights(phi)
                }),
                ROUNDING,
            ),
        says("(vi)", "VIII", "the potential energy with (iii) put in")
            .measured(
                "largest difference from the heights of the centres, 1000 random closed configurations, mgl",
                at_closed(|phi| 5.0 - 2.0 * phi[0].cos() - phi[1].cos() - heights(phi)),
                ROUNDING,
            ),
        says("(vii)", "VIII", "(iii) and (iv) solved for beta").measured(configurations, squared, ROUNDING),
        says("(vii)", "VIII", "is printed with the number (viii), which the next equation has too")
            .counted("equations numbered (viii) less one", repeated(&["(viii)", "(viii)"]))
            .corrected("(vii)", repeated(&["(vii)", "(viii)"]), ROUNDING)
            .fault(Fault::Form),
        says("(viii)", "VIII", "(vii) squared and summed, squared once more to be rid of sin(alpha)")
            .measured(
                "largest left-hand side, 1000 random closed configurations",
                at_closed(|[theta, alpha, _]| quadratic(theta, alpha)),
                ROUNDING,
            ),
        says("after (viii)", "VIII", "two solutions alpha: squared, (viii) has four, and two of them do not close the chain")
            .counted("solutions at theta = 0.344 rad less two", roots(|alpha| quadratic(THETA_IX, alpha)) - 2.0)
            .corrected("two where (vii) holds besides: its sides squared sum to 1", roots(|alpha| open(THETA_IX, alpha)) - 2.0, ROUNDING),
        says("after (viii)", "VIII", "one solution alpha is always in the first quadrant: not at theta of E2, where both are in the fourth")
            .measured("how far the nearer solution is from the first quadrant, deg", no_first, ROUNDING)
            .replaced("the two solutions are alpha and beta in either order; value: largest residual of (viii) at both", both),
    ]
}

/// How many times (viii) is used too often as a number.
fn repeated(numbers: &[&str]) -> f64 {
    numbers.iter().filter(|&&number| number == "(viii)").count() as f64 - 1.0
}

/// E2: E1 turned upside down, so that the last bar is the first.
fn upside_down(e1: &E1State) -> [f64; 3] {
    [-e1.beta, -e1.alpha, -e1.theta].map(|angle| angle.sin().atan2(angle.cos()))
}

fn results(e1: &E1State) -> Vec<EquationAudit> {
    let from_e1 = |printed: [f64; 3]| {
        largest((0..3).map(|bar| difference_deg(printed[bar], e1.angles()[bar])))
    };
    let reported = PRINTED_X.map(f64::to_radians);
    let multipliers = "what the best multipliers leave of (40), mg (root of the sum of squares)";
    vec![
        says("(ix)", "VIII", "the angles are those of a grid point, theta = 0.344 rad, not of the minimum")
            .measured("largest difference of an angle from E1, deg", from_e1(PRINTED_IX), LAST_DIGIT)
            .corrected(
                "theta = 19.69487, alpha = 38.59914, beta = 286.07941 deg",
                from_e1(CORRECTED_IX),
                LAST_DIGIT,
            )
            .fault(Fault::Digits),
        says("(ix)", "VIII", "the energy V = 2.33547 mgl")
            .measured("difference from E1, mgl", 2.335_47 - heights(e1.angles()), LAST_DIGIT),
        says("(x)", "VIII", "the energy V = 2.50087 mgl belongs to the angles")
            .measured("difference from the heights at the printed angles, mgl", 2.500_87 - heights(reported), LAST_DIGIT),
        says("(x)", "VIII", "no equilibrium: theta = 0.001 rad is the first point of a grid on the other branch of (viii)")
            .measured(multipliers, left_of_40(reported), SOLVED)
            .replaced(
                "the second equilibrium is E1 upside down: theta = 73.92059, alpha = -38.59914, beta = -19.69487 deg, V = 3.66453 mgl, a maximum in the plane",
                left_of_40(upside_down(e1)),
            ),
    ]
}
