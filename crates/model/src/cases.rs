//! The registry of named cases.

use crate::{Anchors, Bar, BarError, Chain, ChainError, Problem, Refusal, STANDARD_GRAVITY_M_S2};

/// The paper's example (section VIII): three homogeneous bars of length 1 m and mass 1 kg, the
/// anchors 2 m apart on one vertical.
///
/// # Panics
///
/// Never: the example is a valid problem, and a test builds it.
#[must_use]
pub fn paper() -> Problem {
    build().expect("the paper's example is a valid problem")
}

fn build() -> Result<Problem, Error> {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, -2.0] };
    let bars = vec![Bar::homogeneous(1.0, 1.0)?; 3];
    Ok(Problem::new(Chain::new("three equal bars", STANDARD_GRAVITY_M_S2, anchors, bars)?)?)
}

#[derive(Debug, thiserror::Error)]
enum Error {
    #[error(transparent)]
    Bar(#[from] BarError),
    #[error(transparent)]
    Chain(#[from] ChainError),
    #[error(transparent)]
    Refusal(#[from] Refusal),
}
