//! Small files that would take the machine, wait for ever, or show what is not theirs.

#![cfg(unix)]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Output;

use crate::run::{fails, fed, folder, program, words};

/// What is refused here took minutes, or memory without end.
fn run(folder: &Path, arguments: &[&str]) -> Output {
    fed(program(folder, arguments), "")
}

/// A million joints whose names have 13,000 letters each: 13 GB in 26 kB.
fn long_names() -> String {
    let name = "x".repeat(13_000);
    format!(
        "{{\"joints\": {{\"{name}\": {{\"at_m\": [0, 0, 0]}}, \"B\": {{\"at_m\": [600000, 0, 0]}}}}, \
         \"bars\": [{{\"from\": \"{name}\", \"to\": \"B\", \"length_m\": 1, \"mass_kg\": 1, \"count\": 1000000}}]}}"
    )
}

#[test]
fn names_times_a_count_are_refused_before_they_are_made() {
    let folder = folder("names");
    fs::write(folder.join("names.json"), long_names()).unwrap();
    let output = run(&folder, &["solve", "names.json"]);
    fails(&output, 2, "bytes of memory are needed; of 24000000000");
    // A line of a batch that is refused takes none of the others with it.
    let lamp = "{\"anchors\": {\"start_m\": [0, 0, 0], \"end_m\": [1, 0, 0]}, \
                \"bars\": [{\"length_m\": 1, \"mass_kg\": 1, \"count\": 2}]}";
    fs::write(folder.join("lines"), format!("{}\n{lamp}\n", long_names())).unwrap();
    let output = run(&folder, &["solve", "--batch", "lines", "--summary"]);
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].contains("bytes of memory are needed"), "{text}");
    assert!(lines[1].contains("\"verdict\":\"agreed\""), "{text}");
}

/// Solvers square lengths and forces: the table was one of NaN.
#[test]
fn numbers_whose_squares_are_none_are_refused() {
    let folder = folder("huge");
    let lamp = |far: &str, pull: &str, stiff: &str| {
        format!(
            "joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [3, {far}, 0] }}, \
             P = {{ mass_kg = 1, force_n = [{pull}, 0, 0] }} }}\n\
             bars = [{{ from = \"A\", to = \"P\", length_m = 2, mass_kg = 1, stiffness_n = {stiff} }}, \
             {{ from = \"P\", to = \"B\", length_m = 2, mass_kg = 1, stiffness_n = {stiff} }}]\n"
        )
    };
    for (file, because) in [
        (lamp("1e300", "0", "1e3"), "extent of the supports of this system is above 1e150"),
        (lamp("0", "1e300", "1e3"), "total load of this system is above 1e150"),
        (lamp("0", "0", "1e300"), "total stiffness of this system is above 1e150"),
    ] {
        fs::write(folder.join("lamp.toml"), file).unwrap();
        fails(&run(&folder, &["solve", "lamp.toml"]), 2, because);
    }
}

/// Each line may have so many segments, all of them together may not.
#[test]
fn segments_of_all_lines_share_one_budget() {
    let folder = folder("segments");
    let mut text = "--- LINE TYPES ---\nTypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx\n(-)\n\
        chain 0.2 100 1e9 -1 0 1 1 0 0\n--- POINT PROPERTIES ---\n\
        ID Type X Y Z Mass Volume CdA Ca\n(-)\n1 Fixed 0 0 -50 0 0 0 0\n2 Fixed 60 0 -10 0 0 0 0\n\
        --- LINES ---\nID LineType AttachA AttachB UnstrLen NumSegs LineOutputs\n(-)\n"
        .to_owned();
    for line in 1..=40 {
        let _ = writeln!(text, "{line} chain 1 2 80 1000 -");
    }
    text += "--- OPTIONS ---\n0.001 dtM\n--- need this line ---\n";
    fs::write(folder.join("lines.dat"), text).unwrap();
    fs::write(folder.join("answer.csv"), "joint,x_m,y_m,z_m\n1,0,0,-50\n").unwrap();
    let judge = ["judge", "lines.dat", "--answer", "answer.csv", "--max-memory", "100MB"];
    fails(&run(&folder, &judge), 2, "200000000 bytes of memory are needed; of 100000000");
}

