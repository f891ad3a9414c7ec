//! Systems of joints by name.

use std::fmt;

use super::{Joint, Kind, Member, System, SystemError};
use crate::{Bar, STANDARD_GRAVITY_M_S2};

type Between = Box<dyn FnOnce(usize, usize) -> Member + Send + Sync>;

/// Joints, and members that name the joints they connect: see [`System::builder`].
pub struct SystemBuilder {
    name: String,
    gravity_m_s2: f64,
    joints: Vec<Joint>,
    members: Vec<([String; 2], Between)>,
}

impl System {
    /// A system put together by the names of its joints, in any order, under standard gravity where
    /// no other is given.
    ///
    /// ```
    /// use model::Bar;
    /// use model::system::{Joint, Member, System, SystemError};
    /// let cord = Bar::homogeneous(5.0, 0.0)?;
    /// let lamp = System::builder("a lamp on two cables, one elastic")
    ///     .joint(Joint::anchor("A", [-3.0, 0.0, 0.0]))
    ///     .joint(Joint::anchor("B", [3.0, 0.0, 0.0]))
    ///     .joint(Joint::free("lamp").with_mass(2.0))
    ///     .cable("A", "lamp", cord)
    ///     .member("lamp", "B", move |a, b| Member::cable(a, b, cord).with_stiffness(1e5));
    /// let lamp = lamp.build()?;
    /// assert_eq!((lamp.members()[1].from, lamp.members()[1].to), (2, 1));
    /// assert_eq!((lamp.gravity_m_s2(), lamp.members()[1].stiffness_n), (9.80665, Some(1e5)));
    ///
    /// let no_joint = System::builder("").bar("A", "Q", Bar::homogeneous(1.0, 1.0)?).build();
    /// assert_eq!(no_joint.unwrap_err().to_string(), "member 1 names a joint \"A\" that is not there");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn builder(name: impl Into<String>) -> SystemBuilder {
        SystemBuilder {
            name: name.into(),
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            joints: vec![],
            members: vec![],
        }
    }
}

impl fmt::Debug for SystemBuilder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, gravity_m_s2, joints, members } = self;
        let ends: Vec<_> = members.iter().map(|(ends, _)| ends).collect();
        let mut said = f.debug_struct("SystemBuilder");
        said.field("name", name).field("gravity_m_s2", gravity_m_s2);
        said.field("joints", joints).field("members", &ends).finish_non_exhaustive()
    }
}

impl SystemBuilder {
    /// Gravity along −Z, m/s².
    #[must_use]
    pub fn gravity_m_s2(self, gravity_m_s2: f64) -> Self {
        Self { gravity_m_s2, ..self }
    }

    /// One more joint.
    #[must_use]
    pub fn joint(mut self, joint: Joint) -> Self {
        self.joints.push(joint);
        self
    }

    /// A rigid bar between two joints.
    #[must_use]
    pub fn bar(self, from: &str, to: &str, body: Bar) -> Self {
        self.member(from, to, move |from, to| Member::bar(from, to, body))
    }

    /// An inextensible cable between two joints.
    #[must_use]
    pub fn cable(self, from: &str, to: &str, body: Bar) -> Self {
        self.member(from, to, move |from, to| Member::cable(from, to, body))
    }

    /// A rigid strut between two joints, which only pushes.
    #[must_use]
    pub fn strut(self, from: &str, to: &str, body: Bar) -> Self {
        self.member(from, to, move |from, to| Member::bar(from, to, body).of_kind(Kind::Strut))
    }

    /// Any member between two joints, whose numbers are handed to `member`.
    #[must_use]
    pub fn member(
        mut self,
        from: &str,
        to: &str,
        member: impl FnOnce(usize, usize) -> Member + Send + Sync + 'static,
    ) -> Self {
        self.members.push(([from, to].map(str::to_owned), Box::new(member)));
        self
    }

    /// The system.
    ///
    /// # Errors
    /// As [`System::new`], and [`SystemError::UnknownJoint`].
    pub fn build(self) -> Result<System, SystemError> {
        let Self { name, gravity_m_s2, joints, members } = self;
        let numbers: std::collections::HashMap<_, usize> =
            joints.iter().enumerate().map(|(k, joint)| (joint.name.text(), k)).collect();
        let number = |member: usize, name: &str| {
            let unknown = || SystemError::UnknownJoint { member, name: name.to_owned() };
            numbers.get(name).copied().ok_or_else(unknown)
        };
        let between = |(k, ([from, to], member)): (usize, ([String; 2], Between))| {
            Ok(member(number(k + 1, &from)?, number(k + 1, &to)?))
        };
        let members = members.into_iter().enumerate().map(between).collect::<Result<_, _>>()?;
        drop(numbers);
        System::new(name, gravity_m_s2, joints, members)
    }
}
