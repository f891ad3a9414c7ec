//! The work of the minimisers, frozen: iterations and evaluations over chains and systems of every
//! shape. A guard, a step length or a starting guess that is not what it was changes how an answer
//! is found long before it changes the answer. Where a change is meant to make less work (or more),
//! the failing test prints the table that then belongs here.

use energy::batch::{Batch, BatchSettings};
use energy::{Error, Motion, Settings, minimise, minimise_from};
use model::{Ends, Finish, Problem};
use rand::RngExt;
use samples::{General, Line, Shape, assert_frozen, random_chain};

use crate::support::{random_seed, rng};

/// Chains, answers, iterations, evaluations.
type Row = [u64; 4];

fn add(row: &mut Row, outcome: Result<energy::Solution, Error>) {
    row[0] += 1;
    if let Ok(solution) = outcome {
        row[1] += 1;
        row[2] += solution.work.iterations;
        row[3] += solution.work.evaluations;
    }
}

#[test]
fn work_of_no_guess_by_shape() {
    let mut found = Shape::ALL.map(|shape| (shape, Row::default()));
    for seed in 0..800 {
        let (shape, problem) = random_chain(seed);
        let row = found.iter_mut().find(|row| row.0 == shape).expect("a shape");
        add(&mut row.1, minimise(&problem, &Settings::default()));
    }
    let expected = [
        (Shape::Generic, [73, 73, 388, 1164]),
        (Shape::Together, [73, 73, 538, 1614]),
        (Shape::NearlyTaut, [73, 73, 227, 681]),
        (Shape::Vertical, [73, 73, 602, 1806]),
        (Shape::OneCompressed, [73, 73, 392, 1176]),
        (Shape::Massless, [73, 73, 388, 1165]),
        (Shape::SixOrders, [73, 73, 370, 1111]),
        (Shape::Tiny, [73, 73, 377, 1131]),
        (Shape::Huge, [72, 72, 349, 1047]),
        (Shape::AnyGravity, [72, 72, 369, 1107]),
        (Shape::Mixed, [72, 72, 425, 1275]),
    ];
    assert_frozen(&found, &expected);
}

#[test]
fn work_in_the_plane_by_shape() {
    let mut found = Shape::ALL.map(|shape| (shape, Row::default()));
    let settings = Settings { motion: Motion::Plane, ..Settings::default() };
    for seed in 800..1200 {
        let (shape, problem) = random_chain(seed);
        let row = found.iter_mut().find(|row| row.0 == shape).expect("a shape");
        add(&mut row.1, minimise(&problem, &settings));
    }
    let expected = [
        (Shape::Generic, [37, 37, 185, 555]),
        (Shape::Together, [36, 36, 261, 783]),
        (Shape::NearlyTaut, [36, 36, 120, 360]),
        (Shape::Vertical, [36, 36, 252, 756]),
        (Shape::OneCompressed, [36, 36, 201, 603]),
        (Shape::Massless, [36, 36, 188, 564]),
        (Shape::SixOrders, [36, 36, 207, 621]),
        (Shape::Tiny, [36, 36, 199, 597]),
        (Shape::Huge, [37, 37, 203, 609]),
        (Shape::AnyGravity, [37, 37, 196, 588]),
        (Shape::Mixed, [37, 37, 207, 621]),
    ];
    assert_frozen(&found, &expected);
}

fn general(stream: u64, line: Line, bars: usize) -> Problem {
    General { centre: 0.2..0.8, span: 0.2..0.8, line, ..General::default() }
        .problem(&mut rng(stream), bars)
}

