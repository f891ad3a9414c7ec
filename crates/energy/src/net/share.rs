//! Loads shared by equally stiff springs.
//!
//! Every taut inextensible member `m` is a spring of stiffness `1 / l_m`, and the shape stays where
//! it is. With `R` the gradients of their excesses and `W = diag(1 / l)`, joint forces `r` are borne
//! by
//!
//! `t = W R y,   (Rᵀ W R) y = r`,
//!
//! which is the least `sum t² l` of all `t` with `Rᵀ t = r`: what equally stiff members bear in the
//! limit as they become rigid. Forces `t` become their share by `r = Rᵀ t`; what is left over is a
//! self-stress. The misfits `e` of the lengths, as spring forces `W e`, are split in the same way:
//! what a change of the shape takes up, and what no change of it does.
//!
//! Which of the members resist that do so on one side alone is found by Newton's method for the least of the convex energy
//! `sum s² / 2l - r · y` over their stretches `s = R y` on that side; a step ends where the energy falls no more.
//!
//! Motions that keep the lengths make `Rᵀ W R` singular. A soft spring on every joint holds them;
//! a few solutions for the rest of `r` remove its effect on all others. Motions that strain the
//! members by less than that spring's softness count as such motions.

use std::sync::Arc;

use model::Vector;

use crate::error::Error;
use crate::net::factor::{Block, Factor};
use crate::net::frame::{Frame, Rod};
use crate::net::law::Excess;
use crate::net::shape::largest;
use crate::thresholds::{BISECTIONS, GOLDEN, ROUNDING, ZERO};
use crate::vector::scaled;

/// Stiffness of the floor over that of a member of the unit of length. Its deflection is taken back
/// after every solution, so that it is as rigid as supports are.
const FLOOR: f64 = 1e4;

/// Solutions for one distribution: the first one, and corrections; as many more as leave less of it than this part each, as where
/// a tall truss bends, which strains its members by little.
const SOLUTIONS: usize = 8;
const MOST_SOLUTIONS: usize = 200;
const SLOW: f64 = 0.98;

/// The part of forces without any order that a self-stress must take to count as one. Rounding
/// leaves some 1e-12.
const SELF_STRESS: f64 = 1e-7;

/// The members of one shape as springs.
pub(super) struct Share {
    frame: Arc<Frame>,
    factor: Factor,
    excess: Vec<Excess>,
    taut: Vec<bool>,
}

/// Forces with the strains that go with them.
pub(super) struct Shared {
    /// Force of each taut inextensible member; zero for the others.
    pub(super) force: Vec<f64>,
    /// Change of the excess of each member in the motion that makes these forces.
    pub(super) stretch: Vec<f64>,
    /// What the joint forces do in this motion.
    pub(super) work: f64,
}

/// Forces without any order, of mean one: the fractional parts of the multiples of the golden section.
pub(super) fn disorder(e: usize) -> f64 {
    0.5 + (GOLDEN * (e + 1) as f64).fract()
}

/// Stiffness of the spring in place of a rigid member.
fn weight(rod: &Rod) -> f64 {
    if rod.ground { FLOOR } else { 1.0 / rod.length }
}

impl Shared {
    /// As far from here towards other shares as the energy of one-sided springs falls, which is convex; whether that is all
    /// the way. Those that are not `near` their lengths are none.
    pub(super) fn towards(&mut self, to: &Self, frame: &Frame, near: &[bool]) -> bool {
        let springs = || {
            frame
                .rods
                .iter()
                .enumerate()
                .filter(|(e, rod)| near[*e] && !rod.elastic() && !rod.ground)
        };
        let change = |e: usize| to.stretch[e] - self.stretch[e];
        let slope = |part: f64| {
            let falls = springs().map(|(e, rod)| {
                let stretch = self.stretch[e] + part * change(e);
                if rod.resists(stretch) { weight(rod) * stretch * change(e) } else { 0.0 }
            });
            falls.sum::<f64>() - (to.work - self.work)
        };
        let (mut least, mut part) = (0.0, 1.0);
        if slope(part) > ZERO * (to.work - self.work).abs() {
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (least + part);
                if slope(middle) > 0.0 { part = middle } else { least = middle }
            }
        }
        let step = |from: &mut f64, to: f64| *from += part * (to - *from);
        self.stretch.iter_mut().zip(&to.stretch).for_each(|(from, to)| step(from, *to));
        step(&mut self.work, to.work);
        for (e, rod) in frame.rods.iter().enumerate() {
            if rod.ground {
                step(&mut self.force[e], to.force[e]);
            } else {
                self.force[e] =
                    if to.force[e] == 0.0 { 0.0 } else { weight(rod) * self.stretch[e] };
            }
        }
        part >= 1.0
    }
}

impl Share {
    pub(super) fn new(frame: &Arc<Frame>) -> Result<Self, Error> {
        Ok(Self {
            factor: Factor::new(&frame.spots, &frame.rods, &frame.meter)?,
            frame: Arc::clone(frame),
            excess: Vec::new(),
            taut: Vec::new(),
        })
    }

