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
//! Any other key is an error, and so is a key given twice. A number is the double nearest to it; it
//! may be written as an integer. `nan` and `inf`, which TOML knows, are refused where they stand,
//! and so is what a double cannot hold (`1e999`).
//!
//! The file is UTF-8, with or without a byte order mark, with line ends `\n` or `\r\n`, and at most
//! [`MAX_FILE_BYTES`] long.
//!
//! # Loads on a chain
//!
//! `[[loads]]` puts masses and constant forces at the joints between the bars of a chain: `joint`
//! is the number of a joint, from 1 to the number of bars less 1, and `mass_kg`, `force_n` or both
//! are what acts there. Several loads at one joint add up.
//!
//! # Systems of bars by name
//!
//! With `[joints]` in the place of `[anchors]`, `[[bars]]` connect joints by name:
//!
//! ```
//! let text = r#"
//! [joints]
//! A = { at_m = [0, 0, 0] }                  # an anchor
//! B = { at_m = [2, 0, 0.5], free = "x" }    # slides along x without friction
//! P = { mass_kg = 5, force_n = [0, 12, 0] } # free, with a mass and a constant force
//!
//! [[bars]]
//! from = "A"
//! to = "P"
//! length_m = 0.5
//! mass_kg = 1.0
//! count = 3                                 # three in a row, joints A-P.1 and A-P.2 between them
//!
//! [[bars]]
//! from = "P"
//! to = "B"
//! length_m = 1.0
//! mass_kg = 1.0
//! forces = [{ force_n = [0, 1, 0], at_m = 0.25 }]   # a side wind; at_m optional: the middle
//! "#;
//! use model::system_file::{Described, parse};
//! let Described::System(system) = parse(text, "bridle.toml")? else { panic!("no chain") };
//! assert_eq!(system.joints()[3].name, "A-P.1");
//! # Ok::<(), model::system_file::SystemFileError>(())
//! ```
//!
//! | key | | unit | what is allowed | if it is left out |
//! |---|---|---|---|---|
//! | `at_m` of a joint | `[x, y, z]` | m | finite: where the joint is held | the joint is free |
//! | `free` of a joint | text | | `"x"`, `"y"`, `"z"`: it slides on that line through `at_m`; `"xy"`, `"xz"`, `"yz"`: in that plane | held in all directions |
//! | `along` of a joint | `[x, y, z]` | | direction of the line through `at_m` on which it slides | |
//! | `normal` of a joint | `[x, y, z]` | | normal of the plane through `at_m` in which it slides | |
//! | `mass_kg` of a joint | number | kg | zero or positive, finite; not at an anchor | 0 |
//! | `force_n` of a joint | `[x, y, z]` | N | finite; not at an anchor | none |
//! | `from`, `to` of a bar | text | | names of two different joints | an error |
//! | `kind` of a bar | text | | `"bar"`, `"cable"` (pulls or is slack), `"strut"` (pushes or is loose) | `"bar"` |
//! | `stiffness_n` of a bar | number | N | its axial stiffness EA, positive; `length_m` is then the unstretched length | inextensible |
//! | `forces` of a bar | tables | | `force_n` in N, and `at_m` from 0 to `length_m` | none; at the middle |
//!
//! The other keys of a bar are those of a chain. Two bars between the same two joints, joints that
//! no bar meets, parts that nothing holds, and lengths that cannot close a loop are refused with
//! their numbers.
//!
//! # JSON
//!
//! A text that begins with a brace is JSON: one object with the keys of the TOML file. Errors have
//! their places in it all the same.
//!
//! # A million different bars
//!
//! `bars_file = "bars.csv"` takes the bars from a file of [`columns`]; its path is relative to the
//! folder of the system file. A million rows are read in a fraction of a second, as `[[bars]]` in
//! seconds. Only [`read_system`] and [`read_problem`] follow it: parsing a text opens no file. A
//! program may bring readers of its own for other kinds of files ([`read_with`]).
//!
//! For systems of bars by name `bars_file` takes the bars, and `joints_file` joints, besides those
//! in `[joints]` or instead of them. A row is a bar or a joint; a cell may be empty where the key
//! may be left out.
//!
//! | columns of bars | what they hold |
//! |---|---|
//! | `from`, `to` | names of joints, or whole numbers, which are names too |
//! | `length_m`, `mass_kg`, `centre_m`, `kind`, `stiffness_n` | as the keys of a bar |
//! | `force_x_n`, `force_y_n`, `force_z_n`, `force_at_m` | a force on the bar; in the middle without `force_at_m` |
//!
//! | columns of joints | what they hold |
//! |---|---|
//! | `name` | its name; without this column the joints are called 0, 1, 2, ... |
//! | `x_m`, `y_m`, `z_m` | where the joint is held; it is free where they are empty |
//! | `fixed` | 1 or true: it is held there; 0 or false: it is free, and the place is not used |
//! | `free` | as the key of a joint: how a joint slides through its place |
//! | `mass_kg`, `force_x_n`, `force_y_n`, `force_z_n` | what acts on it; nothing at an anchor |
//!
//! The columns stand in any order, their names in the first line. A name with a comma stands in
//! double quotes.
//!
//! # Refusals
//!
//! [`read_system`] takes every chain that can be described; [`read_problem`] refuses what is no
//! equilibrium problem, with the numbers of its [`Refusal`](crate::Refusal): at `anchors.end_m` if
//! the bars do not reach, at the bar that is too long, at `bars` if none has mass.
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
mod csv;
mod described;
mod document;
mod duplicate;
mod error;
mod json;
mod kind;
mod limits;
mod load;
mod loads;
mod location;
mod network;
mod network_rows;
mod read;
mod row_table;
mod rows;
mod sheet;
mod source;
mod suggest;
mod table;
mod write;
mod write_network;

pub use described::Described;
pub use error::SystemFileError;
pub use kind::{SCOPE, SystemFileErrorKind};
pub use limits::{MAX_BARS, MAX_BARS_FILE_BYTES, MAX_FILE_BYTES};
pub use location::Position;
pub use read::{
    parse, parse_problem, parse_system, read, read_problem, read_problem_with, read_system,
    read_with,
};
pub use rows::{Cell, Rows, RowsReader};
pub use source::{BarsReader, Readers};
pub use suggest::nearest;
pub use write::write_system;
pub use write_network::write_network;
