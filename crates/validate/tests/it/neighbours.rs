//! Which equilibrium is next to a drawing: barriers, rough drawings, what moves freely, and drawings between two shapes.

use model::system::{Joint, Kind, Member, Support, System};
use model::{Bar, STANDARD_GRAVITY_M_S2 as G};
use validate::Solvers;
use validate::systems::{Near, ask};

use crate::drawn::{close, neighbour, written};

/// Two elastic bars of 5 m over feet 6 m apart, drawn up and found down: on the way through the
/// level each is 2 m shorter, which is 1e3 N (2 m)²/(2 · 5 m) in each.
#[test]
fn what_has_snapped_through_is_no_neighbour() {
    let joint = |name: &str, x: f64| Joint::anchor(name, [x, 0.0, 0.0]);
    let joints = vec![
        joint("A", -3.0),
        joint("B", 3.0),
        Joint::free("P").near([0.0, 0.0, 4.0]).with_force([0.0, 0.0, -1e-3]),
    ];
    let body = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = [0, 1].map(|foot| Member::bar(foot, 2, body).with_stiffness(1e3)).to_vec();
    let system = System::new("two bars", 10.0, joints, members).unwrap();
    let mut answer = ask(&system, Solvers::Lagrange, &|_| {});
    let mut down = answer.equilibria.remove(0);
    down.joints_m[2] = [0.0, 0.0, -4.0];
    let near = Near::of(&system, &system.drawing().unwrap(), &down);
    assert!(!near.is_neighbour && near.joint == "P");
    assert!((near.moved_m - 8.0).abs() < 1e-12 && (near.moved - 1.6).abs() < 1e-12);
    // Less the 4 m that the load has sunk there.
    assert!((near.barrier_j.unwrap() - (800.0 - 4e-3)).abs() < 1e-9, "{near:?}");
}

/// A mast of 10 m between a force of 2 kN and a guy of EA = 40 kN, which turns by a tenth of its length. As long as it keeps
/// its length it leans to where the guy has the moment of the force: on the straight way there it is 0.3 % shorter, and a stiff
/// one would store far more than the guy. Of two bars that have snapped through the barrier is on every way.
#[test]
fn a_stiff_bar_that_turns_has_passed_no_barrier() {
    let mast = |stiffness_n: f64| {
        let joints = vec![
            Joint::anchor("base", [0.0; 3]),
            Joint::anchor("guy", [-10.0, 0.0, 0.0]),
            Joint::free("top").with_force([2000.0, 0.0, 0.0]).near([0.0, 0.0, 10.0]),
        ];
        let joints = joints.into_iter().map(|joint| {
            let is_top = joint.support == Support::Free;
            let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
            if is_top { joint.held_by(plane) } else { joint }
        });
        let bar = |from: usize, length_m: f64, stiffness_n: f64| {
            Member::bar(from, 2, Bar::homogeneous(length_m, 0.0).unwrap())
                .with_stiffness(stiffness_n)
        };
        let guy = bar(1, 200.0_f64.sqrt(), 4e4).of_kind(Kind::Cable);
        let members = vec![bar(0, 10.0, stiffness_n), guy];
        System::new("mast", G, joints.collect(), members).unwrap()
    };
    // The moments about the base of a rigid mast that leans by x: 2000 z = N 10 z / l, l² = 200 + 20 x.
    let length_m = |x: f64| (200.0 + 20.0 * x).sqrt();
    let rest = |x: f64| 4e4 * (length_m(x) / 200.0_f64.sqrt() - 1.0) * 10.0 / length_m(x) - 2000.0;
    let rigid = samples::root(rest, [0.0, 5.0]);
    for stiffness_n in [1e7, 1e8, 1e9] {
        let answer = neighbour(&mast(stiffness_n));
        for found in &answer.equilibria {
            let x = found.joints_m[2][0];
            assert!((x - rigid).abs() < 1e5 / stiffness_n, "{stiffness_n}: {x}, {rigid}");
        }
    }
}

/// Cables alone have one shape: also drawn upside down, 4.7 m from where it hangs, it is no other one.
#[test]
fn the_only_shape_of_cables_is_next_to_any_drawing() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [2.0, 0.0, 0.0]),
        Joint::free("P").with_mass(1.0).near([1.0, 0.0, 3.0]),
    ];
    let rope = |kind: Kind| {
        let bar = |from| Member::bar(from, 2, Bar::homogeneous(2.0, 0.0).unwrap()).of_kind(kind);
        System::new("rope", G, joints.clone(), vec![bar(0), bar(1)]).unwrap()
    };
    for found in &neighbour(&rope(Kind::Cable)).equilibria {
        close(&found.joints_m[2], &[1.0, 0.0, -3.0_f64.sqrt()], 1e-9);
    }
    // Bars stand.
    let answer = ask(&rope(Kind::Bar), Solvers::Both, &|_| {});
    assert!(answer.equilibria[0].joints_m[2][2] > 0.0 || !answer.near.unwrap().is_neighbour);
}

