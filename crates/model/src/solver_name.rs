//! Who found an answer.

use std::borrow::Cow;
use std::fmt::{self, Display, Formatter};

use serde::Serialize;

/// The solver behind an answer: one of ours, or any other by its name.
///
/// ```
/// use model::SolverName;
/// let third = SolverName::new("ipopt");
/// assert_ne!(third, SolverName::LAGRANGE);
/// assert_eq!(SolverName::new("lagrange"), SolverName::LAGRANGE);
/// assert_eq!(third.to_string(), "ipopt");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(transparent)]
pub struct SolverName(Cow<'static, str>);

impl SolverName {
    /// Crate `lagrange`: forces first.
    pub const LAGRANGE: Self = Self(Cow::Borrowed("lagrange"));
    /// Crate `energy`: energy first.
    pub const ENERGY: Self = Self(Cow::Borrowed("energy"));
    /// Crate `census`: every equilibrium, by interval branch and bound.
    pub const CENSUS: Self = Self(Cow::Borrowed("census"));

    /// A solver of any name.
    pub fn new(name: impl Into<Cow<'static, str>>) -> Self {
        Self(name.into())
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl Display for SolverName {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
