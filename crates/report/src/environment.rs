//! Where and with what a report was made: the only part of it that differs from run to run.

use serde::Serialize;

/// The packages whose versions matter to the numbers.
const PACKAGES: &str = "argmin argmin-math clarabel nalgebra pulldown-latex rand rand_chacha rayon";

/// The versions that the program is built from.
const LOCK: &str = include_str!(concat!(env!("OUT_DIR"), "/Cargo.lock"));

/// Where and with what.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Environment {
    /// The command, without the folder of the program.
    pub command: String,
    /// Version of this program.
    pub version: &'static str,
    /// The compiler.
    pub compiler: &'static str,
    /// Name and version of the packages that the numbers rest on.
    pub packages: Vec<String>,
    /// Operating system and instruction set.
    pub system: String,
    /// The processor, where the system says it.
    pub processor: String,
    /// Threads that it runs at a time.
    pub threads: usize,
}

impl Environment {
    /// This machine and this program, called with these arguments (the first is its name).
    pub fn here(mut arguments: impl Iterator<Item = String>) -> Self {
        let name = arguments.next().unwrap_or_default();
        let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
        let command: Vec<String> = [name.to_owned()].into_iter().chain(arguments).collect();
        Self {
            command: command.join(" "),
            version: env!("CARGO_PKG_VERSION"),
            compiler: env!("REPORT_COMPILER"),
            packages: PACKAGES
                .split(' ')
                .flat_map(|name| versions(name).map(move |version| format!("{name} {version}")))
                .collect(),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            processor: processor().unwrap_or_else(|| "not known".to_owned()),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
        }
    }
}

/// The versions of a package in the lock file.
fn versions(name: &str) -> impl Iterator<Item = &'static str> {
    let named = format!("name = \"{name}\"");
    let mut lines = LOCK.lines();
    std::iter::from_fn(move || {
        lines.find(|line| *line == named)?;
        lines.next()?.strip_prefix("version = \"")?.strip_suffix('"')
    })
}

/// The processor as Linux names it.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
