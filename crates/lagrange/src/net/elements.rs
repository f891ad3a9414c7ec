//! Newton's method with a whole run of members as one element.
//!
//! The span of a run whose first member has the pull $p$ is the sum of its members',
//!
//! $$ D(p) = \sum_k (l_k + c_k |F_k|)\\,\frac{F_k}{|F_k|}, \qquad F_k = p + s_k, $$
//!
//! with the sums $s_k$ of the loads before them, and its derivative, the 3 x 3 matrix
//!
//! $$ D'(p) = \sum_k \frac{l_k}{|F_k|} (1 - u_k u_k^T) + c_k 1, $$
//!
//! comes out of the same pass over the run. Unknowns are the places of the joints where runs meet
//! and one pull a run, equations the balance of those joints and $D(p) = x_b - x_a$: the matrix is
//! that of the branchings. A straight run is stiff along itself; a small part of the compliance
//! across is added there in the matrix, not in the equations.

use matrices::dense::eigen_of_three;
use nalgebra::{Matrix3, Vector3};

use super::coarse::{self, Start};
use super::framework::{Framework, Link};
use super::newton::{Run, with_held};
use super::runs::{Runs, Step};
use super::state::State;
use super::stiffness::Stiffness;
use crate::condensed::sums::BLOCK;
use crate::condensed::sums::DoubleDouble;
use crate::larger::larger;
use crate::thresholds::{GIVEN, HALVED, HALVINGS, MOST_STEPS, ZERO};
use model::system::Kind;

/// The compliance along a member that the matrix has beside its own, in units of that across: each
/// step gains some five digits where it is all there is.
const ALONG: f64 = 1e-5;
/// A force below this part of the largest one in its run has no direction to rely on, nor one below
/// the other part of the largest in the system.
const CLEAR: f64 = 1e-6;
/// The iteration ends when the error of every span is rounding and does not fall to this part of itself any more.
const FALL: f64 = 0.25;

/// The hanging equilibrium in which every member pulls, by runs; nothing when it is none or the
/// runs are too short to pay. The number of factorisations counts those of the coarse start.
pub(super) fn hang(framework: &Framework) -> Option<Run> {
    if !framework.ropes.is_empty() {
        return None;
    }
    let runs = Runs::new(framework)?;
    // It pays when half of the members is left, or less.
    if 2 * coarse::members(&runs) > framework.links.len() {
        return None;
    }
    let (state, steps) = settled(framework, &runs)?;
    // Its memory serves what follows.
    drop(runs);
    Some(Run { steps, ..Run::at(framework, with_held(framework, state)) })
}

/// The shape and the number of factorisations; nothing where a force vanishes.
fn settled(framework: &Framework, runs: &Runs) -> Option<(State, usize)> {
    let start = coarse::start(framework, runs)?;
    let mut steps = start.factorisations;
    let mut shape = Shape::new(framework, runs, start);
    let mut stiffness = Stiffness::new(&shape.skeleton, false).ok()?;
    let mut error = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        shape.step(&mut stiffness);
        steps += 1;
        let before = std::mem::replace(&mut error, shape.error());
        if error.is_nan() || framework.work.is_spent() || (before <= GIVEN && error > FALL * before)
        {
            break;
        }
    }
    shape.clear().then(|| (shape.state(framework), steps))
}

/// What a run spans at a pull.
struct Law {
    span: Vector3<f64>,
    /// Inverse of its compliance.
    stiffness: Matrix3<f64>,
    /// Smallest and largest square of a force.
    least: f64,
    most: f64,
}

impl Law {
    fn new(steps: &[Step], pull: &Vector3<f64>) -> Self {
        // Rounding grows with the square root of their number only.
        let sums = steps.chunks(BLOCK).map(|chunk| Sums::of(chunk, pull));
        let sums = sums.reduce(|sum, more| sum.plus(&more)).unwrap_or_default();
        let compliance = Matrix3::identity() * sums.across - sums.square * (1.0 - ALONG);
        let (least, most) = (sums.least, sums.most);
        Self { span: sums.span, stiffness: inverse(&compliance), least, most }
    }
}

/// Sums over members of a run.
struct Sums {
    span: Vector3<f64>,
    /// Of $l/|F| + c$.
    across: f64,
    /// Of $l/|F|\\,u u^T$.
    square: Matrix3<f64>,
    least: f64,
    most: f64,
}

