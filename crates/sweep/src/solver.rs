//! What a sweep asks of a solver: many starts in, many ends out.

use std::fmt::Debug;
use std::sync::Arc;

use model::Ends;

use crate::error::SweepError;

/// A solver of one problem for many starts in the vertical plane of its anchors.
///
/// A sweep depends on no solver: it is handed those that it runs. What becomes of a start must
/// depend on the start alone, not on its neighbours: a sweep is cut into runs of starts in many
/// ways, and has the same bits.
///
/// ```
/// use model::{Ends, Finish};
/// use sweep::{BatchSolver, Finds};
///
/// /// Says of every start that it stays where it is.
/// #[derive(Debug)]
/// struct Lazy {
///     bars: usize,
/// }
///
/// impl BatchSolver for Lazy {
///     fn name(&self) -> &str {
///         "lazy"
///     }
///
///     fn finds(&self) -> Finds {
///         Finds::Equilibria
///     }
///
///     fn solve(&self, starts_rad: &[f64], ends: &mut Ends) {
///         let seeds = starts_rad.len() / self.bars;
///         ends.finish = vec![Finish::IterationLimit; seeds];
///         ends.iterations = vec![0; seeds];
///         ends.residual = vec![f64::INFINITY; seeds];
///         ends.energy_j = vec![f64::NAN; seeds];
///         let direction = |angle: &f64| [angle.sin(), -angle.cos()];
///         ends.directions = starts_rad.iter().map(direction).collect();
///     }
/// }
///
/// let solvers = sweep::Solvers::new(vec![std::sync::Arc::new(Lazy { bars: 3 })]);
/// let sweep = sweep::Sweep::new(&model::cases::paper(), sweep::Settings::default(), solvers)?;
/// let outcomes = &sweep.run_chunk(0..5).outcomes[0];
/// assert_eq!((outcomes.solver.as_str(), &outcomes.outcome), ("lazy", &vec![-1; 5]));
/// # Ok::<(), sweep::SweepError>(())
/// ```
pub trait BatchSolver: Debug + Send + Sync {
    /// Its name: what its columns begin with. Letters, digits and underscores.
    fn name(&self) -> &str;

    /// What it looks for.
    fn finds(&self) -> Finds;

    /// Solve from all starts: n angles for each of them, rad, from the descending vertical towards
    /// the last anchor. What was in `ends` is replaced; its memory may be used again.
    fn solve(&self, starts_rad: &[f64], ends: &mut Ends);
}

/// What a solver looks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finds {
    /// Equilibria of every kind.
    Equilibria,
    /// Minima of the energy in the plane, each verified.
    Minima,
}

/// The solvers of a sweep.
#[derive(Debug, Clone)]
pub struct Solvers {
    /// Those that are asked, in the order of their columns; the first two are compared.
    pub(crate) asked: Vec<Arc<dyn BatchSolver>>,
}

impl Solvers {
    /// All of these are asked. The order of their columns is `lagrange`, `energy`, and the others as
    /// they stand here.
    pub fn new(mut solvers: Vec<Arc<dyn BatchSolver>>) -> Self {
        let place = |name: &str| FIRST.iter().position(|first| *first == name);
        solvers.sort_by_key(|solver| place(solver.name()).unwrap_or(FIRST.len()));
        Self { asked: solvers }
    }

    /// Only those of these names are asked.
    #[must_use]
    pub fn only(self, names: &[&str]) -> Self {
        let asked = self.asked.into_iter().filter(|solver| names.contains(&solver.name()));
        Self { asked: asked.collect() }
    }

    /// The names of those that are asked, in the order of their columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.asked.iter().map(|solver| solver.name())
    }

    /// Names are those of columns and of keys.
    pub(crate) fn check(&self) -> Result<(), SweepError> {
        let mut before = vec![];
        for name in self.names() {
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
            if name.is_empty() || !name.chars().all(plain) || RESERVED.contains(&name) {
                return Err(SweepError::SolverName { name: name.to_owned() });
            }
            if before.contains(&name) {
                return Err(SweepError::SolverTwice { name: name.to_owned() });
            }
            before.push(name);
        }
        if before.is_empty() { Err(SweepError::NoSolver) } else { Ok(()) }
    }
}

/// Solvers whose columns and keys come before those of all others.
pub(crate) const FIRST: [&str; 2] = ["lagrange", "energy"];

/// Keys that stand beside the names of solvers.
const RESERVED: [&str; 4] = ["seed", "seeds", "both", "comparison"];