/// Lines of drawings and trusses are counted as they are read: a few letters each, and two letters each where they share
/// their ends.
#[test]
fn lines_of_drawings_have_a_budget() {
    let folder = folder("drawings");
    let ends = " 1 2".repeat(5001);
    fs::write(folder.join("long.obj"), format!("v 0 0 0\nv 1 0 0\ng anchors\np 1\nl{ends}\n"))
        .unwrap();
    let truss = "element truss 1 1 2 1 1\n".repeat(10_001);
    let deck = "model basic -ndm 3\nnode 1 0 0 0\nnode 2 1 0 0\nuniaxialMaterial Elastic 1 1\n";
    fs::write(folder.join("long.tcl"), format!("{deck}{truss}")).unwrap();
    let entities = format!("0\nLWPOLYLINE\n{}", "10\n0\n20\n0\n".repeat(10_002));
    fs::write(
        folder.join("long.dxf"),
        format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"),
    )
    .unwrap();
    for file in ["long.obj", "long.tcl", "long.dxf"] {
        let output = run(&folder, &["solve", file, "--max-memory", "50MB"]);
        fails(&output, 2, "50005000 bytes of memory are needed; of 50000000");
    }
}

/// What is done with a row needs more memory than its equilibrium: motion, variations and derivatives as much
/// as another system's, modes more for each that is asked for. It is asked for before.
#[test]
fn more_than_an_equilibrium_needs_more_memory() {
    let folder = folder("more");
    let row = "anchors = { start_m = [0, 0, 0], end_m = [600, 0, 0] }\n\
        bars = [{ length_m = 1, mass_kg = 1, count = 1000 }]\n";
    fs::write(folder.join("row.toml"), row).unwrap();
    let modes = ["modes", "row.toml", "--modes", "5"];
    for (arguments, needed) in [
        (&modes[..], "7500"),
        (&["simulate", "row.toml", "--time", "0.001"], "5000"),
        (&["study", "row.toml", "--vary", "gravity_m_s2=9,10"], "5000"),
        (&["derivatives", "row.toml", "--of", "bars.1.axial_n"], "5000"),
    ] {
        let output = run(&folder, &[arguments, &["--max-memory", "4MB"]].concat());
        fails(&output, 2, &format!("{needed}000 bytes of memory are needed; of 4000000"));
    }
    let sweep = ["sweep", "row.toml", "--seeds", "9", "--threads", "2", "--out", "rows"];
    let basins = ["basins", "row.toml", "--size", "300", "--out", "pictures"];
    for (arguments, needed) in [(&sweep[..], "100000000"), (&basins, "4500000")] {
        let output = run(&folder, &[arguments, &["--max-memory", "4MB"]].concat());
        fails(&output, 2, &format!("{needed} bytes of memory are needed; of 4000000"));
    }
    assert!(!folder.join("rows").exists());
    let output = run(&folder, &[&modes[..], &["--max-memory", "7500kB"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
}

/// A tree of JSON takes many times its text.
#[test]
fn answers_in_json_have_a_budget() {
    let folder = folder("json");
    fs::write(folder.join("answer.json"), format!("[{}{{}}]", "{\"\":0},".repeat(100_000)))
        .unwrap();
    let judge = ["judge", "--case", "lamp", "--answer", "answer.json", "--max-memory", "80MB"];
    fails(&run(&folder, &judge), 2, "of memory are needed; of 80000000");
}

/// As many unknown joints as a table of forces holds, and as many attributes as an element of XML
/// holds, take time in proportion.
#[test]
fn long_tables_of_names_take_time_in_proportion() {
    let folder = folder("long");
    let mut text = "time_s,joint,x_n,y_n,z_n\n".to_owned();
    for k in 0..300_000 {
        let _ = writeln!(text, "0,joint{k},0,0,0");
    }
    fs::write(folder.join("forces.csv"), text).unwrap();
    let output = run(&folder, &["simulate", "--case", "lamp", "--forces", "forces.csv"]);
    fails(&output, 2, "joint0");
    let mut element = "<VTKFile type=\"UnstructuredGrid\"".to_owned();
    for k in 0..300_000 {
        let _ = write!(element, " a{k}=\"\"");
    }
    fs::write(folder.join("answer.vtu"), format!("<!-- === -->\n{element}/>")).unwrap();
    let output = run(&folder, &["judge", "--case", "lamp", "--answer", "answer.vtu"]);
    fails(&output, 2, "answer.vtu:2: an element with 300001 attributes is not understood");
}

/// Whatever solves a system, alone or many times, ends with the work that it may do.
#[test]
fn every_command_that_solves_ends_with_its_work() {
    let folder = folder("work");
    let bound = "max_work is 1";
    for arguments in [
        &["solve", "--case", "bridle"][..],
        &["modes", "--case", "bridle"],
        &["derivatives", "--case", "bridle", "--of", "bars.1.axial_n"],
        &["study", "--case", "bridle", "--vary", "gravity_m_s2=9,10"],
        &["study", "--case", "bridle", "--vary", "gravity_m_s2=9,10", "--json"],
    ] {
        let output = run(&folder, &[arguments, &["--max-work", "1"]].concat());
        let all = format!("{}{}", String::from_utf8_lossy(&output.stdout), words(&output));
        assert_eq!(output.status.code(), Some(3), "{arguments:?}: {all}");
        assert!(all.contains(bound) || all.contains("\"max_work\": 1"), "{arguments:?}: {all}");
        let free = run(&folder, arguments);
        assert_eq!(free.status.code(), Some(0), "{arguments:?}: {}", words(&free));
    }
}

/// A pipe that nobody writes into is not waited for, whoever names it.
#[test]
fn pipes_without_a_writer_are_not_waited_for() {
    let folder = folder("pipes");
    let made = std::process::Command::new("mkfifo").arg(folder.join("pipe")).status();
    assert!(made.unwrap().success());
    let anchors = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, -1] }\n";
    fs::write(folder.join("chain.toml"), format!("bars_file = \"pipe\"\n{anchors}")).unwrap();
    let named = "joints_file = \"pipe\"\nbars = [{ from = \"A\", to = \"B\", length_m = 1, mass_kg = 1 }]\n";
    fs::write(folder.join("named.toml"), named).unwrap();
    for arguments in [
        &["solve", "chain.toml"][..],
        &["solve", "named.toml"],
        &["solve", "pipe"],
        &["solve", "--batch", "pipe"],
        &["solve", "--case", "lamp", "--near", "pipe"],
        &["judge", "--case", "lamp", "--answer", "pipe"],
        &["simulate", "--case", "lamp", "--forces", "pipe"],
    ] {
        fails(&run(&folder, arguments), 2, "a pipe with a name");
    }
}

/// What a system file names need not be what its writer may read.
#[test]
fn errors_show_nothing_of_a_file_that_is_no_table() {
    let folder = folder("foreign");
    let anchors = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, -1] }\n";
    let bars = "bars = [{ from = \"A\", to = \"B\", length_m = 1, mass_kg = 1 }]\n";
    let joints = "joints = { A = { at_m = [0, 0, 0] } }\n";
    for (name, text) in [
        ("chain.toml", format!("bars_file = \"secret\"\n{anchors}")),
        ("joints.toml", format!("joints_file = \"secret\"\n{bars}")),
        ("bars.toml", format!("bars_file = \"secret\"\n{joints}")),
    ] {
        fs::write(folder.join(name), text).unwrap();
        for secret in
            ["root:$6$salt:20000:0:99999\nuser:$6$\n", "key,$6$\n", "\u{1}\n$6$", "$6$\n\n"]
        {
            fs::write(folder.join("secret"), secret).unwrap();
            let output = run(&folder, &["solve", name]);
            fails(&output, 2, "names no column");
            assert!(!words(&output).contains("$6$"), "{name}: {}", words(&output));
        }
        fs::write(folder.join("secret"), b"$6$\xff\n").unwrap();
        let output = run(&folder, &["solve", name]);
        fails(&output, 2, "names no column");
        assert!(!words(&output).contains("$6$"), "{name}: {}", words(&output));
    }
}

