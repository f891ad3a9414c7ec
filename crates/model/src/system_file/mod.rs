//! System files: a chain, or any system of bars, as TOML or JSON, read with the place of every
//! error.
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
//! use model::system_file::{Described, parse};
//! let Described::Chain(problem) = parse(text, "chain.toml")? else { panic!("a chain") };
//! let chain = problem.chain();
//! assert_eq!(chain.name(), "three equal bars");
//! assert_eq!(chain.bars().len(), 3);
//! assert_eq!(chain.anchors().span_m(), 2.0);
//! # Ok::<(), model::system_file::SystemFileError>(())
//! ```
//!
//! With `[joints]` in the place of `[anchors]`, `[[bars]]` connect joints by name:
//!
//! ```
//! let text = r#"
//! [joints]
//! A = { at_m = [0, 0, 0] }
//! P = { mass_kg = 5 }
//!
//! [[bars]]
//! from = "A"
//! to = "P"
//! length_m = 0.5
//! mass_kg = 1.0
//! count = 3                         # joints A-P.1 and A-P.2 between them
//! "#;
//! use model::system_file::{Described, parse};
//! let Described::System(system) = parse(text, "bridle.toml")? else { panic!("no chain") };
//! assert_eq!(system.joints()[2].name, "A-P.1");
//! # Ok::<(), model::system_file::SystemFileError>(())
//! ```
//!
//! Every key with what is allowed, of chains and of systems, is on the page [`FORMAT`].
//!
//! # Files of bars
//!
//! `bars_file = "bars.csv"` takes the bars from a file of columns. A million rows are read in
//! seconds. Only the functions that read files follow it: parsing a text opens no file. A program may
//! bring a reader of its own for other kinds of files ([`read_with`]).
//!
//! # Refusals
//!
//! What is no equilibrium problem is refused with the numbers of its [`Refusal`](crate::system::Refusal): at
//! `anchors.end_m` if the bars do not reach, at the bar that is too long, at `bars` if none has mass.
//!
//! # Errors
//!
//! A [`SystemFileError`] names the file, line, column and key, and what is wrong:
//!
//! ```
//! use model::system_file::parse;
//! let text = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n\n[[bars]]\nmass = 1\n";
//! let error = parse(text, "chain.toml").unwrap_err();
//! assert_eq!(error.to_string(), "chain.toml:6:1: bars[1].mass: unknown key `mass`");
//! let help = error.help().unwrap();
//! assert!(help.starts_with("did you mean `mass_kg`? allowed here: length_m, mass_kg, mass_kg_per_m, "));
//! ```

/// Words as texts.
macro_rules! names {
    ($($name:ident)*) => { &[$(stringify!($name)),*] };
}

mod csv;
mod described;
mod document;
mod drawing;
mod duplicate;
mod error;
mod json;
mod kind;
mod limits;
mod load;
mod loads;
mod location;
mod material;
mod named;
mod network;
mod network_rows;
mod read;
mod row_table;
mod rows;
mod sheet;
mod source;
mod strength;
mod suggest;
mod table;
mod tolerance;
mod write;
mod write_network;

pub use described::{Described, write};
pub use error::SystemFileError;
pub use kind::{NOT_MODELLED, SCOPE, SystemFileErrorKind};
pub use limits::{
    BYTES_PER_BAR, BYTES_PER_BAR_OF_FILE, BYTES_PER_FILE_BYTE, MAX_BARS, MAX_BARS_FILE_BYTES,
    MAX_FILE_BYTES, limit_memory, most_bars, most_bars_of_file, most_file_bytes,
};
pub use location::Position;
pub use read::{parse, read, read_with};
pub use rows::{Cell, Rows, RowsReader};
pub use suggest::nearest;
pub use write::write_system;
pub use write_network::write_network;

/// The page of the file format: every key with its unit, what is allowed, and an example; what is
/// refused, and why.
///
/// It stands in the package as `FORMAT.md`, and a test holds it against the parser.
pub const FORMAT: &str = include_str!("../../FORMAT.md");
