//! Answers of others with ropes: judged by their places, and by forces of ropes or of their spans.

use model::system::{Joint, Member, System};
use model::{Bar, Place, Proved};
use validate::foreign::{Finding, ForeignAnswer, GivenError, Judgement, Law, Violation};

use super::{judged, places};

/// With the tension of each rope, with that of each of its spans, and with none.
#[test]
fn answers_of_others_with_ropes_are_confirmed() {
    for sample in samples::ropes() {
        let (system, name) = (&sample.system, sample.system.name());
        let members = system.members().iter().zip(&sample.axial_n);
        let spans = members.flat_map(|(member, axial_n)| member.spans().map(|_| *axial_n));
        for axial_n in [None, Some(sample.axial_n.clone()), Some(spans.collect())] {
            let found = judged(system, places(&sample), axial_n);
            assert_eq!(found.finding, Finding::Confirmed, "{name}: {:?}", found.violations);
            assert!(found.statics.largest() < 1e-9, "{name}: {:?}", found.statics);
            for (axial_n, wanted_n) in found.answer.axial_n.iter().zip(&sample.axial_n) {
                assert!((axial_n - wanted_n).abs() < 1e-6 * 100.0, "{name}: {axial_n}");
            }
            let agreed = found.ladder.agreed.proof().unwrap();
            let proved = agreed.forces_found.as_ref().and_then(|forces| forces.proved);
            assert_eq!(proved, Some(Proved::RankAndStability), "{name}");
        }
    }
}

/// The ring on a rope of 5 m, and the tackle: copies of their answers, each with one thing wrong.
#[test]
fn what_is_wrong_with_a_rope_of_others_is_named() {
    let [ring, stretched, .., tackle] = &samples::ropes()[..4] else { panic!() };
    let (at, tension_n) = (places(ring), ring.axial_n[0]);
    let one = |found: Judgement| -> Violation {
        assert_eq!(found.finding, Finding::Refuted);
        assert_eq!(found.violations.len(), 1, "{:?}", found.violations);
        found.violations[0]
    };
    let near = |value: f64, wanted: f64| assert!((value - wanted).abs() < 1e-9, "{value} {wanted}");
    // Another tension on each side of the ring: their mean is right, and 0.6 N each way are not.
    let sides_n = [tension_n - 0.6, tension_n + 0.6];
    let wrong = one(judged(&ring.system, at.clone(), Some(sides_n.to_vec())));
    assert_eq!((wrong.place, wrong.law), (Place::Joint(2), Law::Tension { member: 1, sides_n }));
    near(wrong.value, 1.2);
    assert_eq!(wrong.place_in(&ring.system), "joint P");
    assert!(wrong.what().starts_with("the rope (member 1) pulls with 81.12208333 N on one side"));
    // The wrong tension on both sides leaves 2 cos a of it, upwards.
    let wrong = one(judged(&ring.system, at.clone(), Some(vec![tension_n + 0.6])));
    let Law::Balance { left_n } = wrong.law else { panic!("{wrong:?}") };
    near(left_n[2], 2.0 * 0.6 * 0.6);
    assert_eq!(wrong.place, Place::Joint(2));
    // On the ellipse of the rope, and not in its lowest point: 24 - 25 (z - z^2) = 68 at x = 2.
    let z = 0.5 - (0.25_f64 + 1.76 / 0.96).sqrt();
    let aside = vec![at[0], at[1], [2.0, 0.0, z]];
    let [a, b] =
        [[2.0, z], [-2.0, z - 1.0]].map(|[x, z]: [f64; 2]| [x / x.hypot(z), z / x.hypot(z)]);
    let wrong = one(judged(&ring.system, aside.clone(), Some(vec![tension_n])));
    let Law::Balance { left_n } = wrong.law else { panic!("{wrong:?}") };
    near(left_n[0], -tension_n * (a[0] + b[0]));
    near(left_n[2], -tension_n * (a[1] + b[1]) - 1.2 * tension_n);
    // Without forces none balance it.
    let found = judged(&ring.system, aside, None);
    assert!(found.finding == Finding::Refuted, "{:?}", found.finding);
    // A rope of 5 m as long as its spans: 0.01 m lower both together are 2 * 0.006 m longer.
    let low = vec![at[0], at[1], [4.0 / 3.0, 0.0, -1.01]];
    let found = judged(&ring.system, low, None);
    let wrong = found.violations[0];
    let [first, second] = [[4.0 / 3.0, 1.01], [8.0 / 3.0, 2.01]].map(|[x, z]| f64::hypot(x, z));
    let Law::Length { length_m, distance_m } = wrong.law else { panic!("{wrong:?}") };
    near(length_m, 5.0);
    near(distance_m, first + second);
    // One that stretches and bears what its length does not give.
    let found = judged(&stretched.system, at, Some(vec![tension_n + 0.6]));
    let Law::Elongation { elastic_n, .. } = found.violations[0].law else { panic!("{found:?}") };
    near(elastic_n, tension_n);
    // Five spans, of which the third bears more: at both joints that it runs over.
    let of = |n: usize| tackle.axial_n[0] + if n == 2 { 0.5 } else { 0.0 };
    let found = judged(&tackle.system, places(tackle), Some((0..5).map(of).collect()));
    let jumps: Vec<Place> = found
        .violations
        .iter()
        .filter(|violation| matches!(violation.law, Law::Tension { member: 1, .. }))
        .map(|violation| violation.place)
        .collect();
    assert_eq!(jumps, [Place::Joint(0), Place::Joint(1)]);
}

