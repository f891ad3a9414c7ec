//! The command line itself: help, pages, guesses, what is capped.

use std::path::PathBuf;

use crate::run::{fails, funicular, good, program, refused, says, stderr, stdout};

#[test]
fn help_version_and_completions() {
    let text = good(".", &["--help"]);
    says(&text, &["reproduce", "solve", "cases", "completions", "Exit codes:", "Examples:"]);
    let version = format!("funicular {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(stdout(&funicular(&["--version"])), version);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = stdout(&funicular(&["completions", shell]));
        assert!(script.contains("reproduce"), "{shell}");
        // Cases by name, chains and systems; the scripts for two shells complete no values.
        let names =
            ["three-equal-bars", "footbridge"].into_iter().all(|name| script.contains(name));
        assert!(names || ["powershell", "elvish"].contains(&shell), "{shell}");
    }
    let cases = stdout(&funicular(&["cases"]));
    assert!(model::cases::all().iter().all(|case| cases.contains(case.name)));
}

/// What newcomers type first leads on.
#[test]
fn first_guesses_find_their_way() {
    let said = |arguments: &[&str]| {
        let output = funicular(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    let start = said(&[]);
    assert!(
        start.lines().count() <= 10 && start.contains("funicular solve --case lamp"),
        "{start}"
    );
    for (word, wanted) in [("plot", "--svg"), ("animate", "--html"), ("chain", "funicular new")] {
        assert!(said(&[word]).contains(wanted), "{word}");
    }
    for wanted in ["funicular new", "--case lamp"] {
        assert!(said(&["solve"]).contains(wanted), "{wanted}");
    }
    assert!(said(&["solve", "footbridge"]).contains("--case footbridge"));
    for guess in
        [&["trace", "--case", "lamp"][..], &["trace", "x.toml", "--vary", "a=1", "loads=0..1"]]
    {
        assert!(said(guess).contains("`--vary loads=0..1.2`"), "{guess:?}");
    }
}

/// An error that nobody reads is the same error: no panic, the right exit code.
#[test]
fn a_closed_standard_error_changes_no_exit_code() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let status = std::process::Command::new(crate::run::PROGRAM)
        .args(["solve", "there-is-no-such-file.toml"])
        .stderr(writer)
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(2));
}

/// The page of the format and the chapters of the guide fit a terminal, but for blocks of code, and lose no word.
#[test]
fn pages_fit_a_terminal() {
    let format = stdout(&funicular(&["format"]));
    for page in ["file", "format"] {
        assert_eq!(stdout(&funicular(&["help", page])), format);
    }
    let chapter = include_str!("../../guide/2-systems.md");
    let shown = stdout(&funicular(&["guide", "systems"]));
    for (page, text) in [(&format, model::system_file::FORMAT), (&shown, chapter)] {
        let blocks = page.split("```").step_by(2);
        let long = |line: &&str| line.chars().count() > 80 && line.contains(' ');
        let long: Vec<&str> = blocks.flat_map(str::lines).filter(long).collect();
        assert!(long.is_empty(), "{long:#?}");
        let outside = |text: &str| {
            let blocks: Vec<String> = text.split("```").step_by(2).map(str::to_owned).collect();
            blocks.join(" ")
        };
        let letters = |text: &str| {
            let mut letters: Vec<char> =
                outside(text).chars().filter(|c| c.is_alphanumeric()).collect();
            letters.sort_unstable();
            letters
        };
        assert_eq!(letters(page), letters(text));
    }
}

#[test]
fn numbers_that_are_none_are_explained_in_plain_words() {
    for (arguments, wanted) in [
        (["basins", "--size", "1e9"], "a whole number is required"),
        (["basins", "--others", "abc"], "a number is required"),
    ] {
        fails(&funicular(&arguments), 2, wanted);
    }
}

#[test]
fn the_nearest_case_is_named() {
    let output = funicular(&["solve", "--case", "three-equal-bar"]);
    fails(&output, 2, "did you mean `three-equal-bars`?");
}

