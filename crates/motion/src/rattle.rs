//! One step of RATTLE.
//!
//! $$ M (x_1 - x_0) = h M v_0 + \tfrac{h^2}{2} (f_0 - R_0^T \rho), \quad g(x_1) = 0, $$
//! $$ v_{1/2} = (x_1 - x_0)/h, \quad
//!    M v_1 = M v_{1/2} + \tfrac h2 (f_1 - R_1^T \sigma), \quad R_1 v_1 = 0 $$
//!
//! (H. C. Andersen, J. Comput. Phys. 52 (1983) 24-34; symplectic and symmetric: B. Leimkuhler, R.
//! Skeel, J. Comput. Phys. 112 (1994) 117-125). The nonlinear equation is solved by the iteration
//! with the matrix of the beginning of the step, which is factorised already: each iteration costs
//! one elimination without factorisation and gains the factor `h |v| / l`. Where that is not less
//! than one, near positions where constraints depend on each other, corrections are Newton's.

use model::Vector;

use crate::error::Result;
use crate::force::Forces;
use crate::krylov;
use crate::mechanism::{Link, Mechanism, Rigid};
use crate::saddle::{Saddle, Singular};
use crate::simulation::at_the_beginning;
use crate::state::{State, curvature, half_excess, squared};
use numerics::vector::{dot, minus, norm, plus, worse};

/// Largest relative violation of a length, and of its derivative in units of the largest speed,
/// after any step.
pub const CONSTRAINT_TOLERANCE: f64 = 1e-12;

/// Violation that is rounding: `d · d` of a vector with its last digits wrong.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Corrections after which a step is given up: at a gain of 1.4 each they reach the rounding.
const MOST_CORRECTIONS: usize = 100;

/// A correction that leaves more of the violation than this is followed by one of Newton's.
const SLOW: f64 = 0.5;

/// Part of its length that an end of a bar turns at most in a step that needs Newton's corrections:
/// they would also find the positions that a motion does not lead to.
const LARGEST_TURN: f64 = 0.5;

/// Halvings of a step whose lengths are not met; one that needs more is too long for what it shows.
const HALVINGS: u32 = 4;

/// A span of a rope that is shorter than this, in units of its mean span, has no direction.
const NO_SPAN: f64 = 1e-9;

/// What a step needs and keeps.
pub(crate) struct Stepper {
    pub mechanism: Mechanism,
    saddle: Saddle,
    /// Vectors of the rows at the present places, factorised: one for each rigid span and slide.
    pub vectors: Vec<Vector>,
    /// Forces at the present places and time.
    pub force: Vec<Vector>,
    /// Displacement of the step, its correction, right-hand sides of the rows.
    by: Vec<Vector>,
    x: Vec<Vector>,
    rows: Vec<f64>,
    /// Largest relative violations after the last step: lengths, and their derivatives.
    pub off: [f64; 2],
    /// Corrections of the last step.
    pub corrections: usize,
}

/// Why a step failed, without the time.
#[derive(Clone, Copy)]
pub(crate) enum Failure {
    Singular(Singular),
    NotMet {
        corrections: usize,
        off: f64,
    },
    /// A span of a taut rope has no length.
    Jammed {
        span: Link,
    },
}

impl Stepper {
    pub(crate) fn new(mechanism: Mechanism) -> Result<Self> {
        let slots = mechanism.joint_at.len();
        Ok(Self {
            saddle: Saddle::new(&mechanism)?,
            vectors: vec![[0.0; 3]; mechanism.vectors()],
            force: mechanism.load.clone(),
            by: vec![[0.0; 3]; slots],
            x: vec![[0.0; 3]; slots],
            rows: vec![0.0; mechanism.constraints()],
            off: [0.0; 2],
            corrections: 0,
            mechanism,
        })
    }

