//! Files that commands read and write: links, what must not be overwritten, and interruptions.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::run::{
    PROGRAM, Running, fails, fed, folder, limited, names, program, ran, wait_until, words,
};

const SYSTEM: &str = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [1, 0, -1]\n\
                      [[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 3\n";

/// The commands that read a system and write files by name.
const COMMANDS: [(&str, &[&str]); 3] =
    [("solve", &[]), ("census", &[]), ("trace", &["--vary", "bars.1.mass_kg=1,2"])];

/// Both by one descriptor: neither is lost when standard output goes to a file.
#[test]
fn standard_output_has_another_name() {
    let folder = folder("stdout");
    fs::write(folder.join("chain.toml"), SYSTEM).unwrap();
    let out = fs::File::create(folder.join("out")).unwrap();
    let status = Command::new(PROGRAM)
        .args(["solve", "chain.toml", "--csv", "/dev/stdout"])
        .current_dir(&folder)
        .stdout(out)
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(0));
    let text = fs::read_to_string(folder.join("out")).unwrap();
    assert!(text.starts_with("solver,joint,x_m") && text.contains("\nAgreement: agreed"), "{text}");
}

#[test]
fn what_is_read_is_not_overwritten() {
    let folder = folder("overwritten");
    fs::write(folder.join("chain.toml"), SYSTEM).unwrap();
    let bars_file = SYSTEM.split("[[bars]]").next().unwrap();
    fs::write(folder.join("columns.toml"), format!("bars_file = \"bars.csv\"\n{bars_file}"))
        .unwrap();
    let bars = "length_m,mass_kg\n1,1\n1,2\n1,1\n";
    fs::write(folder.join("bars.csv"), bars).unwrap();
    symlink("chain.toml", folder.join("link")).unwrap();
    fs::create_dir(folder.join("deep")).unwrap();
    for (command, more) in COMMANDS {
        let options: &[&str] = if command == "solve" { &["--csv"] } else { &["--csv", "--svg"] };
        for option in options {
            for (file, out) in [
                ("chain.toml", "chain.toml"),
                ("chain.toml", "deep/../chain.toml"),
                ("chain.toml", "link"),
                ("link", "chain.toml"),
                ("columns.toml", "bars.csv"),
            ] {
                let arguments = [&[command, file, option, out][..], more].concat();
                let output = ran(&folder, &arguments);
                assert_eq!(output.status.code(), Some(2), "{arguments:?}");
                let text = words(&output);
                assert!(
                    text.contains(&format!("cannot write {out}: it is"))
                        && text.contains("which is read"),
                    "{text}"
                );
            }
        }
    }
    let output = ran(&folder, &["census", "chain.toml", "--csv", "new", "--svg", "./new"]);
    fails(&output, 2, "is written to the same file");

    // Pictures have names of their own choice.
    for (name, command) in [
        ("lagrange.svg", "basins deep/lagrange.svg --out deep"),
        ("chain-2.svg", "trace deep/chain-2.svg --svg deep/chain.svg --vary bars.1.mass_kg=1,2"),
    ] {
        let path = folder.join("deep").join(name);
        fs::write(&path, SYSTEM).unwrap();
        let mut arguments: Vec<_> = command.split(' ').collect();
        if name == "chain-2.svg" {
            arguments.extend(["--vary", "bars.2.mass_kg=1,2"]);
        }
        let output = ran(&folder, &arguments);
        fails(&output, 2, "which is read");
        assert_eq!(fs::read_to_string(&path).unwrap(), SYSTEM);
        fs::remove_file(path).unwrap();
    }
    assert_eq!(fs::read_to_string(folder.join("chain.toml")).unwrap(), SYSTEM);
    assert_eq!(fs::read_to_string(folder.join("bars.csv")).unwrap(), bars);
    assert_eq!(names(&folder), ["bars.csv", "chain.toml", "columns.toml", "deep", "link"]);
    assert!(names(&folder.join("deep")).is_empty());
}

/// None of these commands would end within a test.
#[test]
fn what_cannot_be_written_is_said_before_the_work() {
    let folder = folder("before");
    let bars: String = (0..20)
        .map(|k| format!("{},1", 0.5 + 0.017 * f64::from(k * k % 23)))
        .collect::<Vec<_>>()
        .join("\n");
    fs::write(folder.join("bars.csv"), format!("length_m,mass_kg\n{bars}")).unwrap();
    fs::write(
        folder.join("chain.toml"),
        "bars_file = \"bars.csv\"\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [4, 0, 1]\n",
    )
    .unwrap();
    fs::write(folder.join("many.toml"), SYSTEM.replace("count = 3", "count = 5_000")).unwrap();
    let vary = ["--vary", "bars.1.mass_kg=1..2:1000"];
    fs::create_dir(folder.join("folder")).unwrap();
    for (out, why) in [("none/out", "there is no folder none"), ("folder", "it is a folder")] {
        for command in [
            vec!["solve", "many.toml", "--system", "full", "--csv", out],
            vec!["census", "chain.toml", "--max-bars", "20", "--csv", out],
            vec!["census", "chain.toml", "--max-bars", "20", "--svg", out],
            [&["trace", "chain.toml", "--csv", out][..], &vary].concat(),
            [&["trace", "chain.toml", "--svg", out][..], &vary].concat(),
        ] {
            let output = ran(&folder, &command);
            assert_eq!(output.status.code(), Some(2), "{command:?}");
            let wanted = format!("cannot write {out}: {why}");
            assert!(words(&output).contains(&wanted), "{command:?}: {}", words(&output));
        }
    }
    fs::create_dir_all(folder.join("out/report.md")).unwrap();
    let output = ran(&folder, &["reproduce", "--out", "out"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(names(&folder.join("out")), ["report.md"], "{}", words(&output));
}

/// The first bytes of standard input are not lost by a look at them.
#[test]
fn bars_come_from_standard_input() {
    let folder = folder("bars");
    let anchors = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [1, 0, -1]\n";
    let text = format!("bars_file = \"/dev/stdin\"\n{anchors}");
    fs::write(folder.join("chain.toml"), text).unwrap();
    let solve = program(&folder, &["solve", "chain.toml"]);
    let output = fed(solve, "length_m,mass_kg\n1,1\n1,2\n1,1\n");
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
}

/// The program, started by an `env` of GNU: a script may have had signals ignored, and its children
/// inherit that.
#[cfg(target_os = "linux")]
fn started(folder: &Path, signals: &str, arguments: &[&str]) -> Running {
    let child = Command::new("env")
        .args(["--default-signal", signals])
        .arg(PROGRAM)
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .spawn();
    Running(child.unwrap())
}

/// Until the file is being written; before the work there is a moment when one stands there empty.
#[cfg(target_os = "linux")]
fn wait_for_bytes(folder: &Path) {
    let growing = |path: PathBuf| {
        path.extension().is_some_and(|extension| extension == "part")
            && fs::metadata(path).is_ok_and(|about| about.len() > 0)
    };
    let any =
        |folder: &Path| fs::read_dir(folder).unwrap().any(|entry| growing(entry.unwrap().path()));
    wait_until("nothing is written", || any(folder));
}

#[cfg(target_os = "linux")]
#[test]
fn an_interruption_leaves_no_part_behind() {
    let folder = folder("interrupted");
    // Their joints are some 30 MB.
    let text = SYSTEM.replace("count = 3", "count = 100_000");
    fs::write(folder.join("chain.toml"), text).unwrap();
    for signal in ["TERM", "INT"] {
        let arguments = ["solve", "chain.toml", "--summary", "--csv", "out.csv"];
        let mut running = started(&folder, "--default-signal", &arguments);
        wait_for_bytes(&folder);
        running.signal(signal);
        assert_eq!(running.code(), Some(130), "{signal}");
        assert_eq!(names(&folder), ["chain.toml"], "{signal}");
    }
}

/// What runs under `nohup` lives on when the terminal is closed.
#[cfg(target_os = "linux")]
#[test]
fn a_hangup_that_is_ignored_is_ignored() {
    let folder = folder("hangup");
    let text = SYSTEM.replace("count = 3", "count = 100_000");
    fs::write(folder.join("chain.toml"), text).unwrap();
    let arguments = ["solve", "chain.toml", "--summary", "--csv", "out.csv"];
    let mut running = started(&folder, "--ignore-signal=HUP", &arguments);
    wait_for_bytes(&folder);
    running.signal("HUP");
    assert_eq!(running.code(), Some(0));
    assert_eq!(names(&folder), ["chain.toml", "out.csv"]);
}

/// What a limit of memory lets through keeps to it, and what it does not is refused before it is
/// made: with less memory than that the program would be stopped.
#[test]
#[cfg(target_os = "linux")]
fn a_limit_of_memory_is_kept() {
    /// What the program is, its threads and their stacks, kB.
    const ITSELF: u64 = 200_000;
    let folder = folder("memory");
    let limited = |limit: &str, kilobytes: u64, file: &str| {
        let script = format!("ulimit -v {kilobytes}; exec \"$@\"");
        let mut command = Command::new("sh");
        command.args(["-c", &script, "sh"]).arg(PROGRAM);
        command.args(["solve", file, "--summary", "--max-memory", limit]);
        // Each thread that has to wait for memory reserves addresses of its own, 64 MB at a time, which are no
        // memory, and more of them on a busy machine.
        command.env("MALLOC_ARENA_MAX", "1").env("RAYON_NUM_THREADS", "2");
        command.current_dir(&folder).output().unwrap()
    };
    let chain = |count: u64| SYSTEM.replace("count = 3", &format!("count = {count}"));
    fs::write(folder.join("chain.toml"), chain(200_000)).unwrap();
    let output = limited("80MB", ITSELF + 80_000, "chain.toml");
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    fs::write(folder.join("longer.toml"), chain(200_001)).unwrap();
    let output = limited("80MB", ITSELF, "longer.toml");
    fails(&output, 2, "200000");
    fs::write(folder.join("most.toml"), chain(20_000_000)).unwrap();
    assert_eq!(limited("1GB", ITSELF, "most.toml").status.code(), Some(2));
    // Lines of nothing, empty arrays, comments.
    for (name, text) in [("lines", "\n"), ("arrays", "[],"), ("comments", "#\n")] {
        let file = format!("{name}.toml");
        let long = text.repeat(2_000_000 / text.len());
        let long = if name == "arrays" { format!("a = [{long}]") } else { long };
        fs::write(folder.join(&file), &long).unwrap();
        let output = limited("200MB", ITSELF + 200_000, &file);
        assert_eq!(output.status.code(), Some(2), "{name}: {}", words(&output));
        assert!(!words(&output).contains("longer than"), "{name}: {}", words(&output));
        fs::write(folder.join(&file), long.repeat(2)).unwrap();
        fails(&limited("200MB", ITSELF, &file), 2, "2500000");
    }
}

/// A full disk is no bad input: the same command may be given again.
#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_undecided() {
    let out = folder("full");
    let output = ran(&out, &["solve", "--case", "two-bars", "--csv", "/dev/full"]);
    fails(&output, 3, "cannot write /dev/full");
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut command = Command::new(PROGRAM);
    let output = command.args(["solve", "--case", "two-bars"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", words(&output));
}

/// The same of the commands that write most: files may be no longer than one block, which stands
/// for a disk that is full.
#[test]
#[cfg(target_os = "linux")]
fn a_disk_that_is_full_in_the_end_is_undecided() {
    let out = folder("full-later");
    for arguments in [
        "trace --case three-equal-bars --vary anchors.end_m.z=-2..-1:9 --csv t.csv",
        "reproduce --out r",
    ] {
        let arguments: Vec<_> = arguments.split(' ').collect();
        fails(&limited(&out, "ulimit -f 1; trap '' XFSZ", &arguments), 3, "cannot write");
    }
    // Nothing is left that looks like a result.
    assert!(!out.join("t.csv").exists() && !out.join("r").join("results.json").exists());
}
