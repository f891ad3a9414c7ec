//! The step: the one place where the singular matrix is solved, by a *damped spin-free step*.
//!
//! The matrix of the reduced system (see the module `point`) is symmetric,
//!
//! $$ J = \begin{bmatrix} H & G^T \\\\ G & 0 \end{bmatrix}, \qquad
//!    H = \mathrm{diag}\\,(l_i\\,F_i \cdot \partial^2 u_i), \qquad
//!    G = [\\,l_i\\,\partial u_i\\,], $$
//!
//! and singular at every solution. Two treatments make the step well defined.
//!
//! *No spin.* The step is taken in the two directions of each bar's angles across its
//! [spin](crate::spin()). That removes n null directions by geometry, exactly, and no threshold
//! decides what is singular. (Zeng's rank-r Newton step finds the same directions by a
//! decomposition.)
//!
//! *Damping.* Whatever else is singular, such as the turn about vertical anchors or a degenerate
//! equilibrium, is met by the step of Levenberg and Marquardt, $d = -(J^2 + s^2)^{-1} J r$. Since J
//! is symmetric,
//!
//! $$ d = -\mathrm{Re}\left[(J + \mathrm{i}\\,s)^{-1}\right] r, $$
//!
//! one complex solve with the same blocks, $2\times2$ for each bar and $3\times3$ for the pull:
//! O(n), and no product $J^2$ that would square the condition. With s of the order of the residual
//! the step tends to the minimum-norm Newton step, and the convergence is quadratic also to
//! solutions that are not isolated.
//!
//! N. Yamashita, M. Fukushima, Computing Suppl. 15 (2001) 239-249,
//! doi:10.1007/978-3-7091-6217-0_18; J. Fan, Y. Yuan, Computing 74 (2005) 23-39,
//! doi:10.1007/s00607-004-0083-1; Z. Zeng, arXiv:2101.09180

use nalgebra::{Complex, Matrix3, Vector3};

use crate::full::mechanism::Mechanism;
use crate::full::point::{Metric, Point};
use crate::full::spin::across;

/// Steps of the power method for the smallest singular value; a few digits are enough.
const POWERS: usize = 50;

/// The part of a bar in the matrix, in the variables $\sqrt{l_i}\\,\times$ (angles across the
/// spin).
#[derive(Debug, Clone, Copy)]
struct Block {
    /// Square root of the length.
    root: f64,
    /// The two directions across the spin, in angle space.
    across: [Vector3<f64>; 2],
    /// Columns of G.
    columns: [Vector3<f64>; 2],
    /// H: entries 11, 12, 22.
    curvature: [f64; 3],
    /// Residual of the moment rows.
    moment: [f64; 2],
    /// Inverse of H + shift: entries 11, 12, 22.
    inverse: [Complex<f64>; 3],
    step: [f64; 2],
}

/// The matrix of the reduced system at a point, and a step.
#[derive(Debug, Clone)]
pub(crate) struct Matrix {
    blocks: Vec<Block>,
    closure: Vector3<f64>,
    metric: Metric,
    /// The step of the pull.
    pub pull_step: Vector3<f64>,
    /// The same, in the metric.
    scaled_pull_step: Vector3<f64>,
}

impl Matrix {
    pub fn new(mechanism: &Mechanism) -> Self {
        let block = |length: &f64| Block {
            root: length.sqrt(),
            across: [Vector3::zeros(); 2],
            columns: [Vector3::zeros(); 2],
            curvature: [0.0; 3],
            moment: [0.0; 2],
            inverse: [Complex::new(0.0, 0.0); 3],
            step: [0.0; 2],
        };
        Self {
            blocks: mechanism.lengths.iter().map(block).collect(),
            closure: Vector3::zeros(),
            metric: Metric::plain(),
            pull_step: Vector3::zeros(),
            scaled_pull_step: Vector3::zeros(),
        }
    }

    /// Assemble J and r at a point.
    pub fn assemble(&mut self, point: &Point, metric: &Metric) {
        self.metric = *metric;
        self.closure = metric.gap * point.closure;
        for (block, bar) in self.blocks.iter_mut().zip(&point.bars) {
            let [a, b] = across(&bar.frame.spin());
            let force = bar.force / metric.force;
            let curvature = bar.frame.hessian(&bar.u, &bar.gradient, &force);
            let (h_a, h_b) = (curvature * a, curvature * b);
            block.across = [a, b];
            block.curvature = [a.dot(&h_a), a.dot(&h_b), b.dot(&h_b)];
            let gradient = metric.gap * bar.gradient;
            block.columns = [gradient * a * block.root, gradient * b * block.root];
            let scale = block.root / metric.force;
            block.moment = [a.dot(&bar.moment) * scale, b.dot(&bar.moment) * scale];
        }
    }

