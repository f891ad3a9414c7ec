//! `funicular modes` and `funicular simulate`.

use std::path::Path;

use crate::run::{column, files, funicular, good, holding, refused, words};
use serde_json::Value;

fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn json(arguments: &[&str]) -> Value {
    crate::run::json(&funicular(arguments))
}

#[test]
fn simulate_writes_columns_and_an_animation_and_the_same_bytes_again() {
    let folder = tempfile::tempdir().unwrap();
    let name = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    let run = |csv: &str, html: &str| {
        let what = ["simulate", "--case", "three-equal-bars", "--from", "angles=0,60,-60"];
        let how = ["--time", "2", "--push", "1=0.1,0,0", "--out", csv, "--html", html];
        good(&folder, &[&what[..], &how].concat());
    };
    run("a.csv", "a.html");
    run("b.csv", "b.html");
    let read = |file: &str| std::fs::read_to_string(name(file)).unwrap();
    assert_eq!(read("a.csv"), read("b.csv"));
    assert_eq!(read("a.html"), read("b.html"));
    let csv = read("a.csv");
    let mut lines = csv.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(head[..5], ["time_s", "kinetic_j", "potential_j", "energy_j", "joint0_x_m"]);
    let column = |name: &str| head.iter().position(|h| *h == name).unwrap();
    let rows: Vec<Vec<f64>> =
        lines.map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 1001);
    for row in &rows {
        // Bar 2 keeps its length, and the energy its value.
        let d = ["x", "y", "z"].map(|axis| {
            row[column(&format!("joint2_{axis}_m"))] - row[column(&format!("joint1_{axis}_m"))]
        });
        assert!((d.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((row[column("energy_j")] - rows[0][column("energy_j")]).abs() < 1e-4);
    }
    assert!(column("bar3_axial_n") < column("joint3_fz_n"));
    let html = read("a.html");
    assert!(html.contains("<canvas") && !html.contains("http"), "the page needs nothing else");
    // The four equilibria with their modes beside the answer, and the two circles of them, each with its
    // distance at every time that is shown.
    let data = html.split("application/json\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    let shapes = data["shapes"].as_array().unwrap();
    assert!(shapes.len() == 5 && shapes[1]["modes"].is_array() && shapes[0]["axial"].is_array());
    let motion = &data["tracks"][0];
    let near = motion["charts"][1]["curves"].as_array().unwrap();
    let labels = near.iter().map(|curve| curve["label"].as_str().unwrap());
    assert_eq!(labels.collect::<Vec<_>>(), ["from equilibrium 1 / m", "from equilibrium 2 / m"]);
    let times = motion["at"].as_array().unwrap();
    assert_eq!((&times[0], times.last().unwrap()), (&0.into(), &2.into()));
    assert!(near.iter().all(|curve| curve["y"].as_array().unwrap().len() == times.len()));
    // Places, as in the columns, to a tenth of a pixel.
    let unit = motion["unit"].as_f64().unwrap();
    for (k, time) in times.iter().enumerate() {
        let time = time.as_f64().unwrap();
        let row = rows.iter().find(|row| (row[0] - time).abs() < 1e-9).unwrap();
        for (i, axis) in ["x", "y", "z"].iter().enumerate() {
            let x = motion["x"][k][6 + i].as_f64().unwrap() * unit;
            assert!((x - row[column(&format!("joint2_{axis}_m"))]).abs() < 1e-3, "{time} {axis}");
        }
    }
    let parquet = name("a.parquet");
    let arguments = ["simulate", "--case", "two-bars", "--from", "seed:3", "--out", &parquet];
    assert_eq!(funicular(&arguments).status.code(), Some(0));
    assert!(std::fs::read(&parquet).unwrap().starts_with(b"PAR1"));
}

/// The attribute of each element of a kind.
fn attributes(text: &str, element: &str, attribute: &str) -> Vec<String> {
    let tree = roxmltree::Document::parse(text).unwrap();
    let all = tree.descendants().filter(|node| node.has_tag_name(element));
    all.map(|node| node.attribute(attribute).unwrap().to_owned()).collect()
}

#[test]
fn a_motion_for_paraview_is_that_of_the_columns() {
    let folder = tempfile::tempdir().unwrap();
    let name = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    let run = |out: &str| {
        let run = ["simulate", "--case", "lamp", "--push", "lamp=0.3,0.2,0", "--time", "0.5"];
        funicular(&[&run[..], &["--step", "0.01", "--store", "0.1", "--out", &name(out)]].concat())
    };
    let output = run("motion.pvd");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(run("motion.csv").status.code(), Some(0));
    let text = std::fs::read_to_string(name("motion.csv")).unwrap();
    let columns = text;
    let number = |text: &str| -> f64 { text.parse().unwrap() };
    let text = std::fs::read_to_string(name("motion.pvd")).unwrap();
    let times = attributes(&text, "DataSet", "timestep");
    let files = attributes(&text, "DataSet", "file");
    assert_eq!((times.len(), columns.lines().count()), (6, 7));
    for (row, (time, file)) in times.iter().zip(&files).enumerate() {
        let text = std::fs::read_to_string(name(file)).unwrap();
        let tree = roxmltree::Document::parse(&text).unwrap();
        let array = |name: &str| -> Vec<f64> {
            let is = |node: &roxmltree::Node<'_, '_>| node.attribute("Name") == Some(name);
            let node = tree.descendants().find(is).unwrap();
            node.text().unwrap().split_whitespace().map(number).collect()
        };
        let is = |found: f64, column_name: &str| {
            let told = column(&columns, column_name)[row];
            assert!((found - told).abs() <= 1e-12 * told.abs(), "{column_name}: {found} {told}");
        };
        is(number(time), "time_s");
        is(array("TimeValue")[0], "time_s");
        is(array("energy_j")[0], "energy_j");
        is(array("kinetic_j")[0], "kinetic_j");
        is(array("axial_n")[1], "bar2_axial_n");
        // The lamp is the third joint.
        is(array("joints_m")[7], "joint_lamp_y_m");
        is(array("velocity_m_s")[6], "joint_lamp_vx_m_s");
    }
    // What is there stays, and nothing is left beside it.
    let output = run("motion.pvd");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("is not empty"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
    assert_eq!(std::fs::read_dir(name("motion")).unwrap().count(), 6);
}

/// Of a cable without mass the part of its strength is known as it moves; the force in a heavy bar varies along it.
#[test]
fn strength_as_it_moves_is_that_of_members_without_mass() {
    let folder = tempfile::tempdir().unwrap();
    let name = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    let text = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2 }, Q = { mass_kg = 1 } }\nbars = [\
                { from = \"A\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"cable\", strength_n = 80 }, \
                { from = \"P\", to = \"Q\", length_m = 1, mass_kg = 3, strength_n = 80 }]";
    std::fs::write(name("two.toml"), text).unwrap();
    let (system, out) = (name("two.toml"), name("two.pvd"));
    let run = ["simulate", &system, "--push", "Q=0.3,0,0", "--time", "0.1", "--out", &out];
    assert_eq!(funicular(&run).status.code(), Some(0));
    let text = std::fs::read_to_string(name("two/000005.vtu")).unwrap();
    let tree = roxmltree::Document::parse(&text).unwrap();
    let array = |name: &str| -> Vec<f64> {
        let is = |node: &roxmltree::Node<'_, '_>| node.attribute("Name") == Some(name);
        let text = tree.descendants().find(is).unwrap().text().unwrap();
        text.split_whitespace().map(|number| number.parse().unwrap()).collect()
    };
    let (used, axial_n) = (array("utilisation"), array("axial_n"));
    assert!(axial_n[0] > 50.0 && used[1].is_nan(), "{axial_n:?} {used:?}");
    assert!((used[0] - axial_n[0] / 80.0).abs() < 1e-12, "{axial_n:?} {used:?}");
}

#[test]
fn simulate_refuses_what_it_cannot_do_and_says_why() {
    for (arguments, told) in [
        (vec!["--from", "equilibrium:9"], "there is no equilibrium \"9\"; there are 1, 1', 2, 2'"),
        (vec!["--from", "angles=0,0,0"], "bar 3 ends 0.333 of the total length off joint \"3\""),
        (vec!["--from", "angles=0,0"], "2 angles are given for 3 bars"),
        (vec!["--from", "nowhere"], "equilibrium:2"),
        (vec!["--push", "P=0,0,1"], "there is no joint \"P\""),
        (vec!["--push", "1=0,0"], "JOINT=X,Y,Z"),
        (vec!["--push", "0=0,0,1"], "is an anchor: a push does not move it"),
        (vec!["--time", "-1"], "must be positive"),
        (vec!["--time", "0"], "must be positive"),
        (vec!["--damping=-1"], "zero or positive"),
        (vec!["--out", "motion.txt"], ".csv, .parquet or .pvd"),
        (vec!["--from", "angles=0,60,-60", "--step", "50", "--time", "1000"], "shorter step"),
    ] {
        let mut all = vec!["simulate", "--case", "three-equal-bars"];
        all.extend(arguments);
        let output = funicular(&all);
        let said = words(&output);
        assert!(matches!(output.status.code(), Some(2 | 3)), "{all:?} {said}");
        assert!(said.contains(told), "{all:?}: {said}");
    }
}

#[test]
fn the_lowest_modes_of_a_long_chain_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    let text = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
                bars = [{ length_m = 0.001, mass_kg = 0.001, count = 2000 }]\n";
    let path = file(folder.path(), "long.toml", text);
    let found = json(&["modes", &path, "--json", "--modes", "6"]);
    let equilibrium = &found["equilibria"][0];
    let modes = equilibrium["modes"].as_array().unwrap();
    // 1999 joints in two directions, less 2000 lengths kept in the plane.
    assert_eq!((modes.len(), &equilibrium["modes_in_all"]), (6, &Value::from(1999 + 1998)));
    let omega2: Vec<f64> = modes.iter().map(|m| m["omega2_s2"].as_f64().unwrap()).collect();
    assert!(omega2[0] > 0.0 && omega2.windows(2).all(|pair| pair[0] <= pair[1]), "{omega2:?}");
    assert_eq!(equilibrium["index_by_modes"], 0);
    // The first is the swing about the line of the anchors.
    assert!(modes[0]["what"].as_str().unwrap().contains("across the plane"));
    for mode in modes {
        let (omega2, residual) = (&mode["omega2_s2"], &mode["residual_s2"]);
        assert!(residual.as_f64().unwrap() < 1e-6 * omega2.as_f64().unwrap(), "{mode}");
    }
    let text = String::from_utf8(funicular(&["modes", &path]).stdout).unwrap();
    assert!(text.contains("3997 modes") && text.contains("the lowest 20"), "{text}");
}

#[test]
fn released_positions_come_to_rest_and_the_folder_does_not_depend_on_threads_or_shards() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let run = |out: &str, more: &[&str]| {
        let mut arguments = vec!["simulate", "--case", "three-equal-bars", "--seeds", "1100"];
        arguments.extend(["--damping", "3", "--step", "0.02", "--time", "25", "--out", out]);
        arguments.extend(more);
        funicular(&arguments)
    };
    let one = run(&at("one"), &["--threads", "1", "--json"]);
    let told = crate::run::json(&one);
    let rows = told["solvers"]["motion"].as_array().unwrap();
    let count = |outcome: i64| {
        let row = rows.iter().find(|row| row["outcome"] == outcome);
        row.map_or(0, |row| row["count"].as_u64().unwrap())
    };
    // All end on the circle of the stable equilibrium, none at the unstable one.
    assert_eq!((count(0), rows.len()), (1100, 1), "{rows:?}");
    // Two parts, as two shards, joined; and the second after an interruption.
    assert_eq!(run(&at("first"), &["--shard", "1/2"]).status.code(), Some(0));
    assert_eq!(run(&at("second"), &["--shard", "2/2"]).status.code(), Some(0));
    std::fs::remove_file(folder.path().join("second/summary.json")).unwrap();
    std::fs::remove_file(folder.path().join("second/part-000001.parquet")).unwrap();
    assert_eq!(run(&at("second"), &["--shard", "2/2"]).status.code(), Some(2));
    assert_eq!(run(&at("second"), &["--shard", "2/2", "--resume"]).status.code(), Some(0));
    let text = good(".", &["merge", &at("first"), &at("second"), "--out", &at("both")]);
    assert!(text.contains("released seeds") && text.contains("time / s"), "{text}");
    let [one, both] = ["one", "both"].map(|name| files(&folder.path().join(name)));
    assert_eq!(one, both);
    // Where nothing takes energy away nothing comes to rest.
    let free = ["simulate", "--case", "two-bars", "--seeds", "5", "--out", &at("free")];
    refused(".", &free, &[(&[], "without damping")]);
}

/// A weight on a level line, pushed harder and harder: with 3 N more each second its speed is
/// 3/2 t² m/s for a mass of 1 kg, and its way 1/2 t³; after the last time it keeps its speed.
#[test]
fn forces_of_a_table_drive_a_weight() {
    let slider = "joints = { A = { at_m = [0, 0, 0], free = \"x\", mass_kg = 1 }, P = { mass_kg = 1e-9 } }\n\
                  bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0 }]\n";
    let forces = |rows: &str| format!("time_s,joint,x_n,y_n,z_n\n{rows}\n");
    let folder = holding([("slider.toml", slider), ("f.csv", &forces("0,A,0,0,0\n2,A,6,0,0"))]);
    let simulate = ["simulate", "slider.toml", "--forces", "f.csv", "--out", "m.csv"];
    let times = ["--time", "3", "--store", "1", "--order", "4"];
    let simulate = [&simulate[..], &times].concat();
    good(&folder, &simulate);
    let csv = std::fs::read_to_string(folder.path().join("m.csv")).unwrap();
    for (row, place, speed) in [(1, 0.5, 1.5), (2, 4.0, 6.0), (3, 10.0, 6.0)] {
        assert!((column(&csv, "joint_A_x_m")[row] - place).abs() < 1e-2, "{csv}");
        assert!((column(&csv, "joint_A_vx_m_s")[row] - speed).abs() < 1e-2, "{csv}");
    }
    for (rows, told) in [
        ("0,A,0,0,0\n0,A,6,0,0", "f.csv:3: time_s must be later than"),
        ("0,B,0,0,0", "there is no joint \"B\""),
    ] {
        file(folder.path(), "f.csv", &forces(rows));
        refused(&folder, &simulate, &[(&[], told)]);
    }
}

/// The lamp on two cables, thrown up: it falls as a free body until both are taut, and hangs again.
#[test]
fn a_lamp_on_cables_is_thrown_up_and_caught() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lamp.csv");
    let out = path.to_str().unwrap();
    let html = folder.path().join("lamp.html");
    let arguments =
        ["simulate", "--case", "lamp", "--push", "lamp=0,0,10", "--time", "3", "--out", out];
    let output = funicular(&[&arguments[..], &["--html", html.to_str().unwrap()]].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(html.exists());
    let text = String::from_utf8(output.stdout).unwrap();
    let csv = std::fs::read_to_string(&path).unwrap();
    let [lost, kinetic, energy] =
        ["lost_j", "kinetic_j", "energy_j"].map(|name| column(&csv, name));
    // All that it was given is lost when it is caught.
    let last = lost.len() - 1;
    assert!(
        lost[0].abs() <= 0.0 && kinetic[0] > 1.0 && (lost[last] / kinetic[0] - 1.0).abs() < 1e-9
    );
    assert!(kinetic[last] < 1e-12, "{}", kinetic[last]);
    assert!(energy.iter().zip(&lost).all(|(e, l)| (e + l - energy[0]).abs() < 1e-9));
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("J lost in impacts"), "{text}");
    // The cables are at right angles and stop it together: what is left of its motion is rounding, of either sign.
    for speed in 7..13 {
        let push = format!("lamp=0,0,{speed}");
        let arguments =
            ["simulate", "--case", "lamp", "--push", &push, "--time", "3", "--out", out];
        assert_eq!(funicular(&arguments).status.code(), Some(0), "{speed}");
    }
}

