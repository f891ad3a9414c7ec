//! Equilibria in which one bar carries no force, or next to none.
//!
//! There is at most one near the pull at which the force of bar k vanishes, for each pattern of the
//! others: proved in the coordinates of [`axial`](crate::slack::axial).

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

use intervals::Interval;

use crate::closure::{Pattern, signed};
use crate::degenerate::unloaded::{self as degenerate, DegenerateEquilibrium};
use crate::equilibrium::stress;
use crate::equilibrium::{Neighbourhood, Observed, ProvenEquilibrium};
use crate::plane::cell::Cell;
use crate::plane::face::Face;
use crate::plane::system::System;
use crate::slack::axial::AxialClosure;
use crate::slack::moments::ExactMoments;

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
    /// Those with a singular second derivative.
    pub(crate) degenerate: Vec<DegenerateEquilibrium>,
    settled: Vec<Settled>,
}

/// Squares of pulls about the one without force in a bar, one for each pattern of the others (the
/// bit of the bar is 0): with these signs there is no equilibrium in it but the one that is listed,
/// whatever the sign of the bar.
#[derive(Debug)]
struct Settled {
    face: Face,
    bit: u32,
    /// Half a side of the square of each pattern.
    half: HashMap<u32, f64>,
    largest: f64,
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
        for Settled { face, bit, half, largest } in &self.settled {
            let Some(cell) = cell.on(*face, system) else { continue };
            let farthest = cell.at[0].mag().max(cell.at[1].mag());
            if farthest <= *largest {
                left.to_mut().retain(|pattern| {
                    half.get(&(pattern.0 & !bit)).is_none_or(|half| farthest > *half)
                });
            }
        }
        left
    }
}

/// All of them. Degenerate ones are found where lengths and weights are known as integers.
pub(crate) fn unloaded(system: &System, exact: Option<&ExactMoments>) -> Unloaded {
    let mut all = Unloaded::default();
    let bars = system.bars();
    for (number, group) in system.groups.iter().enumerate() {
        let Ok(number) = u8::try_from(number) else { continue };
        let bit = Pattern::bit(bars, group.start);
        let mut half = HashMap::new();
        let mut largest = 0.0_f64;
        for Pattern(others) in candidates(system, group) {
            let Some(closure) = axial_closure(system, group, Pattern(others)) else { continue };
            // Squares about the origin of the chart.
            let side = if let Some(equilibrium) = prove(&closure) {
                let side = equilibrium.alone_in.at[0].hi();
                all.equilibria.push(equilibrium);
                side
            } else if let Some(merged) = exact.and_then(|e| degenerate::prove(e, &closure)) {
                let side = merged.alone_in.at[0].hi();
                all.degenerate.push(merged);
                side
            } else {
                continue;
            };
            largest = largest.max(side);
            half.insert(others, side);
        }
        if !half.is_empty() {
            all.settled.push(Settled { face: Face::Around(number), bit, half, largest });
        }
    }
    all
}

/// The patterns, ascending, that [`axial_closure`] has anything to say of: it looks at them again.
fn candidates(system: &System, group: &Range<usize>) -> Vec<Pattern> {
    let mut found = vec![];
    let number = system.groups.iter().position(|other| other == group);
    let face = number.and_then(|number| u8::try_from(number).ok()).map(Face::Around);
    if let (Some(face), 1, false) = (face, group.len(), system.vertical) {
        let weights = system.weights(face).iter().zip(&system.length).enumerate();
        // How far each bar in tension reaches up; the bar itself bridges what is left.
        let up: Option<Vec<Interval>> = weights
            .map(|(i, (weight, length))| match weight.sign() {
                _ if i == group.start => Some(Interval::ZERO),
                sign => sign.map(|up| signed(up, *length)),
            })
            .collect();
        if let Some(up) = up {
            bridged(system, group.start, &up, (0, 0, system.span[1]), &mut found);
        }
    }
    found
}

/// Those with the signs chosen so far (bars, pattern, height that is left) that bring the end of
/// the chain within the reach of one bar.
fn bridged(
    system: &System,
    bar: usize,
    up: &[Interval],
    (chosen, pattern, left): (usize, u32, Interval),
    found: &mut Vec<Pattern>,
) {
    let rest: f64 = system.length[chosen..].iter().map(|length| length.hi()).sum();
    let reach = rest + system.length[bar].hi();
    // Rounding is far below the room that is left.
    if left.mig() > reach + 4.0 * NEAR {
        return;
    }
    if chosen == up.len() {
        let distance = (system.span[0].square() + left.square()).sqrt();
        if (distance - system.length[bar]).mig() <= 2.0 * NEAR {
            found.push(Pattern(pattern));
        }
        return;
    }
    bridged(system, bar, up, (chosen + 1, pattern, left - up[chosen]), found);
    if chosen != bar {
        let bit = Pattern::bit(up.len(), chosen);
        bridged(system, bar, up, (chosen + 1, pattern | bit, left + up[chosen]), found);
    }
}

/// The equilibrium with these signs, 0 for the bar without force.
pub(crate) fn with_signs(system: &System, signs: &[i8]) -> Option<ProvenEquilibrium> {
    let bars = system.bars();
    let bar = signs.iter().position(|sign| *sign == 0)?;
    let compressed = (0..bars).filter(|i| signs[*i] < 0);
    let others = compressed.map(|i| Pattern::bit(bars, i)).sum();
    let group = system.groups.iter().find(|group| group.contains(&bar))?;
    prove(&axial_closure(system, group, Pattern(others))?)
}