    /// Assemble in the plain metric with the curvature of the stretched bars alone, which is never
    /// positive: for a motion along which the energy only falls.
    pub fn assemble_stretched(&mut self, point: &Point) {
        self.assemble(point, &Metric::plain());
        for (block, bar) in self.blocks.iter_mut().zip(&point.bars) {
            let stretch = bar.force.dot(&bar.u).max(0.0) / (block.root * block.root);
            let [a, b] = block.columns;
            block.curvature = [-stretch * a.dot(&a), -stretch * a.dot(&b), -stretch * b.dot(&b)];
        }
    }

    /// Solve $(J + \mathrm{diag}(s_1, s_2))\\,d = -r$ for the real part of d, with the shift $s_1$
    /// on the moment rows and $s_2$ on the closure.
    pub fn solve_shifted(&mut self, moments: Complex<f64>, closure: Complex<f64>) {
        let mut schur = Matrix3::from_diagonal_element(closure);
        let mut right = self.closure.map(|h| Complex::new(-h, 0.0));
        for block in &mut self.blocks {
            let [h11, h12, h22] = block.curvature;
            let (d11, d22) = (moments + h11, moments + h22);
            let scale = (d11 * d22 - h12 * h12).inv();
            let [k11, k12, k22] = [d22 * scale, -scale * h12, d11 * scale];
            block.inverse = [k11, k12, k22];
            let [a, b] = block.columns;
            let [g, h] = block.moment;
            for row in 0..3 {
                let (w_a, w_b) = (k11 * a[row] + k12 * b[row], k12 * a[row] + k22 * b[row]);
                right[row] += w_a * g + w_b * h;
                for column in 0..3 {
                    schur[(row, column)] -= w_a * a[column] + w_b * b[column];
                }
            }
        }
        let pull = solve_three(schur, right);
        self.scaled_pull_step = pull.map(|p| p.re);
        self.pull_step = self.metric.gap * self.scaled_pull_step * self.metric.force;
        for block in &mut self.blocks {
            let [k11, k12, k22] = block.inverse;
            let along = |column: &Vector3<f64>| {
                pull[0] * column[0] + pull[1] * column[1] + pull[2] * column[2]
            };
            let g = along(&block.columns[0]) + block.moment[0];
            let h = along(&block.columns[1]) + block.moment[1];
            block.step = [-(k11 * g + k12 * h).re, -(k12 * g + k22 * h).re];
        }
    }

    /// Norm of the linearised residual $r + J d$ after the step.
    pub fn predicted_norm(&self) -> f64 {
        let mut closure = self.closure;
        let mut moments = 0.0;
        for block in &self.blocks {
            let [h11, h12, h22] = block.curvature;
            let [y, z] = block.step;
            let [a, b] = block.columns;
            closure += a * y + b * z;
            let g = block.moment[0] + h11 * y + h12 * z + a.dot(&self.scaled_pull_step);
            let h = block.moment[1] + h12 * y + h22 * z + b.dot(&self.scaled_pull_step);
            moments += g * g + h * h;
        }
        (moments + closure.norm_squared()).sqrt()
    }

    /// Largest singular value of J across the spins, divided by the smallest that is not zero: an
    /// estimate in O(n). The first is bounded by the norms of the blocks, the second found by the
    /// power method on the damped inverse. Leaves no step behind.
    pub fn condition(&mut self, damping: f64) -> f64 {
        let mut closure = 0.0;
        let mut largest: f64 = 0.0;
        for (index, block) in self.blocks.iter_mut().enumerate() {
            let [h11, h12, h22] = block.curvature;
            largest = largest.max((h11 * h11 + 2.0 * h12 * h12 + h22 * h22).sqrt());
            closure += block.columns.iter().map(Vector3::norm_squared).sum::<f64>();
            // A start with something of everything.
            block.step = [1.0, (index as f64).cos()];
        }
        self.scaled_pull_step = Vector3::new(1.0, -1.0, 1.0);
        let mut growth = 1.0;
        for _ in 0..POWERS {
            let steps = self.blocks.iter().map(|block| block.step[0].hypot(block.step[1]));
            let norm = steps.fold(self.scaled_pull_step.norm(), f64::hypot);
            for block in &mut self.blocks {
                block.moment = block.step.map(|part| part / norm);
            }
            self.closure = self.scaled_pull_step / norm;
            self.solve_shifted(Complex::new(0.0, damping), Complex::new(0.0, damping));
            growth = norm;
        }
        growth * (largest + closure.sqrt())
    }