#[test]
fn threads_are_capped_wherever_they_are_asked_for() {
    let mut many = program(".", &["solve", "--case", "two-bars"]);
    let output = many.env("RAYON_NUM_THREADS", "5000").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    assert!(said.contains("RAYON_NUM_THREADS") && said.contains("1024"), "{said}");
    for command in ["census", "sweep", "merge"] {
        refused(".", &[command], &[(&["--threads", "1025"], "up to 1024 is required")]);
    }
    good(".", &["census", "--case", "two-bars", "--threads", "0"]);
}

/// Options that need one which another of the options excludes: the parser of the command line forgets
/// such a need.
#[test]
fn options_without_what_they_need_are_refused() {
    let simulate = ["simulate", "--case", "two-bars", "--from", "rest"];
    for row in [&["--json"][..], &["--resume"], &["--seed", "2"], &["--format", "parquet"]] {
        refused(".", &simulate, &[(row, "--seeds <N>")]);
    }
    let random = ["--monte-carlo", "10"];
    let solve = ["solve", "--case", "two-bars"];
    for row in [&["--summary"][..], &["--evidence"], &["--svg", "x.svg"], &["--load-case", "x"]] {
        refused(".", &solve, &[(&[row, &random[..]].concat(), "not provided: --tolerances")]);
    }
    refused(
        ".",
        &["solve"],
        &[
            (&["--case", "two-bars", "--seed", "2"], "--monte-carlo <N>"),
            (&["--batch", "-", "--view", "top"], "--svg <FILE>"),
            (&["--case", "two-bars", "--columns", "--csv", "x.csv"], "not provided: --json"),
        ],
    );
    let sensitivity = ["derivatives", "--case", "two-bars", "--by", "bars.length_m"];
    refused(".", &sensitivity, &[(&["--csv", "x.csv"], "--of <NUMBER>")]);
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("man");
    let _ = std::fs::remove_dir_all(&folder);
    good(".", &["man", "--out", folder.to_str().unwrap()]);
    let page = |name: &str| std::fs::read_to_string(folder.join(format!("{name}.1"))).unwrap();
    let whole = page("funicular");
    let help = stdout(&funicular(&["--help"]));
    let commands = help.lines().skip_while(|line| !line.starts_with("Usage:")).skip(1);
    let names = commands.take_while(|line| *line != "Options:").filter_map(|line| {
        let name = line.strip_prefix("  ")?.split(' ').next()?;
        (!name.is_empty()).then_some(name)
    });
    let mut pages = 0;
    for name in names.filter(|name| *name != "help") {
        assert!(page(&format!("funicular-{name}")).contains(".SH SYNOPSIS"), "{name}");
        assert!(whole.contains(&format!("funicular\\-{name}(1)")), "{name}");
        pages += 1;
    }
    assert!(pages >= 14, "{help}");
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), pages + 1);
    assert!(page("funicular-solve").contains("\\-\\-batch"));
}

/// What the help of a command has to say, wherever its lines are broken.
#[test]
fn the_help_says_what_there_is_to_know() {
    let gone = "130 interrupted; nothing is kept to go on from";
    for (command, says) in [
        ("solve", &[gone][..]),
        ("census", &[gone, "all up to 70, of more the first 70 by energy"]),
        ("reproduce", &[gone]),
        ("trace", &[gone]),
        ("basins", &[gone]),
        ("sweep", &["130 interrupted (Ctrl-C or SIGTERM): what is done stays, --resume goes on"]),
        // It has no --resume.
        ("merge", &["130 interrupted (Ctrl-C or SIGTERM): the same command goes on"]),
        ("judge", &["0 confirmed:", "1 refuted:", "3 undecided:"]),
    ] {
        let help = stdout(&funicular(&[command, "--help"]));
        assert_eq!(help.matches("Exit codes:").count(), 1, "{help}");
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(says.iter().all(|says| help.contains(says)), "{command}: {says:?}: {help}");
    }
}
