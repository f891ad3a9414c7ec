//! Answers as JSON, CSV and VTU.

use formats::FormatError;
use formats::answer::{Answer, Forces, Joints, parse, parse_member_forces};

fn one(text: &str) -> Answer {
    let answers = parse(text, "file").unwrap();
    assert_eq!(answers.len(), 1);
    answers.into_iter().next().unwrap()
}

fn wrong(text: &str) -> String {
    parse(text, "file").unwrap_err().to_string()
}

fn named(places: &[(&str, [f64; 3])]) -> Joints {
    Joints::Named(places.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect())
}

#[test]
fn csv_has_its_columns_in_any_order_and_names_in_quotes() {
    let found = one("z_m, joint ,x_m,y_m\r\n-4,\"the, \"\"lamp\"\"\",0,1e-3\r\n\r\n");
    assert_eq!(found.joints, named(&[("the, \"lamp\"", [0.0, 1e-3, -4.0])]));
    assert_eq!((found.source.as_str(), found.forces), ("file", Forces::None));
}

#[test]
fn csv_of_two_solvers_is_two_answers() {
    let text = "solver,joint,x_m,y_m,z_m,reaction_x_n,reaction_y_n,reaction_z_n\n\
                lagrange,A,0,0,0,1,2,3\nenergy,A,0,0,1,1,2,4\n";
    let answers = parse(text, "file").unwrap();
    let sources: Vec<_> = answers.iter().map(|answer| answer.source.as_str()).collect();
    assert_eq!(sources, ["lagrange", "energy"]);
    assert_eq!(answers[1].reactions_n, Some(vec![("A".to_owned(), [1.0, 2.0, 4.0])]));
}

#[test]
fn the_csv_of_a_chain_has_forces_from_its_second_joint_on() {
    let text = "solver,joint,x_m,y_m,z_m,force_x_n,force_y_n,force_z_n,axial_n\n\
                energy,0,0,0,0,0,0,5,\nenergy,1,0,0,-1,0,0,5,7.5\n";
    assert_eq!(one(text).forces, Forces::InOrder(vec![7.5]));
}

#[test]
fn bad_csv_is_told_with_its_line() {
    for (text, says) in [
        ("", "file: the file is empty"),
        (" \n\n", "file: the file is empty"),
        ("joint,x_m,y_m\nP,0,0\n", "file:1: there is no column `z_m`"),
        ("joint,x_m,y_m,z\nP,0,0,0\n", "file:1: the column \"z\" is not understood"),
        ("joint,x_m,x_m,z_m\n", "file:1: the column \"x_m\" is there twice"),
        ("joint,x_m,y_m,z_m\n", "file: there is no joint"),
        ("joint,x_m,y_m,z_m\nP,0,0\n", "file:2: 4 values are needed here, found 3"),
        ("joint,x_m,y_m,z_m\nP,0,0,0,0\n", "file:2: 4 values are needed here, found 5"),
        (
            "joint,x_m,y_m,z_m\nA,0,0,0\nP,0,0,nan\n",
            "file:3: z_m must be a finite number, found \"nan\"",
        ),
        (
            "joint,x_m,y_m,z_m\nP,0,1e999,0\n",
            "file:2: y_m must be a finite number, found \"1e999\"",
        ),
        ("joint,x_m,y_m,z_m\nP,0,,0\n", "file:2: y_m must be a finite number, found \"\""),
        ("joint,x_m,y_m,z_m\n,0,0,0\n", "file:2: there is no name of the joint"),
        ("joint,x_m,y_m,z_m\n\"P,0,0,0\n", "file:2: there is no end of a quoted cell"),
    ] {
        assert_eq!(wrong(text), says);
    }
    let error = parse("joint,x,y_m,z_m\nP,0,0,0\n", "file").unwrap_err();
    assert!(error.help.unwrap().starts_with("did you mean `x_m`?"));
}

#[test]
fn member_forces_are_lists_by_solver() {
    let lists = parse_member_forces("from,to,axial_n\nA,P,1\nP,B,2\n", "file").unwrap();
    let force = |a: &str, b: &str, n| (a.to_owned(), b.to_owned(), n);
    assert_eq!(lists, [(None, vec![force("A", "P", 1.0), force("P", "B", 2.0)])]);
    // As `solve --bars-csv` writes them, in any order of the lines.
    let text = "solver,bar,from,to,axial_n,utilisation,via\n,2,A,P,2,0.5,\n,1,A,P,1,,Q R\n";
    let lists = parse_member_forces(text, "file").unwrap();
    assert_eq!(lists, [(None, vec![force("A", "P", 1.0), force("A", "P", 2.0)])]);
    let missing = parse_member_forces("from,axial_n\nA,1\n", "file").unwrap_err();
    assert_eq!(missing.to_string(), "file:1: there is no column `to`");
}

