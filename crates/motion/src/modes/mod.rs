//! Small oscillations about an equilibrium.
//!
//! With force densities `ρ_e` the Lagrangian's second derivative is, for rigid members, the same
//! weighted graph Laplacian for each axis; members with a stiffness add their own. On the
//! displacements `y` that keep the lengths to first order (`R y = 0`):
//!
//! $$ K y = \omega^2 M y, \qquad
//!    K = \sum_e \begin{bmatrix} 1 & -1 \\\\ -1 & 1 \end{bmatrix} \otimes
//!        \left( \rho_e I + k_e' u_e u_e^T \right) . $$
//!
//! Ropes do so in each span, `ρ_e` the tension over its length, less what is along it, and resist the
//! change of the sum of their spans: where they are inextensible it is a row of `R`, elsewhere `K` has
//! `EA/L` times the product of its gradient with itself.
//!
//! `ω² > 0` oscillates with the angular frequency `ω`; `ω² < 0` leaves the equilibrium like `exp(t
//! √(−ω²))`; there are as many of these as the Morse index says.
//!
//! Inextensible cables that pull and struts that push are bars in small motions, slack ones have
//! their inertia alone; joints that a floor pushes slide in its level. Bars whose moments across
//! differ have their second axis level, and spins are apart.
//!
//! Where rigid members leave self-stresses `σ`, lengths bind motions to second order: `yᵀ K(σ) y = 0` for all of
//! them. Braces of what moves as one do no such work; those of a flat panel keep it flat, as one of their sums has a
//! `K(σ)` that is positive on all other motions. Where none has, as on bars folded into one line, or a cable slackens to
//! either side, motions are no linear space and there are no modes.

mod balance;
mod dense;
pub(crate) mod lanczos;
mod lowest;
mod planes;
mod shape;
mod shifted;
mod solved;
mod stiffness;

use model::Vector;
use model::system::System;
use nalgebra::DMatrix;

use crate::error::{MotionError, Result};
use crate::force;
use crate::mechanism::Mechanism;
use crate::rattle::{Stepper, no_jam};
use crate::simulation::at_the_beginning;
use crate::state::State;
use crate::unilateral::{LENGTHS, check_forces, check_pushes, inextensible, with_what_holds};
use planes::Sector;
use solved::Solved;
use stiffness::Stiffness;

pub(crate) use balance::LeftOver;
pub use planes::Direction;

/// The modes of an equilibrium, ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// The modes, by ascending `ω²`: all, or the lowest of them.
    pub modes: Vec<Mode>,
    /// How many there are in all.
    pub total: usize,
    /// How many of all have `ω² < 0`.
    pub negative: usize,
    /// Largest force left over at a joint, relative to the largest force.
    pub out_of_balance: f64,
}

/// One mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// `ω²`, 1/s²; what is rounding is exactly zero.
    pub omega2_s2: f64,
    /// Within this of `omega2_s2` the linearised equations have an `ω²`, but for rounding, 1/s².
    pub residual_s2: f64,
    /// Displacement of each joint, world frame, scaled so that the largest has the length 1; of a
    /// spin all are zero.
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
    /// `ω² = 0`: a bar with inertia about its own axis spins in its joints, which stay where they
    /// are.
    Spin {
        /// Number of the member, from 0.
        member: usize,
    },
    /// `ω² = 0` for another reason.
    Neutral,
}

impl Mode {
    /// Frequency of an oscillation, Hz.
    pub fn frequency_hz(&self) -> Option<f64> {
        (self.what == What::Oscillation).then(|| self.omega2_s2.sqrt() / std::f64::consts::TAU)
    }

    /// Rate at which the system leaves the equilibrium, 1/s.
    pub fn rate_1_s(&self) -> Option<f64> {
        (self.what == What::Leaving).then(|| (-self.omega2_s2).sqrt())
    }
}

impl Modes {
    /// Number of modes in which the energy falls (the Morse index).
    pub fn index(&self) -> usize {
        self.negative
    }

    /// Number of the modes that are given without any change of the energy to second order, spins
    /// left aside.
    pub fn neutral(&self) -> usize {
        let zero = |what: &What| matches!(what, What::Turn { .. } | What::Neutral);
        self.modes.iter().filter(|mode| zero(&mode.what)).count()
    }
}

/// Most joints that move for all modes at once: a thousand coordinates take some ten seconds.
const MOST_JOINTS: usize = 350;

/// Systems of at most so many joints that move are solved by dense linear algebra, whatever is
/// asked for: it takes some hundredths of a second.
const DENSE_JOINTS: usize = 60;

