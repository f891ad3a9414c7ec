//! All equilibria of a chain over a parameter, and load paths of any system.

mod confirm;
pub(crate) mod description;
mod enclosed;
mod equations;
mod everywhere;
mod figure;
pub(crate) mod load;
mod page;

pub use self::confirm::Confirmed;
pub use self::enclosed::PathProved;

use std::io::{self, Write};

use branches::{
    Abscissa, Checks, Continuation, ContinuationError, ContinuationSettings, ParameterError,
    PointStatus, Progress, Variation,
};
use model::system::System;
use serde::Serialize;

use self::load::{LoadEnd, LoadPath, LoadPaths};
use crate::csv::{exact, or_empty};
use crate::error::Error;
use crate::object::head;
use crate::parameters::Parameters;
use crate::problem::Problem;
use crate::threads;

/// Follows equilibria over a number of the system file. With values of a chain all of them:
/// branches, folds, exchanges of stability. Of any system, or over a range alone as `loads=0..1.2`,
/// one: the load path from the shape as it is drawn (or the hanging one), through limit points,
/// branch points and slack cables.
///
/// ```
/// use funicular::prelude::*;
/// // Two bars of 1 m have two positions, which meet where the anchors are 2 m apart.
/// let problem = Problem::parse(
///     "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
///      bars = [{ length_m = 1, mass_kg = 1, count = 2 }]",
///     "two.toml",
/// )?;
/// let found = Trace::new().vary("anchors.end_m.x=1.5..2.1:7")?.run(&problem)?;
/// assert!(found.checks_agree());
/// let [event] = &found.paths()[0].events[..] else { panic!("one event") };
/// assert!((event.values[0] - 2.0).abs() < 1e-12);
/// // Two elastic bars of 5 N of stiffness, a gable of 1 m rise over 2 m: how much it bears until
/// // it snaps through. At the limit the bars are (l0 a^2)^(1/3) long.
/// let gable = Problem::parse(
///     "[joints]\n\
///      A = { at_m = [-1, 0, 0] }\n\
///      B = { at_m = [1, 0, 0] }\n\
///      P = { near_m = [0, 0, 0.5], force_n = [0, 0, -1], along = [0, 0, 1], at_m = [0, 0, 0.5] }\n\
///      [[bars]]\nmass_kg = 0\nfrom = \"A\"\nto = \"P\"\nstiffness_n = 5\n\
///      [[bars]]\nmass_kg = 0\nfrom = \"P\"\nto = \"B\"\nstiffness_n = 5",
///     "gable.toml",
/// )?;
/// let found = Trace::new().vary("loads=0..1")?.run(&gable)?;
/// let path = &found.load_paths().expect("a load path").paths()[0];
/// let l0 = 1.25_f64.sqrt();
/// let l = l0.cbrt();
/// let limit_n = 10.0 * (l * l - 1.0).sqrt() / l * (l0 - l) / l0;
/// assert!((path.first_loss().expect("a limit").values[0] - limit_n).abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    parameters: Parameters,
    settings: ContinuationSettings,
    max_points: Option<usize>,
    of: Vec<String>,
    branches: usize,
    linear_buckling: bool,
    threads: usize,
}

impl Trace {
    /// Over no parameter yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Over one more number of the system file, as [`Parameters::vary`] reads it. Branches are
    /// followed along the last one; each combination of the others is a path of its own.
    ///
    /// # Errors
    /// [`Error::Parameter`] with the place in the text.
    pub fn vary(self, text: &str) -> Result<Self, Error> {
        Ok(Self { parameters: self.parameters.vary(text)?, ..self })
    }

    /// Over these parameters.
    #[must_use]
    pub fn over(self, parameters: Parameters) -> Self {
        Self { parameters, ..self }
    }

    /// Most points, of which all that is found is held in memory: of all paths of a chain together
    /// (100,000 if not set), or of each load path (1,000).
    #[must_use]
    pub fn max_points(mut self, max_points: usize) -> Self {
        self.settings.max_points = max_points;
        self.max_points = Some(max_points);
        self
    }

    /// Shows one more number along load paths, as [`Study::of`](crate::Study::of) names it; without
    /// any the coordinate that moves most.
    #[must_use]
    pub fn of(mut self, name: impl Into<String>) -> Self {
        self.of.push(name.into());
        self
    }

    /// Estimates beside a load path where it loses its stability, as linear buckling does: where the
    /// stiffness at its start, extrapolated along the load, is singular.
    #[must_use]
    pub fn linear_buckling(self) -> Self {
        Self { linear_buckling: true, ..self }
    }

    /// Whether load paths are followed: over a range alone, or of what is no chain. Else all
    /// equilibria of a chain are.
    pub fn is_load_path(&self, problem: &Problem) -> bool {
        self.parameters.is_open()
            || !self.of.is_empty()
            || self.branches > 0
            || self.linear_buckling
            || !self.parameters.keep_row(problem)
    }

