//! The whole paper, judged: the headline of this project.

use std::f64::consts::PI;
use std::sync::OnceLock;

use model::{InPlane, InSpace, SolverName};
use paper::claims::{Assessment, Claim};
use paper::equations;
use paper::printed::Paper;
use paper::reproduction::{Reproduction, reproduce_with};
use paper::seeds::{Kind, SEEDS, Survey};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

pub fn reproduction() -> &'static Reproduction {
    static ONCE: OnceLock<Reproduction> = OnceLock::new();
    ONCE.get_or_init(|| reproduce_with(SEEDS, |_| ()).unwrap())
}

fn claim(id: &str) -> &'static Claim {
    reproduction().claims.iter().find(|claim| claim.printed.id == id).unwrap()
}

fn reference(id: &str) -> f64 {
    let value = Paper::project().reference(id);
    assert!(value.is_finite(), "{id}");
    value
}

/// Angles as they are compared, rad; degrees differ by whole turns.
fn apart_deg(a: f64, b: f64) -> f64 {
    let turn = (a - b).rem_euclid(360.0);
    turn.min(360.0 - turn).to_radians()
}

#[test]
fn every_verdict_is_the_expected_one() {
    let r = reproduction();
    for claim in &r.claims {
        println!(
            "{:18} {:10} lagrange {:?} energy {:?}; {:?} {}",
            claim.printed.id,
            claim.verdict,
            claim.lagrange,
            claim.energy,
            claim.number,
            claim.number_is
        );
        assert!(claim.as_expected, "{claim:?}");
        assert!(claim.number.is_some() && !claim.number_is.is_empty(), "{claim:?}");
    }
    assert_eq!(r.summary.unexpected_claims, Vec::<String>::new());
    assert!(r.summary.equations_as_expected, "{:#?}", failing(r));
    assert_eq!(r.summary.cases_agreed, r.summary.cases);
    assert!(r.all_as_expected);
    let largest = claim("x-multipliers").number_is.numbers().next().unwrap().value;
    assert!((largest - 0.2366).abs() < 5e-5, "{largest}");
}

fn failing(r: &Reproduction) -> Vec<(&str, equations::Validity, &str)> {
    use equations::Validity::{Definition, Holds, Remark};
    let holds = [Holds, Definition, Remark];
    let rows = r.equations.iter().filter(|row| !holds.contains(&row.verdict));
    rows.map(|row| (row.number, row.verdict, row.what)).collect()
}

#[test]
fn both_solvers_give_e1_of_the_reference() {
    for id in ["theta", "alpha", "beta"] {
        let found = claim(&format!("ix-{id}"));
        let (lagrange, energy) = (found.lagrange.unwrap(), found.energy.unwrap());
        let reference = reference(&format!("e1-{id}"));
        for (a, b) in [(lagrange, energy), (lagrange, reference), (energy, reference)] {
            assert!(apart_deg(a, b) <= 1e-10, "{id}: {a} {b}");
        }
        // The printed grid point is less than a step of the scan away.
        assert!(apart_deg(found.printed.value(), lagrange) < 0.001, "{id}");
        assert_eq!(found.verdict, Assessment::Explained);
    }
    let v = claim("ix-energy");
    for value in [v.lagrange.unwrap(), v.energy.unwrap()] {
        assert!((value - reference("e1-energy")).abs() <= 1e-12);
        assert_eq!(format!("{value:.5}"), "2.33547");
    }
}

#[test]
fn the_multipliers_are_the_reactions() {
    let numbers = [("o", 2, 3), ("a", 5, 6), ("b", 8, 9), ("d", 11, 12)];
    for (joint, y, z) in numbers {
        for (axis, number) in [("y", y), ("z", z)] {
            let found = claim(&format!("reaction-{joint}-{axis}"));
            let (lagrange, energy) = (found.lagrange.unwrap(), found.energy.unwrap());
            let reference = reference(&format!("lambda-{number}"));
            for value in [lagrange, energy] {
                assert!((value - reference).abs() <= 1e-10, "lambda_{number}: {value} {reference}");
            }
        }
    }
    // Bars 1 and 2 in tension, bar 3 in compression; the anchors carry 3 mg.
    let e1 = &reproduction().equilibria[0];
    assert!((e1.forces_mg[0][1] + e1.forces_mg[3][1] - 3.0).abs() <= 1e-12);
}

