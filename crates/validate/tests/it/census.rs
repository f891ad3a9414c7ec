//! The census held against all that does not need it: both solvers, Newton's laws, exact algebra,
//! topology and certificates.

use std::f64::consts::TAU;
use std::time::Instant;

use census::sextic::{SEXTIC, count_roots};
use census::{Census, Settings};
use model::system::System;
use model::{Problem, Reason, Rung, Vector};
use paper::example::Example;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use samples::{General, Line, stream};
use validate::census_checks::{gaps, nearest, placed, statics, visits};
use validate::completeness::certify_by_census;
use validate::systems::ask;
use validate::{Solvers, Tolerances};

/// A random chain in general position; every fifth one hangs between anchors on one vertical.
fn random_problem(bars: usize, seed: u64) -> Problem {
    let line = if seed.is_multiple_of(5) { Line::Vertical } else { Line::Any };
    General::of_censuses(line).problem(&mut stream(seed, bars as u64), bars)
}

fn census(problem: &Problem) -> Census {
    let census = Census::take(problem, &Settings::default()).unwrap();
    assert!(census.complete, "{:?}", census.undecided);
    census
}

/// Random chains of `bars` bars, those with vertical anchors included.
fn chains(bars: std::ops::RangeInclusive<usize>, seeds: u64) -> Vec<(usize, u64)> {
    bars.flat_map(|bars| (0..seeds).map(move |seed| (bars, seed))).collect()
}

/// Uniform directions in the plane of the anchors (OYZ for anchors on one vertical) or in space.
fn random_directions(problem: &Problem, rng: &mut ChaCha8Rng, in_space: bool) -> Vec<Vector> {
    let [x, y, _] = problem.chain().anchors().difference_m();
    let heading = if x.hypot(y) > 0.0 { y.atan2(x) } else { TAU / 4.0 };
    let bars = problem.chain().bars().iter();
    bars.map(|_| {
        let angle: f64 = rng.random_range(0.0..TAU);
        let aside: f64 = if in_space { rng.random_range(-1.0..1.0) } else { 0.0 };
        let (along, up) = (angle.sin(), -angle.cos());
        let (sin, cos) = heading.sin_cos();
        [along * cos - aside * sin, along * sin + aside * cos, up]
    })
    .collect()
}

/// What the seeds of one solver found: how often each listed equilibrium, and how many ended in no
/// equilibrium.
#[derive(Debug)]
struct Found {
    hits: Vec<usize>,
    lost: usize,
}

/// Solve from many seeds by one solver. Panics if one ends in an equilibrium that is not listed.
///
/// Seeds share no state, whatever the number of threads.
fn seeds(
    problem: &Problem,
    census: &Census,
    seeds: usize,
    solve: impl Fn(&[Vector]) -> Option<Vec<Vector>> + Sync,
) -> Found {
    /// What a solver's tolerance leaves where the equilibrium is ill-conditioned, in total lengths;
    /// far below the distance of any two of the list.
    const SEEDED: f64 = 1e-7;
    let ends: Vec<Option<usize>> = (0..seeds)
        .into_par_iter()
        .map(|k| {
            let mut rng = ChaCha8Rng::seed_from_u64(7);
            rng.set_stream(k as u64);
            let joints = solve(&random_directions(problem, &mut rng, k % 2 == 1))?;
            let place = nearest(problem.chain(), census, &joints).unwrap();
            assert!(place.beyond < SEEDED, "{place:?}: not in the census: {joints:?}");
            Some(place.number)
        })
        .collect();
    let mut found = Found { hits: vec![0; census.equilibria.len()], lost: 0 };
    for end in ends {
        match end {
            Some(number) => found.hits[number - 1] += 1,
            None => found.lost += 1,
        }
    }
    found
}

fn by_lagrange(problem: &Problem) -> impl Fn(&[Vector]) -> Option<Vec<Vector>> + Sync {
    let settings = lagrange::Settings::default();
    move |directions| {
        let mut solver = lagrange::Solver::new(problem, &settings).unwrap();
        let outcome = solver.solve(&lagrange::Seed::directions(directions)).ok()?;
        Some(outcome.solution().ok()?.equilibrium.joints_m)
    }
}

fn by_energy(problem: &Problem) -> impl Fn(&[Vector]) -> Option<Vec<Vector>> + Sync {
    let plane = energy::Settings { motion: energy::Motion::Plane, ..energy::Settings::default() };
    move |directions| {
        let seed = energy::Seed::directions(problem, directions).ok()?;
        // In the plane it stops at saddles of space as well, so more is found.
        let found = energy::minimise_from(problem, &seed, &plane).ok()?;
        Some(found.equilibrium.joints_m)
    }
}

