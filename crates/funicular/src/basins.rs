//! Which start leads where, as pictures.

use model::SolverName;
use rayon::prelude::*;
use sweep::{Axis, Chunk, Discovered, Failure, Field, Member, Outcomes, Settings, Source};

use crate::error::Error;
use crate::problem::Problem;
use crate::starts::solvers;
use crate::threads;

/// Draws which equilibrium each start leads to, by both solvers, over the starting angles of two
/// bars.
///
/// ```
/// use funicular::prelude::*;
/// let found = Basins::new().size(20).run(&Problem::case("three-equal-bars")?)?;
/// assert_eq!(found.starts(), 400);
/// let picture = found.svg(&SolverName::ENERGY, funicular::Field::Outcome)?;
/// assert!(picture.starts_with("<svg") && found.failed(&SolverName::ENERGY) == 0);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Basins {
    size: u32,
    bars: [usize; 2],
    others_deg: f64,
    threads: usize,
}

impl Default for Basins {
    fn default() -> Self {
        Self { size: 300, bars: [1, 2], others_deg: 0.0, threads: 0 }
    }
}

impl Basins {
    /// 300 starts along each side, over the angles of the first two bars; all other bars start
    /// hanging down.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Starts along each side.
    #[must_use]
    pub fn size(self, size: u32) -> Self {
        Self { size, ..self }
    }

    /// The two bars whose angles are the axes, from 1.
    #[must_use]
    pub fn bars(self, bars: [usize; 2]) -> Self {
        Self { bars, ..self }
    }

    /// Starting angle of all other bars from the descending vertical, degrees.
    #[must_use]
    pub fn others_deg(self, others_deg: f64) -> Self {
        Self { others_deg, ..self }
    }

    /// How many threads share the work, 0 (the default) for those of the pool that it is called
    /// from.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// Check the settings against a chain.
    ///
    /// # Errors
    ///
    /// [`Error::BasinsBars`] and [`Error::BasinsAngle`].
    pub fn check(&self, problem: &Problem) -> Result<(), Error> {
        let chain = problem.chain_for("a picture of basins")?;
        self.axes(chain.chain().bars().len()).map(|_| ())
    }

    /// Run all starts.
    ///
    /// # Errors
    ///
    /// [`Error::BasinsBars`] and [`Error::BasinsAngle`] for settings out of range, [`Error::Sweep`]
    /// for chains without a list of equilibria.
    pub fn run(&self, problem: &Problem) -> Result<BasinsAnswer, Error> {
        let chain = problem.chain_for("a picture of basins")?;
        let bars = chain.chain().bars().len();
        let [i, j] = self.axes(bars)?;
        let axis = |bar: usize| {
            if bar == i || bar == j {
                Axis::full(u64::from(self.size))
            } else {
                Axis::fixed(self.others_deg.to_radians())
            }
        };
        let source = Source::Grid((1..=bars).map(axis).collect());
        let settings = Settings { source, ..Settings::default() };
        let size = u64::from(self.size);
        threads::on(self.threads, || {
            let sweep = sweep::Sweep::new(chain, settings, solvers(chain)?)?;
            let [mut lagrange, mut energy] = [Outcomes::default(), Outcomes::default()];
            let mut add = |row: Chunk| {
                for (all, name) in [(&mut lagrange, "lagrange"), (&mut energy, "energy")] {
                    let Some(part) = row.of(name) else { continue };
                    all.outcome.extend(&part.outcome);
                    all.iterations.extend(&part.iterations);
                }
            };
            let proven = sweep.members().list().iter();
            let mut discovered = Discovered::default();
            match sweep.nothing_reached() {
                None => {
                    let rows: Vec<_> = (0..size)
                        .into_par_iter()
                        .map(|row| sweep.run_chunk(row * size..(row + 1) * size))
                        .collect();
                    rows.into_iter().for_each(add);
                }
                Some(mut reached) => {
                    sweep.run_chunks(0..size * size, size, &mut reached, &mut add);
                    for outcomes in [&mut lagrange, &mut energy] {
                        discovered = reached.renumber(outcomes);
                    }
                }
            }
            let names = proven.chain(&discovered.equilibria).enumerate().map(name).collect();
            let title = chain.chain().name().to_owned();
            Ok(BasinsAnswer { of: *self, axes: [i, j], bars, title, names, lagrange, energy })
        })?
    }

