//! An answer from elsewhere, by the names of joints.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap, VecDeque};

use model::system::{Joint, Member, System};
use model::{SolverName, Vector};

/// Joint positions that somebody says are an equilibrium of a system, with forces if they were
/// given.
#[derive(Debug, Clone, PartialEq)]
pub struct ForeignAnswer {
    /// Whose answer it is.
    pub source: SolverName,
    /// Place of each joint of the system, in its order, m.
    pub joints_m: Vec<Vector>,
    /// Axial force of each member, tension positive, N: of a member with loads along it the force
    /// with the loads lumped to its joints by the lever rule.
    pub axial_n: Option<Vec<f64>>,
    /// Of ropes whose spans were given forces of their own these, by the number of the member from 0, N;
    /// the axial force is their mean.
    pub spans_n: BTreeMap<usize, Vec<f64>>,
    /// Force of the ground on each joint, N; zero at joints without support.
    pub reactions_n: Option<Vec<Vector>>,
}

/// Why an answer does not fit the system.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GivenError {
    /// Occurs when a joint of the answer is not in the system.
    #[error("the system has no joint {name:?}")]
    UnknownJoint {
        /// Its name.
        name: String,
        /// The joint whose name is nearest, if one is near.
        suggestion: Option<String>,
    },
    /// Occurs when the answer has the joint of this name twice.
    #[error("joint {0:?} is given twice")]
    Repeated(String),
    /// Occurs when joints of the system are not in the answer.
    #[error("the answer has no place for {}", listed("joint", names, *count))]
    MissingJoints {
        /// The first of them.
        names: Vec<String>,
        /// How many.
        count: usize,
    },
    /// Occurs when a number of this joint or member of the answer is infinite or not a number.
    #[error("a number of {0} is not finite")]
    NotFinite(String),
    /// Occurs when no member connects two joints for which a force is given.
    #[error("no member connects {from:?} with {to:?}")]
    UnknownMember {
        /// A joint.
        from: String,
        /// The other joint.
        to: String,
    },
    /// Occurs when the force of a member is given twice.
    #[error("the force between {from:?} and {to:?} is given twice")]
    RepeatedMember {
        /// A joint.
        from: String,
        /// The other joint.
        to: String,
    },
    /// Occurs when forces are given, but not for every member.
    #[error("forces are given, but not {}", listed("that of member", names, *count))]
    MissingForces {
        /// The first members without.
        names: Vec<String>,
        /// How many.
        count: usize,
    },
    /// Occurs when a list has not as many entries as the system has joints or members.
    #[error("the answer has {found} {of}, and the system {wanted}")]
    Count {
        /// Joints or members.
        of: &'static str,
        /// How many there are in the system.
        wanted: usize,
        /// How many are given.
        found: usize,
    },
}

/// How many names an error lists.
const LISTED: usize = 5;

fn listed(what: &str, names: &[String], count: usize) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
    let more = match count - names.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("{what} {}{more}", quoted.join(", "))
}

impl ForeignAnswer {
    /// An answer of positions by the names of joints, in any order, one for every joint that can
    /// move; an anchor that is not named is where the system has it.
    ///
    /// # Errors
    /// [`GivenError`]: names that the system has not, or that are missing or repeated; numbers that
    /// are not finite.
    ///
    /// ```
    /// use validate::foreign::{ForeignAnswer, GivenError};
    /// let system = model::system::System::from(model::cases::paper().chain());
    /// let places = [("0", 0.0), ("1", -1.0)];
    /// let places = places.map(|(name, z)| (name.to_owned(), [0.0, 0.0, z]));
    /// let error = ForeignAnswer::by_name(&system, "a table", places).unwrap_err();
    /// assert_eq!(error.to_string(), "the answer has no place for joint \"2\"");
    /// ```
    pub fn by_name(
        system: &System,
        source: impl Into<String>,
        places: impl IntoIterator<Item = (String, Vector)>,
    ) -> Result<Self, GivenError> {
        let anchored = |joint: &Joint| joint.support.at_m().filter(|_| joint.support.is_fixed());
        let joints_m = vectors(system, places)?.into_iter().zip(system.joints());
        let joints_m: Vec<_> = joints_m.map(|(at, joint)| at.or_else(|| anchored(joint))).collect();
        let missing = joints_m.iter().zip(system.joints()).filter(|(place, _)| place.is_none());
        let missing: Vec<_> = missing.map(|(_, joint)| joint.name.to_string()).collect();
        if !missing.is_empty() {
            let (count, names) = shortened(missing);
            return Err(GivenError::MissingJoints { names, count });
        }
        Ok(Self {
            source: SolverName::new(source.into()),
            joints_m: joints_m.into_iter().flatten().collect(),
            axial_n: None,
            spans_n: BTreeMap::new(),
            reactions_n: None,
        })
    }

