//! What is equal in joints or members that follow one another is in memory once.

use std::sync::Arc;

/// What may share its properties with one that is equal.
pub(crate) trait Shares: Sized {
    /// Have the properties of the one before, where they are equal.
    fn share(&mut self, before: &Self);

    /// One more, behind those that there are.
    fn join(mut self, all: &mut Vec<Self>) {
        if let Some(before) = all.last() {
            self.share(before);
        }
        all.push(self);
    }
}

/// Let go of what is equal to the one before.
pub(super) fn share<T: PartialEq>(properties: &mut Arc<T>, before: &Arc<T>) {
    if !Arc::ptr_eq(properties, before) && properties == before {
        *properties = Arc::clone(before);
    }
}

/// Let all share what they can with the one before.
pub(super) fn share_all<T: Shares>(all: &mut [T]) {
    for k in 1..all.len() {
        let (before, from) = all.split_at_mut(k);
        from[0].share(&before[k - 1]);
    }
}
