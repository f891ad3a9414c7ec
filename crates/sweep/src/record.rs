use std::ops::Range;

/// What one solver made of a run of consecutive seeds: one entry per seed in every column.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outcomes {
    /// Its name.
    pub solver: String,
    /// The equilibrium reached, as its number in the list of the sweep, or a negative [`Failure`]
    /// code.
    pub outcome: Vec<i16>,
    /// Iterations spent.
    pub iterations: Vec<u16>,
    /// The solver's own residual where it stopped, without unit.
    pub residual: Vec<f64>,
    /// Energy where it stopped, in joules above the height of joint 0.
    pub energy_j: Vec<f64>,
}

/// Why a seed led to no equilibrium of the list. The code is what the columns hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i16)]
pub enum Failure {
    /// The iteration limit was reached.
    IterationLimit = -1,
    /// No step reduces the residual further, yet it is not small.
    Stalled = -2,
    /// A number overflowed or was undefined.
    NonFinite = -3,
    /// It converged to something that is in no list: to be looked at one by one.
    Unlisted = -4,
}

/// A run of consecutive seeds through the solvers of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Chunk {
    /// Which seeds.
    pub seeds: Range<u64>,
    /// What each solver made of them, in the order of the sweep.
    pub outcomes: Vec<Outcomes>,
}

impl Chunk {
    /// What the solver of this name made of them, if it was asked.
    pub fn of(&self, solver: &str) -> Option<&Outcomes> {
        self.outcomes.iter().find(|outcomes| outcomes.solver == solver)
    }
}
