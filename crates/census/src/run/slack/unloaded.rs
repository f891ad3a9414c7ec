//! Equilibria in which one bar carries no force, or next to none, and pulls at which several in one line do.
//!
//! There is at most one near the pull at which the force of bar k vanishes, for each pattern of the
//! others: proved in the coordinates of [`axial`](crate::run::slack::axial).
//!
//! The same holds for a group, bars in a row whose common joints carry no weight, as long as they
//! lie in one line. Where they carry nothing they need not: a group that also bridges its gap in one line is
//! one of the [`families`](crate::run::slack::families), next to which there is no equilibrium with a force.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

use numerics::Interval;

use crate::run::closure::bar::size;
use crate::run::closure::{Pattern, signed};
use crate::run::enclosure::krawczyk::Zero;
use crate::run::equilibrium::inertia::condition;
use crate::run::equilibrium::{Proof, ProvenEquilibrium, stress};
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::system::System;
use crate::run::slack::axial::AxialClosure;
use crate::run::slack::exact::ExactSides;
use crate::run::slack::moments::Exact;

/// A gap between upright bars that differs from the length of the bar by more than this is not
/// bridged by it without force, to rounding.
const NEAR: f64 = 1e-9;

/// A force of less than this, in the unit of the weights, is next to nothing: 2⁻⁴⁰, a 10¹² part.
/// Its digits are what is left of much larger numbers.
const NEXT_TO_NOTHING: f64 = f64::from_bits((1023 - 40) << 52);

/// A force of less than this, 2⁻²⁴, counts as none where its sign is not known: next to a
/// degenerate equilibrium rounding moves a force by much more than its last place.
const TOO_LITTLE: f64 = f64::from_bits((1023 - 24) << 52);

/// The largest disc of pulls tried, in the unit of the weights, and the factor to the next one.
const LARGEST_DISC: f64 = 1.0 / 64.0;
const NEXT_DISC: f64 = 0.125;
/// Discs tried. The smallest is far above rounding.
const DISCS: usize = 12;

/// The equilibria with a bar that carries next to nothing, and the pulls that are settled with
/// them.
#[derive(Debug, Default)]
pub(crate) struct Unloaded {
    pub(crate) equilibria: Vec<ProvenEquilibrium>,
    settled: Vec<Settled>,
}

/// Squares of pulls about the one without force in a group, one for each pattern: with these signs
/// there is no equilibrium in it but the one that is listed, whether the group is pulled or pushed.
#[derive(Debug)]
struct Settled {
    face: Face,
    /// The bits of the group, and that of its first bar.
    bits: u32,
    first: u32,
    /// Half a side of the square of each pattern.
    half: HashMap<u32, f64>,
    largest: f64,
}

impl Settled {
    /// Of a pattern and the one with all bars of the group turned, that in which its first bar is
    /// pulled.
    fn either(&self, Pattern(pattern): Pattern) -> u32 {
        if pattern & self.first == 0 { pattern } else { pattern ^ self.bits }
    }
}

impl Unloaded {
    /// The patterns that may have equilibria in a cell besides those listed here.
    pub(crate) fn left<'a>(
        &self,
        system: &System,
        cell: &Cell,
        patterns: &'a [Pattern],
    ) -> Cow<'a, [Pattern]> {
        let mut left = Cow::Borrowed(patterns);
        for settled in &self.settled {
            let Some(cell) = cell.on(settled.face, system) else { continue };
            let farthest = cell.at[0].mag().max(cell.at[1].mag());
            if farthest <= settled.largest {
                left.to_mut().retain(|pattern| {
                    let half = settled.half.get(&settled.either(*pattern));
                    half.is_none_or(|half| farthest > *half)
                });
            }
        }
        left
    }
}