    setters! {
        /// From branch points of a load path follows the paths that branch off as well, from theirs too if
        /// this depth is 2, and so on; 0 (the default) follows none. Where several modes meet in one branch
        /// point so many directions are tried, and there may be more paths.
        ///
        /// ```
        /// use funicular::prelude::*;
        /// // A gable so steep that its apex sways to a side before it snaps through.
        /// let gable = Problem::parse(
        ///     "[joints]\n\
        ///      A = { at_m = [-1, 0, 0] }\n\
        ///      B = { at_m = [1, 0, 0] }\n\
        ///      P = { at_m = [0, 0, 3], near_m = [0, 0, 3], free = \"xz\", force_n = [0, 0, -1] }\n\
        ///      [[bars]]\nmass_kg = 0\nfrom = \"A\"\nto = \"P\"\nstiffness_n = 5\n\
        ///      [[bars]]\nmass_kg = 0\nfrom = \"P\"\nto = \"B\"\nstiffness_n = 5",
        ///     "gable.toml",
        /// )?;
        /// let found = Trace::new().vary("loads=0..3")?.branches(1).run(&gable)?;
        /// // To the left and to the right.
        /// assert_eq!(found.load_paths().expect("load paths").paths().len(), 1 + 2);
        /// # Ok::<(), Error>(())
        /// ```
        branches: usize,
        /// How many threads share the work, 0 (the default) for those of the pool that it is called
        /// from.
        threads: usize,
    }

    /// The paths of a chain, before any of them is followed.
    ///
    /// # Errors
    /// [`Error::Parameter`] when a parameter does not fit the chain.
    pub fn variation(&self, problem: &Problem) -> Result<Variation, Error> {
        let variation = self.parameters.over(problem)?;
        if !variation.is_row() {
            return Err(ContinuationError::NoRow.into());
        }
        match variation.numbers().iter().find(|number| number.is_count()) {
            None => Ok(variation),
            Some(count) => {
                let text = count.to_string();
                let what = "no branch is followed from one count to another".to_owned();
                let help = "`funicular study` varies counts".to_owned();
                Err(ParameterError { span: 0..text.len(), text, what, help }.into())
            }
        }
    }

    /// The load paths, before any of them is followed.
    ///
    /// # Errors
    /// [`Error::Parameter`] when a parameter does not fit the problem.
    pub fn load_variation(&self, problem: &Problem) -> Result<Variation, Error> {
        self.parameters.along(problem)
    }

    /// Processor time of the censuses at all points, s, good to an order of magnitude, as the
    /// estimate of a census is. Following the branches takes less.
    ///
    /// # Errors
    /// As [`variation`](Self::variation).
    pub fn expected_time_s(&self, problem: &Problem) -> Result<f64, Error> {
        let variation = self.variation(problem)?;
        let points: usize = variation.paths().iter().map(Vec::len).sum();
        Ok(points as f64 * census::expected_time_s(variation.base().members().len()))
    }

    /// Follow all equilibria, or the load path.
    ///
    /// # Errors
    /// [`Error::Parameter`] when a parameter does not fit the problem; [`Error::Load`] where no load
    /// path begins; for all equilibria [`Error::Continuation`] when the chain is too long
    /// for a census, or the paths have more points together than [`max_points`](Self::max_points)
    /// allows. A point that is refused or undecided is no error: it says so.
    pub fn run(&self, problem: &Problem) -> Result<TraceAnswer, Error> {
        self.run_watched(problem, &|_, _| {})
    }

    /// The same, with `watch` told the number of the path and how far it is; of a load path how many
    /// points there are.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(usize, Progress) + Sync),
    ) -> Result<TraceAnswer, Error> {
        if self.is_load_path(problem) {
            let variation = self.load_variation(problem)?;
            let most = self.max_points.unwrap_or(LOAD_POINTS);
            let watch = |path, done| watch(path, Progress { done, total: most });
            let (branches, linear_buckling) = (self.branches, self.linear_buckling);
            let asked = load::Asked { max_points: most, branches, linear_buckling };
            let found = load::trace(&variation, &self.of, asked, &watch)?;
            return Ok(TraceAnswer(Found::Load(found)));
        }
        let variation = self.variation(problem)?;
        let (points, most) =
            (variation.paths().iter().map(Vec::len).sum::<usize>(), self.settings.max_points);
        if points > most {
            return Err(ContinuationError::TooManyPoints { points, most }.into());
        }
        threads::on(self.threads, || {
            let follow = |path| {
                let watch = |progress| watch(path, progress);
                Continuation::follow(&variation, path, &self.settings, &watch)
            };
            let paths = (0..variation.paths().len()).map(follow).collect::<Result<_, _>>()?;
            Ok(TraceAnswer(Found::All { system: variation.base().clone(), paths }))
        })?
    }
}

