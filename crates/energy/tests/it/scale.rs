//! Lengths, masses and gravity times powers of two: not a digit of an answer changes.

use energy::batch::{Batch, BatchSettings};
use energy::net::{self, Critical, Error, Settings, critical, minimise};
use energy::{Motion, minimise_from};
use model::cases::Case;
use model::system::{Kind, System};
use model::{Evidence, Problem, Vector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use samples::{scaled, scaled_chain};

use crate::net_random::{bridle, net, ring, tree};
use crate::net_work::seeded;
use crate::support::{random_seed, rng};

/// Of lengths, masses and gravity.
const FACTORS: [[f64; 3]; 3] = [[1024.0, 1.0, 1.0], [1.0, 0.0625, 1.0], [0.125, 64.0, 0.25]];

fn times(vectors: &[Vector], factor: f64) -> Vec<Vector> {
    vectors.iter().map(|vector| vector.map(|x| factor * x)).collect()
}

/// The same with every second member a cable, every third elastic, and one joint pushed aside.
fn mixed(system: &System) -> System {
    let members = system.members().iter().enumerate().map(|(k, member)| {
        let kind = if k % 2 == 1 { Kind::Cable } else { Kind::Bar };
        let stiffness_n = (k % 3 == 2).then_some(300.0);
        member.clone().of_kind(kind).with_stiffness(stiffness_n)
    });
    let joints = system.joints().iter().enumerate().map(|(k, joint)| {
        joint.clone().with_force(if k == 2 { [0.5, -1.5, 0.25] } else { joint.force_n })
    });
    System::new("mixed", system.gravity_m_s2(), joints.collect(), members.collect())
        .expect("a system")
}

/// Random ones, those of the gallery, with ropes, and a frame whose lengths do not fit; and bridles with places to begin.
fn systems() -> Vec<(System, Option<Vec<Vector>>)> {
    let mut all: Vec<System> = model::cases::systems().map(Case::system).collect();
    all.extend(samples::ropes().into_iter().map(|sample| sample.system));
    all.push(samples::legs([1e-3, 2e-3, 3e-3, 4e-3]));
    for seed in 0..8_u32 {
        for (k, make) in
            [bridle, ring, tree, |rng: &mut ChaCha8Rng| net(rng, 0.6)].iter().enumerate()
        {
            let system = make(&mut ChaCha8Rng::seed_from_u64(4000 + u64::from(seed)));
            let plain = k.is_multiple_of(2) != seed.is_multiple_of(2);
            all.push(if plain { system } else { mixed(&system) });
        }
    }
    let began = (2000..2040).map(seeded).map(|(system, seed)| (system, Some(seed)));
    all.into_iter().map(|system| (system, None)).chain(began).collect()
}

#[test]
fn systems_scale_without_rounding() {
    let (mut answers, mut refused) = (0, 0);
    for (k, (system, seed)) in systems().iter().enumerate() {
        let name = format!("{k} {}", system.name());
        let solved = |system: &System, length: f64| match seed {
            Some(seed) => net::minimise_from(system, &times(seed, length), &Settings::default()),
            None => minimise(system, &Settings::default()),
        };
        let one = solved(system, 1.0);
        for factors in FACTORS {
            let [length, mass, gravity] = factors;
            let force = mass * gravity;
            let other = scaled(system, factors);
            let there = solved(&other, length);
            let (Ok(one), Ok(there)) = (&one, &there) else {
                match (&one, &there) {
                    (
                        Err(Error::NotClosed { member, misfit_m }),
                        Err(Error::NotClosed { member: other, misfit_m: there_m }),
                    ) => {
                        let misfits = [length * misfit_m, *there_m].map(f64::to_bits);
                        assert_eq!((member, misfits[0]), (other, misfits[1]), "{name}");
                        refused += 1;
                    }
                    (one, there) => assert_eq!(one.is_ok(), there.is_ok(), "{name}"),
                }
                continue;
            };
            answers += 1;
            assert_eq!(one.work, there.work, "{name} {factors:?}");
            assert_eq!(one.forces, there.forces, "{name}");
            let (one, there) = (&one.equilibrium, &there.equilibrium);
            assert_eq!(times(&one.joints_m, length), there.joints_m, "{name}");
            assert_eq!(times(&one.reactions_n, force), there.reactions_n, "{name}");
            assert_eq!(times(&one.start_forces_n, force), there.start_forces_n, "{name}");
            let axial: Vec<f64> = one.axial_n.iter().map(|n| n * force).collect();
            assert_eq!(axial, there.axial_n, "{name}");
            assert_eq!(one.stability, there.stability, "{name}");
            let energy = [one.energy_j * force * length, there.energy_j].map(f64::to_bits);
            assert_eq!(energy[0], energy[1], "{name}");
            let [a, b] = [(system, one), (&other, there)].map(|(system, found)| {
                critical(system, &found.joints_m).map_err(|e| e.to_string())
            });
            assert_eq!(a.is_ok(), b.is_ok(), "{name}");
            if let (Ok(a), Ok(b)) = (a, b) {
                let n_m = force / length;
                let a = a.map(|a| Critical {
                    curvature_n_m: a.curvature_n_m.map(|curvature| curvature * n_m),
                    stiffest_n_m: a.stiffest_n_m * n_m,
                    ..a
                });
                assert_eq!(a, b, "{name}");
            }
        }
    }
    assert!(answers > 250 && refused > 0, "{answers} {refused}");
}

/// Chains of every shape, guessed, from a seed of their own, and in their plane.
#[test]
fn chains_scale_without_rounding() {
    let mut answers = 0;
    for seed in 0..110 {
        let (_, base) = samples::random_chain(2_000 + seed);
        let motion = if seed % 3 == 2 { Motion::Plane } else { Motion::Space };
        let settings = energy::Settings { motion, ..energy::Settings::default() };
        let start = random_seed(&base, &mut rng(seed));
        let solved = |problem: &Problem| match seed % 3 {
            0 => minimise_from(problem, &start, &settings),
            _ => energy::minimise(problem, &settings),
        };
        let one = solved(&base);
        for factors in FACTORS {
            let [length, mass, gravity] = factors;
            let force = mass * gravity;
            let scaled = scaled_chain(&base, factors);
            let there = solved(&scaled);
            let (Ok(one), Ok(there)) = (&one, &there) else {
                assert_eq!(one.as_ref().err(), there.as_ref().err());
                continue;
            };
            answers += 1;
            assert_eq!(one.work, there.work, "{seed} {factors:?}");
            assert_eq!(one.directions, there.directions);
            let (one, there) = (&one.equilibrium, &there.equilibrium);
            assert_eq!(times(&one.joints_m, length), there.joints_m);
            assert_eq!(times(&one.multipliers_n, force), there.multipliers_n);
            let axial: Vec<f64> = one.axial_n.iter().map(|n| n * force).collect();
            assert_eq!(axial, there.axial_n);
            assert_eq!((one.energy_j * force * length).to_bits(), there.energy_j.to_bits());
            let timeless = |evidence: &Evidence| Evidence { solve_s: 0.0, ..evidence.clone() };
            assert_eq!(timeless(&one.evidence), timeless(&there.evidence));
            assert_eq!(one.stability, there.stability);
        }
    }
    assert!(answers > 300, "{answers}");
}

#[test]
fn batches_scale_without_rounding() {
    samples::assert_batches_scale(&FACTORS, |problem, angles, ends| {
        let settings = BatchSettings { max_iterations: 60, ..BatchSettings::default() };
        Batch::new(problem, settings).unwrap().minimise(angles, ends);
    });
}
