//! Stiffness, inertia and constraints about an equilibrium in a box.

use std::collections::BTreeMap;

use model::Bar;
use model::system::{Kind, Support, System};
use nalgebra::DMatrix;
use numerics::Interval;
use numerics::vector::{cross, dot, minus};

use super::{EquilibriumBox, NotEnclosed};
use crate::corners::{is_symmetric, second_axis};
use crate::mechanism::{Link, Mechanism};

pub(super) type Vector = [Interval; 3];

/// Coordinates and values; zero elsewhere.
pub(super) type Row = Vec<(usize, Interval)>;

/// Relative rounding of `m l²/12` and of what a file makes of other moments: three roundings and
/// one to spare.
const MOMENT_ROUNDING: f64 = 2.0 * f64::EPSILON;

/// A span between two slots with its stiffness `ρ I + (k' − ρ) u uᵀ` and its inertia; in a rope `k'`
/// is zero.
struct Member {
    a: usize,
    b: usize,
    /// `ρ`: axial force over the length of the span, N/m.
    density: Interval,
    /// `k' − ρ`, N/m, and `u`; none for a rigid bar.
    along: Option<(Interval, Vector)>,
    /// `b` of the matrix of inertia, kg.
    between: Interval,
}

/// What the greater of two different moments across a bar adds to the inertia of the difference of
/// its ends, along an axis.
struct Excess {
    a: usize,
    b: usize,
    /// kg.
    inertia: Interval,
    axis: Vector,
}

/// Everything that the `ω²` follow from, in intervals. Coordinates are three for each slot that
/// moves.
pub(super) struct Pencil {
    pub moving: usize,
    /// Diagonal of the inertia by slot, kg.
    mass: Vec<Interval>,
    members: Vec<Member>,
    excesses: Vec<Excess>,
    /// Of elastic ropes `EA/L`, N/m, and the gradient of the length.
    lengths: Vec<(Interval, Row)>,
    /// Rows of the constraints: coordinate and value.
    pub rows: Vec<Row>,
}

impl Pencil {
    /// `mechanism` has bars for the taut cables and struts of the system as given.
    pub(super) fn new(
        system: &System,
        mechanism: &Mechanism,
        at: &EquilibriumBox<'_>,
    ) -> Result<Self, NotEnclosed> {
        let joints = mechanism.system.joints();
        let by_slot = |slot: usize| mechanism.joint_at[slot];
        let mut found = Self {
            moving: mechanism.moving,
            mass: (0..joints.len()).map(|s| Interval::point(joints[by_slot(s)].mass_kg)).collect(),
            members: Vec::new(),
            excesses: Vec::new(),
            lengths: Vec::new(),
            rows: Vec::new(),
        };
        let span = |link: &Link| minus(at.joints_m[by_slot(link.b)], at.joints_m[by_slot(link.a)]);
        for bar in &mechanism.bars {
            let axial = at.axial_n[bar.member];
            let is_held = match system.members()[bar.member].kind {
                Kind::Bar => true,
                Kind::Cable => axial.sign() == Some(1),
                Kind::Strut => axial.sign() == Some(-1),
            };
            if !is_held {
                return Err(NotEnclosed::Undecided { member: bar.member + 1 });
            }
            let spans = mechanism.of(&bar.spans);
            if let [link] = spans {
                let d = span(link);
                found.add_excess(&system.members()[bar.member].body, link, d);
                found.add(mechanism, link, axial / Interval::point(bar.length_m), None);
                found.rows.push(found.row(&[(link.a, d.map(|x| -x)), (link.b, d)]));
            } else {
                let row = found.add_spans(mechanism, spans, &span, axial, Interval::ZERO);
                found.rows.push(row);
            }
        }
        for spring in &mechanism.springs {
            let (spans, axial) = (mechanism.of(&spring.spans), at.axial_n[spring.member]);
            let length = spans.iter().map(|link| size(span(link))).sum();
            if is_slack(spring.kind, length, spring.length_m) && axial == Interval::ZERO {
                for link in spans {
                    found.add(mechanism, link, Interval::ZERO, None);
                }
                continue;
            }
            let is_extensible = spring.stiffness_n > 0.0;
            let slope = match (spring.kind, axial.sign().filter(|_| is_extensible)) {
                (Kind::Bar, _) | (Kind::Cable, Some(1)) | (Kind::Strut, Some(-1)) => {
                    Interval::point(spring.stiffness_n) / Interval::point(spring.length_m)
                }
                _ => return Err(NotEnclosed::Undecided { member: spring.member + 1 }),
            };
            let is_rope = spans.len() > 1;
            let own = if is_rope { Interval::ZERO } else { slope };
            let gradient = found.add_spans(mechanism, spans, &span, axial, own);
            if is_rope {
                found.lengths.push((slope, gradient));
            }
        }
        found.add_supports(mechanism);
        Ok(found)
    }