#[test]
fn a_lamp_on_cables_let_go_anywhere_comes_to_hang_as_the_solvers_say() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("ends");
    let release =
        ["simulate", "--case", "lamp", "--seeds", "100", "--damping", "2", "--time", "30"];
    let more = ["--step", "5e-3", "--json", "--out", out.to_str().unwrap()];
    let output = funicular(&[&release[..], &more[..]].concat());
    let told = crate::run::json(&output);
    let rows = told["solvers"]["motion"].as_array().unwrap();
    assert_eq!((rows.len(), &rows[0]["outcome"], &rows[0]["count"]), (1, &0.into(), &100.into()));
}

#[test]
fn what_cannot_be_moved_is_refused_before_it_is_released() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("ends");
    // Joints of threads without mass.
    let release = ["simulate", "--case", "mobile", "--seeds", "10", "--damping", "1", "--out"];
    let says = "give it a mass_kg, or a mass to a member that ends there";
    refused(".", &release, &[(&[out.to_str().unwrap()], says)]);
    assert!(!out.exists());
}

/// The numbers of a column of a CSV file without quotes.
const PENDULUM: &str = "name = \"pendulum\"\njoints = { O = { at_m = [0, 0, 0] }, P = {} }\n\
                        bars = [{ from = \"O\", to = \"P\", length_m = 1.5, mass_kg = 2 }]\n";

