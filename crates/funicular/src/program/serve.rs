//! `funicular serve`: a system to change, beside its file, in the browser.

mod http;

use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use clap::Args;
use funicular::live::Ask;
use model::system_file::{limit_memory, most_file_bytes};

use crate::exit::{Exit, Failure, Result};
use crate::foreign_input;
use crate::input;
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::serve::http::{Answer, Request};

/// What is changed where.
const HELP: &str = "\
The page shows the shape with its forces, utilisation and proofs, and the file beside it: each follows the
other. A joint that is held is dragged to another place, a free one is held by hand until it is let go; joints,
members, ropes and masses are added by forms, anything else in the text. It is answered on this machine
alone, at 127.0.0.1, to the page that this program gives out, and opens no file but the one given, which it does not
write: the page saves the text, or itself as a page that needs nothing else. A request has at most 1 MB,
10 s to arrive and, if --max-work and --max-memory say nothing else, some seconds of work and 100 MB for its
system; a system has up to 2000 members, spans of ropes counted each. Ctrl-C ends it.";

/// Work of a solver for one request, if `--max-work` says nothing else: some seconds.
const WORK: std::num::NonZeroU64 = std::num::NonZeroU64::new(20_000_000).unwrap();

/// Memory for the system of one request, if `--max-memory` says nothing else, bytes.
const MEMORY: u64 = 100_000_000;

/// Requests at a time.
const MOST: usize = 8;

/// Bytes of a body.
const MOST_BYTES: usize = 1_000_000;

const HTML: &str = "text/html; charset=utf-8";

/// Time in which a request arrives, and an answer leaves.
const PATIENCE: Duration = Duration::from_secs(10);

/// `funicular serve`.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct Arguments {
    /// The system file (TOML); a lamp on a cord if not given
    #[arg(value_name = "FILE")]
    pub file: Option<std::path::PathBuf>,
    /// The port on 127.0.0.1; 0 takes a free one
    #[arg(long, value_name = "N", default_value_t = 8421)]
    pub port: u16,
}

/// Run the command.
pub fn run(arguments: &Arguments, [has_work, has_memory]: [bool; 2]) -> Result<Exit> {
    end_on_interrupt()?;
    if !has_work {
        funicular::limit_work(WORK);
    }
    if !has_memory {
        limit_memory(MEMORY);
    }
    let text = match &arguments.file {
        Some(path) => text(path)?,
        None => funicular::case_text("lamp")?.to_owned(),
    };
    let refused = |error: std::io::Error| {
        Failure::bad_input(format!("port {} on 127.0.0.1: {error}", arguments.port))
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port)).map_err(refused)?;
    let port = listener.local_addr().map_err(refused)?.port();
    output::print(&format!("http://127.0.0.1:{port}/ until Ctrl-C\n"))?;
    let running = AtomicUsize::new(0);
    let ask = Ask::new(text);
    std::thread::scope(|scope| {
        for stream in listener.incoming().flatten() {
            if running.fetch_add(1, Ordering::SeqCst) >= MOST {
                running.fetch_sub(1, Ordering::SeqCst);
                let _ = Answer::refusal(503, "too many requests at once").write(&stream, PATIENCE);
                continue;
            }
            let (ask, place) = (&ask, Place(&running));
            scope.spawn(move || {
                // Whoever went away has no use for an answer.
                let _ = reply(&stream, port, ask);
                drop(place);
            });
        }
    });
    Ok(Exit::Done)
}

/// One of the requests at a time, given back whatever becomes of it.
struct Place<'a>(&'a AtomicUsize);

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}

/// The text of a file that is TOML, or as TOML that of another program's.
fn text(path: &Path) -> Result<String> {
    if foreign_input::is_foreign(path)? {
        return Ok(input::problem(Some(path), None)?.problem.to_toml());
    }
    let (text, name) = foreign_input::text(path)?;
    if text.len() as u64 > most_file_bytes().min(MOST_BYTES as u64) {
        return Err(Failure::bad_input(format!("{name}: more than {MOST_BYTES} bytes")));
    }
    Ok(text)
}

/// Read a request and answer it.
fn reply(stream: &TcpStream, port: u16, start: &Ask) -> std::io::Result<()> {
    let answer = match Request::read(stream, MOST_BYTES, PATIENCE)? {
        Ok(request) => match request.refusal(port) {
            Some(answer) => answer,
            None => of(&request, start),
        },
        Err(answer) => answer,
    };
    answer.write(stream, PATIENCE)
}

fn of(request: &Request, start: &Ask) -> Answer {
    let answered = || Ask::answer(request.path.strip_prefix('/')?, &request.body);
    match (request.method.as_str(), request.path.as_str()) {
        ("GET", "/") => Answer::ok(HTML, start.page(false)),
        ("POST", path) => match answered() {
            Some(Ok(text)) if path == "/ask" => Answer::ok("application/json", text),
            Some(Ok(html)) => Answer::ok(HTML, html),
            Some(Err(why)) => Answer::refusal(400, &why),
            None => Answer::refusal(404, "no such page"),
        },
        (_, "/" | "/ask" | "/page") => Answer::refusal(405, "no such method"),
        _ => Answer::refusal(404, "no such page"),
    }
}
