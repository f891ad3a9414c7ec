//! What can be wrong with a system file.

use std::path::PathBuf;

use crate::BarError;
use crate::budget::OutOfMemory;
use crate::readable::Readable;
use crate::system::{PrestressError, Refusal, RopeFault, SystemError};

/// What the program knows, and what it does not.
pub const SCOPE: &str = "known are joints without friction, bars, cables and struts, rigid or with a stiffness \
     stiffness_n (EA), their weight, masses at joints, constant forces and a flat floor without \
     friction (floor_m); not known are friction, other contact, bending and damping";

/// Keys that ask for what is not modelled.
pub const NOT_MODELLED: &[&str] = &["friction", "damping", "contact", "bending"];

/// What is wrong.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SystemFileErrorKind {
    /// Occurs when the file cannot be read: it is not there, is a folder, or access is denied.
    #[error("cannot read the file: {0}")]
    Unreadable(std::io::Error),
    /// Occurs when the file named by `bars_file` cannot be read.
    #[error("cannot read the bars from {}: {error}", path.display())]
    UnreadableBars {
        /// Where it was looked for.
        path: PathBuf,
        /// Why it cannot be read.
        error: std::io::Error,
    },
    /// Occurs when a file that the system file names has none of the columns that it may have.
    #[error("the first line of {} names no column", path.display())]
    NoColumns {
        /// The file.
        path: PathBuf,
        /// The columns that it may have.
        allowed: &'static [&'static str],
    },
    /// Occurs when the reader of another kind of file fails.
    #[error("{0}")]
    ForeignBars(Box<dyn std::error::Error + Send + Sync>),
    /// Occurs when this key, `bars_file` or `joints_file`, stands in a text that was not read from a file.
    #[error("`{0}` is relative to the system file, and this text was not read from a file")]
    NoFolder(&'static str),
    /// Occurs when the file is longer than any such file needs to be: the limit, in bytes.
    #[error("the file is longer than the limit of {0} bytes")]
    TooLong(u64),
    /// Occurs when the file holds nothing but white space and comments.
    #[error("the file describes no system: it is empty")]
    Empty,
    /// Occurs when the file is not UTF-8: the offset of the first byte that is not, in the file.
    #[error("the file is not UTF-8 text (first bad byte at offset {0})")]
    NotText(usize),
    /// Occurs when the text is not TOML.
    #[error("not valid TOML: {0}")]
    Syntax(String),
    /// Occurs when the text begins like JSON, or its file is named so, and it is no object of JSON or holds what no system can.
    #[error("not valid JSON: {0}")]
    Json(String),
    /// Occurs when a key is given twice.
    #[error("duplicate key `{key}`{}", first_line.map_or_else(String::new, |line| format!(", first given in line {line}")))]
    DuplicateKey {
        /// The key.
        key: String,
        /// The line of its first appearance, where that is certain.
        first_line: Option<usize>,
    },
    /// Occurs when a bars file has two columns of this name.
    #[error("duplicate column `{0}`")]
    DuplicateColumn(&'static str),
    /// Occurs when a key or a column is not one of those allowed in its place.
    #[error("unknown key `{key}`")]
    UnknownKey {
        /// The key.
        key: String,
        /// The keys allowed here.
        allowed: &'static [&'static str],
        /// The allowed key that looks most like it.
        suggestion: Option<&'static str>,
    },
    /// Occurs when this key asks for what is not modelled.
    #[error("`{0}` is outside what is modelled here")]
    OutOfScope(String),
    /// Occurs when a bar begins or ends at a joint that is not there.
    #[error("there is no joint {joint:?}")]
    UnknownJoint {
        /// The name.
        joint: String,
        /// The joint whose name looks most like it.
        suggestion: Option<String>,
    },
    /// Occurs when a member is of an unknown kind.
    #[error("there is no member of the kind {found:?}")]
    UnknownKind {
        /// The word.
        found: String,
        /// The words allowed.
        allowed: &'static [&'static str],
        /// The one most like it.
        suggestion: Option<&'static str>,
    },
    /// Occurs when a joint lies outside the plane that all are to keep to.
    #[error(
        "joint {joint:?} lies at {axis} = {} m, and the plane {plane:?} of the others at {axis} = {} m",
        Readable(*at_m), Readable(*plane_m)
    )]
    OffPlane {
        /// Name of the joint.
        joint: String,
        /// The plane.
        plane: &'static str,
        /// The coordinate that all have in common.
        axis: char,
        /// That of the joint.
        at_m: f64,
        /// That of the plane.
        plane_m: f64,
    },
    /// Occurs when a joint slides out of the plane that all are to keep to.
    #[error("joint {joint:?} slides out of the plane {plane:?}")]
    LeavesPlane {
        /// Name of the joint.
        joint: String,
        /// The plane.
        plane: &'static str,
    },
    /// Occurs when a member takes its length from the drawing, and its joints are drawn at one
    /// place.
    #[error(
        "joints {from:?} and {to:?} are drawn at one place: a member between them has no length"
    )]
    NoDrawnLength {
        /// Name of a joint.
        from: String,
        /// Name of the other.
        to: String,
    },
    /// Occurs when a load acts on this joint, by name or number, an anchor, where it moves nothing.
    #[error("joint {0:?} is an anchor: a load there goes straight into the ground")]
    LoadedAnchor(String),
    /// Occurs when a load has neither mass nor force.
    #[error("a load needs mass_kg or force_n")]
    NoLoadGiven,
    /// Occurs when a mass at a joint, in kg, is negative, infinite or not a number.
    #[error("a mass must be zero or positive, and finite, got {} kg", Readable(*.0))]
    Mass(f64),
    /// Occurs when a force is infinite or not a number: its first bad component, N.
    #[error("a force must be finite, got {0} N")]
    Force(f64),
    /// Occurs when a direction is zero or not finite.
    #[error("a direction must be finite and not zero")]
    NoDirection,
    /// Occurs when a required key or column is missing.
    #[error("the key `{key}` is missing")]
    MissingKey {
        /// The key.
        key: &'static str,
        /// What it must hold.
        wanted: &'static str,
    },
    /// Occurs when two keys say the same thing in two ways.
    #[error("`{key}` and `{other}` cannot stand together")]
    Conflict {
        /// The key found.
        key: &'static str,
        /// The key it contradicts.
        other: &'static str,
    },
    /// Occurs when a value has the wrong type.
    #[error("expected {wanted}, found {found}")]
    WrongType {
        /// What is allowed.
        wanted: &'static str,
        /// What stands there.
        found: &'static str,
    },
    /// Occurs when a vector has so many components, and not three.
    #[error("expected three numbers, found {0}")]
    WrongCount(usize),
    /// Occurs when an integer does not fit where it stands.
    #[error("the value {found} is out of range")]
    OutOfRange {
        /// As written.
        found: String,
        /// What is allowed.
        wanted: &'static str,
    },
    /// Occurs when there are more bars than fit: the limit.
    #[error("the system has more than {0} bars")]
    TooManyBars(usize),
    /// Occurs when a system by name, with its names, needs more memory than there is.
    #[error("{0}")]
    Memory(OutOfMemory),
    /// Occurs when a file of columns has a header and no rows.
    #[error("there are columns but no rows")]
    NoRows,
    /// Occurs when this stands between the columns of a bars file, and not a comma.
    #[error("columns are separated by commas, found {0:?}")]
    Separator(char),
    /// Occurs when a row has more or fewer cells than the header.
    #[error("expected {wanted} cells, found {found}")]
    WrongCells {
        /// Cells of the header.
        wanted: usize,
        /// Cells of the row.
        found: usize,
    },
    /// Occurs when a quoted cell does not end, or is followed by more than a comma.
    #[error("a quote is not closed")]
    OpenQuote,
    /// Occurs when a cell is empty that must not be.
    #[error("the cell is empty")]
    EmptyCell,
    /// Occurs when a joint is named by a number, this one, that is not whole.
    #[error("a joint is named by text or a whole number, found {0}")]
    NoName(f64),
    /// Occurs when a row of a file is wrong whose text cannot be shown.
    #[error(
        "{}: {}{kind}",
        path.display(),
        place_in_file(*row, column.as_deref())
    )]
    Row {
        /// The file.
        path: PathBuf,
        /// The row, from 1; 0 for the names of the columns.
        row: usize,
        /// The column, where one of them is wrong.
        column: Option<String>,
        /// What is wrong.
        kind: Box<SystemFileErrorKind>,
    },
    /// Occurs when a cell is no number: what stands there.
    #[error("expected a number, found {0:?}")]
    NotANumber(String),
    /// Occurs when a bar cannot be built.
    #[error(transparent)]
    Bar(BarError),
    /// Occurs when a member has no unstretched length that goes with its prestress.
    #[error(transparent)]
    Prestress(PrestressError),
    /// Occurs when the system cannot be built.
    #[error(transparent)]
    System(SystemError),
    /// Occurs when the system is no equilibrium problem.
    #[error(transparent)]
    Refused(Refusal),
}