/// Hanging bars that are drawn roughly end where they hang, though joints move by more than half a member: the energy falls all the
/// way there. A gable under eight times its limit load has snapped through, and a triangle that is drawn upright has turned over: the
/// order of its joints is another one.
#[test]
fn what_hangs_is_next_to_a_rough_drawing_of_it() {
    let bars: Vec<String> = [("A", "P"), ("P", "Q"), ("Q", "R"), ("R", "B")]
        .map(|(from, to)| {
            format!("{{ from = \"{from}\", to = \"{to}\", length_m = 0.6, mass_kg = 1 }}")
        })
        .to_vec();
    let chain = written(&format!(
        "plane = \"xz\"\n\
         joints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{ near_m = [0.45, 0, -0.15] }}, Q = {{ near_m = [0.85, 0, -0.25], mass_kg = 3 }}, \
         R = {{ near_m = [1.5, 0, -0.2] }}, B = {{ at_m = [2, 0, 0] }} }}\n\
         bars = [{}]\n",
        bars.join(", ")
    ));
    let answer = neighbour(&chain);
    assert!(answer.near.unwrap().moved > 0.5);
    let gable = written(
        "plane = \"xz\"\n\
         joints = { A = { at_m = [-1, 0, 0] }, B = { at_m = [1, 0, 0] }, P = { near_m = [0, 0, 0.8], mass_kg = 800 } }\n\
         bars = [{ from = \"A\", to = \"P\", mass_kg = 0, stiffness_n = 1e4 },\n\
         { from = \"P\", to = \"B\", mass_kg = 0, stiffness_n = 1e4 }]\n",
    );
    let answer = ask(&gable, Solvers::Both, &|_| {});
    assert!(answer.agrees() && !answer.near.unwrap().is_neighbour);
    let triangle = written(include_str!("drawn/triangle.toml"));
    let answer = ask(&triangle, Solvers::Both, &|_| {});
    assert!(answer.agrees() && !answer.near.unwrap().is_neighbour);
}

/// A trust region from the drawing on, with inextensible bars, written apart from this workspace, ends at 784.409 J, 3.15e-5 m from
/// the drawing; 2.2e-3 m and 2.4e-3 m from it other minima lie lower.
#[test]
fn a_dome_with_minima_side_by_side_stays_next_to_its_drawing() {
    let answer = neighbour(&written(include_str!("drawn/dome.toml")));
    let moved_m = answer.near.unwrap().moved_m;
    assert!((moved_m - 3.15e-5).abs() < 1e-7, "{moved_m}");
    for found in &answer.equilibria {
        close(&[found.energy_j], &[784.409], 1e-3);
    }
}

/// What equilibrium leaves open is as it is drawn: a frame on rails whose leash is slack, 3.16 of 3.5 m, and a bracket that turns
/// about its anchors 1.5² - 1² = 0.5² + 1² beside their vertical, likewise. Drawn too far out, the bracket comes to rest in the
/// plane of the drawing.
#[test]
fn what_moves_freely_stays_where_it_is_drawn() {
    let rails = r#"
plane = "xz"
bars = [
  { from = "L", to = "T", mass_kg = 5 }, { from = "R", to = "T", mass_kg = 5 },
  { from = "L", to = "R", mass_kg = 1 },
  { from = "T", to = "W", kind = "cable", length_m = 3.5, mass_kg = 0 },
]
[joints]
L = { at_m = [-0.5, 0, 0], free = "x" }
R = { at_m = [0.5, 0, 0], free = "x" }
T = { near_m = [0, 0, 2], mass_kg = 80 }
W = { at_m = [3, 0, 1] }
"#;
    let bracket = |p: &str, leash_m: f64| {
        format!(
            r#"
bars = [
  {{ from = "A", to = "P", length_m = 1.5, mass_kg = 1 }}, {{ from = "B", to = "P", length_m = 1.5, mass_kg = 1 }},
  {{ from = "P", to = "W", kind = "cable", length_m = {leash_m}, mass_kg = 0 }},
  {{ from = "P", to = "V", kind = "cable", length_m = 3.1, mass_kg = 0 }},
]
[joints]
A = {{ at_m = [0, 0, 0] }}
B = {{ at_m = [0, 0, -2] }}
P = {{ near_m = {p}, mass_kg = 5 }}
W = {{ at_m = [-2.1, -2.4, -2] }}
V = {{ at_m = [-0.6, 1.2, 0] }}
"#
        )
    };
    for (text, joint, wanted) in [
        (rails.to_owned(), 2, [0.0, 0.0, 2.0]),
        (bracket("[0.5, 1.0, -1]", 4.4), 2, [0.5, 1.0, -1.0]),
        (bracket("[0.55, 1.1, -1]", 4.6), 2, [0.5, 1.0, -1.0]),
    ] {
        for e in neighbour(&written(&text)).equilibria {
            close(&e.joints_m[joint], &wanted, 1e-9);
        }
    }
}