    /// Spans of one axial force, each with a stiffness along it; the gradient of their length.
    fn add_spans(
        &mut self,
        mechanism: &Mechanism,
        spans: &[Link],
        span: &dyn Fn(&Link) -> Vector,
        axial: Interval,
        along: Interval,
    ) -> Row {
        let mut parts = Vec::new();
        for link in spans {
            let d = span(link);
            let distance = size(d);
            let (density, u) = (axial / distance, d.map(|x| x / distance));
            self.add(mechanism, link, density, Some((along - density, u)));
            parts.extend([(link.a, u.map(|x| -x)), (link.b, u)]);
        }
        self.row(&parts)
    }

    fn add(
        &mut self,
        mechanism: &Mechanism,
        link: &Link,
        density: Interval,
        along: Option<(Interval, Vector)>,
    ) {
        let [from, between, to] = inertia(&mechanism.system.members()[link.member].body);
        self.mass[link.a] = self.mass[link.a] + from;
        self.mass[link.b] = self.mass[link.b] + to;
        self.members.push(Member { a: link.a, b: link.b, density, along, between });
    }

    /// What the greater of two different moments across a bar along `d` adds.
    fn add_excess(&mut self, bar: &Bar, link: &Link, d: Vector) {
        if is_symmetric(bar) {
            return;
        }
        let [_, jy, jz] = moments(bar);
        // Any direction near the second axis makes one that is exactly across the bar.
        let near = second_axis(d.map(Interval::mid)).map(Interval::point);
        let part = dot(near, d) / dot(d, d);
        let second: Vector = std::array::from_fn(|k| near[k] - part * d[k]);
        let across = if jz.mid() > jy.mid() { second } else { cross(d, second) };
        let size = size(across);
        let l = Interval::point(link.length_m);
        self.excesses.push(Excess {
            a: link.a,
            b: link.b,
            inertia: if jz.mid() > jy.mid() { jz - jy } else { jy - jz } / l / l,
            axis: across.map(|x| x / size),
        });
    }

    /// The directions that supports of sliders take: of a line two that are exactly across it.
    fn add_supports(&mut self, mechanism: &Mechanism) {
        for slot in 0..mechanism.moving {
            let joint = &mechanism.system.joints()[mechanism.joint_at[slot]];
            match joint.support {
                Support::Free | Support::Fixed { .. } => {}
                Support::Plane { normal, .. } => {
                    self.rows.push(self.row(&[(slot, normal.map(Interval::point))]));
                }
                Support::Line { direction, .. } => {
                    let mut axis = [Interval::ZERO; 3];
                    let least =
                        (0..3).min_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs()));
                    axis[least.unwrap_or(0)] = Interval::ONE;
                    let direction = direction.map(Interval::point);
                    let first = cross(direction, axis);
                    self.rows.push(self.row(&[(slot, first)]));
                    self.rows.push(self.row(&[(slot, cross(direction, first))]));
                }
            }
        }
    }

    fn row(&self, parts: &[(usize, Vector)]) -> Row {
        let mut sums = BTreeMap::new();
        for (slot, v) in parts.iter().filter(|(slot, _)| *slot < self.moving) {
            for (k, x) in v.iter().enumerate() {
                let sum = sums.entry(3 * slot + k).or_insert(Interval::ZERO);
                *sum = *sum + *x;
            }
        }
        sums.into_iter().collect()
    }

    /// `Xᵀ K X` and `Xᵀ M X`.
    pub(super) fn projected(
        &self,
        x: &DMatrix<Interval>,
    ) -> (DMatrix<Interval>, DMatrix<Interval>) {
        let count = x.ncols();
        let zero = || DMatrix::from_element(count, count, Interval::ZERO);
        let (mut stiffness, mut inertia) = (zero(), zero());
        let at = |slot: usize, column: usize| -> Vector {
            let moves = slot < self.moving;
            std::array::from_fn(|k| if moves { x[(3 * slot + k, column)] } else { Interval::ZERO })
        };
        for member in &self.members {
            let ends: Vec<_> = (0..count).map(|c| (at(member.a, c), at(member.b, c))).collect();
            let by: Vec<_> = ends.iter().map(|(a, b)| minus(*b, *a)).collect();
            add(&mut stiffness, |i, j| {
                let k = member.density * dot(by[i], by[j]);
                let Some((slope, u)) = member.along else { return k };
                k + slope * (dot(u, by[i]) * dot(u, by[j]))
            });
            let crossed =
                |i: usize, j: usize| dot(ends[i].0, ends[j].1) + dot(ends[i].1, ends[j].0);
            add(&mut inertia, |i, j| member.between * crossed(i, j));
        }
        for (slope, gradient) in &self.lengths {
            let by = |c: usize| -> Interval { gradient.iter().map(|(k, g)| *g * x[(*k, c)]).sum() };
            let by: Vec<_> = (0..count).map(by).collect();
            add(&mut stiffness, |i, j| *slope * (by[i] * by[j]));
        }
        for excess in &self.excesses {
            let along = |c: usize| dot(excess.axis, minus(at(excess.b, c), at(excess.a, c)));
            let along: Vec<_> = (0..count).map(along).collect();
            add(&mut inertia, |i, j| excess.inertia * (along[i] * along[j]));
        }
        for slot in 0..self.moving {
            let columns: Vec<_> = (0..count).map(|c| at(slot, c)).collect();
            add(&mut inertia, |i, j| self.mass[slot] * dot(columns[i], columns[j]));
        }
        for matrix in [&mut stiffness, &mut inertia] {
            matrix.fill_lower_triangle_with_upper_triangle();
        }
        (stiffness, inertia)
    }
}

