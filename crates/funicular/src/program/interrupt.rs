//! Ctrl-C, and SIGTERM, as batch systems send it.

use std::fs;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::exit::{Exit, Failure, Result};

/// Set by the first Ctrl-C while something is done that can be gone on with.
static STOP: AtomicBool = AtomicBool::new(false);

/// Whether there is something to keep.
static KEEPING: AtomicBool = AtomicBool::new(false);

/// Held while a line is written.
static LINE: Mutex<()> = Mutex::new(());

/// That Ctrl-C is watched for.
#[derive(Debug)]
pub struct Interrupt(&'static AtomicBool);

impl Interrupt {
    /// From here on the first Ctrl-C only sets a flag, so that what is done is kept. The second one
    /// ends the program at once, which loses no more than the first.
    pub fn keep_what_is_done(self) -> &'static AtomicBool {
        KEEPING.store(true, Ordering::SeqCst);
        self.0
    }
}

/// Ctrl-C ends the program, until there is something to keep.
pub fn on_interrupt() -> Result<Interrupt> {
    watch(|| {
        if !KEEPING.load(Ordering::SeqCst) || STOP.swap(true, Ordering::SeqCst) {
            end();
        }
    })?;
    Ok(Interrupt(&STOP))
}

/// For commands that keep nothing to go on from: the first Ctrl-C ends the program, and no file is
/// left half written.
pub fn end_on_interrupt() -> Result<()> {
    // A hangup would be heard like a Ctrl-C, and a command under `nohup` is to live on.
    if hangups_are_ignored() { Ok(()) } else { watch(end) }
}

/// For commands that print line by line with [`whole_line`]: the first Ctrl-C ends the program as
/// soon as no line is half written, the second at once, for a reader that takes no more.
pub fn end_between_lines() -> Result<()> {
    if hangups_are_ignored() {
        return Ok(());
    }
    watch(|| {
        // In this order: whoever holds the line looks at the flag after it.
        let again = STOP.swap(true, Ordering::SeqCst);
        let line = LINE.try_lock();
        if again || line.is_ok() {
            end();
        }
    })
}

/// Write what an interruption must not cut.
pub fn whole_line(write: impl FnOnce() -> io::Result<()>) -> io::Result<()> {
    let written = {
        let _line = LINE.lock().unwrap_or_else(PoisonError::into_inner);
        write()
    };
    if STOP.load(Ordering::SeqCst) && !KEEPING.load(Ordering::SeqCst) {
        end();
    }
    written
}

fn watch(heard: impl FnMut() + Send + 'static) -> Result<()> {
    ctrlc::set_handler(heard)
        .map_err(|error| Failure::bad_input(format!("Ctrl-C cannot be watched for: {error}")))
}

fn end() {
    columns::abandon(|| std::process::exit(Exit::Interrupted.code().into()));
}

/// Whether the process was started deaf to SIGHUP. Linux says so; elsewhere nobody is asked.
fn hangups_are_ignored() -> bool {
    /// SIGHUP is signal 1, the lowest bit.
    const HANGUP: u64 = 1;
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_some_and(|mask| mask & HANGUP != 0)
}
