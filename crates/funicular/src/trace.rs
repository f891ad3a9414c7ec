//! All equilibria over a parameter.

use std::io::{self, Write};

use branches::{
    Abscissa, Checks, Continuation, ContinuationError, ContinuationSettings, ParameterError,
    PointStatus, Progress, Variation,
};

use model::SystemSummary;
use serde::Serialize;

use crate::error::Error;
use crate::parameters::Parameters;
use crate::problem::Problem;
use crate::solve::SCHEMA_VERSION;
use crate::threads;

/// Follows all equilibria over a number of the system file: branches, folds, exchanges of
/// stability.
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
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    parameters: Parameters,
    settings: ContinuationSettings,
    threads: usize,
}

impl Trace {
    /// Over no parameter yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Over one more number of the system file, as [`Parameters::vary`] reads it. Branches are
    /// followed along the last one; each combination of the others is a path of its own.
    ///
    /// # Errors
    ///
    /// [`Error::Parameter`] with the place in the text.
    pub fn vary(self, text: &str) -> Result<Self, Error> {
        Ok(Self { parameters: self.parameters.vary(text)?, ..self })
    }

    /// Over these parameters.
    #[must_use]
    pub fn over(self, parameters: Parameters) -> Self {
        Self { parameters, ..self }
    }

    /// Most points of all paths together: all that is found is held in memory.
    #[must_use]
    pub fn max_points(mut self, max_points: usize) -> Self {
        self.settings.max_points = max_points;
        self
    }

    /// How many threads share the work, 0 (the default) for those of the pool that it is called
    /// from.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// The paths, before any of them is followed.
    ///
    /// # Errors
    ///
    /// [`Error::Parameter`] when a parameter does not fit the chain.
    pub fn variation(&self, problem: &Problem) -> Result<Variation, Error> {
        let variation = self.parameters.of(problem, "a trace")?;
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

    /// Processor time of the censuses at all points, s, good to an order of magnitude, as the
    /// estimate of a census is. Following the branches takes less.
    ///
    /// # Errors
    ///
    /// As [`variation`](Self::variation).
    pub fn expected_time_s(&self, problem: &Problem) -> Result<f64, Error> {
        let variation = self.variation(problem)?;
        let points: usize = variation.paths().iter().map(Vec::len).sum();
        Ok(points as f64 * census::expected_time_s(variation.base().bars().len()))
    }

    /// Follow all equilibria.
    ///
    /// # Errors
    ///
    /// As [`variation`](Self::variation), and [`Error::Continuation`] when the chain is too long
    /// for a census, or the paths have more points together than [`max_points`](Self::max_points)
    /// allows. A point that is refused or undecided is no error: it says so.
    pub fn run(&self, problem: &Problem) -> Result<TraceAnswer, Error> {
        self.run_watched(problem, &|_, _| {})
    }

    /// The same, with `watch` told the number of the path and how far it is.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(usize, Progress) + Sync),
    ) -> Result<TraceAnswer, Error> {
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
            Ok(TraceAnswer { system: variation.base().summary(), paths })
        })?
    }
}

/// All equilibria along every path.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceAnswer {
    system: SystemSummary,
    paths: Vec<Continuation>,
}

impl TraceAnswer {
    /// The paths.
    #[must_use]
    pub fn paths(&self) -> &[Continuation] {
        &self.paths
    }

    /// Whether every census between the points and events finds exactly the branches there.
    #[must_use]
    pub fn checks_agree(&self) -> bool {
        self.paths.iter().all(|path| path.checks.agree())
    }

    /// Whether all that the checks ask is decided, one way or the other.
    #[must_use]
    pub fn checks_decided(&self) -> bool {
        self.paths.iter().map(|path| &path.checks).all(Checks::decided)
    }

    /// Why no value of the parameters describes a chain that can hang, if none does.
    #[must_use]
    pub fn refused_everywhere(&self) -> Option<String> {
        let mut reasons =
            self.paths.iter().flat_map(|path| &path.points).map(|point| match &point.status {
                PointStatus::Refused { reason } => Some(reason.clone()),
                _ => None,
            });
        let first = reasons.next()??;
        reasons.all(|reason| reason.is_some()).then_some(first)
    }

    /// The bifurcation diagram of a path as SVG: energy, and the angle of a bar, from 1.
    #[must_use]
    pub fn diagram(&self, path: usize, abscissa: Abscissa, bar: usize) -> Option<String> {
        let path = self.paths.get(path)?;
        Some(branches::diagram(path, &self.system.name, abscissa, bar))
    }

    /// A line per point of a branch as CSV: units in the names of the columns, nothing where a
    /// force is infinite.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        let Some(first) = self.paths.first() else { return Ok(()) };
        let branches = self.paths.iter().flat_map(|path| &path.branches);
        let bars = branches
            .clone()
            .find_map(|branch| branch.points.first())
            .map_or(0, |point| point.angles_rad.len());
        write!(to, "path,branch,position,{},span_m,grid,proved,event", first.parameters.join(","))?;
        write!(to, ",pull_horizontal_n,pull_vertical_n,energy_j,index_in_plane,index_in_space")?;
        for bar in 1..=bars {
            write!(to, ",angle_{bar}_rad,axial_{bar}_n")?;
        }
        writeln!(to)?;
        let number = |number: Option<usize>| number.map_or(String::new(), |k| k.to_string());
        for (path, trace) in self.paths.iter().enumerate() {
            for branch in &trace.branches {
                for p in &branch.points {
                    write!(to, "{},{},{:?}", path + 1, branch.id, p.position)?;
                    for value in &p.values {
                        write!(to, ",{value:?}")?;
                    }
                    write!(
                        to,
                        ",{:?},{},{},{}",
                        p.span_m,
                        number(p.grid),
                        p.proved,
                        number(p.event)
                    )?;
                    match p.pull_n {
                        Some([h, v]) => write!(to, ",{h:?},{v:?}")?,
                        None => write!(to, ",,")?,
                    }
                    write!(to, ",{:?},{},{}", p.energy_j, p.index_in_plane, p.index_in_space)?;
                    for (bar, angle) in p.angles_rad.iter().enumerate() {
                        write!(to, ",{angle:?},")?;
                        if let Some(axial) = p.axial_n.get(bar) {
                            write!(to, "{axial:?}")?;
                        }
                    }
                    writeln!(to)?;
                }
            }
        }
        Ok(())
    }
}

/// As `funicular trace --json` prints it.
impl Serialize for TraceAnswer {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Object<'a> {
            schema_version: u32,
            system: &'a SystemSummary,
            traces: &'a [Continuation],
        }
        let Self { system, paths } = self;
        Object { schema_version: SCHEMA_VERSION, system, traces: paths }.serialize(serializer)
    }
}
