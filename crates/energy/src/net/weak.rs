//! Forces and directions where the rounding of places is felt: from displacements, not from places.
//!
//! The excess of a stiff member under a weak load is the small difference of two lengths, and a short
//! member far from the origin has few digits of its direction. Here both are
//! taken from the place at which a joint stands, `x`, and a displacement `u` from there that may be
//! smaller than the last digit of `x`:
//!
//! `c = (|X|² - l² + 2 X·u + u·u) / (|X + u| + l)`, `X` the difference of the ends,
//!
//! with `|X|² - l²` from exact products, in metres, so that anchors and lengths are those of the file
//! to the last digit. The energy of the displacements is quadratic but for
//! rounding, with the members' own stiffnesses, or stiff springs where none has its own; its minimum gives the
//! forces, and is found by steps with one factorisation. Where lengths overdetermine the shape the part of the excesses that no
//! change of it takes off is left out.

use std::ops::Add;

use model::Vector;
use model::system::{Kind, System};

use crate::net::factor::Factor;
use crate::net::frame::{Frame, Rod};
use crate::net::law::Excess;
use crate::net::limit::{Limit, share_forces};
use crate::net::polish::{NEUTRAL, STIFF_STRAIN, STIFFER};
use crate::net::shape::{NO_STRAIN, Shape, largest};
use crate::thresholds::{PROGRESS, SETTLED};
use crate::twofold::Twofold;
use crate::vector::{along, dot, norm, scaled};

/// Joints that are out of balance by this part of the forces that meet there need nothing more,
const BALANCED: f64 = 2.5e-12;

/// which count as no less and no more than so many times the load there, or the mean load where it has none.
const BORNE: [f64; 2] = [1e-2, 1e2];

/// Displacements from the places of a shape, m.
struct Displaced<'a> {
    frame: &'a Frame,
    /// Unstretched length of each member.
    lengths: &'a [f64],
    x: &'a [Vector],
    u: Vec<Vector>,
    /// Of each member what no change of the shape takes off its excess.
    off: Vec<f64>,
    /// Axial forces in the unit of the frame.
    force: Vec<f64>,
}

/// A shape settled to rounding.
pub(super) struct Settled {
    pub(super) shape: Shape,
    /// For each member the derivative of its excess by the place of its end: its direction.
    pub(super) along: Vec<Vector>,
}

impl Settled {
    /// A shape as it is.
    pub(super) fn as_is(frame: &Frame, shape: Shape) -> Self {
        let along = frame.excesses(&shape.x).iter().map(|excess| excess.gradient).collect();
        Self { shape, along }
    }
}

