//! Positions that meet the constraints.

use motion::{Settings, Simulation, random_position};

use crate::common::paper;

#[test]
fn random_positions_close_and_differ_and_are_the_same_for_the_same_seed() {
    let mut mean = [0.0; 3];
    for seed in 0..200 {
        let at = random_position(&paper(), seed).unwrap();
        assert_eq!(at, random_position(&paper(), seed).unwrap());
        let simulation = Simulation::new(&paper(), &at, Settings::default()).unwrap();
        assert!(simulation.constraints_off()[0] < 1e-14);
        for k in 0..3 {
            mean[k] += at[1][k] / 200.0;
        }
    }
    // About the vertical through the anchors no direction is preferred.
    assert!(mean[0].abs() < 0.15 && mean[1].abs() < 0.15, "{mean:?}");
}

#[test]
fn random_positions_of_loops_and_long_chains() {
    let chain = model::cases::get("ten-equal-bars").unwrap().problem();
    let chain = model::system::System::from(chain.chain());
    for seed in 0..20 {
        random_position(&chain, seed).unwrap();
    }
}
