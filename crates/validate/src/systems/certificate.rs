//! The certificate of global minimality for systems: no configuration has less energy.
//!
//! # The bound
//!
//! The potential of every kind of member is a convex function $\\varphi_e$ of the squared distance
//! $t_e$ of its ends, so $\\varphi_e(t) \\ge \\varphi_e(t_e^*) + \\frac{w_e}{2}(t -
//! t_e^*)$ wherever $w_e/2$ is a subgradient at $t_e^*$: of a bar any number at $t^* =
//! l^2$, of a cable any $w \\ge 0$, of a strut any $w \\le
//! 0$ there, and of an elastic member with the spring rate $k = EA/l$ any $w < k$ at $\\sqrt{t^*} =
//! l/(1 - w/k)$. Summed over the members and less the work of the loads,
//!
//! $$ V(x) \\ge Q(x) = \\sum_e \\Big(\\varphi_e(t_e^*) + \\frac{w_e}{2}(|x_b - x_a|^2 - t_e^*)\\Big) - \\sum_j f_j\\cdot x_j, $$
//!
//! a quadratic function with the Hessian $\\Omega \\otimes I_3$, where
//! $\\Omega = C_f^T \\mathrm{diag}(w)\\, C_f$ is the stress matrix over the joints that can move.
//! If $\\Omega \\ge c > 0$, then with the gradient $r$ of $Q$ at any $\\tilde x$
//!
//! $$ V(x) \\ge Q(\\tilde x) - \\frac{|r|^2}{2c} \\quad \\text{for every } x . $$
//!
//! A floor below which no joint gets, $z_j \\ge h$, pushes with $N_j \\ge 0$: as $N_j (z_j - h)
//! \\ge 0$ in every configuration, $V \\ge V - \\sum N_j (z_j - h)$, and the bound is that of the
//! system without a floor under the loads $f_j + N_j e_z$, and the constant.
//!
//! The $w_e$ are those of the answer, $N_e/d_e$; whatever their rounding, the bound holds, and the
//! better the answer, the smaller the gap.
//!
//! # Rounding
//!
//! That $\\Omega \\ge c$ is proved by a Cholesky factorisation of $\\Omega - 2c\\, I$ in floating
//! point that runs to its end, and by what the rows of its factor say of its rounding (module
//! `definite`). The larger $c$, the smaller what the gradient costs: $c$ is as large as the gap
//! needs, where the matrix allows, else as small as rounding does.
//!
//! # References
//!
//! R. Connelly, Invent. Math. 66 (1982) 11-33, doi:10.1007/BF01404753 (stress matrices).

use model::system::{Joint, Member, System, SystemEquilibrium};
use model::{NoCertificate, Optimal, Vector, sum};

use super::definite::{Symmetric, gamma};
use super::floor::push_n;
use numerics::vector::{dot, minus, norm, plus, times, worse};

/// The largest gap that still counts as none, in units of the loads times the size of the system:
/// what the solvers' own budget of energies allows.
const GAP: f64 = 1e-9;

/// What the gradient may add to the gap, in the same units: nothing that anyone sees.
const SMALL_GAP: f64 = 1e-15;

/// Largest distance of a joint from the reference of the energy, or length of a member, m.
pub(super) fn size_m(system: &System, answer: &SystemEquilibrium) -> f64 {
    let origin = system.reference_m();
    let longest = system.members().iter().map(|m| m.body.length_m()).fold(0.0, f64::max);
    answer.joints_m.iter().map(|x| norm(minus(*x, origin))).fold(longest, worse)
}

/// The largest force at an end of a member or of a support, N.
pub(super) fn largest_force_n(answer: &SystemEquilibrium) -> f64 {
    let forces = answer.start_forces_n.iter().chain(&answer.end_forces_n);
    forces.chain(&answer.reactions_n).map(|force| norm(*force)).fold(0.0, worse)
}

