//! What people read: one answer on one screen, tables to paste, units, characters.

use crate::run::{fails, fed, funicular, holding, program, ran, says, stderr, stdout};

/// The lamp of 2 kg on cables of 3 and 4 m over 5 m: a right angle, so that they pull with 4/5 and 3/5 of the weight.
const WEIGHT_N: f64 = 2.0 * 9.80665;

fn solve_in(locale: &str, arguments: &[&str]) -> String {
    let mut command = program(".", &[&["solve", "--case", "lamp"], arguments].concat());
    let output = command.env("LC_ALL", locale).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    stdout(&output)
}

fn solve(arguments: &[&str]) -> String {
    solve_in("C.UTF-8", arguments)
}

/// The numbers of the line that begins with these words.
fn numbers(text: &str, line: &str) -> Vec<f64> {
    let words =
        |text: &str| text.split([' ', ',', '|', '&']).map(str::to_owned).collect::<Vec<_>>();
    let begins = |text: &&str| {
        let found: Vec<_> = words(text).into_iter().filter(|word| !word.is_empty()).collect();
        let wanted = words(line);
        found.len() > wanted.len() && found[..wanted.len()] == wanted[..]
    };
    let line = text.lines().find(begins).unwrap_or_else(|| panic!("no {line}:\n{text}"));
    words(line).iter().filter_map(|word| word.parse().ok()).collect()
}

fn close(x: f64, wanted: f64) {
    // Six digits are printed.
    assert!((x - wanted).abs() <= 1e-5 * wanted.abs(), "{x} {wanted}");
}

/// A pendulum drawn aside, held in an upright plane as in space: it spans nothing, so its depth is that of its end.
#[test]
fn what_hangs_loose_in_a_plane_has_no_line_to_sag_below() {
    for plane in ["", "plane = \"xz\"\n"] {
        let file = format!(
            "{plane}gravity_m_s2 = 10\n\
             joints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{ force_n = [3, 0, 0], mass_kg = 0.2 }}, \
             Q = {{ mass_kg = 0.2 }} }}\n\
             bars = [{{ from = \"A\", to = \"P\", length_m = 5, mass_kg = 0 }}, \
             {{ from = \"P\", to = \"Q\", length_m = 2, mass_kg = 0 }}]\n"
        );
        let text = stdout(&fed(program(".", &["solve", "-"]), file));
        let depth = "Sag: 6 m, of joint Q below the lowest support, A.";
        assert!(text.contains(depth), "{text}");
    }
}

/// A right triangle of 3, 4 and 5 m, its hypotenuse level, in UTM coordinates: to a centimetre and better.
#[test]
fn coordinates_far_from_the_origin_keep_their_digits() {
    let file = "joints = { A = { at_m = [500000, 5400000, 432] }, B = { at_m = [500005, 5400000, 432] }, \
         P = { mass_kg = 2 } }\n\
         bars = [{ from = \"A\", to = \"P\", length_m = 3, mass_kg = 0 }, \
         { from = \"P\", to = \"B\", length_m = 4, mass_kg = 0 }]\n";
    let text = stdout(&fed(program(".", &["solve", "-"]), file));
    let at = numbers(&text, "P");
    for (found, wanted) in at.iter().zip([500_001.8, 5_400_000.0, 429.6]) {
        assert!((found - wanted).abs() < 1e-4, "{at:?}");
    }
}

/// A name in a head that is broken in a narrow table is whole in CSV.
#[test]
fn names_in_heads_are_whole_in_csv() {
    let study = ["study", "--case", "lamp", "--vary", "joints.lamp.mass_kg=1,2,3"];
    let shown = ["--of", "joints.lamp", "--of", "bars.1.axial_n", "--of", "sag.A-B"];
    let text = stdout(&ran(".", &[&study[..], &shown, &["--format", "csv"]].concat()));
    assert!(text.contains("joints.lamp.z / m,bars.1.axial_n / N"), "{text}");
}

