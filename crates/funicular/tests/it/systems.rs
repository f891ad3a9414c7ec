//! Systems of bars by name, as users meet them: tables, JSON, CSV, pictures, exit codes.

use std::path::PathBuf;

use crate::run::{column, good, json, ran, refused, says};
use serde_json::Value;

/// A mass of 2 kg on two massless cables of 5 m between anchors 6 m apart: by the triangle 3, 4, 5
/// it hangs 4 m deep, and each cable pulls with 5/4 of 10 N.
const LAMP: &str = "name = \"lamp\"\ngravity_m_s2 = 10\n[joints]\nA = { at_m = [-3, 0, 0] }\n\
    B = { at_m = [3, 0, 0] }\n\"the, lamp\" = { mass_kg = 2 }\n\
    [[bars]]\nfrom = \"A\"\nto = \"the, lamp\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n\
    [[bars]]\nfrom = \"the, lamp\"\nto = \"B\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n";

fn folder(name: &str) -> PathBuf {
    let path = crate::run::folder(name);
    std::fs::write(path.join("lamp.toml"), LAMP).unwrap();
    path
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// A rope of 50 kg that hangs down with 100 kg at its end: the anchor holds 150 kg, and so does the
/// rope there.
#[test]
fn the_largest_tension_is_that_at_the_end_where_it_is_largest() {
    let folder = folder("rope");
    let rope = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 100 } }\n\
                bars = [{ from = \"A\", to = \"P\", length_m = 10, mass_kg = 50, kind = \"cable\" }]\n";
    let chain = "loads = [{ joint = 1, mass_kg = 1e-300 }]\n\
                 anchors = { start_m = [0, 0, 0], end_m = [0, 0, -10.1] }\n\
                 bars = [{ length_m = 10, mass_kg = 50 }, { length_m = 0.2, mass_kg = 100, centre_m = 0.1 }]\n";
    let held_n = 150.0 * 9.806_65;
    std::fs::write(folder.join("rope.toml"), rope).unwrap();
    let text = ran(&folder, &["solve", "rope.toml", "--svg", "rope.svg"]).stdout;
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("Largest tension: 1471 N"), "{text}");
    assert!(text.contains(" 1471 ") && text.contains(" 980.665 "), "{text}");
    assert!(std::fs::read_to_string(folder.join("rope.svg")).unwrap().contains("1471 N"));
    let study = ["study", "rope.toml", "--vary", "joints.P.mass_kg=100", "--csv", "s.csv"];
    ran(&folder, &study);
    let study = std::fs::read_to_string(folder.join("s.csv")).unwrap();
    assert!((column(&study, "tension_n")[0] - held_n).abs() < 1e-9, "{study}");
    // The same where the rope is a bar of a chain.
    std::fs::write(folder.join("chain.toml"), chain.split_once('\n').unwrap().1).unwrap();
    let text = String::from_utf8(ran(&folder, &["solve", "chain.toml"]).stdout).unwrap();
    assert!(text.contains("Largest tension"), "{text}");
}