    /// Step of the angles of each bar, rad.
    pub fn turns(&self) -> impl Iterator<Item = Vector3<f64>> {
        self.blocks.iter().map(|block| {
            (block.across[0] * block.step[0] + block.across[1] * block.step[1]) / block.root
        })
    }

    /// Step of the vector $l_i u_i$ of each bar, to first order; in the plain metric.
    pub fn moves(&self) -> impl Iterator<Item = Vector3<f64>> {
        self.blocks
            .iter()
            .map(|block| block.columns[0] * block.step[0] + block.columns[1] * block.step[1])
    }
}

/// Solve a complex system of three by elimination with partial pivoting.
fn solve_three(
    mut matrix: Matrix3<Complex<f64>>,
    mut right: Vector3<Complex<f64>>,
) -> Vector3<Complex<f64>> {
    for pivot in 0..3 {
        let size = |row: usize| matrix[(row, pivot)].norm_sqr();
        let best =
            (pivot..3).fold(pivot, |best, row| if size(row) > size(best) { row } else { best });
        matrix.swap_rows(pivot, best);
        right.swap_rows(pivot, best);
        let inverse = matrix[(pivot, pivot)].inv();
        for row in pivot + 1..3 {
            let factor = matrix[(row, pivot)] * inverse;
            for column in pivot + 1..3 {
                let above = matrix[(pivot, column)];
                matrix[(row, column)] -= factor * above;
            }
            let above = right[pivot];
            right[row] -= factor * above;
        }
    }
    for row in (0..3).rev() {
        for column in row + 1..3 {
            let known = right[column];
            right[row] -= matrix[(row, column)] * known;
        }
        right[row] *= matrix[(row, row)].inv();
    }
    right
}

#[cfg(test)]
mod tests {
    use model::cases;
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::full::constraints::coordinates;
    use crate::full::mechanism::Units;
    use crate::full::multipliers::all_multipliers;
    use crate::full::system::{jacobian_of, residual_of};

    /// Rounding of a few hundred operations, amplified by the condition of the matrix at a random
    /// state (a hundred). Worst measured: 2e-14.
    const ROUNDING: f64 = 1e-12;

    /// The example at some state without any symmetry, in its own units.
    fn state(index: i32) -> (Mechanism, Point, Matrix) {
        let mut mechanism =
            Mechanism::scaled(cases::paper().chain(), Units::total(cases::paper().chain()));
        // Three different bars.
        mechanism.lengths = vec![0.2, 0.5, 0.3];
        mechanism.centres = vec![0.15, 0.2, 0.1];
        mechanism.weights = vec![0.3, 0.1, 0.6];
        let mut point = Point::new(3);
        for (bar, angles) in point.angles.iter_mut().enumerate() {
            let bar = f64::from(u8::try_from(bar).unwrap());
            *angles = [1.0, 2.0, 3.0].map(|k| (k + 1.7 * bar + 0.9 * f64::from(index)).sin() * 1.2);
        }
        point.pull = Vector3::new(0.3, -0.2, -0.7) * f64::from(index + 1);
        point.turn(&mechanism);
        point.load(&mechanism.carried_weights());
        let mut matrix = Matrix::new(&mechanism);
        matrix.assemble(&point, &Metric::plain());
        (mechanism, point, matrix)
    }

    fn written_out(matrix: &Matrix) -> (DMatrix<f64>, DVector<f64>) {
        let angles = 2 * matrix.blocks.len();
        let mut jacobian = DMatrix::zeros(angles + 3, angles + 3);
        let mut residual = DVector::zeros(angles + 3);
        for (index, block) in matrix.blocks.iter().enumerate() {
            let [h11, h12, h22] = block.curvature;
            let at = 2 * index;
            jacobian[(at, at)] = h11;
            jacobian[(at, at + 1)] = h12;
            jacobian[(at + 1, at)] = h12;
            jacobian[(at + 1, at + 1)] = h22;
            for (column, entries) in block.columns.iter().enumerate() {
                jacobian.fixed_view_mut::<3, 1>(angles, at + column).copy_from(entries);
                jacobian
                    .fixed_view_mut::<1, 3>(at + column, angles)
                    .copy_from(&entries.transpose());
                residual[at + column] = block.moment[column];
            }
        }
        residual.fixed_rows_mut::<3>(angles).copy_from(&matrix.closure);
        (jacobian, residual)
    }

