//! Members that stretch or go slack, and joints that slide, against closed forms.

use energy::net::{Error, Forces, Settings, minimise, minimise_from};
use model::system::{Joint, Kind, Member, Support, System};

use crate::net_support::{G, bar, close, solve};

fn weightless(from: usize, to: usize, length_m: f64, kind: Kind) -> Member {
    bar(from, to, length_m, 0.0).of_kind(kind)
}

#[test]
fn a_spring_stretches_by_its_load() {
    // Hooke: the elongation is W l / EA; soft enough to be five times as long, and as stiff as
    // steel.
    for stiffness in [5.0, 1e2, 1e8] {
        for kind in [Kind::Bar, Kind::Cable] {
            let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0]), Joint::free("P").with_mass(2.0)];
            let member = weightless(0, 1, 1.5, kind).with_stiffness(stiffness);
            let (_, solution) = solve(joints, vec![member]);
            let found = &solution.equilibrium;
            let stretch = 20.0 * 1.5 / stiffness;
            close(found.joints_m[1][2], 1.0 - 1.5 - stretch);
            close(found.axial_n[0], 20.0);
            close(
                found.energy_j,
                -20.0 * (1.5 + stretch) + 0.5 * stiffness / 1.5 * stretch * stretch,
            );
        }
    }
}

#[test]
fn a_standing_spring_holds_a_weight_that_its_guide_keeps_upright() {
    // Compression: the spring is shorter by W l / EA.
    let joints = vec![
        Joint::anchor("ground", [0.0; 3]),
        Joint::free("top")
            .with_mass(3.0)
            .held_by(Support::Line { at_m: [0.0, 0.0, 1.0], direction: [0.0, 0.0, 1.0] }),
    ];
    for kind in [Kind::Bar, Kind::Strut] {
        let member = weightless(0, 1, 2.0, kind).with_stiffness(300.0);
        let system = System::new("spring", G, joints.clone(), vec![member]).expect("a system");
        let seed = [[0.0; 3], [0.0, 0.0, 1.9]];
        let solution = minimise_from(&system, &seed, &Settings::default()).expect("a minimum");
        close(solution.equilibrium.joints_m[1][2], 1.8);
        close(solution.equilibrium.axial_n[0], -30.0);
        close(solution.equilibrium.reactions_n[0][2], 30.0);
    }
    let rigid = weightless(0, 1, 2.0, Kind::Strut);
    let system = System::new("strut", G, joints, vec![rigid]).expect("a system");
    let seed = [[0.0; 3], [0.0, 0.0, 2.5]];
    let solution = minimise_from(&system, &seed, &Settings::default()).expect("a minimum");
    close(solution.equilibrium.joints_m[1][2], 2.0);
    close(solution.equilibrium.axial_n[0], -30.0);
}

#[test]
fn a_bar_that_would_push_is_slack_as_a_cable() {
    // A lamp on a short cable; the other cable is too long to matter until a side wind blows the
    // lamp over.
    let lamp = |wind: f64| {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [-5.0, 0.0, 0.0]),
            Joint::free("lamp").with_mass(4.0).with_force([wind, 0.0, 0.0]),
        ];
        let members = vec![weightless(0, 2, 5.0, Kind::Cable), weightless(1, 2, 8.0, Kind::Cable)];
        System::new("lamp", G, joints, members).expect("a system")
    };
    let weak = minimise(&lamp(30.0), &Settings::default()).expect("a minimum").equilibrium;
    // Along (3, -4)/5 with 50 N; at (3, 0, -4) the distance to B is sqrt(64 + 16) = 8.94: too far,
    // so both cables are taut where circles of 5 about A and of 8 about B meet: x = (64 - 25 - 25)
    // / 10 = 1.4, z = -4.8.
    close(weak.joints_m[2][0], 1.4);
    close(weak.joints_m[2][2], -4.8);
    let calm = minimise(&lamp(10.0), &Settings::default()).expect("a minimum").equilibrium;
    // Along (1, -4)/sqrt 17: sqrt((5/sqrt 17 + 5)² + ...) = 7.9 from B: the second cable is slack.
    let root = 17.0_f64.sqrt();
    close(calm.joints_m[2][0], 5.0 / root);
    close(calm.axial_n[0], 10.0 * root);
    assert_eq!(calm.axial_n[1].to_bits(), 0.0_f64.to_bits());
}

#[test]
fn a_bead_on_a_slope_without_end_falls() {
    let joints = vec![
        Joint::free("bead")
            .with_mass(1.0)
            .held_by(Support::Line { at_m: [0.0; 3], direction: [0.6, 0.0, -0.8] }),
        Joint::free("lamp").with_mass(1.0),
    ];
    let system = System::new("slope", G, joints, vec![bar(0, 1, 1.0, 0.0)]).expect("a system");
    let Err(Error::Falls { force_n, .. }) = minimise(&system, &Settings::default()) else {
        panic!("it falls")
    };
    close(force_n, 16.0);
}

/// Of parts that hang side by side the one that falls is named with its own load, wherever it stands.
#[test]
fn the_part_that_falls_is_named_by_its_own_load() {
    let slider = |name: &str, mass_kg| {
        Joint::free(name)
            .with_mass(mass_kg)
            .held_by(Support::Line { at_m: [3.0, 0.0, 0.0], direction: [0.6, 0.0, -0.8] })
    };
    let held = || [Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(5.0)];
    let falls = || [slider("bead", 2.0), Joint::free("lamp").with_mass(1.0)];
    let members = || vec![bar(0, 1, 1.0, 0.0), bar(2, 3, 1.0, 0.0)];
    let [a, p] = held();
    let [bead, lamp] = falls();
    for joints in [vec![a.clone(), p.clone(), bead.clone(), lamp.clone()], vec![bead, lamp, a, p]] {
        let system = System::new("two", G, joints, members()).expect("a system");
        let Err(Error::Falls { joint, force_n }) = minimise(&system, &Settings::default()) else {
            panic!("it falls")
        };
        assert_eq!(joint, "bead");
        close(force_n, 24.0);
    }
}

