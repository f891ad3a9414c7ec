//! Chains folded on one straight line, where the closure leaves one force undetermined.

use model::{STRAIGHT_TOLERANCE, Vector};

use crate::run::closure::Shape;
use crate::run::scaled_chain::ScaledChain;
use crate::thresholds::{BISECTIONS, FORCE_ROUNDING};
use crate::vector::{along, cross, dot, norm};

/// Only below this ratio of diagonal entries is a look at the eigenvalues worth while: the frame
/// has an axis along the line.
const NEARLY_STRAIGHT: f64 = 1e-6;

/// The common line of the bars, if they are on one to rounding: the direction in which no motion
/// moves the last joint.
pub(crate) fn line(shape: &Shape) -> Option<Vector> {
    let spread = &shape.moments.spread;
    let diagonal = [spread.entry[0][0], spread.entry[1][1], spread.entry[2][2]];
    let largest = diagonal.into_iter().fold(0.0, f64::max);
    let smallest = diagonal.into_iter().fold(f64::INFINITY, f64::min);
    if smallest > NEARLY_STRAIGHT * largest {
        return None;
    }
    let eigen = spread.eigen();
    let k = (0..3).min_by(|&a, &b| eigen.value[a].total_cmp(&eigen.value[b]))?;
    if eigen.value[k] > STRAIGHT_TOLERANCE * eigen.largest() {
        return None;
    }
    Some([eigen.vector[k][0], eigen.vector[k][1], eigen.vector[k][2]])
}

/// How far the end anchor lies off the line through the first along the unit vector `e`, in total
/// lengths, if that is more than rounding.
pub(crate) fn off_the_line(links: &ScaledChain, e: Vector) -> Option<f64> {
    let [span, rest] = links.span;
    let span: Vector = std::array::from_fn(|k| span[k] + rest[k]);
    let across = norm(cross(e, span)) / links.total();
    (across > STRAIGHT_TOLERANCE).then_some(across)
}

