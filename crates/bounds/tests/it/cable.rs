//! The second-order cone bound.

use crate::support::{chain, configuration, energy, rng, scaled, unit_j};
use bounds::{BoundError, BoundSettings, ConeStatus, cable_bound};
use energy::{Settings, minimise};
use model::{Anchors, Bar, Chain, Problem};

/// Rounding of the energies compared, of weight times length; measured 4e-15 at most.
const ROUNDING: f64 = 1e-13;

/// Two cables straight down to the last anchor, the third slack: V = -4 mgl, 2.0 in the paper's
/// terms (the relaxation without the multiplied closure).
#[test]
fn paper() {
    let problem = model::cases::paper();
    let mgl = problem.chain().gravity_m_s2();
    let bound = cable_bound(&problem, &BoundSettings::default()).unwrap();
    assert!(bound.rigorous_j <= -4.0 * mgl && bound.rigorous_j > -4.0 * mgl * (1.0 + 1e-14));
    assert_eq!(bound.slack, [3]);
    assert!(!bound.is_equilibrium());
    for (force, expected) in bound.cables.axial_n.iter().zip([2.0, 1.0, 0.0]) {
        assert!((force / mgl - expected).abs() < 1e-8, "{force}");
    }
    // The third cable spans nothing.
    assert!(bound.cables.joints_m[2][2] + 2.0 < 1e-6);
}

/// Where all bars are in tension the cables are the minimum: energy, joints and axial forces are
/// those of the minimiser of this crate, which knows nothing of cables. Elsewhere the bound is
/// below.
#[test]
fn taut_cables_are_the_equilibrium() {
    let mut rng = rng(3);
    let (mut taut, mut slack) = (0, 0);
    for stream in 0..120 {
        let problem = chain(2 + usize::try_from(stream).unwrap() % 14, stream, 0.98);
        let unit = unit_j(&problem);
        let bound = cable_bound(&problem, &BoundSettings::default()).unwrap();
        let found = minimise(&problem, &Settings::default()).unwrap().equilibrium;
        let tension = found.axial_n.iter().all(|f| *f > 0.0);
        assert_eq!(bound.is_equilibrium(), tension, "{stream}: {:?}", bound.slack);
        if tension {
            taut += 1;
            assert!((bound.gap_j(found.energy_j) / unit).abs() < ROUNDING, "{stream}");
            let length = problem.chain().total_length_m();
            for (a, b) in bound.cables.joints_m.iter().zip(&found.joints_m) {
                for k in 0..3 {
                    // Two anchors on one vertical: each finds the chain in OYZ.
                    assert!((a[k] - b[k]).abs() < 1e-9 * length, "{stream}: {a:?} {b:?}");
                }
            }
            let most = found.axial_n.iter().fold(0.0_f64, |most, f| most.max(*f));
            for (a, b) in bound.cables.axial_n.iter().zip(&found.axial_n) {
                assert!((a - b).abs() < 1e-9 * most, "{stream}: {a} {b}");
            }
        } else {
            slack += 1;
            assert!(bound.gap_j(found.energy_j) > 0.0, "{stream}");
            for bar in &bound.slack {
                assert!(bound.cables.axial_n[bar - 1].abs() < 1e-6 * unit, "{stream}");
            }
        }
        // The solver's own value, without the rounding to a proof.
        assert!((bound.bound_j - bound.rigorous_j).abs() < 1e-6 * unit, "{stream}");
        if stream.is_multiple_of(4) && problem.chain().bars().len() < 8 {
            for _ in 0..50 {
                let joints = configuration(&problem, &mut rng);
                assert!(bound.gap_j(energy(&problem, &joints)) > -ROUNDING * unit, "{stream}");
            }
        }
    }
    assert!(taut > 20 && slack > 20, "{taut} taut, {slack} slack");
}