/// The modes of a system about an equilibrium, given by the places of its joints, world frame, m.
///
/// Where rigid members and supports determine their forces, these are found here. Where they do not
/// (a member too many), the axial forces of the equilibrium are needed: `axial_n` by member, N,
/// tension positive.
///
/// All modes are found, by dense linear algebra: the time grows with the cube of the number of
/// joints. For the lowest of a large system see [`lowest_modes`].
///
/// # Errors
///
/// [`MotionError`] when the system cannot be moved here or is too large, the places are no
/// equilibrium, forces are needed and not given, an inextensible cable or strut is neither
/// certainly taut nor slack, a joint lies on a floor that does not certainly push it, or motions are no linear space
/// (looked at where no more than 350 joints move).
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
pub fn modes(system: &System, joints_m: &[Vector], axial_n: Option<&[f64]>) -> Result<Modes> {
    let mechanism = about_equilibrium(system, joints_m)?;
    if mechanism.moving > MOST_JOINTS {
        return Err(MotionError::TooLarge { joints: mechanism.moving, most: MOST_JOINTS });
    }
    let mut found = about(system, &mechanism, joints_m, axial_n, &|stiffness, sector| {
        dense::solve(stiffness, sector)
    })?;
    let spins = spins(system);
    found.total += spins.len();
    let negative = found.modes.partition_point(|mode| mode.omega2_s2 < 0.0);
    found.modes.splice(negative..negative, spins);
    Ok(found)
}

/// The spins of bars that have inertia about their own axes.
fn spins(system: &System) -> Vec<Mode> {
    let members = system.members().iter().enumerate();
    let spinning = members.filter(|(_, member)| member.body.inertia_kg_m2()[0] > 0.0);
    let spin = |(member, _)| Mode {
        omega2_s2: 0.0,
        residual_s2: 0.0,
        shape: vec![[0.0; 3]; system.joints().len()],
        what: What::Spin { member },
        direction: Direction::Space,
    };
    spinning.map(spin).collect()
}

/// The lowest `count` modes of a system about an equilibrium, by ascending `ω²`; negative ones are
/// the lowest. That none is left out is proved, but for rounding, by Sylvester's law of inertia:
/// the pivots of the factorised stiffness count the modes below the last.
///
/// For any number of joints: the factorisation is sparse. See [`modes`] for what is given. Spins of
/// bars about their own axes, all with `ω² = 0`, are left out here.
///
/// # Errors
///
/// As [`modes`], and [`MotionError::ModesUncounted`] when the count does not confirm what is
/// found.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
///
/// // A rope of 1 m as 1000 rods: ω² = (j/2)² g/L with the first zero j of the Bessel function J0,
/// // in both directions.
/// let n = 1000_u32;
/// let rod = Bar::homogeneous(1.0 / f64::from(n), 1.0 / f64::from(n))?;
/// let mut joints = vec![Joint::anchor("O", [0.0; 3])];
/// joints.extend((1..=n).map(|k| Joint::free(k.to_string())));
/// let members = (0..n as usize).map(|k| Member::bar(k, k + 1, rod)).collect();
/// let rope = System::new("rope", 9.81, joints, members)?;
/// let at: Vec<[f64; 3]> = (0..=n).map(|k| [0.0, 0.0, -f64::from(k) / f64::from(n)]).collect();
/// let found = motion::lowest_modes(&rope, &at, None, 2)?;
/// let told = (2.404_825_557_695_773_f64 / 2.0).powi(2) * 9.81;
/// assert!(found.modes.iter().all(|mode| (mode.omega2_s2 / told - 1.0).abs() < 1e-6));
/// assert_eq!((found.modes.len(), found.total), (2, 2000));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn lowest_modes(
    system: &System,
    joints_m: &[Vector],
    axial_n: Option<&[f64]>,
    count: usize,
) -> Result<Modes> {
    let mechanism = about_equilibrium(system, joints_m)?;
    let is_small = mechanism.moving <= DENSE_JOINTS;
    let mut found = about(system, &mechanism, joints_m, axial_n, &|stiffness, sector| {
        let size = mechanism.moving * sector.axes.len();
        if is_small || size < lowest::LEAST_SIZE || 4 * count > size {
            dense::solve(stiffness, sector)
        } else {
            lowest::solve(stiffness, sector, count)
        }
    })?;
    found.modes.truncate(count);
    Ok(found)
}

/// The mechanics of a system next to an equilibrium, where taut cables and struts are bars, and
/// joints that lie on a floor slide in its level.
pub(crate) fn about_equilibrium(system: &System, joints_m: &[Vector]) -> Result<Mechanism> {
    Mechanism::for_small_motions(&with_what_holds(system, joints_m)?)
}

