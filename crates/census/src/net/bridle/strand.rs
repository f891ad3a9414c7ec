//! A bridle taken apart into its knot and the strands that hold it.

use std::ops::Range;

use numerics::Interval;

use crate::boxes::arithmetic::Vector;
use crate::net::knots::Core;

/// Bars in a row from an anchor to the knot.
#[derive(Debug, Clone)]
pub(super) struct Strand {
    /// From the anchor on.
    pub(super) members: Vec<usize>,
    /// Joints between its bars, from the anchor on.
    pub(super) joints: Vec<usize>,
    pub(super) anchor: Vector,
    pub(super) length: Vec<Interval>,
    /// The force of bar k is (H, V + weight) with the weights centred about zero.
    pub(super) weight: Vec<Interval>,
}

/// One joint that strands hold, in the units of the frame.
#[derive(Debug, Clone)]
pub(super) struct Bridle {
    pub(super) knot: usize,
    pub(super) load: Vector,
    pub(super) strands: Vec<Strand>,
}

impl Strand {
    /// Whether it is one bar alone: its direction is that to the knot, and its only unknown is the
    /// force density.
    pub(super) fn is_rod(&self) -> bool {
        self.length.len() == 1
    }

    /// Each bar for itself: joints between them bear loads.
    pub(super) fn groups(&self) -> Vec<Range<usize>> {
        (0..self.length.len()).map(|bar| bar..bar + 1).collect()
    }
}

impl Bridle {
    /// Nothing if the net has another shape, if a member is elastic or a rope, or if a joint of a strand bears
    /// no load or one that is not upright.
    pub(super) fn new(core: &Core) -> Option<Self> {
        let knots: Vec<usize> =
            core.joints.iter().copied().filter(|joint| core.meeting(*joint).len() != 2).collect();
        let [knot] = knots[..] else { return None };
        let strands = core.meeting(knot).into_iter();
        let strands = strands.map(|(member, next)| walk(core, knot, member, next));
        Some(Self { knot, load: core.loads[knot], strands: strands.collect::<Option<_>>()? })
    }

    pub(super) fn bars(&self) -> usize {
        self.strands.iter().map(|strand| strand.length.len()).sum()
    }

    /// The number of bars of the longest strand.
    pub(super) fn longest(&self) -> usize {
        self.strands.iter().map(|strand| strand.length.len()).max().unwrap_or(0)
    }

    /// Where the unknowns of a strand begin among those of a box: after the place of the knot.
    pub(super) fn first(&self, strand: usize) -> usize {
        let unknowns = |strand: &Strand| if strand.is_rod() { 1 } else { 2 };
        3 + self.strands[..strand].iter().map(unknowns).sum::<usize>()
    }

    /// All places of the knot that the strands reach; nothing if there is none.
    pub(super) fn whole(&self) -> Option<Vector> {
        let mut at = [Interval::LINE; 3];
        for strand in &self.strands {
            let total: Interval = strand.length.iter().copied().sum();
            let reach = Interval::new(-total.hi(), total.hi());
            for (part, centre) in at.iter_mut().zip(strand.anchor) {
                *part = part.intersect(centre + reach)?;
            }
        }
        Some(at)
    }
}

/// From the knot to the anchor.
fn walk(core: &Core, knot: usize, member: usize, next: usize) -> Option<Strand> {
    let (mut members, mut joints) = (vec![member], vec![]);
    let mut here = next;
    while !core.held(here) {
        if here == knot {
            return None;
        }
        let last = members[members.len() - 1];
        let (member, there) = core.meeting(here).into_iter().find(|(member, _)| *member != last)?;
        joints.push(here);
        members.push(member);
        here = there;
    }
    let at_m = core.system.joints()[here].support.at_m()?;
    members.reverse();
    joints.reverse();
    if !members.iter().all(|member| core.is_rod(*member)) {
        return None;
    }
    // The force of the next bar is that of this one less the load between them.
    let mut raw = vec![Interval::ZERO];
    for (k, joint) in joints.iter().enumerate() {
        let [x, y, z] = core.loads[*joint];
        // Two bars that nothing turns can fold or lie straight under any force.
        if x != Interval::ZERO || y != Interval::ZERO || z.contains(0.0) {
            return None;
        }
        raw.push(raw[k] - z);
    }
    let (least, most) = raw
        .iter()
        .fold((0.0_f64, 0.0_f64), |(least, most), c| (least.min(c.mid()), most.max(c.mid())));
    let centre = Interval::point(0.5 * (least + most));
    Some(Strand {
        length: members.iter().map(|member| core.length(*member)).collect(),
        weight: raw.into_iter().map(|c| c - centre).collect(),
        anchor: core.frame.place(at_m),
        members,
        joints,
    })
}

/// Where a strand ends if the knot is in a box: the horizontal direction to it, distance and rise.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// From the anchor to the knot.
    pub(super) arm: Vector,
    /// The horizontal and the vertical part of the way from the anchor to the knot.
    pub(super) way: [Interval; 2],
    /// The horizontal direction; nothing where the knot may stand over or under the anchor.
    pub(super) toward: Option<[Interval; 2]>,
}

impl Span {
    pub(super) fn new(strand: &Strand, knot: &Vector) -> Self {
        let arm: Vector = std::array::from_fn(|k| knot[k] - strand.anchor[k]);
        let [x, y, z] = arm;
        let distance = (x.square() + y.square()).sqrt();
        let toward = (distance.lo() > 0.0).then(|| {
            let unit = Interval::new(-1.0, 1.0);
            [x, y].map(|part| (part / distance).intersect(unit).unwrap_or(unit))
        });
        Self { arm, way: [distance, z], toward }
    }

    /// A vector of the plane of the strand in the world frame; all its turns where the plane is
    /// unknown.
    pub(super) fn world(&self, [along, up]: [Interval; 2]) -> Vector {
        if let Some([x, y]) = self.toward {
            return [along * x, along * y, up];
        }
        let any = Interval::new(-along.mag(), along.mag());
        [any, any, up]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::arithmetic::points;

    fn strand(anchor: [f64; 3], lengths: &[f64]) -> Strand {
        Strand {
            members: vec![],
            joints: vec![],
            anchor: points(anchor),
            length: lengths.iter().copied().map(Interval::point).collect(),
            weight: vec![Interval::ZERO; lengths.len()],
        }
    }

    /// Two strands of 3 and 2 from anchors 4 apart: what both reach, but for corners.
    #[test]
    fn places_are_those_that_all_strands_reach() {
        let strands = vec![strand([0.0; 3], &[2.0, 1.0]), strand([4.0, 0.0, 1.0], &[2.0])];
        let bridle = Bridle { knot: 0, load: points([0.0, 0.0, -1.0]), strands };
        assert_eq!([0, 1].map(|k| bridle.strands[k].is_rod()), [false, true]);
        assert_eq!((bridle.bars(), bridle.longest()), (3, 2));
        assert_eq!([0, 1, 2].map(|k| bridle.first(k)), [3, 5, 6]);
        let whole = bridle.whole().unwrap();
        for (part, [lo, hi]) in whole.into_iter().zip([[2.0, 3.0], [-2.0, 2.0], [-1.0, 3.0]]) {
            assert!(part.encloses(Interval::new(lo, hi)) && part.width() < hi - lo + 1e-14);
        }
        let far =
            Bridle { strands: vec![strand([0.0; 3], &[1.0]), strand([4.0; 3], &[2.0])], ..bridle };
        assert!(far.whole().is_none());
    }
}
