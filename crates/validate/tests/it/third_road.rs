//! Cables as a second-order cone programme, solved by clarabel: a third road to the same answers.

use model::system::{Joint, Kind, Member, System};
use model::{Bar, Vector};
use validate::Solvers;
use validate::systems::{ConeError, ask, hang_as_cables};

use samples::{Shape, random_chain};

use crate::floor::net;

/// What clarabel's tolerance of 1e-9 leaves of energies, relative to their size: 1e-10 at worst.
const ENERGY: f64 = 1e-8;
/// And of forces, in units of the largest: 8e-6 at worst, 6e-5 where lengths differ by six orders.
const FORCE: f64 = 1e-4;

/// Nets of cables above a floor: energies and forces of three roads. Places of what lies loose are
/// nobody's.
#[test]
fn three_roads_lead_to_the_same_nets() {
    let (mut energies, mut forces): (f64, f64) = (0.0, 0.0);
    for seed in 1..=12_u64 {
        for elastic in [false, true] {
            let system = net(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15), elastic, false);
            let answer = ask(&system, Solvers::Both, &|_| {});
            assert!(answer.agrees(), "{seed} {elastic}");
            let cones = hang_as_cables(&system).unwrap();
            for e in &answer.equilibria {
                let largest = e.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
                energies = energies.max((e.energy_j - cones.energy_j).abs() / e.energy_j.abs());
                for (ours, theirs) in e.axial_n.iter().zip(&cones.axial_n) {
                    forces = forces.max((ours - theirs).abs() / largest);
                }
            }
        }
    }
    println!("energies {energies:.1e}, forces {forces:.1e}");
    assert!(energies < ENERGY && forces < FORCE, "energies {energies}, forces {forces}");
}

/// Chains of all hard shapes: where every bar is in tension the cables are the chain, else they hang
/// lower.
#[test]
fn chains_hang_as_cables_or_higher() {
    /// A bar that bears less than this part of the largest force may as well be slack.
    const TENSION: f64 = 1e-6;
    /// Of weight times length, where bars of all sizes are mixed: 7e-7 at worst, else 5e-9.
    const MIXED: f64 = 1e-5;
    let (mut taut, mut pressed) = (0, 0);
    for seed in 0..200 {
        let (shape, problem) = random_chain(seed);
        let settings = lagrange::condensed::Settings::default();
        let found = lagrange::condensed::solve(&problem, &settings).unwrap().equilibrium;
        let chain = problem.chain();
        let cones = hang_as_cables(&System::from(chain)).unwrap();
        let unit_j = chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m();
        let largest = found.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
        let higher = (found.energy_j - cones.energy_j) / unit_j;
        let what = format!("{seed}, {shape:?}: {higher:e}");
        if found.axial_n.iter().any(|n| *n <= TENSION * largest) {
            pressed += 1;
            assert!(higher > -ENERGY, "{what}");
            continue;
        }
        taut += 1;
        assert!(higher.abs() < if shape == Shape::Mixed { MIXED } else { ENERGY }, "{what}");
        // Small differences of lengths make large ones of these forces.
        if matches!(shape, Shape::Mixed | Shape::NearlyTaut | Shape::Together) {
            continue;
        }
        for (ours, theirs) in found.axial_n.iter().zip(&cones.axial_n) {
            assert!((ours - theirs).abs() < FORCE * largest, "{what}: {ours} {theirs}");
        }
    }
    assert!(taut > 100 && pressed > 50, "{taut} taut, {pressed} pressed");
}

/// Sliders, a force aside, an elastic member between anchors, and what is refused.
#[test]
fn supports_and_held_members_are_those_of_the_system() {
    let joints = vec![
        Joint::anchor("A", [0.0, 0.0, 0.0]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        Joint::free("P").with_mass(2.0).with_force([1.0, 2.0, 0.0]).held_by(
            model::system::Support::Plane { at_m: [1.0, 0.0, 0.0], normal: [0.6, 0.8, 0.0] },
        ),
    ];
    let body = |length: f64| Bar::homogeneous(length, 0.5).unwrap();
    let members = vec![
        Member::cable(0, 2, body(2.0)),
        Member::bar(2, 1, body(2.5)).with_stiffness(300.0),
        Member::cable(0, 1, body(2.9)).with_stiffness(100.0),
    ];
    let system = System::new("slider", 9.81, joints.clone(), members.clone()).unwrap();
    let cones = hang_as_cables(&system).unwrap();
    let answer = ask(&system, Solvers::Both, &|_| {});
    assert!(answer.agrees());
    for e in &answer.equilibria {
        for (ours, theirs) in e.joints_m.iter().zip(&cones.joints_m) {
            let far: Vector = std::array::from_fn(|c| ours[c] - theirs[c]);
            assert!(far.iter().all(|x| x.abs() < 1e-6), "{ours:?} {theirs:?}");
        }
        let largest = e.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
        for (ours, theirs) in e.axial_n.iter().zip(&cones.axial_n) {
            assert!((ours - theirs).abs() < FORCE * largest, "{ours} {theirs}");
        }
    }
    assert!((cones.axial_n[2] - 100.0 * 0.1 / 2.9).abs() < 1e-12);
    let rope = Member::cable(0, 1, Bar::homogeneous(4.5, 0.0).unwrap()).over(vec![2]);
    let roped = System::new("roped", 9.81, joints.clone(), vec![members[0].clone(), rope]).unwrap();
    let refused = hang_as_cables(&roped);
    assert!(matches!(refused, Err(ConeError::Rope(2))), "{refused:?}");
    let strut = members[0].clone().of_kind(Kind::Strut);
    let pushed = System::new("pushed", 9.81, joints, vec![strut, members[1].clone()]).unwrap();
    let refused = hang_as_cables(&pushed);
    assert!(matches!(refused, Err(ConeError::Strut(1))));
}
