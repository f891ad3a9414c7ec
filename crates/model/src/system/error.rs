//! Why a system cannot be built.

use std::hash::{BuildHasher as _, RandomState};

use super::{Joint, Kind, Member, RopeFault, Support};
use crate::mass_range::too_wide;
use crate::readable::Readable;
use crate::{SMALLEST_TOTAL, Vector};

/// Why a system, or a chain, cannot be built.
///
/// Members are counted from 1, joints are named.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SystemError {
    /// Occurs when gravity, in m/s², is zero, negative, infinite or not a number.
    #[error(
        "gravity must be positive and finite (it acts along -Z), got {} m/s^2",
        Readable(*.0)
    )]
    Gravity(f64),
    /// Occurs when there are no members.
    #[error("a system needs at least one member")]
    NoMembers,
    /// Occurs when two joints have the same name.
    #[error("two joints are called {name:?}")]
    DuplicateName {
        /// The name.
        name: String,
        /// Number of the second of them, from 0.
        joint: usize,
    },
    /// Occurs when a coordinate of a support or of a drawing is infinite or not a number.
    #[error("the coordinates of joint {name:?} must be finite, got {coordinate_m} m")]
    Coordinate {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
        /// The first bad coordinate.
        coordinate_m: f64,
    },
    /// Occurs when the direction of a line or the normal of a plane is not of unit length.
    #[error("the direction of the support of joint {name:?} must have the length 1, got {}", Readable(*length))]
    Direction {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
        /// The length as given.
        length: f64,
    },
    /// Occurs when a point mass is negative, infinite or not a number.
    #[error("the mass at joint {name:?} must be zero or positive, and finite, got {} kg", Readable(*mass_kg))]
    Mass {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
        /// The mass as given.
        mass_kg: f64,
    },
    /// Occurs when a force at a joint is infinite or not a number.
    #[error("the force at joint {name:?} must be finite, got {component_n} N")]
    Force {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
        /// The first bad component.
        component_n: f64,
    },
    /// Occurs when a member begins or ends at a joint that is not there.
    #[error("member {member} meets joint number {joint}, and there are only {joints}")]
    NoSuchJoint {
        /// Number of the member, from 1.
        member: usize,
        /// Number of the joint, from 0.
        joint: usize,
        /// Number of joints.
        joints: usize,
    },
    /// Occurs when a member names a joint that is not there.
    #[error("member {member} names a joint {name:?} that is not there")]
    UnknownJoint {
        /// Number of the member, from 1.
        member: usize,
        /// The name.
        name: String,
    },
    /// Occurs when a member begins and ends at the same joint.
    #[error("a member begins and ends at joint {joint:?}")]
    SelfLoop {
        /// Number of the member, from 1.
        member: usize,
        /// Name of the joint.
        joint: String,
    },
    /// Occurs when a rope over rings or pulleys cannot be modelled here.
    #[error("{fault}")]
    Rope {
        /// Number of the member, from 1.
        member: usize,
        /// What is wrong with it.
        fault: RopeFault,
    },
    /// Occurs when two members connect the same two joints: how they share a force is
    /// indeterminate.
    #[error(
        "two members connect joint {from:?} with joint {to:?} (numbers {first} and {member}): how \
         they share a force is indeterminate"
    )]
    Parallel {
        /// Number of the second member, from 1.
        member: usize,
        /// Number of the first member, from 1.
        first: usize,
        /// Name of a joint.
        from: String,
        /// Name of the other joint.
        to: String,
    },
    /// Occurs when the axial stiffness of a member is zero, negative, infinite or not a number.
    #[error("the stiffness EA of a member must be positive and finite, got {} N", Readable(*stiffness_n))]
    Stiffness {
        /// Number of the member, from 1.
        member: usize,
        /// The stiffness as given.
        stiffness_n: f64,
    },
    /// Occurs when a cable has a strength in compression, or a strut one in tension.
    #[error("{what}")]
    IdleStrength {
        /// Number of the member, from 1.
        member: usize,
        /// What has no meaning.
        what: &'static str,
    },
    /// Occurs when the tolerance of a length is zero, negative, infinite, not a number, or as large as the length.
    #[error("the tolerance of a length must be positive and less than the length, {} m, got {} m", Readable(*length_m), Readable(*tolerance_m))]
    LengthTolerance {
        /// Number of the member, from 1.
        member: usize,
        /// Its length.
        length_m: f64,
        /// The tolerance as given.
        tolerance_m: f64,
    },
    /// Occurs when a force acts at a point that is not on its member, or is not finite.
    #[error(
        "a force on a member must be finite and act between 0 and its length {} m, got {component_n} N \
         at {at_m} m", Readable(*length_m)
    )]
    PointLoad {
        /// Number of the member, from 1.
        member: usize,
        /// Place of the force.
        at_m: f64,
        /// Length of the member.
        length_m: f64,
        /// The component of largest size, or the first that is not finite.
        component_n: f64,
    },
    /// Occurs when a drawing leaves a joint out.
    #[error(
        "joint {name:?} is not drawn: with a place near_m for one joint, all that are free need one"
    )]
    NotDrawn {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
    },
    /// Occurs when two joints are drawn at one place.
    #[error("joints {other:?} and {name:?} are drawn at one place")]
    DrawnTogether {
        /// Name of the second joint.
        name: String,
        /// Its number, from 0.
        joint: usize,
        /// Name of the first joint.
        other: String,
    },
    /// Occurs when a joint is drawn where its support does not let it be.
    #[error("joint {name:?} is drawn {} m away from where its support lets it be", Readable(*distance_m))]
    DrawnOffSupport {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
        /// How far away.
        distance_m: f64,
    },
    /// Occurs when the height of the floor, in m, is infinite or not a number.
    #[error("the height of the floor must be finite, got {0} m")]
    Floor(f64),
    /// Occurs when a support holds a joint below the floor.
    #[error(
        "joint {name:?} is held at the height {} m, below the floor at {} m", Readable(*height_m), Readable(*floor_m)
    )]
    BelowFloor {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
        /// The greatest height to which its support lets it.
        height_m: f64,
        /// Height of the floor.
        floor_m: f64,
    },
    /// Occurs when a load acts at a joint, or on a member, that is not there.
    #[error("a load acts on {what} number {number} (from 0), which is not there")]
    NoSuchLoaded {
        /// `joint` or `member`.
        what: &'static str,
        /// Its number, from 0.
        number: usize,
    },
    /// Occurs when two load cases have the same name, this one.
    #[error("two load cases are called {0:?}")]
    DuplicateCase(String),
    /// Occurs when a system has no load case of a name.
    #[error("there is no load case {case:?}; {}", if known.is_empty() { "the system has none".to_owned() } else { format!("there are {}", quoted(known)) })]
    UnknownCase {
        /// The name.
        case: String,
        /// The names of those that there are.
        known: Vec<String>,
    },
    /// Occurs when a load case has a factor for a load that is not there.
    #[error(
        "no load is called {load:?}; a load case has factors for names of loads, and for \"permanent\", those without a name"
    )]
    UnknownLoad {
        /// Name of the case.
        case: String,
        /// The name.
        load: String,
    },
    /// Occurs when the factor of a load is not finite, or that of the permanent ones is negative.
    #[error(
        "the factor of {load:?} in the load case {case:?} must be finite, and of masses not negative, got {factor}"
    )]
    Factor {
        /// Name of the case.
        case: String,
        /// Name of the load.
        load: String,
        /// The factor as given.
        factor: f64,
    },
    /// Occurs when every number is finite and this total, or its square, is not: lengths, loads, their product,
    /// stiffnesses.
    #[error(
        "the {0} of this system is above {LARGEST_TOTAL:e}: its square is more than a double can hold"
    )]
    Overflow(&'static str),
    /// Occurs when a total is less than [`SMALLEST_TOTAL`], so that digits would be lost without
    /// notice.
    #[error(
        "the {quantity} of this system, {total:e} in SI units, is too small for double precision (least: {:e})",
        SMALLEST_TOTAL
    )]
    Underflow {
        /// Which total.
        quantity: &'static str,
        /// Its value in SI units.
        total: f64,
    },
    /// Occurs when the lightest mass is lost in the rounding of the heaviest.
    #[error(
        "the masses of this system reach from {} kg to {} kg: the lightest is lost in the \
         rounding of the heaviest", Readable(*lightest_kg), Readable(*heaviest_kg)
    )]
    MassRange {
        /// The lightest mass that is not zero.
        lightest_kg: f64,
        /// The heaviest mass.
        heaviest_kg: f64,
    },
}

fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
}

/// Solvers square lengths and forces.
pub(crate) const LARGEST_TOTAL: f64 = 1e150;

/// How far from 1 the length of a direction may be: the rounding of its three components.
pub(crate) const UNIT_TOLERANCE: f64 = 8.0 * f64::EPSILON;

/// Refuse what is no system.
pub(super) fn check(
    gravity_m_s2: f64,
    joints: &[Joint],
    members: &[Member],
) -> Result<(), SystemError> {
    if !(gravity_m_s2.is_finite() && gravity_m_s2 > 0.0) {
        return Err(SystemError::Gravity(gravity_m_s2));
    }
    if members.is_empty() {
        return Err(SystemError::NoMembers);
    }
    let hasher = RandomState::new();
    let hash = |joint: &Joint| hasher.hash_one(joint.name.text());
    let same = |a: usize, b: usize| joints[a].name == joints[b].name;
    let twice = first_again(joints.iter().map(hash).zip(0..), same);
    for (number, joint) in joints.iter().enumerate() {
        if twice.is_some_and(|[_, again]| again == number) {
            return Err(SystemError::DuplicateName { name: joint.name.to_string(), joint: number });
        }
        check_joint(number, joint)?;
    }
    super::drawing::check(joints)?;
    // A tackle has parallel strands, and their shares are equal.
    let straight = members.iter().zip(0..).filter(|(member, _)| member.rope.is_none());
    let ends = |member: &Member| [member.from.min(member.to), member.from.max(member.to)];
    let parallel = first_again(straight.map(|(member, k)| (ends(member), k)), |_, _| true);
    for (k, member) in members.iter().enumerate() {
        check_member(k + 1, member, joints)?;
        if let Some([first, _]) = parallel.filter(|[_, again]| *again == k) {
            return Err(SystemError::Parallel {
                member: k + 1,
                first: first + 1,
                from: joints[member.from].name.to_string(),
                to: joints[member.to].name.to_string(),
            });
        }
    }
    check_totals(gravity_m_s2, joints, members)
}

