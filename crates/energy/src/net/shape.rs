use model::Vector;

use crate::error::Error;
use crate::net::factor::{Block, Factor};
use crate::net::frame::Frame;
use crate::net::law::Excess;
pub(super) use crate::thresholds::NO_STRAIN;
use crate::vector::{norm, scaled};

/// Places of the joints and forces of the members: the primal and the dual variables.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    pub(super) x: Vec<Vector>,
    /// Multiplier of the length of each member: its axial force, tension positive.
    pub(super) force: Vec<f64>,
}

impl Shape {
    /// How far the joints are from the origin.
    pub(super) fn extent(&self) -> f64 {
        self.x.iter().map(|x| norm(*x)).fold(0.0, f64::max)
    }
}

/// The parts of the gradient of the Lagrangian that decide about convergence.
#[derive(Debug, Clone)]
pub(super) struct Slope {
    /// Largest component over the largest force of the system.
    pub(super) unbalance: f64,
    /// Largest misfit of a length, over the length.
    pub(super) misfit: f64,
    /// The member with the largest misfit.
    pub(super) worst: usize,
}

impl Slope {
    /// The larger of the two residuals.
    pub(super) fn residual(&self) -> f64 {
        self.unbalance.max(self.misfit)
    }
}

/// The largest entry by magnitude.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(
        0.0,
        |most: f64, value| {
            if value.is_nan() { f64::INFINITY } else { most.max(value.abs()) }
        },
    )
}

impl Frame {
    pub(super) fn excesses(&self, x: &[Vector]) -> Vec<Excess> {
        (0..self.rods.len()).map(|e| self.excess(x, e)).collect()
    }

    /// The largest force of the system: of a member or a load.
    pub(super) fn largest_force(&self, force: &[f64]) -> f64 {
        let loads = self.loads.iter().map(|load| norm(*load));
        loads.fold(largest(force), f64::max)
    }

    /// The same as what is divided by: the unit of force at the strain [`NO_STRAIN`] where there is
    /// no force at all, as at the rest of an elastic system without loads.
    pub(super) fn force_scale(&self, force: &[f64]) -> f64 {
        self.largest_force(force).max(NO_STRAIN)
    }

    /// Gradient of the Lagrangian `sum F c - sum load . x` by the coordinates.
    pub(super) fn lagrangian_gradient(&self, excess: &[Excess], force: &[f64]) -> Vec<f64> {
        self.gradient(|e| scaled(force[e], excess[e].gradient))
    }

    /// The residuals at a configuration.
    pub(super) fn slope(&self, shape: &Shape) -> Slope {
        let excess = self.excesses(&shape.x);
        let gradient = self.lagrangian_gradient(&excess, &shape.force);
        let (mut misfit, mut worst) = (0.0, 0);
        for (e, rod) in self.rods.iter().enumerate() {
            let off = rod.misfit(excess[e].value, shape.force[e]);
            if off > misfit || off.is_nan() {
                (misfit, worst) = (off, self.member_of(e));
            }
        }
        let unbalance = largest(&gradient) / self.force_scale(&shape.force);
        Slope { unbalance, misfit, worst }
    }

    /// The same, of numbers alone: a minimiser that compares with NaN may never stop.
    pub(super) fn finite_slope(&self, shape: &Shape) -> Result<Slope, Error> {
        let slope = self.slope(shape);
        let quantity = "gradient of the energy";
        if slope.residual().is_finite() { Ok(slope) } else { Err(Error::NotFinite { quantity }) }
    }

    /// Energy of the loads and of the stretched members.
    pub(super) fn energy(&self, shape: &Shape) -> f64 {
        let elastic =
            self.rods.iter().zip(&shape.force).enumerate().filter(|(e, _)| !self.again(*e));
        self.height(&shape.x)
            + model::sum(elastic.map(|(_, (rod, force))| 0.5 * rod.flexibility * force * force))
    }

    /// For each joint the sum of `force / length` over its members: the size of the second
    /// derivative of the Lagrangian there, in which shifts are measured.
    pub(super) fn sizes(&self, force: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sizes = vec![0.0; self.spots.len()];
        for (e, rod) in self.rods.iter().enumerate() {
            let size = force(e).abs() / rod.length;
            sizes[rod.from] += size;
            sizes[rod.to] += size;
        }
        sizes
    }

    /// The second derivative of the Lagrangian and of the springs that stand for the lengths.
    pub(super) fn fill(
        &self,
        factor: &mut Factor,
        block: impl Fn(usize) -> Block,
        shift: impl Fn(usize) -> f64,
    ) {
        factor.fill(&self.spots, &self.rods, &block, &shift);
    }
}
