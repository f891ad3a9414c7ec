//! The hanging shape by its forces: least complementary energy, as a programme over cones.
//!
//! With every member in tension the forces $F$ of an equilibrium minimise the convex function
//! $\sum_e l_e\\,t_e + c_e\\,t_e^2/2$ with $t_e \ge |F_e|$, minus the work at the supports, subject
//! to the balance of the joints. The multipliers of that balance are the places $x$ of the joints,
//! and with the pairs (module `cone`)
//!
//! $$ z_e = (t_e, F_e), \qquad s_e = (l_e + c_e t_e,\ -d_e), \qquad d_e = x_b - x_a, $$
//!
//! a shape is the one sought if both are in the cone and $z_e \circ s_e = 0$: a taut member has
//! $|d| = l + c|F|$ and its force along it, a slack one $|d| < l$ and none. The primal-dual interior
//! point method follows $z_e \circ s_e = \mu (1, 0)$ to $\mu \to 0$. Its linear equations in the
//! scaling of Nesterov and Todd are
//!
//! $$ W \Delta z + W^{-1} \Delta s = g, \qquad \Delta s = (c\\,\Delta t,\ -\Delta d) - r, $$
//!
//! so that $\Delta F = K \Delta d + \dots$ with one symmetric positive definite 3 x 3 block $K$ a
//! member, and balance is a system in the places alone. One factorisation serves the predictor,
//! straight for $\mu = 0$, and the corrector with its second order. Some twelve steps do whatever
//! the size, and however many members are slack.
//!
//! It starts from force densities (module `densities`).
//!
//! S. Mehrotra, SIAM J. Optim. 2 (1992) 575-601, doi:10.1137/0802028 (predictor and corrector); E.
//! D. Andersen, C. Roos, T. Terlaky, Math. Program. 95 (2003) 249-277,
//! doi:10.1007/s10107-002-0349-3 (cones of second order).

use nalgebra::{Matrix3, Vector3};

use super::cone::{Block, Pair, Scaling};
use super::densities::{by_densities, pulls};
use super::framework::{Framework, Link};
use super::state::State;
use super::stiffness::Stiffness;
use crate::error::Error;
use crate::thresholds::{MOST_STEPS, SEEN, SHORTEST, ZERO};
use model::system::Kind;

/// First length of a member in the programme, where it is as long as it may be or longer: this
/// much more than it is.
const FIRST_SLACK: f64 = 0.05;
/// The mean of $z \cdot s$ over that of $t\\,l$ at which the lengths of taut bars are right to some
/// 1e-7: often near enough for the final iteration.
pub(super) const FIRST_END: f64 = 1e-7;
/// Where it is not, this one is.
pub(super) const SECOND_END: f64 = 1e-8;
/// Here the stiffness along a taut member is 10^9 times that across, and rounding sets in.
pub(super) const LAST_END: f64 = 1e-9;
/// A member is clearly taut when its force, in units of the mean one, is this many times its slack,
/// in units of its length.
const CLEARLY_TAUT: f64 = 1e4;
/// Part of the way to the boundary that a step may go.
const INSIDE: f64 = 0.99;
/// Stiffness given to every joint, in units of the mean $t/l$: one that nothing holds in some
/// direction stays.
const SHIFT: f64 = 1e-10;

/// The hanging shape with all bars taken as cables, as far as it has come.
pub(super) struct Hanging {
    /// Places of the joints as far as it has come.
    pub places: Vec<Vector3<f64>>,
    /// Force of each member with its size; no pair for one that takes no part.
    forces: Vec<Option<Pair>>,
    /// Their counterparts.
    slacks: Vec<Pair>,
    /// Steps so far.
    pub steps: usize,
    /// Mean of $z \cdot s$ over that of $t\\,l$.
    gap: f64,
    /// Largest part of the length by which a span does not belong to its places.
    misfit: f64,
    /// Short steps on end.
    short: usize,
    /// Mean size of a force at the start.
    first: f64,
}

/// Change of all unknowns.
struct Step {
    moves: Vec<Vector3<f64>>,
    forces: Vec<Pair>,
    slacks: Vec<Pair>,
}

/// A member in the linear equations of a step.
struct Row {
    scaling: Scaling,
    block: Block,
    /// What the counterpart has that places and force do not say.
    off: Pair,
}

impl Hanging {
    /// The start, by force densities.
    ///
    /// # Errors
    ///
    /// [`Error::Memory`] when the factor cannot be held.
    pub fn new(framework: &Framework) -> Result<Self, Error> {
        let (places, densities) = by_densities(framework)?;
        let pairs = framework.links.iter().zip(&densities).map(|(link, density)| {
            let span = link.span(&places);
            // On the central path force and span are parallel, in the ratio of the density.
            let own = link.stretched(density * link.length);
            let head = own.max(span.norm() * (1.0 + FIRST_SLACK));
            let force = Pair::new(density * head, span * *density);
            (pulls(framework, link).then_some(force), Pair::new(head, -span))
        });
        let (forces, slacks): (Vec<_>, Vec<_>) = pairs.unzip();
        let (gap, misfit, first) = (f64::INFINITY, 0.0, 0.0);
        let mut hanging = Self { places, forces, slacks, steps: 0, gap, misfit, short: 0, first };
        hanging.first = hanging.mean();
        // Without any force there is nothing to round off.
        let forces = hanging.forces();
        if forces.iter().all(|force| force.norm() <= 0.0) {
            hanging.gap = 0.0;
        } else {
            hanging.measure(framework);
        }
        Ok(hanging)
    }

