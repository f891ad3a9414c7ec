//! A number of a system that varies gives the system of the file in which it is edited.

use branches::{Combine, Parameter, ParameterError, PointError, Variation};
use model::Bar;
use model::system::{Member, System};
use model::system_file::{Described, parse};

/// A rope of five bars over a rider at A-R, two more to R-B, a stiff row in line with them, a spring and a bar
/// whose centre, inertia and force are given: every number has another size.
const FILE: &str = r#"
name = "varied"
gravity_m_s2 = 9.5
floor_m = -20
[joints]
A = { at_m = [0, 0.5, 0.25] }
B = { at_m = [4, -0.5, 1] }
S = { at_m = [1, 2, 3], free = "y", mass_kg = 0.75 }
T = { at_m = [1.5, 0.25, -6], free = "xz", mass_kg = 0.375 }
R = { mass_kg = 2, force_n = [0.5, 1.5, -2.5] }
P = { mass_kg = 3, force_n = [0.125, 0, 0] }
[[bars]]
from = "A"
to = "R"
length_m = 1
mass_kg = 0.5
count = 5
centre_m = 0.25
inertia_kg_m2 = [0.125, 0.5, 0.75]
forces = [{ force_n = [0, 0.25, 0.5], at_m = 0.125 }]
[[bars]]
from = "R"
to = "B"
length_m = 1.5
mass_kg = 0.25
count = 2
[[bars]]
from = "R"
to = "P"
length_m = 2
mass_kg = 0.125
stiffness_n = 1000
prestress_n = 16
[[bars]]
from = "P"
to = "S"
length_m = 7
mass_kg = 0.0625
length_tolerance_m = 0.001
forces = [{ force_n = [1, 2, 3] }]
[[bars]]
from = "P"
to = "T"
length_m = 9
mass_kg = 0.03125
"#;

/// Pieces of a text and what comes in their place.
type Edits<'a> = &'a [(&'a str, &'a str)];

fn read(text: &str) -> System {
    match parse(text, "varied.toml") {
        Ok(Described::System(system)) => system,
        other => panic!("{other:?}"),
    }
}

fn variation(vary: &[(&str, f64)]) -> Variation {
    let parameter = |(path, value): &(&str, f64)| -> Parameter {
        format!("{path}={value}").parse().unwrap_or_else(|error| panic!("{error}"))
    };
    let all: Vec<Parameter> = vary.iter().map(parameter).collect();
    Variation::new(read(FILE), &all, Combine::Product).unwrap_or_else(|error| panic!("{error}"))
}

fn varied(vary: &[(&str, f64)]) -> System {
    let values: Vec<f64> = vary.iter().map(|(_, value)| *value).collect();
    variation(vary).system(&values).unwrap_or_else(|error| panic!("{vary:?}: {error}"))
}

/// The file with pieces of its text in the place of others, each of which it has once.
fn edited(edits: Edits<'_>) -> System {
    let mut text = FILE.to_owned();
    for (old, new) in edits {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text = text.replace(old, new);
    }
    read(&text)
}

