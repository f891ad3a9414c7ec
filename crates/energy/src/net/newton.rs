//! Newton's method on the augmented Lagrangian: down to a local minimum from anywhere.
//!
//! A spring of stiffness `kappa` in series with each member turns the lengths into energies,
//!
//! `M(x; F) = sum (F + kappa c)² / 2 kappa (1 + kappa phi) - sum load . x`,
//!
//! a function without constraints. Newton's method with a shift that keeps its matrix positive
//! definite lowers it step by step, so no maximum and no saddle attracts it. Where its gradient is
//! small the estimates `F` become the forces with the springs, and the springs become stiffer where
//! the lengths do not improve. At a stationary point whose matrix is indefinite the step is one
//! along the lowest mode.
//!
//! Near a solution `kappa` is large and every step updates the forces: that is Newton's method for
//! places and forces together, in a matrix that is positive definite exactly where the second
//! derivative of the energy is, on the motions that keep the lengths.
//!
//! M. J. D. Powell in R. Fletcher (ed.), Optimization (1969) 283-298; P. E. Gill and D. P.
//! Robinson, Comput. Optim. Appl. 51 (2012) 1-25, doi:10.1007/s10589-010-9339-1

use std::sync::Arc;

use model::system::Kind;

use crate::error::Error;
use crate::net::factor::Factor;
use crate::net::frame::{Frame, Rod};
use crate::net::law::{Excess, Softened};
use crate::net::limit::{Limit, Reading};
use crate::net::polish::NEUTRAL;
use crate::net::settings::Settings;
use crate::net::shape::{Shape, Slope, largest};
use crate::thresholds::{ARMIJO, FORCE_ROUNDING, GOLDEN, STEP_ROUNDING, ZERO};
use crate::vector::scaled;

/// The springs become stiffer by this factor where an update of the forces makes the misfit less by a smaller one.
const STIFFEN: f64 = 5.0;

/// Misfit below which Newton's method for places and forces is tried.
pub(super) const NEAR: f64 = 1e-3;

/// First shift and smallest one, over the size of the matrix: more than the inverse of that, and the steps are nothing.
const FIRST_SHIFT: f64 = 1e-3;
const SMALLEST_SHIFT: f64 = 1e-8;

/// Largest relative displacement of the ends of a strut in one step, over its length: it must not be turned inside out, as
/// its energy falls for ever on the other side.
const STRUT_STEP: f64 = 0.3;

/// Stiffness of the spring of an elastic member that keeps its own, over its own.
const OWN: f64 = 1e6;

/// Halvings of a step before the shift grows.
const HALVINGS: usize = 5;

/// Solutions of a linear system that show the lowest mode.
const MODE_STEPS: usize = 12;

/// Gradient at a stationary point, over the mean force.
const STATIONARY: f64 = 1e-3;

/// Largest displacement of a joint in the first step off a saddle, over the unit of length.
const OFF_SADDLE: f64 = 0.3;

/// Steps after which Newton's method for places and forces is tried again, however near it was.
const AGAIN: u64 = 20;

/// How often lengths may seem to fit no shape where members may be slack.
const MISFITS: usize = 4;

/// Newton's method on the augmented Lagrangian.
pub(super) struct Newton {
    pub(super) frame: Arc<Frame>,
    pub(super) factor: Factor,
    pub(super) settings: Settings,
    /// Force at which a spring is as long again as its member.
    stiffness: f64,
    /// Misfit after the last update of the forces.
    misfit: f64,
    shift: f64,
    /// Whether the last step since the last update of the forces needed no shift.
    definite: bool,
    /// Misfit below which Newton's method for places and forces is tried next.
    near: f64,
    /// Steps since it was tried.
    since: u64,
    /// How often lengths seemed to fit no shape.
    misfits: usize,
    /// The solution where lengths overdetermine it.
    pub(super) limit: Option<Limit>,
    /// Largest relative displacement of the ends of a member in one step, over its length.
    step: f64,
    /// Whether elastic members keep their own stiffness.
    own: bool,
    pub(super) ended: bool,
}