    /// An answer whose lists are in the order of the system's joints and members; of forces there is one
    /// for each member, or one for each span of each member.
    ///
    /// # Errors
    /// [`GivenError::Count`] when they are not as long, [`GivenError::NotFinite`].
    pub fn in_order(
        system: &System,
        source: impl Into<String>,
        joints_m: Vec<Vector>,
        axial_n: Option<Vec<f64>>,
    ) -> Result<Self, GivenError> {
        let count = |of, wanted, found| GivenError::Count { of, wanted, found };
        if joints_m.len() != system.joints().len() {
            return Err(count("joints", system.joints().len(), joints_m.len()));
        }
        let members = system.members().len();
        let spans: usize = system.members().iter().map(|member| member.spans().count()).sum();
        let forces = axial_n.as_ref().map_or(members, Vec::len);
        if forces != members && forces != spans {
            return Err(count("member forces", members, forces));
        }
        if let Some(k) = joints_m.iter().position(|place| place.iter().any(|x| !x.is_finite())) {
            let what = format!("joint {:?}", system.joints()[k].name);
            return Err(GivenError::NotFinite(what));
        }
        let source = SolverName::new(source.into());
        let (spans_n, reactions_n) = (BTreeMap::new(), None);
        let answer = Self { source, joints_m, axial_n: None, spans_n, reactions_n };
        match axial_n {
            Some(axial_n) => answer.bearing(system, axial_n),
            None => Ok(answer),
        }
    }

    /// The same with axial forces in the order of the system: one for each member, or one for each span.
    fn bearing(mut self, system: &System, axial_n: Vec<f64>) -> Result<Self, GivenError> {
        let members = system.members();
        let whole = axial_n.len() == members.len();
        let mut left = axial_n.into_iter();
        let of_member = |member: &Member| -> Vec<f64> {
            let one = if whole { left.next() } else { None };
            member.spans().map_while(|_| one.or_else(|| left.next())).collect()
        };
        let forces: Vec<Vec<f64>> = members.iter().map(of_member).collect();
        if let Some(k) = forces.iter().position(|spans| spans.iter().any(|n| !n.is_finite())) {
            return Err(GivenError::NotFinite(member_name(system, k)));
        }
        let mean = |spans: &Vec<f64>| {
            let more = model::sum(spans.iter().map(|force| force - spans[0]));
            spans[0] + more / spans.len() as f64
        };
        self.axial_n = Some(forces.iter().map(mean).collect());
        self.spans_n =
            forces.into_iter().enumerate().filter(|(_, spans)| spans.len() > 1).collect();
        Ok(self)
    }