/// Two anchors at one point: the chain hangs double, and is slack in the middle if its number of
/// bars is odd.
#[test]
fn anchors_at_one_point() {
    for n in [4_usize, 5, 10, 11] {
        let anchors = Anchors { start_m: [1.0, 2.0, 3.0], end_m: [1.0, 2.0, 3.0] };
        let bars = vec![Bar::homogeneous(1.0, 1.0).unwrap(); n];
        let problem = Problem::new(Chain::new("double", 1.0, anchors, bars).unwrap()).unwrap();
        let bound = cable_bound(&problem, &BoundSettings::default()).unwrap();
        // Pairs of bars at depth 1/2, 3/2, ...; an odd one at the bottom, at depth n/2 rounded
        // down.
        let half = f64::from(u32::try_from(n / 2).unwrap());
        let expected = -(half * half + if n % 2 == 1 { half } else { 0.0 });
        assert!((bound.rigorous_j - expected).abs() < 1e-12 * half * half, "{n}");
        assert_eq!(bound.is_equilibrium(), n % 2 == 0, "{n}: {:?}", bound.slack);
        if n % 2 == 1 {
            assert_eq!(bound.slack, [n / 2 + 1]);
        }
    }
}

/// A long chain, to rounding: closing error, gap, and the pull against the closed form of the
/// catenary, from which equal bars differ by a term of order n⁻².
#[test]
fn twenty_thousand_bars() {
    let n = 20_000_u16;
    let (span, total) = (1.0_f64, 1.5);
    let anchors = Anchors { start_m: [0.0; 3], end_m: [span, 0.0, 0.0] };
    let bars =
        vec![Bar::homogeneous(total / f64::from(n), 1.0 / f64::from(n)).unwrap(); usize::from(n)];
    let problem = Problem::new(Chain::new("long", 1.0, anchors, bars).unwrap()).unwrap();
    let bound = cable_bound(&problem, &BoundSettings::default()).unwrap();
    assert!(bound.is_equilibrium());
    assert!(bound.gap_j(bound.cables.energy_j).abs() < ROUNDING);
    assert!(bound.cables.open_m < 1e-15);
    // 2 c sinh(span / 2c) = total, by bisection; the horizontal pull is c times the weight per
    // length.
    let (mut low, mut high) = (0.05, 1.0);
    for _ in 0..200 {
        let c: f64 = 0.5 * (low + high);
        if 2.0 * c * (span / (2.0 * c)).sinh() > total {
            low = c;
        } else {
            high = c;
        }
    }
    let pull = low / total;
    assert!(
        (bound.cables.pull_n[0] / pull - 1.0).abs() < 1e-8,
        "{}",
        bound.cables.pull_n[0] / pull - 1.0
    );
    assert!((bound.cables.pull_n[2] - 0.5).abs() < 1e-12);
}

#[test]
fn units_do_not_matter() {
    let problem = chain(7, 4, 0.8);
    let reference = cable_bound(&problem, &BoundSettings::default()).unwrap();
    for (length, mass, gravity) in
        [(1e-9, 1.0, 1.0), (1e9, 1e-6, 1.0), (1e-6, 1e6, 1e3), (1e6, 1e6, 1e-9)]
    {
        let other = scaled(&problem, length, mass, gravity);
        let bound = cable_bound(&other, &BoundSettings::default()).unwrap();
        let (a, b) = (bound.rigorous_j / unit_j(&other), reference.rigorous_j / unit_j(&problem));
        assert!((a - b).abs() < ROUNDING, "{length} {mass} {gravity}");
        assert_eq!(bound.slack, reference.slack);
    }
}

#[test]
fn settings_out_of_range() {
    let problem = model::cases::paper();
    let none = BoundSettings { max_iterations: 0, ..BoundSettings::default() };
    let error = cable_bound(&problem, &none).unwrap_err();
    assert!(matches!(error, BoundError::Setting { setting: "max_iterations", .. }), "{error}");
    for tolerance in [0.0, -1.0, 1.0, f64::NAN, f64::INFINITY] {
        let bad = BoundSettings { tolerance, ..BoundSettings::default() };
        let error = cable_bound(&problem, &bad).unwrap_err();
        assert!(matches!(error, BoundError::Setting { setting: "tolerance", .. }), "{error}");
    }
}

/// Stopped before the end there is no bound, and the error says how far it got.
#[test]
fn an_unsolved_programme_is_an_error() {
    let settings = BoundSettings { max_iterations: 1, ..BoundSettings::default() };
    match cable_bound(&model::cases::paper(), &settings).unwrap_err() {
        BoundError::NotSolved { status: ConeStatus::IterationLimit, iterations: 1, .. } => {}
        error => panic!("{error}"),
    }
}
