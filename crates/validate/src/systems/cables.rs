//! A third independent answer: the system as a conic programme.
//!
//! Hang a cable in the place of every bar, and the least energy is a convex problem, whatever the system:
//!
//! $$ \min_{x,\\,e}\\; \sum_m \tfrac{k_m}{2} e_m^2 - \sum_j f_j \cdot x_j \quad\text{with}\quad
//!    |x_b - x_a| \le l_m + e_m, \quad z_j \ge h, $$
//!
//! with an elongation $e$ for elastic members alone and a floor at $h$ if there is one. clarabel's interior point method solves
//! it with neither Newton's laws nor a search among shapes. Where every cable pulls they are the bars: the optimum is the energy
//! of the equilibrium of least energy, and the multipliers of the cones are the axial forces. Where a bar is pressed the cables
//! hang lower.
//!
//! clarabel's tolerance is 1e-9: the energy has about as many digits, places and forces half of them.
//!
//! # References
//!
//! P. J. Goulart, Y. Chen, Clarabel: an interior-point solver for conic programs with quadratic
//! objectives, 2024, arXiv:2405.12762.

use model::system::{Kind, Member, System};
use model::{Vector, sum};

use self::program::{Affine, Program};
use super::near::potential_j;
use numerics::vector::{dot, minus, norm, plus, times};

mod program;

pub use self::program::ConeError;

/// The configuration of least energy of a system whose bars are cables.
#[derive(Debug, Clone, PartialEq)]
pub struct Cables {
    /// Places of the joints, m.
    pub joints_m: Vec<Vector>,
    /// Axial force of each member, N, none negative: the multiplier of its cone.
    pub axial_n: Vec<f64>,
    /// Potential energy from the system's reference, J.
    pub energy_j: f64,
}

/// Where a joint is: `base + Σ axes[k] · variable[first + k]`, in units.
struct Place {
    base: Vector,
    first: usize,
    axes: Vec<Vector>,
}

/// Hang the system with a cable in the place of every bar.
///
/// # Errors
/// [`ConeError`]: a strut, or a programme that clarabel does not solve (a system without any load, or one that falls).
///
/// ```
/// use model::{Bar, system::{Joint, Member, System}};
/// use validate::systems::hang_as_cables;
/// // A lamp of 2 N on cables of 5 m between anchors 6 m apart: 3, 4, 5.
/// let joints = vec![
///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
///     Joint::anchor("B", [3.0, 0.0, 0.0]),
///     Joint::free("lamp").with_mass(0.2),
/// ];
/// let body = Bar::homogeneous(5.0, 0.0)?;
/// let members = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
/// let lamp = System::new("lamp", 10.0, joints, members)?;
/// let found = hang_as_cables(&lamp)?;
/// assert!((found.energy_j + 8.0).abs() < 1e-7);
/// assert!((found.joints_m[2][2] + 4.0).abs() < 1e-4 && (found.axial_n[0] - 1.25).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn hang_as_cables(system: &System) -> Result<Cables, ConeError> {
    if let Some(rope) = system.first_rope() {
        return Err(ConeError::Rope(rope + 1));
    }
    let cables = as_cables(system)?;
    let loads_n = system.joint_loads_n();
    // Units in which all numbers of the programme are of size one.
    let length_m = system.total_length_m() / cables.len() as f64;
    let force_n =
        sum(loads_n.iter().map(|f| norm(*f))).max(f64::MIN_POSITIVE) / loads_n.len() as f64;
    let origin = system.reference_m();
    let (places, movable) = places(system, length_m);

    let mut cost = vec![0.0; movable];
    for (place, load) in places.iter().zip(&loads_n) {
        for (k, axis) in place.axes.iter().enumerate() {
            cost[place.first + k] = -dot(*load, *axis) / force_n;
        }
    }
    let mut program = Program::minimise(cost);
    let cones: Vec<Option<usize>> = cables
        .iter()
        .map(|cable| {
            let [a, b] = [cable.from, cable.to].map(|joint| &places[joint]);
            // What is held at both ends is decided.
            (a.axes.len() + b.axes.len() > 0).then(|| {
                let unit_m = cable.body.length_m();
                let mut reach = Affine { constant: unit_m / length_m, terms: vec![] };
                if let Some(stiffness_n) = cable.stiffness_n {
                    let elongation = program.variable(stiffness_n / force_n * length_m / unit_m);
                    reach.terms.push((elongation, 1.0));
                }
                let [x, y, z] = [0, 1, 2].map(|axis| between(a, b, axis));
                program.second_order(&[reach, x, y, z])
            })
        })
        .collect();
    if let Some(floor_m) = system.floor_m() {
        let height = (floor_m - origin[2]) / length_m;
        for place in places.iter().filter(|place| !place.axes.is_empty()) {
            let terms = terms(place, 2, 1.0).collect();
            program.positive(&Affine { constant: place.base[2] - height, terms });
        }
    }

    let solution = program.solve()?;
    let from_origin_m: Vec<Vector> = places
        .iter()
        .map(|place| {
            let axes = place.axes.iter().zip(&solution.x[place.first..]);
            times(length_m, axes.fold(place.base, |at, (axis, x)| plus(at, times(*x, *axis))))
        })
        .collect();
    let axial_n = cables.iter().zip(cones).map(|(cable, row)| {
        row.map_or_else(|| held_n(cable, &from_origin_m), |row| solution.z[row] * force_n)
    });
    Ok(Cables {
        axial_n: axial_n.collect(),
        energy_j: potential_j(system, &cables, &from_origin_m),
        joints_m: from_origin_m.into_iter().map(|at| plus(origin, at)).collect(),
    })
}

/// The members, with a cable in the place of every bar.
fn as_cables(system: &System) -> Result<Vec<Member>, ConeError> {
    let members = system.members().iter().enumerate().map(|(k, member)| match member.kind {
        Kind::Bar | Kind::Cable => Ok(member.clone().of_kind(Kind::Cable)),
        Kind::Strut => Err(ConeError::Strut(k + 1)),
    });
    members.collect()
}

/// Places of all joints, and the number of their coordinates.
fn places(system: &System, length_m: f64) -> (Vec<Place>, usize) {
    let origin = system.reference_m();
    let mut first = 0;
    let places = system.joints().iter().map(|joint| {
        let at_m = joint.support.at_m().unwrap_or(origin);
        let base = times(1.0 / length_m, minus(at_m, origin));
        let place = Place { base, first, axes: joint.support.motions() };
        first += place.axes.len();
        place
    });
    let places: Vec<Place> = places.collect();
    (places, first)
}

/// The terms of a component of a place, times a factor.
fn terms(place: &Place, component: usize, factor: f64) -> impl Iterator<Item = (usize, f64)> {
    let axes = place.axes.iter().enumerate();
    axes.map(move |(k, axis)| (place.first + k, factor * axis[component]))
        .filter(|(_, part)| part.abs() > 0.0)
}

/// A component of the way from one joint to another.
fn between(a: &Place, b: &Place, component: usize) -> Affine {
    let terms = terms(b, component, 1.0).chain(terms(a, component, -1.0));
    Affine { constant: b.base[component] - a.base[component], terms: terms.collect() }
}

/// Force of a cable between two anchors, by its length; zero of an inextensible one.
fn held_n(cable: &Member, joints_m: &[Vector]) -> f64 {
    let length_m = cable.body.length_m();
    let longer_m = norm(minus(joints_m[cable.to], joints_m[cable.from])) - length_m;
    cable.stiffness_n.map_or(0.0, |stiffness_n| (stiffness_n * longer_m / length_m).max(0.0))
}
