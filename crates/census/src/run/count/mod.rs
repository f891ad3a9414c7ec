//! How many equilibria there are, without the search.

pub(crate) mod morse;
pub mod sextic;
pub(crate) mod topology;
