//! Equilibria in which bars carry no force at all.
//!
//! Two or more bars in a row whose common joints carry no weight (massless bars, say) can hang
//! slack: the pull is then vertical and cancels what hangs before them, every other bar is
//! vertical, and the slack bars bridge the gap that is left in any way they can. That needs no
//! coincidence of lengths. In the plane, k slack bars do so in a space of dimension k − 2 (two
//! bars: two points), the polygons with their lengths and the gap as sides; on it the energy is
//! constant and across it the second derivative is the one of the other bars,
//! `h_j = s_j l_j |F_j|`.
//!
//! Where the slack bars also fit into one line, some up and some down it, the polygons are no
//! manifold there, and the second derivative is singular; where the gap is nothing, known from
//! integers, they close upon themselves and turn about it, two as long as each other folded. These
//! are families all the same: every position that bridges the gap is an equilibrium. A gap that they just
//! bridge, known from integers, leaves one position. That the straight ones are next to no other
//! equilibrium is proved with [`unloaded`](crate::run::slack::unloaded) and [`straight`](crate::run::slack::straight).

use std::cmp::Ordering;
use std::f64::consts::PI;
use std::ops::Range;

use model::{Bar, Problem};
use numerics::Interval;

use crate::run::closure::bar::size;
use crate::run::closure::signed;
use crate::run::count::topology::{Topology, TopologyError};
use crate::run::plane::face::Face;
use crate::run::plane::system::{System, at_first_joint};
use crate::run::slack::exact::ExactSides;
use crate::run::slack::unloaded::ways;

/// A set of equilibria of one energy, in which some bars carry nothing.
///
/// ```
/// use census::{Census, Settings};
/// use model::{Anchors, Bar, Chain, Problem};
/// // Two bars without mass between two that hang straight down: they hang slack.
/// let bars = [(0.9, 2.0), (0.5, 0.0), (0.6, 0.0), (0.7, 1.5)];
/// let bars = bars.map(|(l, m)| Bar::homogeneous(l, m)).into_iter().collect::<Result<_, _>>()?;
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [0.3, 0.0, -0.1] };
/// let problem = Problem::new(Chain::new("slack", 10.0, anchors, bars)?)?;
/// let census = Census::take(&problem, &Settings::default())?;
/// let hanging = census.families.iter().find(|family| family.signs == [1, 0, 0, 1]).unwrap();
/// // Heights of the centres, by hand: -0.45 m and -0.1 m - 0.35 m.
/// assert!((hanging.energy_j.mid() + 10.0 * (2.0 * 0.45 + 1.5 * 0.45)).abs() < 1e-14);
/// // They bridge what is left between -0.9 m and -0.8 m.
/// assert!((hanging.gap_m.mid() - 0.3_f64.hypot(0.1)).abs() < 1e-15);
/// assert_eq!(hanging.dimension_in_plane, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SlackFamily {
    /// +1 for each bar in tension, −1 in compression, 0 for the slack bars.
    pub signs: Vec<i8>,
    /// The pull of the chain on the first anchor along the horizontal direction and along Z, N; the
    /// first is zero.
    pub pull_n: [Interval; 2],
    /// Distance that the slack bars bridge, m.
    pub gap_m: Interval,
    /// Potential energy, measured from the height of joint 0.
    pub energy_j: Interval,
    /// Axial force of each bar, N.
    pub axial_n: Vec<Interval>,
    /// Directions in the plane, across the family, in which the energy falls.
    pub index_in_plane: usize,
    /// Dimension of the family in the plane: the number of slack bars less two, but one for those that
    /// only turn, folded, about a gap of nothing, and none for those that just bridge their gap.
    pub dimension_in_plane: usize,
    /// The family in the plane, if it is a manifold and the second derivative across it regular. Else
    /// the sides are slack bars, in their order, and last the gap.
    pub topology: Result<Topology, TopologyError>,
}

