//! Newton's method for places and forces together, down to rounding level.
//!
//! The springs of the augmented Lagrangian are stiff here and every step updates the forces, so
//! that a step leaves next to nothing of the springs: it is the step of the system of balances and
//! lengths. Its matrix is positive definite exactly where the second derivative of the energy is,
//! on the motions that keep the lengths: at saddles and maxima it is refused.
//!
//! Which cables and struts resist is read off their forces, afresh for each factorisation, and not
//! off the stiff springs: the second order of a step leaves errors of the lengths that such springs
//! would take for forces, larger than those of most members of a net.
//!
//! M. Hintermueller, K. Ito and K. Kunisch, SIAM J. Optim. 13 (2002) 865-888,
//! doi:10.1137/S1052623401383558

use std::sync::Arc;

use model::system::Kind;

use crate::net::frame::{Frame, Rod};
use crate::net::law::{Excess, Softened};
use crate::net::newton::{NEAR, Newton};
use crate::net::shape::{Shape, Slope};
use crate::thresholds::{CHANGES, CORRECTIONS, NO_STRAIN, PROGRESS, STEP_ROUNDING};
use crate::vector::scaled;

/// Strain of the springs in Newton's method for places and forces: what a step leaves of the error.
pub(super) const STIFF_STRAIN: f64 = 1e-6;

/// Of lengths that the shape hardly feels it leaves more: a line whose parts are at an angle `a` to
/// each other strains by `a` times a displacement, and springs of strain `a²` halve the error. Where
/// steps bring little the springs become stiffer by this factor, down to [`NO_STRAIN`], at which the rounding of the
/// springs is a part 1e-4 of the forces.
pub(super) const STIFFER: f64 = 1e-3;

/// Diagonal added there, over the size of the matrix: where a motion is neutral the step has no
/// part of it.
pub(super) const NEUTRAL: f64 = 1e-10;

/// The same over what curvatures are unsure by, as springs strain or forces are off by that part: several members meet in a
/// joint, and each adds to it.
const UNSURE: f64 = 10.0;

/// The same with elastic members, of which what a turn leaves of their lengths is a force.
const ELASTIC_NEUTRAL: f64 = 1e-8;

/// Misfit above which members have turned too far for the factorisation of the step before: its
/// stiff springs point the old way; and the most that may hide what is just taut.
const CHORD_NEAR: f64 = 1e-8;

/// Lengths that are off hide whether a member beside them is just taut, up to this many times as much.
const HIDDEN: f64 = 4.0;

/// How steps with springs of one strain ended.
enum Polished {
    /// Down to rounding.
    Rounded(Shape),
    /// Within the tolerance.
    Converged(Shape),
    /// The steps were used up near a solution.
    Slow(Shape),
    Astray,
}

impl Newton {
    /// Newton's method for places and forces. `None` where it does not converge, or not to a
    /// minimum.
    ///
    /// Steps that bring little are either rounding, or the springs are too soft for lengths that the
    /// shape hardly feels: then stiffer ones go on. Where lengths overdetermine the shape none brings an end: that is
    /// the business of [`limit`](crate::net::limit).
    pub(super) fn polish(&mut self, shape: &Shape) -> Option<Shape> {
        let mut neutral = false;
        let mut found = self.polish_with(shape, STIFF_STRAIN, &mut neutral);
        let mut strain = STIFF_STRAIN * STIFFER;
        while strain >= NO_STRAIN {
            let start = match &found {
                Polished::Converged(shape) | Polished::Slow(shape) => shape,
                Polished::Rounded(_) | Polished::Astray => break,
            };
            match self.polish_with(start, strain, &mut neutral) {
                Polished::Astray => break,
                next => found = next,
            }
            strain *= STIFFER;
        }
        match found {
            Polished::Rounded(shape) | Polished::Converged(shape) => {
                (!neutral || self.rests(&shape)).then_some(shape)
            }
            Polished::Slow(_) | Polished::Astray => None,
        }
    }

