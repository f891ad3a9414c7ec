//! Ropes over rings and pulleys in modes, motions, derivatives, studies, losses, sweeps and basins.

use funicular::prelude::*;
use funicular::{DerivativesError, LoadEventKind, Outcome};
use model::{STANDARD_GRAVITY_M_S2 as G, SolverName};
use serde_json::{Value, json};

use crate::derivatives::are_differences;
use crate::edited;
use crate::run::holding;

/// A ring of 10 kg on a rope of 5 m from the origin to 4 m aside and 1 m up.
const RING: &str = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [4, 0, 1] }, P = { mass_kg = 10 } }\n\
                    bars = [{ from = 'A', via = ['P'], to = 'B', length_m = 5, kind = 'cable' }]";

fn run(arguments: &[&str]) -> (Option<i32>, Value, String) {
    let folder = holding([("ring.toml", RING)]);
    let (code, text, error) = crate::run::run(&folder, arguments);
    (code, serde_json::from_str(&text).unwrap_or_default(), error)
}

/// The ring with an elastic rope more to it.
#[test]
fn derivatives_are_the_differences_of_the_other_solver() {
    let text = json!({
        "joints": { "A": { "at_m": [0, 0, 0] }, "B": { "at_m": [4, 0, 1] }, "C": { "at_m": [1, 2, 0.5] },
            "P": { "mass_kg": 10 } },
        "bars": [
            { "from": "A", "via": ["P"], "to": "B", "length_m": 5, "kind": "cable" },
            { "from": "C", "via": ["P"], "to": "B", "length_m": 4.6, "kind": "cable", "stiffness_n": 90 },
        ],
    });
    let parameters = [
        ("bars.1.length_m", 5.0),
        ("bars.2.length_m", 4.6),
        ("bars.2.stiffness_n", 90.0),
        ("joints.P.mass_kg", 10.0),
        ("joints.C.at_m.y", 2.0),
    ];
    are_differences(&text, "P", 1, &parameters);
    let derivatives = Derivatives::new().run(&edited::problem(&text)).unwrap();
    // A rope has no mass to vary.
    let height = derivatives.gradient("joints.P.at_m.z").unwrap();
    assert!(height.by("bars.1.mass_kg").is_none() && height.by("joints.P.mass_kg").is_some());
    let refused = derivatives.change("bars.1.mass_kg").unwrap_err();
    assert!(matches!(refused, Error::Derivatives(DerivativesError::NoParameter(_))), "{refused}");
}

#[test]
fn a_ring_comes_to_rest_wherever_it_is_let_go() {
    let release = ["simulate", "ring.toml", "--seeds", "60", "--damping", "2", "--time", "30"];
    let more = ["--step", "5e-3", "--json", "--out", "ends"];
    let (code, told, said) = run(&[&release[..], &more[..]].concat());
    assert_eq!(code, Some(0), "{said}");
    let rows = told["solvers"]["motion"].as_array().unwrap();
    assert_eq!((rows.len(), &rows[0]["outcome"], &rows[0]["count"]), (1, &0.into(), &60.into()));
}

/// 3 kg and 2 kg over a pulley for a second: a fifth of the fall.
#[test]
fn weights_over_a_pulley_in_motion() {
    let text = "joints = { D = { at_m = [0, 0, 0] }, E = { at_m = [1, 0, 0] }, P = { mass_kg = 3 }, Q = { mass_kg = 2 } }\n\
                bars = [{ from = 'P', via = ['D', 'E'], to = 'Q', length_m = 5, kind = 'cable' }]";
    let problem = Problem::parse(text, "weights.toml").unwrap();
    let at = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.5], [1.0, 0.0, -2.5]];
    let moved = Simulate::new().start(Start::Joints(at)).time_s(1.0).run(&problem).unwrap();
    let end = moved.stored.last().unwrap();
    assert!((end.joints_m[2][2] + 1.5 + G / 10.0).abs() < 1e-9, "{:?}", end.joints_m);
    assert!((end.axial_n[0] - 2.4 * G).abs() < 1e-9, "{:?}", end.axial_n);
    // At rest nothing holds them.
    let refused = Simulate::new().run(&problem).unwrap_err().to_string();
    assert!(refused.contains("jams"), "{refused}");
}

