//! Files of other programs, right and wrong.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking; so do its helpers")]

use std::fmt::Debug;

use formats::FormatError;

mod answers;
mod compas;
mod drawings;
mod drawn_in_cad;
mod export;
mod forces;
mod map;
mod moordyn;
mod nets;
mod opensees;

/// The right text with what a row of a part of `refused.txt` replaces is refused as the row says.
#[track_caller]
fn refused<T: Debug>(part: &str, right: &str, parse: impl Fn(&str) -> Result<T, FormatError>) {
    let mut parts = include_str!("refused.txt").split("\n## ").skip(1);
    let rows = parts.find_map(|text| text.strip_prefix(part)?.strip_prefix('\n')).expect(part);
    for row in rows.lines().filter(|line| line.starts_with('[')) {
        let [from, to, says]: [String; 3] = serde_json::from_str(row).unwrap();
        assert!(right.contains(&from), "{from}");
        assert_eq!(parse(&right.replacen(&from, &to, 1)).unwrap_err().to_string(), says);
    }
}
