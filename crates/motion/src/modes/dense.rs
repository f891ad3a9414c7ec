//! The projected eigenproblem by dense linear algebra: all modes of a small system.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::planes::Sector;
use super::solved::{Solved, ZERO};
use super::stiffness::{Entry, Stiffness};
use crate::error::MotionError;

/// Rows of the constraints whose part independent of the others is less than this, relative, are
/// dependent.
const INDEPENDENT: f64 = 1e-10;

/// All modes whose displacements are along the axes of a sector.
///
/// # Errors
///
/// [`MotionError::Massless`] where the inertia is not positive definite.
pub(super) fn solve(stiffness: &Stiffness<'_>, sector: &Sector) -> Result<Solved, MotionError> {
    let entries = stiffness.entries(sector);
    let size = entries.size;
    let inertia = matrix(size, size, &entries.inertia);
    // M = L Lᵀ; in z = Lᵀ y the problem is ordinary: L⁻¹ K L⁻ᵀ z = ω² z with R L⁻ᵀ z = 0.
    let massless = || massless(stiffness, sector, &inertia);
    let lower = inertia.clone().cholesky().ok_or_else(massless)?.l();
    let solved = |m: &DMatrix<f64>| lower.solve_lower_triangular(m).ok_or_else(massless);
    let half = solved(&matrix(size, size, &entries.stiffness))?;
    let ordinary = solved(&half.transpose())?;
    let rows = matrix(stiffness.row_count(), size, &entries.rows);
    let free = null_space(&solved(&rows.transpose())?);
    if free.ncols() == 0 {
        return Ok(Solved::none(size));
    }
    let projected = free.transpose() * &ordinary * &free;
    let symmetric = 0.5 * (&projected + projected.transpose());
    let largest = symmetric.norm();
    let eigen = SymmetricEigen::new(symmetric.clone());
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let residual = |k: usize| {
        let z = eigen.eigenvectors.column(k);
        (&symmetric * z - z * eigen.eigenvalues[k]).norm() / z.norm()
    };
    let ordinary_shapes = &free * &eigen.eigenvectors;
    let shapes = lower.transpose().solve_upper_triangular(&ordinary_shapes).ok_or_else(massless)?;
    let columns: Vec<DVector<f64>> = order.iter().map(|&k| shapes.column(k).into_owned()).collect();
    let omega2: Vec<f64> = order.iter().map(|&k| eigen.eigenvalues[k]).collect();
    let rounding = size as f64 * f64::EPSILON * largest;
    let is_zero = |(omega2, y): (&f64, &DVector<f64>)| {
        omega2.abs() <= ZERO * stiffness.energy(sector, y.as_slice())[1] + rounding
    };
    let zero: Vec<bool> = omega2.iter().zip(&columns).map(is_zero).collect();
    Ok(Solved {
        residual: order.iter().map(|&k| residual(k)).collect(),
        total: omega2.len(),
        negative: omega2.iter().zip(&zero).filter(|(o, zero)| **o < 0.0 && !**zero).count(),
        zero,
        omega2,
        shapes: DMatrix::from_columns(&columns),
    })
}

/// The joint that moves no mass of its own: the first one whose inertia, with that of those before
/// it, is not positive definite.
fn massless(stiffness: &Stiffness<'_>, sector: &Sector, inertia: &DMatrix<f64>) -> MotionError {
    let definite =
        |size: &usize| inertia.view((0, 0), (*size, *size)).into_owned().cholesky().is_some();
    let sizes: Vec<usize> = (1..=inertia.nrows()).collect();
    let at = sizes.partition_point(definite).min(inertia.nrows() - 1);
    let joint = stiffness.mechanism.name(at / sector.axes.len());
    MotionError::Massless { joint, inertia_kg: 0.0 }
}

fn matrix(rows: usize, columns: usize, entries: &[Entry]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(rows, columns);
    for &(row, column, value) in entries {
        matrix[(row, column)] += value;
    }
    matrix
}