impl Default for Sums {
    fn default() -> Self {
        let (span, square) = (Vector3::zeros(), Matrix3::zeros());
        Self { span, across: 0.0, square, least: f64::INFINITY, most: 0.0 }
    }
}

impl Sums {
    fn of(steps: &[Step], pull: &Vector3<f64>) -> Self {
        let mut sums = Self::default();
        for step in steps {
            let force = pull + step.offset;
            let squared = force.norm_squared();
            let inverse = squared.sqrt().recip();
            let turn = step.length * inverse;
            sums.span += force * (turn + step.compliance);
            sums.across += turn + step.compliance;
            sums.square += force * (force * (turn * inverse * inverse)).transpose();
            (sums.least, sums.most) = (sums.least.min(squared), sums.most.max(squared));
        }
        sums
    }

    fn plus(mut self, other: &Self) -> Self {
        self.span += other.span;
        self.across += other.across;
        self.square += other.square;
        (self.least, self.most) = (self.least.min(other.least), self.most.max(other.most));
        self
    }
}

/// The inverse of a positive definite matrix: along a straight run its value is 10^5 times that
/// across, and an elimination would lose the smaller one to rounding.
fn inverse(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let (values, axes) = eigen_of_three(matrix).unwrap_or_default();
    let largest = values.amax();
    let values = values.map(|value| value.max(ALONG * ALONG * largest).recip());
    axes * Matrix3::from_diagonal(&values) * axes.transpose()
}

/// Pulls of the runs, and the places of the joints where they meet.
struct Shape<'a> {
    runs: &'a Runs,
    /// The joints that stay, with the elements as its members.
    skeleton: Framework,
    state: State,
    pulls: Vec<Vector3<f64>>,
    laws: Vec<Law>,
}

impl<'a> Shape<'a> {
    fn new(framework: &Framework, runs: &'a Runs, start: Start) -> Self {
        let links = runs.elements.iter().map(|element| Link {
            from: element.from,
            to: element.to,
            length: runs.steps[element.steps.clone()].iter().map(|step| step.length).sum(),
            within: 0.0,
            compliance: 0.0,
            kind: Kind::Bar,
            rope: None,
        });
        let skeleton = framework.of_parts(runs.nodes.clone(), links.collect());
        let state = State::new(start.places, Vec::new(), Vec::new());
        let laws = laws(runs, &start.pulls);
        Self { runs, skeleton, state, pulls: start.pulls, laws }
    }

    fn step(&mut self, stiffness: &mut Stiffness) {
        let gaps = self.gaps();
        stiffness.assemble(&self.skeleton, self.laws.iter().map(|law| law.stiffness));
        stiffness.factorise_definite();
        let now = self.pulls.iter().zip(&self.laws).zip(&gaps);
        let now = now.map(|((pull, law), gap)| pull + law.stiffness * gap);
        let moves = stiffness.moves(&self.skeleton, &self.skeleton.unbalance(now));
        let links = self.skeleton.links.iter().zip(&self.laws).zip(&gaps);
        let change: Vec<Vector3<f64>> =
            links.map(|((link, law), gap)| law.stiffness * (gap + link.span(&moves))).collect();
        self.state = self.state.moved(&moves, 1.0);
        let slope = |shape: &Self| -> f64 {
            change.iter().zip(shape.gaps()).map(|(change, gap)| -change.dot(&gap)).sum()
        };
        let first = slope(self);
        let before = self.pulls.clone();
        let mut t = 1.0;
        for _ in 0..HALVINGS {
            let pulls = before.iter().zip(&change).map(|(pull, change)| pull + change * t);
            self.pulls = pulls.collect();
            self.laws = laws(self.runs, &self.pulls);
            // Else it goes too far beyond the zero.
            if slope(self) <= HALVED * first.abs() {
                break;
            }
            t *= 0.5;
        }
    }

    /// What each run lacks to the distance of its ends.
    fn gaps(&self) -> Vec<Vector3<f64>> {
        let links = self.skeleton.links.iter().zip(&self.laws);
        links
            .map(|(link, law)| {
                link.span(&self.state.places) - law.span + link.span(&self.state.rests)
            })
            .collect()
    }

