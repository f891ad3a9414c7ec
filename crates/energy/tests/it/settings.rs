//! Every entry refuses settings out of range, by name and with the range.

use energy::batch::{Batch, BatchSettings};
use energy::{Error, Seed, Settings, minimise, minimise_from, net, reaction_by_differences};

type Refused = (&'static str, f64, f64);

fn field(error: Error) -> Refused {
    match error {
        Error::Setting { field, low, high, .. } => (field, low, high),
        other => panic!("{other}"),
    }
}

#[test]
fn chains_refuse_settings_out_of_range() {
    let problem = model::cases::paper();
    let seed = Seed::angles(&problem, &[0.3, 0.7, -1.3]).unwrap();
    let good = Settings::default();
    let solution = minimise(&problem, &good).unwrap();
    for (settings, expected) in [
        (Settings { gradient_tolerance: 0.9e-15, ..good }, ("gradient_tolerance", 1e-15, 1e-3)),
        (Settings { gradient_tolerance: 1.1e-3, ..good }, ("gradient_tolerance", 1e-15, 1e-3)),
        (Settings { gradient_tolerance: f64::NAN, ..good }, ("gradient_tolerance", 1e-15, 1e-3)),
        (Settings { closure_tolerance: 0.9e-15, ..good }, ("closure_tolerance", 1e-15, 1e-6)),
        (Settings { closure_tolerance: 1.1e-6, ..good }, ("closure_tolerance", 1e-15, 1e-6)),
        (Settings { max_iterations: 0, ..good }, ("max_iterations", 1.0, u64::MAX as f64)),
    ] {
        assert_eq!(field(minimise(&problem, &settings).unwrap_err()), expected);
        assert_eq!(field(minimise_from(&problem, &seed, &settings).unwrap_err()), expected);
        let reaction = reaction_by_differences(&problem, &solution, &settings);
        assert_eq!(field(reaction.unwrap_err()), expected);
        assert_eq!(field(energy::example::minimise(0.3, 0.7, &settings).unwrap_err()), expected);
    }
}

#[test]
fn batches_refuse_settings_out_of_range() {
    let problem = model::cases::paper();
    let good = BatchSettings::default();
    for (settings, expected) in [
        (BatchSettings { tolerance: 0.9e-14, ..good }, ("tolerance", 1e-14, 1e-3)),
        (BatchSettings { tolerance: 1.1e-3, ..good }, ("tolerance", 1e-14, 1e-3)),
        (BatchSettings { closure: 0.9e-15, ..good }, ("closure", 1e-15, 1e-6)),
        (BatchSettings { closure: 1.1e-6, ..good }, ("closure", 1e-15, 1e-6)),
        (BatchSettings { max_iterations: 0, ..good }, ("max_iterations", 1.0, 60_000.0)),
        (BatchSettings { max_iterations: 60_001, ..good }, ("max_iterations", 1.0, 60_000.0)),
    ] {
        assert_eq!(field(Batch::new(&problem, settings).unwrap_err()), expected);
    }
}

#[test]
fn systems_refuse_settings_out_of_range() {
    let system = model::cases::exhibit("lamp").unwrap().system();
    let good = net::Settings::default();
    let seed: Vec<_> = system.joints().iter().map(|_| [0.5, 0.0, -0.5]).collect();
    for (settings, expected) in [
        (net::Settings { tolerance: 0.9e-15, ..good }, ("tolerance", 1e-15, 1e-3)),
        (net::Settings { tolerance: 1.1e-3, ..good }, ("tolerance", 1e-15, 1e-3)),
        (net::Settings { max_iterations: 0, ..good }, ("max_iterations", 1.0, u64::MAX as f64)),
    ] {
        assert_eq!(field(net::minimise(&system, &settings).unwrap_err()), expected);
        let from = net::minimise_from(&system, &seed, &settings);
        assert_eq!(field(from.unwrap_err()), expected);
    }
}
