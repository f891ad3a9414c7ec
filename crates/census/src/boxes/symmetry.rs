//! Symmetries that are exact in double precision, and the unknowns of each kind of symmetry.
//!
//! A mirror or a half-turn $S$ about a centre permutes the coordinates and changes signs. Where it maps
//! supports, members and loads onto each other without rounding, it acts on the unknowns by a signed
//! permutation $g$ with $F(g y) = g F(y)$. Under the characters $\chi$ of one mirror, or of two that
//! commute, the unknowns fall apart into blocks
//!
//! $$ y = \sum_o z_o v_o, \qquad v_o = \sum_g \chi(g)\\, g\\, e_o, $$
//!
//! one number $z_o$ for each orbit. A symmetric shape has unknowns in the first block alone, and there
//! $J$ maps each block into itself. One row of each orbit stands for all.

use model::Vector as Point;
use model::system::{Joint, Member, Support, System};
use numerics::{Interval, two_sum};

use super::arithmetic::Vector;
use super::equations::{Entry, Equations};

/// A joint is the image of another one if it is this near to it, in units of all lengths together.
/// Only symmetric shapes are found so; what is proved of them does not rest on it.
const NEAR: f64 = 1e-7;

/// Coordinate k of an image is the coordinate that is named, times a sign.
type Axes = [(usize, f64); 3];

/// Mirrors along x and y, those across the diagonals, the half-turn about the vertical.
const MIRRORS: [Axes; 5] = [
    [(0, -1.0), (1, 1.0), (2, 1.0)],
    [(0, 1.0), (1, -1.0), (2, 1.0)],
    [(1, 1.0), (0, 1.0), (2, 1.0)],
    [(1, -1.0), (0, -1.0), (2, 1.0)],
    [(0, -1.0), (1, -1.0), (2, 1.0)],
];

/// One mirror or half-turn: the images of joints and members.
#[derive(Debug, Clone, PartialEq)]
struct Mirror {
    axes: Axes,
    joints: Vec<usize>,
    members: Vec<usize>,
}

/// Mirrors that commute, about one centre.
#[derive(Debug, Clone)]
pub(super) struct Symmetry {
    pub(super) centre_m: Point,
    mirrors: Vec<Mirror>,
}

impl Symmetry {
    /// Those of all these systems, which differ in loads, near a shape; nothing where there is none.
    pub(super) fn of(systems: &[&System], joints_m: &[Point]) -> Option<Self> {
        let centre_m = centre(systems.first()?)?;
        let found = MIRRORS.map(|axes| {
            let mut each = systems.iter().map(|system| mirror(system, joints_m, centre_m, axes));
            let first = each.next()??;
            each.all(|other| other.as_ref() == Some(&first)).then_some(first)
        });
        let [x, y, diagonal, other, turn] = found;
        let commute = |a: &Mirror, b: &Mirror| {
            let both = |a: &[usize], b: &[usize]| (0..a.len()).all(|k| a[b[k]] == b[a[k]]);
            both(&a.joints, &b.joints) && both(&a.members, &b.members)
        };
        let pairs = [(&x, &y), (&diagonal, &other)].into_iter().find_map(|pair| match pair {
            (Some(a), Some(b)) if commute(a, b) => Some(vec![a.clone(), b.clone()]),
            _ => None,
        });
        let one = || [x.clone(), y.clone(), diagonal.clone(), other.clone(), turn].into_iter();
        let mirrors = pairs.or_else(|| one().flatten().next().map(|one| vec![one]))?;
        Some(Self { centre_m, mirrors })
    }
}

/// The middle of the anchors.
fn centre(system: &System) -> Option<Point> {
    let mut anchors = system.joints().iter().filter_map(|joint| match joint.support {
        Support::Fixed { at_m } => Some(at_m),
        _ => None,
    });
    let first = anchors.next()?;
    let [low, high] = anchors.fold([first; 2], |[low, high], at| {
        let low = std::array::from_fn(|k| f64::min(low[k], at[k]));
        [low, std::array::from_fn(|k| f64::max(high[k], at[k]))]
    });
    Some([0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.0])
}

/// Whether two numbers are equal, and no less.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 0.0
}

fn image(axes: Axes, at: Point) -> Point {
    axes.map(|(axis, sign)| sign * at[axis])
}

/// Whether one vector is the image of another, for some sign.
fn maps(axes: Axes, from: Point, to: Point, signs: &[f64]) -> bool {
    let image = image(axes, from);
    signs.iter().any(|sign| (0..3).all(|k| same(sign * image[k], to[k])))
}

