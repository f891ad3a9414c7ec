//! MoorDyn input files.

use formats::system::parse_moordyn;
use model::system::Kind;

use crate::refused;

/// A line heavier than water from an anchor to a fairlead, and a buoyant one to a free float.
const FILE: &str = "\
--------------------- MoorDyn Input File ------------------------------------
two lines, written for a test   # a comment
----------------------- LINE TYPES ------------------------------------------
TypeName   Diam    Mass/m     EA         BA/-zeta    EI         Cd     Ca     CdAx    CaAx
(name)     (m)     (kg/m)     (N)        (N-s/-)     (N-m^2)    (-)    (-)    (-)     (-)
chain      0.2     100        1.0e9      -1.0        0          1.37   1.0    0.64    0.0
rope       0.2     20         1.0e7      -1.0        0          1.37   1.0    0.64    0.0
---------------------- POINT PROPERTIES --------------------------------
ID    Type      X       Y       Z       Mass   Volume  CdA    Ca
(#)   (-)       (m)     (m)     (m)     (kg)   (m^3)   (m^2)  (-)
1     Fixed     0       0.0     -50.0   0      0       0      0
2     Vessel    60      0.0     -10.0   0      0       0      0
3     Free      20      0.0     -20.0   100    1       0      0
---------------------- LINES ----------------------------------------
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (#)      (#)       (m)       (-)     (-)
1     chain      1        2         80        4       p
2     rope       1        3         30        2       -
---------------------- OPTIONS -----------------------------------------
0.001         dtM           time step
1000          WtrDnsty      water density (kg/m^3)
10            g             gravity (m/s^2)
60            WtrDpth       water depth (m)
0             WaveKin       no waves
---------------------- OUTPUTS -----------------------------------------
FairTen1
------------------------- need this line -------------------------------
";

#[test]
fn lines_are_runs_of_elastic_cables_with_their_weight_in_water() {
    let found = parse_moordyn(FILE, "lines.txt").unwrap();
    let system = &found.system;
    assert_eq!(system.name(), "two lines, written for a test");
    let names: Vec<_> = system.joints().iter().map(|joint| joint.name.text()).collect();
    assert_eq!(names, ["1", "2", "3", "line 1.1", "line 1.2", "line 1.3", "line 2.1"]);
    assert_eq!(system.members().len(), 6);
    let displaced_kg_m = 1000.0 * std::f64::consts::PI * 0.01;
    // 31.4 kg/m of water: the chain weighs 68.6 of its 100 kg/m, the rope is lifted by 11.4 of its
    // 20.
    let chain = &system.members()[0];
    assert_eq!((chain.kind, chain.stiffness_n), (Kind::Cable, Some(1e9)));
    assert!((chain.body.mass_kg() - 20.0 * (100.0 - displaced_kg_m)).abs() < 1e-9);
    let rope = &system.members()[4];
    assert!(rope.body.mass_kg() <= 0.0 && rope.loads.len() == 1);
    assert!((rope.loads[0].force_n[2] - 150.0 * (displaced_kg_m - 20.0)).abs() < 1e-9);
    // In the middle of a piece of 15 m.
    assert!((rope.body.length_m() - 15.0).abs() < 1e-12);
    assert!((rope.loads[0].at_m - 7.5).abs() < 1e-12);
    // A float of 100 kg, and of a cubic metre that the water lifts.
    assert!((system.joints()[2].force_n[2] - 10_000.0).abs() < 1e-9);
    assert!((system.joints()[2].mass_kg - 100.0).abs() < 1e-12);
    assert!(
        found.notes.last().unwrap().contains("lack the mass of the line that the water carries")
    );
    assert_eq!(system.joints()[1].support.at_m(), Some([60.0, 0.0, -10.0]));
    assert_eq!(found.floor_m, Some(-60.0));
    assert!(found.notes.iter().any(|note| note.starts_with("line 1: 4 elastic cables of 20 m")));
}

/// What floats in water of no density, as our own files have it, has no inertia from its lift.
#[test]
fn a_negative_mass_is_lift_alone() {
    let text = FILE.replace("-20.0   100    1 ", "-20.0   -90    1 ");
    let read = parse_moordyn(&text, "x").unwrap();
    let float = &read.system.joints()[2];
    assert!(float.mass_kg.abs() <= 0.0 && (float.force_n[2] - 10_900.0).abs() < 1e-9, "{float:?}");
}

/// A vessel that weighs 500 kg more than its water, an anchor of 20 kg.
#[test]
fn loads_on_held_points_are_told_with_their_sum() {
    let text = FILE
        .replace("-10.0   0      0 ", "-10.0   1500      1 ")
        .replace("-50.0   0 ", "-50.0   20");
    let says = "loads on held nodes (2), in sum (0, 0, -5200) N, go to the ground and are not in the reactions";
    for (text, told) in [(FILE, false), (&text, true)] {
        let notes = parse_moordyn(text, "x").unwrap().notes;
        assert_eq!(notes.iter().any(|note| note == says), told, "{notes:?}");
    }
}

#[test]
fn version_one_has_its_columns_in_another_order() {
    let text = FILE
        .replace(
            "ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs",
            "Line LineType UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs",
        )
        .replace("1     chain      1        2         80        4       p", "1 chain 80 4 1 2 p")
        .replace("2     rope       1        3         30        2       -", "2 rope 30 2 1 3 -")
        .replace("LINE TYPES", "LINE DICTIONARY")
        .replace("POINT PROPERTIES", "CONNECTION PROPERTIES");
    assert_eq!(parse_moordyn(&text, "x").unwrap().system, parse_moordyn(FILE, "x").unwrap().system);
}

/// Decks of OpenFAST say how many rows each table has.
#[test]
fn numbers_of_rows_stand_in_front_of_tables() {
    let counted = |types: usize| {
        let after = |line: &str| match line {
            _ if line.contains("LINE TYPES") => format!("\n{types} NTypes - number of types\n"),
            _ if line.contains("POINT PROPERTIES") => "\n3   NConnects - with anchors\n".to_owned(),
            _ => "\n".to_owned(),
        };
        FILE.lines().map(|line| line.to_owned() + &after(line)).collect::<String>()
    };
    let types = |count| parse_moordyn(&counted(count), "x");
    assert_eq!(types(2).unwrap().system, parse_moordyn(FILE, "x").unwrap().system);
    let error = types(3).unwrap_err().to_string();
    assert!(
        error.ends_with("the number in front of the table must be that of its rows, found \"3\""),
        "{error}"
    );
}

#[test]
fn what_is_no_statics_of_lines_or_no_table_is_told_with_its_line() {
    let parse = |text: &str| parse_moordyn(text, "x");
    refused("moordyn", FILE, parse);
    for (text, says) in
        [("", "x: the file is empty"), ("hello\n", "x: there is no section LINE TYPES")]
    {
        assert_eq!(parse(text).unwrap_err().to_string(), says);
    }
}

#[test]
fn points_of_a_fixed_body_are_anchors() {
    let bodies = "---------------------- BODIES ------------------\n\
        ID   Attachment  X0  Y0  Z0  r0  p0  y0  Mass  CG*  I*  Volume  CdA*  Ca*\n(#) (word) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)\n\
        1    Fixed       60  0   0   0   0   0   0     0    0   0       0     0\n";
    let text = FILE
        .replacen(
            "---------------------- POINT",
            &format!("{bodies}---------------------- POINT"),
            1,
        )
        .replacen("2     Vessel    60      0.0     -10.0", "2 Body1 0 0 -10", 1);
    let found = parse_moordyn(&text, "x").unwrap();
    assert_eq!(found.system.joints()[1].support.at_m(), Some([60.0, 0.0, -10.0]));
    let free = text.replacen("1    Fixed ", "1    Free  ", 1);
    let error = parse_moordyn(&free, "x").unwrap_err();
    assert_eq!(
        error.to_string(),
        "x:11: body 1, which is \"free\" and not fixed, is not part of a system of bars at rest"
    );
    let turned = text.replacen("60  0   0   0   0   0", "60  0   0   0   0   5", 1);
    assert_eq!(
        parse_moordyn(&turned, "x").unwrap_err().to_string(),
        "x:11: the yaw of body 1 is not understood"
    );
}
