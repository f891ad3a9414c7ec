//! Newton's method on the condensed equations of a chain in tension: the minimum of a convex
//! function.

use super::settings::Settings;
use super::system::{Closure, System};
use crate::thresholds::BETTER;

/// A step that was much too short is lengthened by this factor.
const EXPANSION: f64 = 4.0;
/// Secants and steps stay away from the ends of their interval by this part of it.
pub(super) const MARGIN: f64 = 0.1;
/// Conditions up to this let the residual after a step be predicted; beyond, a tiny residual may
/// still ask for a long step.
const WELL_CONDITIONED: f64 = 1e4;
/// Residuals below this, in roundings, say nothing of the contraction.
const NOISE: f64 = 1e3;
/// How much the prediction of the next residual may be wrong.
const CAUTION: f64 = 10.0;
/// Passes that Newton's method may take before a nested search takes over.
pub(super) const NEWTON_PASSES: usize = 60;

/// A force that solves the condensed equations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Root {
    /// Force in the bottom bar, in the axes of the system.
    pub force: [f64; 2],
    /// The last closure computed, at this force or one quadratically small step before it.
    pub closure: Closure,
    /// Largest quotient of a residual and the square of the one before, in roundings, among full
    /// steps.
    pub contraction: f64,
}

/// What a solve may spend, and what is asked of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Budget {
    /// Passes over the bars so far.
    pub spent: usize,
    /// Passes at most.
    pub limit: usize,
    /// A closure, in total lengths, with which an iteration that gets no further is content.
    pub closure: f64,
}

impl Budget {
    pub fn of(settings: &Settings) -> Self {
        Self { spent: 0, limit: settings.max_passes, closure: settings.closure }
    }

    /// Spend a pass; false when none is left.
    pub fn spend(&mut self) -> bool {
        self.spent += 1;
        self.spent <= self.limit
    }
}

/// Let a method that may fail try with few passes, and count them.
pub(super) fn within_a_few_passes<T>(
    budget: &mut Budget,
    solve: impl FnOnce(&mut Budget) -> T,
) -> T {
    let limit = budget.limit.min(budget.spent + NEWTON_PASSES);
    let mut few = Budget { limit, ..*budget };
    let answer = solve(&mut few);
    budget.spent = few.spent;
    answer
}

/// Newton's method from a root found in other axes, as long as it gets closer.
pub(super) fn polish(system: &System<'_>, force: [f64; 2], budget: &mut Budget) -> Root {
    let mut root = Root { force, closure: system.closure(force), contraction: 0.0 };
    budget.spend();
    while let Some([x, y]) = root.closure.step() {
        let force = [root.force[0] + x, root.force[1] + y];
        let closure = system.closure(force);
        // A NaN is not closer.
        if !budget.spend() || closure.size().total_cmp(&root.closure.size()).is_ge() {
            break;
        }
        root = Root { force, closure, contraction: 0.0 };
    }
    root
}

/// Minimise $\Phi$ from `force` on.
///
/// `contraction` of the same chain made coarser lets the last pass be saved: the residual after the
/// next step is then predicted, not computed, by that or by its own, whichever is worse. `None`
/// when the passes ran out or rounding errors are larger than [`Closure::floor`] says and prevent a
/// closure within the budget, too.
pub(super) fn minimise(
    system: &System<'_>,
    force: [f64; 2],
    contraction: Option<f64>,
    budget: &mut Budget,
) -> Option<Root> {
    let mut root = Root { force, closure: system.closure(force), contraction: 0.0 };
    budget.spend();
    loop {
        let size = root.closure.size();
        if size <= 1.0 {
            return Some(root);
        }
        let Some(step) = root.closure.step() else {
            return system.settled(&root.closure, budget.closure).then_some(root);
        };
        if let Some(contraction) = contraction
            && CAUTION * contraction.max(root.contraction) * size * size <= 1.0
            && root.closure.condition() <= WELL_CONDITIONED
        {
            root.force = [root.force[0] + step[0], root.force[1] + step[1]];
            return Some(root);
        }
        match along(system, &root, step, budget) {
            Some((part, closure)) => {
                root.force = advance(root.force, step, part);
                root.closure = closure;
                if (part - 1.0).abs() <= f64::EPSILON && size > NOISE {
                    root.contraction = root.contraction.max(closure.size() / (size * size));
                }
            }
            None => return system.settled(&root.closure, budget.closure).then_some(root),
        }
    }
}

fn advance(from: [f64; 2], step: [f64; 2], part: f64) -> [f64; 2] {
    [from[0] + part * step[0], from[1] + part * step[1]]
}

/// Go along the step until the slope of $\Phi$, which rises from negative on, is near zero: no
/// values of $\Phi$ are compared, so no digits are lost next to the minimum.
fn along(
    system: &System<'_>,
    root: &Root,
    step: [f64; 2],
    budget: &mut Budget,
) -> Option<(f64, Closure)> {
    let slope = |closure: &Closure| closure.residual[0] * step[0] + closure.residual[1] * step[1];
    let first = slope(&root.closure);
    if first >= 0.0 || first.is_nan() {
        return None;
    }
    let size = root.closure.size();
    let (mut low, mut slope_low) = (0.0, first);
    let mut high: Option<(f64, f64)> = None;
    let mut part = 1.0;
    loop {
        if !budget.spend() {
            return None;
        }
        let closure = system.closure(advance(root.force, step, part));
        let here = slope(&closure);
        if here.abs() <= BETTER * first.abs() || closure.size() <= BETTER * size {
            return Some((part, closure));
        }
        // A NaN counts as too far.
        if here < 0.0 {
            (low, slope_low) = (part, here);
        } else {
            high = Some((part, here));
        }
        let next = match high {
            None => part * EXPANSION,
            Some((high, slope_high)) => {
                let secant = slope_low / (slope_low - slope_high);
                let secant = if secant.is_finite() { secant } else { 0.5 };
                low + (high - low) * secant.clamp(MARGIN, 1.0 - MARGIN)
            }
        };
        if (next - part).abs() <= f64::EPSILON * part || !next.is_finite() {
            return None;
        }
        part = next;
    }
}

#[cfg(test)]
mod tests;
