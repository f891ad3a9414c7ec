//! Systems of other programs.
//!
//! | [`Source`] | what is read |
//! |---|---|
//! | [`Dxf`](Source::Dxf) | lines and polylines of a drawing, by their layers |
//! | [`Obj`](Source::Obj) | lines between vertices, by their groups |
//! | [`MoorDyn`](Source::MoorDyn) | MoorDyn input files, the statics of them |
//! | [`Map`](Source::Map) | MAP++ input files |
//! | [`OpenSees`](Source::OpenSees) | trusses of OpenSees, in Tcl |
//! | [`Compas`](Source::Compas) | COMPAS JSON of a network, graph or mesh with force densities `q` |
//! | [`parse_net`] | CSV of nodes and of edges with force densities |
//!
//! A net of force densities is no system of lengths: see [`ForceDensityNet::system_at`] for the one
//! that is judged.

mod compas;
mod drawing;
mod dxf;
mod force_density;
mod moordyn;
mod nodes;
mod obj;
mod opensees;

use model::Vector;
use model::system::System;
use numerics::vector::{norm, plus};

pub use compas::parse_compas;
pub use dxf::parse_dxf;
pub use force_density::{Edge, ForceDensityNet, Node};
pub use moordyn::{parse_map, parse_moordyn};
pub use nodes::parse_net;
pub use obj::parse_obj;
pub use opensees::parse_opensees;

use crate::error::{At, Result};

/// Whose file a system is read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// Drawing interchange file in ASCII.
    Dxf,
    /// Wavefront OBJ.
    Obj,
    /// MoorDyn, versions 1 and 2.
    MoorDyn,
    /// MAP++.
    Map,
    /// OpenSees.
    OpenSees,
    /// COMPAS.
    Compas,
}

impl Source {
    /// Whose file this is, by the ending of its name, and by its text where the ending is shared; `None` for what no
    /// reader here knows.
    ///
    /// ```
    /// use formats::system::Source;
    /// assert_eq!(Source::guess("DXF", ""), Some(Source::Dxf));
    /// assert_eq!(Source::guess("txt", "---- LINE TYPES ----"), Some(Source::MoorDyn));
    /// assert_eq!(Source::guess("txt", "--- NODE PROPERTIES ---"), Some(Source::Map));
    /// assert_eq!(Source::guess("txt", "[joints]"), None);
    /// ```
    pub fn guess(ending: &str, text: &str) -> Option<Self> {
        let compas = || text.contains("\"dtype\"") || text.contains("\"datatype\"");
        // Sections stand under lines of dashes, as in no system file.
        let sections = || text.lines().any(|line| line.starts_with("---"));
        // Tables as in version 1 of MoorDyn, whose lines have segments.
        let map = || {
            let upper = text.to_uppercase();
            upper.contains("NODE PROPERTIES") && !upper.contains("NUMSEGS")
        };
        Some(match ending.to_ascii_lowercase().as_str() {
            "dxf" => Self::Dxf,
            "obj" => Self::Obj,
            "map" => Self::Map,
            "tcl" => Self::OpenSees,
            "dat" | "txt" if sections() && map() => Self::Map,
            "dat" | "txt" if sections() => Self::MoorDyn,
            "json" if compas() => Self::Compas,
            _ => return None,
        })
    }

    /// Whether files with this ending may be of another program.
    pub fn may_end(ending: &str) -> bool {
        let endings = ["dxf", "obj", "map", "tcl", "dat", "txt", "json"];
        endings.iter().any(|known| ending.eq_ignore_ascii_case(known))
    }

    /// The text of a file with this ending. A DXF drawing that is no UTF-8 is read in the code page 1252; where it names
    /// another one (`$DWGCODEPAGE`), letters that are no ASCII are replaced.
    ///
    /// # Errors
    /// Where other files are no UTF-8.
    pub fn text(ending: &str, bytes: Vec<u8>) -> Result<String, std::str::Utf8Error> {
        match String::from_utf8(bytes) {
            Ok(text) => Ok(text),
            Err(error) if ending.eq_ignore_ascii_case("dxf") => Ok(dxf::decoded(error.as_bytes())),
            Err(error) => Err(error.utf8_error()),
        }
    }

    /// The system of a file. A net of force densities is the system that has them at its places, and its equilibrium
    /// next to these is wanted.
    ///
    /// # Errors
    /// [`FormatError`](crate::FormatError) with the part that is wrong, missing or not understood, and its line where there is one.
    pub fn parse(self, text: &str, file: &str) -> Result<ForeignSystem> {
        let mut read = match self {
            Self::Dxf => parse_dxf(text, file)?,
            Self::Obj => parse_obj(text, file)?,
            Self::MoorDyn => parse_moordyn(text, file)?,
            Self::Map => parse_map(text, file)?,
            Self::OpenSees => parse_opensees(text, file)?,
            Self::Compas => {
                let net = parse_compas(text, file)?;
                let places_m = net.places_m();
                let drawn = net.system_at(&places_m, file)?.drawn_at(&places_m);
                let system = drawn.map_err(|error| At::file(file).no_system(error))?;
                let note = "each edge is an elastic member that carries its force density times its length at the places \
                            of the file";
                let pushes = net.edges.iter().any(|edge| edge.density_n_m < 0.0).then(|| {
                    "some edges push: whether they stand depends on stiffnesses that the file does not have, and here each \
                     is as soft as its force; `judge` asks whether the places are in balance"
                        .to_owned()
                });
                let notes = [Some(note.to_owned()), pushes, net.held_loads()];
                let notes = notes.into_iter().flatten().collect();
                ForeignSystem { system, notes, floor_m: None }
            }
        };
        let (system, unused) = read.system.without_unused();
        if !unused.is_empty() {
            read.system = system;
            let names = unused.join(", ");
            read.notes.push(format!("supports that no member meets are left out: {names}"));
        }
        Ok(read)
    }
}

/// A system of another program, and what the reader has to say about it.
#[derive(Debug, Clone, PartialEq)]
pub struct ForeignSystem {
    /// The system.
    pub system: System,
    /// How its parts were read: sentences.
    pub notes: Vec<String>,
    /// Height of a floor that is not part of the system, m: joints must stay above it.
    pub floor_m: Option<f64>,
}

impl ForeignSystem {
    /// The system above its floor, where that is an equilibrium problem.
    ///
    /// # Errors
    /// [`FormatError`](crate::FormatError) with the reason where it is none.
    pub fn above_floor(self, file: &str) -> Result<System> {
        let at = At::file(file);
        let above = self.system.with_floor(self.floor_m);
        let system = above.map_err(|error| at.no_system(error))?;
        system.refusal().map_err(|refusal| at.no_system(refusal))?;
        Ok(system)
    }
}

/// Whether a word is one of these.
fn among(words: &str, word: &str) -> bool {
    words.split(' ').any(|known| known == word)
}

/// What there is to say of loads on nodes that cannot move.
fn held_loads(loads_n: impl Iterator<Item = Vector>) -> Option<String> {
    let (mut count, mut sum_n) = (0, [0.0; 3]);
    for load_n in loads_n.filter(|load_n| norm(*load_n) > 0.0) {
        count += 1;
        sum_n = plus(sum_n, load_n);
    }
    // To millionths, without the rounding of the sum.
    let [x, y, z] = sum_n.map(|n| (1e6 * n).round() / 1e6);
    let says = || {
        format!(
            "loads on held nodes ({count}), in sum ({x}, {y}, {z}) N, go to the ground and are not in the reactions"
        )
    };
    (count > 0).then(says)
}
