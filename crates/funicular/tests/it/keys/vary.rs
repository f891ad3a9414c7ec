//! `study`, `derivatives` and `trace`: over the weight everything scales, over the span of two bars
//! and over the lengths of a 3-4-5 triangle there are closed forms.

use serde_json::{Value, json};

use super::output::Output;
use super::solve::{AXIAL, DEPTH, H};
use super::table;

/// The level V under 10 and 20 N a bar.
#[test]
fn study_of_a_chain() {
    let [mut output, _] = table::outputs("study_of_a_chain");
    // Both bars bear the same at their anchors, (H, 10 N) along (1, √3)/2: either may be named.
    let anchor = 0.5 * H + 10.0 * DEPTH;
    let found = output.numbers("points[].tension_n[]");
    for (pair, wanted) in found.chunks(2).zip([anchor, 2.0 * anchor]) {
        assert!([1.0, 2.0].contains(&pair[0]) && (pair[1] - wanted).abs() < 1e-11, "{pair:?}");
    }
}

/// Hanging and standing under 10 to 20 N a bar: angles stay, forces and energies scale.
#[test]
fn branches_over_gravity() {
    let [mut output, columns] = table::outputs("branches_over_gravity");
    let at = |key: &str| format!("traces[].branches[].points[].{key}");
    let positions = output.numbers(&at("position"));
    assert!(positions.len() >= 4 && positions.windows(2).filter(|p| p[0] > p[1]).count() == 1);
    let each = |of: &dyn Fn(f64, f64) -> Value| -> Value {
        let mut sign = 1.0;
        let mut before = 0.0;
        let mut all = Vec::new();
        for position in &positions {
            sign = if *position < before { -1.0 } else { sign };
            before = *position;
            all.push(of(sign, 10.0 + 10.0 * position));
        }
        all.into()
    };
    output.is(&at("values[]"), each(&|_, w| json!(w)));
    let ends = |position: &f64| position.rem_euclid(1.0).abs() <= 0.0;
    output.is(&at("proved"), positions.iter().map(ends).collect::<Vec<_>>());
    let down = 0.1 * H;
    output.is(&at("pull_n[]"), each(&|s, w| json!([s * w * down, -w])));
    let [low, high] = [std::f64::consts::FRAC_PI_6, 5.0 * std::f64::consts::FRAC_PI_6];
    let angles = |s: f64, _: f64| if s > 0.0 { json!([low, high]) } else { json!([high, low]) };
    output.is(&at("angles_rad[]"), each(&angles));
    output.is(&at("energy_j"), each(&|s, w| json!(-s * w * DEPTH)));
    output.is(&at("axial_n[]"), each(&|s, w| json!(vec![s * w * 0.1 * AXIAL; 2])));
    output.is(&at("index_in_space"), each(&|s, _| json!(i32::from(s < 0.0))));
    columns_of_branches(columns);
}

fn columns_of_branches(mut output: Output) {
    let branches = output.numbers("branch");
    let positions = output.numbers("position");
    let each = |of: &dyn Fn(f64, f64) -> Value| -> Value {
        let rows = branches.iter().zip(&positions);
        rows.map(|(branch, at)| of(3.0 - 2.0 * branch, 10.0 + 10.0 * at)).collect()
    };
    output.is("gravity_m_s2", each(&|_, w| json!(w)));
    let ends: Vec<bool> = positions.iter().map(|at| at.rem_euclid(1.0).abs() <= 0.0).collect();
    output.is("proved", ends.clone());
    let grid: Vec<Value> = positions
        .iter()
        .zip(&ends)
        .map(|(at, end)| if *end { json!(at + 1.0) } else { json!("") })
        .collect();
    output.is("grid", grid);
    output.is("pull_horizontal_n", each(&|s, w| json!(s * w * 0.1 * H)));
    output.is("pull_vertical_n", each(&|_, w| json!(-w)));
    output.is("energy_j", each(&|s, w| json!(-s * w * DEPTH)));
    output.is("index_in_space", each(&|s, _| json!(i32::from(s < 0.0))));
    let [low, high] = [std::f64::consts::FRAC_PI_6, 5.0 * std::f64::consts::FRAC_PI_6];
    let angles = |s: f64, _: f64| if s > 0.0 { json!([low, high]) } else { json!([high, low]) };
    output.is("angle_#_rad", each(&angles));
    output.is("axial_#_n", each(&|s, w| json!(vec![s * w * 0.1 * AXIAL; 2])));
}

/// Three bars between level anchors: pairs meet and end at a span of √(3/2) m, as reflected images
/// of each other; beyond two equilibria are left. And 4 m are too far.
#[test]
fn folds_of_the_level_chain() {
    let [mut output] = table::outputs("folds_of_the_level_chain");
    let at = |key: &str| format!("traces[].events[].{key}");
    let span = 1.5_f64.sqrt();
    let spans = [span, span, span, span, 3.0];
    // 1.1, 1.3 and 4 m stand at 0, 1/2 and 1.
    let fold = (span - 1.1) / 0.4;
    let positions = [fold, fold, fold, fold, 0.5 + 1.7 / 5.4];
    // As far from the closed form as is admitted, at most; `1e-15` are digits of the parameter.
    let found = output.numbers(&at("position"));
    let errors = output.numbers(&at("position_error"));
    for ((found, wanted), error) in found.iter().zip(positions).zip(&errors) {
        assert!((found - wanted).abs() <= error + 1e-15 && *error < 1e-9, "{found} {error}");
    }
    let found = output.numbers(&at("values[]"));
    let errors = output.numbers(&at("values_error[]"));
    let wanted = spans.iter().flat_map(|span| [0.0, *span]);
    for ((found, wanted), error) in found.iter().zip(wanted).zip(&errors) {
        assert!((found - wanted).abs() <= error + 1e-15 && *error < 1e-9, "{found} {error}");
    }
    // Each closes the chain, and its energy is that of its angles: centres of three bars.
    let angles = output.numbers(&at("angles_rad[]"));
    let energies = output.numbers(&at("energy_j"));
    assert_eq!((angles.len(), energies.len()), (15, 5));
    for ((angles, energy), span) in angles.chunks(3).zip(&energies).zip(spans) {
        let x: f64 = angles.iter().map(|angle| angle.sin()).sum();
        let z: f64 = angles.iter().map(|angle| -angle.cos()).sum();
        assert!((x - span).abs() < 1e-9 && z.abs() < 1e-9, "{angles:?}");
        let [a, b, c] = [angles[0].cos(), angles[1].cos(), angles[2].cos()];
        let wanted = -9.806_65 * (2.5 * a + 1.5 * b + 0.5 * c);
        assert!((energy - wanted).abs() < 1e-9, "{energy} {wanted}");
    }
    // Each branch that ends in an event is named by it, two by two.
    let named = output.numbers(&at("branches[]"));
    let ends = output.numbers("traces[].branches[].end.event");
    assert_eq!((named.len(), ends.len()), (10, 10));
    // Its last point says so, too.
    assert_eq!(output.numbers("traces[].branches[].points[].event"), ends);
    for (k, pair) in named.chunks(2).enumerate() {
        let count = ends.iter().filter(|event| (*event - (k + 1) as f64).abs() < 0.5).count();
        assert!(count == 2 && pair[0] < pair[1], "{named:?} {ends:?}");
    }
    // The two that are left end where the chain is straight.
    assert!((named[8] - 1.0).abs() < 0.5 && (named[9] - 10.0).abs() < 0.5, "{named:?}");
}
