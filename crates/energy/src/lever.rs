//! The lever rule, as this crate derives it from the energy.
//!
//! The height of the centre of weight of a bar is linear in the heights of its two joints: with `r`
//! from the first, `z_C = (1 - r/l) z_first + (r/l) z_last`. So its weight lifts them as two
//! weights in these parts do.

use model::Bar;

/// The part of its weight that rises with the last joint of a bar: `r/l`.
pub(crate) fn at_last(bar: &Bar) -> f64 {
    bar.centre_m() / bar.length_m()
}

/// The part of its weight that rises with the first joint of a bar, exactly none where the centre
/// of weight is on the last.
pub(crate) fn at_first(bar: &Bar) -> f64 {
    (bar.length_m() - bar.centre_m()) / bar.length_m()
}
