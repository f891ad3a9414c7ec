//! Letters of a drawing beyond ASCII.

/// The bytes 0x80 to 0x9f in the code page 1252; the others stand for themselves.
const UPPER: [char; 32] = [
    '€', '\u{fffd}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{fffd}', 'Ž',
    '\u{fffd}', '\u{fffd}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{fffd}',
    'ž', 'Ÿ',
];
/// What stands before the four hexadecimal digits of a unit of UTF-16.
const NUMBER: &str = "\\U+";

/// The text of a file that is no UTF-8: of the code page 1252 where it names no other; of others ASCII alone is read.
pub(in crate::system) fn decoded(bytes: &[u8]) -> String {
    let letter = |&byte: &u8| match byte {
        0x80..=0x9f => UPPER[usize::from(byte - 0x80)],
        byte => char::from(byte),
    };
    let text: String = bytes.iter().map(letter).collect();
    // The group code stands between.
    let named = text.split_once("$DWGCODEPAGE").and_then(|(_, rest)| rest.lines().nth(2));
    if named.is_none_or(|page| page.trim().eq_ignore_ascii_case("ANSI_1252")) {
        return text;
    }
    String::from_utf8_lossy(bytes).into_owned()
}

/// A text with its letters in the place of their numbers.
pub(super) fn unescaped(text: &str) -> String {
    let mut parts = text.split(NUMBER);
    let mut units: Vec<u16> = parts.next().unwrap_or_default().encode_utf16().collect();
    for part in parts {
        let number = part.get(..4).filter(|digits| digits.bytes().all(|c| c.is_ascii_hexdigit()));
        let unit = number.and_then(|digits| u16::from_str_radix(digits, 16).ok());
        units.extend(unit);
        let rest = if unit.is_some() { &part[4..] } else { part };
        if unit.is_none() {
            units.extend(NUMBER.encode_utf16());
        }
        units.extend(rest.encode_utf16());
    }
    String::from_utf16_lossy(&units)
}