impl SlackFamily {
    /// Directions in space, across the family, in which the energy falls: each compressed bar can
    /// fall in the plane and out of it.
    pub fn index_in_space(&self) -> usize {
        2 * self.index_in_plane
    }

    /// Angle of each bar from the descending vertical, rad: 0 or π, and none for the slack bars.
    /// Without a horizontal pull the bars in force stand upright; bar i points the way of its
    /// force, the pull and the weight before it, times its sign.
    pub fn angles_rad(&self, problem: &Problem) -> Vec<Option<f64>> {
        let chain = problem.chain();
        let gravity = Interval::point(chain.gravity_m_s2());
        let mut before = self.pull_n[1];
        let angle = |(bar, sign): (&Bar, &i8)| {
            let force = before + at_first_joint(bar) * gravity;
            before = before + Interval::point(bar.mass_kg()) * gravity;
            let up = force.mid() * f64::from(*sign) > 0.0;
            (*sign != 0).then_some(if up { PI } else { 0.0 })
        };
        chain.bars().iter().zip(&self.signs).map(angle).collect()
    }
}

/// All families, sorted by group and pattern, and the signs of those that may or may not exist.
pub(crate) fn families(
    system: &System,
    exact: Option<&ExactSides>,
) -> (Vec<SlackFamily>, Vec<Vec<i8>>) {
    let mut found = vec![];
    let mut unclear = vec![];
    for (number, group) in system.groups.iter().enumerate().filter(|(_, group)| group.len() > 1) {
        let Ok(number) = u8::try_from(number) else { continue };
        let others: Vec<usize> = (0..system.bars()).filter(|i| !group.contains(i)).collect();
        for bits in 0..1_u32 << others.len() {
            let mut signs = vec![0_i8; system.bars()];
            for (k, i) in others.iter().enumerate() {
                signs[*i] = if bits >> (others.len() - 1 - k) & 1 == 0 { 1 } else { -1 };
            }
            match family(system, exact, &signs, number) {
                Existence::Proved(family) => found.push(*family),
                Existence::Refuted => {}
                Existence::Unclear => unclear.push(signs),
            }
        }
    }
    (found, unclear)
}

enum Existence {
    Proved(Box<SlackFamily>),
    Refuted,
    Unclear,
}

fn family(system: &System, exact: Option<&ExactSides>, signs: &[i8], group: u8) -> Existence {
    let at = system.group_weight(group);
    let mut gap = system.span;
    let mut hanging = Interval::ZERO;
    let mut forces = vec![];
    let (mut slack, mut up) = (vec![], vec![]);
    for (i, sign) in signs.iter().enumerate() {
        let (length, weight) = (system.length[i], system.weight[i]);
        if *sign == 0 {
            slack.push(length);
            forces.push(Interval::ZERO);
            up.push(0);
            continue;
        }
        // F = (0, c_i − c): its direction is up or down.
        let force = system.weights(Face::Around(group))[i];
        let Some(way) = force.sign().map(|way| sign * way) else { return Existence::Unclear };
        up.push(way);
        let rise = signed(way, length);
        gap[1] = gap[1] - rise;
        hanging = hanging + weight * rise;
        forces.push(signed(*sign, force.abs()));
    }
    let distance = match gap[0].sign() {
        Some(0) => gap[1].abs(),
        _ => size(gap),
    };
    let range = &system.groups[usize::from(group)];
    let closed = exact.filter(|sides| sides.gap_square(&up) == Some(0));
    let polygons = match closed {
        Some(sides) => closed_polygons(&slack, &sides.lengths[range.clone()]),
        None => match exact.and_then(|sides| bridging_side(system, sides, &up, range)) {
            // It is upright, and listed as straight.
            Some(_) if system.vertical => Err(Existence::Refuted),
            Some(side) => Ok((0, Err(TopologyError::Straight { sides: vec![side] }))),
            None => polygons(slack, distance),
        },
    };
    let (dimension_in_plane, topology) = match polygons {
        Ok(polygons) => polygons,
        Err(existence) => return existence,
    };
    let distance = if closed.is_some() { Interval::ZERO } else { distance };
    let newton = system.force_unit_n();
    let total: Interval = system.added.iter().copied().sum();
    let offset = Interval::point(system.offset);
    // The slack bars rise by what the others leave, at the weight of their group.
    let energy = (total - offset) * system.span[1] - hanging - at * gap[1];
    Existence::Proved(Box::new(SlackFamily {
        signs: signs.to_vec(),
        pull_n: [Interval::ZERO, system.pull_on_anchor_n([Interval::ZERO, -at - offset])[1]],
        gap_m: distance.scale(system.length_unit_m),
        energy_j: energy * newton * Interval::point(system.length_unit_m),
        axial_n: forces.into_iter().map(|force| force * newton).collect(),
        index_in_plane: signs.iter().filter(|sign| **sign < 0).count(),
        dimension_in_plane,
        topology,
    }))
}

