//! Settings of the cone solver.

use crate::error::BoundError;

/// Settings of a bound; the same for both programmes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundSettings {
    /// Interior point iterations before it is given up. Default 200; at least 1. Usual are 8 to 40.
    pub max_iterations: u32,
    /// Relative tolerance of the residuals and of the duality gap. Default 1e-9; between 1e-13 and
    /// 1e-2. The rigorous bound does not depend on it for its truth, only for how near it comes.
    pub tolerance: f64,
}

impl Default for BoundSettings {
    fn default() -> Self {
        Self { max_iterations: 200, tolerance: 1e-9 }
    }
}

impl BoundSettings {
    /// Check the ranges.
    ///
    /// # Errors
    ///
    /// [`BoundError::Setting`] with the first that is out of range.
    pub fn validate(&self) -> Result<(), BoundError> {
        if self.max_iterations == 0 {
            return Err(BoundError::Setting {
                setting: "max_iterations",
                range: "at least 1",
                value: 0.0,
            });
        }
        if !(1e-13..=1e-2).contains(&self.tolerance) {
            return Err(BoundError::Setting {
                setting: "tolerance",
                range: "between 1e-13 and 1e-2",
                value: self.tolerance,
            });
        }
        Ok(())
    }
}
