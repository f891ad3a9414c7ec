//! The chain along a path of parameters, as a planar one in units of its own.

use std::cmp::Ordering;
use std::sync::Arc;

use model::system::System;
use model::{Anchors, Problem};
use numerics::lever;

use crate::frame::Frames;
use crate::parameter::apply::PointError;
use crate::parameter::base::ends;
use crate::parameter::system::Unchecked;
use crate::variation::Variation;

/// A path and the planar chains along it.
pub(crate) struct Path<'a> {
    variation: &'a Variation,
    row: Arc<Order>,
    pub(crate) values: &'a [Vec<f64>],
    pub(crate) frames: Arc<Frames>,
    /// The interval between two points whose straight line the path is taken for, everywhere.
    only: Option<usize>,
}

/// The joints of a row in their order, and the member between each two, with whether it runs the other
/// way.
struct Order {
    joints: Vec<usize>,
    members: Vec<(usize, bool)>,
}

impl Order {
    /// Without value for what is no row.
    fn of(system: &System) -> Option<Self> {
        let in_order = || ends(system).map(|[first, last]| (first..=last).collect());
        let joints: Vec<usize> = match system.as_row() {
            Some(row) => row.joints().collect(),
            None => in_order()?,
        };
        let between = |two: &[usize]| {
            let mut members = system.members().iter().enumerate();
            members.find_map(|(k, member)| match [member.from, member.to] {
                ends if ends == [two[0], two[1]] => Some((k, false)),
                ends if ends == [two[1], two[0]] => Some((k, true)),
                _ => None,
            })
        };
        let members = joints.windows(2).map(between).collect::<Option<_>>()?;
        Some(Self { joints, members })
    }

    fn anchors(&self, system: &Unchecked) -> Option<Anchors> {
        let at_m = |joint: Option<&usize>| system.joints[*joint?].support.at_m();
        Some(Anchors { start_m: at_m(self.joints.first())?, end_m: at_m(self.joints.last())? })
    }
}

/// A chain in its vertical plane: lengths in its total length, weights centred and in half their
/// spread.
#[derive(Debug, Clone)]
pub(crate) struct PlanarChain {
    /// $l_i$.
    pub(crate) length: Vec<f64>,
    /// $c_i$, from −1 to 1.
    pub(crate) weight: Vec<f64>,
    /// $D$: horizontal, vertical.
    pub(crate) span: [f64; 2],
    /// Unit of length, m.
    pub(crate) length_unit_m: f64,
    /// Unit of force, N.
    pub(crate) force_unit_n: f64,
    /// What was taken from all $c_i$, N.
    pub(crate) offset_n: f64,
    /// All weight, N.
    pub(crate) total_n: f64,
}

impl PlanarChain {
    /// Distance of the anchors, m.
    pub(crate) fn span_m(&self) -> f64 {
        self.length_unit_m * self.span[0].hypot(self.span[1])
    }
}

/// Steps that differ by less than this part of the values are equal: roundings of a range.
const BEND: f64 = 1e-9;

impl<'a> Path<'a> {
    /// Without value where the system is no row of bars.
    pub(crate) fn new(variation: &'a Variation, values: &'a [Vec<f64>]) -> Option<Self> {
        let row = Order::of(variation.base())?;
        let span = |values: &Vec<f64>| {
            let [x, y, _] = row.anchors(&variation.unchecked(values))?.difference_m();
            Some([x, y])
        };
        let spans: Vec<[f64; 2]> = values.iter().map(span).collect::<Option<_>>()?;
        let frames = Arc::new(Frames::new(&spans));
        Some(Self { variation, row: Arc::new(row), values, frames, only: None })
    }

    /// The path between two positions, going on straight beyond them: what comes after a bend says
    /// nothing about the curves before it. The path itself if there are points between the
    /// positions.
    pub(crate) fn within(&self, low: f64, high: f64) -> Self {
        let (interval, _) = self.interval(0.5 * (low + high));
        let inside = self.position(interval) <= low && high <= self.position(interval + 1);
        Self {
            variation: self.variation,
            row: Arc::clone(&self.row),
            values: self.values,
            frames: Arc::clone(&self.frames),
            only: inside.then_some(interval),
        }
    }

