//! Forces held against what the problem brings, not against the answer.
//!
//! The scale of a joint is its load, or the mean load of all joints where it has none: what is light
//! might lie anywhere beside what is heavy. Of a system without loads it is the largest force of an
//! elastic member. A force found is no scale: an absurd
//! one would forgive everything.

use model::system::System;

use crate::error::Error;
use crate::net::frame::Frame;
use crate::net::polish::rounding_floor;
use crate::net::shape::{NO_STRAIN, Shape, largest};
use crate::net::weak::Settled;
use crate::vector::{norm, scaled};

/// Unbalanced force at a joint over its scale that counts as balance: a quarter of what two solvers are
/// asked to agree to.
const BALANCE: f64 = 2.5e-10;

/// Rounding of a force over the loads from which on the forces say nothing.
const ABSURD: f64 = 1e-6;
/// A strand shorter than this part of its rope, where nothing converges, has run to its end.
const JAMMED: f64 = 1e-2;

#[derive(Debug, Clone, Copy)]
pub(super) struct Balance {
    /// Unbalanced force over the scale of the joint.
    pub(super) unbalance: f64,
    /// What that may be: the tolerance of the search in that unit, which is over the largest force,
    /// but no more than [`BALANCE`]; and the rounding of the forces that meet there.
    pub(super) allowed: f64,
}

impl Frame {
    /// The largest force of an elastic member: the prestress, where no load acts.
    fn elastic_force(&self, shape: &Shape) -> f64 {
        let elastic = self.rods.iter().zip(&shape.force).filter(|(rod, _)| rod.elastic());
        elastic.fold(0.0, |most, (_, force)| force.abs().max(most))
    }

    /// Whether a strand of a rope has next to no length, where nothing converges.
    pub(super) fn jam(&self, shape: &Shape) -> Option<Error> {
        let part = |e: usize| norm(self.span(&shape.x, e)) / self.rods[e].length;
        let spans = self.ropes.iter().flatten().copied();
        let short = spans.filter(|e| !self.is_held(&self.rods[*e]) && part(*e) <= JAMMED);
        let shortest = short.min_by(|a, b| part(*a).total_cmp(&part(*b)))?;
        let member = self.member_of(shortest);
        let rope = &self.ropes[self.rods[shortest].rope as usize - 1];
        let span = rope.iter().position(|e| *e == shortest)? + 1;
        Some(Error::Jammed { member: member + 1, span })
    }

    /// Forces whose rounding is a part [`ABSURD`] of all loads and of the prestress, or more.
    pub(super) fn absurd(&self, shape: &Shape) -> Option<Error> {
        let loads: f64 = self.loads.iter().map(|load| norm(*load)).sum();
        let scale = loads.max(self.elastic_force(shape)).max(NO_STRAIN);
        let ratio = largest(&shape.force) / scale;
        let worst = |(a, b): (&f64, &f64)| a.abs().total_cmp(&b.abs());
        let mut members = (0..self.members).map(|e| (e, &shape.force[e]));
        let first = members.next()?;
        let (member, _) = members
            .fold(first, |most, next| if worst((most.1, next.1)).is_lt() { next } else { most });
        (rounding_floor(self, shape) * ratio > ABSURD)
            .then_some(Error::Absurd { member: member + 1, ratio })
    }

    /// The sum of the forces of the members that meet at each joint.
    pub(super) fn meeting(&self, force: &[f64]) -> Vec<f64> {
        let mut forces = vec![0.0; self.spots.len()];
        for (rod, force) in self.rods.iter().zip(force) {
            forces[rod.from] += force.abs();
            forces[rod.to] += force.abs();
        }
        forces
    }