pub(crate) fn unloaded(system: &System, exact: &Exact) -> Unloaded {
    let mut all = Unloaded::default();
    let bars = system.bars();
    for (number, group) in system.groups.iter().enumerate() {
        let Ok(number) = u8::try_from(number) else { continue };
        let bit = |bar| Pattern::bit(bars, bar);
        let mut settled = Settled {
            face: Face::Around(number),
            bits: group.clone().map(bit).sum(),
            first: bit(group.start),
            half: HashMap::new(),
            largest: 0.0,
        };
        for along in lines(system, group, exact) {
            // The bars of the group that are pushed while its first is pulled.
            let turned: u32 = group
                .clone()
                .zip(&along)
                .filter(|(_, w)| **w != along[0])
                .map(|(i, _)| bit(i))
                .sum();
            for others in (0..1_u32 << bars).filter(|pattern| pattern & settled.bits == 0) {
                let others = Pattern(others);
                let Some(closure) = axial_closure(system, group, &along, others) else { continue };
                let side = if group.len() > 1 {
                    // It is one position of a family.
                    let sides = exact.sides.as_ref();
                    let Some(radius) = sides.and_then(|sides| alone(sides, &closure)) else {
                        continue;
                    };
                    0.5 * radius
                } else {
                    let Some(equilibrium) = prove(&closure) else { continue };
                    let side = equilibrium.alone_in.at[0].hi();
                    all.equilibria.push(equilibrium);
                    side
                };
                settled.largest = settled.largest.max(side);
                settled.half.insert(others.0 | turned, side);
            }
        }
        if !settled.half.is_empty() {
            all.settled.push(settled);
        }
    }
    all
}

/// The ways in which the bars of a group may lie in one line, +1 along it and −1 against it; where
/// lengths are not known as integers, or the group is long, those that are the only ones.
fn lines(system: &System, group: &Range<usize>, exact: &Exact) -> Vec<Vec<i8>> {
    /// Each way costs a walk over the signs of the other bars.
    const LONGEST: usize = 10;
    if exact.sides.is_none() || group.len() > LONGEST {
        return ways(system, group);
    }
    let all =
        (0..1_u32 << group.len()).map(|pattern| Pattern(pattern).signs(group.len()).collect());
    reaching(system, group, all.collect())
}

/// Those in which no other position of them reaches as far, or none reaches less far: all along, or all
/// but the longest against it.
pub(super) fn ways(system: &System, group: &Range<usize>) -> Vec<Vec<i8>> {
    let one = |one: usize| group.clone().map(|i| if i == one { 1 } else { -1 }).collect();
    let mut all = vec![vec![1; group.len()]];
    if group.len() > 1 {
        all.extend(group.clone().map(one));
    }
    reaching(system, group, all)
}

/// Those that reach along the line, not against it.
fn reaching(system: &System, group: &Range<usize>, all: Vec<Vec<i8>>) -> Vec<Vec<i8>> {
    all.into_iter().filter(|along| reach(system, group, along).lo() > 0.0).collect()
}

/// Which way the bars with these signs point at the pull without force in those with sign 0: up, down.
fn upright(system: &System, face: Face, signs: &[i8]) -> Option<Vec<i8>> {
    let force = |(sign, weight): (&i8, &Interval)| match sign {
        0 => Some(0),
        _ => Some(sign * weight.sign().filter(|up| *up != 0)?),
    };
    signs.iter().zip(system.weights(face)).map(force).collect()
}

/// The length of a group that lies in one line.
fn reach(system: &System, group: &Range<usize>, along: &[i8]) -> Interval {
    let lengths = &system.length[group.clone()];
    match (along, lengths) {
        ([1], [length]) => *length,
        _ => along.iter().zip(lengths).map(|(way, length)| signed(*way, *length)).sum(),
    }
}

