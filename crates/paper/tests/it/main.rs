//! The audit of the paper: its verdicts, and that no wrong number passes unseen.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod bounds;
mod claims;
mod completeness;
mod equations;
mod figures;
mod printed;
mod reproduction;
mod sextic;
