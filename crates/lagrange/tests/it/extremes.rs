//! Problems at the edge of what is allowed: an answer or an error, never a panic, a NaN or a hang.

use lagrange::{Settings, Solution, SolveError, constraint_matrix, jacobian, solve};
use model::{Anchors, Bar, Chain, InPlane, InSpace, Problem};
use nalgebra::DVector;

use crate::common::{problem, stream};

fn hang(end_m: [f64; 3], bars: Vec<Bar>) -> Result<Solution, SolveError> {
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    let chain = Chain::new("extreme", 9.81, anchors, bars).unwrap();
    solve(&Problem::new(chain).unwrap(), &Settings::default())
}

fn bar(length: f64, mass: f64) -> Bar {
    Bar::homogeneous(length, mass).unwrap()
}

fn assert_good(found: &Solution) {
    let equilibrium = &found.equilibrium;
    assert_eq!(equilibrium.stability.in_space, InSpace::Stable);
    let numbers = equilibrium.joints_m.iter().chain(&equilibrium.multipliers_n).flatten();
    assert!(numbers.chain(&equilibrium.axial_n).all(|number| number.is_finite()));
    assert!(equilibrium.energy_j.is_finite() && equilibrium.evidence.residual.is_finite());
    assert!(found.condition.is_finite());
}

#[test]
fn two_bars_hang_like_a_v() {
    let found = hang([1.0, 0.0, 0.0], vec![bar(1.0, 1.0); 2]).unwrap();
    assert_good(&found);
    // Closed form: the middle joint below the middle of the span.
    let middle = found.equilibrium.joints_m[1];
    assert!((middle[0] - 0.5).abs() < 1e-14 && middle[1].abs() < 1e-14);
    assert!((middle[2] + 0.75_f64.sqrt()).abs() < 1e-14);
    // Each anchor carries one bar, and the moment about the joint gives H = W/2 · (l/2 cos) / (l sin).
    let reactions = found.equilibrium.reactions_n;
    assert!((reactions.start[2] - 9.81).abs() < 1e-13);
    let horizontal = 0.5 * 9.81 * 0.5 / 0.75_f64.sqrt();
    assert!((reactions.start[0] + horizontal).abs() < 1e-13, "{reactions:?}");
}

#[test]
fn both_ends_at_one_point() {
    // A triangle from one point.
    assert_good(&hang([0.0; 3], vec![bar(1.0, 1.0); 3]).unwrap());
    assert_good(
        &hang([0.0; 3], vec![bar(1.0, 1.0), bar(0.7, 2.0), bar(1.1, 0.5), bar(0.3, 1.0)]).unwrap(),
    );
}

#[test]
fn massless_bars_and_points_of_weight() {
    let at_end = |mass: f64, at: f64| Bar::new(1.0, mass, at, [0.0; 3]).unwrap();
    assert_good(&hang([1.0, 0.0, 0.2], vec![bar(1.0, 0.0), bar(1.0, 1.0), bar(1.0, 0.0)]).unwrap());
    assert_good(
        &hang([1.0, 0.5, 0.0], vec![at_end(1.0, 1.0), at_end(0.0, 0.5), at_end(2.0, 0.0)]).unwrap(),
    );
}

#[test]
fn very_different_bars() {
    let bars = vec![bar(1e-3, 1e3), bar(1.0, 1e-3), bar(1e-2, 1.0), bar(0.7, 1e-6)];
    assert_good(&hang([0.3, 0.4, 0.1], bars).unwrap());
}

