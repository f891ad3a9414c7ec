//! The guide: its pictures are what the program draws, and its files are solved.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::path::{Path, PathBuf};

use crate::keys::output::run;

/// The pictures with the commands that draw them, whose last argument is the file.
const PICTURES: [&[&str]; 5] = [
    &["census", "lamp.toml", "--svg", "lamp.svg"],
    &["solve", "bridle.toml", "--svg", "bridle.svg"],
    &["study", "lamp.toml", "--vary", "anchors.end_m.x=0.5..1.5:40", "--svg", "study.svg"],
    &["trace", "lamp.toml", "--vary", "anchors.end_m.x=1.0..1.6:50", "--svg", "branches.svg"],
    &["modes", "lamp.toml", "--svg", "modes.svg"],
];

fn guide() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("guide")
}

/// The file that a page shows behind its name.
fn shown(page: &str, name: &str) -> String {
    let after = page.split_once(&format!("`{name}`")).unwrap().1;
    after.split_once("```toml\n").unwrap().1.split_once("```").unwrap().0.to_owned()
}

/// `BLESS=1 cargo test -p funicular --test it guide::` draws them again.
#[test]
fn its_pictures_are_what_the_program_draws() {
    let folder = tempfile::tempdir().unwrap();
    let readme = include_str!("../../README.md");
    for name in ["lamp.toml", "bridle.toml"] {
        std::fs::write(folder.path().join(name), shown(readme, name)).unwrap();
    }
    for command in PICTURES {
        let picture = command.last().unwrap();
        assert_eq!(run(folder.path(), command).0, Some(0), "{picture}");
        let drawn = std::fs::read_to_string(folder.path().join(picture)).unwrap();
        let kept = guide().join("pictures").join(picture);
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(&kept, &drawn).unwrap();
        }
        assert!(std::fs::read_to_string(&kept).unwrap() == drawn, "{picture} has changed");
    }
}

#[test]
fn its_first_file_is_solved() {
    let folder = tempfile::tempdir().unwrap();
    let page = std::fs::read_to_string(guide().join("1-first-steps.md")).unwrap();
    std::fs::write(folder.path().join("v.toml"), shown(&page, "v.toml")).unwrap();
    let (code, text) = run(folder.path(), &["solve", "v.toml"]);
    assert_eq!(code, Some(0));
    // Half of 5 kg over a cosine of 0.8.
    assert!(text.contains("Largest tension: 30.6458 N") && text.contains("-0.8) m"), "{text}");
}
