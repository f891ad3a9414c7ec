//! What is given, and what is missing in it.

use model::Bar;
use model::system::{Joint, Member};

use super::super::tests::lamp;
use super::*;

const PLACES: [Vector; 3] = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];

/// A star of so many joints about an anchor.
fn star(joints: usize) -> System {
    let mut all = vec![Joint::anchor("A", [0.0; 3])];
    all.extend((1..=joints).map(|k| Joint::free(format!("P{k}"))));
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    System::new("star", 10.0, all, (1..=joints).map(|k| Member::bar(0, k, bar)).collect()).unwrap()
}

#[test]
fn five_names_are_listed_and_the_rest_counted() {
    let missing = |joints: usize| {
        let given = [("A".to_owned(), [0.0; 3])];
        ForeignAnswer::by_name(&star(joints), "x", given).unwrap_err().to_string()
    };
    let five = "the answer has no place for joint \"P1\", \"P2\", \"P3\", \"P4\", \"P5\"";
    assert_eq!(missing(5), five);
    assert_eq!(missing(6), format!("{five} and 1 more"));
    assert_eq!(missing(8), format!("{five} and 3 more"));
    let system = star(7);
    let answer = ForeignAnswer::in_order(&system, "x", vec![[0.0; 3]; 8], None).unwrap();
    let forces = [("P3".to_owned(), "A".to_owned(), 1.0)];
    assert_eq!(
        answer.with_forces(&system, forces).unwrap_err().to_string(),
        "forces are given, but not that of member \"1 (A - P1)\", \"2 (A - P2)\", \"4 (A - P4)\", \
         \"5 (A - P5)\", \"6 (A - P6)\" and 1 more"
    );
}

#[test]
fn lists_in_order_are_as_long_as_the_system_and_finite() {
    let system = lamp();
    let of = |joints_m: Vec<Vector>, axial_n: Option<Vec<f64>>| {
        ForeignAnswer::in_order(&system, "x", joints_m, axial_n).map_err(|error| error.to_string())
    };
    let right = of(PLACES.to_vec(), Some(vec![1.0, -2.0])).unwrap();
    assert_eq!((right.joints_m, right.axial_n), (PLACES.to_vec(), Some(vec![1.0, -2.0])));
    let told = |found: Result<ForeignAnswer, String>, wanted: &str| {
        assert_eq!(found.unwrap_err(), wanted);
    };
    told(of(PLACES[..2].to_vec(), None), "the answer has 2 joints, and the system 3");
    told(of(PLACES.to_vec(), Some(vec![1.0])), "the answer has 1 member forces, and the system 2");
    let mut none = PLACES.to_vec();
    none[1][2] = f64::INFINITY;
    told(of(none, None), "a number of joint \"B\" is not finite");
    let none = Some(vec![1.0, f64::NAN]);
    told(of(PLACES.to_vec(), none), "a number of 2 (P - B) is not finite");
}

#[test]
fn names_may_come_in_any_order() {
    let system = lamp();
    let places = [("P", 2), ("A", 0), ("B", 1)].map(|(name, k)| (name.to_owned(), PLACES[k]));
    let answer = ForeignAnswer::by_name(&system, "a table", places).unwrap();
    assert_eq!(answer.joints_m, PLACES);
    assert_eq!(answer.source, SolverName::new("a table"));
    let force = |a: &str, b: &str, n: f64| (a.to_owned(), b.to_owned(), n);
    let forces = [force("B", "P", 3.0), force("A", "P", 2.0)];
    let answer = answer.with_forces(&system, forces).unwrap();
    assert_eq!(answer.axial_n, Some(vec![2.0, 3.0]));
    let reactions = [("B".to_owned(), [1.0, 2.0, 3.0])];
    let answer = answer.with_reactions(&system, reactions).unwrap();
    assert_eq!(answer.reactions_n, Some(vec![[0.0; 3], [1.0, 2.0, 3.0], [0.0; 3]]));

    let told = |forces: &[(String, String, f64)]| {
        answer.clone().with_forces(&system, forces.to_vec()).unwrap_err().to_string()
    };
    let not_finite = [force("B", "P", 1.0), force("A", "P", f64::NAN)];
    assert_eq!(told(&not_finite), "a number of 1 (A - P) is not finite");
    assert_eq!(told(&[force("B", "A", 1.0)]), "no member connects \"B\" with \"A\"");
    let twice = [force("A", "P", 1.0), force("P", "A", 2.0)];
    assert_eq!(told(&twice), "the force between \"P\" and \"A\" is given twice");
    assert!(told(&[force("A", "nobody", 1.0)]).starts_with("the system has no joint \"nobody\""));
    let twice = [("A".to_owned(), [1.0; 3]), ("A".to_owned(), [2.0; 3])];
    let error = answer.clone().with_reactions(&system, twice).unwrap_err();
    assert_eq!(error, GivenError::Repeated("A".to_owned()));
    let error = answer.with_reactions(&system, [("A".to_owned(), [0.0, f64::NAN, 0.0])]);
    assert_eq!(error.unwrap_err().to_string(), "a number of joint \"A\" is not finite");
}

/// One letter off is near, a word off is not.
#[test]
fn a_near_name_is_suggested() {
    let system = model::cases::exhibit("lamp").unwrap().system();
    let error = |name: &str| unknown(&system, name);
    let suggested = |name: &str| match error(name) {
        GivenError::UnknownJoint { suggestion, .. } => suggestion,
        other => panic!("{other:?}"),
    };
    assert_eq!(suggested("lamb"), Some("lamp".to_owned()));
    assert_eq!(suggested("something else"), None);
}