#[test]
fn a_lamp_of_two_members_fits_one_screen() {
    let text = solve(&[]);
    assert!(text.lines().count() <= 39, "a prompt has the last of 40 lines:\n{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    for (line, at, wanted) in [
        ("lamp", 2, -2.4),
        ("1 A lamp", 1, 0.8 * WEIGHT_N),
        ("1 A lamp", 2, 0.8 * WEIGHT_N),
        ("2 lamp B", 2, 0.6 * WEIGHT_N),
    ] {
        close(numbers(&text, line)[at], wanted);
    }
    let ground = &text[text.find("Forces of the ground").unwrap()..];
    close(numbers(ground, "A")[2], 0.64 * WEIGHT_N);
    for word in ["Evidence:", "Agreement: agreed"] {
        assert_eq!(text.lines().filter(|line| line.starts_with(word)).count(), 1, "{text}");
    }
    assert!(!text.contains("stress matrix"), "{text}");
}

#[test]
fn the_evidence_in_full_says_once_what_both_solvers_say() {
    let text = solve(&["--evidence"]);
    for words in ["stress matrix", "Krawczyk", "independent lengths", "the statics judge"] {
        assert_eq!(text.matches(words).count(), 1, "{words}\n{text}");
    }
    says(&text, &["+ converged  lagrange:", "+ converged  energy:"]);
}

#[test]
fn a_summary_keeps_forces_and_reactions() {
    let text = solve(&["--summary"]);
    assert!(!text.contains("x / m"), "{text}");
    close(numbers(&text, "1 A lamp")[1], 0.8 * WEIGHT_N);
    close(numbers(&text, "B")[2], 0.36 * WEIGHT_N);
}

#[test]
fn tables_are_pasted_where_they_are_wanted() {
    let csv = solve(&["--format", "csv"]);
    assert!(
        csv.lines().all(|line| line.is_empty() || line.starts_with("# ") || line.contains(','))
    );
    close(numbers(&csv, "1 A lamp")[1], 0.8 * WEIGHT_N);
    let markdown = solve(&["--format", "markdown"]);
    assert!(markdown.contains("\n| joint | x / m | y / m | z / m |\n|---|---:|---:|---:|\n| A |"));
    let latex = solve(&["--format", "latex"]);
    assert_eq!(latex.matches("\\begin{tabular}").count(), 3);
    for line in latex.lines().filter(|line| line.contains('&')) {
        assert!(line.ends_with(" \\\\"), "{line}");
    }
    let [json, same] = [["--format", "json"], ["--json", "--census=auto"]].map(|arguments| {
        let mut json: serde_json::Value = serde_json::from_str(&solve(&arguments)).unwrap();
        for equilibrium in json["equilibria"].as_array_mut().unwrap() {
            equilibrium["evidence"]["solve_s"] = 0.into();
        }
        json
    });
    assert_eq!(json, same);
}

#[test]
fn units_are_those_that_are_asked_for() {
    let text = solve(&["--units", "kN,mm"]);
    says(&text, &["z / mm", "at from / kN", "Fz / kN"]);
    close(numbers(&text, "lamp")[2], -2400.0);
    close(numbers(&text, "1 A lamp")[1], 0.8e-3 * WEIGHT_N);
    says(&text, &["Sag: 2400 mm", "7000 mm long", "Largest tension: 0.0156906 kN"]);
    // A pound-force is that of 0.45359237 kg.
    let text = solve(&["--units", "lbf,ft"]);
    close(numbers(&text, "1 A lamp")[1], 0.8 * 2.0 / 0.453_592_37);
    close(numbers(&text, "lamp")[2], -2.4 / 0.3048);
    fails(&funicular(&["solve", "--case", "lamp", "--units", "kp"]), 2, "kgf");
}

#[test]
fn boxes_are_of_ascii_where_that_is_all_there_is() {
    for (locale, arguments) in
        [("C.UTF-8", &["--ascii"][..]), ("C", &[]), ("de_DE.ISO-8859-1", &[])]
    {
        let text = solve_in(locale, arguments);
        assert!(text.is_ascii() && text.contains("-----"), "{text}");
    }
    assert!(solve(&[]).contains('\u{2500}'));
}

/// A mooring line of twenty bars, part of which lies on the ground: 57 coordinates of its joints, of which those on
/// the ground are upright and gone. Both solvers count the same, so it is said once.
#[test]
fn both_solvers_count_lengths_alike_on_a_floor() {
    let line = "floor_m = -30\n[joints]\nanchor = { at_m = [0, 0, -30] }\nship = { at_m = [60, 0, 0] }\n\
                [[bars]]\nfrom = 'anchor'\nto = 'ship'\nlength_m = 3.5\nmass_kg = 70\ncount = 20\n";
    let folder = holding([("line.toml", line)]);
    let text = stdout(&ran(&folder, &["solve", "line.toml", "--evidence"]));
    assert_eq!(text.matches("independent lengths").count(), 1, "{text}");
    assert!(text.contains("20 independent lengths, 35 mechanisms, 0 self-stresses"), "{text}");
}

