//! The third judge: Newton's laws for every bar, from joint positions and joint forces alone.
//!
//! It knows nothing of angles, directions, multipliers' equations or energies: a bar is two points
//! and a weight between them, and the forces at its ends are what the answer says they are. Bar *i*
//! feels the force `f` of entry *i* at its far joint, and the opposite of entry *i*−1 at its near
//! joint (for bar 1 entry 0 itself, the force of the ground), and its weight:
//!
//! $$ F_{i-1} + F_i - m_i g\\, e_z = 0, \qquad
//!    (x_{i-1} - x_{C_i}) \times F_{i-1} + (x_i - x_{C_i}) \times F_i = 0 . $$

use model::{Chain, Vector, sum};

use crate::free::free_joints;
use crate::lever::centre_part;
use crate::vector::{beyond, cross, minus, norm, worse};

/// Largest violations of geometry and of Newton's laws, dimensionless.
///
/// A bar's balance is measured against its own forces, those of its two ends and its weight: the
/// least of the bars has to be in balance, whatever the others carry. The chain as a whole is
/// measured against the larger of the total weight and the largest joint force, and so are bars
/// that are proved to carry nothing. Of forces counts what the rounding of the largest leaves
/// unexplained, for they are differences of it; of lengths and moments what that and the rounding
/// of the stored coordinates ([`stored_rounding_m`]) leave unexplained: it turns a short bar, far
/// from the origin, by more than any solver could help.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statics {
    /// Largest distance of an end joint from its anchor, in units of the total length.
    pub closure: f64,
    /// Largest change of length of a bar, in units of the total length.
    pub length: f64,
    /// Largest force left over on a bar, in units of its own forces.
    pub force: f64,
    /// Largest moment about its centre of weight left over on a bar, in units of its own forces ×
    /// its length.
    pub moment: f64,
    /// Force left over on the whole chain: both ground reactions and the total weight.
    pub balance: f64,
    /// Moment about joint 0 left over on the whole chain: the ground reaction at joint n and all
    /// weights, in units of force × the total length. Errors too small to show on any one of a
    /// million bars add up here.
    pub turn: f64,
    /// The bar (from 1) with the largest violation of its own.
    pub worst_bar: usize,
}

/// A coordinate is rounded when it is stored, and two of them are subtracted: a few units in the
/// last place of the largest.
const STORED_ULPS: f64 = 8.0;

/// A joint force is a sum of weights and of the force at an anchor: a few units in the last place
/// of the largest.
const FORCE_ULPS: f64 = 8.0;

/// Rounding of the joints' coordinates, m: they are stored in the world frame, however far from its
/// origin the anchors are.
#[must_use]
pub fn stored_rounding_m(chain: &Chain) -> f64 {
    let anchors = chain.anchors();
    let coordinates = anchors.start_m.iter().chain(&anchors.end_m);
    let farthest = coordinates.fold(chain.total_length_m(), |most, x| most.max(x.abs()));
    STORED_ULPS * f64::EPSILON * farthest
}

impl Statics {
    /// The largest violation; NaN if any number of the answer is not finite or missing.
    #[must_use]
    pub fn largest(&self) -> f64 {
        [self.closure, self.length, self.force, self.moment, self.balance, self.turn]
            .into_iter()
            .fold(0.0, worse)
    }

    /// Whether every violation is within the tolerance. NaN never is.
    #[must_use]
    pub fn passes(&self, tolerance: f64) -> bool {
        self.largest() <= tolerance
    }
}

/// Judge an answer.
///
/// Arrays that do not fit the chain, and numbers that are not finite, give NaN, which passes no
/// tolerance.
///
/// ```
/// use model::{Anchors, Bar, Chain};
/// use validate::statics::judge;
/// // Two bars of 1 m and 1 N hang as a triangle of equal sides.
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
/// let chain = Chain::new("triangle", 1.0, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 2])?;
/// let joints = [[0.0; 3], [0.5, 0.0, -0.75_f64.sqrt()], [1.0, 0.0, 0.0]];
/// // Moments about the joint: 1 N at the anchor, less the weight half way, is half a newton.
/// let across = 0.25 / 0.75_f64.sqrt();
/// let forces = [[-across, 0.0, 1.0], [across, 0.0, 0.0], [across, 0.0, 1.0]];
/// assert!(judge(&chain, &joints, &forces).passes(1e-15));
/// // A thousandth of a newton that is not there is found.
/// let wrong = [[-across, 0.0, 1.001], forces[1], forces[2]];
/// assert!((judge(&chain, &joints, &wrong).force - 1e-3).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn judge(chain: &Chain, joints_m: &[Vector], multipliers_n: &[Vector]) -> Statics {
    let bars = chain.bars();
    let (Some(first), Some(last)) = (joints_m.first(), joints_m.last()) else { return unusable() };
    if joints_m.len() != bars.len() + 1 || multipliers_n.len() != bars.len() + 1 {
        return unusable();
    }
    let length_m = chain.total_length_m();
    let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
    let unit_n = multipliers_n.iter().map(|f| norm(*f)).fold(weight_n, worse);
    let anchors = chain.anchors();
    let rounding_m = stored_rounding_m(chain);

    let off = worse(norm(minus(*first, anchors.start_m)), norm(minus(*last, anchors.end_m)));
    let mut found = Statics {
        closure: beyond(off, rounding_m) / length_m,
        length: 0.0,
        force: 0.0,
        moment: 0.0,
        balance: whole_chain(multipliers_n, weight_n) / unit_n,
        turn: beyond(whole_turn(chain, joints_m, multipliers_n) / unit_n, rounding_m) / length_m,
        worst_bar: 1,
    };
    let rounding = Rounding { place_m: rounding_m, force_n: FORCE_ULPS * f64::EPSILON * unit_n };
    let idle = free_joints(chain, joints_m).map_or(0..0, |(bars, _)| bars);
    let mut worst = 0.0;
    for i in 0..bars.len() {
        let bar = LoadedBar::new(chain, i, joints_m, multipliers_n);
        let scale_n = if idle.contains(&i) { unit_n } else { bar.largest_n() };
        let length = bar.stretch(&rounding) / length_m;
        let force = part(bar.force_left(&rounding), scale_n);
        let moment = part(bar.moment_left(&rounding), scale_n * bar.length_m);
        found.length = worse(found.length, length);
        found.force = worse(found.force, force);
        found.moment = worse(found.moment, moment);
        let here = [length, force, moment].into_iter().fold(0.0, worse);
        if worse(worst, here).to_bits() != f64::to_bits(worst) {
            (worst, found.worst_bar) = (here, i + 1);
        }
    }
    found
}

