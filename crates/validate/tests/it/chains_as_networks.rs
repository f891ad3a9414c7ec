//! Every chain of the registry written as joints and members: each solver of systems gives the
//! digits of the solver of chains that shares its mechanics.

use energy::net::minimise;
use model::system::{System, SystemEquilibrium};
use model::{Equilibrium, SolverName, cases};
use validate::Tolerances;
use validate::systems::compare;

/// Rounding of places in units of the largest coordinate, and of forces in units of the largest:
/// the solvers of chains carry some hundred roundings of 2e-16 through a system whose condition is
/// some ten. Measured: 1.7e-14 and 2.2e-13 (`hundred-bars`).
const ROUNDING: f64 = 1e-12;

/// How much more a chain makes of a rounding of its lengths, where that is far from 1: a chain that
/// is 1e-6 of its length away from being taut has as much more in its forces, and lengths over six
/// orders lose a digit or two. Measured, in units of [`ROUNDING`]: 7e4 and 4.
const CONDITIONS: [(&str, f64); 2] = [("nearly-taut", 1e6), ("six-orders", 1e2)];

/// Who has no answer for which chain as a network, and says so.
const REFUSED: [(&str, SolverName); 1] = [("nearly-taut", SolverName::ENERGY)];

fn check(name: &str, system: &System, chain: &Equilibrium, network: SystemEquilibrium) {
    let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let condition = CONDITIONS.iter().find(|(of, _)| *of == name).map_or(1.0, |(_, more)| *more);
    let (length_m, force_n) =
        (largest(chain.joints_m.as_flattened()), largest(chain.multipliers_n.as_flattened()));
    let mut both = [system.as_row().unwrap().equilibrium(chain.clone()), network];
    // Chains that turn freely are turned onto each other there.
    let differ = compare(system, &mut both, &Tolerances::project());
    let (joints, forces) = (differ.joints_m / length_m, differ.forces_n / force_n);
    let who = &chain.solver;
    assert!(joints <= ROUNDING * condition, "{name}, {who}: joints differ by {joints:e}");
    assert!(forces <= ROUNDING * condition, "{name}, {who}: forces differ by {forces:e}");
    // Of the energy of all weight at the largest height.
    let energy = (both[0].energy_j - both[1].energy_j).abs() / (force_n * length_m);
    assert!(energy <= ROUNDING * condition, "{name}, {who}: energies differ by {energy:e}");
}

#[test]
fn a_chain_cut_into_joints_and_members_has_the_same_digits() {
    let mut compared = 0;
    for case in cases::all() {
        let problem = case.problem();
        let system = System::from(problem.chain());
        let refused = |solver: &SolverName, error: &dyn std::fmt::Display| {
            let known = REFUSED.iter().any(|(name, who)| *name == case.name && who == solver);
            assert!(known, "{}: {solver} has no answer: {error}", case.name);
        };
        let mut solver = lagrange::condensed::Solver::default();
        let chain = solver.solve(&problem, &lagrange::condensed::Settings::default());
        let chain = chain.expect("lagrange answers every case").equilibrium;
        match lagrange::net::solve(&system, &lagrange::net::Settings::default()) {
            Ok(found) => {
                check(case.name, &system, &chain, found.equilibrium);
                compared += 1;
            }
            Err(error) => refused(&SolverName::LAGRANGE, &error),
        }
        let chain = energy::minimise(&problem, &energy::Settings::default());
        let chain = chain.expect("energy answers every case").equilibrium;
        match minimise(&system, &energy::net::Settings::default()) {
            Ok(found) => {
                check(case.name, &system, &chain, found.equilibrium);
                compared += 1;
            }
            Err(error) => refused(&SolverName::ENERGY, &error),
        }
    }
    assert!(compared >= 2 * cases::all().len() - REFUSED.len());
}
