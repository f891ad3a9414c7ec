//! `reproduce`: the reference digits of the paper's example (40-digit root finding and a Gröbner
//! basis, by others), its own closure and energy, counts, and numbers that others have published.

use serde_json::{Value, json};

use super::output::Output;
use super::solve::NOTHING;
use super::table;

/// Angles of E1 from the descending vertical, degrees.
const E1: [f64; 3] = [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34];
/// Energies of E1 and E2, mgl.
const ENERGIES: [f64; 2] = [2.335_468_651_999_305, 3.664_531_348_000_695];
/// λ_2 and, upright, λ_3, λ_6, λ_9, λ_12 at E1, mg.
const LEVEL: f64 = 0.648_944_835_933_933_6;
const UPRIGHT: [f64; 4] = [
    2.312_944_292_241_837_6, -1.312_944_292_241_837_6, -0.312_944_292_241_837_6,
    0.687_055_707_758_162_4,
];

/// Energy of three angles, mgl, as (vi) has it: from 6 mgl below the first anchor.
fn energy(angles: [f64; 3]) -> f64 {
    let [a, b, c] = angles.map(f64::cos);
    6.0 - 2.5 * a - 1.5 * b - 0.5 * c
}

/// The energy over θ on the branch of (viii) next to an angle α, with that angle.
fn along(theta: f64, mut alpha: f64) -> (f64, f64) {
    for _ in 0..50 {
        let left = 5.0 - 4.0 * theta.cos() - 4.0 * alpha.cos() + 2.0 * (alpha - theta).cos();
        alpha -= left / (4.0 * alpha.sin() - 2.0 * (alpha - theta).sin());
    }
    let sin = -theta.sin() - alpha.sin();
    let cos = 2.0 - theta.cos() - alpha.cos();
    (energy([theta, alpha, sin.atan2(cos)]), alpha)
}

/// dV/dθ there, by differences.
fn slope(theta: f64, alpha: f64) -> f64 {
    let h = 1e-5;
    (along(theta + h, alpha).0 - along(theta - h, alpha).0) / (2.0 * h)
}

#[test]
fn the_paper_judged() {
    let [mut output] = table::outputs("the_paper_judged");
    equilibria(&mut output);
    completeness(&mut output);
    claims(&mut output);
    equations(&mut output);
    cases(&mut output);
    seeds(&mut output);
    field(&mut output);
    figures(&mut output);
    environment(&mut output);
}

fn equilibria(output: &mut Output) {
    let at = |key: &str| format!("equilibria[].{key}");
    // E2 is E1 upside down: what held an end up now is the other one.
    let [p, q, r, s] = UPRIGHT;
    let forces = |sign: f64, up: [f64; 4]| {
        let level = [-sign, sign, sign, sign].map(|sign| sign * LEVEL);
        [0, 1, 2, 3].map(|k| [level[k], up[k]])
    };
    let turned = [s, -r, -q, p];
    output.is(
        &at("forces_mg[][]"),
        json!([
            forces(1.0, UPRIGHT),
            forces(-1.0, UPRIGHT),
            forces(1.0, turned),
            forces(-1.0, turned)
        ]),
    );
    // The size of the mean force of each bar.
    let axial = [LEVEL.hypot(p - 0.5), LEVEL.hypot(0.5 - q - 1.0), -LEVEL.hypot(0.5 + r)];
    let axial = [axial[0], LEVEL.hypot(-q - 0.5), axial[2]];
    let upside = [-axial[2], -axial[1], -axial[0]];
    output.is(&at("axial_mg[]"), json!([axial, axial, upside, upside]));
}

fn completeness(output: &mut Output) {
    let at = |key: &str| format!("completeness.{key}");
    // (ix) and (x) as printed, each with half of its last digit.
    for (which, theta, alpha) in [("first", 0.344, 0.67), ("second", 0.001, -1.05)] {
        let found = output.numbers(&at(&format!("{which}.slope_mgl[]")));
        let wanted = slope(theta, alpha);
        assert!(found[0] - 1e-5 <= wanted && wanted <= found[1] + 1e-5, "{found:?} {wanted}");
        assert!(found[0] < found[1] && found[1] - found[0] < 1e-5, "{found:?}");
    }
}

