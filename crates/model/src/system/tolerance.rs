//! Numbers that are known within limits, and the systems within them.

use super::{Joint, Member, Support, System, SystemError};
use crate::Bar;

/// How far the numbers of a member may be off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MemberTolerances {
    length_m: Option<f64>,
    stiffness: f64,
    mass_kg: f64,
}

/// How far the numbers of a joint may be off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointTolerances {
    mass_kg: f64,
    at_m: f64,
    force_n: f64,
}

/// A tolerance is out of range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{what} must be {wanted}, found {found}")]
pub struct RangeError {
    /// The key of the system file.
    pub what: &'static str,
    /// What it may be.
    pub wanted: &'static str,
    /// What it is.
    pub found: f64,
}

impl MemberTolerances {
    /// The part by which the stiffness `EA` may be off.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// How far the mass may be off, kg.
    pub fn mass_kg(&self) -> f64 {
        self.mass_kg
    }
}

impl JointTolerances {
    /// How far the point mass may be off, kg.
    pub fn mass_kg(&self) -> f64 {
        self.mass_kg
    }

    /// How far each coordinate of the place of the support may be off, m.
    pub fn at_m(&self) -> f64 {
        self.at_m
    }

    /// How far each component of the force may be off, N.
    pub fn force_n(&self) -> f64 {
        self.force_n
    }
}

/// A positive number that is at most so large; 0 where none is given.
pub(super) fn checked(
    what: &'static str,
    wanted: &'static str,
    given: Option<f64>,
    most: f64,
) -> Result<f64, RangeError> {
    match given {
        None => Ok(0.0),
        Some(found) if found.is_finite() && found > 0.0 && found <= most => Ok(found),
        Some(found) => Err(RangeError { what, wanted, found }),
    }
}

impl Member {
    /// How far the length may be off, m, where it is said: of a rigid member see [`within_m`](Self::within_m).
    pub fn length_tolerance_m(&self) -> Option<f64> {
        self.tolerances.as_ref()?.length_m
    }

    /// Say how far the length may be off, m, or that nothing is known of it.
    pub fn set_length_tolerance(&mut self, length_m: Option<f64>) {
        let others = self.tolerances.as_deref().copied().unwrap_or_default();
        self.set_tolerances(MemberTolerances { length_m, ..others });
    }

    fn set_tolerances(&mut self, all: MemberTolerances) {
        let all = (all != MemberTolerances::default()).then(|| Box::new(all));
        if self.tolerances != all {
            self.tolerances = all;
        }
    }

    /// The same member with a stiffness known to within a part of it, and a mass to within `mass_kg`, kg, as
    /// far as they are given.
    ///
    /// ```
    /// use model::{Bar, system::Member};
    /// let cable = Member::cable(0, 1, Bar::homogeneous(5.0, 2.0)?).with_stiffness(1e6);
    /// let within = cable.clone().with_tolerances(Some(0.05), Some(0.1))?;
    /// assert_eq!(within.tolerances.as_ref().map(|t| (t.stiffness(), t.mass_kg())), Some((0.05, 0.1)));
    /// assert!(cable.with_tolerances(None, Some(3.0)).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RangeError`] for a number that is not positive, and where a stiffness or mass could vanish.
    pub fn with_tolerances(
        mut self,
        stiffness: Option<f64>,
        mass_kg: Option<f64>,
    ) -> Result<Self, RangeError> {
        let part = if self.stiffness_n.is_some() { 1.0_f64.next_down() } else { 0.0 };
        let wanted = "positive and less than 1, of a bar with a stiffness";
        let stiffness = checked("stiffness_tolerance", wanted, stiffness, part)?;
        let mass_kg = checked("mass_tolerance_kg", OF_MASS, mass_kg, self.body.mass_kg())?;
        let length_m = self.length_tolerance_m();
        self.set_tolerances(MemberTolerances { length_m, stiffness, mass_kg });
        Ok(self)
    }

