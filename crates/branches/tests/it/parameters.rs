//! `--vary`: what is accepted, what it does, and every error with its place.

use branches::{
    Combine, Continuation, ContinuationError, ContinuationSettings, Parameter, ParameterError,
    Variation,
};
use model::Chain;
use model::system::System;
use model::system_file::Described;

fn vary(text: &str) -> Parameter {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

fn paper() -> Chain {
    model::cases::paper().into_chain()
}

#[test]
fn paths_reach_every_number_of_a_system_file() {
    for (path, value, wanted) in [
        ("gravity_m_s2", 1.62, "gravity_m_s2 = 1.62"),
        ("anchors.start_m.x", 0.25, "start_m = [0.25, 0.0, 0.0]"),
        ("anchors.end_m[3]", -1.5, "end_m = [0.0, 0.0, -1.5]"),
        ("bars.2.mass_kg", 7.0, "mass_kg = 7.0"),
        ("bars[3].length_m", 1.25, "length_m = 1.25"),
        ("bars.*.mass_kg", 5.0, "mass_kg = 5.0\ncount = 3"),
        ("bars.1.centre_m", 0.125, "centre_m = 0.125"),
        ("bars.1.inertia_kg_m2.2", 3.0, "inertia_kg_m2 = [0.0, 3.0"),
    ] {
        let variation =
            Variation::new(&paper(), &[vary(&format!("{path}={value}"))], Combine::Product);
        let variation = variation.unwrap();
        let problem = variation.problem(&variation.paths()[0][0]).unwrap();
        let text = model::system_file::write_system(problem.chain());
        assert!(text.contains(wanted), "{path}: {wanted} is not in\n{text}");
    }
}

#[test]
fn a_centre_in_the_middle_stays_there() {
    let variation =
        Variation::new(&paper(), &[vary("bars.*.length_m=2")], Combine::Product).unwrap();
    let problem = variation.problem(&[2.0]).unwrap();
    assert!(problem.chain().bars().iter().all(|bar| bar.centre_m().to_bits() == 1.0_f64.to_bits()));
    let moved = [vary("bars.1.centre_m=0.9"), vary("bars.1.length_m=0.8")];
    let variation = Variation::new(&paper(), &moved, Combine::Product).unwrap();
    let error = variation.problem(&[0.9, 0.8]).unwrap_err();
    assert!(error.to_string().starts_with("bar 1: the centre of weight must lie on the bar"));
}

#[test]
fn ranges_have_exact_ends_and_an_exact_zero() {
    let range = vary("anchors.end_m.x=-0.3..0.7:11").values;
    assert_eq!(range.len(), 11);
    assert_eq!(
        [range[0], range[3], range[10]].map(f64::to_bits),
        [-0.3, 0.0, 0.7].map(f64::to_bits)
    );
}

#[test]
fn products_and_steps() {
    let two = [vary("bars.2.mass_kg=1,2"), vary("anchors.end_m.z=-2,-1.5,-1.2")];
    let variation = Variation::new(&paper(), &two, Combine::Product).unwrap();
    assert_eq!(variation.paths().len(), 2);
    assert_eq!(variation.paths()[1][2], [2.0, -1.2]);
    let error = Variation::new(&paper(), &two, Combine::Zip).unwrap_err();
    assert!(error.to_string().contains("3 values, but `bars.2.mass_kg` has 2"), "{error}");
    let two = [vary("bars.2.mass_kg=1,2"), vary("anchors.end_m.z=-2,-1.5")];
    let variation = Variation::new(&paper(), &two, Combine::Zip).unwrap();
    assert_eq!(variation.paths(), [[[1.0, -2.0], [2.0, -1.5]]]);
}

#[test]
fn errors_say_what_where_and_what_is_allowed() {
    for (text, column, what, help) in [
        (
            "bars.2.mas_kg=1",
            8,
            "unknown key `mas_kg`",
            "did you mean `mass_kg`? allowed here: length_m",
        ),
        ("bar.2.mass_kg=1", 1, "unknown key `bar`", "did you mean `bars`?"),
        ("anchors.end_m.q=1", 15, "unknown component `q`", "allowed here: x, y, z"),
        ("anchors.end_m.4=1", 15, "unknown component `4`", "x, y, z"),
        ("anchors.end_m=1", 14, "a part of it is missing", "x, y, z"),
        ("anchors.middle_m.x=1", 9, "unknown key `middle_m`", "start_m, end_m"),
        ("bars.0.mass_kg=1", 6, "`0` is not a bar", "from 1"),
        (
            "bars.two.mass_kg=1",
            6,
            "`two` is not a bar",
            "a range 1-20, a row FROM-TO.*, or * for all",
        ),
        ("bars.2.mass_kg.x=1", 16, "has no parts", "bars.2.mass_kg="),
        ("=1", 1, "unknown key ``", "loads, lengths, gravity_m_s2, floor_m, anchors, joints, bars"),
        ("gravity_m_s2", 13, "`=` and the values are missing", "0.1,1,10"),
        ("gravity_m_s2=", 14, "a number is missing", "-2.9..-0.1:500"),
        ("gravity_m_s2=1,,2", 16, "a number is missing", "list"),
        ("gravity_m_s2=1,x", 16, "`x` is not a number", "list"),
        ("gravity_m_s2=inf", 14, "`inf` is not finite", "list"),
        ("gravity_m_s2=1e999", 14, "`1e999` is not finite", "list"),
        ("gravity_m_s2=1..2:1", 19, "`1` is not a number of points", "from 2 to 1000000"),
        ("gravity_m_s2=1..2:1e9", 19, "`1e9` is not a number of points", "from 2"),
        ("gravity_m_s2=..2:5", 14, "a number is missing", "range"),
    ] {
        let error = text.parse::<Parameter>().unwrap_err();
        assert_eq!(error.column(), column, "{text}: {error}");
        assert!(error.what.contains(what), "{text}: {}", error.what);
        assert!(error.help.contains(help), "{text}: {}", error.help);
    }
}

#[test]
fn errors_of_the_chain_and_of_the_whole() {
    let variation = |texts: &[&str]| -> ParameterError {
        let all: Vec<Parameter> = texts.iter().map(|text| vary(text)).collect();
        Variation::new(&paper(), &all, Combine::Product).unwrap_err()
    };
    let error = variation(&["bars.12.mass_kg=1"]);
    assert_eq!((error.column(), error.span.len()), (6, 2));
    assert_eq!(error.what, "there is no bar 12");
    assert!(variation(&["gravity_m_s2=1", "gravity_m_s2=2"]).what.contains("varied twice"));
    let error = variation(&["gravity_m_s2=1..2:1001", "bars.1.mass_kg=1..2:1000"]);
    assert!(error.what.contains("too many combinations"), "{error}");
    let error = variation(&["gravity_m_s2=1..2"]);
    assert_eq!((error.column(), error.what.as_str()), (18, "the number of points is missing"));
    assert!(error.help.contains("from..to:points") && vary("loads=0..1.2").open);
    assert!(variation(&["joints.4.mass_kg=1,2"]).what.contains("there is no joint `4`"));
}

/// No text makes the parser panic.
#[test]
fn random_bytes_never_panic() {
    const ALPHABET: &[char] =
        &['a', 'n', 'c', 'b', '.', '[', ']', '=', ',', ':', '-', '1', '9', '*', 'e', '\u{e4}', ' '];
    let mut state = 1_u64;
    let mut accepted = 0;
    for round in 0..20_000 {
        let mut text: Vec<char> = "bars[2].mass_kg=1..2:10".chars().collect();
        for _ in 0..=round % 6 {
            // Knuth's linear congruential generator; the high bits are the good ones.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let at = usize::try_from(state >> 33).unwrap() % text.len();
            text[at] = ALPHABET[usize::try_from(state >> 40).unwrap() % ALPHABET.len()];
        }
        let text: String = text.into_iter().collect();
        match text.parse::<Parameter>() {
            Ok(_) => accepted += 1,
            Err(error) => assert!(!error.to_string().is_empty() && error.span.end <= text.len()),
        }
    }
    assert!(accepted > 100, "{accepted}");
}

/// Before a census is taken.
#[test]
fn more_points_than_memory_are_refused() {
    let variation =
        Variation::new(&paper(), &[vary("anchors.end_m.z=-2.5..-0.5:101")], Combine::Product);
    let settings = ContinuationSettings { max_points: 100, ..ContinuationSettings::default() };
    let watched = |_| panic!("a census was taken");
    let error = Continuation::follow(&variation.unwrap(), 0, &settings, &watched).unwrap_err();
    assert_eq!(error, ContinuationError::TooManyPoints { points: 101, most: 100 });
}

/// A bar, then a row of two between the same anchors, written the other way round: `B-A`.
const ROWS: &str = "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [1, 0, 0] }\nP = { mass_kg = 1 }\n\
    [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 2\nmass_kg = 1\n\
    [[bars]]\nfrom = \"P\"\nto = \"B\"\nlength_m = 3\nmass_kg = 2\n\
    [[bars]]\nfrom = \"B\"\nto = \"A\"\nlength_m = 0.7\nmass_kg = 0.5\ncount = 3\n";

/// Numbers of the bars of a system count as its members do, and a row is called by its ends in their order.
#[test]
fn paths_reach_the_bars_of_a_system() {
    let Ok(Described::System(system)) = model::system_file::parse(ROWS, "rows.toml") else {
        panic!("a system")
    };
    for (path, changed) in [
        ("bars.1.mass_kg", 1..2),
        ("bars.2.mass_kg", 2..3),
        ("bars.5.mass_kg", 5..6),
        ("bars.P-B.mass_kg", 2..3),
        ("bars.B-A.mass_kg", 3..6),
        ("bars.*.mass_kg", 1..6),
    ] {
        let variation =
            Variation::new(system.clone(), &[vary(&format!("{path}=9"))], Combine::Product);
        let varied = variation.unwrap_or_else(|error| panic!("{error}")).system(&[9.0]).unwrap();
        for (k, member) in varied.members().iter().enumerate() {
            let is_nine = (member.body.mass_kg() - 9.0).abs() < 1e-15;
            assert_eq!(is_nine, changed.contains(&(k + 1)), "{path}: member {}", k + 1);
        }
    }
    for path in ["bars.B-P.mass_kg=9", "bars.A-B.mass_kg=9", "bars.6.mass_kg=9"] {
        assert!(Variation::new(system.clone(), &[vary(path)], Combine::Product).is_err(), "{path}");
    }
}

/// Loads of anchors would rest on the ground, and free joints have no place that a file names.
#[test]
fn numbers_that_a_joint_does_not_have_are_refused() {
    let system = System::from(&paper());
    let names: Vec<String> = system.joints().iter().map(|joint| joint.name.to_string()).collect();
    for (joint, key, what) in [
        (0, "mass_kg", "is an anchor"),
        (3, "force_n.y", "is an anchor"),
        (1, "at_m.x", "is free and has no `at_m`"),
        (2, "mass_kg", ""),
        (1, "force_n.z", ""),
        (3, "at_m.y", ""),
    ] {
        let path = vary(&format!("joints.{}.{key}=0.5", names[joint]));
        match Variation::new(system.clone(), &[path], Combine::Product) {
            Ok(_) => assert_eq!(what, "", "{joint} {key}"),
            Err(error) => {
                let said = error.to_string();
                assert!(!what.is_empty() && said.contains(what), "{joint} {key}: {said}");
            }
        }
    }
}

/// The anchors of a chain as a system are its first and its last joint.
#[test]
fn the_anchors_of_a_row_of_joints_move() {
    let system = System::from(&paper());
    for (path, moved) in [("anchors.start_m.y=0.5", 0), ("anchors.end_m.y=0.5", 3)] {
        let variation = Variation::new(system.clone(), &[vary(path)], Combine::Product).unwrap();
        let found = variation.system(&[0.5]).unwrap();
        for (k, joint) in found.joints().iter().enumerate() {
            let is_moved = joint.support.at_m().is_some_and(|at_m| at_m[1] > 0.0);
            assert_eq!(is_moved, k == moved, "{path}: joint {k}");
        }
    }
}

/// The unit of each number, as it stands in its name.
#[test]
fn numbers_have_the_units_of_their_names() {
    let units = "gravity_m_s2 m/s^2, floor_m m, anchors.end_m.y m, bars.2.length_m m, bars.2.centre_m m, \
                 bars.2.length_tolerance_m m, bars.2.mass_kg kg, bars.2.inertia_kg_m2.y kg m^2, \
                 bars.2.stiffness_n N, bars.2.prestress_n N, bars.2.count bars, joints.P.at_m.x m, \
                 joints.P.mass_kg kg, joints.P.force_n.z N, joints.P.share 1, loads 1, lengths 1";
    for row in units.split(", ") {
        let (path, unit) = row.split_once(' ').unwrap();
        let parameter = vary(&format!("{path}=1"));
        assert_eq!(parameter.number.unit(), unit, "{path}");
    }
}

/// What an error is about, to the byte: the wrong sign alone, of however many bytes, or the whole wrong word.
#[test]
fn errors_are_about_a_piece_of_the_text() {
    for (text, piece, what) in [
        ("bars2].mass_kg=1", "]", "this bracket is not opened"),
        ("bars[2]\u{e4}.mass_kg=1", "\u{e4}", "a dot is missing here"),
        ("bars[2.mass_kg=1", "[", "this bracket is not closed"),
        ("bars[2=1", "[", "this bracket is not closed"),
        ("joints.\"A.1.mass_kg=1", "\"", "this quotation mark is not closed"),
        ("joints.A.m\u{e4}ss_kg=1", "m\u{e4}ss_kg", "unknown key"),
        ("gravity_m_s2=1,x,2", "x", "is not a number"),
    ] {
        let error = text.parse::<Parameter>().unwrap_err();
        assert!(error.what.contains(what), "{text}: {}", error.what);
        assert_eq!(&text[error.span.clone()], piece, "{text}: {error}");
    }
}
