//! The closure and its kin as series over boxes of their coordinates.

use numerics::Interval;

use crate::closure::signed;
use crate::degenerate::series::Series;
use crate::plane::face::Face;
use crate::plane::system::System;

/// Two functions of two coordinates over a box; `None` where one of them is not analytic.
pub(crate) type Pair = Option<[Series; 2]>;

/// Φ over a rectangle on a face.
pub(crate) fn closure(system: &System, signs: &[i8], face: Face, at: [Interval; 2]) -> Pair {
    let [x, y] = [Series::variable(at[0], 0), Series::variable(at[1], 1)];
    let one = Series::constant(Interval::ONE);
    let [h, v, w] = match face {
        Face::Near | Face::Around(_) => [x, y, one],
        Face::Left => [-one, x, y],
        Face::Right => [one, x, y],
        Face::Below => [x, -one, y],
        Face::Above => [x, one, y],
    };
    let mut gap = system.span.map(|part| -Series::constant(part));
    let bars = signs.iter().zip(&system.length).zip(system.weights(face));
    for ((sign, length), weight) in bars {
        let force = [h, v + w.scaled(*weight)];
        add_bar(&mut gap, &force, signed(*sign, *length))?;
    }
    Some(gap)
}

/// `l F/|F|` more.
fn add_bar(gap: &mut [Series; 2], force: &[Series; 2], length: Interval) -> Option<()> {
    let inverse = (force[0] * force[0] + force[1] * force[1]).sqrt()?.inverse()?.scaled(length);
    *gap = [gap[0] + force[0] * inverse, gap[1] + force[1] * inverse];
    Some(())
}

/// G in the axial force and the direction of the bar with the sign 0: see
/// [`axial`](crate::slack::axial).
pub(crate) fn axial(
    system: &System,
    signs: &[i8],
    face: Face,
    axis: [Interval; 2],
    at: [Interval; 2],
) -> Pair {
    let [rho, t] = [Series::variable(at[0], 0), Series::variable(at[1], 1)];
    let [a, b] = axis.map(Series::constant);
    let arm = [a - t * b, b + t * a];
    let inverse = (arm[0] * arm[0] + arm[1] * arm[1]).sqrt()?.inverse()?;
    let e = arm.map(|part| part * inverse);
    let force = e.map(|part| rho * part);
    let mut gap = system.span.map(|part| -Series::constant(part));
    let bars = signs.iter().zip(&system.length).zip(system.weights(face));
    for ((sign, length), weight) in bars {
        if *sign == 0 {
            gap = [0, 1].map(|k| gap[k] + e[k].scaled(*length));
        } else {
            let force = [force[0], force[1] + Series::constant(*weight)];
            add_bar(&mut gap, &force, signed(*sign, *length))?;
        }
    }
    Some(gap)
}