    /// Largest error of a span, in units of the run's length, or of the balance of a joint, in
    /// units of the largest force.
    fn error(&self) -> f64 {
        let gaps = self.gaps();
        let spans = self.skeleton.links.iter().zip(&gaps);
        let spans = spans.map(|(link, gap)| gap.norm() / link.length);
        let unit = self.laws.iter().map(|law| law.most).fold(0.0, f64::max).sqrt();
        let left = self.skeleton.unbalance(self.pulls.iter().copied());
        let nodes = self.skeleton.nodes.iter().zip(&left);
        let balance = nodes.map(|(node, left)| node.free.components(left).norm() / unit);
        spans.chain(balance).fold(0.0, larger)
    }

    /// Whether every force of the runs is far from none. Those of trees follow from loads alone.
    fn clear(&self) -> bool {
        let twigs = self.runs.twigs.iter().map(|twig| twig.force.norm_squared());
        let most = self.laws.iter().map(|law| law.most).chain(twigs).fold(0.0, f64::max);
        let clear =
            |law: &Law| law.least > CLEAR * CLEAR * law.most && law.least > ZERO * ZERO * most;
        self.laws.iter().all(clear)
    }

    /// Places of all joints and axial forces of all members.
    fn state(&self, framework: &Framework) -> State {
        let places = framework.nodes.iter().map(|node| node.base).collect();
        let taut = framework.links.iter().map(|link| link.kind == Kind::Bar).collect();
        let mut state = State::new(places, vec![0.0; framework.links.len()], taut);
        for (number, &joint) in self.runs.kept.iter().enumerate() {
            state.places[joint] = self.state.places[number];
            state.rests[joint] = self.state.rests[number];
        }
        for (element, pull) in self.runs.elements.iter().zip(&self.pulls) {
            let steps = &self.runs.steps[element.steps.clone()];
            let mut end = Place::of(&state, self.runs.kept[element.from]);
            for step in steps {
                let force = pull + step.offset;
                end.go(&span(step, &force));
            }
            // What rounding leaves to the last joint, spread over the members.
            let to = Place::of(&state, self.runs.kept[element.to]);
            let left = (to.place - end.place) + (to.rest - end.rest);
            let length: f64 = steps.iter().map(|step| step.length).sum();
            let mut at = Place::of(&state, self.runs.kept[element.from]);
            let mut arc = 0.0;
            for (k, step) in steps.iter().enumerate() {
                let force = pull + step.offset;
                state.axial[step.member] = force.norm();
                state.taut[step.member] = true;
                at.go(&span(step, &force));
                arc += step.length;
                if k + 1 < steps.len() {
                    // The part of one member alone would be lost to rounding.
                    let mut shifted = Place { ..at };
                    shifted.go(&(left * (arc / length)));
                    state.places[step.joint] = shifted.place;
                    state.rests[step.joint] = shifted.rest;
                }
            }
        }
        for twig in self.runs.twigs.iter().rev() {
            let link = &framework.links[twig.member];
            let axial = twig.force.norm();
            let mut at = Place::of(&state, twig.root);
            at.go(&(twig.force * (link.length / axial + link.compliance)));
            (state.places[twig.tip], state.rests[twig.tip]) = (at.place, at.rest);
            (state.axial[twig.member], state.taut[twig.member]) = (axial, true);
        }
        state
    }
}

fn laws(runs: &Runs, pulls: &[Vector3<f64>]) -> Vec<Law> {
    let elements = runs.elements.iter().zip(pulls);
    elements.map(|(element, pull)| Law::new(&runs.steps[element.steps.clone()], pull)).collect()
}

fn span(step: &Step, force: &Vector3<f64>) -> Vector3<f64> {
    force * (step.length / force.norm() + step.compliance)
}

/// A place and what rounding has cut off it.
struct Place {
    place: Vector3<f64>,
    rest: Vector3<f64>,
}

impl Place {
    fn of(state: &State, joint: usize) -> Self {
        Self { place: state.places[joint], rest: state.rests[joint] }
    }

    fn go(&mut self, by: &Vector3<f64>) {
        for axis in 0..3 {
            let place = DoubleDouble::sum(self.place[axis], self.rest[axis] + by[axis]);
            (self.place[axis], self.rest[axis]) = (place.high, place.low);
        }
    }
}

#[cfg(test)]
mod tests;