/// The first that is the same as one before it, and that one: of equal keys those that are the `same`.
fn first_again<K: Ord>(
    keys: impl Iterator<Item = (K, usize)>,
    same: impl Fn(usize, usize) -> bool,
) -> Option<[usize; 2]> {
    let mut keys: Vec<(K, usize)> = keys.collect();
    keys.sort_unstable();
    let again = |equal: &[(K, usize)]| {
        let pairs = (1..equal.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
        pairs.map(|pair| pair.map(|k| equal[k].1)).find(|[a, b]| same(*a, *b))
    };
    keys.chunk_by(|a, b| a.0 == b.0).filter_map(again).min_by_key(|[_, again]| *again)
}

fn check_joint(number: usize, joint: &Joint) -> Result<(), SystemError> {
    let name = || joint.name.to_string();
    let places = [joint.support.at_m(), joint.near_m];
    if let Some(coordinate_m) = places.into_iter().flatten().find_map(first_bad) {
        return Err(SystemError::Coordinate { name: name(), joint: number, coordinate_m });
    }
    if let Support::Line { direction: [x, y, z], .. } | Support::Plane { normal: [x, y, z], .. } =
        joint.support
    {
        let length = x.hypot(y).hypot(z);
        if length.is_nan() || (length - 1.0).abs() > UNIT_TOLERANCE {
            return Err(SystemError::Direction { name: name(), joint: number, length });
        }
    }
    if !(joint.mass_kg.is_finite() && joint.mass_kg >= 0.0) {
        return Err(SystemError::Mass { name: name(), joint: number, mass_kg: joint.mass_kg });
    }
    match first_bad(joint.force_n) {
        Some(component_n) => Err(SystemError::Force { name: name(), joint: number, component_n }),
        None => Ok(()),
    }
}

fn check_member(number: usize, member: &Member, joints: &[Joint]) -> Result<(), SystemError> {
    if let Some(joint) = member.path().find(|joint| *joint >= joints.len()) {
        let joints = joints.len();
        return Err(SystemError::NoSuchJoint { member: number, joint, joints });
    }
    super::rope::check(number, member, joints)?;
    if member.from == member.to && member.rope.is_none() {
        let joint = joints[member.from].name.to_string();
        return Err(SystemError::SelfLoop { member: number, joint });
    }
    if let Some(stiffness_n) = member.stiffness_n
        && !(stiffness_n.is_finite() && stiffness_n > 0.0)
    {
        return Err(SystemError::Stiffness { member: number, stiffness_n });
    }
    if let Some(what) = idle_strength(member) {
        return Err(SystemError::IdleStrength { member: number, what });
    }
    let length_m = member.body.length_m();
    if let Some(tolerance_m) = member.length_tolerance_m()
        && !(tolerance_m > 0.0 && tolerance_m < length_m)
    {
        return Err(SystemError::LengthTolerance { member: number, length_m, tolerance_m });
    }
    for load in &member.loads {
        let component_n = first_bad(load.force_n);
        if component_n.is_some() || !(0.0..=length_m).contains(&load.at_m) {
            let largest = load.force_n.into_iter().fold(0.0, |a: f64, x| a.max(x.abs()));
            let component_n = component_n.unwrap_or(largest);
            let at_m = load.at_m;
            return Err(SystemError::PointLoad { member: number, at_m, length_m, component_n });
        }
    }
    Ok(())
}

/// A strength against a force that the member cannot have.
fn idle_strength(member: &Member) -> Option<&'static str> {
    let strength = member.strength.as_deref()?;
    match member.kind {
        Kind::Cable if strength.compression_n().is_some() => {
            Some("a cable cannot push: it has no compression_n and no bending_n_m2")
        }
        Kind::Strut if strength.tension_n().is_some() => {
            Some("a strut cannot pull: it has no strength_n")
        }
        _ => None,
    }
}

