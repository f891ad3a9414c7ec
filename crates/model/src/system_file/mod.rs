//! System files: a chain as TOML, read with the place of every error.
//!
//! ```toml
//! name = "three equal bars"         # optional, for people: "unnamed"
//! gravity_m_s2 = 9.80665            # optional, this is the default; acts along -Z
//!
//! [anchors]
//! start_m = [0.0, 0.0, 0.0]         # joint 0
//! end_m   = [0.0, 0.0, -2.0]        # joint n
//!
//! [[bars]]                          # from the start anchor to the end anchor
//! length_m = 1.0                    # positive
//! mass_kg  = 1.0                    # zero or positive
//! centre_m = 0.5                    # optional: length_m / 2; between 0 and length_m
//! inertia_kg_m2 = [0.0, 0.0833, 0.0833]   # optional: homogeneous slender bar
//! count = 3                         # optional: that many equal bars in a row
//! ```
//!
//! Numbers may be written as integers. Unknown keys are errors. What is no equilibrium problem is
//! refused by [`read_problem`] with the numbers of its [`Refusal`](crate::Refusal).
//!
//! ```
//! use model::system_file::parse_problem;
//! let text = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n\n[[bars]]\nlenght_m = 1\nmass_kg = 1\ncount = 3\n";
//! let error = parse_problem(text, "chain.toml").unwrap_err();
//! assert_eq!(error.to_string(), "chain.toml:6:1: bars[1].lenght_m: unknown key `lenght_m`");
//! assert!(error.help().unwrap().starts_with("did you mean `length_m`?"));
//! ```

mod error;
mod read;
mod write;

pub use error::{Position, SystemFileError, SystemFileErrorKind};
pub use read::{MAX_BARS, MAX_FILE_BYTES, parse_problem, parse_system, read_problem, read_system};
pub use write::write_system;
