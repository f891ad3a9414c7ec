//! Systems and answers of other programs: which reader, and the text.

use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use formats::system::{Source, parse_compas, parse_net};
use funicular::Error;
use funicular::judge::Subject;
use model::open_input;
use model::system_file::most_file_bytes;

use crate::exit::{Failure, Result};
use crate::input::Input;
use crate::judge::{Format, Judge};

/// The system that the arguments name, and the files that were read for it.
pub fn system(arguments: &Judge) -> Result<(Subject, Vec<PathBuf>)> {
    let own = || {
        let Input { problem, files } = arguments.input.read()?;
        Ok((Subject::from(&problem), files))
    };
    let Some(path) = arguments.input.file.as_deref() else { return own() };
    let written = match arguments.format {
        Format::Auto => guess(path, arguments.edges.is_some())?,
        Format::Funicular => Written::Own,
        Format::ForceDensity => Written::Net,
        Format::Dxf => Written::By(Source::Dxf),
        Format::Obj => Written::By(Source::Obj),
        Format::Moordyn => Written::By(Source::MoorDyn),
        Format::Map => Written::By(Source::Map),
        Format::Opensees => Written::By(Source::OpenSees),
        Format::Compas => Written::By(Source::Compas),
    };
    if written != Written::Net && arguments.edges.is_some() {
        return Err(Failure::bad_input("--edges is for nets of force densities"));
    }
    if written != Written::Own && arguments.input.load_case.is_some() {
        return Err(Failure::bad_input("--load-case is for system files, which have [[cases]]"));
    }
    let subject = match written {
        Written::Own => return own(),
        Written::By(Source::Compas) => {
            let (text, name) = text(path)?;
            Subject::net(parse_compas(&text, &name).map_err(Error::from)?, &name)
        }
        Written::Net => {
            let Some(edges) = arguments.edges.as_deref() else {
                return Err(Failure::bad_input(
                    "a net of force densities needs its edges too: --edges FILE",
                ));
            };
            let (nodes, edges) = (text(path)?, text(edges)?);
            let net = parse_net((&nodes.0, &nodes.1), (&edges.0, &edges.1), &nodes.1);
            Subject::net(net.map_err(Error::from)?, &nodes.1)
        }
        Written::By(source) => {
            let (text, name) = text(path)?;
            Subject::from(source.parse(&text, &name).map_err(Error::from)?)
        }
    };
    let files = [Some(path.to_owned()), arguments.edges.clone()];
    Ok((subject, files.into_iter().flatten().collect()))
}

/// How a file is written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Written {
    /// As our own.
    Own,
    /// As the nodes of a net of force densities.
    Net,
    /// By another program.
    By(Source),
}

/// Which format a file is in.
fn guess(path: &Path, with_edges: bool) -> Result<Written> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    if with_edges || ending.eq_ignore_ascii_case("csv") {
        return Ok(Written::Net);
    }
    if !Source::may_end(ending) {
        return Ok(Written::Own);
    }
    Ok(Source::guess(ending, &text(path)?.0).map_or(Written::Own, Written::By))
}

/// Whether a file is of another program.
pub fn is_foreign(path: &Path) -> Result<bool> {
    Ok(matches!(guess(path, false)?, Written::By(_)))
}

/// The text of a file (`-` is standard input), and the name that stands for it in errors.
pub fn text(path: &Path) -> Result<(String, String)> {
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
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let text = Source::text(ending, bytes).map_err(|error| unreadable(&error))?;
    Ok((text, name))
}