fn claims(output: &mut Output) {
    let at = |key: &str| format!("claims[].{key}");
    let listed = include_str!("../../../../../validation/paper.toml");
    let count = listed.lines().filter(|line| line.starts_with("[[claim]]")).count();
    let ids = output.values(&at("id"));
    assert_eq!(ids.len(), count);
    assert!(count >= 50);
    // What is printed and expected stands in the file, word by word.
    for key in ["id", "says", "where", "printed", "unit", "expected"] {
        for text in output.values(&at(key)).iter().filter_map(Value::as_str) {
            assert!(listed.contains(&format!("{key} = \"{text}\"")), "{key}: {text}");
        }
    }
    for digits in output.values(&at("digits")).iter().filter_map(Value::as_i64) {
        assert!(listed.contains(&format!("digits = {digits}\n")), "{digits}");
    }
    assert_eq!(output.values(&at("verdict")), output.values(&at("expected")));
    let place = |id: &str| ids.iter().position(|found| found == id).unwrap();
    let [lagrange, energies, number] =
        ["lagrange", "energy", "number"].map(|key| output.values(&at(key)));
    let says = output.values(&at("number_is"));
    assert!(says[place("abstract-18")].as_str().unwrap().contains("equations missing"));
    let near = |value: &Value, wanted: f64| {
        assert!((value.as_f64().unwrap() - wanted).abs() < 1e-9, "{value} {wanted}");
    };
    for (id, both, apart) in [
        // In steps of a scan by thousandths.
        ("ix-theta", E1[0], 344.0 - E1[0].to_radians() * 1000.0),
        ("ix-energy", ENERGIES[0], 2.335_47 - ENERGIES[0]),
        ("reaction-d-z", UPRIGHT[3], 0.0),
    ] {
        near(&lagrange[place(id)], both);
        near(&energies[place(id)], both);
        // By the digits that are printed.
        assert!((number[place(id)].as_f64().unwrap() - apart).abs() < 1e-3, "{id}");
    }
    near(&number[place("abstract-18")], 12.0);
    // What (x) leaves of (40), in mg, and the slope there.
    assert!((number[place("x-multipliers")].as_f64().unwrap() - 0.5229).abs() < 1e-4);
    assert!((number[place("x-slope")].as_f64().unwrap() - slope(0.001, -1.05)).abs() < 1e-4);
    let verdicts = output.values(&at("verdict"));
    let count = |verdict: &str| verdicts.iter().filter(|found| *found == verdict).count();
    let summary = |key: &str| format!("summary.{key}");
    output.is(&summary("claims"), verdicts.len());
    for verdict in ["confirmed", "explained", "corrected", "refuted", "undecided"] {
        let listed = listed.matches(&format!("expected = \"{verdict}\"")).count();
        assert_eq!(count(verdict), listed, "{verdict}");
        output.is(&summary(verdict), listed);
    }
}

/// The equations that do not hold as printed, as referees with computer algebra found them.
fn equations(output: &mut Output) {
    let at = |key: &str| format!("equations[].{key}");
    let numbers = output.values(&at("number"));
    let place = |number: &str| numbers.iter().position(|found| found == number).unwrap();
    let [printed, corrected] = ["as_printed", "as_corrected"].map(|key| output.values(&at(key)));
    let substance =
        ["(5)", "(18)", "(19)", "(20)", "(24)", "(31)", "(39)", "(x)", "(xxiii)", "(xxiv)"];
    output.is("summary.faulty_equations.substance[]", substance.as_slice());
    let faults = output.values(&at("fault"));
    for number in substance {
        assert!(
            faults.iter().zip(&numbers).any(|(f, n)| n == number && f == "substance"),
            "{number}"
        );
    }
    // 18 of 30 equations; one that holds; (viii)'s energy at the printed (ix) by its last digit.
    assert_eq!(printed[place("abstract")], json!(-12.0));
    assert_eq!(corrected[place("abstract")], json!(0.0));
    assert!(printed[place("(7)")].as_f64().unwrap().abs() < NOTHING);
    let mut of_angles = numbers.iter().zip(&printed).filter(|(number, _)| *number == "(xxiii)");
    assert!(of_angles.any(|(_, left)| left.as_f64().is_some_and(|left| left.abs() > 0.1)));
    let counts = output.values(&at("counts"));
    assert_eq!(counts[place("abstract")], true);
    let texts = |output: &mut Output, key: &str, number: &str, words: &str| {
        let found = output.values(&at(key));
        let text = found[place(number)].as_str().unwrap();
        assert!(text.contains(words), "{key} of {number}: {text}");
    };
    texts(output, "section", "(8)", "III");
    texts(output, "what", "(8)", "bar 1 is held at O");
    texts(output, "measure", "(8)", "1000 random configurations");
    texts(output, "corrected", "abstract", "30 equations");
    texts(output, "verdict", "abstract", "corrected");
    let verdicts = output.values(&at("verdict"));
    let count = |verdict: &str| verdicts.iter().filter(|found| *found == verdict).count();
    output.is("summary.equations", numbers.len());
    output.is("summary.equations_corrected", count("corrected"));
    output.is("summary.equations_refuted", count("refuted"));
}

