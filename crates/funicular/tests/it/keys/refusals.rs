//! Every refusal of a solver as JSON and as a sentence: what went into it stands in both. What a
//! refusal is of is asserted where it arises, in the solvers' own tests.

use serde::Serialize;

use model::system::Misfit;

use super::output::Output;

/// Objects as lines of JSON, each with its sentence; what stands in them is said in the text.
pub fn output<T: Serialize + ToString>(kind: &str, test: &str, objects: &[T]) {
    let line = |object: &T| {
        let mut value = serde_json::to_value(object).unwrap();
        value["sentence"] = object.to_string().into();
        value.to_string() + "\n"
    };
    let lines: String = objects.iter().map(line).collect();
    drop(Output::lines(kind, test, &lines));
}

#[test]
fn refusals_of_energy_for_chains() {
    use energy::Error;
    let refusals = [
        Error::SeedSize { bars: 3, given: 4 },
        Error::SeedDirection { bar: 5, direction: [0.25, 0.75, -1.5] },
        Error::SeedAngle { angle_rad: 6.5 },
        Error::SeedNotClosed { gap: 0.125, iterations: 7 },
        Error::NotConverged { iterations: 8, gradient: 0.375 },
        Error::NoDescent { iterations: 9, gradient: 0.625, gap: 0.0625, directions: 2 },
        Error::NearlyFolded { across: 3e-8 },
    ];
    output("a refusal of energy", "refusals_of_energy_for_chains", &refusals);
}

#[test]
fn refusals_of_energy_for_systems() {
    use energy::Error;
    let refusals = [
        Error::Setting { field: "tolerance", value: 2.5, low: 1e-14, high: 0.5 },
        Error::NoLoad,
        Error::Falls { joint: "F".into(), force_n: 5.5 },
        Error::Seed { joints: 6, given: 7 },
        Error::NotClosed { member: 8, misfit_m: 0.875 },
        Error::IterationLimit { iterations: 9, unbalance: 0.125, misfit: 0.25 },
        Error::Work { spent: 16, max_work: 15 },
        Error::Stalled { unbalance: 0.375, misfit: 0.5 },
        Error::NoMinimum { index: 10 },
        Error::NoMinimumNear { joint: "P".into(), moved_m: 14.5 },
        Error::WrongSign { member: 11, force_n: -6.5 },
        Error::FloorPulls { joint: "L".into(), force_n: 7.5 },
        Error::NotFinite { quantity: "energy" },
        Error::Memory { coordinates: 13 },
        Error::Ended { reason: "in its words".into() },
    ];
    output("a refusal of energy for a system", "refusals_of_energy_for_systems", &refusals);
}

#[test]
fn refusals_of_lagrange_for_chains() {
    use lagrange::Error;
    let refusals = [
        Error::Stagnated { residual: 0.125, iterations: 7, relaxations: 8 },
        Error::FalseRoot { bar: 9, moment: 0.25 },
        Error::Spectrum { size: 12 },
        Error::NotClosed { closure: 0.375, passes: 13 },
        Error::Overflow,
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
        Error::Settings(settings),
        Error::SeedLength { of: "joints", expected: 3, got: 4 },
        Error::SeedNotFinite { of: "joint", number: 5 },
        Error::Falls { joint: joint(), joints: 6, load_n: 7.5 },
        Error::Escapes { joint: joint(), distance_m: 8.5 },
        Error::TooShort { from: "A".into(), to: "B".into(), distance_m: 9.5, reach_m: 4.5 },
        Error::HeldMisfit { member: 10, length_m: 3.5, distance_m: 2.25 },
        Error::Unloaded,
        Error::NotConverged {
            iterations: 11,
            joint: joint(),
            unbalance: 0.125,
            member: 12,
            misfit_m: 0.25,
        },
        Error::Floor { rounds: 13 },
        Error::Unstable { index: 14 },
        Error::Work { spent: 17, max_work: 16 },
        Error::Memory { unknowns: 15 },
    ];
    output("a refusal of lagrange for a system", "refusals_of_lagrange_for_systems", &refusals);
}

/// Where no derivative exists.
#[test]
fn refusals_of_lagrange_for_derivatives() {
    use lagrange::Error;
    let joint = || "P".to_owned();
    let refusals = [
        Error::FreeMotion { motions: 16 },
        Error::OpenForces { dimension: 17 },
        Error::JustTaut { member: 18 },
        Error::JustTouches { joint: joint() },
        Error::NoDerivative { left: 0.375 },
        Error::NotAnAnchor { joint: joint() },
    ];
    output("a refusal of lagrange for a system", "refusals_of_lagrange_for_derivatives", &refusals);
}

/// Lengths that do not fit each other, and forces that nothing decides.
#[test]
fn refusals_of_lagrange_for_frames() {
    use lagrange::Error;
    let misfits = vec![Misfit { member: 1, misfit_m: 0.25, within_m: 0.125 }];
    let refusals = [
        Error::Misfit { misfits },
        Error::Absurd { member: 2, force_n: 3.5, ratio: 4.5 },
        Error::from(model::system::RunTogether { member: 3, from: "P".into(), to: "D".into() }),
    ];
    output("a refusal of lagrange for a system", "refusals_of_lagrange_for_frames", &refusals);
}

/// The same of the other solver.
#[test]
fn refusals_of_energy_for_frames() {
    use energy::Error;
    let misfits = vec![Misfit { member: 1, misfit_m: 0.25, within_m: 0.125 }];
    let refusals = [
        Error::Misfit { misfits },
        Error::Absurd { member: 2, ratio: 4.5 },
        Error::Unbalanced { joint: "U".into(), unbalance: 0.5 },
        Error::Jammed { member: 6, span: 7 },
    ];
    output("a refusal of energy for a system", "refusals_of_energy_for_frames", &refusals);
}
