//! `funicular cases`: the registry of named cases, and the gallery as pages.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use figures::Escaped;
use funicular::{Page, Problem, picture};
use model::cases;
use rayon::prelude::*;

use crate::case_name::CaseName;
use crate::exit::{Exit, Failure, Result};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::solve;
use crate::tables::table;

/// What stands before the pictures of the gallery.
const HEAD: &str = include_str!("gallery.html");

/// `funicular cases`.
#[derive(Debug, Args)]
pub struct Cases {
    /// Print the system file of this case
    #[arg(value_name = "NAME", value_parser = CaseName, hide_possible_values = true)]
    pub name: Option<String>,
    /// Write the gallery into this folder, new, empty, or with a gallery: `index.html` with a picture of every case, and of each
    /// its page, its file and its answer as JSON
    #[arg(long, value_name = "DIR", conflicts_with = "name")]
    pub html: Option<PathBuf>,
}

/// Run the command.
pub fn run(arguments: &Cases) -> Result<Exit> {
    match (&arguments.name, &arguments.html) {
        (Some(name), _) => output::print(funicular::case_text(name)?)?,
        (None, Some(folder)) => return gallery(folder),
        (None, None) => output::print(&registry())?,
    }
    Ok(Exit::Done)
}

/// The registry: chains and systems.
fn registry() -> String {
    let mut chains = table(["case", "what it is"]);
    for case in cases::all() {
        chains.add_row([case.name, case.about]);
    }
    let mut systems = table(["system of bars", "what it is"]);
    for exhibit in cases::exhibits() {
        systems.add_row([exhibit.name, exhibit.about]);
    }
    format!("{chains}\n\n{systems}\n")
}

/// Solve all cases and write their pages.
fn gallery(folder: &Path) -> Result<Exit> {
    end_on_interrupt()?;
    output::make_folder(folder)?;
    let index = folder.join("index.html");
    let holds = std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some());
    if holds && !std::fs::read_to_string(&index).is_ok_and(|text| text.starts_with(HEAD)) {
        let report = format!("the folder {} is not empty: name a new one", folder.display());
        return Err(Failure::bad_input(report));
    }
    // One that is interrupted is known as a gallery.
    output::write_whole(&index, HEAD)?;
    let progress = Progress::start();
    progress.say("all cases of the gallery");
    let all: Vec<_> = cases::named().collect();
    let shown = all.par_iter().map(|(name, about)| one(folder, name, about));
    let shown = shown.collect::<Result<Vec<_>>>()?;
    drop(progress);
    let mut text = HEAD.to_owned();
    text.extend(shown.iter().map(|(card, _)| card.as_str()));
    text += "</main>\n</body>\n</html>\n";
    output::write_whole(&index, &text)?;
    output::print(&format!("{} cases in {}\n", all.len(), index.display()))?;
    Ok(shown.iter().fold(Exit::Done, |worst, (_, exit)| worst.worse(*exit)))
}

/// Write the page, the file, the answer and the picture of a case, and show them.
fn one(folder: &Path, name: &str, about: &str) -> Result<(String, Exit)> {
    let problem = Problem::case(name)?;
    let page = Page::new().run(&problem)?;
    let answer = page.answer();
    let write = |ending: &str, text: &str| {
        output::write_whole(&folder.join(format!("{name}.{ending}")), text)
    };
    write("html", page.html())?;
    write("toml", funicular::case_text(name)?)?;
    let json = serde_json::to_string_pretty(answer).map_err(|error| output::no_json(&error))?;
    write("json", &(json + "\n"))?;
    let mut card =
        format!("<article id=\"{name}\">\n<h2><a href=\"{name}.html\">{name}</a></h2>\n");
    if let Some(first) = answer.equilibria().first() {
        let seen = picture::Seen::Best;
        let drawn = picture::of_system(&problem.system(), first, seen)
            .map_err(|error| Failure::undecided(format!("no picture of {name}: {error}")))?;
        write("svg", &drawn)?;
        let _ = writeln!(
            card,
            "<a href=\"{name}.html\"><img src=\"{name}.svg\" alt=\"{}\" loading=\"lazy\"></a>",
            Escaped(about)
        );
    }
    let verdict = answer.agreement().map(|agreement| agreement.verdict.to_string());
    let _ = writeln!(
        card,
        "<p>{}</p>\n<p>Both solvers: {}. {}. <a href=\"{name}.toml\">File</a>, <a href=\"{name}.json\">answer</a></p>\n</article>",
        Escaped(about),
        Escaped(&verdict.unwrap_or_default()),
        Escaped(page.contents()),
    );
    Ok((card, solve::verdict(answer)))
}