/// Nor need what is named by mistake in the command.
#[test]
fn errors_show_nothing_of_a_file_that_is_something_else() {
    let folder = folder("something-else");
    for secret in ["root:$6$salt:20000:0:99999\nuser:$6$\n", "key,$6$\n", "{\"$6$\": $6$\n"] {
        fs::write(folder.join("secret"), secret).unwrap();
        for arguments in [
            &["solve", "secret"][..],
            &["solve", "--batch", "secret"],
            &["solve", "--case", "lamp", "--near", "secret"],
            &["judge", "--case", "lamp", "--answer", "secret"],
            &["judge", "--case", "lamp", "--answer", "secret", "--members", "secret"],
            &["simulate", "--case", "lamp", "--forces", "secret"],
        ] {
            let output = run(&folder, arguments);
            let all = format!("{}{}", String::from_utf8_lossy(&output.stdout), words(&output));
            assert!(!output.status.success() && !all.contains("$6$"), "{arguments:?}: {all}");
        }
    }
}

/// The lamp on two cables, between joints that a table would compute.
const FORMULAS: &str = "name = \"a\\u202eb\\u0007\"\n\
    [joints]\n\"=1+2\" = { at_m = [-3, 0, 0] }\n\"@B\" = { at_m = [3, 0, 0] }\n\"-\\u202eP\" = { mass_kg = 2 }\n\
    [[bars]]\nfrom = \"=1+2\"\nto = \"-\\u202eP\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n\
    [[bars]]\nfrom = \"-\\u202eP\"\nto = \"@B\"\nlength_m = 5\nmass_kg = 0\nkind = \"cable\"\n";

