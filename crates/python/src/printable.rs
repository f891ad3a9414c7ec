//! Text on its way to people: nothing in it may steer a terminal.

use model::steers;

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