/// At rest at places where every span of a taut rope has a direction.
fn at_rest(mechanism: &Mechanism, joints_m: &[Vector]) -> Result<State> {
    let state = State::at_rest(mechanism.places(joints_m)?);
    no_jam(mechanism, &state).map_err(|failure| at_the_beginning(mechanism, failure))?;
    Ok(state)
}

/// The modes of an equilibrium, sector by sector.
fn about(
    system: &System,
    mechanism: &Mechanism,
    joints_m: &[Vector],
    axial_n: Option<&[f64]>,
    solve: &dyn Fn(&Stiffness<'_>, &Sector) -> Result<Solved>,
) -> Result<Modes> {
    let state = at_rest(mechanism, joints_m)?;
    let mut vectors = vec![[0.0; 3]; mechanism.vectors()];
    let off = state.rows(mechanism, &mut vectors);
    if off.is_nan() || off > LENGTHS {
        return Err(MotionError::NotClosed { iterations: 0, off });
    }
    let (densities, determinate) = densities(mechanism, &state, axial_n)?;
    let left = LeftOver::new(mechanism, &state, &vectors, &densities);
    let out_of_balance = left.off(mechanism)?;
    check_forces(system, mechanism, joints_m, &densities)?;
    check_pushes(system, mechanism, joints_m, &left)?;
    let of = |densities| Stiffness::new(mechanism, &state, &vectors, densities);
    let mut stiffness = of(densities);
    if !determinate && mechanism.moving <= MOST_JOINTS {
        let is_one_sided = |member| inextensible(system, member).is_some();
        stiffness.bound = dense::bound(mechanism, is_one_sided, of)?;
    }
    let mut found = Modes { modes: Vec::new(), total: 0, negative: 0, out_of_balance };
    for sector in planes::sectors(mechanism, &state, &stiffness.excesses) {
        let bound = !stiffness.bound.is_empty();
        let solved =
            if bound { dense::solve(&stiffness, &sector) } else { solve(&stiffness, &sector) }?;
        found.total += solved.total;
        found.negative += solved.negative;
        found.modes.extend(shape::modes(&stiffness, &state, &sector, &solved));
    }
    found.modes.sort_by(|a, b| a.omega2_s2.total_cmp(&b.omega2_s2));
    Ok(found)
}

/// All modes, approximately, orthonormal in the metric of the inertia: a column for each, three
/// coordinates for each slot that moves.
pub(crate) fn approximate_modes(
    mechanism: &Mechanism,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> Result<DMatrix<f64>> {
    let state = at_rest(mechanism, joints_m)?;
    let mut vectors = vec![[0.0; 3]; mechanism.vectors()];
    state.rows(mechanism, &mut vectors);
    let bars = mechanism.bars.iter();
    let densities = bars.map(|bar| axial_n[bar.member] / bar.length_m).collect();
    let stiffness = Stiffness::new(mechanism, &state, &vectors, densities);
    let (rows, mut columns) = (3 * mechanism.moving, Vec::new());
    for sector in planes::sectors(mechanism, &state, &stiffness.excesses) {
        for shape in dense::solve(&stiffness, &sector)?.shapes {
            let first = columns.len();
            columns.resize(first + rows, 0.0);
            for (at, part) in shape.iter().enumerate() {
                let (slot, axis) = (at / sector.axes.len(), sector.axes[at % sector.axes.len()]);
                for k in 0..3 {
                    columns[first + 3 * slot + k] += part * axis[k];
                }
            }
        }
    }
    let count = columns.len() / rows.max(1);
    Ok(DMatrix::from_vec(rows, count, columns))
}

/// Force densities of the rigid bars, N/m, and whether they are the only ones.
fn densities(
    mechanism: &Mechanism,
    state: &State,
    axial_n: Option<&[f64]>,
) -> Result<(Vec<f64>, bool)> {
    let mut stepper = Stepper::new(mechanism.clone())?;
    let forces = force::Forces::default();
    match stepper.arrive(state, &forces, 0.0) {
        Ok(()) => {
            let nothing = vec![[0.0; 3]; mechanism.joint_at.len()];
            let (_, mut rho) = stepper.accelerations(state, &nothing);
            rho.truncate(mechanism.bars.len());
            Ok((rho, true))
        }
        Err(failure) => {
            let refused = at_the_beginning(mechanism, failure);
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
            Ok((bars.map(|bar| axial_n[bar.member] / bar.length_m).collect(), false))
        }
    }
}
