//! Work without the interpreter lock, on threads of the package, that Ctrl-C stops.
//!
//! A piece of work runs on a pool of threads, and the caller waits for it without the lock. Every
//! [`LOOK`] it looks for signals, and hands on what the work tells. Once it is cancelled, the work
//! ends at the next time that it tells something, by unwinding; the caller does not wait for that.

use std::fmt::Display;
use std::num::NonZeroU64;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::process;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use funicular::Error;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use serde::Serialize;

use crate::printable::printable;
use crate::raise::{internal, raise};

/// How often the caller looks for signals: what people take for at once.
const LOOK: Duration = Duration::from_millis(50);

/// How often at most the caller is told how far the work is.
const TELL: Duration = Duration::from_millis(100);

/// Stack of a thread: the nested searches of the solvers fit into a small part of it.
const STACK: usize = 8 << 20;

/// The pools that were asked for, by their numbers of threads: one for each piece of work at a time, so that none waits
/// for what another caller has begun, or for what was cancelled and has not ended yet. A child process has the memory
/// of its parent and none of its threads, so they belong to one process.
struct Pools {
    process: u32,
    /// Threads where nothing is said; 0 for one per processor.
    threads: usize,
    started: Vec<(usize, Arc<ThreadPool>)>,
}

static POOLS: Mutex<Pools> = Mutex::new(Pools { process: 0, threads: 0, started: Vec::new() });

/// How many threads share the work where nothing is said, 0 for one per processor.
#[pyfunction]
pub fn set_threads(threads: usize) -> PyResult<()> {
    check(threads)?;
    POOLS.lock().unwrap_or_else(PoisonError::into_inner).threads = threads;
    Ok(())
}

/// How many threads share the work where nothing is said.
#[pyfunction]
pub fn get_threads() -> usize {
    match POOLS.lock().unwrap_or_else(PoisonError::into_inner).threads {
        0 => processors(),
        threads => threads,
    }
}

/// Hold every solve of this process to so much work.
#[pyfunction]
pub fn limit_work(numbers: NonZeroU64) {
    funicular::limit_work(numbers);
}

fn processors() -> usize {
    thread::available_parallelism().map_or(1, Into::into)
}

fn check(threads: usize) -> PyResult<()> {
    if threads > funicular::MOST_THREADS {
        return Err(raise(&Error::TooManyThreads(threads)));
    }
    Ok(())
}

