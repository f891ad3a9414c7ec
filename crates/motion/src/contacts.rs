//! What holds on one side alone: inextensible cables and struts, and the floor.
//!
//! Each has a gap that never becomes negative, and a force that is never of the wrong sign; one of
//! the two is zero. While a gap is closed it is a constraint as others are. Where one closes with a
//! speed the impact is perfectly plastic: the velocities change by impulses of what is closed, each
//! of the right sign, so that none closes further and what pushes stays closed. With these
//! directions `R` the change is the projection of the velocities in the metric of the inertia, and
//! the energy that is lost is that of the change,
//!
//! $$ M (v^+ - v^-) = -R^T \nu, \quad R v^+ = 0, \qquad
//!    T^- - T^+ = \tfrac12 (v^+ - v^-)^T M (v^+ - v^-) \ge 0 . $$
//!
//! (J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", 1988, with the
//! coefficient of restitution zero; C. Glocker, *Set-Valued Force Laws*, Springer 2001.) A gap
//! opens again where its force would change its sign.

use model::Vector;
use model::system::{Joint, Kind, Member, Support, System};

use crate::error::{MotionError, Result};
use crate::mechanism::Mechanism;
use crate::simulation::CLOSED_TOLERANCE;
use crate::state::{State, curvature, half_excess, rate, squared};
use numerics::vector::{add_times, minus};

/// A gap that is less than this, in units of the length of its member or of all members, is closed.
pub(crate) const CLOSED: f64 = 1e-12;

/// One gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contact {
    /// An inextensible cable, rope or strut, by its number among the members, from 0.
    Member(usize),
    /// A joint above the floor, by its number, from 0.
    Floor(usize),
}

/// Gaps that closed at one time, and what that took of the energy.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// When, s.
    pub time_s: f64,
    /// What closed.
    pub closed: Vec<Contact>,
    /// Energy that was lost, J.
    pub lost_j: f64,
}

/// Whether a motion of a system may have impacts: where there are inextensible cables or struts, or
/// a floor.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
///
/// let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(2.0)];
/// let cable = Member::cable(0, 1, Bar::homogeneous(1.0, 0.0)?);
/// let [rigid, elastic] = [cable.clone(), cable.with_stiffness(1e3)]
///     .map(|cable| System::new("cable", 9.81, joints.clone(), vec![cable]));
/// assert!(motion::has_impacts(&rigid?) && !motion::has_impacts(&elastic?));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn has_impacts(system: &System) -> bool {
    Contacts::of(system).is_some()
}

/// The gaps of a system.
#[derive(Debug, Clone)]
pub(crate) struct Contacts {
    /// As given.
    system: System,
    pub list: Vec<Contact>,
    /// Which of them are closed and bear forces.
    pub holds: Vec<bool>,
}

impl Contacts {
    /// `None` for a system without gaps.
    pub(crate) fn of(system: &System) -> Option<Self> {
        let members = system.members().iter().enumerate();
        let members = members
            .filter(|(_, m)| m.kind != Kind::Bar && m.stiffness_n.is_none())
            .map(|(number, _)| Contact::Member(number));
        let joints = system.joints().iter().enumerate();
        let joints = joints
            .filter(|(_, joint)| system.floor_m().is_some() && rises(joint))
            .map(|(number, _)| Contact::Floor(number));
        let list: Vec<Contact> = members.chain(joints).collect();
        let holds = vec![false; list.len()];
        (!list.is_empty()).then(|| Self { system: system.clone(), list, holds })
    }

    /// Close what is closed at the places of a beginning, world frame, m.
    /// [`MotionError::NotClosed`] where a gap is negative by more than the rounding of printed
    /// digits.
    pub(crate) fn begin(&mut self, joints_m: &[Vector]) -> Result<()> {
        for k in 0..self.list.len() {
            let gap = self.gap_at(self.list[k], joints_m);
            if gap.is_nan() || gap < -CLOSED_TOLERANCE {
                return Err(MotionError::NotClosed { iterations: 0, off: gap.abs() });
            }
            self.holds[k] = gap <= CLOSED_TOLERANCE;
        }
        Ok(())
    }

