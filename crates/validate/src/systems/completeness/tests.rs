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

/// Strands of 3, 2 and 1 bars from three anchors to one knot, whose joints move in four ways.
#[test]
fn long_bridles_are_not_looked_up_unasked() {
    let anchors_m = [[0.0; 3], [4.0, 0.0, 0.0], [1.0, 4.0, 0.5]];
    let mut joints = vec![Joint::free("knot").with_mass(1.0)];
    let mut members = vec![];
    for (strand, (at_m, bars)) in anchors_m.into_iter().zip([3, 2, 1]).enumerate() {
        let mut last = joints.len();
        joints.push(Joint::anchor(format!("anchor {strand}"), at_m));
        for bar in 1..=bars {
            let next = if bar == bars { 0 } else { joints.len() };
            if next > 0 {
                joints.push(Joint::free(format!("{strand}.{bar}")));
            }
            members.push(Member::bar(last, next, Bar::homogeneous(4.0, 1.0).unwrap()));
            last = next;
        }
    }
    let system = System::new("bridle", 9.81, joints, members).unwrap();
    let complete = |census: UseCensus| {
        let mut answers = [lamp().1];
        look_up(&system, &wanted_census(&system, census), &mut answers);
        answers[0].evidence.ladder.complete.reason().cloned()
    };
    let refused = Some(Reason::NoCensus(NoCensus::Motions { closures: 2, motions: 4, limit: 3 }));
    assert_eq!(complete(UseCensus::Auto), refused);
    assert_eq!(complete(UseCensus::Always), refused);
    assert_eq!(complete(UseCensus::Never), Some(Reason::NoCensus(NoCensus::NotAsked)));
}

/// 1e-10 and 1e-12 of the bars' 10 m are 1.01e-9 m.
#[test]
fn an_answer_beyond_the_accuracy_of_solvers_is_refuted() {
    let (system, right) = lamp();
    let census = SystemCensus::take(&system, &Settings::default()).unwrap();
    assert!(census.complete);
    let told = |census: &SystemCensus, off_m: f64| {
        let mut answer = right.clone();
        answer.joints_m[2][1] += off_m;
        certify_by_census(&system, census, &mut answer);
        answer.evidence.ladder
    };
    for sign in [1.0, -1.0] {
        assert!(told(&census, sign * 1.005e-9).complete.is_reached());
        for off_m in [1.015e-9, 0.5] {
            let ladder = told(&census, sign * off_m);
            let Some(Reason::RefutedByCensus { distance }) = ladder.complete.reason() else {
                panic!("{ladder:?}")
            };
            assert!((distance * 10.0 / off_m - 1.0).abs() < 1e-3 && ladder.failed());
        }
    }
    let far = told(&census, f64::NAN);
    assert!(matches!(far.complete.reason(), Some(Reason::Elsewhere { .. })), "{far:?}");
    let mut partial = census.clone();
    partial.complete = false;
    let ladder = told(&partial, 0.5);
    let Some(Reason::Elsewhere { distance }) = ladder.complete.reason() else { panic!() };
    assert!((distance - 0.05).abs() < 1e-12 && !ladder.failed());
    partial.equilibria.clear();
    assert_eq!(told(&partial, 0.0).complete, Status::Open(Reason::NothingListed));
}
