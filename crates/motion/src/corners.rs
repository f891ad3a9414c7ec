//! Bars with three different moments: four points in place of two.
//!
//! Where the moments across a bar differ, its spin acts on its direction. Such a bar gets two
//! *corners* beside its ends: points of it at the distance `s` from its centre, on its second and
//! third principal axis, held by five bars without mass. Every material point is a sum of the four
//! with constant parts (`ξ`, `η`, `ζ` its coordinates along the axes over `l`, `s`, `s`; `f =
//! r/l`),
//!
//! $$ x = (1 - \xi - (1-f)(\eta + \zeta)) x_a + (\xi - f (\eta + \zeta)) x_b + \eta x_p + \zeta x_q, $$
//!
//! so the mass matrix is constant, and the four points have neither a gimbal lock nor a unit
//! quaternion to be normalised (natural coordinates: J. García de Jalón, E. Bayo, *Kinematic and
//! Dynamic Simulation of Multibody Systems*, Springer 1994).

use model::system::{Joint, Kind, Member, System};
use model::{Bar, Vector};

use crate::error::{MotionError, Result};
use crate::inertia::EndInertia;
use numerics::vector::{add_times, cross, dot, minus, norm, plus, times};

/// Largest relative difference of the two moments across a bar that counts as rounding.
const EQUAL_MOMENTS: f64 = 1e-12;

/// Distance of a corner from the centre, in units of the length: the bars between the four points
/// then have lengths of its order.
const ARM: f64 = 0.5;

/// Least second moment about a principal plane, in units of the largest moment: below it corners
/// have no inertia.
const LEAST_SECOND_MOMENT: f64 = 1e-9;

/// A bar with corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cornered {
    /// Its number among the members.
    pub member: usize,
    /// Numbers of its joints: begin, end, corner on the second axis; that on the third is the next.
    pub joints: [usize; 3],
    /// Number of the first of the five bars without mass, which follow each other.
    pub first: usize,
}

/// A system with corners added behind its joints, and their bars behind its members.
pub(crate) struct Expanded {
    pub system: System,
    /// Of all members.
    pub inertia: Vec<EndInertia>,
    pub cornered: Vec<Cornered>,
}

/// Whether the two moments across a bar are equal.
pub(crate) fn is_symmetric(bar: &Bar) -> bool {
    let [_, jy, jz] = bar.inertia_kg_m2();
    (jy - jz).abs() <= EQUAL_MOMENTS * jy.max(jz)
}

pub(crate) fn unequal(number: usize, bar: &Bar, reason: &'static str) -> MotionError {
    let moments_kg_m2 = bar.inertia_kg_m2();
    MotionError::UnequalMoments { member: number + 1, moments_kg_m2, reason }
}

/// Part of its length that a bar reaches to the side and counts as upright: places of equilibria
/// are rounded more coarsely than doubles.
const UPRIGHT: f64 = 1e-9;

/// The second principal axis of a bar along `d` that has not turned about itself: level; where the
/// bar is upright along OY.
pub(crate) fn second_axis(d: Vector) -> Vector {
    let level = [-d[1], d[0], 0.0];
    let size = norm(level);
    let near = if size > UPRIGHT * norm(d) { times(1.0 / size, level) } else { [0.0, 1.0, 0.0] };
    let across = add_times(near, -dot(near, d) / dot(d, d), d);
    times(1.0 / norm(across), across)
}

/// Add corners to all bars whose moments across differ.
/// [`MotionError::UnequalMoments`] where a bar with a stiffness has such moments, or where one of
/// the three is not less than the sum of the other two: a body has none such, or lies in a plane.
pub(crate) fn expand(system: &System) -> Result<Expanded> {
    let (mut joints, mut members) = (system.joints().to_vec(), system.members().to_vec());
    let mut inertia: Vec<EndInertia> = members.iter().map(|m| EndInertia::new(&m.body)).collect();
    let mut cornered = Vec::new();
    for (number, member) in system.members().iter().enumerate() {
        let bar = &member.body;
        if is_symmetric(bar) {
            continue;
        }
        let refused =
            || unequal(number, bar, "in motion each has to be less than the sum of the other two");
        if member.stiffness_n.is_some() || member.kind != Kind::Bar {
            return Err(unequal(
                number,
                bar,
                "it may stretch or go slack, and they differ across it",
            ));
        }
        let corner = joints.len();
        let [a, b, p, q] = [member.from, member.to, corner, corner + 1];
        cornered.push(Cornered { member: number, joints: [a, b, p], first: members.len() });
        for axis in ["second", "third"] {
            joints.push(Joint::free(format!("corner on the {axis} axis of member {}", number + 1)));
        }
        let matrix = matrix(bar).ok_or_else(refused)?;
        inertia[number] = matrix[0];
        let (l, r, s) = (bar.length_m(), bar.centre_m(), ARM * bar.length_m());
        let far = [(a, p, r), (b, p, l - r), (a, q, r), (b, q, l - r), (p, q, s)];
        for ((from, to, along), inertia_of) in far.into_iter().zip(&matrix[1..]) {
            let tie = Bar::homogeneous(along.hypot(s), 0.0).map_err(|_| refused())?;
            members.push(Member::bar(from, to, tie));
            inertia.push(*inertia_of);
        }
    }
    if cornered.is_empty() {
        return Ok(Expanded { system: system.clone(), inertia, cornered });
    }
    let expanded = System::new(system.name(), system.gravity_m_s2(), joints, members);
    let system = expanded.map_err(|_| {
        let first = cornered[0].member;
        unequal(first, &system.members()[first].body, "corners find no place in the system")
    })?;
    Ok(Expanded { system, inertia, cornered })
}

