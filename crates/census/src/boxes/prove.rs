use model::system::{Kind, System};
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::activity::{Activity, activities};
use super::arithmetic::{dot, minus};
use super::diagnosis::diagnosed;
use super::equations::Equations;
use super::floor::prove_above;
use super::frame::Frame;
use super::jam::{jammed, prove_joined};
use super::krawczyk::prove_zero;
use super::newton::refine;
use super::proven::{SystemBox, reach};
use super::turns::turns;

/// Most unknowns that the proof takes: the dense inverse and its product grow with their cube. Some
/// hundred bars in space.
pub const MAX_UNKNOWNS: usize = 640;

/// Prove that exactly one equilibrium, shape and forces, lies in a box next to an answer.
///
/// The answer (places of all joints, m, and axial forces of all members, N, tension positive) may
/// come from anywhere: it only says where to look, and which members act. Whether it lies in the
/// box is for the caller to ask ([`SystemBox::beyond_m`]).
///
/// # Errors
///
/// [`NoBox`], why there is no such proof.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// // A lamp of 2 N on bars of 5 m between anchors 6 m apart (3, 4, 5): each bar pulls with 5/4 N.
/// let joints = vec![
///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
///     Joint::anchor("B", [3.0, 0.0, 0.0]),
///     Joint::free("P").with_force([0.0, 0.125, -2.0]),
/// ];
/// let bar = Bar::homogeneous(5.0, 0.0)?;
/// let members = vec![Member::bar(0, 2, bar), Member::cable(2, 1, bar)];
/// let system = System::new("lamp", 10.0, joints, members)?;
/// // Under a side wind of 1/8 N the plane of the bars leans by the ratio 1/16.
/// let down = 4.0 / (1.0_f64 + 1.0 / 256.0).sqrt();
/// let answer = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, down / 16.0, -down]];
/// let proof = census::boxes::prove(&system, &answer, &[1.25, 1.25])?;
/// assert!(proof.beyond_m(&answer) < 1e-15 && proof.width_m < 1e-14 && proof.turns == 0);
/// // |load| 5/(2 · 4) with the load's size 2 (1 + 1/256)^1/2.
/// let axial_n = 1.25 * (1.0_f64 + 1.0 / 256.0).sqrt();
/// assert!(proof.beyond_n(&[axial_n; 2]) < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prove(system: &System, joints_m: &[Point], axial_n: &[f64]) -> Result<SystemBox, NoBox> {
    let finite = joints_m.iter().flatten().chain(axial_n).all(|x| x.is_finite());
    let fits = joints_m.len() == system.joints().len() && axial_n.len() == system.members().len();
    if !(finite && fits) {
        return Err(NoBox::NotFinite);
    }
    let jams = jammed(system, joints_m, axial_n);
    match system.floor_m() {
        _ if !jams.is_empty() => prove_joined(system, &jams, joints_m, axial_n),
        None => prove_without_floor(system, joints_m, axial_n),
        Some(floor_m) => prove_above(system, floor_m, joints_m, axial_n),
    }
}

/// The same for the joints and members alone.
pub(super) fn prove_without_floor(
    system: &System,
    joints_m: &[Point],
    axial_n: &[f64],
) -> Result<SystemBox, NoBox> {
    let Posed { equations, activities, loose } = Posed::new(system, joints_m, axial_n)?;
    let start = equations.start(joints_m, axial_n);
    let zero = refine(&equations, &start)
        .and_then(|refined| prove_zero(&equations, &refined))
        .map_err(|failure| diagnosed(&equations, &start, failure))?;
    complementarity(system, &equations, &activities, &zero)?;
    Ok(SystemBox::new(system, &equations, &activities, &loose, &zero))
}

/// The equations next to an answer.
pub(super) struct Posed {
    pub(super) equations: Equations,
    pub(super) activities: Vec<Activity>,
    pub(super) loose: Vec<bool>,
}