    /// The mass is so many times as large, and so is what it may be off.
    pub(super) fn scale_tolerances(&mut self, factor: f64) {
        if self.tolerances.is_some()
            && let Some(tolerances) = &mut self.tolerances
        {
            tolerances.mass_kg *= factor;
        }
    }
}

const OF_MASS: &str = "positive and not more than the mass";
const OF_FORCE: &str = "positive, of a joint that moves";

impl Joint {
    /// Its loads are up to so many times as large, and so is what they may be off.
    pub(super) fn scale_tolerances(&mut self, factor: f64) {
        if self.tolerances.is_some()
            && let Some(tolerances) = &mut self.tolerances
        {
            tolerances.mass_kg *= factor;
            tolerances.force_n *= factor;
        }
    }

    /// The same joint with a point mass known to within `mass_kg`, kg, the place of its support to within
    /// `at_m`, m, along each axis, and the components of its force to within `force_n`, N, as far as they
    /// are given.
    ///
    /// ```
    /// use model::system::Joint;
    /// let anchor = Joint::anchor("A", [0.0; 3]).with_tolerances(None, Some(1e-3), None)?;
    /// assert_eq!(anchor.tolerances.as_ref().map(|t| t.at_m()), Some(1e-3));
    /// assert!(Joint::free("P").with_tolerances(None, Some(1e-3), None).is_err());
    /// # Ok::<(), model::system::RangeError>(())
    /// ```
    ///
    /// # Errors
    /// [`RangeError`] for a number that is not positive and finite, where a mass could become negative,
    /// and for the place of a joint that no support holds, or the force on one that none moves.
    pub fn with_tolerances(
        mut self,
        mass_kg: Option<f64>,
        at_m: Option<f64>,
        force_n: Option<f64>,
    ) -> Result<Self, RangeError> {
        let most = |allowed: bool| if allowed { f64::MAX } else { 0.0 };
        let held = most(self.support != Support::Free);
        let moves = most(!self.support.is_fixed());
        let tolerances = JointTolerances {
            mass_kg: checked("mass_tolerance_kg", OF_MASS, mass_kg, self.mass_kg)?,
            at_m: checked("at_tolerance_m", "positive, of a joint with at_m", at_m, held)?,
            force_n: checked("force_tolerance_n", OF_FORCE, force_n, moves)?,
        };
        let given = (tolerances != JointTolerances::default()).then(|| Box::new(tolerances));
        if self.tolerances != given {
            self.tolerances = given;
        }
        Ok(self)
    }
}

/// A number of a system that is known within limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncertain {
    /// Which.
    pub number: UncertainNumber,
    /// As given.
    pub given: f64,
    /// How far it may be off.
    pub within: f64,
}

/// Which number of a system; members, joints and axes from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UncertainNumber {
    /// The (unstretched) length of a member, m.
    Length(usize),
    /// The stiffness `EA` of a member, N.
    Stiffness(usize),
    /// The mass of a member, kg.
    Mass(usize),
    /// The point mass at a joint, kg.
    JointMass(usize),
    /// A coordinate of the place where a support holds a joint, m.
    At(usize, usize),
    /// A component of the force at a joint, N.
    Force(usize, usize),
}

impl System {
    /// All numbers that are known within limits.
    pub fn uncertain(&self) -> Vec<Uncertain> {
        let members = self.members().iter().enumerate();
        let joints = self.joints().iter().enumerate();
        let all = members.flat_map(of_member).chain(joints.flat_map(of_joint));
        all.filter(|uncertain| uncertain.within > 0.0).collect()
    }

