//! The last digits where some bars carry next to nothing.
//!
//! The minimiser holds forces against the largest force of the chain, and that is where double
//! precision ends: a rest `t` of the gradient turns a bar with the axial force `N` by `t / N`. The
//! equations have more digits to give, since the energy may be counted from any bar (a multiple of the
//! closure is taken off, see [`ScaledChain`]). So, where it matters,
//!
//! 1. the weights are counted from the bar with the least load, as sums of the weights in between:
//!    what the bars near it carry is then a sum of small numbers, not a difference of large ones;
//! 2. Newton's method is applied to stationarity and closure at once (`P_i = I - u_i u_iᵀ`):
//!
//! ```text
//! [ l N   Jᵀ ] [ du  ]   [ -l t ]
//! [  J    0  ] [ dmu ] = [ -gap ]      J = [ l_1 P_1 ... l_n P_n ]
//! ```
//!
//! Where bars carry so little that the minimiser leaves them anywhere, this does not converge; they
//! are minimised by themselves first, between heavy bars that do not feel them. The vertical force
//! never rises along a chain, and the level one is the same everywhere: such bars stand in a row.
//!
//! Every equilibrium lies in a vertical plane, so the closure has two rows here. The size of the
//! last step is how far the shape is known.

use std::cmp::Ordering;
use std::ops::Range;
use std::sync::Arc;

use model::{Bar, Problem, Vector};

use crate::error::Error;
use crate::lever;
use crate::run::closure::Shape;
use crate::run::minimise::{Minimum, descend};
use crate::run::reaction::lift_from;
use crate::run::scaled_chain::{Origin, ScaledChain, Units};
use crate::run::settings::Settings;
use crate::run::slope::Slope;
use crate::run::vertical_plane::Turn;
use crate::thresholds::{BISECTIONS, FORCE_ROUNDING, ROUNDING, ZERO};
use crate::vector::{along, dot, norm, scaled, tangent};

/// Turn of a bar, rad, above which the minimiser's digits are not enough: a quarter of what two
/// solvers are asked to agree to, since a long bar turns its joint by as much of the whole length.
const WORTH_REFINING: f64 = 2.5e-11;

/// A step that turns a bar by more than this, rad, leaves the neighbourhood of the minimum.
const LARGEST_TURN: f64 = 0.5;

/// Bars that carry this part of the largest force or less are minimised by themselves where they
/// have to: of the others, what these pull, they change no more than Newton's method makes up for.
pub(crate) const LIGHT: f64 = 1e-6;

/// A minimum with its units and frame, refined if that is needed; and the turn, rad, by which a bar is
/// not known, where that was asked.
pub(crate) fn refine(
    problem: &Problem,
    units: Units,
    minimum: Minimum,
    settings: &Settings,
) -> Result<(Minimum, Units, Option<f64>), Error> {
    let Minimum { slope, unsettled, .. } = &minimum;
    // Bars without any load have no direction of their own.
    let light = slope.across / slope.softest > WORTH_REFINING;
    if !(light || unsettled.is_some()) {
        return Ok((minimum.settled()?, units, None));
    }
    let point = Point::new(problem, &units, &minimum);
    let first = point.step().map_or(f64::NAN, |step| step.largest);
    if unsettled.is_none() && first <= WORTH_REFINING {
        return Ok((minimum.settled()?, units, None));
    }
    let refined = |mut point: Point| {
        let last = point.refined(problem)?;
        let (found, units) = point.into_minimum(&minimum);
        let curvature = found.curvature();
        // Newton's method finds any stationary point.
        (curvature.index(curvature.slope.zero) == 0).then_some((found, units, Some(last)))
    };
    let by_themselves = || {
        let mut anew = Point::new(problem, &units, &minimum);
        anew.lightest(settings).and_then(|()| refined(anew))
    };
    if let Some(refined) = refined(point).or_else(by_themselves) {
        return Ok(refined);
    }
    // Bars without force to rounding hang free: any direction of theirs is an equilibrium as far as
    // doubles tell, and the answer is one of them.
    let unknown_rad = (slope.softest > FORCE_ROUNDING * slope.pull).then_some(first);
    Ok((minimum.settled()?, units, unknown_rad))
}

/// A point of the unknowns: directions in the plane, and the multiplier.
pub(crate) struct Point {
    pub(crate) links: ScaledChain,
    units: Units,
    pub(crate) shape: Shape,
    pub(crate) multiplier: Vector,
}

/// A step of Newton's method.
struct Step {
    turns: Vec<Vector>,
    multiplier: Vector,
    /// Largest turn of a bar, rad.
    largest: f64,
}

