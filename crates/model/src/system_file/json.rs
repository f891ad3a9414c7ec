//! JSON as the TOML that says the same, every value in its place.
//!
//! An object of JSON is a table of TOML but for the colons, the braces around it and the commas
//! between its keys; strings differ in two escapes. So a text of JSON is made one of TOML of the
//! same length, and every error of the one is in its place in the other. Whether the text is JSON
//! at all is asked of a parser of JSON first.

use std::fmt::Write as _;
use std::path::Path;

/// Whether a text is meant as JSON: a brace is the first character that is no blank, or its file is named so.
pub(super) fn is_json(file: &str, text: &str) -> bool {
    let text = text.trim_start();
    let named = || Path::new(file).extension().is_some_and(|end| end.eq_ignore_ascii_case("json"));
    text.starts_with('{') || !text.is_empty() && named()
}

/// The same as TOML, or where and why the text is no JSON.
pub(super) fn as_toml(text: &str) -> Result<String, (usize, String)> {
    check(text)?;
    let mut toml = String::with_capacity(text.len());
    let mut depth = 0_usize;
    let mut rest = text.char_indices();
    while let Some((place, c)) = rest.next() {
        match c {
            '"' => {
                let length = string(&text[place..], &mut toml);
                // The loop has taken the quote.
                let end = place + length;
                while rest.clone().next().is_some_and(|(next, _)| next < end) {
                    rest.next();
                }
            }
            ':' => toml.push('='),
            // Outside of a string no other word of JSON begins so.
            'n' => return Err((place, "null is not allowed here".to_owned())),
            '{' | '[' => {
                depth += 1;
                toml.push(if depth == 1 { ' ' } else { c });
            }
            '}' | ']' => {
                toml.push(if depth == 1 { ' ' } else { c });
                depth = depth.saturating_sub(1);
            }
            // A key of the whole file begins a line.
            ',' if depth == 1 => toml.push('\n'),
            // Within the whole file a line ends behind a value alone.
            '\n' | '\r' | '\t' if depth == 1 => toml.push(' '),
            _ => toml.push(c),
        }
    }
    Ok(toml)
}

/// One string, from its opening quote on: written as TOML with blanks behind where that is shorter.
/// The length that it has in the text.
fn string(text: &str, toml: &mut String) -> usize {
    let begin = toml.len();
    toml.push('"');
    let mut rest = text.char_indices().skip(1);
    let mut length = text.len();
    while let Some((place, c)) = rest.next() {
        match c {
            '"' => {
                length = place + 1;
                break;
            }
            '\\' => escape(&text[place..], &mut rest, toml),
            // Allowed in JSON, not in TOML.
            '\u{7f}' => toml.push_str("\\u007F"),
            _ => toml.push(c),
        }
    }
    toml.push('"');
    while toml.len() < begin + length {
        toml.push(' ');
    }
    length
}

/// One escape; `text` begins with its backslash, which `rest` has passed.
fn escape(text: &str, rest: &mut impl Iterator<Item = (usize, char)>, toml: &mut String) {
    let code = |at: usize| text.get(at..at + 4).and_then(|hex| u32::from_str_radix(hex, 16).ok());
    match rest.next() {
        Some((_, '/')) => toml.push('/'),
        Some((_, 'u')) => {
            let high = code(2).unwrap_or(0);
            let low = if text.get(6..8) == Some("\\u") { code(8) } else { None };
            if let (0xD800..=0xDBFF, Some(low)) = (high, low) {
                // Two halves of one character.
                let whole = 0x1_0000 + ((high - 0xD800) << 10) + (low.wrapping_sub(0xDC00) & 0x3FF);
                let _ = write!(toml, "\\U{whole:08X}");
                let _ = rest.nth(9);
            } else {
                let _ = write!(toml, "\\u{high:04X}");
                let _ = rest.nth(3);
            }
        }
        Some((_, c)) => {
            toml.push('\\');
            toml.push(c);
        }
        None => {}
    }
}

/// Refuse what is no object of JSON, without building its values up.
fn check(text: &str) -> Result<(), (usize, String)> {
    let Err(error) = serde_json::from_str::<serde::de::IgnoredAny>(text) else {
        let is_object = text.trim_start().starts_with('{');
        return is_object.then_some(()).ok_or_else(|| (0, "expected an object".to_owned()));
    };
    let begin: usize = text.split_inclusive('\n').take(error.line() - 1).map(str::len).sum();
    let line = text[begin..].lines().next().unwrap_or_default();
    // Columns count bytes, from 1.
    let mut offset = begin + error.column().saturating_sub(1).min(line.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    let message = error.to_string();
    // The place is told apart.
    let what = message.rfind(" at line ").map_or(message.as_str(), |end| &message[..end]);
    Err((offset, what.to_owned()))
}
