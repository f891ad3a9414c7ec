//! The rows of a case: one answer against itself turned about the vertical of its anchors.

use model::{Anchors, Bar, Equilibrium, Problem, SolverName, Vector};

use super::*;

/// The paper's chain with its anchors beside the origin.
fn problem() -> Problem {
    let anchors = Anchors { start_m: [3.0, -2.0, 0.5], end_m: [3.0, -2.0, -1.5] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    Problem::new(Chain::new("paper", 9.81, anchors, vec![bar; 3]).unwrap()).unwrap()
}

fn turned(answer: &Equilibrium, angle: f64) -> Equilibrium {
    let (sin, cos) = angle.sin_cos();
    let vector = |[x, y, z]: Vector| [cos * x - sin * y, sin * x + cos * y, z];
    let [x0, y0, _] = answer.joints_m[0];
    let place = |[x, y, z]: Vector| {
        let [x, y, z] = vector([x - x0, y - y0, z]);
        [x0 + x, y0 + y, z]
    };
    let mut turned = answer.clone();
    turned.joints_m.iter_mut().for_each(|joint| *joint = place(*joint));
    turned.multipliers_n.iter_mut().for_each(|force| *force = vector(*force));
    turned.reactions_n.start = vector(answer.reactions_n.start);
    turned.reactions_n.end = vector(answer.reactions_n.end);
    turned
}

/// Joints and forces come back by the turn that was found; what was changed besides is told in its
/// own unit: 9.81 · 3 N times 3 m, and the weight, which is the largest force.
#[test]
fn a_turn_is_taken_back_before_the_rows_are_written() {
    let problem = problem();
    let first = lagrange::solve(&problem, &lagrange::Settings::default()).unwrap().equilibrium;
    // An answer that breaks the laws is not turned.
    for (angle, off) in [(0.7, 0.0), (-2.0, 0.0), (0.0, 9.81)] {
        let mut second = turned(&first, angle);
        second.solver = SolverName::ENERGY;
        second.energy_j += off;
        second.axial_n[1] += off;
        let rows = listed(&problem, [first.clone(), second]);
        // The energy, two joints between the anchors, four forces, and three bars.
        assert_eq!(rows.len(), 1 + 2 * 3 + 4 * 3 + 3);
        for row in rows {
            let wanted = match row.observable.as_str() {
                "energy_j" => off / (9.0 * 9.81),
                "axial[2]_n" => off / (3.0 * 9.81),
                _ => 0.0,
            };
            assert!((row.difference - wanted).abs() < 1e-13, "{angle}: {row:?}");
        }
    }
}

fn listed(problem: &Problem, answers: [Equilibrium; 2]) -> Vec<Row> {
    let system = System::from(problem.chain());
    let bars = system.as_row().unwrap();
    rows("case", &system, bars, &answers.map(|answer| bars.equilibrium(answer))).unwrap()
}

#[test]
fn rows_are_written_as_columns() {
    let row = Row {
        case: "c".to_owned(),
        observable: "energy_j".to_owned(),
        lagrange: 1.0,
        energy: -0.25,
        difference: 1.25,
    };
    let result =
        CaseResult { case: "c".to_owned(), bars: 3, rows: vec![row], ..CaseResult::default() };
    assert_eq!(
        csv(&[result]),
        "case,observable,lagrange,energy,difference\nc,energy_j,1e0,-2.5e-1,1.25e0\n"
    );
}

/// The largest differences in units of length, force and energy.
#[test]
fn a_case_is_told_in_the_units_of_its_budgets() {
    let case = model::cases::get("two-bars").unwrap();
    let result = run(case);
    assert_eq!((result.case.as_str(), result.bars, result.failure.as_ref()), ("two-bars", 2, None));
    assert!(result.agrees() && result.rung.is_some());
    let agreement = result.agreement.unwrap();
    let problem = case.problem();
    let chain = problem.chain();
    let length_m = chain.total_length_m();
    let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
    let [joints, forces, energy, statics] = result.scaled.unwrap();
    let rounding_m = stored_rounding_m(chain);
    let beyond_m =
        if agreement.joints_m > rounding_m { agreement.joints_m - rounding_m } else { 0.0 };
    assert!((joints - beyond_m / length_m).abs() < 1e-20, "{joints:e}");
    assert!((energy * weight_n * length_m - agreement.energy_j).abs() < 1e-20, "{energy:e}");
    assert!(forces * weight_n <= agreement.forces_n);
    assert!(agreement.statics.iter().all(|one| one.largest() <= statics));
}

/// Of chains of more than ten bars the ends are listed, and ten axial forces.
#[test]
fn long_chains_are_told_by_their_ends() {
    let count = |bars: usize| {
        let problem = samples::homogeneous(9.81, &vec![(1.0, 1.0); bars], [1.0, 0.0, 0.25]);
        let settings = lagrange::condensed::Settings::default();
        let first = lagrange::condensed::solve(&problem, &settings).unwrap().equilibrium;
        let rows = listed(&problem, [first.clone(), first]);
        assert_eq!(rows.last().unwrap().observable, format!("axial[{}]_n", bars.min(10)));
        assert!(rows.iter().all(|row| row.difference < 1e-15));
        let starting = |with: &str| rows.iter().filter(|r| r.observable.starts_with(with)).count();
        (starting("joint"), starting("force"), starting("axial"))
    };
    assert_eq!(count(10), (27, 33, 10));
    assert_eq!(count(11), (0, 6, 10));
}
