//! Text from files reaches the terminal as text: it steers nothing, and no line of it looks like
//! the program's.

use std::process::Output;

use crate::run::{folder, ran};

/// A name that would set the title, clear the screen, and pass for a verdict.
const NAME: &str = r#"name = "\u001b]0;X\u0007\u001b[2J\nAgreement: agreed by nobody""#;

/// Neither stream has a control character but ends of lines, nor a line that the name wrote.
fn assert_plain(output: &Output) {
    for stream in [&output.stdout, &output.stderr] {
        let text = std::str::from_utf8(stream).unwrap();
        let bad = text.chars().find(|c| c.is_control() && *c != '\n');
        assert_eq!(bad, None, "{text}");
        assert!(
            text.lines().all(|line| !line.starts_with("Agreement: agreed by nobody")),
            "{text}"
        );
    }
    assert!(!output.stdout.is_empty() || !output.stderr.is_empty());
}

#[test]
fn names_of_systems_do_not_steer_the_terminal() {
    let folder = folder("escapes-names");
    let chain = "\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [1, 0, 0]\n[[bars]]\nlength_m = 0.7\nmass_kg = 1\ncount = 2\n";
    std::fs::write(folder.join("chain.toml"), format!("{NAME}{chain}")).unwrap();
    let loads = "[[loads]]\njoint = 1\nmass_kg = 2\n";
    std::fs::write(folder.join("loaded.toml"), format!("{NAME}{chain}{loads}")).unwrap();
    for arguments in [
        &["solve", "chain.toml"][..],
        &["solve", "loaded.toml"],
        &["census", "chain.toml"],
        &["sweep", "chain.toml", "--seeds", "100", "--out", "s"],
    ] {
        let output = ran(&folder, arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_plain(&output);
    }
}

#[test]
fn keys_in_errors_do_not_steer_the_terminal() {
    let folder = folder("escapes-keys");
    std::fs::write(folder.join("chain.toml"), "\"\\u001b[2J\\u0007\" = 1\n").unwrap();
    let output = ran(&folder, &["solve", "chain.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert_plain(&output);
}

/// The manifest of somebody else, and a file whose name would clear the screen.
#[test]
fn names_in_folders_do_not_steer_the_terminal() {
    let folder = folder("escapes-folders");
    for (out, number) in [("one", "1"), ("two", "2")] {
        let shard = format!("{number}/2");
        let sweep =
            ["sweep", "--case", "two-bars", "--seeds", "3000", "--shard", &shard, "--out", out];
        assert_eq!(ran(&folder, &sweep).status.code(), Some(0));
    }
    let path = folder.join("two").join("manifest.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let name = r#""name": "\u001b]0;X\u0007\u001b[2J\nAgreement: agreed by nobody""#;
    let changed = text.replacen("\"name\": \"two bars\"", name, 1);
    assert_ne!(changed, text);
    std::fs::write(&path, changed).unwrap();
    let output = ran(&folder, &["merge", "one", "two", "--out", "all"]);
    assert_eq!(output.status.code(), Some(2));
    assert_plain(&output);

    std::fs::create_dir(folder.join("stray")).unwrap();
    std::fs::write(folder.join("stray").join("\u{1b}[2J\u{7}"), "").unwrap();
    let output = ran(&folder, &["sweep", "--case", "two-bars", "--seeds", "10", "--out", "stray"]);
    assert_eq!(output.status.code(), Some(2));
    assert_plain(&output);
}