#[test]
fn the_scan_of_the_paper_returns_its_eight_numbers() {
    let found = energy::example::scan(energy::example::PAPER_STEP_RAD).unwrap();
    let paper = Paper::project();
    for (position, minimum) in [("ix", &found.first), ("x", &found.second)] {
        let numbers = minimum.printed();
        for (quantity, number) in [
            ("theta", numbers.theta),
            ("alpha", numbers.alpha),
            ("beta", numbers.beta),
            ("energy", numbers.energy),
        ] {
            assert_eq!(paper.claim(&format!("{position}-{quantity}")).unwrap().printed, number);
        }
    }
    assert!(found.second.is_end_point() && !found.first.is_end_point());
}

#[test]
fn the_second_equilibrium_is_e2_which_no_minimiser_finds() {
    let r = reproduction();
    let [e1, e1_mirrored, e2, e2_mirrored] = &r.equilibria[..] else { panic!("four equilibria") };
    for (k, id) in ["e2-theta", "e2-alpha", "e2-beta"].into_iter().enumerate() {
        assert!(apart_deg(e2.lagrange_deg[k], reference(id)) <= 1e-10);
        assert!(apart_deg(e2_mirrored.lagrange_deg[k], -reference(id)) <= 1e-10);
        assert!(apart_deg(e1_mirrored.lagrange_deg[k], -e1.lagrange_deg[k]) <= 1e-10);
    }
    assert!((e1.lagrange_mgl + e2.lagrange_mgl - 6.0).abs() <= 1e-12, "upside down");
    for found in [e2, e2_mirrored] {
        assert_eq!(found.stability.in_plane, InPlane::Maximum);
        assert_eq!(
            (found.stability.in_space, found.stability.index_in_space),
            (InSpace::Unstable, 2)
        );
        assert!(found.energy_deg.is_none() && found.energy_mgl.is_none());
    }
    // Started exactly there, the minimiser ends at E1.
    assert!((claim("second").energy.unwrap() - reference("e1-energy")).abs() <= 1e-12);
    assert_eq!(r.equilibria.iter().map(|p| p.nullity).collect::<Vec<_>>(), [4; 4]);
}

/// (viii), for the theta of (ix): four solutions, of which two close the chain. Numbers from
/// outside of the project.
#[test]
fn squaring_added_two_solutions_to_viii() {
    let solutions = claim("solutions");
    assert_eq!(solutions.verdict, Assessment::Corrected);
    let found: Vec<f64> = solutions.number_is.numbers().map(|number| number.value).collect();
    let [theta, closing @ .., a, b] = &found[..] else { panic!("{found:?}") };
    assert!((theta - 0.344).abs() < 1e-12 && closing.len() == 2, "{found:?}");
    for (value, reference) in closing.iter().chain([a, b]).zip([38.583, -73.926, -38.583, 73.926]) {
        assert!((value - reference).abs() < 5e-4, "{value} {reference}");
    }
}

/// The weights act along -Z, a right angle from the axis Ox that the angles are said to be measured
/// from.
#[test]
fn the_vertical_is_z() {
    let vertical = claim("vertical");
    assert_eq!(vertical.verdict, Assessment::Corrected);
    assert!((vertical.number.unwrap() - 90.0).abs() < 1e-12);
}

fn survey(solver: &SolverName, kind: Kind) -> &'static Survey {
    reproduction().seeds.iter().find(|s| s.solver == *solver && s.kind == kind).unwrap()
}

#[test]
fn random_seeds_lead_to_the_known_equilibria_and_nowhere_else() {
    for kind in [Kind::Planar, Kind::Spatial] {
        for solver in [SolverName::LAGRANGE, SolverName::ENERGY] {
            let found = survey(&solver, kind);
            println!("{found:?}");
            assert_eq!((found.seeds, found.elsewhere), (SEEDS, 0));
            assert!(found.rate() >= 0.95, "{found:?}");
            let counted = found.reached.iter().map(|r| r.seeds).sum::<usize>();
            assert_eq!(counted, found.converged);
            assert_eq!(found.lost.iter().map(|l| l.seeds).sum::<usize>(), SEEDS - found.converged);
            for reached in &found.reached {
                // Lagrange's equations know no up and down; a minimiser does.
                let expected =
                    solver == SolverName::LAGRANGE || reached.equilibrium.starts_with("E1");
                assert_eq!(reached.seeds > 0, expected, "{reached:?} by {solver}");
            }
        }
    }
}

