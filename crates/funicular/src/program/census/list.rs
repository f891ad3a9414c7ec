//! What is listed of many equilibria.

use census::{Estimate, Settings};
use funicular::LargeCensusAnswer;
use funicular::census::List;

use crate::census::{Census, SHAPES, how_far, refuse as refuse_census};
use crate::diagnostics::{Diagnostic, tell};
use crate::exit::{Exit, Failure, Result};
use crate::output;
use crate::progress::Progress;

/// Bytes of JSON up to which everything is listed without being asked for. The help of `--list`
/// says so.
const UNASKED: f64 = 1e8;

/// Bytes of JSON for everything of one bar of an equilibrium, and for an equilibrium in a line
/// without its signs; measured on chains of 13 to 20 bars.
const FULL_BYTES: f64 = 1_600.0;
const LINE_BYTES: f64 = 230.0;

/// Refuse what would fill a disk.
pub fn refuse(arguments: &Census, bars: usize, estimate: Estimate) -> Result<()> {
    if !arguments.printed.is_json() && arguments.csv.is_none() {
        return Ok(());
    }
    let [signs, full] =
        [LINE_BYTES + bars as f64, FULL_BYTES * bars as f64].map(|each| each * estimate.equilibria);
    let most = arguments.max_output as f64;
    let bytes = if arguments.list == Some(List::Full) { full } else { signs };
    if bytes <= most {
        return Ok(());
    }
    let help = if full > most && signs <= most {
        format!(
            "--list signs lists each equilibrium in a line, {} together; --max-output {} takes it all the same",
            size(signs),
            gigabytes(bytes)
        )
    } else {
        format!(
            "--max-output {} takes it all the same; without --json and --csv there is no list",
            gigabytes(bytes)
        )
    };
    let message = format!(
        "the list of some {:.0e} equilibria would take about {}; the limit is {}",
        estimate.equilibria,
        size(bytes),
        size(most)
    );
    Err(Failure::bad_input(Diagnostic::from(message).with_help(help)))
}

/// A limit that is certainly large enough, for an estimate that is good to a factor of two.
fn gigabytes(bytes: f64) -> String {
    format!("{:.0}GB", (2.0 * bytes / 1e9).ceil())
}

fn size(bytes: f64) -> String {
    match bytes {
        ..1e6 => format!("{:.0} kB", bytes / 1e3),
        1e6..1e9 => format!("{:.0} MB", bytes / 1e6),
        1e9..1e10 => format!("{:.1} GB", bytes / 1e9),
        _ => format!("{:.0} GB", bytes / 1e9),
    }
}

/// The census of a row of bars that may have many equilibria.
pub fn of_many(
    arguments: &Census,
    settings: Settings,
    problem: &funicular::Problem,
    progress: Progress,
) -> Result<Exit> {
    let answer = funicular::Census::new()
        .settings(settings)
        .run_large(problem, SHAPES, &|now| progress.say(&how_far(now)))
        .map_err(refuse_census)?;
    if let Some(path) = &arguments.svg {
        output::write_picture(path, &answer.proven.figure(problem.name(), SHAPES))?;
    }
    let list = listed(arguments, &answer);
    if let Some(path) = &arguments.csv {
        progress.say("writing the list");
        output::write_stream(path, |file| answer.write_csv(list, file))?;
    }
    drop(progress);
    if arguments.printed.is_json() {
        output::print_stream(|out| answer.write_json(list, out))?;
    } else {
        output::print(&answer.to_string())?;
    }
    let census = &answer.first.census;
    Ok(Exit::of(census.check_failed(), census.is_decided()))
}

/// What is listed: what is asked for, else everything that is not too large.
fn listed(arguments: &Census, answer: &LargeCensusAnswer) -> List {
    if let Some(list) = arguments.list {
        return list;
    }
    let full = answer.expected_bytes(List::Full);
    if full <= UNASKED {
        return List::Full;
    }
    if arguments.printed.is_json() || arguments.csv.is_some() {
        tell(format_args!(
            "Each equilibrium is listed by its signs and its pull (--list signs), {} together; everything (--list \
             full) would be {}.",
            size(answer.expected_bytes(List::Signs)),
            size(full)
        ));
    }
    List::Signs
}

#[cfg(test)]
mod tests {
    use super::{gigabytes, size};

    #[test]
    fn sizes_are_read_easily() {
        let sizes = [2.4e4, 3.2e7, 1.25e9, 1.84e10].map(size);
        assert_eq!(sizes, ["24 kB", "32 MB", "1.2 GB", "18 GB"]);
        assert_eq!([1.3e9, 1.8e10].map(gigabytes), ["3GB", "36GB"]);
    }
}
