//! `funicular sweep`: millions of starts, and where each of them leads.

mod arguments;
mod tables;

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ::sweep::{Manifest, Run, RunSettings, SCHEMA_VERSION, StoreSummary};
use funicular::{Error, system_of, text};
use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use model::system::System;
use serde_json::{Value, json};

pub use self::arguments::Sweep;
pub(crate) use self::arguments::{Format, count};
use crate::cost::tell_time;
use crate::diagnostics::tell;
use crate::exit::{Exit, Failure};
use crate::interrupt::{Interrupt, on_interrupt};
use crate::output;
use crate::progress::Progress;
use crate::threads;

/// How often the progress bar is drawn while nothing is reported.
const TICK: Duration = Duration::from_millis(200);

/// Run the command.
pub fn run(arguments: &Sweep) -> Result<Exit, Failure> {
    let threads = arguments.threads.resolve()?;
    threads::install(threads)?;
    let interrupt = on_interrupt()?;
    let problem = arguments.input.read()?.problem;
    let progress = Progress::start();
    let sweep = funicular::Sweep::new(arguments.seeds)
        .number(arguments.seed)
        .spread(arguments.spread.into())
        .solvers(arguments.solver.into())
        .shard(arguments.shard)
        .angles(arguments.angles)
        .format(arguments.format.into());
    tell_time("this sweep", sweep.expected_time_s(&problem)?);
    progress.say("the list of equilibria");
    let sweep = sweep.prepare(&problem)?;
    drop(progress);
    let folder = Folder {
        manifest: sweep.manifest(),
        system: system_of(&problem),
        out: &arguments.out,
        threads,
        resume: arguments.resume,
        json: arguments.json,
    };
    folder.run(interrupt, &|settings| sweep.write(&arguments.out, settings))
}

/// A folder of rows to be written.
pub(crate) struct Folder<'a> {
    pub manifest: &'a Manifest,
    pub system: Arc<System>,
    pub out: &'a Path,
    pub threads: usize,
    pub resume: bool,
    pub json: bool,
}

impl Folder<'_> {
    /// Write it, with a bar, until it is done or interrupted, and say what it holds.
    pub(crate) fn run(
        &self,
        interrupt: Interrupt,
        write: &dyn Fn(&RunSettings<'_>) -> Result<Run, Error>,
    ) -> Result<Exit, Failure> {
        let manifest = self.manifest;
        tell_cost(manifest);
        let stop = interrupt.keep_what_is_done();
        let all = manifest.range.end - manifest.range.start;
        let bar = seeds_bar(all);
        let start = Instant::now();
        let done = |seeds| bar.inc(seeds);
        let found = |equilibria: usize| {
            let text = format!("{} equilibria found, ", manifest.equilibria.len() + equilibria);
            bar.set_message(text);
        };
        let (threads, resume) = (self.threads, self.resume);
        let settings = RunSettings { threads, resume, stop, done: &done, found: &found };
        let run = write(&settings);
        bar.finish_and_clear();
        let run = run?;
        let seconds = start.elapsed().as_secs_f64();
        for (file, damage) in &run.repaired {
            tell(format_args!("{file} could not be trusted and has been computed again: {damage}"));
        }
        let Some(summary) = &run.summary else {
            tell(format_args!(
                "Stopped: {} of {all} seeds are done and whole in {}. The same command with --resume goes on.",
                run.seeds,
                self.out.display()
            ));
            return Ok(Exit::Interrupted);
        };
        if self.json {
            let mut object = json_object(manifest, summary, self.out);
            let system = &self.system;
            object["system"] = json!({
                "name": system.name(),
                "joints": system.joints().len(),
                "bars": system.members().len(),
                "total_length_m": system.total_length_m(),
                "total_mass_kg": system.total_mass_kg(),
                "gravity_m_s2": system.gravity_m_s2(),
            });
            object["seeds_before"] = json!(run.seeds_before);
            object["seconds"] = json!(seconds);
            print_json(&object)?;
        } else {
            let rate = tables::rate(run.seeds - run.seeds_before, run.seeds, seconds);
            output::print(&(text::sweep::summary(manifest, summary) + &rate + &written(self.out)))?;
        }
        Ok(verdict(manifest, summary))
    }
}

/// So many seeds and more have their cost told beforehand.
const MANY_SEEDS: u64 = 100_000_000;

/// What a large sweep needs.
fn tell_cost(manifest: &Manifest) {
    let seeds = manifest.range.end - manifest.range.start;
    if seeds >= MANY_SEEDS {
        let parts = seeds.div_ceil(manifest.part_seeds.max(1));
        let [least, most] = manifest.expected_bytes().map(|bytes| bytes.div_ceil(1_000_000_000));
        tell(format_args!(
            "{seeds} seeds: {parts} files, {least} to {most} GB in all. It may be stopped; --resume goes on."
        ));
    }
}

/// A bar that counts seeds, with what is found, rate and time left; silent where standard error is no terminal.
pub(crate) fn seeds_bar(seeds: u64) -> ProgressBar {
    let bar = ProgressBar::new(seeds);
    let template =
        "{elapsed:>4} {wide_bar} {human_pos} of {human_len} seeds, {msg}{rate}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.with_key("rate", whole_rate));
    }
    bar.enable_steady_tick(TICK);
    bar
}

/// Seeds a second: a part of a seed says nothing.
fn whole_rate(state: &ProgressState, out: &mut dyn std::fmt::Write) {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it saturates")]
    let rate = state.per_sec().round() as u64;
    // Nobody to tell, as for every part of the bar.
    let _ = write!(out, "{}/s", HumanCount(rate));
}

/// What `--json` prints of a finished sweep.
pub(crate) fn json_object(manifest: &Manifest, summary: &StoreSummary, out: &Path) -> Value {
    json!({
        "schema_version": SCHEMA_VERSION,
        "folder": out.display().to_string(),
        "seeds": { "count": summary.outcomes.seeds(), "range": manifest.range, "of": manifest.seeds },
        "equilibria": summary.equilibria(manifest).collect::<Vec<_>>(),
        "equilibria_complete": manifest.equilibria_complete,
        "equilibria_below_j": summary.listed_below_j(),
        "solvers": tables::solvers_json(manifest, summary),
        "comparisons": tables::comparisons_json(summary),
        "disagreements": summary.outcomes.named_disagreements().collect::<Vec<_>>(),
        "parts": summary.parts.len(),
    })
}

pub(crate) fn print_json(object: &Value) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(object).map_err(|error| {
        Failure::undecided(format!("the summary cannot be written as JSON: {error}"))
    })?;
    output::print(&(text + "\n"))
}

pub(crate) fn written(out: &Path) -> String {
    format!("Rows, manifest.json and summary.json are in {}\n", out.display())
}

/// How a finished sweep ends.
pub(crate) fn verdict(manifest: &Manifest, summary: &StoreSummary) -> Exit {
    if summary.check_failed(manifest) { Exit::CheckFailed } else { Exit::Done }
}