/// The shape with forces and directions settled to rounding.
pub(super) fn settled(
    system: &System,
    frame: &Frame,
    factor: &mut Factor,
    shape: Shape,
    limit: Option<&Limit>,
) -> Settled {
    let rigid = frame.rigid(frame.force_scale(&shape.force) / STIFF_STRAIN);
    let excess = frame.excesses(&shape.x);
    let rods = frame.rods.iter().zip(&shape.force);
    let active: Vec<bool> = rods.map(|(rod, force)| rod.resists(*force)).collect();
    let lengths: Vec<f64> = system.members().iter().map(|m| m.body.length_m()).collect();
    let (x, u): (Vec<_>, Vec<_>) =
        (0..shape.x.len()).map(|k| place_m(system, frame, &shape, k)).unzip();
    let off = vec![0.0; frame.rods.len()];
    let mut here =
        Displaced { frame, lengths: &lengths, off, x: &x, u, force: shape.force.clone() };
    // The spans of a rope are long beside what it is longer, and what is rigid beside them is as they are.
    let elastic = frame.ropes.is_empty() && frame.rods.iter().any(Rod::elastic);
    let mut shared = None;
    if let Some(limit) = limit {
        let Some(mut share) = limit.share(frame, &shape, &active).filter(|_| elastic) else {
            return Settled::as_is(frame, shape);
        };
        here.off = share.in_no_shape(|e| here.excess(e).0);
        shared = Some(share);
    }
    let mut error = here.error(&active);
    if error <= 1.0 {
        return Settled::as_is(frame, shape);
    }
    let neutral = NEUTRAL * frame.largest_force(&shape.force);
    // Lengths that the shape hardly feels need stiffer springs beside elastic members.
    for stiffer in 0..if elastic { 3 } else { 1 } {
        let rigid = rigid * STIFFER.powi(-stiffer);
        let stiffness = |e: usize| match (active[e], frame.rods[e].elastic()) {
            (false, _) => 0.0,
            (true, true) => 1.0 / frame.rods[e].flexibility,
            (true, false) => rigid / frame.rods[e].length,
        };
        frame.fill(factor, |e| excess[e].block(shape.force[e], stiffness(e)), |_| neutral);
        if !factor.definite() {
            break;
        }
        // Few steps are enough, of which each leaves a part of the error.
        loop {
            let next = here.stepped(factor, &active, &stiffness);
            let left = next.error(&active);
            // NaN is no progress.
            if left.is_nan() || left >= PROGRESS * error {
                break;
            }
            (here, error) = (next, left);
        }
    }
    // Which of those that are just taut resist was read from rounded places.
    let least = SETTLED * frame.largest_force(&here.force);
    let turned = |(e, rod): (usize, &Rod)| {
        let by_law = here.excess(e).0 / rod.flexibility;
        let one_sided = rod.elastic() && rod.kind != Kind::Bar && rod.rope == 0;
        one_sided && by_law.abs() > least && rod.resists(by_law) != active[e]
    };
    if frame.rods.iter().enumerate().any(turned) {
        return Settled::as_is(frame, shape);
    }
    if let Some(mut share) = shared {
        // Rounding beside stiff springs is a self-stress.
        let found = here.force.clone();
        share_forces(frame, &mut share, &mut here.force);
        if here.error(&active) > error.max(1.0) {
            here.force = found;
        }
    }
    let back = |(x, u): (&Vector, &Vector)| -> Vector {
        std::array::from_fn(|k| ((x[k] - frame.origin_m[k]) + u[k]) / frame.length_m)
    };
    let along = (0..frame.rods.len()).map(|e| here.excess(e).1).collect();
    let x = here.x.iter().zip(&here.u).map(back).collect();
    Settled { shape: Shape { x, force: here.force }, along }
}

/// Where a joint of a shape is, m, and what rounding cuts off; an anchor is where it is held.
fn place_m(system: &System, frame: &Frame, shape: &Shape, joint: usize) -> (Vector, Vector) {
    let at_m = system.joints().get(joint).and_then(|joint| joint.support.at_m());
    let (from_m, base) = match at_m {
        Some(at_m) => (at_m, frame.supports[joint]),
        None => (frame.origin_m, [0.0; 3]),
    };
    let at = |k: usize| (shape.x[joint][k] - base[k]) * frame.length_m;
    let sums: [[f64; 2]; 3] = std::array::from_fn(|k| Twofold::sum(from_m[k], at(k)).parts());
    (sums.map(|sum| sum[0]), sums.map(|sum| sum[1]))
}