/// Whether a place is the image of another one as seen from the centre. What is turned over or
/// exchanged must have a distance from there that is a double.
fn place_maps(axes: Axes, centre_m: Point, from: Point, to: Point) -> bool {
    let seen = |at: Point, k: usize| {
        let (part, rest) = two_sum(at[k], -centre_m[k]);
        same(rest, 0.0).then_some(part)
    };
    (0..3).all(|k| {
        let (axis, sign) = axes[k];
        let kept = axis == k && sign > 0.0;
        let turned =
            || matches!((seen(from, axis), seen(to, k)), (Some(a), Some(b)) if same(sign * a, b));
        if kept { same(from[k], to[k]) } else { turned() }
    })
}

fn mirror(system: &System, joints_m: &[Point], centre_m: Point, axes: Axes) -> Option<Mirror> {
    let near_m = NEAR * system.total_length_m();
    let all = system.joints();
    let image_of = |from: usize, taken: &[bool]| {
        let off: Point = std::array::from_fn(|k| joints_m[from][k] - centre_m[k]);
        let target = image(axes, off);
        let near =
            |to: usize| (0..3).all(|k| (joints_m[to][k] - centre_m[k] - target[k]).abs() <= near_m);
        (0..all.len()).find(|to| {
            !taken[*to] && near(*to) && joint_maps(&all[from], &all[*to], centre_m, axes)
        })
    };
    let joints = matched(all.len(), image_of)?;
    let members = system.members();
    let image_of = |from: usize, taken: &[bool]| {
        let image = members[from].clone().renumbered(|joint| joints[joint]);
        (0..members.len()).find(|to| !taken[*to] && member_maps(&image, &members[*to], axes))
    };
    let members = matched(members.len(), image_of)?;
    let twice = |map: &[usize]| (0..map.len()).all(|k| map[map[k]] == k);
    (twice(&joints) && twice(&members)).then_some(Mirror { axes, joints, members })
}

/// A permutation that takes each to its first free image.
fn matched(count: usize, image_of: impl Fn(usize, &[bool]) -> Option<usize>) -> Option<Vec<usize>> {
    let mut taken = vec![false; count];
    let mut images = Vec::with_capacity(count);
    for from in 0..count {
        let to = image_of(from, &taken)?;
        taken[to] = true;
        images.push(to);
    }
    Some(images)
}

fn joint_maps(from: &Joint, to: &Joint, centre_m: Point, axes: Axes) -> bool {
    let place = |a: Point, b: Point| place_maps(axes, centre_m, a, b);
    let support = match (from.support, to.support) {
        (Support::Free, Support::Free) => true,
        (Support::Fixed { at_m: a }, Support::Fixed { at_m: b }) => place(a, b),
        (Support::Line { at_m: a, direction: from }, Support::Line { at_m: b, direction: to })
        | (Support::Plane { at_m: a, normal: from }, Support::Plane { at_m: b, normal: to }) => {
            place(a, b) && maps(axes, from, to, &[1.0, -1.0])
        }
        _ => false,
    };
    support && same(from.mass_kg, to.mass_kg) && maps(axes, from.force_n, to.force_n, &[1.0])
}

/// Whether a member, its joints mapped already, is mapped to another one.
fn member_maps(from: &Member, to: &Member, axes: Axes) -> bool {
    let (own, other) = (&from.body, &to.body);
    let alike = from.kind == to.kind
        && from.stiffness_n.map(f64::to_bits) == to.stiffness_n.map(f64::to_bits)
        && same(own.length_m(), other.length_m())
        && same(own.mass_kg(), other.mass_kg());
    let straight = from.path().eq(to.path())
        && same(own.centre_m(), other.centre_m())
        && from.loads.len() == to.loads.len()
        && from.loads.iter().zip(&to.loads).all(|(from, to)| {
            same(from.at_m, to.at_m) && maps(axes, from.force_n, to.force_n, &[1.0])
        });
    // The middle of a bar is the middle from either end.
    let middle = |body: &model::Bar| {
        same(body.mass_kg(), 0.0) || same(2.0 * body.centre_m(), body.length_m())
    };
    let reversed = [from.from, from.to] == [to.to, to.from]
        && from.via().iter().rev().eq(to.via())
        && middle(own)
        && middle(other)
        && from.loads.is_empty()
        && to.loads.is_empty();
    alike && (straight || reversed)
}

/// Unknowns $y_i = s_i z_{o(i)}$ of one kind of symmetry.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// For each unknown its orbit and sign; nothing where it is 0.
    of: Vec<Option<(usize, f64)>>,
    /// For each orbit the first of its unknowns, whose sign is 1.
    first: Vec<usize>,
}

impl Block {
    /// All unknowns, each for itself.
    pub(super) fn whole(size: usize) -> Self {
        Self { of: (0..size).map(|k| Some((k, 1.0))).collect(), first: (0..size).collect() }
    }