#[test]
fn work_of_seeds() {
    let mut found = Vec::new();
    for (k, bars) in [3, 4, 6, 10, 20].into_iter().enumerate() {
        for motion in [Motion::Space, Motion::Plane] {
            let problem = general(k as u64, Line::PlaneOyz, bars);
            let settings = Settings { motion, ..Settings::default() };
            let (mut row, mut rng) = (Row::default(), rng(100 + k as u64));
            for _ in 0..20 {
                add(&mut row, minimise_from(&problem, &random_seed(&problem, &mut rng), &settings));
            }
            found.push((bars, row));
        }
    }
    let expected = [
        (3, [20, 20, 175, 525]),
        (3, [20, 20, 149, 447]),
        (4, [20, 20, 172, 516]),
        (4, [20, 20, 184, 552]),
        (6, [20, 20, 164, 492]),
        (6, [20, 20, 192, 576]),
        (10, [20, 20, 181, 543]),
        (10, [20, 20, 210, 630]),
        (20, [20, 20, 215, 645]),
        (20, [20, 20, 244, 732]),
    ];
    assert_frozen(&found, &expected);
}

/// Passes over the bars, and converged and stalled seeds, for each number of bars.
#[test]
fn work_of_batches() {
    let mut found = Vec::new();
    for (k, bars) in [2, 3, 4, 5, 6, 7, 12].into_iter().enumerate() {
        let problem = general(k as u64, Line::PlaneOyz, bars);
        let mut rng = rng(200 + k as u64);
        let mut angles: Vec<f64> =
            (0..100 * bars).map(|_| rng.random_range(0.0..std::f64::consts::TAU)).collect();
        // Bars in parallel, and nearly so, are perturbed first.
        for (seed, angles) in angles.chunks_mut(bars).take(40).enumerate() {
            for angle in angles {
                *angle = seed as f64 + 1e-9 * *angle;
            }
        }
        let mut ends = Ends::default();
        Batch::new(&problem, BatchSettings::default()).unwrap().minimise(&angles, &mut ends);
        let count = |finish| ends.finish.iter().filter(|end| **end == finish).count();
        let passes: u32 = ends.iterations.iter().map(|steps| u32::from(*steps)).sum();
        found.push((bars, count(Finish::Converged), count(Finish::Stalled), passes));
    }
    let expected = [
        (2, 100, 0, 2499),
        (3, 100, 0, 4373),
        (4, 100, 0, 4214),
        (5, 100, 0, 5308),
        (6, 100, 0, 5424),
        (7, 100, 0, 5367),
        (12, 100, 0, 4705),
    ];
    assert_frozen(&found, &expected);
}

/// Every other degree of the torus, and where the guards of the ray are.
#[test]
fn work_of_the_example() {
    let mut found = [0, 0, 0];
    for theta in (-180..180).step_by(15) {
        for alpha in (-180..180).step_by(15) {
            let [theta, alpha] = [theta, alpha].map(|angle| f64::from(angle).to_radians());
            found[0] += 1;
            if let Ok(end) = energy::example::minimise(theta, alpha, &Settings::default()) {
                found[1] += 1;
                found[2] += end.iterations;
            }
        }
    }
    let expected = [576, 576, 3744];
    assert_frozen(&found, &expected);
}

/// Anchors almost on one vertical: the chain finds its plane late, and from a seed it turns.
#[test]
fn work_near_one_vertical() {
    let mut found = Vec::new();
    for exponent in 1..9 {
        let (mut row, mut rng) = (Row::default(), rng(300 + exponent));
        for bars in [3, 5, 8, 14] {
            let aside = 10.0_f64.powi(-i32::try_from(exponent).unwrap());
            let problem = samples::equal_bars(bars, 2.0, 1.0, [aside, 0.0, -0.6]);
            add(&mut row, minimise(&problem, &Settings::default()));
            for _ in 0..4 {
                let seed = random_seed(&problem, &mut rng);
                add(&mut row, minimise_from(&problem, &seed, &Settings::default()));
            }
        }
        found.push((exponent, row));
    }
    let expected = [
        (1, [20, 20, 219, 657]),
        (2, [20, 20, 222, 666]),
        (3, [20, 20, 220, 660]),
        (4, [20, 20, 230, 690]),
        (5, [20, 20, 316, 948]),
        (6, [20, 20, 310, 930]),
        (7, [20, 20, 294, 882]),
        (8, [20, 20, 286, 858]),
    ];
    assert_frozen(&found, &expected);
}