    /// The error of something that was no step.
    pub(crate) fn told<T>(&self, done: Result<T, Failure>) -> Result<T> {
        done.map_err(|failure| at_the_beginning(&self.mechanism, failure))
    }

    /// Take over the places: vectors of the rows, their factors, the forces.
    pub(crate) fn arrive(
        &mut self,
        state: &State,
        forces: &Forces,
        time_s: f64,
    ) -> Result<(), Failure> {
        self.off[0] = state.rows(&self.mechanism, &mut self.vectors);
        no_jam(&self.mechanism, state)?;
        forces.at(&self.mechanism, state, time_s, &mut self.force);
        self.saddle.factor(&self.vectors).map_err(Failure::Singular)
    }

    /// A step of the length `h`, of either sign, in halves of halves where a longer one does not meet the lengths.
    pub(crate) fn step(
        &mut self,
        state: &mut State,
        forces: &Forces,
        time_s: f64,
        h: f64,
    ) -> Result<(), Failure> {
        self.step_in_halves(state, forces, [time_s, h], HALVINGS)
    }

    fn step_in_halves(
        &mut self,
        state: &mut State,
        forces: &Forces,
        [time_s, h]: [f64; 2],
        halvings: u32,
    ) -> Result<(), Failure> {
        let moving = self.mechanism.moving;
        for (by, v) in self.by.iter_mut().zip(&state.velocity) {
            *by = v.map(|v| h * v);
        }
        let before = self.excess(state);
        for (x, f) in self.x[..moving].iter_mut().zip(&self.force) {
            *x = f.map(|f| 0.5 * h * h * f);
        }
        self.correct(moving);
        let met = self.meet(state, before);
        // A span that has turned round has passed the joint at its end.
        jammed(&self.mechanism, state, |s, d| {
            dot(d, plus(d, minus(self.by[s.b], self.by[s.a]))) <= 0.0
        })?;
        if halvings > 0 && matches!(met, Err(Failure::NotMet { .. })) {
            // The state is as it was, and so are its factors.
            let half = 0.5 * h;
            self.step_in_halves(state, forces, [time_s, half], halvings - 1)?;
            return self.step_in_halves(state, forces, [time_s + half, half], halvings - 1);
        }
        met?;
        state.displace(&self.by[..moving]);
        for (v, by) in state.velocity.iter_mut().zip(&self.by) {
            *v = by.map(|by| by / h);
        }
        self.arrive(state, forces, time_s + h)?;
        for (x, f) in self.x[..moving].iter_mut().zip(&self.force) {
            *x = f.map(|f| 0.5 * h * f);
        }
        self.settle(state)?;
        if self.off[0].is_nan() || self.off[0] > CONSTRAINT_TOLERANCE {
            return Err(Failure::NotMet { corrections: self.corrections, off: self.off[0] });
        }
        Ok(())
    }

    /// Correct the displacement until the lengths are met.
    fn meet(&mut self, state: &State, mut before: f64) -> Result<(), Failure> {
        let moving = self.mechanism.moving;
        for corrections in 1.. {
            self.corrections = corrections;
            let off = self.excess(state);
            // Rounding may stay above its usual size; then corrections gain nothing.
            let stalled = off <= 0.01 * CONSTRAINT_TOLERANCE && off >= 0.5 * before;
            if off <= ROUNDING || stalled {
                break;
            }
            if off.is_nan() || corrections > MOST_CORRECTIONS {
                return Err(Failure::NotMet { corrections, off });
            }
            // The first one had the forces in it, and corrected what the velocities violate.
            if corrections > 1 && off > SLOW * before {
                if off > before {
                    self.undo(moving);
                    self.excess(state);
                }
                self.newton(state).map_err(|()| Failure::NotMet { corrections, off })?;
            } else {
                self.x[..moving].fill([0.0; 3]);
                self.correct(moving);
            }
            before = off;
        }
        Ok(())
    }