/// Dimension and topology of a family.
type Polygons = (usize, Result<Topology, TopologyError>);

/// The polygons of slack bars and a gap that is not zero, if they certainly exist.
fn polygons(slack: Vec<Interval>, gap: Interval) -> Result<Polygons, Existence> {
    let dimension = slack.len().saturating_sub(2);
    let mut sides = slack;
    sides.push(gap);
    let total: Interval = sides.iter().copied().sum();
    // The polygon closes if and only if no side is longer than the others together.
    let mut strict = gap.lo() > 0.0;
    for side in &sides {
        let rest_less_side = total - *side - *side;
        if rest_less_side.hi() < 0.0 {
            return Err(Existence::Refuted);
        }
        strict &= rest_less_side.lo() > 0.0;
    }
    if !strict {
        return Err(Existence::Unclear);
    }
    Ok((dimension, counted(Topology::polygons(&sides))?))
}

/// The side that is as long as the others where slack bars have one way alone to bridge the gap that upright ones
/// leave: the gap, with all along it, or the longest bar, with the others back.
fn bridging_side(
    system: &System,
    sides: &ExactSides,
    up: &[i8],
    range: &Range<usize>,
) -> Option<usize> {
    let mut ways = ways(system, range).into_iter();
    let along = ways.find(|along| sides.just_bridges(up, range.clone(), along))?;
    let is_folded = along.contains(&-1);
    Some(if is_folded { along.iter().position(|way| *way > 0)? + 1 } else { along.len() + 1 })
}

/// The polygons of slack bars alone, which turn about a point: lengths as intervals, and in integers.
fn closed_polygons(slack: &[Interval], lengths: &[i128]) -> Result<Polygons, Existence> {
    let longest = lengths.iter().copied().max().unwrap_or(0);
    let rest = lengths.iter().sum::<i128>() - longest;
    match longest.cmp(&rest) {
        Ordering::Greater => Err(Existence::Refuted),
        // All in one line.
        Ordering::Equal => {
            let side = lengths.iter().position(|length| *length == longest).unwrap_or(0);
            Ok((1, Err(TopologyError::Straight { sides: vec![side + 1] })))
        }
        Ordering::Less => {
            let turned = Topology::polygons(slack).map(|polygons| polygons.times_circle());
            Ok((slack.len() - 2, counted(turned)?))
        }
    }
}

/// Too many sides to count leave a family unclear; no manifold is no reason against it.
fn counted(
    topology: Result<Topology, TopologyError>,
) -> Result<Result<Topology, TopologyError>, Existence> {
    match topology {
        Ok(_) | Err(TopologyError::Straight { .. }) => Ok(topology),
        Err(_) => Err(Existence::Unclear),
    }
}

#[cfg(test)]
mod tests {
    use model::{Bar, Problem};
    use numerics::Interval;

    use crate::run::Census;
    use crate::run::search::undecided::Reason;
    use crate::settings::Settings;

    /// Bars as (length, mass, centre).
    fn problem(bars: &[(f64, f64, f64)], end_m: [f64; 3]) -> Problem {
        let bars = bars.iter().map(|(l, m, r)| Bar::new(*l, *m, *r, [0.0; 3]).unwrap());
        samples::of_bars(10.0, bars, end_m)
    }