/// Prove that no configuration of the system has less energy than this answer.
///
/// # Errors
/// [`NoCertificate`]: compressed members that the others do not outweigh, a gap that is too large,
/// or an answer that is incomplete.
pub fn certify(system: &System, answer: &SystemEquilibrium) -> Result<Optimal, NoCertificate> {
    let fits = answer.joints_m.len() == system.joints().len()
        && answer.axial_n.len() == system.members().len()
        && answer.reactions_n.len() == system.joints().len()
        && answer.joints_m.iter().flatten().chain(&answer.axial_n).all(|x| x.is_finite());
    if !fits || !answer.energy_j.is_finite() {
        return Err(NoCertificate::Unusable);
    }
    let unit_j = system.total_load_n() * size_m(system, answer);
    let unit_j = if unit_j > 0.0 { unit_j } else { elastic_unit_j(system) };
    if system.has_ropes() {
        return within(answer.energy_j, super::convex::bound_j(system, answer)?, unit_j);
    }
    let densities = densities(system, answer);
    let (value_j, squared_gradient) = tangent(system, answer, &densities);
    let wanted = squared_gradient / (2.0 * SMALL_GAP * unit_j);
    let matrix = stress_matrix(system, &densities);
    let least = matrix.least_eigenvalue(wanted).ok_or_else(|| NoCertificate::NotDefinite {
        compressed: densities.iter().filter(|w| **w < 0.0).count(),
    })?;
    within(answer.energy_j, value_j - squared_gradient / (2.0 * least), unit_j)
}

/// The certificate of a bound that is near enough, in units of some energy: an answer that is below the bound of all
/// configurations keeps no lengths.
fn within(energy_j: f64, bound_j: f64, unit_j: f64) -> Result<Optimal, NoCertificate> {
    let gap = (energy_j - bound_j) / unit_j;
    // NaN is no proof.
    if gap.abs() <= GAP {
        Ok(Optimal { gap: Some(gap), singular: false })
    } else {
        Err(NoCertificate::Gap { gap })
    }
}

/// Energy of doubling the lengths of all elastic members, for systems without loads.
fn elastic_unit_j(system: &System) -> f64 {
    let energies = system.members().iter();
    sum(energies.filter_map(|m| Some(0.5 * m.stiffness_n? * m.body.length_m())))
}

/// Force densities that the members' laws allow as subgradients: the nearest to those of the
/// answer, N/m.
fn densities(system: &System, answer: &SystemEquilibrium) -> Vec<f64> {
    let of_member = |(member, axial_n): (&Member, &f64)| {
        let distance_m = norm(minus(answer.joints_m[member.to], answer.joints_m[member.from]));
        if distance_m <= 0.0 {
            return 0.0;
        }
        member.kind.borne(axial_n / distance_m)
    };
    system.members().iter().zip(&answer.axial_n).map(of_member).collect()
}

/// The stress matrix over the joints that can move.
fn stress_matrix(system: &System, densities: &[f64]) -> Symmetric {
    let mut rows = vec![usize::MAX; system.joints().len()];
    let mut size = 0;
    for (row, joint) in rows.iter_mut().zip(system.joints()) {
        if !joint.support.is_fixed() {
            *row = size;
            size += 1;
        }
    }
    let (mut diagonal, mut terms) = (vec![0.0; size], vec![0.0_f64; size]);
    let mut below = Vec::with_capacity(densities.len());
    for (member, density) in system.members().iter().zip(densities) {
        let (a, b) = (rows[member.from], rows[member.to]);
        for row in [a, b] {
            if row < size {
                diagonal[row] += density;
                terms[row] += density.abs();
            }
        }
        if a < size && b < size {
            below.push((a.max(b), a.min(b), -density));
        }
    }
    // Sums of at most as many terms as members meet in a joint, on the diagonal and beside it.
    let largest = terms.into_iter().fold(0.0, f64::max);
    let uncertainty = 2.0 * gamma(largest_degree(system)) * largest;
    Symmetric { size, below, diagonal, uncertainty }
}

/// The most members that meet in a joint.
fn largest_degree(system: &System) -> usize {
    let mut degrees = vec![0_usize; system.joints().len()];
    for member in system.members() {
        degrees[member.from] += 1;
        degrees[member.to] += 1;
    }
    degrees.into_iter().max().unwrap_or(0)
}

/// Units in the last place that the operations of one term come to: fewer than 16 roundings of half
/// a unit each, and as many again for those of the bound itself.
const TERM_ULPS: f64 = 16.0;

/// A function below the energy, at an answer, while it is added up. Each number is paired with the size of
/// all that was rounded on the way: of differences, with the size of what was subtracted.
pub(super) struct Below<'a> {
    system: &'a System,
    /// Places of the joints from the reference of the energy, m.
    pub(super) places_m: Vec<Vector>,
    /// Loads of the joints, with the pushes of the floor, N.
    loads_n: Vec<Vector>,
    /// The gradient by the place of each joint, N.
    gradient_n: Vec<(Vector, f64)>,
    /// The terms of the value but for the loads, J.
    pub(super) terms_j: Vec<(f64, f64)>,
}

