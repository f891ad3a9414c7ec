//! The systems that the benches solve.

use model::{Anchors, Bar, Chain, Problem};

/// The chain of the benches: n equal bars of total mass 1 kg, together 1.5 times as long as the
/// span, between (0, 0, 0) and (1, 0, -0.2), in standard gravity.
///
/// # Panics
///
/// When `n` is less than 2.
#[must_use]
pub fn equal_bars(n: usize) -> Problem {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, -0.2] };
    let length_m = 1.5 * anchors.span_m() / n as f64;
    let bar = Bar::homogeneous(length_m, 1.0 / n as f64).expect("a valid bar");
    let chain = Chain::new("equal bars", model::STANDARD_GRAVITY_M_S2, anchors, vec![bar; n]);
    Problem::new(chain.expect("a valid chain")).expect("a slack chain of two bars or more")
}
