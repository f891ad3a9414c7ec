//! The potential energy in the directions of the bars.

use model::Problem;

use crate::seed::Seed;
use crate::vector::Sum;

/// Potential energy of a chain with the given directions, measured from the height of joint 0, J.
///
/// The centre of bar *i* is at $\sum_{k<i} l_k u_k + r_i u_i$, so
///
/// $$V = g \sum_i m_i Z_{C_i} = \sum_i c_i\\, u_{i,z}, \qquad
///   c_i = g \Bigl(l_i \sum_{j>i} m_j + m_i r_i\Bigr).$$
///
/// The directions need not close on the end anchor; what the minimiser makes of them does.
///
/// # References
///
/// Equation (v) of the paper, for n bars in space; the paper adds `6 mgl`.
///
/// ```
/// let problem = model::cases::paper();
/// // All bars down: V = -(2.5 + 1.5 + 0.5) mgl.
/// let down = energy::Seed::angles(&problem, &[0.0; 3])?;
/// let mgl = model::STANDARD_GRAVITY_M_S2;
/// assert!((energy::potential_j(&problem, &down) / mgl + 4.5).abs() < 1e-15);
/// # Ok::<(), energy::Error>(())
/// ```
#[must_use]
pub fn potential_j(problem: &Problem, directions: &Seed) -> f64 {
    let chain = problem.chain();
    let (mut after_kg, mut sum) = (Sum::default(), Sum::default());
    for (bar, u) in chain.bars().iter().zip(directions.as_slice()).rev() {
        let moment_kg_m = bar.length_m() * after_kg.value() + bar.mass_kg() * bar.centre_m();
        sum.add(moment_kg_m * u[2]);
        after_kg.add(bar.mass_kg());
    }
    chain.gravity_m_s2() * sum.value()
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::{Anchors, Bar, Chain};

    /// By hand, with centres off the middle: each is measured from the joint before it.
    #[test]
    fn centres_count_from_the_first_joint_of_their_bar() {
        let bar = |length, mass, centre| Bar::new(length, mass, centre, [0.0; 3]).unwrap();
        let bars = vec![bar(2.0, 1.0, 0.5), bar(1.0, 3.0, 0.25), bar(1.5, 2.0, 1.25)];
        let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, -1.0] };
        let chain = Chain::new("off the middle", 10.0, anchors, bars).unwrap();
        let problem = Problem::new(chain).unwrap();
        // Straight down: centres 0.5, 2.25 and 4.25 m below the first joint.
        let down = Seed::angles(&problem, &[0.0; 3]).unwrap();
        assert!((potential_j(&problem, &down) + 10.0 * (0.5 + 6.75 + 8.5)).abs() < 1e-12);
        // Down, up, level: 0.5 below; 2 - 0.25 below; 1 below.
        let turn = std::f64::consts::PI;
        let bent = Seed::angles(&problem, &[0.0, turn, 0.5 * turn]).unwrap();
        assert!((potential_j(&problem, &bent) + 10.0 * (0.5 + 5.25 + 2.0)).abs() < 1e-12);
    }
}
