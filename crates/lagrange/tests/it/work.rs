//! The work of the solvers of chains, frozen: passes, steps and what the evidence counts, over
//! chains of every shape. A guard, a bracket or a starting guess that is not what it was changes
//! how an answer is found long before it changes the answer. Where a change is meant to make less
//! work (or more), the failing test prints the table that then belongs here.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "decades and counts are small"
)]

use std::f64::consts::TAU;

use lagrange::batch::{Batch, BatchSettings};
use lagrange::{Error, Seed, Settings, condensed};
use model::{Ends, Finish, Problem, Status};
use rand::RngExt;
use samples::{General, Line, Shape, assert_frozen, random_chain};

use crate::common::{planar_seed, problem, spatial_seed, stream};

/// Chains, answers, passes, bars in compression, nullities, decades of the conditions, chains with
/// uncertain forces and decades of those.
type Hanging = [i64; 8];

/// Decades of a positive number, rounded down.
fn decades(number: f64) -> i64 {
    number.log10().floor() as i64
}

fn hang(row: &mut Hanging, problem: &Problem) {
    row[0] += 1;
    let Ok(found) = condensed::solve(problem, &condensed::Settings::default()) else { return };
    let evidence = &found.equilibrium.evidence;
    row[1] += 1;
    row[2] += found.pull.passes() as i64;
    row[3] += found.pull.compressed().len() as i64;
    row[4] += evidence.nullity as i64;
    row[5] += decades(evidence.condition);
    if let Status::Reached(reached) = &evidence.ladder.converged
        && let Some(uncertain) = reached.force_uncertainty
    {
        row[6] += 1;
        row[7] += decades(uncertain.relative);
    }
}

#[test]
fn work_of_hanging_by_shape() {
    let mut found = Shape::ALL.map(|shape| (shape, Hanging::default()));
    for seed in 0..1320 {
        let (shape, problem) = random_chain(seed);
        let row = found.iter_mut().find(|row| row.0 == shape).expect("a shape");
        hang(&mut row.1, &problem);
    }
    let expected = [
        (Shape::Generic, [120, 120, 745, 7, 2, 9, 0, 0]),
        (Shape::Together, [120, 120, 1495, 85, 146, 8, 0, 0]),
        (Shape::NearlyTaut, [120, 120, 397, 0, 0, 600, 0, 0]),
        (Shape::Vertical, [120, 120, 1338, 105, 120, 133, 0, 0]),
        (Shape::OneCompressed, [120, 120, 2139, 102, 2, 13, 0, 0]),
        (Shape::Massless, [120, 120, 884, 8, 38, 6, 0, 0]),
        (Shape::SixOrders, [120, 120, 1382, 28, 3, 46, 0, 0]),
        (Shape::Tiny, [120, 120, 699, 10, 1, 5, 0, 0]),
        (Shape::Huge, [120, 120, 700, 8, 2, 4, 0, 0]),
        (Shape::AnyGravity, [120, 120, 985, 10, 2, 7, 0, 0]),
        (Shape::Mixed, [120, 120, 1222, 41, 123, 216, 1, 0]),
    ];
    assert_frozen(&found[..], &expected);
}

/// At the edge of doubles, all but folded, and closed or steep chains of few bars.
#[test]
fn work_of_hanging_at_the_edges() {
    let mut found = [Hanging::default(); 4];
    for seed in 0..400 {
        hang(&mut found[0], &samples::extreme_chain(seed));
        hang(&mut found[1], &samples::folded_chain(seed));
        let mut random = stream(70, seed as usize);
        let general = General { span: 0.0..1e-3, ..General::default() };
        hang(&mut found[2], &general.problem(&mut random, 2 + seed as usize % 9));
        let span = 1.0 - 10.0_f64.powf(random.random_range(-9.0..-2.0));
        let general = General { span: span..1.0, ..General::default() };
        hang(&mut found[3], &general.problem(&mut random, 2 + seed as usize % 9));
    }
    let expected = [
        [400, 400, 6800, 145, 8286, 1007, 10, 0],
        [400, 400, 5488, 349, 187, 1733, 0, 0],
        [400, 400, 4107, 400, 0, 825, 0, 0],
        [400, 400, 1470, 0, 0, 2074, 0, 0],
    ];
    assert_frozen(&found[..], &expected);
}

/// Large chains begin with a coarser one.
#[test]
fn work_of_large_chains() {
    let mut found = Vec::new();
    for (k, bars) in [500, 2_000, 8_000, 20_000].into_iter().enumerate() {
        let mut row = Hanging::default();
        for line in [Line::Any, Line::Vertical] {
            for span in [0.0..0.001, 0.2..0.9, 0.999..0.9999, 0.9999..1.0] {
                let general = General { span, line, ..General::default() };
                hang(&mut row, &general.problem(&mut stream(71, k), bars));
            }
        }
        found.push((bars, row));
    }
    let expected = [
        (500, [8, 8, 329, 5, 4, 8, 0, 0]),
        (2000, [8, 8, 279, 4, 4, 7, 0, 0]),
        (8000, [8, 8, 319, 4, 4, 10, 0, 0]),
        (20000, [8, 8, 266, 4, 4, 8, 0, 0]),
    ];
    assert_frozen(&found[..], &expected);
}

