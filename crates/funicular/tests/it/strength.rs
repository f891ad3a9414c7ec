//! What bars bear, and how much of it they use: against closed forms.

#![expect(clippy::format_push_string, reason = "helpers of tests")]

use funicular::{Loss, Outcome, Weakest, prelude::*};

use crate::run::{good, holding, refused, run};

/// 300 N hang on two threads of 5 m between anchors 8 m apart, 3 m below them: each pulls with 250 N.
fn bridle(root: &str, first: &str, second: &str) -> String {
    format!(
        "name = \"bridle\"\ngravity_m_s2 = 10\n{root}\n\
         joints = {{ A = {{ at_m = [-4, 0, 0] }}, B = {{ at_m = [4, 0, 0] }}, P = {{ mass_kg = 30 }} }}\n\
         [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\n{first}\n\
         [[bars]]\nfrom = \"B\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\n{second}\n"
    )
}

fn weakest(text: &str) -> Weakest {
    let problem =
        Problem::parse(text, "system.toml").unwrap_or_else(|error| panic!("{error}\n{text}"));
    let answer = Solve::new().run(&problem).unwrap();
    let all = answer.equilibria().iter().map(|e| Weakest::of(answer.system(), e).unwrap());
    let all: Vec<_> = all.collect();
    // By both solvers; a safety may be infinite.
    let differ = |one: &Weakest| (one.safety.atan() - all[0].safety.atan()).abs();
    assert!(all.iter().all(|one| differ(one) < 1e-9 && one.bar == all[0].bar), "{all:?}");
    all[0]
}

/// The safety that is required decides which bar is weakest, not the part of the strength alone.
#[test]
fn the_weakest_bar_is_the_one_that_is_nearest_to_the_safety_wanted() {
    for (root, first, second, wanted) in [
        ("", "strength_n = 1000", "strength_n = 500", (1, 0.5, 1.0)),
        ("", "strength_n = 1000\nsafety = 3", "strength_n = 500", (0, 0.25, 3.0)),
        ("safety = 3", "strength_n = 1000", "strength_n = 500", (1, 0.5, 3.0)),
        ("safety = 3", "strength_n = 1000\nsafety = 7", "strength_n = 500", (0, 0.25, 7.0)),
        // What has no strength is not judged; a strength in compression says nothing of a tension.
        ("", "", "strength_n = 100", (1, 2.5, 1.0)),
        ("", "compression_n = 1", "strength_n = 1000", (1, 0.25, 1.0)),
    ] {
        let found = weakest(&bridle(root, first, second));
        assert_eq!((found.bar, found.safety_wanted), (wanted.0, wanted.2), "{first} {second}");
        assert!((found.utilisation - wanted.1).abs() < 1e-12, "{found:?}");
        assert!((found.safety - wanted.1.recip()).abs() < 1e-11, "{found:?}");
    }
}

/// A cable of 3 m and 1 kg, just as long as it is above the floor that bears the 4 kg on it: taut, whichever side
/// rounding falls, it bears half of its weight of 10 N at its top, 250 % of 2 N; one that does not stretch may bear the weight
/// of 40 N and all of its own. A millimetre longer it is slack.
#[test]
fn a_cable_that_is_just_taut_bears_its_own_weight() {
    let text = |length_m: f64, stiffness: &str| {
        format!(
            "floor_m = -3\ngravity_m_s2 = 10\njoints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{ mass_kg = 4 }} }}\n\
             bars = [{{ from = 'A', to = 'P', length_m = {length_m}, mass_kg = 1, kind = 'cable', strength_n = 2{stiffness} }}]"
        )
    };
    for (stiffness, used) in [("", 25.0), (", stiffness_n = 1e4", 2.5)] {
        let taut = weakest(&text(3.0, stiffness));
        assert!((taut.utilisation - used).abs() < 1e-6, "{stiffness} {taut:?}");
        assert!(weakest(&text(3.001, stiffness)).utilisation.abs() <= 0.0, "{stiffness}");
    }
}

