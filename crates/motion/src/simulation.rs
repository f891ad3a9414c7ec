use model::Vector;
use model::system::{RunTogether, System};

use crate::composition::parts;
use crate::contacts::{Contacts, Impact};
use crate::damping;
use crate::error::{MotionError, Result};
use crate::force::{ForceOfTime, Forces, MomentOfTime, kinetic_j, potential_j};
use crate::mechanism::Mechanism;
use crate::rattle::{Failure, Stepper};
use crate::settings::Settings;
use crate::snapshot::Snapshot;
use crate::stable::longest_step_s;
use crate::state::State;
use numerics::vector::{add_times, cross, dot, minus, plus, times};

/// Largest relative violation of a length in places that a motion may begin with; what is less is
/// taken for the rounding of printed digits, and corrected.
pub const CLOSED_TOLERANCE: f64 = 1e-5;

/// Most parts that a step is taken in for the sake of elastic members: more take longer than one
/// would wait without being told.
const MOST_PARTS: f64 = 1e4;

/// Corrections of the places at the beginning: the convergence is quadratic.
const MOST_CORRECTIONS: usize = 20;

/// A system of bars in motion.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// use motion::{Settings, Simulation};
///
/// // A homogeneous bar of 1 m, held at one end, released level.
/// let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P")];
/// let bar = Bar::homogeneous(1.0, 3.0)?;
/// let system = System::new("pendulum", 9.81, joints, vec![Member::bar(0, 1, bar)])?;
/// let places = [[0.0; 3], [1.0, 0.0, 0.0]];
/// let mut pendulum = Simulation::new(&system, &places, Settings::default())?;
/// let released = pendulum.snapshot();
/// // Its end falls with 3/2 g (moment of inertia m l²/3 under the moment m g l/2).
/// assert!((released.accelerations_m_s2[1][2] + 1.5 * 9.81).abs() < 1e-12);
/// // The anchor carries a quarter of the weight.
/// assert!((released.reactions_n[0][2] - 0.25 * 3.0 * 9.81).abs() < 1e-12);
/// for _ in 0..1000 {
///     pendulum.step(1e-3)?;
/// }
/// assert!(pendulum.energy_j().abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Simulation {
    pub(crate) settings: Settings,
    /// Lengths of the steps of RATTLE in a step, in units of it.
    parts: Vec<f64>,
    longest_s: f64,
    pub(crate) forces: Forces,
    pub(crate) state: State,
    pub(crate) stepper: Stepper,
    pub(crate) time_s: f64,
    /// What holds on one side alone, where there is such.
    pub(crate) contacts: Option<Contacts>,
    pub(crate) impacts: Vec<Impact>,
}

impl Simulation {
    /// A system at rest at the given places of its joints (world frame, m; those of anchors are
    /// ignored).
    ///
    /// # Errors
    ///
    /// [`MotionError`] when the system cannot be moved here, a setting is out of range, the places
    /// violate a length by more than [`CLOSED_TOLERANCE`], or the constraints do not determine
    /// their forces there.
    pub fn new(system: &System, joints_m: &[Vector], settings: Settings) -> Result<Self> {
        settings.validate()?;
        let mut contacts = Contacts::of(system);
        let held = match &mut contacts {
            Some(contacts) if joints_m.len() == system.joints().len() => {
                contacts.begin(joints_m)?;
                contacts.held()?
            }
            _ => system.clone(),
        };
        let mechanism = Mechanism::for_motion(&held, system.reference_m())?;
        let mut state = State::at_rest(mechanism.places(joints_m)?);
        let mut stepper = Stepper::new(mechanism)?;
        let off = state.rows(&stepper.mechanism, &mut stepper.vectors);
        if off.is_nan() || off > CLOSED_TOLERANCE {
            return Err(MotionError::NotClosed { iterations: 0, off });
        }
        let assembled = stepper.assemble(&mut state, MOST_CORRECTIONS);
        stepper.told(assembled)?;
        let forces = Forces::default();
        let arrived = stepper.arrive(&state, &forces, 0.0);
        stepper.told(arrived)?;
        let parts = parts(settings.order);
        let longest_s = longest_step_s(&stepper.mechanism)?;
        let impacts = Vec::new();
        let mut found = Self {
            settings,
            parts,
            longest_s,
            forces,
            state,
            stepper,
            time_s: 0.0,
            contacts,
            impacts,
        };
        found.let_go(false)?;
        Ok(found)
    }

