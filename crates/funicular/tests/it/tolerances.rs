//! Ranges over tolerances, against what both solvers find of systems within them.

use funicular::Distribution;
use funicular::prelude::*;

use crate::run::{good, holding, run, says};

/// What the program prints and says, and how it ends.
/// A mast on three elastic legs under a rope to a load, with tolerances of all kinds.
fn mast(root: &str) -> String {
    format!(
        "name = \"mast\"\ngravity_m_s2 = 10\n{root}\n\
         joints = {{ A = {{ at_m = [2, 0, 0] }}, B = {{ at_m = [-1, 1.8, 0] }}, C = {{ at_m = [-1, -1.6, 0.2] }}, \
         D = {{ at_m = [0, 5, 3] }}, top = {{ near_m = [0, 0.1, 3], mass_kg = 20, force_n = [30, 0, 0] }}, \
         Q = {{ near_m = [0, 2.4, 2], mass_kg = 15, mass_tolerance_kg = 1 }} }}\n\
         bars = [{{ from = 'A', to = 'top', mass_kg = 4, stiffness_n = 4e5, strength_n = 900, compression_n = 900 }},\n\
         {{ from = 'B', to = 'top', mass_kg = 4, stiffness_n = 4e5 }},\n\
         {{ from = 'C', to = 'top', mass_kg = 4, stiffness_n = 4e5 }},\n\
         {{ from = 'top', to = 'Q', length_m = 2.6, mass_kg = 0.4, kind = 'cable' }},\n\
         {{ from = 'Q', to = 'D', length_m = 2.9, mass_kg = 0.4, kind = 'cable', length_tolerance_m = 2e-2 }}]"
    )
}

const ALL: &str = "tolerances = { length_tolerance_m = 2e-3, stiffness_tolerance = 0.05, mass_tolerance_kg = 0.1, \
                   at_tolerance_m = 3e-3, force_tolerance_n = 2 }";

