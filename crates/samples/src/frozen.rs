//! Tables of counts that a change of the code changes.

use std::fmt::Debug;

/// Where this variable is set, counts have to be equal: so the search for changes that no test
/// notices sets it.
const EXACT: &str = "EXACT_WORK";

/// Counts may differ by this part, and by [`FEW`] at least: a processor with other vector units, or
/// another library of sines, rounds other last digits, and now and then a step more is made.
const PART: u64 = 20;

/// See [`PART`].
const FEW: u64 = 5;

/// Assert that rows of counts are as they were written down. The message has the rows as they are,
/// to be written down in their place where the change is meant.
///
/// ```
/// samples::assert_frozen(&[("generic", 745)], &[("generic", 745)]);
/// samples::assert_frozen(&[("generic", 746)], &[("generic", 745)]);
/// ```
///
/// # Panics
///
/// Where words differ, or a number by more than a twentieth and five; by anything where the
/// environment has `EXACT_WORK`.
///
/// ```should_panic
/// samples::assert_frozen(&[("generic", 845)], &[("generic", 745)]);
/// ```
pub fn assert_frozen<T: Debug>(found: &[T], expected: &[T]) {
    let rows = |rows: &[T]| {
        rows.iter().fold(String::new(), |text, row| {
            text + &format!(
                "        {row:?},
"
            )
        })
    };
    let (found, expected) = (rows(found), rows(expected));
    let same = if std::env::var_os(EXACT).is_some() {
        found == expected
    } else {
        let (found, expected) = (pieces(&found), pieces(&expected));
        found.len() == expected.len() && found.iter().zip(&expected).all(|(a, b)| near(a, b))
    };
    assert!(same, "the work has changed:\n{found}");
}

/// Runs of digits, and what stands between them.
fn pieces(text: &str) -> Vec<&str> {
    let is_digit = |c: char| c.is_ascii_digit();
    let mut pieces = vec![];
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let inside = is_digit(first);
        let end = rest.find(|c| is_digit(c) != inside).unwrap_or(rest.len());
        let (piece, after) = rest.split_at(end);
        pieces.push(piece);
        rest = after;
    }
    pieces
}

fn near(a: &str, b: &str) -> bool {
    match (a.parse::<u64>(), b.parse::<u64>()) {
        (Ok(a), Ok(b)) => a.abs_diff(b) <= (b / PART).max(FEW),
        _ => a == b,
    }
}