/// A rod let go level falls with 3/2 g at its end, and comes to rest hanging.
#[test]
fn a_pendulum_is_let_go_at_an_angle_and_comes_to_rest() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let path = file(folder.path(), "pendulum.toml", PENDULUM);
    let from =
        ["simulate", &path, "--from", "angles=90", "--out", &at("p.csv"), "--html", &at("p.html")];
    good(".", &[&from[..], &["--time", "40", "--damping", "1"]].concat());
    let csv = std::fs::read_to_string(at("p.csv")).unwrap();
    let (y, z) = (column(&csv, "joint_P_y_m"), column(&csv, "joint_P_z_m"));
    assert!((y[0] - 1.5).abs() < 1e-12 && z[0].abs() < 1e-12, "{} {}", y[0], z[0]);
    // The anchor carries a quarter of the weight at first, and all of it at the end.
    let up = column(&csv, "joint_O_fz_n");
    let weight = 2.0 * 9.80665;
    assert!((up[0] - 0.25 * weight).abs() < 1e-9 && (up[up.len() - 1] - weight).abs() < 1e-4);
    let page = std::fs::read_to_string(at("p.html")).unwrap();
    assert!(page.contains("It comes to rest in equilibrium 1."), "{page}");
    assert!(page.contains("\"names\":[\"O\",\"P\"]") && page.contains("\"axial\":[["));
    // The colours of the pictures.
    assert!(page.contains("#0072b2") && page.contains("#d55e00") && !page.contains("@BLUE@"));
    good(".", &[&from[..], &["--time", "0.5"]].concat());
    let page = std::fs::read_to_string(at("p.html")).unwrap();
    assert!(page.contains("At the end, after 0.5 s, it still moves, "), "{page}");
}

