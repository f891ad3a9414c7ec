//! The tests of the data types and the files, in one program.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod advice;
mod axial;
mod cases;
mod columns;
mod constructors;
mod drawings;
mod evidence_parts;
mod evidence_words;
mod files;
mod format_page;
mod json;
mod load_cases;
mod memory;
mod mutations;
mod network_columns;
mod numbers;
mod parts;
mod ropes;
mod round_trip;
mod slips;
mod strength;
mod support;
mod system_numbers;
mod systems;
mod texts;
mod tolerances;
