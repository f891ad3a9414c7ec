//! Whether equilibrium determines the forces: the self-stress of parallel bars.
//!
//! A self-stress is a set of axial forces that balance at every joint without any load. In a chain
//! the force of one bar is passed on to the next, so it is one vector `p` all along, and every bar
//! is parallel to it: the rigidity matrix of n bars with 3(n−1) free coordinates has rank n, but
//! for a chain whose bars are all parallel to one line, where it has rank n − 1. There any multiple
//! of the unit vector of the line may be added to the forces between all bars.

use model::{Chain, Equilibrium, ForceChoice, ForceFamily, STRAIGHT_TOLERANCE, SolverName, Vector};

use crate::statics::stored_rounding_m;
use crate::vector::{cross, dot, minus, norm};

/// The family of forces that an answer is one of, or nothing where equilibrium determines them.
///
/// Bars count as parallel where they lose, by all their angles to the line, less of their reach
/// than the rounding of lengths ([`STRAIGHT_TOLERANCE`]): of lengths that differ by so much some
/// lie on the line.
#[must_use]
pub fn force_family(chain: &Chain, answer: &Equilibrium) -> Option<ForceFamily> {
    let bars = chain.bars().len();
    if answer.joints_m.len() != bars + 1 || answer.axial_n.len() != bars {
        return None;
    }
    let direction = common_line(chain, &answer.joints_m)?;
    let [mut least, mut most] = [f64::NEG_INFINITY, f64::INFINITY];
    for (ends, axial_n) in answer.joints_m.windows(2).zip(&answer.axial_n) {
        // A force added along the line pulls the bars that run with it and pushes those that run
        // against it.
        if dot(minus(ends[1], ends[0]), direction) > 0.0 {
            least = least.max(-axial_n);
        } else {
            most = most.min(*axial_n);
        }
    }
    let told_n = dot(answer.reactions_n.start, direction);
    // What is added to the bars is taken from the ground at joint 0.
    let range = [told_n - most, told_n - least];
    let pulled = least <= most && range.iter().all(|end| end.is_finite());
    let ours = [SolverName::LAGRANGE, SolverName::ENERGY].contains(&answer.solver);
    let limit = ours && pulled && chain.anchors_on_one_vertical();
    Some(ForceFamily {
        dimension: 1,
        direction,
        start_force_n: pulled.then_some(range),
        choice: if limit { ForceChoice::AnchorsMovedApart } else { ForceChoice::Unknown },
    })
}

/// The unit vector of the line to which all bars are parallel, upwards; nothing if they are not.
fn common_line(chain: &Chain, joints_m: &[Vector]) -> Option<Vector> {
    let bars = || joints_m.windows(2).map(|ends| minus(ends[1], ends[0]));
    let longest = bars().fold([0.0; 3], |a, b| if norm(b) > norm(a) { b } else { a });
    let along = |sum: Vector, bar: Vector| {
        let sign = if dot(bar, longest) < 0.0 { -1.0 } else { 1.0 };
        std::array::from_fn(|k| sum[k] + sign * bar[k])
    };
    let sum = bars().fold([0.0; 3], along);
    let size = norm(sum);
    let unit = if upwards(sum) { 1.0 } else { -1.0 } / size;
    // No negative zeros.
    let line = sum.map(|x| x * unit + 0.0);
    let room_m = STRAIGHT_TOLERANCE * chain.total_length_m() + stored_rounding_m(chain);
    let mut lost_m = 0.0;
    for bar in bars() {
        // l (1 - cos a) = l sin^2 a / (1 + cos a), which loses no digits.
        let (length, across) = (norm(bar), norm(cross(bar, line)));
        lost_m += across * across / (length + dot(bar, line).abs());
        // NaN is not parallel.
        if lost_m.is_nan() || lost_m > room_m {
            return None;
        }
    }
    Some(line)
}

