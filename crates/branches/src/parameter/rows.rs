//! Rows of bars as wholes: how many bars one has, and how long one is beside the next, with length, mass and
//! loads of all of them together.

use model::system::{Joint, Member, PointLoad, Support};
use model::system_file::most_bars;

use crate::parameter::apply::{PointError, UncheckedBar};
use crate::parameter::number::Which;

/// The whole row that all these bars are of, from 1, by the first and the last bar, from 0, of the row that a
/// bar is of; without value where they are of several.
pub(super) fn whole(which: Which, bars: usize, row: impl Fn(usize) -> [usize; 2]) -> Option<Which> {
    let (first, last) = which.ends();
    let [a, b] = row(first.checked_sub(1).filter(|bar| *bar < bars)?);
    (last.min(bars) <= b + 1).then_some(Which::Range(a + 1, b + 1))
}

/// The first and the last of the neighbours of a bar that belong to it, each bar with the next one.
pub(super) fn run(of: usize, bars: usize, belongs: impl Fn(usize) -> bool) -> [usize; 2] {
    let first = (0..of).rev().find(|k| !belongs(*k)).map_or(0, |k| k + 1);
    let last = (of..bars.saturating_sub(1)).find(|k| !belongs(*k)).unwrap_or(bars - 1);
    [first, last]
}

/// The row of equal members that a member is of, as a `count` of a file makes it.
pub(super) fn row(joints: &[Joint], members: &[Member], of: usize) -> [usize; 2] {
    let anywhere = |member: &Member| member.clone().between(0, 0);
    let follows = in_row(joints, members);
    run(of, members.len(), |k| follows(k) && anywhere(&members[k]) == anywhere(&members[k + 1]))
}

/// Whether a member and the next one are of one row: between them is a joint with no load of its own, called by
/// its number in the row or in the chain.
fn in_row<'a>(joints: &'a [Joint], members: &'a [Member]) -> impl Fn(usize) -> bool + 'a {
    let mut meet = vec![0_usize; joints.len()];
    for member in members {
        for joint in member.path() {
            meet[joint] += 1;
        }
    }
    move |k| {
        let [here, next] = [&members[k], &members[k + 1]];
        here.to == next.from
            && [here, next].iter().all(|member| member.rope.is_none())
            && meet[here.to] == 2
            && is_between(&joints[here.to], &joints[here.from].name.text())
    }
}

/// Both rows that meet in a joint, from 0, in the order of the file; without value where it is not two.
pub(super) fn sides(joints: &[Joint], members: &[Member], joint: usize) -> Option<[[usize; 2]; 2]> {
    let meets = |member: &Member| member.from == joint || member.to == joint;
    let mut at = members.iter().enumerate().filter(|(_, member)| meets(member));
    let (first, second) = (at.next()?.0, at.next()?.0);
    let side = |of: usize| run(of, members.len(), in_row(joints, members));
    let both = [side(first), side(second)];
    let straight = [first, second].iter().all(|k| members[*k].rope.is_none());
    (straight && at.next().is_none() && both[0] != both[1]).then_some(both)
}

/// A joint with another share of the length of both rows that meet there on the side of the first.
pub(super) fn share(
    joints: &[Joint],
    members: &mut [Member],
    joint: usize,
    value: f64,
) -> Result<(), PointError> {
    let Some(sides) = sides(joints, members, joint) else { return Ok(()) };
    let lengths = sides.map(|[first, last]| -> f64 {
        members[first..=last].iter().map(|member| member.given_body().length_m()).sum()
    });
    let all = lengths[0] + lengths[1];
    for (([first, last], length), share) in sides.into_iter().zip(lengths).zip([value, 1.0 - value])
    {
        for (k, member) in members[first..=last].iter_mut().enumerate() {
            *member = divided(member, share * all / length, first + k + 1)?;
        }
    }
    Ok(())
}

/// Whether a joint is one of those that a count makes, behind the joint of this name.
fn is_between(joint: &Joint, before: &str) -> bool {
    let bare = joint.mass_kg <= 0.0 && joint.force_n.iter().all(|x| x.abs() <= 0.0);
    let name = joint.name.text();
    let follows = match name.rsplit_once('.') {
        Some((row, "1")) => row.strip_prefix(before).is_some_and(|rest| rest.starts_with('-')),
        Some((row, k)) => {
            k.parse().is_ok_and(|k: usize| k > 0 && before == format!("{row}.{}", k - 1))
        }
        None => name.parse().is_ok_and(|k: usize| k > 0 && before == (k - 1).to_string()),
    };
    bare && follows && matches!(joint.support, Support::Free | Support::Plane { .. })
}