/// Both equations next to a straight position in (ψ, w), blown up, and in (ψ, w²) if the anchors are
/// level: see [`straight`](crate::slack::straight). The pull is f + w ψ g/|f|².
pub(crate) fn blown_up(
    system: &System,
    signs: &[i8],
    f: [Interval; 2],
    [psi, w]: [Interval; 2],
) -> Pair {
    let level = f[1] == Interval::ZERO;
    let psi = Series::variable(psi, 0);
    let w = Series::variable(if level { w.square() } else { w }, 1);
    let square = Series::constant(f[0].square() + f[1].square());
    let mut pair = [Series::constant(Interval::ZERO); 2];
    let bars = signs.iter().zip(&system.length).zip(&system.weight);
    for ((sign, length), weight) in bars {
        let lean = psi + Series::constant(f[0] * *weight);
        // Both equations ask for a = w lean by its square alone; b does not vary if f is level.
        let a_square = if level { w * lean * lean } else { w * lean * w * lean };
        let b = if level { square } else { square + w.scaled(f[1] * *weight) };
        if b.value().lo() <= 0.0 {
            return None;
        }
        let r = (a_square + b * b).sqrt()?;
        let length = signed(*sign, *length);
        pair[0] = pair[0] + (lean * r.inverse()?).scaled(length);
        pair[1] = pair[1] + (lean * lean * (r * (r + b)).inverse()?).scaled(length);
    }
    Some(pair)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closure::Closure;
    use crate::plane::cell::Cell;
    use crate::plane::loads::JointLoads;

    #[test]
    fn the_closure_is_that_of_the_search() {
        let problem = model::cases::get("five-in-space").unwrap().problem();
        let system = System::new(problem.chain(), JointLoads::NONE);
        let signs = [1, -1, 1, 1, -1];
        for face in [Face::Near, Face::Left, Face::Right, Face::Below, Face::Above] {
            let cell =
                Cell { face, at: [Interval::around(0.3, 1e-3), Interval::around(0.2, 1e-3)] };
            let known = Closure::over(&system, &signs, &cell).unwrap();
            let gap = Closure::gap_over(&system, &signs, &cell);
            let pair = closure(&system, &signs, face, cell.at).unwrap();
            for (k, series) in pair.iter().enumerate() {
                assert!(!series.value().disjoint(gap[k]));
                let [x, y] = series.gradient();
                assert!(!x.disjoint(known.slope[k][0]) && !y.disjoint(known.slope[k][1]));
                assert!(x.width() < 0.2 && y.width() < 0.2, "{x:?} {y:?}");
            }
        }
    }

    /// Against the formulas at a point: with `a = w (ψ + f_x c)`, `b = |f|² + w f_z c` and `r² = a² + b²`
    /// the sums of `s l (ψ + f_x c)/r` and of `s l (ψ + f_x c)²/(r (r + b))`, and their differences.
    #[test]
    fn the_blown_up_equations_are_those_of_their_formulas() {
        let problem = model::cases::get("five-in-space").unwrap().problem();
        let system = System::new(problem.chain(), JointLoads::NONE);
        let signs = [1_i8, -1, 1, 1, -1];
        for f in [[0.75, 0.5], [-0.75, 0.5], [0.75, -0.25], [0.75, 0.0], [-0.5, 0.0]] {
            let level = f64::abs(f[1]) <= 0.0;
            let by_formula = |psi: f64, w: f64| {
                let mut sums = [0.0; 2];
                for ((sign, length), weight) in signs.iter().zip(&system.length).zip(&system.weight)
                {
                    let (length, c) = (f64::from(*sign) * length.mid(), weight.mid());
                    let lean = psi + f[0] * c;
                    let b = f[0] * f[0] + f[1] * f[1] + w * f[1] * c;
                    let r = (w * lean).hypot(b);
                    sums[0] += length * lean / r;
                    sums[1] += length * lean * lean / (r * (r + b));
                }
                sums
            };
            let (psi, w) = (0.375, 0.25);
            let at = [psi, w].map(Interval::point);
            let pair = blown_up(&system, &signs, f.map(Interval::point), at).unwrap();
            let wanted = by_formula(psi, w);
            // Between level anchors the second coordinate is w².
            let step = 1e-5;
            let by_psi = [by_formula(psi + step, w), by_formula(psi - step, w)];
            let by_w = [by_formula(psi, w + step), by_formula(psi, w - step)];
            let unit = if level { 2.0 * w } else { 1.0 };
            for k in 0..2 {
                let close = |found: Interval, wanted: f64, room: f64| {
                    assert!((found.mid() - wanted).abs() < room, "{f:?} {k}: {found:?} {wanted}");
                };
                close(pair[k].value(), wanted[k], 1e-13);
                let [x, y] = pair[k].gradient();
                close(x, (by_psi[0][k] - by_psi[1][k]) / (2.0 * step), 1e-7);
                close(y, (by_w[0][k] - by_w[1][k]) / (2.0 * step * unit), 1e-7);
            }
        }
        let level = [Interval::ONE, Interval::ZERO];
        assert!(blown_up(&system, &signs, level, [Interval::ZERO; 2]).is_some());
    }
}
