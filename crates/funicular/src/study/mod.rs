//! The hanging shape over a parameter.

mod figure;

use std::io::{self, Write};

use branches::{Combine, Parameter, Variation};
use model::{Equilibrium, Reactions, Rung, SystemSummary, Vector};
use rayon::prelude::*;
use serde::Serialize;
use validate::answer::{Solvers, UseCensus};

use crate::error::Error;
use crate::extremes::Extremes;
use crate::problem::Problem;
use crate::solve::{SCHEMA_VERSION, Solve, SolveAnswer};
use crate::threads;

/// Solves a chain over numbers of its system file: how sag, forces and angles of the hanging shape
/// depend on them. For chains of any length; every point is solved by both solvers and judged as
/// [`Solve`] does, without a census.
///
/// ```
/// use funicular::prelude::*;
/// // Two bars of 1 m hang as a V: their joint is sqrt(1 - (d/2)^2) below anchors d apart.
/// let problem = Problem::parse(
///     "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
///      bars = [{ length_m = 1, mass_kg = 1, count = 2 }]",
///     "two.toml",
/// )?;
/// let found = Study::new().vary("anchors.end_m.x=0.4..2.2:10")?.run(&problem)?;
/// for point in found.points() {
///     let half = 0.5 * point.values[0];
///     match &point.shape {
///         Ok(shape) => {
///             let sag_m = (1.0 - half * half).sqrt();
///             assert!((shape.extremes.sag_m.unwrap() - sag_m).abs() < 1e-12 && shape.agrees);
///         }
///         // Anchors 2.2 m apart are out of reach.
///         Err(_) => assert!(half >= 1.0),
///     }
/// }
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Study {
    parameters: Vec<Parameter>,
    combine: Combine,
    solvers: Solvers,
    threads: usize,
}

impl Study {
    /// Over no parameter yet, by both solvers.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A number of the system file and its values, as `anchors.end_m.x=0.5..2.6:50`.
    ///
    /// # Errors
    ///
    /// [`Error::Parameter`] with the place in the text.
    pub fn vary(mut self, text: &str) -> Result<Self, Error> {
        self.parameters.push(text.parse()?);
        Ok(self)
    }

    /// How several parameters are combined.
    #[must_use]
    pub fn combine(self, combine: Combine) -> Self {
        Self { combine, ..self }
    }

    /// Which solvers to ask; one alone gets no comparison.
    #[must_use]
    pub fn solvers(self, solvers: Solvers) -> Self {
        Self { solvers, ..self }
    }

    /// How many threads share the work, 0 (the default) for those of the pool that it is called
    /// from. No answer depends on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// The chain with its parameters, before any point is solved.
    ///
    /// # Errors
    ///
    /// [`Error::Parameter`] when a parameter does not fit the chain.
    pub fn variation(&self, problem: &Problem) -> Result<Variation, Error> {
        let chain = problem.chain_for("a study")?.chain().clone();
        Ok(Variation::new(chain, &self.parameters, self.combine)?)
    }

    /// Solve all points.
    ///
    /// # Errors
    ///
    /// As [`variation`](Self::variation). A point that is refused or unsolved is no error: it says
    /// why.
    pub fn run(&self, problem: &Problem) -> Result<StudyAnswer, Error> {
        self.run_watched(problem, &|| {})
    }

    /// The same, with `watch` told of each point that is done.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn() + Sync),
    ) -> Result<StudyAnswer, Error> {
        let variation = self.variation(problem)?;
        let solve = Solve::new().solvers(self.solvers).census(UseCensus::Never);
        let paths = variation.paths().iter().enumerate();
        let all: Vec<_> = paths
            .flat_map(|(path, points)| points.iter().map(move |values| (path + 1, values)))
            .collect();
        let point = |(path, values): (usize, &Vec<f64>)| {
            let shape = shape(&variation, &solve, values);
            watch();
            StudyPoint { path, values: values.clone(), shape }
        };
        let points = threads::on(self.threads, || all.into_par_iter().map(point).collect())?;
        let numbers = variation.numbers();
        Ok(StudyAnswer {
            system: variation.base().summary(),
            parameters: numbers.iter().map(ToString::to_string).collect(),
            units: numbers.iter().map(|number| number.unit()).collect(),
            paths: variation.paths().len(),
            points,
        })
    }
}