impl<'a> Below<'a> {
    /// The loads, and the pushes of the floor with the energies of its height under them. Whatever is pushed the
    /// bound holds; what the answer's floor pulls is none.
    pub(super) fn new(system: &'a System, answer: &SystemEquilibrium) -> Self {
        let origin_m = system.reference_m();
        let places_m = answer.joints_m.iter().map(|at_m| minus(*at_m, origin_m)).collect();
        let (mut loads_n, mut terms_j) = (system.joint_loads_n(), vec![]);
        if let Some(floor_m) = system.floor_m() {
            let height_m = floor_m - origin_m[2];
            for (k, load) in loads_n.iter_mut().enumerate() {
                let push_n = push_n(system, answer, k).max(0.0);
                load[2] += push_n;
                terms_j.push((push_n * height_m, (push_n * height_m).abs()));
            }
        }
        let gradient_n = loads_n.iter().map(|load| (times(-1.0, *load), norm(*load))).collect();
        Self { system, places_m, loads_n, gradient_n, terms_j }
    }

    /// What pulls two joints together, and how large what was rounded in it is, N.
    pub(super) fn pull(&mut self, [a, b]: [usize; 2], pull: Vector, size_n: f64) {
        self.gradient_n[b].0 = plus(self.gradient_n[b].0, pull);
        self.gradient_n[a].0 = minus(self.gradient_n[a].0, pull);
        self.gradient_n[a].1 += size_n;
        self.gradient_n[b].1 += size_n;
    }

    /// A lower bound of the value, J, and upper bounds of the gradient by the places that each joint may take, N,
    /// where no more than so many additions meet in a joint, each rounded.
    pub(super) fn bounds(&self, additions: usize) -> (f64, Vec<f64>) {
        let works = self.loads_n.iter().zip(&self.places_m);
        let works = works.map(|(load, at)| (-dot(*load, *at), norm(*load) * norm(*at)));
        let terms = self.terms_j.iter().copied().chain(works);
        let ulps = TERM_ULPS * f64::EPSILON;
        let rounding_j = ulps * sum(terms.clone().map(|(_, size)| size));
        let ulps = ulps + f64::EPSILON * additions as f64;
        let left_n = |(joint, (force, size)): (&Joint, &(Vector, f64))| {
            let moving = || norm(joint.support.free_part(*force)) + ulps * size;
            if joint.support.is_fixed() { 0.0 } else { moving() }
        };
        let left_n = self.system.joints().iter().zip(&self.gradient_n).map(left_n).collect();
        (sum(terms.map(|(term, _)| term)) - rounding_j, left_n)
    }
}

/// The quadratic function below the energy at an answer: a lower bound of its value there, J, and an upper bound of
/// the square of its gradient by the places that the joints may take, N².
fn tangent(system: &System, answer: &SystemEquilibrium, densities: &[f64]) -> (f64, f64) {
    let mut below = Below::new(system, answer);
    for (member, density) in system.members().iter().zip(densities) {
        let along = minus(below.places_m[member.to], below.places_m[member.from]);
        let pull = times(*density, along);
        below.pull([member.from, member.to], pull, norm(pull));
        below.terms_j.push(tangent_j(member, *density, dot(along, along)));
    }
    let (value_j, left_n) = below.bounds(largest_degree(system));
    (value_j, sum(left_n.iter().map(|most| most * most)))
}

/// The tangent to a member's potential with the slope `w/2`, at the squared distance `t`, and the
/// size of what is rounded in it, J.
fn tangent_j(member: &Member, density: f64, squared_m2: f64) -> (f64, f64) {
    let length_m = member.body.length_m();
    let Some(stiffness_n) = member.stiffness_n else {
        let kept_m2 = length_m * length_m;
        let size = 0.5 * density.abs() * (squared_m2 + kept_m2);
        return (0.5 * density * (squared_m2 - kept_m2), size);
    };
    // With the distance d* of this slope, k/2 (d* - l)^2 + w/2 (t - d*^2).
    let rate = stiffness_n / length_m;
    let stretched_m = length_m / (1.0 - density / rate);
    let stretch_m = stretched_m - length_m;
    let kept_m2 = stretched_m * stretched_m;
    let size = rate * stretch_m.abs() * (length_m + stretched_m.abs())
        + 0.5 * density.abs() * (squared_m2 + kept_m2);
    (0.5 * rate * stretch_m * stretch_m + 0.5 * density * (squared_m2 - kept_m2), size)
}

#[cfg(test)]
mod tests;