#[test]
fn nearly_taut_chains_pull_hard() {
    for slack in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let span = 4.0 * (1.0 - slack);
        let found = hang([span, 0.0, 0.0], vec![bar(1.0, 1.0); 4]).unwrap();
        assert_good(&found);
        // Outer bars at the slope a, inner at b: H tan a = 3/2 mg, H tan b = 1/2 mg, and they shorten
        // the span by a² + b² = 4 slack, up to higher order; the span itself is known to a rounding
        // error, and so is the slack.
        let b = (0.4 * slack).sqrt();
        let pull = 0.5 * 9.81 / b;
        let got = found.equilibrium.multipliers_n[2][0];
        let bound = 4.0 * slack + 2.0 * f64::EPSILON / slack;
        assert!((got / pull - 1.0).abs() < bound, "{got} instead of {pull}, slack {slack}");
        // In any direction.
        assert_good(&hang([0.6 * span, 0.0, 0.8 * span], vec![bar(1.0, 1.0); 4]).unwrap());
        assert_good(&hang([0.0, 0.0, -span], vec![bar(1.0, 1.0); 4]).unwrap());
        assert_good(&hang([0.0, 0.0, span], vec![bar(1.0, 1.0); 4]).unwrap());
    }
}

/// Massless bars beyond the last weight carry nothing and lie where they like.
#[test]
fn idle_bars() {
    for bars in [3, 4] {
        let mut chain = vec![bar(1.0, 0.0); bars];
        chain[0] = bar(1.0, 1.0);
        for end_m in [[0.0, 0.0, -2.0], [0.3, 0.0, -2.0], [1.0, 0.0, 0.0]] {
            let found = hang(end_m, chain.clone()).unwrap();
            assert_good(&found);
            let axial = &found.equilibrium.axial_n;
            assert!(
                (axial[0] - 0.5 * 9.81).abs() < 1e-12,
                "half of the weight at joint 1: {axial:?}"
            );
            assert!(axial[1..].iter().all(|force| force.abs() < 1e-12), "{axial:?}");
            let degenerate = found.equilibrium.stability.in_plane == InPlane::Degenerate;
            assert_eq!(degenerate, bars == 4, "three idle bars can move, two cannot");
        }
    }
}

/// A chain that can fold flat between its anchors: at one span the forces are indeterminate, close to it
/// they are large.
#[test]
fn folding_chains() {
    for span in [1.0, 0.999_999, 1.000_000_1] {
        assert_good(&hang([0.0, 0.0, -span], vec![bar(1.0, 1.0); 3]).unwrap());
    }
}

#[test]
fn many_bars() {
    let found = hang([0.5, 0.0, 0.2], vec![bar(5e-4, 1e-3); 2000]).unwrap();
    assert_good(&found);
    assert_eq!(found.nullity, 2000);
}

#[test]
fn a_hundred_bars() {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 2.0] };
    let bars = vec![bar(0.04, 0.04); 100];
    let chain = Chain::new("catenary", 1.0, anchors, bars).unwrap();
    let found = solve(&Problem::new(chain).unwrap(), &Settings::default()).unwrap();
    assert_good(&found);
    assert_eq!(found.nullity, 100);
    // The continuous catenary from height 0 to 2 over a span of 1 with length 4 pulls with
    // 0.1636975295 (closed form); n bars differ from it by a part in n².
    let pull = found.equilibrium.multipliers_n[50][0];
    assert!((pull - 0.163_697_529_5).abs() < 1e-3, "{pull}");
}

#[test]
fn random_long_chains() {
    for index in 0..10 {
        let mut random = stream(71, index);
        let found = solve(&problem(&mut random, 60, index % 4 == 0), &Settings::default()).unwrap();
        assert_good(&found);
    }
}

/// A chain of one bar is no equilibrium problem, and its equations can be written down all the same.
#[test]
fn equations_of_a_single_bar() {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
    let chain = Chain::new("one", 9.81, anchors, vec![bar(1.0, 1.0)]).unwrap();
    let (q, lambda) = (DVector::zeros(6), DVector::zeros(6));
    assert_eq!(constraint_matrix(&chain, &q).shape(), (6, 6));
    assert_eq!(jacobian(&chain, &q, &lambda).shape(), (12, 12));
}