fn shape(variation: &Variation, solve: &Solve, values: &[f64]) -> Result<StudyShape, NoShape> {
    let problem = variation
        .problem(values)
        .map_err(|error| NoShape { refused: true, reason: error.to_string() })?;
    let chain = problem.chain();
    let span_m = chain.anchors().span_m();
    let answer = solve
        .run_here(&problem.clone().into())
        .map_err(|error| NoShape { refused: false, reason: error.to_string() })?;
    let found = answer.as_chain().and_then(|answer| StudyShape::of(answer, span_m));
    found.ok_or_else(|| NoShape { refused: false, reason: "no equilibrium".to_owned() })
}

/// A point of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyPoint {
    /// Number of its path, from 1: each combination of all parameters but the last has one.
    pub path: usize,
    /// Values of the parameters.
    pub values: Vec<f64>,
    /// The hanging shape, or why there is none.
    #[serde(flatten, serialize_with = "either")]
    pub shape: Result<StudyShape, NoShape>,
}

/// Why a point has no hanging shape.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NoShape {
    /// Whether the values describe no chain that can hang; else no solver has an answer.
    pub refused: bool,
    /// Why, in words.
    pub reason: String,
}

/// One of the two, its keys in place.
fn either<S: serde::Serializer>(
    shape: &Result<StudyShape, NoShape>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match shape {
        Ok(shape) => shape.serialize(serializer),
        Err(none) => none.serialize(serializer),
    }
}

/// The hanging shape at a point of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyShape {
    /// Distance of the anchors, m.
    pub span_m: f64,
    /// Energy above the start anchor, J.
    pub energy_j: f64,
    /// Sag, lowest joint, largest forces.
    #[serde(flatten)]
    pub extremes: Extremes,
    /// Forces of the ground on the chain, N.
    pub reactions_n: Reactions,
    /// How steeply each bar rises from its first joint to its second, degrees from the level.
    pub rises_deg: Vec<f64>,
    /// The highest rung of evidence.
    pub rung: Option<Rung>,
    /// Whether both solvers answered and agree, and the judge finds both in balance.
    pub agrees: bool,
    /// Whether a check failed.
    pub check_failed: bool,
    /// Largest distance of a joint between the two answers, m, if there are two.
    pub joints_differ_m: Option<f64>,
    /// Largest difference of a force, N.
    pub forces_differ_n: Option<f64>,
}

impl StudyShape {
    fn of(answer: &SolveAnswer, span_m: f64) -> Option<Self> {
        let first: &Equilibrium = answer.equilibria().first()?;
        let last = first.joints_m.len().checked_sub(1)?;
        let agreement = answer.agreement();
        Some(Self {
            span_m,
            energy_j: first.energy_j,
            extremes: Extremes::of(&first.joints_m, [0, last], &first.axial_n)?,
            reactions_n: first.reactions_n,
            rises_deg: first.joints_m.windows(2).map(|ends| rise_deg(ends[0], ends[1])).collect(),
            rung: answer.rung(),
            agrees: answer.agrees(),
            check_failed: answer.check_failed(),
            joints_differ_m: agreement.map(|both| both.joints_m),
            forces_differ_n: agreement.map(|both| both.forces_n),
        })
    }
}

/// The angle above the level of the way from one joint to another, degrees.
fn rise_deg(from: Vector, to: Vector) -> f64 {
    (to[2] - from[2]).atan2((to[0] - from[0]).hypot(to[1] - from[1])).to_degrees()
}

/// The hanging shape at every point.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyAnswer {
    system: SystemSummary,
    parameters: Vec<String>,
    units: Vec<&'static str>,
    paths: usize,
    points: Vec<StudyPoint>,
}

impl StudyAnswer {
    /// The names of the parameters, as in the system file.
    #[must_use]
    pub fn parameters(&self) -> &[String] {
        &self.parameters
    }

    /// The units of the parameters.
    #[must_use]
    pub fn units(&self) -> &[&'static str] {
        &self.units
    }

    /// The chain whose numbers vary.
    #[must_use]
    pub fn system(&self) -> &SystemSummary {
        &self.system
    }

