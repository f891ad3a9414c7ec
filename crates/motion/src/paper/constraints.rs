//! The constraints (7)-(20) for n bars, their matrix (22), and the second derivative.

use model::Chain;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::rotation::{rates, rates_derivative, rotation};
use super::{Coordinates, angles};

/// The constraints of a chain: joint 0 at its anchor, both bars of each joint in one place, joint n
/// at its anchor.
#[derive(Debug, Clone)]
pub struct Constraints<'a> {
    chain: &'a Chain,
}

impl<'a> Constraints<'a> {
    /// Of a chain.
    #[must_use]
    pub fn new(chain: &'a Chain) -> Self {
        Self { chain }
    }

    /// Coordinates `x` along bar *i* of its two ends: `−r`, `l − r`.
    fn ends(&self, i: usize) -> [f64; 2] {
        let bar = &self.chain.bars()[i];
        [-bar.centre_m(), bar.length_m() - bar.centre_m()]
    }

    /// Rows and signs of the two ends of bar *i*: it begins the row of its near joint with `−1`
    /// (`+1` at the anchor, as (7) has it), and the row of its far joint with `+1`.
    fn places(&self, i: usize) -> [(usize, f64, f64); 2] {
        let [near, far] = self.ends(i);
        [(i, if i == 0 { 1.0 } else { -1.0 }, near), (i + 1, 1.0, far)]
    }

    /// `{f}` (7)-(20), m: three for each joint.
    #[must_use]
    pub fn values(&self, q: &[Coordinates]) -> DVector<f64> {
        let n = self.chain.bars().len();
        let mut values = DVector::zeros(3 * (n + 1));
        for (i, q) in q.iter().enumerate() {
            let axis = rotation(&angles(q)).column(0).into_owned();
            for (joint, sign, along) in self.places(i) {
                let end = Vector3::new(q[0], q[1], q[2]) + axis * along;
                for k in 0..3 {
                    values[3 * joint + k] += sign * end[k];
                }
            }
        }
        let anchors = self.chain.anchors();
        for k in 0..3 {
            values[k] -= anchors.start_m[k];
            values[3 * n + k] -= anchors.end_m[k];
        }
        values
    }

    /// `[B]` (22): derivatives of the constraints by the coordinates.
    #[must_use]
    pub fn matrix(&self, q: &[Coordinates]) -> DMatrix<f64> {
        let n = self.chain.bars().len();
        let mut matrix = DMatrix::zeros(3 * (n + 1), 6 * n);
        for (i, q) in q.iter().enumerate() {
            let by_angles = axis_derivative(&angles(q));
            for (joint, sign, along) in self.places(i) {
                let mut block = matrix.view_mut((3 * joint, 6 * i), (3, 6));
                block.view_mut((0, 0), (3, 3)).copy_from(&(Matrix3::identity() * sign));
                block.view_mut((0, 3), (3, 3)).copy_from(&(by_angles * (sign * along)));
            }
        }
        matrix
    }

    /// `−[Ḃ] {q̇}`, m/s²: minus the second derivative of the constraints by time where the
    /// coordinates have no acceleration.
    #[must_use]
    pub fn gamma(&self, q: &[Coordinates], velocities: &[Coordinates]) -> DVector<f64> {
        let n = self.chain.bars().len();
        let mut gamma = DVector::zeros(3 * (n + 1));
        for (i, (q, v)) in q.iter().zip(velocities).enumerate() {
            let (at, by) = (angles(q), angles(v));
            // The x axis of the bar turns with ω: its second derivative is ω̇ × x + ω × (ω × x),
            // all in the axes of the bar, with ω̇ = [Q̇] β̇.
            let omega = rates(&at) * by;
            let turned = rates_derivative(&at, &by) * by;
            let x = Vector3::x();
            let second = rotation(&at) * (turned.cross(&x) + omega.cross(&omega.cross(&x)));
            for (joint, sign, along) in self.places(i) {
                for k in 0..3 {
                    gamma[3 * joint + k] -= sign * along * second[k];
                }
            }
        }
        gamma
    }
}

/// Derivatives of the first column of `[A]` by the three angles: `∂(A x)/∂β = A (−[x]) Q`, since
/// `ẋ = A (ω × x)`.
fn axis_derivative(angles: &Vector3<f64>) -> Matrix3<f64> {
    -rotation(angles) * Vector3::x().cross_matrix() * rates(angles)
}
