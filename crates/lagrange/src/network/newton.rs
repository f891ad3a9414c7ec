//! Newton's method on places and axial forces together.
//!
//! With the directions $u$ and lengths $d$ of the members the equations are the balance of the
//! joints and
//! $|d| = l + c\,N$ for every taut member, and their derivative is
//!
//! $$ \begin{bmatrix} \sum C^T \tfrac{N}{d} (1 - u u^T) C & C^T u \\\\ u^T C & -c \end{bmatrix}. $$
//!
//! It is symmetric and indefinite. A step solves it by refinement: with $-c - 1/\rho$ in place of
//! $-c$ the forces can be eliminated, which leaves a matrix over the joints alone, and the small
//! $1/\rho$ is taken out again by the residual of the true system. The same equations hold at every
//! equilibrium, stable or not.

use nalgebra::Vector3;

use super::framework::Framework;
use super::law::by_direction;
use super::residual::Residual;
use super::settings::Settings;
use super::state::State;
use super::stiffness::Stiffness;

/// $\rho$ in units of the largest stiffness $N/l$: far above it, so that a sweep gains some digits,
/// and far below the inverse of rounding.
const PENALTY: f64 = 1e5;
/// Sweeps of refinement in a step.
const SWEEPS: usize = 8;
/// Refinement of a step ends when the residual of the linear system has fallen to this part.
const REFINED: f64 = 3e-6;
/// A step is accepted when the merit falls by this part of what the slope promises.
const ARMIJO: f64 = 1e-4;
/// A step is halved at most so many times.
const HALVINGS: usize = 24;

/// In this many steps the merit ought to fall to this part, or the start was too far away.
const HALVED: f64 = 0.5;
const SLOW_STEPS: usize = 3;

/// When a run of Newton's method ends without success.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Patience {
    /// As soon as the steps hardly help: there is a nearer start to be had.
    Little,
    /// When no step helps at all.
    Full,
}

/// A run of Newton's method: the best state, its residual, and the steps it took.
pub(super) struct Run {
    pub state: State,
    pub residual: Residual,
    pub steps: usize,
}

impl Run {
    /// A run that has made no step yet.
    pub fn at(framework: &Framework, state: State) -> Self {
        Self { residual: Residual::new(framework, &state), state, steps: 0 }
    }
}

/// The state with the forces of elastic members between anchors, which nothing else changes.
pub(super) fn with_held(framework: &Framework, mut state: State) -> State {
    for (k, link) in framework.links.iter().enumerate() {
        if let Some(force) = framework.held_force(link) {
            (state.axial[k], state.taut[k]) = (force, link.bears(force));
        }
    }
    state
}

/// Improve a state until it is in equilibrium to rounding, or no step helps.
pub(super) fn polish(
    framework: &Framework,
    stiffness: &mut Stiffness,
    settings: &Settings,
    state: State,
    patience: Patience,
) -> Run {
    let mut run = Run::at(framework, with_held(framework, state));
    let (mut merit, mut slow) = (run.residual.merit, 0);
    while run.steps < settings.max_iterations {
        let done = run.residual.size() <= settings.tolerance;
        let Residual { forces, lengths, .. } = &run.residual;
        // What is left of rounding goes with the factor of the last step.
        let derivative = if done && run.steps > 0 {
            Some(Derivative::unfactored(framework, &run.state, &run.residual))
        } else {
            Derivative::new(framework, stiffness, &run.state, &run.residual)
        };
        let step =
            derivative.and_then(|d| d.solve(framework, stiffness, (forces, lengths), REFINED));
        let Some((step, _)) = step else { break };
        run.steps += 1;
        let Some((state, residual)) = search(framework, &run, &step, done) else { break };
        (run.state, run.residual) = (state, residual);
        slow += 1;
        if run.residual.merit <= HALVED * merit {
            (merit, slow) = (run.residual.merit, 0);
        }
        if done || (patience == Patience::Little && slow >= SLOW_STEPS) {
            break;
        }
    }
    run
}

/// The longest of the halved steps that lowers the merit.
fn search(framework: &Framework, run: &Run, step: &Step, done: bool) -> Option<(State, Residual)> {
    let mut t = 1.0;
    for _ in 0..if done { 1 } else { HALVINGS } {
        let state = step.applied(&run.state, t);
        let residual = Residual::new(framework, &state);
        if residual.merit <= run.residual.merit * (1.0 - 2.0 * ARMIJO * t) {
            return Some((state, residual));
        }
        t *= 0.5;
    }
    None
}

/// Change of places and of axial forces.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub places: Vec<Vector3<f64>>,
    pub axial: Vec<f64>,
}

/// One row of the derivative: a member's direction and its stiffnesses.
struct Row {
    u: Vector3<f64>,
    /// $N/d$, normal to the member.
    across: f64,
    /// Whether the member keeps its length.
    taut: bool,
    compliance: f64,
    /// $1/(c + 1/\rho)$.
    along: f64,
}

/// The derivative of the equations at a state, whose factor a [`Stiffness`] holds.
pub(super) struct Derivative {
    rows: Vec<Row>,
    /// Largest force, the unit of balance.
    unit: f64,
}

impl Derivative {
    /// Factorise it; nothing when the factor is not finite.
    pub fn new(
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &State,
        residual: &Residual,
    ) -> Option<Self> {
        Self::unfactored(framework, state, residual).factored(framework, stiffness)
    }

