//! What is typed first: files of other programs, pictures in other formats, new files.

use std::process::Output;

use crate::run::{folder, good, json, ran, refused};

fn said(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A line of 12 m and 100 N/m in water between two fixed points 6 m apart, high above the bottom.
const LINE: &str = "---- MoorDyn Input File ----\na hanging line\n---- LINE TYPES ----\n\
    TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx\n(-) (m) (kg/m) (N) (-) (-) (-) (-) (-) (-)\n\
    rope 0.001 10.1971621 1e9 -1 0 1 1 0 0\n---- POINTS ----\nID Type X Y Z Mass Volume CdA Ca\n\
    (-) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)\n1 Fixed 0 0 -10 0 0 0 0\n2 Fixed 6 0 -10 0 0 0 0\n\
    ---- LINES ----\nID LineType AttachA AttachB UnstrLen NumSegs LineOutputs\n(-) (-) (-) (-) (m) (-) (-)\n\
    1 rope 1 2 12 40 -\n---- OPTIONS ----\n0.001 dtM\n1000 rhoW\n9.80665 g\n200 WtrDpth\n\
    ---- need this line ----\n";

/// Each end bears half of the weight in water; every command that solves reads the file.
#[test]
fn a_moordyn_file_is_solved() {
    let folder = folder("moordyn");
    std::fs::write(folder.join("line.txt"), LINE).unwrap();
    let output = ran(&folder, &["solve", "line.txt", "--json"]);
    let json = json(&output);
    assert_eq!(json["agreement"]["verdict"], "agreed");
    let reactions = json["equilibria"][0]["reactions_n"].as_object().unwrap();
    // Less the water that a rope of 1 mm displaces.
    let area_m2 = 0.25 * std::f64::consts::PI * 1e-6;
    let weight_n = 12.0 * 9.80665 * (10.197_162_1 - 1000.0 * area_m2);
    let up: Vec<f64> = reactions.values().map(|force| force[2].as_f64().unwrap()).collect();
    assert_eq!(up.len(), 2);
    assert!(up.iter().all(|up| (up - 0.5 * weight_n).abs() < 1e-6 * weight_n), "{up:?} {weight_n}");
    let vary = ["study", "line.txt", "--vary", "gravity_m_s2=1.62,9.80665"];
    assert_eq!(ran(&folder, &vary).status.code(), Some(0));
    // A system file may have that ending.
    let new = ran(&folder, &["new"]).stdout;
    std::fs::write(folder.join("system.txt"), new).unwrap();
    assert_eq!(ran(&folder, &["solve", "system.txt"]).status.code(), Some(0));
}

#[test]
fn what_is_no_system_is_named() {
    let folder = folder("named");
    std::fs::write(folder.join("bars.csv"), "length_m,mass_kg\n1,1\n").unwrap();
    let output = ran(&folder, &["solve", "bars.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("is a table") && said(&output).contains("bars_file"));
    let says = "written as .svg, .png, .pdf, .dxf";
    refused(&folder, &["solve", "--case", "lamp"], &[(&["--svg", "shape.jpg"], says)]);
    assert!(!folder.join("shape.jpg").exists());
}

const PNG: &[u8] = b"\x89PNG";

/// Every picture can be drawn in pixels, and the ending says in what else.
#[test]
fn a_picture_is_written_as_its_name_ends() {
    let folder = folder("pictures");
    let solve = &["solve", "--case", "lamp", "--svg"][..];
    for (name, arguments, head) in [
        ("solve.svg", solve, &b"<svg"[..]),
        ("solve.PDF", solve, b"%PDF-"),
        ("solve.dxf", solve, b"0\nSECTION"),
        ("solve.png", solve, PNG),
        ("picture.png", &["solve", "--case", "lamp", "--picture"], PNG),
        ("census.png", &["census", "--case", "two-bars", "--svg"], PNG),
        ("each.png", &["census", "--case", "lamp", "--svg"], PNG),
        ("modes.png", &["modes", "--case", "lamp", "--svg"], PNG),
        ("study.png", &["study", "--case", "lamp", "--vary", "loads=1,2", "--svg"], PNG),
        ("trace.png", &["trace", "--case", "lamp", "--vary", "loads=1..2", "--svg"], PNG),
    ] {
        good(&folder, &[arguments, &[name]].concat());
        assert!(std::fs::read(folder.join(name)).unwrap().starts_with(head), "{name}");
    }
    let basins = ["basins", "--case", "two-bars", "--size", "4", "--out", ".", "--format", "png"];
    good(&folder, &basins);
    assert!(std::fs::read(folder.join("energy-iterations.png")).unwrap().starts_with(PNG));
}

#[test]
fn a_new_file_is_written_once_and_solved() {
    let folder = folder("new");
    for (name, arguments) in [
        ("chain.toml", &["new", "chain.toml"][..]),
        ("system.toml", &["new", "--system", "system.toml"]),
        ("truss.toml", &["new", "--truss", "truss.toml"]),
        ("net.toml", &["new", "--net", "5x4", "net.toml"]),
    ] {
        good(&folder, arguments);
        good(&folder, &["solve", name]);
        // Never over what is there.
        std::fs::write(folder.join(name), "mine").unwrap();
        let again = ran(&folder, arguments);
        assert_eq!(again.status.code(), Some(2));
        assert!(said(&again).contains("exists already"), "{}", said(&again));
        assert_eq!(std::fs::read_to_string(folder.join(name)).unwrap(), "mine");
    }
    // Inside 3 x 2 joints; each of the 5 x 4 but the corners is there.
    let net = String::from_utf8(ran(&folder, &["new", "--net", "5x4"]).stdout).unwrap();
    assert_eq!((net.matches("mass_kg = 1 }").count(), net.matches("at_m").count()), (6, 10));
    for wrong in ["2x5", "5", "axb"] {
        assert_eq!(ran(&folder, &["new", "--net", wrong]).status.code(), Some(2));
    }
    assert_eq!(ran(&folder, &["new", "--net", "5x5", "--truss"]).status.code(), Some(2));
}
