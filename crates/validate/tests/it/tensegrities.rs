//! Tensegrities that nothing but their prestress holds: known stresses, by both solvers, and that they are stable.

use energy::net::Settings as ByEnergy;
use lagrange::net::Settings as ByForces;
use model::cases::exhibit;
use model::system::{Joint, Kind, Member, System, SystemEquilibrium};
use model::{Bar, Rung, Vector};
use validate::Solvers;
use validate::systems::{SystemFailure, ask};

use crate::common::{agreed, close};

/// Relative to the largest number of its kind: both solvers reach 3e-14.
const DIGITS: f64 = 1e-11;

/// The system, and both answers, which agree and are proved to be the only ones near.
fn answers(name: &str) -> (System, Vec<SystemEquilibrium>) {
    let system = exhibit(name).unwrap().system();
    assert!(system.is_unloaded() && system.refusal().is_ok());
    let answers = agreed(&system);
    for e in &answers {
        assert!(e.evidence.rung() >= Some(Rung::Verified), "{name}: {:#?}", e.evidence.ladder);
        let most = e.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
        // It stands by itself: no support bears a force.
        let borne = e.reactions_n.iter().flatten().fold(0.0, |most: f64, n| most.max(n.abs()));
        assert!(borne <= DIGITS * most, "{name}: {borne} N on a support");
    }
    (system, answers)
}

/// Force densities, N/m, each with the names of the ends of its member.
fn densities(system: &System, e: &SystemEquilibrium) -> Vec<(Kind, String, f64)> {
    let members = system.members().iter().zip(&e.axial_n);
    members
        .map(|(member, axial_n)| {
            let [a, b] = [member.from, member.to];
            let d = [0, 1, 2].map(|c| e.joints_m[b][c] - e.joints_m[a][c]);
            let name = format!("{}-{}", system.joints()[a].name, system.joints()[b].name);
            (member.kind, name, axial_n / d[0].hypot(d[1]).hypot(d[2]))
        })
        .collect()
}

#[test]
fn the_cross_has_force_densities_of_one_and_minus_one() {
    let (system, answers) = answers("x-cross");
    for e in &answers {
        for (kind, _, density) in densities(&system, e) {
            close(density, if kind == Kind::Cable { 500.0 } else { -500.0 });
        }
    }
}

#[test]
fn the_prism_stands_twisted_by_150_degrees() {
    let (system, answers) = answers("prism");
    let (q, r, h): (f64, f64, f64) = (900.0, 1.0, 1.5);
    for e in &answers {
        for (kind, name, density) in densities(&system, e) {
            let level = name.matches('B').count() != 1;
            close(
                density,
                match kind {
                    Kind::Cable if level => q / 3.0_f64.sqrt(),
                    Kind::Cable => q,
                    _ => -q,
                },
            );
        }
        let top = e.joints_m[system.joint("T1").unwrap()];
        let angle = 270.0_f64.to_radians();
        for (found, wanted) in top.into_iter().zip([r * angle.cos(), r * angle.sin(), h]) {
            assert!((found - wanted).abs() < DIGITS, "{found} is not {wanted}");
        }
    }
}

#[test]
fn the_struts_of_the_expandable_octahedron_have_minus_three_halves_of_its_cables() {
    let (system, answers) = answers("expandable-octahedron");
    for e in &answers {
        for (kind, _, density) in densities(&system, e) {
            close(density, if kind == Kind::Cable { 400.0 } else { -600.0 });
        }
    }
}

/// Each prism has a stress of its own: two, and any sum of them holds the tower.
#[test]
fn the_stresses_of_the_prisms_of_a_tower_add_up() {
    let (system, answers) = answers("simplex-tower");
    let q = 900.0;
    for e in &answers {
        for (kind, name, density) in densities(&system, e) {
            let storeys: Vec<char> = name.chars().filter(|c| c.is_alphabetic()).collect();
            close(
                density,
                match (kind, storeys[0] == storeys[1]) {
                    (Kind::Cable, true) if storeys[0] == 'T' => 2.0 * q / 3.0_f64.sqrt(),
                    (Kind::Cable, true) => q / 3.0_f64.sqrt(),
                    (Kind::Cable, false) => q,
                    _ => -q,
                },
            );
        }
    }
}

