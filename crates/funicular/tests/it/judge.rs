//! `funicular judge`: answers from elsewhere, in all formats, right and wrong.

use formats::system::parse_moordyn;
use serde_json::Value;
use std::path::{Path, PathBuf};

use crate::run::{fed, program, refused, run, says};

/// A mass of 2 kg on two massless cables of 5 m between anchors 6 m apart: by the triangle 3, 4, 5
/// it hangs 4 m deep, and each cable pulls with 5/4 of 10 N.
const LAMP: &str = "name = \"lamp\"\ngravity_m_s2 = 10\n[joints]\nA = { at_m = [-3, 0, 0] }\n\
    B = { at_m = [3, 0, 0] }\nP = { mass_kg = 2 }\n\
    [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n\
    [[bars]]\nfrom = \"P\"\nto = \"B\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n";
const RIGHT: &str = "joint,x_m,y_m,z_m\nP,0,0,-4\nA,-3,0,0\nB,3,0,0\n";

fn folder(name: &str) -> PathBuf {
    let path = crate::run::folder(name);
    std::fs::write(path.join("lamp.toml"), LAMP).unwrap();
    std::fs::write(path.join("right.csv"), RIGHT).unwrap();
    path
}

fn judge(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    run(folder, &[&["judge"], arguments].concat())
}

