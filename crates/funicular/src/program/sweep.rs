//! `funicular sweep`: millions of starts, and where each of them leads.

mod arguments;
mod tables;

use std::path::Path;
use std::time::{Duration, Instant};

use ::sweep::{
    Axis, Comparison, Manifest, RunSettings, SCHEMA_VERSION, Settings, Shard, Solvers, Source,
    StoreError, StoreSummary, SystemText,
};
use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use miette::miette;
use model::Problem;
use serde_json::{Value, json};

use self::arguments::Spread;
pub use self::arguments::Sweep;
use crate::diagnostics::tell;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::interrupt::on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::threads;
use crate::which::Which;

/// How often the progress bar is drawn while nothing is reported.
const TICK: Duration = Duration::from_millis(200);

/// Run the command.
pub fn run(arguments: &Sweep) -> Result<Exit, Failure> {
    let threads = threads::resolve(arguments.threads)?;
    threads::install(threads)?;
    let problem = input::problem(arguments.file.as_deref(), arguments.case.as_deref())?
        .into_chain("sweep")?;
    let settings = settings(arguments, problem.chain().bars().len())?;
    let progress = Progress::start();
    progress.say("the list of equilibria");
    let solvers = solvers(arguments, &problem)?;
    let sweep = ::sweep::Sweep::new(&problem, settings, solvers)
        .map_err(|error| Failure::bad_input(miette!("{error}")))?;
    drop(progress);
    let manifest = manifest(arguments, &problem, &sweep);
    tell_cost(&manifest);
    let stop = on_interrupt()?;
    let all = manifest.range.end - manifest.range.start;
    let bar = seeds_bar(all);
    let start = Instant::now();
    let run = ::sweep::run(
        &arguments.out,
        &manifest,
        &sweep,
        &RunSettings { threads, resume: arguments.resume, stop, done: &|seeds| bar.inc(seeds) },
    );
    bar.finish_and_clear();
    let run = run.map_err(|error| store_failure(&error))?;
    let seconds = start.elapsed().as_secs_f64();
    for (file, damage) in &run.repaired {
        tell(format_args!("{file} could not be trusted and has been computed again: {damage}"));
    }
    let Some(summary) = &run.summary else {
        tell(format_args!(
            "Stopped: {} of {all} seeds are done and whole in {}. The same command with --resume goes on.",
            run.seeds,
            arguments.out.display()
        ));
        return Ok(Exit::Interrupted);
    };
    let computed = run.seeds - run.seeds_before;
    if arguments.json {
        let mut object = json_object(&manifest, summary, &arguments.out);
        object["system"] = json!(problem.chain().summary());
        object["seeds_before"] = json!(run.seeds_before);
        object["seconds"] = json!(seconds);
        print_json(&object)?;
    } else {
        let rate = tables::rate(computed, run.seeds, seconds);
        output::print(&(tables::summary(&manifest, summary) + &rate + &written(&arguments.out)))?;
    }
    Ok(verdict(&manifest, summary))
}

/// Seeds from which on the cost is told beforehand.
const MANY_SEEDS: u64 = 100_000_000;

/// What a large sweep needs: rows of 6 to 20 bytes for each solver, as those of the named cases have.
fn tell_cost(manifest: &Manifest) {
    let seeds = manifest.range.end - manifest.range.start;
    if seeds >= MANY_SEEDS {
        let rows = seeds * manifest.solvers.len() as u64;
        let gigabytes = |bytes: u64| (rows * bytes).div_ceil(1_000_000_000);
        let parts = seeds.div_ceil(manifest.part_seeds.max(1));
        let (least, most) = (gigabytes(6), gigabytes(20));
        tell(format_args!(
            "{seeds} seeds: {parts} files, {least} to {most} GB in all. It may be stopped; --resume goes on."
        ));
    }
}

fn settings(arguments: &Sweep, bars: usize) -> Result<Settings, Failure> {
    let source = match arguments.source {
        Spread::Uniform => Source::Uniform,
        Spread::Sobol => Source::Sobol,
        Spread::Grid => Source::Grid(vec![Axis::full(grid_points(arguments.seeds, bars)?); bars]),
    };
    Ok(Settings { number: arguments.seed, source, ..Settings::default() })
}

/// The solvers that are asked.
fn solvers(arguments: &Sweep, problem: &Problem) -> Result<Solvers, Failure> {
    let both = funicular::starts::solvers(problem)
        .map_err(|error| Failure::bad_input(miette!("{error}")))?;
    Ok(match arguments.solver {
        Which::Lagrange => both.only(&["lagrange"]),
        Which::Energy => both.only(&["energy"]),
        Which::Both => both,
    })
}

