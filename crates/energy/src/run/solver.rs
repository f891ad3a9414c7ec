use std::sync::Arc;

use model::{STRAIGHT_TOLERANCE, Vector};

use crate::error::Error;
use crate::run::closure::Shape;
use crate::run::convergence::{Convergence, Iterate};
use crate::run::curvature::{Curvature, Step};
use crate::run::scaled_chain::ScaledChain;
use crate::run::settings::Settings;
use crate::run::slope::Slope;
use crate::run::straight_fold::off_the_line;
use crate::run::vertical_plane::Turn;
use crate::thresholds::{BISECTIONS, CORRECTIONS, FAIR_PART, LOST, PROGRESS, ROUNDING};
use crate::vector::{dot, norm, scaled};

/// A closed chain with its projected gradient.
pub(crate) type Place = (Arc<Shape>, Arc<Slope>);

/// Feasible Newton with a shift.
///
/// Every iterate is a closed chain. One iteration:
///
/// 1. judge the iterate: a minimum ends the run, a saddle is left along its lowest mode;
/// 2. about nearly vertical anchors, turn the whole chain towards its plane;
/// 3. solve the Newton system with the smallest shift that makes the Hessian positive definite on
///    the closed motions (inertia by counting signs) and that earlier iterations found good;
/// 4. turn the bars, and close the chain again;
/// 5. accept if the energy falls by a fair part of the prediction, else take a larger shift.
///
/// The energy never rises, a step is a descent direction by construction, and where the gradient
/// vanishes with a negative eigenvalue left (a saddle, a maximum) the solver leaves along its
/// eigenvector. So it can only end at a local minimum or by an error.
#[derive(Debug)]
pub(crate) struct FeasibleNewton {
    links: Arc<ScaledChain>,
    convergence: Convergence,
    pub(crate) iterations: u64,
    /// Evaluations of energy, gradient and Hessian.
    pub(crate) evaluations: u64,
    pub(crate) finished: bool,
    /// Why the place where it finished is not known to be a minimum.
    pub(crate) unsettled: Option<Error>,
}

/// A step better than this part of its prediction lets the shift shrink.
const GOOD_PART: f64 = 0.7;

/// Where the mean gradient is below this part of the most negative axial force and the Hessian is
/// indefinite, the iterate is near a saddle, and its lowest mode is worth more than its gradient.
const SADDLE_PART: f64 = 1e-2;

/// Above this part of the rounding of the energy a fall as large as predicted still says something.
const HALF_BLIND: f64 = 0.05;

/// A step on trial: the shape that it leads to, and what was predicted.
struct Trial {
    shape: Shape,
    /// Fall of the energy, the rounding left in the two closures counted at what it is worth.
    fall: f64,
    /// Fall to second order.
    predicted: f64,
}

impl FeasibleNewton {
    pub(crate) fn new(links: Arc<ScaledChain>, settings: Settings) -> Self {
        let convergence = Convergence::new(settings);
        let (iterations, evaluations, finished, unsettled) = (0, 0, false, None);
        Self { links, convergence, iterations, evaluations, finished, unsettled }
    }

    /// From a closed chain down, with so many iterations at most.
    pub(crate) fn run(&mut self, start: Shape, most: u64) -> Result<Place, Error> {
        let mut here = self.place(start)?;
        self.check_energy(&here)?;
        while !self.finished && self.iterations < most {
            match self.next(&here)? {
                Some(place) => {
                    self.check_energy(&place)?;
                    here = place;
                }
                None => self.finished = true,
            }
            self.iterations += 1;
        }
        Ok(here)
    }

    /// The next iterate; nothing where the run ends.
    fn next(&mut self, (shape, slope): &Place) -> Result<Option<Place>, Error> {
        let (links, shape, slope) = (Arc::clone(&self.links), Arc::clone(shape), Arc::clone(slope));
        let curvature = Curvature { links, shape, slope };
        self.evaluations += 1;
        match self.convergence.judge(&curvature) {
            Iterate::Minimum => return Ok(None),
            Iterate::Saddle => {
                let place = self.escape(&curvature)?;
                if place.is_none() {
                    self.unsettled = Some(self.stalled(&curvature));
                }
                return Ok(place);
            }
            Iterate::Near | Iterate::Sloping => {}
        }
        if let Some(place) = self.turn(&curvature)? {
            return Ok(Some(place));
        }
        let place = self.search(&curvature)?;
        // Else the gradient has reached its rounding.
        if place.is_none() && !self.at_rounding(&curvature) {
            self.unsettled = Some(self.stalled(&curvature));
        }
        Ok(place)
    }

