//! What people read: the reproduction report and its figures.
