//! Systems in which two features meet: a floor and a drawing, a plane and a support that moves, tolerances and a part that
//! turns. Expected values are closed forms.

use funicular::prelude::*;
use serde_json::Value;

use crate::run::{good, holding, run};

fn problem(text: &str) -> Problem {
    Problem::parse(text, "system.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn near(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() < 1e-9 * wanted.abs().max(1.0)
}

fn is_verified(text: &str) -> bool {
    let answer = Solve::new().run(&problem(text)).expect("an answer");
    answer.agrees() && answer.equilibria()[0].evidence.rung() >= Some(Rung::Verified)
}

/// A heavy joint on the floor between a bar and an elastic cable, drawn at some height.
fn drawn_at(height_m: f64) -> String {
    format!(
        "floor_m = -1.5\n\
         joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [3, 0, 0] }}, \
         U = {{ near_m = [0.9, 1, {height_m}], mass_kg = 3, force_n = [0, 2, 0], mass_tolerance_kg = 0.01 }}, \
         V = {{ near_m = [1.8, 0.55, {height_m}], mass_kg = 3 }} }}\n\
         bars = [{{ from = 'A', to = 'U', length_m = 2, mass_kg = 1 }}, {{ from = 'U', to = 'V', length_m = 1, mass_kg = 0 }}, \
         {{ from = 'V', to = 'B', length_m = 2, mass_kg = 0, kind = 'cable', stiffness_n = 1e3 }}]"
    )
}

#[test]
fn what_is_drawn_above_the_floor_that_it_lies_on_is_judged_as_on_it() {
    let folder = holding([("on.toml", &drawn_at(-1.5)), ("above.toml", &drawn_at(-1.48))]);
    let frequencies = |file: &str| -> Vec<f64> {
        let found: Value =
            serde_json::from_str(&good(&folder, &["modes", file, "--json"])).unwrap();
        let modes = found["equilibria"][0]["modes"].as_array().unwrap().clone();
        modes.iter().map(|mode| mode["omega2_s2"].as_f64().unwrap()).collect()
    };
    let [on, above] = ["on.toml", "above.toml"].map(frequencies);
    assert!(on.len() == 2 && on.iter().zip(&above).all(|(a, b)| near(*a, *b)), "{on:?} {above:?}");
    let answer = good(&folder, &["solve", "above.toml", "--json"]);
    std::fs::write(folder.path().join("answer.json"), answer).unwrap();
    for arguments in [
        &["judge", "above.toml", "--answer", "answer.json"][..],
        &["solve", "above.toml", "--tolerances"],
        &["simulate", "above.toml", "--time", "0.1"],
    ] {
        good(&folder, arguments);
    }
    assert!(is_verified(&drawn_at(-1.48)));
}

/// A ball on a bar against a wall that leans, `a x + b y + c z = d`: any wall has a proof, on the floor too.
#[test]
fn what_slides_in_a_plane_that_leans_in_all_directions_is_verified() {
    for normal in ["[1, 2, 3]", "[3, -1, 2]", "[1, 1, 1]"] {
        let text = format!(
            "joints = {{ A = {{ at_m = [0, 0, 0] }}, T = {{ at_m = [1, 0, -1], normal = {normal}, mass_kg = 1 }} }}\n\
             bars = [{{ from = 'A', to = 'T', length_m = 2, mass_kg = 0 }}]"
        );
        assert!(is_verified(&text), "{normal}");
    }
    let on_floor = "floor_m = -1\njoints = { A = { at_m = [0, 0, 0] }, \
        S = { at_m = [1.5, 0, 0], normal = [1, 0, 0.2], mass_kg = 1, force_n = [0, 5, 0] } }\n\
        bars = [{ from = 'A', to = 'S', length_m = 2.5, mass_kg = 0.5 }]";
    assert!(is_verified(on_floor));
}

/// A truss that stands at the height of the floor on a pin and a roller: the apex is at sqrt(l² - 1) m.
#[test]
fn a_roller_at_the_height_of_the_floor_neither_lies_there_nor_rises() {
    let text = "floor_m = 0\nplane = 'xz'\njoints = { A = { at_m = [0, 0, 0] }, S = { at_m = [2, 0, 0], free = 'x' }, \
        P = { near_m = [1, 0, 1], mass_kg = 100, mass_tolerance_kg = 0.1 } }\n\
        bars = [{ from = 'A', to = 'P', mass_kg = 0 }, { from = 'S', to = 'P', mass_kg = 0 }, { from = 'A', to = 'S', mass_kg = 0 }]";
    let problem = problem(text);
    let found = Derivatives::new().run(&problem).unwrap();
    let height = found.gradient("joints.P.at_m.z").unwrap();
    // z² = l² - x² with x = (d² + l² - k²)/(2 d): z' = (l - x l/d)/z of the first leg.
    let by_leg = height.by("bars.1.length_m").unwrap().value;
    assert!(near(by_leg, 0.5_f64.sqrt()), "{by_leg}");
    let ranges = Solve::new().tolerances(&problem).unwrap();
    let forces = &ranges.ranges().unwrap().reactions_n;
    // The ground bears half of 100 ± 0.1 kg under each leg; nothing along the roller, nor across the plane.
    let [along, across, up] = forces[1].unwrap();
    assert!(along.guaranteed.iter().all(|n| n.abs() <= 0.0));
    assert!(across.guaranteed.iter().all(|n| n.abs() < 1e-300));
    let half_n = 0.5 * 9.80665;
    assert!(near(up.guaranteed[0], 99.9 * half_n) && near(up.guaranteed[1], 100.1 * half_n));
}

#[test]
fn ranges_of_a_part_that_turns_freely_are_said_to_be_those_of_one_turn() {
    let text = "tolerances = { mass_tolerance_kg = 0.01 }\n\
        joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 }, Q = { mass_kg = 2 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 0 }, { from = 'A', to = 'Q', length_m = 1.2, mass_kg = 0 }, \
        { from = 'P', to = 'Q', length_m = 0.8, mass_kg = 0 }]";
    let found = Solve::new().tolerances(&problem(text)).unwrap();
    assert_eq!(found.ranges().unwrap().free_turns, 1);
    let said = found.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("but for the free turn of one part about a vertical"), "{said}");
}