/// Refuse a floor above what a support holds.
pub(super) fn check_floor(floor_m: f64, joints: &[Joint]) -> Result<(), SystemError> {
    if !floor_m.is_finite() {
        return Err(SystemError::Floor(floor_m));
    }
    for (number, joint) in joints.iter().enumerate() {
        // The height of what moves level alone.
        let height_m = match joint.support {
            Support::Fixed { at_m } => at_m[2],
            Support::Line { at_m, direction } if direction[2].abs() <= 0.0 => at_m[2],
            Support::Plane { at_m, normal } if normal[0].hypot(normal[1]) <= 0.0 => at_m[2],
            _ => continue,
        };
        if height_m < floor_m {
            let name = joint.name.to_string();
            return Err(SystemError::BelowFloor { name, joint: number, height_m, floor_m });
        }
    }
    Ok(())
}

fn check_totals(
    gravity_m_s2: f64,
    joints: &[Joint],
    members: &[Member],
) -> Result<(), SystemError> {
    let length_m = crate::sum(members.iter().map(|member| member.body.length_m()));
    let masses = joints.iter().map(|joint| joint.mass_kg);
    let masses = masses.chain(members.iter().map(|member| member.body.mass_kg()));
    let mass_kg = crate::sum(masses.clone());
    let forces = joints.iter().map(|joint| joint.force_n);
    let forces = forces.chain(members.iter().flat_map(|m| m.loads.iter().map(|l| l.force_n)));
    let force_n = crate::sum(forces.map(|[x, y, z]| x.hypot(y).hypot(z)));
    let load_n = mass_kg * gravity_m_s2 + force_n;
    let stiffness_n: f64 = members.iter().filter_map(|member| member.stiffness_n).sum();
    let reach_m = joints
        .iter()
        .filter_map(|joint| joint.support.at_m())
        .fold(0.0, |a: f64, at| at.into_iter().fold(a, |a, x| a.max(x.abs())));
    let loaded = load_n > 0.0;
    let totals = [
        ("extent of the supports", 2.0 * reach_m, true),
        ("total length", length_m, false),
        ("total load", load_n, !loaded),
        ("total load times total length", load_n * length_m, !loaded),
        ("total stiffness", stiffness_n, true),
    ];
    check_range(totals, masses)
}

/// Totals, and whether they may vanish, must be numbers with digits to spare, and masses, kg, none too
/// light beside another.
pub(crate) fn check_range<const N: usize>(
    totals: [(&'static str, f64, bool); N],
    masses: impl Iterator<Item = f64>,
) -> Result<(), SystemError> {
    for (quantity, total, may_vanish) in totals {
        if total.is_nan() || total > LARGEST_TOTAL {
            return Err(SystemError::Overflow(quantity));
        }
        if total < SMALLEST_TOTAL && !may_vanish {
            return Err(SystemError::Underflow { quantity, total });
        }
    }
    too_wide(masses).map_or(Ok(()), |(lightest_kg, heaviest_kg)| {
        Err(SystemError::MassRange { lightest_kg, heaviest_kg })
    })
}

fn first_bad(vector: Vector) -> Option<f64> {
    vector.into_iter().find(|x| !x.is_finite())
}
