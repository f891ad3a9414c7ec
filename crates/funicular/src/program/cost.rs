//! What takes long says so before it begins.

use crate::diagnostics::tell;

/// Work of so much processor time and more is told beforehand, s.
const LONG_S: f64 = 60.0;

/// Tell how long something is expected to take on one processor, if that is long.
pub fn tell_time(what: &str, expected_s: f64) {
    if expected_s >= LONG_S {
        let time = census::rough_time(expected_s);
        tell(format_args!("{what}: about {time} of one processor are expected."));
    }
}