#[test]
fn every_number_is_that_of_the_file() {
    let tables: [(&str, f64, Edits<'_>); 24] = [
        ("gravity_m_s2", 3.0, &[("9.5", "3")]),
        ("floor_m", -16.0, &[("-20", "-16")]),
        ("joints.A.at_m.x", 0.125, &[("[0, 0.5, 0.25]", "[0.125, 0.5, 0.25]")]),
        ("joints.B.at_m.y", 0.75, &[("[4, -0.5, 1]", "[4, 0.75, 1]")]),
        ("joints.S.at_m.z", 2.0, &[("[1, 2, 3], free", "[1, 2, 2], free")]),
        ("joints.T.at_m.y", -0.5, &[("[1.5, 0.25, -6]", "[1.5, -0.5, -6]")]),
        ("joints.R.mass_kg", 5.0, &[("{ mass_kg = 2,", "{ mass_kg = 5,")]),
        ("joints.T.mass_kg", 5.0, &[("mass_kg = 0.375", "mass_kg = 5")]),
        ("joints.R.force_n.x", 7.0, &[("[0.5, 1.5, -2.5]", "[7, 1.5, -2.5]")]),
        ("joints.R.force_n.y", 7.0, &[("[0.5, 1.5, -2.5]", "[0.5, 7, -2.5]")]),
        ("joints.R.force_n.z", 7.0, &[("[0.5, 1.5, -2.5]", "[0.5, 1.5, 7]")]),
        ("bars.A-R.*.mass_kg", 0.375, &[("mass_kg = 0.5\n", "mass_kg = 0.375\n")]),
        ("bars.1-5.centre_m", 0.75, &[("centre_m = 0.25", "centre_m = 0.75")]),
        ("bars.A-R.*.inertia_kg_m2.y", 0.625, &[("0.125, 0.5, 0.75", "0.125, 0.625, 0.75")]),
        ("bars.R-B.*.length_m", 1.625, &[("length_m = 1.5\n", "length_m = 1.625\n")]),
        ("bars.8.stiffness_n", 500.0, &[("stiffness_n = 1000", "stiffness_n = 500")]),
        ("bars.R-P.prestress_n", 8.0, &[("prestress_n = 16", "prestress_n = 8")]),
        // What bears a prestress has the length that is given under it.
        ("bars.R-P.length_m", 2.5, &[("length_m = 2\n", "length_m = 2.5\n")]),
        ("bars.9.length_tolerance_m", 0.25, &[("tolerance_m = 0.001", "tolerance_m = 0.25")]),
        // A force in the middle stays there, others stay where they are.
        ("bars.P-S.length_m", 6.5, &[("length_m = 7\n", "length_m = 6.5\n")]),
        ("bars.A-R.*.length_m", 1.25, &[("length_m = 1\n", "length_m = 1.25\n")]),
        // Rows keep their length, mass and loads; of the inertia what is across goes with the cube.
        (
            "bars.A-R.count",
            10.0,
            &[(
                "length_m = 1\nmass_kg = 0.5\ncount = 5\ncentre_m = 0.25\ninertia_kg_m2 = [0.125, 0.5, 0.75]\n\
                 forces = [{ force_n = [0, 0.25, 0.5], at_m = 0.125 }]",
                "length_m = 0.5\nmass_kg = 0.25\ncount = 10\ncentre_m = 0.125\n\
                 inertia_kg_m2 = [0.0625, 0.0625, 0.09375]\n\
                 forces = [{ force_n = [0, 0.125, 0.25], at_m = 0.0625 }]",
            )],
        ),
        (
            "bars.7.count",
            1.0,
            &[("length_m = 1.5\nmass_kg = 0.25\ncount = 2", "length_m = 3\nmass_kg = 0.5")],
        ),
        (
            "bars.P-S.count",
            2.0,
            &[(
                "length_m = 7\nmass_kg = 0.0625\nlength_tolerance_m = 0.001\nforces = [{ force_n = [1, 2, 3] }]",
                "length_m = 3.5\nmass_kg = 0.03125\nlength_tolerance_m = 0.0005\ncount = 2\n\
                 forces = [{ force_n = [0.5, 1, 1.5] }]",
            )],
        ),
    ];
    for (path, value, edits) in tables {
        let (found, wanted) = (varied(&[(path, value)]), edited(edits));
        assert_eq!(found.members(), wanted.members(), "{path}");
        // Joints of a new count come last where there was none; by name they are those of the file.
        assert_eq!(found.joints().len(), wanted.joints().len(), "{path}");
        for joint in wanted.joints() {
            let same = found.joint(&joint.name.text()).map(|k| &found.joints()[k]);
            assert_eq!(same, Some(joint), "{path}");
        }
        let of = |system: &System| (system.gravity_m_s2().to_bits(), system.floor_m());
        assert_eq!(of(&found), of(&wanted), "{path}");
    }
}

/// Masses and forces of joints and members alike, whatever else is set, in whatever order.
#[test]
fn loads_are_a_factor_of_all_loads() {
    let wanted = edited(&[
        ("mass_kg = 0.75", "mass_kg = 1.5"),
        ("mass_kg = 0.375", "mass_kg = 0.75"),
        ("{ mass_kg = 2, force_n = [0.5, 1.5, -2.5] }", "{ mass_kg = 9, force_n = [1, 3, -5] }"),
        ("{ mass_kg = 3, force_n = [0.125, 0, 0] }", "{ mass_kg = 6, force_n = [0.25, 0, 0] }"),
        ("mass_kg = 0.5\n", "mass_kg = 1\n"),
        ("[0, 0.25, 0.5], at_m", "[0, 0.5, 1], at_m"),
        ("length_m = 1.5\nmass_kg = 0.25", "length_m = 1.5\nmass_kg = 0.5"),
        ("length_m = 2\nmass_kg = 0.125", "length_m = 2\nmass_kg = 0.25"),
        ("mass_kg = 0.0625", "mass_kg = 0.125"),
        ("[1, 2, 3] }", "[2, 4, 6] }"),
        ("mass_kg = 0.03125", "mass_kg = 11"),
    ]);
    let vary = [("joints.R.mass_kg", 9.0), ("loads", 2.0), ("bars.10.mass_kg", 11.0)];
    let found = varied(&vary);
    assert_eq!(found.joints(), wanted.joints());
    for (found, wanted) in found.members().iter().zip(wanted.members()) {
        // Given moments of inertia are no load.
        assert!((found.body.mass_kg() - wanted.body.mass_kg()).abs() < 1e-15);
        assert_eq!(found.loads, wanted.loads);
    }
}

/// Lengths, and with them given centres and the places of loads; what is in the middle by default stays there where one
/// member has another length besides.
#[test]
fn lengths_are_a_factor_of_all_lengths() {
    let base = read(FILE);
    let found = varied(&[("lengths", 1.25), ("bars.9.length_m", 8.0)]);
    assert_eq!(found.joints(), base.joints());
    for (k, (found, base)) in found.members().iter().zip(base.members()).enumerate() {
        let [found, base] = [found, base].map(|member| member.clone().as_given());
        let (own, other) = (&found.body, &base.body);
        let length_m = if k == 8 { 8.0 } else { 1.25 * other.length_m() };
        assert!((own.length_m() - length_m).abs() < 1e-14, "{k}: {}", own.length_m());
        assert!((own.mass_kg() - other.mass_kg()).abs() < 1e-15, "{k}");
        assert_eq!(own.given_centre_m().is_some(), other.given_centre_m().is_some(), "{k}");
        let centre_m = other.given_centre_m().map_or(0.5 * length_m, |centre_m| 1.25 * centre_m);
        assert!((own.centre_m() - centre_m).abs() < 1e-14, "{k}");
        // What lies off the axis stays as far from it.
        let [moments, others] = [own.given_inertia_kg_m2(), other.given_inertia_kg_m2()];
        assert_eq!(moments, others.map(|[x, y, z]| [x, 1.5625 * y, 1.5625 * z]), "{k}");
        assert_eq!(
            (found.prestress_n(), found.stiffness_n),
            (base.prestress_n(), base.stiffness_n)
        );
        for (load, other) in found.loads.iter().zip(&base.loads) {
            let middle = (other.at_m - 0.5 * base.body.length_m()).abs() < 1e-15;
            let at_m = if middle { 0.5 * length_m } else { 1.25 * other.at_m };
            assert!((load.at_m - at_m).abs() < 1e-14, "{k}");
            let forces = [load.force_n, other.force_n].map(|force| force.map(f64::to_bits));
            assert_eq!(forces[0], forces[1], "{k}");
        }
    }
}

/// A rider's share: the lengths on both sides have the sum they had, and go with masses and loads.
#[test]
fn a_share_moves_length_from_one_row_to_the_other() {
    let wanted = edited(&[
        (
            "length_m = 1\nmass_kg = 0.5\ncount = 5\ncentre_m = 0.25\ninertia_kg_m2 = [0.125, 0.5, 0.75]\n\
             forces = [{ force_n = [0, 0.25, 0.5], at_m = 0.125 }]",
            "length_m = 0.5\nmass_kg = 0.25\ncount = 5\ncentre_m = 0.125\n\
             inertia_kg_m2 = [0.0625, 0.0625, 0.09375]\n\
             forces = [{ force_n = [0, 0.125, 0.25], at_m = 0.0625 }]",
        ),
        (
            "length_m = 2\nmass_kg = 0.125\nstiffness_n = 1000\nprestress_n = 16\n",
            "length_m = 2\nmass_kg = 0.125\n",
        ),
    ]);
    let text = FILE.replace("stiffness_n = 1000\nprestress_n = 16\n", "");
    // Without the third bar at R two rows meet there.
    let two = |text: &str| text.replace("from = \"R\"\nto = \"P\"", "from = \"A\"\nto = \"P\"");
    let vary: Parameter = "joints.R.share=0.3125".parse().unwrap();
    let base = read(&two(&text));
    let varied = Variation::new(base.clone(), &[vary], Combine::Product).unwrap();
    let found = varied.system(&[0.3125]).unwrap();
    // 2.5 m of 8 m on the first side.
    assert_eq!(found.members()[..5], wanted.members()[..5]);
    for (k, member) in found.members()[5..7].iter().enumerate() {
        let scale = 5.5 / 3.0;
        assert!((member.body.length_m() - 1.5 * scale).abs() < 1e-15, "{k}");
        assert!((member.body.mass_kg() - 0.25 * scale).abs() < 1e-15, "{k}");
    }
    assert_eq!(found.members()[7..], base.members()[7..]);
    let error = |path: &str| -> String {
        let vary: Parameter = path.parse().unwrap();
        Variation::new(read(FILE), &[vary], Combine::Product).unwrap_err().what
    };
    // Three rows, one row, and a joint within a row.
    for joint in ["R", "S", "\"A-R.2\""] {
        let what = error(&format!("joints.{joint}.share=0.5"));
        assert!(what.contains("not where two rows of bars meet"), "{joint}: {what}");
    }
}

#[test]
fn counts_are_of_whole_rows_of_equal_bars() {
    let refused = |vary: &[(&str, f64)]| {
        let values: Vec<f64> = vary.iter().map(|(_, value)| *value).collect();
        variation(vary).system(&values).unwrap_err()
    };
    let unequal = refused(&[("bars.3.mass_kg", 2.0), ("bars.A-R.count", 3.0)]);
    assert_eq!(unequal, PointError::Unequal { first: 1, last: 5 });
    let PointError::Count { value, most } = refused(&[("bars.7.count", 4e9)]) else { panic!() };
    assert!((value - 4e9).abs() < 1e-6);
    // All bars that a file may have less the eight others.
    assert_eq!(most + 8, model::system_file::most_bars());
    let of = |path: &str| -> Result<Variation, String> {
        let vary: Parameter = path.parse().unwrap();
        Variation::new(read(FILE), &[vary], Combine::Product).map_err(|error| error.what)
    };
    for path in ["bars.4-6.count=2", "bars.*.count=2", "bars.5-7.count=2"] {
        assert_eq!(of(path).unwrap_err(), "these bars are of several rows", "{path}");
    }
    for path in ["bars.1-5.count=2", "bars.2-4.count=2", "bars.6-7.count=2", "bars.10.count=2"] {
        assert!(of(path).is_ok(), "{path}");
    }
}

/// Where a third member meets a row it is two rows.
#[test]
fn a_row_ends_where_another_member_meets_it() {
    let base = read(FILE);
    let [from, to] = ["A-R.2", "T"].map(|name| base.joint(name).unwrap());
    let mut members = base.members().to_vec();
    members.push(Member::bar(from, to, Bar::homogeneous(9.0, 1.0).unwrap()));
    let base = System::new("met", 10.0, base.joints().to_vec(), members).unwrap();
    let of = |path: &str| {
        let vary: Parameter = path.parse().unwrap();
        Variation::new(base.clone(), &[vary], Combine::Product).map_err(|error| error.what)
    };
    assert_eq!(of("bars.1-5.count=2").unwrap_err(), "these bars are of several rows");
    assert!(of("bars.1-2.count=3").is_ok() && of("bars.3-5.count=2").is_ok());
}

/// A rope over a ring behind a row runs over the same ring when the row has other joints; it is no row itself.
#[test]
fn counts_leave_ropes_on_their_rings() {
    let text = |count: usize| {
        format!(
            "joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [4, 0, 0] }}, P = {{ mass_kg = 2 }} }}\n\
             bars = [{{ from = \"A\", to = \"P\", length_m = {}, mass_kg = 0, count = {count} }}, \
             {{ from = \"A\", to = \"B\", via = [\"P\"], length_m = 6, kind = \"cable\" }}]",
            3.0 / count as f64
        )
    };
    let of = |path: &str, value: f64| {
        let vary: Parameter = path.parse().unwrap();
        Variation::new(read(&text(1)), &[vary], Combine::Product).unwrap().system(&[value])
    };
    for count in [1, 2, 4] {
        assert_eq!(of(&format!("bars.1.count={count}"), count as f64).unwrap(), read(&text(count)));
    }
    assert_eq!(of("bars.2.count=1", 1.0).unwrap(), read(&text(1)));
    let refused = of("bars.2.count=2", 2.0).unwrap_err();
    assert_eq!(refused, PointError::Count { value: 2.0, most: 1 });
}

/// The rows of a chain are its runs of equal bars, each with its own first and last.
#[test]
fn a_count_of_a_chain_is_that_of_its_file() {
    let file = |rows: &str| {
        let anchors = "anchors = { start_m = [0, 0, 0], end_m = [3, 0, -1] }";
        samples::parsed(&format!("{anchors}\nbars = [{rows}]")).into_chain()
    };
    let [one, two, three] = [
        "{ length_m = 1, mass_kg = 0.5, centre_m = 0.25, count = 2 }",
        "{ length_m = 0.5, mass_kg = 2, count = 4 }",
        "{ length_m = 0.75, mass_kg = 1 }",
    ];
    let base = file(&[one, two, three].join(", "));
    let of = |texts: &[&str]| {
        let vary: Vec<Parameter> = texts.iter().map(|text| text.parse().unwrap()).collect();
        let variation = Variation::new(&base, &vary, Combine::Product)?;
        let values = variation.paths()[0][0].clone();
        Ok::<_, ParameterError>(variation.problem(&values))
    };
    let other = ["{ length_m = 0.5, mass_kg = 0.25, centre_m = 0.125, count = 4 }", two, three];
    for path in ["bars.1.count=4", "bars.1-2.count=4"] {
        assert_eq!(of(&[path]).unwrap().unwrap().chain(), &file(&other.join(", ")), "{path}");
    }
    let other = [one, "{ length_m = 1, mass_kg = 4, count = 2 }", three];
    for path in ["bars.4.count=2", "bars.3-6.count=2"] {
        assert_eq!(of(&[path]).unwrap().unwrap().chain(), &file(&other.join(", ")), "{path}");
    }
    let unequal = of(&["bars.5.mass_kg=1", "bars.3.count=2"]).unwrap().unwrap_err();
    assert_eq!(unequal, PointError::Unequal { first: 3, last: 6 });
    for path in ["bars.2-3.count=2", "bars.6-7.count=1"] {
        assert_eq!(of(&[path]).unwrap_err().what, "these bars are of several rows", "{path}");
    }
}

/// The anchors of a chain between two of them have their keys; those of another system are joints.
#[test]
fn anchors_are_those_of_a_chain() {
    let of = |system: &System, path: &str| {
        let vary: Parameter = path.parse().unwrap();
        Variation::new(system.clone(), &[vary], Combine::Product).map_err(|error| error.what)
    };
    let refused = of(&read(FILE), "anchors.end_m.x=1").unwrap_err();
    assert_eq!(refused, "the system is not a chain between two anchors");
    let chain = System::from(model::cases::paper().chain());
    assert!(of(&chain, "anchors.end_m.x=1").is_ok());
}