/// A value of a count as one.
pub(super) fn number(value: f64, others: usize) -> Result<usize, PointError> {
    let most = most_bars().saturating_sub(others);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
    let count = value as usize;
    let fits = (1..=most).contains(&count) && (count as f64 - value).abs() <= 0.0;
    fits.then_some(count).ok_or(PointError::Count { value, most })
}

/// A row, from 0, with another count; the joints between its bars are new.
pub(super) fn set(
    joints: &mut Vec<Joint>,
    members: &mut Vec<Member>,
    [first, last]: [usize; 2],
    value: f64,
) -> Result<(), PointError> {
    let old = last - first + 1;
    let count = number(value, members.len() - old)?;
    if row(joints, members, first) != [first, last] {
        return Err(PointError::Unequal { first: first + 1, last: last + 1 });
    }
    if members[first].rope.is_some() {
        // It runs over joints of its own.
        return if count > 1 { Err(PointError::Count { value, most: 1 }) } else { Ok(()) };
    }
    let part = old as f64 / count as f64;
    let model = divided(&members[first], part, first + 1)?;
    let ends = [members[first].from, members[last].to];
    let between: Vec<usize> = members[first..last].iter().map(|member| member.to).collect();
    let new = joints_between(joints, ends, between.first().map(|k| &joints[*k]), count);
    // The new joints stand where the first of the old ones stood, or at the end.
    let place = between.first().copied().unwrap_or(joints.len());
    let mut goes = vec![0; joints.len()];
    let mut all = Vec::with_capacity(joints.len() + count);
    for (k, joint) in std::mem::take(joints).into_iter().enumerate() {
        if k == place {
            all.extend(new.iter().cloned());
        }
        goes[k] = all.len();
        if !between.contains(&k) {
            all.push(joint);
        }
    }
    let begins = if place < goes.len() { goes[place] - new.len() } else { all.len() };
    if place == goes.len() {
        all.extend(new);
    }
    let at = |k: usize| match k {
        0 => goes[ends[0]],
        _ if k == count => goes[ends[1]],
        _ => begins + k - 1,
    };
    let all_new: Vec<_> = (0..count).map(|k| model.clone().between(at(k), at(k + 1))).collect();
    let moved = std::mem::take(members).into_iter().map(|member| member.renumbered(|k| goes[k]));
    *members = moved.collect();
    members.splice(first..=last, all_new);
    *joints = all;
    Ok(())
}

/// A member, of this number from 1, with a part of the length, mass and loads.
fn divided(member: &Member, part: f64, bar: usize) -> Result<Member, PointError> {
    let prestress_n = member.prestress_n();
    let mut member = member.clone().as_given();
    let body = UncheckedBar::new(&member.body).divided(part).bar();
    member.body = body.map_err(|error| PointError::Bar { bar, error })?;
    member.set_length_tolerance(member.length_tolerance_m().map(|within_m| part * within_m));
    let length_m = member.body.length_m();
    for PointLoad { at_m, force_n, .. } in &mut member.loads {
        *at_m = (part * *at_m).min(length_m);
        *force_n = force_n.map(|x| part * x);
    }
    match prestress_n {
        Some(force_n) => {
            member.with_prestress(force_n).map_err(|error| PointError::Prestress { bar, error })
        }
        None => Ok(member),
    }
}

