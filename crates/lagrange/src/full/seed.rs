//! Where a solve starts: the angles of the bars. The first multipliers are estimated from them.

use std::f64::consts::{FRAC_PI_2, PI};

use model::Problem;
use nalgebra::Vector3;

use crate::error::Error;
use crate::full::spin::regular_angles;
use crate::thresholds::{GOLDEN, HALVINGS, ZERO};

/// Angles ψ, θ, φ of each bar, rad.
///
/// ```
/// use lagrange::{Seed, Settings, solve_from};
/// let near_e2 = Seed::planar(&[1.3, -0.7, -0.3]);
/// let found = solve_from(&model::cases::paper(), &near_e2, &Settings::default())?;
/// assert_eq!(found.equilibrium.stability.index_in_space, 2);
/// # Ok::<(), lagrange::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Seed {
    angles: Vec<[f64; 3]>,
}

impl Seed {
    /// Any angles ψ, θ, φ, rad: the bars may point anywhere in space.
    ///
    /// ```
    /// let seed = lagrange::Seed::spatial(vec![[0.1, 1.2, -0.3]; 3]);
    /// assert_eq!(seed.angles()[2], [0.1, 1.2, -0.3]);
    /// ```
    pub fn spatial(angles: Vec<[f64; 3]>) -> Self {
        Self { angles }
    }

    /// The paper's choice: ψ = 0, θ = π/2, in the plane *OYZ*, with φ measured from the descending
    /// vertical towards +Y, rad.
    ///
    /// ```
    /// let seed = lagrange::Seed::planar(&[0.3, 0.7, -1.3]);
    /// assert_eq!(seed.angles()[1], [0.0, std::f64::consts::FRAC_PI_2, 0.7]);
    /// ```
    pub fn planar(phi: &[f64]) -> Self {
        Self { angles: phi.iter().map(|phi| [0.0, FRAC_PI_2, *phi]).collect() }
    }

    /// In the vertical plane turned by `heading` from *OXZ* about +Z, with `phi` measured from the
    /// descending vertical towards the heading, rad.
    ///
    /// At heading π/2 the directions are those of [`Seed::planar`]; the angles are not, since those
    /// of every bar are chosen away from gimbal lock.
    ///
    /// ```
    /// // A level bar towards +X.
    /// let seed = lagrange::Seed::planar_towards(0.0, &[std::f64::consts::FRAC_PI_2]);
    /// let [psi, theta, phi] = seed.angles()[0];
    /// assert!((lagrange::direction(psi, theta, phi).x - 1.0).abs() < 1e-15);
    /// ```
    pub fn planar_towards(heading: f64, phi: &[f64]) -> Self {
        let (sin, cos) = heading.sin_cos();
        let directions = phi.iter().map(|phi| {
            let (out, down) = phi.sin_cos();
            Vector3::new(out * cos, out * sin, -down)
        });
        Self { angles: directions.map(|u| regular_angles(&u)).collect() }
    }

    /// Any directions of the bars, from first to last joint; their lengths do not matter.
    ///
    /// ```
    /// let seed = lagrange::Seed::directions(&[[0.0, 3.0, -4.0]]);
    /// let [psi, theta, phi] = seed.angles()[0];
    /// assert!((lagrange::direction(psi, theta, phi).z + 0.8).abs() < 1e-15);
    /// ```
    pub fn directions(directions: &[model::Vector]) -> Self {
        Self { angles: directions.iter().map(|u| regular_angles(&Vector3::from(*u))).collect() }
    }

