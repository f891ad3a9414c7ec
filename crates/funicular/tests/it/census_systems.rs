//! `funicular census` of systems of joints and members: JSON, tables, drawings, columns, refusals.

use serde_json::Value;

use crate::census::{ROUNDING, funicular, json};
use crate::run::{folder, says, stdout, words};

/// A chain of two bars of 5 m without mass over 6 m, with a lamp of 2 N at its joint and one of 1 N
/// on a bar of 1 m below: by name, both stable and not.
const LAMPS: &str = r#"
gravity_m_s2 = 10.0
[joints]
A = { at_m = [-3, 0, 0] }
B = { at_m = [3, 0, 0] }
P = { mass_kg = 0.2 }
lamp = { mass_kg = 0.1 }
[[bars]]
from = "A"
to = "P"
length_m = 5
mass_kg = 0
[[bars]]
from = "P"
to = "B"
length_m = 5
mass_kg = 0
[[bars]]
from = "P"
to = "lamp"
length_m = 1
mass_kg = 0
"#;

#[test]
fn a_net_has_its_list() {
    let path = folder("held").join("net.toml");
    let bar = "[[bars]]\nfrom = \"lamp\"\nto = \"A\"\nlength_m = 5.5\nmass_kg = 1\n";
    std::fs::write(&path, format!("{LAMPS}{bar}")).unwrap();
    let value = json(&[path.to_str().unwrap()], 0);
    let net = &value["census"]["parts"][0]["net"];
    assert_eq!((&net["closures"], &net["knots"]), (&2.into(), &serde_json::json!(["P"])));
    assert_eq!((&net["undecided_boxes"], &value["census"]["complete"]), (&0.into(), &true.into()));
    assert_eq!(net["swings"], serde_json::json!(["lamp"]));
    let stable = |e: &&Value| e["stability"]["in_space"] == "stable";
    assert!(value["equilibria"].as_array().unwrap().iter().any(|e| stable(&e)));
    let text = stdout(&funicular(&[path.to_str().unwrap()]));
    let says = "The net of 2 closures: all places of P; lamp by closed forms";
    assert!(text.contains(says) && text.lines().all(|line| line.chars().count() <= 80), "{text}");
}

