//! How exactly a converged outcome is known, from the forces in its bars.
//!
//! A solver that ends with a residual `t`, in units of the largest force, leaves a bar with the
//! axial force `N` turned by `t / N`. Bars without force that lie straight between their ends have
//! an axial force that grows with the square of their angle `a` off that line, so that what is left
//! is `a³`, and they are known to the cube root of `t`.

use model::{Bar, Chain};

/// Residual of a converged outcome, in units of the largest force.
const RESIDUAL: f64 = 1e-13;

/// Bars whose spread of directions, a squared angle, is below this are parallel: their forces are
/// not told by their directions.
const PARALLEL: f64 = 1e-9;

/// What every bar carries of the weights from joint 0 on, those of the bars put to their ends by
/// the lever rule, in units of the total weight.
pub(crate) fn carried(chain: &Chain) -> Vec<f64> {
    let total_kg = chain.total_mass_kg();
    let mut before = 0.0;
    let carried = |bar: &Bar| {
        let here = before + bar.mass_kg() * (1.0 - bar.centre_m() / bar.length_m());
        before += bar.mass_kg();
        here / total_kg
    };
    chain.bars().iter().map(carried).collect()
}

/// How far the joints of a converged outcome may be from those of its equilibrium, in total
/// lengths, for the lengths of the bars in this unit, what they carry and their directions.
///
/// Bar `i` is parallel to `q + c_i e_z`, with what it carries, `c_i`, and one unknown force `q`:
/// least squares find it.
pub(crate) fn place_error(lengths: &[f64], carried: &[f64], u: &[[f64; 2]]) -> f64 {
    let (mut xx, mut xz, mut zz, mut right) = (0.0, 0.0, 0.0, [0.0; 2]);
    for ((l, c), [x, z]) in lengths.iter().zip(carried).zip(u) {
        xx += l * x * x;
        xz += l * x * z;
        zz += l * z * z;
        right[0] += l * c * x * z;
        right[1] -= l * c * x * x;
    }
    let determinant = xx * zz - xz * xz;
    // Also where a direction is undefined.
    if determinant.is_nan() || determinant <= PARALLEL {
        return 0.0;
    }
    let q = [
        (xx * right[0] + xz * right[1]) / determinant,
        (xz * right[0] + zz * right[1]) / determinant,
    ];
    let force = |c: &f64| [q[0], q[1] + c];
    let largest = carried.iter().map(force).map(|[x, z]| x.hypot(z)).fold(1.0, f64::max);
    let turns = lengths.iter().zip(carried).zip(u).map(|((l, c), [x, z])| {
        let [fx, fz] = force(c);
        let axial = (fx * x + fz * z).abs() / largest;
        l * (RESIDUAL / axial).min(RESIDUAL.cbrt())
    });
    turns.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bar of 1 m and 1 kg hangs from an anchor; two without mass, of 5 and 1 m, just bridge the
    /// rest: `angle` off their line, they are known to the cube root of the residual and no more.
    #[test]
    fn bars_without_force_are_known_to_a_cube_root() {
        let lengths = [1.0 / 7.0, 5.0 / 7.0, 1.0 / 7.0];
        let carried = [0.5, 1.0, 1.0];
        let hanging = |angle: f64, plumb: f64| {
            [
                [plumb.sin(), -plumb.cos()],
                [angle.cos(), angle.sin()],
                [(5.0 * angle).cos(), -(5.0 * angle).sin()],
            ]
        };
        let error = place_error(&lengths, &carried, &hanging(0.0, 0.0));
        assert!((error / (6.0 / 7.0 * 1e-13_f64.cbrt()) - 1.0).abs() < 1e-3, "{error:e}");
        // Half of the weight, and the pull of 1e-3 of that: known to 1e-13 over the force.
        let pulled = place_error(&lengths, &carried, &hanging(0.0, 1e-3));
        assert!((pulled / (6.0 / 7.0 * 1e-13 / 0.5e-3) - 1.0).abs() < 1e-2, "{pulled:e}");
        // Parallel bars tell nothing of their forces.
        let parallel = place_error(&lengths, &carried, &[[0.0, -1.0]; 3]);
        assert!(parallel.abs() <= 0.0);
    }
}
