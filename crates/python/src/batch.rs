//! Many chains of the same number of bars.

use funicular::prelude::{Anchors, Bar, Chain, Error, SolverName, Solvers, Vector};
use lagrange::condensed;
use model::system::System;
use model::{Equilibrium, Problem, Rung};
use numpy::{PyArrayMethods as _, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use validate::systems::{SystemFailure, ask_with, judge_chain};
use validate::{Question, UseCensus};

use crate::arrays::{column, numbers, vectors};
use crate::raise::{internal, parts};
use crate::told::{self, Told};
use crate::{words, work};

/// Chains that one thread takes at a time: some milliseconds, so that Ctrl-C is felt.
const BLOCK: usize = 256;

/// No rung was reached.
pub const NO_RUNG: i8 = -1;

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

/// The answers of some chains in a row: an entry, row or block of rows for each.
#[derive(Default)]
struct Block {
    joints_m: Vec<Vector>,
    forces_n: Vec<Vector>,
    axial_n: Vec<f64>,
    energy_j: Vec<f64>,
    residual: Vec<f64>,
    statics: Vec<f64>,
    rung: Vec<i8>,
    failures: Vec<(usize, Told)>,
}

impl Block {
    fn add(&mut self, found: &Equilibrium, statics: f64) {
        self.joints_m.extend_from_slice(&found.joints_m);
        self.forces_n.extend_from_slice(&found.multipliers_n);
        self.axial_n.extend_from_slice(&found.axial_n);
        self.energy_j.push(found.energy_j);
        self.residual.push(found.evidence.residual);
        self.statics.push(statics);
        self.rung.push(found.evidence.rung().map_or(NO_RUNG, number));
    }

    fn add_failure(&mut self, chain: usize, bars: usize, told: Told) {
        self.joints_m.extend(std::iter::repeat_n([f64::NAN; 3], bars + 1));
        self.forces_n.extend(std::iter::repeat_n([f64::NAN; 3], bars + 1));
        self.axial_n.extend(std::iter::repeat_n(f64::NAN, bars));
        self.energy_j.push(f64::NAN);
        self.residual.push(f64::NAN);
        self.statics.push(f64::NAN);
        self.rung.push(NO_RUNG);
        self.failures.push((chain, told));
    }
}

/// The number of a rung, lowest first, from 0.
pub fn number(rung: Rung) -> i8 {
    let place = Rung::ALL.iter().position(|other| *other == rung);
    place.and_then(|k| k.try_into().ok()).unwrap_or(NO_RUNG)
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

    fn block(&self, chains: std::ops::Range<usize>) -> Block {
        let mut solver = condensed::Solver::default();
        let settings = Question::default().condensed(self.bars);
        let mut block = Block::default();
        for chain in chains {
            let problem = match self.problem(chain) {
                Ok(problem) => problem,
                Err(error) => {
                    block.add_failure(chain, self.bars, Told::of(&error));
                    continue;
                }
            };
            // The memory of one solver serves all chains of the block.
            let alone = self.solvers == Solvers::Lagrange;
            match alone.then(|| solver.solve(&problem, &settings)) {
                Some(Ok(found)) => {
                    block.add(&found.equilibrium, judged(&problem, &found.equilibrium));
                    solver.take_back(found);
                }
                _ => self.asked(chain, &problem, &mut block),
            }
        }
        block
    }

    /// Asked, compared and certified like a system alone, but for the census.
    fn asked(&self, chain: usize, problem: &Problem, block: &mut Block) {
        let question =
            Question { solvers: self.solvers, census: UseCensus::Never, ..Question::default() };
        let system = System::from(problem.chain());
        let answer = ask_with(&system, &question, &|_| {});
        let first = answer.by(&SolverName::LAGRANGE).or(answer.equilibria.first());
        let as_chain = |found| system.as_row()?.chain_equilibrium(found);
        match first.and_then(as_chain) {
            Some(found) => block.add(&found, judged(problem, &found)),
            None => block.add_failure(chain, self.bars, unsolved(&answer.failures)),
        }
    }
}

/// The largest violation of Newton's laws.
fn judged(problem: &Problem, found: &Equilibrium) -> f64 {
    judge_chain(problem, found).largest()
}

fn unsolved(failures: &[SystemFailure]) -> Told {
    let message = failures.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    Told::new("Unsolved", message, told::failures(failures))
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
        // The Python half has looked for a wrong shape before.
        if wanted != found {
            return Err(internal(&format!("{what}: {wanted} numbers wanted, got {found}")));
        }
    }
    let whole = work::run(py, threads, progress.as_ref(), move |watch| {
        let done = std::sync::atomic::AtomicUsize::new(0);
        let blocks: Vec<Block> = (0..chains.div_ceil(BLOCK))
            .into_par_iter()
            .map(|k| {
                watch.go_on();
                let block = batch.block(k * BLOCK..chains.min((k + 1) * BLOCK));
                let size = block.energy_j.len();
                let done = done.fetch_add(size, std::sync::atomic::Ordering::Relaxed) + size;
                watch.tell("chains", done as u64, chains as u64);
                block
            })
            .collect();
        joined(blocks)
    })?;
    dict(py, whole, chains, bars)
}

/// All blocks, in their order.
fn joined(blocks: Vec<Block>) -> Block {
    let mut whole = Block::default();
    for block in blocks {
        whole.joints_m.extend(block.joints_m);
        whole.forces_n.extend(block.forces_n);
        whole.axial_n.extend(block.axial_n);
        whole.energy_j.extend(block.energy_j);
        whole.residual.extend(block.residual);
        whole.statics.extend(block.statics);
        whole.rung.extend(block.rung);
        whole.failures.extend(block.failures);
    }
    whole
}

fn dict(py: Python<'_>, all: Block, chains: usize, bars: usize) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    let cube =
        |vectors: Vec<Vector>| column(py, vectors.into_flattened()).reshape([chains, bars + 1, 3]);
    dict.set_item("joints_m", cube(all.joints_m)?)?;
    dict.set_item("forces_n", cube(all.forces_n)?)?;
    dict.set_item("axial_n", column(py, all.axial_n).reshape([chains, bars])?)?;
    dict.set_item("energy_j", column(py, all.energy_j))?;
    dict.set_item("residual", column(py, all.residual))?;
    dict.set_item("statics", column(py, all.statics))?;
    dict.set_item("rung", numpy::PyArray1::from_vec(py, all.rung))?;
    let failures = all.failures.iter().map(|(chain, told)| Ok((*chain, parts(py, told)?)));
    dict.set_item("failures", failures.collect::<PyResult<Vec<_>>>()?)?;
    Ok(dict)
}
