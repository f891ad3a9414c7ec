//! Ropes over rings and pulleys in sweeps and basins.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use funicular::prelude::*;
use model::SolverName;

/// Two rings: P of 10 kg on a rope of 5 m between A and B, 4 m apart and B 1 m higher; Q of 3 kg on one of 7 m between
/// C and D, 4.2 m apart and level. Where they hang is known: both spans lean by `a` with `sin a = d/L`.
fn two_rings() -> Problem {
    Problem::parse(
        "gravity_m_s2 = 9.8\n[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [4, 0, 1] }\n\
         C = { at_m = [0, 3, 0] }\nD = { at_m = [4.2, 3, 0] }\nP = { mass_kg = 10 }\nQ = { mass_kg = 3 }\n\
         [[bars]]\nfrom = \"A\"\nto = \"B\"\nvia = [\"P\"]\nkind = \"cable\"\nlength_m = 5\n\
         [[bars]]\nfrom = \"C\"\nto = \"D\"\nvia = [\"Q\"]\nkind = \"cable\"\nlength_m = 7\n",
        "rings.toml",
    )
    .unwrap()
}

/// 98 N 1 m below A, 29.4 N 2.8 m (5.6/7 of 3.5 m) and more below C: the energy is convex, and has no other rest.
const ENERGY_J: f64 = -98.0 - 29.4 * 2.8;

#[test]
fn starts_anywhere_lead_to_the_one_rest_of_rings() {
    let found = Sweep::new(40).run(&two_rings()).unwrap();
    let [one] = &found.equilibria[..] else { panic!("{:?}", found.equilibria) };
    assert!((one.energy_j - ENERGY_J).abs() < 1e-9, "{}", one.energy_j);
    let places = one.joints_m.as_ref().unwrap();
    for (joint, wanted) in [(4, [4.0 / 3.0, 0.0, -1.0]), (5, [2.1, 3.0, -2.8])] {
        for axis in 0..3 {
            assert!((places[joint][axis] - wanted[axis]).abs() < 1e-9, "{places:?}");
        }
    }
}

#[test]
fn the_basin_of_rings_at_rest_is_everywhere() {
    let found = Basins::new().size(6).joint("P").run(&two_rings()).unwrap();
    assert_eq!(found.equilibria().len(), 1, "{:?}", found.equilibria());
    for solver in [SolverName::LAGRANGE, SolverName::ENERGY] {
        assert!(found.outcomes(&solver).unwrap().outcome.iter().all(|outcome| *outcome == 0));
    }
    // As far as the rope is long, about where P hangs.
    let [[from, to], _] = found.ranges();
    assert!((to - from - 10.0).abs() < 1e-9, "{from} {to}");
}
