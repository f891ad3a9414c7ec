//! Systems of cables as a second-order cone programme.

use model::system::{Kind, Member, Support, System};
use model::{Vector, sum};

use crate::error::BoundError;
use crate::program::{Affine, ConeEvidence, Program};
use crate::settings::BoundSettings;

/// The configuration of least energy of a system whose bars are taken for cables, as the cone
/// programme has it: good to about its tolerance, and no proof.
#[derive(Debug, Clone, PartialEq)]
pub struct CableSystem {
    /// Places of the joints, m.
    pub joints_m: Vec<Vector>,
    /// Axial force of each member, N, none negative: the multiplier of its cone.
    pub axial_n: Vec<f64>,
    /// Potential energy from the system's reference, J.
    pub energy_j: f64,
    /// How the programme was solved.
    pub evidence: ConeEvidence,
}

/// Where a joint is: `base + Σ axes[k] · variable[first + k]`, in units.
struct Place {
    base: Vector,
    first: usize,
    axes: Vec<Vector>,
}

/// Least energy of a system in which every bar is a cable, above its floor if it has one:
///
/// $$ \min_{x,\,e}\; \sum_m \tfrac{k_m}{2} e_m^2 - \sum_j f_j \cdot x_j \quad\text{with}\quad
///    |x_b - x_a| \le l_m + e_m, \quad z_j \ge h, $$
///
/// with an elongation `e` for elastic members alone. It is convex, whatever the system: where every
/// bar carries a force it is the bars' own minimum too, the only one.
///
/// # Errors
///
/// [`BoundError`]: a setting out of range, a strut, or a programme that clarabel does not solve (a
/// system without any load, or one that falls).
///
/// ```
/// use bounds::{BoundSettings, cable_system};
/// use model::{Bar, system::{Joint, Member, System}};
/// // A lamp of 2 N on cables of 5 m between anchors 6 m apart: 3, 4, 5.
/// let joints = vec![
///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
///     Joint::anchor("B", [3.0, 0.0, 0.0]),
///     Joint::free("lamp").with_mass(0.2),
/// ];
/// let body = Bar::homogeneous(5.0, 0.0)?;
/// let members = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
/// let lamp = System::new("lamp", 10.0, joints, members)?;
/// let found = cable_system(&lamp, &BoundSettings::default())?;
/// assert!((found.energy_j + 8.0).abs() < 1e-7);
/// // Places and forces have about half as many digits as the energy, which is least there.
/// assert!((found.joints_m[2][2] + 4.0).abs() < 1e-4 && (found.axial_n[0] - 1.25).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cable_system(system: &System, settings: &BoundSettings) -> Result<CableSystem, BoundError> {
    if let Some(k) = system.members().iter().position(|member| member.kind == Kind::Strut) {
        return Err(BoundError::Strut { member: k + 1 });
    }
    let loads_n = loads_n(system);
    let length_m = system.total_length_m() / system.members().len() as f64;
    let force_n = sum(loads_n.iter().map(|[x, y, z]| x.hypot(*y).hypot(*z))).max(f64::MIN_POSITIVE)
        / loads_n.len() as f64;
    let (places, movable) = places(system, length_m);
    let moving: Vec<bool> = system
        .members()
        .iter()
        .map(|m| places[m.from].axes.len() + places[m.to].axes.len() > 0)
        .collect();
    // One elongation for each elastic member that moves, behind the coordinates.
    let mut elongation = vec![None; system.members().len()];
    let mut variables = movable;
    for (k, member) in system.members().iter().enumerate() {
        if moving[k] && member.stiffness_n.is_some() {
            elongation[k] = Some(variables);
            variables += 1;
        }
    }
    let mut cost = vec![0.0; variables];
    for (place, load) in places.iter().zip(&loads_n) {
        for (k, axis) in place.axes.iter().enumerate() {
            cost[place.first + k] = -dot(*load, *axis) / force_n;
        }
    }
    let mut program = Program::minimise(cost);
    let mut cones = vec![None; system.members().len()];
    for (k, member) in system.members().iter().enumerate() {
        if !moving[k] {
            continue;
        }
        let mut reach = Affine::new(member.body.length_m() / length_m, []);
        if let (Some(variable), Some(stiffness_n)) = (elongation[k], member.stiffness_n) {
            reach.terms.push((variable, 1.0));
            program.curve(variable, stiffness_n / force_n * length_m / member.body.length_m());
        }
        let [a, b] = [member.from, member.to].map(|joint| &places[joint]);
        let span = [0, 1, 2].map(|c| difference(a, b, c));
        let [x, y, z] = span;
        cones[k] = Some(program.second_order(&[reach, x, y, z]));
    }
    if let Some(floor_m) = system.floor_m() {
        let height = (floor_m - system.reference_m()[2]) / length_m;
        for place in places.iter().filter(|place| !place.axes.is_empty()) {
            let mut above = Affine::new(place.base[2] - height, []);
            above.terms.extend(terms(place, 2, 1.0));
            program.positive(&above);
        }
    }
    let (solution, evidence) = program.solve(settings)?;
    evidence.accept(false)?;
    let origin = system.reference_m();
    let joints_m: Vec<Vector> = places
        .iter()
        .map(|place| {
            std::array::from_fn(|c| {
                let moves = terms(place, c, 1.0).map(|(k, part)| part * solution.x[k]);
                origin[c] + length_m * (place.base[c] + moves.sum::<f64>())
            })
        })
        .collect();
    let axial_n = system.members().iter().enumerate().map(|(k, member)| {
        cones[k].map_or_else(|| held_n(member, &joints_m), |row| solution.z[row] * force_n)
    });
    let axial_n: Vec<f64> = axial_n.collect();
    let energy_j = energy_j(system, &joints_m, &loads_n);
    Ok(CableSystem { joints_m, axial_n, energy_j, evidence })
}

