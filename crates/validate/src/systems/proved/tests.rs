//! Rank and stability by hand.

use model::Proved;

use super::super::tests::{arch, four_legs, lamp, propped};
use super::proved;

/// Two bars at 3-4-5 in a plane leave the swing across it, which their pull resists; upside down the
/// energy falls along it. A part that turns freely is not held by anything. Four legs have a
/// self-stress, and no motion.
#[test]
fn what_holds_is_proved_and_nothing_else() {
    let (system, answer) = lamp();
    assert_eq!(proved(&system, &answer), Some(Proved::RankAndStability));
    let (system, answer) = arch();
    assert_eq!(proved(&system, &answer), Some(Proved::Rank));
    let (system, answer) = propped(1.0, 0.0);
    assert_eq!(proved(&system, &answer), Some(Proved::Rank));
    let (system, answer) = four_legs(0.5);
    assert_eq!(proved(&system, &answer), Some(Proved::Stability));
    let (system, mut answer) = lamp();
    answer.axial_n.truncate(1);
    assert_eq!(proved(&system, &answer), None);
}