    /// The balance of the joint that is worst held against what it may be; refused where it is more.
    ///
    /// What the rounding of the forces at a joint leaves is allowed: of places of size `X` the
    /// direction of a member of length `l` has `X / l` units in the last place.
    pub(super) fn balance(
        &self,
        system: &System,
        Settled { shape, along }: &Settled,
        tolerance: f64,
    ) -> Result<Balance, Error> {
        let unbalance = self.gradient(|e| scaled(shape.force[e], along[e]));
        let loads: Vec<f64> = self.loads.iter().map(|load| norm(*load)).collect();
        let mean = loads.iter().sum::<f64>() / self.joints as f64;
        let least = if mean > 0.0 { mean } else { self.elastic_force(shape) };
        let forces = self.meeting(&shape.force);
        let rounding = rounding_floor(self, shape);
        let searched = tolerance.max(rounding);
        let most = self.force_scale(&shape.force);
        let mut worst = Balance { unbalance: 0.0, allowed: searched };
        for (joint, spot) in self.spots.iter().enumerate() {
            let own = if loads[joint] > 0.0 { loads[joint] } else { least };
            let scale = own.max(NO_STRAIN);
            let rest = largest(&unbalance[spot.first..spot.first + spot.freedom]);
            let rounded = rounding * forces[joint] / scale;
            let kept = tolerance.max(BALANCE);
            let allowed = (searched * most / scale).min(kept) + rounded;
            let here = Balance { unbalance: rest / scale, allowed };
            if here.unbalance > kept + rounded {
                let joint = system.joints()[joint].name.to_string();
                return Err(Error::Unbalanced { joint, unbalance: here.unbalance });
            }
            if here.unbalance * worst.allowed > worst.unbalance * here.allowed {
                worst = here;
            }
        }
        Ok(worst)
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member};

    use super::*;

