//! A system set in motion.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::str::FromStr;

use formats::ForceTable;
use model::Vector;
use model::budget::BYTES_PER_MEMBER;
use model::system::{Kind, System};
use motion::{Order, Settings, Simulation, Snapshot};

use crate::equilibria::{self, system_of};
use crate::error::Error;
use crate::problem::Problem;

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
    /// second, in the vertical plane through the supports (through Y where these are on one
    /// vertical); what they lack to close the loops is corrected if it is little.
    Angles(Vec<f64>),
    /// A position at random, the same for the same number.
    Seed(u64),
    /// Places of all joints, world frame, m; what they lack to meet the lengths is corrected if it is
    /// little.
    Joints(Vec<Vector>),
}

/// Why a simulation does not begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulateError {
    /// Occurs when a time is zero, negative, infinite or not a number.
    #[error("{what} must be positive and finite, got {value_s} s")]
    Time {
        /// Which time.
        what: &'static str,
        /// Its value.
        value_s: f64,
    },
    /// Occurs when the time has more steps than can be counted.
    #[error("{steps:e} steps are too many: at most {MOST_STEPS:e}")]
    Steps {
        /// Their number.
        steps: f64,
    },
    /// Occurs when many positions are to come to rest, and there is no damping.
    #[error("without damping nothing comes to rest: give a drag or friction in the joints")]
    NoDamping,
    /// Occurs when a joint that is to be pushed, or on which a force is to act, is not there.
    #[error("there is no joint {name:?}")]
    NoSuchJoint {
        /// The name as given.
        name: String,
    },
    /// Occurs when there is no equilibrium of this number.
    #[error("there is no equilibrium {label:?}; there are {}", labels.join(", "))]
    NoSuchEquilibrium {
        /// The number as given.
        label: String,
        /// Those that are found.
        labels: Vec<String>,
    },
    /// Occurs when there are not as many angles as members.
    #[error("{given} angles are given for {bars} bars")]
    AngleCount {
        /// Number of angles.
        given: usize,
        /// Number of members.
        bars: usize,
    },
    /// Occurs when a rigid bar at its angle ends far off the joint that the others lead to.
    #[error(
        "with these angles bar {bar} ends {off:.3} of the total length off joint {joint:?} (at most \
         {ROUGH} is corrected)"
    )]
    Angles {
        /// Number of the bar, from 1.
        bar: usize,
        /// Name of the joint where it should end.
        joint: String,
        /// Distance of its end from there, in units of the total length.
        off: f64,
    },
    /// Occurs when the given places are far from all that the lengths allow.
    #[error(
        "at these places the lengths are not met: joint {joint:?} would have to move by {off:.3} of the \
         total length (at most {ROUGH} is corrected)"
    )]
    Apart {
        /// Name of the joint that would have to move most.
        joint: String,
        /// By how much, in units of the total length.
        off: f64,
    },
}

/// Supports nearer to one vertical than this, in total lengths, are on it.
const ON_ONE_VERTICAL: f64 = 1e-9;

/// Chains of at most so many bars have their equilibria numbered by a census.
pub(crate) const CENSUS_BARS: usize = census::Settings::SOUGHT_BARS;

/// How far from where it has to be a joint may be given, in total lengths: angles in whole degrees.
const ROUGH: f64 = 0.02;

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

/// Sets a system in motion, and follows it with rigid bars: RATTLE in the places of the joints.
///
/// ```
/// use funicular::prelude::*;
/// // The example of the paper, released from a position of its own.
/// let problem = Problem::case("three-equal-bars")?;
/// let moved = Simulate::new()
///     .start(Start::Angles(vec![0.0, 60.0, -60.0]))
///     .time_s(2.0)
///     .step_s(1e-3)
///     .run(&problem)?;
/// let [first, .., last] = &moved.stored[..] else { panic!("stored at many times") };
/// assert_eq!((first.time_s, moved.stored.len()), (0.0, 1001));
/// assert!((last.time_s - 2.0).abs() < 1e-9);
/// // Energy is kept to the order of the step squared, laws and lengths to rounding.
/// assert!((last.energy_j() - first.energy_j()).abs() < 1e-4);
/// assert!(last.laws.largest() < 1e-12 && last.lengths_off < 1e-12);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Simulate {
    start: Start,
    pub(crate) time_s: f64,
    step_s: f64,
    store_s: Option<f64>,
    pub(crate) settings: Settings,
    pushes: Vec<(String, Vector)>,
    forces: ForceTable,
}