/// A weight at a joint of a chain takes no command away: two bars of 1 m without mass over 1.2 m.
#[test]
fn a_loaded_chain_is_traced_swept_and_drawn_as_the_chain_that_it_is() {
    let folder = folder("loaded-chain");
    let text = "anchors = { start_m = [0, 0, 0], end_m = [1.2, 0, 0] }\n\
                bars = [{ length_m = 1, mass_kg = 0, count = 2 }]\n\
                loads = [{ joint = 1, mass_kg = 2 }]\n";
    std::fs::write(folder.join("v.toml"), text).unwrap();
    for arguments in [
        &["trace", "v.toml", "--vary", "anchors.end_m.x=1.0..1.4:5", "--csv", "t.csv"][..],
        &["sweep", "v.toml", "--seeds", "50", "--format", "csv", "--out", "sweep"],
        &["basins", "v.toml", "--out", "basins", "--size", "16"],
        &["census", "v.toml"],
        &["solve", "v.toml"],
    ] {
        let output = ran(&folder, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    }
    // Below the anchors or above them, at sqrt(1 - x^2/4): V = -+ 2 g times that.
    let trace = std::fs::read_to_string(folder.join("t.csv")).unwrap();
    let (x, energy) = (column(&trace, "anchors.end_m.x"), column(&trace, "energy_j"));
    for (x, energy) in x.iter().zip(&energy) {
        let height = (1.0 - 0.25 * x * x).sqrt();
        assert!((energy.abs() - 2.0 * 9.80665 * height).abs() < 1e-9, "{x} {energy}");
    }
    assert!(x.len() >= 10, "{trace}");
}

#[test]
fn tables_csv_and_picture_of_a_system() {
    let folder = folder("systems-files");
    let arguments = ["solve", "lamp.toml", "--csv", "j.csv", "--svg", "p.svg"];
    let text = good(&folder, &arguments);
    assert!(text.contains("Largest tension: 12.5 N, in the member from"), "{text}");
    assert!(
        text.contains("Lowest joint: the, lamp, at (0, 0, -4) m.") || text.contains("-4) m."),
        "{text}"
    );
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let joints = read("j.csv");
    assert!(joints.contains("\nlagrange,\"the, lamp\","), "{joints}");
    let picture = read("p.svg");
    let document = roxmltree::Document::parse(&picture).unwrap();
    let said: String = document.descendants().filter_map(|node| node.text()).collect();
    assert!(said.contains("12.5 N") && said.contains("the, lamp"), "{said}");
}

#[test]
fn other_commands_say_that_they_are_for_chains() {
    let folder = folder("systems-others");
    let vary = ["--vary", "anchors.end_m.x=1..2:3"];
    refused(&folder, &["trace", "lamp.toml"], &[(&vary, "chain")]);
    assert_eq!(ran(&folder, &["solve", "-"]).status.code(), Some(2));
}

/// Nobody says how wide the terminal is: tables keep to 80 columns, and long systems to what stands
/// out.
#[test]
fn every_answer_of_the_gallery_fits_eighty_columns() {
    /// The gallery's systems are some metres and some newtons large: 1e-12 of either is no digit.
    const LEFT_BY_ROUNDING: f64 = 1e-12;

    let folder = folder("systems-gallery");
    for exhibit in model::cases::exhibits() {
        let text = good(&folder, &["solve", "--case", exhibit.name, "--csv", "j.csv"]);
        for line in text.lines() {
            assert!(line.chars().count() <= 80, "{}: {line}", exhibit.name);
        }
        says(&text, &["Forces of the ground", "Lowest joint: ", "Largest "]);
        // Neither the tables nor the file have zeros that rounding has left.
        let joints = std::fs::read_to_string(folder.join("j.csv")).unwrap();
        let tables = text.split_once("Largest ").unwrap().0;
        let words = joints.split([',', '\n']).chain(tables.split_whitespace());
        for (word, x) in words.filter_map(|word| Some((word, word.parse::<f64>().ok()?))) {
            assert!(x.abs() > LEFT_BY_ROUNDING || x == 0.0, "{word} in\n{joints}{tables}");
            assert!(x != 0.0 || !word.starts_with('-'), "{word} in\n{joints}{tables}");
        }
    }
    let output = ran(&folder, &["cases"]);
    assert!(String::from_utf8(output.stdout).unwrap().contains("footbridge"));
}

/// A weight on a rod of 5 m, drawn aside on a floor 4 m below the anchor: 3, 4, 5.
#[test]
fn a_floor_pushes_what_lies_on_it() {
    let folder = folder("systems-floor");
    let text = "name = \"drawn aside\"\ngravity_m_s2 = 10\nfloor_m = -4\n[joints]\n\
        A = { at_m = [0, 0, 0] }\nP = { mass_kg = 1, force_n = [3, 0, 0] }\n\
        [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\n";
    std::fs::write(folder.join("floor.toml"), text).unwrap();
    let output = ran(&folder, &["solve", "floor.toml", "--json", "--svg", "floor.svg"]);
    assert_eq!(json(&output)["equilibria"][0]["evidence"]["rung"], "optimal");
    let picture = std::fs::read_to_string(folder.join("floor.svg")).unwrap();
    assert!(picture.contains("class=\"floor\""));
    // On the floor it swings about the vertical of its anchor in the level pull: F/(m R) = 1/s².
    let output = ran(&folder, &["modes", "floor.toml", "--json"]);
    let found = json(&output);
    let modes = found["equilibria"][0]["modes"].as_array().unwrap();
    assert!(modes.len() == 1 && (number(&modes[0]["omega2_s2"]) - 1.0).abs() < 1e-9, "{found}");
    // The census knows no floor, and says so.
    let output = ran(&folder, &["census", "floor.toml"]);
    assert_ne!(output.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&output.stderr).contains("floor"));
}

