//! The chain as the census sees it: lengths, weights and span in units of the chain, as intervals.

use std::ops::Range;

use model::{Bar, Chain, Vector};
use numerics::{Interval, lever};

use crate::run::closure::bar::size;
use crate::run::plane::face::Face;
use crate::run::plane::loads::JointLoads;

/// A chain in units in which the total length and the spread of the weights are of order one. Units
/// are powers of two, so that scaling rounds nothing.
#[derive(Debug, Clone)]
pub(crate) struct System {
    /// `l_i`, in [`length_unit_m`](Self::length_unit_m).
    pub(crate) length: Vec<Interval>,
    /// `c_i` less [`offset`](Self::offset), `c_1` being 0, in [`mass_unit_kg`](Self::mass_unit_kg)
    /// × g: between −1 and 1, not falling.
    pub(crate) weight: Vec<Interval>,
    /// For each group, the weights of all bars less the one of the group: accurate where the
    /// difference is small.
    local: Vec<Vec<Interval>>,
    /// Runs of bars whose common joints carry no weight: their `F_i` are one and the same.
    pub(crate) groups: Vec<Range<usize>>,
    /// Horizontal and vertical part of D, in the unit of length.
    pub(crate) span: [Interval; 2],
    /// Whether the anchors stand on one vertical.
    pub(crate) vertical: bool,
    /// Horizontal unit vector (X, Y) of the plane.
    pub(crate) direction: [Interval; 2],
    /// Added to the vertical pull so that the weights are centred about zero.
    pub(crate) offset: f64,
    /// Unit of length, m.
    pub(crate) length_unit_m: f64,
    /// Unit of mass, kg; forces are in this times g.
    pub(crate) mass_unit_kg: f64,
    /// Gravity, m/s².
    pub(crate) gravity_m_s2: f64,
    /// Joint 0, m.
    pub(crate) start_m: Vector,
    /// Joint n, m.
    pub(crate) end_m: Vector,
    /// What joint 0 carries, in the unit of mass: a part of the reaction there and of nothing else.
    /// It may be larger than all other weights by any factor and is never added to them.
    pub(crate) on_start: Interval,
    /// What each bar adds behind joint 0, in the unit of mass: bar 1 what it leaves at joint 1, any
    /// other bar its mass.
    pub(crate) added: Vec<Interval>,
}

/// A power of two at or a little above a number that is not negative; its inverse is normal too.
fn power_of_two_above(x: f64) -> f64 {
    /// The bits of the exponent of a double.
    const EXPONENT: u64 = 0x7ff << 52;
    /// 2⁻¹⁰⁰⁰ and 2¹⁰⁰⁰: the inverse of either is far from overflow and underflow.
    const SMALLEST: f64 = f64::from_bits((1023 - 1000) << 52);
    const LARGEST: f64 = f64::from_bits((1023 + 1000) << 52);
    if !(SMALLEST..LARGEST).contains(&x) {
        return if x < SMALLEST { SMALLEST } else { LARGEST };
    }
    let below = f64::from_bits(x.to_bits() & EXPONENT);
    if below < x { 2.0 * below } else { below }
}

/// The vertical anchors of the paper stand in its plane OYZ.
const PAPER_PLANE: [Interval; 2] = [Interval::ZERO, Interval::ONE];

