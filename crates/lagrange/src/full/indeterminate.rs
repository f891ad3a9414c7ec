//! Two strands that hang straight down and just meet: the one equilibrium whose multipliers are not
//! determined.
//!
//! With the anchors on one vertical and lengths that fit, the chain of least energy is straight.
//! Its two strands then share the weight of the joint where they meet in any way that leaves no bar
//! pushed: the Jacobian of the full system has one null vector more, a change of all multipliers
//! along the vertical, and Newton's method ends at multipliers that depend on the seed. The shape
//! it ends at is straight to the root of a rounding only, because the closure along the vertical is
//! of second order there.

use model::Problem;
use nalgebra::Vector3;

use crate::condensed::Condensed;
use crate::full::mechanism::Units;
use crate::full::reduced::Reduced;
use crate::full::spin::regular_angles;
use crate::settings::Settings;
use crate::thresholds::UPRIGHT;

/// Where the strands of a converged chain just meet, straighten them and give them the forces that
/// they have when the anchors are a little apart, which are determined (see
/// [`condensed`](crate::condensed)). The equations must hold there as they did before, else nothing
/// is changed.
pub(crate) fn resolve(reduced: &mut Reduced, problem: &Problem, settings: &Settings) {
    let upright = |u: &Vector3<f64>| u.x.hypot(u.y) <= UPRIGHT;
    if !reduced.here.bars.iter().all(|bar| upright(&bar.u)) {
        return;
    }
    let Some(meeting) = Condensed::new(problem).indeterminate_pull() else { return };
    let before = (reduced.here.angles.clone(), reduced.here.pull);
    let straight: Vec<[f64; 3]> = reduced
        .here
        .bars
        .iter()
        .map(|bar| regular_angles(&(Vector3::z() * bar.u.z.signum())))
        .collect();
    let pull = -Vector3::from(meeting.ground_n()) / Units::total(problem.chain()).weight;
    reduced.resume(straight.into_iter(), pull);
    if reduced.largest() > settings.tolerance {
        reduced.resume(before.0.into_iter(), before.1);
    }
}

#[cfg(test)]
mod tests {
    use model::{Anchors, Bar, Chain, Problem};

    use crate::condensed;
    use crate::full::solve::solve;
    use crate::settings::Settings;

    fn problem(masses: &[f64], end_m: [f64; 3]) -> Problem {
        let bars = masses.iter().map(|mass| Bar::homogeneous(1.0, *mass).unwrap()).collect();
        let anchors = Anchors { start_m: [0.0; 3], end_m };
        Problem::new(Chain::new("strands", 9.81, anchors, bars).unwrap()).unwrap()
    }

    /// The strand of bar 1 and that of bars 2 and 3 share 3.5 kg at the lowest joint: by hand, from
    /// 1/(a)² = 1/(3.5 - a)² + 1/(6.5 - a)², a the mass that hangs on bar 1 (half of its own
    /// included).
    #[test]
    fn strands_share_as_they_do_a_little_apart() {
        let found = solve(&problem(&[2.0, 5.0, 1.0], [0.0, 0.0, 1.0]), &Settings::default());
        let found = found.unwrap().equilibrium;
        let a = found.axial_n[0] / 9.81;
        let balance = (a * a).recip() - (3.5 - a).powi(-2) - (6.5 - a).powi(-2);
        assert!(a > 0.0 && a < 3.5 && balance.abs() < 1e-12, "{a}: {balance:e}");
        assert!((found.axial_n[1] / 9.81 - (3.5 - a)).abs() < 1e-14);
        assert!(found.joints_m.iter().all(|joint| joint[0].hypot(joint[1]) < 1e-15));
    }

    #[test]
    fn the_full_system_and_the_condensed_one_give_the_same_forces() {
        let shapes: [(&[f64], f64); 5] = [
            (&[1.0, 1.0, 1.0, 1.0], 0.0),
            (&[2.0, 1.0, 5.0, 1.0], 2.0),
            (&[1.0, 5.0, 1.0, 2.0, 1.0], -1.0),
            (&[1.0; 12], 2.0),
            (&[3.0, 1.0, 2.0, 1.0, 1.0, 2.0, 5.0], -3.0),
        ];
        for (masses, rise) in shapes {
            let problem = problem(masses, [0.0, 0.0, rise]);
            let full = solve(&problem, &Settings::default()).unwrap().equilibrium;
            let short =
                condensed::solve(&problem, &condensed::Settings::default()).unwrap().equilibrium;
            assert!(full.evidence.residual <= 1e-13, "{masses:?}");
            assert_eq!(full.stability, short.stability, "{masses:?}");
            for (a, b) in full.multipliers_n.iter().zip(&short.multipliers_n) {
                let off = (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
                assert!(off < 1e-12, "{masses:?}: {a:?} {b:?}");
            }
        }
    }

    /// A little apart there is nothing to choose, and nothing is changed.
    #[test]
    fn strands_a_little_apart_are_left_alone() {
        let problem = problem(&[1.0, 5.0, 1.0, 2.0], [1e-3, 0.0, 0.0]);
        let found = solve(&problem, &Settings::default()).unwrap().equilibrium;
        assert!(found.joints_m[2][0] > 1e-4 && found.multipliers_n[0][0] < 0.0);
    }
}