/// No number of a file moves one joint out of the plane that `plane` keeps all to.
#[test]
fn supports_stay_in_the_plane_of_all() {
    let text = "plane = 'xz'\njoints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 0 }]";
    let problem = problem(text);
    let study = Study::new().vary("joints.A.at_m.y=0,0.1").unwrap();
    let error = study.run(&problem).unwrap_err().to_string();
    assert!(error.contains("joint `A` would leave the plane that holds all joints"), "{error}");
    let found = Derivatives::new().run(&problem).unwrap();
    let height = found.gradient("joints.P.at_m.z").unwrap();
    assert!(height.by("joints.A.at_m.y").is_none());
    assert!(near(height.by("joints.A.at_m.z").unwrap().value, 1.0));
}

/// A weight that is drawn aside beyond both of its supports hangs below no point of the line between them.
#[test]
fn what_hangs_beyond_the_ends_of_a_steep_line_has_its_depth_below_the_lowest_support() {
    let text = "plane = 'xz'\njoints = { A = { at_m = [0, 0, 0] }, B = { at_m = [0.1, 0, 0.5] }, \
        P = { mass_kg = 1, force_n = [30, 0, 0] } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 2, mass_kg = 0.1 }, { from = 'P', to = 'B', length_m = 2.2, mass_kg = 0.1 }]";
    let folder = holding([("aside.toml", text)]);
    let (_, out, _) = run(&folder, &["solve", "aside.toml"]);
    // |P| = 2 and |P - B| = 2.2: with 0.1 x + 0.5 z = -0.29 that is 26 z² + 29 z + 4.41 = 0 of the lower point.
    let depth_m = (29.0 + (29.0_f64 * 29.0 - 4.0 * 26.0 * 4.41).sqrt()) / 52.0;
    assert!(
        out.contains(&format!("Sag: {depth_m:.6} m, of joint P below the lowest support, A")),
        "{out}"
    );
}