impl Posed {
    pub(super) fn new(system: &System, joints_m: &[Point], axial_n: &[f64]) -> Result<Self, NoBox> {
        Self::within(system, Frame::new(system, axial_n), joints_m, axial_n, MAX_UNKNOWNS)
    }

    /// In these units, with so many unknowns at most.
    pub(super) fn within(
        system: &System,
        frame: Frame,
        joints_m: &[Point],
        axial_n: &[f64],
        limit: usize,
    ) -> Result<Self, NoBox> {
        let activities = activities(system, &frame, joints_m, axial_n)?;
        let loose = loose_joints(system, &activities);
        let held: Vec<bool> = system
            .joints()
            .iter()
            .zip(&loose)
            .map(|(joint, loose)| *loose || joint.support.is_fixed())
            .collect();
        let unknowns = unknowns(system, &activities, &held);
        if unknowns > limit {
            return Err(NoBox::TooLarge { unknowns, limit });
        }
        let turns = turns(system, &activities, joints_m, &held);
        let equations = Equations::new(system, frame, &activities, &turns, joints_m, &held);
        Ok(Self { equations, activities, loose })
    }
}

/// Coordinates of joints and forces.
fn unknowns(system: &System, activities: &[Activity], held: &[bool]) -> usize {
    let moving = system.joints().iter().zip(held).filter(|(_, held)| !**held);
    let coordinates: usize = moving.map(|(joint, _)| joint.support.motions().len()).sum();
    coordinates + activities.iter().filter(|activity| **activity == Activity::Acts).count()
}

/// Joints that can move, that no load acts on, and none of whose members acts.
fn loose_joints(system: &System, activities: &[Activity]) -> Vec<bool> {
    let still = |force: Point| force.iter().all(|x| x.abs() <= 0.0);
    let mut loose: Vec<bool> = system
        .joints()
        .iter()
        .map(|joint| !joint.support.is_fixed() && joint.mass_kg <= 0.0 && still(joint.force_n))
        .collect();
    for (member, activity) in system.members().iter().zip(activities) {
        let body = &member.body;
        let unloaded =
            |far: f64| body.mass_kg() <= 0.0 || body.centre_m().to_bits() == far.to_bits();
        let slack = *activity == Activity::Slack && member.loads.is_empty();
        for joint in member.path() {
            loose[joint] &= slack;
        }
        loose[member.from] &= unloaded(body.length_m());
        loose[member.to] &= unloaded(0.0);
    }
    loose
}

/// Prove the signs: cables that act pull, struts push, the others are slack, and no free turn is
/// held by a force.
pub(super) fn complementarity(
    system: &System,
    equations: &Equations,
    activities: &[Activity],
    zero: &[Interval],
) -> Result<(), NoBox> {
    let places = equations.places(zero);
    for acting in &equations.acting {
        let sign = zero[acting.force].sign();
        let right = match system.members()[acting.member].kind {
            Kind::Bar => true,
            Kind::Cable => sign == Some(1),
            Kind::Strut => sign == Some(-1),
        };
        if !right {
            return Err(NoBox::WrongSign { member: acting.member + 1 });
        }
    }
    for (k, member) in system.members().iter().enumerate() {
        let (length, distance) = (equations.lengths[k], reach(member, &places));
        let slack = match member.kind {
            Kind::Bar => false,
            Kind::Cable => distance.hi() < length.lo(),
            Kind::Strut => distance.lo() > length.hi(),
        };
        match activities[k] {
            Activity::Slack if !slack => return Err(NoBox::NotSlack { member: k + 1 }),
            Activity::Idle if !slack && member.stiffness_n.is_none() => {
                return Err(NoBox::BetweenAnchors { member: k + 1 });
            }
            _ => {}
        }
    }
    for hold in &equations.holds {
        let arm = minus(places[hold.arm], places[hold.centre]);
        let [x, y, _] = hold.across;
        // The arm is normal to `across`; its part along the normal of that must not vanish.
        if dot([y, -x, Interval::ZERO], arm).contains(0.0) {
            return Err(NoBox::NotContracting);
        }
    }
    Ok(())
}