    /// Hold what is violated at places, world frame, m; whether there is such.
    pub(crate) fn hold_negative(&mut self, joints_m: &[Vector]) -> bool {
        let mut found = false;
        for k in 0..self.list.len() {
            if !self.holds[k] && self.gap_at(self.list[k], joints_m) < -CLOSED {
                self.holds[k] = true;
                found = true;
            }
        }
        found
    }

    /// What the length of a member or the height of a joint says of a contact: a cable closes as it
    /// gets longer, a strut as it gets shorter.
    fn opening(
        &self,
        contact: Contact,
        longer: impl Fn(&Member) -> f64,
        higher: impl Fn(usize) -> f64,
    ) -> f64 {
        match contact {
            Contact::Member(number) => {
                let member = &self.system.members()[number];
                let longer = longer(member);
                if member.kind == Kind::Cable { -longer } else { longer }
            }
            Contact::Floor(joint) => higher(joint),
        }
    }

    /// How high a place is above the floor, in units of all lengths.
    fn above_floor(&self, z_m: f64) -> f64 {
        (z_m - self.system.floor_m().unwrap_or_default()) / self.system.total_length_m()
    }

    fn gap_at(&self, contact: Contact, joints_m: &[Vector]) -> f64 {
        let longer = |member: &Member| {
            let spans = member.spans().map(|[a, b]| minus(joints_m[b], joints_m[a]));
            half_excess(squared(spans), member.body.length_m())
        };
        self.opening(contact, longer, |joint| self.above_floor(joints_m[joint][2]))
    }

    /// The system with bars and supports for what holds, and nothing else in its place; ropes stay,
    /// those that do not hold without stiffness.
    pub(crate) fn held(&self) -> Result<System> {
        let supports = self.system.joints().iter().map(|joint| joint.support);
        let (mut supports, mut members): (Vec<Support>, _) =
            (supports.collect(), self.system.members().to_vec());
        for (contact, holds) in self.list.iter().zip(&self.holds) {
            match *contact {
                Contact::Member(number) if !holds => let_go(&mut members[number]),
                Contact::Floor(_) if !holds => {}
                Contact::Member(number) => hold(&mut members[number]),
                Contact::Floor(number) => {
                    let at_m = [0.0, 0.0, self.system.floor_m().unwrap_or_default()];
                    let support = supports[number];
                    if matches!(support, Support::Line { .. }) {
                        let joint = self.system.joints()[number].name.to_string();
                        return Err(MotionError::FloorEndsLine { joint });
                    }
                    supports[number] = support.on_level(at_m).unwrap_or(support);
                }
            }
        }
        self.system.on_supports(|joint, _| supports[joint], members).map_err(|error| {
            MotionError::Input { what: "what cables and the floor hold", reason: error.to_string() }
        })
    }

    /// The gaps, relative: to first order the part of the length that is missing to its end, or of
    /// all lengths to the floor.
    pub(crate) fn gaps(&self, mechanism: &Mechanism, state: &State) -> Vec<f64> {
        let longer = |member: &Member| {
            let spans = slots(member, mechanism).map(|[a, b]| state.between(a, b));
            half_excess(squared(spans), member.body.length_m())
        };
        let higher = |joint: usize| {
            self.above_floor(state.at[mechanism.slot_of[joint]][2] + mechanism.reference_m[2])
        };
        self.list.iter().map(|contact| self.opening(*contact, longer, higher)).collect()
    }

    /// How fast the gaps open, m/s.
    pub(crate) fn rates(&self, mechanism: &Mechanism, state: &State) -> Vec<f64> {
        let longer = |member: &Member| {
            rate(changing(member, mechanism, state, &state.velocity)) / member.body.length_m()
        };
        let higher = |joint: usize| state.velocity[mechanism.slot_of[joint]][2];
        self.list.iter().map(|contact| self.opening(*contact, longer, higher)).collect()
    }

