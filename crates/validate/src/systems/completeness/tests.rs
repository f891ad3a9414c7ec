//! What is looked up unasked, and how far an answer is from a list.

use model::Bar;
use model::system::{Joint, Member};

use super::super::tests::lamp;
use super::*;

/// The lamp's census has it below its anchors alone; its bars have 10 m together.
#[test]
fn distances_are_parts_of_the_total_length() {
    let (system, right) = lamp();
    let census = SystemCensus::take(&system, &Settings::default()).unwrap();
    let [position] = &census.equilibria[..] else { panic!("{:?}", census.equilibria) };
    let off = |change: fn(&mut SystemEquilibrium)| {
        let mut answer = right.clone();
        change(&mut answer);
        distance(&system, position, &answer)
    };
    assert!(off(|_| ()) < 1e-15);
    assert!((off(|a| a.joints_m[2][1] += 0.5) - 0.05).abs() < 1e-14);
    assert!((off(|a| a.joints_m[2][2] -= 2.0) - 0.2).abs() < 1e-14);
    assert_eq!(off(|a| a.joints_m[2][0] = f64::NAN).to_bits(), f64::INFINITY.to_bits());
    assert_eq!(off(|a| a.joints_m.truncate(2)).to_bits(), f64::INFINITY.to_bits());
}

/// Strands of 5, 4 and 4 bars from three anchors to one knot.
#[test]
fn long_bridles_are_not_looked_up_unasked() {
    let anchors_m = [[0.0; 3], [4.0, 0.0, 0.0], [1.0, 4.0, 0.5]];
    let mut joints = vec![Joint::free("knot").with_mass(1.0)];
    let mut members = vec![];
    for (strand, (at_m, bars)) in anchors_m.into_iter().zip([5, 4, 4]).enumerate() {
        let mut last = joints.len();
        joints.push(Joint::anchor(format!("anchor {strand}"), at_m));
        for bar in 1..=bars {
            let next = if bar == bars { 0 } else { joints.len() };
            if next > 0 {
                joints.push(Joint::free(format!("{strand}.{bar}")));
            }
            members.push(Member::bar(last, next, Bar::homogeneous(1.0, 1.0).unwrap()));
            last = next;
        }
    }
    let system = System::new("bridle", 9.81, joints, members).unwrap();
    let complete = |census: UseCensus| {
        let mut answers = [lamp().1];
        look_up(&system, census, &mut answers);
        answers[0].evidence.ladder.complete.reason().cloned()
    };
    let limit = |limit: usize| Some(Reason::NoCensus(NoCensus::Bridle { bars: 13, limit }));
    assert_eq!(complete(UseCensus::Auto), limit(8));
    assert_eq!(complete(UseCensus::Always), limit(12));
    assert_eq!(complete(UseCensus::Never), Some(Reason::NoCensus(NoCensus::NotAsked)));
}
