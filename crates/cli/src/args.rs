//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

const EXIT_CODES: &str = "\
Exit codes:
  0  done, and every check agreed
  1  a check failed: the solvers disagree, or a claim came out otherwise than expected
  2  bad input or usage
  3  not converged, or not decided";

const EXAMPLES: &str = "\
Examples:
  funicular reproduce                        the paper, judged, in the terminal
  funicular reproduce --out report           the same as report/report.md and report/results.json
  funicular solve chain.toml                 the shape and the forces of a chain of your own
  funicular solve --case ten-equal-bars --json | jq .agreement
  funicular completions bash > ~/.local/share/bash-completion/completions/funicular";

/// Where does a chain of rigid bars come to rest under its own weight, and how sure can we be?
///
/// Every equilibrium is found twice, by two solvers that share no mechanics (Lagrange multipliers;
/// potential energy), and judged by a third party that knows only Newton's laws.
#[derive(Debug, Parser)]
#[command(name = "funicular", version, after_help = EXIT_CODES, after_long_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Reproduce the paper: its claims, what both solvers find, and the verdicts
    #[command(after_help = EXIT_CODES)]
    Reproduce(Reproduce),
    /// Find the hanging equilibrium of a system file by both solvers, and compare them
    #[command(after_help = EXIT_CODES)]
    Solve(Solve),
    /// Find every equilibrium of a chain, stable or not, and prove that there is no other
    #[command(after_help = EXIT_CODES)]
    Census(crate::census::Census),
    /// Run millions of starts through the solvers: which start leads where
    Sweep(crate::sweep::Sweep),
    /// Join the shards of a sweep, and prove that nothing is missing or double
    Merge(crate::merge::Merge),
    /// Follow all equilibria over a parameter: branches, folds, exchanges of stability
    Trace(crate::trace::Arguments),
    /// Draw which start leads where, by both solvers
    Basins(crate::basins::Arguments),
    /// List the named cases, or print the system file of one (a start for a file of your own)
    Cases(Cases),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// `funicular reproduce`.
#[derive(Debug, Args)]
pub struct Reproduce {
    /// Write report.md and results.json into this folder (made if it is not there)
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print the results as one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}

/// `funicular solve`.
#[derive(Debug, Args)]
pub struct Solve {
    /// The system file (TOML); see `funicular cases three-equal-bars` for one
    #[arg(value_name = "FILE", required_unless_present = "case")]
    pub file: Option<PathBuf>,
    /// Solve a named case instead of a file
    #[arg(long, value_name = "NAME", conflicts_with = "file")]
    pub case: Option<String>,
    /// Which solver; one alone gets no comparison
    #[arg(long, value_enum, default_value_t = Which::Both)]
    pub solver: Which,
    /// Which equations lagrange solves
    #[arg(long, value_enum, default_value_t = System::Auto)]
    pub system: System,
    /// Print one JSON object (schema_version 1) instead of tables
    #[arg(long)]
    pub json: bool,
    /// Leave out the arrays over joints and bars
    #[arg(long)]
    pub summary: bool,
    /// Write joints and forces, a line per joint, to this CSV file
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

/// Which solvers to ask.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Which {
    /// Forces first: constraints and multipliers
    Lagrange,
    /// Energy first: minimisation
    Energy,
    /// Both, and the comparison
    Both,
}

/// Which of the systems of equations `lagrange` solves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum System {
    /// The full one up to 30 bars, the condensed one beyond
    Auto,
    /// The paper's: all coordinates and all multipliers at once
    Full,
    /// Three equations for the pull on the first anchor, whatever the number of bars
    Condensed,
}

/// `funicular cases`.
#[derive(Debug, Args)]
pub struct Cases {
    /// Print the system file of this case
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        super::Cli::command().debug_assert();
    }
}