/// A massless elastic bar that bears nothing has its length, and stores nothing.
#[test]
fn an_elastic_bar_without_load_is_not_pressed_into_a_point() {
    let text = "joints = { A = { at_m = [0, 0, 0] }, U = {}, P = { mass_kg = 2 } }\n\
        bars = [{ from = 'A', to = 'U', length_m = 1, mass_kg = 0, stiffness_n = 1e3 }, { from = 'A', to = 'P', length_m = 1, mass_kg = 0 }]";
    let answer = Solve::new().run(&problem(text)).unwrap();
    assert!(answer.agrees());
    let found = &answer.equilibria()[0];
    assert!(near(found.energy_j, -2.0 * 9.80665), "{}", found.energy_j);
    let [x, y, z] = found.joints_m[1];
    assert!(near(x.hypot(y).hypot(z), 1.0) && found.axial_n[0].abs() < 1e-6);
}

/// Bars that lie on a floor or slide on a level bear nothing: the stiffest are as long as they are, to rounding.
#[test]
fn the_stiffest_bars_agree_where_they_bear_nothing() {
    for stiffness_n in ["1e6", "1e7", "1e9"] {
        let text = format!(
            "floor_m = -1.88\njoints = {{ A = {{ at_m = [1, 2, -1.24] }}, S = {{ at_m = [-1.02, 1.4, -0.67], free = 'xy' }}, \
             P = {{ mass_kg = 0.5 }} }}\nbars = [{{ from = 'A', to = 'P', length_m = 3.29, mass_kg = 1 }}, \
             {{ from = 'S', to = 'P', length_m = 2.93, mass_kg = 0.3, stiffness_n = {stiffness_n} }}]"
        );
        assert!(Solve::new().run(&problem(&text)).unwrap().agrees(), "{stiffness_n}");
    }
}

/// A ball on a wall, `x = 1`, at the end of a bar of `sqrt(2)` m: of the two places where it can be one is below the floor.
#[test]
fn what_cannot_lie_on_the_floor_stands_where_its_bar_lets_it() {
    let text = "floor_m = -0.5\njoints = { A = { at_m = [0, 0, 0] }, S = { at_m = [1, 0, 0], free = 'z', mass_kg = 1 } }\n\
        bars = [{ from = 'A', to = 'S', length_m = 1.4142135623730951, mass_kg = 0 }]";
    let answer = Solve::new().run(&problem(text)).unwrap();
    assert!(answer.agrees());
    let found = &answer.equilibria()[0];
    let weight_n = 9.80665;
    assert!(near(found.joints_m[1][2], 1.0) && near(found.axial_n[0], -weight_n * 2.0_f64.sqrt()));
}

/// Two chains of bars that meet on the floor, in a plane: one stands, the other lies.
#[test]
fn bars_that_stand_on_the_floor_in_a_plane_agree() {
    let text = "plane = 'xz'\nfloor_m = -0.05\n\
        joints = { A = { at_m = [0, 0, 0] }, C = { at_m = [-2, 0, 1] }, P = { mass_kg = 0.84 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 0.5355, mass_kg_per_m = 0.63, count = 2 }, \
        { from = 'C', to = 'P', length_m = 1.071, mass_kg_per_m = 1.33, count = 2 }]";
    assert!(Solve::new().run(&problem(text)).unwrap().agrees());
}

/// A bar whose weight is at its first end, with nothing at the other, is at rest in any direction; so is what lies on the
/// floor at the end of bars that bear nothing.
#[test]
fn places_on_which_nothing_acts_are_not_compared() {
    let dangling = "joints = { A = { at_m = [-1, -2, 0] }, P = {}, Q = { mass_kg = 4.63 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 1.3117, mass_kg_per_m = 0.23, count = 2, centre_m = 0 }, \
        { from = 'A', to = 'Q', length_m = 0.5049, mass_kg_per_m = 0.94, count = 3, centre_m = 0.1262 }]";
    let lying = "plane = 'xz'\nfloor_m = -0.79\ngravity_m_s2 = 1.62\n\
        joints = { C = { at_m = [-1.67, 0, -0.41] }, S = { at_m = [1.93, 0, 1.18], free = 'x' }, P = { mass_kg = 4.3 } }\n\
        bars = [{ from = 'C', to = 'S', length_m = 1.405, mass_kg = 0, count = 3 }, \
        { from = 'S', to = 'P', length_m = 2.41404225315134, mass_kg = 1.01 }]";
    for text in [dangling, lying] {
        let answer = Solve::new().run(&problem(text)).unwrap();
        assert!(answer.agrees(), "{text}");
        assert!(answer.agreement().is_some_and(|found| found.free_joints > 0), "{text}");
    }
}

