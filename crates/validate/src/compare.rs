//! Two answers held against each other, and each against Newton's laws.

use model::{Bar, Chain, Equilibrium, Problem, Rung, Vector};
use serde::Serialize;

use crate::books::{Books, books};
use crate::certificate::certify;
use crate::statics::{Statics, judge, stored_rounding_m};
use crate::tolerances::Tolerances;

/// How far two answers agree: the object `agreement` of the JSON.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// Largest distance of a joint in one answer from the same joint in the other, m.
    pub joints_m: f64,
    /// Largest difference of a joint force, N.
    pub forces_n: f64,
    /// Difference of the energies, J.
    pub energy_j: f64,
    /// With both anchors on one vertical every turn about it is an equilibrium too: the angle by
    /// which the second answer was turned onto the first before the comparison, rad.
    pub turned_rad: Option<f64>,
    /// Joints without load between bars without force, in both answers: they may be anywhere that
    /// the lengths of the bars allow, so their places are judged by Newton's laws alone.
    pub free_joints: usize,
    /// Violations of Newton's laws by each answer.
    pub statics: [Statics; 2],
    /// Whether the other numbers of each answer follow from its joints and forces.
    pub books: [Books; 2],
    /// Whether all of these are within their budgets.
    pub verdict: Verdict,
    /// What exceeds its budget.
    pub reasons: Vec<String>,
}

/// Whether two answers are one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// All differences are within their budgets, and both answers in balance.
    Agreed,
    /// Something is not.
    Disagreed,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if *self == Self::Agreed { "agreed" } else { "disagreed" })
    }
}

impl Agreement {
    /// Whether the two answers are one.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.verdict == Verdict::Agreed
    }
}

/// Units in which differences are judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Total length, m.
    pub length_m: f64,
    /// The larger of the total weight and the largest joint force, N.
    pub force_n: f64,
    /// Total weight × total length, J.
    pub energy_j: f64,
    /// Rounding of a joint's coordinates: they are stored in the world frame, however far from its
    /// origin the anchors are, m.
    pub rounding_m: f64,
}

impl Units {
    /// The units of a chain whose largest joint force is known.
    #[must_use]
    pub fn new(chain: &Chain, multipliers_n: &[Vector]) -> Self {
        let length_m = chain.total_length_m();
        let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
        Self {
            length_m,
            force_n: multipliers_n.iter().map(|f| norm(*f)).fold(weight_n, f64::max),
            energy_j: weight_n * length_m,
            rounding_m: stored_rounding_m(chain),
        }
    }
}

/// Hold two answers against each other and each against Newton's laws, and write what that proves into
/// their evidence: `agreed`, and `optimal` where a certificate exists.
#[must_use]
pub fn compare(
    problem: &Problem,
    answers: &mut [Equilibrium; 2],
    tolerances: &Tolerances,
) -> Agreement {
    let chain = problem.chain();
    let agreement = differences(chain, answers, tolerances);
    for answer in answers.iter_mut() {
        if agreement.agrees() {
            answer.evidence.reach(
                Rung::Agreed,
                format!(
                    "lagrange and energy differ by {:.1e} m, {:.1e} N, {:.1e} J; the statics judge finds \
                     every bar in balance to {:.1e}",
                    agreement.joints_m,
                    agreement.forces_n,
                    agreement.energy_j,
                    worst(agreement.statics.iter().map(Statics::largest)),
                ),
            );
        } else {
            answer.evidence.miss(Rung::Agreed, agreement.reasons.join("; "));
        }
        certify_rung(problem, answer);
    }
    agreement
}

/// Judge one answer that has no second to compare with.
pub fn judge_alone(problem: &Problem, answer: &mut Equilibrium) -> Statics {
    answer.evidence.miss(Rung::Agreed, "only one solver was asked");
    certify_rung(problem, answer);
    judge(problem.chain(), &answer.joints_m, &answer.multipliers_n)
}

/// The rungs above `agreed`.
fn certify_rung(problem: &Problem, answer: &mut Equilibrium) {
    for rung in [Rung::Verified, Rung::Complete] {
        answer.evidence.miss(rung, "no interval proof was tried (`funicular census` does)");
    }
    match certify(problem, answer) {
        Ok(proof) => answer.evidence.reach(
            Rung::Optimal,
            format!(
                "the stress matrix is positive semidefinite{}: no configuration has less energy than \
                 {:.1e} of weight times length below this one",
                if proof.singular { " (singular: the free turn about the vertical)" } else { "" },
                proof.gap,
            ),
        ),
        Err(doubt) => answer.evidence.miss(Rung::Optimal, doubt.to_string()),
    }
}