/// Solves, answers, iterations, steps of relaxation, relaxations, other angles, false roots,
/// residuals kept, indices in space, nullities, decades of the conditions.
type Full = [i64; 11];

fn add(row: &mut Full, outcome: Result<lagrange::Solution, Error>) {
    row[0] += 1;
    let found = match outcome {
        Ok(found) => found,
        Err(Error::Stagnated { iterations, relaxations, .. }) => {
            row[2] += iterations as i64;
            row[4] += relaxations as i64;
            return;
        }
        Err(_) => return,
    };
    let effort = found.effort;
    row[1] += 1;
    row[2] += effort.iterations as i64;
    row[3] += effort.relaxation_steps as i64;
    row[4] += effort.relaxations as i64;
    row[5] += effort.reparametrisations as i64;
    row[6] += effort.false_roots as i64;
    row[7] += found.residual_history.len() as i64;
    row[8] += found.equilibrium.stability.index_in_space as i64;
    row[9] += found.nullity as i64;
    row[10] += decades(found.condition);
}

#[test]
fn work_of_no_guess() {
    let mut found = Vec::new();
    for vertical in [false, true] {
        for bars in [2, 3, 5, 8, 13, 40] {
            let mut row = Full::default();
            for k in 0..if bars < 10 { 12 } else { 2 } {
                let problem = problem(&mut stream(72, k), bars, vertical);
                add(&mut row, lagrange::solve(&problem, &Settings::default()));
            }
            found.push((vertical, bars, row));
        }
    }
    let expected = [
        (false, 2, [12, 12, 66, 22, 12, 0, 0, 44, 0, 24, 15]),
        (false, 3, [12, 12, 99, 49, 12, 0, 0, 50, 0, 36, 17]),
        (false, 5, [12, 12, 109, 58, 12, 0, 0, 51, 0, 60, 14]),
        (false, 8, [12, 12, 98, 52, 12, 0, 0, 46, 0, 96, 15]),
        (false, 13, [2, 2, 20, 12, 2, 0, 0, 8, 0, 26, 4]),
        (false, 40, [2, 2, 14, 6, 2, 0, 0, 8, 0, 80, 0]),
        (true, 2, [12, 12, 61, 20, 12, 0, 0, 41, 0, 36, 11]),
        (true, 3, [12, 12, 99, 57, 12, 0, 0, 42, 0, 48, 13]),
        (true, 5, [12, 12, 112, 66, 12, 0, 0, 46, 0, 72, 14]),
        (true, 8, [12, 12, 121, 66, 12, 0, 0, 55, 0, 108, 19]),
        (true, 13, [2, 2, 22, 14, 2, 0, 0, 8, 0, 28, 4]),
        (true, 40, [2, 2, 78, 54, 3, 0, 0, 24, 0, 82, 4]),
    ];
    assert_frozen(&found[..], &expected);
}

#[test]
fn work_of_seeds() {
    let kept = Settings { lock_margin: 0.0, relaxations: 1, ..Settings::default() };
    let short = Settings { max_relaxation_steps: 40, ..Settings::default() };
    let mut found = Vec::new();
    for (number, settings) in [Settings::default(), kept, short].into_iter().enumerate() {
        for bars in [2, 3, 4, 6, 9] {
            let mut row = Full::default();
            for k in 0..16 {
                let mut random = stream(73, 100 * bars + k);
                let problem = problem(&mut random, bars, k % 4 == 0);
                let seed = if k % 2 == 0 {
                    spatial_seed(&mut random, bars)
                } else {
                    planar_seed(&mut random, bars)
                };
                add(&mut row, lagrange::solve_from(&problem, &seed, &settings));
            }
            found.push((number, bars, row));
        }
    }
    let expected = [
        (0, 2, [16, 16, 379, 16, 1, 1, 0, 363, 5, 36, 17]),
        (0, 3, [16, 16, 428, 40, 4, 1, 0, 388, 21, 52, 22]),
        (0, 4, [16, 16, 398, 14, 2, 3, 0, 384, 25, 68, 23]),
        (0, 6, [16, 16, 422, 44, 4, 9, 0, 378, 64, 100, 18]),
        (0, 9, [16, 16, 693, 148, 6, 15, 0, 545, 87, 148, 31]),
        (1, 2, [16, 16, 389, 16, 1, 0, 0, 373, 5, 36, 17]),
        (1, 3, [16, 16, 456, 52, 5, 0, 0, 404, 19, 52, 21]),
        (1, 4, [16, 15, 388, 14, 2, 0, 0, 374, 21, 64, 22]),
        (1, 6, [16, 12, 311, 35, 3, 0, 0, 276, 51, 75, 13]),
        (1, 9, [16, 14, 464, 41, 4, 0, 0, 423, 86, 130, 27]),
        (2, 2, [16, 16, 379, 16, 1, 1, 0, 363, 5, 36, 17]),
        (2, 3, [16, 16, 428, 40, 4, 1, 0, 388, 21, 52, 22]),
        (2, 4, [16, 16, 398, 14, 2, 3, 0, 384, 25, 68, 23]),
        (2, 6, [16, 16, 422, 44, 4, 9, 0, 378, 64, 100, 18]),
        (2, 9, [16, 16, 749, 134, 7, 15, 0, 615, 87, 148, 31]),
    ];
    assert_frozen(&found[..], &expected);
}

