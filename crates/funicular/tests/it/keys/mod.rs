//! Every key of JSON and every column of every command is asserted against a number that does not
//! come from the same code: a closed form, the paper with more digits, a law of nature, a count by
//! hand, the clock.
//!
//! The text files beside the tests list all paths by kind of output, with their values, or with the
//! tests below that compute these; `table.rs` says how. A test fails where it asserts other paths
//! than the text says, or meets one that is not listed; so a new key without a check, and a check
//! without a key, are told. So are fields and variants of types that can be written as JSON and that
//! no run of these tests brings forth: `fields.rs` reads them from the sources.

mod census;
mod fields;
mod files;
mod inventory;
mod laws;
mod load_paths;
mod motion;
mod names;
mod open_rungs;
pub mod output;
mod page;
mod refusals;
mod reproduce;
mod solve;
mod starts;
mod table;
mod undecided;
mod vary;
