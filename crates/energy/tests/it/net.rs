//! Networks of rigid bars against closed forms and against published numbers.

use energy::net::{Error, Forces, Settings, Solution, minimise, minimise_from, minimise_near};
use model::Vector;
use model::system::{Joint, Member, System};

use crate::net_support::{G, ROUNDING, bar, check, check_but, close, net, solve};

#[test]
fn known_systems_hang_as_by_hand() {
    for known in samples::known() {
        let name = known.system.name();
        let solution = minimise(&known.system, &Settings::default()).expect(name);
        check_but(&known.system, &solution, &known.slack, ROUNDING);
        let found = &solution.equilibrium;
        known.assert_holds(found, ROUNDING);
        assert!(known.slack.iter().all(|slack| found.axial_n[*slack].to_bits() == 0), "{name}");
        if let Some([mechanisms, self_stresses]) = known.counts {
            let rigidity = match solution.forces {
                Forces::Unique(rigidity) if self_stresses == 0 => rigidity,
                Forces::Family { rigidity, least: true } if self_stresses > 0 => rigidity,
                other => panic!("{name}: {other:?}"),
            };
            let counted = (rigidity.mechanisms, rigidity.self_stresses);
            assert_eq!(counted, (mechanisms, self_stresses), "{name}");
        }
    }
}

/// A lamp aside under heavy bars, with nothing counted: an answer for who drags it.
#[test]
fn a_lamp_hangs_without_dense_matrices() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [8.0, 0.0, 0.0]),
        Joint::free("lamp").with_mass(5.0),
    ];
    let members = vec![bar(0, 2, 5.0, 2.0), bar(2, 1, 5.0, 2.0)];
    let system = System::new("lamp", G, joints, members).unwrap();
    let settings = Settings { dense: 0, ..Settings::default() };
    let near = [[0.0; 3], [8.0, 0.0, 0.0], [4.2, 0.5, -2.8]];
    for found in [minimise(&system, &settings), minimise_near(&system, &near, &settings)] {
        let Solution { equilibrium: found, forces, .. } = found.unwrap();
        close(found.joints_m[2][2], -3.0);
        close(found.axial_n[0], 35.0 * 5.0 / 3.0);
        assert_eq!(forces, Forces::NotCounted);
        assert!(found.evidence.rigidity.is_none() && found.stability.index_in_space == 0);
    }
}

#[test]
fn a_tripod_stands_where_its_seed_stands() {
    let joints = samples::joints(
        &[[3.0, 0.0, 0.0], [-1.5, 1.5 * 3.0_f64.sqrt(), 0.0], [-1.5, -1.5 * 3.0_f64.sqrt(), 0.0]],
        &[12.0],
    );
    let members: Vec<Member> = (0..3).map(|k| bar(k, 3, 5.0, 0.0)).collect();
    let system = System::new("tripod", G, joints, members).unwrap();
    let mut seed: Vec<Vector> =
        system.joints().iter().map(|j| j.support.at_m().unwrap_or_default()).collect();
    seed[3] = [0.3, -0.2, 3.5];
    let solution = minimise_from(&system, &seed, &Settings::default()).unwrap();
    check(&system, &solution);
    close(solution.equilibrium.joints_m[3][2], 4.0);
    close(solution.equilibrium.axial_n[1], -50.0);
}

#[test]
fn an_upright_arch_collapses_into_a_hanging_one() {
    // A seed with the exact symmetry of the standing arch, which is a saddle. The trapezium that
    // hangs: spans 3 and 1, strands of 1.25, so 0.75 down.
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(1.0),
        Joint::free("Q").with_mass(1.0),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
    ];
    let members = vec![bar(0, 1, 1.25, 0.0), bar(1, 2, 1.0, 0.0), bar(2, 3, 1.25, 0.0)];
    let system = System::new("arch", G, joints, members).unwrap();
    let seed = [[0.0; 3], [1.0, 0.0, 0.75], [2.0, 0.0, 0.75], [3.0, 0.0, 0.0]];
    let solution = minimise_from(&system, &seed, &Settings::default()).unwrap();
    check(&system, &solution);
    close(solution.equilibrium.joints_m[1][2], -0.75);
    close(solution.equilibrium.joints_m[2][2], -0.75);
    close(solution.equilibrium.energy_j, -15.0);
}

