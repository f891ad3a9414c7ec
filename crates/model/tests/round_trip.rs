//! What is written reads back, bit for bit; and the JSON has the keys that others rely on.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use model::system_file::{parse_system, write_system};
use model::{
    Anchors, Bar, Chain, Equilibrium, Evidence, InPlane, InSpace, Reactions, Rung, SolverName,
    Stability,
};
use proptest::prelude::*;

/// Finite positive lengths over the whole range a chain may use.
fn positive() -> impl Strategy<Value = f64> {
    (-30.0..30.0_f64).prop_map(f64::exp2)
}

fn bar() -> impl Strategy<Value = Bar> {
    (positive(), prop_oneof![Just(0.0), positive()], 0.0..=1.0_f64, any::<bool>()).prop_map(
        |(length, mass, part, plain)| {
            if plain {
                Bar::homogeneous(length, mass).unwrap()
            } else {
                Bar::new(length, mass, part * length, [0.1, part, mass]).unwrap()
            }
        },
    )
}

proptest! {
    #[test]
    fn systems_read_back_bit_for_bit(
        name in ".*",
        gravity in positive(),
        start_m in prop::array::uniform3(-1e9..1e9_f64),
        end_m in prop::array::uniform3(-1e-9..1e-9_f64),
        runs in prop::collection::vec((bar(), 1..5_usize), 1..6),
    ) {
        let bars = runs.iter().flat_map(|(bar, count)| vec![*bar; *count]).collect();
        let chain = Chain::new(name, gravity, Anchors { start_m, end_m }, bars).unwrap();
        prop_assert_eq!(parse_system(&write_system(&chain), "written").unwrap(), chain);
    }
}

#[test]
fn the_keys_of_an_equilibrium_are_those_of_the_design() {
    let mut evidence = Evidence::converged(1e-15, "residual", 4);
    evidence.reach(Rung::Agreed, "both");
    evidence.miss(Rung::Optimal, "no certificate");
    let equilibrium = Equilibrium {
        solver: SolverName::Lagrange,
        energy_j: -1.0,
        joints_m: vec![[0.0; 3], [1.0, 2.0, 3.0]],
        multipliers_n: vec![[0.0; 3]; 2],
        reactions_n: Reactions { start: [0.0; 3], end: [1.0; 3] },
        axial_n: vec![0.5],
        stability: Stability {
            in_plane: InPlane::Maximum,
            index_in_plane: 1,
            in_space: InSpace::Unstable,
            index_in_space: 2,
        },
        evidence,
    };
    let json = serde_json::to_value(&equilibrium).unwrap();
    assert_eq!(json["solver"], "lagrange");
    assert_eq!(json["joints_m"][1][2], 3.0);
    assert_eq!(json["reactions_n"]["end"][0], 1.0);
    assert_eq!(json["stability"]["in_plane"], "maximum");
    assert_eq!(json["stability"]["in_space"], "unstable");
    assert_eq!(json["stability"]["index_in_space"], 2);
    assert_eq!(json["evidence"]["rung"], "agreed");
    for key in ["residual", "iterations", "nullity", "solve_s"] {
        assert!(json["evidence"][key].is_number(), "{key}");
    }
    let ladder = json["evidence"]["ladder"].as_array().unwrap();
    let reached: Vec<_> = ladder.iter().map(|s| s["reached"].as_bool().unwrap()).collect();
    assert_eq!(reached, [true, true, false, false, false]);
    assert_eq!(ladder[4]["how"], "no certificate");
    assert_eq!(serde_json::from_value::<Equilibrium>(json).unwrap(), equilibrium);
}

#[test]
fn totals_do_not_drift_over_a_million_bars() {
    let bar = Bar::homogeneous(0.1, 0.3).unwrap();
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
    let chain = Chain::new("long", 9.81, anchors, vec![bar; 1_000_000]).unwrap();
    // 0.1 and 0.3 are not exact in binary; a million times their doubles is what the sum must be.
    assert!((chain.total_length_m() - 1e6 * 0.1).abs() <= 1e5 * f64::EPSILON);
    assert!((chain.total_mass_kg() - 1e6 * 0.3).abs() <= 3e5 * f64::EPSILON);
}
