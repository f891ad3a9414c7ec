//! What can be seen of an equilibrium: energy, forces, indices.

use matrices::dense::eigenvalues;
use nalgebra::{DMatrix, DVector};

use crate::path::PlanarChain;

/// A chain whose bars agree in direction to this (sine) where its curve turns lies on one line.
/// Turns are located to the square root of rounding or better, but where curves cross, of the
/// largest residual.
pub(crate) const STRAIGHT: f64 = 1e-4;

/// Whether the chain lies on one line.
pub(crate) fn is_straight(y: &DVector<f64>) -> bool {
    y.iter().take(y.len() - 4).all(|angle| (angle - y[0]).sin().abs() <= STRAIGHT)
}

/// An equilibrium on a curve, in SI units, with its indices.
#[derive(Debug, Clone)]
pub(crate) struct Observables {
    pub(crate) pull_n: [f64; 2],
    pub(crate) energy_j: f64,
    /// Axial forces, tension positive.
    pub(crate) axial_n: Vec<f64>,
    /// The same without unit, and finite where they are not; sign and zeros count.
    pub(crate) along: Vec<f64>,
    pub(crate) index_in_plane: usize,
    pub(crate) index_out_of_plane: usize,
    /// Determinant of the second derivative in the plane, bordered by the closure; sign and zeros
    /// count.
    pub(crate) plane_test: f64,
    /// Determinant of the second derivative out of the plane; sign and zeros count.
    pub(crate) space_test: f64,
    /// Smallest over largest eigenvalue, in size, of the bordered second derivative.
    pub(crate) singular: f64,
    /// Largest |sine| between two bars: 0 if the chain lies on one line.
    pub(crate) bent: f64,
}

impl Observables {
    pub(crate) fn at(plane: &PlanarChain, y: &DVector<f64>) -> Self {
        let n = plane.length.len();
        // (H, V, w) and its negative are one pull.
        let side = if y[n + 2] < 0.0 { -1.0 } else { 1.0 };
        let [h, v, w] = [side * y[n], side * y[n + 1], side * y[n + 2]];
        let units: Vec<[f64; 2]> = (0..n)
            .map(|i| {
                let (sin, cos) = y[i].sin_cos();
                [sin, -cos]
            })
            .collect();
        // F_i · u_i, times w.
        let along: Vec<f64> =
            (0..n).map(|i| h * units[i][0] + (v + w * plane.weight[i]) * units[i][1]).collect();
        let moment_sum: f64 = (0..n).map(|i| plane.weight[i] * plane.length[i] * units[i][1]).sum();
        let newton = plane.force_unit_n;
        let joule = plane.length_unit_m;
        let energy_j =
            joule * ((plane.total_n - plane.offset_n) * plane.span[1] - newton * moment_sum);

        let (index_in_plane, plane_test, singular) = in_plane(plane, &units, &along);
        let (index_out_of_plane, space_test) = out_of_plane(plane, &along);
        let bent = units
            .iter()
            .map(|u| (u[0] * units[0][1] - u[1] * units[0][0]).abs())
            .fold(0.0, f64::max);
        Self {
            pull_n: [newton * h / w, newton * v / w - plane.offset_n],
            energy_j,
            axial_n: along.iter().map(|force| newton * force / w).collect(),
            along,
            index_in_plane,
            index_out_of_plane,
            plane_test,
            space_test,
            singular,
            bent,
        }
    }

    pub(crate) fn index_in_space(&self) -> usize {
        self.index_in_plane + self.index_out_of_plane
    }
}

/// Index, determinant and smallest eigenvalue of the second derivative of the Lagrangian
/// $-\sum l_i F_i \cdot u_i + p \cdot D$ by angles and pull. Each of the two equations of the
/// closure adds one negative eigenvalue to those of the second derivative along the closure.
fn in_plane(plane: &PlanarChain, units: &[[f64; 2]], along: &[f64]) -> (usize, f64, f64) {
    let n = units.len();
    let mut k = DMatrix::zeros(n + 2, n + 2);
    for i in 0..n {
        let length = plane.length[i];
        k[(i, i)] = length * along[i];
        for (row, slope) in [-units[i][1], units[i][0]].into_iter().enumerate() {
            k[(n + row, i)] = -length * slope;
            k[(i, n + row)] = -length * slope;
        }
    }
    let values = eigenvalues(&k).unwrap_or_else(|| vec![f64::NAN]);
    let (index, product) = index_and_product(&values);
    let sizes = || values.iter().map(|value| value.abs());
    let singular = sizes().fold(f64::INFINITY, f64::min) / sizes().fold(0.0, f64::max);
    (index.saturating_sub(2), product, singular)
}

/// Index and determinant of the weighted Laplacian of force densities over the joints between the
/// anchors. With the anchors on one vertical the turn about it is left out.
fn out_of_plane(plane: &PlanarChain, along: &[f64]) -> (usize, f64) {
    let n = along.len();
    if n < 2 {
        return (0, 1.0);
    }
    let density = |i: usize| along[i] / plane.length[i];
    let mut k = DMatrix::zeros(n - 1, n - 1);
    for joint in 0..n - 1 {
        k[(joint, joint)] = density(joint) + density(joint + 1);
        if joint > 0 {
            k[(joint, joint - 1)] = -density(joint);
            k[(joint - 1, joint)] = -density(joint);
        }
    }
    let mut values = eigenvalues(&k).unwrap_or_else(|| vec![f64::NAN]);
    if plane.span[0].abs() <= 0.0 {
        let size = |k: &usize| values[*k].abs();
        let least = (0..values.len()).min_by(|a, b| size(a).total_cmp(&size(b)));
        if let Some(least) = least {
            values.remove(least);
        }
    }
    index_and_product(&values)
}

fn index_and_product(values: &[f64]) -> (usize, f64) {
    (values.iter().filter(|value| **value < 0.0).count(), values.iter().product())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One joint between bars of 2 m and 5 m that bear 3 N and -4 N: its density is 3/2 - 4/5. Two joints
    /// have the determinant of [[a + b, -b], [-b, b + c]], ab + ac + bc.
    #[test]
    fn densities_are_forces_over_lengths() {
        let plane = |length: &[f64]| PlanarChain {
            length: length.to_vec(),
            weight: vec![0.0; length.len()],
            span: [1.0, 0.0],
            length_unit_m: 1.0,
            force_unit_n: 1.0,
            offset_n: 0.0,
            total_n: 1.0,
        };
        let (index, determinant) = out_of_plane(&plane(&[2.0, 5.0]), &[3.0, -4.0]);
        assert!(index == 0 && (determinant - 0.7).abs() < 1e-15, "{determinant}");
        let (index, determinant) = out_of_plane(&plane(&[2.0, 5.0, 0.5]), &[3.0, -4.0, 0.25]);
        let [a, b, c] = [1.5, -0.8, 0.5];
        assert!((determinant - (a * b + a * c + b * c)).abs() < 1e-14, "{determinant}");
        assert_eq!(index, 1);
    }
}
