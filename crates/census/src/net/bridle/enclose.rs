//! From a zero found by the search to places of all joints and forces of all members, enclosed by
//! the proof that knows nothing of the search; and its index.

use model::Vector as Point;
use numerics::Interval;

use super::newton::{Found, cell};
use super::pulls::density;
use super::strand::{Bridle, Span};
use crate::boxes::arithmetic::{Vector, dot, minus, norm, product};
use crate::net::choice::Choice;
use crate::net::knots::Core;
use crate::net::knots::enclose::Proved;
use crate::run::closure::bar::unit;
use crate::run::closure::signed;
use crate::run::plane::face::Face;

/// An equilibrium of the bridle, enclosed.
pub(super) struct Enclosed {
    pub(super) choice: Choice,
    places: Vec<Vector>,
    /// Axial forces of all members.
    axial: Vec<Interval>,
}

impl Enclosed {
    /// Whether it is the equilibrium that is alone in the box of a zero.
    pub(super) fn is(&self, bridle: &Bridle, found: &Found) -> bool {
        let inside =
            |all: &Interval, part: Option<Interval>| part.is_some_and(|part| all.encloses(part));
        let knot = self.places[bridle.knot];
        if !found.alone_in.iter().zip(knot).all(|(all, part)| inside(all, Some(part))) {
            return false;
        }
        bridle.strands.iter().enumerate().all(|(i, strand)| {
            let signs = found.charts.patterns[i].signs(strand.members.len());
            let mut same = strand.members.iter().zip(signs);
            // The sign of a bar alone is that of its density.
            let same = strand.is_rod()
                || same.all(|(member, sign)| self.axial[*member].sign() == Some(sign));
            let pull = self.pull(bridle, i, found.charts.faces[i]);
            let all = cell(bridle, &found.charts, &found.alone_in, i).at;
            same && (0..2).all(|k| inside(&all[k], pull.map(|pull| pull[k])))
        })
    }

    /// Whether both are proved to be two: some place or force of theirs is apart.
    pub(super) fn differs(&self, other: &Self) -> bool {
        let apart = |(a, b): (&Interval, &Interval)| a.intersect(*b).is_none();
        let places = self.places.as_flattened().iter().zip(other.places.as_flattened());
        places.chain(self.axial.iter().zip(&other.axial)).any(apart)
    }

    /// The pull of a strand in a chart; nothing if it is not one of this chart.
    fn pull(&self, bridle: &Bridle, i: usize, face: Face) -> Option<[Interval; 2]> {
        let strand = &bridle.strands[i];
        let over = |part: Interval, divisor: Interval| (divisor.lo() > 0.0).then(|| part / divisor);
        let one = Interval::ONE;
        if strand.is_rod() {
            let density = self.axial[strand.members[0]] / strand.length[0];
            let at = match face {
                Face::Left => over(one, -density)?,
                Face::Right => over(one, density)?,
                _ => density,
            };
            return Some([at, Interval::ZERO]);
        }
        let [x, y] = Span::new(strand, &self.places[bridle.knot]).toward?;
        let first = strand.joints.first().map_or(bridle.knot, |joint| *joint);
        let arm = minus(self.places[first], strand.anchor);
        let size = product(self.axial[strand.members[0]], Interval::ONE / norm(arm));
        let force: Vector = arm.map(|part| product(part, size));
        let h = dot(force, [x, y, Interval::ZERO]);
        let v = force[2] - strand.weight[0];
        Some(match face {
            Face::Near | Face::Around(_) => [h, v],
            Face::Left => [over(v, -h)?, over(one, -h)?],
            Face::Right => [over(v, h)?, over(one, h)?],
            Face::Below => [over(h, -v)?, over(one, -v)?],
            Face::Above => [over(h, v)?, over(one, v)?],
        })
    }
}

/// Enclose a zero; nothing if that is not proved, or if it may not be the one of the search.
pub(super) fn enclosed(core: &Core, bridle: &Bridle, found: &Found) -> Option<Enclosed> {
    let Proved { places, choice, .. } = Proved::next_to(core, &[], &start(core, bridle, found))?;
    let mut axial = vec![Interval::ZERO; core.system.members().len()];
    for (member, force) in &choice.axial {
        axial[*member] = *force;
    }
    let enclosed = Enclosed { choice, places, axial };
    enclosed.is(bridle, found).then_some(enclosed)
}