/// How boldly a run goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// Strain of the springs under the largest force at first.
    pub(super) strain: f64,
    /// Misfit below which Newton's method for places and forces is tried.
    pub(super) near: f64,
    /// Largest relative displacement of the ends of a member in one step, over its length.
    pub(super) step: f64,
    /// Whether elastic members keep their own stiffness: softened by the springs, a shallow dome
    /// would snap through, and a start would end in another minimum than the one below it.
    pub(super) own: bool,
}

impl Default for Pace {
    /// From anywhere.
    fn default() -> Self {
        Self { strain: 0.1, near: NEAR, step: 2.0, own: false }
    }
}

/// The augmented Lagrangian at one configuration.
struct Local {
    excess: Vec<Excess>,
    soft: Vec<Softened>,
    value: f64,
    gradient: Vec<f64>,
}

impl Local {
    /// Mean force of the members.
    fn typical(&self) -> f64 {
        let sum: f64 = self.soft.iter().map(|soft| soft.force.abs()).sum();
        // Where no member bears anything yet, the loads; where nothing but rounding, what is left over.
        let (mean, left) = (sum / self.soft.len() as f64, largest(&self.gradient));
        if sum <= 0.0 {
            1.0
        } else if mean > STATIONARY * left {
            mean
        } else {
            left
        }
    }
}

impl Newton {
    /// From a start with these forces.
    pub(super) fn new(
        frame: Arc<Frame>,
        factor: Factor,
        settings: Settings,
        force: &[f64],
        pace: Pace,
    ) -> Self {
        Self {
            stiffness: frame.force_scale(force) / pace.strain,
            frame,
            factor,
            settings,
            misfit: f64::INFINITY,
            shift: 0.0,
            definite: false,
            near: pace.near,
            since: 0,
            misfits: 0,
            limit: None,
            step: pace.step,
            own: pace.own,
            ended: false,
        }
    }

    fn kappa(&self, rod: usize) -> f64 {
        let rod = &self.frame.rods[rod];
        let kappa = self.stiffness / rod.length;
        if self.own && rod.elastic() { kappa.max(OWN / rod.flexibility) } else { kappa }
    }

    /// The members with their springs, and the value of the augmented Lagrangian.
    fn value(&self, x: &[model::Vector], force: &[f64]) -> (Vec<Excess>, Vec<Softened>, f64) {
        let excess = self.frame.excesses(x);
        let soft = |(e, c): (usize, &Excess)| {
            self.frame.rods[e].softened(c.value, force[e], self.kappa(e))
        };
        let soft: Vec<Softened> = excess.iter().enumerate().map(soft).collect();
        let once = soft.iter().enumerate().filter(|(e, _)| !self.frame.again(*e));
        let potential = model::sum(once.map(|(_, soft)| soft.potential));
        (excess, soft, self.frame.height(x) + potential)
    }

    fn local(&self, shape: &Shape) -> Local {
        let (excess, soft, value) = self.value(&shape.x, &shape.force);
        let gradient = self.frame.gradient(|e| scaled(soft[e].force, excess[e].gradient));
        Local { excess, soft, value, gradient }
    }

    /// Factorise the second derivative with a shift; whether it is positive definite.
    fn factorise(&mut self, local: &Local, shift: f64) -> bool {
        let typical = local.typical();
        let sizes = self.frame.sizes(|e| local.soft[e].force.abs().max(typical));
        let block = |e: usize| local.excess[e].block(local.soft[e].force, local.soft[e].stiffness);
        self.frame.fill(&mut self.factor, block, |joint| shift * sizes[joint]);
        self.factor.definite()
    }

    /// Rounding of the augmented Lagrangian.
    fn noise(&self, shape: &Shape, local: &Local) -> f64 {
        FORCE_ROUNDING * (local.value.abs() + self.frame.largest_force(&shape.force))
    }

