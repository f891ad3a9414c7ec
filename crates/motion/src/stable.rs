//! The longest step that the elastic members allow.
//!
//! A step of RATTLE is stable for an oscillation of the angular frequency `ω` up to `2/ω`, and grows
//! it without end in longer ones (E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical
//! Integration*, 2nd ed., Springer 2006, section I.5.1).
//!
//! No position has an oscillation faster than this bound: a member of the stiffness `k = EA/l` along
//! the unit vector `u` resists displacements of its ends with `k u uᵀ`, which is at most `k`
//! whatever its direction; a rope resists the sum over `n` spans, which is at most `n k` in each of
//! them; constraints only slow oscillations (Rayleigh); and the matrix of inertia
//! is constant. What is left is one number for each joint, `K w = ω² M w`.

use model::Vector;

use crate::error::Result;
use crate::mechanism::Mechanism;
use crate::saddle::Saddle;
use numerics::vector::{add_times, dot, minus, times};

/// Longest step in units of `1/ω`: half of what is stable, where the energy of the oscillation is
/// kept to a quarter.
const LONGEST: f64 = 1.0;

/// Iterations of the power method: `ω` is then low by a few parts in a hundred at most (the relative
/// error of `ω²` falls as `ln n / 2k`; J. Kuczynski, H. Wozniakowski, SIAM J. Matrix Anal. Appl. 13
/// (1992) 1094-1122).
const ITERATIONS: usize = 40;

/// The longest step, s; infinite where no member is elastic.
/// [`MotionError::Massless`] where the inertia is singular.
pub(crate) fn longest_step_s(mechanism: &Mechanism) -> Result<f64> {
    if mechanism.springs.iter().all(|spring| spring.stiffness_n <= 0.0) {
        return Ok(f64::INFINITY);
    }
    let mut inertia = Saddle::inertia(mechanism)?;
    let moving = mechanism.moving;
    // Any beginning that no symmetry of a structure shares.
    let mut x: Vec<Vector> =
        (0..moving).map(|k| [1, 2, 3].map(|c| (1.0 + k as f64 * f64::from(c)).sin())).collect();
    let mut omega2 = 0.0;
    for _ in 0..ITERATIONS {
        let pulled = pulls(mechanism, &x);
        let mut next = pulled.clone();
        inertia.solve(&mut next, &mut []);
        // The quotient of Rayleigh of `M⁻¹ K` in the metric of `K`.
        let size: f64 = x.iter().zip(&pulled).map(|(x, y)| dot(*x, *y)).sum();
        if size.is_nan() || size <= 0.0 {
            break;
        }
        omega2 = next.iter().zip(&pulled).map(|(x, y)| dot(*x, *y)).sum::<f64>() / size;
        let largest = next.iter().map(|x| dot(*x, *x)).fold(0.0, f64::max).sqrt();
        x = next.into_iter().map(|x| times(1.0 / largest, x)).collect();
    }
    Ok(LONGEST / f64::sqrt(omega2))
}

/// `K x` by slot that moves.
fn pulls(mechanism: &Mechanism, x: &[Vector]) -> Vec<Vector> {
    let mut found = vec![[0.0; 3]; x.len()];
    let at = |slot: usize| x.get(slot).copied().unwrap_or_default();
    for spring in &mechanism.springs {
        let spans = mechanism.of(&spring.spans);
        let moving = spans.iter().filter(|span| span.a.min(span.b) < x.len()).count();
        let k = moving as f64 * spring.stiffness_n / spring.length_m;
        for span in spans {
            let pull = times(k, minus(at(span.b), at(span.a)));
            for (slot, sign) in [(span.a, -1.0), (span.b, 1.0)] {
                if let Some(found) = found.get_mut(slot) {
                    *found = add_times(*found, sign, pull);
                }
            }
        }
    }
    found
}
