//! The tests of the judge from outside, in one program.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking; so do its helpers")]

mod agreement;
mod beside_heavy;
mod census;
mod chains;
mod chains_as_networks;
mod chains_catenary;
mod chains_million;
mod chains_stability;
mod common;
mod drawn;
mod external;
mod far;
mod field;
mod first_tries;
mod floor;
mod frames;
mod free_turns;
mod independence;
mod integer_chains;
mod judged;
mod just_taut;
mod moving;
mod near_slack;
mod neighbours;
mod network_properties;
mod networks;
mod networks_census;
mod prescribed;
mod ropes;
mod ropes_corners;
mod rows;
mod statics;
mod tensegrities;
mod third_road;
mod trusses;
