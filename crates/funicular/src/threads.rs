//! How many threads share the work.

use crate::error::Error;

/// More threads than this are a mistake: they would only wait for each other.
pub const MOST_THREADS: usize = 1024;

/// Do the work on this many threads, or for 0 on those of the pool that it is called from. No
/// answer depends on it.
pub(crate) fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> Result<T, Error> {
    if threads == 0 {
        return Ok(work());
    }
    if threads > MOST_THREADS {
        return Err(Error::TooManyThreads(threads));
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Error::Threads { threads, reason: error.to_string() })?;
    Ok(pool.install(work))
}