impl Displaced<'_> {
    /// What the excess of a member is, and its direction.
    fn excess(&self, e: usize) -> (f64, Vector) {
        let rod = &self.frame.rods[e];
        let apart = along(self.u[rod.to], -1.0, self.u[rod.from]);
        let ends = (self.x[rod.to], self.x[rod.from]);
        let span_m = along(self.frame.span(self.x, e), 1.0, apart);
        let unit = 1.0 / self.frame.length_m;
        let whole: Excess = rod.excess(scaled(unit, span_m));
        if rod.rope > 0 {
            let moved = |strand: usize| {
                let Rod { from, to, .. } = self.frame.rods[strand];
                along(self.frame.span(self.x, strand), 1.0, along(self.u[to], -1.0, self.u[from]))
            };
            let length_m = self.frame.whole(e, |strand| norm(moved(strand)));
            return (length_m * unit - rod.length, whole.gradient);
        }
        let Some(&length_m) = self.lengths.get(e) else { return (whole.value, whole.gradient) };
        let squares = difference_of_squares(ends, apart, length_m);
        let both = if rod.elastic() { norm(span_m) + length_m } else { 2.0 * length_m };
        (squares / both * unit - self.off[e], whole.gradient)
    }

    /// The largest unbalanced force over what counts as none at its joint, or error of the force of an elastic
    /// member over what counts as none.
    fn error(&self, active: &[bool]) -> f64 {
        let (frame, rest) = (self.frame, self.gradient(|e| self.force[e]));
        let mean = frame.loads.iter().map(|load| norm(*load)).sum::<f64>() / frame.joints as f64;
        let meeting = frame.meeting(&self.force);
        let unbalance = frame.spots.iter().enumerate().map(|(joint, spot)| {
            let load = frame.loads.get(joint).map_or(0.0, |load| norm(*load));
            let own = if load > 0.0 { load } else { mean };
            let most = if own > 0.0 { BORNE[1] * own } else { f64::INFINITY };
            let scale = meeting[joint].min(most).max(BORNE[0] * own).max(NO_STRAIN);
            largest(&rest[spot.first..spot.first + spot.freedom]) / scale
        });
        let elastic = frame.rods.iter().filter(|rod| rod.elastic()).map(|rod| rod.flexibility);
        let stiffest = elastic.fold(f64::INFINITY, f64::min);
        let rods = frame.rods.iter().enumerate().filter(|(e, _)| active[*e]);
        // Of what is rigid a length that is off is felt by the stiffest spring beside it.
        let laws = rods.map(|(e, rod)| {
            if rod.elastic() {
                (self.excess(e).0 / rod.flexibility - self.force[e]).abs()
            } else if frame.ropes.is_empty() {
                self.excess(e).0.abs() / stiffest
            } else {
                0.0
            }
        });
        let laws = laws.fold(0.0, f64::max) / frame.largest_force(&self.force);
        (unbalance.fold(0.0, f64::max) / BALANCED).max(laws / SETTLED)
    }

    fn gradient(&self, force: impl Fn(usize) -> f64) -> Vec<f64> {
        self.frame.gradient(|e| scaled(force(e), self.excess(e).1))
    }

    /// After one step with the factorisation at hand.
    fn stepped(
        &self,
        factor: &mut Factor,
        active: &[bool],
        stiffness: &impl Fn(usize) -> f64,
    ) -> Self {
        let frame = self.frame;
        // An elastic member has the force of its excess, an inextensible one more than it had.
        let force: Vec<f64> = (0..frame.rods.len())
            .map(|e| {
                let own = if frame.rods[e].elastic() { 0.0 } else { self.force[e] };
                if active[e] { own + stiffness(e) * self.excess(e).0 } else { 0.0 }
            })
            .collect();
        let step = factor.step_against(self.gradient(|e| force[e]));
        let change = |e: usize| {
            frame.whole(e, |strand| dot(self.excess(strand).1, frame.relative(&step, strand)))
        };
        let force = (0..force.len()).map(|e| force[e] + stiffness(e) * change(e)).collect();
        let u = frame.moved(&self.u, frame.length_m, &step);
        Self { frame, lengths: self.lengths, off: self.off.clone(), x: self.x, u, force }
    }
}

