//! Many chains of the same number of bars.

use std::slice::from_ref;
use std::sync::atomic::{AtomicUsize, Ordering};

use funicular::prelude::{Anchors, Bar, Chain, Error, SolverName, Solvers, Vector};
use lagrange::condensed;
use model::system::System;
use model::{Equilibrium, Problem, Rung};
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use validate::systems::{SystemFailure, ask_with, judge_chain};
use validate::{Question, UseCensus};

use crate::arrays::{numbers, vectors};
use crate::many::Many;
use crate::raise::internal;
use crate::told::{self, Told};
use crate::{words, work};

/// Chains that one thread takes at a time: some milliseconds, so that Ctrl-C is felt.
const BLOCK: usize = 256;

/// What is asked.
struct Batch {
    bars: usize,
    lengths_m: Vec<f64>,
    masses_kg: Vec<f64>,
    centres_m: Option<Vec<f64>>,
    starts_m: Vec<Vector>,
    ends_m: Vec<Vector>,
    gravity_m_s2: f64,
    solvers: Solvers,
}

/// The hanging equilibrium of a chain, as there are arrays of it.
struct Found {
    joints_m: Vec<Vector>,
    forces_n: Vec<Vector>,
    axial_n: Vec<f64>,
    energy_j: f64,
    residual: f64,
    /// The largest violation of Newton's laws.
    statics: f64,
    rung: Option<Rung>,
}

impl Found {
    fn new(problem: &Problem, found: &Equilibrium) -> Self {
        Self {
            joints_m: found.joints_m.clone(),
            forces_n: found.multipliers_n.clone(),
            axial_n: found.axial_n.clone(),
            energy_j: found.energy_j,
            residual: found.evidence.residual,
            statics: judge_chain(problem, found).largest(),
            rung: found.evidence.rung(),
        }
    }
}

impl Batch {
    fn problem(&self, chain: usize) -> Result<Problem, Error> {
        let n = self.bars;
        let bar = |k: usize| {
            let (length_m, mass_kg) = (self.lengths_m[k], self.masses_kg[k]);
            let centre_m = self.centres_m.as_ref().map(|centres| centres[k]);
            Bar::given(length_m, mass_kg, centre_m, None)
        };
        let bars = (chain * n..(chain + 1) * n).map(bar).collect::<Result<Vec<_>, _>>()?;
        let anchors = Anchors { start_m: self.starts_m[chain], end_m: self.ends_m[chain] };
        Ok(Problem::new(Chain::new(String::new(), self.gravity_m_s2, anchors, bars)?)?)
    }

    /// Of chains in a row: the memory of one solver serves them all.
    fn block(&self, chains: std::ops::Range<usize>) -> Vec<Result<Found, Told>> {
        let mut solver = condensed::Solver::default();
        chains.map(|chain| self.one(chain, &mut solver)).collect()
    }

    fn one(&self, chain: usize, solver: &mut condensed::Solver) -> Result<Found, Told> {
        let problem = self.problem(chain).map_err(|error| Told::of(&error))?;
        let settings = Question::default().condensed(self.bars);
        let alone = self.solvers == Solvers::Lagrange;
        let Some(Ok(solved)) = alone.then(|| solver.solve(&problem, &settings)) else {
            return self.asked(&problem);
        };
        let found = Found::new(&problem, &solved.equilibrium);
        solver.take_back(solved);
        Ok(found)
    }

    /// Asked, compared and certified like a system alone, but for the census.
    fn asked(&self, problem: &Problem) -> Result<Found, Told> {
        let question =
            Question { solvers: self.solvers, census: UseCensus::Never, ..Question::default() };
        let system = System::from(problem.chain());
        let answer = ask_with(&system, &question, &|_| {});
        let first = answer.by(&SolverName::LAGRANGE).or(answer.equilibria.first());
        let as_chain = |found| system.as_row()?.chain_equilibrium(found);
        let found = first.and_then(as_chain).ok_or_else(|| unsolved(&answer.failures))?;
        Ok(Found::new(problem, &found))
    }
}

fn unsolved(failures: &[SystemFailure]) -> Told {
    let message = failures.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    let failures = told::failures(failures.iter().map(funicular::Failure::of));
    Told::new("Unsolved", message, failures)
}

/// The hanging equilibria of chains: arrays with an entry for each, NaN where there is none, and
/// why.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "arrays, one for each quantity")]
pub fn solve_many<'py>(
    py: Python<'py>,
    chains: usize,
    bars: usize,
    lengths_m: PyReadonlyArrayDyn<'py, f64>,
    masses_kg: PyReadonlyArrayDyn<'py, f64>,
    centres_m: Option<PyReadonlyArrayDyn<'py, f64>>,
    starts_m: PyReadonlyArrayDyn<'py, f64>,
    ends_m: PyReadonlyArrayDyn<'py, f64>,
    gravity_m_s2: f64,
    solver: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let batch = Batch {
        bars,
        lengths_m: numbers(&lengths_m)?,
        masses_kg: numbers(&masses_kg)?,
        centres_m: centres_m.as_ref().map(numbers).transpose()?,
        starts_m: vectors(&starts_m)?,
        ends_m: vectors(&ends_m)?,
        gravity_m_s2,
        solvers: words::solvers(solver)?,
    };
    let all = chains.saturating_mul(bars);
    for (what, wanted, found) in [
        ("lengths", all, batch.lengths_m.len()),
        ("masses", all, batch.masses_kg.len()),
        ("centres", all, batch.centres_m.as_ref().map_or(all, Vec::len)),
        ("starts", chains, batch.starts_m.len()),
        ("ends", chains, batch.ends_m.len()),
    ] {
        // A wrong shape, which the Python half has looked for before.
        if wanted != found {
            return Err(internal(&format!("{what}: {wanted} numbers wanted, got {found}")));
        }
    }
    let found = work::run(py, threads, progress.as_ref(), move |watch| {
        let done = AtomicUsize::new(0);
        let block = |k: usize| {
            let block = batch.block(k * BLOCK..chains.min((k + 1) * BLOCK));
            let done = done.fetch_add(block.len(), Ordering::Relaxed) + block.len();
            watch.tell("chains", done as u64, chains as u64);
            block
        };
        (0..chains.div_ceil(BLOCK)).into_par_iter().flat_map_iter(block).collect()
    })?;
    let many = Many::<Found>::new(py, found);
    let places = [bars + 1, 3];
    many.add("joints_m", &places, |found| found.joints_m.as_flattened())?;
    many.add("forces_n", &places, |found| found.forces_n.as_flattened())?;
    many.add("axial_n", &[bars], |found| &found.axial_n)?;
    many.add("energy_j", &[], |found| from_ref(&found.energy_j))?;
    many.add("residual", &[], |found| from_ref(&found.residual))?;
    many.add("statics", &[], |found| from_ref(&found.statics))?;
    many.done(|found| found.rung)
}