#[test]
fn a_net_from_four_corners_has_the_symmetry_of_the_square() {
    let n = 9;
    let (joints, members) = net(n, 0.8);
    let (system, solution) = solve(joints, members);
    let found = &solution.equilibrium;
    assert!(found.axial_n.iter().all(|axial| *axial > 0.0), "all bars pull");
    for i in 0..n {
        for j in 0..n {
            let [x, y, z] = found.joints_m[i * n + j];
            let [mirrored_x, _, mirrored_z] = found.joints_m[(n - 1 - i) * n + j];
            close(mirrored_x, 0.8 - x);
            close(mirrored_z, z);
            let [turned_x, turned_y, turned_z] = found.joints_m[j * n + i];
            close(turned_x, y);
            close(turned_y, x);
            close(turned_z, z);
        }
    }
    for corner in [0, n - 1, n * (n - 1), n * n - 1] {
        close(found.reactions_n[corner][2], system.total_mass_kg() * G / 4.0);
    }
}

#[test]
fn reactions_are_derivatives_of_the_least_energy() {
    // Central differences: the error is a third derivative times the square of the step, and the
    // rounding of the energy over the step: 1e-10 + 1e-11 relative at a step of 1e-5, with the
    // curvatures of this net.
    let n = 5;
    let energy = |corner: usize, axis: usize, by: f64| {
        let (mut joints, members) = net(n, 0.8);
        let mut at = joints[corner].support.at_m().unwrap();
        at[axis] += by;
        joints[corner] = Joint::anchor("moved", at);
        // From the same reference: the first anchor stays the first.
        let system = System::new("moved", G, joints, members).unwrap();
        minimise(&system, &Settings::default()).unwrap().equilibrium.energy_j
    };
    let (joints, members) = net(n, 0.8);
    let (_, solution) = solve(joints, members);
    let corner = n - 1;
    for axis in 0..3 {
        let step = 1e-5;
        let difference = (energy(corner, axis, step) - energy(corner, axis, -step)) / (2.0 * step);
        let reaction = solution.equilibrium.reactions_n[corner][axis];
        assert!((difference - reaction).abs() < 1e-7, "{axis}: {difference} {reaction}");
    }
}

#[test]
fn what_cannot_hang_is_refused_with_numbers() {
    let lamp = |distance: f64| {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [distance, 0.0, 0.0]),
            Joint::free("lamp").with_mass(5.0),
        ];
        let members = vec![bar(0, 2, 1.0, 0.0), bar(2, 1, 1.0, 0.0)];
        minimise(&System::new("lamp", G, joints, members).unwrap(), &Settings::default())
    };
    let Err(Error::NotClosed { misfit_m, .. }) = lamp(2.5) else { panic!("{:?}", lamp(2.5)) };
    assert!((0.2..=0.5).contains(&misfit_m), "{misfit_m}");
    // Of a member of 1 m or 2 m, each a sixth too short, beside one of 10 m that fits.
    let joints = samples::joints(&[[0.0; 3], [3.5, 0.0, 0.0]], &[5.0, 0.5]);
    let members = vec![bar(0, 3, 10.0, 0.0), bar(0, 2, 1.0, 0.0), bar(2, 1, 2.0, 0.0)];
    let apart = System::new("apart", G, joints, members).unwrap();
    match minimise(&apart, &Settings::default()) {
        Err(Error::NotClosed { member: member @ (2 | 3), misfit_m }) => {
            let sixth_m = (member - 1) as f64 / 6.0;
            assert!((misfit_m - sixth_m).abs() < 0.1 * sixth_m, "{member}: {misfit_m}");
        }
        other => panic!("{other:?}"),
    }
    let joints = vec![Joint::free("P").with_mass(2.0), Joint::free("Q")];
    let falling = System::new("falling", G, joints, vec![bar(0, 1, 1.0, 1.0)]).unwrap();
    let Err(Error::Falls { joint, force_n }) = minimise(&falling, &Settings::default()) else {
        panic!("it falls")
    };
    assert_eq!(joint, "P");
    close(force_n, 30.0);
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("Q")];
    let weightless = System::new("weightless", G, joints, vec![bar(0, 1, 1.0, 0.0)]).unwrap();
    assert_eq!(minimise(&weightless, &Settings::default()).unwrap_err(), Error::NoLoad);
}
