//! Answers of systems with oblique sliders, rounded to any number of digits, as files have them.

use model::Bar;
use model::Vector;
use model::system::{Joint, Kind, Member, Support, System};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::best_forces::tests::{unit, vector};
use super::{Finding, ForcesJudged, ForeignAnswer, Judgement, judge_foreign};

/// Joints that slide on oblique lines and in oblique planes around one that hangs free.
fn drawn(random: &mut ChaCha8Rng) -> System {
    let arms = random.random_range(2..5);
    let mut joints = Vec::new();
    let mut members = Vec::new();
    for k in 0..arms {
        let (at_m, along) = (vector(random), unit(random));
        let support = match random.random_range(0..3) {
            0 => Support::Line { at_m, direction: along },
            1 => Support::Plane { at_m, normal: along },
            _ => Support::Fixed { at_m },
        };
        let mass_kg = random.random_range(0.5..5.0);
        joints.push(Joint::free(format!("A{k}")).with_mass(mass_kg).held_by(support));
        let (length_m, mass_kg) = (random.random_range(2.0..8.0), random.random_range(0.0..3.0));
        let kind = if random.random_bool(0.5) { Kind::Bar } else { Kind::Cable };
        members
            .push(Member::bar(k, arms, Bar::homogeneous(length_m, mass_kg).unwrap()).of_kind(kind));
    }
    joints.push(Joint::free("P").with_mass(random.random_range(0.5..10.0)));
    System::new("sliders", 9.81, joints, members).unwrap()
}

/// To so many digits that count, as printed.
fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap()
}

fn judged(system: &System, joints_m: &[Vector], digits: usize, tolerance: f64) -> Judgement {
    let places = joints_m.iter().map(|at| at.map(|x| rounded(x, digits))).collect();
    let answer = ForeignAnswer::in_order(system, "a table", places, None).unwrap();
    judge_foreign(system, &answer, tolerance, &|_| {}).unwrap()
}

/// The hanging point of an answer to six digits is off by 5e-6 of itself at most, and likewise.
#[test]
fn an_answer_is_confirmed_to_the_digits_that_it_has() {
    let mut random = ChaCha8Rng::seed_from_u64(274);
    let mut confirmed = 0;
    for number in 0..120 {
        let system = drawn(&mut random);
        let Ok(found) = energy::net::minimise(&system, &energy::net::Settings::default()) else {
            continue;
        };
        for digits in [6, 8, 10, 13, 16] {
            for tolerance in [1e-6, 10.0_f64.powf(1.0 - digits as f64).max(1e-11)] {
                if digits == 6 && tolerance < 5e-6 {
                    continue;
                }
                let found = judged(&system, &found.equilibrium.joints_m, digits, tolerance);
                let about = || {
                    format!(
                        "{number}, {digits} digits, {tolerance:e}: {} {:?} {:?} {system:?}",
                        found.finding, found.violations, found.forces
                    )
                };
                assert_eq!(found.finding, Finding::Confirmed, "{}", about());
                let ForcesJudged::Found(best) = &found.forces else { panic!("{}", about()) };
                assert!(best.converged, "{}", about());
                confirmed += 1;
            }
        }
    }
    assert!(confirmed > 300, "{confirmed}");
}