impl System {
    /// A chain with loads at its joints in its units. Some joint between the anchors carries
    /// weight: a problem where none does is refused.
    pub(crate) fn new(chain: &Chain, loads: &JointLoads) -> Self {
        let bars = chain.bars();
        let length_unit_m = power_of_two_above(chain.total_length_m());

        // c_i is all that hangs at the joints 1 to i-1. What joint 0 carries would be the same part
        // of every c_i: a large one would cost them their digits. What hangs at a joint is counted
        // with the bar before it.
        let with_load = |weight: Interval, bar: usize| loads.added_to(weight, bar + 1);
        let mut added: Vec<Interval> =
            (0..bars.len()).map(|k| with_load(Interval::point(bars[k].mass_kg()), k)).collect();
        added[0] = with_load(at_second_joint(&bars[0]), 0);
        let mut carried = added[0];
        let mut raw = vec![Interval::ZERO];
        for (bar, added) in bars.iter().zip(&added).skip(1) {
            raw.push(carried + at_first_joint(bar));
            carried = carried + *added;
        }
        let groups = groups(bars, loads);
        for group in &groups {
            let common = group.clone().map(|i| raw[i]).fold(raw[group.start], |all, c| {
                // The exact values are equal, so each enclosure holds it.
                all.intersect(c).unwrap_or(all)
            });
            raw[group.clone()].fill(common);
        }
        let (first, last) = (raw[0].mid(), raw[raw.len() - 1].mid());
        let mass_unit_kg = power_of_two_above(0.5 * (last - first));
        let offset = 0.5 * (first + last) / mass_unit_kg;
        let weight =
            raw.iter().map(|c| c.scale(mass_unit_kg.recip()) - Interval::point(offset)).collect();

        let anchors = chain.anchors();
        let difference: [Interval; 3] = std::array::from_fn(|k| {
            let (a, b) = (anchors.start_m[k], anchors.end_m[k]);
            // Equal as numbers: 0 and −0 too.
            if a <= b && b <= a { Interval::ZERO } else { Interval::point(b) - Interval::point(a) }
        });
        // Divided by the larger part: squares neither overflow nor vanish.
        let unit = power_of_two_above(difference[0].mag().max(difference[1].mag()));
        let [x, y] = [difference[0].scale(unit.recip()), difference[1].scale(unit.recip())];
        let vertical = x == Interval::ZERO && y == Interval::ZERO;
        let (horizontal, direction) = if vertical {
            (Interval::ZERO, PAPER_PLANE)
        } else if x == Interval::ZERO {
            (y.abs(), [x, y.unit_sign()])
        } else if y == Interval::ZERO {
            (x.abs(), [x.unit_sign(), y])
        } else {
            let distance = size([x, y]);
            (distance, [x / distance, y / distance])
        };
        let shorten = |x: Interval| x.scale(length_unit_m.recip());
        let mut system = Self {
            length: bars.iter().map(|bar| shorten(Interval::point(bar.length_m()))).collect(),
            weight,
            local: vec![],
            groups,
            span: [shorten(horizontal.scale(unit)), shorten(difference[2])],
            vertical,
            direction,
            offset,
            length_unit_m,
            mass_unit_kg,
            gravity_m_s2: chain.gravity_m_s2(),
            start_m: anchors.start_m,
            end_m: anchors.end_m,
            on_start: at_first_joint(&bars[0]).scale(mass_unit_kg.recip()),
            added: added.into_iter().map(|mass| mass.scale(mass_unit_kg.recip())).collect(),
        };
        system.local =
            system.groups.iter().map(|group| system.weights_from(chain, loads, group)).collect();
        system
    }

    pub(crate) fn bars(&self) -> usize {
        self.length.len()
    }

    /// The weights c_i counted from the origin of a chart.
    pub(crate) fn weights(&self, face: Face) -> &[Interval] {
        match face {
            Face::Around(group) => &self.local[usize::from(group)],
            _ => &self.weight,
        }
    }

    /// The origin of a chart: what its V is more than the vertical pull.
    pub(crate) fn origin(&self, face: Face) -> Interval {
        match face {
            Face::Around(group) => self.group_weight(group) + Interval::point(self.offset),
            _ => Interval::point(self.offset),
        }
    }

    pub(crate) fn group_weight(&self, group: u8) -> Interval {
        self.weight[self.groups[usize::from(group)].start]
    }

    /// The weight of one group less that of another.
    pub(crate) fn group_distance(&self, from: u8, to: u8) -> Interval {
        self.local[usize::from(from)][self.groups[usize::from(to)].start]
    }

    /// The weights of all bars less that of the bars of a group, from the masses in between.
    fn weights_from(
        &self,
        chain: &Chain,
        loads: &JointLoads,
        group: &Range<usize>,
    ) -> Vec<Interval> {
        let bars = chain.bars();
        let unit = self.mass_unit_kg.recip();
        let between = |from: usize, to: usize| {
            loads.added_to(at_second_joint(&bars[from]), from + 1).scale(unit)
                + self.added[from + 1..to].iter().copied().sum()
                + at_first_joint(&bars[to]).scale(unit)
        };
        (0..bars.len())
            .map(|i| {
                if i < group.start {
                    -between(i, group.start)
                } else if i >= group.end {
                    between(group.end - 1, i)
                } else {
                    Interval::ZERO
                }
            })
            .collect()
    }

    /// The pull of the chain on the first anchor, N, from that of bar 1 on joint 0.
    pub(crate) fn pull_on_anchor_n(&self, [h, v]: [Interval; 2]) -> [Interval; 2] {
        let newton = self.force_unit_n();
        [h * newton, (v - self.on_start) * newton]
    }

    /// Unit of force, N.
    pub(crate) fn force_unit_n(&self) -> Interval {
        Interval::point(self.gravity_m_s2).scale(self.mass_unit_kg)
    }

    /// A vector of the plane (along it, up) in the world frame.
    pub(crate) fn world(&self, [along, up]: [Interval; 2]) -> [Interval; 3] {
        let part = |direction: Interval| match direction.sign() {
            Some(0) => Interval::ZERO,
            _ if direction == Interval::ONE => along,
            _ if direction == -Interval::ONE => -along,
            _ => along * direction,
        };
        [part(self.direction[0]), part(self.direction[1]), up]
    }
}