    /// Take a shape with the members that are taut; elastic ones are no part of it. Whether the
    /// springs can be factorised.
    pub(super) fn stand(&mut self, x: &[Vector], taut: &[bool], softness: f64) -> bool {
        let frame = Arc::clone(&self.frame);
        let rods = frame.rods.iter().zip(taut);
        self.taut = rods.map(|(rod, taut)| *taut && !rod.elastic()).collect();
        self.excess = frame.excesses(x);
        let sizes = frame.sizes(|e| if self.taut[e] { 1.0 } else { 0.0 });
        let blocks: Vec<Block> = (0..frame.rods.len())
            .map(|e| Block {
                isotropic: 0.0,
                along: self.weight(e),
                direction: self.excess[e].gradient,
                stretch: self.weight(e),
            })
            .collect();
        frame.fill(
            &mut self.factor,
            |e| blocks[e],
            |joint| softness * if sizes[joint] > 0.0 { sizes[joint] } else { 1.0 },
        );
        self.factor.definite()
    }

    /// Stiffness of a member's spring.
    fn weight(&self, rod: usize) -> f64 {
        if self.taut[rod] { weight(&self.frame.rods[rod]) } else { 0.0 }
    }

    /// The forces of the joints that inextensible members bear at a shape, taut or not.
    pub(super) fn unshared(&self, force: &[f64]) -> Vec<f64> {
        let rods = &self.frame.rods;
        self.joint_forces(|e| if rods[e].elastic() { 0.0 } else { force[e] })
    }

    /// `Rᵀ t`
    fn joint_forces(&self, force: impl Fn(usize) -> f64) -> Vec<f64> {
        self.frame.resisted(|e| scaled(force(e), self.excess[e].gradient))
    }

    fn stretch(&self, y: &[f64]) -> Vec<f64> {
        (0..self.frame.rods.len()).map(|e| self.frame.change(&self.excess, e, y)).collect()
    }

    /// The same joint forces, borne by the springs.
    pub(super) fn shared(&mut self, force: &[f64]) -> Shared {
        // What is slack gives its part to the others.
        let borne = self.unshared(force);
        self.bearing(&borne, None)
    }

    /// Forces of the joints, by their coordinates, borne by the springs, by steps from other shares of them.
    pub(super) fn bearing(&mut self, borne: &[f64], from: Option<&Shared>) -> Shared {
        let enough = ROUNDING * largest(borne);
        let still = vec![0.0; self.taut.len()];
        let (mut floor, mut stretch, mut work) = match from {
            None => (still.clone(), still, 0.0),
            Some(from) => (from.force.clone(), from.stretch.clone(), from.work),
        };
        for (e, rod) in self.frame.rods.iter().enumerate() {
            if !rod.ground || !self.taut[e] {
                floor[e] = 0.0;
            }
        }
        let mut before = f64::INFINITY;
        for solutions in 0..MOST_SOLUTIONS {
            let there = self.joint_forces(|e| floor[e] + self.weight(e) * stretch[e]);
            let mut rest: Vec<f64> = borne.iter().zip(there).map(|(r, t)| r - t).collect();
            let left = largest(&rest);
            if left <= enough || solutions >= SOLUTIONS && left > SLOW * before {
                break;
            }
            before = left;
            self.factor.solve(&mut rest);
            work += borne.iter().zip(&rest).map(|(force, by)| force * by).sum::<f64>();
            // Not of the sum of the motions, whose rounding is that of the largest of them.
            for (stretch, more) in stretch.iter_mut().zip(self.stretch(&rest)) {
                *stretch += more;
            }
            for (e, _) in self.frame.rods.iter().enumerate().filter(|(_, rod)| rod.ground) {
                floor[e] += self.weight(e) * stretch[e];
            }
        }
        let bears = |(e, stretch): (usize, &f64)| {
            if self.frame.rods[e].ground { floor[e] } else { self.weight(e) * stretch }
        };
        Shared { force: stretch.iter().enumerate().map(bears).collect(), stretch, work }
    }

    /// The part of the excesses of the taut inextensible members that no change of the shape takes up.
    pub(super) fn in_no_shape(&mut self, excess: impl Fn(usize) -> f64) -> Vec<f64> {
        let frame = Arc::clone(&self.frame);
        let of_taut = |e: usize| if self.taut[e] { excess(e) } else { 0.0 };
        let mut rest: Vec<f64> = (0..self.taut.len()).map(of_taut).collect();
        let springs = frame.rods.iter().zip(&rest).map(|(rod, excess)| weight(rod) * excess);
        let taken = self.shared(&springs.collect::<Vec<_>>()).stretch;
        for ((rest, taken), taut) in rest.iter_mut().zip(taken).zip(&self.taut) {
            *rest = if *taut { *rest - taken } else { 0.0 };
        }
        rest
    }

    /// For each member whether it takes part in a self-stress, shown by forces without any order.
    /// `None` where there is no self-stress.
    pub(super) fn self_stressed(&mut self) -> Option<Vec<bool>> {
        let any = |(e, taut): (usize, &bool)| if *taut { disorder(e) } else { 0.0 };
        let mut force: Vec<f64> = self.taut.iter().enumerate().map(any).collect();
        self.frame.spread(&mut force);
        let shared = self.shared(&force).force;
        let rest = force.iter().zip(shared).map(|(force, shared)| (force - shared).abs());
        let part: Vec<bool> =
            rest.zip(&self.taut).map(|(rest, taut)| *taut && rest > SELF_STRESS).collect();
        part.contains(&true).then_some(part)
    }
}
