//! What to do about a refusal: words that name the remedy, for every refusal that has one.

use model::Bar;
use model::system::{Joint, Kind, Member, PrestressError, Refusal, System, SystemError};
use model::system_file::{Described, SystemFileErrorKind, parse};

#[track_caller]
fn advises(kind: &SystemFileErrorKind, words: &[&str]) {
    let help = kind.help();
    match &help {
        Some(help) => assert!(words.iter().all(|word| help.contains(word)), "{help}"),
        None => assert!(words.is_empty(), "no advice, not {words:?}"),
    }
    assert_eq!(help.is_some(), !words.is_empty(), "{help:?}");
}

#[test]
fn systems() {
    let system = SystemFileErrorKind::System;
    let (from, to) = ("A".to_owned(), "B".to_owned());
    let parallel = SystemError::Parallel { member: 2, first: 1, from, to };
    advises(&system(parallel), &["one bar", "a joint into one"]);
    advises(&system(SystemError::Overflow("total load")), &["metres", "newtons"]);
    advises(&system(SystemError::NoMembers), &["[[bars]]"]);
    advises(&system(SystemError::Gravity(0.0)), &[]);
}

#[test]
fn prestress_and_refusals() {
    let prestress = SystemFileErrorKind::Prestress;
    advises(&prestress(PrestressError::Inextensible), &["stiffness_n", "EA"]);
    let sign = PrestressError::Sign { kind: Kind::Cable, prestress_n: -1.0 };
    advises(&prestress(sign), &["tension is positive"]);
    advises(&prestress(PrestressError::NotFinite(f64::INFINITY)), &[]);
    advises(&SystemFileErrorKind::Refused(Refusal::NothingMoves), &["without at_m"]);
    advises(&SystemFileErrorKind::Refused(Refusal::LoadOnAnchors), &["can move"]);
}

#[test]
fn folders_and_numbers_in_quotes() {
    let folder = std::io::Error::from(std::io::ErrorKind::IsADirectory);
    advises(&SystemFileErrorKind::Unreadable(folder), &["folder"]);
    let missing = std::io::Error::from(std::io::ErrorKind::NotFound);
    advises(&SystemFileErrorKind::Unreadable(missing), &[]);
    let found = "a string";
    advises(&SystemFileErrorKind::WrongType { found, wanted: "a number" }, &["without quotes"]);
    advises(&SystemFileErrorKind::WrongType { found, wanted: "a table" }, &[]);
    advises(&SystemFileErrorKind::WrongType { found: "a table", wanted: "a number" }, &[]);
}

/// The way round a loop is told by six names at most: three, how many are left out, and two.
#[test]
fn long_ways_are_shortened_in_the_middle() {
    let told = |joints: usize| {
        let name = |k: usize| format!("J{k}");
        let mut all = vec![Joint::anchor(name(0), [0.0; 3])];
        all.extend((1..joints).map(|k| Joint::free(name(k))));
        let bar =
            |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 1.0).unwrap());
        let mut members: Vec<_> = (1..joints).map(|k| bar(k - 1, k, 1.0)).collect();
        members.push(bar(0, joints - 1, 100.0));
        match System::new("", 9.81, all, members).unwrap().refusal().unwrap_err() {
            Refusal::TooLong { way, .. } => way,
            other => panic!("{other}"),
        }
    };
    assert_eq!(told(6), ["J0", "J1", "J2", "J3", "J4", "J5"]);
    assert_eq!(told(7), ["J0", "J1", "J2", "2 more", "J5", "J6"]);
    assert_eq!(told(9), ["J0", "J1", "J2", "4 more", "J7", "J8"]);
}

/// What is far from unit length is scaled before it is squared.
#[test]
fn directions_of_any_length_are_made_units() {
    let read = |direction: &str| {
        let text = format!(
            "[joints]\nA = {{ at_m = [0, 0, 0], along = {direction} }}\nB = {{ at_m = [1, 0, 0] }}\nP = {{}}\n\
             [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 1\nmass_kg = 1\n\
             [[bars]]\nfrom = \"B\"\nto = \"P\"\nlength_m = 1\nmass_kg = 1\n"
        );
        parse(&text, "f")
    };
    for text in ["[3, 0, 4]", "[3e300, 0, 4e300]", "[3e-300, 0, 4e-300]", "[0.6, 0, 0.8]"] {
        let Described::System(system) = read(text).unwrap() else { panic!("{text}") };
        match system.joints()[0].support {
            model::system::Support::Line { direction: [x, y, z], .. } => {
                assert!((x - 0.6).abs() + y.abs() + (z - 0.8).abs() < 1e-15, "{text}");
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(matches!(read("[0, 0, 0]").unwrap_err().kind(), SystemFileErrorKind::NoDirection));
}

/// Two runs between the same joints have joints of their own, and every joint its own name.
#[test]
fn runs_between_the_same_joints_are_told_apart() {
    let run = "[[bars]]\nfrom = \"A\"\nto = \"B\"\nlength_m = 1\nmass_kg = 1\ncount = 3\n";
    let joints = "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [1, 0, 0] }\n";
    let text = format!("{joints}{run}{run}{run}");
    let Described::System(system) = parse(&text, "f").unwrap() else { panic!("{text}") };
    let names: Vec<_> = system.joints().iter().skip(2).map(|joint| joint.name.text()).collect();
    let expected = ["A-B.1", "A-B.2", "A-B#2.1", "A-B#2.2", "A-B#3.1", "A-B#3.2"];
    assert_eq!(names, expected);
}

/// A gravity that is refused is marked where it is written.
#[test]
fn gravity_is_marked_at_its_key() {
    let text = "gravity_m_s2 = -1\n[joints]\nA = { at_m = [0, 0, 0] }\nP = {}\n\
                [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 1\nmass_kg = 1\n";
    let error = parse(text, "f").unwrap_err();
    assert!(error.to_string().contains("f:1:"), "{error}");
}
