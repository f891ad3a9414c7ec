//! The axial force along a member that bears weight: not the same at both ends.

use crate::system::{Kind, System, SystemEquilibrium};
use crate::{Anchors, Vector};

/// The axial force of a member at its ends and its extremes along the member, N, tension positive.
///
/// A member that is not level carries its own weight along itself: a rope that hangs down pulls at its
/// upper end by its whole weight more than at its lower end. A dimension or a strength is to be
/// held against [`largest_n`](Self::largest_n), not against the force in the middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialForce {
    /// Where the member begins.
    pub from_n: f64,
    /// Where it ends.
    pub to_n: f64,
    /// The least along it.
    pub least_n: f64,
    /// The most along it.
    pub most_n: f64,
}

impl AxialForce {
    /// Of a member from `from_m` to `to_m` whose ends bear the forces `start_n` and `end_n` (on the member,
    /// N), and loads between them: at which part of its length, and which force, N.
    ///
    /// With the unit vector $u$ from its first joint to its second the axial force is
    /// $-S \cdot u$ at the first and falls by $P \cdot u$ at each load. A member without length has no
    /// direction: its axial force is `middle_n` everywhere.
    ///
    /// ```
    /// // A rope of 1 m and 10 N hangs down and carries 20 N.
    /// let rope = model::AxialForce::along(
    ///     ([0.0; 3], [0.0, 0.0, -1.0]), ([0.0, 0.0, 30.0], [0.0, 0.0, -20.0]), 25.0,
    ///     [(0.5, [0.0, 0.0, -10.0])],
    /// );
    /// assert_eq!((rope.from_n, rope.to_n, rope.largest_n()), (30.0, 20.0, 30.0));
    /// ```
    pub fn along(
        (from_m, to_m): (Vector, Vector),
        (start_n, end_n): (Vector, Vector),
        middle_n: f64,
        loads: impl IntoIterator<Item = (f64, Vector)>,
    ) -> Self {
        let d: Vector = std::array::from_fn(|k| to_m[k] - from_m[k]);
        let length_m = d[0].hypot(d[1]).hypot(d[2]);
        if length_m <= 0.0 {
            return Self { from_n: middle_n, to_n: middle_n, least_n: middle_n, most_n: middle_n };
        }
        let part = |force: Vector| (0..3).map(|k| force[k] * d[k]).sum::<f64>() / length_m;
        let (from_n, to_n) = (-part(start_n), part(end_n));
        let mut loads: Vec<(f64, f64)> =
            loads.into_iter().map(|(at, force)| (at, part(force))).collect();
        loads.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut here = from_n;
        let (mut least_n, mut most_n) = (from_n.min(to_n), from_n.max(to_n));
        // Behind the last load stands the force at the end, without the rounding of the sum.
        let inner = loads.len().saturating_sub(1);
        for (_, along) in loads.into_iter().take(inner) {
            here -= along;
            (least_n, most_n) = (least_n.min(here), most_n.max(here));
        }
        Self { from_n, to_n, least_n, most_n }
    }

    /// The larger of the two extremes, with its sign.
    pub fn largest_n(&self) -> f64 {
        if self.most_n >= -self.least_n { self.most_n } else { self.least_n }
    }
}

/// Loads in the order of their places, those at one place as one: no part of the member is between them.
fn by_place(mut loads: Vec<(f64, Vector)>) -> Vec<(f64, Vector)> {
    loads.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    loads.dedup_by(|(at, force), (before, sum)| {
        let is_same = at.total_cmp(before).is_eq();
        if is_same {
            sum.iter_mut().zip(force).for_each(|(sum, component)| *sum += *component);
        }
        is_same
    });
    loads
}

impl SystemEquilibrium {
    /// The axial force along every member.
    ///
    /// Spread loads, and the weight of a member whose centre is in its middle, put its extremes at other loads and ends; the
    /// weight of another one counts as acting at its centre. What [is idle](Self::is_idle) bears nothing along it:
    /// each joint carries its part of its weight.
    pub fn axial_forces(&self, system: &System) -> Vec<AxialForce> {
        (0..system.members().len()).map(|member| self.axial_force(system, member)).collect()
    }

