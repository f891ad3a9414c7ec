//! The result as Markdown.

use std::fmt::Write;
use std::process::Command;

use crate::Failure;
use crate::compile::Built;
use crate::judge::Verdict;
use crate::options::Options;
use crate::tests::Test;

/// Counts, the bounds of the share of survivors, and the table of survivors.
///
/// # Errors
///
/// Where git does not say the commit.
pub fn written(
    options: &Options,
    all: usize,
    built: &Built,
    tests: &[Test],
    verdicts: &[Verdict],
) -> Result<String, Failure> {
    let git = Command::new("git").args(["rev-parse", "--short", "HEAD"]).output()?;
    let commit = String::from_utf8(git.stdout)?;
    let foreign = |verdict: &Verdict| {
        verdict.noticed_by.is_some_and(|test| test.program.krate != options.krate)
    };
    let alive = verdicts.iter().filter(|verdict| verdict.noticed_by.is_none()).count();
    let elsewhere = verdicts.iter().filter(|verdict| foreign(verdict)).count();
    let run = verdicts.len();
    let mut text = format!("# {}, {}\n\n", options.krate, commit.trim());
    let drawn = run + built.without_switch.len() + built.not_compiled.len();
    let how = if options.only.is_some() {
        "those of an earlier result".to_owned()
    } else {
        format!("seed {}", options.seed)
    };
    writeln!(
        text,
        "{drawn} of {all} changes ({how}): {} do not compile, {} stand where no switch can, {run} were run.\n\
         Asked were {} tests of at most {} s.\n",
        built.not_compiled.len(),
        built.without_switch.len(),
        tests.len(),
        options.limit,
    )?;
    let count = |text: &mut String, who: &str, count: usize| {
        let (low, high) = bounds(count, run);
        let share = 100.0 * count as f64 / run as f64;
        writeln!(text, "{who}: {count}, {share:.1} % (95 %: {low:.1} to {high:.1} %).")
    };
    count(&mut text, "Unnoticed by the crate's own tests", alive + elsewhere)?;
    if !options.also.is_empty() {
        let also = options.also.join("`, `");
        count(&mut text, &format!("Unnoticed by these and those of `{also}`"), alive)?;
    }
    text.push_str("\n| change | tests that reach it | what became of it |\n|---|---|---|\n");
    let prefix = format!("crates/{}/src/", options.krate);
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
    Ok(text)
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
