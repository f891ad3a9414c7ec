//! Positions that meet the constraints, near a guess or at random.

use model::Vector;
use model::system::{Joint, Kind, Support, System};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::contacts::Contacts;
use crate::error::{MotionError, Result};
use crate::force::Forces;
use crate::mechanism::Mechanism;
use crate::rattle::Stepper;
use crate::state::State;
use numerics::vector::{add_times, dot, minus, norm, plus, times};

/// Corrections of a guess: far ones move at most [`Stepper::LARGEST_CORRECTION`] of a bar each.
const MOST_CORRECTIONS: usize = 400;

/// Random guesses after which no position is found.
const GUESSES: u64 = 50;

/// The position that a guess leads to by corrections that are least in the metric of the inertia:
/// places of the joints, world frame, m. Inextensible cables and struts and the floor take part in
/// it where the guess, corrected without them, would violate them.
///
/// # Errors
///
/// [`MotionError`] when the system cannot be moved here, or the corrections do not end.
///
/// ```
/// let system = model::system::System::from(model::cases::paper().chain());
/// // Roughly the paper's chain; its bars are 1 m long.
/// let guess = [[0.0; 3], [0.0, 0.3, -0.9], [0.0, 0.9, -1.7], [0.0, 0.0, -2.0]];
/// let at = motion::assemble(&system, &guess)?;
/// for pair in at.windows(2) {
///     let d: Vec<f64> = (0..3).map(|k| pair[1][k] - pair[0][k]).collect();
///     assert!((d.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-13);
/// }
/// # Ok::<(), motion::MotionError>(())
/// ```
pub fn assemble(system: &System, guess_m: &[Vector]) -> Result<Vec<Vector>> {
    let Some(mut contacts) = Contacts::of(system) else { return closed(system, guess_m) };
    // What cannot hold where it is has to hold, until all that does not has room.
    for _ in 0..=contacts.list.len() {
        let at = closed(&contacts.held()?, guess_m)?;
        if !contacts.hold_negative(&at) {
            return Ok(at);
        }
    }
    Err(MotionError::NotClosed { iterations: contacts.list.len(), off: f64::NAN })
}

/// A position at random: the same for the same seed. Members point anywhere from the joints they
/// hang on, inextensible cables and struts with some slack, and loops are closed by [`assemble`].
///
/// # Errors
///
/// [`MotionError`] when the system cannot be moved here, or no guess of fifty can be closed.
pub fn random_position(system: &System, seed: u64) -> Result<Vec<Vector>> {
    let mut failed = MotionError::NotClosed { iterations: 0, off: f64::NAN };
    for stream in 0..GUESSES {
        match assemble(system, &guess(system, seed, stream)) {
            Ok(at) => return Ok(at),
            Err(error) => failed = error,
        }
    }
    Err(failed)
}

/// Places at random: the same for the same seed. Members point anywhere from the joints they hang
/// on, inextensible cables and struts with some slack; loops are not closed.
///
/// ```
/// let system = model::system::System::from(model::cases::paper().chain());
/// let at = motion::random_places(&system, 7);
/// // Joint 1 is a bar of 1 m away from the anchor, the last one is the other anchor.
/// assert!((at[1].iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-14);
/// assert_eq!((at[3], at == motion::random_places(&system, 8)), ([0.0, 0.0, -2.0], false));
/// ```
pub fn random_places(system: &System, seed: u64) -> Vec<Vector> {
    guess(system, seed, 0)
}

/// The same with what holds; inextensible cables and struts that are left are slack.
fn closed(system: &System, guess_m: &[Vector]) -> Result<Vec<Vector>> {
    let mut stepper = Stepper::new(Mechanism::for_places(system)?)?;
    let mut state = State::at_rest(stepper.mechanism.places(guess_m)?);
    let assembled = stepper.assemble(&mut state, MOST_CORRECTIONS);
    stepper.told(assembled)?;
    // A position where forces are indeterminate is no beginning.
    let arrived = stepper.arrive(&state, &Forces::default(), 0.0);
    stepper.told(arrived)?;
    Ok(world(&stepper.mechanism, &state))
}

fn world(mechanism: &Mechanism, state: &State) -> Vec<Vector> {
    let reference = mechanism.reference_m;
    mechanism.by_joint(&state.at).into_iter().map(|x| plus(x, reference)).collect()
}

/// Joints one after the other, each at the length of a member from one that is placed.
fn guess(system: &System, seed: u64, stream: u64) -> Vec<Vector> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(stream);
    let random = &mut generator;
    let joints = system.joints();
    // A plane leaves nearly all open: its joints hang on others, as those that are free.
    let begins = |joint: &Joint| {
        let in_plane = matches!(joint.support, Support::Plane { .. });
        joint.support.at_m().filter(|_| !in_plane)
    };
    let mut at: Vec<Option<Vector>> = joints.iter().map(begins).collect();
    let mut members = vec![Vec::new(); joints.len()];
    for member in system.members() {
        let length_m = member.body.length_m() / member.spans().count() as f64;
        // Slack by some part of the length, none more likely than another.
        let length_m = match (member.stiffness_n, member.kind) {
            (None, Kind::Cable) => length_m * random.random_range(0.0..1.0),
            (None, Kind::Strut) => length_m * random.random_range(1.0..2.0),
            _ => length_m,
        };
        for [a, b] in member.spans() {
            members[a].push((b, length_m));
            members[b].push((a, length_m));
        }
    }
    let mut open: Vec<usize> = (0..joints.len()).filter(|&joint| at[joint].is_some()).collect();
    if open.is_empty() {
        at[0] = Some([0.0; 3]);
        open.push(0);
    }
    let mut next = 0;
    while let Some(&joint) = open.get(next) {
        next += 1;
        for &(other, length_m) in &members[joint] {
            if let (None, Some(here)) = (at[other], at[joint]) {
                at[other] = Some(add_times(here, length_m, direction(random)));
                open.push(other);
            }
        }
    }
    let slid = joints.iter().zip(at).map(|(joint, at)| {
        let along = random.random_range(-1.0..1.0);
        let at = at.unwrap_or_default();
        match joint.support {
            // Somewhere on its support, not where the file happens to name a point of it.
            Support::Line { direction, .. } => add_times(at, along, direction),
            Support::Plane { at_m, normal } => add_times(at, dot(minus(at_m, at), normal), normal),
            _ => at,
        }
    });
    slid.collect()
}

/// A direction, all equally likely.
fn direction(random: &mut ChaCha8Rng) -> Vector {
    loop {
        let v: Vector = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        let size = norm(v);
        if size > 0.1 && size <= 1.0 {
            return times(1.0 / size, v);
        }
    }
}