    /// A circular arc that hangs from anchor to anchor with the length of the chain: a seed that
    /// needs no guess. With the anchors on one vertical it lies in the plane *OYZ*.
    ///
    /// ```
    /// let seed = lagrange::Seed::arc(&model::cases::paper());
    /// let ends = seed.angles().iter().map(|[a, b, c]| lagrange::direction(*a, *b, *c));
    /// // Three bars of 1 m from anchor to anchor, 2 m straight down, to a few percent.
    /// assert!((ends.sum::<nalgebra::Vector3<f64>>().z + 2.0).abs() < 0.1);
    /// ```
    pub fn arc(problem: &Problem) -> Self {
        let chain = problem.chain();
        let span = Vector3::from(chain.anchors().difference_m());
        let length = chain.total_length_m();
        let level = Vector3::new(span.x, span.y, 0.0);
        let level = level.try_normalize(0.0).unwrap_or_else(Vector3::y);
        let chord = span.try_normalize(0.0).unwrap_or(level);
        // Across the chord, in the vertical plane, upwards.
        let up = (Vector3::z() - chord * chord.z).try_normalize(ZERO).unwrap_or(level);
        let half = half_angle(span.norm() / length);
        let mut before = 0.0;
        let bars = chain.bars().iter().map(|bar| {
            let middle = (before + 0.5 * bar.length_m()) / length;
            before += bar.length_m();
            let (sin, cos) = (half * (2.0 * middle - 1.0)).sin_cos();
            regular_angles(&(chord * cos + up * sin))
        });
        Self { angles: bars.collect() }
    }

    /// The angles ψ, θ, φ of each bar, rad.
    ///
    /// ```
    /// assert_eq!(lagrange::Seed::planar(&[0.3, 0.7]).angles().len(), 2);
    /// ```
    pub fn angles(&self) -> &[[f64; 3]] {
        &self.angles
    }

    pub(crate) fn check(&self, bars: usize) -> Result<(), Error> {
        if self.angles.len() != bars {
            return Err(Error::SeedLength { of: "bars", expected: bars, got: self.angles.len() });
        }
        for (index, angles) in self.angles.iter().enumerate() {
            if angles.iter().any(|angle| !angle.is_finite()) {
                return Err(Error::SeedNotFinite { of: "bar", number: index + 1 });
            }
        }
        Ok(())
    }
}

/// Half the angle a of an arc whose chord is `ratio` times its length: sin a / a = ratio.
fn half_angle(ratio: f64) -> f64 {
    // sin a / a falls from 1 to 0 on [0, π]; a seed needs no more digits than these.
    let (mut low, mut high) = (0.0, PI);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle.sin() > ratio * middle { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// A perturbation for the given round: every angle of bar i turned by up to half a radian, in a
/// sequence that has no pattern and needs no random numbers (multiples of the golden ratio, modulo
/// 1).
pub(crate) fn perturb(angles: &mut [[f64; 3]], round: usize) {
    for (index, angle) in angles.iter_mut().flatten().enumerate() {
        *angle += ((index + 1) as f64 * round as f64 * GOLDEN).fract() - 0.5;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arc_closes_for_many_equal_bars() {
        let anchors = model::Anchors { start_m: [1.0, 2.0, 3.0], end_m: [2.0, 4.0, 2.0] };
        let bars = vec![model::Bar::homogeneous(0.05, 1.0).unwrap(); 100];
        let problem = Problem::new(model::Chain::new("arc", 9.81, anchors, bars).unwrap()).unwrap();
        let ends: Vector3<f64> = Seed::arc(&problem)
            .angles()
            .iter()
            .map(|[psi, theta, phi]| crate::full::rotation::direction(*psi, *theta, *phi) * 0.05)
            .sum();
        // The polygon differs from its arc by a part in n².
        assert!((ends - Vector3::new(1.0, 2.0, -1.0)).norm() < 1e-3, "{ends}");
    }

    #[test]
    fn planar_seeds_point_where_they_say() {
        let phi = [0.3, -2.0, 3.0];
        let paper = Seed::planar(&phi);
        let turned = Seed::planar_towards(FRAC_PI_2, &phi);
        for (a, b) in paper.angles().iter().zip(turned.angles()) {
            let (a, b) = (
                crate::full::rotation::direction(a[0], a[1], a[2]),
                crate::full::rotation::direction(b[0], b[1], b[2]),
            );
            assert!((a - b).norm() < 1e-15);
        }
    }
}