/// A bar of 2 m that hangs, with 3 kg and a pull of 5 N a metre, 100 K warmer: of another length it is heavier and has more of
/// all that is given a metre. As a chain between two anchors, too.
#[test]
fn what_is_given_a_metre_follows_a_length_that_varies() {
    let hanging = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 2, mass_kg_per_m = 3, force_n_per_m = [0, 0, -5], \
        temperature_k = 100, expansion_per_k = 1e-3 }]";
    let chain = "anchors = { start_m = [0, 0, 0], end_m = [2, 0, 0] }\n\
        bars = [{ length_m = 2, mass_kg_per_m = 3 }, { length_m = 2, mass_kg_per_m = 3 }]";
    let folder = holding([("hanging.toml", hanging), ("chain.toml", chain)]);
    let study = |file: &str, of: &str| -> Vec<f64> {
        let arguments = ["study", file, "--vary", "bars.1.length_m=2,3", "--of", of, "--json"];
        let found: Value = serde_json::from_str(&good(&folder, &arguments)).unwrap();
        let points = found["points"].as_array().unwrap();
        points.iter().map(|point| point["of"][0].as_f64().unwrap()).collect()
    };
    let gravity = 9.80665;
    let places = study("hanging.toml", "joints.P.z");
    assert!(near(places[0], -2.2) && near(places[1], -3.3), "{places:?}");
    let forces = study("hanging.toml", "bars.1.axial_from_n");
    let wanted = |length_m: f64| (1.0 + 3.0 * length_m) * gravity + 5.0 * length_m;
    assert!(near(forces[0], wanted(2.0)) && near(forces[1], wanted(3.0)), "{forces:?}");
    // Of the chain as the file with that length has it.
    let pulls = study("chain.toml", "bars.1.axial_n");
    for (pull_n, length_m) in pulls.into_iter().zip(["2", "3"]) {
        let text = chain.replacen("length_m = 2", &format!("length_m = {length_m}"), 1);
        let wanted = Solve::new().run(&problem(&text)).unwrap().equilibria()[0].axial_n[0];
        assert!(near(pull_n, wanted), "{pull_n} {wanted}");
    }
}

/// An elastic bar, a strut and a short rigid bar hold a weight: `(x + 1)² + z² = 4` and `(x - 1)² + z² = 0.16` to the elastic
/// bar's elongation, x = 0.96, and the strut of 1.6 m is loose. Searches that start from a hanging shape compress the
/// elastic bar to 34 kJ; other starts find what is lower.
#[test]
fn the_lowest_is_looked_for_from_other_starts_too() {
    let text = "plane = 'xz'\njoints = { A = { at_m = [-1, 0, 0] }, B = { at_m = [0, 0, -1] }, C = { at_m = [1, 0, 0] }, P = { mass_kg = 1 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 2, mass_kg = 0, stiffness_n = 1e6 }, \
        { from = 'P', to = 'B', length_m = 1.6, mass_kg = 0, kind = 'strut' }, { from = 'C', to = 'P', length_m = 0.4, mass_kg = 0 }]";
    let answer = Solve::new().run(&problem(text)).unwrap();
    assert!(answer.agrees());
    let [x, _, z] = answer.equilibria()[0].joints_m[3];
    assert!((x - 0.96).abs() < 1e-4 && (z - 0.1584_f64.sqrt()).abs() < 1e-4, "{x} {z}");
}

