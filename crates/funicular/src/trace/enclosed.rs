//! What interval arithmetic proves of load paths: their limit and branch points, and the path from its
//! start to the first of them.

use branches::Variation;
use census::boxes::{PathProof, SingularKind, prove_path, prove_singular};
use model::NoBox;
use model::system::{Joint, Member, System};
use serde::Serialize;

use super::equations::Kept;
use super::load::{Kind, LoadEvent};

/// What is proved of a load path from its start on. The path is the one through the shape at the start, as
/// far as its parameter grows (or falls) all along; of other equilibria nothing is said but that they do not
/// meet it.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct PathProved {
    /// Up to this value of the last parameter the path is regular: no other equilibrium meets it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// What ends it: a limit point, or a branch point of a mode that breaks a symmetry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first: Option<Kind>,
    /// Values of the last parameter between which that point lies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub between: Option<[f64; 2]>,
    /// Boxes that cover the path.
    pub boxes: usize,
    /// Why it is not proved further, before the end of the range and before any such point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub because: Option<String>,
}

/// How far, as a part of it, a value followed may be from bounds that are proved.
const NEAR: f64 = 1e-9;

impl PathProved {
    /// Whether an event is the point that the proof of the path comes to.
    pub(super) fn is_of(&self, event: &LoadEvent) -> bool {
        let (Some([low, high]), Some(value)) = (self.between, event.values.last()) else {
            return false;
        };
        let off = NEAR * low.abs().max(high.abs());
        let inside = low.min(high) - off <= *value && *value <= low.max(high) + off;
        inside && self.first == Some(event.kind)
    }

    fn nothing(because: impl Into<String>) -> Self {
        Self { because: Some(because.into()), ..Self::default() }
    }
}

/// The path from its start.
pub(super) fn proved(
    variation: &Variation,
    [from, to]: [&[f64]; 2],
    start: Option<&Kept>,
) -> PathProved {
    let system = |values: &[f64]| variation.unloaded(values).ok();
    let (Some(first), Some(last), Some(start)) = (system(from), system(to), start) else {
        return PathProved::nothing("the numbers describe no system at its ends");
    };
    if start.values != from {
        return PathProved::nothing("it begins in a branch point");
    }
    if first.floor_m().is_some() {
        return PathProved::nothing("the system has a floor");
    }
    if !loads_alone(&first, &last) {
        return PathProved::nothing("more than loads vary");
    }
    let values = [from, to].map(|values| values.last().copied().unwrap_or(f64::NAN));
    let answer = &start.equilibrium;
    match prove_path([&first, &last], values, &answer.joints_m, &answer.axial_n) {
        Err(because) => PathProved::nothing(because.to_string()),
        Ok(PathProof { to, first, tubes, stopped }) => PathProved {
            to: Some(to),
            first: first.map(|(kind, _)| match kind {
                SingularKind::Limit => Kind::Limit,
                SingularKind::Branch => Kind::Branch,
            }),
            between: first.map(|(_, value)| [value.lo(), value.hi()]),
            boxes: tubes,
            because: stopped.map(|because: NoBox| because.to_string()),
        },
    }
}

/// Values of the last parameter between which exactly one limit or branch point is proved to lie; nothing
/// where more than loads vary, over a floor, or where there is no proof.
pub(super) fn enclosed(
    variation: &Variation,
    [from, to]: [&[f64]; 2],
    at: &Kept,
    kind: Kind,
) -> Option<[f64; 2]> {
    let kind = match kind {
        Kind::Limit => SingularKind::Limit,
        Kind::Branch => SingularKind::Branch,
        Kind::Kink => return None,
    };
    let system = |values: &[f64]| variation.unloaded(values).ok();
    let (first, last, here) = (system(from)?, system(to)?, system(&at.values)?);
    if here.floor_m().is_some() || !loads_alone(&first, &last) {
        return None;
    }
    let values = [from.last()?, to.last()?, at.values.last()?].map(|value| *value);
    let answer = &at.equilibrium;
    let ends = [&first, &last];
    let found =
        prove_singular(kind, ends, &here, values, &answer.joints_m, &answer.axial_n).ok()?;
    Some([found.lo(), found.hi()])
}

/// Whether two systems differ in forces and masses alone.
pub(super) fn loads_alone(a: &System, b: &System) -> bool {
    let joint = |(a, b): (&Joint, &Joint)| a.support == b.support;
    let body =
        |member: &Member| (member.body.length_m().to_bits(), member.body.centre_m().to_bits());
    let places = |member: &Member| -> Vec<u64> {
        member.loads.iter().map(|load| load.at_m.to_bits()).collect()
    };
    let member = |(a, b): (&Member, &Member)| {
        body(a) == body(b) && a.stiffness_n == b.stiffness_n && places(a) == places(b)
    };
    // A product of gravity and masses is not on a straight line.
    a.gravity_m_s2().to_bits() == b.gravity_m_s2().to_bits()
        && a.floor_m().map(f64::to_bits) == b.floor_m().map(f64::to_bits)
        && a.joints().iter().zip(b.joints()).all(joint)
        && a.members().iter().zip(b.members()).all(member)
}