    /// P of 2 kg hangs 1 m below A, and Q of 0.5 g 2 m below P: upright members bear 20.005 N and 5 mN.
    fn hung(forces_n: [f64; 2]) -> (System, Frame, Shape) {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("P").with_mass(2.0),
            Joint::free("Q").with_mass(5e-4),
        ];
        let bar =
            |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
        let system =
            System::new("hung", 10.0, joints, vec![bar(0, 1, 1.0), bar(1, 2, 2.0)]).unwrap();
        let frame = Frame::new(&system).unwrap();
        let place = |z_m: f64| {
            let away = |k: usize, x: f64| (x - frame.origin_m[k]) / frame.length_m;
            [away(0, 0.0), away(1, 0.0), away(2, z_m)]
        };
        let x = [0.0, -1.0, -3.0].map(place).to_vec();
        let force = forces_n.map(|force_n| force_n / frame.force_n).to_vec();
        (system, frame, Shape { x, force })
    }

    fn balance(
        system: &System,
        frame: &Frame,
        shape: &Shape,
        tolerance: f64,
    ) -> Result<Balance, Error> {
        frame.balance(system, &Settled::as_is(frame, shape.clone()), tolerance)
    }

    #[test]
    fn each_joint_is_held_to_its_own_load() {
        let (system, frame, shape) = hung([20.005, 0.005]);
        let held = balance(&system, &frame, &shape, 1e-12).unwrap();
        assert!(held.unbalance <= held.allowed && held.allowed < 1e-9, "{held:?}");
        // At P 2 N too much of 20 N; at Q 1e-6 N too much of 5 mN.
        for (forces_n, named, wanted) in
            [([22.005, 0.005], "P", 0.1), ([20.005_001, 0.005_001], "Q", 2e-4)]
        {
            let (system, frame, shape) = hung(forces_n);
            let refused = balance(&system, &frame, &shape, 1e-12);
            let Err(Error::Unbalanced { joint, unbalance }) = refused else {
                panic!("{refused:?}")
            };
            assert_eq!(joint, named);
            assert!((unbalance / wanted - 1.0).abs() < 1e-9, "{unbalance}");
        }
        // A joint without a load is held to the mean of all three: 1 N of 10 N.
        let joints =
            vec![Joint::anchor("A", [0.0; 3]), Joint::free("P"), Joint::free("Q").with_mass(3.0)];
        let light = |from, to| Member::bar(from, to, Bar::homogeneous(1.0, 0.0).unwrap());
        let system = System::new("idle", 10.0, joints, vec![light(0, 1), light(1, 2)]).unwrap();
        let frame = Frame::new(&system).unwrap();
        let x = [0.0, -1.0, -2.0].map(|z| [0.0, 0.0, (z - frame.origin_m[2]) / frame.length_m]);
        let force = [31.0, 30.0].map(|force_n| force_n / frame.force_n).to_vec();
        let refused = balance(&system, &frame, &Shape { x: x.to_vec(), force }, 1e-12);
        let Err(Error::Unbalanced { joint, unbalance }) = refused else { panic!("{refused:?}") };
        assert!(joint == "P" && (unbalance - 0.1).abs() < 1e-9, "{joint} {unbalance}");
        // A tolerance is allowed, of either joint's own load.
        let (system, frame, shape) = hung([20.005 + 1e-4, 0.005 + 1e-8]);
        let held = balance(&system, &frame, &shape, 1e-5).unwrap();
        assert!(held.unbalance > 1e-6 && held.unbalance < 1e-5, "{held:?}");
    }

    /// Two springs of 1 m and 2 m, 40 N, between anchors 4 m apart, without weight: stretched to 1.5 m and 2.5 m
    /// they pull with 20 N and 10 N. What is left is held to the larger one.
    #[test]
    fn without_loads_the_prestress_is_the_scale() {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("P"),
            Joint::anchor("B", [0.0, 0.0, -4.0]),
        ];
        let spring = |from, to, length_m| {
            Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap()).with_stiffness(40.0)
        };
        let members = vec![spring(0, 1, 1.0), spring(1, 2, 2.0)];
        let system = System::new("string", 10.0, joints, members).unwrap();
        let frame = Frame::new(&system).unwrap();
        let x = [0.0, -1.5, -4.0].map(|z| [0.0, 0.0, (z - frame.origin_m[2]) / frame.length_m]);
        let force: Vec<f64> = [20.0, 10.0].map(|force_n| force_n / frame.force_n).to_vec();
        let shape = Shape { x: x.to_vec(), force };
        assert!((frame.elastic_force(&shape) * frame.force_n - 20.0).abs() < 1e-12);
        let refused = balance(&system, &frame, &shape, 1e-12);
        let Err(Error::Unbalanced { joint, unbalance }) = refused else { panic!("{refused:?}") };
        assert!(joint == "P" && (unbalance - 0.5).abs() < 1e-12, "{joint} {unbalance}");
        assert!(frame.absurd(&shape).is_none());
    }

    /// Of a rope of 4 m a strand of 5 cm is more than a hundredth, however long what hangs on it.
    #[test]
    fn strands_are_short_beside_their_ropes() {
        let line = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [3.0, 0.0, 0.0]),
            Joint::free("P").with_mass(1.0),
            Joint::free("Q").with_mass(1.0),
        ];
        let members =
            vec![Member::cable(0, 1, line(4.0)).over(vec![2]), Member::bar(2, 3, line(9.0))];
        let frame = Frame::new(&System::new("rope", 10.0, joints, members).unwrap()).unwrap();
        for (strand_m, jams) in [(0.05, false), (0.03, true)] {
            let x = [[0.0; 3], [3.0, 0.0, 0.0], [strand_m, 0.0, 0.0], [strand_m, 0.0, -9.0]];
            let away =
                |at: [f64; 3]| [0, 1, 2].map(|k| (at[k] - frame.origin_m[k]) / frame.length_m);
            let shape = Shape { x: x.map(away).to_vec(), force: vec![1.0; frame.rods.len()] };
            let found = frame.jam(&shape);
            assert_eq!(matches!(found, Some(Error::Jammed { member: 1, span: 1 })), jams);
        }
    }
}