    /// The points, the last parameter changing fastest.
    #[must_use]
    pub fn points(&self) -> &[StudyPoint] {
        &self.points
    }

    /// How many paths there are: combinations of all parameters but the last.
    #[must_use]
    pub fn paths(&self) -> usize {
        self.paths
    }

    /// The shapes that were found.
    pub fn shapes(&self) -> impl Iterator<Item = &StudyShape> {
        self.points.iter().filter_map(|point| point.shape.as_ref().ok())
    }

    /// Whether a check failed at some point.
    #[must_use]
    pub fn check_failed(&self) -> bool {
        self.shapes().any(|shape| shape.check_failed)
    }

    /// Whether every point is solved and agreed on, or refused because no chain can hang there.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.points.iter().all(|point| match &point.shape {
            Ok(shape) => shape.joints_differ_m.is_none() || shape.agrees,
            Err(none) => none.refused,
        })
    }

    /// Why no value of the parameters describes a chain that can hang, if none does.
    #[must_use]
    pub fn refused_everywhere(&self) -> Option<&str> {
        let mut reasons = self.points.iter().map(|point| match &point.shape {
            Err(NoShape { refused: true, reason }) => Some(reason.as_str()),
            _ => None,
        });
        let first = reasons.next()??;
        reasons.all(|reason| reason.is_some()).then_some(first)
    }

    /// A line per point as CSV, units in the names of the columns; what a refused point has not is
    /// empty.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        let bars = self.system.bars;
        write!(to, "path,{},span_m,agrees,evidence,energy_j,sag_m", self.parameters.join(","))?;
        write!(to, ",lowest_joint,lowest_x_m,lowest_y_m,lowest_z_m")?;
        write!(to, ",tension_n,tension_bar,compression_n,compression_bar")?;
        write!(to, ",start_x_n,start_y_n,start_z_n,end_x_n,end_y_n,end_z_n")?;
        for bar in 1..=bars {
            write!(to, ",rise_{bar}_deg")?;
        }
        writeln!(to, ",refused")?;
        for point in &self.points {
            write!(to, "{}", point.path)?;
            for value in &point.values {
                write!(to, ",{value:?}")?;
            }
            match &point.shape {
                Ok(shape) => shape.write_csv(&mut to)?,
                Err(none) => {
                    write!(to, "{}", ",".repeat(19 + bars))?;
                    writeln!(to, ",{}", crate::csv::quoted(&none.reason))?;
                }
            }
        }
        Ok(())
    }

    /// Sag, forces and angles over the last parameter as SVG, for one path, from 1.
    #[must_use]
    pub fn figure(&self, path: usize) -> String {
        figure::figure(self, path)
    }
}

impl StudyShape {
    /// The cells of a line after the values of the parameters.
    fn write_csv(&self, to: &mut impl Write) -> io::Result<()> {
        let Self { span_m, agrees, energy_j, extremes, .. } = self;
        let rung = self.rung.map_or_else(String::new, |rung| rung.to_string());
        write!(to, ",{span_m:?},{agrees},{rung},{energy_j:?},")?;
        if let Some(sag_m) = extremes.sag_m {
            write!(to, "{sag_m:?}")?;
        }
        write!(to, ",{}", extremes.lowest_joint)?;
        for x in extremes.lowest_m {
            write!(to, ",{x:?}")?;
        }
        for largest in [extremes.tension_n, extremes.compression_n] {
            match largest {
                Some((bar, force_n)) => write!(to, ",{force_n:?},{}", bar + 1)?,
                None => write!(to, ",,")?,
            }
        }
        for force in [self.reactions_n.start, self.reactions_n.end].as_flattened() {
            write!(to, ",{force:?}")?;
        }
        for rise in &self.rises_deg {
            write!(to, ",{rise:?}")?;
        }
        writeln!(to, ",")
    }
}

/// As `funicular study --json` prints it.
impl Serialize for StudyAnswer {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Object<'a> {
            schema_version: u32,
            system: &'a SystemSummary,
            parameters: &'a [String],
            units: &'a [&'static str],
            points: &'a [StudyPoint],
        }
        let Self { system, parameters, units, points, .. } = self;
        Object { schema_version: SCHEMA_VERSION, system, parameters, units, points }
            .serialize(serializer)
    }
}
