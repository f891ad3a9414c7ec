//! What must not matter to a system of mixed members, and what elastic ones tend to.

use model::Bar;
use model::cases::Case;
use model::system::{Member, PointLoad, System, SystemEquilibrium};
use validate::Solvers;
use validate::systems::ask;

use crate::networks::{Members, bridle, net, tree};

/// What two answers to one question may differ by, in units of the length and of the largest force:
/// the solvers' tolerance times the softness of the shapes drawn.
const ROUNDING: f64 = 1e-8;

/// Systems of bars, cables and springs whose shape both solvers agree on.
fn systems() -> Vec<(System, Vec<SystemEquilibrium>)> {
    let drawn = (0..12).flat_map(|seed| [bridle, tree, net].map(|draw| draw(Members::Mixed, seed)));
    let solved = drawn.filter_map(|system| answers(&system).map(|found| (system, found)));
    solved.collect()
}

/// The answers of both, where they agree.
fn answers(system: &System) -> Option<Vec<SystemEquilibrium>> {
    system.refusal().ok()?;
    let answer = ask(system, Solvers::Both, &|_| {});
    answer.agrees().then_some(answer.equilibria)
}

/// Whether forces and heights are the same: parts may turn freely about verticals.
#[track_caller]
fn same(found: &SystemEquilibrium, wanted: &SystemEquilibrium) {
    let largest = wanted.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
    for (a, b) in found.axial_n.iter().zip(&wanted.axial_n) {
        assert!((a - b).abs() < ROUNDING * largest, "{a} {b} of {largest}");
    }
    let size = wanted.joints_m.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (a, b) in found.joints_m.iter().zip(&wanted.joints_m) {
        assert!((a[2] - b[2]).abs() < ROUNDING * size, "{a:?} {b:?}");
    }
    let (energy_j, wanted_j) = (found.energy_j, wanted.energy_j);
    assert!((energy_j - wanted_j).abs() < ROUNDING * largest * size, "{energy_j} {wanted_j}");
    assert_eq!(found.stability.index_in_space, wanted.stability.index_in_space);
}

/// The same member from its other end.
fn reversed(member: &Member) -> Member {
    let body = &member.body;
    let (length, centre) = (body.length_m(), body.length_m() - body.centre_m());
    let turned = |load: &PointLoad| PointLoad { at_m: length - load.at_m, ..*load };
    member
        .clone()
        .between(member.to, member.from)
        .with_body(Bar::new(length, body.mass_kg(), centre, body.inertia_kg_m2()).unwrap())
        .with_loads(member.loads.iter().map(turned).collect())
}

#[test]
fn members_may_run_either_way() {
    let systems = systems();
    assert!(systems.len() > 20, "{}", systems.len());
    for (system, answers_before) in systems {
        let every_second = system.members().iter().enumerate();
        let members = every_second
            .map(|(k, member)| if k % 2 == 0 { reversed(member) } else { member.clone() });
        let joints = system.joints().to_vec();
        let turned =
            System::new("turned", system.gravity_m_s2(), joints, members.collect()).unwrap();
        for (found, wanted) in answers(&turned).unwrap().iter().zip(&answers_before) {
            same(found, wanted);
            // The force at the start of the one is that at the end of the other.
            let largest = wanted.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
            let (a, b) = (found.start_forces_n[0][2], wanted.end_forces_n[0][2]);
            assert!((a - b).abs() < ROUNDING * largest, "{a} {b}");
        }
    }
}

/// Numbers of an answer by their keys, each over the unit that its key ends with; seconds are left out.
fn numbers(found: &serde_json::Value, key: &str, units: [f64; 3], all: &mut Vec<(String, f64)>) {
    let [length, mass, gravity] = units;
    match found {
        serde_json::Value::Number(number) if !key.ends_with("_s") => {
            let last = key.rsplit('_').next().unwrap_or_default();
            let unit = match last {
                "m" => length,
                "n" => mass * gravity,
                "j" => mass * gravity * length,
                _ => 1.0,
            };
            all.push((key.to_owned(), number.as_f64().unwrap() / unit));
        }
        serde_json::Value::Array(items) => {
            for item in items {
                numbers(item, key, units, all);
            }
        }
        serde_json::Value::Object(items) => {
            for (key, item) in items {
                numbers(item, key, units, all);
            }
        }
        _ => {}
    }
}

/// Not a digit of an answer changes with its units: neither of both equilibria with their evidence, nor of how far
/// they are from each other and from balance.
#[test]
fn answers_scale_without_rounding() {
    assert_scaled(systems().into_iter().map(|(system, _)| system));
}

#[test]
fn answers_of_ropes_scale_without_rounding() {
    assert_scaled(samples::ropes().into_iter().map(|sample| sample.system));
}

#[test]
fn answers_of_the_gallery_scale_without_rounding() {
    assert_scaled(model::cases::systems().map(Case::system));
}

fn assert_scaled(systems: impl Iterator<Item = System>) {
    for system in systems {
        let found = |units: [f64; 3]| {
            let answer = ask(&samples::scaled(&system, units), Solvers::Both, &|_| {});
            assert!(answer.agrees(), "{} {units:?}", system.name());
            let mut all = vec![];
            let equilibria = answer.equilibria.iter().map(|found| {
                serde_json::json!({
                    "joints_m": found.joints_m, "axial_n": found.axial_n,
                    "start_forces_n": found.start_forces_n, "end_forces_n": found.end_forces_n,
                    "reactions_n": found.reactions_n, "energy_j": found.energy_j,
                    "stability": found.stability, "evidence": found.evidence,
                })
            });
            let agreement = serde_json::to_value(&answer.agreement).unwrap();
            let value = serde_json::Value::Array(equilibria.chain([agreement]).collect());
            numbers(&value, "", units, &mut all);
            all
        };
        let one = found([1.0; 3]);
        assert!(one.len() > 100, "{}", one.len());
        for units in [[0.125, 1.0, 1.0], [1.0, 256.0, 0.5], [1024.0, 0.03125, 4.0]] {
            assert_eq!(one, found(units), "{} {units:?}", system.name());
        }
    }
}

/// The shape of springs is that of bars up to their flexibility, to first order: ten times as stiff
/// is ten times as near, by either solver.
#[test]
fn elastic_shapes_tend_to_the_rigid_one_at_order_one() {
    let nets = (0..8).map(|seed| net(Members::Bars, seed));
    let solved: Vec<_> =
        nets.filter_map(|bars| answers(&bars).map(|found| (bars, found))).collect();
    assert!(solved.len() >= 3, "{}", solved.len());
    for (bars, rigid) in solved {
        let soft = |stiffness_n: f64| {
            let members = bars.members().iter().map(|bar| bar.clone().with_stiffness(stiffness_n));
            let joints = bars.joints().to_vec();
            let system = System::new("soft", bars.gravity_m_s2(), joints, members.collect());
            answers(&system.unwrap()).unwrap()
        };
        let (near, nearer) = (soft(1e8), soft(1e9));
        for solver in 0..2 {
            let away = |answer: &SystemEquilibrium| {
                let joints = answer.joints_m.iter().zip(&rigid[solver].joints_m);
                joints.map(|(a, b)| (a[2] - b[2]).abs()).fold(0.0, f64::max)
            };
            let order = (away(&near[solver]) / away(&nearer[solver])).log10();
            assert!((order - 1.0).abs() < 0.02, "{order}");
        }
    }
}
