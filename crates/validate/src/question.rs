//! What is asked of the solvers.

use std::num::{NonZeroU64, NonZeroUsize};

/// What is asked, and of whom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Question {
    /// Which solvers. Default both.
    pub solvers: Solvers,
    /// Which equations `lagrange` solves for a row of rigid bars between two anchors. Default the
    /// condensed ones.
    pub equations: Equations,
    /// Whether the answers are looked up in a census. Default where that is quick.
    pub census: UseCensus,
    /// How many threads `lagrange` uses for one long chain; the answer does not depend on it.
    /// Default one. (A census runs on the threads of rayon's pool.)
    pub threads: NonZeroUsize,
    /// Work that each solver may do, iterations times size: numbers in all factors of its matrices;
    /// bars times passes where a row between two anchors needs none. Default what its own settings
    /// say.
    pub max_work: Option<NonZeroU64>,
}

impl Question {
    /// Settings of `lagrange` with the work that it may do.
    pub(crate) fn lagrange(&self) -> lagrange::net::Settings {
        let usual = lagrange::net::Settings::default();
        lagrange::net::Settings { max_work: self.work(), ..usual }
    }

    /// The same of `energy`.
    pub(crate) fn energy(&self) -> energy::net::Settings {
        let usual = energy::net::Settings::default();
        energy::net::Settings { max_work: self.work(), ..usual }
    }

    /// Settings of `lagrange` for the condensed equations of a row of so many bars.
    pub fn condensed(&self, bars: usize) -> lagrange::condensed::Settings {
        let usual = lagrange::condensed::Settings::default();
        let passes = self.passes(bars, usual.max_passes as u64);
        let max_passes = passes.try_into().unwrap_or(usual.max_passes);
        lagrange::condensed::Settings { max_passes, ..usual }
    }

    /// The same for the paper's equations.
    pub(crate) fn full(&self, bars: usize) -> lagrange::Settings {
        let usual = lagrange::Settings::default();
        let passes = self.passes(bars, usual.max_iterations as u64);
        let max_iterations = passes.try_into().unwrap_or(usual.max_iterations);
        lagrange::Settings { max_iterations, ..usual }
    }

    /// Passes over a chain of so many bars that the work allows, of this many at most.
    pub(crate) fn passes(&self, bars: usize, most: u64) -> u64 {
        (self.work() / bars.max(1) as u64).clamp(1, most)
    }

    fn work(&self) -> u64 {
        self.max_work.map_or_else(model::budget::max_work, NonZeroU64::get)
    }
}

impl Default for Question {
    fn default() -> Self {
        Self {
            solvers: Solvers::Both,
            equations: Equations::Condensed,
            census: UseCensus::Auto,
            threads: NonZeroUsize::MIN,
            max_work: None,
        }
    }
}

/// Which solvers are asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Solvers {
    /// Forces first: constraints and multipliers. Alone it gets no comparison.
    Lagrange,
    /// Energy first: minimisation. Alone it gets no comparison.
    Energy,
    /// Both, and the comparison.
    #[default]
    Both,
}

/// Which of the systems of equations `lagrange` solves.
///
/// They have the same solutions; a test compares them. The angles of the full one lose digits where
/// strands hang side by side or a chain is nearly straight, and its cost grows faster than the
/// number of bars.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Equations {
    /// Three equations for the pull on the first anchor, whatever the number of bars.
    #[default]
    Condensed,
    /// The paper's: all coordinates and all multipliers at once; for some 30 bars.
    Full,
}

/// Whether answers are looked up in a census: whether they are proved to be equilibria, and with
/// which others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum UseCensus {
    /// No census.
    Never,
    /// Where it takes a second at most: chains of up to 8 bars.
    #[default]
    Auto,
    /// Wherever there can be one: chains of up to 16 bars, in some ten seconds.
    Always,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Work is bars times passes, of at least one: 1000 for 10 bars are 100 of either equations.
    #[test]
    fn work_bounds_the_passes_over_a_row() {
        let with =
            |max_work| Question { max_work: NonZeroU64::new(max_work), ..Question::default() };
        let passes = |question: Question, bars| {
            (question.condensed(bars).max_passes, question.full(bars).max_iterations)
        };
        assert_eq!(passes(with(1000), 10), (100, 100));
        assert_eq!(passes(with(1000), 3), (333, lagrange::Settings::default().max_iterations));
        assert_eq!(passes(with(1000), 10_000), (1, 1));
        // Of a chain without bars another error says what is wrong.
        assert!(passes(with(1000), 0).0 > 0);
        let usual = (lagrange::condensed::Settings::default(), lagrange::Settings::default());
        assert_eq!(passes(with(0), 10), (usual.0.max_passes, usual.1.max_iterations));
    }
}