/// An orthonormal basis of what is orthogonal to the columns.
fn null_space(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let (size, given) = columns.shape();
    let mut turned = DMatrix::identity(size, size);
    if given == 0 {
        return turned;
    }
    let qr = columns.clone().col_piv_qr();
    let largest = columns.column_iter().map(|column| column.norm()).fold(0.0, f64::max);
    let r = qr.r();
    let is_independent = |k: &usize| r[(*k, *k)].abs() > INDEPENDENT * largest;
    let rank = (0..r.nrows()).take_while(is_independent).count();
    qr.q_tr_mul(&mut turned);
    turned.rows(rank, size - rank).transpose()
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, System};

    use super::super::planes::sectors;
    use super::*;
    use crate::mechanism::Mechanism;
    use crate::state::State;

    /// Half of 4 kg in the middle of a bar moves with either end: about that middle the ends turn
    /// without moving any mass, and no mode is left out for that.
    #[test]
    fn an_end_without_inertia_of_its_own_is_named() {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("P"),
            Joint::free("Q"),
            Joint::anchor("B", [2.0, 0.0, 0.0]),
        ];
        let light = Bar::homogeneous(1.0, 0.0).unwrap();
        let members = |moment: f64| {
            let heavy = Bar::new(1.0, 4.0, 0.5, [0.0, moment, moment]).unwrap();
            vec![Member::bar(0, 1, light), Member::bar(1, 2, heavy), Member::bar(2, 3, light)]
        };
        let solved = |moment: f64| {
            let system = System::new("bar", 10.0, joints.clone(), members(moment)).unwrap();
            let at = [
                [0.0; 3],
                [0.5, 0.0, -0.75_f64.sqrt()],
                [1.5, 0.0, -0.75_f64.sqrt()],
                [2.0, 0.0, 0.0],
            ];
            let mechanism = Mechanism::for_small_motions(&system).unwrap();
            let state = State::at_rest(mechanism.places(&at).unwrap());
            let mut vectors = vec![[0.0; 3]; mechanism.vectors()];
            state.rows(&mechanism, &mut vectors);
            let densities = vec![1.0; mechanism.bars.len()];
            let stiffness = Stiffness::new(&mechanism, &state, &vectors, densities);
            let sectors = sectors(&mechanism, &state, &stiffness.excesses);
            sectors
                .iter()
                .map(|sector| solve(&stiffness, sector).map(|s| s.total))
                .collect::<Result<Vec<_>, _>>()
        };
        // One mode in the plane and two across it.
        assert_eq!(solved(0.1).unwrap().iter().sum::<usize>(), 3);
        let refused = solved(0.0).unwrap_err();
        assert!(
            matches!(&refused, MotionError::Massless { joint, .. } if joint == "Q"),
            "{refused}"
        );
    }

    /// Of (1, 2, 2) and the same with a part of (2, 1, -2), by the part over the whole, in any unit.
    #[test]
    fn columns_depend_on_each_other_by_their_size() {
        for size in [1e3, 1.0, 1e-3] {
            for (part, dimension) in [(3.0 * INDEPENDENT, 1), (0.3 * INDEPENDENT, 2)] {
                let first = [1.0, 2.0, 2.0].map(|x| size * x);
                let second = [2.0, 1.0, -2.0].map(|x| size * part * x);
                let columns = DMatrix::from_fn(3, 2, |row, column| {
                    first[row] + if column == 1 { second[row] } else { 0.0 }
                });
                let found = null_space(&columns);
                assert_eq!(found.ncols(), dimension, "{size} {part}");
                assert!(
                    (found.transpose() * &found - DMatrix::identity(dimension, dimension)).amax()
                        < 1e-14
                );
                // Across the first but for what counts as nothing.
                let along = (columns.column(0).transpose() * &found).amax();
                assert!(along < 3.0 * INDEPENDENT * size, "{along}");
            }
        }
    }
}
