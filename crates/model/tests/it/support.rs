//! Texts to put mistakes into, and the check of their errors.

use model::system_file::parse_problem;

/// A file with the anchors of the paper in front of the given rest.
pub fn anchored(rest: &str) -> String {
    format!("[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n{rest}")
}

/// Three bars of the paper behind the given head.
pub fn barred(head: &str) -> String {
    format!("{head}\n[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 3\n")
}

/// The text must be refused with this message (file, line, column, key, reason) and this place
/// marked.
#[track_caller]
pub fn check(text: &str, message: &str, marked: &str) {
    let error = parse_problem(text, "f").expect_err(text);
    let found = error.span().map_or("", |span| &error.text()[span]);
    assert_eq!((error.to_string().as_str(), found), (message, marked));
}