    /// The blocks of all characters, the symmetric one first; nothing where a direction of a support is
    /// not mapped to one.
    pub(super) fn all(equations: &Equations, symmetry: &Symmetry) -> Option<Vec<Self>> {
        if !equations.holds.is_empty() {
            return None;
        }
        let actions = symmetry.mirrors.iter().map(|mirror| action(equations, mirror));
        let actions = actions.collect::<Option<Vec<_>>>()?;
        let characters = 0..1_usize << actions.len();
        Some(characters.map(|odd| Self::new(&actions, odd)).collect())
    }

    /// Of the character that is −1 for the mirrors whose bits are set.
    fn new(actions: &[Action], odd: usize) -> Self {
        let size = actions.first().map_or(0, Vec::len);
        let mut of = vec![None; size];
        let mut seen = vec![false; size];
        let mut first = vec![];
        for start in 0..size {
            if seen[start] {
                continue;
            }
            // The images under all products of the mirrors, with the sum of their signs.
            let mut images: Vec<(usize, f64)> = vec![(start, 1.0)];
            for (k, action) in actions.iter().enumerate() {
                let character = if odd >> k & 1 == 1 { -1.0 } else { 1.0 };
                let more = images.iter().map(|(at, sign)| {
                    let (image, own) = action[*at];
                    (image, sign * own * character)
                });
                let more: Vec<_> = more.collect();
                images.extend(more);
            }
            let sum = |at: usize| -> f64 {
                images.iter().filter(|(image, _)| *image == at).map(|(_, sign)| sign).sum()
            };
            for (at, _) in &images {
                seen[*at] = true;
                if sum(*at).abs() > 0.0 {
                    of[*at] = Some((first.len(), sum(*at).signum()));
                }
            }
            if of[start].is_some() {
                first.push(start);
            }
        }
        Self { of, first }
    }

    pub(super) fn size(&self) -> usize {
        self.first.len()
    }

    /// All unknowns.
    pub(super) fn spread(&self, z: &[Interval]) -> Vec<Interval> {
        let part = |of: &Option<(usize, f64)>| match *of {
            Some((orbit, sign)) if sign > 0.0 => z[orbit],
            Some((orbit, _)) => -z[orbit],
            None => Interval::ZERO,
        };
        self.of.iter().map(part).collect()
    }

    /// One of each orbit, of unknowns or equations.
    pub(super) fn gather<T: Copy>(&self, all: &[T]) -> Vec<T> {
        self.first.iter().map(|k| all[*k]).collect()
    }

    /// The part of the derivative that maps the block into itself.
    pub(super) fn restrict(&self, entries: &[Entry]) -> Vec<Entry> {
        let mut row_of = vec![None; self.of.len()];
        for (orbit, row) in self.first.iter().enumerate() {
            row_of[*row] = Some(orbit);
        }
        let own = |(row, column, entry): &Entry| {
            let (orbit, sign) = self.of[*column]?;
            Some((row_of[*row]?, orbit, if sign > 0.0 { *entry } else { -*entry }))
        };
        entries.iter().filter_map(own).collect()
    }
}

/// For each unknown its image and sign.
type Action = Vec<(usize, f64)>;

fn action(equations: &Equations, mirror: &Mirror) -> Option<Action> {
    let mut action = vec![(0, 0.0); equations.size];
    for (from, to) in mirror.joints.iter().enumerate() {
        let (from, to) = (&equations.joints[from], &equations.joints[*to]);
        for (k, axis) in from.axes.iter().enumerate() {
            let image: Vector = mirror
                .axes
                .map(|(axis_of, sign)| if sign > 0.0 { axis[axis_of] } else { -axis[axis_of] });
            let exact = image.iter().all(|part| part.width() <= 0.0);
            let is = |other: &Vector, sign: f64| {
                (0..3).all(|i| same(sign * image[i].lo(), other[i].lo()) && other[i].width() <= 0.0)
            };
            let along = to.axes.iter().enumerate().find_map(|(i, other)| {
                [1.0, -1.0].into_iter().find(|sign| is(other, *sign)).map(|sign| (i, sign))
            });
            let (i, sign) = along.filter(|_| exact)?;
            action[from.first + k] = (to.first + i, sign);
        }
    }
    let mut force = vec![None; mirror.members.len()];
    for acting in &equations.acting {
        force[acting.member] = Some(acting.force);
    }
    for (from, to) in mirror.members.iter().enumerate() {
        match (force[from], force[*to]) {
            (Some(from), Some(to)) => action[from] = (to, 1.0),
            (None, None) => {}
            _ => return None,
        }
    }
    Some(action)
}

#[cfg(test)]
mod tests;
