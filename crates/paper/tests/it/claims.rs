//! The judges of the claims can be wrong-footed by no wrong number: altered prints and altered
//! answers change the verdicts.

use std::sync::OnceLock;

use paper::claims::{Assessment, Claim, claims};
use paper::example::Example;
use paper::printed::Paper;
use paper::seeds::{Survey, surveys};

/// The example and small surveys, solved once.
pub fn solved() -> &'static (Example, Vec<Survey>) {
    static ONCE: OnceLock<(Example, Vec<Survey>)> = OnceLock::new();
    ONCE.get_or_init(|| {
        let example = Example::solve().unwrap();
        let surveys = surveys(&example, 300);
        (example, surveys)
    })
}

fn find(claims: &[Claim], id: &str) -> Claim {
    claims.iter().find(|claim| claim.printed.id == id).unwrap().clone()
}

/// The verdict on a claim if something else were printed.
fn if_printed(id: &str, text: &str) -> Assessment {
    let mut paper = Paper::project();
    let printed = paper.claims.iter_mut().find(|claim| claim.id == id).unwrap();
    text.clone_into(&mut printed.printed);
    let (example, surveys) = solved();
    find(&claims(&paper, example, surveys), id).verdict
}

#[test]
fn the_verdict_follows_what_is_printed() {
    for (id, text, verdict) in [
        // The truth would be confirmed.
        ("ix-theta", "19.69487", Assessment::Confirmed),
        ("ix-alpha", "38.59914", Assessment::Confirmed),
        ("ix-beta", "286.07941", Assessment::Confirmed),
        ("x-theta", "73.92059", Assessment::Confirmed),
        ("x-alpha", "321.40086", Assessment::Confirmed),
        ("x-energy", "3.66453", Assessment::Confirmed),
        ("second", "3.66453", Assessment::Confirmed),
        ("abstract-18", "30", Assessment::Confirmed),
        ("reference-45", "33", Assessment::Confirmed),
        // Another grid point, a wrong last digit, a wrong count would not.
        ("ix-theta", "19.76704", Assessment::Refuted),
        ("ix-theta", "19.70976", Assessment::Refuted),
        ("ix-energy", "2.33548", Assessment::Refuted),
        ("x-theta", "73.92100", Assessment::Explained),
        ("parameters", "17", Assessment::Corrected),
        ("freedom", "3", Assessment::Corrected),
        ("useless", "2", Assessment::Corrected),
        ("unknowns-40", "30", Assessment::Corrected),
        ("system-30", "18", Assessment::Corrected),
        ("four", "2", Assessment::Corrected),
        ("x-first-point", "0.11459", Assessment::Undecided),
        // What is no number supports no verdict.
        ("ix-theta", "nineteen", Assessment::Undecided),
        ("x-theta", "NaN", Assessment::Undecided),
        ("abstract-18", "eighteen", Assessment::Undecided),
    ] {
        assert_eq!(if_printed(id, text), verdict, "{id} printed as {text}");
    }
}

/// Names of the claims that are not as expected when the answers are altered.
fn unexpected(change: impl Fn(&mut Example)) -> Vec<String> {
    let (example, surveys) = solved();
    let mut altered = example.clone();
    change(&mut altered);
    let judged = claims(&Paper::project(), &altered, surveys);
    judged.into_iter().filter(|claim| !claim.as_expected).map(|claim| claim.printed.id).collect()
}

#[test]
fn an_altered_answer_changes_the_verdicts_that_rest_on_it() {
    assert_eq!(unexpected(|_| ()), Vec::<String>::new());

    // One multiplier with the wrong sign, in either solver.
    let flipped = unexpected(|e| {
        let force = &mut e.lagrange.e1.equilibrium.multipliers_n[2];
        force[2] = -force[2];
    });
    assert_eq!(flipped, ["reaction-b-z", "turned"]);
    let flipped = unexpected(|e| {
        let force = &mut e.energy.e1.equilibrium.multipliers_n[1];
        force[1] = -force[1];
    });
    assert_eq!(flipped, ["reaction-a-y"]);
    assert_eq!(unexpected(|e| e.energy.reaction_at_d_mg[2] += 1e-9), ["reaction-d-z"]);

    // A position a little off, an energy a little off.
    let moved = unexpected(|e| e.energy.e1.equilibrium.joints_m[1][2] += 1e-9);
    assert_eq!(moved, ["span", "ix-theta", "ix-alpha", "same-first"]);
    let lower = unexpected(|e| e.energy.e1.equilibrium.energy_j -= 1e-10);
    assert_eq!(lower, ["ix-energy"]);

    // E2 of other stability, or a minimiser that stays there.
    assert_eq!(
        unexpected(|e| e.energy.at_e2.stability = e.lagrange.e1.equilibrium.stability),
        ["minima"]
    );
    assert_eq!(
        unexpected(|e| e.energy.from_e2.equilibrium = e.lagrange.e2.equilibrium.clone()),
        ["second"]
    );
    // A third circle's worth of freedom.
    assert_eq!(unexpected(|e| e.lagrange.e1.nullity = 5), ["infinity"]);

    // Another scan.
    let finer = unexpected(|e| e.energy.scan = energy::example::scan(5e-4).unwrap());
    let all = ["scan-ix", "scan-x", "ix-theta", "ix-alpha", "ix-beta", "x-first-point"];
    assert!(finer.iter().all(|id| all.contains(&id.as_str())) && finer.len() >= 3, "{finer:?}");
}

#[test]
fn nan_is_never_a_verdict() {
    let (example, surveys) = solved();
    let mut altered = example.clone();
    altered.lagrange.e1.equilibrium.energy_j = f64::NAN;
    altered.lagrange.e1.equilibrium.joints_m[1][1] = f64::NAN;
    altered.energy.e1.equilibrium.multipliers_n[3][1] = f64::NAN;
    let judged = claims(&Paper::project(), &altered, surveys);
    let known = "span ix-theta ix-alpha ix-energy same-first symmetric-ix cosine turned";
    for id in known.split(' ') {
        let claim = find(&judged, id);
        assert!(!claim.as_expected, "{claim:?}");
    }
    assert!(judged.iter().all(|claim| claim.number.is_none_or(f64::is_finite)));
}

#[test]
fn every_claim_has_a_judge() {
    let (example, surveys) = solved();
    for claim in claims(&Paper::project(), example, surveys) {
        assert_ne!(claim.number_is.to_string(), "nobody judges this claim", "{}", claim.printed.id);
    }
    let mut paper = Paper::project();
    paper.claims[0].id = "a claim that nobody knows".to_owned();
    assert_eq!(claims(&paper, example, surveys)[0].verdict, Assessment::Undecided);
}
