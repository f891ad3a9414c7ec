//! Systems of bars: joints, and members between them.
//!
//! A [`System`] is any number of joints connected by any number of members: bars, and members of
//! other kinds with laws of their own. Joints are spherical and without friction; some are held by
//! supports, the others are free. Gravity acts along −Z on the masses of joints and members, and
//! constant forces act at joints and at points of members.
//!
//! A chain between two anchors is the special case that [`Chain`](crate::Chain) describes.
//!
//! # Conventions
//!
//! Joints and members are numbered from 0 in the order in which they are given. A member runs from
//! its joint [`from`](Member::from) to its joint [`to`](Member::to). Vectors are `[x, y, z]` in the
//! world frame.

mod answer;
mod builder;
mod convert;
mod drawing;
mod error;
mod graph;
mod jam;
mod joint;
mod load_case;
mod member;
mod name;
mod prestress;
mod refusal;
mod rope;
mod row;
mod share;
mod strength;
mod symmetry;
mod tolerance;

pub use answer::{SystemEquilibrium, SystemStability};
pub use builder::SystemBuilder;
pub use error::SystemError;
pub(crate) use error::UNIT_TOLERANCE;
pub(crate) use error::check_range;
pub use jam::Joined;
pub use joint::{Joint, JointProperties, Support};
pub use load_case::{LoadCase, LoadOn, NamedLoad, PERMANENT};
pub use member::{ByLength, Kind, LENGTH_ROUNDING, Member, MemberProperties, Misfit, PointLoad};
pub use name::Name;
pub use prestress::{Prestress, PrestressError};
pub use refusal::Refusal;
pub(crate) use refusal::shortened;
pub use rope::{Rope, RopeFault, RunTogether};
pub use row::Row;
pub use strength::Strength;
pub use symmetry::Part;
pub use tolerance::{JointTolerances, MemberTolerances, RangeError, Uncertain, UncertainNumber};

pub(crate) use share::Shares;
use share::share_all;

use crate::Vector;

/// Joints and members under gravity and constant forces.
///
/// ```
/// use model::system::{Joint, Member, System};
/// use model::Bar;
/// // A lamp of 5 kg on two bars of 1 m between level anchors 1 m apart.
/// let joints = vec![
///     Joint::anchor("A", [0.0, 0.0, 0.0]),
///     Joint::anchor("B", [1.0, 0.0, 0.0]),
///     Joint::free("lamp").with_mass(5.0),
/// ];
/// let bar = Bar::homogeneous(1.0, 1.0)?;
/// let members = vec![Member::bar(0, 2, bar), Member::bar(2, 1, bar)];
/// let system = System::new("a lamp", 9.80665, joints, members)?;
/// assert_eq!(system.total_mass_kg(), 7.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    name: String,
    gravity_m_s2: f64,
    joints: Vec<Joint>,
    members: Vec<Member>,
    floor_m: Option<f64>,
    total_length_m: f64,
    total_mass_kg: f64,
    row: row::Once,
    /// Loads by name and the cases in which they act; no solver looks at them.
    load_cases: Option<Box<load_case::LoadCases>>,
}

impl System {
    /// A system of the given joints and members.
    ///
    /// # Errors
    /// [`SystemError`] when a number is out of range, or a member names a joint that is not there.
    pub fn new(
        name: impl Into<String>,
        gravity_m_s2: f64,
        joints: Vec<Joint>,
        members: Vec<Member>,
    ) -> Result<Self, SystemError> {
        error::check(gravity_m_s2, &joints, &members)?;
        Ok(Self::unchecked(name.into(), gravity_m_s2, joints, members))
    }