/// Every equilibrium that seeds of either solver find is in the list; `STARTS=100000` tries more of them.
#[test]
fn no_seed_finds_what_is_not_listed() {
    let count = std::env::var("STARTS").map_or(3_000, |n| n.parse().unwrap());
    let problem = model::cases::paper();
    let census = census(&problem);
    let clock = Instant::now();
    let lagrange = seeds(&problem, &census, count, by_lagrange(&problem));
    println!("lagrange {lagrange:?} {:.1} s", clock.elapsed().as_secs_f64());
    let clock = Instant::now();
    let energy = seeds(&problem, &census, count, by_energy(&problem));
    println!("energy {energy:?} {:.1} s", clock.elapsed().as_secs_f64());
    // The search is worth something: nearly all seeds end, and both circles are found.
    assert!(lagrange.lost < count / 20 && lagrange.hits.iter().all(|hits| *hits > count / 10));
    assert!(energy.lost < count / 20 && energy.hits[0] > count / 2);
}

#[test]
fn no_seed_on_random_chains_finds_what_is_not_listed() {
    let (mut hit, mut listed) = (0, 0);
    for (bars, seed) in chains(3..=5, 4) {
        let problem = random_problem(bars, seed);
        let census = census(&problem);
        let lagrange = seeds(&problem, &census, 300, by_lagrange(&problem));
        let energy = seeds(&problem, &census, 300, by_energy(&problem));
        println!("{bars} bars, seed {seed}: {lagrange:?} {energy:?}");
        assert!(energy.hits[0] > 0, "the global minimum");
        hit += lagrange.hits.iter().filter(|hits| **hits > 0).count();
        listed += census.equilibria.len();
    }
    println!("{hit} of {listed}");
    assert!(2 * hit > listed, "{hit} of {listed}");
}

/// Take one equilibrium off the list, and the seeds find that it is missing.
#[test]
#[should_panic(expected = "not in the census")]
fn a_seed_finds_what_was_deleted() {
    let problem = model::cases::paper();
    let mut census = census(&problem);
    census.equilibria.remove(1);
    seeds(&problem, &census, 8, by_lagrange(&problem));
}

/// `lagrange` stays where it is started in the list, with the same stability, and Newton's laws
/// hold.
#[test]
fn every_listed_equilibrium_is_one_for_lagrange_and_for_the_statics_judge() {
    let tolerance = Tolerances::project().statics;
    let judged: Vec<(f64, f64)> = chains(3..=6, 10)
        .into_par_iter()
        .map(|(bars, seed)| {
            let problem = random_problem(bars, seed);
            let census = census(&problem);
            let visits = visits(&problem, &census).unwrap();
            assert_eq!(visits.len(), census.equilibria.len());
            for visit in &visits {
                assert!(
                    visit.ended.number == visit.number && visit.same_stability,
                    "{bars} bars, seed {seed}: {visit:?}"
                );
            }
            let off = visits.iter().map(|visit| visit.ended.beyond).fold(0.0, f64::max);
            let allowed = placed(problem.chain());
            assert!(off <= allowed, "{bars} bars, seed {seed}: {off:e}");
            (off, statics(&problem, &census))
        })
        .collect();
    let (off, statics) = judged.iter().fold((0.0_f64, 0.0_f64), |(a, b), (c, d)| {
        assert!(*d <= tolerance, "{d:e}");
        (a.max(*c), b.max(*d))
    });
    println!("lagrange beyond its box {off:.1e}, statics {statics:.1e}");
}

/// No configuration has less energy than the first of the list, none more than the last.
#[test]
fn the_ends_of_the_list_are_certified() {
    /// Gaps at rounding level, in units of weight times length. Measured: see the output.
    const ROUNDING: f64 = 1e-12;
    let mut all = vec![(model::cases::paper(), 0, 0)];
    all.extend(chains(3..=7, 6).into_iter().map(|(bars, k)| (random_problem(bars, k), bars, k)));
    let worst: Vec<[f64; 2]> = all
        .into_par_iter()
        .map(|(problem, bars, seed)| {
            let census = census(&problem);
            let gaps = gaps(&problem, &census).unwrap();
            for gap in gaps {
                assert!(gap.abs() < ROUNDING, "{bars} bars, seed {seed}: {gaps:?}");
            }
            // The first is proved optimal by its stress matrix as well.
            assert!(census.equilibria[0].optimal, "{bars} bars, seed {seed}");
            gaps
        })
        .collect();
    let most = worst.concat().into_iter().map(f64::abs).fold(0.0, f64::max);
    println!("largest gap {most:.1e}");
}

/// Without its first or its last equilibrium nothing certifies a list.
#[test]
fn a_list_cut_short_is_not_certified() {
    let problem = random_problem(5, 3);
    let whole = census(&problem);
    let without = |k: usize| {
        let mut census = whole.clone();
        census.equilibria.remove(k);
        gaps(&problem, &census)
    };
    assert!(without(0).is_err() && without(whole.equilibria.len() - 1).is_err());
}

