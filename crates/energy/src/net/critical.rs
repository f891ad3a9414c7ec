//! What the energy says of a shape from elsewhere: whether its gradient vanishes there, and in how
//! many directions it falls.
//!
//! Elastic members bear what their lengths say. The forces of the others, and the pushes of the
//! floor, are the multipliers of their lengths: those that leave least of the gradient.

use matrices::dense::least_squares;
use model::Vector;
use model::system::{Kind, System};
use nalgebra::DVector;

use crate::error::Error;
use crate::net::factor::Factor;
use crate::net::frame::Frame;
use crate::net::minimise::seeded;
use crate::net::polish::rounding_floor;
use crate::net::shape::{Shape, largest};
use crate::net::stability::{DENSE, Dense, below, rows};
use crate::thresholds::{CHANGES, ZERO};
use crate::vector::scaled;

/// Members with a force of the wrong sign become slack, those with this part of the worst and more.
const WORST: f64 = 0.5;

/// The energy at a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Critical {
    /// Largest component of its gradient, over the largest force.
    pub unbalance: f64,
    /// What that may be: a tolerance, and what rounding of the places leaves of the forces of stiff
    /// members.
    pub allowed: f64,
    /// Largest misfit of a length, over the length, beyond what rounding of the places explains.
    pub misfit: f64,
    /// Number of directions in which the energy falls.
    pub index: usize,
    /// The curvature nearest to zero, N/m; nothing for large systems.
    pub curvature_n_m: Option<f64>,
    /// The stiffness of the stiffest member, along it or by its force across it, N/m.
    pub stiffest_n_m: f64,
}

impl Critical {
    /// Whether the shape is an equilibrium.
    pub fn is_equilibrium(&self) -> bool {
        self.unbalance <= self.allowed && self.misfit <= ZERO
    }
}

/// The energy of a system at places of its joints, m; nothing for large systems with inextensible
/// members.
///
/// # Errors
///
/// [`Error`] where the system has no energy or the places do not fit it.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// // A weight on a spring of 1 m and EA = 10 N: 5 N stretch it by half.
/// let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_force([0.0, 0.0, -5.0])];
/// let spring = Member::bar(0, 1, Bar::homogeneous(1.0, 0.0)?).with_stiffness(10.0);
/// let system = System::new("a spring", 9.81, joints, vec![spring])?;
/// let at = |z| energy::net::critical(&system, &[[0.0; 3], [0.0, 0.0, z]]);
/// let hanging = at(-1.5)?.expect("it is small");
/// assert!(hanging.is_equilibrium() && hanging.index == 0);
/// assert!(!at(-1.4)?.expect("it is small").is_equilibrium());
/// // Upright the spring is shorter by half, and falls to either side.
/// assert_eq!(at(0.5)?.expect("it is small").index, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn critical(system: &System, joints_m: &[Vector]) -> Result<Option<Critical>, Error> {
    let frame = Frame::new(system)?;
    let mut shape = seeded(&frame, joints_m)?;
    let excess = frame.excesses(&shape.x);
    for ((force, rod), excess) in shape.force.iter_mut().zip(&frame.rods).zip(&excess) {
        *force = rod.prestress(excess.value);
    }
    let once = |e: &usize| !frame.rods[*e].elastic() && !frame.again(*e);
    let rigid: Vec<usize> = (0..frame.rods.len()).filter(once).collect();
    if !rigid.is_empty() {
        if frame.freedom > DENSE {
            return Ok(None);
        }
        let outside = |e: usize| match frame.rods[e].kind {
            Kind::Bar | Kind::Cable => excess[e].value,
            Kind::Strut => -excess[e].value,
        };
        let taut = rigid.into_iter().filter(|e| {
            frame.rods[*e].kind == Kind::Bar || outside(*e) >= -ZERO * frame.rods[*e].length
        });
        multipliers(&frame, &mut shape, &taut.collect::<Vec<_>>());
    }
    let slope = frame.slope(&shape);
    let stiff = frame.rods.iter().zip(&shape.force).map(|(rod, force)| {
        let along = if rod.elastic() { rod.flexibility.recip() } else { 0.0 };
        along.max(force.abs() / rod.length)
    });
    let stiff = stiff.fold(f64::MIN_POSITIVE, f64::max);
    let stiffest = frame.rods.iter().filter(|rod| rod.elastic());
    let stiffest = stiffest.map(|rod| rod.length / rod.flexibility).fold(0.0, f64::max);
    // Far from the origin places are given to few digits.
    let far = joints_m.iter().flatten().fold(0.0_f64, |far, x| far.max(x.abs())) / frame.length_m;
    let shortest = frame.rods.iter().map(|rod| rod.length).fold(f64::INFINITY, f64::min);
    let given = f64::EPSILON * far / shortest;
    let rounding =
        rounding_floor(&frame, &shape).max(given) * stiffest / frame.force_scale(&shape.force);
    let unit_n_m = frame.force_n / frame.length_m;
    let (index, curvature_n_m) = if frame.freedom <= DENSE {
        let count = Dense::read(&frame, &shape, None).count();
        (count.index, count.nearest_to_zero.map(|nearest| nearest * unit_n_m))
    } else {
        let mut factor = Factor::new(&frame.spots, &frame.rods, &frame.meter)?;
        (below(&frame, &shape, &mut factor, ZERO, true), None)
    };
    let (unbalance, misfit) = (slope.unbalance, (slope.misfit - given).max(0.0));
    let (allowed, stiffest_n_m) = (ZERO + rounding, stiff * unit_n_m);
    Ok(Some(Critical { unbalance, allowed, misfit, index, curvature_n_m, stiffest_n_m }))
}

/// Forces of the taut inextensible members that leave least of the gradient; those whose sign would be wrong are slack, and
/// taut again where what is left would stretch them.
fn multipliers(frame: &Frame, shape: &mut Shape, rigid: &[usize]) {
    let excess = frame.excesses(&shape.x);
    let elastic = shape.force.clone();
    let gradient = DVector::from_vec(frame.gradient(|e| scaled(elastic[e], excess[e].gradient)));
    let all = rows(frame, &excess, rigid).transpose();
    let mut taut = vec![true; rigid.len()];
    for _ in 0..CHANGES {
        let held: Vec<usize> = (0..rigid.len()).filter(|k| taut[*k]).collect();
        let balance = all.select_columns(&held);
        let Some(forces) = least_squares(&balance, &-&gradient, ZERO) else { return };
        shape.force.clone_from(&elastic);
        for (k, force) in held.iter().zip(&forces) {
            shape.force[rigid[*k]] += force;
        }
        frame.spread(&mut shape.force);
        let left = all.tr_mul(&(&gradient + balance * forces));
        let zero = ZERO * largest(&shape.force);
        // A force of the wrong sign, or the pull on what is slack.
        let wrong = |k: usize| {
            let pull = if taut[k] { shape.force[rigid[k]] } else { -left[k] };
            let changes = pull.abs() > zero && frame.rods[rigid[k]].resists(pull) != taut[k];
            if changes { pull.abs() } else { 0.0 }
        };
        let wrong: Vec<f64> = (0..rigid.len()).map(wrong).collect();
        let worst = largest(&wrong);
        if worst <= 0.0 {
            return;
        }
        for (taut, wrong) in taut.iter_mut().zip(wrong) {
            *taut ^= wrong > WORST * worst;
        }
    }
}
