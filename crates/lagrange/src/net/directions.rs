//! The directions in which a joint can move.
//!
//! Most joints move freely or not at all; their matrices are not stored, and not multiplied with.

use nalgebra::{Matrix3, Vector3};

/// The free directions of a joint, orthonormal.
#[derive(Debug, Clone)]
pub(super) enum Directions {
    /// The three axes.
    All,
    /// None.
    Held,
    /// As many columns of a matrix; the others are zero.
    Few(Box<(Matrix3<f64>, usize)>),
}

impl Directions {
    /// The first `count` columns of a matrix whose other columns are zero.
    pub fn new(axes: Matrix3<f64>, count: usize) -> Self {
        if count == 0 { Self::Held } else { Self::Few(Box::new((axes, count))) }
    }

    /// Their number.
    pub fn count(&self) -> usize {
        match self {
            Self::All => 3,
            Self::Held => 0,
            Self::Few(few) => few.1,
        }
    }

    /// The components of a vector along them; zero beyond their number.
    pub fn components(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::All => *vector,
            Self::Held => Vector3::zeros(),
            Self::Few(few) => few.0.tr_mul(vector),
        }
    }

    /// The part of a vector along them.
    pub fn part(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::All => *vector,
            Self::Held => Vector3::zeros(),
            Self::Few(few) => few.0 * few.0.tr_mul(vector),
        }
    }

    /// Those in a plane that two directions span, to which they are not oblique.
    pub fn within(&self, plane: [Vector3<f64>; 2]) -> Self {
        let (mut axes, mut count) = (Matrix3::zeros(), 0);
        for direction in plane {
            let part = self.part(&direction);
            let rest = part - axes * axes.tr_mul(&part);
            if rest.norm() > 0.5 {
                axes.set_column(count, &rest.normalize());
                count += 1;
            }
        }
        Self::new(axes, count)
    }

    /// The vector with these components; as many are read as there are directions.
    pub fn vector(&self, components: &[f64]) -> Vector3<f64> {
        if let (Self::All, &[x, y, z]) = (self, components) {
            return Vector3::new(x, y, z);
        }
        let axes = self.axes();
        components.iter().enumerate().map(|(k, s)| axes.column(k) * *s).sum()
    }

    /// As columns of a matrix, the others zero.
    pub fn axes(&self) -> Matrix3<f64> {
        match self {
            Self::All => Matrix3::identity(),
            Self::Held => Matrix3::zeros(),
            Self::Few(few) => few.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_components_are_those_of_the_matrix() {
        let v = Vector3::new(1.0, -2.0, 3.0);
        let along = Vector3::new(0.6, 0.0, 0.8);
        let line =
            Directions::new(Matrix3::from_columns(&[along, Vector3::zeros(), Vector3::zeros()]), 1);
        for directions in [Directions::All, Directions::Held, line] {
            let axes = directions.axes();
            let components = directions.components(&v);
            assert_eq!(components, axes.tr_mul(&v));
            assert_eq!(directions.part(&v), axes * components);
            let count = directions.count();
            assert_eq!(directions.vector(&components.as_slice()[..count]), axes * components);
        }
    }
}
