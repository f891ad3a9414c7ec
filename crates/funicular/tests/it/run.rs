//! The program, as tests start it, and what they look at.

use std::collections::BTreeMap;
use std::io::{Read, Write as _};
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

/// Where the program is.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_funicular");

/// Patience of a loaded machine.
const LONG: Duration = Duration::from_secs(300);

/// The program in a folder, to be started.
pub fn program(folder: impl AsRef<Path>, arguments: &[&str]) -> Command {
    let mut program = Command::new(PROGRAM);
    program.current_dir(folder).env("NO_COLOR", "1").args(arguments);
    program
}

/// What it leaves behind when it is given an input, within some patience.
pub fn fed(mut program: Command, input: impl AsRef<[u8]> + Send) -> Output {
    program.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    thread::scope(|scope| {
        let mut running = Running(program.spawn().unwrap());
        let Child { stdin, stdout, stderr, .. } = &mut running.0;
        let (mut stdin, mut out, mut err) =
            (stdin.take().unwrap(), stdout.take().unwrap(), stderr.take().unwrap());
        // A program that refuses does not read all.
        scope.spawn(move || drop(stdin.write_all(input.as_ref())));
        let [out, err] = [scope.spawn(move || read(&mut out)), scope.spawn(move || read(&mut err))];
        let status = running.status();
        Output { status, stdout: out.join().unwrap(), stderr: err.join().unwrap() }
    })
}

fn read(from: &mut dyn Read) -> Vec<u8> {
    let mut all = vec![];
    from.read_to_end(&mut all).unwrap();
    all
}

/// What it leaves behind under a limit that a shell sets.
pub fn limited(folder: &Path, limit: &str, arguments: &[&str]) -> Output {
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("{limit}; exec \"$@\""), "sh", PROGRAM]);
    shell.args(arguments).current_dir(folder).output().unwrap()
}

/// A process that ends with the test, however that ends.
pub struct Running(pub Child);

impl Running {
    /// The exit code, within some patience.
    pub fn code(&mut self) -> Option<i32> {
        self.status().code()
    }

    fn status(&mut self) -> ExitStatus {
        let mut status = None;
        wait_until("it does not end", || {
            status = self.0.try_wait().unwrap();
            status.is_some()
        });
        status.unwrap()
    }

    pub fn signal(&self, name: &str) {
        let id = self.0.id().to_string();
        let kill = Command::new("kill").args(["-s", name, &id]).status();
        assert!(kill.unwrap().success());
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The first line that the program says while it begins.
pub fn first_line(folder: &Path, arguments: &[&str]) -> String {
    let mut program = program(folder, arguments);
    let piped = program.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut running = Running(piped.spawn().unwrap());
    let mut line = String::new();
    let mut said = std::io::BufReader::new(running.0.stderr.take().unwrap());
    std::io::BufRead::read_line(&mut said, &mut line).unwrap();
    line
}

/// The most memory that the program has held, bytes, when it has printed so much. It waits for its
/// reader there: an answer is longer than what a pipe holds.
#[cfg(target_os = "linux")]
pub fn peak(folder: impl AsRef<Path>, arguments: &[&str], printed: u64) -> u64 {
    let mut program = program(folder, arguments);
    let piped = program.stdout(Stdio::piped()).stderr(Stdio::null());
    let mut running = Running(piped.spawn().unwrap());
    let mut out = Read::take(running.0.stdout.take().unwrap(), printed);
    assert_eq!(std::io::copy(&mut out, &mut std::io::sink()).unwrap(), printed);
    let status = std::fs::read_to_string(format!("/proc/{}/status", running.0.id())).unwrap();
    let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    most.trim().trim_end_matches(" kB").parse::<u64>().unwrap() * 1024
}

/// Wait until something is so.
pub fn wait_until(otherwise: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < LONG, "{otherwise}");
        thread::sleep(Duration::from_millis(1));
    }
}

/// What it leaves behind.
pub fn ran(folder: impl AsRef<Path>, arguments: &[&str]) -> Output {
    program(&folder, arguments).output().unwrap()
}

/// The same where no file is named.
pub fn funicular(arguments: &[&str]) -> Output {
    ran(".", arguments)
}

/// Exit code, standard output and standard error of the program in a folder.
pub fn run(folder: impl AsRef<Path>, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = ran(folder, arguments);
    (output.status.code(), stdout(&output), stderr(&output))
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// What is told, in one line: long messages are wrapped, in a frame.
pub fn words(output: &Output) -> String {
    let said = stderr(output);
    let words = said.split(|c: char| c.is_whitespace() || c == '│');
    words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// What a command has to refuse as bad input, each with words that it has to say.
#[track_caller]
pub fn refused(folder: impl AsRef<Path>, command: &[&str], table: &[(&[&str], &str)]) {
    for (arguments, wanted) in table {
        let output = ran(&folder, &[command, *arguments].concat());
        let said = words(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(output.stdout.is_empty(), "{arguments:?}: {}", stdout(&output));
        assert!(said.contains(wanted), "{arguments:?}: {said}");
    }
}

/// It ends with this code and says this.
#[track_caller]
pub fn fails(output: &Output, code: i32, wanted: &str) {
    let said = words(output);
    assert_eq!(output.status.code(), Some(code), "{said}");
    assert!(said.contains(wanted), "{said}");
}

/// A text says all of these.
#[track_caller]
pub fn says(text: &str, wanted: &[&str]) {
    for wanted in wanted {
        assert!(text.contains(wanted), "{wanted} is not in\n{text}");
    }
}

/// What is printed where all is well.
#[track_caller]
pub fn good(folder: impl AsRef<Path>, arguments: &[&str]) -> String {
    let output = ran(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    stdout(&output)
}

/// The object that is printed where all is well.
pub fn json(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// An empty folder of this name for a file of tests.
#[track_caller]
pub fn folder(name: &str) -> PathBuf {
    let tests = Path::new(Location::caller().file()).file_stem().unwrap();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(tests).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// A folder of its own with these files, which goes with its owner.
pub fn holding<const N: usize>(files: [(&str, impl AsRef<[u8]>); N]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// The numbers in a column of a table.
pub fn column(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines().map(|line| line.split(','));
    let at = lines.next().unwrap().position(|column| column == name).expect(name);
    lines.map(|mut line| line.nth(at).unwrap().parse().unwrap()).collect()
}

/// The names of what is in a folder.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// The files of a folder by their names.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let file = |name: String| (name.clone(), std::fs::read(folder.join(name)).unwrap());
    names(folder).into_iter().map(file).collect()
}

/// No number of a JSON value is missing: NaN and infinity would come out as null.
pub fn assert_no_null(value: &Value, allowed: &[&str]) {
    match value {
        Value::Array(items) => items.iter().for_each(|item| assert_no_null(item, allowed)),
        Value::Object(map) => {
            for (key, item) in map {
                assert!(!item.is_null() || allowed.contains(&key.as_str()), "{key} is null");
                assert_no_null(item, allowed);
            }
        }
        _ => {}
    }
}
