//! The third judge: Newton's laws for every bar, from joint positions and joint forces alone.
//!
//! It knows nothing of angles, directions, multipliers' equations or energies: a bar is two points
//! and a weight between them, and the forces at its ends are what the answer says they are. Bar *i*
//! feels the force `f` of entry *i* at its far joint, and the opposite of entry *i*−1 at its near joint
//! (for bar 1 entry 0 itself, the force of the ground), and its weight:
//!
//! $$ F_{i-1} + F_i - m_i g\, e_z = 0, \qquad
//!    (x_{i-1} - x_{C_i}) \times F_{i-1} + (x_i - x_{C_i}) \times F_i = 0 . $$

use model::{Chain, Vector, sum};
use serde::Serialize;

/// Largest violations of geometry and of Newton's laws, dimensionless.
///
/// Forces are measured in units of the larger of the total weight and the largest joint force: a
/// nearly taut chain carries many times its weight, and its forces are differences of large ones.
/// Of lengths and moments counts what the rounding of the stored coordinates ([`stored_rounding_m`])
/// leaves unexplained: it turns a short bar, far from the origin, by more than any solver could help.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Statics {
    /// Largest distance of an end joint from its anchor, in units of the total length.
    pub closure: f64,
    /// Largest change of length of a bar, in units of the total length.
    pub length: f64,
    /// Largest force left over on a bar.
    pub force: f64,
    /// Largest moment about its centre of weight left over on a bar, in units of force × the length
    /// of that bar.
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
    let mut worst = 0.0;
    for (i, bar) in bars.iter().enumerate() {
        let along = minus(joints_m[i + 1], joints_m[i]);
        let before = if i == 0 { multipliers_n[0] } else { minus([0.0; 3], multipliers_n[i]) };
        let after = multipliers_n[i + 1];
        let weight = bar.mass_kg() * chain.gravity_m_s2();
        let left: Vector =
            [before[0] + after[0], before[1] + after[1], before[2] + after[2] - weight];
        let part = bar.centre_m() / bar.length_m();
        let turn = minus(
            cross(along.map(|x| x * (1.0 - part)), after),
            cross(along.map(|x| x * part), before),
        );
        let stretch = (norm(along) - bar.length_m()).abs();
        let bar_length = beyond(stretch, rounding_m) / length_m;
        let force = norm(left) / unit_n;
        // A displaced end of the bar turns it: force times displacement.
        let moment = beyond(norm(turn) / unit_n, rounding_m) / bar.length_m();
        found.length = worse(found.length, bar_length);
        found.force = worse(found.force, force);
        found.moment = worse(found.moment, moment);
        let here = [bar_length, force, moment].into_iter().fold(0.0, worse);
        if worse(worst, here).to_bits() != f64::to_bits(worst) {
            (worst, found.worst_bar) = (here, i + 1);
        }
    }
    found
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
            let part = bar.centre_m() / bar.length_m();
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

/// What of a violation is beyond the rounding; NaN stays NaN (`f64::max` would forget it).
fn beyond(violation: f64, rounding: f64) -> f64 {
    if violation <= rounding { 0.0 } else { violation - rounding }
}

/// The larger of two violations; NaN is the worst of all (`f64::max` would forget it).
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm([x, y, z]: Vector) -> f64 {
    x.hypot(y).hypot(z)
}
