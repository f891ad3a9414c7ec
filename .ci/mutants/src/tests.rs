//! Which tests there are, what each takes and which changes it reaches.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use crate::Failure;
use crate::compile::Program;
use crate::options::Options;

pub struct Test<'a> {
    pub program: &'a Program,
    pub name: String,
    pub seconds: f64,
    pub reaches: BTreeSet<u32>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    Passed,
    Failed,
    TimedOut,
}

/// All tests that pass within the limit, quickest first. Each runs alone.
///
/// # Errors
///
/// Where a program cannot be run.
pub fn traced<'a>(programs: &'a [Program], options: &Options) -> Result<Vec<Test<'a>>, Failure> {
    let mut names = Vec::new();
    for program in programs {
        let list = command(program).args(["--list", "--format", "terse"]).output()?;
        let list = String::from_utf8(list.stdout)?;
        let tests = list.lines().filter_map(|line| line.strip_suffix(": test"));
        let skipped = |name: &&str| {
            !options.krates.contains(&program.krate)
                && options.skip.iter().any(|word| name.contains(word))
        };
        names.extend(tests.filter(|name| !skipped(name)).map(|name| (program, name.to_owned())));
    }
    eprintln!("{} tests", names.len());
    let tests = parallel(options.jobs, &names, |k, (program, name)| {
        let own = options.krates.contains(&program.krate);
        let limit = if own { options.limit } else { options.also_limit };
        let file = options.work.join(format!("trace-{k}"));
        let test = trace(program, name, &file, limit);
        let _ = std::fs::remove_file(&file);
        test
    })?;
    let mut tests: Vec<Test> = tests.into_iter().flatten().collect();
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    Ok(tests)
}

fn trace<'a>(
    program: &'a Program,
    name: &str,
    file: &Path,
    limit: f64,
) -> Result<Option<Test<'a>>, Failure> {
    let began = Instant::now();
    let outcome = run(program, name, "MUTANT_TRACE", file.as_os_str(), limit)?;
    if outcome != Outcome::Passed {
        let why = if outcome == Outcome::Failed { "fails" } else { "takes too long" };
        eprintln!("not asked, {why}: {} {name}", program.krate);
        return Ok(None);
    }
    let seconds = began.elapsed().as_secs_f64();
    let reached = std::fs::read_to_string(file).unwrap_or_default();
    let reaches = reached.lines().map(str::parse).collect::<Result<_, _>>()?;
    Ok(Some(Test { program, name: name.to_owned(), seconds, reaches }))
}

/// One test with a variable of the environment, killed after `limit` seconds.
pub fn run(
    program: &Program,
    name: &str,
    variable: &str,
    value: &std::ffi::OsStr,
    limit: f64,
) -> Result<Outcome, Failure> {
    let mut child = command(program)
        .args(["--exact", name, "--test-threads", "1"])
        .env(variable, value)
        .env("EXACT_WORK", "1")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()?;
    waited(&mut child, Duration::from_secs_f64(limit))
}

fn waited(child: &mut Child, limit: Duration) -> Result<Outcome, Failure> {
    let began = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(if status.success() { Outcome::Passed } else { Outcome::Failed });
        }
        if began.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            return Ok(Outcome::TimedOut);
        }
        std::thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(50));
    }
}

/// A change may ask for all memory there is, so each program gets 6 GB.
fn command(program: &Program) -> Command {
    let mut command = Command::new("sh");
    command
        .args(["-c", "ulimit -v 6000000; exec \"$0\" \"$@\""])
        .arg(&program.file)
        .current_dir(&program.folder)
        .env("CARGO_MANIFEST_DIR", &program.folder);
    command
}

/// The results in the order of the items.
pub fn parallel<'a, T: Sync, R: Send>(
    jobs: usize,
    items: &'a [T],
    work: impl Fn(usize, &'a T) -> Result<R, Failure> + Sync,
) -> Result<Vec<R>, Failure> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, Relaxed);
                    let Some(item) = items.get(k) else { return };
                    let result = work(k, item);
                    done.lock().expect("no worker panics").push((k, result));
                }
            });
        }
    });
    let mut done = done.into_inner().map_err(|_| "a worker panicked")?;
    done.sort_by_key(|(k, _)| *k);
    done.into_iter().map(|(_, result)| result).collect()
}
