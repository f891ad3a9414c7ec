//! Where a motion begins.

use std::str::FromStr;

use model::Vector;
use model::system::{Kind, Support, System};
use numerics::vector::{minus, norm};

use super::error::{ROUGH, SimulateError};
use crate::equilibria;
use crate::error::Error;
use crate::problem::Problem;

/// Supports nearer to one vertical than this, in total lengths, are on it.
const ON_ONE_VERTICAL: f64 = 1e-9;

/// Chains of at most so many bars have their equilibria numbered by a census.
pub(crate) const CENSUS_BARS: usize = census::Settings::SOUGHT_BARS;

/// Where a motion begins.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Start {
    /// In the stable equilibrium, at rest: a push sets it in motion.
    #[default]
    Rest,
    /// In an equilibrium, named as [`Modes`](crate::Modes) and the census number them: `2`, or
    /// `2'` for a mirror image.
    Equilibrium(String),
    /// Angles of the members from the descending vertical, degrees, each from its first joint to its
    /// second, in the vertical plane through the supports (where these are on one vertical in that of `plane`, or
    /// through Y); what they lack to close the loops is corrected if it is little.
    Angles(Vec<f64>),
    /// A position at random, the same for the same number.
    Seed(u64),
    /// Places of all joints, world frame, m; what they lack to meet the lengths is corrected if it is
    /// little.
    Joints(Vec<Vector>),
}

impl FromStr for Start {
    type Err = String;

    /// `rest`, `equilibrium:2`, `angles=19.7,38.6,-73.9`, `seed:7`.
    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| {
            let read: Result<f64, _> = text.trim().parse();
            read.ok().filter(|x| x.is_finite()).ok_or(format!("`{text}` is not a number"))
        };
        if text == "rest" {
            Ok(Self::Rest)
        } else if let Some(label) = text.strip_prefix("equilibrium:") {
            Ok(Self::Equilibrium(label.to_owned()))
        } else if let Some(angles) = text.strip_prefix("angles=") {
            angles.split(',').map(number).collect::<Result<_, _>>().map(Self::Angles)
        } else if let Some(seed) = text.strip_prefix("seed:") {
            seed.parse().map(Self::Seed).map_err(|error| format!("`{seed}`: {error}"))
        } else {
            Err("rest, equilibrium:2, angles=19.7,38.6,-73.9 or seed:7".to_owned())
        }
    }
}

impl Start {
    /// Places of the joints at the beginning.
    pub(super) fn position(
        &self,
        problem: &Problem,
        system: &System,
    ) -> Result<Vec<Vector>, Error> {
        match self {
            Self::Rest => named(equilibria::hanging(problem)?, "1"),
            Self::Equilibrium(label) => named(equilibria::all(problem, CENSUS_BARS)?, label),
            Self::Angles(angles) => pulled_shut(system, &at_angles(system, angles)?),
            Self::Seed(seed) => Ok(motion::random_position(system, *seed)?),
            Self::Joints(joints_m) => pulled_shut(system, joints_m),
        }
    }
}

fn named(found: equilibria::Equilibria, label: &str) -> Result<Vec<Vector>, Error> {
    let labels: Vec<String> = found.list.iter().map(|one| one.label.clone()).collect();
    let wanted = found.list.into_iter().find(|one| one.label == label);
    let at = wanted.map(|one| one.found.joints_m);
    at.ok_or_else(|| SimulateError::NoSuchEquilibrium { label: label.to_owned(), labels }.into())
}

/// The position next to places that do not quite meet the lengths.
fn pulled_shut(system: &System, given_m: &[Vector]) -> Result<Vec<Vector>, Error> {
    let at = motion::assemble(system, given_m)?;
    let moved = at.iter().zip(given_m).zip(system.joints());
    // Places of supports are those of the file, whatever is given.
    let moved = moved.filter(|(_, joint)| !joint.support.is_fixed());
    let moved = moved.map(|((a, b), joint)| (norm(minus(*a, *b)) / system.total_length_m(), joint));
    match moved.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((off, joint)) if off.is_nan() || off > ROUGH => {
            Err(SimulateError::Apart { joint: joint.name.to_string(), off }.into())
        }
        _ => Ok(at),
    }
}

