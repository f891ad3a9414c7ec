//! From any shape to a rest: augmented multipliers.
//!
//! The hanging shape of module `hanging` takes bars as cables. Where it leaves a bar slack, or
//! where a member can only push, this module finds a rest of the true members. Every member is
//! given the compliance
//! $c + 1/\rho$ beside a force $N_0$: $N = (|d| - l + N_0/\rho)/(c + 1/\rho)$, kept to the sign the
//! member can bear. The energy of that is smooth, Newton's method brings it to a minimum, and $N_0
//! \leftarrow N$ leads to the true law.

use nalgebra::{Matrix3, Vector3};

use super::framework::{Framework, Link};
use super::law::by_direction;
use super::state::State;
use super::stiffness::Stiffness;
use model::system::Kind;

/// First $\rho$ in units of the mean $|N|/l$: members stretch by some percent.
const FIRST_PENALTY: f64 = 30.0;
/// Growth of $\rho$ when the lengths get better too slowly, and what is too slowly.
const PENALTY_GROWTH: f64 = 5.0;
const SLOW: f64 = 0.25;
/// $\rho$ grows to this multiple of the first one at most: rounding of lengths becomes forces
/// beyond.
const LARGEST_GROWTH: f64 = 1e6;
/// Updates of the forces.
const ROUNDS: usize = 60;
/// Newton steps between two updates.
const STEPS: usize = 100;
/// Lengths right to this part: the final iteration takes over.
const CLOSE: f64 = 1e-7;
/// Forces in balance to this part of the largest before an update.
const BALANCED: f64 = 1e-3;
/// A step is accepted when the energy falls by this part of what the slope promises.
const ARMIJO: f64 = 1e-4;
const HALVINGS: usize = 40;
/// Stiffness given to every joint where the matrix is not definite, in units of the mean $|N|/l$.
const SHIFT: f64 = 1e-2;

/// A rest near a state: places, forces, and the factorisations it took.
pub(super) fn settle(
    framework: &Framework,
    stiffness: &mut Stiffness,
    mut state: State,
) -> (State, usize) {
    let mut penalty = Penalty::new(framework, &state);
    let (mut steps, mut last) = (0, f64::INFINITY);
    for _ in 0..ROUNDS {
        steps += penalty.rest(framework, stiffness, &mut state);
        let axial = penalty.forces(framework, &state.places);
        let misfit = penalty.misfit(framework, &axial);
        penalty.offsets = axial;
        if misfit <= CLOSE {
            break;
        }
        if misfit > SLOW * last && penalty.rho < LARGEST_GROWTH * penalty.first {
            penalty.rho *= PENALTY_GROWTH;
        }
        last = misfit;
    }
    state.axial = penalty.offsets;
    let links = framework.links.iter().zip(&state.axial);
    state.taut = links.map(|(link, axial)| link.kind == Kind::Bar || link.bears(*axial)).collect();
    (state, steps)
}

struct Penalty {
    rho: f64,
    first: f64,
    mean: f64,
    offsets: Vec<f64>,
}

impl Penalty {
    fn new(framework: &Framework, state: &State) -> Self {
        let densities =
            framework.links.iter().zip(&state.axial).map(|(l, axial)| axial.abs() / l.length);
        let mean = densities.sum::<f64>() / framework.links.len().max(1) as f64;
        let mean = if mean > 0.0 { mean } else { 1.0 };
        let offsets = state.axial.clone();
        Self { rho: FIRST_PENALTY * mean, first: FIRST_PENALTY * mean, mean, offsets }
    }

    fn stiffness(&self, link: &Link) -> f64 {
        (link.compliance + self.rho.recip()).recip()
    }

    /// Axial force at a length.
    fn force(&self, link: &Link, length: f64, offset: f64) -> f64 {
        let force = (length - link.length + offset / self.rho) * self.stiffness(link);
        if link.kind == Kind::Bar || link.bears(force) { force } else { 0.0 }
    }

    fn forces(&self, framework: &Framework, places: &[Vector3<f64>]) -> Vec<f64> {
        let links = framework.links.iter().zip(&self.offsets);
        links.map(|(link, offset)| self.force(link, link.span(places).norm(), *offset)).collect()
    }

    /// Largest error of a length, in units of the length: the update of the force over $\rho$.
    fn misfit(&self, framework: &Framework, axial: &[f64]) -> f64 {
        let links = framework.links.iter().zip(axial).zip(&self.offsets);
        let moved = links.filter(|((link, _), _)| framework.moves(link));
        moved
            .map(|((link, axial), offset)| (axial - offset).abs() / (self.rho * link.length))
            .fold(0.0, f64::max)
    }

    fn energy(&self, framework: &Framework, places: &[Vector3<f64>]) -> f64 {
        let links = framework.links.iter().zip(self.forces(framework, places));
        let stored = links.map(|(link, force)| 0.5 * force * force / self.stiffness(link));
        let loads = framework.nodes.iter().zip(places).map(|(node, place)| -node.load.dot(place));
        stored.sum::<f64>() + loads.sum::<f64>()
    }

    /// Newton's method on the energy; the number of factorisations.
    fn rest(&self, framework: &Framework, stiffness: &mut Stiffness, state: &mut State) -> usize {
        for step in 0..STEPS {
            state.axial = self.forces(framework, &state.places);
            let directions = state.directions(framework);
            let pulls = directions.iter().zip(&state.axial).map(|((u, _), axial)| u * *axial);
            let unbalance = framework.unbalance(pulls);
            let gradient = stiffness.gather(framework, &unbalance);
            let largest = gradient.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
            if largest <= BALANCED * state.largest_force(framework) * self.accuracy() {
                return step;
            }
            self.assemble(framework, stiffness, state, &directions, true);
            if !stiffness.factorise_indefinite() || stiffness.negative_pivots() > 0 {
                self.assemble(framework, stiffness, state, &directions, false);
                stiffness.shift(SHIFT * self.mean);
                stiffness.factorise_definite();
            }
            let mut moves = gradient.clone();
            stiffness.solve(&mut moves);
            let slope: f64 = gradient.iter().zip(&moves).map(|(g, s)| g * s).sum();
            let moves = stiffness.scatter(framework, &moves);
            let before = self.energy(framework, &state.places);
            let mut t = 1.0;
            let found = (0..HALVINGS).find_map(|_| {
                let places: Vec<_> =
                    state.places.iter().zip(&moves).map(|(place, step)| place + step * t).collect();
                let falls = self.energy(framework, &places) <= before - ARMIJO * t * slope;
                t *= 0.5;
                falls.then_some(places)
            });
            let Some(places) = found else { return step + 1 };
            state.places = places;
        }
        STEPS
    }

    /// Balance is asked for in step with the lengths.
    fn accuracy(&self) -> f64 {
        self.first / self.rho
    }

    /// The second derivative of the energy; without `full` the parts that may be negative are left
    /// out.
    fn assemble(
        &self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &State,
        directions: &[(Vector3<f64>, f64)],
        full: bool,
    ) {
        let links = framework.links.iter().zip(directions).zip(&state.axial);
        let blocks = links.map(|((link, (u, length)), axial)| {
            if *length <= 0.0 {
                return Matrix3::zeros();
            }
            let works = link.kind == Kind::Bar || *axial != 0.0;
            let across = if full { axial / length } else { axial.max(0.0) / length };
            by_direction(u, across, if works { self.stiffness(link) } else { 0.0 })
        });
        stiffness.assemble(framework, blocks);
    }
}
