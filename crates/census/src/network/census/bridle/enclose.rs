//! From a zero found by the search to places of all joints and forces of all members, enclosed by
//! the proof that knows nothing of the search; and its index.

use intervals::Interval;
use model::Vector as Point;

use super::newton::{Found, cell};
use super::pulls::density;
use super::strand::{Bridle, Span};
use crate::closure::bar::unit;
use crate::closure::signed;
use crate::network::arithmetic::{Vector, dot, minus, norm, product};
use crate::network::census::choice::Choice;
use crate::network::census::net::Core;
use crate::network::census::net::enclose::equations;
use crate::network::census::net::inertia::index;
use crate::network::krawczyk::prove_zero;
use crate::network::newton::refine;
use crate::plane::face::Face;

/// An equilibrium of the bridle, enclosed.
pub(super) struct Enclosed {
    pub(super) choice: Choice,
    /// Places of all joints.
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
    let equations = equations(core);
    let (joints_m, axial_n) = start(core, bridle, found);
    let start = equations.start(&joints_m, &axial_n);
    let refined = refine(&equations, &start).ok()?;
    let zero = prove_zero(&equations, &refined).ok()?;
    let places = equations.places(&zero.tight);
    let mut axial = vec![Interval::ZERO; core.system.members().len()];
    let mut choice = Choice::default();
    choice.places.extend(core.joints.iter().map(|joint| (*joint, places[*joint])));
    for acting in &equations.acting {
        let [a, b] = acting.ends.map(|joint| places[joint]);
        let force = product(zero.tight[acting.density], norm(minus(b, a)));
        axial[acting.member] = force;
        choice.axial.push((acting.member, force));
    }
    choice.index = [index(&equations, &zero.tight)?, 0];
    let enclosed = Enclosed { choice, places, axial };
    enclosed.is(bridle, found).then_some(enclosed)
}

/// Places of all joints, m, and axial forces, N, next to a zero.
fn start(core: &Core, bridle: &Bridle, found: &Found) -> (Vec<Point>, Vec<f64>) {
    let frame = core.frame;
    let joints = core.system.joints();
    let mut joints_m: Vec<Point> =
        joints.iter().map(|joint| joint.support.at_m().unwrap_or(frame.origin_m)).collect();
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