    /// With which accelerations the gaps open, m/s².
    pub(crate) fn accelerations(
        &self,
        mechanism: &Mechanism,
        state: &State,
        acceleration: &[Vector],
    ) -> Vec<f64> {
        let longer = |member: &Member| {
            let along = rate(changing(member, mechanism, state, acceleration));
            let turning = curvature(changing(member, mechanism, state, &state.velocity));
            (along + turning) / member.body.length_m()
        };
        let higher = |joint: usize| acceleration[mechanism.slot_of[joint]][2];
        self.list.iter().map(|contact| self.opening(*contact, longer, higher)).collect()
    }

    /// The force or impulse of each contact that holds, positive where it is of the right sign: of
    /// the multipliers of the rows of the constraints, which for members are over their lengths.
    pub(crate) fn forces(&self, mechanism: &Mechanism, multipliers: &[f64]) -> Vec<f64> {
        let bars = mechanism.bars.iter().zip(multipliers);
        let mut by_member = vec![0.0; mechanism.system.members().len()];
        for (bar, multiplier) in bars {
            by_member[bar.member] = multiplier * bar.length_m;
        }
        let mut by_slot = vec![[0.0; 3]; mechanism.joint_at.len()];
        for (slide, multiplier) in mechanism.slides.iter().zip(&multipliers[mechanism.bars.len()..])
        {
            by_slot[slide.slot] = add_times(by_slot[slide.slot], -multiplier, slide.normal);
        }
        let force = |contact: &Contact| match *contact {
            Contact::Member(number) => {
                let pulls = self.system.members()[number].kind == Kind::Cable;
                if pulls { by_member[number] } else { -by_member[number] }
            }
            Contact::Floor(joint) => {
                let support = self.system.joints()[joint].support;
                support.upright_part(by_slot[mechanism.slot_of[joint]]).unwrap_or_default()
            }
        };
        self.list.iter().map(force).collect()
    }
}

/// Whether a joint can rise from a floor: free, or along a plane or line that is not level.
fn rises(joint: &Joint) -> bool {
    joint.support.on_level([0.0; 3]).is_some()
}

/// A member that holds: a bar, or a rope as it is.
pub(crate) fn hold(member: &mut Member) {
    if member.rope.is_none() {
        member.kind = Kind::Bar;
    }
}

/// Axial stiffness of a rope that is slack, N: it bears nothing, and couples the same joints as while it holds, so that their
/// order stays.
const LOOSE_N: f64 = f64::MIN_POSITIVE;

/// A member that is slack.
pub(crate) fn let_go(member: &mut Member) {
    if member.rope.is_some() {
        member.stiffness_n = Some(LOOSE_N);
    }
}

/// The slots of the spans of a member.
fn slots<'a>(
    member: &'a Member,
    mechanism: &'a Mechanism,
) -> impl Iterator<Item = [usize; 2]> + Clone + 'a {
    member.spans().map(|ends| ends.map(|joint| mechanism.slot_of[joint]))
}

/// The spans of a member, with the changes of them that vectors by slot make.
fn changing<'a>(
    member: &'a Member,
    mechanism: &'a Mechanism,
    state: &'a State,
    v: &'a [Vector],
) -> impl Iterator<Item = [Vector; 2]> + Clone + 'a {
    slots(member, mechanism).map(|[a, b]| [state.between(a, b), minus(v[b], v[a])])
}

#[cfg(test)]
mod tests {
    use model::Bar;

    use super::*;

