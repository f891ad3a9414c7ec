//! Newton's method on the closed chains, as a solver for argmin.

use std::sync::Arc;

use argmin::core::{IterState, KV, Problem, Solver, State, TerminationReason, TerminationStatus};
use model::Vector;

use crate::closure::{LOST_SPREAD, Shape};
use crate::curvature::Curvature;
use crate::error::Error;
use crate::links::Links;
use crate::objective::{Objective, Place};
use crate::plane::Turn;
use crate::settings::Settings;
use crate::slope::Slope;
use crate::strands::off_the_line;
use crate::vector::{dot, norm, scaled};

/// argmin's state for this solver: closed shape, projected gradient, projected Hessian.
pub(crate) type Iterate = IterState<Arc<Shape>, Arc<Slope>, (), Curvature, (), f64>;

/// Feasible Newton with a shift.
///
/// argmin has no solver for constrained problems, so this one is ours; argmin runs it. Every iterate
/// is a closed chain. One iteration:
///
/// 1. solve the Newton system with the smallest shift that makes the Hessian positive definite on
///    the closed motions (inertia by counting signs) and that earlier iterations found good;
/// 2. turn the bars, and close the chain again;
/// 3. accept if the energy falls by a fair part of the prediction, else take a larger shift.
///
/// The energy never rises, a step is a descent direction by construction, and where the gradient
/// vanishes with a negative eigenvalue left (a saddle, a maximum) the solver leaves along its
/// eigenvector. So it can only end at a local minimum or by an error.
#[derive(Debug)]
pub(crate) struct FeasibleNewton {
    settings: Settings,
    shift: f64,
    converged: bool,
    polished: bool,
    /// Whether the iteration before was a turn of the whole chain.
    swung: bool,
    /// Turns made without the energy being able to tell.
    blind_turns: usize,
}

/// Least part of the predicted fall of the energy that counts as success.
const FAIR_PART: f64 = 0.1;

/// A step better than this part of its prediction lets the shift shrink.
const GOOD_PART: f64 = 0.7;

/// Factors of the shift after a good step and after a failure.
const SHIFT_DOWN: f64 = 0.1;
/// See [`SHIFT_DOWN`].
const SHIFT_UP: f64 = 4.0;

/// Factor of the shift while the Hessian is not positive definite.
const INDEFINITE_UP: f64 = 8.0;

/// Where the mean gradient is below this part of the most negative axial force and the Hessian is
/// indefinite, the iterate is near a saddle, and its lowest mode is worth more than its gradient.
const SADDLE_PART: f64 = 1e-2;

/// Roundings of the closure in the smallest attainable residual.
const FLOOR: f64 = 16.0;

/// Trials of one iteration: four to this power covers the range of a double's squares.
const TRIALS: usize = 60;

/// Corrections of the closure after a step. Three to five are normal; a step that needs more is too
/// long.
const CORRECTIONS: usize = 12;

/// Energies are sums of rounded products: differences below this, times the size of the forces,
/// say nothing, and the gradient decides alone.
const ENERGY_NOISE: f64 = 2.0 * f64::EPSILON;

/// Once differences of energy are rounding, a step must shrink the mean gradient to this part.
const GRADIENT_PROGRESS: f64 = 0.5;

/// Above this part of the noise a fall as large as predicted still says something.
const HALF_BLIND: f64 = 0.05;

/// How often the whole chain may turn towards its plane when the energy it wins is below its noise:
/// Newton's method mends what each turn does to the gradient, and each brings the plane nearer by the
/// distance of the verticals.
const BLIND_TURNS: usize = 16;

/// Eigenvalues above minus this, in units of the largest force, are zero: the rounding of the axial
/// forces and of the sums behind the count.
pub(crate) const ZERO_CURVATURE: f64 = 1e-10;

/// A residual this small is rounding; no further step is worth its time.
const EXACT: f64 = 8.0 * f64::EPSILON;

impl FeasibleNewton {
    pub(crate) fn new(settings: Settings) -> Self {
        Self {
            settings,
            shift: 0.0,
            converged: false,
            polished: false,
            swung: false,
            blind_turns: 0,
        }
    }

    /// Whether the projected gradient and the closure are below their tolerances.
    fn stationary(&self, shape: &Shape, slope: &Slope) -> bool {
        slope.residual() <= self.settings.gradient_tolerance
            && norm(shape.moments.gap) <= self.settings.closure_tolerance
    }

