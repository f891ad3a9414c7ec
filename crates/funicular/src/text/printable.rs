//! Text from files on its way to a terminal: nothing in it may steer the terminal or look like a
//! line of ours.

use std::fmt;

use model::steers;

/// A text that is not the program's own, such as the name of a system: every control character is
/// shown as its escape, line ends too, so that it stays within its line.
pub struct Printable<T>(pub T);

impl<T: fmt::Display> fmt::Display for Printable<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.to_string().chars() {
            if steers(c) {
                write!(f, "{}", c.escape_default())?;
            } else {
                fmt::Write::write_char(f, c)?;
            }
        }
        Ok(())
    }
}

/// Everything that is printed passes here: what still steers becomes a question mark. Line ends
/// stay, and so do the colours of the program's own errors (`ESC [ numbers m`) where `colours` are
/// asked for.
pub fn filtered(text: &str, colours: bool) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let length = if colours { colour(rest) } else { 0 };
        if length > 0 {
            out.push_str(&rest[..length]);
            rest = &rest[length..];
            continue;
        }
        out.push(if steers(c) && c != '\n' { '?' } else { c });
        rest = &rest[c.len_utf8()..];
    }
    out
}

/// Length of the colour that a text begins with; 0 if it begins with none.
fn colour(text: &str) -> usize {
    let Some(codes) = text.strip_prefix("\u{1b}[") else { return 0 };
    let end = codes.find(|c: char| !c.is_ascii_digit() && c != ';');
    match end {
        // Code 8 conceals what follows.
        Some(end) if codes[end..].starts_with('m') && codes[..end].split(';').all(|n| n != "8") => {
            2 + end + 1
        }
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::{Printable, filtered};

    #[test]
    fn names_stay_within_their_line() {
        let shown = |text: &str| Printable(text).to_string();
        assert_eq!(shown("ok\nAgreement: agreed"), "ok\\nAgreement: agreed");
        assert_eq!(shown("\u{1b}]0;X\u{7}\u{1b}[2J"), "\\u{1b}]0;X\\u{7}\\u{1b}[2J");
        assert_eq!(shown("\u{202e}gnirts \u{e4}"), "\\u{202e}gnirts \u{e4}");
    }

    #[test]
    fn nothing_but_colours_of_our_own_gets_through() {
        assert_eq!(filtered("a\u{1b}[31mb\u{1b}[0m\n", true), "a\u{1b}[31mb\u{1b}[0m\n");
        assert_eq!(filtered("a\u{1b}[31mb\n", false), "a?[31mb\n");
        assert_eq!(filtered("\u{1b}[2J\u{1b}[8mx\u{1b}]0;t\u{7}\u{9b}", true), "?[2J?[8mx?]0;t??");
    }
}