/// A bar of 4.5 m that rests on the floor with one end turns about the other: no motion leaves it, whatever its rounding.
#[test]
fn a_bar_that_rests_on_the_floor_turns_and_does_not_leave() {
    for length_m in ["4.4", "4.5", "5"] {
        let text = format!(
            "floor_m = -1.5\njoints = {{ A = {{ at_m = [0, 0, -1] }}, P = {{ mass_kg = 1 }} }}\n\
             bars = [{{ from = 'A', to = 'P', length_m = {length_m}, mass_kg = 1 }}]"
        );
        let folder = holding([("bar.toml", &text)]);
        let out = good(&folder, &["modes", "bar.toml"]);
        assert!(out.contains("1 mode, 0 unstable"), "{out}");
    }
}

/// Of three cases the first has no answer: 10 N across a weight of 2 kg turn it about the line between its anchors, from
/// straight below.
#[test]
fn cases_move_from_the_first_that_has_an_answer() {
    let text = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [2, 0, 0] }, P = { mass_kg = 1 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 1.5, mass_kg = 0 }, { from = 'B', to = 'P', length_m = 1.5, mass_kg = 0 }]\n\
        loads = [{ name = 'm', joint = 'P', mass_kg = 1 }, { name = 'w', joint = 'P', force_n = [0, 10, 0] }]\n\
        cases = [{ name = 'bad', factors = { m = -2 } }, { name = 'still', factors = { m = 1 } }, { name = 'wind', factors = { m = 1, w = 1 } }]";
    let found = Solve::new().load_cases(&problem(text)).unwrap();
    let moves: Vec<_> = found
        .cases()
        .iter()
        .map(|case| case.settled.as_ref().ok().map(|one| one.moves_m))
        .collect();
    let turned = (10.0_f64 / (2.0 * 9.80665)).atan();
    let wanted = 2.0 * 1.25_f64.sqrt() * (0.5 * turned).sin();
    assert!(
        moves[0].is_none() && moves[1] == Some(0.0) && near(moves[2].unwrap(), wanted),
        "{moves:?}"
    );
}

/// Two lamps at one place, with a slack tie between them that bears nothing in any direction: it explains nothing of what is
/// left over at a third one, a third of a metre from its place.
#[test]
fn a_slack_tie_without_span_explains_no_force_elsewhere() {
    let text = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [2, 0, 0] }, P = { mass_kg = 2 }, Q = { mass_kg = 2 }, R = { mass_kg = 2 } }\n\
        bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 0, stiffness_n = 1000 }, \
        { from = 'P', to = 'B', length_m = 1, mass_kg = 0, stiffness_n = 1000 }, \
        { from = 'A', to = 'Q', length_m = 1, mass_kg = 0, stiffness_n = 1000 }, \
        { from = 'Q', to = 'B', length_m = 1, mass_kg = 0, stiffness_n = 1000 }, \
        { from = 'A', to = 'R', length_m = 0.5, mass_kg = 0, stiffness_n = 1000 }, \
        { from = 'P', to = 'Q', length_m = 0.5, mass_kg = 0, kind = 'cable' }]";
    // P and Q by `2 (1000/1) (l - 1) z/l = 2 g`, l^2 = 1 + z^2.
    let answer = |r: &str| {
        format!(
            "joint,x_m,y_m,z_m\nA,0,0,0\nB,2,0,0\nP,1,0,-0.27464367150555574\nQ,1,0,-0.2746436715055558\nR,{r}\n"
        )
    };
    let right = format!("0,0,{}", -0.5 * (1.0 + 2.0 * 9.80665 / 1000.0));
    let folder = holding([
        ("lamps.toml", text),
        ("moved.csv", &answer("0.3,0,-0.7")),
        ("right.csv", &answer(&right)),
    ]);
    for (file, code) in [("moved.csv", 1), ("right.csv", 0)] {
        let (found, out, said) = run(&folder, &["judge", "lamps.toml", "--answer", file]);
        assert_eq!(found, Some(code), "{out}{said}");
    }
}

