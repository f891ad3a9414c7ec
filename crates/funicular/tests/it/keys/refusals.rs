//! Every refusal of a solver as JSON and as a sentence: what went into it stands in both. What a
//! refusal is of is asserted where it arises, in the solvers' own tests.

use serde::Serialize;
use serde_json::Value;

use model::system::Misfit;

use super::output::Output;

/// Objects as lines of JSON, each with words that its sentence has to say.
pub fn output(kind: &str, test: &str, refusals: &[(Value, String, &[&str])]) {
    let mut lines = String::new();
    for (object, sentence, words) in refusals {
        for word in *words {
            assert!(sentence.contains(word), "{sentence} for {word}");
        }
        lines += &object.to_string();
        lines.push('\n');
    }
    drop(Output::lines(kind, test, &lines));
}

/// A refusal with words that its sentence has to say.
pub fn of<'a>(
    refusal: &(impl Serialize + ToString),
    words: &'a [&'a str],
) -> (Value, String, &'a [&'a str]) {
    (serde_json::to_value(refusal).unwrap(), refusal.to_string(), words)
}

#[test]
fn refusals_of_energy_for_chains() {
    use energy::Error;
    let refusals = [
        of(&Error::SeedSize { bars: 3, given: 4 }, &["for each of the 3 bars, got 4"]),
        of(
            &Error::SeedDirection { bar: 5, direction: [0.25, 0.75, -1.5] },
            &["direction 5 of the seed, [0.25, 0.75, -1.5], points nowhere"],
        ),
        of(&Error::SeedAngle { angle_rad: 6.5 }, &["finite, got 6.5 rad"]),
        of(
            &Error::SeedNotClosed { gap: 0.125, iterations: 7 },
            &["0.125 of the total length is left after 7 corrections"],
        ),
        of(
            &Error::NotConverged { iterations: 8, gradient: 0.375 },
            &["after 8 iterations: projected gradient 0.375"],
        ),
        of(
            &Error::NoDescent { iterations: 9, gradient: 0.625, gap: 0.0625, directions: 2 },
            &["after 9 iterations", "gradient 0.625", "closure 0.0625", "in 2 directions"],
        ),
        of(&Error::NearlyFolded { across: 3e-8 }, &["the anchors 3e-8 of the total length"]),
    ];
    output("a refusal of energy", "refusals_of_energy_for_chains", &refusals);
}

#[test]
fn refusals_of_energy_for_systems() {
    use energy::Error;
    let refusals = [
        of(
            &Error::Setting { field: "tolerance", value: 2.5, low: 1e-14, high: 0.5 },
            &["tolerance must lie between 1e-14 and 0.5, got 2.5"],
        ),
        of(&Error::NoMember, &["has no member"]),
        of(&Error::NoLoad, &["no force acts on the system"]),
        of(
            &Error::Direction { joint: "S".into(), direction: [0.25, 0.75, -1.5] },
            &["joint S has a direction that points nowhere: [0.25, 0.75, -1.5]"],
        ),
        of(
            &Error::Falls { joint: "F".into(), force_n: 5.5 },
            &["joint F falls for ever", "a force of 5.5 N"],
        ),
        of(&Error::Seed { joints: 6, given: 7 }, &["each of the 6 joints, got 7"]),
        of(
            &Error::NotClosed { member: 8, misfit_m: 0.875 },
            &["member 8 is 0.875 m off in the best"],
        ),
        of(
            &Error::IterationLimit { iterations: 9, unbalance: 0.125, misfit: 0.25 },
            &["after 9 iterations: unbalanced force 0.125", "off by 0.25"],
        ),
        of(&Error::Work { spent: 16, max_work: 15 }, &["factors of 16 numbers", "max_work is 15"]),
        of(
            &Error::Stalled { unbalance: 0.375, misfit: 0.5 },
            &["unbalanced force 0.375", "off by 0.5"],
        ),
        of(&Error::NoMinimum { index: 10 }, &["in 10 independent directions"]),
        of(
            &Error::NoMinimumNear { joint: "P".into(), moved_m: 14.5 },
            &["no minimum near the drawing", "joint P is 14.5 m away"],
        ),
        of(
            &Error::WrongSign { member: 11, force_n: -6.5 },
            &["would balance with -6.5 N in member 11"],
        ),
        of(
            &Error::FloorPulls { joint: "L".into(), force_n: 7.5 },
            &["joint L would balance with 7.5 N"],
        ),
        of(&Error::NotFinite { quantity: "energy" }, &["the energy is not a finite number"]),
        of(&Error::Memory { coordinates: 13 }, &["a system of 13 coordinates"]),
        of(
            &Error::Ended { reason: "in its words".into() },
            &["argmin ended the run: in its words"],
        ),
    ];
    output("a refusal of energy for a system", "refusals_of_energy_for_systems", &refusals);
}