    /// Whether the energy falls in no direction, with springs that are as stiff as rounding lets them be.
    fn rests(&mut self, shape: &Shape) -> bool {
        // Stiffer ones round more than they strain.
        let strain = f64::EPSILON.sqrt();
        let stiffness = self.frame.force_scale(&shape.force) / strain;
        let active = self.frame.active(shape, 0.0);
        self.factorise_stiff(shape, stiffness, &active, strain)
    }

    /// The same with springs of one strain.
    fn polish_with(&mut self, shape: &Shape, strain: f64, neutral: &mut bool) -> Polished {
        let frame = Arc::clone(&self.frame);
        let (mut shape, mut slope) = (shape.clone(), frame.slope(shape));
        let stiffness = frame.force_scale(&shape.force) / strain;
        let error = frame.error();
        // As many with one factorisation.
        let (mut steps, mut changes) = (CORRECTIONS, CHANGES);
        let mut active = frame.active(&shape, slope.misfit);
        while steps > 0 {
            steps -= 1;
            let start = slope.residual();
            if !self.factorise_stiff(&shape, stiffness, &active, 0.0) {
                // Springs that strain and forces that are off seem to give way along what nothing resists.
                let seems = start <= CHORD_NEAR && (*neutral || strain >= STIFF_STRAIN);
                if !(seems && self.factorise_stiff(&shape, stiffness, &active, strain + start)) {
                    return Polished::Astray;
                }
                *neutral = true;
            }
            for chord in 0..CORRECTIONS {
                let next = self.chord(&shape, stiffness, &active, &[]);
                let there = frame.slope(&next);
                let (before, after) = (error(&slope), error(&there));
                if !after.is_finite() {
                    return Polished::Astray;
                }
                // With the factorisation of another shape it may be that which brings nothing.
                let left = if chord == 0 { slope.residual() } else { before };
                if after >= before && left <= self.tolerance(&shape) {
                    return self.polished(shape, slope.residual());
                }
                if chord > 0 && after > PROGRESS * before {
                    break;
                }
                (shape, slope) = (next, there);
                if frame.active(&shape, slope.misfit) != active || slope.misfit > CHORD_NEAR {
                    break;
                }
            }
            let resist = frame.active(&shape, slope.misfit);
            if resist != active {
                if changes == 0 {
                    return Polished::Astray;
                }
                (active, changes, steps) = (resist, changes - 1, steps + 1);
                continue;
            }
            // Below the tolerance it goes on as long as that brings something.
            let residual = slope.residual();
            let slow = residual > PROGRESS * start;
            if residual <= rounding_floor(&frame, &shape)
                || (slow && residual <= self.tolerance(&shape))
            {
                return self.polished(shape, residual);
            }
            if residual > 2.0 * start.max(NEAR) {
                return Polished::Astray;
            }
        }
        if slope.misfit < NEAR { Polished::Slow(shape) } else { Polished::Astray }
    }

    fn polished(&self, shape: Shape, residual: f64) -> Polished {
        // A nearly taut line has forces of the load over its slope, and an error of a length moves it
        // by as many times that error.
        let turned = self.frame.largest_force(&shape.force).max(1.0);
        if turned * residual <= rounding_floor(&self.frame, &shape) {
            Polished::Rounded(shape)
        } else {
            Polished::Converged(shape)
        }
    }

    /// Factorise the matrix with stiff springs in the members that resist; whether it is positive
    /// definite, where curvatures are `unsure` by so much.
    pub(super) fn factorise_stiff(
        &mut self,
        shape: &Shape,
        stiffness: f64,
        active: &[bool],
        unsure: f64,
    ) -> bool {
        let frame = Arc::clone(&self.frame);
        let excess = frame.excesses(&shape.x);
        let largest = frame.largest_force(&shape.force);
        let sizes = frame.sizes(|e| if active[e] { largest } else { 0.0 });
        let along = if frame.ropes.is_empty() { 0.0 } else { STEP_ROUNDING * stiffness / largest };
        let own = if frame.rods.iter().any(Rod::elastic) { ELASTIC_NEUTRAL } else { NEUTRAL };
        let neutral = own.max(along).max(UNSURE * unsure);
        let block = |e: usize| {
            let spring = stiff(&frame, &excess[e], shape.force[e], e, stiffness, active[e]);
            excess[e].block(if active[e] { shape.force[e] } else { 0.0 }, spring.stiffness)
        };
        frame.fill(&mut self.factor, block, |joint| {
            neutral * if sizes[joint] > 0.0 { sizes[joint] } else { largest }
        });
        self.factor.definite()
    }

