//! The paper's example by the spatial minimiser, against reference values (40-digit
//! root finding, kind "external").

use crate::support::{difference, random_seed, rng, unbalanced};
use energy::{Motion, Seed, Settings, minimise, minimise_from, second_order};
use model::{InPlane, InSpace, STANDARD_GRAVITY_M_S2 as MG, cases};

/// E1: theta, alpha, beta, degrees from the descending vertical.
const E1_DEG: [f64; 3] = [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34];
/// E1: energy, mgl, the paper's zero.
const E1_MGL: f64 = 2.335_468_651_999_305;
/// E1: multipliers (Y, Z) at the joints 0..3, mg.
const E1_MULTIPLIERS: [[f64; 2]; 4] = [
    [-0.648_944_835_933_933_6, 2.312_944_292_241_837_6],
    [0.648_944_835_933_933_6, -1.312_944_292_241_837_6],
    [0.648_944_835_933_933_6, -0.312_944_292_241_837_6],
    [0.648_944_835_933_933_6, 0.687_055_707_758_162_4],
];

/// The angles of the bars in the plane *OYZ*, positive towards +Y.
fn angles(directions: &[[f64; 3]]) -> Vec<f64> {
    directions.iter().map(|u| u[1].atan2(-u[2])).collect()
}

#[test]
fn e1_without_a_guess_in_every_observable() {
    let problem = cases::paper();
    let solution = minimise(&problem, &Settings::default()).unwrap();
    let found = &solution.equilibrium;
    let angles = angles(&solution.directions);
    // E1 or its mirror image: the turn about OD makes them one.
    let side = angles[0].signum();
    for (angle, e1) in angles.iter().zip(E1_DEG) {
        assert!((side * angle - e1.to_radians()).abs() < 1e-14, "{angles:?}");
    }
    assert!((found.energy_j / MG + 6.0 - E1_MGL).abs() < 1e-14);
    for (force, [y, z]) in found.multipliers_n.iter().zip(E1_MULTIPLIERS) {
        let force = force.map(|x| x / MG);
        assert!(difference(force, [0.0, side * y, z]) < 1e-14, "{force:?}");
    }
    let bits = |v: [f64; 3]| v.map(f64::to_bits);
    assert_eq!(bits(found.reactions_n.start), bits(found.multipliers_n[0]));
    assert_eq!(bits(found.reactions_n.end), bits(found.multipliers_n[3]));
    // Bars 1 and 2 are pulled, bar 3 is pushed.
    assert!(found.axial_n[0] > 0.0 && found.axial_n[1] > 0.0 && found.axial_n[2] < 0.0);
    let (forces, lengths) = unbalanced(&problem, &solution);
    assert!(forces < 1e-15 && lengths < 1e-15, "{forces:e} {lengths:e}");

    let stability = found.stability;
    assert_eq!((stability.in_plane, stability.index_in_plane), (InPlane::Minimum, 0));
    assert_eq!((stability.in_space, stability.index_in_space), (InSpace::Stable, 0));
    // The turn about OD, and nothing else.
    assert_eq!(found.evidence.nullity, 1);
    assert!(found.evidence.residual < 1e-14);
    assert!(found.evidence.condition > 1.0 && found.evidence.condition < 10.0);
}

#[test]
fn ten_thousand_seeds_in_space_all_reach_the_one_minimum() {
    let problem = cases::paper();
    let mut rng = rng(2);
    let seeds: Vec<Seed> = (0..10_000).map(|_| random_seed(&problem, &mut rng)).collect();
    let (mut total, mut most) = (0, 0);
    for seed in &seeds {
        let found = minimise_from(&problem, seed, &Settings::default()).unwrap();
        assert!((found.equilibrium.energy_j / MG + 6.0 - E1_MGL).abs() < 1e-13);
        total += found.work.iterations;
        most = most.max(found.work.iterations);
    }
    // The work, frozen with room for another processor's square root.
    assert!(total < 90_000, "{total}");
    assert!(most <= 25, "{most}");
}

#[test]
fn seeds_in_the_plane_reach_it_too_in_the_plane_and_in_space() {
    let problem = cases::paper();
    for motion in [Motion::Plane, Motion::Space] {
        let settings = Settings { motion, ..Settings::default() };
        for i in 0..12 {
            for j in 0..12 {
                for k in 0..12 {
                    let angle = |m: i32| f64::from(m) * 30.0_f64.to_radians();
                    let seed = [angle(i), angle(j), angle(k)];
                    let seed = Seed::angles(&problem, &seed).unwrap();
                    let found = minimise_from(&problem, &seed, &settings).unwrap();
                    let v = found.equilibrium.energy_j / MG + 6.0;
                    assert!((v - E1_MGL).abs() < 1e-13, "{i} {j} {k} {motion:?}: {v}");
                    if motion == Motion::Plane {
                        assert!(found.directions.iter().all(|u| u[0].abs() < 1e-16));
                    }
                }
            }
        }
    }
}

#[test]
fn e2_as_a_seed_is_left_for_e1() {
    let problem = cases::paper();
    let e2 = [-E1_DEG[2], -E1_DEG[1], -E1_DEG[0]].map(f64::to_radians);
    let seed = Seed::angles(&problem, &e2).unwrap();
    for motion in [Motion::Plane, Motion::Space] {
        let settings = Settings { motion, ..Settings::default() };
        let found = minimise_from(&problem, &seed, &settings).unwrap();
        assert!((found.equilibrium.energy_j / MG + 6.0 - E1_MGL).abs() < 1e-14);
    }
}

#[test]
fn the_work_without_a_guess_is_frozen() {
    let solution = minimise(&cases::paper(), &Settings::default()).unwrap();
    assert_eq!((solution.work.iterations, solution.work.evaluations), (7, 21));
}

/// E2, the paper's chain upside down: a maximum among the motions in its plane, of which there is one,
/// and falling in two directions of space (40-digit root finding).
#[test]
fn indices_in_the_plane_and_in_space_are_two_numbers() {
    let problem = cases::paper();
    let e2 = [73.920_588_792_231_34_f64, -38.599_136_184_451_89, -19.694_867_976_133_02];
    let seed = Seed::angles(&problem, &e2.map(f64::to_radians)).unwrap();
    let stability = second_order(&problem, &seed).unwrap().stability;
    assert_eq!((stability.in_plane, stability.index_in_plane), (InPlane::Maximum, 1));
    assert_eq!((stability.in_space, stability.index_in_space), (InSpace::Unstable, 2));
}
