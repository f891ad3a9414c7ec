//! Frequencies enclosed, modes drawn and moving; motions and their ends, the same for any threads.

use std::io::Read as _;
use std::path::Path;
use std::process::Stdio;

use serde_json::Value;

use crate::run::{Running, column, holding, names, program, refused, wait_until, words};

/// The outcome of the program in a folder, on so many threads of the pool.
fn run(folder: impl AsRef<Path>, threads: usize, arguments: &[&str]) -> std::process::Output {
    let mut command = program(folder, arguments);
    command.env("RAYON_NUM_THREADS", threads.to_string()).output().unwrap()
}

fn json(folder: impl AsRef<Path>, arguments: &[&str]) -> Value {
    crate::run::json(&run(folder, 2, arguments))
}

/// The ends of the enclosure of each mode.
fn enclosures(equilibrium: &Value) -> Vec<[f64; 2]> {
    let modes = equilibrium["modes"].as_array().unwrap();
    let ends = |mode: &Value| [0, 1].map(|k| mode["omega2_between_s2"][k].as_f64().unwrap());
    modes.iter().map(ends).collect()
}

#[test]
fn frequencies_of_the_paper_are_enclosed_and_their_signs_proved() {
    let folder = tempfile::tempdir().unwrap();
    let found = json(&folder, &["modes", "--case", "three-equal-bars", "--json"]);
    for equilibrium in found["equilibria"].as_array().unwrap() {
        let enclosed = &equilibrium["enclosed"];
        assert_eq!(enclosed["status"], "reached", "{enclosed}");
        let inertia = &enclosed["inertia"];
        assert_eq!(inertia["negative"], equilibrium["index_in_space"]);
        assert_eq!(inertia["zero"], 1, "the turn about the anchors");
        let modes = equilibrium["modes"].as_array().unwrap();
        for (mode, [low, high]) in modes.iter().zip(enclosures(equilibrium)) {
            let omega2 = mode["omega2_s2"].as_f64().unwrap();
            let turns = mode["what"].as_str().unwrap().contains("turn");
            assert_eq!(turns, low.abs() + high.abs() <= 0.0, "{mode}");
            // Dense linear algebra is as near as that.
            assert!(low - 1e-11 <= omega2 && omega2 <= high + 1e-11, "{mode}");
            assert!(high - low < 2e-11, "{mode}");
        }
    }
    // E2 is left at these rates (the motion pushed off it: 7.773041054 and 6.3589771 1/s).
    let upper = found["equilibria"].as_array().unwrap().iter().find(|e| e["label"] == "2");
    let ends = enclosures(upper.unwrap());
    for ([low, high], rate) in ends.into_iter().zip([7.773_041_f64, 6.358_977]) {
        assert!((-low).sqrt() > rate - 1e-6 && (-high).sqrt() < rate + 1e-6, "{low} {high} {rate}");
    }
    let text = run(&folder, 1, &["modes", "--case", "three-equal-bars"]).stdout;
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("proved: 2 negative, 1 zero, 0 positive"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
}

/// A pendulum of two points: ω² = (2 -+ √2) g/l.
const DOUBLE: &str = r#"
name = "double <&> pendulum"
gravity_m_s2 = 10
joints = { O = { at_m = [0, 0, 0] }, A = { mass_kg = 1 }, B = { mass_kg = 1 } }
bars = [
    { from = "O", to = "A", length_m = 1, mass_kg = 0 },
    { from = "A", to = "B", length_m = 1, mass_kg = 0 },
]
"#;

/// Two masses on a triangle of rods lie on the floor and turn about their anchor's vertical: the one
/// mode is proved to be zero, and is called so.
#[test]
fn a_mode_that_is_proved_to_be_zero_is_called_a_turn() {
    let text = r#"{"joints": {"A": {"at_m": [0.35,1.52,2.18]}, "P": {"mass_kg": 6}, "Q": {"mass_kg": 9}},
        "bars": [{"from":"A","to":"P","length_m":4.75,"mass_kg":0}, {"from":"A","to":"Q","length_m":5.15,"mass_kg":0},
                 {"from":"P","to":"Q","length_m":5.16,"mass_kg":0}], "floor_m": 1.93}"#;
    let folder = holding([("turns.json", text)]);
    let found = json(&folder, &["modes", "turns.json", "--json"]);
    let modes = found["equilibria"][0]["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 1);
    assert_eq!(modes[0]["omega2_between_s2"], serde_json::json!([0.0, 0.0]));
    assert_eq!(modes[0]["omega2_s2"], 0.0);
    assert_eq!(modes[0]["what"], "turn about the vertical at x = 0.35 m, y = 1.52 m");
    assert!(modes[0].get("frequency_hz").is_none(), "{modes:?}");
}

/// A ring that hangs on the floor from an elastic bar, beside a slack rope: rounding makes the `ω²` of its turn negative, and the
/// proof says that it is zero.
#[test]
fn a_direction_is_counted_as_it_is_proved() {
    let text = "floor_m = -0.2\n\
        joints = { H0 = { at_m = [-1.9172193654414924, 1.4510621147504525, 2.302123657957715] }, \
        H1 = { at_m = [-0.942842988772572, 0.4322336618884375, 2.1424758268699327] }, R0 = { mass_kg = 4.586960867649749 } }\n\
        bars = [{ from = \"H1\", via = [\"R0\", \"H0\"], to = \"R0\", kind = \"cable\", length_m = 10.72230128347486, \
        stiffness_n = 540.7908575765497 }, { from = \"H1\", to = \"R0\", length_m = 2.5141960798629315, mass_kg = 0.1, \
        stiffness_n = 1476.5834080884542 }]\n";
    let folder = holding([("ring.toml", text)]);
    let output = run(&folder, 1, &["modes", "ring.toml", "--json"]);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let ring = &found["equilibria"][0];
    assert_eq!(
        (&ring["enclosed"]["inertia"]["negative"], &ring["index_by_modes"]),
        (&0.into(), &0.into())
    );
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn closed_forms_lie_in_the_enclosures_and_large_systems_say_that_they_have_none() {
    let folder = holding([("double.toml", DOUBLE)]);
    let found = json(&folder, &["modes", "double.toml", "--json"]);
    let ends = enclosures(&found["equilibria"][0]);
    assert!(ends.len() == 4 && ends.iter().all(|[low, high]| high > low), "{ends:?}");
    let text = run(&folder, 2, &["modes", "double.toml"]).stdout;
    assert!(String::from_utf8(text).unwrap().contains("oscillation in the plane"));
    let long = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
                bars = [{ length_m = 0.01, mass_kg = 0.01, count = 200 }]\n";
    std::fs::write(folder.path().join("long.toml"), long).unwrap();
    let found = json(&folder, &["modes", "long.toml", "--modes", "3", "--json"]);
    let enclosed = &found["equilibria"][0]["enclosed"];
    assert_eq!(enclosed["status"], "open");
    assert_eq!(enclosed["because"], "199 joints move, and at most 60 are enclosed");
    assert!(found["equilibria"][0]["modes"][0].get("omega2_between_s2").is_none());
    let text = run(&folder, 2, &["modes", "long.toml", "--modes", "3"]).stdout;
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("not enclosed by interval arithmetic: 199 joints move"), "{text}");
}

#[test]
fn cables_that_pull_struts_that_push_and_a_floor_hold_in_small_motions() {
    let folder = tempfile::tempdir().unwrap();
    // A closed ring of bars that hangs by three cables.
    let found = json(&folder, &["modes", "--case", "ring", "--json"]);
    let equilibrium = &found["equilibria"][0];
    assert_eq!(equilibrium["index_by_modes"], equilibrium["index_in_space"]);
    assert_eq!(equilibrium["enclosed"]["inertia"]["positive"], equilibrium["modes_in_all"]);
    // The lamp of the triangle 3, 4, 5 swings about the line of its anchors, 12/5 m below it.
    let found = json(&folder, &["modes", "--case", "lamp", "--json"]);
    let [[low, high]] = enclosures(&found["equilibria"][0])[..] else { panic!("{found}") };
    let told = 9.806_65 / 2.4;
    assert!(low <= told + 1e-12 && told - 1e-12 <= high && high - low < 1e-12, "{low} {high}");
    // 2 kg on a floor between cords of 1 m, EA = 400 N, stretched to 1.25 m: 2 T/(d m) across them
    // and 2 EA/(l m) along them.
    let laid = "floor_m = 0.25\n\
                joints = { A = { at_m = [-1.25, 0, 0.25] }, B = { at_m = [1.25, 0, 0.25] }, P = { mass_kg = 2 } }\n\
                bars = [{ from = \"A\", to = \"P\", kind = \"cable\", length_m = 1, mass_kg = 0, stiffness_n = 400 }, \
                { from = \"B\", to = \"P\", kind = \"cable\", length_m = 1, mass_kg = 0, stiffness_n = 400 }]\n";
    std::fs::write(folder.path().join("laid.toml"), laid).unwrap();
    let found = json(&folder, &["modes", "laid.toml", "--json"]);
    let ends = enclosures(&found["equilibria"][0]);
    for ([low, high], told) in ends.iter().zip([80.0, 400.0]) {
        assert!(*low <= told && told <= *high && high - low < 1e-10, "{ends:?}");
    }
    assert_eq!(ends.len(), 2);
}

#[test]
fn three_different_moments_are_enclosed_and_a_member_that_is_just_taut_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let found = json(&folder, &["modes", "--case", "three-bars-off-centre", "--json"]);
    let equilibria = found["equilibria"].as_array().unwrap();
    assert!(equilibria.len() > 1);
    for equilibrium in equilibria {
        assert_eq!(equilibrium["enclosed"]["status"], "reached");
        assert_eq!(equilibrium["enclosed"]["inertia"]["negative"], equilibrium["index_in_space"]);
    }
    // A bar that hangs: ω² = m g r/(m r² + J) about either axis, beside its spin.
    let hanging = "joints = { O = { at_m = [0, 0, 0] }, P = {} }\n\
                   bars = [{ from = \"O\", to = \"P\", length_m = 1, mass_kg = 2, inertia_kg_m2 = [0.25, 0.5, 0.375] }]\n";
    std::fs::write(folder.path().join("hanging.toml"), hanging).unwrap();
    let found = json(&folder, &["modes", "hanging.toml", "--json"]);
    let modes = found["equilibria"][0]["modes"].as_array().unwrap();
    assert_eq!((modes.len(), &modes[0]["what"]), (3, &"spin of bar 1 about its axis".into()));
    let ends = enclosures(&found["equilibria"][0]);
    for ([low, high], moment) in ends[1..].iter().zip([0.5, 0.375]) {
        let told = 9.806_65 / (0.5 + moment);
        assert!(*low <= told + 1e-14 && told <= *high + 1e-14 && high - low < 1e-12, "{ends:?}");
    }
    // A third cable, level and of just its length, that bears nothing.
    let lamp = "joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, C = { at_m = [-1, 0, -4] }, P = { mass_kg = 2 } }\n\
                bars = [{ from = \"A\", to = \"P\", length_m = 5, mass_kg = 0 }, { from = \"B\", to = \"P\", length_m = 5, mass_kg = 0 }, \
                { from = \"C\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"cable\" }]\n";
    std::fs::write(folder.path().join("just.toml"), lamp).unwrap();
    let output = run(&folder, 1, &["modes", "just.toml"]);
    assert!(words(&output).contains("member 3 is an inextensible cable"), "{output:?}");
    assert_ne!(output.status.code(), Some(0));
}

