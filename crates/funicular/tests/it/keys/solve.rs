//! `solve`: two bars between anchors on one level, a lamp on two light bars, the paper's chain.

use serde_json::json;

use super::table;

/// Two bars of 1 m and 10 N over a span of 1 m: each stands at 60 degrees.
pub const LEVEL_V: &str = r#"
name = "level V"
gravity_m_s2 = 10
anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }
bars = [{ length_m = 1, mass_kg = 1, count = 2 }]
"#;

/// A lamp of 20 N on light bars of 3 and 4 m over 5 m: they meet at a right angle.
pub const LAMP: &str = r#"
name = "lamp"
gravity_m_s2 = 10
joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [5, 0, 0] }, P = { mass_kg = 2 } }
bars = [{ from = "A", to = "P", length_m = 3, mass_kg = 0 },
  { from = "P", to = "B", length_m = 4, mass_kg = 0 }]
"#;

/// Half the height of an equilateral triangle of side 1 m, m.
pub const DEPTH: f64 = 0.866_025_403_784_438_6;
/// The moment of 10 N about an anchor is borne by H over the depth: H = 10 (1/4)/(√3/2), N.
pub const H: f64 = 2.886_751_345_948_129;
/// The mean force of a bar is (H, 5 N), along the bar: its size, N.
pub const AXIAL: f64 = 5.773_502_691_896_258;

/// Residuals in units of the largest force or length, and differences between two answers to
/// numbers of some metres and newtons: in exact arithmetic they are nothing.
pub const NOTHING: f64 = 1e-12;

/// The paper's chain in its own numbering, from 40 digits; it may turn about the line between its
/// anchors, and both answers are turned onto each other.
#[test]
fn the_paper_turned() {
    let [mut output] = table::outputs("the_paper_turned");
    let g = 9.806_65;
    // At the start the ground lifts the first bar; at the end of each the next one, or the ground.
    let up = [2.312_944_292_241_837_6, 1.312_944_292_241_837_6, 0.312_944_292_241_837_6];
    let up = [up[0], -up[1], -up[2], 0.687_055_707_758_162_4];
    let [start, end] =
        ["start", "end"].map(|end| format!("equilibria[].bars[].force_at_{end}_n[]"));
    for (path, wanted) in [(start, [up[0], -up[1], -up[2]]), (end, [up[1], up[2], up[3]])] {
        for (force, up) in output.numbers(&path).chunks(3).zip(wanted.iter().cycle()) {
            // |λ_2| mg level, in any direction about the vertical.
            assert!((force[0].hypot(force[1]) - 0.648_944_835_933_933_6 * g).abs() < NOTHING);
            assert!((force[2] - up * g).abs() < 1e-11, "{force:?} {up}");
        }
    }
}

/// Three bars of 1 m that hang down 2 m and come up 1 m: their forces are one of a family.
#[test]
fn straight_forces_are_a_family() {
    let [mut output] = table::outputs("straight_forces_are_a_family");
    for basis in output.numbers("equilibria[].evidence.self_stresses.basis[][]").chunks(3) {
        let third = basis[2].signum() / 3.0_f64.sqrt();
        for (found, wanted) in basis.iter().zip([-third, -third, third]) {
            assert!((found - wanted).abs() < NOTHING, "{basis:?}");
        }
    }
    // As the anchors come back the bars lean by H/F and shorten by l (H/F)²/2 each, together by
    // nothing: 1/F_1² + 1/F_2² = 1/F_3², here by bisection; between the pull R of the first anchor
    // and the bars' middles hang 1/2, 3/2 bars, and the third hangs on 30 N - R.
    let [mut low, mut high] = [16.0_f64, 24.0];
    for _ in 0..100 {
        let r = 0.5 * (low + high);
        let sum = (r - 5.0).powi(-2) + (r - 15.0).powi(-2) - (25.0 - r).powi(-2);
        *(if sum > 0.0 { &mut low } else { &mut high }) = r;
    }
    output.each("equilibria[].bars[].axial_n", json!([low - 5.0, low - 15.0, 25.0 - low]));
}

/// A weight of 1 N on three cables in a plane, √2, 1 and √2 m long, and a hanger: with the outer
/// forces t and the middle one 1 - √2 t there is a family.
#[test]
fn three_cables() {
    let side = std::f64::consts::SQRT_2;
    let [mut output] = table::outputs("three_cables");
    for basis in output.numbers("equilibria[].evidence.self_stresses.basis[][]").chunks(4) {
        // (1, -√2, 1, 0)/2 or its opposite.
        let sign = basis[0].signum();
        for (found, wanted) in basis.iter().zip([0.5, -side / 2.0, 0.5, 0.0]) {
            assert!((found - sign * wanted).abs() < NOTHING, "{basis:?}");
        }
    }
}
