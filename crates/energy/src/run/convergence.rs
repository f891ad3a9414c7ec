//! What the minimiser has learnt: when to stop, and how bold the next step may be.

use crate::run::closure::Shape;
use crate::run::curvature::Curvature;
use crate::run::settings::Settings;
use crate::run::slope::Slope;
use crate::thresholds::{GRADIENT_PART, STEP_ROUNDING};
use crate::vector::norm;

/// How often the whole chain may turn towards its plane when the energy it wins is below its noise:
/// Newton's method mends what each turn does to the gradient, and each brings the plane nearer by
/// the distance of the verticals.
const BLIND_TURNS: usize = 16;

/// Factors of the shift after a good step, and after a failure or while the Hessian is not positive definite.
const SHIFT_DOWN: f64 = 0.1;
/// See [`SHIFT_DOWN`].
const SHIFT_UP: f64 = 4.0;

/// What an iterate is, by its first and second derivative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Iterate {
    /// The gradient or the closure is above its tolerance.
    Sloping,
    /// Stationary, and the energy falls along some motion: a saddle or a maximum.
    Saddle,
    /// A minimum within the tolerances, worth one more step: it brings the digits that the
    /// tolerances leave out.
    Near,
    /// A minimum to rounding, or one that has had its last step.
    Minimum,
}

/// What the iterations so far have learnt.
#[derive(Debug)]
pub(crate) struct Convergence {
    settings: Settings,
    /// Shift of the Hessian that made the last steps good.
    pub(crate) shift: f64,
    /// Whether the step that a minimum within the tolerances is worth was made.
    polished: bool,
    /// Whether the last iteration turned the whole chain.
    pub(crate) turned: bool,
    /// Turns made without the energy being able to tell.
    blind_turns: usize,
}

impl Convergence {
    pub(crate) fn new(settings: Settings) -> Self {
        Self { settings, shift: 0.0, polished: false, turned: false, blind_turns: 0 }
    }

    /// Whether the projected gradient and the closure are below their tolerances.
    pub(crate) fn stationary(&self, shape: &Shape, slope: &Slope) -> bool {
        slope.residual() <= self.settings.gradient_tolerance && self.closed(shape)
    }

    /// Whether the closure is below its tolerance.
    pub(crate) fn closed(&self, shape: &Shape) -> bool {
        norm(shape.moments.gap) <= self.settings.closure_tolerance
    }

    /// What the iterate is. Asking uses up the one step more.
    pub(crate) fn judge(&mut self, curvature: &Curvature) -> Iterate {
        let (shape, slope) = (&curvature.shape, &curvature.slope);
        if !self.stationary(shape, slope) {
            return Iterate::Sloping;
        }
        if curvature.index(slope.zero) > 0 {
            return Iterate::Saddle;
        }
        if self.polished || slope.residual() <= STEP_ROUNDING {
            return Iterate::Minimum;
        }
        self.polished = true;
        Iterate::Near
    }

    /// Whether one more turn may be made that the energy cannot judge.
    pub(crate) fn may_turn_blindly(&mut self) -> bool {
        let may = self.blind_turns < BLIND_TURNS;
        self.blind_turns += usize::from(may);
        may
    }

    /// A saddle was left: what was learnt on it is of no use.
    pub(crate) fn left_saddle(&mut self) {
        self.shift = 0.0;
        self.polished = false;
    }

    /// A step was as good as its prediction.
    pub(crate) fn good_step(&mut self, next: &Slope) {
        self.shift = (SHIFT_DOWN * self.shift).min(next.mean);
    }

    /// A step failed.
    pub(crate) fn failed_step(&mut self, slope: &Slope) {
        self.shift = (SHIFT_UP * self.shift).max(GRADIENT_PART * slope.mean);
    }

    /// The shifted Hessian is not positive definite. A shift beyond the safe one is never needed; a
    /// smaller one often does.
    pub(crate) fn indefinite(&mut self, curvature: &Curvature) {
        let next = (SHIFT_UP * self.shift).max(GRADIENT_PART * curvature.slope.mean);
        let safe = curvature.safe_shift();
        self.shift = if self.shift < safe { next.min(safe) } else { next };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blind_turns_come_to_an_end() {
        let mut convergence = Convergence::new(Settings::default());
        let blind = (0..100).filter(|_| convergence.may_turn_blindly()).count();
        assert_eq!(blind, BLIND_TURNS);
    }
}
