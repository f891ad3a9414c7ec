//! The system as argmin sees it.

use std::sync::Arc;

use argmin::core::{Error, Gradient, IterState};

use crate::net::frame::Frame;
use crate::net::shape::{Shape, Slope};

/// argmin's state for the solvers of this module: places and forces, and the residuals there.
pub(super) type Iterate = IterState<Arc<Shape>, Arc<Slope>, (), (), (), f64>;

/// The gradient of the Lagrangian; the solvers have functions of their own that fall.
#[derive(Debug, Clone)]
pub(super) struct Potential {
    pub(super) frame: Arc<Frame>,
}

/// Refuse what is not a number: a minimiser that compares with NaN may never stop.
fn finite(value: f64, quantity: &'static str) -> Result<(), Error> {
    if value.is_finite() { Ok(()) } else { Err(crate::net::Error::NotFinite { quantity }.into()) }
}

impl Gradient for Potential {
    type Param = Arc<Shape>;
    type Gradient = Arc<Slope>;

    fn gradient(&self, shape: &Arc<Shape>) -> Result<Arc<Slope>, Error> {
        let slope = self.frame.slope(shape);
        finite(slope.residual(), "gradient of the energy")?;
        Ok(Arc::new(slope))
    }
}

#[cfg(test)]
mod tests {
    use super::finite;

    #[test]
    fn what_is_not_finite_is_refused() {
        assert!(finite(-3.0, "a number").is_ok());
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(finite(value, "a number").is_err(), "{value}");
        }
    }
}