#[test]
fn refusals_of_lagrange_for_chains() {
    use lagrange::Error;
    let refusals = [
        of(
            &Error::Stagnated { residual: 0.125, iterations: 7, relaxations: 8 },
            &["residual 0.125 (relative) after 7 steps and 8 relaxations"],
        ),
        of(&Error::FalseRoot { bar: 9, moment: 0.25 }, &["a moment of 0.25", "acts on bar 9"]),
        of(&Error::Spectrum { size: 12 }, &["the Jacobian (size 12)"]),
        of(
            &Error::NotClosed { closure: 0.375, passes: 13 },
            &["off by 0.375 of its length after 13 passes"],
        ),
        of(&Error::Overflow, &["larger than a double can hold"]),
    ];
    output("a refusal of lagrange", "refusals_of_lagrange_for_chains", &refusals);
}

#[test]
fn refusals_of_lagrange_for_systems() {
    use lagrange::Error;
    use lagrange::SettingsError;
    let settings = SettingsError { name: "tolerance", value: 2.5, low: 1e-14, high: 0.5 };
    let joint = || "P".to_owned();
    let refusals = [
        of(&Error::Settings(settings), &["tolerance", "2.5"]),
        of(
            &Error::SeedLength { of: "joints", expected: 3, got: 4 },
            &["holds 4 joints, the system has 3"],
        ),
        of(&Error::SeedNotFinite { of: "joint", number: 5 }, &["not finite at joint 5"]),
        of(
            &Error::Falls { joint: joint(), joints: 6, load_n: 7.5 },
            &["joint P and the 6 joints", "resists 7.5 N"],
        ),
        of(
            &Error::Escapes { joint: joint(), distance_m: 8.5 },
            &["joint P moves on", "8.5 m away"],
        ),
        of(
            &Error::TooShort { from: "A".into(), to: "B".into(), distance_m: 9.5, reach_m: 4.5 },
            &["9.5 m between A and B", "reach 4.5 m"],
        ),
        of(
            &Error::HeldMisfit { member: 10, length_m: 3.5, distance_m: 2.25 },
            &["member 10 of 3.5 m is held at both ends, 1.25 m less apart than that"],
        ),
        of(&Error::Unloaded, &["nothing decides the shape"]),
        of(
            &Error::NotConverged {
                iterations: 11,
                joint: joint(),
                unbalance: 0.125,
                member: 12,
                misfit_m: 0.25,
            },
            &["after 11 factorisations", "balance of P is off by 0.125", "member 12 by 0.25 m"],
        ),
        of(&Error::Floor { rounds: 13 }, &["after 13 rounds"]),
        of(&Error::Unstable { index: 14 }, &["of index 14"]),
        of(&Error::Work { spent: 17, max_work: 16 }, &["17 entries", "max_work is 16"]),
        of(&Error::Memory { unknowns: 15 }, &["of 15 unknowns"]),
    ];
    output("a refusal of lagrange for a system", "refusals_of_lagrange_for_systems", &refusals);
}

/// Where no derivative exists.
#[test]
fn refusals_of_lagrange_for_derivatives() {
    use lagrange::Error;
    let joint = || "P".to_owned();
    let refusals = [
        of(&Error::FreeMotion { motions: 16 }, &["16 independent motions meet no stiffness"]),
        of(&Error::OpenForces { dimension: 17 }, &["17 independent self-stresses"]),
        of(
            &Error::JustTaut { member: 18 },
            &["member 18 has just its length and bears no force but that of its own weight"],
        ),
        of(&Error::JustTouches { joint: joint() }, &["joint P just touches the floor"]),
        of(&Error::NoDerivative { left: 0.375 }, &["leave 0.375 of a change"]),
        of(&Error::NotAnAnchor { joint: joint() }, &["joint P is no anchor"]),
    ];
    output("a refusal of lagrange for a system", "refusals_of_lagrange_for_derivatives", &refusals);
}

/// Lengths that do not fit each other, and forces that nothing decides.
#[test]
fn refusals_of_lagrange_for_frames() {
    use lagrange::Error;
    let misfits = vec![Misfit { member: 1, misfit_m: 0.25, within_m: 0.125 }];
    let refusals = [
        of(&Error::Misfit { misfits }, &["ends of member 2 are 0.25 m", "length_tolerance_m"]),
        of(
            &Error::Absurd { member: 2, force_n: 3.5, ratio: 4.5 },
            &["member 2 would bear 3.5 N, 4.5 times the loads"],
        ),
        of(
            &Error::from(model::system::RunTogether {
                member: 3,
                from: "P".into(),
                to: "D".into(),
            }),
            &["the rope (member 3) jams: P and D run together"],
        ),
    ];
    output("a refusal of lagrange for a system", "refusals_of_lagrange_for_frames", &refusals);
}

/// The same of the other solver.
#[test]
fn refusals_of_energy_for_frames() {
    use energy::Error;
    let misfits = vec![Misfit { member: 1, misfit_m: 0.25, within_m: 0.125 }];
    let refusals = [
        of(&Error::Misfit { misfits }, &["member 2 is 0.25 m off, where 0.125 m"]),
        of(&Error::Absurd { member: 2, ratio: 4.5 }, &["4.5 times the loads in member 2"]),
        of(
            &Error::Unbalanced { joint: "U".into(), unbalance: 0.5 },
            &["joint U is out of balance by 0.5"],
        ),
        of(&Error::Jammed { member: 6, span: 7 }, &["(member 6) jams: its span 7 has no length"]),
    ];
    output("a refusal of energy for a system", "refusals_of_energy_for_frames", &refusals);
}
