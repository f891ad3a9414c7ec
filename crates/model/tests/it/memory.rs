//! What is promised of memory and time is kept: memory measured in a process of its own.

#![cfg(target_os = "linux")]

use std::process::Command;
use std::time::{Duration, Instant};

use model::Bar;
use model::budget::{BYTES_PER_EQUAL_MEMBER_READ, BYTES_PER_MEMBER_IN_ROW};
use model::system::{Joint, Member, System};
use model::system_file::{Described, parse};

/// Members in the row.
const COUNT: u64 = 1_000_000;

/// Set for the process that is measured.
const ALONE: &str = "MEMORY_OF_A_ROW_ALONE";

/// Joints by name and a row of bars between them, in 150 bytes.
fn row() -> String {
    format!(
        "joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [600000, 0, 0] }} }}\n\
         bars = [{{ from = \"A\", to = \"B\", length_m = 1, mass_kg = 1, count = {COUNT} }}]\n"
    )
}

/// The most memory that this process has held so far, bytes.
fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() * 1024
}

#[test]
fn a_million_members_are_read_within_the_promise() {
    if std::env::var_os(ALONE).is_none() {
        let me = std::env::current_exe().unwrap();
        let name = "memory::a_million_members_are_read_within_the_promise";
        let status = Command::new(me).args([name, "--exact"]).env(ALONE, "1").status().unwrap();
        assert!(status.success());
        return;
    }
    let before = peak();
    let Described::System(system) = parse(&row(), "row.toml").unwrap() else { panic!("a chain") };
    assert_eq!(system.members().len() as u64, COUNT);
    let each = (peak() - before) / COUNT;
    println!("{each} bytes for each");
    assert!(each <= BYTES_PER_EQUAL_MEMBER_READ, "{each}");
    // Not promised far too much either.
    assert!(10 * BYTES_PER_EQUAL_MEMBER_READ <= 14 * each, "{each}");
}

/// Both solvers need more than the reader: what they need is asked before they begin.
#[test]
fn a_row_is_refused_where_its_solve_has_no_room() {
    if std::env::var_os(ALONE).is_none() {
        let me = std::env::current_exe().unwrap();
        let name = "memory::a_row_is_refused_where_its_solve_has_no_room";
        let status = Command::new(me).args([name, "--exact"]).env(ALONE, "1").status().unwrap();
        assert!(status.success());
        return;
    }
    // Room for names of 12 letters, twice each, beside it.
    model::system_file::limit_memory(COUNT * (BYTES_PER_MEMBER_IN_ROW + 100));
    assert!(parse(&row(), "row.toml").is_ok());
    model::system_file::limit_memory(COUNT * BYTES_PER_MEMBER_IN_ROW);
    let refused = parse(&row(), "row.toml").unwrap_err().to_string();
    let of = format!("bytes of memory are needed; of {}", COUNT * BYTES_PER_MEMBER_IN_ROW);
    assert!(refused.contains(&of), "{refused}");
    // A cable makes it no row of bars.
    model::system_file::limit_memory(COUNT * (BYTES_PER_MEMBER_IN_ROW + 100));
    let refused = parse(&row().replace("count", "kind = \"cable\", count"), "row.toml");
    assert!(refused.unwrap_err().to_string().contains("bytes of memory are needed"));
}

/// The chord of a truss lies in one line between its anchors, and each joint of it is held by what
/// stands on it: looked up, not searched for along the chord. Each joint by each took over half a
/// minute here, and this takes half a second.
#[test]
fn a_long_chord_is_checked_in_proportion() {
    const PANELS: usize = 100_000;
    const PATIENCE: Duration = Duration::from_secs(20);
    let anchor = |k: usize| Joint::anchor(format!("A{k}"), [k as f64, 0.0, 0.0]);
    let mut joints: Vec<Joint> = (0..=PANELS).map(|k| Joint::free(format!("A{k}"))).collect();
    (joints[0], joints[PANELS]) = (anchor(0), anchor(PANELS));
    joints.push(Joint::anchor("T", [0.0, 0.0, 1.0]));
    joints.extend((1..PANELS).map(|k| Joint::free(format!("T{k}"))));
    let mut members = Vec::new();
    let mut bar = |from, to, length_m| {
        members.push(Member::bar(from, to, Bar::homogeneous(length_m, 1.0).unwrap()));
    };
    for k in 0..PANELS {
        let top = PANELS + 1 + k;
        bar(k, k + 1, 1.0);
        bar(top, k + 1, f64::hypot(1.0, 1.0));
        if k > 0 {
            bar(top, k, 1.0);
            bar(top - 1, top, 1.0);
        }
    }
    let system = System::new("a truss", 9.81, joints, members).unwrap();
    let began = Instant::now();
    assert_eq!(system.refusal(), Ok(()));
    assert!(began.elapsed() < PATIENCE, "{:?}", began.elapsed());
}