/// Two bays with a diagonal cable each, pushed by 6 N: together they bear it, and the heavy one, which need not bear anything, all
/// of it at most, with half of its own weight along it at its upper end.
#[test]
fn what_may_become_taut_bears_its_own_weight_too() {
    let mut file = "plane = \"xz\"\n[joints]\n".to_owned();
    for (name, x, force_n) in [("0", 0, [226, 24]), ("1", 3, [0, -1200]), ("2", 6, [-232, -600])] {
        let [right, up] = force_n;
        file += &format!("A{name} = {{ at_m = [{x}, 0, 0] }}\n");
        file += &format!("B{name} = {{ near_m = [{x}, 0, 3], force_n = [{right}, 0, {up}] }}\n");
    }
    let bars = [("A0", "B0"), ("A1", "B1"), ("A2", "B2"), ("B0", "B1"), ("B1", "B2")];
    for (from, to) in bars {
        file += &format!("[[bars]]\nfrom = \"{from}\"\nto = \"{to}\"\nmass_kg = 0\n");
    }
    file += "[[bars]]\nfrom = \"A1\"\nto = \"B0\"\nmass_kg = 0\nkind = \"cable\"\n";
    file +=
        "[[bars]]\nfrom = \"A2\"\nto = \"B1\"\nmass_kg = 3\nkind = \"cable\"\nstrength_n = 15\n";
    let problem = Problem::parse(&file, "bays.toml").unwrap();
    let answer = Solve::new().run(&problem).unwrap();
    let by_lagrange = Weakest::of(answer.system(), &answer.equilibria()[0]).unwrap();
    let wanted_n = 72.0_f64.sqrt() + 3.0 * 9.80665 / 8.0_f64.sqrt();
    assert!((by_lagrange.utilisation - wanted_n / 15.0).abs() < 1e-9, "{by_lagrange:?}");
}

/// The same bars stand on the anchors and push: they break by their compression, or buckle by Euler's
/// formula, which knows of 5 m and EI.
#[test]
fn bars_that_push_break_or_buckle() {
    let standing = |first: &str, second: &str| {
        bridle("", first, second)
            .replace("P = { mass_kg = 30", "P = { near_m = [0, 0, 3], mass_kg = 30")
    };
    let found = weakest(&standing("compression_n = 500\nstrength_n = 1", "compression_n = 2000"));
    assert_eq!(found.bar, 0);
    assert!((found.utilisation - 0.5).abs() < 1e-12, "{found:?}");
    let found = weakest(&standing("bending_n_m2 = 1000", "compression_n = 2000"));
    let euler_n = (std::f64::consts::PI / 5.0).powi(2) * 1000.0;
    assert!((found.utilisation - 250.0 / euler_n).abs() < 1e-12, "{found:?}");
}

/// The weight of a rope that hangs down is part of its force where it is largest: at its upper end.
#[test]
fn the_own_weight_counts() {
    let found = weakest(
        "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2 } }\n\
         bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 1, strength_n = 60 }]",
    );
    assert!((found.utilisation - 0.5).abs() < 1e-12, "{found:?}");
}

/// Three rigid members of this kind from the level of their anchors to 300 N 4 m below.
fn three(kind: &str) -> String {
    let bar = |from: &str, length_m: f64| {
        format!(
            "{{ from = \"{from}\", to = \"P\", kind = \"{kind}\", length_m = {length_m}, mass_kg = 0, \
             strength_n = 400 }}"
        )
    };
    format!(
        "gravity_m_s2 = 10\nplane = \"xz\"\n\
         joints = {{ A = {{ at_m = [-3, 0, 0] }}, M = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [3, 0, 0] }}, \
         P = {{ mass_kg = 30 }} }}\nbars = [{}, {}, {}]",
        bar("A", 5.0),
        bar("M", 4.0),
        bar("B", 5.0)
    )
}

/// Three rigid members hold a joint in one plane: with s and m the forces of the outer ones and of the one in
/// the middle balance says 2 · 4/5 s + m = 300 N, and nothing else. Cables never push: m is 300 N at most. Of bars
/// nothing bounds the force, and what nothing bounds is not safe, whatever the solvers show.
#[test]
fn forces_that_balance_leaves_open_are_counted_at_their_worst() {
    let found = weakest(&three("cable"));
    assert_eq!(found.bar, 1);
    assert!((found.utilisation - 0.75).abs() < 1e-9, "{found:?}");
    let found = weakest(&three("bar"));
    assert!(found.utilisation.is_infinite() && !found.suffices(), "{found:?}");
}

