//! From any shape to a rest: augmented multipliers.
//!
//! The hanging shape of module `hanging` takes bars as cables. Where it leaves a bar slack, or
//! where a member can only push, this module finds a rest of the true members. Every member is
//! given the compliance
//! $c + 1/\rho$ beside a force $N_0$: $N = (|d| - l + N_0/\rho)/(c + 1/\rho)$, kept to the sign the
//! member can bear. The energy of that is smooth, Newton's method brings it to a minimum, and $N_0
//! \leftarrow N$ leads to the true law. A floor at the height $h$ pushes each joint up in the same way, with
//! $\max(0, \rho (h - z) + N_0)$.

use nalgebra::Vector3;

use super::floor::lift;
use super::framework::{Framework, Link};
use super::state::State;
use super::stiffness::Stiffness;
use crate::thresholds::{BETTER, EARNED, MOST_STEPS};
use model::system::Kind;

/// Updates of the forces.
const ROUNDS: usize = 60;
/// First $\rho$ in units of the mean $|N|/l$: members stretch by some percent.
pub(super) const FIRST_PENALTY: f64 = 30.0;
/// The same where the state is to be kept: members stretch by some hundredth of a percent.
pub(super) const NEAR_PENALTY: f64 = 1e4;
/// Growth of $\rho$ when the lengths get better too slowly, and what is too slowly.
const PENALTY_GROWTH: f64 = 5.0;
const SLOW: f64 = 0.25;
/// $\rho$ grows to this multiple of the first one at most: rounding of lengths becomes forces
/// beyond.
const LARGEST_GROWTH: f64 = 1e6;
/// Rounds without better lengths after which the members do not fit from here.
const STUCK: usize = 5;
/// A joint at this multiple of all lengths and supports together is on its way to infinity.
const FAR: f64 = 1e3;
/// Lengths right to this part: the final iteration takes over.
const CLOSE: f64 = 1e-7;
/// Forces in balance to this part of the largest before an update.
const BALANCED: f64 = 1e-3;
const HALVINGS: usize = 40;
/// Stiffness given to every joint where the matrix is not definite, in units of the mean $|N|/l$:
/// the first one, and how it grows until the matrix is definite and falls from step to step.
const SHIFT: f64 = 1e-3;
const SHIFT_GROWTH: f64 = 8.0;
const SHIFT_FALL: f64 = 0.25;
/// The shift where none is needed: a joint that nothing holds in some direction follows its load.
const FLAT: f64 = 1e-6;
/// Shifts tried; then the negative pivots are left out.
const TRIES: usize = 20;

/// A rest near a state.
pub(super) struct Rest {
    pub state: State,
    pub factorisations: usize,
    /// Whether the lengths fit.
    pub fits: bool,
    /// A joint that has left every bound, if there is one.
    pub lost: Option<usize>,
    /// Whether the floor pushes each joint.
    pub lies: Vec<bool>,
}

/// Settle from a state, with a first penalty, above a floor at this height.
pub(super) fn settle(
    framework: &Framework,
    stiffness: &mut Stiffness,
    mut state: State,
    first: f64,
    floor: Option<f64>,
) -> Rest {
    let mut penalty = Penalty::new(framework, &state, first, floor);
    let (mut factorisations, mut best, mut since, mut fits) = (0, f64::INFINITY, 0, false);
    let mut lost = None;
    for _ in 0..ROUNDS {
        let (steps, balanced) = penalty.rest(framework, stiffness, &mut state);
        factorisations += steps;
        lost = penalty.lost(&state.places);
        if lost.is_some() || framework.work.is_spent() {
            break;
        }
        let axial = penalty.forces(framework, &state.places);
        let pushes = penalty.pushes(framework, &state.places);
        let misfit = penalty.misfit(framework, &axial, &pushes);
        (penalty.offsets, penalty.push_offsets) = (axial, pushes);
        fits = misfit <= CLOSE;
        if fits && balanced {
            break;
        }
        if misfit > SLOW * best && penalty.rho < LARGEST_GROWTH * penalty.first {
            penalty.rho *= PENALTY_GROWTH;
        }
        since = if misfit < BETTER * best { 0 } else { since + 1 };
        best = best.min(misfit);
        if since >= STUCK && !fits {
            break;
        }
    }
    state.axial = penalty.offsets;
    let links = framework.links.iter().zip(&state.axial);
    state.taut = links.map(|(link, axial)| link.kind == Kind::Bar || link.bears(*axial)).collect();
    let lies = penalty.push_offsets.iter().map(|push| *push > 0.0).collect();
    Rest { state, factorisations, fits, lost, lies }
}

