//! What a floor pushes along the motions that a support leaves.

use model::system::Support;

use super::super::statics::tests::crooked;
use super::*;

/// (1, 2, 3) N of the ground. A line along (3, 0, 4)/5 leaves (12, 0, 16)/25 of a push upwards, whose
/// square is 16/25: 48/25 + 12/25 over that. A plane across (0, 3, 4)/5 leaves (0, -12, 9)/25.
#[test]
fn a_push_is_known_along_the_motions_that_rise() {
    let at_m = [0.0; 3];
    let line = Support::Line { at_m, direction: [0.6, 0.0, 0.8] };
    let plane = Support::Plane { at_m, normal: [0.0, 0.6, 0.8] };
    for (support, left, push) in [
        (Support::Free, [0.0, 0.0, 1.0], 3.0),
        (line, [0.48, 0.0, 0.64], 3.75),
        (plane, [0.0, -0.48, 0.36], 1.0 / 3.0),
        (Support::Fixed { at_m }, [0.0; 3], 0.0),
        (Support::Plane { at_m, normal: [0.0, 0.0, 1.0] }, [0.0; 3], 0.0),
        (Support::Line { at_m, direction: [0.6, -0.8, 0.0] }, [0.0; 3], 0.0),
        // A slope of a billionth is level, one of three is none.
        (Support::Line { at_m, direction: [1.0, 0.0, 9e-10] }, [9e-10, 0.0, 0.0], 0.0),
        (Support::Line { at_m, direction: [1.0, 0.0, 3e-9] }, [3e-9, 0.0, 0.0], 1.0 / 3e-9),
    ] {
        let (system, mut answer) = crooked(|joints, _| joints[1].support = support);
        answer.reactions_n[1] = [1.0, 2.0, 3.0];
        let found = system.joints()[1].support.free_part(UP);
        for k in 0..3 {
            assert!((found[k] - left[k]).abs() < 1e-15, "{support:?}: {found:?}");
        }
        assert_eq!(push_n(&system, &answer, 1).to_bits(), 0);
        let floored = system.with_floor(-20.0).unwrap();
        let found = push_n(&floored, &answer, 1);
        assert!((found - push).abs() <= 1e-8 * push, "{support:?}: {found}");
    }
}
