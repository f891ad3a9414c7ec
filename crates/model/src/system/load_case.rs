//! Loads by name, and the cases in which they act together.

use std::collections::HashMap;

use super::{Joint, Member, PointLoad, System, SystemError};
use crate::{Bar, BarError, Vector};

/// The loads without a name, in [`LoadCase::factors`]: weights of members and joints, constant forces.
pub const PERMANENT: &str = "permanent";

/// A load by name: masses and forces at joints, or forces along members.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedLoad {
    /// Its name, which several loads may share; those called [`PERMANENT`] are as if without a name.
    pub name: String,
    /// Where it acts.
    pub on: LoadOn,
}

/// Where a load acts, and what it is.
#[derive(Debug, Clone, PartialEq)]
pub enum LoadOn {
    /// At each of these joints a mass, kg, and a constant force, N.
    Joints {
        /// Their numbers, from 0.
        joints: Vec<usize>,
        /// The mass at each.
        mass_kg: f64,
        /// The force at each.
        force_n: Vector,
    },
    /// Along each of these members a constant force by the metre of its length, N/m.
    Members {
        /// Their numbers, from 0.
        members: Vec<usize>,
        /// The force a metre.
        force_n_per_m: Vector,
    },
}

/// A case: loads that act together, each by its factor.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadCase {
    /// The name.
    pub name: String,
    /// Factors by the names of loads. A load that is not named here does not act; the loads without a name
    /// ([`PERMANENT`]) then act by 1.
    pub factors: Vec<(String, f64)>,
}

/// The named loads of a system, and its cases.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LoadCases {
    /// The factor by which weights, and loads without a name, act.
    permanent: f64,
    /// Mass and force of each joint with loads, without any of them.
    own: Vec<(usize, f64, Vector)>,
    loads: Vec<NamedLoad>,
    cases: Vec<LoadCase>,
    /// Mass and force of each joint with a named load, without it.
    joints: Vec<(usize, f64, Vector)>,
    /// The number of loads of each member with a named load, without it.
    members: Vec<(usize, usize)>,
}

impl LoadCase {
    /// The factor of the loads of this name, [`PERMANENT`] for those without.
    pub fn factor(&self, name: &str) -> f64 {
        let given = self.factors.iter().find(|(load, _)| load == name);
        given.map_or(if name == PERMANENT { 1.0 } else { 0.0 }, |(_, factor)| *factor)
    }
}

impl NamedLoad {
    /// Add the load, times a factor, to what acts.
    fn act(&self, factor: f64, joints: &mut [Joint], members: &mut [Member]) {
        match &self.on {
            LoadOn::Joints { joints: numbers, mass_kg, force_n } => {
                for number in numbers {
                    let joint = &mut joints[*number];
                    joint.mass_kg += factor * mass_kg;
                    for (sum, component) in joint.force_n.iter_mut().zip(force_n) {
                        *sum += factor * component;
                    }
                }
            }
            LoadOn::Members { members: numbers, force_n_per_m } => {
                for number in numbers {
                    let member = &mut members[*number];
                    let given_m = member.given_body().length_m();
                    let force_n = force_n_per_m.map(|x| factor * given_m * x);
                    let middle = |length_m: f64| PointLoad {
                        at_m: 0.5 * length_m,
                        force_n,
                        is_spread: true,
                    };
                    let load = middle(member.body.length_m());
                    member.loads.push(load);
                    let growth = member.by_length.growth;
                    let own = member.by_length.force_n_per_m.iter_mut().zip(force_n_per_m);
                    own.for_each(|(sum, x)| *sum += factor * growth * x);
                    if let Some(given) = &mut member.prestress {
                        given.loads.push(middle(given_m));
                    }
                }
            }
        }
    }
}

/// A body whose mass, and moments of inertia, are so many times as large.
fn heavier(body: &Bar, factor: f64) -> Result<Bar, BarError> {
    let inertia = body.given_inertia_kg_m2().map(|inertia| inertia.map(|j| factor * j));
    Bar::given(body.length_m(), factor * body.mass_kg(), body.given_centre_m(), inertia)
}