    /// $-\sum_i v_i\\,\frac{\lambda_i}{\lambda_i^2 + s^2}\\,(v_i \cdot r)$, J being symmetric.
    fn damped_step(jacobian: &DMatrix<f64>, residual: &DVector<f64>, s: f64) -> DVector<f64> {
        let eigen = jacobian.clone().symmetric_eigen();
        let parts = eigen.eigenvectors.tr_mul(residual);
        let parts = parts.zip_map(&eigen.eigenvalues, |part, l| -part * l / (l * l + s * s));
        eigen.eigenvectors * parts
    }

    #[test]
    fn complex_solve_is_the_step_of_levenberg_and_marquardt() {
        for index in 0..20 {
            let (_, _, mut matrix) = state(index);
            for damping in [1e-6, 1e-2, 1.0, 100.0] {
                let shift = Complex::new(0.0, damping);
                matrix.solve_shifted(shift, shift);
                let (jacobian, residual) = written_out(&matrix);
                let expected = damped_step(&jacobian, &residual, damping);
                let got = matrix.blocks.iter().flat_map(|block| block.step);
                let got = DVector::from_iterator(9, got.chain(matrix.pull_step.iter().copied()));
                let size = expected.norm().max(1.0);
                assert!((&got - &expected).norm() < ROUNDING * size, "{damping}: {got} {expected}");
                let predicted = (residual + jacobian * got).norm();
                assert!((matrix.predicted_norm() - predicted).abs() < ROUNDING * size);
            }
        }
    }

    /// Without damping the step, completed by the centres and the other multipliers, satisfies the
    /// linear system of the paper's 30 equations but for their part along the spins, which is of
    /// second order: the matrix has no say there, to first order.
    #[test]
    fn undamped_step_solves_the_full_linear_system() {
        for index in 0..20 {
            let (mechanism, point, mut matrix) = state(index);
            let tiny = Complex::new(0.0, 1e-12);
            matrix.solve_shifted(tiny, tiny);
            let q = coordinates(&mechanism, &point.angles);
            let lambda = all_multipliers(&mechanism, &point.pull);
            // The step of the centres follows along the chain; that of every multiplier from the
            // pull.
            let mut step = DVector::zeros(30);
            let mut joint = Vector3::zeros();
            for (bar, (turn, moved)) in matrix.turns().zip(matrix.moves()).enumerate() {
                let part = mechanism.centres[bar] / mechanism.lengths[bar];
                step.fixed_rows_mut::<3>(6 * bar).copy_from(&(joint + moved * part));
                step.fixed_rows_mut::<3>(6 * bar + 3).copy_from(&turn);
                joint += moved;
            }
            for joint in 0..4 {
                let sign = if joint == 0 { -1.0 } else { 1.0 };
                step.fixed_rows_mut::<3>(18 + 3 * joint).copy_from(&(matrix.pull_step * sign));
            }
            let mut left =
                residual_of(&mechanism, &q, &lambda) + jacobian_of(&mechanism, &q, &lambda) * &step;
            for (bar, at) in point.bars.iter().enumerate() {
                let spin = at.frame.spin().normalize();
                let rows = left.fixed_rows::<3>(6 * bar + 3).into_owned();
                left.fixed_rows_mut::<3>(6 * bar + 3).copy_from(&(rows - spin * spin.dot(&rows)));
            }
            assert!(left.amax() < ROUNDING * step.amax().max(1.0), "{left}");
        }
    }

    /// The largest norm of a block of moments and that of the closure together, over the smallest singular value.
    #[test]
    fn condition_is_of_the_written_matrix() {
        for index in 0..20 {
            let (_, _, mut matrix) = state(index);
            let (jacobian, _) = written_out(&matrix);
            let block = |at: usize| jacobian.view((2 * at, 2 * at), (2, 2)).norm();
            let largest = (0..3).map(block).fold(0.0, f64::max);
            let bound = largest + jacobian.view((6, 0), (3, 6)).norm();
            let values = jacobian.singular_values();
            assert!(bound >= values[0]);
            let ratio = matrix.condition(1e-9) / (bound / values[8]);
            assert!((0.8..1.0 + 1e-9).contains(&ratio), "{index}: {ratio}");
        }
    }
}
