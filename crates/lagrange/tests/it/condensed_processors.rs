//! Shared among processors, the condensed solver gives the same bits.

use std::num::NonZeroUsize;

use lagrange::condensed::{Settings, Solver};
use model::{Anchors, Bar, Chain, Equilibrium, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Long enough for three processors, and no whole number of blocks.
const BARS: usize = 200_003;

/// Bars of all lengths and masses, hung slack, tight, or from one vertical.
fn problem(span: f64, rise: f64) -> Problem {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut bar = || {
        let length: f64 = random.random_range(0.5..2.0);
        Bar::homogeneous(length / BARS as f64, random.random_range(0.0..1.0)).unwrap()
    };
    let bars: Vec<Bar> = (0..BARS).map(|_| bar()).collect();
    let anchors = Anchors { start_m: [0.1, 0.2, 0.3], end_m: [0.1 + span, 0.2 - span, 0.3 + rise] };
    Problem::new(Chain::new("shared", 9.81, anchors, bars).unwrap()).unwrap()
}

fn solve(problem: &Problem, processors: usize) -> Equilibrium {
    let processors = NonZeroUsize::new(processors).unwrap();
    let mut solver = Solver::with_processors(processors);
    let mut found = solver.solve(problem, &Settings::default()).unwrap().equilibrium;
    found.evidence.solve_s = 0.0;
    found
}

#[test]
fn the_bits_do_not_depend_on_the_processors() {
    for (span, rise) in [(0.4, 0.1), (0.8, 0.0), (0.0, -0.5)] {
        let problem = problem(span, rise);
        let alone = solve(&problem, 1);
        for processors in [2, 3, 7] {
            assert!(solve(&problem, processors) == alone, "{processors} processors differ");
        }
    }
}