/// Released 1 m below their pulleys 5 kg falls by G/8 and 3 kg rises, until at 2/√(G/4) s it is at its pulley.
#[test]
fn a_motion_ends_where_a_weight_comes_to_its_pulley() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let text = "joints = { D = { at_m = [0, 0, 0] }, P = { mass_kg = 5 }, Q = { mass_kg = 3 } }\n\
                bars = [{ from = 'P', via = ['D'], to = 'Q', length_m = 2, kind = 'cable' }]";
    std::fs::write(at("weights.toml"), text).unwrap();
    std::fs::write(at("above.csv"), "joint,x_m,y_m,z_m\nD,0,0,0\nP,0,0,-1\nQ,0,0,-1\n").unwrap();
    let release = ["simulate", "weights.toml", "--from", "above.csv", "--time", "2"];
    let more = ["--step", "1e-3", "--store", "0.01", "--out", "ends.csv"];
    let (code, said, error) = crate::run::run(&folder, &[&release[..], &more[..]].concat());
    assert_eq!(code, Some(3), "{said}{error}");
    assert!(said.contains("The motion ends before 2 s: the rope (member 1) jams"), "{said}");
    let rows = std::fs::read_to_string(at("ends.csv")).unwrap();
    let last: f64 = rows.lines().last().unwrap().split(',').next().unwrap().parse().unwrap();
    let end_s = (8.0 / G).sqrt();
    assert!(last < end_s && last > end_s - 0.02, "{last} of {end_s}");
}

/// `T = W/(2 cos a)` with `sin a = d/L`, over the length and over the place of an end; without the rope the ring
/// falls.
#[test]
fn studies_and_losses_of_a_rope() {
    for (vary, value, tension) in [
        ("bars.1.length_m=4.5..6:4", &(|k: f64| 4.5 + 0.5 * k) as &dyn Fn(f64) -> f64, true),
        ("joints.B.at_m.x=3..4.5:4", &|k: f64| 3.0 + 0.5 * k, false),
    ] {
        let arguments = ["study", "ring.toml", "--vary", vary, "--of", "bars.1.axial_n", "--json"];
        let (code, found, said) = run(&arguments);
        assert_eq!(code, Some(0), "{said}");
        let points = found["points"].as_array().unwrap();
        assert_eq!(points.len(), 4);
        for (k, point) in points.iter().enumerate() {
            let at = value(k as f64);
            let sin = if tension { 4.0 / at } else { at / 5.0 };
            let told = 10.0 * G / (2.0 * (1.0 - sin * sin).sqrt());
            let found = point["of"][0].as_f64().unwrap();
            assert!((found - told).abs() < 1e-9 * told, "{vary} {at}: {found}, not {told}");
        }
    }
    let problem = Problem::parse(RING, "ring.toml").unwrap();
    let found = Solve::new().without_each(&problem).unwrap();
    let [loss] = found.losses() else { panic!("one") };
    assert!(loss.left.as_ref().is_err_and(|reason| reason.outcome == Outcome::Falls));
}

/// Two rings: P of 10 kg on a rope of 5 m between A and B, 4 m apart and B 1 m higher; Q of 3 kg on one of 7 m between
/// C and D, 4.2 m apart and level. Where they hang is known: both spans lean by `a` with `sin a = d/L`.
fn two_rings() -> Problem {
    Problem::parse(
        "gravity_m_s2 = 9.8\n[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [4, 0, 1] }\n\
         C = { at_m = [0, 3, 0] }\nD = { at_m = [4.2, 3, 0] }\nP = { mass_kg = 10 }\nQ = { mass_kg = 3 }\n\
         [[bars]]\nfrom = \"A\"\nto = \"B\"\nvia = [\"P\"]\nkind = \"cable\"\nlength_m = 5\n\
         [[bars]]\nfrom = \"C\"\nto = \"D\"\nvia = [\"Q\"]\nkind = \"cable\"\nlength_m = 7\n",
        "rings.toml",
    )
    .unwrap()
}