/// Add a symmetric form to the upper triangle of a matrix.
fn add(matrix: &mut DMatrix<Interval>, form: impl Fn(usize, usize) -> Interval) {
    for j in 0..matrix.ncols() {
        for i in 0..=j {
            matrix[(i, j)] = matrix[(i, j)] + form(i, j);
        }
    }
}

fn size(d: Vector) -> Interval {
    dot(d, d).sqrt()
}

/// Whether a member bears nothing at every distance of an interval and next to it: a member that is
/// just taut is stiff on one side alone.
fn is_slack(kind: Kind, distance: Interval, length_m: f64) -> bool {
    match kind {
        Kind::Cable => distance.hi() < length_m,
        Kind::Strut => distance.lo() > length_m,
        Kind::Bar => false,
    }
}

/// The matrix of [`EndInertia`](crate::EndInertia), in intervals, kg.
fn inertia(bar: &Bar) -> [Interval; 3] {
    let l = Interval::point(bar.length_m());
    let to_centre = Interval::point(bar.centre_m()) / l;
    let from_centre = (l - Interval::point(bar.centre_m())) / l;
    let [_, second, third] = moments(bar);
    // Both count where they differ by a rounding: an ω² of unequal ones lies between those of
    // either. Where they differ by more the smaller one counts in all directions.
    let j = match (is_symmetric(bar), second.mid() < third.mid()) {
        (true, _) => second.hull(third),
        (false, true) => second,
        (false, false) => third,
    };
    let j = j / l / l;
    let m = Interval::point(bar.mass_kg());
    [
        m * from_centre * from_centre + j,
        m * to_centre * from_centre - j,
        m * to_centre * to_centre + j,
    ]
}

fn moments(bar: &Bar) -> [Interval; 3] {
    bar.inertia_kg_m2().map(|moment| Interval::around(moment, MOMENT_ROUNDING * moment))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 2 kg with the centre at 2/7 of 0.7 m: 2 (5/7)², 2 (5/7)(2/7) and 2 (2/7)², and the moment over 0.49 m².
    #[test]
    fn inertia_is_that_of_both_ends() {
        let bar = Bar::given(0.7, 2.0, Some(0.2), Some([0.0, 0.05, 0.05])).unwrap();
        let turns = 0.05 / 0.49;
        let wanted = [50.0 / 49.0 + turns, 20.0 / 49.0 - turns, 8.0 / 49.0 + turns];
        for (found, wanted) in inertia(&bar).into_iter().zip(wanted) {
            assert!((found.mid() - wanted).abs() < 1e-15 && found.width() < 1e-14, "{found:?}");
        }
    }
}
