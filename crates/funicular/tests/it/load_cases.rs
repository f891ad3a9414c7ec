//! Load cases: each by both solvers, and the envelope over them.

use funicular::prelude::*;

use crate::run::{good, holding, run};

/// A pole of 2 m with 10 kg on its end that hangs from a ball joint, with gravity 10: under a side force F it
/// leans by F / 100, and pulls by the size of both.
const POLE: &str = "name = \"pole\"\ngravity_m_s2 = 10\nsafety = 2\n\
    joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 10 } }\n\
    bars = [{ from = \"A\", to = \"P\", length_m = 2, mass_kg = 0, strength_n = 300 }]\n\
    [[loads]]\nname = \"wind\"\njoint = \"P\"\nforce_n = [0, 75, 0]\n\
    [[cases]]\nname = \"still\"\nfactors = { permanent = 1.2 }\n\
    [[cases]]\nname = \"storm\"\nfactors = { wind = 1 }\n\
    [[cases]]\nname = \"gale\"\nfactors = { wind = 2, permanent = 2 }\n";

fn near(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() < 1e-9 * wanted.abs().max(1.0)
}

#[test]
fn a_pole_in_still_air_storm_and_gale() {
    let problem = Problem::parse(POLE, "pole.toml").unwrap();
    assert_eq!(problem.load_cases(), ["still", "storm", "gale"]);
    let found = Solve::new().load_cases(&problem).unwrap();
    let bar = &found.bars()[0];
    assert!(near(bar.least_n.value, 120.0) && bar.least_n.case == "still");
    assert!(near(bar.most_n.value, 250.0) && bar.most_n.case == "gale");
    let used = bar.utilisation.as_ref().unwrap();
    assert!(near(used.value, 250.0 / 300.0) && used.case == "gale");
    let support = &found.supports()[0];
    assert!(support.joint == "A" && near(support.most_n.value, 250.0));
    // 3-4-5: from 2 m below the anchor to 1.2 m beside it and 1.6 m below.
    let moves: Vec<f64> =
        found.cases().iter().map(|c| c.settled.as_ref().unwrap().moves_m).collect();
    let leans = 1.2_f64.hypot(0.4);
    assert!(near(moves[0], 0.0) && near(moves[1], leans) && near(moves[2], leans), "{moves:?}");
    assert_eq!(found.is_strong(), Some(false));
    assert!(found.is_decided() && !found.check_failed());
    let unfit = problem.in_case("calm").unwrap_err().to_string();
    assert!(unfit.contains("\"still\", \"storm\", \"gale\""), "{unfit}");
}

/// A rod of 2 m and 4 kg that is lifted by 50 N in its middle and carries 10 kg: of twice all of that it bears 180 N
/// at its top, 40 N less above its middle, 100 N more below it, and 200 N at its end.
#[test]
fn what_acts_along_a_bar_is_that_of_the_case() {
    let text = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 10 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 2, mass_kg = 4, strength_n = 220, \
        forces = [{ force_n = [0, 0, 50] }] }]\n\
        cases = [{ name = 'twice', factors = { permanent = 2 } }]";
    let problem = Problem::parse(text, "rod.toml").unwrap();
    let found = Solve::new().load_cases(&problem).unwrap();
    let bar = &found.bars()[0];
    assert!(near(bar.most_n.value, 240.0) && near(bar.least_n.value, 140.0), "{bar:?}");
    assert!(near(bar.utilisation.as_ref().unwrap().value, 240.0 / 220.0));
    // As the case says by itself.
    let alone = Solve::new().run(&problem.in_case("twice").unwrap()).unwrap();
    let along = alone.equilibria()[0].axial_force(alone.system(), 0);
    assert!(near(bar.most_n.value, along.most_n) && near(bar.least_n.value, along.least_n));
    let settled = found.cases()[0].settled.as_ref().unwrap();
    assert!(near(settled.weakest.unwrap().utilisation, 240.0 / 220.0));
}