    fn place(&mut self, shape: Shape) -> Result<Place, Error> {
        self.evaluations += 1;
        let slope = Slope::new(&self.links, &shape);
        finite(slope.mean, "projected gradient")?;
        Ok((Arc::new(shape), Arc::new(slope)))
    }

    fn check_energy(&mut self, (shape, _): &Place) -> Result<(), Error> {
        self.evaluations += 1;
        finite(shape.moments.value, "energy")
    }

    /// Newton's step with a shift that lowers the energy; nothing where no step does.
    fn search(&mut self, curvature: &Curvature) -> Result<Option<Place>, Error> {
        let (shape, slope) = (&*curvature.shape, &*curvature.slope);
        let stationary = self.convergence.stationary(shape, slope);
        // Differences of energies below this say nothing, and the gradient decides alone; an error of the closure costs the
        // multiplier.
        let noise = ROUNDING * (slope.pull + norm(slope.multiplier));
        for _ in 0..BISECTIONS {
            let Some(step) = curvature.step(self.convergence.shift) else {
                if slope.mean <= SADDLE_PART * -slope.lowest
                    && let Some(place) = self.escape(curvature)?
                {
                    return Ok(Some(place));
                }
                self.convergence.indefinite(curvature);
                continue;
            };
            let Some(trial) = trial(curvature, &step) else {
                self.convergence.failed_step(slope);
                continue;
            };
            let decided = trial.predicted > noise;
            if !decided || trial.fall >= FAIR_PART * trial.predicted {
                let good = trial.fall >= GOOD_PART * trial.predicted;
                let lower = trial.predicted > HALF_BLIND * noise && good;
                let (shape, next) = self.place(trial.shape)?;
                let flatter = next.mean <= PROGRESS * slope.mean;
                if decided || flatter || lower {
                    if !decided || good {
                        self.convergence.good_step(&next);
                    }
                    return Ok(Some((shape, next)));
                }
                if stationary {
                    break;
                }
            }
            self.convergence.failed_step(slope);
        }
        Ok(None)
    }

    /// Turn the whole chain towards the plane of its anchors, if that is far and the turn is soft.
    fn turn(&mut self, curvature: &Curvature) -> Result<Option<Place>, Error> {
        // Never twice in a row: what a turn leaves is Newton's.
        let turned = if self.convergence.turned { None } else { self.turned(curvature) };
        self.convergence.turned = turned.is_some();
        turned.map(|shape| self.place(shape)).transpose()
    }

    fn turned(&mut self, curvature: &Curvature) -> Option<Shape> {
        let (links, shape, slope) = (&curvature.links, &curvature.shape, &curvature.slope);
        let (turn, predicted) = Turn::towards_anchor(links, slope)?;
        let u = turn.of(&shape.u);
        let moments = links.measure(&u);
        let turned = links.close(Shape { u, moments }, CORRECTIONS).ok()?;
        let fall = shape.moments.value - turned.moments.value;
        let worth_it = if predicted > ROUNDING * slope.pull {
            fall >= FAIR_PART * predicted
        } else {
            self.convergence.may_turn_blindly()
        };
        worth_it.then_some(turned)
    }

    /// Leave a saddle: down along the lowest mode, as far as the second order is right. `None` if
    /// there is no such mode or no way along it.
    fn escape(&mut self, curvature: &Curvature) -> Result<Option<Place>, Error> {
        let (links, shape, slope) = (&curvature.links, &curvature.shape, &curvature.slope);
        let Some((mode, lowest)) = curvature.falling(slope.zero) else {
            return Ok(None);
        };
        let size: f64 = mode.iter().zip(&links.length).map(|(v, l)| l * dot(*v, *v)).sum();
        // Along the mode, not against what is left of the gradient.
        let uphill: f64 = (0..links.bars())
            .map(|i| links.length[i] * dot(links.load(i, slope.multiplier), mode[i]))
            .sum();
        let mut length = if uphill > 0.0 { -1.0 } else { 1.0 };
        for _ in 0..BISECTIONS {
            let moved = links.moved(&shape.u, |i, _| scaled(length, mode[i]));
            if let Ok(trial) = links.close(moved, CORRECTIONS) {
                let fall = shape.moments.value - trial.moments.value;
                let predicted = -0.5 * lowest * size * length * length;
                if fall >= 0.5 * predicted && fall > ROUNDING * slope.pull {
                    let place = self.place(trial)?;
                    self.convergence.left_saddle();
                    return Ok(Some(place));
                }
            }
            length *= 0.5;
        }
        Ok(None)
    }

