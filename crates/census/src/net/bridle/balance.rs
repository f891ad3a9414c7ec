//! Balance at the knot: which pulls of the strands may hold its load together.
//!
//! Strand i pulls at the knot with minus the force of its last bar, $f_i = d_i/w_i$ with $d_i =
//! (h_i e_i, v_i + c_i w_i)$ and $w_i \ge 0$; $\sum_i f_i$ is the load L of the knot. Where $w_i$
//! may be zero, a strand that is all but straight, the force has no bound and only its direction is
//! known. With b, what the forces that are bounded leave of the load, and one, two or three forces
//! without bound,
//!
//! $$ d_1 \times b = 0; \qquad w_1\\,(b \times d_2) = d_1 \times d_2, \quad
//!    w_2\\,(d_1 \times b) = d_1 \times d_2; \qquad
//!    w_1 \det(b, d_2, d_3) = \det(d_1, d_2, d_3), \dots $$
//!
//! hold for every equilibrium, by Cramer's rule.

use numerics::Interval;

use super::pulls::{Pulls, density};
use super::strand::{Span, Strand};
use crate::boxes::arithmetic::{
    Vector, cross, det, dot, factors, minus, norm, plus, quotient, times,
};
use crate::branch_and_bound::hull;

/// The force of the last bar of a strand over a cell of pulls and a box of places.
#[derive(Debug, Clone)]
pub(super) struct Held {
    force: Vector,
    /// Of a bar alone that may pull or push, that of a pull.
    direction: Vector,
    w: Interval,
    /// The size of the horizontal part where its direction is unknown.
    turned: Option<Interval>,
}

impl Held {
    pub(super) fn new(strand: &Strand, span: &Span, pulls: &Pulls) -> Self {
        if strand.is_rod() {
            let [t, w] = density(&pulls.cell);
            let force = times(t, span.arm).map(|part| quotient(part, w));
            let direction = if t.hi() < 0.0 { times(t, span.arm) } else { span.arm };
            return Self { force, direction, w, turned: None };
        }
        let last = strand.weight[strand.weight.len() - 1];
        let [h, _, w] = pulls.cell.homogeneous();
        let [_, v] = pulls.cell.force(last);
        let direction = span.world([h, v]);
        let force = direction.map(|part| quotient(part, w));
        let turned = span.toward.is_none().then(|| quotient(h.abs(), w));
        Self { force, direction, w, turned }
    }

    fn bounded(&self) -> bool {
        self.w.lo() > 0.0
    }
}

/// All choices of one pull for each strand that may hold the load, as their numbers in the lists.
pub(super) fn balanced(load: Vector, lists: &[Vec<Held>]) -> Vec<Vec<usize>> {
    // The hull of all forces of the strands from one on.
    let mut rest = vec![[Interval::ZERO; 3]];
    for list in lists.iter().rev() {
        let forces = list.iter().map(|held| held.force);
        let Some(hull) = forces.reduce(hull) else {
            return vec![];
        };
        rest.push(plus(rest[rest.len() - 1], hull));
    }
    rest.reverse();
    let mut choices = Choices { load, lists, rest, chosen: vec![], found: vec![] };
    choices.extend(load);
    choices.found
}

struct Choices<'a> {
    load: Vector,
    lists: &'a [Vec<Held>],
    rest: Vec<Vector>,
    chosen: Vec<usize>,
    found: Vec<Vec<usize>>,
}

impl Choices<'_> {
    /// One more strand; `left` is what the chosen ones leave of the load.
    fn extend(&mut self, left: Vector) {
        let strand = self.chosen.len();
        let apart = |a: &Vector, b: &Vector| (0..3).any(|k| a[k].disjoint(b[k]));
        if strand == self.lists.len() {
            if self.may_hold() {
                self.found.push(self.chosen.clone());
            }
            return;
        }
        if apart(&left, &self.rest[strand]) {
            return;
        }
        let is_last = strand + 1 == self.lists.len();
        for (number, held) in self.lists[strand].iter().enumerate() {
            if is_last && apart(&left, &held.force) {
                continue;
            }
            self.chosen.push(number);
            let left = if is_last { left } else { minus(left, held.force) };
            self.extend(left);
            self.chosen.pop();
        }
    }

    fn may_hold(&self) -> bool {
        let all: Vec<&Held> =
            self.lists.iter().zip(&self.chosen).map(|(list, number)| &list[*number]).collect();
        let left_by = |which: &dyn Fn(usize) -> bool| {
            let others = all.iter().enumerate().filter(|(k, _)| which(*k));
            others.fold(self.load, |left, (_, held)| minus(left, held.force))
        };
        let unbounded: Vec<&Held> = all.iter().copied().filter(|held| !held.bounded()).collect();
        let bounded = |k: usize| all[k].bounded();
        let b = left_by(&bounded);
        let may = match unbounded[..] {
            [] => (0..all.len()).all(|k| {
                let left = left_by(&|other| other != k);
                cross(all[k].direction, left).iter().all(|part| part.contains(0.0))
            }),
            [one] => cross(one.direction, b).iter().all(|part| part.contains(0.0)),
            [one, two] => two_may_hold(one, two, b),
            [one, two, three] => three_may_hold([one, two, three], b),
            _ => true,
        };
        may && all.iter().enumerate().all(|(k, held)| {
            // Its horizontal part has any direction, but this size.
            held.turned.is_none_or(|size| {
                let left = left_by(&|other| other != k && all[other].bounded());
                let others = (0..all.len()).all(|other| other == k || all[other].bounded());
                !others || !norm([left[0], left[1], Interval::ZERO]).disjoint(size)
            })
        })
    }
}