    /// Go on to a gap below `end`; whether it was reached, or is near and no step goes on.
    pub fn advance(&mut self, framework: &Framework, stiffness: &mut Stiffness, end: f64) -> bool {
        while !self.ended(end) && self.steps < MOST_STEPS && self.short < 2 {
            if self.idle() || framework.work.is_spent() || !self.step(framework, stiffness) {
                break;
            }
            self.steps += 1;
            self.measure(framework);
        }
        self.ended(end.max(SEEN))
    }

    /// Whether no member pulls.
    fn idle(&self) -> bool {
        self.mean() <= ZERO * self.first
    }

    /// Whether the gap is below `end`, and lengths are right.
    fn ended(&self, end: f64) -> bool {
        self.gap <= end && self.misfit <= SEEN
    }

    /// Whether every cable is far from slack. Bars keep their lengths whatever their forces are.
    pub fn clear(&self, framework: &Framework) -> bool {
        let mean = self.mean();
        let mut links = framework.links.iter().enumerate();
        links.all(|(k, link)| {
            link.kind != Kind::Cable || self.tautness(link, k, mean) > CLEARLY_TAUT
        })
    }

    /// Forces of the members.
    pub fn forces(&self) -> Vec<Vector3<f64>> {
        self.forces.iter().map(|pair| pair.map_or(Vector3::zeros(), |z| z.tail)).collect()
    }

    /// Places, axial forces, and which members are taut.
    pub fn state(&self, framework: &Framework) -> State {
        let (mean, idle) = (self.mean(), self.idle());
        let mut axial: Vec<f64> = self.forces().iter().map(Vector3::norm).collect();
        let mut taut = vec![false; axial.len()];
        for (k, link) in framework.links.iter().enumerate() {
            let pulls = !idle && axial[k] > 0.0 && self.tautness(link, k, mean) > 1.0;
            taut[k] = link.kind == Kind::Bar || (link.kind == Kind::Cable && pulls);
            if !pulls {
                axial[k] = 0.0;
            }
        }
        State::new(self.places.clone(), axial, taut)
    }

    /// Mean size of a force.
    fn mean(&self) -> f64 {
        let sizes = self.forces.iter().flatten().map(|z| z.head);
        sizes.sum::<f64>() / self.forces.len().max(1) as f64
    }

    /// Force of a member in units of the mean one, over its slack in units of its length.
    fn tautness(&self, link: &Link, member: usize, mean: f64) -> f64 {
        let slack = &self.slacks[member];
        let left = (slack.head - slack.tail.norm()) / link.length;
        self.forces[member].map_or(0.0, |z| z.head / (mean * left))
    }

    /// Gap and misfit at the pairs as they are.
    fn measure(&mut self, framework: &Framework) {
        let (mut product, mut work, mut misfit) = (0.0, 0.0, 0.0_f64);
        for (k, link) in framework.links.iter().enumerate() {
            if let Some(z) = &self.forces[k] {
                product += z.dot(&self.slacks[k]);
                work += z.head * link.length;
                let off = self.off(link, k, z);
                misfit = misfit.max((off.head.abs() + off.tail.norm()) / link.length);
            }
        }
        (self.gap, self.misfit) = (product / work, misfit);
    }

    /// What the counterpart of a member has that its force and places do not say.
    fn off(&self, link: &Link, member: usize, z: &Pair) -> Pair {
        let slack = &self.slacks[member];
        let head = slack.head - link.stretched(z.head);
        Pair::new(head, slack.tail + link.span(&self.places))
    }

