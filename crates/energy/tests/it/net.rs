//! Networks of rigid bars against closed forms and against published numbers.

use energy::net::{Error, Forces, Settings, Solution, minimise, minimise_from, minimise_near};
use model::Vector;
use model::system::{Joint, Member, System};

use crate::net_support::{G, bar, check, close, net, solve};

#[test]
fn a_lamp_on_a_v_of_heavy_bars() {
    // Two bars of 5 m and 2 kg between anchors 8 m apart: the lamp is 3 m down. By the lever rule 5
    // kg + 2 kg hang there, 35 N on each side along (4, -3)/5.
    let joints = samples::joints(&[[0.0; 3], [8.0, 0.0, 0.0]], &[5.0]);
    let (_, solution) = solve(joints, vec![bar(0, 2, 5.0, 2.0), bar(2, 1, 5.0, 2.0)]);
    let found = &solution.equilibrium;
    close(found.joints_m[2][2], -3.0);
    close(found.joints_m[2][0], 4.0);
    for axial in &found.axial_n {
        close(*axial, 35.0 * 5.0 / 3.0);
    }
    close(found.reactions_n[0][2], 45.0);
    close(found.reactions_n[0][0], -35.0 * 4.0 / 3.0);
    close(found.energy_j, -50.0 * 3.0 - 2.0 * 20.0 * 1.5);
    assert_eq!(found.stability.neutral, 0);
    assert_eq!(found.stability.index_in_plane, Some(0));
    let Forces::Unique(rigidity) = solution.forces else { panic!("{:?}", solution.forces) };
    assert_eq!((rigidity.rank, rigidity.mechanisms), (2, 1));
}

#[test]
fn a_tripod_hangs_from_three_anchors() {
    // Anchors on a circle of radius 3, legs of 5: the apex 4 below. Each leg carries a third.
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / 3.0;
    let mut joints: Vec<Joint> = (0..3)
        .map(|k| Joint::anchor(format!("A{k}"), [3.0 * angle(k).cos(), 3.0 * angle(k).sin(), 0.0]))
        .collect();
    joints.push(Joint::free("apex").with_mass(12.0));
    let (_, solution) = solve(joints, (0..3).map(|k| bar(k, 3, 5.0, 0.0)).collect());
    let found = &solution.equilibrium;
    close(found.joints_m[3][2], -4.0);
    close(found.joints_m[3][0], 0.0);
    for axial in &found.axial_n {
        close(*axial, 40.0 * 5.0 / 4.0);
    }
    let Forces::Unique(rigidity) = solution.forces else { panic!("{:?}", solution.forces) };
    assert_eq!((rigidity.rank, rigidity.self_stresses, rigidity.mechanisms), (3, 0, 0));
    assert_eq!(found.stability.index_in_plane, None);
}