impl SystemFileErrorKind {
    /// What is allowed here, or what to do about it.
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::UnknownKey { allowed, suggestion, .. }
            | Self::UnknownKind { allowed, suggestion, .. } => {
                let list = format!("allowed here: {}", allowed.join(", "));
                return Some(match suggestion {
                    Some("bars") => format!("did you mean `bars` (with a `kind`)? {list}"),
                    Some(near) => format!("did you mean `{near}`? {list}"),
                    None => list,
                });
            }
            Self::UnknownJoint { suggestion, .. } => {
                return suggestion.as_ref().map(|near| format!("did you mean {near:?}?"));
            }
            Self::NoColumns { allowed, .. } => {
                return Some(format!("columns may be: {}", allowed.join(", ")));
            }
            Self::MissingKey { key, wanted } => return Some(format!("{key} must be {wanted}")),
            Self::OutOfRange { wanted, .. } => return Some(format!("allowed: {wanted}")),
            Self::Conflict { key, other } => {
                return Some(format!("keep `{key}` or `{other}`, and remove the other"));
            }
            Self::Unreadable(error) | Self::UnreadableBars { error, .. } => match error.kind() {
                std::io::ErrorKind::IsADirectory => "this is a folder; name a file in it",
                _ => return None,
            },
            Self::OutOfScope(_) => SCOPE,
            Self::LoadedAnchor(_) => "remove the load, or put it on a joint that can move",
            Self::OffPlane { .. } | Self::LeavesPlane { .. } => {
                "with `plane` all joints lie in one plane and stay in it; without, every joint says \
                 itself how it slides"
            }
            Self::NoDrawnLength { .. } => "give the member a length_m, or draw one joint elsewhere",
            Self::NoLoadGiven => {
                "mass_kg hangs a mass there, force_n = [x, y, z] pulls with a constant force"
            }
            Self::System(error) => return system_help(error).map(str::to_owned),
            Self::Refused(refusal) => refusal_help(refusal),
            Self::NoFolder(_) => "write the bars as [[bars]], or read the system from its file",
            Self::TooLong(_) => {
                "equal bars in a row are written once, with `count`; many different ones as columns, \
                 with `bars_file`"
            }
            Self::Empty => {
                "a system needs [anchors] with start_m and end_m, or [joints] by name, and one or more [[bars]]"
            }
            Self::NotText(_) => "save the file as UTF-8",
            Self::Syntax(_) => {
                "a line is `key = value`, `[anchors]`, `[[bars]]` or `# a comment`; text stands in \
                 double quotes, numbers take a decimal point and no unit"
            }
            Self::DuplicateKey { .. } => "a key is given once; every bar starts with [[bars]]",
            Self::DuplicateColumn(_) => "a column is given once; keep one of them",
            Self::NoRows => {
                "every line after the header is a row: a bar of a file of bars, a joint of one of joints"
            }
            Self::WrongType { found: "a string", wanted } if wanted.contains("number") => {
                "numbers are written without quotes"
            }
            Self::WrongCount(_) => "a vector is written [x, y, z]",
            Self::Memory(_) => "fewer members, or shorter names of joints, need less memory",
            Self::TooManyBars(_) => {
                "an answer over more bars than this does not fit into 24 GB of memory"
            }
            Self::Separator(_) | Self::NotANumber(_) => {
                "a row is numbers with a decimal point, separated by commas, such as 0.25,1e-3"
            }
            Self::OpenQuote => {
                "a name with a comma stands in double quotes, a quote in it is doubled"
            }
            Self::Row { kind, .. } => return kind.help(),
            Self::WrongCells { .. } => {
                "a row has one cell for each column of the header; numbers take a decimal point, not a \
                 comma"
            }
            Self::Bar(BarError::Inertia(_)) => {
                "without inertia_kg_m2 a bar has the moments [0, m l^2/12, m l^2/12] of a slender one"
            }
            Self::Prestress(error) => return prestress_help(*error).map(str::to_owned),
            Self::Json(_) => {
                "an object with the keys of the TOML file: {\"joints\": {...}, \"bars\": [...]}; names \
                 and keys in double quotes, no comments, no comma behind the last"
            }
            _ => return None,
        };
        Some(help.to_owned())
    }
}

