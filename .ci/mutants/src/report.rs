//! The result as Markdown.

use std::fmt::Write;
use std::process::Command;

use crate::compile::Built;
use crate::judge::Verdict;
use crate::options::Options;
use crate::tests::Test;
use crate::{Failure, Mutant};

/// Of each crate the counts, the bounds of the share of survivors, and the table of survivors.
///
/// # Errors
///
/// Where git does not say the commit.
pub fn written(
    options: &Options,
    all: &[Mutant],
    built: &Built,
    tests: &[Test],
    verdicts: &[Verdict],
) -> Result<String, Failure> {
    let git = Command::new("git").args(["rev-parse", "--short", "HEAD"]).output()?;
    let commit = String::from_utf8(git.stdout)?;
    let mut text = String::new();
    for krate in &options.krates {
        writeln!(text, "# {krate}, {}\n", commit.trim())?;
        of_crate(&mut text, krate, options, all, built, tests, verdicts)?;
    }
    Ok(text)
}

fn of_crate(
    text: &mut String,
    krate: &str,
    options: &Options,
    all: &[Mutant],
    built: &Built,
    tests: &[Test],
    verdicts: &[Verdict],
) -> std::fmt::Result {
    let of = |mutants: &[Mutant]| mutants.iter().filter(|mutant| mutant.krate() == krate).count();
    let verdicts: Vec<_> = verdicts.iter().filter(|v| v.mutant.krate() == krate).collect();
    let foreign =
        |verdict: &Verdict| verdict.noticed_by.is_some_and(|test| test.program.krate != krate);
    let alive = verdicts.iter().filter(|verdict| verdict.noticed_by.is_none()).count();
    let elsewhere = verdicts.iter().filter(|verdict| foreign(verdict)).count();
    let run = verdicts.len();
    let (unswitched, not_compiled) = (of(&built.without_switch), of(&built.not_compiled));
    let drawn = run + unswitched + not_compiled;
    let how = if options.only.is_some() {
        "those of an earlier result".to_owned()
    } else {
        format!("seed {}", options.seed)
    };
    let own = tests.iter().filter(|test| test.program.krate == krate).count();
    writeln!(
        text,
        "{drawn} of {} changes ({how}): {not_compiled} do not compile, {unswitched} stand where no switch can, {run} were run.\n\
         Asked were {own} tests of at most {} s.\n",
        of(all),
        options.limit,
    )?;
    let count = |text: &mut String, who: &str, count: usize| {
        let (low, high) = bounds(count, run);
        let share = 100.0 * count as f64 / run as f64;
        writeln!(text, "{who}: {count}, {share:.1} % (95 %: {low:.1} to {high:.1} %).")
    };
    count(text, "Unnoticed by the crate's own tests", alive + elsewhere)?;
    let others: Vec<&str> = options.packages().filter(|other| *other != krate).collect();
    if !others.is_empty() {
        let who = format!("Unnoticed by these and those of `{}`", others.join("`, `"));
        count(text, &who, alive)?;
    }
    text.push_str("\n| change | tests that reach it | what became of it |\n|---|---|---|\n");
    let prefix = format!("crates/{krate}/src/");
    let mut rows: Vec<_> = verdicts
        .iter()
        .filter(|verdict| verdict.noticed_by.is_none() || foreign(verdict))
        .map(|verdict| {
            let name = verdict.mutant.name.replace(&prefix, "").replace('|', "\\|");
            let fate = verdict.noticed_by.map_or("open".to_owned(), |test| {
                format!("noticed by `{}::{}`", test.program.krate, test.name)
            });
            format!("| `{name}` | {} | {fate} |\n", verdict.reached_by)
        })
        .collect();
    rows.sort();
    text.extend(rows);
    text.push('\n');
    Ok(())
}

/// Wilson's interval of a share, 95 %, in per cent.
fn bounds(count: usize, of: usize) -> (f64, f64) {
    let (z, n) = (1.96, of.max(1) as f64);
    let share = count as f64 / n;
    let centre = share + z * z / (2.0 * n);
    let half = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    let scale = 100.0 / (1.0 + z * z / n);
    ((scale * (centre - half)).max(0.0), scale * (centre + half))
}
