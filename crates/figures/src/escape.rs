//! Text between tags: the one place where it is made safe.

use std::fmt;

use model::steers;

/// A text as XML and HTML have it, in elements and in quoted attributes.
///
/// ```
/// assert_eq!(figures::Escaped("a < b & \"c\"").to_string(), "a &lt; b &amp; &quot;c&quot;");
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Escaped<'a>(pub &'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut rest = self.0;
        while let Some(at) = rest.find(special) {
            f.write_str(&rest[..at])?;
            let Some(c) = rest[at..].chars().next() else { break };
            f.write_str(match c {
                '&' => "&amp;",
                '<' => "&lt;",
                '>' => "&gt;",
                '"' => "&quot;",
                _ => " ",
            })?;
            rest = &rest[at + c.len_utf8()..];
        }
        f.write_str(rest)
    }
}

/// Whether a character cannot stand as it is, or turns the text round it. XML has a place for neither control characters, but
/// for the ends of lines and tabulators, nor the two non-characters, not even as a reference.
fn special(c: char) -> bool {
    let white = matches!(c, '\n' | '\t');
    matches!(c, '&' | '<' | '>' | '"' | '\u{fffe}' | '\u{ffff}') || (steers(c) && !white)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_is_well_formed() {
        assert_eq!(
            Escaped("a<b>&\"c\u{1}\n\u{7f}\u{202e}\u{1f517}").to_string(),
            "a&lt;b&gt;&amp;&quot;c \n  \u{1f517}"
        );
        assert_eq!(Escaped("").to_string(), "");
        assert_eq!(Escaped("plain").to_string(), "plain");
    }
}
