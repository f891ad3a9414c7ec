//! The chapters of the guide, as they stand in the folder `guide` and in `funicular::guide`.

use std::fmt::Write as _;

use clap::Args;
use funicular::text::markdown::page;

use crate::exit::{Exit, Result};
use crate::output;

/// Names of the chapters, and their text.
pub const CHAPTERS: [(&str, &str); 15] = [
    ("first-steps", include_str!("../../guide/1-first-steps.md")),
    ("systems", include_str!("../../guide/2-systems.md")),
    ("evidence", include_str!("../../guide/3-evidence.md")),
    ("all-equilibria", include_str!("../../guide/4-all-equilibria.md")),
    ("judging", include_str!("../../guide/5-judging.md")),
    ("motion", include_str!("../../guide/6-motion.md")),
    ("large-systems", include_str!("../../guide/7-large-systems.md")),
    ("limits", include_str!("../../guide/8-limits.md")),
    ("speeds", include_str!("../../guide/9-speeds.md")),
    ("methods", include_str!("../../guide/10-methods.md")),
    ("from-python", include_str!("../../guide/11-from-python.md")),
    ("from-rust", include_str!("../../guide/12-from-rust.md")),
    ("commands", include_str!("../../guide/13-commands.md")),
    ("keys", include_str!("../../guide/14-keys.md")),
    ("load-paths", include_str!("../../guide/15-load-paths.md")),
];

/// The chapter for a command.
pub fn chapter_of(command: &str) -> &'static str {
    match command {
        "solve" => "evidence",
        "census" => "all-equilibria",
        "trace" => "load-paths",
        "study" | "page" | "serve" | "convert" => "systems",
        "modes" | "simulate" => "motion",
        "judge" => "judging",
        "sweep" | "basins" | "merge" => "large-systems",
        "derivatives" | "cases" | "new" | "format" => "first-steps",
        _ => "commands",
    }
}

/// Options of `funicular guide`.
#[derive(Debug, Args)]
pub struct Guide {
    /// The chapter; if not given, all are listed
    #[arg(value_parser = clap::builder::PossibleValuesParser::new(CHAPTERS.map(|(name, _)| name)))]
    chapter: Option<String>,
}

/// Print a chapter, or the list of them.
pub fn run(arguments: &Guide) -> Result<Exit> {
    let wanted = arguments.chapter.as_deref();
    let chapter = CHAPTERS.iter().find(|(name, _)| Some(*name) == wanted);
    let text = chapter.map_or_else(list, |(_, text)| page(text));
    output::print(&text)?;
    Ok(Exit::Done)
}

/// The names of the chapters and their titles.
fn list() -> String {
    let mut list = String::from("`funicular guide CHAPTER` prints one of these:\n\n");
    for (name, text) in CHAPTERS {
        let title = text.lines().next().unwrap_or_default().trim_start_matches("# ");
        let _ = writeln!(list, "  {name:<15} {title}");
    }
    list
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn every_command_has_a_chapter_that_names_it() {
        let command = crate::args::Cli::command();
        for sub in command.get_subcommands() {
            let wanted = chapter_of(sub.get_name());
            let (_, text) = CHAPTERS.iter().find(|(name, _)| *name == wanted).expect("a chapter");
            assert!(text.contains(sub.get_name()), "{} in {wanted}", sub.get_name());
        }
    }
}
