//! Chains, systems, and censuses that are checked whatever they find.

use census::{Census, Settings};
use model::system::{Joint, Member, System};
use model::{Bar, Problem};
pub use samples::chain as problem;

/// Gravity of systems, m/s².
pub const G: f64 = 10.0;

pub fn system(joints: Vec<Joint>, members: Vec<Member>) -> System {
    System::new("test", G, joints, members).unwrap()
}

/// A member without mass.
pub fn light(length_m: f64) -> Bar {
    Bar::homogeneous(length_m, 0.0).unwrap()
}

pub fn equal(bars: usize, end_m: [f64; 3]) -> Problem {
    problem(&vec![(1.0, 1.0, 0.5); bars], end_m)
}

pub fn census(problem: &Problem) -> Census {
    match Census::take(problem, &Settings::default()) {
        Ok(census) => {
            // Whatever was found is right, complete or not.
            assert_eq!(census.check(problem), Ok(()));
            census
        }
        Err(error) => panic!("{error}"),
    }
}
