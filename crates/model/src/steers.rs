//! Characters that steer what shows them.

/// Whether a character may move a cursor, change the state of a terminal, or turn the direction of a
/// text round (Unicode's explicit directional formatting, UAX #9).
///
/// ```
/// assert!(model::steers('\u{1b}') && model::steers('\u{202e}') && !model::steers('\u{e4}'));
/// ```
pub fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200e}' | '\u{200f}' | '\u{61c}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{2028}' | '\u{2029}')
}
