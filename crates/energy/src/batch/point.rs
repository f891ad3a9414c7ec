//! What the bars of all lanes know, and the passes over them.
#![expect(
    clippy::inline_always,
    reason = "a pass over the bars is fast only as one loop of vector instructions"
)]

use super::piece::Piece;
use super::wide::{WIDTH, Wide, accumulate, same, wide};
use crate::thresholds::FORCE_ROUNDING;

/// One bar in all lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// Direction on trial.
    pub(crate) x: Wide,
    pub(crate) z: Wide,
    /// Direction in the last closed chain that was accepted.
    pub(crate) x_base: Wide,
    pub(crate) z_base: Wide,
    /// Projected slope there.
    pub(crate) slope: Wide,
    /// Axial force there, and then what stands for it in the step.
    pub(crate) axial: Wide,
    /// Step from there.
    pub(crate) turn: Wide,
}

impl Place {
    pub(crate) const ZERO: Self = Self {
        x: same(0.0),
        z: same(0.0),
        x_base: same(0.0),
        z_base: same(0.0),
        slope: same(0.0),
        axial: same(0.0),
        turn: same(0.0),
    };
}

/// Sums over the bars at the trial.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sums {
    pub(crate) gap: [Wide; 2],
    /// $\sum l_i t_i t_i^T$ as xx, xz, zz.
    pub(crate) spread: [Wide; 3],
    /// $\sum l_i h_i (t_i\cdot e_z)\\, t_i$.
    pub(crate) weight: [Wide; 2],
    pub(crate) value: Wide,
}

/// One pass over the bars.
#[inline(always)]
pub(crate) fn measure(pieces: &[Piece], span: [f64; 2], places: &[Place]) -> Sums {
    let mut sums = Sums {
        gap: [same(-span[0]), same(-span[1])],
        spread: [same(0.0); 3],
        weight: [same(0.0); 2],
        value: same(0.0),
    };
    for (piece, place) in pieces.iter().zip(places) {
        let (l, h) = (piece.length, piece.lifted);
        let (x, z) = (&place.x, &place.z);
        accumulate(&mut sums.gap[0], |k| l * x[k]);
        accumulate(&mut sums.gap[1], |k| l * z[k]);
        accumulate(&mut sums.spread[0], |k| l * z[k] * z[k]);
        accumulate(&mut sums.spread[1], |k| -(l * x[k] * z[k]));
        accumulate(&mut sums.spread[2], |k| l * x[k] * x[k]);
        accumulate(&mut sums.weight[0], |k| -(l * h * x[k] * z[k]));
        accumulate(&mut sums.weight[1], |k| l * h * x[k] * x[k]);
        accumulate(&mut sums.value, |k| l * h * z[k]);
    }
    sums
}

/// Solution of `[[a, b], [b, d]] y = r` in every lane.
#[inline(always)]
pub(crate) fn answer(matrix: &[Wide; 3], right: &[Wide; 2]) -> [Wide; 2] {
    let [a, b, d] = matrix;
    let inverse = wide(|k| 1.0 / (a[k] * d[k] - b[k] * b[k]));
    [
        wide(|k| (d[k] * right[0][k] - b[k] * right[1][k]) * inverse[k]),
        wide(|k| (a[k] * right[1][k] - b[k] * right[0][k]) * inverse[k]),
    ]
}

/// What is known at a closed chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slopes {
    /// Largest $l_i |s_i|$, in units of the largest of $|\mu|$ and 1 times the mean length.
    pub(crate) largest: Wide,
    /// Whether the second derivative on the tangent space is positive definite, or no bar is pushed:
    /// then it is the minimum, though slack bars may move at no cost.
    pub(crate) convex: [bool; WIDTH],
    /// Largest turn in the step, and its undefined entries.
    pub(crate) largest_turn: Wide,
    /// $\sum l_i s_i \delta_i$: first-order change of the energy.
    pub(crate) fall: Wide,
}

/// An axial force smaller than this, in the direction of the step only, is taken for this one.
const LEAST_STIFFNESS: f64 = 1e-3;