#[test]
fn modes_are_drawn_and_moved_on_a_page() {
    let folder = holding([("double.toml", DOUBLE)]);
    let arguments = ["modes", "double.toml", "--svg", "m.svg", "--html", "m.html"];
    assert_eq!(run(&folder, 1, &arguments).status.code(), Some(0));
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let svg = read("m.svg");
    let parsed = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<_> = parsed.descendants().filter_map(|node| node.text()).collect();
    // √((2 - √2) 10)/2π = 0.3852 Hz, each in two planes.
    for told in ["1: 0.3852 Hz", "4: 0.93 Hz", "all modes"] {
        assert!(texts.iter().any(|text| text.contains(told)), "{told}: {texts:?}");
    }
    let paths = parsed.descendants().filter(|node| node.has_tag_name("path"));
    assert_eq!(paths.count(), 4 * 3, "at rest and to both sides");
    let page = read("m.html");
    assert!(page.contains("double &lt;&amp;&gt; pendulum") && !page.contains("http"), "{page}");
    let data = page.split("application/json\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    assert!(data["play"] == true && data["shapes"][0]["axial"].is_array());
    let mut shapes = data["shapes"].as_array().unwrap().iter();
    let modes = shapes.find_map(|shape| shape["modes"].as_array()).unwrap();
    assert_eq!((modes.len(), modes[0]["shape"].as_array().unwrap().len()), (4, 9));
    let omega2 = modes[3]["omega2"].as_f64().unwrap();
    assert!((omega2 - 34.142).abs() < 1e-3, "{omega2}");
    let wrong = ["modes", "double.toml", "--svg", "n.svg", "--equilibrium", "7"];
    refused(&folder, &wrong, &[(&[], "there is no equilibrium")]);
}

#[test]
fn a_motion_has_the_same_bytes_for_any_number_of_threads() {
    let net = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [2, 0, 0] }, C = { at_m = [1, 2, 0] }, \
               P = { mass_kg = 1 }, Q = { mass_kg = 2 } }\n\
               bars = [{ from = \"A\", to = \"P\", length_m = 1.5, mass_kg = 1, count = 3 }, \
               { from = \"B\", to = \"P\", length_m = 1.5, mass_kg = 1, count = 2 }, \
               { from = \"C\", to = \"P\", length_m = 2, mass_kg = 1, stiffness_n = 1e3 }, \
               { from = \"P\", to = \"Q\", length_m = 1, mass_kg = 0.5 }]\n";
    let folder = holding([("net.toml", net)]);
    for (source, name) in [(&["net.toml"][..], "net"), (&["--case", "three-equal-bars"], "paper")] {
        let of = |threads: usize, extension: &str| {
            let file = format!("{name}-{threads}.{extension}");
            let mut arguments = vec!["simulate"];
            arguments.extend(source);
            arguments.extend(["--from", "seed:3", "--time", "1", "--damping", "0.3"]);
            arguments.extend(["--order", "4", "--out", &file]);
            let output = run(&folder, threads, &arguments);
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(0), "{said}");
            std::fs::read(folder.path().join(&file)).unwrap()
        };
        for extension in ["csv", "parquet"] {
            let one = of(1, extension);
            assert!(one.len() > 10_000);
            for threads in [2, 5] {
                assert_eq!(one, of(threads, extension), "{name}, {threads} threads");
            }
        }
    }
}

