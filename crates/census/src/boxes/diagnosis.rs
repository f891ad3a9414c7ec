//! Why there is no box: what double precision says of the derivative. No proof.

use matrices::dense::singular_values;
use model::NoBox;
use nalgebra::DMatrix;
use numerics::Interval;

use super::equations::Equations;
use super::newton::dense;

/// A singular value below this part of the largest one counts as zero.
const RANK: f64 = 1e-10;

/// A better reason than that a proof failed, where one is found at a place of the system.
pub(super) fn diagnosed(equations: &Equations, at: &[f64], failure: NoBox) -> NoBox {
    let point: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
    let entries = equations.slope(&point);
    let rigid: Vec<usize> = equations
        .acting
        .iter()
        .filter(|acting| acting.is_rigid())
        .map(|acting| acting.force)
        .collect();
    let moving = equations.joints.iter().map(|joint| joint.axes.len()).sum();
    let mut rigidity = DMatrix::zeros(rigid.len(), moving);
    for (row, column, value) in &entries {
        if let (Ok(row), true) = (rigid.binary_search(row), *column < moving) {
            rigidity[(row, *column)] += value.mid();
        }
    }
    if let Some(dimension) = deficiency(&rigidity) {
        return NoBox::SelfStresses { dimension };
    }
    match deficiency(&dense(equations.size, &entries)) {
        Some(dimension) => NoBox::FreeMotions { dimension },
        None => failure,
    }
}

/// How many rows depend on others, if some do.
fn deficiency(matrix: &DMatrix<f64>) -> Option<usize> {
    let values = singular_values(matrix)?;
    let largest = values.iter().copied().fold(0.0, f64::max);
    let rank = values.iter().filter(|value| **value > RANK * largest).count();
    matrix.nrows().checked_sub(rank).filter(|missing| *missing > 0)
}
