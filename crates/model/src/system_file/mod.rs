//! System files: a chain as TOML, read with the place of every error.
//!
//! ```
//! let text = r#"
//! name = "three equal bars"         # optional, for people: "unnamed"
//! gravity_m_s2 = 9.80665            # optional, this is the default; acts along -Z
//!
//! [anchors]
//! start_m = [0.0, 0.0, 0.0]         # joint 0
//! end_m   = [0.0, 0.0, -2.0]        # joint n
//!
//! [[bars]]                          # from the start anchor to the end anchor
//! length_m = 1.0
//! mass_kg  = 1.0
//! centre_m = 0.5                    # optional: length_m / 2
//! inertia_kg_m2 = [0.0, 0.0833, 0.0833]   # optional: homogeneous slender bar
//! count = 3                         # optional: that many equal bars in a row
//! "#;
//! let chain = model::system_file::parse_system(text, "chain.toml")?;
//! assert_eq!(chain.name(), "three equal bars");
//! assert_eq!(chain.bars().len(), 3);
//! assert_eq!(chain.anchors().span_m(), 2.0);
//! # Ok::<(), model::system_file::SystemFileError>(())
//! ```
//!
//! # Keys
//!
//! | key | | unit | what is allowed | if it is left out |
//! |---|---|---|---|---|
//! | `name` | text | | anything | `"unnamed"` |
//! | `gravity_m_s2` | number | m/s² | positive, finite | 9.80665 |
//! | `anchors.start_m`, `anchors.end_m` | `[x, y, z]` | m | finite | an error |
//! | `bars` | tables | | one or more, unless there is `bars_file` | an error |
//! | `bars_file` | text | | a file of [`columns`] in the place of `bars` | |
//! | `length_m` of a bar | number | m | positive, finite | an error |
//! | `mass_kg` of a bar | number | kg | zero or positive, finite | an error |
//! | `centre_m` of a bar | number | m | from 0 to `length_m`, from the joint nearer to the start | `length_m / 2` |
//! | `inertia_kg_m2` of a bar | `[J_x, J_y, J_z]` | kg m² | zero or positive, finite; x along the bar | `[0, m l²/12, m l²/12]` |
//! | `count` of a bar | whole number | | 1 or more; [`MAX_BARS`] in all | 1 |
//!
//! Any other key is an error, and so is a key given twice. A number is the double nearest to it; it may
//! be written as an integer. `nan` and `inf`, which TOML knows, are refused where they stand, and so is
//! what a double cannot hold (`1e999`).
//!
//! The file is UTF-8, with or without a byte order mark, with line ends `\n` or `\r\n`, and at most
//! [`MAX_FILE_BYTES`] long.
//!
//! # A million different bars
//!
//! `bars_file = "bars.csv"` takes the bars from a file of [`columns`]; its path is relative to the folder
//! of the system file. A million rows are read in a fraction of a second, as `[[bars]]` in seconds. Only
//! [`read_system`] and [`read_problem`] follow it: parsing a text opens no file. A program may bring
//! readers of its own for other kinds of files ([`read_problem_with`]).
//!
//! # Refusals
//!
//! [`read_system`] takes every chain that can be described; [`read_problem`] refuses what is no
//! equilibrium problem, with the numbers of its [`Refusal`](crate::Refusal): at `anchors.end_m` if the
//! bars do not reach, at the bar that is too long, at `bars` if none has mass.
//!
//! # Errors
//!
//! A [`SystemFileError`] names the file, line, column and key, and what is wrong:
//!
//! ```
//! use model::system_file::parse_problem;
//! let text = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n\n[[bars]]\nmass = 1\n";
//! let error = parse_problem(text, "chain.toml").unwrap_err();
//! assert_eq!(error.to_string(), "chain.toml:6:1: bars[1].mass: unknown key `mass`");
//! assert_eq!(
//!     error.help().unwrap(),
//!     "did you mean `mass_kg`? allowed here: length_m, mass_kg, centre_m, inertia_kg_m2, count"
//! );
//! ```

pub mod columns;
mod document;
mod duplicate;
mod error;
mod kind;
mod limits;
mod load;
mod location;
mod read;
mod source;
mod suggest;
mod table;
mod write;

pub use error::SystemFileError;
pub use kind::SystemFileErrorKind;
pub use limits::{MAX_BARS, MAX_BARS_FILE_BYTES, MAX_FILE_BYTES};
pub use location::Position;
pub use read::{parse_problem, parse_system, read_problem, read_problem_with, read_system};
pub use source::BarsReader;
pub use suggest::nearest;
pub use write::write_system;