/// The joints between so many bars, each like one that was there, drawn on the line between the ends.
fn joints_between(
    joints: &[Joint],
    [from, to]: [usize; 2],
    like: Option<&Joint>,
    count: usize,
) -> Vec<Joint> {
    let name = |k: usize| joints[k].name.text();
    let like_name = like.map(|joint| joint.name.text());
    let row = match like_name.as_deref().and_then(|name| name.rsplit_once('.')) {
        Some((row, _)) => row.to_owned(),
        None => format!("{}-{}", name(from), name(to)),
    };
    let support = like.map_or(Support::Free, |joint| joint.support);
    let drawn = joints.iter().any(|joint| joint.near_m.is_some());
    let ends_m = joints[from].drawn_m().zip(joints[to].drawn_m()).filter(|_| drawn);
    let joint = |k: usize| {
        Joint::free(format!("{row}.{k}")).held_by(support).near(ends_m.map(|(a, b)| {
            let part = k as f64 / count as f64;
            std::array::from_fn(|c| a[c] + part * (b[c] - a[c]))
        }))
    };
    (1..count).map(joint).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of seven bars the first three belong together, and the last two.
    #[test]
    fn runs_end_where_bars_do_not_belong_to_the_next() {
        let belongs = |k: usize| [0, 1, 5].contains(&k);
        for (of, ends) in [
            (0, [0, 2]),
            (1, [0, 2]),
            (2, [0, 2]),
            (3, [3, 3]),
            (4, [4, 4]),
            (5, [5, 6]),
            (6, [5, 6]),
        ] {
            assert_eq!(run(of, 7, belongs), ends);
            assert_eq!(run(of, 7, |_| true), [0, 6]);
            assert_eq!(run(of, 7, |_| false), [of, of]);
        }
        assert_eq!(run(0, 1, |_| false), [0, 0]);
        // Bars from 1: those of one run are the whole of it; beyond it, or beyond the last, they are of none.
        let row = |of: usize| run(of, 7, belongs);
        let range = |first, last| whole(Which::Range(first, last), 7, row);
        assert_eq!(range(1, 2), Some(Which::Range(1, 3)));
        assert_eq!(range(6, 6), Some(Which::Range(6, 7)));
        assert_eq!(range(6, 9), Some(Which::Range(6, 7)));
        assert_eq!((range(3, 4), range(5, 6), range(8, 8)), (None, None, None));
    }

    /// A row of A is A-R.1, A-R.2.., a chain 1, 2..: without load, and free or in a plane.
    #[test]
    fn joints_of_a_row_follow_by_their_numbers() {
        for (name, before, follows) in [
            ("A-R.1", "A", true),
            ("A-R.1", "B", false),
            ("A-R.2", "A-R.1", true),
            ("A-R.3", "A-R.1", false),
            ("A-R.0", "A", false),
            ("1", "0", true),
            ("12", "11", true),
            ("0", "", false),
            ("2", "0", false),
            ("P", "A", false),
        ] {
            let joint = Joint::free(name);
            assert_eq!(is_between(&joint, before), follows, "{before} {name}");
            assert!(!is_between(&joint.clone().with_mass(0.1), before), "{before} {name}");
            assert!(!is_between(&joint.clone().with_force([0.0, -1.0, 0.0]), before));
            assert!(!is_between(&Joint::anchor(name, [0.0; 3]), before), "{before} {name}");
            let support = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
            assert_eq!(is_between(&joint.held_by(support), before), follows);
        }
    }

    /// Of three bars from (1, 2, 3) to (4, 8, -3) the joints are drawn at a third and two of the way; where nothing
    /// is drawn they are not.
    #[test]
    fn new_joints_are_drawn_between_the_ends() {
        let drawn = Joint::free("B").near([4.0, 8.0, -3.0]);
        let joints = [Joint::anchor("A", [1.0, 2.0, 3.0]), Joint::free("A-R.1"), drawn];
        let new = joints_between(&joints, [0, 2], Some(&joints[1]), 3);
        let names: Vec<_> = new.iter().map(|joint| joint.name.text()).collect();
        assert_eq!(names, ["A-R.1", "A-R.2"]);
        for (joint, wanted) in new.iter().zip([[2.0, 4.0, 1.0], [3.0, 6.0, -1.0]]) {
            let at = joint.near_m.unwrap();
            assert!((0..3).all(|k| (at[k] - wanted[k]).abs() < 1e-14), "{at:?}");
            assert_eq!(joint.support, Support::Free);
        }
        let joints = [Joint::anchor("A", [1.0, 2.0, 3.0]), Joint::anchor("B", [4.0, 8.0, -3.0])];
        let new = joints_between(&joints, [0, 1], None, 2);
        assert_eq!((new.len(), new[0].near_m), (1, None));
        assert_eq!(new[0].name, "A-B.1");
    }
}