struct Penalty {
    rho: f64,
    first: f64,
    mean: f64,
    offsets: Vec<f64>,
    floor: Option<f64>,
    push_offsets: Vec<f64>,
    /// No joint of a system that hangs together gets further from the origin.
    reach: f64,
}

impl Penalty {
    fn new(framework: &Framework, state: &State, first: f64, floor: Option<f64>) -> Self {
        let densities =
            framework.links.iter().zip(&state.axial).map(|(l, axial)| axial.abs() / l.length);
        let mean = densities.sum::<f64>() / framework.links.len().max(1) as f64;
        let mean = if mean > 0.0 { mean } else { 1.0 };
        let offsets = state.axial.clone();
        let bases = framework.nodes.iter().map(|node| node.base.amax()).fold(0.0, f64::max);
        let lengths: f64 = framework.links.iter().map(|link| link.length).sum();
        let reach = FAR * (bases + lengths);
        let push_offsets = vec![0.0; framework.nodes.len()];
        let rho = first * mean;
        Self { rho, first: rho, mean, offsets, floor, push_offsets, reach }
    }

    fn lost(&self, places: &[Vector3<f64>]) -> Option<usize> {
        places.iter().position(|place| place.amax() > self.reach)
    }

    fn stiffness(&self, link: &Link) -> f64 {
        (link.compliance + self.rho.recip()).recip()
    }

    fn force(&self, link: &Link, length: f64, offset: f64) -> f64 {
        let force = (length - link.length + offset / self.rho) * self.stiffness(link);
        if link.kind == Kind::Bar || link.bears(force) { force } else { 0.0 }
    }

    fn forces(&self, framework: &Framework, places: &[Vector3<f64>]) -> Vec<f64> {
        let links = framework.links.iter().zip(&self.offsets).enumerate();
        let length = |span: usize| framework.links[span].span(places).norm();
        links.map(|(k, (link, n))| self.force(link, framework.whole(k, length), *n)).collect()
    }

    /// Push of the floor on each joint.
    fn pushes(&self, framework: &Framework, places: &[Vector3<f64>]) -> Vec<f64> {
        let joints = framework.nodes.iter().zip(places).zip(&self.push_offsets);
        let push = |((node, place), offset): ((_, &Vector3<f64>), &f64)| match self.floor {
            Some(floor) if lift(node).is_some() => (self.rho * (floor - place.z) + offset).max(0.0),
            _ => 0.0,
        };
        joints.map(push).collect()
    }

    /// Largest error of a length, in units of the length, and of a height: the update of the force over $\rho$.
    fn misfit(&self, framework: &Framework, axial: &[f64], pushes: &[f64]) -> f64 {
        let pushes = pushes.iter().zip(&self.push_offsets);
        let heights = pushes.map(|(push, offset)| (push - offset).abs() / self.rho);
        let links = framework.links.iter().zip(axial).zip(&self.offsets);
        let moved = links.filter(|((link, _), _)| framework.moves(link));
        moved
            .map(|((link, axial), offset)| (axial - offset).abs() / (self.rho * link.length))
            .chain(heights)
            .fold(0.0, f64::max)
    }

