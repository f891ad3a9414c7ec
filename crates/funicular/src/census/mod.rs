//! Every equilibrium of a system, with proof.

mod answer;
mod csv;
mod large;
mod summary;

pub use answer::{CensusAnswer, Enclosures, Found, InRow};
pub use large::{LargeCensusAnswer, Line, List};
pub use summary::{Chain, Check, EnergyUnit, Net, Open, Part, Slack, Summary};

use census::net::{LoadedRow, SystemCensus};
use census::{Progress, Settings};
use model::NoCensus;
use model::system::{Kind, System};
use validate::UseCensus;

use crate::error::Error;
use crate::problem::Problem;
use crate::solve::Solve;
use crate::threads;

/// Finds every equilibrium, stable or not, and proves that there is no other.
///
/// ```
/// use funicular::prelude::*;
/// let found = Census::new().run(&Problem::case("three-equal-bars")?)?;
/// // E1, E2 and their mirror images, on two circles.
/// assert!(found.complete() && found.census.is_decided());
/// assert_eq!((found.equilibria.len(), found.census.parts[0].count), (4, 2));
/// // A pendulum of two bars hangs, stands, and folds up twice.
/// let bar = Bar::homogeneous(1.0, 0.0)?;
/// let pendulum = System::builder("double pendulum")
///     .gravity_m_s2(10.0)
///     .joint(Joint::anchor("A", [0.0; 3]))
///     .joint(Joint::free("P").with_mass(1.0))
///     .joint(Joint::free("Q").with_mass(1.0))
///     .bar("A", "P", bar)
///     .bar("P", "Q", bar)
///     .build()?;
/// let found = Census::new().run(&pendulum.into())?;
/// let energies = found.equilibria.iter().map(|found| found.equilibrium.energy_j.round());
/// let energies: Vec<f64> = energies.collect();
/// assert_eq!((found.complete(), energies), (true, vec![-30.0, -10.0, 10.0, 30.0]));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Census {
    settings: Settings,
    threads: usize,
}

impl Census {
    /// Chains of up to 16 bars, on all processors.
    pub fn new() -> Self {
        Self::default()
    }

    /// Refuse chains of more bars, with an estimate of what they would cost; at most
    /// [`Settings::MAX_BARS`].
    #[must_use]
    pub fn max_bars(mut self, max_bars: usize) -> Self {
        self.settings.max_bars = max_bars;
        self
    }

    setters! {
        /// All settings of the search.
        settings: Settings,
        /// How many threads share the work, 0 (the default) for those of the pool that it is called
        /// from. The answer does not depend on it.
        threads: usize,
    }

    /// Take the census, and check it: of a chain, or of joints and members: trees, chains of bars
    /// between anchors with trees and weights at their joints, frames, nets of several closures whose
    /// joints move in few ways (one joint held by strands of one or two bars, a boom on its tackle), three strands of any
    /// number of bars under upright loads, and any number of such parts; of cables, struts and ropes among their
    /// members each set that may be slack. Of cables and ropes alone, elastic or not, an equilibrium that is verified
    /// is the only one.
    ///
    /// # Errors
    /// [`Error::Census`] when a chain is too long, [`Error::Refused`] when a system has no
    /// equilibrium, [`Error::SystemCensus`] when it has no census: nets that move in too many ways,
    /// level loads on a chain, elastic bars. What cannot be decided is no error: it is listed, and
    /// the census is not complete.
    pub fn run(&self, problem: &Problem) -> Result<CensusAnswer, Error> {
        self.run_watched(problem, &|_| {})
    }

    /// The same, with `watch` told how far the search is.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(Progress) + Sync),
    ) -> Result<CensusAnswer, Error> {
        let system = problem.system();
        system.refusal()?;
        if let Some(row) = LoadedRow::of(&system) {
            row.refusal(&self.settings)?;
        }
        threads::on(self.threads, || {
            let census =
                SystemCensus::take_watched(&system, &self.settings, watch).or_else(|because| {
                    let named = || Error::SystemCensus(because, named(&system, because));
                    of_cables(&system).ok_or_else(named)
                })?;
            Ok(CensusAnswer::new(&system, census))
        })?
    }

    /// Take the census of a row of bars between two anchors with more equilibria than should be held in memory: of
    /// each only its signs, its pull and its index are kept, and the rest is made when it is written. The
    /// first so many are made at once.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    ///
    /// ```
    /// use funicular::census::List;
    /// use funicular::prelude::*;
    /// let found = Census::new().run_large(&Problem::case("three-equal-bars")?, 1, &|_| {})?;
    /// assert_eq!((found.first.equilibria.len(), found.first.census.count), (2, 4));
    /// let mut lines = vec![];
    /// found.write_csv(List::Signs, &mut lines).expect("memory can be written");
    /// // The two circles, and the names of the columns.
    /// assert_eq!(lines.iter().filter(|byte| **byte == b'\n').count(), 3);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn run_large(
        &self,
        problem: &Problem,
        made: usize,
        watch: &(dyn Fn(Progress) + Sync),
    ) -> Result<LargeCensusAnswer, Error> {
        let system = problem.system();
        let row = LoadedRow::of(&system).ok_or(Error::ChainsOnly("a long list"))?;
        let census = threads::on(self.threads, || row.compact(&self.settings, watch))??;
        Ok(LargeCensusAnswer::new(&system, census, made))
    }
}

/// The joint or the member that a refusal is about, in brackets.
fn named(system: &System, because: NoCensus) -> String {
    let name = |joint: usize| format!("{:?}", system.joints()[joint].name);
    let joint = because.joint().map(|joint| format!(" (joint {})", name(joint - 1)));
    let member = because.member().map(|member| {
        let member = &system.members()[member - 1];
        format!(" (from {} to {})", name(member.from), name(member.to))
    });
    joint.or(member).unwrap_or_default()
}

/// Of cables and ropes alone the one equilibrium that a solver finds, if it is proved.
fn of_cables(system: &System) -> Option<SystemCensus> {
    if !system.members().iter().all(|member| member.kind == Kind::Cable) {
        return None;
    }
    let answer = Solve::new().census(UseCensus::Never).run_here(&system.clone().into()).ok()?;
    let mut found = answer.equilibria().iter();
    found.find_map(|found| SystemCensus::of_cables(system, &found.joints_m, &found.axial_n))
}
