//! Frames that are built up joint by joint: three bars to joints whose places are known fix a
//! joint, two let it swing.
//!
//! A joint held by three bars of the lengths $r_i$ to known places $a_i$ is where three spheres
//! meet: with $e_i = a_i - a_1$ and $p = x - a_1$,
//!
//! $$ p \cdot e_2 = \tfrac12(r_1^2 - r_2^2 + |e_2|^2), \quad p \cdot e_3 = \tfrac12(r_1^2 - r_3^2 + |e_3|^2), \quad
//!    |p|^2 = r_1^2, $$
//!
//! two places, mirror images in the plane of the $a_i$, or none. It cannot move, and its three
//! forces follow from its balance. A joint held by two bars alone goes round in a circle about the
//! line through both ends; it is in balance where the part of its load across that line points
//! along the radius: outward, a minimum, or inward, a maximum. So a frame with k joints of the one
//! and the other kind has at most $2^k$ positions, by closed forms.

use model::NoCensus;
use model::system::{Member, System};
use numerics::Interval;

use super::choice::{Choice, Measured};
use super::{MAX_POSITIONS, Result};
use crate::boxes::arithmetic::{
    Vector, cross, difference, dot, factors, minus, norm, plus, product, squared, sum, times,
};

/// A joint with the members that hold it, and where they begin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Placed {
    pub(super) joint: usize,
    /// Two or three members, each with the joint at its other end.
    pub(super) held_by: Vec<(usize, usize)>,
}

/// In which order the joints of a part can be placed; nothing if they cannot, or a member is elastic or a rope.
pub(super) fn order(system: &System, joints: &[usize], members: &[usize]) -> Option<Vec<Placed>> {
    let other = |member: &Member| member.stiffness_n.is_some() || member.rope.is_some();
    if members.iter().any(|member| other(&system.members()[*member])) {
        return None;
    }
    let mut rigid: Vec<bool> = system.joints().iter().map(|j| j.support.is_fixed()).collect();
    let ends = |member: usize| [system.members()[member].from, system.members()[member].to];
    let held_by = |joint: usize, rigid: &[bool]| -> Vec<(usize, usize)> {
        let of_joint = members.iter().filter_map(|member| match ends(*member) {
            [a, b] if a == joint => Some((*member, b)),
            [a, b] if b == joint => Some((*member, a)),
            _ => None,
        });
        of_joint.filter(|(_, other)| rigid[*other]).collect()
    };
    let mut left = joints.to_vec();
    let mut order = vec![];
    let mut used = 0;
    while let Some(at) = left.iter().position(|joint| held_by(*joint, &rigid).len() >= 3) {
        let joint = left.swap_remove(at);
        let held_by = held_by(joint, &rigid);
        used += held_by.len();
        if held_by.len() > 3 {
            return None;
        }
        rigid[joint] = true;
        order.push(Placed { joint, held_by });
    }
    for joint in left {
        let held_by = held_by(joint, &rigid);
        used += held_by.len();
        if held_by.len() != 2 {
            return None;
        }
        order.push(Placed { joint, held_by });
    }
    // A member between two joints that swing is in none of these.
    (used == members.len()).then_some(order)
}

/// All positions of a frame under these loads of its joints.
pub(super) fn positions(
    of: Measured<'_>,
    order: &[Placed],
    loads: &[Vector],
) -> Result<Vec<Choice>> {
    let (places, frame) = (of.system.joints().iter().enumerate(), of.frame);
    let anchors = places.filter_map(|(k, joint)| Some((k, frame.place(joint.support.at_m()?))));
    let mut choices = vec![Choice { places: anchors.collect(), ..Choice::default() }];
    for placed in order {
        let mut next = vec![];
        for choice in &choices {
            next.extend(placed_on(of, choice, placed, loads)?);
        }
        if next.len() > MAX_POSITIONS {
            return Err(NoCensus::TooManyPositions { limit: MAX_POSITIONS });
        }
        choices = next;
    }
    for choice in &mut choices {
        balance(choice, order, loads)?;
    }
    Ok(choices)
}