impl Default for Simulate {
    fn default() -> Self {
        Self {
            start: Start::Rest,
            time_s: 10.0,
            step_s: 1e-3,
            store_s: None,
            settings: Settings::default(),
            pushes: Vec::new(),
            forces: ForceTable::default(),
        }
    }
}

/// Times stored where nothing else is asked for.
const STORED: f64 = 1000.0;

/// Most steps: their number is counted in a double, exactly.
const MOST_STEPS: f64 = 1e12;

impl Simulate {
    /// Ten seconds in steps of a millisecond, from the stable equilibrium, without damping.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Where it begins.
    #[must_use]
    pub fn start(self, start: Start) -> Self {
        Self { start, ..self }
    }

    /// How long it is followed, s.
    #[must_use]
    pub fn time_s(self, time_s: f64) -> Self {
        Self { time_s, ..self }
    }

    /// Length of a step, s. Where the elastic members need shorter ones it is taken in parts.
    #[must_use]
    pub fn step_s(self, step_s: f64) -> Self {
        Self { step_s, ..self }
    }

    /// Time between stored times, s, rounded to whole steps; a thousandth of the time if not said.
    #[must_use]
    pub fn store_s(self, store_s: f64) -> Self {
        Self { store_s: Some(store_s), ..self }
    }

    /// Order in the length of the step.
    #[must_use]
    pub fn order(mut self, order: Order) -> Self {
        self.settings.order = order;
        self
    }

    /// Drag of a medium, 1/s: momentum falls at this rate.
    #[must_use]
    pub fn drag_1_s(mut self, drag_1_s: f64) -> Self {
        self.settings.drag_1_s = drag_1_s;
        self
    }

    /// Friction in the joints, N m s.
    #[must_use]
    pub fn friction_n_m_s(mut self, friction_n_m_s: f64) -> Self {
        self.settings.friction_n_m_s = friction_n_m_s;
        self
    }

    /// Push a joint at the beginning with an impulse, N s. Joints of a chain are named by their
    /// numbers, from `0`.
    #[must_use]
    pub fn push(mut self, joint: impl Into<String>, impulse_n_s: Vector) -> Self {
        self.pushes.push((joint.into(), impulse_n_s));
        self
    }

