//! A bound from any configuration and any force densities: the certificate of global optimality.

use intervals::{Interval, IntervalSum};
use model::{Problem, Vector};

use crate::data::{Data, Sense};

/// What [`stress_bound`] proves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressBound {
    /// No configuration in space has less energy, J (more, for an upper bound).
    pub rigorous_j: f64,
    /// By what fraction the force densities had to be raised for the proof: 0, or a few roundings
    /// where the stress matrix of the optimum is singular. Not small where there is nothing to
    /// prove.
    pub raised: f64,
}

/// A rigorous bound on the energy of every configuration, from joint positions and force densities
/// that need not be exact.
///
/// With a multiplier τ_i/2 for each $|d_i|^2 = l_i^2$, the Lagrangian
///
/// $$ L(x, \tau) = \sum_k W_k z_k
///    + \tfrac12 \sum_i \tau_i \left(|x_i - x_{i-1}|^2 - l_i^2\right) $$
///
/// equals the energy on every configuration, so its minimum over free joints x is below the energy
/// of all of them. It is a quadratic function; its second derivative, the same for X, Y and Z, is
/// the stress matrix: tridiagonal, τ_k + τ_{k+1} on the diagonal, −τ_k beside it. If that is
/// positive definite, then around any point $\hat x$ with gradient $r = \nabla L(\hat x)$
///
/// $$ \min_x L = L(\hat x) - \tfrac12\, r^T \Omega^{-1} r . $$
///
/// The second term is of the order of the squared errors of $\hat x$. Eliminating the joints one
/// after the other, $u_1 = \tau_1$, $u_{k+1} = u_k \tau_{k+1} / (u_k + \tau_{k+1})$ (springs in a
/// row), proves the definiteness (every pivot $u_k + \tau_{k+1} > 0$) and evaluates the bound in
/// one pass over the bars. All of it is done in interval arithmetic, from the doubles of the chain:
/// no configuration in space has less energy than what is returned, whatever the rounding.
///
/// On one vertical the stress matrix of the minimum is singular (the chain can turn about it).
/// Then, and when rounding hides the sign of a pivot, the force densities are raised a little until
/// the proof goes through; the bound falls short by as much as they were raised.
///
/// `joints_m`: n + 1 positions, world frame, m; the first and the last are taken to be the anchors.
/// `force_density_n_m`: axial force over length of each bar, N/m, tension positive; for
/// [`Sense::Upper`] as well (at a maximum every bar but one is compressed).
///
/// `None` when the lengths of the lists are not those of the chain, when a number is not finite,
/// and when the stress matrix is not positive semidefinite (negative, for an upper bound) even
/// after raising: then this configuration is not certified, and if it is an equilibrium, it is not
/// the global optimum.
///
/// ```
/// use bounds::{Sense, stress_bound};
/// use model::{Anchors, Bar, Chain, Problem};
/// // Two bars of weight 1 N hang in an equilateral triangle: the joint is at depth √3/2, and
/// // V = -√3/2.
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
/// let chain = Chain::new("two bars", 1.0, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 2])?;
/// let problem = Problem::new(chain)?;
/// let depth = 0.75_f64.sqrt();
/// let joints = [[0.0; 3], [0.5, 0.0, -depth], [1.0, 0.0, 0.0]];
/// // The joint carries 1 N: 2 τ depth = 1.
/// let density = [0.5 / depth; 2];
/// let bound = stress_bound(&problem, Sense::Lower, &joints, &density).unwrap().rigorous_j;
/// assert!(bound <= -depth && bound > -depth - 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
///
/// R. Connelly, Invent. Math. 66 (1982) 11-33, doi:10.1007/BF01404753 (stress matrices and global
/// rigidity: super stability); H.-J. Schek, Comput. Methods Appl. Mech. Eng. 3 (1974) 115-134,
/// doi:10.1016/0045-7825(74)90045-0 (force densities).
#[must_use]
pub fn stress_bound(
    problem: &Problem,
    sense: Sense,
    joints_m: &[Vector],
    force_density_n_m: &[f64],
) -> Option<StressBound> {
    let data = Data::new(problem, sense);
    let n = data.bars();
    if joints_m.len() != n + 1 || force_density_n_m.len() != n {
        return None;
    }
    let start = problem.chain().anchors().start_m;
    let bars: Vec<Vector> = joints_m
        .windows(2)
        .enumerate()
        .map(|(i, ends)| {
            let from = if i == 0 { start } else { ends[0] };
            std::array::from_fn(|k| (ends[1][k] - from[k]) / data.scale.length)
        })
        .collect();
    let tau: Vec<f64> = force_density_n_m
        .iter()
        .map(|t| data.scale.without_force_density(sense.sign() * t))
        .collect();
    certify(&data, &bars, &tau).map(|proof| StressBound {
        rigorous_j: sense.rigorous(data.scale, proof.value),
        raised: proof.raised,
    })
}

