//! Work that several threads share.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

/// What `work` makes of each number below `count`, in their order, by the threads of the pool that it runs in.
///
/// A thread takes at least `apart` numbers in a row: work shorter than some microseconds is not worth handing over one
/// by one. What hands it over knows no types, so that it is compiled once and not for every kind of work.
///
/// ```
/// assert_eq!(numerics::in_parallel(5, 1, |k| k * k), [0, 1, 4, 9, 16]);
/// ```
pub fn in_parallel<T: Send>(
    count: usize,
    apart: usize,
    work: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let mut done = Vec::new();
    done.resize_with(count, || Mutex::new(None));
    each(count, apart, &|k| {
        *done[k].lock().unwrap_or_else(PoisonError::into_inner) = Some(work(k));
    });
    let taken = |slot: Mutex<Option<T>>| slot.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.into_iter().filter_map(taken).collect()
}

fn each(count: usize, apart: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().with_min_len(apart).for_each(work);
}