/// Exact algebra and topology: the paper's chain.
#[test]
fn the_sextic_and_the_topology_count_the_same() {
    let census = census(&model::cases::paper());
    assert_eq!(count_roots(&SEXTIC, -1, 1), Some(census.equilibria.len()));
    // The boxes of the cosines hold the roots that other arithmetic finds.
    let roots = paper::sextic::roots().unwrap();
    for (equilibrium, root) in census.equilibria.iter().rev().zip(&roots) {
        let theta = equilibrium.angles_rad[0];
        // cos falls here; a rounding on either side.
        let [low, high] = [theta.hi().cos() - 1e-15, theta.lo().cos() + 1e-15];
        assert!((low..=high).contains(root), "{low} {root} {high}");
    }
    let topology = census.topology.as_ref().unwrap();
    assert_eq!((census.alternating_sum(), topology.euler), (0, 0));
    assert_eq!(census.morse(), Ok(()));
}

/// The rungs of the ladder: `optimal` for E1 alone, `complete` for E2, and neither for what is not
/// listed.
#[test]
fn the_ladder_is_honest() {
    let example = Example::solve().unwrap();
    let mut e2 = example.lagrange.e2.equilibrium.clone();
    certify_by_census(&example.problem, &example.census, &mut e2);
    assert_eq!(e2.evidence.rung(), Some(Rung::Complete));
    let reached = |answer: &model::Equilibrium, rung| answer.evidence.ladder.is_reached(rung);
    // Turned about the vertical anchors it is on the same circle.
    let mut turned = example.lagrange.e2.equilibrium.clone();
    let (sin, cos) = 0.7_f64.sin_cos();
    for joint in &mut turned.joints_m {
        let [x, y, z] = *joint;
        *joint = [cos * x - sin * y, sin * x + cos * y, z];
    }
    certify_by_census(&example.problem, &example.census, &mut turned);
    assert!(reached(&turned, Rung::Complete));
    // Moved by 1e-9 of a bar it is no longer in the box.
    let mut moved = example.lagrange.e2.equilibrium.clone();
    moved.joints_m[1][2] += 1e-9;
    certify_by_census(&example.problem, &example.census, &mut moved);
    assert!(!reached(&moved, Rung::Verified) && !reached(&moved, Rung::Complete));
    // A census that is not complete says so.
    let mut open = example.census.clone();
    open.complete = false;
    certify_by_census(&example.problem, &open, &mut e2);
    assert!(reached(&e2, Rung::Verified) && !reached(&e2, Rung::Complete));
}

/// All weight hangs on bar 1, and 5 + 1 m reach over just 6 m: both solvers end at the only position of a slack family,
/// which is said of them.
#[test]
fn an_answer_of_a_gap_just_bridged_is_told_as_one() {
    let bars = [(1.0, 3.0, 1.0), (5.0, 2.0, 0.0), (1.0, 0.0, 0.25)];
    let problem = samples::chain(&bars, [6.0, 0.0, -1.0]);
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert!(census.decided() && census.families.len() == 1);
    let system = System::from(problem.chain());
    let answers = ask(&system, Solvers::Both, &|_| {}).equilibria;
    assert_eq!(answers.len(), 2);
    for answer in &answers {
        let reason = answer.evidence.ladder.complete.reason();
        assert_eq!(reason, Some(&Reason::SlackFamily));
        // A millimetre higher it is not: 5 kg hang there.
        let mut answer = system.as_row().unwrap().chain_equilibrium(answer).unwrap();
        answer.joints_m[1][2] += 1e-3;
        answer.energy_j += 1e-3 * 5.0 * 9.81;
        certify_by_census(&problem, &census, &mut answer);
        let reason = answer.evidence.ladder.verified.reason();
        assert!(matches!(reason, Some(Reason::Elsewhere { .. })), "{reason:?}");
    }
}

/// A slack pair at the bottom is at rest in a family of positions: no box holds one of them alone,
/// and the ladder says why.
#[test]
fn an_answer_of_a_slack_family_is_told_as_one() {
    // The last bar hangs from its anchor, the first three fill what is left of the way.
    let bars = [(0.5, 0.0), (1.0, 0.0), (2.0, 0.0), (0.75, 1.0)];
    let problem = samples::homogeneous(9.81, &bars, [0.0, 0.0, 3.0]);
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert_eq!(census.families.len(), 1);
    let mut answer = energy::minimise(&problem, &energy::Settings::default()).unwrap().equilibrium;
    certify_by_census(&problem, &census, &mut answer);
    let ladder = &answer.evidence.ladder;
    assert_eq!(ladder.verified.reason(), Some(&Reason::SlackFamily));
    assert_eq!(ladder.complete.reason(), Some(&Reason::SlackFamily));
}
