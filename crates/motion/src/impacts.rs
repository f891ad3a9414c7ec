//! Steps over impacts: what closes within a step, and what opens at its end.
//!
//! A step is taken with what holds at its beginning. If a gap is negative at its end, the time at
//! which the first one closes is looked for by shorter steps from the same beginning; there the
//! impact takes its part of the velocities, and the rest of the step follows. What would have to
//! hold with a force of the wrong sign at the end of a step is let go: within the step that force
//! is small with the step, and so the error is of the second order as that of the step is.
//!
//! Two gaps may close in turn, each impact opening the other a little, without end in a finite
//! time. After [`IN_TURN`] impacts in a step gaps that hardly move are closed together.

use model::Vector;

use crate::contacts::{CLOSED, Contacts, Impact};
use crate::damping;
use crate::error::{MotionError, Result};
use crate::mechanism::Mechanism;
use crate::rattle::Stepper;
use crate::simulation::Simulation;
use crate::state::State;
use numerics::vector::{norm, worse};

/// Impacts in one step after which it is given up: they follow each other ever faster.
const MOST_IMPACTS: usize = 200;

/// Impacts in one step after which gaps that hardly move are closed together, and what that is: the
/// gap, relative, and its speed in units of the largest. The energy that this takes is some 1e-8 of
/// that of the motion, and told as that of an impact.
const IN_TURN: usize = 6;
const HARDLY_OPEN: f64 = 1e-10;
const HARDLY_MOVES: f64 = 1e-4;

/// Shortest part of a step that is taken: velocities are displacements over times, and lose their
/// digits in shorter ones. Nearer to an end of a step an impact is at that end.
const SHORTEST: f64 = 1e-6;

/// Shorter steps from the beginning of a step until its impact is found: a secant doubles the
/// digits, and two middles of three halve what is left.
const MOST_ATTEMPTS: usize = 100;

/// Forces and speeds that are less than this, in units of all loads and of the largest speed, are
/// rounding of zero.
const NOTHING: f64 = 1e-12;

/// Speeds and accelerations of gaps that are less than this, in units of the largest of joints or of their free fall, are
/// what the velocities and constraints of a step leave.
const STILL: f64 = 1e-10;

impl Simulation {
    /// A step, with the impacts in it.
    pub(crate) fn step_with_impacts(&mut self, step_s: f64) -> Result<()> {
        if step_s < 0.0 {
            let reason = "what is lost in impacts does not come back".to_owned();
            return Err(MotionError::Input { what: "a step back in time", reason });
        }
        let mut left_s = step_s;
        for impacts in 1..=MOST_IMPACTS {
            let before = (self.state.clone(), self.time_s);
            self.whole(left_s)?;
            let Some((at_s, closing)) = self.first_closing(&before, left_s, step_s)? else {
                return self.let_go(false);
            };
            self.collide(&closing, None)?;
            self.let_go(impacts > IN_TURN)?;
            left_s -= at_s;
            if left_s <= 0.0 {
                return Ok(());
            }
        }
        Err(self.too_many(step_s))
    }

    /// The first gap that closes in a step that has been taken, and when in it: the motion is there
    /// then. None where no gap is negative.
    fn first_closing(
        &mut self,
        before: &(State, f64),
        left_s: f64,
        step_s: f64,
    ) -> Result<Option<(f64, Vec<usize>)>> {
        let mut high = (left_s, self.least_gap());
        if high.1 >= -CLOSED {
            return Ok(None);
        }
        self.go_back(before)?;
        let mut low = (0.0, self.least_gap());
        let shortest_s = SHORTEST * step_s;
        for attempt in 0..MOST_ATTEMPTS {
            let secant = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
            // Every third time the middle, so that the bracket gets shorter from both sides.
            let is_secant = attempt % 3 < 2 && secant > low.0 && secant < high.0;
            let at_s = if is_secant { secant } else { f64::midpoint(low.0, high.0) };
            if at_s <= low.0 || at_s >= high.0 || high.0 <= shortest_s {
                break;
            }
            self.go_back(before)?;
            self.whole(at_s)?;
            let least = self.least_gap();
            let is_closing = !self.closing().is_empty();
            if least.abs() <= CLOSED && is_closing {
                high = (at_s, least);
                break;
            }
            // What has just been let go has no gap, and opens.
            *(if least < 0.0 && is_closing { &mut high } else { &mut low }) = (at_s, least);
        }
        let is_at_end = left_s - high.0 <= shortest_s;
        let at_s = if is_at_end { left_s } else { high.0.max(shortest_s) };
        self.go_back(before)?;
        self.whole(at_s)?;
        Ok(Some((at_s, self.closing())))
    }

