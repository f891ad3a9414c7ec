//! Work that is shared by threads and handed on in the order in which it came.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Bytes of results that may wait for an earlier one before the threads wait too.
const WAITING_BYTES: usize = 64 << 20;

/// What waits to be handed on.
struct Queue<R, W> {
    write: W,
    /// The number of the result that is handed on next.
    next: usize,
    waiting: BTreeMap<usize, (R, usize)>,
    bytes: usize,
    ended: bool,
}

impl<R, W: FnMut(R) -> ControlFlow<()>> Queue<R, W> {
    /// Hand on all that waits for no earlier result.
    fn hand_on(&mut self) {
        while !self.ended
            && let Some((result, bytes)) = self.waiting.remove(&self.next)
        {
            self.next += 1;
            self.bytes -= bytes;
            self.ended = (self.write)(result).is_break();
        }
    }
}

/// Results that wait, and who waits for room among them.
struct Shared<R, W> {
    queue: Mutex<Queue<R, W>>,
    room: Condvar,
}

impl<R, W: FnMut(R) -> ControlFlow<()>> Shared<R, W> {
    fn lock(&self) -> MutexGuard<'_, Queue<R, W>> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Take in a result; the one that all others wait for always has room.
    fn take_in(&self, number: usize, result: R, bytes: usize) {
        let mut queue = self.lock();
        while number != queue.next && queue.bytes > WAITING_BYTES && !queue.ended {
            queue = self.room.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
        queue.bytes += bytes;
        queue.waiting.insert(number, (result, bytes));
        queue.hand_on();
        self.room.notify_all();
    }
}

/// Ends the work of all threads when one of them panics, so that none waits for its result.
struct EndOnPanic<'a, R, W: FnMut(R) -> ControlFlow<()>>(&'a Shared<R, W>);

impl<R, W: FnMut(R) -> ControlFlow<()>> Drop for EndOnPanic<'_, R, W> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.lock().ended = true;
            self.0.room.notify_all();
        }
    }
}

/// Do `work` on what `source` gives, on so many threads, and hand the results to `write` one by one
/// in the order of the source, until it has had enough. `bytes` says how much memory a result
/// holds: results that wait for an earlier one hold little more than a bound, whatever the source.
pub fn in_order<T, R: Send>(
    threads: usize,
    source: impl Iterator<Item = T> + Send,
    work: impl Fn(T) -> R + Sync,
    bytes: impl Fn(&R) -> usize + Sync,
    write: impl FnMut(R) -> ControlFlow<()> + Send,
) {
    let source = Mutex::new(source.enumerate());
    let (waiting, room) = (BTreeMap::new(), Condvar::new());
    let queue = Mutex::new(Queue { write, next: 0, waiting, bytes: 0, ended: false });
    let shared = Shared { queue, room };
    let one_after_the_other = || {
        let _guard = EndOnPanic(&shared);
        while !shared.lock().ended {
            let next = source.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((number, item)) = next else { break };
            let result = work(item);
            let bytes = bytes(&result);
            shared.take_in(number, result, bytes);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(one_after_the_other);
        }
        one_after_the_other();
    });
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::{WAITING_BYTES, in_order};

    #[test]
    fn results_come_in_the_order_of_the_source_whatever_the_threads() {
        for threads in [1, 2, 7] {
            let mut seen = vec![];
            // The first of each ten takes longest.
            let work = |k: u64| {
                std::thread::sleep(std::time::Duration::from_micros(if k.is_multiple_of(10) {
                    900
                } else {
                    9
                }));
                k * k
            };
            in_order(
                threads,
                0..200,
                work,
                |_| 1,
                |square| {
                    seen.push(square);
                    ControlFlow::Continue(())
                },
            );
            assert_eq!(seen, (0..200).map(|k| k * k).collect::<Vec<_>>());
        }
    }

    #[test]
    fn threads_wait_when_results_pile_up_behind_a_slow_one() {
        let (held, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let work = |k: usize| {
            if k == 0 {
                std::thread::sleep(std::time::Duration::from_millis(60));
            }
            most.fetch_max(held.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
        };
        // Two of them reach the bound.
        in_order(
            3,
            0..100,
            work,
            |()| WAITING_BYTES / 2 + 1,
            |()| {
                held.fetch_sub(1, Ordering::SeqCst);
                ControlFlow::Continue(())
            },
        );
        assert_eq!(held.into_inner(), 0);
        // Two wait, and each thread may hold one in its hands.
        assert!(most.into_inner() <= 5);
    }

    #[test]
    fn nothing_is_asked_for_once_the_reader_has_gone() {
        let asked = AtomicUsize::new(0);
        let source = std::iter::repeat_with(|| asked.fetch_add(1, Ordering::SeqCst));
        let mut written = 0;
        in_order(
            2,
            source,
            |k| k,
            |_| 1,
            |_| {
                written += 1;
                if written == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        );
        assert_eq!(written, 3);
        assert!(asked.into_inner() < 20);
    }

    #[test]
    fn a_panic_ends_all() {
        let work = |k: usize| assert_ne!(k, 3, "the fourth");
        let caught = std::panic::catch_unwind(|| {
            in_order(2, 0..1000, work, |()| WAITING_BYTES, |()| ControlFlow::Continue(()));
        });
        assert!(caught.is_err());
    }
}