/// What has no equilibrium in a case has one in the others.
/// An upright rope of 20 m, 100 N/m heavy and lifted by 90 N/m, with a float of 1000 N on its end: 800 N at its foot and
/// 1000 N at its top, whether the lift is a load of the bar, one by name, or a force that is spread. As one force in the middle
/// it would make 1800 N and -800 N of it.
#[test]
fn loads_a_metre_change_the_force_evenly() {
    let text = |bar: &str, loads: &str| {
        format!(
            "gravity_m_s2 = 10\njoints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{ force_n = [0, 0, 1000] }} }}\n\
             bars = [{{ from = 'A', to = 'P', length_m = 20, mass_kg = 200, kind = 'cable', strength_n = 1500{bar} }}]\n{loads}"
        )
    };
    let lift = "loads = [{ name = 'lift', bar = 1, force_n_per_m = [0, 0, 90] }]\n\
                cases = [{ name = 'sea', factors = { lift = 1 } }]";
    for (bar, loads) in [
        (", force_n_per_m = [0, 0, 90]", ""),
        (", forces = [{ force_n = [0, 0, 1800], spread = true }]", ""),
        ("", lift),
    ] {
        let problem = Problem::parse(&text(bar, loads), "rope.toml").unwrap();
        let again = Problem::parse(&problem.to_toml(), "again.toml").unwrap();
        assert_eq!(again, problem);
        let found = Solve::new().run(&again).unwrap();
        let along = found.equilibria()[0].axial_force(found.system(), 0);
        assert!(near(along.least_n, 800.0) && near(along.most_n, 1000.0), "{along:?}");
        if !loads.is_empty() {
            let bar = &Solve::new().load_cases(&problem).unwrap().bars()[0].clone();
            assert!(near(bar.least_n.value, 800.0) && near(bar.most_n.value, 1000.0), "{bar:?}");
        }
    }
    for (force, wrong) in [
        ("force_n = [0, 0, 9], spread = 1", "expected true or false"),
        ("force_n = [0, 0, 9], at_m = 4, spread = true", "`at_m`"),
    ] {
        let text = text(&format!(", forces = [{{ {force} }}]"), "");
        let error = Problem::parse(&text, "rope.toml").unwrap_err();
        assert!(format!("{error:?}{error}").contains(wrong), "{error:?}");
    }
}

#[test]
fn a_case_without_an_answer_leaves_the_others() {
    let text = POLE.replace("permanent = 1.2", "permanent = 0");
    let found = Solve::new().load_cases(&Problem::parse(&text, "pole.toml").unwrap()).unwrap();
    let reason = found.cases()[0].settled.as_ref().unwrap_err();
    assert_eq!(reason.outcome, funicular::Outcome::NoLoad);
    assert!(near(found.bars()[0].least_n.value, 125.0) && found.bars()[0].least_n.case == "storm");
    assert!(!found.is_decided() && found.is_strong() == Some(false));
}

/// What is required over a parameter.
type Wanted<'a> = &'a dyn Fn(f64) -> f64;

/// A number is what it is in the file: it acts by the factor of the case, and beside the loads.
#[test]
fn numbers_vary_beside_the_loads_of_a_case() {
    let pole = Problem::parse(POLE, "pole.toml").unwrap();
    let gale = pole.in_case("gale").unwrap();
    for (problem, [wind, factor]) in [(&pole, [75.0, 1.0]), (&gale, [150.0, 2.0])] {
        let pull =
            |force_n: f64, mass_kg: f64| (wind + factor * force_n).hypot(factor * 10.0 * mass_kg);
        let all: [(&str, f64, Wanted<'_>, f64); 3] = [
            (
                "joints.P.mass_kg",
                10.0,
                &|mass_kg| pull(0.0, mass_kg),
                100.0 * factor * factor * 10.0,
            ),
            ("joints.P.force_n.y", 0.0, &|force_n| pull(force_n, 10.0), wind * factor),
            // Half of it hangs on the middle.
            (
                "bars.1.mass_kg",
                0.0,
                &|mass_kg| pull(0.0, 10.0 + 0.5 * mass_kg),
                500.0 * factor * factor,
            ),
        ];
        let derivatives = Derivatives::new().run(problem).unwrap();
        let gradient = derivatives.gradient("bars.1.axial_n").unwrap();
        for (parameter, own, wanted, slope) in all {
            let values = [own, own + 1.5];
            let vary = format!("{parameter}={},{}", values[0], values[1]);
            let study = Study::new().vary(&vary).unwrap().of("bars.1.axial_n");
            let found = study.run(problem).unwrap();
            let pulls: Vec<f64> = found.shapes().map(|shape| shape.of[0].unwrap()).collect();
            assert!(pulls.len() == 2 && near(pulls[0], wanted(values[0])), "{vary}: {pulls:?}");
            assert!(near(pulls[1], wanted(values[1])), "{vary}: {pulls:?}");
            let trace = Trace::new().vary(&format!("{parameter}={own}..{}", values[1])).unwrap();
            let found = trace.run(problem).unwrap();
            let points = &found.load_paths().unwrap().paths()[0].points;
            let [first, last] =
                [points.first(), points.last()].map(|point| point.unwrap().axial_n[0]);
            assert!(near(first, wanted(own)) && near(last, wanted(values[1])), "{first} {last}");
            let slope = slope / pull(0.0, 10.0);
            assert!(near(gradient.by(parameter).unwrap().value, slope), "{parameter}: {gradient}");
            let change = derivatives.change(parameter).unwrap();
            assert!(near(change.axial_n[0], slope), "{parameter}: {change:?}");
        }
    }
}

/// 5 kg and 3 kg of snow; in winter the first by 1.5. A number that is changed stands beside both, at once or one after the
/// other, and before the case or in it.
#[test]
fn loads_and_cases_stay_when_numbers_change() {
    let text = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 5 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 2, mass_kg = 0 }]\n\
        loads = [{ name = 'snow', joint = 'P', mass_kg = 3 }]\n\
        cases = [{ name = 'winter', factors = { permanent = 1.5, snow = 1 } }]";
    let problem = Problem::parse(text, "bar.toml").unwrap();
    let pull = |problem: &Problem| Solve::new().run(problem).unwrap().equilibria()[0].axial_n[0];
    let longer = |problem: &Problem| problem.with(&[("bars.1.length_m", 4.0)]).unwrap();
    let heavier = |problem: &Problem| problem.with(&[("joints.P.mass_kg", 6.0)]).unwrap();
    let winter = |problem: &Problem| problem.in_case("winter").unwrap();
    assert!(near(pull(&winter(&problem)), 105.0));
    for both in [heavier(&longer(&problem)), longer(&heavier(&problem))] {
        assert!(near(pull(&both), 90.0), "{}", pull(&both));
        assert!(near(pull(&winter(&both)), 120.0));
    }
    assert!(near(pull(&heavier(&longer(&winter(&problem)))), 120.0));
    let doubled = problem.with(&[("loads", 2.0)]).unwrap();
    assert!(near(pull(&doubled), 160.0) && near(pull(&winter(&doubled)), 210.0));
    assert!(near(pull(&heavier(&doubled)), 120.0));
    assert_eq!(problem.with(&[("gravity_m_s2", 10.0)]).unwrap(), problem);
    let cases = Solve::new().load_cases(&longer(&problem)).unwrap();
    assert!(near(cases.bars()[0].most_n.value, 105.0));
}