    /// One step of the interior point method; whether there was one.
    fn step(&mut self, framework: &Framework, stiffness: &mut Stiffness) -> bool {
        let rows: Vec<Option<Row>> = framework
            .links
            .iter()
            .enumerate()
            .map(|(k, link)| {
                self.forces[k].as_ref().map(|z| {
                    let scaling = Scaling::new(z, &self.slacks[k]);
                    let block = scaling.block(link.compliance);
                    Row { scaling, block, off: self.off(link, k, z) }
                })
            })
            .collect();
        let block =
            |row: &Option<Row>| row.as_ref().map_or(Matrix3::zeros(), |row| row.block.stiffness);
        stiffness.assemble(framework, rows.iter().map(block));
        let soft = rows.iter().flatten().map(|row| row.scaling.rho).sum::<f64>();
        stiffness.shift(SHIFT * soft / rows.len().max(1) as f64);
        stiffness.factorise_stiff();
        // The predictor: straight for a product of zero.
        let count = rows.iter().flatten().count() as f64;
        let predictor =
            self.solve(framework, stiffness, &rows, |_, z, _| Pair::new(-z.head, -z.tail));
        let (ahead, aside) = self.ways(&predictor);
        let (ahead, aside) = (ahead.min(1.0), aside.min(1.0));
        let (mut product, mut left) = (0.0, 0.0);
        for (k, z) in self.forces.iter().enumerate() {
            if let Some(z) = z {
                product += z.dot(&self.slacks[k]);
                let z = z.plus(ahead, &predictor.forces[k]);
                left += z.dot(&self.slacks[k].plus(aside, &predictor.slacks[k]));
            }
        }
        let centre = (left / product).max(0.0).powi(3) * product / count;
        // The corrector: towards the centre, less what the predictor's step leaves at second order.
        let corrector = self.solve(framework, stiffness, &rows, |k, z, row: &Row| {
            let lambda = row.scaling.apply(z);
            let second = row
                .scaling
                .apply_inverse(&predictor.slacks[k])
                .product(&row.scaling.apply(&predictor.forces[k]));
            let target = Pair::new(centre - second.head, -second.tail);
            row.scaling.apply_inverse(&lambda.divide(&target)).plus(-1.0, z)
        });
        let (ahead, aside) = self.ways(&corrector);
        let (mut ahead, mut aside) = ((INSIDE * ahead).min(1.0), (INSIDE * aside).min(1.0));
        if framework.links.iter().any(|link| link.compliance > 0.0) {
            // Forces and lengths are in one equation.
            (ahead, aside) = (ahead.min(aside), ahead.min(aside));
        }
        self.apply(&corrector, ahead, aside)
    }

    /// The step with the right side `target`, $W^{-1} g$, for each member.
    fn solve(
        &self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        rows: &[Option<Row>],
        target: impl Fn(usize, &Pair, &Row) -> Pair,
    ) -> Step {
        let none = Pair::new(0.0, Vector3::zeros());
        let constant = |(k, row): (usize, &Option<Row>)| match (row, &self.forces[k]) {
            (Some(row), Some(z)) => {
                target(k, z, row).plus(1.0, &row.scaling.squared_inverse(&row.off))
            }
            _ => none,
        };
        let constants: Vec<Pair> = rows.iter().enumerate().map(constant).collect();
        let links = || framework.links.iter().zip(rows).zip(&constants);
        let now = links().zip(&self.forces).map(|(((link, row), h), z)| match (row, z) {
            (Some(row), Some(z)) => {
                let taken = link.compliance * h.head / row.block.divisor;
                z.tail + h.tail - row.block.row * taken
            }
            _ => Vector3::zeros(),
        });
        let moves = stiffness.moves(framework, &framework.unbalance(now));
        let changes = links().map(|((link, row), h)| {
            let Some(row) = row else { return (none, none) };
            let span = link.span(&moves);
            let head = (h.head + row.block.row.dot(&span)) / row.block.divisor;
            let taken = link.compliance * h.head / row.block.divisor;
            let tail = h.tail - row.block.row * taken + row.block.stiffness * span;
            let slack = Pair::new(link.compliance * head, -span).plus(-1.0, &row.off);
            (Pair::new(head, tail), slack)
        });
        let (forces, slacks) = changes.unzip();
        Step { moves, forces, slacks }
    }

    /// How far forces and counterparts can go.
    fn ways(&self, step: &Step) -> (f64, f64) {
        let mut ways = (f64::INFINITY, f64::INFINITY);
        for (k, z) in self.forces.iter().enumerate() {
            if let Some(z) = z {
                ways.0 = ways.0.min(z.way(&step.forces[k]));
                ways.1 = ways.1.min(self.slacks[k].way(&step.slacks[k]));
            }
        }
        ways
    }

    /// Go along a step; not where rounding has left the cone.
    fn apply(&mut self, step: &Step, ahead: f64, aside: f64) -> bool {
        let mut next = (self.forces.clone(), self.slacks.clone());
        for (k, z) in self.forces.iter().enumerate() {
            if let Some(z) = z {
                let (z, slack) =
                    (z.plus(ahead, &step.forces[k]), self.slacks[k].plus(aside, &step.slacks[k]));
                // NaN is nowhere inside.
                if !z.inside() || !slack.inside() {
                    return false;
                }
                (next.0[k], next.1[k]) = (Some(z), slack);
            }
        }
        (self.forces, self.slacks) = next;
        for (place, step) in self.places.iter_mut().zip(&step.moves) {
            *place += step * aside;
        }
        // Two such steps on end and there is no such shape.
        self.short = if ahead.min(aside) < SHORTEST { self.short + 1 } else { 0 };
        true
    }
}

#[cfg(test)]
mod tests;