/// 98 N 1 m below A, 29.4 N 2.8 m (5.6/7 of 3.5 m) and more below C: the energy is convex, and has no other rest.
const ENERGY_J: f64 = -98.0 - 29.4 * 2.8;

#[test]
fn starts_anywhere_lead_to_the_one_rest_of_rings() {
    let found = Sweep::new(40).run(&two_rings()).unwrap();
    let [one] = &found.equilibria[..] else { panic!("{:?}", found.equilibria) };
    assert!((one.energy_j - ENERGY_J).abs() < 1e-9, "{}", one.energy_j);
    let places = one.joints_m.as_ref().unwrap();
    for (joint, wanted) in [(4, [4.0 / 3.0, 0.0, -1.0]), (5, [2.1, 3.0, -2.8])] {
        for axis in 0..3 {
            assert!((places[joint][axis] - wanted[axis]).abs() < 1e-9, "{places:?}");
        }
    }
}

#[test]
fn the_basin_of_rings_at_rest_is_everywhere() {
    let found = Basins::new().size(6).joint("P").run(&two_rings()).unwrap();
    assert_eq!(found.equilibria().len(), 1, "{:?}", found.equilibria());
    for solver in [SolverName::LAGRANGE, SolverName::ENERGY] {
        assert!(found.outcomes(&solver).unwrap().outcome.iter().all(|outcome| *outcome == 0));
    }
    // As far as the rope is long, about where P hangs.
    let [[from, to], _] = found.ranges();
    assert!((to - from - 10.0).abs() < 1e-9, "{from} {to}");
}

/// A boom with a counterweight over a pulley stands in balance, or hangs lower: what `solve` shows is what derivatives and
/// load paths are of, and what jams has none.
#[test]
fn derivatives_and_paths_are_of_what_solve_shows() {
    let boom = |pulley: [f64; 3], boom: [f64; 3], counter: [f64; 2]| {
        let [mass_kg, length_m, at_top_kg] = boom;
        let [counter_kg, rope_m] = counter;
        let text = json!({
            "joints": { "A": { "at_m": [0, 0, 0] }, "K": { "at_m": pulley }, "T": { "mass_kg": at_top_kg },
                "W": { "mass_kg": counter_kg } },
            "bars": [{ "from": "A", "to": "T", "length_m": length_m, "mass_kg": mass_kg },
                { "from": "T", "to": "W", "kind": "cable", "length_m": rope_m, "via": ["K"] }],
        });
        edited::problem(&text)
    };
    let low = boom([0.734, -0.248, 1.521], [2.75, 1.9182, 10.62], [13.01, 3.5456]);
    let answer = Solve::new().run(&low).unwrap();
    assert!(answer.agrees());
    let z_m = answer.equilibria()[0].joints_m[2][2];
    assert!((z_m + 1.689_68).abs() < 1e-5, "{z_m}");
    let found = Derivatives::new().run(&low).unwrap();
    assert!((found.equilibrium().joints_m[2][2] - z_m).abs() < 1e-9);
    let trace = Trace::new().vary("loads=1..1.01").unwrap().run(&low).unwrap();
    let first = &trace.load_paths().unwrap().paths()[0].points[0];
    assert!((first.joints_m[2][2] - z_m).abs() < 1e-9 && trace.checks_agree());
}