/// Two rings of 1 and 3 kg in one place, each of which its span could hold: both together hang by a tension that is
/// known, and by no other.
#[test]
fn rings_in_one_place_are_in_balance_together() {
    let joints = samples::joints(&[[0.0; 3], [4.8, 0.0, 0.0]], &[1.0, 3.0]);
    // Two spans of 3 m, each 1.8 m deep: 3-4-5.
    let rope = Member::cable(0, 1, Bar::homogeneous(6.0 / 1.001, 0.0).unwrap()).over(vec![2, 3]);
    let tension_n = 40.0 / (2.0 * 0.6);
    let rope = rope.with_stiffness(1e3 * tension_n);
    let system = System::new("rings", 10.0, joints, vec![rope]).unwrap();
    let place = [2.4, 0.0, -1.8];
    let at = || vec![[0.0; 3], [4.8, 0.0, 0.0], place, place];
    // With 0.7 the span between them would also have to bear 24.6 N of S at a tension of 23.3 N.
    for (factor, broken) in [(1.0, 0), (1.003, 1), (0.7, 2), (2.0, 1)] {
        let found = judged(&system, at(), Some(vec![factor * tension_n]));
        let violations = &found.violations;
        assert_eq!(found.is_confirmed(), broken == 0, "{factor}: {violations:?}");
        assert_eq!(found.is_refuted(), broken > 0, "{factor}: {violations:?}");
        let left = violations.iter().filter_map(|violation| match violation.law {
            Law::Balance { left_n } => Some(left_n[2]),
            _ => None,
        });
        let left: Vec<f64> = left.collect();
        assert_eq!(left.len(), broken, "{factor}: {violations:?}");
        let near = |value: f64, wanted: f64| assert!((value - wanted).abs() < 1e-6, "{left:?}");
        near(left.last().copied().unwrap_or_default(), 40.0 * (factor - 1.0));
        if broken == 2 {
            near(left[0], 0.6 * factor * tension_n - 30.0);
        }
    }
}

/// A slack rope bears nothing, and its spans may be as they are.
#[test]
fn a_slack_rope_of_others_bears_nothing() {
    let slack = &samples::ropes()[8];
    let at = places(slack);
    let found = judged(&slack.system, at.clone(), Some(vec![3.0, slack.axial_n[1]]));
    let law = Law::Slack { force_n: 3.0, length_m: 9.0, distance_m: 2.0 * 5.0_f64.sqrt() };
    assert!(found.violations.iter().any(|violation| violation.law == law), "{found:?}");
    assert_eq!(judged(&slack.system, at, None).answer.axial_n[0].to_bits(), 0.0_f64.to_bits());
}