/// A weight of 1 N on three cables in a plane: with the force densities a, b, a of the family
/// 2 a + b = 1 the outer ones bear 0 to 1/√2 N, the middle one 0 to 1 N, the hanger its weight. (`keys/solve.txt` has
/// these numbers as JSON.)
#[test]
fn what_is_open_of_forces_is_told_bar_by_bar() {
    let folder = tempfile::tempdir().unwrap();
    let side = 2.0_f64.sqrt();
    let bar = |from: &str, to: &str, length: f64| {
        format!(
            "[[bars]]\nfrom = \"{from}\"\nto = \"{to}\"\nlength_m = {length:?}\nmass_kg = 0\nkind = \"cable\"\n"
        )
    };
    let text = "gravity_m_s2 = 1\n[joints]\nA = { at_m = [-1, 0, 0] }\nB = { at_m = [0, 0, 0] }\n\
                C = { at_m = [1, 0, 0] }\nP = {}\nQ = { mass_kg = 1 }\n"
        .to_owned()
        + &bar("A", "P", side)
        + &bar("B", "P", 1.0)
        + &bar("C", "P", side)
        + &bar("P", "Q", 0.5);
    std::fs::write(folder.path().join("fan.toml"), text).unwrap();
    let said = good(&folder, &["solve", "fan.toml"]);
    assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    says(&said, &["may be / N", "0 to 0.707107", "0 to 1 ", "only this"]);
    assert!(!said.contains("slack") && !said.contains("just taut"), "{said}");
}

#[test]
fn members_without_force_are_named() {
    let folder = folder("systems-idle");
    // The lamp hangs 4 m deep: a third cable to it may be longer, and a strut shorter. What weight it has its ends carry.
    let more = |kind: &str, length: f64, mass: f64| {
        let text = LAMP.replace("[joints]\n", "[joints]\nC = { at_m = [0, 0, 0] }\n")
            + &format!(
                "[[bars]]\nfrom = \"C\"\nto = \"the, lamp\"\nlength_m = {length:?}\nmass_kg = {mass:?}\nkind = \"{kind}\"\n"
            );
        std::fs::write(folder.join("more.toml"), text).unwrap();
        let bars =
            json(&ran(&folder, &["solve", "more.toml", "--json"]))["equilibria"][0]["bars"].take();
        let idle = bars.as_array().unwrap().last().unwrap().clone();
        assert!(number(&idle["axial_max_n"]).abs() <= 0.0, "{idle}");
        let output = ran(&folder, &["solve", "more.toml"]);
        String::from_utf8(output.stdout).unwrap()
    };
    for mass in [0.0, 0.3] {
        let said = more("cable", 4.5, mass);
        assert!(said.contains(" slack "), "{said}");
        let said = more("strut", 3.5, mass);
        assert!(said.contains(" loose "), "{said}");
    }
}

/// A spatial net from above and one side has all three axes of the world, from the top two.
#[test]
fn pictures_are_seen_from_where_one_asks() {
    let folder = folder("seen");
    let axes = |more: &[&str]| {
        let arguments = ["solve", "--case", "bridle", "--svg", "net.svg"];
        good(&folder, &[&arguments[..], more].concat());
        let svg = std::fs::read_to_string(folder.join("net.svg")).unwrap();
        svg.matches("class=\"axis\"").count()
    };
    assert_eq!((axes(&[]), axes(&["--view", "top"]), axes(&["--view", "side"])), (3, 2, 2));
    let answer = ran(&folder, &["solve", "--case", "bridle", "--json"]).stdout;
    std::fs::write(folder.join("answer.json"), answer).unwrap();
    let draws: [(&[&str], _, _); 3] = [
        (&["census", "--case", "tripod", "--svg", "c.svg"], "c-1.svg", "class=\"axis\""),
        (
            &["judge", "--case", "bridle", "--answer", "answer.json", "--html", "j.html"],
            "j-1.html",
            "class=\"axis\"",
        ),
        (&["modes", "--case", "bridle", "--svg", "m.svg"], "m.svg", "<line"),
    ];
    for (arguments, file, what) in draws {
        let drawn = |view: &str| {
            good(&folder, &[arguments, &["--view", view]].concat());
            std::fs::read_to_string(folder.join(file)).unwrap()
        };
        let [best, top, side] = ["best", "top", "side"].map(drawn);
        assert!(best != top && top != side, "{arguments:?}");
        if what.contains("axis") {
            assert_eq!(
                [&best, &top].map(|page| page.matches(what).count()),
                [3, 2],
                "{arguments:?}"
            );
        }
    }
    // The shapes of one row side by side; from above each alone.
    let row = ["census", "--case", "two-bars", "--svg", "row.svg"];
    for (more, file) in [(&[][..], "row.svg"), (&["--view", "top"], "row-2.svg")] {
        assert_eq!(ran(&folder, &[&row, more].concat()).status.code(), Some(0));
        assert!(folder.join(file).exists(), "{file}");
    }
    for command in ["solve", "census", "modes"] {
        let output = ran(&folder, &[command, "--case", "bridle", "--view", "top"]);
        assert_eq!(output.status.code(), Some(2), "a view without a picture");
    }
}