    /// One step down the augmented Lagrangian.
    fn descend(&mut self, shape: &Shape, local: &Local) -> Result<Shape, Error> {
        let noise = self.noise(shape, local);
        loop {
            if self.factorise(local, self.shift.max(NEUTRAL)) {
                let step = self.factor.step_against(local.gradient.clone());
                let slope: f64 = step.iter().zip(&local.gradient).map(|(s, g)| s * g).sum();
                let mut part = self.longest_part(&step);
                for _ in 0..HALVINGS {
                    let x = self.frame.moved(&shape.x, part, &step);
                    let (_, _, value) = self.value(&x, &shape.force);
                    if value <= local.value + ARMIJO * part * slope + noise {
                        self.definite = self.shift <= 0.0;
                        self.relent(part);
                        return Ok(Shape { x, force: shape.force.clone() });
                    }
                    part *= 0.5;
                }
            }
            self.shift = if self.shift > 0.0 { 8.0 * self.shift } else { FIRST_SHIFT };
            if self.shift > SMALLEST_SHIFT.recip() {
                return Err(self.stalled(shape));
            }
        }
    }

    /// The part of a step, at most one, that turns no member too far.
    fn longest_part(&self, step: &[f64]) -> f64 {
        let rods = self.frame.rods.iter().enumerate();
        rods.fold(1.0, |part, (e, rod)| {
            let strut = rod.kind == Kind::Strut;
            let most = if strut { STRUT_STEP.min(self.step) } else { self.step } * rod.length;
            part.min(most / self.frame.turned(step, e).max(f64::MIN_POSITIVE))
        })
    }

    /// The next shift after a step of which this part was made.
    fn relent(&mut self, part: f64) {
        if part > 0.9 {
            self.shift *= 0.2;
            if self.shift < SMALLEST_SHIFT {
                self.shift = 0.0;
            }
        } else if part < 0.3 {
            self.shift = (4.0 * self.shift).max(SMALLEST_SHIFT);
        }
    }

    fn stalled(&self, shape: &Shape) -> Error {
        if let Some(jam) = self.frame.jam(shape) {
            return jam;
        }
        let slope = self.frame.slope(shape);
        if slope.misfit > NEAR {
            return Error::NotClosed {
                member: slope.worst + 1,
                misfit_m: slope.misfit * self.frame.rods[slope.worst].length * self.frame.length_m,
            };
        }
        if self.frame.is_relaxed(shape) {
            return Error::NoLoad;
        }
        Error::Stalled { unbalance: slope.unbalance, misfit: slope.misfit }
    }

    /// At a stationary point of the augmented Lagrangian whose second derivative is indefinite: a
    /// step along its lowest mode.
    fn leave_saddle(&mut self, shape: &Shape, local: &Local) -> Option<Shape> {
        let mut shift = FIRST_SHIFT;
        while !self.factorise(local, shift) {
            shift *= 4.0;
            if shift > SMALLEST_SHIFT.recip() {
                return None;
            }
        }
        // A start without symmetry, the same in every run.
        let mut mode: Vec<f64> =
            (0..self.frame.freedom).map(|k| (1.0 + GOLDEN * k as f64).sin()).collect();
        for _ in 0..MODE_STEPS {
            let size = largest(&mode);
            for value in &mut mode {
                *value /= size;
            }
            self.factor.solve(&mut mode);
        }
        let uphill: f64 = mode.iter().zip(&local.gradient).map(|(v, g)| v * g).sum();
        let mut part = OFF_SADDLE / largest(&mode);
        if uphill > 0.0 {
            part = -part;
        }
        self.shift = shift;
        // Along a motion that nothing resists, as a free turn, nothing but rounding falls.
        let noise = self.noise(shape, local);
        for _ in 0..40 {
            let x = self.frame.moved(&shape.x, part, &mode);
            if self.value(&x, &shape.force).2 < local.value - noise {
                return Some(Shape { x, force: shape.force.clone() });
            }
            part *= 0.5;
        }
        None
    }