    /// The least gap of what does not hold.
    fn least_gap(&self) -> f64 {
        let Some(contacts) = &self.contacts else { return f64::INFINITY };
        let gaps = contacts.gaps(self.mechanism(), &self.state);
        let open = gaps.into_iter().zip(&contacts.holds).filter(|(_, holds)| !**holds);
        open.map(|(gap, _)| gap).fold(f64::INFINITY, f64::min)
    }

    /// What does not hold, has no gap, and closes.
    fn closing(&self) -> Vec<usize> {
        let Some(contacts) = &self.contacts else { return Vec::new() };
        let gaps = contacts.gaps(self.mechanism(), &self.state);
        let rates = contacts.rates(self.mechanism(), &self.state);
        let is_closing = |k: &usize| !contacts.holds[*k] && gaps[*k] <= CLOSED && rates[*k] < 0.0;
        (0..gaps.len()).filter(is_closing).collect()
    }

    fn go_back(&mut self, (state, time_s): &(State, f64)) -> Result<()> {
        self.state.clone_from(state);
        self.time_s = *time_s;
        self.arrive()
    }

    fn arrive(&mut self) -> Result<()> {
        let arrived = self.stepper.arrive(&self.state, &self.forces, self.time_s);
        self.stepper.told(arrived)
    }

    /// Change what holds.
    fn hold(&mut self, contacts: &Contacts) -> Result<()> {
        let reference_m = self.mechanism().reference_m;
        self.stepper = Stepper::new(Mechanism::for_motion(&contacts.held()?, reference_m)?)?;
        self.arrive()
    }

    /// The plastic impact of what closes, with what holds; or a push, N s by slot, under them.
    pub(crate) fn collide(&mut self, closing: &[usize], push: Option<&[Vector]>) -> Result<()> {
        let Some(mut contacts) = self.contacts.take() else { return Ok(()) };
        let energy_j = self.energy_j();
        let solved = self.impulses(&mut contacts, closing, push);
        if solved.is_ok() && push.is_none() {
            let closed: Vec<_> =
                closing.iter().filter(|&&k| contacts.holds[k]).map(|&k| contacts.list[k]).collect();
            let lost_j = energy_j - self.energy_j();
            self.impacts.push(Impact { time_s: self.time_s, closed, lost_j });
        }
        self.contacts = Some(contacts);
        solved
    }

    /// Find which of what is closed bears an impulse, and change the velocities.
    fn impulses(
        &mut self,
        contacts: &mut Contacts,
        closing: &[usize],
        push: Option<&[Vector]>,
    ) -> Result<()> {
        let held = contacts.holds.clone();
        let closed = |k: usize| held[k] || closing.contains(&k);
        for (k, holds) in contacts.holds.iter_mut().enumerate() {
            *holds = closed(k);
        }
        self.hold(contacts)?;
        if !closing.is_empty() {
            let assembled = self.stepper.assemble(&mut self.state, 20);
            self.stepper.told(assembled)?;
            self.arrive()?;
        }
        let nothing = vec![[0.0; 3]; self.mechanism().joint_at.len()];
        let push = push.unwrap_or(&nothing);
        let (before, speed) = (self.state.velocity.clone(), self.state.largest_speed());
        // One goes or comes at a time: each choice of what bears is seen once if the impulses are
        // determined at all.
        for _ in 0..=4 * held.len() {
            let multipliers = self.stepper.impulses(&self.state, push);
            let impulses = contacts.forces(self.mechanism(), &multipliers);
            if let Some(k) = most_wrong(&contacts.holds, &impulses) {
                contacts.holds[k] = false;
                self.hold(contacts)?;
                continue;
            }
            let pushed = self.stepper.push(&mut self.state, push);
            self.stepper.told(pushed)?;
            let rates = contacts.rates(self.mechanism(), &self.state);
            // What an impact stops is left with the rounding of its speed.
            let least = -NOTHING * speed.max(self.state.largest_speed());
            let back = (0..held.len())
                .filter(|&k| closed(k) && !contacts.holds[k] && rates[k] < least)
                .min_by(|&i, &j| rates[i].total_cmp(&rates[j]));
            let Some(back) = back else { return Ok(()) };
            self.state.velocity.clone_from(&before);
            contacts.holds[back] = true;
            self.hold(contacts)?;
        }
        Err(self.too_many(0.0))
    }

