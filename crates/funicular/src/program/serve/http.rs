//! What little of HTTP a page on the same machine needs: one request and one answer a connection.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Bytes of the first line and the headers, and how many headers.
const HEAD: usize = 16 * 1024;
const HEADERS: usize = 64;

/// A request, its body read.
#[derive(Debug)]
pub struct Request {
    pub method: String,
    pub path: String,
    host: Option<String>,
    origin: Option<String>,
    is_json: bool,
    pub body: Vec<u8>,
}

/// An answer.
#[derive(Debug)]
pub struct Answer {
    status: u16,
    kind: &'static str,
    body: String,
}

/// The parts of the head of a request, and where the body begins.
struct Head {
    request: Request,
    begins: usize,
    length: usize,
}

impl Request {
    /// Read a request; or what to answer to something that is none. All of it has to arrive in time.
    pub fn read(
        mut stream: &TcpStream,
        most: usize,
        patience: Duration,
    ) -> io::Result<Result<Self, Answer>> {
        let (began, mut bytes, mut piece) = (Instant::now(), vec![], [0; 8192]);
        let mut more = |bytes: &mut Vec<u8>| -> io::Result<()> {
            let left = patience.saturating_sub(began.elapsed());
            stream.set_read_timeout(Some(left.max(Duration::from_millis(1))))?;
            let count = stream.read(&mut piece)?;
            if count == 0 || left.is_zero() {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            bytes.extend_from_slice(&piece[..count]);
            Ok(())
        };
        let head = loop {
            match head(&bytes) {
                Ok(Some(head)) => break head,
                Ok(None) if bytes.len() > HEAD => {
                    return Ok(Err(Answer::refusal(431, "the head of the request is too long")));
                }
                Ok(None) => more(&mut bytes)?,
                Err(answer) => return Ok(Err(answer)),
            }
        };
        if head.length > most {
            return Ok(Err(Answer::refusal(413, &format!("more than {most} bytes"))));
        }
        while bytes.len() < head.begins + head.length {
            more(&mut bytes)?;
        }
        let body = bytes[head.begins..head.begins + head.length].to_vec();
        Ok(Ok(Self { body, ..head.request }))
    }

    /// What to answer to who is not the page that this program gave out: another name of this machine
    /// (as a page elsewhere may have it resolved), another origin, or a form.
    pub fn refusal(&self, port: u16) -> Option<Answer> {
        let names = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}"));
        let Some(host) = self.host.as_ref().filter(|host| names.contains(host)) else {
            return Some(Answer::refusal(403, "another host"));
        };
        if self.origin.as_ref().is_some_and(|origin| *origin != format!("http://{host}")) {
            return Some(Answer::refusal(403, "another origin"));
        }
        let is_open = self.method == "GET" || self.is_json;
        (!is_open).then(|| Answer::refusal(415, "application/json is required"))
    }
}

/// The head of a request as far as it is there.
fn head(bytes: &[u8]) -> Result<Option<Head>, Answer> {
    let mut headers = [httparse::EMPTY_HEADER; HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    let begins = match parsed.parse(bytes) {
        Ok(httparse::Status::Complete(begins)) => begins,
        Ok(httparse::Status::Partial) => return Ok(None),
        Err(error) => return Err(Answer::refusal(400, &error.to_string())),
    };
    let of = |name: &str| {
        let mut with = parsed.headers.iter().filter(|one| one.name.eq_ignore_ascii_case(name));
        let first = with.next().map(|one| String::from_utf8_lossy(one.value).into_owned());
        if with.next().is_some() {
            Err(Answer::refusal(400, "a header given twice"))
        } else {
            Ok(first)
        }
    };
    if of("transfer-encoding")?.is_some() {
        return Err(Answer::refusal(411, "a length is required"));
    }
    let length = match of("content-length")? {
        Some(text) => {
            text.parse().map_err(|_| Answer::refusal(400, "the content-length is not a number"))?
        }
        None => 0,
    };
    let kind = of("content-type")?.unwrap_or_default();
    let request = Request {
        method: parsed.method.unwrap_or_default().to_owned(),
        path: parsed.path.unwrap_or_default().to_owned(),
        host: of("host")?,
        origin: of("origin")?,
        is_json: kind.split(';').next().is_some_and(|kind| kind.trim() == "application/json"),
        body: vec![],
    };
    Ok(Some(Head { request, begins, length }))
}

impl Answer {
    pub fn ok(kind: &'static str, body: String) -> Self {
        Self { status: 200, kind, body }
    }

    /// Why there is none, in words.
    pub fn refusal(status: u16, why: &str) -> Self {
        Self { status, kind: "text/plain; charset=utf-8", body: why.to_owned() }
    }

    /// Write it, in time, and close.
    pub fn write(&self, mut stream: &TcpStream, patience: Duration) -> io::Result<()> {
        stream.set_write_timeout(Some(patience))?;
        let head = format!(
            "HTTP/1.1 {} {}\r\ncontent-type: {}\r\ncontent-length: {}\r\nconnection: close\r\ncache-control: no-store\r\n\
             x-content-type-options: nosniff\r\ncross-origin-resource-policy: same-origin\r\n\
             content-security-policy: default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; \
             connect-src 'self'; img-src data:; frame-ancestors 'none'\r\n\r\n",
            self.status,
            if self.status == 200 { "OK" } else { "Refused" },
            self.kind,
            self.body.len(),
        );
        // At once: the second of two waits until the first is acknowledged.
        stream.write_all((head + &self.body).as_bytes())?;
        stream.flush()
    }
}
