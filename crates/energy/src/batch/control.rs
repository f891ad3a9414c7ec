//! What a lane does next: correct the closure, accept, halve the step, or end.
#![expect(
    clippy::inline_always,
    reason = "a pass over the bars is fast only as one loop of vector instructions"
)]

use super::BatchSettings;
use crate::thresholds::{ARMIJO, BISECTIONS, CORRECTIONS, LOST, ZERO};

/// Largest turn of a bar in one correction or step.
const LARGEST_TURN: f64 = 0.7;
/// Damping of a correction, in squares of the gap: it vanishes faster than the gap does.
const DAMPING: f64 = 0.1;
/// Corrections of a seed, which may be anywhere, before it is perturbed: six are usual; bars in
/// parallel turn together towards the line of the gap, ever more slowly.
const SEED_CORRECTIONS: usize = 25;
/// Perturbations off points that are stationary and no minima, and their size, rad.
const PERTURBATIONS: u32 = 8;
const PERTURBATION: f64 = 0.01;
/// Where one lane is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Lane {
    /// Its seed; `usize::MAX` when there is none left.
    pub(crate) seed: usize,
    /// Trials measured.
    pub(crate) trials: u32,
    /// Corrections of the closure in this trial.
    corrections: usize,
    halvings: usize,
    perturbations: u32,
    /// Steps since the slope was zero to the tolerance and the chain a minimum. They are quadratic, but where the second
    /// derivative vanishes: there each takes a part of the way.
    settling: usize,
    /// Part of the step on trial.
    part: f64,
    /// Energy at the accepted chain; infinite before there is one.
    value: f64,
    /// Its first-order change by the whole step.
    fall: f64,
    /// Largest slope at the accepted chain.
    pub(crate) slope: f64,
}

/// What to do with a lane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Next {
    /// Turn the bars of the trial by $-t_i\cdot\nu$.
    Correct([f64; 2]),
    /// The trial is the new base; slopes are wanted.
    Accept,
    /// From the base, by this part of the step.
    Step(f64),
    /// From the base, by this times i + 1.
    Perturb(f64),
    /// It is a minimum.
    Minimum,
    /// Out of trials.
    IterationLimit,
    /// Nothing helps.
    Stalled,
    /// Not a number.
    NonFinite,
}

impl Lane {
    /// At the start of a seed.
    pub(crate) fn new(seed: usize) -> Self {
        Self { seed, value: f64::INFINITY, slope: f64::INFINITY, ..Self::default() }
    }

    /// After a measurement of the trial.
    #[inline(always)]
    pub(crate) fn measured(
        &mut self,
        settings: &BatchSettings,
        gap: [f64; 2],
        spread: [f64; 3],
        value: f64,
    ) -> Next {
        self.trials += 1;
        let square = gap[0] * gap[0] + gap[1] * gap[1];
        if !square.is_finite() {
            return Next::NonFinite;
        }
        if self.trials > settings.max_iterations {
            return Next::IterationLimit;
        }
        if square <= settings.closure * settings.closure {
            // Rounding errors of the energy must not stop a step that promises less than they are.
            if value <= self.value + ARMIJO * self.part * self.fall + LOST
                || self.value.is_infinite()
            {
                self.value = value;
                return Next::Accept;
            }
            return self.halve();
        }
        let started = self.value.is_finite();
        self.corrections += 1;
        if self.corrections > if started { CORRECTIONS } else { SEED_CORRECTIONS } {
            return if started { self.halve() } else { self.perturb() };
        }
        let damping = DAMPING * square;
        let [a, b, d] = [spread[0] + damping, spread[1], spread[2] + damping];
        let inverse = 1.0 / (a * d - b * b);
        let pull = [(d * gap[0] - b * gap[1]) * inverse, (a * gap[1] - b * gap[0]) * inverse];
        // No turn is larger than the pull.
        let size = (pull[0] * pull[0] + pull[1] * pull[1]).sqrt();
        if !size.is_finite() {
            return if started { self.halve() } else { self.perturb() };
        }
        // All bars along the gap: no turn closes it to first order.
        if !started && parallel(spread, gap, square) {
            return self.perturb();
        }
        let part = if size > LARGEST_TURN { LARGEST_TURN / size } else { 1.0 };
        Next::Correct([pull[0] * part, pull[1] * part])
    }

    /// After the slopes at an accepted chain: what now.
    #[inline(always)]
    pub(crate) fn accepted(
        &mut self,
        settings: &BatchSettings,
        slope: f64,
        convex: bool,
        largest_turn: f64,
        fall: f64,
    ) -> Next {
        self.slope = slope;
        self.halvings = 0;
        self.corrections = 0;
        if slope.is_nan() {
            return Next::NonFinite;
        }
        let here = slope <= settings.tolerance;
        if here && !convex && self.settling == 0 {
            return self.perturb();
        }
        if here {
            let goes_on = convex && largest_turn > ZERO && self.settling < BISECTIONS && fall < 0.0;
            if !(goes_on && largest_turn.is_finite()) {
                return Next::Minimum;
            }
            self.settling += 1;
        }
        if !(largest_turn.is_finite() && fall < 0.0) {
            return self.perturb();
        }
        self.fall = fall;
        self.part = if largest_turn > LARGEST_TURN { LARGEST_TURN / largest_turn } else { 1.0 };
        Next::Step(self.part)
    }

    pub(super) fn halve(&mut self) -> Next {
        self.corrections = 0;
        self.halvings += 1;
        self.part *= 0.5;
        if self.halvings <= BISECTIONS {
            Next::Step(self.part)
        } else if self.settling > 0 {
            Next::Minimum
        } else {
            Next::Stalled
        }
    }

    pub(super) fn perturb(&mut self) -> Next {
        self.perturbations += 1;
        self.settling = 0;
        // What is closed after a perturbation is the new base, whatever its energy.
        self.value = f64::INFINITY;
        self.corrections = 0;
        if self.perturbations > PERTURBATIONS {
            Next::Stalled
        } else {
            Next::Perturb(PERTURBATION * f64::from(self.perturbations))
        }
    }
}

/// Whether the spread is so small along the gap that only rounding turns the bars.
pub(super) fn parallel([a, b, d]: [f64; 3], gap: [f64; 2], square: f64) -> bool {
    const LEAST: f64 = 1e-12;
    let along = a * gap[0] * gap[0] + 2.0 * b * gap[0] * gap[1] + d * gap[1] * gap[1];
    along <= LEAST * square
}

#[cfg(test)]
mod tests;