    /// A cable of 2 m from an anchor 2.5 m above the floor, a strut of 4 m beside it: where P is 1.5 m from the one and
    /// 5 m from the other, half of the squares' difference over the length's square; above the floor by parts of 6 m.
    #[test]
    fn gaps_are_parts_of_lengths() {
        let joints = vec![
            Joint::anchor("A", [0.0, 0.0, 2.5]),
            Joint::free("P").with_mass(1.0),
            Joint::anchor("B", [4.0, 0.0, 4.0]),
        ];
        let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let strut = Member::bar(2, 1, body(4.0)).of_kind(Kind::Strut);
        let members = vec![Member::cable(0, 1, body(2.0)), strut];
        let system = System::new("gaps", 10.0, joints, members).unwrap().with_floor(-0.25).unwrap();
        let mut contacts = Contacts::of(&system).unwrap();
        let list = [Contact::Member(0), Contact::Member(1), Contact::Floor(1)];
        assert_eq!(contacts.list, list);
        let at = |z: f64| [[0.0, 0.0, 2.5], [0.0, 0.0, z], [4.0, 0.0, 4.0]];
        for (contact, gap) in
            list.into_iter().zip([(4.0 - 2.25) / 8.0, (25.0 - 16.0) / 32.0, 1.25 / 6.0])
        {
            let found = contacts.gap_at(contact, &at(1.0));
            assert!((found - gap).abs() < 1e-15, "{contact:?}: {found}, not {gap}");
        }
        // Along (0, 0, -1.5) and (-4, 0, -3), over 2 m and 4 m; with accelerations the square of the speed, 4.3125.
        let mechanism =
            Mechanism::for_motion(&contacts.held().unwrap(), system.reference_m()).unwrap();
        let mut state = State::at_rest(mechanism.places(&at(1.0)).unwrap());
        let slot = mechanism.slot_of[1];
        state.velocity[slot] = [0.5, -0.25, 2.0];
        assert_eq!(contacts.rates(&mechanism, &state), [1.5, -2.0, 2.0]);
        let mut acceleration = vec![[0.0; 3]; 3];
        acceleration[slot] = [1.0, 2.0, -3.0];
        assert_eq!(
            contacts.accelerations(&mechanism, &state, &acceleration),
            [-8.8125 / 2.0, 9.3125 / 4.0, -3.0]
        );
        // Multipliers of rows are over the lengths; a strut pushes.
        contacts.holds = vec![true, true, false];
        let held = Mechanism::for_motion(&contacts.held().unwrap(), system.reference_m()).unwrap();
        assert_eq!(contacts.forces(&held, &[3.0, -5.0]), [6.0, 20.0, 0.0]);
        // Below the floor by less than what may be, and by more.
        for (part, held) in [(0.5, false), (2.0, true)] {
            let below = at(-0.25 - part * CLOSED * 6.0);
            assert!(contacts.gap_at(list[2], &below) < 0.0);
            contacts.holds = vec![true, true, false];
            assert_eq!(contacts.hold_negative(&below), held, "{part}");
            assert_eq!(contacts.holds[2], held);
        }
    }

    /// With a cable of 2 m and a floor 1.8 m below its anchor: what begins closed is held, what is violated by more than
    /// rounded digits is told with its size.
    #[test]
    fn violated_contacts_are_no_beginning() {
        let joints = vec![Joint::anchor("A", [0.0, 0.0, 2.5]), Joint::free("P").with_mass(1.0)];
        let members = vec![Member::cable(0, 1, Bar::homogeneous(2.0, 0.0).unwrap())];
        let system = System::new("floor", 10.0, joints, members).unwrap().with_floor(0.7).unwrap();
        let mut contacts = Contacts::of(&system).unwrap();
        let anchor = [0.0, 0.0, 2.5];
        for (place, holds) in [
            ([0.0, 0.0, 1.0], [false, false]),
            ([2.0 + 1e-6, 0.0, 2.5], [true, false]),
            ([0.5, 0.0, 0.7 - 1e-6], [false, true]),
        ] {
            contacts.begin(&[anchor, place]).unwrap();
            assert_eq!(contacts.holds, holds, "{place:?}");
        }
        // (2.1² - 2²) / (2 · 2²), and 0.1 of a whole length of 2.
        for (place, wanted) in [([0.0, 2.1, 2.5], 0.05125), ([0.0, 0.5, 0.6], 0.05)] {
            let told = contacts.begin(&[anchor, place]);
            let Err(MotionError::NotClosed { off, .. }) = told else { panic!("{told:?}") };
            assert!((off - wanted).abs() < 1e-14, "{off}");
        }
    }
}