/// `1'` is one word, also where a table is wider than the terminal; and what stands above it is not.
#[test]
fn names_of_mirror_images_are_not_broken_over_lines() {
    let mut command = program(".", &["census", "--case", "three-equal-bars"]);
    let text = stdout(&command.env("LC_ALL", "C.UTF-8").output().unwrap());
    for label in ["1'", "2'"] {
        let begins = |line: &&str| line.split_whitespace().next() == Some(label);
        // Its energy stands in the same line.
        assert!(
            text.lines().filter(begins).any(|line| line.contains(" -2") || line.contains(" -3")),
            "{text}"
        );
    }
    assert!(!text.lines().any(|line| line.trim() == "'"), "{text}");
    let found = text.lines().find(|line| line.starts_with("4 equilibria")).unwrap();
    assert!(found.chars().count() <= 80, "{found}");
}

/// Whatever is printed without a terminal fits into 80 columns, and no name of a joint is broken for it.
#[test]
fn all_that_is_printed_fits_80_columns() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let mut command = program(folder.path(), arguments);
        stdout(&command.env("LC_ALL", "C.UTF-8").output().unwrap())
    };
    run(&["new", "--net", "5x5", "net.toml"]);
    let trace = ["--case", "three-equal-bars", "--vary", "anchors.end_m.z=-2.9..-0.5:4"];
    let mut all: Vec<Vec<&str>> = vec![vec!["new"], vec!["solve", "net.toml"]];
    all.extend(["study", "trace"].map(|command| [&[command], &trace[..]].concat()));
    for case in ["three-equal-bars", "lamp", "six-orders"] {
        all.extend(
            ["census", "modes", "solve", "derivatives"]
                .map(|command| vec![command, "--case", case]),
        );
        all.push(vec!["simulate", "--case", case, "--time", "0.01"]);
    }
    for arguments in &all {
        let text = run(arguments);
        for line in text.lines() {
            assert!(line.chars().count() <= 80, "{arguments:?}: {line}");
        }
    }
    // What each may bear stands in the row of its names.
    let net = run(&["solve", "net.toml"]);
    let row =
        |line: &str| line.contains(" N1_2 ") && line.contains(" N2_2 ") && line.contains(" to ");
    assert!(net.lines().any(row), "{net}");
    // A thing alone is one thing.
    let one = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
               bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 0 }]\n";
    std::fs::write(folder.path().join("one.toml"), one).unwrap();
    assert!(run(&["solve", "one.toml"]).starts_with("unnamed: 1 member between 2 joints,"));
    assert!(run(&["census", "one.toml"]).starts_with("unnamed: 1 member between 2 joints,\n"));
}

#[test]
fn counts_begin_at_one() {
    let run = |arguments: &[&str]| stdout(&funicular(arguments));
    let vary = "anchors.end_m.z=-2.9..-0.5:4";
    let text = run(&["trace", "--case", "three-equal-bars", "--vary", vary]);
    assert!(text.contains(" 1, 2 ") && !text.contains(" 0, 1 "), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("basins");
    let arguments = ["basins", "--case", "two-bars", "--size", "4", "--out", out.to_str().unwrap()];
    run(&arguments);
    let pictures = std::fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().path());
    let svg: Vec<_> =
        pictures.map(|path| std::fs::read_to_string(path).unwrap_or_default()).collect();
    assert!(svg.iter().any(|svg| svg.contains(">1: ")), "the legend");
    assert!(!svg.iter().any(|svg| svg.contains(">0: ")), "the legend");
}

/// A planar truss that is drawn in space falls over, and the answer says how it is kept in its plane.
#[test]
fn what_falls_out_of_its_plane_has_a_hint() {
    let truss = stdout(&funicular(&["cases", "warren-truss"]));
    let solved = |text: &str| {
        let folder = holding([("truss.toml", text)]);
        stdout(&ran(&folder, &["solve", "truss.toml", "--census", "never", "--summary"]))
    };
    let hint = "plane = \"xz\"";
    assert!(!solved(&truss).contains(hint));
    let in_space = solved(&truss.replace(hint, ""));
    assert!(in_space.contains("unstable") && in_space.contains(hint), "{in_space}");
}