    /// The same with the true stiffness of the elastic members, however stiff they are.
    pub fn elastic(
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &State,
        residual: &Residual,
    ) -> Option<Self> {
        let mut new = Self::unfactored(framework, state, residual);
        for row in &mut new.rows {
            if row.taut && row.compliance > 0.0 {
                row.along = row.compliance.recip();
            }
        }
        new.factored(framework, stiffness)
    }

    fn factored(self, framework: &Framework, stiffness: &mut Stiffness) -> Option<Self> {
        let new = self;
        let blocks = new.rows.iter().map(|row| by_direction(&row.u, row.across, row.along));
        stiffness.assemble(framework, blocks);
        let finite = stiffness.factorise_indefinite();
        finite.then_some(new)
    }

    /// The same for a stiffness that holds a factor from nearby.
    fn unfactored(framework: &Framework, state: &State, residual: &Residual) -> Self {
        Self { rows: rows(framework, state, &residual.directions), unit: residual.unit }
    }

    /// What concerns taut members; zero for the others.
    pub fn of_taut(&self, values: &[f64]) -> Vec<f64> {
        let rows = self.rows.iter().zip(values);
        rows.map(|(row, value)| if row.taut { *value } else { 0.0 }).collect()
    }

    /// The step that takes unbalanced forces and misfits of the lengths away to first order, and
    /// the part of their norm that it leaves, once that is below `enough` or falls no further;
    /// nothing when it leaves all.
    pub fn solve(
        &self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        (forces, lengths): (&[Vector3<f64>], &[f64]),
        enough: f64,
    ) -> Option<(Step, f64)> {
        let mut step = Step {
            places: vec![Vector3::zeros(); framework.nodes.len()],
            axial: vec![0.0; framework.links.len()],
        };
        let mut left = (forces.to_vec(), lengths.to_vec());
        let first = size(framework, forces, lengths, self.unit);
        let mut last = f64::INFINITY;
        for _ in 0..SWEEPS {
            let better = self.refined(&step, framework, stiffness, &left.0, &left.1);
            left = self.left(&better, framework, forces, lengths);
            let size = size(framework, &left.0, &left.1, self.unit);
            if size.is_nan() || size >= last {
                break;
            }
            (step, last) = (better, size);
            if size <= enough * enough * first {
                break;
            }
        }
        // A step that leaves all of the residual does not count.
        (last < first).then(|| (step, (last / first).sqrt()))
    }

    /// The step plus the solution for what is left.
    fn refined(
        &self,
        step: &Step,
        framework: &Framework,
        stiffness: &mut Stiffness,
        forces: &[Vector3<f64>],
        lengths: &[f64],
    ) -> Step {
        let mut right = forces.to_vec();
        for ((link, row), misfit) in framework.links.iter().zip(&self.rows).zip(lengths) {
            let pull = row.u * (row.along * misfit);
            right[link.from] -= pull;
            right[link.to] += pull;
        }
        let mut moves = stiffness.gather(framework, &right);
        stiffness.solve(&mut moves);
        let moves = stiffness.scatter(framework, &moves);
        let links = framework.links.iter().zip(&self.rows).zip(lengths);
        let axial =
            links.map(|((link, row), misfit)| row.along * (row.u.dot(&link.span(&moves)) - misfit));
        Step {
            axial: step.axial.iter().zip(axial).map(|(a, more)| a + more).collect(),
            places: step.places.iter().zip(&moves).map(|(place, more)| place + more).collect(),
        }
    }

    /// What a step leaves of unbalanced forces and misfits to first order.
    pub fn left(
        &self,
        step: &Step,
        framework: &Framework,
        forces: &[Vector3<f64>],
        lengths: &[f64],
    ) -> (Vec<Vector3<f64>>, Vec<f64>) {
        let (mut forces, mut lengths) = (forces.to_vec(), lengths.to_vec());
        for (k, (link, row)) in framework.links.iter().zip(&self.rows).enumerate() {
            let change = link.span(&step.places);
            let stretch = row.u.dot(&change);
            let pull = (change - row.u * stretch) * row.across + row.u * step.axial[k];
            forces[link.from] += pull;
            forces[link.to] -= pull;
            if row.taut {
                lengths[k] -= stretch - row.compliance * step.axial[k];
            }
        }
        (forces, lengths)
    }
}

impl Step {
    pub fn applied(&self, state: &State, t: f64) -> State {
        let mut next = state.moved(&self.places, t);
        for (axial, step) in next.axial.iter_mut().zip(&self.axial) {
            *axial += step * t;
        }
        next
    }
}

fn size(framework: &Framework, forces: &[Vector3<f64>], lengths: &[f64], unit: f64) -> f64 {
    let forces = framework.nodes.iter().zip(forces);
    let squares = forces.map(|(node, force)| node.free.components(force).norm_squared());
    squares.sum::<f64>() / (unit * unit) + lengths.iter().map(|l| l * l).sum::<f64>()
}

fn rows(framework: &Framework, state: &State, directions: &[(Vector3<f64>, f64)]) -> Vec<Row> {
    let across = |k: usize| -> f64 {
        let (_, length) = directions[k];
        if length > 0.0 { state.axial[k] / length } else { 0.0 }
    };
    let links = framework.links.iter();
    let stiffest = (0..directions.len()).map(|k| across(k).abs()).fold(0.0, f64::max);
    let rho = PENALTY * if stiffest > 0.0 { stiffest } else { 1.0 };
    links
        .enumerate()
        .map(|(k, link)| {
            let taut = state.taut[k] && framework.moves(link);
            Row {
                u: directions[k].0,
                across: across(k),
                taut,
                compliance: link.compliance,
                along: if taut { (link.compliance + rho.recip()).recip() } else { 0.0 },
            }
        })
        .collect()
}
