//! The same zero found from several cells, told from different zeros, with proof.

use crate::run::closure::Pattern;
use crate::run::enclosure::krawczyk::Zero;
use crate::run::plane::cell::Cell;
use crate::run::plane::system::System;

pub(crate) type Zeros = Vec<(Pattern, Zero)>;

/// Each zero once, sorted by pattern and then by the order of discovery; pairs that can neither be
/// proved the same nor different come second, one of them only.
pub(crate) fn merge(system: &System, mut zeros: Zeros) -> (Zeros, Zeros) {
    // Stable: within a pattern the order of discovery stays.
    zeros.sort_by_key(|(pattern, _)| *pattern);
    let mut once: Zeros = vec![];
    let mut unclear: Zeros = vec![];
    for (pattern, zero) in zeros {
        let known = once.iter().rev().take_while(|(other, _)| *other == pattern);
        let nearest = known.map(|(_, other)| relation(system, other, &zero)).max();
        match nearest.unwrap_or(Relation::Different) {
            Relation::Same => {}
            Relation::Unclear => unclear.push((pattern, zero)),
            Relation::Different => once.push((pattern, zero)),
        }
    }
    (once, unclear)
}

/// From the farthest to the nearest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Relation {
    Different,
    Unclear,
    Same,
}

/// Both zeros belong to the same pattern.
fn relation(system: &System, a: &Zero, b: &Zero) -> Relation {
    let within = |outer: &Zero, inner: &Zero| {
        inner
            .tight
            .on(outer.alone_in.face, system)
            .is_some_and(|cell| outer.alone_in.encloses(&cell))
    };
    if within(a, b) || within(b, a) {
        return Relation::Same;
    }
    if apart(system, &a.tight, &b.tight) || apart(system, &b.tight, &a.tight) {
        return Relation::Different;
    }
    Relation::Unclear
}

/// Whether no pull lies in both.
fn apart(system: &System, a: &Cell, b: &Cell) -> bool {
    match b.on(a.face, system) {
        Some(same_face) => a.disjoint(&same_face),
        // On the face of `a` its constant coordinate has the sign of the face.
        None => b.behind(a.face, system),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::plane::face::Face;
    use crate::run::plane::loads::JointLoads;
    use numerics::Interval;

    fn system() -> System {
        System::new(model::cases::paper().chain(), JointLoads::NONE)
    }

    fn zero(face: Face, at: [f64; 2], reach: f64) -> Zero {
        let around = |radius| Cell { face, at: at.map(|x| Interval::around(x, radius)) };
        Zero { tight: around(1e-14), alone_in: around(reach) }
    }

    #[test]
    fn a_zero_on_an_edge_of_the_cube_is_one_on_both_faces() {
        // (H, V, w) = (1, 0.5, 1), seen on the near and on the right face.
        let pair = [zero(Face::Near, [1.0, 0.5], 1e-3), zero(Face::Right, [0.5, 1.0], 1e-3)];
        let (once, unclear) = merge(&system(), pair.map(|zero| (Pattern(1), zero)).to_vec());
        assert_eq!((once.len(), unclear.len()), (1, 0));
    }

    #[test]
    fn different_zeros_stay_apart_and_so_do_patterns() {
        let zeros = vec![
            (Pattern(1), zero(Face::Near, [0.3, 0.5], 1e-3)),
            (Pattern(1), zero(Face::Near, [0.31, 0.5], 1e-3)),
            (Pattern(2), zero(Face::Near, [0.3, 0.5], 1e-3)),
            (Pattern(2), zero(Face::Left, [0.0, 0.5], 1e-3)),
            (Pattern(2), zero(Face::Right, [0.0, 0.5], 1e-3)),
        ];
        let (once, unclear) = merge(&system(), zeros);
        assert_eq!((once.len(), unclear.len()), (5, 0));
    }

    #[test]
    fn overlapping_enclosures_without_a_common_neighbourhood_are_unclear() {
        let zeros = [zero(Face::Near, [0.3, 0.5], 1e-16), zero(Face::Near, [0.3, 0.5], 1e-16)];
        let (once, unclear) = merge(&system(), zeros.map(|zero| (Pattern(0), zero)).to_vec());
        assert_eq!((once.len(), unclear.len()), (1, 1));
    }
}
