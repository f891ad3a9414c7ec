//! Both solvers on the paper's example against its numbers: theta, alpha, beta and V as printed in
//! (ix), and as established independently.

use energy::example::{ExampleMinimum, minimise};
use lagrange::Seed;
use model::{Equilibrium, Problem};
use paper::printed::Paper;

/// A start near the first position, rad: theta, alpha, beta.
const START: [f64; 3] = [0.3, 0.7, -1.3];
/// Angles of either solver against the reference, deg. Measured: 1e-14.
const ANGLE_DEG: f64 = 1e-10;
/// V of either solver against the reference, mgl. Measured: 4e-16.
const ENERGY_MGL: f64 = 1e-12;
/// The paper measures V from 6 mgl below the level of O.
const PAPER_ZERO_MGL: f64 = 6.0;

/// theta, alpha, beta, deg, and V, mgl, of an equilibrium in the plane OYZ.
fn in_paper_numbers(problem: &Problem, found: &Equilibrium) -> [f64; 4] {
    let bar = &problem.chain().bars()[0];
    let mgl_j = bar.mass_kg() * problem.chain().gravity_m_s2() * bar.length_m();
    let angle = |k: usize| {
        let [a, b] = [found.joints_m[k], found.joints_m[k + 1]];
        f64::atan2(b[1] - a[1], a[2] - b[2]).to_degrees()
    };
    [angle(0), angle(1), angle(2), found.energy_j / mgl_j + PAPER_ZERO_MGL]
}

/// E1 by `lagrange`, by the minimisation of `energy` and by its Solution 1 over theta and alpha.
fn by_all() -> [(&'static str, [f64; 4]); 3] {
    let problem = model::cases::paper();
    let settings = lagrange::Settings::default();
    let lagrange = lagrange::solve_from(&problem, &Seed::planar(&START), &settings).unwrap();
    let plane = energy::Settings { motion: energy::Motion::Plane, ..energy::Settings::default() };
    let seed = energy::Seed::angles(&problem, &START).unwrap();
    let energy = energy::minimise_from(&problem, &seed, &plane).unwrap();
    let ExampleMinimum { theta_rad, alpha_rad, beta_rad, energy_mgl, .. } =
        minimise(START[0], START[1], &plane).unwrap();
    let [theta_deg, alpha_deg, beta_deg] = [theta_rad, alpha_rad, beta_rad].map(f64::to_degrees);
    [
        ("lagrange", in_paper_numbers(&problem, &lagrange.equilibrium)),
        ("energy", in_paper_numbers(&problem, &energy.equilibrium)),
        ("energy, Solution 1", [theta_deg, alpha_deg, beta_deg, energy_mgl]),
    ]
}

#[test]
fn both_solvers_give_the_reference_numbers() {
    let paper = Paper::project();
    let names = ["e1-theta", "e1-alpha", "e1-beta", "e1-energy"];
    for (who, found) in by_all() {
        for (name, value) in names.into_iter().zip(found) {
            let tolerance = if name == "e1-energy" { ENERGY_MGL } else { ANGLE_DEG };
            let off = (value - paper.reference(name)).abs();
            println!("{who:20} {name:10} {value:.15} {off:.1e}");
            assert!(off <= tolerance, "{who}: {name} = {value}");
        }
    }
}

/// V to all printed digits; the angles to the step of the paper's scan, 0.001 rad, and not to the
/// printed digits.
#[test]
fn both_solvers_explain_the_printed_numbers() {
    let paper = Paper::project();
    let printed = |id| paper.claim(id).unwrap();
    for (who, [theta, alpha, beta, energy]) in by_all() {
        assert!(printed("ix-energy").rounds_to(energy), "{who}: V = {energy}");
        for (id, angle) in [("ix-theta", theta), ("ix-alpha", alpha), ("ix-beta", beta + 360.0)] {
            let claim = printed(id);
            let off = (claim.value() - angle).abs();
            assert!(off < 0.001_f64.to_degrees(), "{who}: {id} is {off} deg off");
            assert!(!claim.rounds_to(angle), "{who}: {id}");
        }
    }
}