#[test]
fn every_command_takes_a_load_case() {
    let folder = holding([("pole.toml", POLE)]);
    let bare = POLE.split("[[loads]]").next().unwrap();
    std::fs::write(folder.path().join("bare.toml"), bare).unwrap();
    let text = good(&folder, &["solve", "pole.toml", "--load-case", "each"]);
    let worst = "Worst: in gale the member from A to P is at 83.3 % of its strength.\n";
    assert!(text.ends_with(worst), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    // Names that do not fit beside the numbers stand below them.
    let long = POLE.replace("\"gale\"", "\"a gale from the north-west\"");
    std::fs::write(folder.path().join("long.toml"), long).unwrap();
    let text = good(&folder, &["solve", "long.toml", "--load-case", "each"]);
    assert!(text.contains("a gale from the north-west") && text.contains("\nCases: 1 "), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    let checked = |case| run(&folder, &["solve", "pole.toml", "--load-case", case, "--check"]).0;
    assert_eq!([checked("each"), checked("storm"), checked("gale")], [Some(1), Some(0), Some(1)]);
    // The pendulum by 125 N on 10 kg and 2 m: omega^2 = 6.25 1/s^2, in both directions.
    let (_, text, _) = run(&folder, &["modes", "pole.toml", "--load-case", "storm"]);
    assert!(text.contains("pole, storm") && text.matches(" 6.25 ").count() == 2, "{text}");
    for (command, more) in [
        ("census", &[][..]),
        ("study", &["--vary", "gravity_m_s2=10"]),
        ("derivatives", &["--of", "bars.1.axial_n"]),
    ] {
        let text = good(&folder, &[&[command, "pole.toml", "--load-case", "gale"], more].concat());
        assert!(text.contains("250"), "{command}: {text}");
    }
    for arguments in [
        &["solve", "pole.toml", "--load-case", "calm"][..],
        &["modes", "pole.toml", "--load-case", "each"],
        &["solve", "bare.toml", "--load-case", "each"],
        &["solve", "bare.toml", "--load-case", "storm"],
        &["solve", "pole.toml", "--load-case", "each", "--svg", "a.svg"],
        &["solve", "pole.toml", "--load-case", "each", "--summary"],
        &["solve", "pole.toml", "--load-case", "each", "--without", "each"],
        &["solve", "pole.toml", "pole.toml", "--load-case", "each"],
    ] {
        let (code, text, said) = run(&folder, arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {text}{said}");
        assert!(said.contains("load") && said.contains("case"), "{arguments:?}: {said}");
    }
    assert!(!folder.path().join("a.svg").exists());
    // Several files, each in the case.
    let (code, text, _) =
        run(&folder, &["solve", "pole.toml", "pole.toml", "--load-case", "storm"]);
    assert_eq!((code, text.matches("pole, storm").count()), (Some(0), 2), "{text}");
}