/// What follows is asserted where it is found, in `paper`, `energy` and `validate`: here one value of each is told by
/// its name.
fn cases(output: &mut Output) {
    let at = |key: &str| format!("cases[].{key}");
    let all = model::cases::all();
    output.is(&at("case"), all.iter().map(|case| case.name).collect::<Vec<_>>());
    output.is(&at("about"), all.iter().map(|case| case.about).collect::<Vec<_>>());
    output.are(json!({ "summary.cases": all.len(), "summary.cases_agreed": all.len() }));
    let rows = |key: &str| at(&format!("rows[].{key}"));
    // The paper's chain turns about the vertical through its anchors.
    first(output, &at("bars"), 3);
    first(output, &at("agreement.turned_parts"), 1);
    first(output, &at("agreement.self_stresses"), 0);
    first(output, &rows("case"), "three-equal-bars");
    first(output, &rows("observable"), "energy_j");
    for solver in ["lagrange", "energy"] {
        first(output, &rows(solver), (ENERGIES[0] - 6.0) * 9.806_65);
    }
    let found = output.numbers(&rows("difference"));
    assert!(found.iter().all(|difference| (0.0..1e-9).contains(difference)));
    let at = |key: &str| format!("summary.largest_difference.{key}");
    output.is(&at("case"), "far-from-the-origin");
    assert!(output.values(&at("observable"))[0].is_string());
    let [a, b] = ["lagrange", "energy"].map(|key| output.numbers(&at(key))[0]);
    assert!((a - b).abs() <= 1e-9 * a.abs().max(1.0), "{a} {b}");
}

/// The first of the values at a path.
fn first(output: &mut Output, path: &str, wanted: impl Into<Value>) {
    let (found, wanted) = (output.values(path).remove(0), wanted.into());
    let same = match (found.as_f64(), wanted.as_f64()) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-12 * b.abs().max(1.0),
        _ => found == wanted,
    };
    assert!(same, "{path}: {found} for {wanted}");
}

fn seeds(output: &mut Output) {
    let at = |key: &str| format!("seeds[].{key}");
    let reached = output.numbers(&at("reached[].seeds"));
    assert!((reached[..4].iter().sum::<f64>() - 10_000.0).abs() < 0.5, "{reached:?}");
    // The second solver at minima alone, and always directly.
    assert!(reached[6] + reached[7] + reached[11] < 0.5, "{reached:?}");
    let direct = output.values(&at("direct"));
    assert!(direct[0].as_f64().unwrap() <= 10_000.0 && direct[1].is_null() && direct[3].is_null());
    let [median, most, largest] =
        ["median_iterations", "most_iterations_of_95_percent", "most_iterations"]
            .map(|key| output.numbers(&at(key)));
    for k in 0..4 {
        assert!(1.0 <= median[k] && median[k] <= most[k] && most[k] <= largest[k]);
    }
}

