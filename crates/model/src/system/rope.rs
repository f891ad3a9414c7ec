//! Ropes: members that run over rings and pulleys.

use serde::Serialize;

use super::error::SystemError;
use super::{Joint, Kind, Member, System};

/// What makes a member a rope: the joints that it runs over without friction.
///
/// A joint that is free is a ring on the rope, one that is held a pulley. The length of a rope is the
/// sum of its spans, and its tension is the same in all of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rope {
    /// The joints between its ends, in their order; one joint may stand here more than once.
    pub via: Vec<usize>,
}

/// A ring has run to the end of a span of its rope: the span has no direction for its force.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error(
    "the rope (member {member}) jams: {from} and {to} run together, and the span between them has no \
     direction for its force"
)]
pub struct RunTogether {
    /// Number of the rope among the members, from 1.
    pub member: usize,
    /// Name of one joint.
    pub from: String,
    /// Name of the other.
    pub to: String,
}

/// Why a rope cannot be modelled here.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RopeFault {
    /// Occurs when a member that pushes is to run over a joint.
    #[error("only a cable runs over rings or pulleys: a bar or a strut cannot bend around a joint")]
    Kind,
    /// Occurs when a rope has a mass.
    #[error("a rope over rings or pulleys has no mass here: its weight would slide with the rope")]
    Mass,
    /// Occurs when a rope has a centre of weight or moments of inertia: `centre_m` or `inertia_kg_m2`.
    #[error("a rope over rings or pulleys has no mass here, and so no {0}")]
    Body(&'static str),
    /// Occurs when a force acts on a rope between its joints.
    #[error("no force acts on a rope over rings or pulleys: it would slide with the rope")]
    Load,
    /// Occurs when a prestress is given for a rope.
    #[error(
        "a rope over rings or pulleys has no prestress here: its unstretched length says what it bears"
    )]
    Prestress,
    /// Occurs when a rope runs from the joint of this name to the same joint.
    #[error("a rope runs from joint {0:?} to itself: a span has two joints")]
    Repeated(String),
}

impl RopeFault {
    /// The key of a system file that is wrong.
    pub(crate) fn key(&self) -> &'static str {
        match self {
            Self::Kind => "kind",
            Self::Mass => "mass_kg",
            Self::Body(key) => key,
            Self::Load => "forces",
            Self::Prestress => "prestress_n",
            Self::Repeated(_) => "via",
        }
    }
}

impl Member {
    /// The same member as a rope over these joints; without joints it is as it was.
    ///
    /// ```
    /// use model::{Bar, system::Member};
    /// // From an anchor over a ring, a pulley and the same ring again: a tackle.
    /// let rope = Member::cable(0, 2, Bar::homogeneous(9.0, 0.0)?).over(vec![2, 1]);
    /// assert_eq!(rope.path().collect::<Vec<_>>(), [0, 2, 1, 2]);
    /// assert_eq!(rope.spans().collect::<Vec<_>>(), [[0, 2], [2, 1], [1, 2]]);
    /// # Ok::<(), model::BarError>(())
    /// ```
    #[must_use]
    pub fn over(mut self, via: Vec<usize>) -> Self {
        if self.via() != via {
            self.rope = (!via.is_empty()).then(|| Box::new(Rope { via }));
        }
        self
    }

    /// The same member straight from its first joint to its last.
    #[must_use]
    pub fn straight(self) -> Self {
        self.over(vec![])
    }

    /// The joints between its ends that it runs over; none of a member that is straight.
    pub fn via(&self) -> &[usize] {
        self.rope.as_ref().map_or(&[], |rope| &rope.via)
    }

    /// Every joint that it meets, from its first to its last.
    pub fn path(&self) -> impl Iterator<Item = usize> + Clone {
        std::iter::once(self.from).chain(self.via().iter().copied()).chain([self.to])
    }

    /// The two joints of each of its spans: one of a member that is straight.
    pub fn spans(&self) -> impl Iterator<Item = [usize; 2]> + Clone {
        self.path().zip(self.path().skip(1)).map(|(a, b)| [a, b])
    }

    /// The same member where its joints have other numbers.
    #[must_use]
    pub fn renumbered(self, number: impl Fn(usize) -> usize) -> Self {
        let via = self.via().iter().map(|joint| number(*joint)).collect();
        let (from, to) = (number(self.from), number(self.to));
        self.between(from, to).over(via)
    }

    /// What of a rope is not modelled.
    pub(crate) fn rope_fault(&self, joints: &[Joint]) -> Option<RopeFault> {
        self.rope.as_ref()?;
        let repeated = self.spans().find(|[a, b]| a == b);
        if let Some(joint) = repeated.map(|[joint, _]| joints[joint].name.to_string()) {
            return Some(RopeFault::Repeated(joint));
        }
        let faults = [
            (self.kind != Kind::Cable, RopeFault::Kind),
            (self.body.mass_kg() > 0.0, RopeFault::Mass),
            (self.body.given_centre_m().is_some(), RopeFault::Body("centre_m")),
            (self.body.given_inertia_kg_m2().is_some(), RopeFault::Body("inertia_kg_m2")),
            (!self.loads.is_empty(), RopeFault::Load),
            (self.prestress.is_some(), RopeFault::Prestress),
        ];
        faults.into_iter().find_map(|(is, fault)| is.then_some(fault))
    }
}

impl System {
    /// The first member that runs over rings or pulleys, from 0.
    pub fn first_rope(&self) -> Option<usize> {
        self.members().iter().position(|member| member.rope.is_some())
    }

    /// Whether a member runs over rings or pulleys.
    pub fn has_ropes(&self) -> bool {
        self.first_rope().is_some()
    }
}

/// Refuse what is not a valid rope.
pub(super) fn check(number: usize, member: &Member, joints: &[Joint]) -> Result<(), SystemError> {
    match member.rope_fault(joints) {
        Some(fault) => Err(SystemError::Rope { member: number, fault }),
        None => Ok(()),
    }
}