    /// The same of one member, from 0.
    ///
    /// # Panics
    /// If the answer is not one of the system.
    pub fn axial_force(&self, system: &System, k: usize) -> AxialForce {
        if self.is_idle(system, k) || system.members()[k].rope.is_some() {
            // One tension from end to end, or none.
            return AxialForce::along(Default::default(), Default::default(), self.axial_n[k], []);
        }
        self.loaded_force(system, k)
    }

    /// Whether a cable is slack or a strut is loose: without force and away from its length, not just taut or just tight. What
    /// is just taut bears its weight as what is taut does: which of the two it is, is rounding, and this is the safe side.
    ///
    /// # Panics
    /// If the answer is not one of the system.
    pub fn is_idle(&self, system: &System, k: usize) -> bool {
        /// A member whose length is off by less than this part of it has it.
        const JUST: f64 = 1e-10;
        let member = &system.members()[k];
        let span_m = |[a, b]: [usize; 2]| {
            let [start_m, end_m] = [self.joints_m[a], self.joints_m[b]];
            Anchors { start_m, end_m }.span_m()
        };
        let longer = || member.spans().map(span_m).sum::<f64>() / member.body.length_m() - 1.0;
        self.axial_n[k].abs() <= 0.0
            && match member.kind {
                Kind::Bar => false,
                Kind::Cable => longer() < -JUST,
                Kind::Strut => longer() > JUST,
            }
    }

    /// The same of a member that is no rope, with its own loads, taut or not.
    pub(crate) fn loaded_force(&self, system: &System, k: usize) -> AxialForce {
        let member = &system.members()[k];
        let ends_m = (self.joints_m[member.from], self.joints_m[member.to]);
        let body = &member.body;
        let place = |at_m: f64| at_m / body.length_m();
        let centre = place(body.centre_m());
        let weight_n = [0.0, 0.0, -body.mass_kg() * system.gravity_m_s2()];
        let weight = ((centre - 0.5).abs() <= f64::EPSILON, centre, weight_n);
        let loads =
            member.loads.iter().map(|load| (load.is_spread, place(load.at_m), load.force_n));
        let (mut points, mut even_n) = (Vec::new(), [0.0; 3]);
        for (is_spread, at, force_n) in loads.chain([weight]) {
            if is_spread {
                even_n.iter_mut().zip(force_n).for_each(|(sum, component)| *sum += component);
            } else {
                points.push((at, force_n));
            }
        }
        let mut loads = by_place(points);
        if !loads.is_empty() && even_n.iter().any(|component| component.abs() > 0.0) {
            // What is spread between one load and the next: each load's jump is between two parts of it.
            let part_n = |part: f64| even_n.map(|component| part * component);
            let mut spread = Vec::with_capacity(2 * loads.len() + 1);
            let mut before = 0.0;
            for (at, force) in loads {
                spread.push((at, part_n(at - before)));
                spread.push((at, force));
                before = at;
            }
            spread.push((1.0, part_n(1.0 - before)));
            loads = spread;
        }
        let forces_n = (self.start_forces_n[k], self.end_forces_n[k]);
        AxialForce::along(ends_m, forces_n, self.axial_n[k], loads)
    }
}

impl crate::Equilibrium {
    /// The axial force along every bar: its ends have the extremes, since weight alone acts between
    /// them.
    pub fn axial_forces(&self) -> Vec<AxialForce> {
        let forces = self.multipliers_n.windows(2).enumerate();
        let joints = self.joints_m.windows(2).zip(&self.axial_n);
        joints
            .zip(forces)
            .map(|((ends_m, middle_n), (bar, forces))| {
                // Entry 0 is the force on bar 1, every other one the force on the bar before.
                let sign = if bar == 0 { 1.0 } else { -1.0 };
                let forces_n = (forces[0].map(|x| sign * x), forces[1]);
                AxialForce::along((ends_m[0], ends_m[1]), forces_n, *middle_n, [])
            })
            .collect()
    }
}