    /// Right-hand sides `−g` at the displaced places; the largest violation.
    fn excess(&mut self, state: &State) -> f64 {
        let (mut off, by) = (0.0, &self.by);
        let moved = |s: &Link, d: Vector| plus(d, minus(by[s.b], by[s.a]));
        for (bar, row) in self.mechanism.bars.iter().zip(&mut self.rows) {
            let squared = match self.mechanism.of(&bar.spans) {
                // The span is the vector of the row.
                [span] => {
                    let d = moved(span, self.vectors[bar.spans.start]);
                    dot(d, d)
                }
                spans => squared(spans.iter().map(|s| moved(s, state.between(s.a, s.b)))),
            };
            let excess = half_excess(squared, bar.length_m);
            *row = -excess * bar.length_m * bar.length_m;
            off = worse(off, excess.abs());
        }
        let rows = &mut self.rows[self.mechanism.bars.len()..];
        for (slide, row) in self.mechanism.slides.iter().zip(rows) {
            *row = -dot(slide.normal, self.by[slide.slot]);
        }
        off
    }

    /// Solve, and add to the displacement.
    fn correct(&mut self, moving: usize) {
        self.saddle.solve(&mut self.x[..moving], &mut self.rows);
        for (by, x) in self.by.iter_mut().zip(&self.x[..moving]) {
            *by = plus(*by, *x);
        }
    }

    /// Take back the last correction.
    fn undo(&mut self, moving: usize) {
        for (by, x) in self.by.iter_mut().zip(&self.x[..moving]) {
            *by = minus(*by, *x);
        }
    }

    /// A correction with the vectors at the displaced places (of the momentum, those of the
    /// beginning of the step stay), where the iteration with the old ones gains too little: the
    /// step passes a position where constraints depend on each other.
    ///
    /// The equation `R₁ M⁻¹ R₀ᵀ ν = −g` is solved with the factors of `R₀ M⁻¹ R₀ᵀ` as
    /// preconditioner. The product of the two has its eigenvalues near 1 and, for the directions
    /// that lose their constraint at a distance `δ` from where they do, near `δ₁/δ₀`: two clusters.
    fn newton(&mut self, state: &State) -> Result<(), ()> {
        let moving = self.mechanism.moving;
        let rigid = &self.mechanism.spans[..self.mechanism.rigid_spans()];
        let turned = |span: &Link| norm(minus(self.by[span.b], self.by[span.a])) / span.length_m;
        if rigid.iter().any(|span| turned(span) > LARGEST_TURN) {
            return Err(());
        }
        let (mut displaced, mut ahead) = (state.clone(), self.vectors.clone());
        displaced.displace(&self.by[..moving]);
        displaced.rows(&self.mechanism, &mut ahead);
        let far = self.mechanism.system.total_length_m();
        let bars = self.mechanism.bars.iter();
        let mut unit: Vec<f64> = bars.map(|bar| bar.length_m * bar.length_m).collect();
        unit.resize(self.rows.len(), far);
        let right: Vec<f64> = self.rows.iter().zip(&unit).map(|(row, unit)| row / unit).collect();
        let (saddle, x, rows) = (&mut self.saddle, &mut self.x, &mut self.rows);
        let mut displaced = |z: &[f64]| {
            for ((row, z), unit) in rows.iter_mut().zip(z).zip(&unit) {
                *row = z * unit;
            }
            x[..moving].fill([0.0; 3]);
            saddle.solve(&mut x[..moving], rows);
            // Slots of anchors are never displaced.
            let bars = self.mechanism.bars.iter();
            let mut out: Vec<f64> = bars.map(|bar| rate(&self.mechanism, bar, &ahead, x)).collect();
            out.extend(self.mechanism.slides.iter().map(|slide| dot(slide.normal, x[slide.slot])));
            out.iter_mut().zip(&unit).for_each(|(out, unit)| *out /= unit);
            out
        };
        let found = krylov::solve(&mut displaced, &right);
        displaced(&found);
        for (by, x) in self.by.iter_mut().zip(&self.x[..moving]) {
            *by = plus(*by, *x);
        }
        Ok(())
    }

