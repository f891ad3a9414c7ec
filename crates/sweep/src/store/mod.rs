//! Sweeps on disk.

pub(crate) mod compute;
pub(crate) mod description;
pub(crate) mod digests;
pub(crate) mod error;
pub(crate) mod finished;
pub(crate) mod lock;
pub(crate) mod manifest;
pub(crate) mod merge;
pub(crate) mod open;
pub(crate) mod part;
pub(crate) mod run;
pub(crate) mod shard;
