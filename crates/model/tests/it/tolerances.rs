//! Tolerances in system files: read, refused, and written back.

use model::system::{Uncertain, UncertainNumber};
use model::system_file::{Described, write_network};

use crate::support::{Folder, refused_at, system};

fn chain(root: &str, first: &str, second: &str) -> String {
    format!(
        "{root}\nanchors = {{ start_m = [0, 0, 0], end_m = [2, 0, 0] }}\n\
         bars = [{{ length_m = 1, mass_kg = 1, count = 2{first} }}, {{ length_m = 2, mass_kg = 3{second} }}]"
    )
}

fn net(root: &str, joint: &str, first: &str) -> String {
    format!(
        "{root}\njoints = {{ A = {{ at_m = [1, 0, 0] }}, P = {{ mass_kg = 5, force_n = [0, 7, 0]{joint} }} }}\n\
         bars = [{{ from = \"A\", to = \"P\", length_m = 2, mass_kg = 1, stiffness_n = 400{first} }}]"
    )
}

fn uncertain(number: UncertainNumber, given: f64, within: f64) -> Uncertain {
    Uncertain { number, given, within }
}

#[test]
fn every_number_has_its_own_or_that_of_all() {
    use UncertainNumber::{At, Force, JointMass, Length, Mass, Stiffness};
    let all = "tolerances = { length_tolerance_m = 0.1, stiffness_tolerance = 0.25, mass_tolerance_kg = 0.5, \
               at_tolerance_m = 0.01, force_tolerance_n = 2 }";
    let at = |joint: usize, x: f64| {
        [0, 1, 2].map(|axis| uncertain(At(joint, axis), if axis == 0 { x } else { 0.0 }, 0.01))
    };
    let mut wanted = vec![
        uncertain(Length(0), 2.0, 0.2),
        uncertain(Stiffness(0), 400.0, 100.0),
        uncertain(Mass(0), 1.0, 0.5),
    ];
    wanted.extend(at(0, 1.0));
    wanted.push(uncertain(JointMass(1), 5.0, 1.5));
    wanted.extend([0, 1, 2].map(|k| uncertain(Force(1, k), if k == 1 { 7.0 } else { 0.0 }, 2.0)));
    let text = net(all, ", mass_tolerance_kg = 1.5", ", length_tolerance_m = 0.2");
    assert_eq!(system(&text).uncertain(), wanted);
    // Of a chain: rows of bars, and anchors. Nothing of it stretches or is pulled.
    let mut wanted = vec![];
    for (bar, (length_m, mass_kg)) in [(1.0, 1.0), (1.0, 1.0), (2.0, 3.0)].into_iter().enumerate() {
        let within_m = if bar < 2 { 0.2 } else { 0.1 };
        wanted.extend([
            uncertain(Length(bar), length_m, within_m),
            uncertain(Mass(bar), mass_kg, 0.5),
        ]);
    }
    wanted.extend(at(0, 0.0).into_iter().chain(at(3, 2.0)));
    assert_eq!(system(&chain(all, ", length_tolerance_m = 0.2", "")).uncertain(), wanted);
    assert!(system(&net("", "", "")).uncertain().is_empty());
}

#[test]
fn what_is_written_reads_back() {
    for text in [
        chain("tolerances = { at_tolerance_m = 0.01 }", ", length_tolerance_m = 1e-3", ""),
        net(
            "tolerances = { stiffness_tolerance = 0.1, force_tolerance_n = 0.2 }",
            ", mass_tolerance_kg = 1",
            "",
        ),
        net("", ", force_tolerance_n = 3", ", length_tolerance_m = 1e-3, mass_tolerance_kg = 0.5"),
    ] {
        let read = system(&text);
        assert!(!read.uncertain().is_empty());
        assert_eq!(system(&write_network(&read)), read);
    }
}