    /// One step with the factorisation at hand, towards lengths that are longer by what they are to be `off`, if anything.
    pub(super) fn chord(
        &mut self,
        shape: &Shape,
        stiffness: f64,
        active: &[bool],
        off: &[f64],
    ) -> Shape {
        let frame = Arc::clone(&self.frame);
        let mut excess = frame.excesses(&shape.x);
        excess.iter_mut().zip(off).for_each(|(excess, off)| excess.value -= off);
        let soft: Vec<Softened> = (0..frame.rods.len())
            .map(|e| stiff(&frame, &excess[e], shape.force[e], e, stiffness, active[e]))
            .collect();
        let gradient = frame.gradient(|e| scaled(soft[e].force, excess[e].gradient));
        let step = self.factor.step_against(gradient);
        let force = (0..frame.rods.len())
            .map(|e| soft[e].force + soft[e].stiffness * frame.change(&excess, e, &step));
        Shape { force: force.collect(), x: frame.moved(&shape.x, 1.0, &step) }
    }

    /// The tolerance, or what rounding of the places leaves where that is more.
    pub(super) fn tolerance(&self, shape: &Shape) -> f64 {
        self.settings.tolerance.max(rounding_floor(&self.frame, shape))
    }
}

/// A member that resists or not, with a spring of this stiffness.
fn stiff(
    frame: &Frame,
    excess: &Excess,
    force: f64,
    rod: usize,
    stiffness: f64,
    active: bool,
) -> Softened {
    let rod = &frame.rods[rod];
    if active {
        rod.spring(excess.value, force, stiffness / rod.length)
    } else {
        Softened::default()
    }
}

impl Frame {
    /// The residual of a shape, in which the misfit of a stiff elastic member counts as the force that
    /// it stands for.
    fn error(&self) -> impl Fn(&Slope) -> f64 + use<> {
        let elastic = self.rods.iter().filter(|rod| rod.elastic());
        let stiffest = elastic.map(|rod| rod.length / rod.flexibility).fold(1.0, f64::max);
        move |slope| slope.unbalance.max(stiffest * slope.misfit)
    }

    /// Which members resist: by the sign of their force, and where it is rounding by their length; what is just taut
    /// would resist, and while lengths are off by a misfit, what may be.
    fn active(&self, shape: &Shape, misfit: f64) -> Vec<bool> {
        let rounding = rounding_floor(self, shape);
        let hidden = rounding.max((HIDDEN * misfit).min(CHORD_NEAR));
        let none = NO_STRAIN * self.largest_force(&shape.force);
        let resists = |(e, rod): (usize, &Rod)| {
            let force = shape.force[e];
            if rod.kind == Kind::Bar {
                return true;
            }
            let rounding = if rod.elastic() { hidden } else { rounding };
            let of_length =
                if rod.elastic() { rounding * rod.length / rod.flexibility } else { 0.0 };
            if force.abs() > none.max(of_length) {
                return rod.resists(force);
            }
            let excess = self.excess(&shape.x, e).value / rod.length;
            excess.abs() <= rounding || rod.resists(excess)
        };
        self.rods.iter().enumerate().map(resists).collect()
    }
}

/// What roundings of the places leave of the lengths: some units in the last place of the largest
/// coordinate over the length of a member.
pub(super) fn rounding_floor(frame: &Frame, shape: &Shape) -> f64 {
    let shortest = frame.rods.iter().map(|rod| rod.length).fold(f64::INFINITY, f64::min);
    STEP_ROUNDING * (1.0 + shape.extent() / shortest)
}
