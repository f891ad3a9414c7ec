//! The hanging shape by its forces: least complementary energy.
//!
//! With every member in tension the forces $F$ of an equilibrium minimise the convex function
//! $\sum_e \varphi^*_e(F_e)$ minus the work at the supports, subject to the balance of the joints,
//! and the multipliers of that balance are the places of the joints. Newton's method with the law
//! rounded off (module `law`) needs one sparse factorisation a step; the rounding falls step by
//! step.
//!
//! It starts from force densities $w$: with $F = w\,d$ balance is a linear system for the places,
//! and
//! $w \leftarrow w\,|d|/l$ brings the lengths nearer to $l$ (the iteration of Weiszfeld).

use nalgebra::{Matrix3, Vector3};

use super::error::Error;
use super::framework::{Framework, Link};
use super::law::Tension;
use super::state::State;
use super::stiffness::Stiffness;
use model::system::Kind;

/// Force-density iterations before Newton's method. Each costs a scalar factorisation, a tenth of a
/// Newton step; twenty save about as many Newton steps as they cost and start it inside the region
/// where full steps are taken.
const DENSITY_STEPS: usize = 20;
/// First rounding, relative to the starting force of each member.
const FIRST_ROUNDING: f64 = 0.1;
/// Each rounding is this fraction of the last one.
const ROUNDING_FALL: f64 = 0.2;
/// At this rounding the lengths of taut bars are right to 5e-7: often near enough for the final
/// iteration.
pub(super) const FIRST_END: f64 = 1e-3;
/// Where it is not, as in nets of 100,000 members, this one is.
pub(super) const SECOND_END: f64 = 2e-4;
/// Here the stiffness along a taut member is 10^9 times that across, and rounding sets in.
pub(super) const LAST_END: f64 = 2e-5;
/// A member with this many times its rounding is clearly taut: `|d| > l (1 - 5e-5)`; at the end one
/// with the second number counts as taut.
const CLEARLY_TAUT: f64 = 100.0;
const TAUT: f64 = 10.0;
/// A member has at least this fraction of the mean starting force in its rounding.
const LEAST_SCALE: f64 = 0.1;
/// Next rounding when the step would gain less than this fraction of the rounding's own energy.
const GAIN: f64 = 0.1;
/// A step that would gain less than this fraction is rounding, however far it may go.
const NO_GAIN: f64 = 1e-12;
/// A step is halved while the slope at its end rises steeper than this fraction of the first slope.
const SLOPE: f64 = 0.5;
/// Newton steps in all; nets of 20,000 members take some 15.
const MOST_STEPS: usize = 200;

/// The hanging shape with all bars taken as cables, as far as it has come.
pub(super) struct Hanging {
    shape: Shape,
    /// Starting force of each member.
    scales: Vec<f64>,
    rounding: f64,
    /// Newton steps so far.
    pub steps: usize,
    /// Whether the shape belongs to its rounding.
    settled: bool,
}

impl Hanging {
    /// The start, by force densities.
    ///
    /// # Errors
    ///
    /// [`Error::Memory`] when the factor cannot be held.
    pub fn new(framework: &Framework) -> Result<Self, Error> {
        let shape = Shape::by_densities(framework)?;
        let mean = mean_force(&shape.forces);
        let scales =
            shape.forces.iter().map(|force| force.norm().max(LEAST_SCALE * mean)).collect();
        // Without any force there is nothing to round off.
        let (rounding, settled) = if mean > 0.0 { (FIRST_ROUNDING, false) } else { (0.0, true) };
        Ok(Self { shape, scales, rounding, steps: 0, settled })
    }

    /// Go on to a rounding below `end`; whether it was reached.
    pub fn advance(&mut self, framework: &Framework, stiffness: &mut Stiffness, end: f64) -> bool {
        while self.steps < MOST_STEPS && !(self.settled && self.rounding <= end) {
            if self.settled {
                self.rounding *= ROUNDING_FALL;
            }
            self.settled = self.shape.step(framework, stiffness, &self.scales, self.rounding);
            self.steps += 1;
        }
        self.settled && self.rounding <= end
    }

    /// Whether every cable is far from slack. Bars keep their lengths whatever their forces are.
    pub fn clear(&self, framework: &Framework) -> bool {
        self.shape.clearly_taut(framework, &self.scales, self.rounding)
    }

    /// Places of the joints at the rounding it has come to.
    pub fn places(&self) -> &[Vector3<f64>] {
        &self.shape.places
    }

    /// Forces of the members there.
    pub fn forces(&self) -> &[Vector3<f64>] {
        &self.shape.forces
    }

    /// Places, axial forces, and which members are taut.
    pub fn state(&self, framework: &Framework) -> State {
        self.shape.state(framework, &self.scales, self.rounding)
    }
}

/// Whether a member takes part: one that cannot pull does not.
fn pulls(framework: &Framework, link: &Link) -> bool {
    link.kind != Kind::Strut && framework.moves(link)
}

fn mean_force(forces: &[Vector3<f64>]) -> f64 {
    forces.iter().map(Vector3::norm).sum::<f64>() / forces.len().max(1) as f64
}

/// Forces in balance, and the places that go with them.
struct Shape {
    places: Vec<Vector3<f64>>,
    forces: Vec<Vector3<f64>>,
}

