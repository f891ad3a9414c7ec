//! A system set in motion.

mod error;
mod start;

pub use self::error::SimulateError;
pub(crate) use self::start::CENSUS_BARS;
pub use self::start::Start;

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use formats::ForceTable;
use model::Vector;
use model::budget::BYTES_PER_MEMBER;
use model::system::System;
use motion::{Order, Settings, Simulation, Snapshot};

use crate::error::Error;
use crate::problem::Problem;

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
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// Where it begins.
        start: Start,
        /// How long it is followed, s.
        time_s: f64,
        /// Length of a step, s. Where the elastic members need shorter ones it is taken in parts.
        step_s: f64,
        /// Time between stored times, s, rounded to whole steps; a thousandth of the time if not said.
        store_s: f64 => Some(store_s),
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
        forces: ForceTable,
    }

    /// Order in the length of the step.
    #[must_use]
    pub fn order(mut self, order: Order) -> Self {
        self.settings.order = order;
        self
    }

    /// Drag of a medium, 1/s: momentum falls at this rate.
    #[must_use]
    pub fn damping_1_s(mut self, damping_1_s: f64) -> Self {
        self.settings.damping_1_s = damping_1_s;
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

    /// Follow the motion, and keep all stored times in memory.
    ///
    /// # Errors
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
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        each: &mut dyn FnMut(&Snapshot) -> ControlFlow<()>,
    ) -> Result<Motion, Error> {
        let (steps, every) = self.steps()?;
        problem.fits(BYTES_PER_MEMBER)?;
        let system = problem.system();
        let at = self.start.position(problem, &system)?;
        let mut simulation = Simulation::new(&system, &at, self.settings)?;
        simulation.push(&self.impulses(&system)?)?;
        let numbers = system.joints().iter().enumerate();
        let numbers: HashMap<_, _> = numbers.map(|(k, joint)| (joint.name.text(), k)).collect();
        for (name, force) in self.forces.joints() {
            let force = force.clone();
            let of_time = Box::new(move |time_s: f64| force.at(time_s));
            let number = numbers.get(name.as_str()).copied();
            let number = number.ok_or_else(|| SimulateError::NoSuchJoint(name.clone()))?;
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
            return Err(SimulateError::Steps(steps).into());
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
            if system.joints()[joint].support.is_fixed() {
                return Err(SimulateError::PushedAnchor(name.clone()).into());
            }
            for k in 0..3 {
                impulses[joint][k] += impulse[k];
            }
        }
        Ok(impulses)
    }
}

fn joint(system: &System, name: &str) -> Result<usize, SimulateError> {
    system.joint(name).ok_or_else(|| SimulateError::NoSuchJoint(name.to_owned()))
}

/// A motion at its stored times.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// What moves.
    pub system: Arc<System>,
    /// In how many parts each step was taken for the sake of elastic members.
    pub parts_of_step: u32,
    /// Everything at the stored times.
    pub stored: Vec<Snapshot>,
}