    fn census(bars: &[(f64, f64, f64)], end_m: [f64; 3]) -> Census {
        let problem = problem(bars, end_m);
        let census = Census::take(&problem, &Settings::default()).unwrap();
        assert_eq!(census.check(&problem), Ok(()));
        census
    }

    #[test]
    fn a_family_has_the_energy_and_the_forces_of_its_geometry() {
        let bars = [(0.9, 2.0, 0.3), (0.5, 0.0, 0.25), (0.6, 0.0, 0.3), (0.7, 1.5, 0.2)];
        let census = census(&bars, [0.3, 0.0, -0.1]);
        assert!(census.complete);
        let hanging = census.families.iter().find(|family| family.signs == [1, 0, 0, 1]).unwrap();
        // Bar 1 hangs from the start, bar 4 from the end: by hand, with g = 10 m/s².
        let energy = 10.0 * (2.0 * -0.3 + 1.5 * (-0.1 - 0.7 + 0.2));
        let gap = (0.3_f64.powi(2) + 0.1_f64.powi(2)).sqrt();
        let near = |interval: Interval, expected: f64| {
            (interval.mid() - expected).abs() < 1e-14 && interval.width() < 1e-13
        };
        assert!(near(hanging.energy_j, energy), "{:?}", hanging.energy_j);
        assert!(near(hanging.gap_m, gap));
        // Each hanging bar carries the part of its weight that falls on its free end.
        assert!(near(hanging.axial_n[0], 20.0 * 0.3 / 0.9));
        assert!(near(hanging.axial_n[3], 15.0 * 0.5 / 0.7));
        assert_eq!((hanging.index_in_plane, hanging.index_in_space()), (0, 0));
        // Both stand: each falls in the plane and out of it.
        let stand = census.families.iter().find(|family| family.signs == [-1, 0, 0, -1]).unwrap();
        assert_eq!((stand.index_in_plane, stand.index_in_space()), (2, 4));
        // From the first joint of each bar to its second: down from the start and up to the end, and the other way.
        let problem = problem(&bars, [0.3, 0.0, -0.1]);
        let half_turn = std::f64::consts::PI;
        for (family, ends) in [(hanging, [0.0, half_turn]), (stand, [half_turn, 0.0])] {
            let [first, last] = ends.map(Some);
            assert_eq!(family.angles_rad(&problem), [first, None, None, last]);
        }
        // No equilibrium is lower.
        let lowest = census.equilibria.first().map_or(f64::INFINITY, |e| e.energy_j.lo());
        assert!(hanging.energy_j.hi() < lowest);
    }

    /// Bar 1 down by 0.3 and bars 4 and 5 up by 0.1 and 0.2: as decimals they leave no gap, as doubles one
    /// of 3e-17, which intervals do not tell from none.
    #[test]
    fn a_gap_that_may_be_zero_is_not_decided() {
        let bars =
            [(0.3, 2.0, 0.1), (0.4, 0.0, 0.2), (0.4, 0.0, 0.2), (0.1, 1.5, 0.05), (0.2, 1.5, 0.1)];
        let census = census(&bars, [0.0; 3]);
        assert!(!census.complete);
        let unclear = census.undecided.iter().filter(|open| open.reason == Reason::Slack);
        assert!(unclear.flat_map(|open| &open.signs).any(|signs| signs == &[1, 0, 0, 1, 1]));
    }

    #[test]
    fn a_gap_out_of_reach_is_no_family() {
        // 0.4 + 0.4 cannot bridge what two hanging bars leave of a span of 1.5.
        let bars = [(0.9, 2.0, 0.3), (0.4, 0.0, 0.2), (0.4, 0.0, 0.2), (0.5, 1.5, 0.2)];
        let census = census(&bars, [1.5, 0.0, 0.0]);
        assert!(census.complete && census.families.is_empty());
    }
}