    /// Why no step helps: the chain is folded beyond what double precision tells, or it is not known.
    fn stalled(&self, curvature: &Curvature) -> Error {
        let slope = &curvature.slope;
        if let Some(across) = slope.lost(&curvature.links) {
            return Error::NearlyFolded { across };
        }
        let (iterations, gradient) = (self.iterations, slope.residual());
        let directions = curvature.index(slope.zero);
        let gap = norm(curvature.shape.moments.gap) / curvature.links.total();
        Error::NoDescent { iterations, gradient, gap, directions }
    }

    /// Whether a place from which no step helps is a minimum, as well as rounding lets it be known.
    fn at_rounding(&self, curvature: &Curvature) -> bool {
        let (shape, slope) = (&curvature.shape, &curvature.slope);
        let flat = self.convergence.stationary(shape, slope)
            || (self.convergence.closed(shape) && slope.residual() <= rounding_floor(shape));
        flat && curvature.index(slope.zero) == 0
    }
}

/// Refuse what is not a number: a minimiser that compares with NaN may never stop.
fn finite(value: f64, quantity: &'static str) -> Result<(), Error> {
    if value.is_finite() { Ok(()) } else { Err(Error::NotFinite { quantity }) }
}

/// Take a step and close the chain again; `None` if it does not close.
fn trial(curvature: &Curvature, step: &Step) -> Option<Trial> {
    let (links, shape, slope) = (&curvature.links, &curvature.shape, &curvature.slope);
    let mut predicted = 0.0;
    let moved = links.moved(&shape.u, |i, u| {
        let v = curvature.turn_of(step, i, u);
        predicted += links.length[i] * (0.5 * slope.axial[i] + step.shift) * dot(v, v);
        v
    });
    let trial = links.close(moved, CORRECTIONS).ok()?;
    // The multiplier says what the rounding left in the two closures is worth.
    let worth = |m: Vector| dot(slope.multiplier, m);
    let fall = (shape.moments.value - trial.moments.value)
        + (worth(shape.moments.gap) - worth(trial.moments.gap));
    Some(Trial { shape: trial, fall, predicted })
}

/// Smallest eigenvalue of the spread of the directions: the square of their angle to the line to
/// which they are most nearly parallel.
fn smallest_spread(shape: &Shape) -> f64 {
    let eigen = shape.moments.spread.eigen();
    let smallest = eigen.value[..eigen.size].iter().copied().fold(f64::INFINITY, f64::min);
    smallest.max(STRAIGHT_TOLERANCE)
}

/// The smallest residual that directions in double precision can have.
///
/// A unit vector in double precision leaves the closure uncertain by a rounding. Along a line to
/// which all bars are nearly parallel, at an angle of the size `a`, closing that gap turns them by
/// a rounding over `a`; `a²` is the smallest eigenvalue of the spread.
fn rounding_floor(shape: &Shape) -> f64 {
    LOST / smallest_spread(shape).sqrt()
}

/// How far directions in double precision leave the forces open, as a part of the largest: of bars
/// at an angle `a` to a common line they hold the forces along the line to a rounding, and what is
/// left of the gradient, over `a`. On the line itself the forces are those of the limit (module
/// `straight_fold`), exact if the anchors are on it; by as much as they are off it the bars have room to
/// turn by the root of that. With a bar compressed on the line nothing is known of the forces along
/// it.
pub(crate) fn force_uncertainty(links: &ScaledChain, shape: &Shape, slope: &Slope) -> f64 {
    if let Some(e) = slope.line {
        let known = if slope.opened { 0.0 } else { 1.0 };
        off_the_line(links, e).map_or(known, f64::sqrt)
    } else {
        (LOST + slope.residual()) / smallest_spread(shape).sqrt()
    }
}

#[cfg(test)]
mod tests;
