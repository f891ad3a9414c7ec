//! Numbers of a system file that vary.

use std::sync::Arc;

use branches::{Combine, Parameter, ParameterError, Variation};

use crate::error::Error;
use crate::problem::Problem;

/// Numbers of a system file with their values: what a [`Study`](crate::Study) and a
/// [`Trace`](crate::Trace) run over.
///
/// ```
/// use funicular::{Parameters, Study, prelude::*};
/// let parameters = Parameters::new().vary("bars.2.mass_kg=1,2")?.vary("anchors.end_m.z=-2,-1")?;
/// let found = Study::new().over(parameters).run(&Problem::case("three-equal-bars")?)?;
/// assert_eq!(found.points().len(), 4);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Parameters {
    all: Vec<Parameter>,
    combine: Combine,
}

impl Parameters {
    /// None yet, to be taken in all combinations.
    pub fn new() -> Self {
        Self::default()
    }

    /// A number of the system file and its values, as `anchors.end_m.z=-2.9..-0.1:500`, in the
    /// units of the file. A [`Trace`](crate::Trace) also takes a range alone, `loads=0..1.2`.
    ///
    /// # Errors
    /// [`Error::Parameter`] with the place in the text.
    pub fn vary(mut self, text: &str) -> Result<Self, Error> {
        self.all.push(text.parse()?);
        Ok(self)
    }

    /// How several parameters are combined.
    #[must_use]
    pub fn combine(self, combine: Combine) -> Self {
        Self { combine, ..self }
    }

    /// Whether the problem is one row of rigid bars between two anchors under upright loads, and stays one.
    pub(crate) fn keep_row(&self, problem: &Problem) -> bool {
        problem.row().is_some() && self.all.iter().all(|one| one.number.keeps_rows())
    }

    /// Whether one is a range without a number of points.
    pub(crate) fn is_open(&self) -> bool {
        self.all.iter().any(|one| one.open)
    }

    /// The same with so many values of each range that has no number of them.
    pub(crate) fn sampled(&self, points: usize) -> Self {
        let all = self.all.iter().map(|one| one.sampled(points));
        Self { all: all.collect(), combine: self.combine }
    }

    /// A problem with these parameters, for paths that find their own points.
    pub(crate) fn along(&self, problem: &Problem) -> Result<Variation, Error> {
        let system = Arc::unwrap_or_clone(problem.system());
        Ok(Variation::along(system, &self.all, self.combine)?)
    }

    /// A problem with these parameters.
    pub(crate) fn over(&self, problem: &Problem) -> Result<Variation, Error> {
        let system = Arc::unwrap_or_clone(problem.system());
        Ok(Variation::new(system, &self.all, self.combine)?)
    }
}

/// A parameter has values; what they are does not matter here.
pub(crate) fn parsed(path: &str) -> Result<Parameter, Error> {
    let parameter = format!("{path}=1").parse();
    parameter.map_err(|error| without_value(error, path).into())
}

/// The error about the path alone.
pub(crate) fn without_value(error: ParameterError, path: &str) -> ParameterError {
    let end = |at: usize| at.min(path.len());
    let span = end(error.span.start)..end(error.span.end);
    ParameterError { text: path.to_owned(), span, ..error }
}

impl Problem {
    /// The same problem with other numbers of its file, by their paths; a chain becomes a system with
    /// joints named by their numbers, from `0`.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// let lamp = Problem::case("lamp")?;
    /// let heavy = lamp.with(&[("joints.lamp.mass_kg", 4.0), ("gravity_m_s2", 10.0)])?;
    /// let weight: f64 =
    ///     Solve::new().run(&heavy)?.equilibria()[0].reactions_n.iter().map(|force| force[2]).sum();
    /// assert!((weight - 40.0).abs() < 1e-9);
    /// assert!(lamp.with(&[("joints.candle.mass_kg", 4.0)]).is_err());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Parameter`] for what the problem has not, [`Error::Point`] where the numbers describe
    /// no problem.
    pub fn with(&self, numbers: &[(impl AsRef<str>, f64)]) -> Result<Self, Error> {
        let system = self.system();
        let number = |(path, value): &(_, f64)| {
            let path: &str = AsRef::as_ref(path);
            let parameter = parsed(path)?;
            branches::check(&system, &parameter).map_err(|error| without_value(error, path))?;
            Ok::<_, Error>((parameter.number, *value))
        };
        let numbers = numbers.iter().map(number).collect::<Result<Vec<_>, _>>()?;
        Ok(branches::apply(&system, &numbers)?.into())
    }
}
