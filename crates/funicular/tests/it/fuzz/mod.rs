//! Damaged input of every kind: nothing panics, and nothing false is accepted.
//!
//! A thousand inputs of each kind are always tried, the same ones. With `FUZZ_SECONDS` each kind is
//! tried for so long, with other inputs each time; `.ci/fuzz` does that. What fails is kept in the
//! target folder, and its name is in the message.

mod columns;
mod command_line;
mod foreign;
mod manifest;
mod mutate;
mod system_file;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use mutate::Random;

/// Inputs of a kind, where nobody says how long.
const ALWAYS: u64 = 400;

/// Make inputs of one kind and check each, until the number or the time is up.
fn fuzz<T: AsRef<[u8]>>(kind: &str, make: impl Fn(&mut Random) -> T, check: impl Fn(&T)) {
    let seconds = std::env::var("FUZZ_SECONDS").ok();
    let time = seconds.map(|text| Duration::from_secs_f64(text.parse().expect("FUZZ_SECONDS")));
    let first = match time {
        None => 0,
        Some(_) => SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_secs() << 30,
    };
    let start = Instant::now();
    let mut tried = 0;
    while time.map_or(tried < ALWAYS, |time| start.elapsed() < time) {
        let seed = first + tried;
        let input = make(&mut Random::new(seed));
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| check(&input))) {
            let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{kind}-{seed}"));
            std::fs::write(&path, &input).unwrap();
            eprintln!("{kind}, seed {seed}: the input is in {}", path.display());
            std::panic::resume_unwind(panic);
        }
        tried += 1;
    }
    println!("{kind}: {tried} inputs in {:.1} s", start.elapsed().as_secs_f64());
}