#[test]
fn json_of_systems_and_of_chains() {
    let system = r#"{"equilibria": [{"solver": "energy", "energy_j": -1,
        "joints": [{"name": "A", "at_m": [0, 0, 0]}, {"name": "P", "at_m": [0, 0, -1]}],
        "bars": [{"from": "A", "to": "P", "axial_n": 2.5}], "reactions_n": {"A": [0, 0, 2.5]}}]}"#;
    let found = one(system);
    assert_eq!(found.source, "energy");
    assert_eq!(found.joints, named(&[("A", [0.0; 3]), ("P", [0.0, 0.0, -1.0])]));
    assert_eq!(found.forces, Forces::Named(vec![("A".to_owned(), "P".to_owned(), 2.5)]));
    assert_eq!(found.reactions_n, Some(vec![("A".to_owned(), [0.0, 0.0, 2.5])]));
    let chain = r#"{"equilibria": [{"solver": "lagrange", "joints_m": [[0,0,0],[1,0,0],[2,0,0]],
        "axial_n": [1, 2], "reactions_n": {"start": [1, 0, 0], "end": [2, 0, 0]}}]}"#;
    let found = one(chain);
    assert_eq!(found.joints, Joints::InOrder(vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]));
    assert_eq!(found.forces, Forces::InOrder(vec![1.0, 2.0]));
    let ends = found.reactions_n.unwrap();
    assert_eq!((ends[0].0.as_str(), ends[1].0.as_str()), ("2", "0"));
}

#[test]
fn bad_json_is_told() {
    for (text, says) in [
        ("{", "file:1: this is not JSON: EOF while parsing an object at line 1 column 1"),
        ("[1]", "file: the text must be a JSON object, found \"[1]\""),
        ("{\"equilibria\": []}", "file: there is no equilibrium"),
        ("{\"equilibria\": 1}", "file: equilibria must be a list, found \"1\""),
        ("{\"joints\": [{\"at_m\": [0,0,0]}]}", "file: there is no text `name` in joints[0]"),
        (
            "{\"joints\": [{\"name\": \"A\", \"at_m\": [0,0]}]}",
            "file: joints[0].at_m must be a vector [x, y, z], found \"[0,0]\"",
        ),
        (
            "{\"joints_m\": [[0, 0, null]]}",
            "file: joints_m must be a finite number, found \"null\"",
        ),
    ] {
        assert_eq!(wrong(text), says);
    }
    let summary = parse("{\"equilibria\": [{\"solver\": \"energy\"}]}", "file").unwrap_err();
    assert_eq!(summary.to_string(), "file: there is no list `joints` or `joints_m`");
    assert!(summary.help.is_some());
}

/// Two lines between three points, the second grid as a line of many.
fn vtu(points: &str, cells: &str, data: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"3\" NumberOfCells=\"2\">\n\
         <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{points}</DataArray></Points>\n\
         <Cells>{cells}</Cells>\n{data}</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"
    )
}

fn cells(connectivity: &str, offsets: &str, types: &str) -> String {
    [("connectivity", connectivity), ("offsets", offsets), ("types", types)]
        .map(|(name, values)| {
            format!(
                "<DataArray type=\"Int64\" Name=\"{name}\" format=\"ascii\">{values}</DataArray>\n"
            )
        })
        .concat()
}

#[test]
fn a_grid_is_points_and_lines() {
    const POINTS: &str = "-3 0 0  3 0 0  0 0 -4";
    let forces =
        "<CellData><DataArray Name=\"axial_n\" format=\"ascii\">1.25 1.5</DataArray></CellData>";
    let found = one(&vtu(POINTS, &cells("0 2 2 1", "2 4", "3 3"), forces));
    let places = vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
    assert_eq!(found.joints, Joints::InOrder(places));
    assert_eq!(found.forces, Forces::Numbered(vec![(0, 2, Some(1.25)), (2, 1, Some(1.5))]));
    // In the order of the members, where the lines have their numbers.
    let numbers =
        forces.replace("<CellData>", "<CellData><DataArray Name=\"member\">2 1</DataArray>");
    let turned = one(&vtu(POINTS, &cells("0 2 2 1", "2 4", "3 3"), &numbers));
    assert_eq!(turned.forces, Forces::Numbered(vec![(2, 1, Some(1.5)), (0, 2, Some(1.25))]));
    let polyline = one(&vtu(POINTS, &cells("0 2 1", "3", "4"), ""));
    assert_eq!(polyline.forces, Forces::Numbered(vec![(0, 2, None), (2, 1, None)]));
}

#[test]
fn bad_grids_are_told() {
    const POINTS: &str = "-3 0 0  3 0 0  0 0 -4";
    let lines = cells("0 2 2 1", "2 4", "3 3");
    for (text, says) in [
        (vtu("0 0", &lines, ""), "file:5: 3 values are needed here, found 2"),
        (vtu("0 0 nan", &lines, ""), "file:5: DataArray must be a finite number, found \"nan\""),
        (
            vtu(POINTS, &cells("0 1 2", "3", "5"), ""),
            "file:4: cell of VTK's type 5 is not part of a system of bars at rest",
        ),
        (vtu(POINTS, &cells("0 2", "4", "3"), ""), "file:4: 4 values are needed here, found 2"),
        (
            vtu(POINTS, &cells("0 2.5", "2", "3"), ""),
            "file:6: connectivity must be a whole number, found \"2.5\"",
        ),
        (
            "<VTKFile type=\"PolyData\"/>".to_owned(),
            "file:1: there is no VTKFile of type UnstructuredGrid",
        ),
    ] {
        assert_eq!(wrong(&text), says);
    }
    assert!(wrong("<VTKFile>").contains("this is not XML"));
    let binary = vtu(POINTS, &lines, "").replacen("format=\"ascii\"", "format=\"binary\"", 1);
    let error: FormatError = parse(&binary, "file").unwrap_err();
    assert_eq!(error.to_string(), "file:5: DataArray of format \"binary\" is not understood");
    // Entities that grow without end are refused before they grow.
    let bomb = "<!DOCTYPE a [<!ENTITY b \"bbbb\">]><VTKFile>&b;</VTKFile>";
    assert!(wrong(bomb).contains("this is not XML"));
}
