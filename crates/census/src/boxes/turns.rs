//! Parts that turn freely about a vertical.
//!
//! Two kinds of sets of joints turn without any change of energy, if all their loads are exactly
//! vertical: what hangs on anchors that stand exactly on one vertical, and what hangs on one joint
//! alone. The forces of the members inside have no moment about the vertical, those of the members
//! that hold the set act through it: the moments of the left-hand sides of (1) over the set add up
//! to zero at every place and with every force. So one equation is superfluous and one coordinate
//! free.
//!
//! The azimuth of one joint p of the set is therefore fixed by the equation $e \cdot (x_p - x_c) =
//! 0$, e being the horizontal direction across the answer's arm from the vertical to p, and $\mu e$
//! is added to the forces at p with an unknown $\mu$. In a solution of these equations the identity
//! of moments reads $\mu\\, e \times (x_p - x_c) = 0$, and as the arm is proved not to vanish, $\mu
//! = 0$: it is an equilibrium. Sets are nested or apart; p is in none of the sets inside, so that
//! this holds for one set after the other.

use std::collections::HashSet;

use model::Vector;
use model::system::{Support, System};

use super::activity::Activity;

/// A set that turns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Turn {
    pub(crate) joints: Vec<usize>,
    /// What gives the vertical: an anchor, a slider on it, or the joint on which all hangs.
    pub(crate) centre: usize,
    /// The joint whose azimuth is fixed.
    pub(crate) arm: usize,
    /// The horizontal direction across the arm.
    pub(crate) across: [f64; 2],
}

/// An arm below this part of the size of the system may be no arm: a set that hangs plumb has
/// nothing to turn.
const NO_ARM: f64 = 1e-7;
/// A turn that is the sum of others up to this part of it is no turn of its own.
const DEPENDENT: f64 = 1e-6;

/// The independent free turns of a system about a place of it, inner ones first.
pub(super) fn turns(
    system: &System,
    activities: &[Activity],
    joints_m: &[Vector],
    held: &[bool],
) -> Vec<Turn> {
    let net = Net::new(system, activities, held);
    let mut sets: Vec<(usize, Vec<usize>)> = vec![];
    for component in net.components(&net.moving(), None) {
        sets.extend(net.axis(&component).map(|centre| (centre, component.clone())));
        for &cut in &component {
            let hanging = net.components(&component, Some(cut)).into_iter();
            sets.extend(hanging.filter(|set| net.hangs(set)).map(|set| (cut, set)));
        }
    }
    sets.sort_by_key(|(_, set)| set.len());
    let size = system.total_length_m();
    let mut found: Vec<Turn> = vec![];
    let mut basis: Vec<Vec<f64>> = vec![];
    for (centre, joints) in sets {
        let arm = |joint: usize| {
            let [x, y] = [0, 1].map(|k| joints_m[joint][k] - joints_m[centre][k]);
            (x.hypot(y), [x, y])
        };
        let inner: HashSet<usize> = found
            .iter()
            .filter(|turn| turn.joints.iter().all(|joint| joints.contains(joint)))
            .flat_map(|turn| turn.joints.iter().copied())
            .collect();
        let outer = joints.iter().copied().filter(|joint| !inner.contains(joint));
        let Some(joint) = outer.max_by(|a, b| arm(*a).0.total_cmp(&arm(*b).0)) else { continue };
        let (length, [x, y]) = arm(joint);
        let mut motion = vec![0.0; 2 * joints_m.len()];
        for joint in &joints {
            let (_, [x, y]) = arm(*joint);
            [motion[2 * joint], motion[2 * joint + 1]] = [-y, x];
        }
        if length > NO_ARM * size && independent(&mut motion, &basis) {
            basis.push(motion);
            let across = [-y / length, x / length];
            found.push(Turn { joints, centre, arm: joint, across });
        }
    }
    found
}