/// Slope, curvature and step at the trial, which is closed. The lanes where it is not get nonsense,
/// which nobody uses; `accepted` says which lanes take it over.
#[inline(always)]
pub(crate) fn slopes(
    pieces: &[Piece],
    sums: &Sums,
    accepted: &[bool; WIDTH],
    places: &mut [Place],
) -> Slopes {
    let [x, z] = answer(&sums.spread, &sums.weight);
    let mu = [wide(|k| -x[k]), wide(|k| -z[k])];
    let count = pieces.len() as f64;
    let force = wide(|k| {
        let square = mu[0][k] * mu[0][k] + mu[1][k] * mu[1][k];
        if square > 1.0 { square.sqrt() } else { 1.0 }
    });
    let (mut largest, mut negative, mut pushed) = (same(0.0), same(0.0), same(0.0));
    let mut matrix = [same(0.0); 3];
    let mut axial_of = |piece: &Piece, place: &Place| {
        let (x, z) = (&place.x, &place.z);
        let up = wide(|k| piece.lifted + mu[1][k]);
        let slope = wide(|k| x[k] * up[k] - z[k] * mu[0][k]);
        let axial = wide(|k| -(z[k] * up[k] + x[k] * mu[0][k]));
        accumulate(&mut negative, |k| if axial[k] < 0.0 { 1.0 } else { 0.0 });
        accumulate(&mut pushed, |k| if axial[k] >= -FORCE_ROUNDING * force[k] { 0.0 } else { 1.0 });
        let weight = wide(|k| piece.length / axial[k]);
        accumulate(&mut matrix[0], |k| weight[k] * z[k] * z[k]);
        accumulate(&mut matrix[1], |k| -(weight[k] * x[k] * z[k]));
        accumulate(&mut matrix[2], |k| weight[k] * x[k] * x[k]);
        largest = wide(|k| {
            let slope = piece.length * slope[k].abs();
            if slope <= largest[k] { largest[k] } else { slope }
        });
        (slope, axial)
    };
    for (piece, place) in pieces.iter().zip(places.iter_mut()) {
        let (slope, axial) = axial_of(piece, place);
        for k in 0..WIDTH {
            if accepted[k] {
                place.slope[k] = slope[k];
                place.axial[k] = axial[k];
                place.x_base[k] = place.x[k];
                place.z_base[k] = place.z[k];
            }
        }
    }
    let convex = wide(|k| {
        let determinant = matrix[0][k] * matrix[2][k] - matrix[1][k] * matrix[1][k];
        let trace = matrix[0][k] + matrix[2][k];
        let positive = match (determinant > 0.0, trace > 0.0) {
            (true, true) => 2.0,
            (true, false) => 0.0,
            (false, _) => 1.0,
        };
        // Zero or undefined determinants are no proof.
        pushed[k] < 0.5 || determinant.abs() > 0.0 && (negative[k] + positive - 2.0).abs() < 0.5
    });
    let unit = wide(|k| force[k] / count);
    let (largest_turn, fall) = newton(pieces, &convex, accepted, places);
    Slopes { largest: wide(|k| largest[k] / unit[k]), convex, largest_turn, fall }
}

/// Newton's step on the tangent space; that of the absolute curvatures where it is not convex.
#[inline(always)]
fn newton(
    pieces: &[Piece],
    convex: &[bool; WIDTH],
    accepted: &[bool; WIDTH],
    places: &mut [Place],
) -> (Wide, Wide) {
    let mut matrix = [same(0.0); 3];
    let mut right = [same(0.0); 2];
    for (piece, place) in pieces.iter().zip(places.iter_mut()) {
        let (x, z) = (&place.x_base, &place.z_base);
        // The inverse of what stands for the axial force.
        let inverse = wide(|k| {
            let axial = place.axial[k];
            let stiff = if axial.abs() > LEAST_STIFFNESS { axial.abs() } else { LEAST_STIFFNESS };
            1.0 / if convex[k] || !accepted[k] { axial } else { stiff }
        });
        let weight = wide(|k| piece.length * inverse[k]);
        accumulate(&mut matrix[0], |k| weight[k] * z[k] * z[k]);
        accumulate(&mut matrix[1], |k| -(weight[k] * x[k] * z[k]));
        accumulate(&mut matrix[2], |k| weight[k] * x[k] * x[k]);
        accumulate(&mut right[0], |k| weight[k] * place.slope[k] * z[k]);
        accumulate(&mut right[1], |k| -(weight[k] * place.slope[k] * x[k]));
        for k in 0..WIDTH {
            if accepted[k] {
                place.axial[k] = inverse[k];
            }
        }
    }
    let nu = answer(&matrix, &right);
    let (mut largest, mut fall) = (same(0.0), same(0.0));
    for (piece, place) in pieces.iter().zip(places.iter_mut()) {
        let (x, z) = (&place.x_base, &place.z_base);
        let turn = wide(|k| -(place.slope[k] + x[k] * nu[1][k] - z[k] * nu[0][k]) * place.axial[k]);
        accumulate(&mut fall, |k| piece.length * place.slope[k] * turn[k]);
        largest = wide(|k| if turn[k].abs() > largest[k] { turn[k].abs() } else { largest[k] });
        for k in 0..WIDTH {
            if accepted[k] {
                place.turn[k] = turn[k];
            }
        }
    }
    (largest, fall)
}

/// How the next trial is made in a lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moves {
    /// From the accepted chain by this part of the step, ...
    pub(crate) from_base: [bool; WIDTH],
    pub(crate) part: Wide,
    /// ... or from the trial by $-t_i\cdot\nu$, ...
    pub(crate) pull: [Wide; 2],
    /// ... and besides, bar i by this times i + 1.
    pub(crate) perturbation: Wide,
}

/// Make the next trial.
#[inline(always)]
pub(crate) fn turn(places: &mut [Place], moves: &Moves) {
    for (bar, place) in places.iter_mut().enumerate() {
        let pick =
            |yes: &Wide, no: &Wide| wide(|k| if moves.from_base[k] { yes[k] } else { no[k] });
        let (x, z) = (pick(&place.x_base, &place.x), pick(&place.z_base, &place.z));
        let nu = &moves.pull;
        let step = wide(|k| moves.part[k] * place.turn[k]);
        let correction = wide(|k| z[k] * nu[0][k] - x[k] * nu[1][k]);
        let number = (bar + 1) as f64;
        let delta = pick(&step, &correction);
        let delta = wide(|k| delta[k] + number * moves.perturbation[k]);
        let scale = wide(|k| 1.0 / (1.0 + delta[k] * delta[k]).sqrt());
        place.x = wide(|k| (x[k] - delta[k] * z[k]) * scale[k]);
        place.z = wide(|k| (z[k] + delta[k] * x[k]) * scale[k]);
    }
}