/// A chain with strengths is solved like one without.
#[test]
fn a_chain_with_strengths_is_the_same_chain() {
    let chain = |keys: &str| {
        let text = format!(
            "name = \"chain\"\nanchors = {{ start_m = [0, 0, 0], end_m = [2, 0, 0] }}\n\
             bars = [{{ length_m = 1.5, mass_kg = 1{keys} }}, {{ length_m = 0.5, mass_kg = 2, count = 3 }}]"
        );
        let answer = Solve::new().run(&Problem::parse(&text, "chain.toml").unwrap()).unwrap();
        let all = answer.equilibria().iter();
        let all: Vec<_> = all.map(|e| (e.joints_m.clone(), e.axial_n.clone())).collect();
        (all, answer.rung(), answer.is_strong())
    };
    let [bare, strong] = ["", ", strength_n = 100"].map(chain);
    assert_eq!((bare.0, bare.1), (strong.0, strong.1));
    assert_eq!((bare.2, strong.2), (None, Some(true)));
}

/// Loads at one place of a bar act as one, in whatever order they stand: nothing of it is between them.
#[test]
fn loads_at_one_place_are_one() {
    for [first, second] in [[50, -50], [-50, 50]] {
        let text = format!(
            "gravity_m_s2 = 10\njoints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{ mass_kg = 10 }} }}\n\
             bars = [{{ from = 'A', to = 'P', length_m = 2, mass_kg = 0, strength_n = 120, forces = [\
             {{ force_n = [0, 0, {first}], at_m = 1 }}, {{ force_n = [0, 0, {second}], at_m = 1 }}] }}]"
        );
        let found = weakest(&text);
        assert!((found.utilisation - 100.0 / 120.0).abs() < 1e-12, "{found:?}");
    }
}

/// A bar fewer and a truss folds, a rope fewer and a bridle hangs elsewhere: which of its bars are meant
/// stays as it was, and joints that nothing holds any more are gone with it.
#[test]
fn losses_are_survived_or_not() {
    let losses = |text: &str| {
        Solve::new().without_each(&Problem::parse(text, "system.toml").unwrap()).unwrap()
    };
    let found = losses(&bridle("safety = 2", "strength_n = 1000", "strength_n = 500"));
    // All 300 N hang on the other rope.
    let outcome = |loss: &Loss| {
        let left = loss.left.as_ref().unwrap();
        let weakest = left.weakest.unwrap();
        (loss.bar, weakest.bar, (1e9 * weakest.utilisation).round() / 1e9, left.is_strong())
    };
    let all: Vec<_> = found.losses().iter().map(outcome).collect();
    assert_eq!(all, [(0, 1, 0.6, Some(false)), (1, 0, 0.3, Some(true))]);
    assert!(!found.survives() && found.is_decided() && !found.check_failed());
    let strong = losses(&bridle("safety = 2", "strength_n = 1000", "strength_n = 600"));
    assert!(strong.survives());
    // What has no strength survives where all of it hangs.
    assert!(losses(&bridle("", "", "")).survives());
    let truss = "plane = \"xz\"\njoints = { A = { at_m = [0, 0, 0] }, B = { at_m = [2, 0, 0], free = \"x\" }, \
                 C = { near_m = [1, 0, 1], mass_kg = 100 } }\n\
                 bars = [{ from = \"A\", to = \"B\", mass_kg = 0 }, { from = \"A\", to = \"C\", mass_kg = 0 }, \
                 { from = \"B\", to = \"C\", mass_kg = 0 }]";
    let found = losses(truss);
    assert!(found.losses().iter().all(|loss| {
        loss.left
            .as_ref()
            .is_err_and(|why| [Outcome::Leaves, Outcome::Falls].contains(&why.outcome))
    }));
    assert!(!found.survives() && found.is_decided(), "{found}");
}