/// With cables and struts exchanged the stress of the cross turns its sign: it pushes the square out of its plane, and
/// there is nothing to hold it.
#[test]
fn the_wrong_sign_of_a_stress_holds_nothing() {
    let (system, answers) = answers("x-cross");
    let exchanged = |member: &Member| {
        member.clone().of_kind(if member.kind == Kind::Strut { Kind::Cable } else { Kind::Strut })
    };
    let drawn = system.joints().iter().zip(&answers[0].joints_m);
    let joints = drawn.map(|(joint, at_m)| joint.clone().near(*at_m)).collect();
    let members = system.members().iter().map(exchanged).collect();
    let other = System::new("exchanged", 9.81, joints, members).unwrap();
    let answer = ask(&other, Solvers::Both, &|_| {});
    let holds = |e: &SystemEquilibrium| {
        e.stability.index_in_space == 0 && e.axial_n.iter().any(|n| n.abs() > 1.0)
    };
    assert!(!answer.equilibria.iter().any(holds), "{answer:?}");
}

/// A joint on a taut string is where its parts pull alike.
#[test]
fn a_taut_string_bears_its_prestress() {
    let body = |length: f64| Bar::homogeneous(length, 0.0).unwrap();
    let joints =
        vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [1.0, 0.0, 0.0]), Joint::free("P")];
    let cable = |from, to, length| {
        Member::cable(from, to, body(length)).with_stiffness(1e4).with_prestress(100.0).unwrap()
    };
    let members = vec![cable(0, 2, 0.4), cable(2, 1, 0.6)];
    let string = System::new("string", 9.81, joints, members).unwrap();
    for e in &agreed(&string) {
        assert_eq!(e.stability.index_in_space, 0);
        close(e.axial_n[0], 100.0);
        close(e.axial_n[1], 100.0);
        close(e.joints_m[2][0], 0.4);
    }
}

/// Elastic members without load and without prestress: nothing decides the shape, and both solvers
/// say so.
#[test]
fn without_load_and_prestress_there_is_no_answer() {
    let joints =
        vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [1.0, 0.0, 0.0]), Joint::free("P")];
    let slack =
        |from, to| Member::cable(from, to, Bar::homogeneous(0.8, 0.0).unwrap()).with_stiffness(1e4);
    let system = System::new("loose", 9.81, joints, vec![slack(0, 2), slack(2, 1)]).unwrap();
    assert!(system.refusal().is_ok());
    let answer = ask(&system, Solvers::Both, &|_| {});
    assert!(answer.equilibria.is_empty(), "{answer:?}");
    assert_eq!(answer.failures.len(), 2);
}

/// Without one of its members a prism is limp where it weighs nothing: no shape is the only one. With 2 kg in each bar
/// it comes down from its drawing, and both solvers know where to.
#[test]
fn a_prism_that_has_lost_a_member_does_not_stand() {
    let (light, stands) = answers("prism");
    let places_m = &stands[0].joints_m;
    let middle = places_m.iter().map(|at| at[2]).sum::<f64>() / places_m.len() as f64;
    let on_anchors = |heavy_kg: f64| {
        let joints = light.joints().iter().zip(places_m).map(|(joint, at_m)| {
            let name = joint.name.to_string();
            if at_m[2] < middle {
                Joint::anchor(name, *at_m)
            } else {
                Joint::free(name).near(*at_m)
            }
        });
        let members = light.members().iter().map(|member| {
            let body = Bar::homogeneous(member.body.length_m(), heavy_kg).unwrap();
            let same = Member::bar(member.from, member.to, body).of_kind(member.kind);
            match member.stiffness_n {
                Some(stiffness_n) => same.with_stiffness(stiffness_n),
                None => same,
            }
        });
        System::new("prism", 9.81, joints.collect(), members.collect()).unwrap()
    };
    for heavy_kg in [0.0, 2.0] {
        let whole = on_anchors(heavy_kg);
        for member in 0..whole.members().len() {
            let [a, b] = [whole.members()[member].from, whole.members()[member].to];
            let held = [a, b].map(|joint| whole.joints()[joint].support.is_fixed());
            if held == [true, true] {
                continue;
            }
            let (left, _) = whole.without(member);
            let answer = ask(&left, Solvers::Both, &|_| {});
            if heavy_kg > 0.0 {
                assert!(answer.agrees(), "{member}: {:?} {:?}", answer.agreement, answer.failures);
                assert!(!answer.near.unwrap().is_neighbour, "{member}");
            } else {
                assert!(answer.equilibria.is_empty() && answer.failures.len() == 2, "{member}");
                assert!(answer.failures.iter().all(SystemFailure::is_unloaded), "{member}");
            }
        }
    }
}