/// A position with one more joint, in both ways.
fn placed_on(
    of: Measured<'_>,
    choice: &Choice,
    placed: &Placed,
    loads: &[Vector],
) -> Result<Vec<Choice>> {
    let flat = NoCensus::Flat { joint: placed.joint + 1 };
    let mut spheres = vec![];
    for (member, other) in &placed.held_by {
        spheres.push((choice.place(*other).ok_or(flat)?, of.length(*member)));
    }
    // The place of the joint on the plane or line of the others, and how far off it is in which
    // direction.
    let found = match spheres[..] {
        [a, b] => off_line(a, b, loads[placed.joint]),
        [a, b, c] => off_plane(a, b, c),
        _ => Err(Miss::Undecided),
    };
    let (foot, off) = match found {
        Ok(found) => found,
        Err(Miss::Nowhere) => return Ok(vec![]),
        Err(Miss::Undecided) => return Err(flat),
    };
    let swings = spheres.len() == 2;
    let one = |place: Vector, falls: bool| {
        let index = if falls { [0, 1] } else { [0, 0] };
        choice.and(&Choice { places: vec![(placed.joint, place)], index, ..Choice::default() })
    };
    Ok(vec![one(plus(foot, off), false), one(minus(foot, off), swings)])
}

enum Miss {
    /// The spheres do not meet.
    Nowhere,
    /// They may touch, or their centres may be on one line.
    Undecided,
}

type Sphere = (Vector, Interval);

/// The square root of a square that is proved positive.
fn root(square: Interval) -> Result<Interval, Miss> {
    match square.sign() {
        Some(1) => Ok(square.sqrt()),
        Some(-1) => Err(Miss::Nowhere),
        _ => Err(Miss::Undecided),
    }
}

/// `(r² − s² + |e|²)/2`: the product of e with the place relative to the first centre.
fn along(first: Sphere, other: Sphere) -> (Vector, Interval) {
    let span = minus(other.0, first.0);
    let squares = difference(first.1.square(), other.1.square());
    (span, sum(squares, squared(span)).scale(0.5))
}

/// Where two spheres meet, along the part of the load across the line of their centres.
fn off_line(a: Sphere, b: Sphere, load: Vector) -> Result<(Vector, Vector), Miss> {
    let (span, product_with_span) = along(a, b);
    let size = squared(span);
    if size.lo() <= 0.0 {
        return Err(Miss::Undecided);
    }
    let foot = times(product_with_span / size, span);
    let radius = root(a.1.square() - squared(foot))?;
    let across = minus(load, times(dot(load, span) / size, span));
    let pull = norm(across);
    if pull.lo() <= 0.0 {
        return Err(Miss::Undecided);
    }
    Ok((plus(a.0, foot), times(radius / pull, across)))
}

/// Where three spheres meet, along the normal of the plane of their centres.
fn off_plane(a: Sphere, b: Sphere, c: Sphere) -> Result<(Vector, Vector), Miss> {
    let ((e, p), (f, q)) = (along(a, b), along(a, c));
    let normal = cross(e, f);
    let size = squared(normal);
    if size.lo() <= 0.0 {
        return Err(Miss::Undecided);
    }
    let (ee, ef, ff) = (squared(e), dot(e, f), squared(f));
    let alpha = difference(product(p, ff), product(q, ef)) / size;
    let beta = difference(product(q, ee), product(p, ef)) / size;
    let foot = plus(times(alpha, e), times(beta, f));
    let height = root(a.1.square() - squared(foot))?;
    Ok((plus(a.0, foot), times(height / size.sqrt(), normal)))
}

/// The axial forces, from the joints placed last to the first.
fn balance(choice: &mut Choice, order: &[Placed], loads: &[Vector]) -> Result<()> {
    let mut forces = loads.to_vec();
    for placed in order.iter().rev() {
        let flat = NoCensus::Flat { joint: placed.joint + 1 };
        let here = choice.place(placed.joint).ok_or(flat)?;
        let mut spans = vec![];
        for (_, other) in &placed.held_by {
            spans.push(minus(choice.place(*other).ok_or(flat)?, here));
        }
        let borne = times(-Interval::ONE, forces[placed.joint]);
        let densities = factors(&spans, borne).ok_or(flat)?;
        for (((member, other), span), density) in placed.held_by.iter().zip(&spans).zip(densities) {
            forces[*other] = minus(forces[*other], times(density, *span));
            choice.axial.push((*member, product(density, norm(*span))));
        }
    }
    Ok(())
}
