//! The examples of the page of the file format, as its readers try them.

use crate::run::{folder, ran};
use model::system_file::FORMAT;

/// What a terminal has room for: wider lines are broken where they are copied.
const COLUMNS: usize = 80;

/// The blocks of the page: their language with the name of their file, and their text.
fn blocks() -> Vec<(&'static str, &'static str)> {
    let parts: Vec<&str> = FORMAT.split("```").collect();
    parts.iter().skip(1).step_by(2).map(|block| block.split_once('\n').unwrap()).collect()
}

/// Exit code 0, or 2 where the block says that it is refused. Files of bars and joints stand behind the system that
/// names them.
#[test]
fn every_block_is_solved_or_refused_as_it_says() {
    let folder = folder("all");
    let all = blocks();
    let (mut solved, mut refused) = (0, 0);
    for (k, (language, text)) in all.iter().enumerate().filter(|(_, (l, _))| !l.starts_with("csv"))
    {
        let files =
            all[k + 1..].iter().map_while(|(l, text)| Some((l.strip_prefix("csv ")?, text)));
        for (name, text) in files {
            std::fs::write(folder.join(name), text).unwrap();
        }
        let file = format!("block-{k}.{language}");
        std::fs::write(folder.join(&file), text).unwrap();
        let output = ran(&folder, &["solve", &file]);
        let said = String::from_utf8_lossy(&output.stderr);
        let wanted = if text.contains("# refused: ") { 2 } else { 0 };
        assert_eq!(output.status.code(), Some(wanted), "block {k}:\n{text}\n{said}");
        *(if wanted == 0 { &mut solved } else { &mut refused }) += 1;
    }
    assert!(solved >= 11 && refused >= 30, "{solved} solved, {refused} refused");
}

#[test]
fn no_line_of_an_example_is_wider_than_a_terminal() {
    for (language, text) in blocks().iter().filter(|(language, _)| !language.starts_with("csv")) {
        for line in text.lines() {
            assert!(line.chars().count() <= COLUMNS, "{language}: {line}");
        }
    }
}
