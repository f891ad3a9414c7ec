//! Lengths, masses and gravity times powers of two: not a digit of an answer changes.

use energy::network::{Settings, critical, minimise};
use model::Vector;
use model::system::{Kind, System};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use samples::scaled;

use crate::network_random::{bridle, net, ring, tree};

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
        member.clone().of_kind(kind).stretching(stiffness_n)
    });
    let joints = system.joints().iter().enumerate().map(|(k, joint)| {
        joint.clone().with_force(if k == 2 { [0.5, -1.5, 0.25] } else { joint.force_n })
    });
    System::new("mixed", system.gravity_m_s2(), joints.collect(), members.collect())
        .expect("a system")
}

#[test]
fn systems_scale_without_rounding() {
    let mut answers = 0;
    for seed in 0..8_u32 {
        for (k, make) in
            [bridle, ring, tree, |rng: &mut ChaCha8Rng| net(rng, 0.6)].iter().enumerate()
        {
            let system = make(&mut ChaCha8Rng::seed_from_u64(4000 + u64::from(seed)));
            let system =
                if k.is_multiple_of(2) == seed.is_multiple_of(2) { mixed(&system) } else { system };
            let one = minimise(&system, &Settings::default());
            for factors in FACTORS {
                let [length, mass, gravity] = factors;
                let force = mass * gravity;
                let other = scaled(&system, factors);
                let there = minimise(&other, &Settings::default());
                let (Ok(one), Ok(there)) = (&one, &there) else {
                    assert_eq!(one.is_ok(), there.is_ok());
                    continue;
                };
                answers += 1;
                assert_eq!(one.work, there.work, "{seed} {k} {factors:?}");
                assert_eq!(one.forces, there.forces);
                let (one, there) = (&one.equilibrium, &there.equilibrium);
                assert_eq!(times(&one.joints_m, length), there.joints_m);
                assert_eq!(times(&one.reactions_n, force), there.reactions_n);
                assert_eq!(times(&one.start_forces_n, force), there.start_forces_n);
                let axial: Vec<f64> = one.axial_n.iter().map(|n| n * force).collect();
                assert_eq!(axial, there.axial_n);
                assert_eq!(one.stability, there.stability);
                let energy = [one.energy_j * force * length, there.energy_j].map(f64::to_bits);
                assert_eq!(energy[0], energy[1]);
                let [a, b] = [(&system, one), (&other, there)]
                    .map(|(system, found)| critical(system, &found.joints_m).unwrap());
                assert_eq!(a, b);
            }
        }
    }
    assert!(answers > 60, "{answers}");
}