/// A mast of 10 m on three guys: without it the guys have one shape left, upside down, which no structure survives. A load
/// that is drawn on two ropes hangs on the other one.
#[test]
fn what_hangs_upside_down_has_left_its_drawing() {
    let losses = |text: &str| {
        Solve::new().without_each(&Problem::parse(text, "system.toml").unwrap()).unwrap()
    };
    let guys = ["[6, 0, 0]", "[-3, 5, 0]", "[-3, -5, 0]"].map(|at| {
        let rope = "kind = 'cable', stiffness_n = 1e6, mass_kg = 0";
        format!("{{ from = 'top', to = '{at}', {rope} }}")
    });
    let anchors =
        ["[6, 0, 0]", "[-3, 5, 0]", "[-3, -5, 0]"].map(|at| format!("'{at}' = {{ at_m = {at} }}"));
    let mast = format!(
        "joints = {{ foot = {{ at_m = [0, 0, 0] }}, top = {{ near_m = [0, 0, 10], mass_kg = 500 }}, {} }}\n\
         bars = [{{ from = 'foot', to = 'top', mass_kg = 10 }}, {}]",
        anchors.join(", "),
        guys.join(", ")
    );
    let found = losses(&mast);
    let outcome = |k: usize| found.losses()[k].left.as_ref().err().map(|why| why.outcome);
    assert_eq!(outcome(0), Some(Outcome::Leaves), "{found}");
    assert!(!found.survives());
    let drawn = bridle("", "kind = 'cable'", "kind = 'cable'")
        .replace("P = {", "P = { near_m = [0, 0, -3],");
    assert!(losses(&drawn).survives());
}

/// What weighs may be lost itself: then nothing is left to fall.
#[test]
fn what_weighs_may_be_lost() {
    let bars = "bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 1 }, \
                { from = 'B', to = 'P', length_m = 1, mass_kg = 0 }]";
    let two = format!(
        "joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [1, 0, 0] }}, P = {{}} }}\n{bars}"
    );
    let one = "joints = { A = { at_m = [0, 0, 0] }, P = {} }\n\
               bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 1 }]";
    for text in [&two, one] {
        let found =
            Solve::new().without_each(&Problem::parse(text, "system.toml").unwrap()).unwrap();
        let outcomes: Vec<_> = found
            .losses()
            .iter()
            .map(|loss| loss.left.as_ref().err().map(|why| why.outcome))
            .collect();
        assert_eq!(outcomes[0], Some(Outcome::NoLoad));
        assert!(outcomes[1..].iter().all(Option::is_none));
        assert!(found.survives() && found.is_decided());
    }
}

/// The words for what becomes of each, and the exit codes.
#[test]
fn the_program_loses_each_bar_in_turn() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    file("weak.toml", bridle("safety = 2", "strength_n = 1000", "strength_n = 500"));
    let text = good(&folder, &["solve", "weak.toml", "--without", "each"]);
    let said = "A part falls after 0 of 2 losses, a member is too weak after 1.\n\
                Worst: without A to P the member from B to P is at 60 % of its strength.\n";
    assert!(text.ends_with(said), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    assert_eq!(run(&folder, &["solve", "weak.toml", "--without", "each", "--check"]).0, Some(1));
    for more in [&["--svg", "a.svg"][..], &["weak.toml"], &["--csv", "a.csv"]] {
        let (code, _, said) =
            run(&folder, &[&["solve", "weak.toml", "--without", "each"], more].concat());
        assert_eq!(code, Some(2));
        assert!(said.contains("--without"), "{said}");
    }
    assert!(!folder.path().join("a.svg").exists());
}

