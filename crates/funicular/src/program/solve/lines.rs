//! The lines of a batch, one at a time in bounded memory.

use std::io::{self, BufRead, Read as _};

use model::system_file::{MAX_BARS_FILE_BYTES, most_file_bytes};

/// A line that is not blank.
pub struct Line {
    /// Its number, from 1; blank lines count.
    pub number: u64,
    /// The text of an object, or why there is none.
    pub text: Result<String, String>,
}

/// Lines as they are read.
pub struct Lines {
    from: Box<dyn BufRead + Send>,
    /// Bytes of the longest line that is read, and of the longest that is passed over.
    limits: [u64; 2],
    number: u64,
    ended: bool,
}

impl Lines {
    pub fn of(from: impl BufRead + Send + 'static) -> Self {
        let limits = [most_file_bytes(), MAX_BARS_FILE_BYTES];
        Self { from: Box::new(from), limits, number: 0, ended: false }
    }

    /// The next line with its end, `None` behind the last.
    fn read(&mut self) -> io::Result<Option<Vec<u8>>> {
        let [most, longest] = self.limits;
        let mut bytes = vec![];
        // One byte more than is allowed shows that it is too long.
        self.from.by_ref().take(most + 1).read_until(b'\n', &mut bytes)?;
        self.number += 1;
        if bytes.len() as u64 > most {
            let rest = self.from.by_ref().take(longest).skip_until(b'\n')?;
            if rest as u64 == longest {
                let reason = format!("a line does not end within {longest} bytes");
                return Err(io::Error::other(reason));
            }
        }
        Ok(Some(bytes).filter(|bytes| !bytes.is_empty()))
    }
}

impl Iterator for Lines {
    type Item = Line;

    fn next(&mut self) -> Option<Line> {
        while !self.ended {
            let read = self.read();
            let number = self.number;
            let bytes = match read {
                Ok(Some(bytes)) => bytes,
                Ok(None) => break,
                Err(error) => {
                    self.ended = true;
                    return Some(Line {
                        number: number + 1,
                        text: Err(format!("it cannot be read: {error}")),
                    });
                }
            };
            if !bytes.iter().all(u8::is_ascii_whitespace) {
                return Some(Line { number, text: object(bytes, self.limits[0]) });
            }
        }
        None
    }
}

/// The text of a line that may be an object of JSON.
fn object(bytes: Vec<u8>, most: u64) -> Result<String, String> {
    if bytes.len() as u64 > most {
        return Err(format!("the line is longer than the limit of {most} bytes"));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        format!("the line is not UTF-8 text (first bad byte at offset {offset})")
    })?;
    let text = text.trim_start_matches('\u{feff}').trim_end();
    if text.trim_start().starts_with('{') {
        Ok(text.to_owned())
    } else {
        Err("a line is an object of JSON with the keys of a system file: {\"anchors\": ...}"
            .to_owned())
    }
}

#[cfg(test)]
mod tests {
    use std::io::{BufRead, BufReader, Cursor, Read as _};

    use super::Lines;

    #[test]
    fn blank_lines_count_and_are_passed_over() {
        let lines = Lines::of(Cursor::new("\u{feff}{1}\r\n\n  \n{2}\nx = 1\n{3}"));
        let read: Vec<_> = lines.map(|line| (line.number, line.text)).collect();
        assert_eq!(read[0], (1, Ok("{1}".to_owned())));
        assert_eq!(read[1], (4, Ok("{2}".to_owned())));
        assert!(read[2].0 == 5 && read[2].1.is_err());
        assert_eq!(read[3], (6, Ok("{3}".to_owned())));
        assert_eq!(read.len(), 4);
        let bad = Lines::of(Cursor::new(b"{\xff}\n{}\n")).map(|line| line.text.is_ok());
        assert_eq!(bad.collect::<Vec<_>>(), [false, true]);
    }

    /// With limits that are soon met.
    fn short(from: impl BufRead + Send + 'static) -> Lines {
        let lines = Lines::of(from);
        assert_eq!(lines.limits[1], 2_000_000_000);
        Lines { limits: [1_000_000, 20_000_000], ..lines }
    }

    #[test]
    fn a_line_without_end_is_not_held() {
        let endless = || BufReader::new(std::io::repeat(b'{'));
        let read: Vec<_> = short(endless().take(1_000_009).chain(Cursor::new("\n{2}\n")))
            .map(|line| (line.number, line.text.is_ok()))
            .collect();
        assert_eq!(read, [(1, false), (2, true)]);
        // A device that never ends is not read for ever.
        let told: Vec<_> = short(endless()).map(|line| line.text.unwrap_err()).collect();
        assert!(
            told.len() == 1 && told[0].contains("does not end within 20000000 bytes"),
            "{told:?}"
        );
    }
}
