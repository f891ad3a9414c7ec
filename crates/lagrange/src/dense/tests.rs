//! What the rows of the full system are measured in.

use super::*;
use crate::mechanism::Units;

/// Of each bar three rows of its centre, in units of the largest multiplier, and three of its
/// angles, in units of that times the mean length; then the constraints, in total lengths.
#[test]
fn rows_are_measured_in_forces_moments_and_lengths() {
    let problem = model::cases::paper();
    let chain = problem.chain();
    let mechanism = Mechanism::scaled(chain, Units::total(chain));
    let mut dense = Dense::new(&mechanism, &Point::new(3));
    for (largest, force) in [(-7.0, 7.0), (0.25, 1.0 / 3.0)] {
        dense.lambda.fill(0.0);
        dense.lambda[4] = largest;
        let mut units = Vec::new();
        for _ in 0..3 {
            units.extend([force; 3]);
            units.extend([force / 3.0; 3]);
        }
        units.extend([1.0; 12]);
        assert_eq!(dense.residual.len(), units.len());
        for (row, unit) in units.into_iter().enumerate() {
            dense.residual.fill(0.0);
            dense.residual[row] = -2.0;
            assert!((dense.largest() * unit - 2.0).abs() < 1e-14, "{row}");
        }
    }
}