fn differences(chain: &Chain, answers: &[Equilibrium; 2], tolerances: &Tolerances) -> Agreement {
    let [first, second] = answers;
    let units = Units::new(chain, &first.multipliers_n);
    let turned_rad = free_turn(chain).then(|| turn_onto(chain, first, second));
    let (sin, cos) = turned_rad.unwrap_or(0.0).sin_cos();
    let origin = chain.anchors().start_m;
    let turned = |[x, y, z]: Vector| [cos * x - sin * y, sin * x + cos * y, z];
    let place = |joint: &Vector| std::array::from_fn(|k| joint[k] - origin[k]);

    let free = free_joints(chain, answers, tolerances.forces.value * units.force_n);
    let held = |joints_m: &[Vector], k: usize| if free[k] { origin } else { joints_m[k] };
    let joints_m = if answers.iter().all(|answer| answer.joints_m.len() == free.len()) {
        let pairs = (0..free.len()).map(|k| [held(&first.joints_m, k), held(&second.joints_m, k)]);
        worst(pairs.map(|[a, b]| distance(place(&a), turned(place(&b)))))
    } else {
        f64::NAN
    };
    let free_joints = free.iter().filter(|free| **free).count();
    let forces_n =
        largest(&first.multipliers_n, &second.multipliers_n, |a, b| distance(*a, turned(*b)));
    let energy_j = (first.energy_j - second.energy_j).abs();
    let statics = answers.each_ref().map(|a| judge(chain, &a.joints_m, &a.multipliers_n));
    let books = answers.each_ref().map(|a| books(chain, a));

    let mut reasons = Vec::new();
    let mut budget = |what: &str, value: f64, limit: f64| {
        // NaN is over every budget.
        if value.is_nan() || value > limit {
            reasons.push(format!("{what}: {value:.2e} is over its budget of {limit:.2e}"));
        }
    };
    budget("joints / m", joints_m, tolerances.joints.value * units.length_m + units.rounding_m);
    budget("forces / N", forces_n, tolerances.forces.value * units.force_n);
    budget("energy / J", energy_j, tolerances.energy.value * units.energy_j);
    for (answer, statics) in answers.iter().zip(&statics) {
        budget(
            &format!("statics of {}, at bar {}", answer.solver, statics.worst_bar),
            statics.largest(),
            tolerances.statics.value,
        );
    }
    for (answer, books) in answers.iter().zip(&books) {
        budget(
            &format!("energy of {} less that of its joints", answer.solver),
            books.energy,
            tolerances.energy.value,
        );
        budget(
            &format!("axial forces and reactions of {} less its joint forces", answer.solver),
            books.forces(),
            tolerances.statics.value,
        );
    }
    if first.stability != second.stability {
        reasons.push(format!(
            "stability: {:?} by {}, {:?} by {}",
            first.stability, first.solver, second.stability, second.solver
        ));
    }
    let verdict = if reasons.is_empty() { Verdict::Agreed } else { Verdict::Disagreed };
    Agreement {
        joints_m,
        forces_n,
        energy_j,
        turned_rad,
        free_joints,
        statics,
        books,
        verdict,
        reasons,
    }
}

/// A joint with less than this part of the total weight carries no load: a rounding of the weight.
const NO_LOAD: f64 = f64::EPSILON;

/// Which joints 0..=n carry no load and lie between bars that carry no force in either answer: an
/// equilibrium does not say where such a joint is. Where a joint without load lies between bars with
/// force, the two are parallel, and it is held.
fn free_joints(chain: &Chain, answers: &[Equilibrium; 2], no_force_n: f64) -> Vec<bool> {
    let bars = chain.bars();
    let mut free = vec![false; bars.len() + 1];
    let no_load_kg = NO_LOAD * chain.total_mass_kg();
    // What of a bar's mass its second end carries.
    let beyond = |bar: &Bar| bar.mass_kg() * (bar.centre_m() / bar.length_m());
    for k in 1..bars.len() {
        let load_kg = beyond(&bars[k - 1]) + (bars[k].mass_kg() - beyond(&bars[k]));
        // Arrays that do not fit, and NaN, free nothing.
        let limp = |bar: usize| {
            answers.iter().all(|a| a.axial_n.get(bar).is_some_and(|n| n.abs() <= no_force_n))
        };
        free[k] = load_kg <= no_load_kg && limp(k - 1) && limp(k);
    }
    free
}

/// Whether the chain turns freely about the vertical through both anchors.
#[must_use]
pub fn free_turn(chain: &Chain) -> bool {
    let [x, y, _] = chain.anchors().difference_m();
    x.hypot(y) <= model::STRAIGHT_TOLERANCE * chain.total_length_m()
}

/// The turn about the vertical that brings the joints of `second` closest to those of `first`.
fn turn_onto(chain: &Chain, first: &Equilibrium, second: &Equilibrium) -> f64 {
    let [ox, oy, _] = chain.anchors().start_m;
    let (mut along, mut across) = (0.0, 0.0);
    for (a, b) in first.joints_m.iter().zip(&second.joints_m) {
        let (ax, ay, bx, by) = (a[0] - ox, a[1] - oy, b[0] - ox, b[1] - oy);
        along += ax * bx + ay * by;
        across += bx * ay - by * ax;
    }
    f64::atan2(across, along)
}

/// Largest difference of two arrays, by the given measure; NaN if they differ in length.
fn largest(a: &[Vector], b: &[Vector], measure: impl Fn(&Vector, &Vector) -> f64) -> f64 {
    if a.len() != b.len() {
        return f64::NAN;
    }
    worst(a.iter().zip(b).map(|(a, b)| measure(a, b)))
}

/// The largest value, NaN if there is one (`f64::max` would forget it).
fn worst(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

fn distance(a: Vector, b: Vector) -> f64 {
    norm(std::array::from_fn(|k| a[k] - b[k]))
}

fn norm([x, y, z]: Vector) -> f64 {
    x.hypot(y).hypot(z)
}