/// In a plane the angles are those of the plane, towards x or else y.
#[test]
fn angles_lie_in_the_plane_of_the_system() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("p.csv");
    for (plane, along, across) in [("xz", "x", "y"), ("yz", "y", "x")] {
        let text = format!("plane = \"{plane}\"\n{PENDULUM}");
        let path = file(folder.path(), "pendulum.toml", &text);
        let from = ["simulate", &path, "--from", "angles=30", "--time", "0.01", "--out"];
        good(".", &[&from[..], &[out.to_str().unwrap()]].concat());
        let csv = std::fs::read_to_string(&out).unwrap();
        let first = |axis: &str| column(&csv, &format!("joint_P_{axis}_m"))[0];
        assert!((first(along) - 0.75).abs() < 1e-12 && first(across).abs() < 1e-12, "{plane}");
    }
}

/// Places to three digits are pulled onto the lengths; places that are far off are refused.
#[test]
fn a_motion_begins_at_the_places_of_a_file() {
    let folder = holding([("pendulum.toml", PENDULUM)]);
    let at = |z: &str| {
        let shape = format!("joint,x_m,y_m,z_m\nO,0,0,0\nP,1.06,0,{z}\n");
        file(folder.path(), "shape.csv", &shape);
    };
    let from = ["simulate", "pendulum.toml", "--time", "0.1", "--out", "p.csv", "--from"];
    at("-1.06");
    good(&folder, &[&from[..], &["shape.csv"]].concat());
    let csv = std::fs::read_to_string(folder.path().join("p.csv")).unwrap();
    let (x, z) = (column(&csv, "joint_P_x_m")[0], column(&csv, "joint_P_z_m")[0]);
    let level = 1.5 / 2.0_f64.sqrt();
    assert!((x - level).abs() < 1e-12 && (z + level).abs() < 1e-12, "{x} {z}");
    at("-0.5");
    let far = "joint \"P\" would have to move by 0.2";
    let nowhere = "or a file with the places of the joints";
    refused(&folder, &from, &[(&["shape.csv"], far), (&["shape"], nowhere)]);
}

