//! `funicular sweep`: millions of starts, and where each of them leads.

mod arguments;

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ::sweep::{Manifest, Run, RunSettings, SCHEMA_VERSION, StoreSummary};
use funicular::{Error, Summary, text};
use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use model::system::System;
use serde_json::{Value, json};

pub use self::arguments::Sweep;
pub(crate) use self::arguments::{Rows, count};
use crate::cost::tell_time;
use crate::diagnostics::tell;
use crate::exit::{Exit, Result};
use crate::interrupt::Interrupt;
use crate::output;
use crate::progress::Progress;
use crate::tables::short;

/// How often the progress bar is drawn while nothing is reported.
const TICK: Duration = Duration::from_millis(200);

/// Run the command.
pub fn run(arguments: &Sweep) -> Result<Exit> {
    let rows = &arguments.rows;
    let begun = rows.begin()?;
    let problem = arguments.input.read()?.problem;
    let progress = Progress::start();
    let sweep = funicular::Sweep::new(arguments.seeds)
        .number(rows.seed)
        .spread(arguments.spread)
        .solvers(arguments.solver)
        .shard(rows.shard)
        .angles(arguments.angles)
        .format(rows.format);
    tell_time("this sweep", sweep.expected_time_s(&problem)?);
    progress.say("the list of equilibria");
    let sweep = sweep.prepare(&problem)?;
    drop(progress);
    let (manifest, system, out) = (sweep.manifest(), problem.system(), &arguments.out);
    let folder = Folder { manifest, system, out, rows };
    folder.run(begun, &|settings| sweep.write(&arguments.out, settings))
}

/// A folder of rows to be written.
pub(crate) struct Folder<'a> {
    pub manifest: &'a Manifest,
    pub system: Arc<System>,
    pub out: &'a Path,
    pub rows: &'a Rows,
}

impl Folder<'_> {
    /// Write it, with a bar, until it is done or interrupted, and say what it holds.
    pub(crate) fn run(
        &self,
        (threads, interrupt): (usize, Interrupt),
        write: &dyn Fn(&RunSettings<'_>) -> Result<Run, Error>,
    ) -> Result<Exit> {
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
        let resume = self.rows.resume;
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
        if self.rows.json {
            let mut object = json_object(manifest, summary, self.out);
            object["system"] = json!(Summary::new(&self.system));
            object["seeds_before"] = json!(run.seeds_before);
            object["seconds"] = json!(seconds);
            output::print_json(&object)?;
        } else {
            let rate = rate(run.seeds - run.seeds_before, run.seeds, seconds);
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
    let mut object = json!({
        "schema_version": SCHEMA_VERSION,
        "folder": out.display().to_string(),
        "seeds": { "count": summary.outcomes.seeds(), "range": manifest.range, "of": manifest.seeds },
        "equilibria": summary.equilibria(manifest).collect::<Vec<_>>(),
        "equilibria_complete": manifest.equilibria_complete,
        "equilibria_below_j": summary.listed_below_j(),
        "parts": summary.parts.len(),
    });
    if let (Value::Object(all), Value::Object(found)) =
        (&mut object, text::sweep::object(manifest, &summary.outcomes))
    {
        all.extend(found);
    }
    object
}

/// How fast it was; nothing was computed if everything was there, or if there is nothing to
/// compute.
fn rate(computed: u64, all: u64, seconds: f64) -> String {
    if all == 0 {
        return "This shard is empty: there are more shards than parts.\n".to_owned();
    }
    if computed == 0 {
        return "Everything was there already.\n".to_owned();
    }
    let rate = computed as f64 / seconds.max(f64::MIN_POSITIVE);
    format!("{computed} seeds in {seconds:.1} s: {} a second, written\n", short(rate.round()))
}

pub(crate) fn written(out: &Path) -> String {
    format!("Rows, manifest.json and summary.json are in {}\n", out.display())
}

/// How a finished sweep ends.
pub(crate) fn verdict(manifest: &Manifest, summary: &StoreSummary) -> Exit {
    if summary.check_failed(manifest) { Exit::CheckFailed } else { Exit::Done }
}
