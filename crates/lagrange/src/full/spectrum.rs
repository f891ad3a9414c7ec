//! Singular values of the Jacobian: how singular the system is at a solution.

use matrices::dense::singular_values;
use model::Chain;
use nalgebra::{DMatrix, DVector};

use crate::error::Error;
use crate::full::constraints::PER_BAR;
use crate::full::mechanism::{Mechanism, Units};
use crate::full::point::{Metric, Point};
use crate::full::stability::neutral_motions;
use crate::full::step::Matrix;
use crate::full::system::jacobian_of;
use crate::thresholds::ZERO_SINGULAR_VALUE;

/// Up to this number of bars the full Jacobian is decomposed, above the reduced one, which has the same
/// nullity and is smaller, ...
pub(crate) const LARGEST_FULL: usize = 30;
/// ... up to this (half a second); above it none is.
pub(crate) const LARGEST_DECOMPOSED: usize = 300;
/// Damping of the estimate: what is smaller stays hidden, above all the zero ones, which come out
/// at 1e-16 divided by its square.
const ESTIMATE_DAMPING: f64 = 1e-7;

/// Singular values of a Jacobian.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// All of them, the largest first.
    pub singular_values: Vec<f64>,
    /// How many are zero: the dimension of the null space.
    pub nullity: usize,
    /// The largest divided by the smallest that is not zero.
    pub condition: f64,
}

/// Singular values of the full [`jacobian`](crate::jacobian()) at `q`, `lambda` (SI), measured in
/// *l* and *mg* (mean length and weight of the bars) so that they are pure numbers.
///
/// At an equilibrium the nullity is n, one for the spin of each bar about its own axis, plus one
/// when the anchors are on one vertical, for the turn of the chain about it, plus the degeneracy of
/// the equilibrium itself, if any.
///
/// # Errors
///
/// [`Error::Spectrum`] when the decomposition does not converge.
///
/// # Panics
///
/// When `q` has not 6n entries or `lambda` not 3(n+1).
///
/// ```
/// use lagrange::{Seed, Settings, solve_from, spectrum};
/// let problem = model::cases::paper();
/// let seed = Seed::planar(&[0.3, 0.7, -1.3]);
/// let found = solve_from(&problem, &seed, &Settings::default())?;
/// let spectrum = spectrum(problem.chain(), &found.q, &found.lambda)?;
/// assert_eq!((spectrum.singular_values.len(), spectrum.nullity), (30, 4));
/// # Ok::<(), lagrange::Error>(())
/// ```
pub fn spectrum(chain: &Chain, q: &DVector<f64>, lambda: &DVector<f64>) -> Result<Spectrum, Error> {
    let units = Units::mean(chain);
    let scale = |(row, value): (usize, &f64)| {
        if row % PER_BAR < 3 { value / units.length } else { *value }
    };
    let q = DVector::from_iterator(q.len(), q.iter().enumerate().map(scale));
    Spectrum::of(&jacobian_of(&Mechanism::scaled(chain, units), &q, &(lambda / units.weight)))
}

impl Spectrum {
    fn of(jacobian: &DMatrix<f64>) -> Result<Self, Error> {
        let size = jacobian.nrows();
        let found = singular_values(jacobian);
        let singular_values = found.ok_or(Error::Spectrum { size })?;
        let largest = singular_values.first().copied().unwrap_or(0.0);
        let regular =
            singular_values.iter().filter(|value| **value > ZERO_SINGULAR_VALUE * largest).count();
        let smallest = if regular > 0 { singular_values[regular - 1] } else { largest };
        Ok(Self { nullity: size - regular, condition: largest / smallest, singular_values })
    }

    /// Singular values of the reduced Jacobian, in units of the total length and weight.
    pub(crate) fn reduced(mechanism: &Mechanism, point: &Point) -> Result<Self, Error> {
        let angles = 3 * mechanism.bars();
        let mut jacobian = DMatrix::zeros(angles + 3, angles + 3);
        for (index, (bar, length)) in point.bars.iter().zip(&mechanism.lengths).enumerate() {
            let at = 3 * index;
            let curvature = bar.frame.hessian(&bar.u, &bar.gradient, &bar.force);
            let columns = bar.gradient * length.sqrt();
            jacobian.fixed_view_mut::<3, 3>(at, at).copy_from(&curvature);
            jacobian.fixed_view_mut::<3, 3>(angles, at).copy_from(&columns);
            jacobian.fixed_view_mut::<3, 3>(at, angles).copy_from(&columns.transpose());
        }
        Self::of(&jacobian)
    }

    /// Nullity by geometry and condition by estimate, without any singular value: for chains so
    /// long that a decomposition is out of reach.
    pub(crate) fn estimated(mechanism: &Mechanism, point: &Point) -> Self {
        let mut matrix = Matrix::new(mechanism);
        matrix.assemble(point, &Metric::plain());
        Self {
            singular_values: Vec::new(),
            nullity: mechanism.bars() + neutral_motions(mechanism, point),
            condition: matrix.condition(ESTIMATE_DAMPING),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::full::reduced::Reduced;
    use crate::full::seed::Seed;
    use crate::full::solve::solve_from;
    use crate::settings::Settings;

    /// The estimate against the decomposition, at an equilibrium of each kind of anchors.
    #[test]
    fn estimate_is_that_of_the_decomposition() {
        for end_m in [[0.0, 0.0, -2.0], [1.0, 0.5, -1.0]] {
            let bars = vec![model::Bar::homogeneous(0.6, 1.0).unwrap(); 5];
            let anchors = model::Anchors { start_m: [0.0; 3], end_m };
            let chain = Chain::new("five", 9.81, anchors, bars).unwrap();
            let problem = model::Problem::new(chain).unwrap();
            let units = Units::total(problem.chain());
            let seed = Seed::planar(&[0.1, 0.4, -0.3, 0.9, -1.0]);
            let found = solve_from(&problem, &seed, &Settings::default()).unwrap();
            let mut reduced = Reduced::new(Mechanism::scaled(problem.chain(), units), 0.0);
            let pull = -found.lambda.fixed_rows::<3>(0) / units.weight;
            reduced.resume(found.angles_rad.iter().copied(), pull);
            let exact = Spectrum::reduced(&reduced.mechanism, &reduced.here).unwrap();
            let estimate = Spectrum::estimated(&reduced.mechanism, &reduced.here);
            assert_eq!(exact.nullity, estimate.nullity);
            assert_eq!(exact.nullity, found.nullity);
            // A bound on the largest and, from 50 steps, nearly the smallest singular value;
            // without the spins the latter may be a little larger.
            let ratio = estimate.condition / exact.condition;
            assert!((0.5..4.0).contains(&ratio), "{ratio}");
        }
    }
}