    fn energy(&self, framework: &Framework, places: &[Vector3<f64>]) -> f64 {
        let members = &framework.links[..framework.members()];
        let links = members.iter().zip(self.forces(framework, places));
        let stored = links.map(|(link, force)| 0.5 * force * force / self.stiffness(link));
        let loads = framework.nodes.iter().zip(places).map(|(node, place)| -node.load.dot(place));
        let pressed = self.pushes(framework, places).into_iter().map(|push| 0.5 * push * push);
        stored.sum::<f64>() + loads.sum::<f64>() + pressed.sum::<f64>() / self.rho
    }

    /// Newton's method on the energy; the number of factorisations, and whether it ended in
    /// balance.
    fn rest(
        &self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &mut State,
    ) -> (usize, bool) {
        let (mut shift, mut factorisations) = (0.0, 0);
        // In step with the lengths.
        let accuracy = BALANCED * self.first / self.rho;
        for _ in 0..MOST_STEPS {
            state.axial = self.forces(framework, &state.places);
            let directions = state.directions(framework);
            let mut unbalance = framework.left(&directions, &state.axial);
            let pushes = self.pushes(framework, &state.places);
            unbalance.iter_mut().zip(&pushes).for_each(|(force, push)| force.z += push);
            let gradient = stiffness.gather(framework, &unbalance);
            let largest = gradient.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
            if largest <= accuracy * state.largest_force(framework) {
                return (factorisations, true);
            }
            let (tries, used) = self.factorise(framework, stiffness, state, &directions, shift);
            (factorisations, shift) = (factorisations + tries, used * SHIFT_FALL);
            let mut moves = gradient.clone();
            stiffness.solve(&mut moves);
            let slope: f64 = gradient.iter().zip(&moves).map(|(g, s)| g * s).sum();
            let moves = stiffness.scatter(framework, &moves);
            let Some(places) = self.lower(framework, &state.places, &moves, slope) else {
                return (factorisations, false);
            };
            state.places = places;
            if self.lost(&state.places).is_some() {
                break;
            }
        }
        (factorisations, false)
    }

    /// The places of the longest of the halved steps that lowers the energy.
    fn lower(
        &self,
        framework: &Framework,
        from: &[Vector3<f64>],
        moves: &[Vector3<f64>],
        slope: f64,
    ) -> Option<Vec<Vector3<f64>>> {
        let before = self.energy(framework, from);
        let mut t = 1.0;
        (0..HALVINGS).find_map(|_| {
            let places: Vec<_> = from.iter().zip(moves).map(|(p, step)| p + step * t).collect();
            let falls = self.energy(framework, &places) <= before - EARNED * t * slope;
            t *= 0.5;
            falls.then_some(places)
        })
    }

    /// Factorise the second derivative of the energy, shifted until it is definite: the number of
    /// factorisations and the shift.
    fn factorise(
        &self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &State,
        directions: &[(Vector3<f64>, f64)],
        first: f64,
    ) -> (usize, f64) {
        let least = SHIFT * self.mean;
        let mut shift = if first < least { FLAT * self.mean } else { first };
        for tries in 1.. {
            self.assemble(framework, stiffness, state, directions);
            stiffness.shift(shift);
            if stiffness.factorise_indefinite() && stiffness.negative_pivots() == 0 {
                return (tries, shift);
            }
            shift = (shift * SHIFT_GROWTH).max(least);
            if tries >= TRIES {
                break;
            }
        }
        stiffness.factorise_definite();
        (TRIES, shift)
    }

    /// The second derivative of the energy.
    fn assemble(
        &self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &State,
        directions: &[(Vector3<f64>, f64)],
    ) {
        stiffness.assemble_members(framework, |k| {
            let (link, (u, length), axial) = (&framework.links[k], directions[k], state.axial[k]);
            if length <= 0.0 {
                return (u, 0.0, 0.0);
            }
            let works = link.kind == Kind::Bar || axial != 0.0;
            (u, axial / length, if works { self.stiffness(link) } else { 0.0 })
        });
        let pushed = self.pushes(framework, &state.places).into_iter().enumerate();
        for (joint, _) in pushed.filter(|(_, push)| *push > 0.0) {
            stiffness.press(
                joint,
                self.rho,
                &framework.nodes[joint].free.components(&Vector3::z()),
            );
        }
    }
}