/// The mass matrix of the four points by pairs: ab, ap, bp, aq, bq, pq. The diagonal is part of ab
/// (a, b), ap (p) and aq (q).
fn matrix(bar: &Bar) -> Option<[EndInertia; 6]> {
    let [jx, jy, jz] = bar.inertia_kg_m2();
    let least = LEAST_SECOND_MOMENT * jx.max(jy).max(jz);
    // Second moments ∫ x², ∫ y², ∫ z² about the centre.
    let second = [0.5 * (jy + jz - jx), 0.5 * (jx + jz - jy), 0.5 * (jx + jy - jz)];
    if second.iter().any(|s| s.is_nan() || *s <= least) {
        return None;
    }
    let (l, m) = (bar.length_m(), bar.mass_kg());
    let arm = ARM * l;
    let (f, near) = (bar.centre_m() / l, (l - bar.centre_m()) / l);
    let [x, y, z] = [second[0] / l / l, second[1] / arm / arm, second[2] / arm / arm];
    let across = m + y + z;
    let pair = |from, between, to| EndInertia { from, between, to };
    Some([
        pair(near * near * across + x, near * f * across - x, f * f * across + x),
        pair(0.0, -near * y, y),
        pair(0.0, -f * y, 0.0),
        pair(0.0, -near * z, z),
        pair(0.0, -f * z, 0.0),
        pair(0.0, 0.0, 0.0),
    ])
}

impl Cornered {
    /// Append the places of the corners to those of the joints: see [`second_axis`].
    pub(crate) fn place(&self, bar: &Bar, at: &mut Vec<Vector>) {
        let [a, b, _] = self.joints;
        let d = minus(at[b], at[a]);
        let second = second_axis(d);
        let third = cross(d, second);
        let arm = ARM * bar.length_m();
        let centre = add_times(at[a], bar.centre_m() / bar.length_m(), d);
        at.push(add_times(centre, arm, second));
        at.push(add_times(centre, arm / norm(third).max(f64::MIN_POSITIVE), third));
    }
}

/// How a bar with three different moments turns, of which the places of its ends say a part alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// Its number among the members, from 0.
    pub member: usize,
    /// Its principal axes: along it, the second, the third; world frame.
    pub axes: [Vector; 3],
    /// Angular velocity, world frame, rad/s.
    pub omega_rad_s: Vector,
    /// Angular acceleration, world frame, rad/s².
    pub alpha_rad_s2: Vector,
}

impl Turning {
    /// Of places, velocities and accelerations by joint, corners included.
    pub(crate) fn new(
        cornered: &Cornered,
        bar: &Bar,
        at: &[Vector],
        velocity: &[Vector],
        acceleration: &[Vector],
    ) -> Self {
        let [a, b, p] = cornered.joints;
        let (l, arm) = (bar.length_m(), ARM * bar.length_m());
        let f = bar.centre_m() / l;
        let along = |v: &[Vector]| times(1.0 / l, minus(v[b], v[a]));
        let across = |v: &[Vector], corner: usize| {
            let centre = add_times(v[a], f, minus(v[b], v[a]));
            times(1.0 / arm, minus(v[corner], centre))
        };
        let (first, second, third) = (along(at), across(at, p), across(at, p + 1));
        let (rate, second_rate) = (along(velocity), across(velocity, p));
        let (turned, second_turned) = (along(acceleration), across(acceleration, p));
        // ė = ω × e and ë = α × e + ω × (ω × e), for the first and the second axis.
        let spin = dot(third, second_rate);
        let omega = add_times(cross(first, rate), spin, first);
        let spin_rate = dot(third, second_turned) - dot(omega, second) * dot(omega, third);
        let bent = add_times(cross(first, turned), -spin, cross(first, omega));
        Self {
            member: cornered.member,
            axes: [first, second, third],
            omega_rad_s: omega,
            alpha_rad_s2: add_times(bent, spin_rate, first),
        }
    }

    /// Angular momentum about the centre, and its rate, kg m²/s and N m.
    pub(crate) fn momentum(&self, moments_kg_m2: [f64; 3]) -> [Vector; 2] {
        let weighed = |v: Vector| {
            let parts = self.axes.iter().zip(moments_kg_m2);
            parts.fold([0.0; 3], |sum, (axis, j)| add_times(sum, j * dot(*axis, v), *axis))
        };
        let momentum = weighed(self.omega_rad_s);
        let rate = plus(weighed(self.alpha_rad_s2), cross(self.omega_rad_s, momentum));
        [momentum, rate]
    }
}
