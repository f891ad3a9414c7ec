//! The projected eigenproblem by dense linear algebra: all modes of a small system.

use matrices::dense::{Cholesky, across, eigen, product, projected};
use nalgebra::DMatrix;

use super::lanczos::length;
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
    let lower = Cholesky::new(&inertia).ok_or_else(massless)?;
    let half = lower.solve(matrix(size, size, &entries.stiffness));
    let ordinary = lower.solve(half.transpose());
    let rows = matrix(stiffness.row_count(), size, &entries.rows);
    let free = across(&lower.solve(rows.transpose()), INDEPENDENT);
    if free.ncols() == 0 {
        return Ok(Solved::default());
    }
    let projected = projected(&ordinary, &free);
    let symmetric = 0.5 * (&projected + projected.transpose());
    let (omega2, vectors) = eigen(&symmetric).ok_or_else(massless)?;
    let images = product(&symmetric, &vectors);
    let shapes = lower.solve_transposed(product(&free, &vectors));
    let shapes: Vec<_> = shapes.as_slice().chunks_exact(size).map(<[f64]>::to_vec).collect();
    let residual = |(k, omega2): (usize, &f64)| {
        let off = |(image, z): (&f64, &f64)| image - z * omega2;
        let rest: Vec<f64> = images.column(k).iter().zip(&vectors.column(k)).map(off).collect();
        length(&rest)
    };
    let rounding = size as f64 * f64::EPSILON * length(symmetric.as_slice());
    let is_zero = |(omega2, y): (&f64, &Vec<f64>)| {
        omega2.abs() <= ZERO * stiffness.energy(sector, y)[1] + rounding
    };
    let zero: Vec<bool> = omega2.iter().zip(&shapes).map(is_zero).collect();
    Ok(Solved {
        residual: omega2.iter().enumerate().map(residual).collect(),
        total: omega2.len(),
        negative: omega2.iter().zip(&zero).filter(|(o, zero)| **o < 0.0 && !**zero).count(),
        zero,
        omega2,
        shapes,
    })
}

/// The joint that moves no mass of its own: the first one whose inertia, with that of those before
/// it, is not positive definite.
fn massless(stiffness: &Stiffness<'_>, sector: &Sector, inertia: &DMatrix<f64>) -> MotionError {
    let definite =
        |size: &usize| Cholesky::new(&inertia.clone().resize(*size, *size, 0.0)).is_some();
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
                let found = across(&columns, INDEPENDENT);
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
