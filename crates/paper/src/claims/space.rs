//! Section IX: initial conditions, turns about the vertical, infinities.

use lagrange::{Seed, relative_residual};
use model::{Chain, Equilibrium, Reactions, SolverName, Vector};
use nalgebra::DVector;
use validate::lever::centre_part;
use validate::systems::judge_chain;

use super::{ANGLE_RAD, Facts, Finding, largest};
use crate::printed::{Assessment, Printed};
use crate::seeds::Kind;
use crate::sentence::Sentence;

pub(super) fn judge(facts: &Facts, printed: &Printed) -> Option<Finding> {
    match printed.id.as_str() {
        "initial-conditions" => initial_conditions(facts),
        "turned" => Some(turned(facts)),
        "infinity" => Some(infinity(facts)),
        _ => None,
    }
}

fn initial_conditions(facts: &Facts) -> Option<Finding> {
    let survey =
        |solver| facts.surveys.iter().find(|s| s.solver == solver && s.kind == Kind::Planar);
    let lagrange = survey(SolverName::LAGRANGE)?.distinct() as f64;
    let energy = survey(SolverName::ENERGY)?.distinct() as f64;
    let verdict = Assessment::Refuted.unless(lagrange > 1.5);
    let what = "different equilibria that the same random planar seeds lead to";
    Some(Finding::new(verdict, lagrange, what).lagrange(lagrange).energy(energy))
}

/// Turns about the vertical, rad.
const TURNS: [f64; 5] = [0.4, 1.1, 2.3, -0.9, 3.0];

/// E1 turned is an equilibrium: by the 30 equations, by the gradient of the energy, and by Newton's
/// laws.
fn turned(facts: &Facts) -> Finding {
    let problem = &facts.example.problem;
    let e1 = &facts.example.lagrange.e1.equilibrium;
    let (mut multipliers, mut gradient, mut newton) = (0.0, 0.0, 0.0);
    for turn in TURNS {
        let (sin, cos) = turn.sin_cos();
        let turned = |[x, y, z]: &Vector| [cos * x - sin * y, sin * x + cos * y, *z];
        let joints: Vec<Vector> = e1.joints_m.iter().map(turned).collect();
        let forces: Vec<Vector> = e1.multipliers_n.iter().map(turned).collect();
        let bars: Vec<Vector> = joints
            .windows(2)
            .map(|ends| std::array::from_fn(|k| ends[1][k] - ends[0][k]))
            .collect();
        let [start, end] = [e1.reactions_n.start, e1.reactions_n.end].map(|force| turned(&force));
        let found = Equilibrium {
            joints_m: joints.clone(),
            multipliers_n: forces.clone(),
            reactions_n: Reactions { start, end },
            ..e1.clone()
        };
        newton = largest([newton, judge_chain(problem, &found).largest()]);
        let q = coordinates(problem.chain(), &joints, &bars);
        let lambda = DVector::from_vec(forces.concat());
        multipliers = largest([multipliers, relative_residual(problem.chain(), &q, &lambda)]);
        let second = energy::Seed::directions(problem, &bars)
            .and_then(|seed| energy::second_order(problem, &seed));
        gradient = largest([gradient, second.map_or(f64::NAN, |s| largest([s.residual, s.gap]))]);
    }
    let most = largest([multipliers, gradient, newton]);
    let verdict = Assessment::Refuted.unless(most <= ANGLE_RAD);
    let what = Sentence::filled(
        "largest residual of E1 turned by {} angles: the 30 equations (lagrange), the gradient of the energy \
         (energy), Newton's laws",
        [TURNS.len().into()],
    );
    Finding::new(verdict, most, what).lagrange(multipliers).energy(gradient)
}

/// The coordinates of eq. (21) of bars in space.
fn coordinates(chain: &Chain, joints: &[Vector], bars: &[Vector]) -> DVector<f64> {
    let seed = Seed::directions(bars);
    let mut q = Vec::with_capacity(6 * bars.len());
    for (i, bar) in chain.bars().iter().enumerate() {
        let part = centre_part(bar);
        q.extend((0..3).map(|k| joints[i][k] + part * bars[i][k]));
        q.extend(seed.angles()[i]);
    }
    DVector::from_vec(q)
}

/// Two circles: double in number, single in dimension.
fn infinity(facts: &Facts) -> Finding {
    let example = facts.example;
    let bars = example.problem.chain().bars().len();
    let [e1, _, e2, _] = example.lagrange.all();
    // Every bar can spin about its own axis (or, in gimbal lock, two of its angles are one).
    let dimensions = [e1, e2].map(|found| found.nullity as f64 - bars as f64);
    let nullity = (e1.nullity as f64 - facts.paper.reference("nullity")).abs() < 0.5;
    let energy = [example.energy.e1.equilibrium.evidence.nullity, example.energy.at_e2.nullity];
    let single = largest(dimensions.iter().map(|d| d - 1.0)) < 0.5 && energy == [1, 1];
    let proof = &facts.completeness;
    // The census: so many circles, and each of them a single curve.
    let double = proof.is_closed() && proof.circles == 2;
    let what = Sentence::filled(
        "dimension of the family through E1 (and through E2): nullity less one spin per bar. The census proves that \
         there are {} circles of equilibria and nothing else: the infinity is double in number, not in dimension",
        [proof.circles.into()],
    );
    let shown = nullity && single && double;
    Finding::new(Assessment::Explained.if_shown(shown), dimensions[0], what)
        .lagrange(dimensions[0])
        .energy(energy[0] as f64)
}