/// A weight below its anchor on a strut falls: no force that a strut bears holds it.
#[test]
fn a_weight_below_its_anchor_on_a_strut_falls() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(5.0)];
    let system = System::new("strut", G, joints, vec![weightless(0, 1, 1.0, Kind::Strut)]);
    let failed = minimise(&system.unwrap(), &Settings::default()).unwrap_err();
    let Error::WrongSign { member: 1, force_n } = failed else { panic!("{failed}") };
    // The weight is what would have to be borne.
    close(force_n, 5.0 * G);
}

/// A weight whose cable is longer than the floor is deep lies on it: the floor bears all of it, and
/// anchors are where they were put, to the last digit.
#[test]
fn the_floor_bears_what_lies_on_it() {
    let at_m = [0.1, 0.7, 3.3];
    let joints = vec![Joint::anchor("A", at_m), Joint::free("P").with_mass(5.0)];
    let system = System::new("floor", G, joints, vec![weightless(0, 1, 5.0, Kind::Cable)])
        .and_then(|system| system.with_floor(-1.0))
        .expect("a system");
    let found = minimise(&system, &Settings::default()).expect("a minimum").equilibrium;
    assert!((found.joints_m[1][2] + 1.0).abs() < 1e-12);
    let [x, y, z] = found.reactions_n[1];
    assert!(x.abs() < 1e-12 && y.abs() < 1e-12 && (z - 50.0).abs() < 1e-10, "{z}");
    assert!(found.axial_n[0].abs() < 1e-10);
    assert_eq!(found.joints_m[0].map(f64::to_bits), at_m.map(f64::to_bits));
}

/// Members that just reach the floor share the weight with it. Rigid as supports are it leaves
/// `sum F² l` of the members alone to be least: zero of one member; of 0.4 m and 0.6 m with 10 N at
/// each joint, F1 = F2 + 10 N, 6 N and -4 N, which cables do not bear.
#[test]
fn members_that_just_reach_the_floor_share_with_it() {
    for kind in [Kind::Bar, Kind::Cable] {
        let weight = |name: &str| Joint::free(name).with_mass(10.0 / G);
        let above = |joints, members| {
            let system = System::new("touching", G, joints, members)
                .and_then(|system| system.with_floor(-1.0))
                .expect("a system");
            minimise(&system, &Settings::default()).expect("a minimum")
        };
        let one = above(
            vec![Joint::anchor("A", [0.0; 3]), weight("P")],
            vec![weightless(0, 1, 1.0, kind)],
        );
        let Forces::Family { least: true, .. } = one.forces else { panic!("{:?}", one.forces) };
        assert!(one.equilibrium.axial_n[0].abs() < 1e-9);
        close(one.equilibrium.reactions_n[1][2], 10.0);
        let two = above(
            vec![Joint::anchor("A", [0.0; 3]), weight("Q"), weight("P")],
            vec![weightless(0, 1, 0.4, kind), weightless(1, 2, 0.6, kind)],
        );
        let [upper, lower] = two.equilibrium.axial_n[..] else { panic!() };
        close(upper - lower, 10.0);
        close(two.equilibrium.reactions_n[2][2] + lower, 10.0);
        let named = two.equilibrium.evidence.self_stresses.expect("one");
        // Both members alike, of unit norm.
        let [stress] = &named.basis[..] else { panic!("{:?}", named.basis) };
        close(stress[0] * stress[1], 0.5);
        close(stress[0].powi(2), 0.5);
        if kind == Kind::Bar {
            close(upper, 6.0);
            close(lower, -4.0);
        } else {
            assert!(lower >= 0.0 && two.equilibrium.reactions_n[2][2] >= 0.0);
        }
    }
}

/// Two bars of 1.2 m and 1 kN over feet 2 m apart, with 10 N at P that slides upright: the energy rises from both sides to a
/// saddle just above the level, so that each start comes down to the minimum on its own side.
#[test]
fn starts_end_in_the_minimum_below_them() {
    let rail = Support::Line { at_m: [0.0; 3], direction: [0.0, 0.0, 1.0] };
    let joints = vec![
        Joint::anchor("A", [-1.0, 0.0, 0.0]),
        Joint::anchor("B", [1.0, 0.0, 0.0]),
        Joint::free("P").with_mass(1.0).held_by(rail),
    ];
    let members = [0, 1].map(|foot| weightless(foot, 2, 1.2, Kind::Bar).with_stiffness(1e3));
    let system = System::new("two bars", G, joints, members.to_vec()).unwrap();
    for start_m in [-0.9, -0.5, -0.2, 0.2, 0.5, 0.9] {
        let places_m = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, start_m]];
        let found = minimise_from(&system, &places_m, &Settings::default()).unwrap().equilibrium;
        let z = found.joints_m[2][2];
        assert!(z * start_m > 0.0 && z.abs() > 0.5, "{start_m}: {z}");
        // What both bars bear up, by their law.
        let length = z.hypot(1.0);
        close(2.0 * 1e3 * (1.0 - length / 1.2) * z / length, 10.0);
    }
}