/// Whether a vector is independent of an orthonormal basis; then it becomes the next of it.
fn independent(vector: &mut [f64], basis: &[Vec<f64>]) -> bool {
    let norm = |vector: &[f64]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let before = norm(vector);
    for unit in basis {
        let part: f64 = unit.iter().zip(&*vector).map(|(a, b)| a * b).sum();
        vector.iter_mut().zip(unit).for_each(|(x, u)| *x -= part * u);
    }
    let after = norm(vector);
    for x in vector.iter_mut() {
        *x /= after;
    }
    after > DEPENDENT * before
}

/// The joints with the members that act between them.
struct Net<'a> {
    system: &'a System,
    neighbours: Vec<Vec<usize>>,
    /// Joints that do not move in the proof.
    held: &'a [bool],
    /// Joints that feel a load that is not exactly vertical.
    level: Vec<bool>,
}

impl<'a> Net<'a> {
    fn new(system: &'a System, activities: &[Activity], held: &'a [bool]) -> Self {
        let mut neighbours = vec![vec![]; system.joints().len()];
        for (member, activity) in system.members().iter().zip(activities) {
            if *activity == Activity::Acts {
                for [a, b] in member.spans() {
                    neighbours[a].push(b);
                    neighbours[b].push(a);
                }
            }
        }
        Self { system, neighbours, held, level: system.joints_with_level_loads() }
    }

    fn moving(&self) -> Vec<usize> {
        (0..self.held.len()).filter(|joint| !self.held[*joint]).collect()
    }

    /// The connected parts of a set of moving joints, one joint taken out.
    fn components(&self, set: &[usize], without: Option<usize>) -> Vec<Vec<usize>> {
        let mut open: HashSet<usize> = set.iter().copied().collect();
        without.map(|cut| open.remove(&cut));
        let mut found = vec![];
        for start in set {
            if !open.remove(start) {
                continue;
            }
            let mut part = vec![*start];
            let mut next = 0;
            while let Some(here) = part.get(next).copied() {
                next += 1;
                part.extend(self.neighbours[here].iter().filter(|joint| open.remove(joint)));
            }
            found.push(part);
        }
        found
    }

    /// A joint on the vertical through all that holds a component, if there is one and all loads
    /// are vertical.
    fn axis(&self, component: &[usize]) -> Option<usize> {
        let mut centre: Option<(usize, Vector)> = None;
        for joint in
            component.iter().flat_map(|joint| self.neighbours[*joint].iter().chain([joint]))
        {
            let at_m = match self.system.joints()[*joint].support {
                _ if self.level[*joint] && !self.held[*joint] => return None,
                Support::Free => continue,
                Support::Plane { normal: [x, y, _], .. } if is_zero(x) && is_zero(y) => continue,
                Support::Fixed { at_m } => at_m,
                Support::Line { at_m, direction: [x, y, _] } if is_zero(x) && is_zero(y) => at_m,
                Support::Line { .. } | Support::Plane { .. } => return None,
            };
            let (_, [x, y, _]) = *centre.get_or_insert((*joint, at_m));
            if !(is_zero(at_m[0] - x) && is_zero(at_m[1] - y)) {
                return None;
            }
        }
        centre.map(|(joint, _)| joint)
    }

    /// Whether a set has no support that feels a turn, and no load that is not vertical.
    fn hangs(&self, set: &[usize]) -> bool {
        set.iter().all(|joint| {
            let free = match self.system.joints()[*joint].support {
                Support::Free => true,
                Support::Plane { normal: [x, y, _], .. } => is_zero(x) && is_zero(y),
                Support::Fixed { .. } | Support::Line { .. } => false,
            };
            free && !self.level[*joint]
                && self.neighbours[*joint].iter().all(|next| !self.held[*next])
        })
    }
}

