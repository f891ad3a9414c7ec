//! The memory that a solve is said to need, `--max-memory`, is what it takes: never less, and not far more.

#![cfg(target_os = "linux")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::run::folder;
use model::budget::{BYTES_PER_MEMBER, BYTES_PER_MEMBER_IN_ROW};
use model::system_file::{BYTES_PER_BAR, BYTES_PER_BAR_OF_FILE};

/// What is said is at most so many tenths of what is measured.
const TENTHS: u64 = 14;

fn peak(folder: &Path, file: &str) -> u64 {
    crate::run::peak(folder, &["solve", file, "--json", "--threads", "2"], 1000)
}

/// What each of so many members takes, beside the program itself, against what is said: not less, and no more
/// than a part of it, in tenths.
fn is_as_said(folder: &Path, file: &str, members: u64, said: u64, tenths: u64) {
    fs::write(folder.join("small.toml"), chain(400)).unwrap();
    let each = peak(folder, file).saturating_sub(peak(folder, "small.toml")) / members;
    println!("{file}: {each} bytes for each member, {said} are said");
    assert!(each <= said, "{file}: {each} bytes, and {said} are said");
    assert!(10 * said <= tenths * each, "{file}: {each} bytes, and {said} are said");
}

fn chain(bars: u64) -> String {
    let across = 3 * bars / 5;
    format!(
        "anchors = {{ start_m = [0, 0, 0], end_m = [{across}, 0, 0] }}\n\
         bars = [{{ length_m = 1, mass_kg = 1, count = {bars} }}]\n"
    )
}

/// Bars enough that what the program takes itself, and whole pages, do not count.
const BARS: u64 = 200_000;

#[test]
fn a_chain_takes_what_is_said() {
    let folder = folder("chain");
    fs::write(folder.join("chain.toml"), chain(BARS)).unwrap();
    is_as_said(&folder, "chain.toml", BARS, BYTES_PER_BAR, TENTHS);
}

/// Bars that are all different have each its numbers in memory.
#[test]
fn a_chain_of_different_bars_takes_what_is_said() {
    let folder = folder("bars");
    let mut bars = "length_m,mass_kg\n".to_owned();
    for k in 0..BARS {
        writeln!(bars, "1.{:03},1.{:02}", k * 7919 % 100, k * 104_729 % 89).unwrap();
    }
    fs::write(folder.join("bars.csv"), bars).unwrap();
    let text = chain(BARS);
    let anchors = text.lines().next().unwrap();
    fs::write(folder.join("bars.toml"), format!("{anchors}\nbars_file = \"bars.csv\"\n")).unwrap();
    is_as_said(&folder, "bars.toml", BARS, BYTES_PER_BAR_OF_FILE, TENTHS);
}

#[test]
fn a_row_between_named_joints_takes_what_is_said() {
    let folder = folder("row");
    let text = format!(
        "joints = {{ left = {{ at_m = [0, 0, 0] }}, right = {{ at_m = [{}, 0, 0] }} }}\n\
         bars = [{{ from = \"left\", to = \"right\", length_m = 1, mass_kg = 1, count = {BARS} }}]\n",
        3 * BARS / 5
    );
    fs::write(folder.join("row.toml"), text).unwrap();
    is_as_said(&folder, "row.toml", BARS, BYTES_PER_MEMBER_IN_ROW, TENTHS);
}

/// A level net of cables with names of its own for all joints, held along its edge.
#[test]
fn a_net_takes_what_is_said() {
    const SIDE: u64 = 80;
    let folder = folder("net");
    let edge = |k: u64| k == 0 || k == SIDE;
    let mut joints = "name,x_m,y_m,z_m,mass_kg\n".to_owned();
    let (mut cables, mut count) = ("from,to,length_m,mass_kg,kind\n".to_owned(), 0);
    for (i, j) in (0..=SIDE).flat_map(|i| (0..=SIDE).map(move |j| (i, j))) {
        match (edge(i), edge(j)) {
            (true, true) => {}
            (false, false) => writeln!(joints, "knot {i} {j},,,,1.{}", (i + 3 * j) % 8).unwrap(),
            _ => writeln!(joints, "knot {i} {j},{},{},0,", 9 * i, 9 * j).unwrap(),
        }
        for (k, l, along_edge) in [(i + 1, j, edge(j)), (i, j + 1, edge(i))] {
            if k <= SIDE && l <= SIDE && !along_edge {
                let (from, to) = (format!("knot {i} {j}"), format!("knot {k} {l}"));
                writeln!(cables, "{from},{to},10.{},0.1,cable", (7 * i + 5 * j) % 9).unwrap();
                count += 1;
            }
        }
    }
    fs::write(folder.join("joints.csv"), joints).unwrap();
    fs::write(folder.join("cables.csv"), cables).unwrap();
    let files = "joints_file = \"joints.csv\"\nbars_file = \"cables.csv\"\n";
    fs::write(folder.join("net.toml"), files).unwrap();
    is_as_said(&folder, "net.toml", count, BYTES_PER_MEMBER, 2 * TENTHS);
}
