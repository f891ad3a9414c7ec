//! Enclosures of `ω²`: intervals that are proved to contain them.
//!
//! An equilibrium `x*` with its forces lies in a box that somebody has proved to hold one. With
//! intervals for what is read off that box (`pencil`):
//!
//! 1. `R(x*)` has independent rows, and from approximate modes `X̃` the exact displacements `X = X̃
//!    − R̃ᵀ W` are enclosed that keep the lengths, `R X = 0` (`kept`);
//! 2. `A = Xᵀ K X` and `B = Xᵀ M X = I + F` with `‖F‖ ≤ φ < 1`: the columns of `X` are a basis of
//!    what keeps the lengths, and the `ω²` are the eigenvalues of the pencil `(A, B)`;
//! 3. the eigenvalues of `A`, which is nearly diagonal, by Gershgorin's discs, each row scaled so
//!    that its disc is narrow (`discs`);
//! 4. Ostrowski's theorem: the k-th `ω²` is the k-th eigenvalue of `A` times a number between
//!    `1/(1 + φ)` and `1/(1 − φ)`.
//!
//! Turns about verticals have `ω² = 0` exactly. Where no more enclosures contain zero than there
//! are such turns, these are the zeros, all signs are proved, and with them the index.
//!
//! # References
//!
//! S. M. Rump, "Verification methods", Acta Numerica 19 (2010) 287-449, sections 10 and 13,
//! doi:10.1017/S096249291000005X; A. M. Ostrowski, Proc. Natl. Acad. Sci. 45 (1959) 740-744;
//! R. A. Horn, C. R. Johnson, *Matrix Analysis*, 2nd ed. (2013), theorems 4.5.9, 6.1.1 and 6.4.

mod discs;
mod kept;
mod pencil;

use model::number::Brief;
use model::system::System;
use nalgebra::DMatrix;
use numerics::Interval;

use crate::error::MotionError;
use crate::modes::{about_equilibrium, approximate_modes};
use pencil::Pencil;

/// Systems of at most so many joints that move are enclosed: the work grows with the cube of their
/// number, and takes some tenths of a second here.
pub const MOST_ENCLOSED_JOINTS: usize = 60;

/// A box that is proved to hold exactly one equilibrium of a system, in which the floor, if there
/// is one, pushes the joints that lie on it.
#[derive(Debug, Clone, Copy)]
pub struct EquilibriumBox<'a> {
    /// Places of all joints, world frame, m.
    pub joints_m: &'a [[Interval; 3]],
    /// Axial forces of all members, loads lumped to the joints, tension positive, N.
    pub axial_n: &'a [Interval],
    /// Number of independent turns about verticals that leave the energy what it is, proved: the
    /// equilibrium stands for all that they make of it.
    pub turns: usize,
}

/// Enclosures of all `ω²` of an equilibrium; spins of bars are left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosures {
    /// Of the k-th smallest `ω²` the k-th, 1/s².
    pub omega2_s2: Vec<Interval>,
    /// How many `ω²` are negative, zero and positive, where that is proved.
    pub inertia: Option<[usize; 3]>,
}

/// Why the `ω²` of an equilibrium are not enclosed. Numbers count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum NotEnclosed {
    /// Occurs when the system cannot be moved.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Occurs when the box has not one place for each joint and one force for each member.
    #[error("the box is not one of this system: {places} places and {forces} forces")]
    OtherSystem { places: usize, forces: usize },
    /// Occurs when more joints move than are enclosed.
    #[error("{joints} joints move, and at most {most} are enclosed")]
    TooLarge { joints: usize, most: usize },
    /// Occurs when a cable or strut is not proved to bear a force, nor to be slack: its stiffness
    /// is undecided.
    #[error("member {member} is not proved to be taut, nor to be slack")]
    Undecided { member: usize },
    /// Occurs when the constraints are not proved to be independent.
    #[error(
        "the constraints are not proved to be independent (norm {norm}, below 1 is wanted)",
        norm = Brief(*norm)
    )]
    Dependent {
        /// Norm of what should be small.
        norm: f64,
    },
    /// Occurs when the approximate modes are not proved to be a basis of what keeps the lengths.
    #[error(
        "{found} approximate modes are not proved to be a basis of {wanted} dimensions (norm {norm}, below 1 \
         is wanted)",
        norm = Brief(*norm)
    )]
    NoBasis {
        found: usize,
        wanted: usize,
        /// Norm of `B − I`.
        norm: f64,
    },
}

