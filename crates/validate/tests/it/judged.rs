//! Answers for chains, judged as those of the systems that they are.

use model::system::{System, SystemEquilibrium};
use model::{Equilibrium, Problem};
use validate::Tolerances;
use validate::systems::{self, SystemAgreement};

fn of_system(problem: &Problem, answers: &[Equilibrium]) -> (System, Vec<SystemEquilibrium>) {
    let system = System::from(problem.chain());
    let row = system.as_row().unwrap();
    let found = answers.iter().map(|answer| row.equilibrium(answer.clone())).collect();
    (system, found)
}

/// Hold answers against each other; what that proves is written into their evidence.
pub fn compare(
    problem: &Problem,
    answers: &mut [Equilibrium],
    tolerances: &Tolerances,
) -> SystemAgreement {
    let (system, mut found) = of_system(problem, answers);
    let agreement = systems::compare(&system, &mut found, tolerances);
    for (answer, found) in answers.iter_mut().zip(found) {
        answer.evidence = found.evidence;
    }
    agreement
}

/// Judge one answer alone.
pub fn judge_alone(problem: &Problem, answer: &mut Equilibrium) {
    let (system, mut found) = of_system(problem, std::slice::from_ref(answer));
    systems::judge_alone(&system, &mut found[0]);
    answer.evidence = found.remove(0).evidence;
}

/// Both answers, of `lagrange` by the paper's equations, and how they compare.
pub fn both(problem: &Problem) -> ([Equilibrium; 2], SystemAgreement) {
    let mut answers = [
        lagrange::solve(problem, &lagrange::Settings::default()).unwrap().equilibrium,
        energy::minimise(problem, &energy::Settings::default()).unwrap().equilibrium,
    ];
    let agreement = compare(problem, &mut answers, &Tolerances::project());
    (answers, agreement)
}
