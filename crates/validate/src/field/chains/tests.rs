//! Two bars, by hand.

use super::*;

/// 2 kg in one beam of 1 m, mirrored over 1.2 m: the joint hangs 0.8 m deep, the middle of the beam
/// half of that, and under 10 m/s² the half of the chain has -8 J.
#[test]
fn half_of_two_bars_has_its_closed_form() {
    let catena = parsed("fraction = 0.6\ntotal_mass_kg = 2\ngravity_m_s2 = 10");
    let entry = one(&catena, &parsed("beams = 1\nenergy_j = '-8.5'"));
    assert_eq!(entry.title, "half of a chain of 2 bars");
    let [number] = &entry.numbers[..] else { panic!("{entry:?}") };
    assert!((number.ours + 8.0).abs() < 1e-13, "{}", number.ours);
    assert!(
        number.published.to_bits() == f64::to_bits(-8.5) && (number.allowed - 0.05).abs() < 1e-15
    );
    let Some(BothSolvers::Least { apart_j, below_j }) = entry.solvers else { panic!("{entry:?}") };
    assert!(apart_j < 1e-13 && (below_j - 0.5).abs() < 1e-13, "{apart_j} {below_j}");
}