#[test]
fn systems_without_a_census_are_told_why() {
    let path = folder("net").join("net.toml");
    let bars = ["A", "B"].map(|anchor| {
        format!(
            "[[bars]]\nfrom = \"lamp\"\nto = \"{anchor}\"\nlength_m = 1\nmass_kg = 1\ncount = 7\n"
        )
    });
    let text = LAMPS.to_owned() + &bars.concat();
    std::fs::write(&path, text).unwrap();
    let output = funicular(&[path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    let told = words(&output);
    assert!(told.contains("3 closures") && told.contains("independent ways"), "{told}");
}

#[test]
fn positions_of_a_system_are_drawn_and_written() {
    let out = folder("tripod");
    let [svg, csv] = ["shapes.svg", "shapes.csv"].map(|name| out.join(name));
    let [svg_path, csv_path] = [&svg, &csv].map(|path| path.to_str().unwrap());
    let output = funicular(&["--case", "tripod", "--svg", svg_path, "--csv", csv_path]);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    // Legs of 3 m on a circle of 1.8 m: the load is 2.4 m below or above it.
    let table = std::fs::read_to_string(&csv).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(
        rows[0].join(","),
        "equilibrium,energy_j,index_in_space,joint,x_m,y_m,z_m,reaction_x_n,reaction_y_n,reaction_z_n,rung,box_width"
    );
    assert_eq!(rows.len(), 1 + 2 * 4);
    for (row, sign) in [(4, -1.0), (8, 1.0)] {
        let number = |column: usize| rows[row][column].parse::<f64>().unwrap();
        assert_eq!((rows[row][3], rows[row][2]), ("top", "0"));
        assert!((number(6) - sign * 2.4).abs() < 1e-9, "{:?}", rows[row]);
        let energy = 30.0 * 9.80665 * sign * 2.4;
        assert!((number(1) - energy).abs() < 1e-9 * energy.abs(), "{:?}", rows[row]);
    }
    // Each leg bears a third of the weight.
    assert!((rows[1][9].parse::<f64>().unwrap() - 10.0 * 9.80665).abs() < 1e-9);
    for name in ["shapes-1.svg", "shapes-2.svg"] {
        let text = std::fs::read_to_string(out.join(name)).unwrap();
        roxmltree::Document::parse(&text).unwrap();
    }
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 3);
}

/// A ring on a rope with a weight over a pulley at its end, and a slack cable: of what pulls alone one equilibrium is
/// all. Beside a strut it is listed in the plane of the anchors.
#[test]
fn of_cables_and_ropes_one_equilibrium_is_all() {
    let path = folder("tackle").join("tackle.toml");
    // Two strands of 3-4-5 hold 40 N at P, each with 25 N, as the weight of 2.5 kg at Q does.
    let tackle = "gravity_m_s2 = 10\n\
                  joints = { A = { at_m = [-3, 0, 0] }, D = { at_m = [3, 0, 0] }, P = { mass_kg = 4 }, \
                  Q = { mass_kg = 2.5 }, E = { at_m = [3, 0, 1] } }\n\
                  bars = [{ from = 'A', to = 'Q', via = ['P', 'D'], length_m = 12, mass_kg = 0, kind = 'cable' },\n\
                  { from = 'E', to = 'Q', length_m = 5, mass_kg = 0, kind = 'cable' }]";
    std::fs::write(&path, tackle).unwrap();
    let found = json(&[path.to_str().unwrap()], 0);
    let only = &found["equilibria"][0];
    assert_eq!(
        (&found["census"]["complete"], &found["census"]["count"]),
        (&true.into(), &1.into())
    );
    for (bar, wanted) in [(0, 25.0), (1, 0.0)] {
        let axial_n = only["bars"][bar]["axial_n"].as_f64().unwrap();
        assert!((axial_n - wanted).abs() < ROUNDING * 25.0, "{axial_n}");
    }
    // Beside a strut both joints move in too many ways in space.
    let slack = "length_m = 5, mass_kg = 0, kind = 'cable'";
    let strut = tackle.replace(slack, "length_m = 1.5, mass_kg = 0, kind = 'strut'");
    std::fs::write(&path, strut).unwrap();
    let plane = funicular(&[path.to_str().unwrap()]);
    assert_eq!(plane.status.code(), Some(3), "{}", words(&plane));
    let text = stdout(&plane);
    says(
        &text,
        &["NOT proved to be all", "no others were looked for", "With member 2 slack the net"],
    );
}

/// A bar of 3 m and 20 N, whose end a counterweight of 12 N draws to a pulley, as `a_bar_over_a_pulley_with_its_counterweight_is_scanned` has it.
#[test]
fn a_bar_over_a_pulley_has_its_list() {
    let path = folder("counterweight").join("counterweight.toml");
    let bar = "gravity_m_s2 = 10\n\
               joints = { A = { at_m = [0, 0, 0] }, Q = { mass_kg = 2 }, D = { at_m = [1.6, 1.2, 4] }, \
               E = { mass_kg = 1.2 } }\n\
               bars = [{ from = 'A', to = 'Q', length_m = 3, mass_kg = 0 },\n\
               { from = 'E', to = 'Q', via = ['D'], length_m = LENGTH, mass_kg = 0, kind = 'cable' }]";
    std::fs::write(&path, bar.replace("LENGTH", "9")).unwrap();
    let path = path.to_str().unwrap();
    let found = json(&[path], 0);
    assert_eq!(found["census"]["complete"], true);
    for e in found["equilibria"].as_array().unwrap() {
        assert!((e["bars"][1]["axial_n"].as_f64().unwrap() - 12.0).abs() < ROUNDING * 12.0);
    }
    let text = stdout(&funicular(&[path]));
    assert!(text.contains("The net of 0 closures: all places of Q"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    // Short ropes draw the counterweight up to the pulley, which is told.
    std::fs::write(path, bar.replace("LENGTH", "5")).unwrap();
    let open = funicular(&[path]);
    assert_eq!(open.status.code(), Some(3), "{}", words(&open));
    assert!(stdout(&open).contains("to the end of a span"), "{}", stdout(&open));
}