    /// The same system with other values of its uncertain numbers, in their order. A member of another
    /// length carries its loads at the same parts of it.
    ///
    /// ```
    /// use model::{Bar, system::{Joint, Member, System}};
    /// let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(1.0)];
    /// let bar = Member::bar(0, 1, Bar::homogeneous(2.0, 1.0)?).with_length_tolerance(0.1);
    /// let system = System::new("pendulum", 9.81, joints, vec![bar])?;
    /// let longer = system.with_uncertain(&[2.1])?;
    /// assert_eq!(longer.members()[0].body, Bar::homogeneous(2.1, 1.0)?);
    /// assert!(longer.uncertain().is_empty());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SystemError`] for numbers that no system has.
    pub fn with_uncertain(&self, values: &[f64]) -> Result<Self, SystemError> {
        let (mut joints, mut members) = (self.joints().to_vec(), self.members().to_vec());
        for (uncertain, value) in self.uncertain().iter().zip(values) {
            match uncertain.number {
                UncertainNumber::Length(k) => {
                    let off = || SystemError::LengthTolerance {
                        member: k + 1,
                        length_m: uncertain.given,
                        tolerance_m: value - uncertain.given,
                    };
                    lengthened(&mut members[k], *value).ok_or_else(off)?;
                }
                UncertainNumber::Stiffness(k) => members[k].stiffness_n = Some(*value),
                UncertainNumber::Mass(k) => {
                    let off = || SystemError::Overflow("mass of a member");
                    weighted(&mut members[k], *value).ok_or_else(off)?;
                }
                UncertainNumber::JointMass(k) => joints[k].mass_kg = *value,
                UncertainNumber::At(k, axis) => {
                    if let Some(at_m) = joints[k].support.at_m_mut() {
                        at_m[axis] = *value;
                    }
                }
                UncertainNumber::Force(k, axis) => joints[k].force_n[axis] = *value,
            }
        }
        for joint in joints.iter_mut().filter(|joint| joint.tolerances.is_some()) {
            joint.tolerances = None;
        }
        for member in &mut members {
            (member.tolerances, member.prestress) = (None, None);
        }
        let system = Self::new(self.name(), self.gravity_m_s2(), joints, members)?;
        system.with_floor(self.floor_m())
    }
}

fn of_member((k, member): (usize, &Member)) -> impl Iterator<Item = Uncertain> {
    let tolerances = member.tolerances.as_deref().copied().unwrap_or_default();
    let (length_m, mass_kg) = (member.body.length_m(), member.body.mass_kg());
    let stiffness_n = member.stiffness_n.unwrap_or(0.0);
    [
        (UncertainNumber::Length(k), length_m, tolerances.length_m.unwrap_or(0.0)),
        (UncertainNumber::Stiffness(k), stiffness_n, tolerances.stiffness * stiffness_n),
        (UncertainNumber::Mass(k), mass_kg, tolerances.mass_kg.min(mass_kg)),
    ]
    .into_iter()
    .map(|(number, given, within)| Uncertain { number, given, within })
}

fn of_joint((k, joint): (usize, &Joint)) -> impl Iterator<Item = Uncertain> {
    let tolerances = joint.tolerances.as_deref().copied().unwrap_or_default();
    let within_kg = tolerances.mass_kg.min(joint.mass_kg);
    let mass = (UncertainNumber::JointMass(k), joint.mass_kg, within_kg);
    let at_m = joint.support.at_m().unwrap_or_default();
    let axes = (0..3).flat_map(move |axis| {
        let at = (UncertainNumber::At(k, axis), at_m[axis], tolerances.at_m);
        [at, (UncertainNumber::Force(k, axis), joint.force_n[axis], tolerances.force_n)]
    });
    let all = std::iter::once(mass).chain(axes);
    all.map(|(number, given, within)| Uncertain { number, given, within })
}

/// Give a member another length, its loads at the same parts of it.
fn lengthened(member: &mut Member, length_m: f64) -> Option<()> {
    let part = length_m / member.body.length_m();
    let centre_m = member.body.given_centre_m().map(|centre_m| (part * centre_m).min(length_m));
    member.body = Bar::given(length_m, member.body.mass_kg(), centre_m, None).ok()?;
    for load in &mut member.loads {
        load.at_m = (part * load.at_m).min(length_m);
    }
    Some(())
}

/// Give a member another mass.
fn weighted(member: &mut Member, mass_kg: f64) -> Option<()> {
    let body = &member.body;
    member.body = Bar::given(body.length_m(), mass_kg, body.given_centre_m(), None).ok()?;
    Some(())
}