/// The radius of a disc of pulls in which no other has the group in this line, pulled or pushed, than that
/// without force, if the group exactly bridges its gap so.
fn alone(sides: &ExactSides, closure: &AxialClosure) -> Option<f64> {
    let AxialClosure { system, group, along, face, signs, .. } = closure;
    let up = upright(system, *face, signs)?;
    if !sides.just_bridges(&up, group.clone(), along) {
        return None;
    }
    let (only, radius) = widest_disc(closure)?;
    // The zero without force is in the disc, so it is the only one.
    only.at[0].contains(0.0).then_some(radius)
}

/// The equilibrium with these signs, 0 for the bar without force.
pub(crate) fn with_signs(system: &System, signs: &[i8]) -> Option<ProvenEquilibrium> {
    let bars = system.bars();
    let bar = signs.iter().position(|sign| *sign == 0)?;
    let compressed = (0..bars).filter(|i| signs[*i] < 0);
    let others = compressed.map(|i| Pattern::bit(bars, i)).sum();
    let group = system.groups.iter().find(|group| group.contains(&bar))?;
    if group.len() > 1 {
        return None;
    }
    prove(&axial_closure(system, group, &[1], Pattern(others))?)
}

/// The closure in the axial force of a group alone, if the group, its bars pointing these ways, just
/// bridges the gap that the others leave with these signs, or nearly so.
fn axial_closure<'a>(
    system: &'a System,
    group: &Range<usize>,
    along: &[i8],
    others: Pattern,
) -> Option<AxialClosure<'a>> {
    // Between anchors on one vertical such a bar is upright too, and its direction is not
    // determined.
    if system.vertical {
        return None;
    }
    let number = system.groups.iter().position(|other| other == group)?;
    let face = Face::Around(u8::try_from(number).ok()?);
    let signs: Vec<i8> = others
        .signs(system.bars())
        .enumerate()
        .map(|(i, s)| if group.contains(&i) { 0 } else { s })
        .collect();
    // The gap that upright bars leave.
    let mut gap = system.span;
    for (i, sign) in signs.iter().enumerate().filter(|(_, sign)| **sign != 0) {
        let up = system.weights(face)[i].sign()?;
        gap[1] = gap[1] - signed(sign * up, system.length[i]);
    }
    let reach = reach(system, group, along);
    if (size(gap) - reach).mig() > NEAR {
        return None;
    }
    let axis = gap.map(|part| Interval::point(part.mid() / reach.mid()));
    let group = group.clone();
    Some(AxialClosure { system, group, along: along.to_vec(), face, signs, axis })
}

/// The equilibrium near the pull without force in a bar, if there is exactly one and its bar
/// carries next to nothing.
fn prove(closure: &AxialClosure) -> Option<ProvenEquilibrium> {
    let system = closure.system;
    let (tight, radius) = widest_disc(closure)?;
    // Any other the search finds by itself, and one outside of the square that is settled too.
    let most = tight.at[0].mag();
    let outside = tight.at.iter().any(|part| part.mag() > 0.5 * radius);
    if outside || most > TOO_LITTLE || most > NEXT_TO_NOTHING && !tight.at[0].contains(0.0) {
        return None;
    }
    let observed = closure.bars(tight.at)?;
    let slope = closure.slope(&observed, tight.at).map(|row| row.map(Interval::mid));
    let indices = closure.indices(&observed, condition(slope))?;
    // A square inside the disc.
    let side = Interval::new(-0.5 * radius, 0.5 * radius);
    let optimal = stress::proves_optimal(&closure.signs, &system.length, &observed.sizes, false);
    let shown = Zero { tight, alone_in: Cell { face: closure.face, at: [side, side] } };
    Some(Proof { shown, observed, indices, optimal }.assemble(system, &closure.signs))
}

