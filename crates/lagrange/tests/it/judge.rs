//! Judge an answer by Newton's laws and by the stress matrix, from joints and forces alone. Nothing
//! of the solver is used.

use model::{Equilibrium, Problem, Vector};

/// What is wrong with an answer: largest errors, in units of the largest force and the total
/// length.
#[derive(Debug, Clone, Copy)]
pub struct Judgement {
    /// Lengths of the bars.
    pub length: f64,
    /// First and last joint at their anchors.
    pub closure: f64,
    /// Forces on each bar.
    pub force: f64,
    /// Moments on each bar.
    pub moment: f64,
    /// Energy from the heights of the centres, in units of the total weight and length.
    pub energy: f64,
    /// Whether the stress matrix is positive semidefinite: no configuration has less energy.
    pub lowest: bool,
}

impl Default for Judgement {
    fn default() -> Self {
        Self { length: 0.0, closure: 0.0, force: 0.0, moment: 0.0, energy: 0.0, lowest: true }
    }
}

impl Judgement {
    /// Whether every error is at most `bound`; NaN is not.
    pub fn within(&self, bound: f64) -> bool {
        let Self { length, closure, force, moment, energy, .. } = *self;
        [length, closure, force, moment, energy].iter().all(|error| *error <= bound)
    }
}

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(a: Vector) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

/// Judge an answer.
pub fn judge(problem: &Problem, answer: &Equilibrium) -> Judgement {
    let chain = problem.chain();
    let (bars, anchors) = (chain.bars(), chain.anchors());
    let gravity = chain.gravity_m_s2();
    let (joints, multipliers) = (&answer.joints_m, &answer.multipliers_n);
    assert_eq!(joints.len(), bars.len() + 1);
    assert_eq!(multipliers.len(), bars.len() + 1);
    assert_eq!(answer.axial_n.len(), bars.len());
    let total = chain.total_length_m();
    let weight = chain.total_mass_kg() * gravity;
    let force = multipliers.iter().map(|f| norm(*f)).fold(weight, f64::max);
    // Coordinates far from the origin carry their own rounding.
    let place = joints.iter().flatten().fold(total, |most, x| most.max(x.abs()));

    let mut found = Judgement::default();
    let keep = |worst: &mut f64, error: f64| {
        // A NaN is worse than anything.
        if error.is_nan() || error > *worst {
            *worst = error;
        }
    };
    let ends = [(joints[0], anchors.start_m), (joints[bars.len()], anchors.end_m)];
    for (joint, anchor) in ends {
        keep(&mut found.closure, norm(minus(joint, anchor)) / place);
    }
    let mut energies = Vec::new();
    for (i, bar) in bars.iter().enumerate() {
        let way = minus(joints[i + 1], joints[i]);
        keep(&mut found.length, (norm(way) - bar.length_m()).abs() / place);
        // On bar 1 the ground acts at joint 0; on others the bar before, with the opposite of its
        // multiplier.
        let at_first = if i == 0 { multipliers[0] } else { multipliers[i].map(|x| -x) };
        let at_second = multipliers[i + 1];
        let bar_weight = bar.mass_kg() * gravity;
        let sum = [0, 1, 2].map(|k| at_first[k] + at_second[k]);
        keep(&mut found.force, norm([sum[0], sum[1], sum[2] - bar_weight]) / force);
        let lever = bar.centre_m() / bar.length_m();
        let about_centre = minus(
            cross(way.map(|x| x * (1.0 - lever)), at_second),
            cross(way.map(|x| x * lever), at_first),
        );
        keep(&mut found.moment, norm(about_centre) / (force * place));
        let height = joints[i][2] + lever * way[2] - joints[0][2];
        energies.push(bar_weight * height);
    }
    let energy = model::sum(energies);
    keep(&mut found.energy, (energy - answer.energy_j).abs() / (weight * place));
    found.lowest = positive_semidefinite(problem, answer);
    found
}

/// Whether the stress matrix, tridiagonal with $\tau_i + \tau_{i+1}$ on and $-\tau_{i+1}$ beside
/// the diagonal, has no negative pivot beyond rounding. The part of a pivot that comes from the
/// left is the stiffness of the bars $\tau_1, \tau_2, \ldots$ in series.
fn positive_semidefinite(problem: &Problem, answer: &Equilibrium) -> bool {
    /// Axial forces are known to this part of the largest one.
    const KNOWN: f64 = 1e-12;
    let bars = problem.chain().bars();
    let largest = answer.axial_n.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let stiffness: Vec<f64> =
        answer.axial_n.iter().zip(bars).map(|(force, bar)| force / bar.length_m()).collect();
    let error: Vec<f64> = bars.iter().map(|bar| KNOWN * largest / bar.length_m()).collect();
    let mut left = stiffness[0];
    let mut left_error = error[0];
    for i in 1..stiffness.len() {
        let pivot = left + stiffness[i];
        let pivot_error = left_error + error[i];
        if pivot < -pivot_error {
            return false;
        }
        if pivot <= pivot_error {
            // Zero: allowed only at the end, or where no force acts at all beside it.
            let rest = &stiffness[i + 1..];
            return rest.iter().zip(&error[i + 1..]).all(|(next, error)| *next >= -error);
        }
        // 1/left' = 1/left + 1/next, and how errors go through it.
        let (a, b) = (stiffness[i] / pivot, left / pivot);
        left *= a;
        left_error = a * a * left_error + b * b * error[i];
    }
    true
}