/// What roundings explain.
struct Rounding {
    /// Of a coordinate, m.
    place_m: f64,
    /// Of a joint force, N.
    force_n: f64,
}

/// A bar with the forces on it.
struct LoadedBar {
    length_m: f64,
    /// From its first to its second joint, m.
    along: Vector,
    /// Where its weight is, as a part of the length.
    centre_part: f64,
    weight_n: f64,
    /// On it at its first joint, N.
    before: Vector,
    /// On it at its second joint, N.
    after: Vector,
}

impl LoadedBar {
    fn new(chain: &Chain, i: usize, joints_m: &[Vector], multipliers_n: &[Vector]) -> Self {
        let bar = &chain.bars()[i];
        let before = multipliers_n[i];
        Self {
            length_m: bar.length_m(),
            along: minus(joints_m[i + 1], joints_m[i]),
            centre_part: centre_part(bar),
            weight_n: bar.mass_kg() * chain.gravity_m_s2(),
            before: if i == 0 { before } else { before.map(|x| -x) },
            after: multipliers_n[i + 1],
        }
    }

    /// Its largest force, N.
    fn largest_n(&self) -> f64 {
        [norm(self.before), norm(self.after)].into_iter().fold(self.weight_n, worse)
    }

    /// Change of its length, m.
    fn stretch(&self, rounding: &Rounding) -> f64 {
        beyond((norm(self.along) - self.length_m).abs(), rounding.place_m)
    }

    /// Sum of its forces, N.
    fn force_left(&self, rounding: &Rounding) -> f64 {
        let sum: [f64; 3] = std::array::from_fn(|k| self.before[k] + self.after[k]);
        beyond(norm([sum[0], sum[1], sum[2] - self.weight_n]), rounding.force_n)
    }

    /// Sum of their moments about its centre of weight, N m.
    fn moment_left(&self, rounding: &Rounding) -> f64 {
        let turn = minus(
            cross(self.along.map(|x| x * (1.0 - self.centre_part)), self.after),
            cross(self.along.map(|x| x * self.centre_part), self.before),
        );
        // A displaced end of the bar turns it: force times displacement.
        let explained = rounding.place_m * self.largest_n() + rounding.force_n * self.length_m;
        beyond(norm(turn), explained)
    }
}

/// What a violation is of its unit; nothing is no part of nothing.
fn part(violation: f64, unit: f64) -> f64 {
    if violation <= 0.0 { 0.0 } else { violation / unit }
}

/// Force left over on the chain as a whole.
fn whole_chain(multipliers_n: &[Vector], weight_n: f64) -> f64 {
    let (start, end) = (multipliers_n[0], multipliers_n[multipliers_n.len() - 1]);
    norm([start[0] + end[0], start[1] + end[1], sum([start[2], end[2], -weight_n])])
}

/// Moment about joint 0 left over on the chain as a whole, by compensated sums.
fn whole_turn(chain: &Chain, joints_m: &[Vector], multipliers_n: &[Vector]) -> f64 {
    let last = joints_m.len() - 1;
    let origin = joints_m[0];
    let end = cross(minus(joints_m[last], origin), multipliers_n[last]);
    let weights = |axis: usize| {
        chain.bars().iter().enumerate().map(move |(i, bar)| {
            let part = centre_part(bar);
            let from = joints_m[i][axis] - origin[axis];
            let along = joints_m[i + 1][axis] - joints_m[i][axis];
            bar.mass_kg() * chain.gravity_m_s2() * (from + part * along)
        })
    };
    // (x, y, z) x (0, 0, -w) = (-y w, x w, 0)
    norm([
        sum(weights(1).map(|moment| -moment).chain([end[0]])),
        sum(weights(0).chain([end[1]])),
        end[2],
    ])
}

fn unusable() -> Statics {
    let nan = f64::NAN;
    Statics {
        closure: nan,
        length: nan,
        force: nan,
        moment: nan,
        balance: nan,
        turn: nan,
        worst_bar: 0,
    }
}

#[cfg(test)]
mod tests;