/// The closure in the axial force of a bar alone, if the bar just bridges the gap that the others
/// leave with these signs, or nearly so.
fn axial_closure<'a>(
    system: &'a System,
    group: &Range<usize>,
    others: Pattern,
) -> Option<AxialClosure<'a>> {
    // Between anchors on one vertical such a bar is upright too, and its direction is not
    // determined.
    if group.len() > 1 || system.vertical {
        return None;
    }
    let bar = group.start;
    let number = system.groups.iter().position(|other| other == group)?;
    let face = Face::Around(u8::try_from(number).ok()?);
    let signs: Vec<i8> = others
        .signs(system.bars())
        .enumerate()
        .map(|(i, s)| if i == bar { 0 } else { s })
        .collect();
    // The gap that upright bars leave.
    let mut gap = system.span;
    for (i, sign) in signs.iter().enumerate().filter(|(_, sign)| **sign != 0) {
        let up = system.weights(face)[i].sign()?;
        gap[1] = gap[1] - signed(sign * up, system.length[i]);
    }
    let distance = (gap[0].square() + gap[1].square()).sqrt();
    if (distance - system.length[bar]).mig() > NEAR {
        return None;
    }
    let axis = gap.map(|part| Interval::point(part.mid() / system.length[bar].mid()));
    Some(AxialClosure { system, bar, face, signs, axis })
}

/// The equilibrium near the pull without force in a bar, if there is exactly one and its bar
/// carries next to nothing.
fn prove(closure: &AxialClosure) -> Option<ProvenEquilibrium> {
    let (system, bar, face) = (closure.system, closure.bar, closure.face);
    let mut radius = LARGEST_DISC;
    let mut found = None;
    for _ in 0..DISCS {
        if let Some(tight) = closure.only_one(radius) {
            found = Some(tight);
            break;
        }
        radius *= NEXT_DISC;
    }
    let tight = found?;
    // Any other the search finds by itself, and one outside of the square that is settled too.
    let most = tight.at[0].mag();
    let outside = tight.at.iter().any(|part| part.mag() > 0.5 * radius);
    if outside || most > TOO_LITTLE || most > NEXT_TO_NOTHING && !tight.at[0].contains(0.0) {
        return None;
    }
    let bars = closure.bars(tight.at)?;
    let slope = closure.slope(&bars, tight.at).map(|row| row.map(Interval::mid));
    let indices = closure.indices(&bars, condition(slope))?;
    // A square inside the disc.
    let side = Interval::new(-0.5 * radius, 0.5 * radius);
    let optimal = stress::proves_optimal(&closure.signs, &system.length, &bars.sizes, false);
    let observed = Observed {
        pull: Cell { face, at: bars.forces[bar] }.pull(system),
        forces: bars.forces,
        sizes: bars.sizes,
        directions: bars.directions,
    };
    let alone_in = Neighbourhood { chart: face, at: [side, side] };
    let signs = &closure.signs;
    Some(ProvenEquilibrium::assemble(system, signs, &observed, alone_in, indices, optimal))
}

/// Ratio of the singular values of a matrix.
fn condition([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let squares = a * a + b * b + c * c + d * d;
    let determinant = a * d - b * c;
    let rest = (squares * squares - 4.0 * determinant * determinant).max(0.0).sqrt();
    0.5 * (squares + rest) / determinant.abs()
}

#[cfg(test)]
mod tests {
    use model::{Anchors, Bar, Chain};

    use super::*;
    use crate::plane::loads::JointLoads;

    /// Singular values 3 and 1, turned.
    #[test]
    fn the_condition_is_the_ratio_of_the_singular_values() {
        let (s, c) = 0.3_f64.sin_cos();
        assert!((condition([[3.0 * c, -s], [3.0 * s, c]]) - 3.0).abs() < 1e-14);
    }

    /// A bar of 1 m is level between one that hangs 0.9 m and one that rises 0.4 m, without force.
    fn level() -> System {
        let bars = [(0.9, 1.0, 0.5), (1.0, 2.0, 0.75), (0.4, 1.0, 0.25)];
        let bars = bars.map(|(l, m, r)| Bar::new(l, m, r, [0.0; 3]).unwrap());
        let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, -0.5] };
        let chain = Chain::new("unloaded", 9.81, anchors, bars.to_vec()).unwrap();
        System::new(&chain, JointLoads::NONE)
    }

    /// About an axis aside it is no longer next to the origin of the chart: a square about that
    /// does not hold it.
    #[test]
    fn what_is_proved_outside_of_its_square_is_left_to_the_search() {
        let system = level();
        let mut closure = axial_closure(&system, &system.groups[1], Pattern(0)).unwrap();
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
        let closure = axial_closure(&system, &system.groups[1], Pattern(0)).unwrap();
        // The disc in which it is alone is large enough to hold it.
        let disc = LARGEST_DISC * NEXT_DISC.powi(5);
        let [force, _] = closure.only_one(disc).unwrap().at;
        assert!(force.contains(0.0) && force.mag() > TOO_LITTLE && force.mag() < 0.5 * disc);
        assert!(prove(&closure).is_none());
    }
}
