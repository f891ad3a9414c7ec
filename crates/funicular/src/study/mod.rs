//! The hanging shape over a parameter.

mod answer;
mod figure;
mod page;
mod shape;

pub use self::answer::{StudyAnswer, StudyPoint};
pub use self::shape::{NoShape, StudyShape};

use branches::{Number, Variation};
use model::Vector;
use model::budget::BYTES_PER_MEMBER;
use model::system::System;
use rayon::prelude::*;
use validate::{Solvers, UseCensus};

use crate::error::Error;
use crate::observable::Observable;
use crate::parameters::Parameters;
use crate::problem::Problem;
use crate::solve::Solve;
use crate::threads;

/// Solves a chain or a system over numbers of its system file: how sag, forces and angles of the
/// hanging shape depend on them. For any size; every point is solved by both solvers and judged as
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
    parameters: Parameters,
    of: Vec<String>,
    solvers: Solvers,
    threads: usize,
    with_shapes: bool,
}

impl Study {
    /// Over no parameter yet, by both solvers.
    pub fn new() -> Self {
        Self::default()
    }

    /// Over one more number of the system file, as [`Parameters::vary`] reads it. Each
    /// combination of all but the last is a path of its own.
    ///
    /// # Errors
    /// [`Error::Parameter`] with the place in the text.
    pub fn vary(self, text: &str) -> Result<Self, Error> {
        Ok(Self { parameters: self.parameters.vary(text)?, ..self })
    }

    /// Shows one more number of each shape: a place `joints.NAME` (or one coordinate, `joints.NAME.z`), the `sag.NAME-NAME` of the row of
    /// members between two joints, an axial force of a member, `bars.NUMBER.axial_max_n` (or `axial_n`, `axial_from_n`, `axial_to_n`), the part of its
    /// strength that a member uses, `bars.NUMBER.utilisation`, or `utilisation` of the weakest, or the
    /// `height` of the lowest joint over the floor, Z = 0 where there is none, or over `height=DATUM`.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// // Two bars of 1 m hang as a V of equal sides under anchors 1 m apart.
    /// let problem = Problem::parse(
    ///     "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
    ///      bars = [{ length_m = 1, mass_kg = 1, count = 2 }]",
    ///     "two.toml",
    /// )?;
    /// let study = Study::new().vary("gravity_m_s2=1.62,9.81")?.of("joints.1.z").of("height=-2");
    /// let found = study.run(&problem)?;
    /// let depth_m = 0.75_f64.sqrt();
    /// for shape in found.shapes() {
    ///     let [place_m, height_m] = [shape.of[0].unwrap(), shape.of[1].unwrap()];
    ///     assert!((place_m + depth_m).abs() < 1e-12 && (height_m - 2.0 + depth_m).abs() < 1e-12);
    /// }
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn of(mut self, name: impl Into<String>) -> Self {
        self.of.push(name.into());
        self
    }

    /// Over these parameters.
    #[must_use]
    pub fn over(self, parameters: Parameters) -> Self {
        Self { parameters, ..self }
    }

    setters! {
        /// Which solvers to ask; one alone gets no comparison.
        solvers: Solvers,
        /// How many threads share the work, 0 (the default) for those of the pool that it is called
        /// from. No answer depends on it.
        threads: usize,
    }

    /// Keep places and forces of each shape.
    #[must_use]
    pub(crate) fn with_shapes(self) -> Self {
        Self { with_shapes: true, ..self }
    }

    /// How many points each path has: each combination of all parameters but the last is a path.
    ///
    /// # Errors
    /// [`Error::Parameter`] when a parameter does not fit the problem.
    pub fn points(&self, problem: &Problem) -> Result<Vec<usize>, Error> {
        Ok(self.parameters.over(problem)?.paths().iter().map(Vec::len).collect())
    }

    /// Solve all points.
    ///
    /// # Errors
    /// As [`points`](Self::points), and [`Error::Parameter`] when [`of`](Self::of) names nothing of the
    /// problem. A point that is refused or unsolved is no error: it says
    /// why.
    pub fn run(&self, problem: &Problem) -> Result<StudyAnswer, Error> {
        self.run_watched(problem, &|| {})
    }

    /// The same, with `watch` told of each point that is done.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn() + Sync),
    ) -> Result<StudyAnswer, Error> {
        problem.fits(BYTES_PER_MEMBER)?;
        let variation = self.parameters.over(problem)?;
        let of = self.units(variation.base())?;
        self.all(&variation, of, problem.row().is_some(), watch)
    }

    /// What is to be shown besides, with its units.
    fn units(&self, system: &System) -> Result<Vec<(String, &'static str)>, Error> {
        let named = self.of.iter().map(|text| Observable::named(text, system));
        Ok(named.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// All points. Of a system that is drawn each is solved next to the one before it on its path: the
    /// branch that the drawing begins on is followed.
    fn all(
        &self,
        variation: &Variation,
        of: Vec<(String, &'static str)>,
        spans: bool,
        watch: &(dyn Fn() + Sync),
    ) -> Result<StudyAnswer, Error> {
        let solve = Solve::new().solvers(self.solvers).census(UseCensus::Never);
        let point = |path: usize, values: &Vec<f64>, before: &mut Option<Vec<Vector>>| {
            let shape = NoShape::or(variation.system(values).map(Problem::from), |problem| {
                StudyShape::found(problem, before, &solve, &of, self.with_shapes)
            });
            watch();
            StudyPoint { path, values: values.clone(), shape }
        };
        let paths: Vec<_> = variation.paths().iter().enumerate().collect();
        let along = |(path, points): (usize, &Vec<Vec<f64>>)| -> Vec<StudyPoint> {
            if variation.base().drawing().is_some() {
                let mut before = None;
                return points.iter().map(|at| point(path + 1, at, &mut before)).collect();
            }
            points.par_iter().map(|at| point(path + 1, at, &mut None)).collect()
        };
        let points = threads::on(self.threads, || {
            paths.into_par_iter().map(along).flatten_iter().collect()
        })?;
        let numbers = variation.numbers();
        Ok(StudyAnswer {
            system: variation.base().clone(),
            spans,
            parameters: numbers.iter().map(ToString::to_string).collect(),
            units: numbers.iter().map(Number::unit).collect(),
            of,
            paths: variation.paths().len(),
            points,
        })
    }
}