    /// Turn the whole chain towards the plane of its anchors, if that is far and the turn is soft.
    fn swing(
        &mut self,
        problem: &mut Problem<Objective>,
        links: &Links,
        shape: &Shape,
        slope: &Slope,
    ) -> Result<Option<Place>, argmin::core::Error> {
        let Some((turn, predicted)) = Turn::towards_anchor(links, slope) else {
            return Ok(None);
        };
        let u = turn.of(&shape.u);
        let moments = links.measure(&u);
        let Ok(turned) = links.close(Shape { u, moments }, CORRECTIONS) else { return Ok(None) };
        let fall = shape.moments.value - turned.moments.value;
        if predicted > ENERGY_NOISE * slope.pull {
            if fall < FAIR_PART * predicted {
                return Ok(None);
            }
        } else if self.blind_turns == BLIND_TURNS {
            return Ok(None);
        } else {
            self.blind_turns += 1;
        }
        let turned = Arc::new(turned);
        let next = problem.gradient(&turned)?;
        Ok(Some((turned, next)))
    }

    /// Leave a saddle: down along the lowest mode, as far as the second order is right. `None` if
    /// there is no such mode or no way along it.
    fn escape(
        &mut self,
        problem: &mut Problem<Objective>,
        curvature: &Curvature,
    ) -> Result<Option<Place>, argmin::core::Error> {
        let (links, shape, slope) = (&curvature.links, &curvature.shape, &curvature.slope);
        let Some((mode, lowest)) = curvature.falling(ZERO_CURVATURE * slope.pull) else {
            return Ok(None);
        };
        let size: f64 = mode.iter().zip(&links.length).map(|(v, l)| l * dot(*v, *v)).sum();
        // Along the mode, not against what is left of the gradient.
        let uphill: f64 = (0..links.bars())
            .map(|i| links.length[i] * dot(links.load(i, slope.multiplier), mode[i]))
            .sum();
        let mut length = if uphill > 0.0 { -1.0 } else { 1.0 };
        for _ in 0..TRIALS {
            let moved = links.moved(&shape.u, |i, _| scaled(length, mode[i]));
            if let Ok(trial) = links.close(moved, CORRECTIONS) {
                let fall = shape.moments.value - trial.moments.value;
                let predicted = -0.5 * lowest * size * length * length;
                if fall >= 0.5 * predicted && fall > ENERGY_NOISE * slope.pull {
                    let trial = Arc::new(trial);
                    let slope = problem.gradient(&trial)?;
                    self.shift = 0.0;
                    self.polished = false;
                    return Ok(Some((trial, slope)));
                }
            }
            length *= 0.5;
        }
        Ok(None)
    }
}

/// Make a closed shape the current iterate.
fn accept(
    problem: &mut Problem<Objective>,
    state: Iterate,
    shape: Arc<Shape>,
    slope: Arc<Slope>,
) -> Result<(Iterate, Option<KV>), argmin::core::Error> {
    let value = problem.cost(&shape)?;
    Ok((state.param(shape).gradient(slope).cost(value), None))
}

/// Smallest eigenvalue of the spread of the directions: the square of their angle to the line to which they are
/// most nearly parallel.
fn smallest_spread(shape: &Shape) -> f64 {
    let eigen = shape.moments.spread.eigen();
    let smallest = eigen.value[..eigen.size].iter().copied().fold(f64::INFINITY, f64::min);
    smallest.max(LOST_SPREAD)
}

/// The smallest residual that directions in double precision can have.
///
/// A unit vector in double precision leaves the closure uncertain by a rounding. Along a line to
/// which all bars are nearly parallel, at an angle of the size `a`, closing that gap turns them by a
/// rounding over `a`; `a²` is the smallest eigenvalue of the spread.
fn rounding_floor(shape: &Shape) -> f64 {
    FLOOR * f64::EPSILON / smallest_spread(shape).sqrt()
}

/// How far directions in double precision leave the forces in doubt, as a part of the largest: of bars at an angle `a`
/// to a common line they hold the forces along the line to a rounding, and what is left of the gradient, over `a`. On
/// the line itself the forces are those of the limit (module `strands`), exact if the anchors are on it; by as much as
/// they are off it the bars have room to turn by the root of that. With a bar pushed on the line nothing is known of
/// what the bars share along it.
pub(crate) fn doubt(links: &Links, shape: &Shape, slope: &Slope) -> f64 {
    if let Some(e) = slope.line {
        let known = if slope.opened { 0.0 } else { 1.0 };
        off_the_line(links, e).map_or(known, f64::sqrt)
    } else {
        (FLOOR * f64::EPSILON + slope.residual()) / smallest_spread(shape).sqrt()
    }
}

/// Why no step helps: the chain is folded beyond what double precision tells, or it is not known.
fn stalled(links: &Links, state: &Iterate, slope: &Slope) -> argmin::core::Error {
    if let Some(across) = slope.lost(links) {
        return Error::NearlyFolded { across }.into();
    }
    Error::Stalled { iterations: state.get_iter(), gradient: slope.residual() }.into()
}