/// All that weighs or acts without a name, times a factor.
fn scale(factor: f64, joints: &mut [Joint], members: &mut [Member]) -> Result<(), BarError> {
    let times = |force_n: &mut Vector| *force_n = force_n.map(|x| factor * x);
    for joint in joints {
        joint.mass_kg *= factor;
        times(&mut joint.force_n);
    }
    for member in members {
        member.body = heavier(&member.body, factor)?;
        member.scale_tolerances(factor);
        member.loads.iter_mut().for_each(|load| times(&mut load.force_n));
        times(&mut member.by_length.force_n_per_m);
        if let Some(given) = &mut member.prestress {
            given.body = heavier(&given.body, factor)?;
            given.loads.iter_mut().for_each(|load| times(&mut load.force_n));
        }
    }
    Ok(())
}

impl System {
    /// The same system with loads by name, all of which act, and the cases in which only some do
    /// ([`in_case`](Self::in_case)).
    ///
    /// # Errors
    /// [`SystemError`] when a number is out of range, a joint or member is not there, two cases have one
    /// name or a case names a load that is none.
    ///
    /// ```
    /// use model::system::{Joint, LoadCase, LoadOn, Member, NamedLoad, System};
    /// use model::Bar;
    /// let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("lamp").with_mass(5.0)];
    /// let members = vec![Member::bar(0, 1, Bar::homogeneous(1.0, 1.0)?)];
    /// let wind = LoadOn::Joints { joints: vec![1], mass_kg: 0.0, force_n: [20.0, 0.0, 0.0] };
    /// let storm = LoadCase { name: "storm".into(), factors: vec![("wind".into(), 1.5)] };
    /// let still = LoadCase { name: "still".into(), factors: vec![("permanent".into(), 1.35)] };
    /// let system = System::new("a lamp", 9.81, joints, members)?
    ///     .with_loads(vec![NamedLoad { name: "wind".into(), on: wind }], vec![storm, still])?;
    /// assert_eq!(system.joints()[1].force_n[0], 20.0);
    /// let [storm, still] = ["storm", "still"].map(|name| system.in_case(name).expect("a case"));
    /// assert_eq!((storm.joints()[1].force_n[0], storm.joints()[1].mass_kg), (30.0, 5.0));
    /// assert_eq!((still.joints()[1].force_n[0], still.joints()[1].mass_kg), (0.0, 6.75));
    /// assert_eq!(still.members()[0].body.mass_kg(), 1.35);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_loads(
        mut self,
        loads: Vec<NamedLoad>,
        cases: Vec<LoadCase>,
    ) -> Result<Self, SystemError> {
        self.check_loads(&loads, &cases)?;
        let on_joints = |load: &NamedLoad| match &load.on {
            LoadOn::Joints { joints, .. } => joints.clone(),
            LoadOn::Members { .. } => vec![],
        };
        let own = loads.iter().flat_map(on_joints);
        let own = own.map(|k| (k, self.joints[k].mass_kg, self.joints[k].force_n)).collect();
        let (unnamed, loads): (Vec<_>, Vec<_>) =
            loads.into_iter().partition(|load| load.name == PERMANENT);
        for load in unnamed {
            load.act(1.0, &mut self.joints, &mut self.members);
        }
        let (joints, members) = (vec![], vec![]);
        let mut kept = LoadCases { permanent: 1.0, own, loads, cases, joints, members };
        for load in &kept.loads {
            match &load.on {
                LoadOn::Joints { joints, .. } => kept.joints.extend(
                    joints.iter().map(|k| (*k, self.joints[*k].mass_kg, self.joints[*k].force_n)),
                ),
                LoadOn::Members { members, .. } => {
                    kept.members.extend(members.iter().map(|k| (*k, self.members[*k].loads.len())));
                }
            }
        }
        for load in &kept.loads {
            load.act(1.0, &mut self.joints, &mut self.members);
        }
        let system = Self::new(self.name, self.gravity_m_s2, self.joints, self.members)?;
        Ok(Self { floor_m: self.floor_m, load_cases: Some(Box::new(kept)), ..system })
    }

    fn check_loads(&self, loads: &[NamedLoad], cases: &[LoadCase]) -> Result<(), SystemError> {
        for NamedLoad { on, .. } in loads {
            match on {
                LoadOn::Joints { joints, .. } => {
                    if let Some(joint) = joints.iter().find(|k| **k >= self.joints.len()) {
                        return Err(SystemError::NoSuchLoaded { what: "joint", number: *joint });
                    }
                }
                LoadOn::Members { members, .. } => {
                    if let Some(member) = members.iter().find(|k| **k >= self.members.len()) {
                        return Err(SystemError::NoSuchLoaded { what: "member", number: *member });
                    }
                }
            }
        }
        for (k, case) in cases.iter().enumerate() {
            if cases[..k].iter().any(|other| other.name == case.name) {
                return Err(SystemError::DuplicateCase(case.name.clone()));
            }
            for (name, factor) in &case.factors {
                let is_there = name == PERMANENT || loads.iter().any(|load| load.name == *name);
                if !is_there {
                    let (case, load) = (case.name.clone(), name.clone());
                    return Err(SystemError::UnknownLoad { case, load });
                }
                if !(factor.is_finite() && (*factor >= 0.0 || name != PERMANENT)) {
                    let (case, load) = (case.name.clone(), name.clone());
                    return Err(SystemError::Factor { case, load, factor: *factor });
                }
            }
        }
        Ok(())
    }

    /// The same with the loads by name and the cases of another system, of which this one differs in numbers: `own` is what
    /// a joint has itself, by its number there, mass and force, of what it had; loads at joints act by one factor, those along
    /// members by another. Joints are found by their names. Loads along members need the same members: else cases are not kept.
    #[must_use]
    pub fn with_loads_of(
        self,
        other: &Self,
        own: impl Fn(usize, f64, Vector) -> (f64, Vector),
        [at_joints, along_members]: [f64; 2],
    ) -> Self {
        let Some(before) = other.load_cases.as_deref() else { return self };
        let is_along = |load: &NamedLoad| matches!(load.on, LoadOn::Members { .. });
        if self.members.len() != other.members.len() && before.loads.iter().any(is_along) {
            return self;
        }
        let here = |joint: usize| {
            let name = &other.joints[joint].name;
            let is_same = self.joints.get(joint).is_some_and(|same| same.name == *name);
            if is_same { Some(joint) } else { self.joint(&name.text()) }
        };
        let times = |factor: f64, force: Vector| force.map(|x| factor * x);
        let mut all = before.clone();
        let own_now = |joint: usize, mass_kg: f64, force_n: Vector| {
            own(joint, at_joints * mass_kg, times(at_joints, force_n))
        };
        all.own = before
            .own
            .iter()
            .filter_map(|(joint, mass_kg, force_n)| {
                let (mass_kg, force_n) = own_now(*joint, *mass_kg, *force_n);
                Some((here(*joint)?, mass_kg, force_n))
            })
            .collect();
        // Loads without a name are beside what the joint has itself.
        let owns: HashMap<_, _> = before
            .own
            .iter()
            .map(|(joint, mass_kg, force_n)| (joint, (mass_kg, force_n)))
            .collect();
        all.joints = before
            .joints
            .iter()
            .filter_map(|(joint, mass_kg, force_n)| {
                let (own_kg, own_n) = owns.get(joint)?;
                let (now_kg, now_n) = own_now(*joint, **own_kg, **own_n);
                let beside = |x: f64, own: f64, now: f64| now + at_joints * (x - own);
                let force_n = std::array::from_fn(|k| beside(force_n[k], own_n[k], now_n[k]));
                Some((here(*joint)?, beside(*mass_kg, **own_kg, now_kg), force_n))
            })
            .collect();
        for load in &mut all.loads {
            match &mut load.on {
                LoadOn::Joints { joints, mass_kg, force_n } => {
                    *joints = joints.iter().filter_map(|joint| here(*joint)).collect();
                    *mass_kg *= at_joints;
                    *force_n = times(at_joints, *force_n);
                }
                LoadOn::Members { force_n_per_m, .. } => {
                    *force_n_per_m = times(along_members, *force_n_per_m);
                }
            }
        }
        Self { load_cases: Some(Box::new(all)), ..self }
    }

    /// The same with other tolerances of its joints.
    pub(crate) fn with_joints(self, joints: Vec<Joint>) -> Self {
        Self { joints, row: super::row::Once::default(), ..self }
    }

    /// The factor by which weights act, and loads without a name: that of the load case ([`in_case`](Self::in_case)), else 1.
    pub fn permanent_factor(&self) -> f64 {
        self.load_cases.as_ref().map_or(1.0, |all| all.permanent)
    }

    /// Mass, kg, and force, N, of a joint as it has them itself, without factors and loads; `None` where there are no loads at
    /// it.
    pub fn own_load(&self, joint: usize) -> Option<(f64, Vector)> {
        let own = &self.load_cases.as_ref()?.own;
        own.iter().find(|(k, ..)| *k == joint).map(|(_, mass_kg, force_n)| (*mass_kg, *force_n))
    }

    /// The loads by name.
    pub fn named_loads(&self) -> &[NamedLoad] {
        self.load_cases.as_ref().map_or(&[], |all| &all.loads)
    }

    /// The cases in which loads act together.
    pub fn load_cases(&self) -> &[LoadCase] {
        self.load_cases.as_ref().map_or(&[], |all| &all.cases)
    }

    /// The same system under the loads that have no name alone.
    #[must_use]
    pub fn without_named_loads(&self) -> Self {
        let (mut joints, mut members) = (self.joints.clone(), self.members.clone());
        if let Some(all) = &self.load_cases {
            // Of a joint or member with several loads the first says what was there before them.
            for (joint, mass_kg, force_n) in all.joints.iter().rev() {
                (joints[*joint].mass_kg, joints[*joint].force_n) = (*mass_kg, *force_n);
            }
            for (member, loads) in all.members.iter().rev() {
                members[*member].loads.truncate(*loads);
                if let Some(given) = &mut members[*member].prestress {
                    given.loads.truncate(*loads);
                }
            }
        }
        let system = Self::unchecked(self.name.clone(), self.gravity_m_s2, joints, members);
        Self { floor_m: self.floor_m, ..system }
    }

    /// The system in one of its [`load_cases`](Self::load_cases), its name that of both.
    ///
    /// # Errors
    /// [`SystemError`] when there is no case of this name, or its factors bring a number out of range.
    pub fn in_case(&self, name: &str) -> Result<Self, SystemError> {
        let case = self.load_cases().iter().find(|case| case.name == name).ok_or_else(|| {
            let known = self.load_cases().iter().map(|case| case.name.clone()).collect();
            SystemError::UnknownCase { case: name.to_owned(), known }
        })?;
        let permanent = self.without_named_loads();
        let (mut joints, mut members) = (permanent.joints, permanent.members);
        let scaled = scale(case.factor(PERMANENT), &mut joints, &mut members);
        scaled.map_err(|_| SystemError::Factor {
            case: name.to_owned(),
            load: PERMANENT.to_owned(),
            factor: case.factor(PERMANENT),
        })?;
        let mut largest = vec![case.factor(PERMANENT); joints.len()];
        for load in self.named_loads() {
            // What does not act leaves no trace, not even a zero.
            let factor = case.factor(&load.name);
            if factor.abs() > 0.0 {
                load.act(factor, &mut joints, &mut members);
                if let LoadOn::Joints { joints, .. } = &load.on {
                    for k in joints {
                        largest[*k] = largest[*k].max(factor.abs());
                    }
                }
            }
        }
        // Which of its loads is off nobody has said: that with the largest factor.
        joints.iter_mut().zip(largest).for_each(|(joint, by)| joint.scale_tolerances(by));
        let title = format!("{}, {name}", self.name);
        let system = Self::new(title, self.gravity_m_s2, joints, members)?;
        let own = self.load_cases.as_ref().map_or_else(Vec::new, |all| all.own.clone());
        let (loads, cases, joints, members) = (vec![], vec![], vec![], vec![]);
        let permanent = case.factor(PERMANENT);
        let load_cases = LoadCases { permanent, own, loads, cases, joints, members };
        Ok(Self { floor_m: self.floor_m, load_cases: Some(Box::new(load_cases)), ..system })
    }
}