/// A proved bound without units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Proof {
    /// No configuration has less energy.
    pub(crate) value: f64,
    /// By what fraction the force densities were raised.
    pub(crate) raised: f64,
}

/// First fraction by which the force densities are raised when they do not do as they are: one
/// rounding.
const FIRST_RAISE: f64 = f64::EPSILON;
/// From one attempt to the next. The bound falls short in proportion to the raise, so the factor is
/// what is lost at most.
const RAISE_FACTOR: f64 = 2.0;
/// Where it is given up: the force densities belong to no minimum.
const LAST_RAISE: f64 = 1e-2;

/// The bound from bar vectors (the last one is replaced by what closes the chain) and force
/// densities, raised if need be.
pub(crate) fn certify(data: &Data, bars: &[Vector], tau: &[f64]) -> Option<Proof> {
    if !tau.iter().chain(bars.iter().flatten()).all(|x| x.is_finite()) {
        return None;
    }
    let (mut raise, mut best) = (0.0, None::<Proof>);
    while raise <= LAST_RAISE {
        let raised: Vec<f64> = tau
            .iter()
            .zip(&data.length)
            .map(|(t, l)| t + raise * (t.abs() + raise / l.hi()))
            .collect();
        let value = lower_bound(data, bars, &raised);
        // A pivot that is barely positive is barely an aid: raise on while it pays.
        match (value, &best) {
            (Some(value), Some(before)) if value <= before.value => break,
            (Some(value), _) => best = Some(Proof { value, raised: raise }),
            (None, _) => {}
        }
        raise = if raise > 0.0 { RAISE_FACTOR * raise } else { FIRST_RAISE };
    }
    best
}

/// The bound, or `None` when a pivot is not proved positive.
fn lower_bound(data: &Data, bars: &[Vector], tau: &[f64]) -> Option<f64> {
    let n = data.bars();
    // The last bar vector, as the exact difference: the configuration then closes by construction.
    let mut last = [IntervalSum::ZERO; 3];
    for (k, sum) in last.iter_mut().enumerate() {
        sum.add(data.difference[k]);
        for bar in &bars[..n - 1] {
            sum.add(Interval::point(-bar[k]));
        }
    }
    let last = last.map(|sum| sum.value());
    let bar = |i: usize| if i + 1 == n { last } else { bars[i].map(Interval::point) };

    let mut total = IntervalSum::ZERO;
    let mut stiffness = Interval::point(tau[0]);
    let mut load = [Interval::ZERO; 3];
    let mut force = bar(0).map(|d| Interval::point(tau[0]) * d);
    for i in 0..n {
        let d = bar(i);
        let t = Interval::point(tau[i]);
        total.add(data.tail_weight[i] * d[2]);
        let square = d[0].square() + d[1].square() + d[2].square();
        total.add(t * (square - data.length[i].square()) * Interval::point(0.5));
        if i + 1 == n {
            break;
        }
        // Joint i + 1, between this bar and the next: its residual force, then its elimination.
        let next = Interval::point(tau[i + 1]);
        let next_force = bar(i + 1).map(|d| next * d);
        let pivot = stiffness + next;
        if !(pivot.lo() > 0.0 && pivot.hi().is_finite()) {
            return None;
        }
        for k in 0..3 {
            let weight = if k == 2 { data.joint_weight[i] } else { Interval::ZERO };
            let a = load[k] + (weight + (force[k] - next_force[k]));
            total.add(-(a.square() / pivot * Interval::point(0.5)));
            load[k] = a * next / pivot;
        }
        stiffness = stiffness * next / pivot;
        force = next_force;
    }
    let value = total.value().lo();
    value.is_finite().then_some(value)
}