/// Places of all joints, m, and axial forces, N, next to a zero.
fn start(core: &Core, bridle: &Bridle, found: &Found) -> (Vec<Point>, Vec<f64>) {
    let frame = core.frame;
    let mut joints_m = core.places_m();
    let mut axial_n = vec![0.0; core.system.members().len()];
    let at: Vec<Interval> = found.at.iter().copied().map(Interval::point).collect();
    let knot = [at[0], at[1], at[2]];
    let mut put = |joint: usize, place: Vector| {
        joints_m[joint] = frame.place_m(place).map(Interval::mid);
    };
    put(bridle.knot, knot);
    for (i, strand) in bridle.strands.iter().enumerate() {
        let span = Span::new(strand, &knot);
        let cell = cell(bridle, &found.charts, &at, i);
        if strand.is_rod() {
            let [t, w] = density(&cell);
            let axial = t / w * strand.length[0];
            axial_n[strand.members[0]] = axial.mid() * frame.force_n;
            continue;
        }
        let [_, _, w] = cell.homogeneous();
        let mut here = strand.anchor;
        let bars = strand.length.len();
        for (k, sign) in found.charts.patterns[i].signs(bars).enumerate() {
            let force = cell.force(strand.weight[k]);
            let size = norm([force[0], force[1], Interval::ZERO]) / w;
            axial_n[strand.members[k]] = signed(sign, size).mid() * frame.force_n;
            let arm = unit(force).map(|part| signed(sign, part) * strand.length[k]);
            let arm = span.world(arm);
            here = std::array::from_fn(|k| here[k] + arm[k]);
            if let Some(joint) = strand.joints.get(k) {
                put(*joint, here);
            }
        }
    }
    (joints_m, axial_n)
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, System};

    use super::*;
    use crate::boxes::arithmetic::points;
    use crate::boxes::frame::Frame;
    use crate::net::bridle::newton::Charts;
    use crate::net::bridle::strand::Strand;
    use crate::run::closure::Pattern;

    /// A strand of two bars with the forces (12, −16)/16 and (12, −5)/16, 11/16 between them: slopes
    /// of 3, 4, 5 and of 5, 12, 13. A bar alone comes from the other side of the knot.
    fn bridle() -> Bridle {
        let all = |numbers: &[f64]| numbers.iter().copied().map(Interval::point).collect();
        let several = Strand {
            members: vec![0, 1],
            joints: vec![1],
            anchor: points([0.0; 3]),
            length: all(&[1.25, 0.8125]),
            weight: all(&[-0.34375, 0.34375]),
        };
        let alone = Strand {
            members: vec![2],
            joints: vec![],
            anchor: points([1.5, 1.25, -1.3125]),
            length: all(&[1.25]),
            weight: all(&[0.0]),
        };
        Bridle { knot: 0, load: points([0.0; 3]), strands: vec![several, alone] }
    }

    const PLACES: [[f64; 3]; 4] =
        [[1.5, 0.0, -1.3125], [0.75, 0.0, -1.0], [0.0; 3], [1.5, 1.25, -1.3125]];

    fn enclosed(alone: f64) -> Enclosed {
        Enclosed {
            choice: Choice::default(),
            places: PLACES.map(points).to_vec(),
            axial: [1.25, 0.8125, alone].map(Interval::point).to_vec(),
        }
    }

    #[test]
    fn pulls_are_told_in_every_chart() {
        let faces = [Face::Near, Face::Left, Face::Right, Face::Below, Face::Above];
        let (h, v) = (0.75, 0.65625);
        let several = [Some([h, -v]), None, Some([-v / h, 1.0 / h]), Some([h / v, 1.0 / v]), None];
        // 5/2 over 5/4 is a density of 2.
        let pulled = [Some([2.0, 0.0]), None, Some([0.5, 0.0])];
        let pushed = [Some([-2.0, 0.0]), Some([0.5, 0.0]), None];
        let is = |strand: usize, alone: f64, expected: &[Option<[f64; 2]>]| {
            for (face, expected) in faces.into_iter().zip(expected) {
                let found = enclosed(alone).pull(&bridle(), strand, face);
                let near = found.zip(*expected).is_none_or(|(found, expected)| {
                    let mut both = found.into_iter().zip(expected);
                    both.all(|(part, x)| (part.mid() - x).abs() < 1e-14 && part.width() < 1e-14)
                });
                assert!(near && found.is_some() == expected.is_some(), "{face:?} {found:?}");
            }
        };
        is(0, 2.5, &several);
        is(1, 2.5, &pulled);
        is(1, -2.5, &pushed);
    }

    #[test]
    fn what_is_apart_in_some_force_or_place_differs() {
        let mut other = enclosed(2.5);
        assert!(!other.differs(&enclosed(2.5)) && other.differs(&enclosed(2.25)));
        other.places[1] = points([0.75, 1.0, -1.0]);
        assert!(other.differs(&enclosed(2.5)));
    }

    /// Newton's method starts in metres and newtons: from units of 2 m and 4 N about (10, 20, 30) m.
    #[test]
    fn the_start_is_in_the_units_of_the_system() {
        let frame = Frame { length_m: 2.0, force_n: 4.0, origin_m: [10.0, 20.0, 30.0] };
        let placed = |k: usize| [0, 1, 2].map(|i| frame.origin_m[i] + 2.0 * PLACES[k][i]);
        let light = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let joints = vec![
            Joint::free("knot").with_mass(1.0),
            Joint::free("P").with_mass(1.0),
            Joint::anchor("A", placed(2)),
            Joint::anchor("B", placed(3)),
        ];
        let members = vec![
            Member::bar(2, 1, light(2.5)),
            Member::bar(1, 0, light(1.625)),
            Member::bar(3, 0, light(2.5)),
        ];
        let system = System::new("start", 10.0, joints, members).unwrap();
        let core = Core {
            system: &system,
            frame: &frame,
            joints: &[0, 1],
            members: &[0, 1, 2],
            loads: &[],
        };
        let charts =
            Charts { faces: vec![Face::Near, Face::Near], patterns: vec![Pattern(0), Pattern(0)] };
        // The place of the knot, a pull, a density of 3/4.
        let [x, y, z] = PLACES[0];
        let found = Found { charts, alone_in: vec![], at: vec![x, y, z, 0.75, -0.65625, 0.75] };
        let (joints_m, axial_n) = start(&core, &bridle(), &found);
        for (k, at_m) in joints_m.iter().enumerate() {
            let near = at_m.iter().zip(placed(k)).all(|(a, b)| (a - b).abs() < 1e-13);
            assert!(near, "{k}: {at_m:?}");
        }
        for (found, expected) in axial_n.iter().zip([5.0, 3.25, 3.75]) {
            assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        }
    }
}
