//! The first words: commands in groups, what to type when nothing was, and what a word that is no command may mean.

use std::ffi::OsString;
use std::io::Write as _;

use clap::builder::{Resettable, StyledStr};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory, FromArgMatches, Id};

use crate::args::Cli;
use crate::exit::Exit;
use crate::guide;
use crate::tables::wrapped;

/// The commands, by what they are for.
const GROUPS: [(&str, &[&str]); 6] = [
    (
        "Equilibria",
        &["solve", "census", "study", "derivatives", "trace", "page", "serve", "convert"],
    ),
    ("Motion", &["modes", "simulate"]),
    ("Answers of others", &["judge"]),
    ("Many starts", &["sweep", "basins", "merge"]),
    ("The paper", &["reproduce"]),
    ("Files and help", &["cases", "new", "format", "guide", "man", "completions"]),
];

/// What is printed without arguments.
const START: &str = "\
funicular finds where systems of bars, cables and springs come to rest, with
which forces, and how sure that is.

  funicular solve --case lamp   a first answer; `funicular cases` lists others
  funicular new > system.toml   a file of your own; `funicular format`: all keys
  funicular solve system.toml   its equilibrium by two solvers, judged, proved
  funicular census system.toml  every equilibrium, stable or not
  funicular help                all commands; `funicular COMMAND --help`: one
  funicular reproduce           the paper, judged";

/// Words that were tried and are no commands, with what does that.
const MEANT: [(&str, &str); 8] = [
    ("chain", "`funicular new` prints the file of a chain, `funicular solve FILE` solves it"),
    ("system", "`funicular new` prints a system file, `funicular solve FILE` solves it"),
    ("plot", "`funicular solve FILE --svg picture.svg` draws"),
    ("draw", "`funicular solve FILE --svg picture.svg` draws"),
    ("view", "`funicular page FILE --out page.html` shows it from all sides"),
    (
        "animate",
        "`funicular simulate FILE --html motion.html` and `funicular modes FILE --html modes.html` move",
    ),
    ("example", "`funicular cases` lists examples, `funicular cases NAME` prints the file of one"),
    ("gallery", "`funicular cases` lists examples, `funicular cases NAME` prints the file of one"),
];

/// What `solve` and the others say when no file is named.
const NO_FILE: &str =
    "to start: `funicular new > system.toml`, or `--case lamp` (`funicular cases` lists them)";

/// What is said where a parameter is named without its option, or an option without it.
const VALUES: &str =
    "values of a number of the file: `--vary loads=0..1.2`, `--vary bars.1.length_m=1,1.1,1.2`";

/// Words of Rust's own parsers, and plain ones.
const RUST: [(&str, &str); 3] = [
    ("invalid float literal", "a number is required"),
    ("invalid digit found in string", "a whole number is required"),
    ("number too large to fit in target type", "the number is too large"),
];

/// The command line; or how the program ends without one.
pub fn parse() -> Result<Cli, Exit> {
    if std::env::args_os().len() <= 1 {
        say(START);
        return Err(Exit::BadInput);
    }
    let command = with_chapters(grouped(Cli::command()));
    let matches =
        command.clone().try_get_matches_from(asked()).map_err(|error| explained(&error))?;
    // An option may need one that another option excludes: clap then asks for it no longer.
    let needs = without_conflicts(command).try_get_matches_from(asked());
    needs.map_err(|error| explained(&error))?;
    Cli::from_arg_matches(&matches).map_err(|error| explained(&error))
}

/// The commands, with options that exclude none.
fn without_conflicts(command: Command) -> Command {
    command
        .mut_args(|arg| arg.conflicts_with(Resettable::<Id>::Reset))
        .mut_subcommands(without_conflicts)
}

/// The words of the command line. The help of the file format is its page, as it stands: clap would wrap it.
fn asked() -> Vec<OsString> {
    let words: Vec<OsString> = std::env::args_os().collect();
    match &words[..] {
        [program, help, page] if help == "help" && (page == "file" || page == "format") => {
            vec![program.clone(), "format".into()]
        }
        _ => words,
    }
}

/// The commands with their help in groups.
fn grouped(command: Command) -> Command {
    /// Where what a command is for begins.
    const INDENT: usize = 15;
    let about = |name: &str| {
        let found = command.get_subcommands().find(|sub| sub.get_name() == name);
        found.and_then(Command::get_about).map(ToString::to_string).unwrap_or_default()
    };
    let mut text = String::from("{about-with-newline}\n{usage-heading} {usage}\n");
    for (title, names) in GROUPS {
        text.extend(["\n", title, ":\n"]);
        for name in names {
            text += &wrapped(&format!("  {name:<12} {}", about(name)), INDENT);
            text.push('\n');
        }
    }
    text += "\nOptions:\n{options}{after-help}";
    command.help_template(text)
}