/// The force densities of the bars alone, with these arms, from what the forces of the other
/// strands leave of the load; nothing where that is not known, or the arms may be dependent.
pub(super) fn densities<'a>(
    load: Vector,
    others: impl Iterator<Item = &'a Held>,
    arms: &[Vector],
) -> Option<Vec<Interval>> {
    let mut b = load;
    for held in others {
        if !held.bounded() {
            return None;
        }
        b = minus(b, held.force);
    }
    factors(arms, b)
}

fn two_may_hold(one: &Held, two: &Held, b: Vector) -> bool {
    let both = cross(one.direction, two.direction);
    let meets = |a: Vector| (0..3).all(|k| !a[k].disjoint(both[k]));
    dot(both, b).contains(0.0)
        && meets(times(one.w, cross(b, two.direction)))
        && meets(times(two.w, cross(one.direction, b)))
}

fn three_may_hold(all: [&Held; 3], b: Vector) -> bool {
    let [one, two, three] = all.map(|held| held.direction);
    let volume = det(one, two, three);
    let parts = [det(b, two, three), det(one, b, three), det(one, two, b)];
    parts.into_iter().zip(all).all(|(part, held)| !(held.w * part).disjoint(volume))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::arithmetic::points;

    fn bounded(force: [f64; 3]) -> Held {
        let force = points(force);
        Held { force, direction: force, w: Interval::ONE, turned: None }
    }

    /// A strand that is all but straight.
    fn unbounded(direction: [f64; 3]) -> Held {
        let direction = points(direction);
        let force = direction.map(|part| quotient(part, Interval::ZERO));
        Held { force, direction, w: Interval::new(0.0, 1.0), turned: None }
    }

    /// Whether these strands may hold a load together.
    fn may(load: [f64; 3], held: &[Held]) -> bool {
        let lists: Vec<Vec<Held>> = held.iter().map(|held| vec![held.clone()]).collect();
        !balanced(points(load), &lists).is_empty()
    }

    /// By hand: what forces without bound cannot reach.
    #[test]
    fn straight_strands_hold_what_lies_along_them() {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!(may([3.0, 4.0, 0.0], &[bounded([3.0, 4.0, 0.0])]));
        assert!(!may([3.0, 4.0, 0.0], &[bounded([3.0, 5.0, 0.0])]));
        // One, with a bounded one: 2 along z is left.
        let aside = bounded([1.0, 0.0, 0.0]);
        assert!(may([1.0, 0.0, 2.0], &[aside.clone(), unbounded(z)]));
        assert!(!may([1.5, 0.0, 2.0], &[aside.clone(), unbounded(z)]));
        // Two hold what lies in their plane: at least as much along each as w ≤ 1 asks for.
        assert!(may([3.0, 2.0, 0.0], &[unbounded(x), unbounded(y)]));
        assert!(!may([3.0, 2.0, 1.0], &[unbounded(x), unbounded(y)]));
        assert!(!may([0.5, 2.0, 0.0], &[unbounded(x), unbounded(y)]));
        // Three hold anything of at least this size in each direction, and no push.
        let three = [unbounded(x), unbounded(y), unbounded(z)];
        assert!(may([3.0, 2.0, 1.5], &three));
        assert!(!may([3.0, 2.0, 0.5], &three) && !may([3.0, 2.0, -1.5], &three));
        // Whatever turns has its size.
        let turning = |size: f64| Held {
            force: [Interval::new(-size, size), Interval::new(-size, size), Interval::ONE],
            direction: [Interval::LINE, Interval::LINE, Interval::ONE],
            w: Interval::ONE,
            turned: Some(Interval::point(size)),
        };
        assert!(may([3.0, 4.0, 1.0], &[turning(5.0)]) && !may([3.0, 4.0, 1.0], &[turning(6.0)]));
    }

    /// Loads that known densities of one, two and three bars make.
    #[test]
    fn densities_are_those_of_the_load() {
        let arms = [[1.0, 0.0, -2.0], [0.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(points);
        let known = [2.0, -3.0, 0.5];
        for bars in 1..=3 {
            let pulls = (0..bars).map(|k| times(Interval::point(known[k]), arms[k]));
            let other = bounded([0.25, -0.5, 4.0]);
            let load = pulls.fold(other.force, plus);
            let found = densities(load, std::iter::once(&other), &arms[..bars]).unwrap();
            assert_eq!(found.len(), bars);
            for (found, known) in found.iter().zip(known) {
                assert!(found.contains(known) && found.width() < 1e-13, "{bars}: {found:?}");
            }
            assert!(
                densities(load, std::iter::once(&unbounded([1.0; 3])), &arms[..bars]).is_none()
            );
        }
        let parallel = [arms[0], times(Interval::point(2.0), arms[0])];
        assert!(densities(points([1.0; 3]), std::iter::empty(), &parallel).is_none());
    }
}