/// Whether a vector points up; of level ones, whether it points along the first axis that it has a
/// part along.
fn upwards([x, y, z]: Vector) -> bool {
    [z, x, y].into_iter().find(|part| part.abs() > 0.0).is_some_and(|part| part > 0.0)
}

/// What two answers of a family differ by beyond a force added along its line: the differences of
/// their joint forces with its mean taken away.
pub(crate) fn beside_the_family(family: &ForceFamily, differences_n: &mut [Vector]) {
    // Joint 0 has the force of the ground on bar 1, all others that of what comes after on the bar
    // before.
    let sign = |k: usize| if k == 0 { -1.0 } else { 1.0 };
    let parts = differences_n.iter().enumerate().map(|(k, d)| sign(k) * dot(*d, family.direction));
    let mean = parts.sum::<f64>() / differences_n.len() as f64;
    for (k, difference) in differences_n.iter_mut().enumerate() {
        for (part, along) in difference.iter_mut().zip(family.direction) {
            *part -= sign(k) * mean * along;
        }
    }
}

#[cfg(test)]
mod tests {
    use model::Reactions;

    use super::*;
    use crate::certificate::tests::answer;

    /// Three bars of 1, 2 and 3 m along a direction, the second one back.
    fn folded(direction: Vector, aside: Vector) -> (Chain, Vec<Vector>) {
        let lengths = [1.0, -2.0, 3.0];
        let mut joints_m = vec![[0.0; 3]];
        for (k, length) in lengths.into_iter().enumerate() {
            let sign = if k == 1 { 1.0 } else { 0.0 };
            let last = joints_m[k];
            joints_m
                .push(std::array::from_fn(|c| last[c] + length * direction[c] + sign * aside[c]));
        }
        let bars = lengths.map(|l: f64| model::Bar::homogeneous(l.abs(), 1.0).unwrap());
        let anchors = model::Anchors { start_m: [0.0; 3], end_m: joints_m[3] };
        (Chain::new("folded", 9.81, anchors, bars.to_vec()).unwrap(), joints_m)
    }