    /// One iteration far from the solution.
    fn approach(&mut self, shape: &Shape, slope: &Slope) -> Result<Shape, Error> {
        let local = self.local(shape);
        let misfit = self.spring_misfit(shape, &local);
        let enough = (0.1 * self.stiffness * misfit)
            .max(self.frame.largest_force(&shape.force) * self.tolerance(shape));
        if largest(&local.gradient) > enough {
            return self.descend(shape, &local);
        }
        if !self.definite && !self.factorise(&local, NEUTRAL) {
            // The lowest mode is worth a step where little else is left.
            if largest(&local.gradient) > STATIONARY * local.typical() {
                return self.descend(shape, &local);
            }
            if let Some(next) = self.leave_saddle(shape, &local) {
                return Ok(next);
            }
        }
        (self.shift, self.definite) = (0.0, false);
        let force: Vec<f64> = local.soft.iter().map(|soft| soft.force).collect();
        if STIFFEN * misfit > self.misfit {
            self.stiffness *= STIFFEN;
            // Springs that strain by next to nothing are stiff enough for any solution.
            if self.stiffness * ZERO > self.frame.largest_force(&force) && misfit > NEAR {
                let (rod, off) = (&self.frame.rods[slope.worst], slope.misfit);
                let misfit_m = off * rod.length * self.frame.length_m;
                let not_closed = Error::NotClosed { member: slope.worst + 1, misfit_m };
                return Err(self.frame.jam(shape).unwrap_or(not_closed));
            }
        }
        self.misfit = misfit;
        Ok(Shape { x: shape.x.clone(), force })
    }

    /// The solution next to a shape, by Newton's method for places and forces; where lengths
    /// overdetermine it, the limit of stiff springs.
    fn finish(&mut self, shape: &Shape) -> Result<Option<Shape>, Error> {
        let exact = self.polish(shape);
        let absurd = exact.as_ref().and_then(|exact| self.frame.absurd(exact));
        let exact = exact.filter(|_| absurd.is_none());
        match self.limit(exact.as_ref().unwrap_or(shape), exact.is_some())? {
            Reading::Found(limit) if limit.fits() => {
                self.limit = Some(limit.clone());
                Ok(Some(limit.shape))
            }
            // Fewer lengths than places say nothing of each other: elsewhere they fit.
            Reading::Found(limit) if exact.is_none() && limit.has_enough(&self.frame) => {
                // What was taken for taut may be slack.
                let may_go = |rod: &Rod| rod.kind != Kind::Bar && !rod.ground;
                self.misfits += 1;
                if self.misfits <= MISFITS && self.frame.rods.iter().any(may_go) {
                    return Ok(None);
                }
                Err(Error::Misfit { misfits: limit.misfits })
            }
            Reading::Released(shape) => Ok(self.polish(&shape)),
            _ => absurd.map_or(Ok(exact), Err),
        }
    }

    /// Largest elongation of a spring, over the length of its member.
    fn spring_misfit(&self, shape: &Shape, local: &Local) -> f64 {
        let change = local.soft.iter().zip(&shape.force).map(|(soft, force)| soft.force - force);
        change.fold(0.0, |most: f64, change| most.max(change.abs())) / self.stiffness
    }

    /// One iteration.
    pub(super) fn iterate(&mut self, shape: &Shape, slope: &Slope) -> Result<Shape, Error> {
        self.frame.meter.check()?;
        self.since += 1;
        // Off a saddle the misfit need not become less than it was there.
        let again = slope.misfit <= NEAR && self.near < NEAR && self.since >= AGAIN;
        if slope.misfit <= self.near || again {
            if let Some(solution) = self.finish(shape)? {
                self.ended = true;
                return Ok(solution);
            }
            self.near = NEAR.min((0.1 * slope.misfit).max(STEP_ROUNDING));
            self.since = 0;
        }
        self.approach(shape, slope)
    }
}

#[cfg(test)]
mod tests;