    /// The same with axial forces by the names of two joints in any order: one for each member, by its
    /// ends, or, where there are more forces than members, one for each span of each member. Forces
    /// between the same two joints are in the order of the system.
    ///
    /// # Errors
    /// [`GivenError`]: members that the system has not, or that are missing or repeated; numbers
    /// that are not finite.
    pub fn with_forces(
        self,
        system: &System,
        forces: impl IntoIterator<Item = (String, String, f64)>,
    ) -> Result<Self, GivenError> {
        let forces: Vec<_> = forces.into_iter().collect();
        let joints = joint_numbers(system);
        let number = |name: &str| joints.get(name).copied().ok_or_else(|| unknown(system, name));
        let pieces = pieces(system, forces.len() > system.members().len());
        let mut open = BTreeMap::<_, VecDeque<usize>>::new();
        for (piece, (_, ends)) in pieces.iter().enumerate() {
            open.entry(pair(*ends)).or_default().push_back(piece);
        }
        let mut found = vec![None; pieces.len()];
        for (from, to, force) in forces {
            let Some(open) = open.get_mut(&pair([number(&from)?, number(&to)?])) else {
                return Err(GivenError::UnknownMember { from, to });
            };
            let Some(piece) = open.pop_front() else {
                return Err(GivenError::RepeatedMember { from, to });
            };
            found[piece] = Some(force);
        }
        let missing = pieces.iter().zip(&found).filter(|(_, force)| force.is_none());
        let mut missing: Vec<_> = missing.map(|((k, _), _)| *k).collect();
        missing.dedup();
        if !missing.is_empty() {
            let (count, names) =
                shortened(missing.into_iter().map(|k| member_name(system, k)).collect());
            return Err(GivenError::MissingForces { names, count });
        }
        self.bearing(system, found.into_iter().flatten().collect())
    }

    /// The same with forces of the ground by the names of joints; those not named are zero.
    ///
    /// # Errors
    /// [`GivenError`]: names that the system has not, or that are repeated; numbers that are not
    /// finite.
    pub fn with_reactions(
        mut self,
        system: &System,
        reactions: impl IntoIterator<Item = (String, Vector)>,
    ) -> Result<Self, GivenError> {
        let found = vectors(system, reactions)?;
        self.reactions_n = Some(found.into_iter().map(Option::unwrap_or_default).collect());
        Ok(self)
    }
}

/// Two joints in an order that does not depend on the direction.
fn pair([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// What bears a force each, in the order of the system: every member by its ends, or every span; with the number of
/// the member.
fn pieces(system: &System, by_span: bool) -> Vec<(usize, [usize; 2])> {
    let of_member = |(k, member): (usize, &Member)| {
        let ends = (!by_span).then_some([member.from, member.to]);
        let spans = member.spans().filter(|_| by_span);
        ends.into_iter().chain(spans).map(|joints| (k, joints)).collect::<Vec<_>>()
    };
    system.members().iter().enumerate().flat_map(of_member).collect()
}

fn joint_numbers(system: &System) -> HashMap<Cow<'_, str>, usize> {
    system.joints().iter().enumerate().map(|(k, joint)| (joint.name.text(), k)).collect()
}

/// Vectors by the names of joints, in the order of the system.
fn vectors(
    system: &System,
    named: impl IntoIterator<Item = (String, Vector)>,
) -> Result<Vec<Option<Vector>>, GivenError> {
    let numbers = joint_numbers(system);
    let mut found = vec![None; system.joints().len()];
    for (name, vector) in named {
        let Some(k) = numbers.get(name.as_str()).copied() else {
            return Err(unknown(system, &name));
        };
        if vector.iter().any(|x| !x.is_finite()) {
            return Err(GivenError::NotFinite(format!("joint {name:?}")));
        }
        if found[k].replace(vector).is_some() {
            return Err(GivenError::Repeated(name));
        }
    }
    Ok(found)
}

fn unknown(system: &System, name: &str) -> GivenError {
    let names: Vec<_> = system.joints().iter().map(|joint| joint.name.text()).collect();
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    let suggestion = model::system_file::nearest(name, &names).map(str::to_owned);
    GivenError::UnknownJoint { name: name.to_owned(), suggestion }
}

/// A member by its number and its joints.
pub(super) fn member_name(system: &System, k: usize) -> String {
    let member = &system.members()[k];
    let name = |joint: usize| &system.joints()[joint].name;
    format!("{} ({} - {})", k + 1, name(member.from), name(member.to))
}

fn shortened(mut names: Vec<String>) -> (usize, Vec<String>) {
    let count = names.len();
    names.truncate(LISTED);
    (count, names)
}

#[cfg(test)]
mod tests;