/// Places of all joints, and the number of their coordinates.
fn places(system: &System, length_m: f64) -> (Vec<Place>, usize) {
    let origin = system.reference_m();
    let mut first = 0;
    let places = system.joints().iter().map(|joint| {
        let at_m = joint.support.at_m().unwrap_or(origin);
        let base = std::array::from_fn(|c| (at_m[c] - origin[c]) / length_m);
        let axes = match joint.support {
            Support::Free => vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Support::Fixed { .. } => vec![],
            Support::Line { direction, .. } => vec![direction],
            Support::Plane { normal, .. } => across(normal).to_vec(),
        };
        let place = Place { base, first, axes };
        first += place.axes.len();
        place
    });
    let places: Vec<Place> = places.collect();
    (places, first)
}

/// Two unit vectors normal to a unit vector and to each other.
fn across(normal: Vector) -> [Vector; 2] {
    let least = (0..3).min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs())).unwrap_or(0);
    let mut helper = [0.0; 3];
    helper[least] = 1.0;
    let along = dot(helper, normal);
    let first: Vector = std::array::from_fn(|c| helper[c] - along * normal[c]);
    let size = dot(first, first).sqrt();
    let first = first.map(|x| x / size);
    let [a, b, c] = normal;
    let [x, y, z] = first;
    [first, [b * z - c * y, c * x - a * z, a * y - b * x]]
}

/// The terms of a component of a place, times a factor.
fn terms(place: &Place, component: usize, factor: f64) -> impl Iterator<Item = (usize, f64)> {
    let axes = place.axes.iter().enumerate();
    axes.map(move |(k, axis)| (place.first + k, factor * axis[component]))
        .filter(|(_, part)| part.abs() > 0.0)
}

/// A component of the way from one joint to another.
fn difference(a: &Place, b: &Place, component: usize) -> Affine {
    let terms = terms(b, component, 1.0).chain(terms(a, component, -1.0));
    Affine { constant: b.base[component] - a.base[component], terms: terms.collect() }
}

/// Weights and forces at the joints, those of members by the lever rule, N.
fn loads_n(system: &System) -> Vec<Vector> {
    let gravity = system.gravity_m_s2();
    let mut loads: Vec<Vector> = system
        .joints()
        .iter()
        .map(|joint| {
            let [x, y, z] = joint.force_n;
            [x, y, z - joint.mass_kg * gravity]
        })
        .collect();
    for member in system.members() {
        let weight = [0.0, 0.0, -member.body.mass_kg() * gravity];
        let forces = member.loads.iter().map(|load| (load.at_m, load.force_n));
        for (at_m, force) in forces.chain([(member.body.centre_m(), weight)]) {
            let part = at_m / member.body.length_m();
            for c in 0..3 {
                loads[member.from][c] += (1.0 - part) * force[c];
                loads[member.to][c] += part * force[c];
            }
        }
    }
    loads
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn distance_m(member: &Member, joints_m: &[Vector]) -> f64 {
    let [a, b] = [joints_m[member.from], joints_m[member.to]];
    (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2])
}

/// Force of a member between two anchors, by its length; none of an inextensible one.
fn held_n(member: &Member, joints_m: &[Vector]) -> f64 {
    let length_m = member.body.length_m();
    let strain = (distance_m(member, joints_m) - length_m) / length_m;
    member.stiffness_n.map_or(0.0, |stiffness_n| (stiffness_n * strain).max(0.0))
}

fn energy_j(system: &System, joints_m: &[Vector], loads_n: &[Vector]) -> f64 {
    let origin = system.reference_m();
    let works = joints_m
        .iter()
        .zip(loads_n)
        .map(|(at, load)| -dot(*load, std::array::from_fn(|c| at[c] - origin[c])));
    let elastic = system.members().iter().filter_map(|member| {
        let stretch_m = (distance_m(member, joints_m) - member.body.length_m()).max(0.0);
        Some(0.5 * member.stiffness_n? / member.body.length_m() * stretch_m * stretch_m)
    });
    sum(works.chain(elastic))
}