/// Two soft bars drawn far too long, in a nearly level line: the energy falls to the shape above, 0.42 m away, and to that below,
/// 0.46 m, where a descent ends.
#[test]
fn a_drawing_between_two_shapes_has_no_neighbour() {
    let gable = written(
        r#"
plane = "xz"
bars = [
  { from = "A", to = "P", length_m = 1.0084, stiffness_n = 4596.029, mass_kg = 0 },
  { from = "B", to = "P", length_m = 1.1085, stiffness_n = 4596.029, mass_kg = 0 },
]
[joints]
A = { at_m = [0, 0, 0] }
B = { at_m = [2, 0, 0] }
P = { near_m = [1.2203, 0, 0.0162], mass_kg = 0.949 }
"#,
    );
    let answer = ask(&gable, Solvers::Both, &|_| {});
    assert!(answer.agrees() && !answer.is_decided(), "{:?}", answer.near);
}

/// A derrick without a force that holds its boom in one direction: a mast of 4 m on two guys, a boom of 6 m from its foot with
/// 1 kN on it, and the cable between their heads. Foot, head and load are as the triangle of the forces, so the boom bears
/// 1.5 kN; the guys what the cable pulls level, √27/4 kN, towards the boom. Each of its directions is an equilibrium, and that
/// is said; drawn beside its lengths, both solvers find the one next to the drawing.
#[test]
fn a_derrick_stays_where_its_boom_is_drawn() {
    let level = 27.0_f64.sqrt();
    for (turn, off_m) in [(0.0_f64, 0.0), (0.3, 0.0), (0.3, 1e-2), (-0.2, 0.1)] {
        let joints = vec![
            Joint::anchor("foot", [0.0, 0.0, 0.0]),
            Joint::anchor("left", [-4.0, 3.0, 0.0]),
            Joint::anchor("right", [-4.0, -3.0, 0.0]),
            Joint::free("head").near([0.0, 0.0, 4.0]),
            Joint::free("tip")
                .near([level * turn.cos() + off_m, level * turn.sin() - off_m, 3.0 + off_m])
                .with_force([0.0, 0.0, -1e3]),
        ];
        let member =
            |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
        let cable = |from, to, length_m| member(from, to, length_m).of_kind(Kind::Cable);
        let members = vec![
            member(0, 3, 4.0),
            member(0, 4, 6.0),
            cable(3, 4, 28.0_f64.sqrt()),
            cable(1, 3, 41.0_f64.sqrt()),
            cable(2, 3, 41.0_f64.sqrt()),
        ];
        let system = System::new("derrick", 10.0, joints, members).unwrap();
        let answer = neighbour(&system);
        let agreement = answer.agreement.as_ref().unwrap();
        for e in &answer.equilibria {
            // As what turns, as a joint whose place is open, or as a motion without resistance.
            let said = agreement.turned_parts + agreement.undetermined.len();
            assert_eq!(said + agreement.unresisted(e), 1);
            let [x, y, z] = e.joints_m[4];
            assert!((y.atan2(x) - turn).abs() < off_m + 1e-9 && (z - 3.0).abs() < 1e-9);
            // The guys pull 4 and ±3 level of their length: x = 4 (a + b)/√41 and y = 3 (b - a)/√41.
            let (sum, difference) = (250.0 * x / 4.0, 250.0 * y / 3.0);
            let guys = [0.5 * (sum - difference), 0.5 * (sum + difference)];
            let wanted = guys.map(|part| part * 41.0_f64.sqrt());
            close(&e.axial_n[1..2], &[-1500.0], 1e-6);
            close(&e.axial_n[3..], &wanted, 1e-6);
        }
    }
}