/// Points on each axis of a regular grid with this many points in all.
fn grid_points(seeds: u64, bars: usize) -> Result<u64, Failure> {
    let power = u32::try_from(bars).unwrap_or(u32::MAX);
    let points = |side: u64| side.checked_pow(power);
    // The largest grid that is not larger; a side of two is too much for 64 bars.
    let mut side = 1;
    let mut step = 1_u64 << 40;
    while step > 0 {
        if points(side + step).is_some_and(|points| points <= seeds) {
            side += step;
        }
        step /= 2;
    }
    if points(side) == Some(seeds) {
        return Ok(side);
    }
    let near: Vec<_> = [side, side + 1]
        .into_iter()
        .filter_map(|side| Some(format!("{} = {side}^{bars}", points(side)?)))
        .collect();
    Err(Failure::bad_input(miette!(
        help = format!("the nearest are --seeds {}", near.join(" and ")),
        "a regular grid over the angles of {bars} bars has as many points on each: it cannot have {seeds}"
    )))
}

fn manifest(arguments: &Sweep, problem: &Problem, sweep: &::sweep::Sweep) -> Manifest {
    let bars = problem.chain().bars().len();
    let angles = if arguments.angles { bars } else { 0 };
    Manifest {
        schema_version: SCHEMA_VERSION,
        program: concat!("funicular ", env!("CARGO_PKG_VERSION")).to_owned(),
        system: SystemText::of(problem.chain()),
        seeds: arguments.seeds,
        seed_number: arguments.seed,
        source: arguments.source.to_string(),
        solvers: sweep.solvers().names().map(str::to_owned).collect(),
        angles: (1..=angles).map(|bar| format!("theta_{bar}_rad")).collect(),
        equilibria: sweep.members().list().to_vec(),
        equilibria_complete: sweep.members().complete(),
        equilibria_left_out: sweep.members().left_out(),
        format: arguments.format.to_string(),
        part_seeds: 0,
        shard: Shard::WHOLE,
        range: 0..0,
    }
    .with_shard(arguments.shard)
}

/// A bar that counts seeds, with rate and time left; silent where standard error is no terminal.
pub(crate) fn seeds_bar(seeds: u64) -> ProgressBar {
    let bar = ProgressBar::new(seeds);
    let template = "{elapsed:>4} {wide_bar} {human_pos} of {human_len} seeds, {rate}, {eta} left";
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

/// An error of the folder, with what to do about it. A disk that fails says nothing about the input: the sweep is
/// undecided, and those who run many may try again.
pub(crate) fn store_failure(error: &StoreError) -> Failure {
    let message = error.to_string();
    let report = match error.help() {
        Some(help) => miette!(help = help, "{message}"),
        None => miette!("{message}"),
    };
    if error.may_pass() { Failure::undecided(report) } else { Failure::bad_input(report) }
}

/// Whether a comparison says something of the list rather than of the solvers.
fn is_gap(manifest: &Manifest, comparison: Comparison) -> bool {
    comparison == Comparison::NotListed && !manifest.equilibria_complete
}

/// What `--json` prints of a finished sweep.
pub(crate) fn json_object(manifest: &Manifest, summary: &StoreSummary, out: &Path) -> Value {
    json!({
        "schema_version": SCHEMA_VERSION,
        "folder": out.display().to_string(),
        "seeds": { "count": summary.outcomes.seeds(), "range": manifest.range, "of": manifest.seeds },
        "equilibria": manifest.equilibria,
        "equilibria_complete": manifest.equilibria_complete,
        "equilibria_left_out": manifest.equilibria_left_out,
        "solvers": tables::solvers_json(summary),
        "comparisons": tables::comparisons_json(summary),
        "disagreements": summary.outcomes.named_disagreements().collect::<Vec<_>>(),
        "parts": summary.parts.len(),
    })
}

pub(crate) fn print_json(object: &Value) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(object).map_err(|error| {
        Failure::undecided(miette!("the summary cannot be written as JSON: {error}"))
    })?;
    output::print(&(text + "\n"))
}

/// The tables of a finished sweep.
pub(crate) fn summary_tables(manifest: &Manifest, summary: &StoreSummary) -> String {
    tables::summary(manifest, summary)
}

pub(crate) fn written(out: &Path) -> String {
    format!("Rows, manifest.json and summary.json are in {}\n", out.display())
}

/// A seed that converged to what is in no complete list, or a minimisation that ended elsewhere than in a
/// minimum, is a check that failed. Failures to converge are results, and so is a gap in a list that is not complete.
pub(crate) fn verdict(manifest: &Manifest, summary: &StoreSummary) -> Exit {
    let wrong = summary.outcomes.comparisons().any(|(comparison, count)| {
        count > 0 && comparison.should_not_be() && !is_gap(manifest, comparison)
    });
    let unlisted = ::sweep::Failure::Unlisted as i16;
    let tally = summary.outcomes.tally();
    let mut outcomes = tally.solvers.iter().flat_map(|(_, solver)| solver.0.keys());
    let invented = outcomes.any(|outcome| *outcome == unlisted);
    if wrong || (invented && manifest.equilibria_complete) { Exit::CheckFailed } else { Exit::Done }
}