impl Point {
    fn new(problem: &Problem, units: &Units, minimum: &Minimum) -> Self {
        let Minimum { links, shape, slope, .. } = minimum;
        let size = |i: usize| norm(links.load(i, slope.multiplier));
        let bar = (0..links.bars()).min_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(0);
        let turn = Turn::into_plane(links, &shape.u);
        let u = turn.flattened(&shape.u);
        let multiplier = turn.of(&[slope.multiplier])[0];
        let multiplier = along(multiplier, links.carried[bar], links.up);
        let links = ScaledChain { carried: counted_from(problem, bar), ..(**links).clone() };
        let units = Units {
            frame: units.frame.turned(
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| turn.back(axis)),
            ),
            origin: Some(Origin { bar, carried: minimum.links.carried[bar] }),
            ..*units
        };
        let moments = links.measure(&u);
        Self { links, units, shape: Shape { u, moments }, multiplier }
    }

    /// Newton's step; `None` if a number is not finite.
    fn step(&self) -> Option<Step> {
        let links = &self.links;
        let (mut xx, mut xz, mut zz, mut rest) = (0.0, 0.0, 0.0, [0.0; 3]);
        let at: Vec<(Vector, f64)> = (self.shape.u.iter().enumerate())
            .map(|(i, &u)| {
                let load = links.load(i, self.multiplier);
                let (t, axial) = (tangent(u, load), -dot(load, u));
                let w = links.length[i] / axial;
                xx += w * (u[2] * u[2]);
                xz -= w * (u[0] * u[2]);
                zz += w * (u[0] * u[0]);
                rest = along(rest, w, t);
                (t, axial)
            })
            .collect();
        let gap = along(self.shape.moments.gap, -1.0, rest);
        let determinant = xx * zz - xz * xz;
        let multiplier = [
            (zz * gap[0] - xz * gap[2]) / determinant,
            0.0,
            (xx * gap[2] - xz * gap[0]) / determinant,
        ];
        let turns: Vec<Vector> = (self.shape.u.iter().zip(at))
            .map(|(&u, (t, axial))| scaled(-1.0 / axial, along(t, 1.0, tangent(u, multiplier))))
            .collect();
        let sum: f64 = turns.iter().map(|turn| dot(*turn, *turn)).sum();
        let largest = turns.iter().fold(0.0_f64, |most, turn| most.max(norm(*turn)));
        (sum.is_finite() && norm(multiplier).is_finite()).then_some(Step {
            turns,
            multiplier,
            largest,
        })
    }

    /// Down to the last digits that there are; how far the shape is not known then, rad.
    fn refined(&mut self, problem: &Problem) -> Option<f64> {
        self.straightened(problem.chain()).or_else(|| self.newton().filter(|_| self.closed()))
    }

    /// Newton's method; the smallest step made, rad, or `None` if it leaves the neighbourhood.
    fn newton(&mut self) -> Option<f64> {
        let (mut turn, mut last) = (f64::INFINITY, f64::INFINITY);
        // Quadratic convergence takes five steps; where a bar without force makes the minimum degenerate each halves the error.
        for _ in 0..BISECTIONS {
            let step = self.step()?;
            // A bar without any force answers rounding by any turn, once all others are right.
            if turn <= ZERO && step.largest > ZERO {
                break;
            }
            if step.largest > LARGEST_TURN {
                return None;
            }
            let size = step.largest.max(norm(step.multiplier) / norm(self.multiplier));
            self.shape = self.links.moved(&self.shape.u, |i, _| step.turns[i]);
            self.multiplier = along(self.multiplier, 1.0, step.multiplier);
            turn = turn.min(step.largest);
            if size <= ROUNDING || (last <= ZERO && size > 0.5 * last) {
                break;
            }
            last = size;
        }
        Some(turn)
    }

    /// The bars that carry next to nothing minimised by themselves, the lightest of them last;
    /// `None` where there are none, or that fails.
    fn lightest(&mut self, settings: &Settings) -> Option<()> {
        let (mut run, mut found) = (0..self.links.bars(), None);
        loop {
            let light = self.light(&run);
            if light.len() < 2 || light.len() == run.len() {
                return found;
            }
            run = light;
            let (part, turn) = self.links.part(run.clone(), &self.shape.u)?;
            let Minimum { shape, slope, .. } =
                descend(part, turn.of(&self.shape.u[run.clone()]), settings).ok()?;
            for (u, new) in self.shape.u[run.clone()].iter_mut().zip(&shape.u) {
                *u = turn.back(*new);
            }
            self.shape.moments = self.links.measure(&self.shape.u);
            // A part counts its weights from its middle, in units of what is between its ends.
            let (first, last) = (self.links.carried[run.start], self.links.carried[run.end - 1]);
            let multiplier = scaled(first - last, turn.back(slope.multiplier));
            self.multiplier = along(multiplier, -0.5 * (first + last), self.links.up);
            found = Some(());
        }
    }

    /// The bars of a run around its least loaded one that carry next to nothing of its largest load.
    fn light(&self, run: &Range<usize>) -> Range<usize> {
        let load = |i: usize| norm(self.links.load(i, self.multiplier));
        let most = run.clone().map(load).fold(0.0, f64::max);
        let is_light = |i: &usize| load(*i) <= LIGHT * most;
        let first = run.clone().find(is_light).unwrap_or(run.end);
        first..run.clone().rfind(is_light).map_or(first, |last| last + 1)
    }

    fn into_minimum(self, minimum: &Minimum) -> (Minimum, Units) {
        let Self { links, units, shape, multiplier } = self;
        let slope = Slope::refined(&links, &shape.u, multiplier);
        let refined = Minimum {
            links: Arc::new(links),
            shape: Arc::new(shape),
            slope: Arc::new(slope),
            iterations: minimum.iterations,
            evaluations: minimum.evaluations,
            unsettled: None,
        };
        (refined, units)
    }
}

/// What each bar carries less what `bar` carries, in units of the total weight: the weights in
/// between.
fn counted_from(problem: &Problem, bar: usize) -> Vec<f64> {
    let between = lift_from(problem, bar);
    let carried = |(i, here): (usize, &Bar)| {
        let part = here.mass_kg() / problem.chain().total_mass_kg();
        match i.cmp(&bar) {
            Ordering::Less => part * lever::at_last(here) - between[i + 1],
            Ordering::Equal => 0.0,
            Ordering::Greater => -(between[i] + part * lever::at_first(here)),
        }
    };
    problem.chain().bars().iter().enumerate().map(carried).collect()
}

#[cfg(test)]
mod tests;