/// The largest entry of the comparison is no disagreement of the solvers: coordinates of 2e6 m have
/// an ulp of 2.3e-10 m, and the bars are 0.8 m long.
#[test]
fn the_largest_difference_between_the_solvers_is_explained() {
    let row = reproduction().summary.largest_difference.as_ref().unwrap();
    println!("{row:?}");
    assert_eq!(row.case, "far-from-the-origin");
    let ulp = row.lagrange.abs().next_up() - row.lagrange.abs();
    assert!((row.lagrange - row.energy).abs() <= 2.0 * ulp, "{row:?}");
    // All others, in units of total length, force, weight times length.
    let others = reproduction().cases.iter().flat_map(|case| &case.rows);
    let others = others.filter(|other| other.case != row.case);
    let next = others.max_by(|a, b| a.difference.total_cmp(&b.difference)).unwrap();
    println!("{next:?}");
    assert!(next.difference < 1e-10, "{next:?}");
}

/// Keys whose value may be missing. Everything else that is `null` was a number that JSON cannot
/// hold.
const MAY_BE_NULL: [&str; 16] = [
    "lagrange", "energy", "unit", "digits", "energy_deg", "energy_mgl", "as_corrected", "fault",
    "force_uncertainty", // Of a row too long to count them.
    "self_stresses", "failure", "direct", "largest_difference",
    // Of a published number in `field`: what anyone can check by hand, what the solvers say, and
    // why it is not judged. Which of them there are depends on the number.
    "by_hand", "solvers", "not_judged",
];

fn nulls(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Null => found.push(path.to_owned()),
        Value::Array(items) => items.iter().for_each(|item| nulls(item, path, found)),
        Value::Object(map) => map
            .iter()
            .filter(|(key, value)| !(value.is_null() && MAY_BE_NULL.contains(&key.as_str())))
            .for_each(|(key, value)| nulls(value, &format!("{path}.{key}"), found)),
        _ => {}
    }
}

#[test]
fn the_json_holds_no_number_that_is_none() {
    let json = serde_json::to_value(reproduction()).unwrap();
    let mut found = Vec::new();
    nulls(&json, "", &mut found);
    assert!(found.is_empty(), "{found:?}");
    assert_eq!(json["all_as_expected"], Value::Bool(true));
    assert_eq!(json["claims"][0]["expected"], json["claims"][0]["verdict"]);
    // The check sees a NaN.
    let mut broken = reproduction().clone();
    broken.equilibria[0].lagrange_mgl = f64::NAN;
    let mut found = Vec::new();
    nulls(&serde_json::to_value(broken).unwrap(), "", &mut found);
    assert_eq!(found, [".equilibria.lagrange_mgl"]);
}

fn without_times(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(without_times),
        Value::Object(map) => {
            map.retain(|key, _| !["seconds", "solve_s"].contains(&key.as_str()));
            map.values_mut().for_each(without_times);
        }
        _ => {}
    }
}

#[test]
fn two_runs_differ_in_their_times_only() {
    let timeless = |run: &Reproduction| {
        let mut json = serde_json::to_value(run).unwrap();
        without_times(&mut json);
        json
    };
    let again = reproduce_with(SEEDS, |_| ()).unwrap();
    assert!(timeless(reproduction()) == timeless(&again));
}

/// Planar seeds are three angles in the plane *OYZ*, each seed from a stream of its own.
#[test]
fn planar_seeds_lie_in_the_plane() {
    let (example, surveys) = crate::claims::solved();
    let by_lagrange = |s: &&Survey| s.solver == SolverName::LAGRANGE && s.kind == Kind::Planar;
    let survey = surveys.iter().find(by_lagrange).unwrap();
    let settings = lagrange::Settings::default();
    let mut solver = lagrange::Solver::new(&example.problem, &settings).unwrap();
    let mut iterations: Vec<usize> = vec![];
    let mut direct = 0;
    for seed in 0..survey.seeds {
        let mut random = ChaCha8Rng::seed_from_u64(2026);
        random.set_stream(seed as u64);
        let angles: [f64; 3] = std::array::from_fn(|_| random.random_range(-PI..PI));
        let found = solver.solve(&lagrange::Seed::planar(&angles)).unwrap();
        iterations.push(found.effort().iterations);
        direct += usize::from(found.effort().relaxations == 0);
    }
    iterations.sort_unstable();
    assert_eq!(survey.direct, Some(direct));
    assert_eq!(survey.median_iterations, iterations[survey.seeds / 2 - 1]);
    assert_eq!(Some(&survey.most_iterations), iterations.last());
}