/// A gable that is pushed by its load has strengths in tension alone: nothing judges it, and that is said. With one in compression
/// it is judged.
#[test]
fn a_force_without_a_strength_is_named() {
    let gable = |strength: &str| {
        format!(
            "gravity_m_s2 = 10\njoints = {{ A = {{ at_m = [-4, 0, 0] }}, B = {{ at_m = [4, 0, 0] }}, \
             P = {{ near_m = [0, 0, 3], mass_kg = 30 }} }}\n\
             bars = [{{ from = 'A', to = 'P', mass_kg = 0, {strength} }}, {{ from = 'B', to = 'P', mass_kg = 0 }}]"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let said = |strength: &str| {
        std::fs::write(folder.path().join("gable.toml"), gable(strength)).unwrap();
        let (_, text, _) = run(&folder, &["solve", "gable.toml"]);
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let unjudged = "Not judged: compression of up to 250 N, in the member from A to P, which has no \
                    compression_n or bending_n_m2.";
    let text = said("strength_n = 1000");
    assert!(text.contains(unjudged) && !text.contains("Weakest"), "{text}");
    let text = said("compression_n = 1000");
    assert!(
        text.contains("Weakest: member from A to P, at 25 %") && !text.contains("Not judged"),
        "{text}"
    );
}

/// Places to six digits say little of the forces of stiff bars: those of the equilibrium next to them count, two crossed cables with
/// the prestress of 200 N.
#[test]
fn an_answer_without_forces_is_as_strong_as_its_equilibrium() {
    let text = "gravity_m_s2 = 10\nplane = 'xz'\n\
        joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [3, 0, 0] }, C = { near_m = [3, 0, 4] }, D = { near_m = [0, 0, 4], mass_kg = 1 } }\n\
        bars = [{ from = 'A', to = 'D', mass_kg = 0, stiffness_n = 1e9 }, { from = 'B', to = 'C', mass_kg = 0, stiffness_n = 1e9 },\n\
        { from = 'D', to = 'C', mass_kg = 0, stiffness_n = 1e9 },\n\
        { from = 'A', to = 'C', mass_kg = 0, kind = 'cable', stiffness_n = 1e9, prestress_n = 1000, strength_n = 100 },\n\
        { from = 'B', to = 'D', mass_kg = 0, kind = 'cable', stiffness_n = 1e9, prestress_n = 1000, strength_n = 100 }]";
    let problem = Problem::parse(text, "bay.toml").unwrap();
    let solved = Solve::new().run(&problem).unwrap();
    let wanted = Weakest::of(solved.system(), &solved.equilibria()[0]).unwrap();
    let rows = solved.system().joints().iter().zip(&solved.equilibria()[0].joints_m);
    let rows = rows.map(|(joint, [x, y, z])| format!("{},{x:.7},{y:.7},{z:.7}\n", joint.name));
    let table = "joint,x_m,y_m,z_m\n".to_owned() + &rows.collect::<String>();
    let answer = funicular::judge::parse(&table, "places.csv").unwrap();
    let answer = funicular::judge::fit(&problem.system(), answer[0].clone()).unwrap();
    let judged = Judge::new().run(&problem, &answer).unwrap();
    let found = judged.weakest().unwrap();
    assert!(wanted.utilisation > 1.0 && judged.judgement().is_confirmed());
    assert!((found.utilisation / wanted.utilisation - 1.0).abs() < 1e-6, "{found:?} {wanted:?}");
}

/// Exit code 1 with `--check` alone, and where there is nothing to check a word about it.
#[test]
fn the_program_says_which_bar_is_weakest() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    file("weak.toml", bridle("safety = 2", "strength_n = 1000", "strength_n = 300"));
    file("strong.toml", bridle("safety = 2", "strength_n = 1000", "strength_n = 600"));
    file("bare.toml", bridle("", "", ""));
    let text = good(&folder, &["solve", "weak.toml"]);
    let line = "Weakest: member from B to P, at 83.3 % of its strength: safety 1.2, below 2.\n";
    assert!(text.contains(line), "{text}");
    assert_eq!(run(&folder, &["solve", "weak.toml", "--check"]).0, Some(1));
    // In a picture the one that is too weak is marked, and each has its part beside its force.
    for (name, marked) in [("weak", true), ("strong", false), ("bare", false)] {
        let (system, picture) = (format!("{name}.toml"), format!("{name}.svg"));
        assert_eq!(run(&folder, &["solve", &system, "--svg", &picture]).0, Some(0));
        let drawn = std::fs::read_to_string(folder.path().join(picture)).unwrap();
        assert_eq!(
            [drawn.contains("class=\"weak\""), drawn.contains("too weak")],
            [marked; 2],
            "{name}"
        );
        let labels = ["250 N, 25 %", "250 N, 83.33 %"].map(|label| drawn.contains(label));
        assert_eq!(labels, [name != "bare", marked], "{name}");
    }
    let text = good(&folder, &["solve", "strong.toml", "--check"]);
    assert!(text.contains("at 41.7 % of its strength: safety 2.4, 2 required.\n"), "{text}");
    assert_eq!(run(&folder, &["solve", "strong.toml", "weak.toml", "--check"]).0, Some(1));
    for files in [&["bare.toml"][..], &["strong.toml", "bare.toml"]] {
        let (code, _, said) = run(&folder, &[&["solve", "--check"], files].concat());
        assert_eq!(code, Some(2));
        assert!(said.contains("--check: no bar of this system has a strength_n"), "{said}");
    }
    // 30, 36 and 40 kg: 250, 300 and 333 N.
    let study =
        ["study", "weak.toml", "--vary", "joints.P.mass_kg=30,36,40", "--of", "utilisation"];
    let text = good(&folder, &[&study[..], &["--csv", "/dev/stdout"]].concat());
    let used: Vec<f64> = text
        .lines()
        .filter_map(|line| line.split(',').rev().find_map(|x| x.parse().ok()))
        .collect();
    assert!(text.contains("utilisation") && !used.is_empty(), "{text}");
    let bare = ["bare.toml", "--vary", "gravity_m_s2=9,10", "--of", "bars.2.utilisation"];
    refused(&folder, &["study"], &[(&bare, "bar 2 has no strength")]);
}

/// The forces of an answer from elsewhere are held against the strengths as those of a solver are: 250 N on each thread,
/// given or found; and under the loads of a case.
#[test]
fn answers_from_elsewhere_are_as_strong_as_their_forces() {
    let folder = tempfile::tempdir().unwrap();
    let cases = "[[loads]]\nname = \"snow\"\njoint = \"P\"\nmass_kg = 15\n\
                 [[cases]]\nname = \"summer\"\nfactors = {}\n\
                 [[cases]]\nname = \"winter\"\nfactors = { snow = 2 }\n";
    for (name, root, second) in [
        ("weak", "safety = 2", "strength_n = 300"),
        ("strong", "safety = 2", "strength_n = 600"),
        ("bare", "", ""),
    ] {
        let first = if second.is_empty() { "" } else { "strength_n = 2000" };
        let text = bridle(root, first, second);
        std::fs::write(folder.path().join(format!("{name}.toml")), &text).unwrap();
        std::fs::write(folder.path().join(format!("{name}-cases.toml")), text + cases).unwrap();
    }
    std::fs::write(folder.path().join("places.csv"), "joint,x_m,y_m,z_m\nP,0,0,-3\n").unwrap();
    std::fs::write(folder.path().join("forces.csv"), "from,to,axial_n\nA,P,250\nB,P,250\n")
        .unwrap();
    let judge = |arguments: &[&str]| {
        run(&folder, &[&["judge"], arguments, &["--answer", "places.csv"]].concat())
    };
    let members = ["--members", "forces.csv"];
    for more in [&[][..], &members] {
        let (code, text, _) = judge(&[&["weak.toml"], more].concat());
        assert_eq!(code, Some(0), "{text}");
        let line = "Weakest: member from B to P, at 83.3 % of its strength: safety 1.2, below 2.\n";
        assert!(text.contains(line), "{text}");
        let checked = ["weak.toml", "strong.toml", "bare.toml"]
            .map(|file| judge(&[&[file, "--check"], more].concat()).0);
        assert_eq!(checked, [Some(1), Some(0), Some(2)]);
    }
    let (_, _, said) = judge(&["bare.toml", "--check"]);
    assert!(said.contains("--check: no bar of this system has a strength_n"), "{said}");
    // Without snow as above, and with 30 kg more twice as much: 500 N are 83.3 % of 600 N.
    let (code, text, _) = judge(&["strong-cases.toml", "--load-case", "summer", "--check"]);
    assert!(code == Some(0) && text.contains("at 41.7 %"), "{text}");
    let (code, text, _) = judge(&["strong-cases.toml", "--load-case", "winter", "--check"]);
    assert!(code == Some(1) && text.contains("at 83.3 %"), "{text}");
    let given = [&["strong-cases.toml", "--load-case", "winter"], &members[..]].concat();
    let (code, text, _) = judge(&given);
    assert!(code == Some(1) && text.contains("are left over"), "{text}");
    let (code, _, said) = judge(&["strong-cases.toml", "--load-case", "spring"]);
    assert!(code == Some(2) && said.contains("no load case \"spring\""), "{said}");
    // On the page too.
    let (code, ..) = judge(&["weak.toml", "--html", "verdict.html"]);
    let page = std::fs::read_to_string(folder.path().join("verdict.html")).unwrap();
    assert_eq!(code, Some(0));
    assert!(page.contains("at 83.3 % of its strength") && page.contains("class=\"weak\""));
}

/// Places without forces, where balance leaves these open: what nothing bounds is not strong.
#[test]
fn forces_that_are_found_and_open_are_counted_at_their_worst() {
    let folder = holding([("places.csv", "joint,x_m,y_m,z_m\nP,0,0,-4\n")]);
    let forces = "from,to,axial_n\nA,P,75\nM,P,180\nB,P,75\n";
    std::fs::write(folder.path().join("forces.csv"), forces).unwrap();
    for (kind, found, given) in [
        ("cable", "at 75 % of its strength", "at 45 %"),
        ("bar", "whose force has no bound", "at 45 %"),
    ] {
        std::fs::write(folder.path().join("three.toml"), three(kind)).unwrap();
        let judge = ["judge", "three.toml", "--answer", "places.csv"];
        let (code, text, _) = run(&folder, &judge);
        assert!(code == Some(0) && text.contains(found), "{text}");
        // Forces that are given are those that are judged.
        let (code, text, _) = run(&folder, &[&judge[..], &["--members", "forces.csv"]].concat());
        assert!(code == Some(0) && text.contains(given), "{text}");
    }
}

/// A ship that slides, drawn aside against a line of two cables: without either of them nothing holds it.
#[test]
fn what_slides_away_for_ever_after_a_loss_falls() {
    let text = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 }, \
         ship = { at_m = [3, 0, 2], free = \"x\", force_n = [1000, 0, 0] } }\n\
         bars = [{ from = \"A\", to = \"P\", length_m = 3, mass_kg = 1, kind = \"cable\" }, \
         { from = \"P\", to = \"ship\", length_m = 3, mass_kg = 1, kind = \"cable\" }]\n";
    let found = Solve::new().without_each(&Problem::parse(text, "ship.toml").unwrap()).unwrap();
    for loss in found.losses() {
        assert_eq!(loss.left.as_ref().unwrap_err().outcome, Outcome::Falls, "{loss:?}");
    }
}

/// A prestressed line is limp without either half; an arch of two triangles stands on three hinges, and without a tie
/// the equilibrium next to it is one of two hinges too many.
#[test]
fn what_is_limp_or_unstable_after_a_loss_leaves() {
    let line = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [4, 0, 0] }, P = { near_m = [2, 0, 0] } }\n\
                bars = [{ from = 'A', to = 'P', mass_kg = 0, stiffness_n = 1e3, prestress_n = 10 }, \
                { from = 'P', to = 'B', mass_kg = 0, stiffness_n = 1e3, prestress_n = 10 }]";
    let arch = "plane = 'xz'\njoints = { A = { at_m = [0, 0, 0] }, B = { at_m = [20, 0, 0] }, \
                top = { near_m = [10, 0, 5], mass_kg = 3000 }, P = { near_m = [5, 0, 4.2], mass_kg = 1000 }, \
                Q = { near_m = [15, 0, 4.2], mass_kg = 800 } }\n\
                bars = [{ from = 'A', to = 'P', mass_kg = 400 }, { from = 'P', to = 'top', mass_kg = 400 }, \
                { from = 'top', to = 'Q', mass_kg = 400 }, { from = 'Q', to = 'B', mass_kg = 400 }, \
                { from = 'A', to = 'top', mass_kg = 600 }, { from = 'B', to = 'top', mass_kg = 600 }]";
    for (text, ties) in [(line, [0, 1]), (arch, [4, 5])] {
        let problem = Problem::parse(text, "system.toml").unwrap();
        let found = Solve::new().without_each(&problem).unwrap();
        for tie in ties {
            let why = found.losses()[tie].left.as_ref().unwrap_err();
            assert_eq!(why.outcome, Outcome::Leaves, "{why:?}");
            let reason = ["decides the shape", "is unstable"][tie / 4];
            assert!(why.reason.ends_with(reason), "{why:?}");
        }
        assert!(!found.survives() && found.is_decided());
    }
}

/// A weight on a level support of its own stays there when the cable to it is lost.
#[test]
fn what_stands_on_its_own_support_does_not_fall() {
    let text = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [4, 0, 0] }, P = { mass_kg = 5 }, \
        S = { at_m = [2, 1, 0], free = 'xy', mass_kg = 10 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 2.5, mass_kg = 0, kind = 'cable' }, \
        { from = 'P', to = 'B', length_m = 2.5, mass_kg = 0, kind = 'cable' }, \
        { from = 'P', to = 'S', length_m = 2, mass_kg = 0, kind = 'cable' }]";
    let losses = Solve::new().without_each(&Problem::parse(text, "roller.toml").unwrap()).unwrap();
    // 3-4-5: P hangs 1.5 m deep, and its cables bear 5 g / 2 times 2.5 m / 1.5 m.
    let left = losses.losses()[2].left.as_ref().unwrap();
    let (_, tension_n) = left.extremes.tension_n.unwrap();
    assert!((tension_n / (2.5 * 9.80665 * 2.5 / 1.5) - 1.0).abs() < 1e-9, "{tension_n}");
}