#[test]
fn rows_of_a_file_have_them_too() {
    let folder = Folder::new("tolerances");
    let root = "tolerances = { mass_tolerance_kg = 0.5 }\nbars_file = \"bars.csv\"\njoints_file = \"joints.csv\"";
    let path = folder.file("net.toml", root);
    let write = |joint: &str, bar: &str| {
        let joints =
            "name,x_m,y_m,z_m,mass_kg,mass_tolerance_kg,at_tolerance_m,force_tolerance_n\n";
        let bars = "from,to,length_m,mass_kg,stiffness_n,length_tolerance_m,stiffness_tolerance,mass_tolerance_kg\n";
        folder.file("joints.csv", format!("{joints}A,0,0,0,,,1e-3,\n{joint}\n"));
        folder.file("bars.csv", format!("{bars}{bar}\n"));
        model::system_file::read(&path)
    };
    let Ok(Described::System(system)) = write("P,,,,4,,,3", "A,P,2,1,400,0.2,0.25,0.125") else {
        panic!()
    };
    let within: Vec<f64> = system.uncertain().iter().map(|number| number.within).collect();
    assert_eq!(within, [0.2, 100.0, 0.125, 1e-3, 1e-3, 1e-3, 0.5, 3.0, 3.0, 3.0]);
    for (joint, bar, column) in [
        ("P,,,,4,5,,", "A,P,2,1,400,,,", "mass_tolerance_kg"),
        ("P,,,,4,,1,", "A,P,2,1,400,,,", "at_tolerance_m"),
        ("P,,,,4,,,-1", "A,P,2,1,400,,,", "force_tolerance_n"),
        ("P,,,,4,,,", "A,P,2,1,400,,1,", "stiffness_tolerance"),
        ("P,,,,4,,,", "A,P,2,1,,,0.1,", "stiffness_tolerance"),
        ("P,,,,4,,,", "A,P,2,1,,3,,", "length"),
    ] {
        let error = write(joint, bar).unwrap_err().to_string();
        assert!(error.contains(column), "{error}");
    }
}

#[test]
fn what_is_no_tolerance_is_refused_where_it_stands() {
    let root = |text: &str| net(text, "", "");
    let joint = |text: &str| net("", &format!(", {text}"), "");
    let bar = |text: &str| net("", "", &format!(", {text}"));
    for (text, key, words) in [
        (bar("stiffness_tolerance = 0"), "bars[1].stiffness_tolerance", "less than 1"),
        (bar("stiffness_tolerance = 1"), "bars[1].stiffness_tolerance", "less than 1"),
        (bar("stiffness_tolerance = nan"), "bars[1].stiffness_tolerance", "less than 1"),
        (bar("mass_tolerance_kg = 1.5"), "bars[1].mass_tolerance_kg", "not more than"),
        (bar("mass_tolerance_kg = -1"), "bars[1].mass_tolerance_kg", "positive"),
        (bar("length_tolerance_m = 2"), "bars[1].length_tolerance_m", "less than the length"),
        (bar("length_tolerence_m = 1"), "bars[1].length_tolerence_m", "length_tolerance_m"),
        (joint("mass_tolerance_kg = 6"), "joints.P.mass_tolerance_kg", "not more than"),
        (joint("force_tolerance_n = inf"), "joints.P.force_tolerance_n", "positive"),
        (joint("force_tolerance_n = 'much'"), "joints.P.force_tolerance_n", "number"),
        (joint("at_tolerance_m = 1"), "joints.P.at_tolerance_m", "with at_m"),
        (root("tolerances = 1"), "tolerances", "table"),
        (root("tolerances = { at_m = 1 }"), "tolerances.at_m", "at_tolerance_m"),
        (root("tolerances = { at_tolerance_m = 0 }"), "tolerances.at_tolerance_m", "positive"),
        (chain("", ", mass_tolerance_kg = 2", ""), "bars[1].mass_tolerance_kg", "not more than"),
        (
            chain("", "", ", stiffness_tolerance = 0.1"),
            "bars[2].stiffness_tolerance",
            "allowed here",
        ),
        (
            chain("tolerances = { length_tolerance_m = nan }", "", ""),
            "tolerances.length_tolerance_m",
            "positive",
        ),
    ] {
        refused_at(&text, key, words);
    }
}

/// A system at other values: each number that is uncertain, and nothing else.
#[test]
fn other_values_are_put_where_they_belong() {
    let all = "tolerances = { length_tolerance_m = 0.1, stiffness_tolerance = 0.25, mass_tolerance_kg = 0.5, \
               at_tolerance_m = 0.01, force_tolerance_n = 2 }";
    let varied = system(&net(all, "", ""))
        .with_uncertain(&[2.1, 500.0, 1.5, 1.01, 0.0, -0.01, 4.5, 0.5, 8.0, -1.0]);
    let wanted = "joints = { A = { at_m = [1.01, 0, -0.01] }, P = { mass_kg = 4.5, force_n = [0.5, 8, -1] } }\n\
                  bars = [{ from = 'A', to = 'P', length_m = 2.1, mass_kg = 1.5, stiffness_n = 500 }]";
    assert_eq!(varied.unwrap(), system(wanted));
    // A length that no bar has.
    let off = system(&net("", "", ", length_tolerance_m = 0.1")).with_uncertain(&[-1.0]);
    assert!(off.is_err());
}