/// A weight on three elastic bars in the form of a tripod rests below its feet, and above them.
#[test]
fn of_two_stable_rests_each_release_is_given_its_own() {
    let tripod = "joints = { A = { at_m = [0.5, 0, 0] }, B = { at_m = [-0.25, 0.4330127018922193, 0] }, \
                  C = { at_m = [-0.25, -0.4330127018922193, 0] }, P = { mass_kg = 1 } }\n\
                  bars = [{ from = \"A\", to = \"P\", length_m = 0.7, mass_kg = 0, stiffness_n = 400 }, \
                  { from = \"B\", to = \"P\", length_m = 0.7, mass_kg = 0, stiffness_n = 400 }, \
                  { from = \"C\", to = \"P\", length_m = 0.7, mass_kg = 0, stiffness_n = 400 }]\n";
    let folder = holding([("tripod.toml", tripod)]);
    let arguments = ["simulate", "tripod.toml", "--seeds", "400", "--damping", "4", "--time", "30"];
    let more = ["--step", "0.005", "--format", "csv", "--out"];
    for (threads, out) in [("1", "one"), ("3", "three")] {
        let all = [&arguments[..], &more[..], &[out, "--threads", threads]].concat();
        let output = run(&folder, 2, &all);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    for name in ["manifest.json", "summary.json", "part-000000.csv"] {
        assert_eq!(read(&format!("one/{name}")), read(&format!("three/{name}")), "{name}");
    }
    let manifest: Value = serde_json::from_str(&read("one/manifest.json")).unwrap();
    let rests = manifest["equilibria"].as_array().unwrap();
    // Heights by bisection of 3 (EA/l) (L - l) z/L = -m g with L² = 1/4 + z².
    let left_n = |z: f64| {
        let length = z.hypot(0.5);
        3.0 * 400.0 / 0.7 * (length - 0.7) * z / length + 9.806_65
    };
    let mut heights = [[-1.0, -0.45], [0.4, 0.6]].map(|[mut low, mut high]: [f64; 2]| {
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if left_n(middle) > 0.0 { &mut high } else { &mut low }) = middle;
        }
        low
    });
    heights.sort_by(f64::total_cmp);
    assert_eq!(rests.len(), 2, "{rests:?}");
    for (rest, z) in rests.iter().zip(heights) {
        let found = rest["joints_m"][3][2].as_f64().unwrap();
        assert!((found - z).abs() < 1e-5, "{found} {z}");
    }
    // Each end has the energy of the rest that it is given: m g z and the three bars'.
    let energy = |z: f64| 9.806_65 * z + 1.5 * 400.0 / 0.7 * (z.hypot(0.5) - 0.7).powi(2);
    let rows = read("one/part-000000.csv");
    let mut counts = [0, 0];
    let outcomes = column(&rows, "motion_outcome");
    for (outcome, found) in outcomes.into_iter().zip(column(&rows, "motion_energy_j")) {
        let outcome = usize::from(outcome > 0.5);
        assert!((found - energy(heights[outcome])).abs() < 1e-6, "{outcome}: {found}");
        counts[outcome] += 1;
    }
    assert!(counts[0] + counts[1] == 400 && counts[0] > 100 && counts[1] > 40, "{counts:?}");
}

