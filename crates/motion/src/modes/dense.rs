//! The projected eigenproblem by dense linear algebra: all modes of a small system.

use matrices::dense::{Cholesky, across, eigen, product, projected};
use model::Vector;
use nalgebra::{DMatrix, DVectorView};

use super::lanczos::length;
use super::planes::{Sector, space};
use super::solved::{Solved, ZERO};
use super::stiffness::{Entry, Stiffness};
use crate::error::{MotionError, Result};
use crate::mechanism::Mechanism;

/// Rows of the constraints whose part independent of the others is less than this, relative, are
/// dependent.
const INDEPENDENT: f64 = 1e-10;

/// What a self-stress does along motions is rounding below this part of its own size.
const WORK: f64 = 1e-9;

/// All modes whose displacements are along the axes of a sector.
/// [`MotionError::Massless`] where the inertia is not positive definite.
pub(super) fn solve(stiffness: &Stiffness<'_>, sector: &Sector) -> Result<Solved> {
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
    // Where nothing resists there is rounding of the forces alone.
    let scale = length(symmetric.as_slice()).max(stiffness.unit());
    let rounding = size as f64 * f64::EPSILON * scale;
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

/// The motions, by slot, that keep lengths to first order and not to second: those across the kernel of a sum of
/// self-stresses. Where panels are apart, each with a stress that works in one sense, the sum that weighs each stress
/// with its trace is positive on all of them.
/// [`MotionError::Singular`] where that sum is not positive, another stress works along its kernel, or one that works has a
/// part in a cable or strut, which a motion may slacken.
pub(super) fn bound<'a>(
    mechanism: &'a Mechanism,
    is_one_sided: impl Fn(usize) -> bool,
    stressed: impl Fn(Vec<f64>) -> Stiffness<'a>,
) -> Result<Vec<Vec<Vector>>> {
    let sector = space();
    let without = stressed(vec![0.0; mechanism.bars.len()]).entries(&sector);
    let size = without.size;
    let rows = matrix(mechanism.constraints(), size, &without.rows);
    let free = across(&rows.transpose(), INDEPENDENT);
    let without = matrix(size, size, &without.stiffness);
    // What each self-stress does along the motions, in units of its own size.
    let works = |stress: DVectorView<'_, f64>| {
        let bars = mechanism.bars.iter().zip(stress.iter());
        let densities = bars.map(|(bar, axial)| axial / bar.length_m).collect();
        let alone = matrix(size, size, &stressed(densities).entries(&sector).stiffness) - &without;
        projected(&alone, &free) / alone.amax().max(f64::MIN_POSITIVE)
    };
    let stresses = across(&rows, INDEPENDENT);
    let works: Vec<_> = stresses.column_iter().map(works).collect();
    let does = |work: &DMatrix<f64>| work.amax() > WORK;
    if !works.iter().any(does) {
        return Ok(vec![]);
    }
    let slackens = |stress: DVectorView<'_, f64>| {
        let mut bars = mechanism.bars.iter().zip(stress.iter());
        bars.any(|(bar, axial)| axial.abs() > WORK && is_one_sided(bar.member))
    };
    let mut working = stresses.column_iter().zip(&works).filter(|(_, work)| does(work));
    if working.any(|(stress, _)| slackens(stress)) {
        return Err(MotionError::Singular);
    }
    let weighed = works.iter().map(|work| work * work.trace());
    let sum = weighed.fold(DMatrix::zeros(free.ncols(), free.ncols()), |sum, work| sum + work);
    let (values, vectors) = eigen(&(&sum / sum.amax())).ok_or(MotionError::Singular)?;
    let kernel = values.partition_point(|value| *value <= WORK);
    let kept = vectors.columns(0, kernel);
    let undone = works.iter().all(|work| !does(&(work * kept)));
    if values.first().is_some_and(|least| *least < -WORK) || !undone {
        return Err(MotionError::Singular);
    }
    let motions = product(&free, &vectors.columns(kernel, free.ncols() - kernel).into_owned());
    let by_slot = |motion: &[f64]| motion.chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect();
    Ok(motions.as_slice().chunks_exact(size).map(by_slot).collect())
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
