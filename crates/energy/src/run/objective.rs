//! The chain as argmin sees it.

use std::sync::Arc;

use argmin::core::{CostFunction, Error, Gradient, Hessian};

use crate::run::closure::Shape;
use crate::run::curvature::Curvature;
use crate::run::scaled_chain::ScaledChain;
use crate::run::slope::Slope;

/// Energy, projected gradient and projected Hessian of closed chains.
///
/// The parameter is a closed [`Shape`], shared and never changed: argmin keeps copies of the
/// current, the previous and the best one, and a chain of a million bars is copied for none of
/// them.
#[derive(Debug, Clone)]
pub(crate) struct Objective {
    pub(crate) links: Arc<ScaledChain>,
}

/// Refuse what is not a number: a minimiser that compares with NaN may never stop.
fn finite(value: f64, quantity: &'static str) -> Result<(), Error> {
    if value.is_finite() { Ok(()) } else { Err(crate::error::Error::NotFinite { quantity }.into()) }
}

impl CostFunction for Objective {
    type Param = Arc<Shape>;
    type Output = f64;

    fn cost(&self, shape: &Arc<Shape>) -> Result<f64, Error> {
        finite(shape.moments.value, "energy")?;
        Ok(shape.moments.value)
    }
}

impl Gradient for Objective {
    type Param = Arc<Shape>;
    type Gradient = Arc<Slope>;

    fn gradient(&self, shape: &Arc<Shape>) -> Result<Arc<Slope>, Error> {
        let slope = Slope::new(&self.links, shape);
        finite(slope.mean, "projected gradient")?;
        Ok(Arc::new(slope))
    }
}

/// The pair at which the second derivative is taken.
pub(crate) type Place = (Arc<Shape>, Arc<Slope>);

impl Hessian for Objective {
    type Param = Place;
    type Hessian = Curvature;

    fn hessian(&self, (shape, slope): &Place) -> Result<Curvature, Error> {
        Ok(Curvature {
            links: Arc::clone(&self.links),
            shape: Arc::clone(shape),
            slope: Arc::clone(slope),
        })
    }
}

#[cfg(test)]
mod tests;