    /// Add `x` to the velocities as an impulse (its inertia divided out), and take out what changes
    /// lengths.
    pub(crate) fn settle(&mut self, state: &mut State) -> Result<(), Failure> {
        let moving = self.mechanism.moving;
        let mut corrections = 0;
        self.rates(state);
        loop {
            self.saddle.solve(&mut self.x[..moving], &mut self.rows);
            for (v, x) in state.velocity.iter_mut().zip(&self.x[..moving]) {
                *v = plus(*v, *x);
            }
            corrections += 1;
            let rate = self.rates(state);
            let speed = state.largest_speed();
            self.off[1] = if speed > 0.0 { rate / speed } else { rate };
            if self.off[1] <= 0.1 * CONSTRAINT_TOLERANCE {
                return Ok(());
            }
            if self.off[1].is_nan() || corrections > MOST_CORRECTIONS {
                return Err(Failure::NotMet { corrections, off: self.off[1] });
            }
            self.x[..moving].fill([0.0; 3]);
        }
    }

    /// Right-hand sides `−R v`; the largest `d · w / l`, a speed.
    fn rates(&mut self, state: &State) -> f64 {
        let v = &state.velocity;
        let mut off = 0.0;
        for (bar, row) in self.mechanism.bars.iter().zip(&mut self.rows) {
            let rate = rate(&self.mechanism, bar, &self.vectors, v);
            *row = -rate;
            off = worse(off, rate.abs() / bar.length_m);
        }
        let rows = &mut self.rows[self.mechanism.bars.len()..];
        for (slide, row) in self.mechanism.slides.iter().zip(rows) {
            let rate = dot(slide.normal, v[slide.slot]);
            *row = -rate;
            off = worse(off, rate.abs());
        }
        off
    }

    /// The multipliers of the rows that a push makes, N s/m: of a member its axial impulse over its
    /// length, tension positive.
    pub(crate) fn impulses(&mut self, state: &State, impulses: &[Vector]) -> Vec<f64> {
        let moving = self.mechanism.moving;
        self.rates(state);
        self.x[..moving].copy_from_slice(&impulses[..moving]);
        self.saddle.solve(&mut self.x[..moving], &mut self.rows);
        self.rows.clone()
    }

    /// Change the velocities by impulses, N s by slot, under the constraints.
    pub(crate) fn push(&mut self, state: &mut State, impulses: &[Vector]) -> Result<(), Failure> {
        let moving = self.mechanism.moving;
        self.x[..moving].copy_from_slice(&impulses[..moving]);
        self.settle(state)
    }

    /// Accelerations by slot, m/s², and multipliers `ρ` of the rows: `M a + Rᵀ ρ = f`, `R a = −Ṙ
    /// v`.
    ///
    /// Of a rigid member `ρ` is the force density, its axial force over its length, tension
    /// positive.
    pub(crate) fn accelerations(
        &mut self,
        state: &State,
        extra: &[Vector],
    ) -> (Vec<Vector>, Vec<f64>) {
        let v = &state.velocity;
        let mut a: Vec<Vector> =
            self.force.iter().zip(extra).map(|(force, extra)| plus(*force, *extra)).collect();
        let mut rho = vec![0.0; self.rows.len()];
        for (bar, row) in self.mechanism.bars.iter().zip(&mut rho) {
            let spans = self.mechanism.of(&bar.spans).iter();
            *row = -curvature(spans.map(|s| [state.between(s.a, s.b), minus(v[s.b], v[s.a])]));
        }
        self.saddle.solve(&mut a[..self.mechanism.moving], &mut rho);
        a[self.mechanism.moving..].fill([0.0; 3]);
        (a, rho)
    }

