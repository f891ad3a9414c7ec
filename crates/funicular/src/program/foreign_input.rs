//! Systems and answers of other programs: which reader, and the text.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use formats::answer::{Answer, Forces, Joints, MemberForces};
use formats::system::{ForceDensityNet, ForeignSystem, parse_compas, parse_moordyn, parse_net};
use funicular::Error;
use miette::miette;
use model::system::System;
use model::system_file::MAX_FILE_BYTES;

use crate::exit::Failure;
use crate::input;
use crate::judge::{Format, Judge};

/// A system, or a net of force densities that becomes one at the places that are judged.
pub enum Given {
    /// A system.
    System {
        /// The system.
        system: System,
        /// How it was read.
        notes: Vec<String>,
        /// Height of a floor that is not part of it, m.
        floor_m: Option<f64>,
    },
    /// A net, and its file.
    Net(ForceDensityNet, String),
}

impl Given {
    /// How the file was read.
    pub fn notes(&self) -> Vec<String> {
        match self {
            Self::System { notes, .. } => notes.clone(),
            Self::Net(..) => vec![
                "each edge is an elastic member that carries its force density times its length at the places judged"
                    .to_owned(),
            ],
        }
    }

    /// Height of a floor that is not part of the system, m.
    pub fn floor_m(&self) -> Option<f64> {
        match self {
            Self::System { floor_m, .. } => *floor_m,
            Self::Net(..) => None,
        }
    }

    /// The answer that the file of the system has itself.
    pub fn own_answer(&self) -> Option<Answer> {
        let Self::Net(net, file) = self else { return None };
        Some(Answer {
            source: file.clone(),
            joints: Joints::InOrder(net.places_m()),
            forces: Forces::None,
            reactions_n: None,
        })
    }
}

/// The system that the arguments name, and the files that were read for it.
pub fn system(arguments: &Judge) -> Result<(Given, Vec<PathBuf>), Failure> {
    let Some(path) = arguments.file.as_deref() else {
        let input::Input { problem, files } = input::problem(None, arguments.case.as_deref())?;
        return Ok((own(&problem), files));
    };
    let format = match arguments.format {
        Format::Auto => guess(path, arguments.edges.is_some())?,
        format => format,
    };
    if format != Format::ForceDensity && arguments.edges.is_some() {
        return Err(Failure::bad_input(miette!("--edges is for nets of force densities")));
    }
    let given = match format {
        Format::Moordyn => {
            let (text, name) = text(path)?;
            let ForeignSystem { system, notes, floor_m } =
                parse_moordyn(&text, &name).map_err(Error::from)?;
            Given::System { system, notes, floor_m }
        }
        Format::Compas => {
            let (text, name) = text(path)?;
            Given::Net(parse_compas(&text, &name).map_err(Error::from)?, name)
        }
        Format::ForceDensity => {
            let Some(edges) = arguments.edges.as_deref() else {
                return Err(Failure::bad_input(miette!(
                    "a net of force densities needs its edges too: --edges FILE"
                )));
            };
            let (nodes, edges) = (text(path)?, text(edges)?);
            let net = parse_net((&nodes.0, &nodes.1), (&edges.0, &edges.1), &nodes.1);
            Given::Net(net.map_err(Error::from)?, nodes.1)
        }
        Format::Auto | Format::Funicular => {
            let input::Input { problem, files } = input::problem(Some(path), None)?;
            return Ok((own(&problem), files));
        }
    };
    let files = [Some(path.to_owned()), arguments.edges.clone()];
    Ok((given, files.into_iter().flatten().collect()))
}

/// A system of our own file.
fn own(problem: &funicular::Problem) -> Given {
    let system = match (problem.as_system(), problem.as_chain()) {
        (Some(system), _) => system.clone(),
        (None, Some(chain)) => System::from(chain.chain()),
        (None, None) => unreachable!("a problem is a chain or a system"),
    };
    Given::System { system, notes: vec![], floor_m: None }
}

/// Which format a file is in.
fn guess(path: &Path, with_edges: bool) -> Result<Format, Failure> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    Ok(match ending.to_ascii_lowercase().as_str() {
        "dat" | "txt" => Format::Moordyn,
        "csv" => Format::ForceDensity,
        _ if with_edges => Format::ForceDensity,
        "json" => {
            let (text, _) = text(path)?;
            let compas = text.contains("\"dtype\"") || text.contains("\"datatype\"");
            if compas { Format::Compas } else { Format::Funicular }
        }
        _ => Format::Funicular,
    })
}

/// The text of a file (`-` is standard input), and the name that stands for it in errors.
pub fn text(path: &Path) -> Result<(String, String), Failure> {
    let standard = path == Path::new("-");
    let name = if standard { "standard input".to_owned() } else { path.display().to_string() };
    let unreadable = |why: &dyn std::fmt::Display| {
        Failure::bad_input(miette!("{} cannot be read: {why}", crate::printable::Printable(&name)))
    };
    let mut bytes = Vec::new();
    // One byte more than is allowed shows that it is too long.
    let limit = MAX_FILE_BYTES.saturating_add(1);
    let read = if standard {
        std::io::stdin().lock().take(limit).read_to_end(&mut bytes)
    } else if path.is_dir() {
        return Err(unreadable(&"it is a folder"));
    } else {
        File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes))
    };
    read.map_err(|error| unreadable(&error))?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(unreadable(&format_args!("it is longer than {MAX_FILE_BYTES} bytes")));
    }
    let text = String::from_utf8(bytes).map_err(|error| unreadable(&error.utf8_error()))?;
    Ok((text, name))
}

/// Give each answer the forces of its solver, or the one list there is.
pub fn attach(answers: &mut [Answer], lists: &[MemberForces], file: &str) -> Result<(), Failure> {
    let mut taken = vec![false; lists.len()];
    for answer in answers.iter_mut() {
        let of = |(name, _): &MemberForces| name.as_deref().is_none_or(|n| n == answer.source);
        let Some(k) = lists.iter().position(of) else {
            let (file, source) = (crate::printable::Printable(file), &answer.source);
            return Err(Failure::bad_input(miette!("{file} has no forces of {source:?}")));
        };
        taken[k] = true;
        answer.forces = Forces::Named(lists[k].1.clone());
    }
    if let Some(k) = taken.iter().position(|taken| !taken) {
        let (file, name) = (crate::printable::Printable(file), &lists[k].0);
        return Err(Failure::bad_input(miette!(
            "{file} has forces of {:?}, of whom there is no answer",
            name.as_deref().unwrap_or_default()
        )));
    }
    Ok(())
}