/// An ensemble that is interrupted keeps its parts, says so with 130, and goes on to the same
/// bytes.
#[cfg(unix)]
#[test]
fn an_interrupted_ensemble_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let release = ["simulate", "--case", "two-bars", "--seeds", "4000", "--damping", "3"];
    let more = ["--time", "2", "--step", "0.02", "--out"];
    let whole = [&release[..], &more[..], &["whole"]].concat();
    assert_eq!(run(&folder, 2, &whole).status.code(), Some(0));
    let part = [&release[..], &more[..], &["part", "--threads", "1"]].concat();
    let mut running = Running(program(folder.path(), &part).spawn().unwrap());
    // The first of four parts is there.
    let first = folder.path().join("part/part-000000.parquet");
    wait_until("no part appears", || first.exists());
    running.signal("TERM");
    assert_eq!(running.code(), Some(130));
    assert!(first.exists() && !folder.path().join("part/summary.json").exists());
    let go_on = [&part[..], &["--resume"]].concat();
    assert_eq!(run(&folder, 2, &go_on).status.code(), Some(0));
    for name in ["manifest.json", "summary.json", "part-000000.parquet", "part-000003.parquet"] {
        let of = |out: &str| std::fs::read(folder.path().join(out).join(name)).unwrap();
        assert_eq!(of("whole"), of("part"), "{name}");
    }
}