/// The same lamp aside under heavy and light bars, with nothing counted: an answer for who drags it.
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
fn four_legs_share_a_load_as_equally_stiff_ones_would() {
    // One leg too many: its forces are a family with one parameter, +1 -1 +1 -1 around the square.
    // The member with the least sum of F² l has none of it: a quarter of the load each, on legs of
    // 5 with feet 3 out and 4 up.
    let mut joints: Vec<Joint> = [[3.0, 0.0], [0.0, 3.0], [-3.0, 0.0], [0.0, -3.0]]
        .iter()
        .enumerate()
        .map(|(k, [x, y])| Joint::anchor(format!("A{k}"), [*x, *y, 0.0]))
        .collect();
    joints.push(Joint::free("apex").with_mass(8.0));
    let (_, solution) = solve(joints, (0..4).map(|k| bar(k, 4, 5.0, 0.0)).collect());
    let Forces::Family { rigidity, least: true } = solution.forces else {
        panic!("{:?}", solution.forces)
    };
    assert_eq!((rigidity.rank, rigidity.self_stresses, rigidity.mechanisms), (3, 1, 0));
    for axial in &solution.equilibrium.axial_n {
        close(*axial, 20.0 * 5.0 / 4.0);
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
fn a_symmetric_bridle_with_a_branch_point() {
    // Two strands of 5 m from anchors 6 m apart carry a third of 2 m with 7 kg at its end: the
    // branch point is 4 m down, the end 6 m. Strand weights 1 kg each, the third 3 kg.
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[0.0, 7.0]);
    let members = vec![bar(0, 2, 5.0, 1.0), bar(1, 2, 5.0, 1.0), bar(2, 3, 2.0, 3.0)];
    let (_, solution) = solve(joints, members);
    let found = &solution.equilibrium;
    close(found.joints_m[2][2], -4.0);
    close(found.joints_m[3][2], -6.0);
    close(found.axial_n[2], 85.0);
    close(found.axial_n[0], 0.5 * (70.0 + 30.0 + 10.0) * 5.0 / 4.0);
    assert_eq!(found.stability.neutral, 0);
}

#[test]
fn a_hanging_tree_hangs_straight_down() {
    // A binary tree below one anchor: every bar upright, and each carries what hangs below it.
    let mut joints = vec![Joint::anchor("root", [1.0, 2.0, 3.0])];
    let mut members = Vec::new();
    for k in 1..31 {
        joints.push(Joint::free(format!("{k}")).with_mass(1.0 + (k % 3) as f64));
        members.push(bar((k - 1) / 2, k, 1.0 + (k % 4) as f64, 0.5));
    }
    let (system, solution) = solve(joints, members);
    let found = &solution.equilibrium;
    let mut below: Vec<f64> = system.joints().iter().map(|joint| joint.mass_kg * G).collect();
    for k in (1..31).rev() {
        let axial = below[k] + 2.5;
        assert!((found.axial_n[k - 1] - axial).abs() < 1e-10, "{k}");
        below[(k - 1) / 2] += below[k] + 5.0;
        let parent = found.joints_m[(k - 1) / 2];
        close(found.joints_m[k][2], parent[2] - system.members()[k - 1].body.length_m());
    }
    close(found.reactions_n[0][2], below[0]);
}

#[test]
fn a_loaded_string_of_four_parts() {
    // Massless bars; weights 40, 20, 40 N chosen for slopes 1/2 x 5 ... : the pull is H in each
    // part, and the slopes are (50, 10, -10, -50) / H. With H = 30 the parts have lengths sqrt(H² +
    // V²) / H times a run of 1 m.
    let h: f64 = 30.0;
    let vertical = [50.0_f64, 10.0, -10.0, -50.0];
    let mut joints = vec![Joint::anchor("A", [0.0; 3])];
    for mass in [4.0, 2.0, 4.0] {
        joints.push(Joint::free(format!("{mass} kg, {}", joints.len())).with_mass(mass));
    }
    joints.push(Joint::anchor("B", [4.0, 0.0, 0.0]));
    let members = (0..4).map(|k| bar(k, k + 1, (h * h + vertical[k].powi(2)).sqrt() / h, 0.0));
    let (_, solution) = solve(joints, members.collect());
    let found = &solution.equilibrium;
    let mut z = 0.0;
    for (k, v) in vertical.into_iter().enumerate() {
        close(found.axial_n[k], (h * h + v * v).sqrt());
        z -= v / h;
        close(found.joints_m[k + 1][2], z);
        close(found.joints_m[k + 1][0], k as f64 + 1.0);
    }
}

#[test]
fn the_papers_chain_as_a_network() {
    // Reference: 40-digit root finding of the paper's example (three bars of length l and mass m
    // between anchors 2 l apart on one vertical): E1, the global minimum, on a circle.
    let joints = vec![
        Joint::anchor("O", [0.0; 3]),
        Joint::free("A"),
        Joint::free("B"),
        Joint::anchor("D", [0.0, 0.0, -2.0]),
    ];
    let (_, solution) = solve(joints, (0..3).map(|k| bar(k, k + 1, 1.0, 1.0)).collect());
    let found = &solution.equilibrium;
    close(found.energy_j / G + 6.0, 2.335_468_651_999_305);
    assert_eq!(found.stability.neutral, 1);
    let across = |force: Vector| force[0].hypot(force[1]) / G;
    close(across(found.reactions_n[0]), 0.648_944_835_933_633_8);
    close(found.reactions_n[0][2] / G, 2.312_944_292_241_837_6);
    close(found.reactions_n[3][2] / G, 0.687_055_707_758_162_4);
    // The last bar props the chain up.
    assert!(found.axial_n[2] < 0.0 && found.axial_n[1] > 0.0);
    let cosine = |k: usize| found.joints_m[k][2] - found.joints_m[k + 1][2];
    close(cosine(0), 0.941_500_734_898_234_9);
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