    /// Bring places onto the lengths by corrections that are least in the metric of the inertia.
    pub(crate) fn assemble(&mut self, state: &mut State, most: usize) -> Result<(), Failure> {
        let moving = self.mechanism.moving;
        let mut off = f64::NAN;
        for corrections in 0..=most {
            let before = off;
            off = state.rows(&self.mechanism, &mut self.vectors);
            // Corrections past the rounding would not end.
            if off <= ROUNDING || (off <= 0.1 * CONSTRAINT_TOLERANCE && off >= 0.5 * before) {
                return Ok(());
            }
            if off.is_nan() || corrections == most {
                return Err(Failure::NotMet { corrections, off });
            }
            self.saddle.factor(&self.vectors).map_err(Failure::Singular)?;
            self.by.fill([0.0; 3]);
            self.excess(state);
            let rows = &mut self.rows[self.mechanism.bars.len()..];
            for (slide, row) in self.mechanism.slides.iter().zip(rows) {
                *row = -dot(slide.normal, minus(state.at[slide.slot], slide.at));
            }
            self.x[..moving].fill([0.0; 3]);
            self.saddle.solve(&mut self.x[..moving], &mut self.rows);
            let part = self.part_of_correction();
            for x in &mut self.x[..moving] {
                *x = x.map(|x| part * x);
            }
            state.displace(&self.x[..moving]);
        }
        Ok(())
    }

    /// Largest correction of [`Self::assemble`], in units of the bars.
    pub(crate) const LARGEST_CORRECTION: f64 = 0.3;

    /// How much of a correction is taken: the linear part of a length is good for a part of a bar.
    fn part_of_correction(&self) -> f64 {
        let changes = self.mechanism.spans[..self.mechanism.rigid_spans()].iter().map(|link| {
            let change = minus(self.x[link.b], self.x[link.a]);
            dot(change, change).sqrt() / link.length_m
        });
        (Self::LARGEST_CORRECTION / changes.fold(0.0, worse)).min(1.0)
    }
}

/// Half of the rate of the square of a length: its row times velocities by slot.
#[inline]
fn rate(mechanism: &Mechanism, bar: &Rigid, vectors: &[Vector], v: &[Vector]) -> f64 {
    let part = |(span, d): (&Link, &Vector)| dot(*d, minus(v[span.b], v[span.a]));
    match mechanism.of(&bar.spans) {
        [span] => part((span, &vectors[bar.spans.start])),
        spans => spans.iter().zip(&vectors[bar.spans.clone()]).map(part).sum(),
    }
}

/// Whether every span of a taut rope has a direction.
pub(crate) fn no_jam(mechanism: &Mechanism, state: &State) -> Result<(), Failure> {
    jammed(mechanism, state, |span, d| norm(d) <= NO_SPAN * span.length_m)
}

/// The first span of a taut rope for which this is so, as a failure.
fn jammed(
    mechanism: &Mechanism,
    state: &State,
    is_lost: impl Fn(&Link, Vector) -> bool,
) -> Result<(), Failure> {
    if mechanism.spans.len() == mechanism.bars.len() + mechanism.springs.len() {
        return Ok(());
    }
    let springs = mechanism.springs.iter().filter(|spring| spring.spans.len() > 1);
    let taut = springs.filter(|s| s.slope(state.length_m(mechanism.of(&s.spans))) > 0.0);
    let rigid = mechanism.bars.iter().map(|bar| &bar.spans).filter(|spans| spans.len() > 1);
    let mut spans = rigid.chain(taut.map(|spring| &spring.spans)).flat_map(|s| mechanism.of(s));
    let moves = |span: &Link| span.a.min(span.b) < mechanism.moving;
    match spans.find(|span| moves(span) && is_lost(span, state.between(span.a, span.b))) {
        Some(span) => Err(Failure::Jammed { span: *span }),
        None => Ok(()),
    }
}