/// Names that begin like a formula are text in tables, and read back as they are; in pictures and
/// pages no name turns the text round it.
#[test]
fn names_stay_names_in_tables_pictures_and_pages() {
    let folder = folder("names-out");
    fs::write(folder.join("lamp.toml"), FORMULAS).unwrap();
    let solve: Vec<_> =
        "solve lamp.toml --csv joints.csv --bars-csv bars.csv --svg lamp.svg".split(' ').collect();
    let output = run(&folder, &solve);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    for file in ["joints.csv", "bars.csv"] {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let cells = text.lines().flat_map(|line| line.split(','));
        // A number may begin with a sign.
        let formula =
            |cell: &&str| cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err();
        assert_eq!(cells.clone().find(formula), None, "{text}");
        assert!(
            cells.clone().any(|cell| cell == "'=1+2") && cells.clone().any(|cell| cell == "'@B")
        );
    }
    let judge: Vec<_> = "judge lamp.toml --answer joints.csv --members bars.csv --html lamp.html"
        .split(' ')
        .collect();
    let output = run(&folder, &judge);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    let output = run(&folder, &["modes", "lamp.toml", "--html", "modes.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    for file in ["lamp.svg", "lamp-1.html", "modes.html"] {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let bad = text.chars().find(|c| model::steers(*c) && !matches!(c, '\n' | '\t'));
        assert_eq!(bad, None, "{file}");
    }
}

/// A text of the command line comes back without what would colour the terminal.
#[test]
fn a_parameter_is_not_echoed_raw() {
    let folder = folder("vary");
    let study = ["study", "--case", "lamp", "--vary", "joints.lamp.mass_kg=1\u{1b}[31m,2"];
    let mut command = program(&folder, &study);
    let output = command.env_remove("NO_COLOR").env("FORCE_COLOR", "1").output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("1?[31m") && !text.contains("1\u{1b}[31m"), "{text:?}");
}

/// `-` is standard output where something is read, and no name of a file.
#[test]
fn a_dash_is_no_file() {
    let folder = folder("dash");
    let output = run(&folder, &["solve", "--case", "lamp", "--csv", "-"]);
    fails(&output, 2, "standard output is /dev/stdout");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

/// A motion that fails at its first step is no result, and replaces none.
#[test]
fn a_motion_that_fails_replaces_nothing() {
    let folder = folder("motion");
    fs::write(folder.join("m.csv"), "precious\n").unwrap();
    let simulate: Vec<_> =
        "simulate --case three-equal-bars --from seed:7 --step 10 --time 100 --out m.csv"
            .split(' ')
            .collect();
    fails(&run(&folder, &simulate), 2, "take a shorter step");
    assert_eq!(fs::read_to_string(folder.join("m.csv")).unwrap(), "precious\n");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}
