//! Motion as the third road to the same answers: what moves with damping comes to rest where the
//! solvers say, what leaves an unstable equilibrium does so at the rate of its mode, and the signs
//! of the modes give the index.

use model::system::System;
use model::{Equilibrium, Problem, Vector};
use motion::{MotionError, Order, Settings, Simulation, What, modes, random_position};
use rayon::prelude::*;

/// Longest chain of the registry whose census is taken here.
const CENSUS_BARS: usize = 6;

fn hanging(problem: &Problem) -> Equilibrium {
    let settings = lagrange::condensed::Settings::default();
    lagrange::condensed::solve(problem, &settings).unwrap().equilibrium
}

/// All planar equilibria by the census.
fn equilibria(problem: &Problem) -> Vec<Equilibrium> {
    let census = census::Census::take(problem, &census::Settings::default()).unwrap();
    census.positions().map(|position| census.position_to_model(&position)).collect()
}

#[test]
fn the_signs_of_the_modes_give_the_index_of_every_equilibrium() {
    let (mut judged, mut refused) = (0, Vec::new());
    for case in model::cases::all() {
        let problem = case.problem();
        let system = System::from(problem.chain());
        let mut list = vec![hanging(&problem)];
        if problem.chain().bars().len() <= CENSUS_BARS {
            list.extend(equilibria(&problem));
        }
        for found in list {
            match modes(&system, &found.joints_m, Some(&found.axial_n)) {
                Ok(told) => {
                    let index = found.stability.index_in_space;
                    assert_eq!(told.index(), index, "{}: {:?}", case.name, told.modes);
                    // A turn about one vertical is the only neutral motion here.
                    let turns = problem.chain().anchors_on_one_vertical();
                    assert_eq!(told.neutral(), usize::from(turns), "{}", case.name);
                    judged += 1;
                }
                Err(MotionError::Massless { .. }) => refused.push(case.name),
                Err(error) => panic!("{}: {error}", case.name),
            }
        }
    }
    refused.dedup();
    // Two massless links meet in a joint without inertia.
    assert_eq!(refused, ["massless-links"]);
    assert!(judged > 40, "{judged}");
}

/// Largest distance of the joints from those of an equilibrium that is turned about the vertical
/// through the first anchor, m.
fn from_circle(at: &[Vector], equilibrium: &[Vector]) -> f64 {
    let axis = at[0];
    let level = |x: &Vector| [x[0] - axis[0], x[1] - axis[1]];
    let ([x, y], [u, v]) = (level(&at[1]), level(&equilibrium[1]));
    let (cos, sin) = (x * u + y * v, y * u - x * v);
    let size = cos.hypot(sin);
    let (cos, sin) = (cos / size, sin / size);
    let distance = |(a, b): (&Vector, &Vector)| {
        let [u, v] = level(b);
        let turned = [cos * u - sin * v + axis[0], sin * u + cos * v + axis[1], b[2]];
        (0..3).map(|k| (a[k] - turned[k]).powi(2)).sum::<f64>().sqrt()
    };
    at.iter().zip(equilibrium).map(distance).fold(0.0, f64::max)
}

#[test]
fn released_with_damping_the_papers_chain_comes_to_rest_on_the_circle_of_its_least_energy() {
    // SEEDS=10000 for more of them.
    let seeds: u64 = std::env::var("SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let problem = model::cases::paper();
    let system = System::from(problem.chain());
    let least = hanging(&problem).joints_m;
    let upright = equilibria(&problem)
        .into_iter()
        .max_by(|a, b| a.energy_j.total_cmp(&b.energy_j))
        .unwrap()
        .joints_m;
    let settings = Settings { damping_1_s: 3.0, ..Settings::default() };
    let ends: Vec<(f64, f64)> = (0..seeds)
        .into_par_iter()
        .map(|seed| {
            let at = random_position(&system, seed).unwrap();
            let mut chain = Simulation::new(&system, &at, settings).unwrap();
            for _ in 0..4000 {
                chain.step(0.01).unwrap();
            }
            let rest = chain.joints_m();
            (from_circle(&rest, &least), from_circle(&rest, &upright))
        })
        .collect();
    let worst = ends.iter().fold(0.0, |most: f64, end| most.max(end.0));
    let nearest = ends.iter().fold(f64::INFINITY, |least: f64, end| least.min(end.1));
    println!("{seeds} seeds: off the circle {worst:e} m, from the upright one {nearest} m");
    assert!(ends.iter().all(|end| end.0 < 1e-8), "{worst:e}");
    assert!(nearest > 0.1, "{nearest}");
}

#[test]
fn pushed_off_its_unstable_equilibrium_the_chain_leaves_at_the_rates_of_its_modes() {
    let problem = model::cases::paper();
    let system = System::from(problem.chain());
    let upright = equilibria(&problem)
        .into_iter()
        .find(|found| found.stability.index_in_space == 2)
        .unwrap()
        .joints_m;
    let told = modes(&system, &upright, None).unwrap();
    let leaving: Vec<_> = told.modes.iter().filter(|mode| mode.what == What::Leaving).collect();
    assert_eq!(leaving.len(), 2);
    let settings = Settings { order: Order::Fourth, ..Settings::default() };
    for mode in leaving {
        let rate = mode.rate_1_s().unwrap();
        let mut chain = Simulation::new(&system, &upright, settings).unwrap();
        let start = chain.joints_m();
        let push: Vec<Vector> = mode.shape.iter().map(|v| v.map(|x| 1e-9 * x)).collect();
        chain.set_velocities(&push).unwrap();
        // The part of the mode in the displacement: v/r sinh(r t), so that at twice the time it is
        // 2 cosh(r t) times as large.
        let part = |chain: &Simulation| {
            let moved = chain.joints_m();
            let mut sum = [0.0; 2];
            for ((x, x0), v) in moved.iter().zip(&start).zip(&mode.shape) {
                for k in 0..3 {
                    sum[0] += (x[k] - x0[k]) * v[k];
                    sum[1] += v[k] * v[k];
                }
            }
            sum[0] / sum[1]
        };
        let steps = (4.0 / rate / 1e-3).round();
        let run = |chain: &mut Simulation| {
            let mut left = steps;
            while left > 0.0 {
                chain.step(1e-3).unwrap();
                left -= 1.0;
            }
            part(chain)
        };
        let (once, twice) = (run(&mut chain), run(&mut chain));
        let measured = (0.5 * twice / once).acosh() / (1e-3 * steps);
        println!("rate {rate} 1/s by the mode, {measured} by the motion");
        assert!((measured / rate - 1.0).abs() < 5e-6, "{measured} {rate}");
    }
}