    /// Add a force at a joint as a function of time, N; with the damping of [`Settings`] and the
    /// constant loads it acts from the next step on.
    ///
    /// # Errors
    ///
    /// [`MotionError::Input`] when there is no such joint.
    pub fn add_force(&mut self, joint: usize, of_time: ForceOfTime) -> Result<()> {
        let Some(&slot) = self.mechanism().slot_of.get(joint) else {
            let reason = format!("there is no joint number {joint}");
            return Err(MotionError::Input { what: "a force of time", reason });
        };
        self.forces.of_time.push((slot, of_time));
        self.forces.at(&self.stepper.mechanism, &self.state, self.time_s, &mut self.stepper.force);
        Ok(())
    }

    /// Add a moment on a member as a function of time, N m, world frame; what of it is along the
    /// member does nothing (its spin is apart).
    ///
    /// # Errors
    ///
    /// [`MotionError::Input`] when there is no such member, it is a rope, or its moments across
    /// differ: then its spin is not apart.
    pub fn add_moment(&mut self, member: usize, of_time: ForceOfTime) -> Result<()> {
        let refused = |reason| MotionError::Input { what: "a moment of time", reason };
        let system = self.mechanism().system();
        let Some(of) = system.members().get(member) else {
            return Err(refused(format!("there is no member number {member}")));
        };
        if of.rope.is_some() {
            return Err(refused(format!("a rope, member number {member}, bears none")));
        }
        if self.mechanism().cornered.iter().any(|cornered| cornered.member == member) {
            return Err(refused(format!("the moments across member number {member} differ")));
        }
        let [a, b] = [of.from, of.to].map(|joint| self.mechanism().slot_of[joint]);
        self.forces.moments.push(MomentOfTime { a, b, member, of_time });
        self.forces.at(&self.stepper.mechanism, &self.state, self.time_s, &mut self.stepper.force);
        Ok(())
    }

    /// Give velocities to the joints, m/s; what of them changes lengths is taken out (least change
    /// in the metric of the inertia). Bars do not spin about themselves then.
    ///
    /// # Errors
    ///
    /// [`MotionError`] when they are not as many as the joints, or not finite.
    pub fn set_velocities(&mut self, velocities_m_s: &[Vector]) -> Result<()> {
        let mut velocity = self.mechanism().by_slot(velocities_m_s, "velocities of the joints")?;
        velocity[self.mechanism().moving..].fill([0.0; 3]);
        for cornered in &self.mechanism().cornered {
            let slot = |joint: usize| self.mechanism().slot_of[joint];
            let [a, b, p] = cornered.joints.map(slot);
            let body = &self.mechanism().system.members()[cornered.member].body;
            let d = self.state.between(a, b);
            let omega = times(1.0 / dot(d, d), cross(d, minus(velocity[b], velocity[a])));
            let f = body.centre_m() / body.length_m();
            let centre = add_times(velocity[a], f, minus(velocity[b], velocity[a]));
            for corner in [p, slot(cornered.joints[2] + 1)] {
                let arm = add_times(self.state.between(a, corner), -f, d);
                velocity[corner] = plus(centre, cross(omega, arm));
            }
        }
        self.state.velocity = velocity;
        let nothing = vec![[0.0; 3]; self.mechanism().joint_at.len()];
        self.push_slots(&nothing)
    }

    /// Push joints with impulses, N s.
    ///
    /// # Errors
    ///
    /// [`MotionError`] when they are not as many as the joints, or not finite.
    pub fn push(&mut self, impulses_n_s: &[Vector]) -> Result<()> {
        let impulses = self.mechanism().by_slot(impulses_n_s, "impulses on the joints")?;
        self.push_slots(&impulses)
    }