fn place_in_file(row: usize, column: Option<&str>) -> String {
    let row = if row > 0 { format!("row {row}") } else { "the head".to_owned() };
    column.map_or_else(|| format!("{row}: "), |column| format!("{row}, column `{column}`: "))
}

fn prestress_help(error: PrestressError) -> Option<&'static str> {
    Some(match error {
        PrestressError::Inextensible => {
            "give the member a stiffness_n (EA); the forces of inextensible members follow from the \
             equilibrium"
        }
        PrestressError::Sign { .. } => "tension is positive; a bar takes both",
        _ => return None,
    })
}

fn system_help(error: &SystemError) -> Option<&'static str> {
    Some(match error {
        SystemError::Parallel { .. } => "replace them by one bar, or put a joint into one of them",
        SystemError::Overflow(_) | SystemError::Underflow { .. } => {
            "check the units: lengths are in metres, masses in kilograms, forces in newtons"
        }
        SystemError::MassRange { .. } => {
            "check the units: masses are in kilograms; a mass that does not count may be 0"
        }
        SystemError::NotDrawn { .. } => {
            "give it a place: near_m = [x, y, z]; without any near_m the lowest equilibrium is found"
        }
        SystemError::DrawnTogether { .. } => "give one of them another place near_m",
        SystemError::Rope { fault, .. } => return rope_help(fault),
        SystemError::NoMembers => "describe every bar under a line [[bars]]",
        _ => return None,
    })
}