/// The only zero in the largest disc of pulls that is proved to hold one, and the radius of that.
fn widest_disc(closure: &AxialClosure) -> Option<(Cell, f64)> {
    let radii = std::iter::successors(Some(LARGEST_DISC), |radius| Some(radius * NEXT_DISC));
    let one = |radius| closure.only_one(radius).map(|tight| (tight, radius));
    radii.take(DISCS).find_map(one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::plane::loads::JointLoads;

    /// Singular values 3 and 1, turned.
    #[test]
    fn the_condition_is_the_ratio_of_the_singular_values() {
        let (s, c) = 0.3_f64.sin_cos();
        assert!((condition([[3.0 * c, -s], [3.0 * s, c]]) - 3.0).abs() < 1e-14);
    }

    /// A bar of 1 m is level between one that hangs 0.9 m and one that rises 0.4 m, without force.
    fn level() -> System {
        let bars = [(0.9, 1.0, 0.5), (1.0, 2.0, 0.75), (0.4, 1.0, 0.25)];
        System::new(samples::chain(&bars, [1.0, 0.0, -0.5]).chain(), JointLoads::NONE)
    }

    /// About an axis aside it is no longer next to the origin of the chart: a square about that
    /// does not hold it.
    #[test]
    fn what_is_proved_outside_of_its_square_is_left_to_the_search() {
        let system = level();
        let mut closure = axial_closure(&system, &system.groups[1], &[1], Pattern(0)).unwrap();
        let ProvenEquilibrium { signs, alone_in, .. } = prove(&closure).unwrap();
        // In the largest disc in which it is alone, that of 2⁻²¹.
        let alone = |k: i32| closure.only_one(LARGEST_DISC * NEXT_DISC.powi(k)).is_some();
        assert_eq!([0, 1, 2, 3, 4, 5].map(alone), [false, false, false, false, false, true]);
        let half = 0.5 * f64::from_bits((1023 - 21) << 52);
        assert_eq!((signs, alone_in.at), (vec![1, 0, 1], [Interval::new(-half, half); 2]));
        closure.axis = [Interval::ONE, Interval::point(0.125)];
        assert!(closure.only_one(LARGEST_DISC).is_some());
        assert!(prove(&closure).is_none());
    }

    /// A length that is known to 3 · 10⁻⁷ leaves the force as little known.
    #[test]
    fn a_force_that_may_be_more_than_too_little_is_left_to_the_search() {
        let mut system = level();
        system.length[1] = system.length[1] + Interval::around(0.0, 3e-7 * system.length[1].mid());
        let closure = axial_closure(&system, &system.groups[1], &[1], Pattern(0)).unwrap();
        // The disc in which it is alone is large enough to hold it.
        let disc = LARGEST_DISC * NEXT_DISC.powi(5);
        let [force, _] = closure.only_one(disc).unwrap().at;
        assert!(force.contains(0.0) && force.mag() > TOO_LITTLE && force.mag() < 0.5 * disc);
        assert!(prove(&closure).is_none());
    }

    /// One bar is as long as it is, without any rounding; of several the ways count.
    #[test]
    fn a_group_reaches_as_far_as_its_ways() {
        let system = level();
        for group in &system.groups {
            assert_eq!(reach(&system, group, &[1]), system.length[group.start]);
        }
        let reach = reach(&system, &(0..3), &[1, -1, 1]);
        assert!((reach.mid() - (0.9 - 1.0 + 0.4) / 4.0).abs() < 1e-15, "{reach:?}");
    }

    /// The gap is 1 m, level, and bar 2 as long.
    #[test]
    fn the_axis_is_the_direction_of_the_bar_without_force() {
        let system = level();
        let closure = axial_closure(&system, &system.groups[1], &[1], Pattern(0)).unwrap();
        let axis = closure.axis.map(Interval::mid);
        assert!((axis[0] - 1.0).abs() < 1e-14 && axis[1].abs() < 1e-14, "{axis:?}");
        assert_eq!((closure.signs, closure.group), (vec![1, 0, 1], 1..2));
        // With another sign the gap is longer than the bar.
        assert!(axial_closure(&system, &system.groups[1], &[1], Pattern(0b100)).is_none());
    }
}