/// A weight of 10 g between two steel cables of 5 MN: steps of a millisecond are 15 times what is
/// stable, and led to 4.5e305 J.
#[test]
fn steps_too_long_for_stiff_members_are_taken_in_parts_or_refused_with_one_that_works() {
    let folder = tempfile::tempdir().unwrap();
    let run = |stiffness: &str, step: &str| {
        let bar = |from: &str, to: &str| {
            format!(
                "{{ from = \"{from}\", to = \"{to}\", length_m = 1.1, mass_kg = 0, stiffness_n = {stiffness} }}"
            )
        };
        let text = format!(
            "joints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{ mass_kg = 0.01 }}, B = {{ at_m = [2, 0, 0] }} }}\n\
             bars = [{}, {}]\n",
            bar("A", "P"),
            bar("P", "B")
        );
        let path = file(folder.path(), "steel.toml", &text);
        let out = folder.path().join("steel.csv");
        let run = ["simulate", &path, "--push", "P=0.01,0,0.01", "--step", step, "--time", "1"];
        let output = funicular(&[&run[..], &["--out", out.to_str().unwrap()]].concat());
        let said = String::from_utf8_lossy(&output.stderr).replace("\n  ", " ");
        (output.status.code(), String::from_utf8(output.stdout).unwrap(), said, out)
    };
    let (code, text, said, out) = run("5e6", "1e-3");
    assert_eq!(code, Some(0), "{said}");
    assert!(text.contains("each step in 31 parts for the elastic members"), "{text}");
    let energy = column(&std::fs::read_to_string(out).unwrap(), "energy_j");
    // The push gives p²/2m = 0.01 J.
    assert!(energy.iter().all(|e| (e - energy[0]).abs() < 0.005), "{text}");
    let (code, _, said, _) = run("5e16", "1e-3");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("allow 3.317e-10 s: take steps of at most 3.317e-6 s"), "{said}");
}