/// The multiplier of a chain that hangs straight down and up again, its fold exactly at a joint.
///
/// With anchors on one vertical (or at one point) such a chain is the one of least energy, but its
/// two strands may share the weight in any way that leaves no bar pushed: `mu + tau e`, `e` along
/// the line, for an interval of `tau`. What is returned is the limit of the forces when the anchors
/// are moved apart sideways: the horizontal pull *H* turns bar *i* off the line by `H / N_i`, both
/// strands must lose the same length by it, and so
///
/// $$\sum_i s_i\\, l_i / N_i(\tau)^2 = 0, \qquad s_i = \mathrm{sign}(e \cdot u_i).$$
///
/// `None` if every `tau` leaves a bar pushed.
pub(crate) fn opening_multiplier(
    links: &ScaledChain,
    shape: &Shape,
    multiplier: Vector,
    e: Vector,
) -> Option<Vector> {
    let tension = |i: usize, u: Vector| -dot(links.load(i, multiplier), u);

    // N_i(tau) = N_i - tau e.u_i must not be negative.
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for (i, &u) in shape.u.iter().enumerate() {
        if dot(e, u) > 0.0 {
            high = high.min(tension(i, u));
        } else {
            low = low.max(-tension(i, u));
        }
    }
    if !(low.is_finite() && high.is_finite()) {
        return None;
    }
    let room = high - low;
    if room <= 0.0 {
        // A single tau, at which two bars with nothing between them are slack, is met to rounding.
        let size = low.abs().max(high.abs()).max(1.0);
        return (room >= -FORCE_ROUNDING * size).then(|| along(multiplier, 0.5 * (low + high), e));
    }
    for _ in 0..BISECTIONS {
        let tau = 0.5 * (low + high);
        let mut balance = 0.0;
        for (i, &u) in shape.u.iter().enumerate() {
            let s = dot(e, u);
            let n = tension(i, u) - tau * s;
            balance += s * links.length[i] / (n * n);
        }
        // A larger tau slackens the bars along e, and they lose more length.
        if balance < 0.0 {
            low = tau;
        } else {
            high = tau;
        }
    }
    Some(along(multiplier, 0.5 * (low + high), e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::settings::Motion;

    /// Nothing hangs at the fold: the two bars there are slack, whatever multiplier it starts from,
    /// and the rounding of its loads pushes neither.
    #[test]
    fn strands_that_meet_without_a_load_leave_the_last_bars_slack() {
        let (down, up) = ([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
        let links = |rounding: f64| ScaledChain {
            length: vec![0.25; 4],
            carried: vec![0.5, 0.1 + rounding, 0.1 - rounding, -0.5],
            span: [[0.0; 3]; 2],
            up,
            vertical: true,
            motion: Motion::Space,
        };
        let u = vec![down, down, up, up];
        let moments = links(0.0).measure(&u);
        let shape = Shape { u, moments };
        let e = line(&shape).unwrap();
        for start in [0.0, 0.1, -0.05] {
            let at = |rounding| opening_multiplier(&links(rounding), &shape, [0.0, 0.0, start], e);
            for rounding in [0.0, 1e-16, -1e-16] {
                assert!((at(rounding).unwrap()[2] + 0.1).abs() < 1e-15);
            }
            // Of these two, one is pushed whatever the forces.
            assert!(at(1e-3).is_none() != at(-1e-3).is_none());
        }
    }

    /// Four equal bars with both anchors at one point: by symmetry each strand takes one half.
    #[test]
    fn two_equal_strands_share_the_weight() {
        let (down, up) = ([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
        let links = ScaledChain {
            length: vec![0.25; 4],
            carried: vec![0.375, 0.125, -0.125, -0.375],
            span: [[0.0; 3]; 2],
            up,
            vertical: true,
            motion: Motion::Space,
        };
        let u = vec![down, down, up, up];
        let moments = links.measure(&u);
        let shape = Shape { u, moments };
        // Whatever multiplier it starts from.
        for start in [0.0, 0.1, -0.05] {
            let e = line(&shape).unwrap();
            let mu = opening_multiplier(&links, &shape, [0.0, 0.0, start], e).unwrap();
            assert!(mu.iter().all(|x| x.abs() < 1e-15));
        }
    }

    /// Powers of two of all lengths change neither the line nor which chain has one.
    #[test]
    fn a_line_is_one_in_every_unit() {
        for scale in [1.0, 2.0_f64.powi(30), 2.0_f64.powi(-30)] {
            let links = ScaledChain {
                length: vec![scale * 0.5; 2],
                carried: vec![0.25, -0.25],
                span: [[scale, 0.0, 0.0], [0.0; 3]],
                up: [0.0, 0.0, 1.0],
                vertical: false,
                motion: Motion::Space,
            };
            let bent = |angle: f64| {
                let u: Vec<Vector> = [angle, -angle].map(|a: f64| [a.cos(), 0.0, a.sin()]).to_vec();
                let moments = links.measure(&u);
                line(&Shape { u, moments })
            };
            // The spread is the square of the angle: 1e-16 is rounding of the lengths, 1e-10 not.
            let found = bent(1e-8).unwrap();
            assert!(found[0].abs() > 1.0 - 1e-15 && found[2].abs() < 1e-7);
            assert!(bent(1e-5).is_none() && bent(1e-2).is_none());
        }
    }

    #[test]
    fn anchors_off_the_line_are_off_it_by_their_part_of_the_length() {
        let links = ScaledChain {
            length: vec![1.0, 1.0],
            carried: vec![0.25, -0.25],
            span: [[0.3, 0.0, 0.4], [0.0, 0.0, 0.2]],
            up: [0.0, 0.0, 1.0],
            vertical: false,
            motion: Motion::Space,
        };
        assert!((off_the_line(&links, [1.0, 0.0, 0.0]).unwrap() - 0.3).abs() < 1e-15);
        assert!((off_the_line(&links, [0.0, 0.0, -1.0]).unwrap() - 0.15).abs() < 1e-15);
        let straight = ScaledChain { span: [[0.3, 0.0, 0.4], [0.0; 3]], ..links };
        assert!(off_the_line(&straight, [0.6, 0.0, 0.8]).is_none());
    }
}