    /// Processor time that the starts take, s: from a few starts, good to a factor of three.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn expected_time_s(&self, problem: &Problem) -> Result<f64, Error> {
        let chain = problem.chain_for("a picture of basins")?;
        let starts = u64::from(self.size).pow(2);
        Ok(sweep::expected_time_s(chain, &Settings::default(), &solvers(chain)?, starts)?)
    }

    /// The two bars of the axes, the lower first: the grid runs along it.
    fn axes(&self, bars: usize) -> Result<[usize; 2], Error> {
        let [i, j] = self.bars;
        if i == j || ![i, j].iter().all(|bar| (1..=bars).contains(bar)) {
            return Err(Error::BasinsBars { axes: self.bars, bars });
        }
        if !self.others_deg.is_finite() {
            return Err(Error::BasinsAngle { others_deg: self.others_deg });
        }
        Ok([i.min(j), i.max(j)])
    }
}

/// Where every start led.
#[derive(Debug, Clone, PartialEq)]
pub struct BasinsAnswer {
    of: Basins,
    axes: [usize; 2],
    bars: usize,
    title: String,
    names: Vec<String>,
    lagrange: Outcomes,
    energy: Outcomes,
}

impl BasinsAnswer {
    /// Number of starts.
    #[must_use]
    pub fn starts(&self) -> u64 {
        u64::from(self.of.size).pow(2)
    }

    /// The equilibria that outcomes 0, 1, 2, ... stand for, in words.
    #[must_use]
    pub fn equilibria(&self) -> &[String] {
        &self.names
    }

    /// Where the starts of a solver led.
    #[must_use]
    pub fn outcomes(&self, solver: &SolverName) -> Option<&Outcomes> {
        match solver.as_str() {
            "lagrange" => Some(&self.lagrange),
            "energy" => Some(&self.energy),
            _ => None,
        }
    }

    /// Starts from which a solver reached no equilibrium.
    #[must_use]
    pub fn failed(&self, solver: &SolverName) -> usize {
        let all = self.outcomes(solver).into_iter().flat_map(|all| &all.outcome);
        all.filter(|outcome| **outcome < 0).count() - self.unlisted(solver)
    }

    /// Starts from which a solver reached an equilibrium that is in no list.
    #[must_use]
    pub fn unlisted(&self, solver: &SolverName) -> usize {
        let all = self.outcomes(solver).into_iter().flat_map(|all| &all.outcome);
        all.filter(|outcome| **outcome == Failure::Unlisted as i16).count()
    }

    /// The picture of one solver as SVG.
    ///
    /// # Errors
    ///
    /// [`Error::Basins`] when the solver was not asked.
    pub fn svg(&self, solver: &SolverName, field: Field) -> Result<String, Error> {
        let none = Outcomes::default();
        let outcomes = self.outcomes(solver).unwrap_or(&none);
        let fixed = if self.bars > 2 {
            format!("; all other bars start at {}\u{b0}", self.of.others_deg)
        } else {
            String::new()
        };
        let what = match field {
            Field::Outcome => "equilibrium reached",
            Field::Iterations => "iterations spent",
        };
        let size = self.of.size;
        let note = format!("{what} by {solver} from {size} \u{d7} {size} starts{fixed}");
        let labels = self.axes.map(|bar| format!("start of bar {bar} from the vertical / \u{b0}"));
        let picture = sweep::Basins {
            size,
            outcomes,
            names: &self.names,
            title: &self.title,
            note: &note,
            labels: [&labels[0], &labels[1]],
        };
        Ok(picture.svg(field)?)
    }
}

/// An equilibrium in the legend: its number from 1, energy and kind.
fn name((number, member): (usize, &Member)) -> String {
    let kind = match member.index_in_plane {
        Some(0) => ", minimum",
        Some(_) => ", no minimum",
        None => "",
    };
    let mirrored = if member.mirrored { " (mirror image)" } else { "" };
    format!("{}: {:.4} J{kind}{mirrored}", number + 1, member.energy_j)
}