    fn push_slots(&mut self, impulses: &[Vector]) -> Result<()> {
        if self.contacts.is_some() {
            self.collide(&[], Some(impulses))?;
            return self.let_go(false);
        }
        let pushed = self.stepper.push(&mut self.state, impulses);
        pushed.map_err(|failure| self.told(failure, 0.0))
    }

    /// The longest step that is taken as one, s: half of what is stable for the fastest oscillation
    /// that the elastic members can have in any position. Infinite without such.
    ///
    /// ```
    /// use model::Bar;
    /// use model::system::{Joint, Member, System};
    /// use motion::{Settings, Simulation};
    ///
    /// // 2 kg on a spring of 800 N/m: 20 1/s.
    /// let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(2.0)];
    /// let spring = Member::bar(0, 1, Bar::homogeneous(1.0, 0.0)?).with_stiffness(800.0);
    /// let system = System::new("spring", 9.81, joints, vec![spring])?;
    /// let places = [[0.0; 3], [0.0, 0.0, -1.0]];
    /// let simulation = Simulation::new(&system, &places, Settings::default())?;
    /// assert!((simulation.longest_step_s() - 1.0 / 20.0).abs() < 1e-12);
    /// assert_eq!(simulation.parts_of(0.12)?, 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn longest_step_s(&self) -> f64 {
        self.longest_s
    }

    /// In how many parts a step is taken, so that none is longer than [`Self::longest_step_s`].
    ///
    /// # Errors
    ///
    /// [`MotionError::Stiff`] when they are more than ten thousand.
    pub fn parts_of(&self, step_s: f64) -> Result<u32> {
        let parts = (step_s.abs() / self.longest_s).ceil().max(1.0);
        if parts > MOST_PARTS {
            let (longest_s, most_s) = (self.longest_s, MOST_PARTS * self.longest_s);
            return Err(MotionError::Stiff { step_s, longest_s, most_s });
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 10,000")]
        Ok(parts as u32)
    }

    /// Take a step of the length `step_s`, s, in [as many parts](Self::parts_of) as elastic members
    /// need; negative steps go back in time.
    ///
    /// # Errors
    ///
    /// [`MotionError`] when the constraints cannot be met: the step is too long, or the bars lie on
    /// a taut line.
    pub fn step(&mut self, step_s: f64) -> Result<()> {
        let parts = self.parts_of(step_s)?;
        let part_s = step_s / f64::from(parts);
        for _ in 0..parts {
            if self.contacts.is_some() {
                self.step_with_impacts(part_s)?;
            } else {
                self.whole(part_s)?;
            }
        }
        Ok(())
    }

    /// A step with what holds at its beginning.
    pub(crate) fn whole(&mut self, step_s: f64) -> Result<()> {
        for k in 0..self.parts.len() {
            self.part(self.parts[k] * step_s)?;
        }
        Ok(())
    }

    /// A symmetric step of order two: half of the damping, RATTLE, half of the damping.
    fn part(&mut self, h: f64) -> Result<()> {
        self.damp(0.5 * h)?;
        let stepped = self.stepper.step(&mut self.state, &self.forces, self.time_s, h);
        stepped.map_err(|failure| self.told(failure, h))?;
        self.damp(0.5 * h)?;
        if !self.state.largest_speed().is_finite() {
            return Err(MotionError::Overflow { time_s: self.time_s, step_s: h });
        }
        self.time_s += h;
        Ok(())
    }

    fn damp(&mut self, h: f64) -> Result<()> {
        damping::damp(&self.settings, &mut self.state, &mut self.stepper, h)
            .map_err(|failure| self.told(failure, h))
    }

    fn told(&self, failure: Failure, step_s: f64) -> MotionError {
        match failure {
            Failure::NotMet { corrections, off } => MotionError::StepTooLong {
                time_s: self.time_s,
                step_s,
                iterations: corrections,
                off,
            },
            failure => at_the_beginning(self.mechanism(), failure),
        }
    }

    /// The impacts so far: when inextensible cables and struts became taut or joints met the floor,
    /// and the energy that was lost.
    ///
    /// ```
    /// use model::Bar;
    /// use model::system::{Joint, Member, System};
    /// use motion::{Settings, Simulation};
    ///
    /// // A weight of 2 kg falls from its anchor until a cable of 1 m is taut, and hangs there.
    /// let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(2.0)];
    /// let cable = Member::cable(0, 1, Bar::homogeneous(1.0, 0.0)?);
    /// let system = System::new("drop", 9.81, joints, vec![cable])?;
    /// let mut drop = Simulation::new(&system, &[[0.0; 3]; 2], Settings::default())?;
    /// for _ in 0..1000 {
    ///     drop.step(1e-3)?;
    /// }
    /// let [impact] = drop.impacts() else { panic!("one") };
    /// assert!((impact.time_s - (2.0_f64 / 9.81).sqrt()).abs() < 1e-11);
    /// assert!((impact.lost_j - 2.0 * 9.81).abs() < 1e-9);
    /// assert!((drop.joints_m()[1][2] + 1.0).abs() < 1e-12 && drop.kinetic_j() < 1e-18);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts
    }

    /// Energy that was lost in impacts so far, J.
    pub fn lost_j(&self) -> f64 {
        model::sum(self.impacts.iter().map(|impact| impact.lost_j))
    }

    /// The mechanics of the system, with what holds at the present time.
    pub fn mechanism(&self) -> &Mechanism {
        &self.stepper.mechanism
    }

    /// Time since the beginning, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Places of the joints, world frame, m.
    pub fn joints_m(&self) -> Vec<Vector> {
        let reference = self.mechanism().reference_m;
        let places = self.mechanism().by_joint(&self.state.at);
        places.into_iter().map(|x| plus(x, reference)).collect()
    }

    /// Velocities of the joints, m/s.
    pub fn velocities_m_s(&self) -> Vec<Vector> {
        self.mechanism().by_joint(&self.state.velocity)
    }

    /// Kinetic energy, J.
    pub fn kinetic_j(&self) -> f64 {
        kinetic_j(self.mechanism(), &self.state)
    }

    /// Potential energy relative to [`System::reference_m`], J; the forces of time are not in it.
    pub fn potential_j(&self) -> f64 {
        potential_j(self.mechanism(), &self.state)
    }

    /// Mechanical energy, J.
    pub fn energy_j(&self) -> f64 {
        self.kinetic_j() + self.potential_j()
    }

    /// Largest relative violation of a length, and of its derivative in units of the largest speed,
    /// after the last step.
    pub fn constraints_off(&self) -> [f64; 2] {
        self.stepper.off
    }

    /// Corrections of the places that the last step took.
    pub fn corrections(&self) -> usize {
        self.stepper.corrections
    }

    /// Everything at the present time: places, velocities, accelerations, forces, energies.
    pub fn snapshot(&mut self) -> Snapshot {
        let damping = damping::forces(self.mechanism(), &self.settings, &self.state);
        let solved = self.stepper.accelerations(&self.state, &damping.total());
        Snapshot::new(self, &solved.0, &solved.1, &damping)
    }

    /// Moments of time by member at the present time, N m.
    pub(crate) fn moments_of_time(&self) -> Vec<Vector> {
        let mut found = vec![[0.0; 3]; self.mechanism().given()[1]];
        for moment in &self.forces.moments {
            found[moment.member] = plus(found[moment.member], (moment.of_time)(self.time_s));
        }
        found
    }

    /// Forces of time by slot at the present time, N.
    pub(crate) fn forces_of_time(&self) -> Vec<Vector> {
        let mut found = vec![[0.0; 3]; self.mechanism().joint_at.len()];
        for (slot, of_time) in &self.forces.of_time {
            found[*slot] = plus(found[*slot], of_time(self.time_s));
        }
        found
    }
}

pub(crate) fn at_the_beginning(mechanism: &Mechanism, failure: Failure) -> MotionError {
    match failure {
        Failure::Singular(failed) => {
            MotionError::Redundant { joint: mechanism.name(failed.slot), pivot: failed.pivot }
        }
        Failure::NotMet { corrections, off } => {
            MotionError::NotClosed { iterations: corrections, off }
        }
        Failure::Jammed { span } => MotionError::Jammed(RunTogether {
            member: mechanism.owner(span.member) + 1,
            from: mechanism.name(span.a),
            to: mechanism.name(span.b),
        }),
    }
}
