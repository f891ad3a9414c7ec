//! Steps that are taken and steps that are halved, by hand.

use super::*;

/// From an energy of 1 a step that promises a fall of 1 must bring 1e-4 of it.
#[test]
fn a_step_must_bring_a_fair_part_of_its_fall() {
    let settings = BatchSettings::default();
    for (value, accepted) in [(0.999_8, true), (0.999_95, false), (1.000_05, false)] {
        let mut lane = Lane { value: 1.0, fall: -1.0, part: 1.0, ..Lane::new(0) };
        let next = lane.measured(&settings, [0.0; 2], [1.0, 0.0, 1.0], value);
        assert_eq!(next, if accepted { Next::Accept } else { Next::Step(0.5) }, "{value}");
    }
}

/// Where no half of a step helps, a chain that was settling is at its minimum.
#[test]
fn halving_ends_at_a_minimum_only_where_the_chain_was_settling() {
    for (settling, end) in [(0, Next::Stalled), (1, Next::Minimum)] {
        let mut lane = Lane { settling, part: 1.0, ..Lane::new(0) };
        let mut part = 1.0;
        for _ in 0..BISECTIONS {
            part *= 0.5;
            assert_eq!(lane.halve(), Next::Step(part));
        }
        assert_eq!(lane.halve(), end);
    }
}