/// A motion that is interrupted keeps what is stored, says so and ends with 130.
#[cfg(unix)]
#[test]
fn an_interrupted_motion_keeps_what_is_done() {
    let folder = tempfile::tempdir().unwrap();
    // Hours of motion, stored each hundredth of a second.
    let arguments = ["simulate", "--case", "two-bars", "--from", "seed:1", "--time", "1e5"];
    let arguments = [&arguments[..], &["--store", "0.01", "--out", "m.csv"]].concat();
    let mut command = program(folder.path(), &arguments);
    let mut running = Running(command.stdout(Stdio::piped()).spawn().unwrap());
    // The file is begun when the interruption is caught already.
    wait_until("nothing is written", || !names(folder.path()).is_empty());
    std::thread::sleep(std::time::Duration::from_millis(200));
    running.signal("INT");
    assert_eq!(running.code(), Some(130));
    let mut text = String::new();
    running.0.stdout.take().unwrap().read_to_string(&mut text).unwrap();
    assert!(text.contains("s, interrupted,"), "{text}");
    let csv = std::fs::read_to_string(folder.path().join("m.csv")).unwrap();
    let rows: Vec<&str> = csv.lines().collect();
    let times = rows[1..].iter().map(|row| row.split(',').next().unwrap().parse::<f64>().unwrap());
    for (k, time_s) in times.enumerate() {
        assert!((time_s - 0.01 * k as f64).abs() < 1e-9 * (1.0 + time_s), "{k} {time_s}");
    }
    assert!(rows.len() > 10, "{}", rows.len());
}
