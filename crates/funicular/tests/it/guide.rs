//! The guide: its pictures are what the program draws, and its files are solved.

use std::path::{Path, PathBuf};

use crate::run::{good, holding, run};

/// The pictures with the commands that draw them, whose last argument is the file.
const PICTURES: [&[&str]; 10] = [
    &["solve", "triangle.toml", "--svg", "triangle.svg"],
    &["solve", "--case", "warren-truss", "--svg", "truss.svg"],
    &["solve", "--case", "lattice-tower", "--svg", "tower.svg"],
    &["solve", "--case", "star-dome", "--svg", "dome.svg"],
    &["census", "lamp.toml", "--svg", "lamp.svg"],
    &["solve", "bridle.toml", "--svg", "bridle.svg"],
    &["study", "lamp.toml", "--vary", "anchors.end_m.x=0.5..1.5:40", "--svg", "study.svg"],
    &["trace", "lamp.toml", "--vary", "anchors.end_m.x=1.0..1.6:50", "--svg", "branches.svg"],
    &["modes", "lamp.toml", "--svg", "modes.svg"],
    &["trace", "--case", "star-dome", "--vary", "loads=0..4", "--svg", "load-path.svg"],
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
    let first = include_str!("../../guide/1-first-steps.md");
    for (page, name) in [(readme, "lamp.toml"), (readme, "bridle.toml"), (first, "triangle.toml")] {
        std::fs::write(folder.path().join(name), shown(page, name)).unwrap();
    }
    for command in PICTURES {
        let picture = command.last().unwrap();
        assert_eq!(run(&folder, command).0, Some(0), "{picture}");
        let drawn = std::fs::read_to_string(folder.path().join(picture)).unwrap();
        let kept = guide().join("pictures").join(picture);
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(&kept, &drawn).unwrap();
        }
        assert!(std::fs::read_to_string(&kept).unwrap() == drawn, "{picture} has changed");
    }
}

/// What the first chapter says of its structures is what the program says of them.
#[test]
fn its_first_structures_are_solved() {
    let page = include_str!("../../guide/1-first-steps.md");
    let folder = holding([("triangle.toml", shown(page, "triangle.toml"))]);
    // Half of 100 kg, and √2 of that; by the method of joints; `validate` holds the tower and the dome
    // against Newton's method.
    for (arguments, said) in [
        (&["solve", "triangle.toml"][..], &["tension: 490.332 N", "compression: 693.435 N"][..]),
        (&["solve", "triangle.toml"], &["another is lower, by 1961.33 J"]),
        (&["solve", "--case", "warren-truss"], &["2758.12 N", "2891.12 N", " 2451.66 "]),
        (&["solve", "--case", "lattice-tower"], &["1884.22", "2954.56"]),
        (&["solve", "--case", "star-dome"], &["joint N1 is 0.00184273 m", "another is lower, by"]),
    ] {
        let text = good(&folder, arguments).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.iter().all(|words| text.contains(words.trim())), "{said:?}\n{text}");
    }
    let vary = "joints.N1.force_n.z=-40..-720:18";
    let (code, text, _) = run(&folder, &["study", "--case", "star-dome", "--vary", vary]);
    assert_eq!(code, Some(3));
    assert!(text.contains("both solvers agree on 16"), "{text}");
}

/// What the chapter of load paths shows is what the program says, and its options are taken.
#[test]
fn its_load_path_is_followed() {
    let page = include_str!("../../guide/15-load-paths.md");
    let folder = holding([("gable.toml", shown(page, "gable.toml"))]);
    let command = page.split('`').find_map(|code| code.strip_prefix("funicular trace gable.toml"));
    let arguments = command.unwrap().split_whitespace();
    let arguments: Vec<&str> = ["trace", "gable.toml"].into_iter().chain(arguments).collect();
    let text = good(&folder, &arguments);
    let said = page.split_once("```text\n").unwrap().1.split_once("```").unwrap().0;
    let trimmed =
        |text: &str| text.lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>();
    assert_eq!(trimmed(said), trimmed(&text));
    // EA = 1e6 N, limit where l^3 = l0 a^2, in units of 1e3 N.
    let l0 = 1.25_f64.sqrt();
    let l = l0.cbrt();
    let limit = 2e3 * (l * l - 1.0).sqrt() / l * (l0 - l) / l0;
    assert!(said.contains(&format!("loads = {limit:.7}")), "{limit}");
}

/// The examples of the chapter of commands, as they stand there.
#[test]
fn its_commands_run() {
    let folder = tempfile::tempdir().unwrap();
    let page = include_str!("../../guide/13-commands.md");
    let lines = page.split('`').filter_map(|code| code.strip_prefix("funicular "));
    let commands: Vec<Vec<&str>> = lines
        .map(|line| line.split_whitespace().take_while(|word| *word != ">").collect())
        // An answer of another program, a summary of all, what does not end, and what other tests run.
        .filter(|words: &Vec<_>| !["judge", "COMMAND", "reproduce", "serve"].contains(&words[0]))
        .collect();
    assert!(commands.len() > 10, "{commands:?}");
    for command in commands {
        assert_eq!(run(&folder, &command).0, Some(0), "{command:?}");
    }
}

/// The systems of the second chapter, and what the program says of them: each text stands behind its system.
#[test]
fn its_systems_are_solved() {
    let folder = tempfile::tempdir().unwrap();
    let page = include_str!("../../guide/2-systems.md");
    let trimmed = |text: &str| text.lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
    let ways: [&[&str]; 4] =
        [&[], &["--without", "each"], &["--load-case", "each"], &["--tolerances"]];
    let mut texts = 0;
    for block in page.split("```").skip(1).step_by(2) {
        if let Some(system) = block.strip_prefix("toml\n") {
            std::fs::write(folder.path().join("system.toml"), system).unwrap();
            assert_eq!(run(&folder, &["solve", "system.toml"]).0, Some(0), "{system}");
        } else if let Some(text) = block.strip_prefix("text\n") {
            let said = ways.map(|way| run(&folder, &[&["solve", "system.toml"], way].concat()).1);
            assert!(
                said.iter().any(|said| trimmed(said).contains(&trimmed(text))),
                "{text}{said:?}"
            );
            texts += 1;
        }
    }
    assert_eq!(texts, 4);
}
