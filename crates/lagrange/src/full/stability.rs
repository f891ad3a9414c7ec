//! Second-order behaviour of an equilibrium, from the signs of its axial forces and two small sums.
//!
//! Turn bar i by a small angle in any direction: its vector $l_i u_i$ moves across itself, and the
//! second derivative of the Lagrangian is $l_i T_i$ with the axial force $T_i = F_i \cdot u_i$,
//! whichever the direction. In its vertical plane (every equilibrium of a hanging chain has one,
//! see below) the motions split into those in the plane, $\sum l_i a_i t_i = 0$ with
//! $t_i \perp u_i$ in the plane, and those out of it, $\sum l_i b_i = 0$. On each, the quadratic
//! form $\sum l_i T_i a_i^2$ is diagonal under m linear conditions (m = 2 and 1), and Haynsworth's
//! inertia additivity for its bordered matrix gives the index:
//!
//! $$ \mathrm{index} = \\#\\{T_i < 0\\} + \\#\\{\text{positive eigenvalues of } S\\} - m, \qquad
//!    S_\text{in} = \sum \frac{l_i}{T_i} t_i t_i^T, \quad S_\text{out} = \sum \frac{l_i}{T_i}. $$
//!
//! Since $u_i = F_i/T_i$ and all $F_i$ have the horizontal part H of the pull,
//! $S_\text{out} = D_h / H$ with the horizontal span $D_h$: no sum, no cancellation. It is positive
//! when the pull on the first anchor points towards the other, and with vertical anchors it is
//! zero, the neutral turn about them.
//!
//! The plane: bar i is parallel to $F_i = p_0 + c_i e_z$, so all bars lie in the plane of $p_0$ and
//! $e_z$.
//!
//! E. V. Haynsworth, Linear Algebra Appl. 1 (1968) 73-81, doi:10.1016/0024-3795(68)90050-5

use model::{InPlane, Stability};
use nalgebra::Vector3;

use crate::full::mechanism::Mechanism;
use crate::full::point::Point;
use crate::thresholds::{GIVEN, ZERO};

/// Stability of the equilibrium at `point`, a root of the reduced system.
pub(crate) fn stability(mechanism: &Mechanism, point: &Point) -> Stability {
    let [span, pull] = [mechanism.end, point.pull].map(|v| Vector3::new(v.x, v.y, 0.0));
    let normal = plane_normal(mechanism, &span, &pull);
    let level = Vector3::new(-normal.y, normal.x, 0.0);
    let least = GIVEN * point.largest_force(&mechanism.carried_weights());

    let mut compressed = 0;
    // Of symmetric matrices of two rows the entries 11, 12 and 22.
    let (mut sum, mut size) = (Vector3::zeros(), 0.0);
    let (mut unloaded, mut unloaded_sum) = (0, Vector3::zeros());
    for (bar, length) in point.bars.iter().zip(&mechanism.lengths) {
        let across = normal.cross(&bar.u);
        let (x, z) = (across.dot(&level), across.z);
        let outer = Vector3::new(x * x, x * z, z * z);
        let mut force = bar.force.dot(&bar.u);
        if force.abs() <= least {
            // Counts as barely stretched: with barely compressed the index is the same, since one
            // more negative term meets one less positive eigenvalue.
            force = least;
            unloaded += 1;
            unloaded_sum += outer;
        }
        compressed += usize::from(force < 0.0);
        sum += outer * (length / force);
        size += (length / force).abs();
    }
    let count = |entries: &Vector3<f64>, above: f64| {
        let middle = f64::midpoint(entries.x, entries.z);
        let apart = (0.5 * (entries.x - entries.z)).hypot(entries.y);
        [middle - apart, middle + apart].iter().filter(|value| **value > above).count()
    };
    // Without compression S is a sum of squares with positive weights, and bars that close a slack
    // chain are not all parallel: no threshold is needed, however taut the chain.
    let (positive, zero) = if compressed == 0 {
        (2, 0)
    } else {
        let positive = count(&sum, ZERO * size);
        (positive, 2 - positive - count(&-sum, ZERO * size))
    };
    // Unloaded bars that can move with the others at rest do so at no cost.
    let degenerate = zero > 0 || unloaded > count(&unloaded_sum, ZERO);
    let index_in_plane = (compressed + positive).saturating_sub(2);

    let towards = !mechanism.on_one_vertical && span.dot(&pull) > 0.0;
    let index_out_of_plane = (compressed + usize::from(towards)).saturating_sub(1);

    let index_in_space = index_in_plane + index_out_of_plane;
    let motions = mechanism.bars().saturating_sub(2);
    Stability::of([index_in_plane, index_in_space], motions, degenerate)
}

/// Unit normal of the vertical plane, horizontal.
fn plane_normal(mechanism: &Mechanism, span: &Vector3<f64>, pull: &Vector3<f64>) -> Vector3<f64> {
    // The pull lies in the plane too, and serves when the anchors are on one vertical. With
    // neither, all bars are vertical, and any plane is as good as another: the paper's, OYZ.
    let level = if mechanism.on_one_vertical { pull } else { span };
    let level = level.try_normalize(f64::EPSILON).unwrap_or_else(Vector3::y);
    Vector3::new(level.y, -level.x, 0.0)
}

/// Dimension of the motions that cost nothing to second order, spins apart: the turn about vertical
/// anchors, and one in the plane when the equilibrium is degenerate there.
pub(crate) fn neutral_motions(mechanism: &Mechanism, point: &Point) -> usize {
    let degenerate = stability(mechanism, point).in_plane == InPlane::Degenerate;
    usize::from(mechanism.on_one_vertical) + usize::from(degenerate)
}
