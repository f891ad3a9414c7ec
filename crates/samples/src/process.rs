//! What this process has used so far, where the system tells (Linux).

use std::fs::read_to_string;

/// Processor time of all threads, s, in steps of 10 ms.
pub fn processor_s() -> Option<f64> {
    /// Ticks of the clock in `/proc`.
    const PER_SECOND: f64 = 100.0;
    let told = read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in brackets, may contain spaces; user and system time are the 12th
    // and 13th field after it.
    let mut ticks = told.rsplit_once(')')?.1.split_whitespace().skip(11).map(str::parse::<f64>);
    Some((ticks.next()?.ok()? + ticks.next()?.ok()?) / PER_SECOND)
}

/// Processor time of this thread, s.
pub fn thread_s() -> Option<f64> {
    let told = read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * told.split_whitespace().next()?.parse::<f64>().ok()?)
}

/// The most memory, kB.
pub fn peak_kb() -> Option<u64> {
    let told = read_to_string("/proc/self/status").ok()?;
    let peak = told.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    peak.trim().strip_suffix("kB")?.trim().parse().ok()
}