/// By the joints of a whole rope, and by those of its spans in their order.
#[test]
fn forces_of_ropes_come_by_the_names_of_joints() {
    let tackle = &samples::ropes()[3].system;
    let answer = ForeignAnswer::in_order(tackle, "a table", vec![[0.0; 3]; 3], None).unwrap();
    let with = |forces: &[(&str, &str, f64)]| {
        let forces = forces.iter().map(|(a, b, n)| ((*a).to_owned(), (*b).to_owned(), *n));
        let found = answer.clone().with_forces(tackle, forces);
        found.map(|found| (found.axial_n.unwrap(), found.spans_n[&0].clone()))
    };
    assert_eq!(with(&[("end", "beam", 5.0)]), Ok((vec![5.0], vec![5.0; 5])));
    let spans = [1.0, 2.0, 3.0, 4.0].map(|n| ("block", "beam", n));
    // The last span has the joints of the whole.
    let error = with(&spans).unwrap_err();
    assert_eq!(error.to_string(), "forces are given, but not that of member \"1 (beam - end)\"");
    let error = with(&[("beam", "end", 1.0), ("end", "beam", 5.0)]).unwrap_err();
    assert_eq!(error.to_string(), "the force between \"end\" and \"beam\" is given twice");
    let own = &samples::ropes()[4].system;
    let answer = ForeignAnswer::in_order(own, "a table", vec![[0.0; 3]; 3], None).unwrap();
    let spans = [
        ("beam", "block", 1.0),
        ("block", "beam", 2.0),
        ("end", "beam", 9.0),
        ("beam", "block", 3.0),
    ];
    let forces = spans.map(|(a, b, n)| (a.to_owned(), b.to_owned(), n));
    let found = answer.clone().with_forces(own, forces).unwrap();
    assert_eq!(found.spans_n[&0], [1.0, 2.0, 3.0, 9.0]);
    assert_eq!(found.axial_n, Some(vec![3.75]));
    let count = |n: usize| {
        let places = vec![[0.0; 3]; 3];
        ForeignAnswer::in_order(own, "a table", places, Some(vec![1.0; n])).map(|_| ())
    };
    assert_eq!([1, 4].map(count), [Ok(()), Ok(())]);
    let wrong = GivenError::Count { of: "member forces", wanted: 1, found: 3 };
    assert_eq!(count(3), Err(wrong));
}

/// A rope from A over W to P and one from A over P to W: each has the ends of a span of the other, and both run
/// between W and P. How many forces there are tells members from spans; those between the same joints are in the
/// order of the system.
#[test]
fn forces_of_ropes_that_share_their_joints() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("P", [4.0, 0.0, 1.0]),
        Joint::free("W").with_mass(20.0),
    ];
    let cable = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let members = vec![
        Member::cable(0, 1, cable(8.0)).over(vec![2]),
        Member::cable(0, 2, cable(9.0)).over(vec![1]),
    ];
    let system = System::new("crossed", 10.0, joints, members).unwrap();
    let answer = ForeignAnswer::in_order(&system, "a table", vec![[0.0; 3]; 3], None).unwrap();
    let with = |forces: &[(&str, &str, f64)]| {
        let forces = forces.iter().map(|(a, b, n)| ((*a).to_owned(), (*b).to_owned(), *n));
        answer.clone().with_forces(&system, forces).map(|found| {
            let spans = found.spans_n.into_values().collect::<Vec<_>>();
            (found.axial_n.unwrap(), spans)
        })
    };
    let members = [("W", "A", 7.0), ("A", "P", 5.0)];
    assert_eq!(with(&members), Ok((vec![5.0, 7.0], vec![vec![5.0; 2], vec![7.0; 2]])));
    let spans = [("P", "A", 3.0), ("W", "P", 2.0), ("A", "W", 1.0), ("P", "W", 4.0)];
    let wanted = vec![vec![1.0, 2.0], vec![3.0, 4.0]];
    assert_eq!(with(&spans), Ok((vec![1.5, 3.5], wanted)));
    // One of the spans twice, and another not at all.
    let error = with(&[spans[0], spans[1], spans[2], spans[2]]).unwrap_err();
    assert_eq!(error.to_string(), "the force between \"A\" and \"W\" is given twice");
    let error = with(&spans[..3]).unwrap_err();
    assert_eq!(error.to_string(), "forces are given, but not that of member \"2 (A - W)\"");
}