/// Steps, and converged seeds, for each number of bars; long chains end by signs.
#[test]
fn work_of_batches() {
    let mut found = Vec::new();
    for (k, bars) in [2, 3, 4, 5, 6, 7, 15, 25].into_iter().enumerate() {
        let span = if bars > 10 { 0.87..0.89 } else { 0.2..0.8 };
        let general = General { span, line: Line::PlaneOyz, ..General::default() };
        let problem = general.problem(&mut stream(74, k), bars);
        let mut random = stream(75, k);
        let seeds = if bars > 10 { 16 } else { 160 };
        let angles: Vec<f64> = (0..seeds * bars).map(|_| random.random_range(0.0..TAU)).collect();
        for max_iterations in [3, 150] {
            let settings = BatchSettings { max_iterations, ..BatchSettings::default() };
            let mut ends = Ends::default();
            Batch::new(&problem, settings).unwrap().solve(&angles, &mut ends);
            let converged = ends.finish.iter().filter(|end| **end == Finish::Converged).count();
            let steps: u64 = ends.iterations.iter().map(|steps| u64::from(*steps)).sum();
            // Two decimals of the energies' sum say which equilibria were reached.
            let energies: f64 = ends.energy_j.iter().filter(|energy| energy.is_finite()).sum();
            found.push((bars, max_iterations, converged, steps, (100.0 * energies).round() as i64));
        }
    }
    let expected = [
        (2, 3, 0, 480, 156_451),
        (2, 150, 160, 1294, 169_246),
        (3, 3, 0, 480, -402_297),
        (3, 150, 160, 2207, -848_159),
        (4, 3, 0, 480, -26373),
        (4, 150, 160, 2233, 4679),
        (5, 3, 0, 480, 467_319),
        (5, 150, 160, 2956, 779_660),
        (6, 3, 0, 480, 1_220_579),
        (6, 150, 160, 5530, 3_463_615),
        (7, 3, 0, 480, -648_354),
        (7, 150, 159, 11101, -2_662_210),
        (15, 3, 0, 48, -333_329),
        (15, 150, 8, 3843, -2_164_906),
        (25, 3, 0, 48, -250_120),
        (25, 150, 5, 3571, -2_874_472),
    ];
    assert_frozen(&found[..], &expected);
}

/// All bars in parallel, folded back, next to it, and many turns: where the pattern that turns bars comes in.
#[test]
fn work_of_undefined_steps() {
    let problem = model::cases::paper();
    let mut found = Vec::new();
    for (number, off) in [0.0, 1e-12, 1e-6, 1e-3].into_iter().enumerate() {
        let angles: Vec<f64> = (0..48)
            .flat_map(|k| [0.0, off, -off].map(|off| f64::from(k % 24) * TAU / 24.0 + off))
            .collect();
        let mut ends = Ends::default();
        Batch::new(&problem, BatchSettings::default()).unwrap().solve(&angles, &mut ends);
        let steps: u64 = ends.iterations.iter().map(|steps| u64::from(*steps)).sum();
        let mut row = Full::default();
        let folded = [0.0, off, 0.5 * TAU];
        for angles in angles.chunks(3).take(24).chain([&folded[..]]) {
            let seed = Seed::planar(angles);
            add(&mut row, lagrange::solve_from(&problem, &seed, &Settings::default()));
        }
        found.push((number, steps, row));
    }
    let expected = [
        (0, 802, [25, 25, 1372, 701, 11, 40, 0, 671, 18, 100, 25]),
        (1, 650, [25, 25, 790, 129, 3, 28, 0, 661, 22, 100, 25]),
        (2, 732, [25, 25, 924, 285, 23, 66, 0, 639, 2, 100, 25]),
        (3, 712, [25, 25, 1181, 89, 9, 42, 0, 1092, 20, 100, 25]),
    ];
    assert_frozen(&found[..], &expected);
}