    /// Let forces act at joints as functions of time.
    ///
    /// ```
    /// use funicular::ForceTable;
    /// use funicular::prelude::*;
    /// // A weight of 1 kg that slides on a level line, drawn along it by 3 N for 2 s: 6 m/s.
    /// let problem = Problem::parse(
    ///     "joints = { S = { at_m = [0, 0, 0], free = \"x\", mass_kg = 1 }, P = { mass_kg = 1e-6 } }\n\
    ///      bars = [{ from = \"S\", to = \"P\", length_m = 1, mass_kg = 0 }]",
    ///     "slider.toml",
    /// )?;
    /// let forces = ForceTable::parse("time_s,joint,x_n,y_n,z_n\n0,S,3,0,0\n2,S,3,0,0\n", "f.csv")?;
    /// let start = Start::Joints(vec![[0.0; 3], [0.0, 0.0, -1.0]]);
    /// let moved = Simulate::new().start(start).time_s(2.0).forces(forces).run(&problem)?;
    /// let speed = moved.stored.last().unwrap().velocities_m_s[0][0];
    /// assert!((speed - 6.0).abs() < 1e-3);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn forces(self, forces: ForceTable) -> Self {
        Self { forces, ..self }
    }

    /// Follow the motion, and keep all stored times in memory.
    ///
    /// # Errors
    ///
    /// [`Error::Motion`] when the system cannot be moved or a step is too long, [`Error::Simulate`]
    /// when a setting is out of range or there is no such start, and the errors of
    /// [`Solve`](crate::Solve).
    pub fn run(&self, problem: &Problem) -> Result<Motion, Error> {
        let mut stored = Vec::new();
        let motion = self.run_watched(problem, &mut |snapshot| {
            stored.push(snapshot.clone());
            ControlFlow::Continue(())
        })?;
        Ok(Motion { stored, ..motion })
    }

    /// Follow the motion, and hand each stored time to `each`, which may end it; in what is returned
    /// no time is stored.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        each: &mut dyn FnMut(&Snapshot) -> ControlFlow<()>,
    ) -> Result<Motion, Error> {
        let (steps, every) = self.steps()?;
        problem.fits(BYTES_PER_MEMBER)?;
        let system = system_of(problem);
        let at = self.position(problem, &system)?;
        let mut simulation = Simulation::new(&system, &at, self.settings)?;
        simulation.push(&self.impulses(&system)?)?;
        let numbers = system.joints().iter().enumerate();
        let numbers: HashMap<_, _> = numbers.map(|(k, joint)| (joint.name.as_str(), k)).collect();
        for (name, force) in self.forces.joints() {
            let force = force.clone();
            let of_time = Box::new(move |time_s: f64| force.at(time_s));
            let number = numbers.get(name.as_str()).copied();
            let number = number.ok_or_else(|| SimulateError::NoSuchJoint { name: name.clone() })?;
            simulation.add_force(number, of_time)?;
        }
        let step_s = self.time_s / steps as f64;
        let parts_of_step = simulation.parts_of(step_s)?;
        for step in 0..=steps {
            if step > 0 {
                simulation.step(step_s)?;
            }
            if step % every == 0 || step == steps {
                let mut snapshot = simulation.snapshot();
                // Sums of steps drift by rounding; the number of steps does not.
                snapshot.time_s = step as f64 * step_s;
                if each(&snapshot).is_break() {
                    break;
                }
            }
        }
        Ok(Motion { system, parts_of_step, stored: Vec::new() })
    }

    /// Number of steps, and every how many the state is stored.
    pub(crate) fn steps(&self) -> Result<(u64, u64), Error> {
        let store_s = self.store_s.unwrap_or(self.time_s / STORED);
        for (what, value_s) in [
            ("the time", self.time_s),
            ("the step", self.step_s),
            ("the time between stored times", store_s),
        ] {
            if !(value_s.is_finite() && value_s > 0.0) {
                return Err(SimulateError::Time { what, value_s }.into());
            }
        }
        let steps = (self.time_s / self.step_s).round().max(1.0);
        if steps > MOST_STEPS {
            return Err(SimulateError::Steps { steps }.into());
        }
        let every = (store_s / self.step_s).round().max(1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole, positive, and the steps below 1e12; more between stored times are capped"
        )]
        Ok((steps as u64, every as u64))
    }

    fn impulses(&self, system: &System) -> Result<Vec<Vector>, Error> {
        let mut impulses = vec![[0.0; 3]; system.joints().len()];
        for (name, impulse) in &self.pushes {
            let joint = joint(system, name)?;
            for k in 0..3 {
                impulses[joint][k] += impulse[k];
            }
        }
        Ok(impulses)
    }

    /// Places of the joints at the beginning.
    fn position(&self, problem: &Problem, system: &System) -> Result<Vec<Vector>, Error> {
        match &self.start {
            Start::Rest => named(equilibria::hanging(problem)?, "1"),
            Start::Equilibrium(label) => named(equilibria::all(problem, CENSUS_BARS)?, label),
            Start::Angles(angles) => pulled_shut(system, &at_angles(system, angles)?),
            Start::Seed(seed) => Ok(motion::random_position(system, *seed)?),
            Start::Joints(joints_m) => pulled_shut(system, joints_m),
        }
    }
}

fn joint(system: &System, name: &str) -> Result<usize, SimulateError> {
    system.joint(name).ok_or_else(|| SimulateError::NoSuchJoint { name: name.to_owned() })
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
    let moved = moved.map(|((a, b), joint)| (distance(*a, *b) / system.total_length_m(), joint));
    match moved.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((off, joint)) if off.is_nan() || off > ROUGH => {
            Err(SimulateError::Apart { joint: joint.name.clone(), off }.into())
        }
        _ => Ok(at),
    }
}

fn distance(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
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
        for (member, along) in members.iter().zip(&along) {
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
        let off = distance(ends, at[member.to]) / system.total_length_m();
        let is_rigid = member.kind == Kind::Bar && member.stiffness_n.is_none();
        if is_rigid && off > ROUGH {
            let joint = joints[member.to].name.clone();
            return Err(SimulateError::Angles { bar: k + 1, joint, off });
        }
    }
    Ok(at)
}

/// The level direction of the plane through the supports; where they are on one vertical the paper's
/// `Y`.
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
        _ => [0.0, 1.0],
    }
}

/// A motion at its stored times.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// What moves.
    pub system: System,
    /// In how many parts each step was taken for the sake of elastic members.
    pub parts_of_step: u32,
    /// Everything at the stored times.
    pub stored: Vec<Snapshot>,
}
