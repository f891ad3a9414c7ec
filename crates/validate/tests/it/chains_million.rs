//! Accuracy does not drift with the number of bars: two hundred thousand of them, or `BARS` (a million by
//! night), judged by Newton's laws.

use lagrange::condensed;
use model::{Anchors, Bar, Chain, Equilibrium, Problem};
use numerics::vector::norm;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use validate::Tolerances;
use validate::systems::judge_chain;

use crate::judged::compare;

fn bars() -> usize {
    std::env::var("BARS").map_or(100_000, |n| n.parse().expect("a number"))
}

/// Closure in total lengths, force balance in weights: the accuracy asked for at any number of
/// bars.
const ACCURACY: f64 = 1e-12;

fn equal_bars(n: usize) -> Problem {
    samples::equal_bars(n, 1.5, 1.0, [1.0, 0.0, -0.2])
}

/// Lengths and masses over a factor of twenty, a tenth of the bars massless, centres anywhere,
/// between anchors that are nowhere special.
fn random_bars(n: usize) -> Problem {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let bars: Vec<Bar> = (0..n)
        .map(|_| {
            let length = rng.random_range(0.1..2.0) / n as f64;
            let massless = rng.random_range(0..10) == 0;
            let mass = if massless { 0.0 } else { rng.random_range(0.1..2.0) };
            Bar::new(length, mass, length * rng.random_range(0.0..1.0), [0.0; 3]).unwrap()
        })
        .collect();
    let anchors = Anchors { start_m: [0.3, -0.2, 0.1], end_m: [0.9, 0.2, 0.4] };
    Problem::new(Chain::new("random", 9.806_65, anchors, bars).unwrap()).unwrap()
}

/// Closure and force balance of the whole, and every law on every bar, within the accuracy.
fn accurate(problem: &Problem, found: &Equilibrium) {
    let chain = problem.chain();
    let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
    let unit_n = found.multipliers_n.iter().map(|f| norm(*f)).fold(weight_n, f64::max);
    let statics = judge_chain(problem, found);
    println!("{} bars, {}: {statics:?}", chain.bars().len(), found.solver);
    assert!(statics.passes(ACCURACY), "{}: {statics:?}", found.solver);
    // The judge measures forces in the largest force; here they are asked for in weights.
    for force in [statics.force, statics.balance] {
        assert!(force * unit_n / weight_n <= ACCURACY, "{}: {statics:?}", found.solver);
    }
    // And the judge forgives the rounding of stored coordinates; nothing is forgiven here.
    let [last, end] = [found.joints_m[chain.bars().len()], chain.anchors().end_m];
    let open_m = norm(std::array::from_fn(|k| last[k] - end[k]));
    println!("  open by {:.1e} of its length", open_m / chain.total_length_m());
    assert!(open_m <= ACCURACY * chain.total_length_m(), "{}: {open_m:e}", found.solver);
}

/// Measured with a million: closure 4e-16, forces 4e-16 of the largest on any bar, 2e-15 on the whole, by either
/// solver.
#[test]
fn long_chains_are_as_accurate_as_short_ones() {
    for problem in [equal_bars(bars()), random_bars(bars())] {
        let settings = condensed::Settings::default();
        let lagrange = condensed::solve(&problem, &settings).unwrap().equilibrium;
        accurate(&problem, &lagrange);
        let energy = energy::minimise(&problem, &energy::Settings::default()).unwrap().equilibrium;
        accurate(&problem, &energy);
        let agreement = compare(&problem, &mut [lagrange, energy], &Tolerances::project());
        assert!(agreement.agrees(), "{:?}", agreement.disagreement);
        println!(
            "  joints {:.1e} m, forces {:.1e} N, energy {:.1e} J",
            agreement.joints_m, agreement.forces_n, agreement.energy_j
        );
    }
}
