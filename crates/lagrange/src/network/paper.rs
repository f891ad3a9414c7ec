//! The paper's system for any system of bars, as a checked reference.
//!
//! Each bar has the six coordinates of eq. (21) and at each of its two ends a vector of
//! multipliers, the force of the joint on the bar: eqs. (7)-(20) for any number of bars in a joint.
//! With $\mathbf{B}$ and $\mathbf{T}$ as in the paper the rows of a bar are
//! $\mathbf{B}^T\\{\lambda\\} + \mathbf{T}$, and each joint adds its own balance. It is evaluated
//! at an answer; no solver uses it.

use model::Vector;
use model::system::{Kind, Member, System, SystemEquilibrium};
use nalgebra::{DVector, Vector3};

use crate::rotation::{direction, direction_gradient};

/// Coordinates of one bar: centre of weight and three angles, eq. (21).
const PER_BAR: usize = 6;

/// The unknowns of the paper's system.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperUnknowns {
    /// $X_C, Y_C, Z_C, \psi, \theta, \varphi$ of each bar, m and rad.
    pub q: DVector<f64>,
    /// Force of the joint on each bar, at its start and at its end, N: six numbers a bar.
    pub lambda: DVector<f64>,
    /// Places of the joints, m.
    pub joints_m: Vec<Vector>,
    /// Force of the ground on each joint, N.
    pub reactions_n: Vec<Vector>,
}

impl PaperUnknowns {
    /// Of an answer; nothing when a member is not an inextensible bar.
    ///
    /// The angles are those with $\psi = 0$: every direction has some, and the spin of a bar is
    /// free.
    #[must_use]
    pub fn of(system: &System, answer: &SystemEquilibrium) -> Option<Self> {
        let rigid = |m: &Member| m.kind == Kind::Bar && m.stiffness_n.is_none();
        if !system.members().iter().all(rigid) {
            return None;
        }
        let bars = system.members().len();
        let mut q = DVector::zeros(PER_BAR * bars);
        let mut lambda = DVector::zeros(PER_BAR * bars);
        for (k, member) in system.members().iter().enumerate() {
            let start = Vector3::from(answer.joints_m[member.from]);
            let u = (Vector3::from(answer.joints_m[member.to]) - start).normalize();
            let centre = start + u * member.body.centre_m();
            let angles = Vector3::new(0.0, (-u.z).atan2(u.x), u.y.clamp(-1.0, 1.0).asin());
            let at = PER_BAR * k;
            q.fixed_rows_mut::<3>(at).copy_from(&centre);
            q.fixed_rows_mut::<3>(at + 3).copy_from(&angles);
            lambda.fixed_rows_mut::<3>(at).copy_from_slice(&answer.start_forces_n[k]);
            lambda.fixed_rows_mut::<3>(at + 3).copy_from_slice(&answer.end_forces_n[k]);
        }
        let (joints_m, reactions_n) = (answer.joints_m.clone(), answer.reactions_n.clone());
        Some(Self { q, lambda, joints_m, reactions_n })
    }
}

/// Residual of the paper's system: for each bar six rows of balance (N, and N m in those of the
/// angles) and six of constraints (m), then for each joint three of balance (N).
///
/// # Panics
///
/// When the unknowns are not those of the system.
///
/// # References
///
/// Paper, eqs. (7)-(22) and (40).
///
/// ```
/// use lagrange::network::{PaperUnknowns, Settings, paper_residual, solve};
/// use model::system::{Joint, Member, System};
/// let bar = model::Bar::homogeneous(1.0, 2.0)?;
/// let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P")];
/// let system = System::new("pendulum", 9.80665, joints, vec![Member::bar(0, 1, bar)])?;
/// let answer = solve(&system, &Settings::default())?.equilibrium;
/// let unknowns = PaperUnknowns::of(&system, &answer).expect("all members are bars");
/// assert!(paper_residual(&system, &unknowns).amax() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn paper_residual(system: &System, unknowns: &PaperUnknowns) -> DVector<f64> {
    let (bars, joints) = (system.members().len(), system.joints().len());
    let mut residual = DVector::zeros(2 * PER_BAR * bars + 3 * joints);
    let g = system.gravity_m_s2();
    let balance = 2 * PER_BAR * bars;
    for (j, joint) in system.joints().iter().enumerate() {
        let weight = Vector3::z() * (-joint.mass_kg * g);
        let ground = Vector3::from(unknowns.reactions_n[j]);
        let sum = Vector3::from(joint.force_n) + weight + ground;
        residual.fixed_rows_mut::<3>(balance + 3 * j).copy_from(&sum);
    }
    for (k, member) in system.members().iter().enumerate() {
        let at = PER_BAR * k;
        let centre = unknowns.q.fixed_rows::<3>(at).into_owned();
        let [psi, theta, phi] = [3, 4, 5].map(|angle| unknowns.q[at + angle]);
        let u = direction(psi, theta, phi);
        let (length, r) = (member.body.length_m(), member.body.centre_m());
        let mut force = Vector3::z() * (-member.body.mass_kg() * g);
        let mut lever = Vector3::zeros();
        for load in &member.loads {
            force += Vector3::from(load.force_n);
            lever += Vector3::from(load.force_n) * (load.at_m - r);
        }
        let ends = [(member.from, -r), (member.to, length - r)];
        for (end, (joint, arm)) in ends.into_iter().enumerate() {
            let lambda = unknowns.lambda.fixed_rows::<3>(at + 3 * end).into_owned();
            force += lambda;
            lever += lambda * arm;
            let gap = centre + u * arm - Vector3::from(unknowns.joints_m[joint]);
            let row = PER_BAR * bars + at + 3 * end;
            residual.fixed_rows_mut::<3>(row).copy_from(&gap);
            let mut joint_row = residual.fixed_rows_mut::<3>(balance + 3 * joint);
            joint_row -= lambda;
        }
        let moment = direction_gradient(psi, theta, phi).tr_mul(&lever);
        residual.fixed_rows_mut::<3>(at).copy_from(&force);
        residual.fixed_rows_mut::<3>(at + 3).copy_from(&moment);
    }
    residual
}