impl Shape {
    /// Force densities, first `1 / l` times the mean load, improved some times.
    fn by_densities(framework: &Framework) -> Result<Self, Error> {
        let sliding = framework.nodes.iter().any(|node| matches!(node.freedom, 1 | 2));
        let mut stiffness = Stiffness::new(framework, !sliding)?;
        let mut densities: Vec<f64> = framework
            .links
            .iter()
            .map(|link| if pulls(framework, link) { link.length.recip() } else { 0.0 })
            .collect();
        let mut places = Vec::new();
        for step in 0..=DENSITY_STEPS {
            places = by_density(framework, &mut stiffness, &densities, sliding);
            if step < DENSITY_STEPS {
                for (density, link) in densities.iter_mut().zip(&framework.links) {
                    let span = link.span(&places).norm();
                    *density *= span / (link.length + link.compliance * *density * span);
                }
            }
        }
        let forces = framework.links.iter().zip(&densities);
        let forces = forces.map(|(link, w)| link.span(&places) * *w).collect();
        Ok(Self { places, forces })
    }

    /// One Newton step at one rounding; whether the next one may follow.
    fn step(
        &mut self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        scales: &[f64],
        rounding: f64,
    ) -> bool {
        let mu = |k: usize| rounding * scales[k];
        let laws: Vec<Option<Tension>> = framework
            .links
            .iter()
            .enumerate()
            .map(|(k, link)| {
                pulls(framework, link).then(|| Tension::new(link, &self.forces[k], mu(k)))
            })
            .collect();
        let block = |law: &Option<Tension>| law.as_ref().map_or(Matrix3::zeros(), |l| l.stiffness);
        stiffness.assemble(framework, laws.iter().map(block));
        stiffness.factorise_definite();
        // What the forces would be at the places as they are; the moves bring them into balance.
        let now =
            framework.links.iter().zip(&laws).zip(&self.forces).map(|((link, law), force)| {
                let gap = law.as_ref().map(|law| link.span(&self.places) - law.span);
                force + gap.map_or(Vector3::zeros(), |gap| block(law) * gap)
            });
        let mut moves = stiffness.gather(framework, &framework.unbalance(now));
        stiffness.solve(&mut moves);
        for (place, step) in self.places.iter_mut().zip(stiffness.scatter(framework, &moves)) {
            *place += step;
        }
        let spans: Vec<_> = framework.links.iter().map(|link| link.span(&self.places)).collect();
        let change: Vec<Vector3<f64>> = laws
            .iter()
            .zip(&spans)
            .map(|(law, span)| {
                law.as_ref().map_or(Vector3::zeros(), |l| l.stiffness * (span - l.span))
            })
            .collect();
        let slope = |t: f64| -> f64 {
            let links = framework.links.iter().enumerate().filter(|(k, _)| laws[*k].is_some());
            let work = links.map(|(k, link)| {
                let span = Tension::span(link, &(self.forces[k] + change[k] * t), mu(k));
                change[k].dot(&(span - spans[k]))
            });
            work.sum()
        };
        let first = slope(0.0);
        let mut t = 1.0;
        while slope(t) > SLOPE * first.abs() && t > f64::EPSILON {
            t *= 0.5;
        }
        for (force, change) in self.forces.iter_mut().zip(&change) {
            *force += change * t;
        }
        let energy: f64 =
            framework.links.iter().enumerate().map(|(k, link)| mu(k) * link.length).sum();
        first.abs() < if t >= 1.0 { GAIN } else { NO_GAIN } * energy
    }

    /// Whether every cable is far from slack. Bars keep their lengths whatever their forces are.
    fn clearly_taut(&self, framework: &Framework, scales: &[f64], rounding: f64) -> bool {
        let mut links = framework.links.iter().zip(&self.forces).zip(scales);
        links.all(|((link, force), scale)| {
            link.kind != Kind::Cable || force.norm() > CLEARLY_TAUT * rounding * scale
        })
    }

    /// Axial forces, and which members are taut: those with far more force than their rounding.
    fn state(&self, framework: &Framework, scales: &[f64], rounding: f64) -> State {
        let mut axial: Vec<f64> = self.forces.iter().map(Vector3::norm).collect();
        let mut taut = vec![false; axial.len()];
        for (k, link) in framework.links.iter().enumerate() {
            let pulls = axial[k] > TAUT * rounding * scales[k];
            taut[k] = link.kind == Kind::Bar || (link.kind == Kind::Cable && pulls);
            if !pulls {
                axial[k] = 0.0;
            }
        }
        State::new(self.places.clone(), axial, taut)
    }
}

/// Places of the joints in balance for given force densities.
fn by_density(
    framework: &Framework,
    stiffness: &mut Stiffness,
    densities: &[f64],
    sliding: bool,
) -> Vec<Vector3<f64>> {
    let bases: Vec<_> = framework.nodes.iter().map(|node| node.base).collect();
    let pulls = framework.links.iter().zip(densities);
    let unbalance = framework.unbalance(pulls.map(|(link, density)| link.span(&bases) * *density));
    if sliding {
        stiffness.assemble(framework, densities.iter().map(|w| Matrix3::identity() * *w));
        stiffness.factorise_definite();
        let mut moves = stiffness.gather(framework, &unbalance);
        stiffness.solve(&mut moves);
        let moves = stiffness.scatter(framework, &moves);
        return bases.iter().zip(moves).map(|(base, step)| base + step).collect();
    }
    stiffness.assemble_scalar(densities.iter().copied());
    stiffness.factorise_definite();
    let size = stiffness.size();
    let mut moves = vec![0.0; 3 * size];
    let column_of = |joint: usize| stiffness.first_unknown(joint);
    for (joint, force) in unbalance.iter().enumerate() {
        if let Some(column) = column_of(joint) {
            for axis in 0..3 {
                moves[axis * size + column] = force[axis];
            }
        }
    }
    stiffness.solve(&mut moves);
    let place = |(joint, base): (usize, &Vector3<f64>)| {
        stiffness.first_unknown(joint).map_or(*base, |column| {
            base + Vector3::new(moves[column], moves[size + column], moves[2 * size + column])
        })
    };
    bases.iter().enumerate().map(place).collect()
}