/// Enclose all `ω²` of an equilibrium, from a box that is proved to hold one.
///
/// Lengths, masses, forces and gravity are the doubles of the system. Moments of inertia are taken
/// with a few roundings to either side, so that those of homogeneous bars contain `m l²/12`; of
/// moments across that differ by a rounding all between them are taken. Bars with different moments
/// across have their second axis as level as it can be across them.
///
/// # Errors
///
/// [`NotEnclosed`], why there is no such proof.
///
/// ```
/// use numerics::Interval;
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// use motion::EquilibriumBox;
///
/// // A homogeneous bar of 1 m and 3 kg: ω² = 3/2 g/l, in every direction. It hangs by 3 g/2.
/// let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P")];
/// let bar = Bar::homogeneous(1.0, 3.0)?;
/// let system = System::new("rod", 9.81, joints, vec![Member::bar(0, 1, bar)])?;
/// let at = [[0.0; 3], [0.0, 0.0, -1.0]].map(|x| x.map(Interval::point));
/// let axial = [Interval::point(1.5) * Interval::point(9.81)];
/// let hanging = EquilibriumBox { joints_m: &at, axial_n: &axial, turns: 0 };
/// let found = motion::enclose_modes(&system, &hanging)?;
/// assert_eq!(found.inertia, Some([0, 0, 2]));
/// assert!(found.omega2_s2.iter().all(|o| o.contains(14.715) && o.width() < 1e-12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn enclose_modes(system: &System, at: &EquilibriumBox<'_>) -> Result<Enclosures, NotEnclosed> {
    let (places, forces) = (at.joints_m.len(), at.axial_n.len());
    if places != system.joints().len() || forces != system.members().len() {
        return Err(NotEnclosed::OtherSystem { places, forces });
    }
    let joints_m: Vec<_> = at.joints_m.iter().map(|x| x.map(Interval::mid)).collect();
    let mechanism = about_equilibrium(system, &joints_m)?;
    let joints = mechanism.moving;
    if joints > MOST_ENCLOSED_JOINTS {
        return Err(NotEnclosed::TooLarge { joints, most: MOST_ENCLOSED_JOINTS });
    }
    let axial_n: Vec<_> = at.axial_n.iter().map(|n| n.mid()).collect();
    let about = approximate_modes(&mechanism, &joints_m, &axial_n)?;
    let pencil = Pencil::new(system, &mechanism, at)?;
    let kept = kept::displacements(&pencil.rows, &about)?;
    let (stiffness, inertia) = pencil.projected(&kept);
    let norm = norm(&less_unit(inertia));
    let wanted = 3 * joints - pencil.rows.len();
    // Independent rows leave so many dimensions; columns with a definite B are independent.
    let is_basis = kept.ncols() == wanted && norm < 1.0;
    if !is_basis {
        return Err(NotEnclosed::NoBasis { found: kept.ncols(), wanted, norm });
    }
    let beyond = Interval::new(-norm, norm) + Interval::ONE;
    let theta = Interval::ONE / beyond;
    let omega2_s2 = discs::eigenvalues(&stiffness).into_iter().map(|a| a * theta).collect();
    Ok(with_zeros(ascending(omega2_s2), at.turns))
}

/// The k-th smallest is not less than those before it, nor more than those behind.
fn ascending(mut omega2: Vec<Interval>) -> Vec<Interval> {
    let mut low = f64::NEG_INFINITY;
    for o in &mut omega2 {
        low = low.max(o.lo());
        *o = Interval::new(low, o.hi().max(low));
    }
    let mut high = f64::INFINITY;
    for o in omega2.iter_mut().rev() {
        high = high.min(o.hi());
        *o = Interval::new(o.lo().min(high), high);
    }
    omega2
}

/// Where as many enclosures contain zero as there are zeros by turns, these are zero.
fn with_zeros(mut omega2_s2: Vec<Interval>, turns: usize) -> Enclosures {
    let negative = omega2_s2.iter().filter(|o| o.hi() < 0.0).count();
    let positive = omega2_s2.iter().filter(|o| o.lo() > 0.0).count();
    let undecided = omega2_s2.len() - negative - positive;
    if undecided != turns {
        return Enclosures { omega2_s2, inertia: None };
    }
    omega2_s2[negative..negative + turns].fill(Interval::ZERO);
    Enclosures { omega2_s2, inertia: Some([negative, turns, positive]) }
}

/// `S − I`.
fn less_unit(mut matrix: DMatrix<Interval>) -> DMatrix<Interval> {
    for i in 0..matrix.nrows() {
        matrix[(i, i)] = matrix[(i, i)] - Interval::ONE;
    }
    matrix
}

/// The largest sum of a row of absolute values, rounded upward: a bound of every eigenvalue and,
/// for symmetric matrices, of the 2-norm.
fn norm(matrix: &DMatrix<Interval>) -> f64 {
    let row = |i: usize| matrix.row(i).iter().map(|x| Interval::point(x.mag())).sum::<Interval>();
    (0..matrix.nrows()).map(|i| row(i).hi()).fold(0.0, numerics::vector::worse)
}