    /// Of numbers that are known to be in range.
    fn unchecked(
        name: String,
        gravity_m_s2: f64,
        mut joints: Vec<Joint>,
        mut members: Vec<Member>,
    ) -> Self {
        share_all(&mut joints);
        share_all(&mut members);
        let masses = members.iter().map(|member| member.body.mass_kg());
        let total_mass_kg = crate::sum(joints.iter().map(|joint| joint.mass_kg).chain(masses));
        let total_length_m = crate::sum(members.iter().map(|member| member.body.length_m()));
        Self {
            name,
            gravity_m_s2,
            joints,
            members,
            floor_m: None,
            total_length_m,
            total_mass_kg,
            row: row::Once::default(),
            load_cases: None,
        }
    }

    /// The same system above a flat floor without friction: no joint gets below the height
    /// `floor_m`, m, and what lies there the floor pushes up. Members are straight: where both ends
    /// are above the floor all of them is. With `None` there is no floor.
    ///
    /// # Errors
    /// [`SystemError`] when the height is not finite, or a support holds a joint below it.
    ///
    /// ```
    /// use model::system::{Joint, Member, System};
    /// use model::Bar;
    /// let joints = vec![Joint::anchor("A", [0.0, 0.0, 3.0]), Joint::free("P").with_mass(1.0)];
    /// let members = vec![Member::cable(0, 1, Bar::homogeneous(5.0, 0.0)?)];
    /// let system = System::new("a weight on a line", 9.81, joints, members)?;
    /// assert_eq!(system.clone().with_floor(-1.0)?.floor_m(), Some(-1.0));
    /// assert!(system.with_floor(4.0).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_floor(self, floor_m: impl Into<Option<f64>>) -> Result<Self, SystemError> {
        let floor_m = floor_m.into();
        floor_m.map_or(Ok(()), |floor_m| error::check_floor(floor_m, &self.joints))?;
        Ok(Self { floor_m, row: row::Once::default(), ..self })
    }

    /// The same system after the loss of a member, from 0, and the numbers that its joints had before: an
    /// anchor or a joint without load that no member meets any more is gone too.
    ///
    /// # Panics
    /// If there is no such member.
    ///
    /// ```
    /// use model::system::{Joint, Member, System};
    /// use model::Bar;
    /// let joints = vec![
    ///     Joint::anchor("A", [0.0, 0.0, 0.0]),
    ///     Joint::anchor("B", [1.0, 0.0, 0.0]),
    ///     Joint::free("lamp").with_mass(5.0),
    /// ];
    /// let bar = Bar::homogeneous(1.0, 1.0)?;
    /// let members = vec![Member::bar(0, 2, bar), Member::bar(2, 1, bar)];
    /// let system = System::new("a lamp", 9.80665, joints, members)?;
    /// let (left, joints) = system.without(0);
    /// assert_eq!((left.members().len(), joints), (1, vec![1, 2]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn without(&self, member: usize) -> (Self, Vec<usize>) {
        let mut members = self.members.clone();
        let lost = members.remove(member);
        let met = |joint: usize| members.iter().any(|m| m.path().any(|k| k == joint));
        let of_use = |k: usize| {
            let joint = &self.joints[k];
            let [x, y, z] = joint.force_n;
            // What its support does not bear.
            let load_n = [x, y, z - joint.mass_kg * self.gravity_m_s2];
            let moves = joint.support.free_part(load_n);
            moves.iter().any(|n| n.abs() > 0.0) || met(k)
        };
        let is_left = |k: &usize| lost.path().all(|joint| joint != *k) || of_use(*k);
        let kept: Vec<usize> = (0..self.joints.len()).filter(is_left).collect();
        (self.of_joints(members, &kept), kept)
    }

    /// The same system without the fixed joints that no member meets, which bear nothing, and their names.
    #[must_use]
    pub fn without_unused(&self) -> (Self, Vec<String>) {
        let mut unused: Vec<bool> =
            self.joints.iter().map(|joint| joint.support.is_fixed()).collect();
        self.members.iter().flat_map(Member::path).for_each(|joint| unused[joint] = false);
        let kept: Vec<usize> = (0..unused.len()).filter(|k| !unused[*k]).collect();
        let names = self.joints.iter().zip(unused).filter(|(_, is_unused)| *is_unused);
        let names = names.map(|(joint, _)| joint.name.to_string()).collect();
        (self.of_joints(self.members.clone(), &kept), names)
    }

    /// The system of these members and of the joints kept, which are all that they meet.
    fn of_joints(&self, members: Vec<Member>, kept: &[usize]) -> Self {
        // Those that stay keep their order.
        let number = |joint: usize| kept.partition_point(|k| *k < joint);
        let members = members.into_iter().map(|member| member.renumbered(number)).collect();
        let joints = kept.iter().map(|k| self.joints[*k].clone()).collect();
        let left = Self::unchecked(self.name.clone(), self.gravity_m_s2, joints, members);
        Self { floor_m: self.floor_m, ..left }
    }

    /// Height of the floor below which no joint gets, m; nothing where there is none.
    pub fn floor_m(&self) -> Option<f64> {
        self.floor_m
    }

    /// The name, for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Gravity `g` along −Z, m/s².
    pub fn gravity_m_s2(&self) -> f64 {
        self.gravity_m_s2
    }

    /// The joints.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The members.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// The point from which energies are measured, m: where the first joint is whose height a support holds; the first
    /// support, where none does.
    ///
    /// `V = Σ m g Z − Σ f · x +` elastic energies, with heights and places relative to this point.
    ///
    /// ```
    /// use model::system::{Joint, Member, System};
    /// use model::Bar;
    /// let joints = vec![Joint::free("P").with_mass(1.0), Joint::anchor("A", [0.0, 0.0, 3.0])];
    /// let members = vec![Member::bar(1, 0, Bar::homogeneous(2.0, 0.0)?)];
    /// let system = System::new("pendulum", 9.81, joints, members)?;
    /// assert_eq!((system.reference_m(), system.joint("P")), ([0.0, 0.0, 3.0], Some(0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn reference_m(&self) -> Vector {
        let supports = || self.joints.iter().map(|joint| &joint.support);
        let first = supports().find(|support| support.holds_height());
        first
            .or(supports().find(|support| support.at_m().is_some()))
            .and_then(Support::at_m)
            .unwrap_or_default()
    }

    /// Sum of the lengths of the members, m.
    pub fn total_length_m(&self) -> f64 {
        self.total_length_m
    }

    /// Sum of the masses of joints and members, kg.
    pub fn total_mass_kg(&self) -> f64 {
        self.total_mass_kg
    }

    /// Weight and force of each joint with what its members bring there by [`Member::end_loads_n`], N.
    pub fn joint_loads_n(&self) -> Vec<Vector> {
        let weight_n = |joint: &Joint| joint.mass_kg * self.gravity_m_s2;
        let own = self.joints.iter().map(|joint| (joint.force_n, weight_n(joint)));
        let mut loads: Vec<Vector> = own.map(|([x, y, z], w)| [x, y, z - w]).collect();
        for member in &self.members {
            let [start, end] = member.end_loads_n(self.gravity_m_s2);
            for k in 0..3 {
                loads[member.from][k] += start[k];
                loads[member.to][k] += end[k];
            }
        }
        loads
    }

    /// Sum of the sizes of all loads, N.
    pub fn total_load_n(&self) -> f64 {
        let on_members = self.members.iter().flat_map(|member| &member.loads);
        let forces = self.joints.iter().map(|joint| joint.force_n);
        let sizes = forces.chain(on_members.map(|load| load.force_n));
        let sizes = sizes.map(|[x, y, z]| x.hypot(y).hypot(z));
        crate::sum(sizes) + self.total_mass_kg * self.gravity_m_s2
    }

    /// The number of the joint of this name.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Distance of two supported joints, m; NaN where one of them has no support.
    fn distance_m(&self, a: usize, b: usize) -> f64 {
        match (self.joints[a].support.at_m(), self.joints[b].support.at_m()) {
            (Some(start_m), Some(end_m)) => crate::Anchors { start_m, end_m }.span_m(),
            _ => f64::NAN,
        }
    }
}
