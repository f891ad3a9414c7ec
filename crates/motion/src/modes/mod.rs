//! Small oscillations about an equilibrium.
//!
//! With force densities `ρ_e` the Lagrangian's second derivative is, for rigid members, the same
//! weighted graph Laplacian for each axis; members with a stiffness add their own. On the
//! displacements `y` that keep the lengths to first order (`R y = 0`):
//!
//! $$ K y = \omega^2 M y, \qquad
//!    K = \sum_e \begin{bmatrix} 1 & -1 \\ -1 & 1 \end{bmatrix} \otimes
//!        \left( \rho_e I + k_e' u_e u_e^T \right) . $$
//!
//! `ω² > 0` oscillates with the angular frequency `ω`; `ω² < 0` leaves the equilibrium like `exp(t
//! √(−ω²))`; there are as many of these as the Morse index says.

mod dense;
mod planes;
mod shape;

use model::Vector;
use model::system::System;

use crate::error::MotionError;
use crate::force;
use crate::mechanism::Mechanism;
use crate::rattle::Stepper;
use crate::state::State;
use crate::vector::{add_times, dot, norm, plus, times, worse};
use dense::Stiffness;

pub use planes::Direction;

/// The modes of an equilibrium, ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// The modes, by ascending `ω²`.
    pub modes: Vec<Mode>,
    /// Largest force left over at a joint, relative to the largest force.
    pub out_of_balance: f64,
}

/// One mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// `ω²`, 1/s²; what is rounding is exactly zero.
    pub omega2_s2: f64,
    /// Displacement of each joint, world frame, scaled so that the largest has the length 1.
    pub shape: Vec<Vector>,
    /// What it is.
    pub what: What,
    /// Which way the joints move.
    pub direction: Direction,
}

/// What a mode is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum What {
    /// `ω² > 0`: an oscillation.
    Oscillation,
    /// `ω² < 0`: it leaves the equilibrium.
    Leaving,
    /// `ω² = 0`: a part turns about the vertical at this `[x, y]`, m, through its supports.
    Turn {
        /// Where the vertical stands.
        axis_m: [f64; 2],
    },
    /// `ω² = 0` for another reason.
    Neutral,
}

impl Mode {
    /// Frequency of an oscillation, Hz.
    #[must_use]
    pub fn frequency_hz(&self) -> Option<f64> {
        (self.what == What::Oscillation).then(|| self.omega2_s2.sqrt() / std::f64::consts::TAU)
    }

    /// Rate at which the system leaves the equilibrium, 1/s.
    #[must_use]
    pub fn rate_1_s(&self) -> Option<f64> {
        (self.what == What::Leaving).then(|| (-self.omega2_s2).sqrt())
    }
}

impl Modes {
    /// Number of modes in which the energy falls (the Morse index).
    #[must_use]
    pub fn index(&self) -> usize {
        self.modes.iter().filter(|mode| mode.what == What::Leaving).count()
    }

    /// Number of modes without any change of the energy to second order.
    #[must_use]
    pub fn neutral(&self) -> usize {
        let zero = |what: &What| matches!(what, What::Turn { .. } | What::Neutral);
        self.modes.iter().filter(|mode| zero(&mode.what)).count()
    }
}

/// Most joints that move: a thousand coordinates take some ten seconds.
const MOST_JOINTS: usize = 350;

/// Largest violation of a length, relative, in an equilibrium.
const LENGTHS: f64 = 1e-8;

/// Largest force left over in an equilibrium, relative to the largest force in the system.
const BALANCE: f64 = 1e-7;