    /// Let go of what would have to hold with a force of the wrong sign.
    pub(crate) fn let_go(&mut self, in_turn: bool) -> Result<()> {
        let Some(mut contacts) = self.contacts.take() else { return Ok(()) };
        let energy_j = self.energy_j();
        let done = self.let_go_of(&mut contacts, in_turn);
        self.contacts = Some(contacts);
        let lost_j = energy_j - self.energy_j();
        if let (true, Some(impact)) = (in_turn, self.impacts.last_mut()) {
            impact.lost_j += lost_j;
        }
        done
    }

    /// What is closed and stays closed by the velocities bears a force of the right sign, or opens
    /// with its acceleration: one goes or comes at a time until both are so.
    fn let_go_of(&mut self, contacts: &mut Contacts, in_turn: bool) -> Result<()> {
        let unit_n: f64 = self.mechanism().load.iter().map(|f| norm(*f)).sum();
        let gaps = contacts.gaps(self.mechanism(), &self.state);
        let rates = contacts.rates(self.mechanism(), &self.state);
        let (gap, rate) = if in_turn { (HARDLY_OPEN, HARDLY_MOVES) } else { (CLOSED, STILL) };
        let still = rate * self.state.largest_speed();
        let fall = self.mechanism().load.iter().zip(&self.mechanism().mass);
        let fall = fall.filter(|(_, mass)| **mass > 0.0).map(|(load, mass)| norm(*load) / mass);
        let fall = fall.fold(0.0, f64::max);
        let stays = |k: usize| gaps[k] <= gap && rates[k].abs() <= still;
        let closed: Vec<bool> = (0..gaps.len()).map(|k| contacts.holds[k] || stays(k)).collect();
        for _ in 0..=4 * closed.len() {
            if !closed.contains(&true) {
                return Ok(());
            }
            let damping = damping::forces(self.mechanism(), &self.settings, &self.state);
            let (acceleration, rho) = self.stepper.accelerations(&self.state, &damping.total());
            let forces = contacts.forces(self.mechanism(), &rho);
            let wrong = most_wrong(&contacts.holds, &forces);
            if let Some(k) = wrong.filter(|&k| forces[k] < -NOTHING * unit_n) {
                contacts.holds[k] = false;
                self.hold(contacts)?;
                continue;
            }
            // What is held still has the rounding of its free fall.
            let largest = acceleration.iter().map(|a| norm(*a)).fold(fall, worse);
            let opening = contacts.accelerations(self.mechanism(), &self.state, &acceleration);
            let back = (0..closed.len())
                .filter(|&k| closed[k] && !contacts.holds[k] && opening[k] < -STILL * largest)
                .min_by(|&i, &j| opening[i].total_cmp(&opening[j]));
            if let Some(back) = back {
                contacts.holds[back] = true;
                self.hold(contacts)?;
                continue;
            }
            if in_turn {
                let nothing = vec![[0.0; 3]; self.mechanism().joint_at.len()];
                let pushed = self.stepper.push(&mut self.state, &nothing);
                self.stepper.told(pushed)?;
            }
            return Ok(());
        }
        Err(self.too_many(0.0))
    }

    fn too_many(&self, step_s: f64) -> MotionError {
        MotionError::Impacts { time_s: self.time_s, step_s, most: MOST_IMPACTS }
    }
}

/// Of what holds that with the most negative force, if one is negative.
fn most_wrong(holds: &[bool], forces: &[f64]) -> Option<usize> {
    let wrong = (0..holds.len()).filter(|&k| holds[k] && forces[k] < 0.0);
    wrong.min_by(|&i, &j| forces[i].total_cmp(&forces[j]))
}
