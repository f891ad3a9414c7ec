//! Numbers of a system file that vary.

use branches::{Base, Combine, Parameter, Variation};

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
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A number of the system file and its values, as `anchors.end_m.z=-2.9..-0.1:500`, in the
    /// units of the file.
    ///
    /// # Errors
    ///
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

    /// The chain of a problem with these parameters; `what` needs one.
    pub(crate) fn of(&self, problem: &Problem, what: &'static str) -> Result<Variation, Error> {
        self.over(problem.chain_for(what)?.chain().clone())
    }

    /// A chain or a system with these parameters.
    pub(crate) fn over<B: Base>(&self, base: B) -> Result<Variation<B>, Error> {
        Ok(Variation::new(base, &self.all, self.combine)?)
    }
}