/// The current iterate; `init` puts the first one in.
fn current(state: &mut Iterate) -> Result<(Arc<Shape>, Arc<Slope>), Error> {
    match (state.get_param(), state.get_gradient()) {
        (Some(shape), Some(slope)) => Ok((Arc::clone(shape), Arc::clone(slope))),
        _ => Err(Error::NotFinite { quantity: "first iterate" }),
    }
}

impl Solver<Objective, Iterate> for FeasibleNewton {
    fn name(&self) -> &'static str {
        "feasible Newton"
    }

    fn init(
        &mut self,
        problem: &mut Problem<Objective>,
        mut state: Iterate,
    ) -> Result<(Iterate, Option<KV>), argmin::core::Error> {
        let Some(shape) = state.take_param() else {
            return Err(Error::NotFinite { quantity: "first iterate" }.into());
        };
        let slope = problem.gradient(&shape)?;
        accept(problem, state, shape, slope)
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Objective>,
        mut state: Iterate,
    ) -> Result<(Iterate, Option<KV>), argmin::core::Error> {
        let place = current(&mut state)?;
        let curvature = problem.hessian(&place)?;
        let (shape, slope) = place;
        let stationary = self.stationary(&shape, &slope);
        if stationary {
            if curvature.index(ZERO_CURVATURE * slope.pull) > 0 {
                return match self.escape(problem, &curvature)? {
                    Some((shape, slope)) => accept(problem, state, shape, slope),
                    None => Err(stalled(&curvature.links, &state, &slope)),
                };
            }
            if self.polished || slope.residual() <= EXACT {
                self.converged = true;
                return Ok((state, None));
            }
            self.polished = true;
        }
        let links = Arc::clone(&curvature.links);
        // Never twice in a row: what a turn leaves is Newton's.
        self.swung = !self.swung;
        if self.swung {
            if let Some((turned, next)) = self.swing(problem, &links, &shape, &slope)? {
                return accept(problem, state, turned, next);
            }
            self.swung = false;
        }
        let noise = ENERGY_NOISE * (slope.pull + slope.multiplier_size());
        for _ in 0..TRIALS {
            let Some(step) = curvature.step(self.shift) else {
                if slope.mean <= SADDLE_PART * -slope.lowest
                    && let Some((shape, slope)) = self.escape(problem, &curvature)?
                {
                    return accept(problem, state, shape, slope);
                }
                // A shift beyond the safe one is never needed; a smaller one often does.
                let next = (INDEFINITE_UP * self.shift).max(GRADIENT_PART * slope.mean);
                let safe = curvature.safe_shift();
                self.shift = if self.shift < safe { next.min(safe) } else { next };
                continue;
            };
            let mut predicted = 0.0;
            let moved = links.moved(&shape.u, |i, u| {
                let v = curvature.turn_of(&step, i, u);
                predicted += links.length[i] * (0.5 * slope.axial[i] + step.shift) * dot(v, v);
                v
            });
            if let Ok(trial) = links.close(moved, CORRECTIONS) {
                // The multiplier says what the rounding left in the two closures is worth.
                let worth = |m: Vector| dot(slope.multiplier, m);
                let fall = (shape.moments.value - trial.moments.value)
                    + (worth(shape.moments.gap) - worth(trial.moments.gap));
                let decided = predicted > noise;
                if !decided || fall >= FAIR_PART * predicted {
                    let trial = Arc::new(trial);
                    let next = problem.gradient(&trial)?;
                    // On a straight chain the multiplier is another one.
                    let comparable = next.line.is_some() == slope.line.is_some();
                    let flatter = next.mean <= GRADIENT_PROGRESS * slope.mean;
                    let lower = predicted > HALF_BLIND * noise && fall >= GOOD_PART * predicted;
                    if decided || !comparable || flatter || lower {
                        if !decided || fall >= GOOD_PART * predicted {
                            self.shift = (SHIFT_DOWN * self.shift).min(next.mean);
                        }
                        return accept(problem, state, trial, next);
                    }
                    if stationary {
                        break;
                    }
                }
            }
            self.shift = (SHIFT_UP * self.shift).max(GRADIENT_PART * slope.mean);
        }
        let closed = norm(shape.moments.gap) <= self.settings.closure_tolerance;
        if stationary || (closed && slope.residual() <= rounding_floor(&shape)) {
            // The gradient has reached its rounding.
            if curvature.index(ZERO_CURVATURE * slope.pull) == 0 {
                self.converged = true;
                return Ok((state, None));
            }
        }
        Err(stalled(&links, &state, &slope))
    }

    fn terminate(&mut self, _state: &Iterate) -> TerminationStatus {
        if self.converged {
            TerminationStatus::Terminated(TerminationReason::SolverConverged)
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

/// Smallest shift worth trying when none failed, in units of the mean gradient: it holds the mean
/// turn of the bars to a few radians.
const GRADIENT_PART: f64 = 0.25;