/// Places of the joints with the members at these angles from the descending vertical, one member
/// after the other from what is placed already.
fn at_angles(system: &System, angles_deg: &[f64]) -> Result<Vec<Vector>, SimulateError> {
    let (members, joints) = (system.members(), system.joints());
    if angles_deg.len() != members.len() {
        return Err(SimulateError::AngleCount { given: angles_deg.len(), bars: members.len() });
    }
    let [east, north] = level(system);
    let along: Vec<Vector> = members
        .iter()
        .zip(angles_deg)
        .map(|(member, angle_deg)| {
            let (sin, cos) = angle_deg.to_radians().sin_cos();
            [east * sin, north * sin, -cos].map(|x| member.body.length_m() * x)
        })
        .collect();
    let held = |joint: &model::system::Joint| joint.support.at_m();
    let fixed = joints.iter().map(|joint| held(joint).filter(|_| joint.support.is_fixed()));
    let mut at: Vec<Option<Vector>> = fixed.collect();
    let plus = |a: Vector, sign: f64, d: Vector| [0, 1, 2].map(|k| a[k] + sign * d[k]);
    loop {
        let before = at.iter().flatten().count();
        // A rope bends where it likes.
        for (member, along) in members.iter().zip(&along).filter(|(m, _)| m.rope.is_none()) {
            match [member.from, member.to].map(|joint| at[joint]) {
                [Some(here), None] => at[member.to] = Some(plus(here, 1.0, *along)),
                [None, Some(here)] => at[member.from] = Some(plus(here, -1.0, *along)),
                _ => {}
            }
        }
        if at.iter().flatten().count() == before {
            // What hangs on nothing that is fixed begins at a point of its support.
            let Some(open) = at.iter().position(Option::is_none) else { break };
            let slides = (0..joints.len()).find(|&k| at[k].is_none() && held(&joints[k]).is_some());
            let first = slides.unwrap_or(open);
            at[first] = Some(held(&joints[first]).unwrap_or_else(|| system.reference_m()));
        }
    }
    let at: Vec<Vector> = at.into_iter().flatten().collect();
    for (k, (member, along)) in members.iter().zip(&along).enumerate() {
        let ends = plus(at[member.from], 1.0, *along);
        let off = norm(minus(ends, at[member.to])) / system.total_length_m();
        let is_rigid = member.kind == Kind::Bar && member.stiffness_n.is_none();
        if is_rigid && off > ROUGH {
            let joint = joints[member.to].name.to_string();
            return Err(SimulateError::Angles { bar: k + 1, joint, off });
        }
    }
    Ok(at)
}

/// The level direction of the plane through the supports; where they are on one vertical that of the upright plane in
/// which a joint slides, or else the paper's `Y`.
fn level(system: &System) -> [f64; 2] {
    let fixed = system.joints().iter().filter(|joint| joint.support.is_fixed());
    let mut held = fixed.filter_map(|joint| joint.support.at_m());
    let Some(first) = held.next() else { return [0.0, 1.0] };
    let across = held.map(|at| [at[0] - first[0], at[1] - first[1]]);
    let width = |d: &[f64; 2]| d[0].hypot(d[1]);
    match across.max_by(|a, b| width(a).total_cmp(&width(b))) {
        Some(d) if width(&d) > ON_ONE_VERTICAL * system.total_length_m() => {
            d.map(|x| x / width(&d))
        }
        _ => {
            let planes = system.joints().iter().find_map(|joint| match joint.support {
                Support::Plane { normal: [x, y, _], .. } if x.hypot(y) > 0.0 => Some([x, y]),
                _ => None,
            });
            planes.map_or([0.0, 1.0], |[x, y]| {
                // The one towards x, or else y.
                let back = y < 0.0 || (y.abs() <= 0.0 && x > 0.0);
                let size = if back { -x.hypot(y) } else { x.hypot(y) };
                [y / size, -x / size]
            })
        }
    }
}
