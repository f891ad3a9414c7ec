//! Systems and answers of other programs: which reader, and the text.

use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use formats::system::{ForeignSystem, parse_compas, parse_moordyn, parse_net};
use funicular::judge::Subject;
use funicular::{Error, Problem};
use model::open_input;
use model::system_file::most_file_bytes;

use crate::diagnostics::Diagnostic;
use crate::exit::Failure;
use crate::input;
use crate::judge::{Format, Judge};

/// The system that the arguments name, and the files that were read for it.
pub fn system(arguments: &Judge) -> Result<(Subject, Vec<PathBuf>), Failure> {
    let load_case = arguments.load_case.as_deref();
    let own = |file| {
        let input::Input { problem, files } = input::problem(file, arguments.case.as_deref())?;
        Ok((Subject::from(&input::in_case(problem, load_case)?), files))
    };
    let Some(path) = arguments.file.as_deref() else { return own(None) };
    let format = match arguments.format {
        Format::Auto => guess(path, arguments.edges.is_some())?,
        format => format,
    };
    if format != Format::ForceDensity && arguments.edges.is_some() {
        return Err(Failure::bad_input("--edges is for nets of force densities"));
    }
    if load_case.is_some() && !matches!(format, Format::Auto | Format::Funicular) {
        return Err(Failure::bad_input("--load-case is for system files, which have [[cases]]"));
    }
    let subject = match format {
        Format::Moordyn => {
            let (text, name) = text(path)?;
            Subject::from(parse_moordyn(&text, &name).map_err(Error::from)?)
        }
        Format::Compas => {
            let (text, name) = text(path)?;
            Subject::net(parse_compas(&text, &name).map_err(Error::from)?, &name)
        }
        Format::ForceDensity => {
            let Some(edges) = arguments.edges.as_deref() else {
                return Err(Failure::bad_input(
                    "a net of force densities needs its edges too: --edges FILE",
                ));
            };
            let (nodes, edges) = (text(path)?, text(edges)?);
            let net = parse_net((&nodes.0, &nodes.1), (&edges.0, &edges.1), &nodes.1);
            Subject::net(net.map_err(Error::from)?, &nodes.1)
        }
        Format::Auto | Format::Funicular => return own(Some(path)),
    };
    let files = [Some(path.to_owned()), arguments.edges.clone()];
    Ok((subject, files.into_iter().flatten().collect()))
}

/// The problem of a file of another program; `None` if it is not known as one.
///
/// The bottom of the sea is a floor of the system; a net of force densities is the system that has them at its
/// places, and its equilibrium next to these is wanted.
pub fn problem(path: &Path) -> Result<Option<Problem>, Failure> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    match ending.to_ascii_lowercase().as_str() {
        "csv" => {
            let message = format!("{} is a table, not a system file", path.display());
            let help = "a system file names it, bars_file = \"...\" or joints_file = \"...\" (`funicular format`); \
                        of a net of force densities `funicular judge NODES --edges EDGES` reads both tables";
            Err(Failure::bad_input(Diagnostic::from(message).with_help(help.to_owned())))
        }
        "dat" | "txt" => moordyn(path),
        "json" if guess(path, false)? == Format::Compas => {
            let (text, name) = text(path)?;
            let net = parse_compas(&text, &name).map_err(Error::from)?;
            let places_m = net.places_m();
            let system = net.system_at(&places_m, &name).map_err(Error::from)?;
            Ok(Some(Problem::from(system).near(&places_m)?))
        }
        _ => Ok(None),
    }
}

/// A MoorDyn file, which has sections under lines of dashes, as no system file has.
fn moordyn(path: &Path) -> Result<Option<Problem>, Failure> {
    let (text, name) = text(path)?;
    if !text.lines().any(|line| line.starts_with("---")) {
        return Ok(None);
    }
    let ForeignSystem { system, floor_m, .. } = parse_moordyn(&text, &name).map_err(Error::from)?;
    let system = match floor_m {
        Some(floor_m) => {
            let above = system.with_floor(floor_m);
            above.map_err(|error| Failure::bad_input(format!("{name}: {error}")))?
        }
        None => system,
    };
    system.refusal().map_err(|refusal| Failure::bad_input(format!("{name}: {refusal}")))?;
    Ok(Some(system.into()))
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
        Failure::bad_input(format!("{} cannot be read: {why}", crate::printable::Printable(&name)))
    };
    let mut bytes = Vec::new();
    // One byte more than is allowed shows that it is too long.
    let most = most_file_bytes();
    let limit = most.saturating_add(1);
    let read = if standard {
        std::io::stdin().lock().take(limit).read_to_end(&mut bytes)
    } else {
        open_input(path).and_then(|file| file.take(limit).read_to_end(&mut bytes))
    };
    read.map_err(|error| match error.kind() {
        ErrorKind::IsADirectory => unreadable(&"it is a folder"),
        _ => unreadable(&error),
    })?;
    if bytes.len() as u64 > most {
        return Err(unreadable(&format_args!("it is longer than {most} bytes")));
    }
    let text = String::from_utf8(bytes).map_err(|error| unreadable(&error.utf8_error()))?;
    Ok((text, name))
}