/// `|X + u|² - l²` for `X` from one place to another.
fn difference_of_squares((to, from): (Vector, Vector), apart: Vector, length: f64) -> f64 {
    let length = Twofold::from(length);
    let square = |k: usize| {
        let span = Twofold::sum(to[k], -from[k]) + Twofold::from(apart[k]);
        span * span
    };
    (0..3).map(square).fold(-(length * length), Add::add).value()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_differ_by_what_the_ends_moved() {
        // 2, 3, 6 is 7 long; moved by e along itself it is (7 + e)² - 49 = 14 e + e².
        for e in [1e-2, 1e-9, 1e-18, 1e-25] {
            let u = [2.0, 3.0, 6.0].map(|x: f64| x / 7.0 * e);
            let found = difference_of_squares(([2.0, 3.0, 6.0], [0.0; 3]), u, 7.0);
            assert!((found / (14.0 * e + e * e) - 1.0).abs() < 1e-14, "{e}: {found}");
        }
        let across = difference_of_squares(([2.0, 0.0, 0.0], [0.0; 3]), [0.0, 1e-9, 0.0], 2.0);
        assert!((across / 1e-18 - 1.0).abs() < 1e-14);
    }

    /// A member of 7 m from (1, 2, 3) whose end is moved to 7.07 m along (2, 3, 6): a spring is 0.07 m too long, of
    /// a rigid one it is the difference of the squares over 14 m, 0.07 + 0.07^2/14. The law of a spring of 50 N
    /// wants 1/2 N.
    #[test]
    fn excesses_are_those_of_the_moved_ends() {
        use model::Bar;
        use model::system::{Joint, Member};
        let foot = [1.0, 2.0, 3.0];
        let joints = vec![
            Joint::anchor("A", foot),
            Joint::free("P").with_force([4.0 / 7.0, 6.0 / 7.0, 12.0 / 7.0 + 10.0]),
            Joint::free("Q").with_mass(1.0),
        ];
        let bar = |from, to, length_m| {
            Member::bar(from, to, Bar::homogeneous(length_m, 0.0).expect("a bar"))
        };
        for (stiffness_n, wanted_m) in [(Some(50.0), 0.07), (None, 0.07 + 0.07 * 0.07 / 14.0)] {
            let members = vec![
                bar(0, 1, 7.0).with_stiffness(stiffness_n),
                bar(1, 2, 3.0).with_stiffness(9.0),
            ];
            let system = System::new("moved", 10.0, joints.clone(), members).expect("a system");
            let frame = Frame::new(&system).expect("a frame");
            let by = |part: f64| -> Vector {
                std::array::from_fn(|k| foot[k] + part * [2.0, 3.0, 6.0][k])
            };
            let x = [foot, by(1.0), [by(1.0)[0], by(1.0)[1], by(1.0)[2] - 3.0]];
            let moved = [2.0, 3.0, 6.0].map(|x: f64| 0.01 * x);
            let force = |newtons: f64| vec![newtons / frame.force_n, 10.0 / frame.force_n];
            let displaced = |newtons: f64| Displaced {
                frame: &frame,
                lengths: &[7.0, 3.0],
                off: vec![0.0; 2],
                x: &x,
                u: vec![[0.0; 3], moved, moved],
                force: force(newtons),
            };
            let (value, gradient) = displaced(1.0).excess(0);
            assert!((value * frame.length_m - wanted_m).abs() < 1e-14, "{value} {wanted_m}");
            // The law of a rigid one is that of squares, steeper by the stretch.
            let steep = if stiffness_n.is_some() { 1.0 } else { 1.01 };
            let wanted = [2.0, 3.0, 6.0].map(|x: f64| steep * x / 7.0);
            assert!((0..3).all(|k| (gradient[k] - wanted[k]).abs() < 1e-14), "{gradient:?}");
            let Some(stiffness_n) = stiffness_n else { continue };
            // 10 N at Q; with 2 N along the spring P is at rest as well, and the law is what is wrong; by the law it is half
            // a newton.
            let law_n = stiffness_n * 0.01;
            for newtons in [2.0, law_n] {
                let here = displaced(newtons);
                let unbalance = largest(&here.gradient(|e| here.force[e]));
                let at_joints = unbalance * frame.force_n / (newtons + 10.0) / BALANCED;
                let off = (law_n - newtons).abs() / frame.force_n;
                let law = off / frame.largest_force(&here.force) / SETTLED;
                assert_eq!(law > at_joints, newtons > 1.0, "{law} {at_joints}");
                let (found, wanted) = (here.error(&[true, false]), law.max(at_joints));
                assert!((found / wanted - 1.0).abs() < 1e-9, "{found} {wanted}");
            }
        }
    }

    /// 2 mN under a rod under a spring of 1 TN from (1, 2, 3), which stretches it by 2e-15 m, far less than a digit of
    /// its place: both bear the load, whatever they are said to bear.
    #[test]
    fn forces_are_settled_where_places_are_rounded() {
        use model::Bar;
        use model::system::{Joint, Member};
        let joints = vec![
            Joint::anchor("A", [1.0, 2.0, 3.0]),
            Joint::free("P"),
            Joint::free("Q").with_force([0.0, 0.0, -2e-3]),
        ];
        let bar = |from, to, length_m| {
            Member::bar(from, to, Bar::homogeneous(length_m, 0.0).expect("a bar"))
        };
        let members = vec![bar(0, 1, 1.0).with_stiffness(1e12), bar(1, 2, 0.5)];
        let system = System::new("weak", 10.0, joints, members).expect("a system");
        let frame = Frame::new(&system).expect("a frame");
        let place = |z: f64| -> Vector {
            std::array::from_fn(|k| ([1.0, 2.0, z][k] - frame.origin_m[k]) / frame.length_m)
        };
        for said in [[1.03, 0.98], [0.5, 2.0]] {
            let shape = Shape {
                x: [3.0, 2.0, 1.5].map(place).to_vec(),
                force: said.map(|part| part * 2e-3 / frame.force_n).to_vec(),
            };
            let mut factor =
                Factor::new(&frame.spots, &frame.rods, &frame.meter).expect("a factor");
            let found = settled(&system, &frame, &mut factor, shape, None).shape;
            for force in &found.force {
                let off = force * frame.force_n / 2e-3 - 1.0;
                assert!(off.abs() < 1e-9, "{said:?}: off by {off:e}");
            }
        }
    }
}