/// Cables and ropes alone have a convex energy: where one goes slack under a load that stays, no direction falls and nothing
/// branches, whatever rounding makes of pivots that vanish.
#[test]
fn no_rope_loses_its_stability() {
    for (lifted, most) in [
        (
            json!({ "C": { "at_m": [0, 0, 0] }, "B": { "at_m": [2, 0, 0] }, "R": { "mass_kg": 1, "force_n": [0, 0, 1] },
            "S": { "mass_kg": 1 } }),
            30,
        ),
        (
            json!({ "C": { "at_m": [0, 0, 0] }, "B": { "at_m": [4, 0, 1] }, "R": { "mass_kg": 10, "force_n": [0, 0, 1] } }),
            90,
        ),
    ] {
        let mut bars =
            vec![json!({ "from": "C", "to": "B", "kind": "cable", "length_m": 5, "via": ["R"] })];
        if lifted.get("S").is_some() {
            bars.push(
                json!({ "from": "R", "to": "S", "kind": "cable", "length_m": 1, "mass_kg": 0 }),
            );
        }
        let problem = edited::problem(&json!({ "joints": lifted, "bars": bars }));
        let vary = format!("joints.R.force_n.z=0..{most}");
        let trace = Trace::new().vary(&vary).unwrap().run(&problem).unwrap();
        let path = &trace.load_paths().unwrap().paths()[0];
        assert!(path.points.iter().all(|point| point.index == 0), "{trace}");
        assert!(path.events.iter().all(|event| event.kind == LoadEventKind::Kink), "{trace}");
        assert!(trace.checks_agree(), "{trace}");
    }
}

/// A support that moves is where energies are counted from.
#[test]
fn paths_along_the_first_support_are_confirmed() {
    let joints =
        json!({ "A": { "at_m": [0, 0, 0] }, "B": { "at_m": [4, 0, 1] }, "R": { "mass_kg": 10 } });
    let bars = json!([{ "from": "A", "to": "B", "kind": "cable", "length_m": 5, "via": ["R"] }]);
    let problem = edited::problem(&json!({ "joints": joints, "bars": bars }));
    let trace = Trace::new().vary("joints.A.at_m.z=0..-0.2").unwrap().run(&problem).unwrap();
    assert!(trace.checks_agree(), "{trace}");
}

/// 2 kg on a ring, beside it a cable that just reaches it: half of the weight is 9.807 N on each side, and -2e-13 N in the cable
/// are rounding.
#[test]
fn a_cable_that_just_reaches_is_no_violation() {
    let joints = json!({ "A": { "at_m": [0.5, 0, 0.5] }, "B": { "at_m": [0, 0.5, 0.5] }, "R": { "mass_kg": 2 } });
    let bars = json!([
        { "from": "B", "to": "R", "kind": "cable", "length_m": 3.5, "mass_kg": 0 },
        { "from": "B", "to": "A", "kind": "cable", "length_m": 7, "via": ["R"] },
    ]);
    let answer =
        Solve::new().run(&edited::problem(&json!({ "joints": joints, "bars": bars }))).unwrap();
    assert!(answer.agrees(), "{answer}");
    // Both strands lean by √(1/8) over 3.5 m.
    let pull_n = G / (1.0 - 0.125 / 12.25_f64).sqrt();
    assert!((answer.equilibria()[0].axial_n[1] - pull_n).abs() < 1e-9, "{answer}");
}

/// A ring beside a pulley, 9 cm from it, and rings that jam elsewhere than one solver looked first: each solver is asked again
/// next to what the other has found.
#[test]
fn a_jam_that_one_solver_alone_sees_is_looked_at_again() {
    let joints = json!({ "A": { "at_m": [0, 0, 0] }, "C": { "at_m": [0.15, 0, -1.9] }, "P": { "mass_kg": 2 },
        "W": { "mass_kg": 6 } });
    let bars = json!([
        { "from": "A", "to": "P", "kind": "cable", "length_m": 2, "mass_kg": 0 },
        { "from": "C", "via": ["P"], "to": "W", "kind": "cable", "length_m": 4 },
    ]);
    let answer =
        Solve::new().run(&edited::problem(&json!({ "joints": joints, "bars": bars }))).unwrap();
    assert!(answer.agrees(), "{answer}");
    let [_, c, p, w] = answer.equilibria()[0].joints_m[..] else { panic!("four joints") };
    // The rope keeps its length, W hangs below the ring.
    let span_m = ((c[0] - p[0]).powi(2) + (c[2] - p[2]).powi(2)).sqrt();
    assert!((span_m + p[2] - w[2] - 4.0).abs() < 1e-12 && span_m > 0.09, "{span_m}");
}