/// What is printed of an answer, and said, where the verdict ends with this code.
#[track_caller]
fn judged(code: i32, folder: &Path, arguments: &[&str]) -> [String; 2] {
    let (found, out, error) = judge(folder, arguments);
    assert_eq!(found, Some(code), "{out}{error}");
    [out, error]
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

#[test]
fn what_our_own_commands_print_is_confirmed() {
    let folder = folder("judge-own");
    let solved = program(
        &folder,
        &["solve", "lamp.toml", "--json", "--csv", "j.csv", "--bars-csv", "b.csv"],
    );
    let solved = { solved }.output().unwrap();
    write(&folder, "answer.json", &String::from_utf8(solved.stdout).unwrap());
    let [out, _] = judged(0, &folder, &["lamp.toml", "--answer", "answer.json"]);
    assert_eq!(out.matches("Verdict: confirmed").count(), 2, "{out}");
    let columns = ["lamp.toml", "--answer", "j.csv", "--members", "b.csv", "--tolerance", "1e-11"];
    assert_eq!(judge(&folder, &columns).0, Some(0));
    // A chain, and its census: every equilibrium of it, stable or not.
    let chain = ["--case", "three-equal-bars"];
    for by in ["solve", "census"] {
        let printed =
            program(&folder, &[&[by], &chain[..], &["--json"]].concat()).output().unwrap();
        write(&folder, "chain.json", &String::from_utf8(printed.stdout).unwrap());
        let [out, _] =
            judged(0, &folder, &[&chain[..], &["--answer", "chain.json", "--json"]].concat());
        let found: Value = serde_json::from_str(&out).unwrap();
        let found = found.as_array().unwrap();
        assert_eq!(found.len(), if by == "solve" { 2 } else { 4 });
        assert!(found.iter().all(|one| one["finding"] == "confirmed"));
    }
}

#[test]
fn the_page_needs_nothing_else_and_tells_the_verdict_first() {
    let folder = folder("judge-page");
    write(&folder, "low.csv", &RIGHT.replace("-4\n", "-4.01\n"));
    judged(1, &folder, &["lamp.toml", "--answer", "low.csv", "--html", "page.html"]);
    let page = std::fs::read_to_string(folder.join("page.html")).unwrap();
    for outside in ["http://", "https://", "src=\"", "@import", "url("] {
        let allowed = page.matches("http://www.w3.org/").count();
        let found = page.matches(outside).count();
        assert_eq!(found, if outside == "http://" { allowed } else { 0 }, "{outside}");
    }
    let place = |text: &str| page.find(text).unwrap_or_else(|| panic!("{text}"));
    assert!(place("refuted: a law is broken") < place("member 1 (A - P)"));
    // The enclosure of the error of 1 cm, its ends rounded outwards.
    let proved = "Proved: the largest error of a joint is between ";
    let ends = page[place(proved) + proved.len()..].split(" m,").next().unwrap();
    let ends: Vec<f64> = ends.split(" and ").map(|end| end.parse().unwrap()).collect();
    assert!(ends[0] < 0.01 && 0.01 < ends[1] && ends[1] - ends[0] < 2.5e-5, "{ends:?}");
    assert!(place("member 1 (A - P)") < place("<svg"));
    // A page that would overwrite the answer is refused.
    judged(2, &folder, &["lamp.toml", "--answer", "low.csv", "--html", "low.csv"]);
}

/// 1 kg on two cables of 5 m between anchors 4 m apart hangs √21 m deep and draws each with
/// 9.81/2 N times 5/√21: 5.3518 N.
#[test]
fn an_answer_is_judged_by_the_digits_that_it_has() {
    let folder = folder("judge-digits");
    let lamp =
        LAMP.replace("= 10", "= 9.81").replace("3, 0, 0", "2, 0, 0").replace("= 2 }", "= 1 }");
    write(&folder, "lamp.toml", &lamp);
    // Without the anchors, which are those of the file.
    write(&folder, "centimetres.csv", "joint,x_m,y_m,z_m\nP,0,0,-4.58\n");
    write(&folder, "millimetres.csv", "joint,x_m,y_m,z_m\nP,0,0,-4583\n");
    write(&folder, "feet.csv", "joint,x_m,y_m,z_m\nA,-6.56,0,0\nB,6.56,0,0\nP,0,0,-15\n");
    write(&folder, "whole.csv", "joint,x_m,y_m,z_m\nP,0,0,-4.58257569496\n");
    write(&folder, "forces.csv", "from,to,axial_n\nA,P,5.35\nP,B,5.35\n");
    write(&folder, "wrong.csv", "from,to,axial_n\nA,P,5.38\nP,B,5.38\n");
    let unwrapped = |arguments: &[&str]| {
        let (code, out, err) = judge(&folder, &[&["lamp.toml", "--answer"], arguments].concat());
        (code, out.split_whitespace().collect::<Vec<_>>().join(" ") + &err)
    };
    let (code, out) = unwrapped(&["centimetres.csv"]);
    assert_eq!(code, Some(1), "{out}");
    for unit in ["millimetres", "feet"] {
        let (_, out) = unwrapped(&[&format!("{unit}.csv")]);
        assert!(out.contains(&format!("The places seem to be in {unit}: they")), "{out}");
    }
    let says = "Positions look rounded to 0.01 m: with --tolerance 1e-3 the answer is confirmed.";
    assert!(out.contains(says), "{out}");
    let (code, out) = unwrapped(&["centimetres.csv", "--tolerance", "1e-3"]);
    assert!(code == Some(0) && !out.contains("--tolerance"), "{out}");
    let (code, out) = unwrapped(&["whole.csv", "--members", "forces.csv"]);
    assert_eq!(code, Some(0), "{out}");
    assert!(out.contains("taken as printed to 3 digits: known to 0.005 N."), "{out}");
    assert!(!out.contains("0.000e0") && !out.contains("0.00e0"), "{out}");
    let (code, out) = unwrapped(&["whole.csv", "--members", "wrong.csv"]);
    assert!(code == Some(1) && out.contains("The forces are those of the answer."), "{out}");
    // The forces are wrong, not the places.
    assert!(
        out.contains("With --tolerance 1e-2 the answer") && !out.contains("look rounded"),
        "{out}"
    );
}

/// With oblique sliders, as in the issue: its own answer in 8 digits, 5e-8 m off.
#[test]
fn an_answer_with_oblique_sliders_is_confirmed() {
    let folder = folder("judge-sliders");
    write(&folder, "sliders.json", include_str!("judge/sliders.json"));
    write(&folder, "sliders.csv", include_str!("judge/sliders.csv"));
    let (code, out, _) = judge(&folder, &["sliders.json", "--answer", "sliders.csv"]);
    assert!(code == Some(0) && out.contains("Verdict: confirmed"), "{out}");
}

#[test]
fn bad_input_is_told_and_ends_with_two() {
    let folder = folder("judge-bad");
    let files = [
        ("missing.csv", "joint,x_m,y_m,z_m\nA,-3,0,0\nB,3,0,0\n", "no place for joint \"P\""),
        ("misspelt.csv", "joint,x_m,y_m,z\nA,-3,0,0\n", "did you mean `z_m`?"),
        ("unknown.csv", "joint,x_m,y_m,z_m\nQ,0,0,0\n", "the system has no joint \"Q\""),
        ("counts.json", "{\"joints_m\": [[0,0,0]]}", "1 joints, and the system 3"),
    ];
    for (name, text, says) in files {
        write(&folder, name, text);
        refused(&folder, &["judge", "lamp.toml", "--answer"], &[(&[name], says)]);
    }
    std::fs::write(folder.join("latin.csv"), b"joint,x_m,y_m,z_m\n\xe9,0,0,0\n").unwrap();
    let large = std::fs::File::create(folder.join("large.csv")).unwrap();
    large.set_len(model::system_file::MAX_FILE_BYTES + 1).unwrap();
    let table = [
        (&["lamp.toml"][..], "an answer is needed"),
        (&["lamp.toml", "--answer", "none.csv"], "cannot be read"),
        (&["lamp.toml", "--answer", "."], "it is a folder"),
        (&["lamp.toml", "--answer", "latin.csv"], "cannot be read"),
        (&["lamp.toml", "--answer", "large.csv"], "it is longer than"),
        (&["-", "--answer", "-"], "cannot both come from standard input"),
        (&["right.csv"], "needs its edges too"),
        (&["lamp.toml", "--edges", "right.csv", "--format", "funicular"], "--edges is for nets"),
        (&["lamp.toml", "--answer", "right.csv", "--tolerance", "2"], "must lie between"),
        (&["lamp.toml", "--answer", "right.csv", "--tolerance", "nan"], "must lie between"),
    ];
    refused(&folder, &["judge"], &table);
}

#[test]
fn standard_input_may_be_the_answer_or_the_system() {
    let folder = folder("judge-stdin");
    let run =
        |arguments: &[&str], input: &str| fed(program(&folder, arguments), input).status.code();
    assert_eq!(run(&["judge", "lamp.toml", "--answer", "-"], RIGHT), Some(0));
    assert_eq!(run(&["judge", "-", "--answer", "right.csv"], LAMP), Some(0));
    assert_eq!(run(&["judge", "lamp.toml", "--answer", "-"], ""), Some(2));
}

/// A line of forty segments that hangs free between two points; only its answer is computed here.
const LINE: &str = "---- MoorDyn Input File ----\na hanging line\n---- LINE TYPES ----\n\
    Name Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx\n(-) (m) (kg/m) (N) (-) (-) (-) (-) (-) (-)\n\
    wire 0.05 20 1e7 -1 0 1 1 1 1\n---- POINTS ----\nID Type X Y Z Mass Volume CdA Ca\n\
    (-) (-) (m) (m) (m) (kg) (m3) (m2) (-)\n1 Fixed 0 0 -20 0 0 0 0\n2 Vessel 60 0 0 0 0 0 0\n\
    ---- LINES ----\nID LineType AttachA AttachB UnstrLen NumSegs LineOutputs\n(-) (-) (-) (-) (m) (-) (-)\n\
    1 wire 1 2 70 40 -\n---- OPTIONS ----\n1000 WtrDnsty\n9.81 g\n200 WtrDpth\n---- need this line ----\n";

fn solved_line(text: &str) -> String {
    let foreign = parse_moordyn(text, "line.txt").unwrap();
    let answer = funicular::Solve::new().run(&foreign.system.clone().into()).unwrap();
    assert!(answer.agrees());
    let joints = foreign.system.joints().iter().zip(&answer.equilibria()[0].joints_m);
    let rows = joints.map(|(joint, [x, y, z])| format!("{},{x:?},{y:?},{z:?}\n", joint.name));
    format!("joint,x_m,y_m,z_m\n{}", rows.collect::<String>())
}

#[test]
fn a_mooring_line_is_judged_and_one_on_the_floor_is_not() {
    let folder = folder("judge-moordyn");
    write(&folder, "line.txt", LINE);
    write(&folder, "answer.csv", &solved_line(LINE));
    let [out, _] = judged(0, &folder, &["line.txt", "--answer", "answer.csv"]);
    assert!(out.contains("line 1: 40 elastic cables of 1.75 m"), "{out}");
    // The same with the floor where the line hangs through it.
    write(&folder, "shallow.txt", &LINE.replace("200 WtrDpth", "20 WtrDpth"));
    let [out, _] = judged(3, &folder, &["shallow.txt", "--answer", "answer.csv"]);
    assert!(out.contains("on or below the floor"), "{out}");
    judged(2, &folder, &["line.txt", "--answer", "answer.csv", "--format", "compas"]);
}

/// A plane deck with loads on its supports: answers are wanted as (x, 0, y), and both are said.
#[test]
fn a_deck_of_a_plane_says_what_it_wants_and_leaves_out() {
    let folder = folder("judge-plane");
    // Trusses of 5 m, and the load by which they are as long as from (3, 3.9).
    let (stiffness_n, found_m) = (1e6, 3.9_f64.hypot(3.0));
    let load_n = 2.0 * stiffness_n * (found_m / 5.0 - 1.0) * 3.9 / found_m;
    let deck = format!(
        "model basic -ndm 2\nnode 1 0 0\nnode 2 6 0\nnode 3 3 4\nfix 1 1 1\nfix 2 1 1\n\
        uniaxialMaterial Elastic 1 {stiffness_n:?}\nelement truss 1 1 3 1 1\nelement truss 2 2 3 1 1\n\
        pattern Plain 1 Linear {{ load 1 0 -100; load 2 7 -50; load 3 0 {load_n:?} }}\n"
    );
    write(&folder, "plane.tcl", &deck);
    write(&folder, "answer.csv", "joint,x_m,y_m,z_m\n1,0,0,0\n2,6,0,0\n3,3,0,3.9\n");
    let [out, _] = judged(0, &folder, &["plane.tcl", "--answer", "answer.csv"]);
    let said = out.split_whitespace().collect::<Vec<_>>().join(" ");
    says(
        &said,
        &["(x, y) is (x, 0, y), of answers too", "loads on held nodes (2), in sum (7, 0, -150) N"],
    );
}

#[test]
fn the_net_of_olympia_is_in_balance_and_one_force_changed_is_not() {
    let folder = folder("judge-olympia");
    let data =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/external/force-density");
    let text = |name: &str| std::fs::read_to_string(data.join(name)).unwrap();
    let (nodes, edges) = (text("olympia-nodes.csv"), text("olympia-edges.csv"));
    write(&folder, "nodes.csv", &nodes);
    write(&folder, "edges.csv", &edges);
    judged(0, &folder, &["nodes.csv", "--edges", "edges.csv"]);
    // Force density and force of one edge a tenth larger.
    assert!(edges.contains("77,4,5,5,9.086835826"));
    write(&folder, "edges.csv", &edges.replace("77,4,5,5,9.086835826", "77,4,5,5.5,9.9955194086"));
    let [out, _] = judged(1, &folder, &["nodes.csv", "--edges", "edges.csv"]);
    // Joint 77 is an anchor, and bears what it is asked to.
    assert!(out.contains("joint 4 ") && !out.contains("joint 77 "), "{out}");
    // A column that the other net has misspelt is named.
    write(&folder, "nodes.csv", &text("stuttgart21-nodes.csv"));
    let [_, err] = judged(2, &folder, &["nodes.csv", "--edges", "edges.csv"]);
    assert!(err.contains("the column \"6\" is not understood"), "{err}");
}

#[test]
fn names_from_files_do_not_steer_the_terminal() {
    let folder = folder("judge-escapes");
    let name = "\u{1b}[2JP";
    write(
        &folder,
        "lamp.toml",
        &LAMP.replace("P = {", "\"\\u001B[2JP\" = {").replace("\"P\"", "\"\\u001B[2JP\""),
    );
    write(&folder, "answer.csv", &RIGHT.replace("P,0,0,-4", &format!("\"{name}\",0,0,-5")));
    let [out, _] = judged(1, &folder, &["lamp.toml", "--answer", "answer.csv"]);
    assert!(!out.contains('\u{1b}'), "{out:?}");
    write(&folder, "answer.csv", &RIGHT.replace("P,0,0,-4", "\"\u{1b}]0;X\u{7}\",0,0,-5"));
    let [_, err] = judged(2, &folder, &["lamp.toml", "--answer", "answer.csv"]);
    assert!(!err.contains('\u{7}') && !err.contains("\u{1b}]"), "{err:?}");
}