fn problem(text: &str) -> Problem {
    Problem::parse(text, "mast.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn solvers_stay_within_the_ranges() {
    let problem = problem(&mast(ALL));
    let found = Solve::new().tolerances_drawn(&problem, 60, 11, Distribution::Ends).unwrap();
    let ranges = found.ranges().unwrap();
    assert_eq!((found.is_stable(), ranges.numbers.len()), (Some(true), 5 + 3 + 5 + 12 + 2 + 3));
    let draws = found.draws().unwrap();
    assert_eq!((draws.solved, draws.outside), (60, 0));
    // Both ends of a force that is said to be a hull are those of a system, by both solvers.
    let system = found.answer().system();
    for (member, range) in ranges.axial_n.iter().enumerate().filter(|(_, range)| range.is_hull) {
        let [least, most] = range.guaranteed;
        let nominal = found.answer().equilibria()[0].axial_n[member];
        assert!(least < nominal && nominal < most, "{range:?} {nominal}");
        // A draw deviates by no more than half the range.
        let drawn = draws.axial_n[member];
        assert!(drawn.deviation < 0.5 * (most - least) && range.contains(drawn.mean), "{drawn:?}");
    }
    // Each number alone, at both of its ends, is in all ranges; of the one that matters most it says how much.
    for (k, number) in ranges.numbers.iter().enumerate() {
        let ends = [-1.0, 1.0].map(|end| {
            let values = ranges.numbers.iter().enumerate();
            let values =
                values.map(|(i, n)| n.given + if i == k { end * number.within } else { 0.0 });
            let varied = system.with_uncertain(&values.collect::<Vec<_>>()).unwrap();
            let answer = Solve::new().census(UseCensus::Never).run(&varied.into()).unwrap();
            assert!(answer.agrees());
            answer.equilibria().iter().for_each(|e| {
                let mut forces = ranges.axial_n.iter().zip(&e.axial_n);
                assert!(forces.all(|(range, force)| range.contains(*force)), "{number:?}");
            });
            answer.equilibria()[0].axial_n.clone()
        });
        for (member, range) in ranges.axial_n.iter().enumerate() {
            let change = 0.5 * (ends[1][member] - ends[0][member]);
            let (most_by, by) = range.most_by.unwrap();
            assert!(change.abs() < 1.001 * by.abs() + 1e-6, "{member} {number:?}: {change} {by}");
            assert!(most_by != k || (change - by).abs() < 1e-2 * by.abs(), "{change} {by}");
        }
    }
}

#[test]
fn the_program_prints_them_in_eighty_columns() {
    let folder = holding([("mast.toml", mast(ALL))]);
    let arguments = ["solve", "mast.toml", "--tolerances", "--monte-carlo", "20"];
    let said = good(&folder, &arguments);
    assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    says(
        &said,
        &[
            "exactly one equilibrium", "hull", "most by", "sd / N", "Fx / N", "Sag: ",
            "20 draws (seed 1)",
        ],
    );
    let [m, mm] =
        [&said, &good(&folder, &[&arguments[..], &["--units", "kN,mm"]].concat())].map(|said| {
            let sag = said.lines().find(|line| line.starts_with("Sag: ")).unwrap();
            let words: Vec<&str> = sag.split_whitespace().collect();
            (words[1].parse::<f64>().unwrap(), words[4].to_owned())
        });
    assert!((mm.0 - 1e3 * m.0).abs() < 1e-2 && m.1 == "m," && mm.1 == "mm,", "{m:?} {mm:?}");
    // Longer names leave no room for three ranges beside each other; of the tackle, whose ranges across its rope are
    // rounding, what is held exactly has no row.
    let longer = mast(ALL).replace("top", "top-of-the-mast");
    std::fs::write(folder.path().join("longer.toml"), longer).unwrap();
    let (code, said, _) = run(&folder, &["solve", "longer.toml", "--tolerances"]);
    assert!(code == Some(0) && said.lines().all(|line| line.chars().count() <= 80), "{said}");
    let rows = said.lines().filter(|line| line.starts_with(" top-of-the-mast"));
    assert_eq!(
        rows.filter_map(|row| row.split_whitespace().nth(1)).collect::<Vec<_>>(),
        ["x", "y", "z"]
    );
    let (code, said, _) = run(&folder, &["solve", "--case", "tackle", "--tolerances"]);
    assert!(code == Some(0) && said.lines().all(|line| line.chars().count() <= 80), "{said}");
    let places = said.split("Fx / N").next().unwrap();
    assert!(places.contains("\n block ") && !places.contains("\n winch "), "{said}");
    // A strength that all forces stay below, and one that some do not.
    for (strength, wanted) in [("900", 0), ("101", 1)] {
        let text = mast(ALL).replace("compression_n = 900", &format!("compression_n = {strength}"));
        std::fs::write(folder.path().join("weak.toml"), text).unwrap();
        let (code, said, _) = run(&folder, &["solve", "weak.toml", "--tolerances", "--check"]);
        assert_eq!(code, Some(wanted), "{said}");
    }
}

/// Ranges and modes of a gable that has snapped through are of what hangs below, and say so.
#[test]
fn ranges_and_modes_of_another_shape_than_is_drawn_say_so() {
    let text = "plane = \"xz\"\n\
                joints = { A = { at_m = [-1, 0, 0] }, B = { at_m = [1, 0, 0] }, P = { near_m = [0, 0, 0.8], mass_kg = 800 } }\n\
                bars = [{ from = \"A\", to = \"P\", mass_kg = 0, stiffness_n = 1e4 },\n\
                { from = \"P\", to = \"B\", mass_kg = 0, stiffness_n = 1e4 }]\n\
                tolerances = { length_tolerance_m = 1e-6 }\n";
    let folder = holding([("gable.toml", text)]);
    let (code, said, _) = run(&folder, &["solve", "gable.toml", "--tolerances"]);
    assert_eq!(code, Some(3), "{said}");
    says(
        &said,
        &[
            "The equilibrium of the numbers given: agreed; not the neighbour of the shape",
            "exactly one equilibrium is near",
        ],
    );
    let (code, said, _) = run(&folder, &["modes", "gable.toml"]);
    assert_eq!(code, Some(3), "{said}");
    says(&said, &["Not the neighbour of the shape given: see `funicular solve`."]);
    let (code, said, _) = run(&folder, &["modes", "gable.toml", "--json"]);
    let found: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!((code, &found["is_neighbour"]), (Some(3), &serde_json::Value::Bool(false)));
}

/// A weight pushed aside has a mirror image in the plane of its push, of the same energy: draws are solved next to the one shown.
#[test]
fn draws_do_not_go_to_the_mirror_image() {
    let text = r#"
floor_m = 0
joints = { A = { at_m = [0, 0, 0] }, C = { at_m = [0, 0, 3] }, F = { mass_kg = 1, force_n = [14.1, -1.8, 0] }, T = { mass_kg = 5, mass_tolerance_kg = 0.1 } }
bars = [{ from = "A", to = "F", kind = "cable", length_m = 1.976, mass_kg = 0.2, stiffness_n = 1e4, length_tolerance_m = 4e-3 },
  { from = "F", to = "T", length_m = 1.825, mass_kg = 1, length_tolerance_m = 6e-3 },
  { from = "C", to = "T", kind = "cable", length_m = 1.8, mass_kg = 0.1, stiffness_n = 2000 },
  { from = "A", to = "T", length_m = 1.9, mass_kg = 0.1, stiffness_n = 5000, length_tolerance_m = 5e-3 }]
"#;
    let folder = holding([("pushed.toml", text)]);
    let random = ["--tolerances", "--monte-carlo", "100", "--distribution", "ends"];
    let said = good(&folder, &[&["solve", "pushed.toml"][..], &random].concat());
    says(&said, &["100 with an answer, none of"]);
}

#[test]
fn what_has_no_ranges_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "exact.toml",
        &mast("").replace(", mass_tolerance_kg = 1", "").replace(", length_tolerance_m = 2e-2", ""),
    );
    let bob = "floor_m = -3.05\ntolerances = { length_tolerance_m = 0.1 }\n\
               joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2 } }\n\
               bars = [{ from = 'A', to = 'P', length_m = 3, mass_kg = 0 }]";
    write("floor.toml", bob);
    write("deep.toml", &bob.replace("-3.05", "-3.2"));
    let anchors = "A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, C = { at_m = [0, 0, -9] }";
    let bars = ["A", "B", "C"].map(|from| {
        format!(
            "{{ from = '{from}', to = 'P', length_m = 5, mass_kg = 0, length_tolerance_m = 1e-3 }}"
        )
    });
    let bars = bars.join(", ");
    write(
        "braced.toml",
        &format!("joints = {{ {anchors}, P = {{ mass_kg = 2 }} }}\nbars = [{bars}]"),
    );
    write("mast.toml", &mast(ALL));
    for (arguments, wanted, words) in [
        (&["exact.toml", "--tolerances"][..], 2, "no number of this system has a tolerance"),
        (&["floor.toml", "--tolerances"], 3, "may come to lie on the floor or rise from it: 2"),
        (&["deep.toml", "--tolerances"], 0, "-3.1"),
        (&["braced.toml", "--tolerances"], 3, "overdetermine the shape 1-fold"),
        (&["mast.toml", "mast.toml", "--tolerances"], 2, "one system at a time"),
        (&["mast.toml", "--monte-carlo", "5"], 2, "--tolerances"),
        (&["mast.toml", "--tolerances", "--monte-carlo", "0"], 2, "1..=1000000"),
        (&["mast.toml", "--tolerances", "--summary"], 2, "cannot be used"),
    ] {
        let arguments: Vec<&str> = ["solve"].iter().chain(arguments).copied().collect();
        let (code, said, failed) = run(&folder, &arguments);
        assert_eq!(code, Some(wanted), "{said}\n{failed}");
        assert!(format!("{said}{failed}").replace('\n', " ").contains(words), "{said}\n{failed}");
    }
}

