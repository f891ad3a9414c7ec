//! What the report says: one chapter a file, each a list of blocks.

pub(crate) mod cases;
pub(crate) mod citing;
pub(crate) mod claims;
pub(crate) mod equations;
pub(crate) mod field;
pub(crate) mod gallery;
pub(crate) mod method;
pub(crate) mod overview;
pub(crate) mod positions;
pub(crate) mod run;
pub(crate) mod scan;