/// Numbers that others have published, and laws that need no solver: the first line of MoorPy's table.
fn field(output: &mut Output) {
    let at = |key: &str| format!("field[].{key}");
    first(output, &at("title"), "mooring line, index 0");
    assert!(output.values(&at("source"))[0].as_str().unwrap().contains("MoorPy"));
    let reasons = output.values(&at("not_judged"));
    assert!(reasons[0].as_str().unwrap().contains("a floor with friction") && reasons[1].is_null());
    let numbers = |key: &str| at(&format!("numbers[].{key}"));
    first(output, &numbers("what"), "H at A / N");
    first(output, &numbers("published"), 96_643.428_159_340_08);
    first(output, &numbers("digits"), 8);
    first(output, &numbers("at_most"), false);
    let printed = output.values(&numbers("printed"));
    assert!(printed[0].as_str().unwrap().starts_with("96643.428"), "{}", printed[0]);
    let [ours, allowed] = ["ours", "allowed"].map(|key| output.numbers(&numbers(key)));
    assert!((ours[0] - 96_643.428_159_340_08).abs() <= allowed[0] && allowed[0] < 1.0);
    let [broken, allowed] =
        ["broken_n", "allowed_n"].map(|key| output.numbers(&at(&format!("by_hand.{key}"))));
    assert!(broken[0] <= allowed[0] && broken[0] >= 0.0);
    let laws = output.values(&at("by_hand.law"));
    assert!(laws[0].as_str().unwrap().contains("vertical forces at both ends"));
    let solvers = |key: &str| at(&format!("solvers.{key}"));
    let kinds = output.values(&solvers("kind"));
    assert!(["run", "judged", "least"].iter().all(|kind| kinds.iter().any(|k| k == kind)));
    first(output, &solvers("members"), 100);
    let off = output.values(&solvers("off[][]"));
    assert!(off[0] == "lagrange" && off[2] == "energy");
}

/// Curves of the paper's figures, angles in degrees.
fn figures(output: &mut Output) {
    let at = |key: &str| format!("figures.{key}");
    let point = output.numbers(&at("closure_curve[][]"));
    let angles = [point[0], point[1], point[2]].map(f64::to_radians);
    assert!((energy(angles) - point[3]).abs() < 1e-9, "{angles:?}");
    let near = output.numbers(&at("near_minimum[][]"));
    assert!((along(near[0].to_radians(), 0.67).0 - near[1]).abs() < 1e-9, "{near:?}");
    let scan = output.numbers(&at("scan_points[][][]"));
    assert!((along(scan[0].to_radians(), 1.05).0 - scan[1]).abs() < 1e-6, "{scan:?}");
    let results = output.numbers(&at("scan_results[][]"));
    assert!((results[0] - 19.709_75).abs() < 0.6e-5, "{results:?}");
    output.near(&at("slope_at_x"), 1e-4, slope(0.001, -1.05));
    let rows = output.values(&at("basins[].rows[]"));
    // All four equilibria by the first solver, minima alone by the second.
    let (half, all) = (rows.len() / 2, |rows: &[Value]| json!(rows).to_string());
    assert!(['1', '2', '3', '4'].iter().all(|letter| all(&rows[..half]).contains(*letter)));
    assert!(!all(&rows[half..]).contains(['3', '4']));
    let at = |key: &str| format!("figures.histories[].{key}");
    first(output, &at("start_deg[]"), 0.3_f64.to_degrees());
    let residuals = output.numbers(&at("residuals[]"));
    assert!(residuals[residuals.len() - 1] < NOTHING && residuals[0] > 1e-3);
}

fn environment(output: &mut Output) {
    let at = |key: &str| format!("environment.{key}");
    output.is(&at("version"), env!("CARGO_PKG_VERSION"));
    let packages = output.values(&at("packages[]"));
    let lock = include_str!("../../../../../Cargo.lock");
    for package in packages {
        let (name, version) = package.as_str().unwrap().split_once(' ').unwrap();
        let entry = format!("name = \"{name}\"\nversion = \"{version}\"");
        assert!(lock.contains(&entry), "{name} {version}");
    }
    output.says(&at("system"), json!([std::env::consts::OS]));
    let processor = output.values(&at("processor")).remove(0);
    if let Ok(known) = std::fs::read_to_string("/proc/cpuinfo") {
        assert!(known.contains(processor.as_str().unwrap()), "{processor}");
    }
    output.is(&at("threads"), std::thread::available_parallelism().unwrap().get());
}
