//! Lengths, masses and gravity times powers of two: the same branches, digit for digit but for these.

use branches::{Branch, Combine, Continuation, ContinuationSettings, Event, Variation};
use model::Problem;
use samples::scaled_chain;

/// Of lengths, masses and gravity.
const FACTORS: [[f64; 3]; 3] = [[1024.0, 1.0, 1.0], [1.0, 0.0625, 4.0], [0.125, 64.0, 0.25]];

fn assert_times(one: &[f64], factor: f64, other: &[f64]) {
    let one: Vec<f64> = one.iter().map(|x| factor * x).collect();
    assert_eq!(one, other);
}

fn assert_branch(one: &Branch, [length, force]: [f64; 2], value: f64, other: &Branch) {
    assert_eq!((one.start, one.end), (other.start, other.end));
    assert_eq!(one.points.len(), other.points.len());
    for (one, other) in one.points.iter().zip(&other.points) {
        assert_eq!((one.grid, one.proved, one.event), (other.grid, other.proved, other.event));
        assert_eq!(one.position.to_bits(), other.position.to_bits());
        assert_times(&one.values, value, &other.values);
        assert_times(&[one.span_m], length, &[other.span_m]);
        assert_times(&one.pull_n.unwrap_or_default(), force, &other.pull_n.unwrap_or_default());
        assert_eq!(one.angles_rad, other.angles_rad);
        assert_times(&[one.energy_j], force * length, &[other.energy_j]);
        assert_times(&one.axial_n, force, &other.axial_n);
        let indices = |point: &branches::BranchPoint| [point.index_in_plane, point.index_in_space];
        assert_eq!(indices(one), indices(other));
    }
}

fn assert_event(one: &Event, [length, force]: [f64; 2], value: f64, other: &Event) {
    assert_eq!((one.kind, &one.branches), (other.kind, &other.branches));
    assert_eq!(one.position.to_bits(), other.position.to_bits());
    assert_times(&one.values, value, &other.values);
    assert_times(&one.values_error, value, &other.values_error);
    assert_times(&[one.span_m], length, &[other.span_m]);
    assert_eq!(one.angles_rad, other.angles_rad);
    assert_times(&[one.energy_j], force * length, &[other.energy_j]);
    assert_eq!(one.singular.to_bits(), other.singular.to_bits());
}

/// Over a place, a length, a mass and the centre of a bar, past folds and straight positions.
#[test]
fn branches_scale_without_rounding() {
    let bars = [(0.75, 0.5, 0.3), (1.1, 1.25, 0.4), (0.6, 0.8, 0.35)];
    let base = samples::chain(&bars, [1.3, 0.0, -0.35]);
    let mut events = 0;
    for (number, [low, high], powers) in [
        ("anchors.end_m.x", [0.2, 2.6], [1, 0]),
        ("bars.2.length_m", [0.5, 1.9], [1, 0]),
        ("bars.3.mass_kg", [0.2, 3.0], [0, 1]),
        ("bars.2.centre_m", [0.0, 1.1], [1, 0]),
    ] {
        let follow = |problem: &Problem, factor: f64| {
            let vary = format!("{number}={}..{}:9", factor * low, factor * high);
            let vary = vary.parse().unwrap_or_else(|error| panic!("{vary}: {error}"));
            let variation = Variation::new(problem.chain(), &[vary], Combine::Product).unwrap();
            Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {}).unwrap()
        };
        let one = follow(&base, 1.0);
        events += one.events.len();
        for factors in FACTORS {
            let [length, mass, gravity] = factors;
            let value = length.powi(powers[0]) * mass.powi(powers[1]);
            let other = follow(&scaled_chain(&base, factors), value);
            assert_eq!(one.branches.len(), other.branches.len(), "{number} {factors:?}");
            assert_eq!(one.events.len(), other.events.len(), "{number} {factors:?}");
            let units = [length, mass * gravity];
            for (one, other) in one.branches.iter().zip(&other.branches) {
                assert_branch(one, units, value, other);
            }
            for (one, other) in one.events.iter().zip(&other.events) {
                assert_event(one, units, value, other);
            }
            let ends = |checks: &branches::Checks| [checks.between, checks.added];
            assert_eq!(ends(&one.checks), ends(&other.checks));
        }
    }
    assert!(events > 8, "{events}");
}
