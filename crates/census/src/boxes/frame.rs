//! Units in which lengths and forces of a system are of order one, and its loads in them.

use model::system::{Member, System};
use model::{Bar, Vector as Point};
use numerics::{Interval, lever};

use super::arithmetic::{NOWHERE, Vector, minus, plus, points, sum, times};

/// Powers of two, so that scaling rounds nothing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    /// Unit of length, m.
    pub(crate) length_m: f64,
    /// Unit of force, N.
    pub(crate) force_n: f64,
    /// The point from which places are counted, m.
    pub(crate) origin_m: Point,
}

/// The power of two next to a positive number, far from overflow and underflow.
fn power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    /// 2⁻⁵⁰⁰ and 2⁵⁰⁰: products of two are normal numbers.
    const SMALLEST: f64 = f64::from_bits((1023 - 500) << 52);
    const LARGEST: f64 = f64::from_bits((1023 + 500) << 52);
    f64::from_bits(x.clamp(SMALLEST, LARGEST).to_bits() & EXPONENT)
}

impl Frame {
    /// Units for a system with these axial forces.
    pub(crate) fn new(system: &System, axial_n: &[f64]) -> Self {
        let loads_n = system.total_load_n();
        let largest_n = axial_n.iter().fold(loads_n, |most, axial| most.max(axial.abs()));
        Self {
            length_m: power_of_two(system.total_length_m()),
            force_n: power_of_two(largest_n),
            origin_m: system.reference_m(),
        }
    }

    pub(crate) fn length(&self, metres: Interval) -> Interval {
        metres.scale(self.length_m.recip())
    }

    pub(crate) fn force(&self, newtons: Interval) -> Interval {
        newtons.scale(self.force_n.recip())
    }

    pub(crate) fn place(&self, at_m: Point) -> Vector {
        std::array::from_fn(|k| {
            // The difference of doubles is zero only if they are equal.
            if (at_m[k] - self.origin_m[k]).abs() <= 0.0 {
                Interval::ZERO
            } else {
                self.length(Interval::point(at_m[k]) - Interval::point(self.origin_m[k]))
            }
        })
    }

    /// A box of places in units.
    pub(crate) fn places(&self, at_m: Vector) -> Vector {
        minus(at_m, points(self.origin_m)).map(|part| self.length(part))
    }

    pub(crate) fn place_m(&self, place: Vector) -> Vector {
        std::array::from_fn(|k| {
            sum(place[k].scale(self.length_m), Interval::point(self.origin_m[k]))
        })
    }

    /// Loads of all joints in units: those of the joint, and what the lever rule leaves it of the
    /// members'.
    pub(crate) fn loads(&self, system: &System) -> Vec<Vector> {
        let mut loads: Vec<Vector> = system
            .joints()
            .iter()
            .map(|joint| {
                let own = self.weight(system, Interval::point(joint.mass_kg));
                plus(own, points(joint.force_n).map(|part| self.force(part)))
            })
            .collect();
        for member in system.members() {
            for (joint, is_start) in [(member.from, true), (member.to, false)] {
                loads[joint] = plus(loads[joint], self.share(system, member, is_start));
            }
        }
        loads
    }

    /// What the lever rule leaves one end of a member of its loads, in units.
    pub(crate) fn share(&self, system: &System, member: &Member, is_start: bool) -> Vector {
        let body = &member.body;
        let mut share =
            self.weight_share(system, member, Interval::point(body.mass_kg()), is_start);
        for load in &member.loads {
            let force = times(part(body, load.at_m, is_start), points(load.force_n));
            share = plus(share, force.map(|part| self.force(part)));
        }
        share
    }

    /// What it leaves it of the weight of a mass of the member, in units.
    pub(super) fn weight_share(
        &self,
        system: &System,
        member: &Member,
        mass_kg: Interval,
        is_start: bool,
    ) -> Vector {
        let part = part(&member.body, member.body.centre_m(), is_start);
        if mass_kg == Interval::ZERO || part == Interval::ZERO {
            return NOWHERE;
        }
        self.weight(system, mass_kg * part)
    }

    pub(super) fn weight(&self, system: &System, mass_kg: Interval) -> Vector {
        if mass_kg == Interval::ZERO {
            return NOWHERE;
        }
        // Rounded whatever the numbers are, so that a mass of 1 in other units has the same digits.
        let weight_n = mass_kg * Interval::point(system.gravity_m_s2());
        [Interval::ZERO, Interval::ZERO, -self.force(weight_n)]
    }

    /// `l/EA` of a member in units; exactly 0 for an inextensible one.
    pub(crate) fn compliance(&self, member: &Member) -> Interval {
        member.stiffness_n.map_or(Interval::ZERO, |stiffness_n| {
            self.length(Interval::point(member.body.length_m()))
                / self.force(Interval::point(stiffness_n))
        })
    }
}

/// The part of a load at a point of a bar that one of its ends takes; exactly 0 if the point is the
/// other end.
fn part(bar: &Bar, at_m: f64, is_start: bool) -> Interval {
    let is_other = if is_start { at_m >= bar.length_m() } else { at_m <= 0.0 };
    if is_other {
        return Interval::ZERO;
    }
    let [start, end] = lever(Interval::point(bar.length_m()), Interval::point(at_m));
    if is_start { start } else { end }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A load over one end is no load of the other, exactly; one at a third of a bar is shared
    /// 2 : 1.
    #[test]
    fn loads_over_an_end_are_borne_there_alone() {
        let bar = Bar::homogeneous(3.0, 1.0).unwrap();
        assert_eq!(part(&bar, 3.0, true), Interval::ZERO);
        assert_eq!(part(&bar, 0.0, false), Interval::ZERO);
        let cases = [(0.0, [1.0, 0.0]), (1.0, [2.0 / 3.0, 1.0 / 3.0]), (3.0, [0.0, 1.0])];
        for (at_m, expected) in cases {
            for (is_start, expected) in [true, false].into_iter().zip(expected) {
                let share = part(&bar, at_m, is_start);
                assert!(share.contains(expected) && share.width() < 1e-15, "{at_m}: {share:?}");
            }
        }
    }
}
