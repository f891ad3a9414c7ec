//! Singular values of the Jacobian: how singular the system is at a solution.

use model::Chain;
use nalgebra::{DMatrix, DVector};

use crate::SolveError;
use crate::constraints::PER_BAR;
use crate::mechanism::{Mechanism, Units};
use crate::point::Point;
use crate::system::jacobian_of;

/// Singular values below this part of the largest are zero. At a state converged to 1e-13 the zero
/// ones come out at 1e-16 to 1e-13 and the smallest of the others, up to a hundred bars, above 1e-7.
const ZERO: f64 = 1e-10;
/// Steps of the iteration behind a singular value decomposition, per row; a few are usual.
const SVD_STEPS: usize = 100;

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

/// Singular values of the full [`jacobian`](crate::jacobian()) at `q`, `lambda` (SI), measured in *l*
/// and *mg* (mean length and weight of the bars) so that they are pure numbers.
///
/// At an equilibrium the nullity is n, one for the spin of each bar about its own axis, plus one when
/// the anchors are on one vertical, for the turn of the chain about it, plus the degeneracy of the
/// equilibrium itself, if any.
///
/// # Errors
///
/// [`SolveError::Spectrum`] when the decomposition does not converge.
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
/// # Ok::<(), lagrange::SolveError>(())
/// ```
pub fn spectrum(
    chain: &Chain,
    q: &DVector<f64>,
    lambda: &DVector<f64>,
) -> Result<Spectrum, SolveError> {
    let units = Units::mean(chain);
    let scale = |(row, value): (usize, &f64)| {
        if row % PER_BAR < 3 { value / units.length } else { *value }
    };
    let q = DVector::from_iterator(q.len(), q.iter().enumerate().map(scale));
    Spectrum::of(jacobian_of(&Mechanism::scaled(chain, units), &q, &(lambda / units.weight)))
}

impl Spectrum {
    fn of(jacobian: DMatrix<f64>) -> Result<Self, SolveError> {
        let size = jacobian.nrows();
        let svd = jacobian.try_svd(false, false, f64::EPSILON, SVD_STEPS * size);
        let singular_values = svd.ok_or(SolveError::Spectrum { size })?.singular_values;
        let singular_values: Vec<f64> = singular_values.iter().copied().collect();
        let largest = singular_values.first().copied().unwrap_or(0.0);
        let regular = singular_values.iter().filter(|value| **value > ZERO * largest).count();
        let smallest = if regular > 0 { singular_values[regular - 1] } else { largest };
        Ok(Self { nullity: size - regular, condition: largest / smallest, singular_values })
    }

    /// Singular values of the reduced Jacobian, in units of the total length and weight.
    pub(crate) fn reduced(mechanism: &Mechanism, point: &Point) -> Result<Self, SolveError> {
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
        Self::of(jacobian)
    }
}