/// What a bar leaves at its first joint, kg: m (1 − r/l), by the lever rule.
pub(crate) fn at_first_joint(bar: &Bar) -> Interval {
    Interval::point(bar.mass_kg()) * shares(bar)[0]
}

/// What a bar leaves at its second joint, kg: m r/l, and nothing at all if its centre is on the
/// first.
fn at_second_joint(bar: &Bar) -> Interval {
    if bar.mass_kg() <= 0.0 || bar.centre_m() <= 0.0 {
        return Interval::ZERO;
    }
    Interval::point(bar.mass_kg()) * shares(bar)[1]
}

/// The parts of its weight that a bar leaves at its two joints.
fn shares(bar: &Bar) -> [Interval; 2] {
    lever(Interval::point(bar.length_m()), Interval::point(bar.centre_m()))
}

/// Runs of bars joined by joints without weight.
///
/// Joint i carries nothing if and only if nothing hangs there, `m_i r_i = 0` and
/// `m_{i+1} (l_{i+1} - r_{i+1}) = 0`: a question about the data as they stand, without rounding.
pub(crate) fn groups(bars: &[Bar], loads: &JointLoads) -> Vec<Range<usize>> {
    let mut groups = vec![];
    let mut start = 0;
    for joint in 1..=bars.len() {
        let weightless = joint < bars.len() && {
            let (before, after) = (&bars[joint - 1], &bars[joint]);
            loads.none_at(joint)
                && (before.mass_kg() <= 0.0 || before.centre_m() <= 0.0)
                && (after.mass_kg() <= 0.0 || after.centre_m() >= after.length_m())
        };
        if !weightless {
            groups.push(start..joint);
            start = joint;
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use numerics::DoubleDouble;

    use super::*;

    /// Bars of 2 kg, 4 kg and 2 kg with their centres in the middle, and 1 kg at each joint: what
    /// the anchors bear besides is in no `c_i`; the energy of the last one counts.
    #[test]
    fn what_hangs_at_the_anchors_moves_no_bar() {
        let bars = [2.0, 4.0, 2.0].map(|mass| (1.0, mass));
        let loads = JointLoads::new(vec![Some(DoubleDouble::point(1.0)); 4]);
        let system =
            System::new(samples::homogeneous(10.0, &bars, [2.0, 0.0, 0.5]).chain(), &loads);
        // 0, 1 + 3 and 4 + 1 + 3 kg hang before the bars: ±4 kg about their middle.
        let is = |found: &[Interval], kg: [f64; 3]| {
            found.iter().zip(kg).all(|(found, kg)| found.contains(kg / system.mass_unit_kg))
        };
        assert_eq!((system.mass_unit_kg, system.offset), (4.0, 1.0));
        assert!(is(&system.weight, [-4.0, 0.0, 4.0]), "{:?}", system.weight);
        assert!(is(&system.added, [2.0, 5.0, 3.0]), "{:?}", system.added);
        assert!(is(system.weights(Face::Around(0)), [0.0, 4.0, 8.0]));
        assert!(is(system.weights(Face::Around(2)), [-8.0, -4.0, 0.0]));
    }

    /// Along an axis of the world nothing is rounded, whichever way the chain runs.
    #[test]
    fn vectors_along_the_axes_are_exact() {
        let (along, up) = (Interval::point(0.1), Interval::point(0.7));
        let cases = [
            ([2.0, 0.0], [along, Interval::ZERO]),
            ([-2.0, 0.0], [-along, Interval::ZERO]),
            ([0.0, -2.0], [Interval::ZERO, -along]),
        ];
        for ([x, y], expected) in cases {
            let three = samples::homogeneous(10.0, &[(1.0, 1.0); 3], [x, y, 0.5]);
            let found = System::new(three.chain(), JointLoads::NONE).world([along, up]);
            assert_eq!(found, [expected[0], expected[1], up]);
        }
    }

    #[test]
    fn units_are_powers_of_two_at_or_above_a_number() {
        for (x, power) in [(3.0, 4.0), (4.0, 4.0), (0.3, 0.5), (0.25, 0.25), (1.0, 1.0)] {
            assert_eq!(power_of_two_above(x).to_bits(), f64::to_bits(power), "{x}");
        }
        let [smallest, largest] = [-1000, 1000].map(|k| 2.0_f64.powi(k));
        for x in [0.0, 1e-305, smallest] {
            assert_eq!(power_of_two_above(x).to_bits(), smallest.to_bits(), "{x}");
        }
        for x in [largest, 1e305, f64::INFINITY] {
            assert_eq!(power_of_two_above(x).to_bits(), largest.to_bits(), "{x}");
        }
    }
}
