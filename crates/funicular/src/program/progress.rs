//! Progress on standard error, only where a person watches.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// How often the spinner turns.
const TICK: Duration = Duration::from_millis(100);

/// A spinner that says what is going on; silent where standard error is no terminal.
pub struct Progress(ProgressBar);

impl Progress {
    /// Start to show progress.
    pub fn start() -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed:>4} {msg}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(TICK);
        Self(bar)
    }

    /// Say what is going on now.
    pub fn say(&self, what: &str) {
        self.0.set_message(what.to_owned());
    }

    /// Says how many of all are done, each time that it is called.
    pub fn counter(&self, all: usize, what: &'static str) -> impl Fn() + Sync {
        let done = AtomicUsize::new(0);
        move || {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            self.say(&format!("{done} of {all} {what}"));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