/// Most points of a load path: from start to limit some 50 are usual.
const LOAD_POINTS: usize = 1_000;

/// All equilibria along every path, or load paths; it serialises to what `funicular trace --json` prints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TraceAnswer(Found);

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
enum Found {
    All {
        #[serde(flatten, serialize_with = "head")]
        system: System,
        #[serde(rename = "traces")]
        paths: Vec<Continuation>,
    },
    Load(LoadPaths),
}

impl TraceAnswer {
    /// The paths along which all equilibria are followed; none where load paths are.
    pub fn paths(&self) -> &[Continuation] {
        match &self.0 {
            Found::All { paths, .. } => paths,
            Found::Load(_) => &[],
        }
    }

    /// The load paths, if these are followed.
    pub fn load_paths(&self) -> Option<&LoadPaths> {
        match &self.0 {
            Found::All { .. } => None,
            Found::Load(found) => Some(found),
        }
    }

    /// Whether every census between the points and events finds exactly the branches there; of load
    /// paths whether `energy` and the judge confirm every point.
    pub fn checks_agree(&self) -> bool {
        match &self.0 {
            Found::All { paths, .. } => paths.iter().all(|path| path.checks.agree()),
            Found::Load(found) => found.paths().iter().all(LoadPath::agrees),
        }
    }

    /// Whether all that the checks ask is decided, one way or the other; of load paths whether none
    /// was lost.
    pub fn checks_decided(&self) -> bool {
        match &self.0 {
            Found::All { paths, .. } => paths.iter().map(|path| &path.checks).all(Checks::decided),
            Found::Load(found) => {
                use LoadEnd::{Jams, Lost, NoLength, Open, Unbounded};
                let early = [Lost, Open, Unbounded, Jams, NoLength];
                found.paths().iter().all(|path| !early.contains(&path.end))
            }
        }
    }

    /// Why no value of the parameters describes a chain that can hang, if none does.
    pub fn refused_everywhere(&self) -> Option<String> {
        let mut reasons =
            self.paths().iter().flat_map(|path| &path.points).map(|point| match &point.status {
                PointStatus::Refused { reason } => Some(reason.clone()),
                _ => None,
            });
        let first = reasons.next()??;
        reasons.all(|reason| reason.is_some()).then_some(first)
    }

    /// The diagram of a path as SVG: energy, and the angle of a bar, from 1; of a load path the
    /// parameter over the first number shown, with the paths that branch off.
    pub fn diagram(&self, path: usize, abscissa: Abscissa, bar: usize) -> Option<String> {
        match &self.0 {
            Found::All { system, paths } => {
                Some(branches::diagram(paths.get(path)?, system.name(), abscissa, bar))
            }
            Found::Load(found) => {
                let main =
                    found.paths().iter().enumerate().filter(|(_, one)| one.branches_from.is_none());
                found.figure(main.map(|(number, _)| number + 1).nth(path)?)
            }
        }
    }

    /// A line per point of a branch or a load path as CSV: units in the names of the columns, nothing where a
    /// force is infinite.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        if let Found::Load(found) = &self.0 {
            return found.write_csv(to);
        }
        let Some(first) = self.paths().first() else { return Ok(()) };
        let branches = self.paths().iter().flat_map(|path| &path.branches);
        let bars = branches
            .clone()
            .find_map(|branch| branch.points.first())
            .map_or(0, |point| point.angles_rad.len());
        let parameters: Vec<String> = first.parameters.iter().map(crate::csv::quoted).collect();
        write!(to, "path,branch,position,{},span_m,grid,proved,event", parameters.join(","))?;
        write!(to, ",pull_horizontal_n,pull_vertical_n,energy_j,index_in_plane,index_in_space")?;
        for bar in 1..=bars {
            write!(to, ",angle_{bar}_rad,axial_{bar}_n")?;
        }
        writeln!(to)?;
        for (path, trace) in self.paths().iter().enumerate() {
            for branch in &trace.branches {
                for p in &branch.points {
                    let mut cells = vec![exact(&(path + 1)), exact(&branch.id), exact(&p.position)];
                    cells.extend(p.values.iter().map(exact));
                    let proved = p.proved.to_string();
                    cells.extend([exact(&p.span_m), or_empty(p.grid), proved, or_empty(p.event)]);
                    let pull_n = p.pull_n.map(|[level, upright]| (level, upright)).unzip();
                    cells.extend([or_empty(pull_n.0), or_empty(pull_n.1), exact(&p.energy_j)]);
                    cells.extend([exact(&p.index_in_plane), exact(&p.index_in_space)]);
                    for (bar, angle) in p.angles_rad.iter().enumerate() {
                        cells.extend([exact(angle), or_empty(p.axial_n.get(bar))]);
                    }
                    writeln!(to, "{}", cells.join(","))?;
                }
            }
        }
        Ok(())
    }
}