/// A prestressed net from other places: elastic systems without loads have no force to begin with
/// but that of their lengths.
#[test]
fn both_solvers_come_back_from_displaced_places() {
    let (system, answers) = answers("prism");
    let aside = |k: usize| (1.0 + 7.0 * k as f64).sin();
    let start: Vec<Vector> = answers[0]
        .joints_m
        .iter()
        .enumerate()
        .map(|(k, x)| {
            [x[0] + 0.2 * aside(k), x[1] + 0.2 * aside(k + 50), x[2] + 0.2 * aside(k + 99)]
        })
        .collect();
    let found = energy::net::minimise_from(&system, &start, &ByEnergy::default()).unwrap();
    let seed = lagrange::net::Seed::at(start);
    let other = lagrange::net::solve_from(&system, &seed, &ByForces::default()).unwrap();
    for e in [found.equilibrium, other.equilibrium] {
        for (found, wanted) in e.axial_n.iter().zip(&answers[0].axial_n) {
            close(*found, *wanted);
        }
    }
}

/// A net without loads, of which one force density is changed: the places of the file are no
/// equilibrium of it, and the minimiser that begins there has the forces of their lengths alone.
#[test]
fn a_prestressed_net_is_minimised_from_places_that_are_not_its_own() {
    let nodes = include_str!("../../data/external/force-density/olympia-nodes.csv");
    let edges = include_str!("../../data/external/force-density/olympia-edges.csv");
    let net = formats::system::parse_net((nodes, "nodes"), (edges, "edges"), "Olympia").unwrap();
    let rested = |factor: f64| {
        let mut net = net.clone();
        net.edges[100].density_n_m *= factor;
        let system = net.system_at(&net.places_m(), "Olympia").unwrap();
        assert!(system.is_unloaded());
        let places_m = net.places_m();
        let found = energy::net::minimise_from(&system, &places_m, &ByEnergy::default()).unwrap();
        let seed = lagrange::net::Seed::at(net.places_m());
        let other = lagrange::net::solve_from(&system, &seed, &ByForces::default()).unwrap();
        let far = |a: &[Vector], b: &[Vector]| {
            let distances =
                a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2]));
            distances.fold(0.0, f64::max)
        };
        let (mine, others) = (&found.equilibrium.joints_m, &other.equilibrium.joints_m);
        // Tens of metres wide: 1e-9 m is the digits of the file.
        assert!(far(mine, others) < 1e-9, "{}", far(mine, others));
        far(mine, &net.places_m())
    };
    assert!(rested(1.0) < 1e-6);
    assert!(rested(5.0) > 1e-3);
}

/// A tendon of 20 parts under 100 kN sinks by `w L²/8 F` under 0.35 kg; a string of 4 mg under 70 N. What they store is far
/// more than what their loads do, and its rounding is no disagreement.
#[test]
fn light_loads_on_a_tight_string_leave_the_rounding_of_what_it_stores() {
    for (mass_kg, prestress_n) in [(0.35, 1e5), (4e-6, 70.0)] {
        let at = |k: u32| [0.65 * f64::from(k) / 20.0, 0.0, 0.0];
        let free = |k: u32| Joint::free(k.to_string()).with_mass(mass_kg / 20.0).near(at(k));
        let mut joints = vec![Joint::anchor("A", at(0))];
        joints.extend((1..20).map(free));
        joints.push(Joint::anchor("B", at(20)));
        let part = |k| {
            let body = Bar::homogeneous(at(1)[0], 0.0).unwrap();
            let cable = Member::cable(k, k + 1, body).with_stiffness(100.0 * prestress_n);
            cable.with_prestress(prestress_n).unwrap()
        };
        let system = System::new("string", 9.81, joints, (0..20).map(part).collect()).unwrap();
        let answer = ask(&system, Solvers::Both, &|_| {});
        assert!(answer.agrees(), "{:?} {:?}", answer.agreement, answer.failures);
        let sag = mass_kg * 9.81 / 20.0 * 0.65 * 20.0 / (8.0 * prestress_n);
        let found = -answer.equilibria[0].joints_m[10][2];
        assert!((found / sag - 1.0).abs() < 1e-6, "{found} {sag}");
    }
}
