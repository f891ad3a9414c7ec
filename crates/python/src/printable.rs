//! Text on its way to people: nothing in it may steer a terminal.

/// The text with every character that could move a cursor, change a terminal's state, or turn the
/// direction of the text round (Unicode's explicit directional formatting, UAX #9) shown as its
/// escape. Line ends stay.
pub fn printable(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if steers(c) && c != '\n' {
            out.extend(c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{2028}' | '\u{2029}')
}