/// The commands, each of whose help ends with its chapter of the guide.
pub fn with_chapters(mut command: Command) -> Command {
    let names: Vec<String> =
        command.get_subcommands().map(|sub| sub.get_name().to_owned()).collect();
    for name in names {
        let line = format!("The guide: `funicular guide {}`", guide::chapter_of(&name));
        command = command.mut_subcommand(&name, |sub| {
            let words = |words: Option<&StyledStr>| words.map(ToString::to_string);
            let short = words(sub.get_after_help()).unwrap_or_default();
            let mut long = words(sub.get_after_long_help()).unwrap_or_default();
            if !long.contains(&short) {
                long = format!("{long}\n\n{short}");
            }
            let after = |text: &str| laid_out(format!("{text}\n\n{line}").trim_start());
            sub.after_help(after(&short)).after_long_help(after(&long))
        });
    }
    command
}

/// A text in lines that fit a terminal: sentences one after the other; of a list, which is indented, each item with
/// what follows it below its second column.
fn laid_out(text: &str) -> String {
    const FURTHER: usize = 3;
    let indent = |line: &str| line.len() - line.trim_start().len();
    let mut paragraphs: Vec<String> = Vec::new();
    for line in text.lines() {
        let goes_on = paragraphs.last().is_some_and(|last| {
            !last.is_empty() && !line.is_empty() && !last.ends_with(':') && {
                if indent(last) == 0 {
                    indent(line) == 0
                } else {
                    indent(line) >= indent(last) + FURTHER
                }
            }
        });
        match paragraphs.last_mut().filter(|_| goes_on) {
            Some(last) => *last = format!("{last} {}", line.trim_start()),
            None => paragraphs.push(line.to_owned()),
        }
    }
    let laid = |paragraph: &String| {
        let own = indent(paragraph);
        let gap = paragraph[own..].find("  ").map(|gap| own + gap);
        let column = gap.map(|gap| gap + indent(&paragraph[gap..]));
        wrapped(paragraph, if own == 0 { 0 } else { column.filter(|c| *c < 30).unwrap_or(own + 2) })
    };
    paragraphs.iter().map(laid).collect::<Vec<_>>().join("\n")
}

/// Words for people. Where the terminal is gone there is nobody to read them.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Print what is wrong with the arguments, and what was probably meant.
fn explained(error: &clap::Error) -> Exit {
    if error.kind() == ErrorKind::ValueValidation {
        let text = error.render().to_string();
        let text = RUST.iter().fold(text, |text, (rust, plain)| text.replace(rust, plain));
        say(text.trim_end());
    } else {
        // As in `say`.
        let _ = error.print();
    }
    let word = match error.get(ContextKind::InvalidSubcommand) {
        Some(ContextValue::String(word)) => word.as_str(),
        _ => "",
    };
    if let Some((_, meant)) = MEANT.iter().find(|(name, _)| *name == word) {
        say(&format!("\n{meant}"));
    }
    let args: &[String] = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::Strings(names)) => names,
        Some(ContextValue::String(name)) => std::slice::from_ref(name),
        _ => &[],
    };
    let is_missing = error.kind() == ErrorKind::MissingRequiredArgument;
    let is_unknown = error.kind() == ErrorKind::UnknownArgument;
    let named = |is: fn(&String) -> bool| args.iter().any(is);
    if is_missing && named(|name| name.starts_with("--vary"))
        || is_unknown && named(|name| name.contains('=') && !name.starts_with('-'))
    {
        say(&format!("\n{VALUES}"));
    }
    if is_missing && named(|name| name.contains("FILE") && !name.starts_with('-')) {
        say(&format!("\n{NO_FILE}"));
    }
    if error.use_stderr() { Exit::BadInput } else { Exit::Done }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_stands_in_one_group() {
        let mut grouped: Vec<&str> =
            GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let command = Cli::command();
        let mut commands: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
        grouped.sort_unstable();
        commands.sort_unstable();
        assert_eq!(grouped, commands);
    }

    #[test]
    fn every_help_fits_a_terminal() {
        for command in with_chapters(Cli::command()).get_subcommands() {
            let text = command.get_after_long_help().unwrap().to_string();
            // A word of an example may be longer.
            let long = text.lines().filter(|line| line.len() > 80);
            assert_eq!(long.collect::<Vec<_>>(), [""; 0], "{}", command.get_name());
        }
    }

    #[test]
    fn sentences_and_items_are_laid_out_on_their_own() {
        let text = "One sentence\ngoes on. It is long enough, with a few words more, to be in two lines of a terminal.\n\n\
            Codes:\n  0  done, and all that there is to be said of it is said here in one item of a list\n     that goes on\n  1  not";
        let laid = "One sentence goes on. It is long enough, with a few words more, to be in two\n\
            lines of a terminal.\n\nCodes:\n  0  done, and all that there is to be said of it is said here in one item of a\n     \
            list that goes on\n  1  not";
        assert_eq!(laid_out(text), laid);
    }

    #[test]
    fn no_word_that_is_explained_is_a_command() {
        let command = Cli::command();
        for (word, _) in MEANT {
            assert!(command.find_subcommand(word).is_none(), "{word}");
        }
    }
}