fn rope_help(fault: &RopeFault) -> Option<&'static str> {
    Some(match fault {
        RopeFault::Kind => "a rope has kind = \"cable\"",
        RopeFault::Mass => {
            "leave its mass out, or hang it as mass_kg at the joints, or give each span a bar of its own"
        }
        RopeFault::Load => "let the force act at a joint",
        RopeFault::Prestress => "give its unstretched length_m and stiffness_n alone",
        RopeFault::Body(_) | RopeFault::Repeated(_) => return None,
    })
}

fn refusal_help(refusal: &Refusal) -> &'static str {
    match refusal {
        Refusal::Unconnected { .. } => "remove the joint, or connect it by a bar",
        Refusal::Falls { .. } => {
            "give one of its joints a place: at_m = [x, y, z]; or, where it stands on a floor, all of them one in a \
             drawing: near_m = [x, y, z]"
        }
        Refusal::NothingMoves => "leave one joint without at_m, or use at least two bars",
        Refusal::NoLoad => {
            "give a bar or a joint a mass, a joint a force, or members a stiffness and a prestress"
        }
        Refusal::LoadOnAnchors => "give a load to a joint that can move along it",
        Refusal::LoadsCancel => "give a load that is not balanced where it acts",
        Refusal::Unresolved { .. } => "put the origin near the system",
        Refusal::OutOfReach { .. } | Refusal::Taut { .. } => {
            "move the anchors together or lengthen the bars"
        }
        Refusal::ShortRope { .. } => "lengthen the rope, or move the anchors together",
        Refusal::TooLong { .. } => {
            "shorten this bar, lengthen another of the loop, or move anchors of it apart"
        }
        Refusal::Folded { .. } => {
            "shorten this bar, lengthen another of the loop, or move anchors of it apart; a beam with a joint between its \
             ends is a triangle with some depth"
        }
    }
}
