//! Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};

use miette::miette;

use crate::exit::{Exit, Failure};

static STOP: AtomicBool = AtomicBool::new(false);

/// A flag that is set by the first Ctrl-C (or SIGTERM, as batch systems send it). The second one ends the
/// program at once, which loses no more than the first.
pub fn on_interrupt() -> Result<&'static AtomicBool, Failure> {
    ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::SeqCst) {
            std::process::exit(Exit::Interrupted.code().into());
        }
    })
    .map_err(|error| Failure::bad_input(miette!("Ctrl-C cannot be watched for: {error}")))?;
    Ok(&STOP)
}
