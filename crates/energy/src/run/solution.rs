use std::sync::Arc;
use std::time::Instant;

use model::{
    Equilibrium, Evidence, ForceUncertainty, Problem, SolverName, UncertaintyCause, Vector,
};

use crate::run::minimise::Minimum;
use crate::run::reaction::{axial_forces, joint_forces, reactions};
use crate::run::scaled_chain::Units;
use crate::run::settings::Settings;
use crate::run::solver::force_uncertainty;
use crate::run::stability::SecondOrder;
use crate::thresholds::ZERO;
use crate::vector::{VectorSum, scaled};

/// A local minimum of the energy: the equilibrium with its evidence, and what the search cost.
///
/// ```
/// let found = energy::minimise(&model::cases::paper(), &energy::Settings::default())?;
/// // Together the anchors carry the three weights.
/// let reactions = found.equilibrium.reactions_n;
/// assert!((reactions.start[2] + reactions.end[2] - 3.0 * 9.80665).abs() < 1e-12);
/// assert!(found.work.gap < 1e-13);
/// # Ok::<(), energy::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The observables.
    pub equilibrium: Equilibrium,
    /// Unit directions of the bars, world frame.
    pub directions: Vec<Vector>,
    /// What the search cost.
    pub work: Work,
}

/// What a search cost, and how exactly it ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Work {
    /// Iterations of the solver on the chain itself (coarser chains not counted).
    pub iterations: u64,
    /// Evaluations of energy, gradient and Hessian on the chain itself.
    pub evaluations: u64,
    /// Projected gradient, in the unit of its tolerance.
    pub gradient: f64,
    /// Distance of the last joint from the end anchor, over the total length.
    pub gap: f64,
}

/// What `Evidence::residual` means here.
const RESIDUAL_OF: &str =
    "projected gradient: largest force across a bar, over the largest force of the chain";

/// What it means where bars that carry next to nothing are not known well enough.
const TURN_LEFT: &str = "turn of a bar that the next step of Newton's method asks for, rad, where bars carry next to nothing";

impl Solution {
    pub(crate) fn new(
        problem: &Problem,
        units: &Units,
        minimum: Minimum,
        unknown_rad: Option<f64>,
        settings: &Settings,
        clock: Instant,
    ) -> Self {
        let second = SecondOrder::new(&minimum.curvature());
        let Minimum { links, shape, slope, iterations, evaluations, .. } = minimum;
        let energy = shape.moments.value + units.datum(&links);

        let residual = slope.residual();
        let iterations_usize = usize::try_from(iterations).unwrap_or(usize::MAX);
        let tolerance = settings.gradient_tolerance;
        let mut evidence = match unknown_rad.filter(|turn| *turn > ZERO) {
            Some(turn) => Evidence::new(TURN_LEFT, turn, ZERO, iterations_usize),
            None => Evidence::new(RESIDUAL_OF, residual, tolerance, iterations_usize),
        };
        // A refined minimum has its own digits.
        let relative = match units.origin {
            Some(_) => 0.0,
            None => force_uncertainty(&links, &shape, &slope),
        };
        if relative > ZERO {
            let cause = UncertaintyCause::ParallelBars;
            evidence = evidence.with_force_uncertainty(ForceUncertainty { relative, cause });
        }
        evidence.nullity = second.nullity;
        evidence.condition = second.condition;
        // In the memory of the shape, which nothing else holds any more.
        drop(links);
        let u = Arc::try_unwrap(shape).map_or_else(|shape| shape.u.clone(), |shape| shape.u);
        let directions: Vec<Vector> = u.into_iter().map(|u| units.frame.into_world(u)).collect();
        let multipliers_n = joint_forces(problem, units, &slope);
        let equilibrium = Equilibrium {
            solver: SolverName::ENERGY,
            energy_j: energy * units.weight_n * units.length_m,
            joints_m: joints(problem, &directions),
            reactions_n: reactions(&multipliers_n),
            multipliers_n,
            axial_n: axial_forces(units, &slope),
            stability: second.stability,
            evidence,
        };
        let work = Work { iterations, evaluations, gradient: residual, gap: second.gap };
        let mut solution = Self { equilibrium, directions, work };
        solution.equilibrium.evidence.solve_s = clock.elapsed().as_secs_f64();
        solution
    }
}

/// Positions of the joints, world frame, m, summed from the start anchor.
fn joints(problem: &Problem, directions: &[Vector]) -> Vec<Vector> {
    let chain = problem.chain();
    let mut sum = VectorSum::default();
    sum.add(chain.anchors().start_m);
    let mut joints = Vec::with_capacity(directions.len() + 1);
    joints.push(chain.anchors().start_m);
    for (bar, &u) in chain.bars().iter().zip(directions) {
        sum.add(scaled(bar.length_m(), u));
        joints.push(sum.value());
    }
    joints
}