/// A rigid load on three slings that are drawn taut, of which one is too long: by sequential quadratic programming (SciPy's
/// SLSQP, slings no longer than their length) a comes to rest at (-0.99946, -1.62763) with -5055.318 J.
#[test]
fn of_slings_that_are_drawn_taut_one_may_be_slack() {
    let text = "plane = 'xz'\njoints = { hook = { at_m = [0, 0, 0] }, a = { mass_kg = 100, near_m = [-1, 0, -1.6] }, \
        b = { mass_kg = 100, near_m = [1, 0, -1.6] }, m = { mass_kg = 100, near_m = [0, 0, -1.6] }, \
        K = { mass_kg = 10, near_m = [0, 0, -2] } }\n\
        bars = [{ from = 'a', to = 'K', mass_kg = 0 }, { from = 'b', to = 'K', mass_kg = 0 }, \
        { from = 'm', to = 'K', mass_kg = 0 }, { from = 'a', to = 'm', mass_kg = 0 }, { from = 'b', to = 'm', mass_kg = 0 }, \
        { from = 'hook', to = 'a', kind = 'cable', length_m = 1.91, mass_kg = 0 }, \
        { from = 'hook', to = 'b', kind = 'cable', length_m = 1.98, mass_kg = 0 }, \
        { from = 'hook', to = 'm', kind = 'cable', length_m = 1.65, mass_kg = 0 }]";
    let answer = Solve::new().run(&problem(text)).unwrap();
    assert!(answer.agrees(), "{:?}", answer.failures());
    for found in answer.equilibria() {
        assert!((found.energy_j + 5055.318).abs() < 1e-3, "{}", found.energy_j);
        let [x, _, z] = found.joints_m[1];
        assert!((x + 0.99946).abs() < 1e-5 && (z + 1.62763).abs() < 1e-5, "{x} {z}");
    }
}

/// A table of which one foot is held: all four bear a quarter of 80 kg, twice that in a case; what stands on the floor is
/// listed as the support is.
#[test]
fn what_the_floor_bears_is_listed_over_all_cases() {
    let mut joints = vec![
        "F0 = { at_m = [0, 0, 0] }".to_owned(),
        "K = { near_m = [0.5, 0.5, 1], mass_kg = 80 }".to_owned(),
    ];
    let mut bars = Vec::new();
    for (k, corner) in ["[0, 0, 0]", "[1, 0, 0]", "[1, 1, 0]", "[0, 1, 0]"].iter().enumerate() {
        if k > 0 {
            joints.push(format!("F{k} = {{ near_m = {corner} }}"));
        }
        for to in ["K".to_owned(), format!("F{}", (k + 1) % 4)] {
            bars.push(format!("{{ from = 'F{k}', to = '{to}', mass_kg = 0, stiffness_n = 1e6 }}"));
        }
    }
    let text = format!(
        "floor_m = 0\njoints = {{ {} }}\nbars = [{}]\nloads = [{{ name = 'more', joint = 'K', force_n = [0, 0, -784.532] }}]\n\
         cases = [{{ name = 'one', factors = {{ more = 0 }} }}, {{ name = 'two', factors = {{ more = 1 }} }}]",
        joints.join(", "),
        bars.join(", ")
    );
    let folder = holding([("table.toml", text.as_str())]);
    let out = good(&folder, &["solve", "table.toml", "--load-case", "each", "--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    let supports = found["supports"].as_array().unwrap();
    assert_eq!(supports.len(), 4, "{supports:?}");
    let total: f64 = supports.iter().map(|one| one["most_n"]["value"].as_f64().unwrap()).sum();
    assert!(near(total, 160.0 * 9.80665), "{total}");
}

/// Modes of all equilibria by the census, of one without it; what the census does not take is refused, not left out.
#[test]
fn the_census_of_modes_is_taken_or_refused() {
    let folder = holding([("empty", "")]);
    for (most, wanted) in [("2", Some(0)), ("0", Some(0)), ("25", Some(2))] {
        let (code, out, said) = run(&folder, &["modes", "--case", "two-bars", "--max-bars", most]);
        assert_eq!(code, wanted, "{most}: {said}");
        assert_eq!(out.contains("These are all equilibria"), most == "2", "{out}");
        assert_eq!(said.contains("from 1 to 24"), most == "25", "{said}");
    }
}