/// Draws are the same for the same seed, and others for another.
#[test]
fn seeds_make_the_draws() {
    let problem = problem(&mast(ALL));
    let draws = |seed: u64| {
        let found = Solve::new().tolerances_drawn(&problem, 3, seed, Distribution::Normal).unwrap();
        found.draws().unwrap().axial_n.clone()
    };
    let first = draws(1);
    assert_eq!(first, draws(1));
    assert_ne!(first, draws(2));
}

/// A plumb bob bears its weight, 20 N and 5: draws deviate by what their distribution says. What lies beyond three
/// deviations takes 6 phi(3) / (2 Phi(3) - 1) = 0.026 662 of the variance of a normal one.
#[test]
fn draws_are_distributed_as_they_are_asked_for() {
    let text = "gravity_m_s2 = 10\n\
        joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2, mass_tolerance_kg = 0.5 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 3, mass_kg = 0 }]";
    let problem = problem(text);
    for (distribution, part) in [
        (Distribution::Uniform, 3.0_f64.sqrt().recip()),
        (Distribution::Normal, (1.0 - 0.026_662_f64).sqrt() / 3.0),
        (Distribution::Ends, 1.0),
    ] {
        let found = Solve::new().tolerances_drawn(&problem, 4000, 1, distribution).unwrap();
        let draws = found.draws().unwrap();
        assert_eq!((draws.solved, draws.outside, draws.distribution), (4000, 0, distribution));
        // Of 4000 draws the mean is known to 1/63 of the deviation, and that to 1/89 of itself: four times that.
        let drawn = draws.axial_n[0];
        assert!((drawn.mean - 20.0).abs() < 5.0 * part * 4.0 / 63.0, "{distribution:?}: {drawn:?}");
        assert!(
            (drawn.deviation / (5.0 * part) - 1.0).abs() < 4.0 / 89.0,
            "{distribution:?}: {drawn:?}"
        );
    }
}