    /// Whether the path has a corner in the point of this number.
    pub(crate) fn bends(&self, point: usize) -> bool {
        if point == 0 || point + 1 >= self.values.len() {
            return false;
        }
        let rows = [point - 1, point, point + 1].map(|k| &self.values[k]);
        (0..rows[0].len()).any(|k| {
            let [before, here, after] = rows.map(|row| row[k]);
            let size = before.abs().max(here.abs()).max(after.abs());
            (after - 2.0 * here + before).abs() > BEND * size
        })
    }

    /// Whether the numbers at a position are in their ranges and some weight is not on the anchors,
    /// so that there are equations. The chain may still be out of reach.
    pub(crate) fn is_chain(&self, position: f64) -> bool {
        let problem = self.problem(&self.values_at(position));
        !matches!(problem, Err(PointError::Bar { .. } | PointError::System(_) | PointError::NoRow))
            && self.plane(position).force_unit_n > 0.0
    }

    pub(crate) fn bars(&self) -> usize {
        self.row.members.len()
    }

    pub(crate) fn position(&self, point: usize) -> f64 {
        point as f64 / (self.values.len() - 1).max(1) as f64
    }

    /// The interval that holds a position, and how far into it.
    fn interval(&self, position: f64) -> (usize, f64) {
        let intervals = self.values.len().saturating_sub(1).max(1);
        let at = position * intervals as f64;
        if let Some(k) = self.only {
            return (k, at - k as f64);
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let k = (at.floor().clamp(0.0, (intervals - 1) as f64)) as usize;
        (k, at - k as f64)
    }

    /// The values of the parameters at a position, on or off the grid, beyond its ends too.
    pub(crate) fn values_at(&self, position: f64) -> Vec<f64> {
        if self.values.len() == 1 {
            return self.values[0].clone();
        }
        let (k, part) = self.interval(position);
        let between = |(a, b): (&f64, &f64)| {
            // The points of the grid are met exactly.
            match part.total_cmp(&1.0) {
                _ if part.abs() <= 0.0 => *a,
                Ordering::Equal => *b,
                _ => a * (1.0 - part) + b * part,
            }
        };
        self.values[k].iter().zip(&self.values[k + 1]).map(between).collect()
    }

    pub(crate) fn problem(&self, values: &[f64]) -> Result<Problem, PointError> {
        self.variation.problem(values)
    }

    /// The planar chain at a position; nothing is checked. A weight at a joint is carried with the bar
    /// before it.
    pub(crate) fn plane(&self, position: f64) -> PlanarChain {
        let system = self.variation.unchecked(&self.values_at(position));
        let g = system.gravity_m_s2;
        let anchors = self.row.anchors(&system);
        let [x, y, z] = anchors.map_or([f64::NAN; 3], |anchors| anchors.difference_m());
        let horizontal = self.frames.signed(self.interval(position).0, [x, y]);
        let bars =
            || self.row.members.iter().map(|(k, turned)| (&system.members[*k].body, *turned));
        let unit = model::sum(bars().map(|(bar, _)| bar.length_m));
        let mut carried = 0.0;
        let mut raw = Vec::with_capacity(self.bars());
        for ((bar, turned), joint) in bars().zip(&self.row.joints[1..]) {
            let joint = &system.joints[*joint];
            let [first, second] = lever(bar.length_m, bar.centre_m());
            raw.push(carried + bar.mass_kg * if turned { second } else { first });
            carried += bar.mass_kg + (joint.mass_kg - joint.force_n[2] / g);
        }
        let (first, last) = (raw[0], raw[raw.len() - 1]);
        let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
        PlanarChain {
            length: bars().map(|(bar, _)| bar.length_m / unit).collect(),
            weight: raw.iter().map(|c| (c - middle) / half).collect(),
            span: [horizontal / unit, z / unit],
            length_unit_m: unit,
            force_unit_n: half * g,
            offset_n: middle * g,
            total_n: carried * g,
        }
    }

    /// +1 where the census looks along the direction of the plane, −1 where against it.
    pub(crate) fn facing(&self, position: f64) -> f64 {
        if self.plane(position).span[0] < 0.0 { -1.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variation::Combine;

    fn variation() -> Variation {
        let vary = [
            "anchors.end_m.z=-2,-1.5,-1,-1", "bars.2.mass_kg=1,2,3,6",
            "anchors.end_m.x=0.25,0.25,0.25,0.5",
        ];
        let vary: Vec<_> = vary.iter().map(|text| text.parse().unwrap()).collect();
        let chain = model::cases::paper().into_chain();
        Variation::new(&chain, &vary, Combine::Zip).unwrap()
    }

    fn near(found: &[f64], wanted: &[f64]) {
        let same = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-14;
        assert!(
            found.len() == wanted.len() && found.iter().zip(wanted).all(same),
            "{found:?} {wanted:?}"
        );
    }

    #[test]
    fn values_go_straight_from_point_to_point() {
        let variation = variation();
        let path = Path::new(&variation, &variation.paths()[0]).unwrap();
        assert_eq!(
            [0, 1, 2, 3].map(|point| path.position(point).to_bits()),
            [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(f64::to_bits)
        );
        near(&path.values_at(0.1), &[-1.85, 1.3, 0.25]);
        near(&path.values_at(0.5), &[-1.25, 2.5, 0.25]);
        near(&path.values_at(0.75), &[-1.0, 3.75, 0.3125]);
        // On beyond the ends.
        near(&path.values_at(1.1), &[-1.0, 6.9, 0.575]);
        near(&path.values_at(-0.1), &[-2.15, 0.7, 0.25]);
        // The third point is a corner alone.
        assert_eq!([0, 1, 2, 3].map(|point| path.bends(point)), [false, false, true, false]);
        assert!(path.is_chain(0.2) && !path.is_chain(-0.4));
    }

    /// Within one interval it goes on as there; across a point it is the path itself.
    #[test]
    fn a_path_within_an_interval_goes_on_straight() {
        let variation = variation();
        let path = Path::new(&variation, &variation.paths()[0]).unwrap();
        near(&path.within(0.35, 0.65).values_at(0.9), &[-0.65, 3.7, 0.25]);
        near(&path.within(1.0 / 3.0, 2.0 / 3.0).values_at(0.2), &[-1.7, 1.6, 0.25]);
        near(&path.within(0.5, 0.75).values_at(0.9), &path.values_at(0.9));
        near(&path.within(0.2, 0.5).values_at(0.9), &path.values_at(0.9));
    }

    /// Lengths in the total, weights from -1 to 1 by the levers of the bars, the span in the plane; a bar
    /// that is written from its end, a mass and a force at joints.
    #[test]
    fn the_plane_chain_is_that_of_the_numbers() {
        use model::Bar;
        use model::system::{Joint, Member};
        let bar = |length, mass, centre| Bar::new(length, mass, centre, [0.0; 3]).unwrap();
        let joints = vec![
            Joint::anchor("A", [1.0, 2.0, 3.0]),
            Joint::free("P").with_mass(0.5),
            Joint::free("Q").with_force([0.0, 0.0, -12.0]),
            Joint::anchor("B", [4.0, 6.0, 1.0]),
        ];
        let members = vec![
            Member::bar(0, 1, bar(2.0, 3.0, 0.5)),
            Member::bar(2, 1, bar(1.0, 2.0, 0.25)),
            Member::bar(2, 3, bar(5.0, 1.0, 2.0)),
        ];
        let system = System::new("", 10.0, joints, members).unwrap();
        let vary = ["gravity_m_s2=10,20".parse().unwrap()];
        let variation = Variation::new(system, &vary, Combine::Product).unwrap();
        let path = Path::new(&variation, &variation.paths()[0]).unwrap();
        assert_eq!(path.bars(), 3);
        let plane = path.plane(0.5);
        near(&plane.length, &[0.25, 0.125, 0.625]);
        // What is before each bar, and of its own mass the share at its first joint: 3/4, 1/4, 3/5; 0.5 kg,
        // and 12 N under 15 m/s^2.
        let raw = [3.0 * 0.75, 3.5 + 2.0 * 0.25, 5.5 + 0.8 + 0.6];
        let (middle, half) = (0.5 * (raw[0] + raw[2]), 0.5 * (raw[2] - raw[0]));
        near(&plane.weight, &raw.map(|c| (c - middle) / half));
        near(&[plane.offset_n, plane.force_unit_n], &[15.0 * middle, 15.0 * half]);
        near(&plane.span, &[5.0 / 8.0, -2.0 / 8.0]);
        assert!((plane.span_m() - 29.0_f64.sqrt()).abs() < 1e-14);
        assert!(
            (plane.total_n - 7.3 * 15.0).abs() < 1e-12 && (plane.length_unit_m - 8.0).abs() < 1e-15
        );
    }
}