/// Differences of doubles are zero only if these are equal.
fn is_zero(x: f64) -> bool {
    x.abs() <= 0.0
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member};

    use super::*;

    /// Two bars hang from an anchor, the lower one aside; its end is free, or slides in a plane.
    /// Only a level plane lets it turn.
    #[test]
    fn what_slides_in_a_plane_that_is_not_level_does_not_turn() {
        let at_m = [[0.0; 3], [0.0, 0.0, -1.0], [0.6, 0.0, -1.8]];
        let turning = |support: Support| {
            let light = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
            let joints = vec![
                Joint::anchor("A", at_m[0]),
                Joint::free("P").with_mass(1.0),
                Joint::free("Q").with_mass(1.0).held_by(support),
            ];
            let members = vec![Member::bar(0, 1, light(1.0)), Member::bar(1, 2, light(1.0))];
            let system = System::new("two", 10.0, joints, members).unwrap();
            let found = turns(&system, &[Activity::Acts; 2], &at_m, &[true, false, false]);
            found.iter().map(|turn| (turn.centre, turn.arm)).collect::<Vec<_>>()
        };
        let plane = |normal: Vector| Support::Plane { at_m: at_m[2], normal };
        assert_eq!(turning(Support::Free), [(1, 2)]);
        assert_eq!(turning(plane([0.0, 0.0, 1.0])), [(1, 2)]);
        for normal in [[0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [0.48, 0.36, 0.8]] {
            assert_eq!(turning(plane(normal)), [], "{normal:?}");
        }
    }

    /// Of (3, 4) the part across (1, 0) is (0, 4); of (2, 0) nothing is left, and of (2, 1e-7) too little.
    #[test]
    fn vectors_become_the_next_of_a_basis_unless_they_are_in_its_span() {
        let basis = [vec![1.0, 0.0]];
        let mut vector = [3.0, 4.0];
        assert!(independent(&mut vector, &basis));
        assert!(vector[0].abs() < 1e-15 && (vector[1] - 1.0).abs() < 1e-15, "{vector:?}");
        assert!(!independent(&mut [2.0, 0.0], &basis));
        assert!(!independent(&mut [2.0, 1e-7], &basis));
        assert!(independent(&mut [2.0, 1e-5], &basis));
        let mut first = [3.0, 4.0];
        assert!(independent(&mut first, &[]));
        assert!((first[0] - 0.6).abs() < 1e-15 && (first[1] - 0.8).abs() < 1e-15, "{first:?}");
    }

    /// A joint between two anchors of one vertical turns about it, whatever acts on the anchors, and
    /// does not if anything pulls it aside.
    #[test]
    fn what_hangs_on_anchors_turns_unless_it_is_pulled_aside() {
        let at_m = [[0.0; 3], [0.0, 0.0, -1.0], [0.6, 0.0, -0.5]];
        let turning = |pulled: usize, force_n: Vector, beside: f64| {
            let light = Bar::homogeneous(1.0, 0.0).unwrap();
            let mut joints = vec![
                Joint::anchor("A", at_m[0]),
                Joint::anchor("B", [beside, 0.0, -1.0]),
                Joint::free("P").with_mass(1.0),
            ];
            joints[pulled].force_n = force_n;
            let members = vec![Member::bar(0, 2, light), Member::bar(1, 2, light)];
            let system = System::new("between", 10.0, joints, members).unwrap();
            let found = turns(&system, &[Activity::Acts; 2], &at_m, &[true, true, false]);
            found.iter().map(|turn| (turn.joints.clone(), turn.arm)).collect::<Vec<_>>()
        };
        let aside = [1.0, 0.0, 0.0];
        for (pulled, force_n) in [(0, aside), (1, aside), (2, [0.0, 0.0, -3.0]), (0, [0.0; 3])] {
            assert_eq!(turning(pulled, force_n, 0.0), [(vec![2], 2)], "{pulled}");
        }
        assert_eq!(turning(2, aside, 0.0), []);
        assert_eq!(turning(2, [0.0, -1.0, 0.0], 0.0), []);
        assert_eq!(turning(0, [0.0; 3], 1e-9), []);
    }
}