/// The modes of a system about an equilibrium, given by the places of its joints, world frame, m.
///
/// Where rigid members and supports determine their forces, these are found here. Where they do not
/// (a member too many), the axial forces of the equilibrium are needed: `axial_n` by member, N,
/// tension positive.
///
/// All modes are found, by dense linear algebra: the time grows with the cube of the number of
/// joints.
///
/// # Errors
///
/// [`MotionError`] when the system cannot be moved here or is too large, the places are no
/// equilibrium, or forces are needed and not given.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
///
/// // A homogeneous bar of 1 m: ω² = 3/2 g/l, in every direction.
/// let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P")];
/// let bar = Bar::homogeneous(1.0, 3.0)?;
/// let system = System::new("rod", 9.81, joints, vec![Member::bar(0, 1, bar)])?;
/// let found = motion::modes(&system, &[[0.0; 3], [0.0, 0.0, -1.0]], None)?;
/// assert_eq!(found.modes.len(), 2);
/// assert!(found.modes.iter().all(|mode| (mode.omega2_s2 - 1.5 * 9.81).abs() < 1e-13));
/// // Upright it falls at the same rate.
/// let upright = motion::modes(&system, &[[0.0; 3], [0.0, 0.0, 1.0]], None)?;
/// assert_eq!(upright.index(), 2);
/// assert!((upright.modes[0].omega2_s2 + 1.5 * 9.81).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn modes(
    system: &System,
    joints_m: &[Vector],
    axial_n: Option<&[f64]>,
) -> Result<Modes, MotionError> {
    let mechanism = Mechanism::new(system)?;
    if mechanism.moving > MOST_JOINTS {
        return Err(MotionError::TooLarge { joints: mechanism.moving, most: MOST_JOINTS });
    }
    let state = State::at_rest(mechanism.places(joints_m)?);
    let mut vectors = vec![[0.0; 3]; mechanism.constraints()];
    let off = state.rows(&mechanism, &mut vectors);
    if off.is_nan() || off > LENGTHS {
        return Err(MotionError::NotClosed { iterations: 0, off });
    }
    let densities = densities(&mechanism, &state, axial_n)?;
    let out_of_balance = balance(&mechanism, &state, &vectors, &densities)?;
    let stiffness = Stiffness::new(&mechanism, &state, &vectors, densities);
    let mut modes = Vec::new();
    for sector in planes::sectors(&mechanism, &state) {
        let solved = stiffness.solve(&sector);
        modes.extend(shape::modes(&mechanism, &state, &sector, &solved));
    }
    modes.sort_by(|a, b| a.omega2_s2.total_cmp(&b.omega2_s2));
    Ok(Modes { modes, out_of_balance })
}

/// Force densities of the rigid bars, N/m.
fn densities(
    mechanism: &Mechanism,
    state: &State,
    axial_n: Option<&[f64]>,
) -> Result<Vec<f64>, MotionError> {
    let mut stepper = Stepper::new(mechanism)?;
    let forces = force::Forces { of_time: Vec::new() };
    match stepper.arrive(mechanism, state, &forces, 0.0) {
        Ok(()) => {
            let nothing = vec![[0.0; 3]; mechanism.joint_at.len()];
            let (_, mut rho) = stepper.accelerations(mechanism, state, &nothing);
            rho.truncate(mechanism.bars.len());
            Ok(rho)
        }
        Err(failure) => {
            let refused = crate::simulation::at_the_beginning(mechanism, failure);
            let axial_n = axial_n.ok_or(refused)?;
            if axial_n.len() != mechanism.system.members().len() {
                let reason = format!(
                    "{} given for {} members",
                    axial_n.len(),
                    mechanism.system.members().len()
                );
                return Err(MotionError::Input { what: "axial forces", reason });
            }
            let bars = mechanism.bars.iter();
            Ok(bars.map(|link| axial_n[link.member] / link.length_m).collect())
        }
    }
}

/// Largest force left over at a joint, relative to the largest force.
fn balance(
    mechanism: &Mechanism,
    state: &State,
    vectors: &[Vector],
    densities: &[f64],
) -> Result<f64, MotionError> {
    let mut left = mechanism.load.clone();
    let mut unit_n = left.iter().map(|f| norm(*f)).fold(0.0, worse);
    let rigid = mechanism.bars.iter().zip(vectors).zip(densities);
    let rigid = rigid.map(|((link, d), rho)| (link, times(*rho, *d)));
    let springs = mechanism.springs.iter().map(|spring| {
        let d = state.between(spring.link.a, spring.link.b);
        (&spring.link, times(spring.force_density(norm(d)), d))
    });
    for (link, pull) in rigid.chain(springs) {
        left[link.a] = plus(left[link.a], pull);
        left[link.b] = add_times(left[link.b], -1.0, pull);
        unit_n = worse(unit_n, norm(pull));
    }
    for slide in &mechanism.slides {
        let f = left[slide.slot];
        left[slide.slot] = add_times(f, -dot(f, slide.normal), slide.normal);
    }
    let sizes = left[..mechanism.moving].iter().map(|f| norm(*f));
    let (slot, off) = sizes.enumerate().fold((0, 0.0_f64), |most, (slot, size)| {
        if size.is_nan() || size > most.1 { (slot, size) } else { most }
    });
    let off = if unit_n > 0.0 { off / unit_n } else { off };
    if off.is_nan() || off > BALANCE {
        return Err(MotionError::NotInBalance { joint: mechanism.name(slot), off });
    }
    Ok(off)
}