/// A pool of so many threads, 0 for as many as were set, on which nothing works; whoever holds it works on it.
fn pool(threads: usize) -> PyResult<Arc<ThreadPool>> {
    check(threads)?;
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    if pools.process != process::id() {
        // Dropping pools whose threads are not there would wait for them.
        std::mem::forget(std::mem::take(&mut pools.started));
        pools.process = process::id();
    }
    let wanted = if threads == 0 { pools.threads } else { threads };
    let wanted = if wanted == 0 { processors() } else { wanted };
    let idle = |(threads, pool): &&(usize, Arc<ThreadPool>)| {
        *threads == wanted && Arc::strong_count(pool) == 1
    };
    if let Some((_, pool)) = pools.started.iter().find(idle) {
        return Ok(Arc::clone(pool));
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(wanted)
        .stack_size(STACK)
        .thread_name(|k| format!("funicular-{k}"))
        .build()
        .map_err(|error| internal(&error.to_string()))?;
    let pool = Arc::new(pool);
    pools.started.push((wanted, Arc::clone(&pool)));
    Ok(pool)
}

/// What a piece of work tells whoever waits for it.
enum Message<T> {
    /// What is done, how much of it, and of how much in all (0: not known).
    Told(String, u64, u64),
    /// The work has ended.
    Ended(thread::Result<T>),
}

/// Hands on what the work tells.
type HandOn = Box<dyn Fn(String, u64, u64) + Send + Sync>;

/// Told by the work how far it is; ends the work where it is cancelled.
pub struct Watch {
    cancelled: AtomicBool,
    begun: Instant,
    /// Milliseconds from the beginning to the last time that something was handed on.
    told_ms: AtomicU64,
    hand_on: Option<HandOn>,
}

/// What unwinds through work that is cancelled.
struct Cancelled;

impl Watch {
    /// End the work here if it is cancelled: at the beginning of each part.
    pub fn go_on(&self) {
        if self.cancelled.load(Ordering::Relaxed) {
            resume_unwind(Box::new(Cancelled));
        }
    }

    /// What is being done, how much of it is done, and of how much in all (0: not known).
    pub fn tell(&self, what: &str, done: u64, total: u64) {
        self.go_on();
        let Some(hand_on) = &self.hand_on else { return };
        let now = u64::try_from(self.begun.elapsed().as_millis()).unwrap_or(u64::MAX);
        let last = self.told_ms.load(Ordering::Relaxed);
        let due = now >= last.saturating_add(u64::try_from(TELL.as_millis()).unwrap_or(0));
        let ours = || {
            self.told_ms.compare_exchange(last, now, Ordering::Relaxed, Ordering::Relaxed).is_ok()
        };
        if (due || (total > 0 && done == total)) && ours() {
            hand_on(what.to_owned(), done, total);
        }
    }

    /// Set once the work is cancelled, for work that looks for itself.
    pub fn stop(&self) -> &AtomicBool {
        &self.cancelled
    }
}

/// Do the work on so many threads (0: as many as were set), and wait for it. `progress` is called
/// on the thread of the caller with what is done, how much, and of how much; what it raises ends
/// the work.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<T> {
    let pool = pool(threads)?;
    let (sender, receiver) = channel();
    let hand_on = progress.map(|_| hand_on(sender.clone()));
    let watch = Arc::new(Watch {
        cancelled: AtomicBool::new(false),
        begun: Instant::now(),
        told_ms: AtomicU64::new(0),
        hand_on,
    });
    let working = Arc::clone(&watch);
    Arc::clone(&pool).spawn(move || {
        let ended = catch_unwind(AssertUnwindSafe(|| work(&working)));
        drop(pool);
        // Whoever was cancelled is not waited for.
        let _ = sender.send(Message::Ended(ended));
    });
    let found = wait(py, receiver, progress);
    if found.is_err() {
        watch.cancelled.store(true, Ordering::Relaxed);
    }
    found
}

/// The same of work of the library, whose error is raised.
pub fn answer<T: Send + 'static>(
    py: Python<'_>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> Result<T, Error> + Send + 'static,
) -> PyResult<T> {
    run(py, threads, progress.as_ref(), work)?.map_err(|error| raise(&error))
}

/// What the program prints of an answer, with `--json` and without. A number that JSON has not is a bug.
pub fn told(found: &(impl Serialize + Display)) -> (String, String) {
    (json(found), printable(&found.to_string()))
}

/// As a text of JSON.
pub fn json(found: &impl Serialize) -> String {
    serde_json::to_string(found).unwrap_or_else(|error| unreachable!("{error}"))
}

fn hand_on<T: Send + 'static>(sender: Sender<Message<T>>) -> HandOn {
    Box::new(move |what, done, total| {
        let _ = sender.send(Message::Told(what, done, total));
    })
}

fn wait<T: Send>(
    py: Python<'_>,
    mut receiver: Receiver<Message<T>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<T> {
    loop {
        let message = py.detach(|| {
            let message = receiver.recv_timeout(LOOK);
            (message, receiver)
        });
        receiver = message.1;
        match message.0 {
            Ok(Message::Told(what, done, total)) => {
                if let Some(progress) = progress {
                    progress.call1((what, done, total))?;
                }
            }
            Ok(Message::Ended(Ok(found))) => return Ok(found),
            Ok(Message::Ended(Err(panic))) => return Err(internal(&said(panic.as_ref()))),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Err(internal("the work was lost")),
        }
        py.check_signals()?;
    }
}

/// What a panic says.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "a panic without words".to_owned())
}