    #[test]
    fn lines_point_upwards_and_level_ones_along_their_first_axis() {
        for (direction, line) in [
            ([0.0, 0.6, 0.8], [0.0, 0.6, 0.8]),
            ([0.0, 0.6, -0.8], [0.0, -0.6, 0.8]),
            ([0.48, -0.64, 0.6], [0.48, -0.64, 0.6]),
            ([0.6, -0.8, 0.0], [0.6, -0.8, 0.0]),
            ([-0.6, 0.8, 0.0], [0.6, -0.8, 0.0]),
            ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]),
        ] {
            let (chain, joints_m) = folded(direction, [0.0; 3]);
            let found = common_line(&chain, &joints_m).unwrap();
            assert!(norm(minus(found, line)) < 1e-15, "{direction:?}: {found:?}");
        }
    }

    /// A bar of 2 m that is aside by 1e-3 m loses 2.5e-7 m: not on the line, whichever way.
    #[test]
    fn a_bar_aside_is_off_the_line_in_every_direction() {
        for (direction, aside) in [
            ([1.0, 0.0, 0.0], [0.0, 1e-3, 0.0]),
            ([1.0, 0.0, 0.0], [0.0, 0.0, 1e-3]),
            ([0.0, 1.0, 0.0], [0.0, 0.0, 1e-3]),
            ([0.0, 1.0, 0.0], [1e-3, 0.0, 0.0]),
            ([0.0, 0.0, 1.0], [0.0, 1e-3, 0.0]),
            ([0.6, 0.0, 0.8], [0.8e-3, 0.0, -0.6e-3]),
            ([0.6, 0.8, 0.0], [0.8e-3, -0.6e-3, 0.0]),
        ] {
            let (chain, joints_m) = folded(direction, aside);
            assert!(common_line(&chain, &joints_m).is_none(), "{direction:?} {aside:?}");
            // A millionth of it is rounding.
            let (chain, joints_m) = folded(direction, aside.map(|x| 1e-6 * x));
            assert!(common_line(&chain, &joints_m).is_some(), "{direction:?} {aside:?}");
        }
    }

    /// Bars of 1, 2 and 3 m up, down and up again between anchors on one vertical, with 4, 5 and
    /// 6 N: what is added along the line relieves the one that runs against it. It may be from -4 to
    /// 5 N, and is taken from the 7 N of the ground at joint 0.
    #[test]
    fn the_forces_are_chosen_where_our_solvers_find_a_chain_that_pulls() {
        let (chain, joints_m) = folded([0.0, 0.0, 1.0], [0.0; 3]);
        let family = |solver: SolverName, axial_n: [f64; 3]| {
            let answer = Equilibrium {
                solver,
                joints_m: joints_m.clone(),
                reactions_n: Reactions { start: [0.0, 0.0, 7.0], end: [0.0; 3] },
                ..answer([0.0; 3], axial_n, 0.0)
            };
            let found = force_family(&chain, &answer).unwrap();
            (found.choice, found.start_force_n)
        };
        let ours = [SolverName::LAGRANGE, SolverName::ENERGY];
        let range = Some([7.0 - 5.0, 7.0 + 4.0]);
        for solver in ours.clone() {
            let found = family(solver, [4.0, 5.0, 6.0]);
            assert_eq!(found, (ForceChoice::AnchorsMovedApart, range));
        }
        let foreign = SolverName::new("a table");
        assert_eq!(family(foreign, [4.0, 5.0, 6.0]), (ForceChoice::Unknown, range));
        // 4 N pressed and 3 N drawn: whatever is added, one of both is pressed.
        for solver in ours {
            assert_eq!(family(solver, [-4.0, 3.0, 6.0]), (ForceChoice::Unknown, None));
        }
    }

    /// What differs by a force along the line alone differs by nothing beside it.
    #[test]
    fn a_force_of_the_family_is_taken_away() {
        let family = ForceFamily {
            dimension: 1,
            direction: [0.0, 0.6, 0.8],
            start_force_n: None,
            choice: ForceChoice::Unknown,
        };
        let added = |k: usize| if k == 0 { -5.0 } else { 5.0 };
        let mut differences: Vec<Vector> =
            (0..4).map(|k| family.direction.map(|x| added(k) * x)).collect();
        differences[2][0] = 0.25;
        beside_the_family(&family, &mut differences);
        for (k, left) in differences.iter().enumerate() {
            let expected = [if k == 2 { 0.25 } else { 0.0 }, 0.0, 0.0];
            assert!(norm(minus(*left, expected)) < 1e-15, "{k}: {left:?}");
        }
    }

    /// The bar of 2 m aside by `a` turns by `a/2` and the line by `a/6`: the bars lose `a²/6` together.
    /// They may lose 24 units in the last place of 6 m, and far from the origin 2^-29 m.
    #[test]
    fn lines_far_away_are_known_to_the_rounding_of_places() {
        let far = 2.0_f64.powi(20);
        let aligned = |origin: f64, aside_m: f64| {
            let (chain, joints_m) = folded([0.0, 0.0, 1.0], [0.0, aside_m, 0.0]);
            let mut anchors = *chain.anchors();
            (anchors.start_m[0], anchors.end_m[0]) = (origin, origin);
            let chain = Chain::new("far", 9.81, anchors, chain.bars().to_vec()).unwrap();
            common_line(&chain, &joints_m).is_some()
        };
        for (origin, room_m) in [(0.0, 144.0 * f64::EPSILON), (far, 2.0_f64.powi(-29))] {
            let aside_m = (6.0 * room_m).sqrt();
            assert!(aligned(origin, 0.9 * aside_m) && !aligned(origin, 1.1 * aside_m), "{origin}");
        }
    }
}
