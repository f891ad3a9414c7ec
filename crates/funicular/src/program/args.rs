//! The command line.

use clap::{Parser, Subcommand};
use clap_complete::Shell;

/// How commands end, with what an interruption leaves.
macro_rules! exit_codes {
    ($failed:literal, $last:literal) => {
        concat!(
            "Exit codes:\n  \
               0  done, and every check agreed\n  \
               1  a check failed: ",
            $failed,
            "\n  \
               2  bad input or usage\n  \
               3  not converged, not decided, or not written (the disk is full)\n",
            $last
        )
    };
}

/// Of the program.
const EXIT_CODES: &str = exit_codes!(
    "the solvers disagree, or a claim of `reproduce` came out otherwise than expected",
    "130  interrupted; what `sweep` and `merge` have done is kept, to go on from"
);

/// Of the commands that begin from the start.
const ALL_OR_NOTHING: &str = exit_codes!(
    "the solvers disagree",
    "130  interrupted; nothing is kept to go on from, and no file is half written"
);

/// Of `solve`, which takes several systems.
const OF_SEVERAL: &str = exit_codes!(
    "the solvers disagree",
    "  of several systems the worst: 1 before 2 before 3\n\
     130  interrupted; nothing is kept to go on from, and no file is half written"
);

/// Of `reproduce`.
const OF_CLAIMS: &str = exit_codes!(
    "a claim came out otherwise than expected",
    "130  interrupted; nothing is kept to go on from, and no file is half written"
);

const EXAMPLES: &str = "\
Examples:
  funicular reproduce                        the paper, judged, in the terminal
  funicular reproduce --out report           the same as report/report.html, report.md and results.json
  funicular new > chain.toml                 a system file to start from
  funicular format | less                    every key of a system file
  funicular solve chain.toml                 the shape and the forces of a chain of your own
  funicular solve --case ten-equal-bars --json | jq .agreement
  funicular solve --batch systems.jsonl > answers.jsonl    a system in every line, an answer in every line
  funicular judge net.toml --answer theirs.csv --html verdict.html    somebody else's answer, judged
  funicular census chain.toml --svg shapes.svg   every equilibrium, and the proof that there is no other
  funicular sweep chain.toml --seeds 1000000 --out starts    which start leads where
  funicular study chain.toml --vary anchors.end_m.x=0.5..2.6:50 --svg sag.svg
  funicular trace chain.toml --vary anchors.end_m.z=-2.9..-0.1:200 --svg diagram.svg
  funicular modes chain.toml                 frequencies, and rates of leaving
  funicular simulate chain.toml --from seed:7 --damping 0.5 --html motion.html    released, it comes to rest
  funicular completions bash > ~/.local/share/bash-completion/completions/funicular";

/// Where does a system of bars, cables and springs come to rest, and how sure can we be?
///
/// Where a system comes to rest is found twice, by two solvers that share no mechanics (Lagrange multipliers;
/// potential energy), and judged by a third party that knows only Newton's laws.
///
/// Scope: bars, cables and struts between joints without friction, rigid or with a stiffness, in
/// space, at rest or in motion under their weight, masses at joints and constant forces, above a
/// flat floor; no other contact and no bending. All commands take any such system, but for `census`,
/// which takes what has few closures; `trace` follows all equilibria of chains, and load paths of any.
#[derive(Debug, Parser)]
#[command(name = "funicular", version, after_help = EXIT_CODES, after_long_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Refuse what would need more memory: 80 bytes for each byte of a system file, 120 for each of
    /// an answer in JSON, 400 for each bar of a chain (640 where bars are in a file of their own),
    /// 400 for each in another row of rigid bars between two anchors, 5000 for each member of another
    /// system (640 of them while it is read) and of any that moves, is varied or has derivatives, 7000
    /// and 100 for each mode with `modes`, and twice its name for each joint. A line of a batch may need all of it. A sweep needs 50 MB
    /// for each thread, basins 50 bytes for each start, a trace what its --max-points says. If not
    /// given, 24 GB, files of 64 MiB and 20 million bars
    #[arg(long, value_name = "SIZE", global = true, hide_short_help = true, value_parser = crate::memory::parse)]
    pub max_memory: Option<u64>,
    /// Work that each solver may do for one system: numbers in all factors of its matrices, or bars
    /// times passes over a row between two anchors, which is iterations times size. What needs more
    /// ends without an answer (exit code 3). If not given, 10000000000: up to an hour or so
    #[arg(long, value_name = "N", global = true, hide_short_help = true, value_parser = crate::memory::work)]
    pub max_work: Option<std::num::NonZeroU64>,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Reproduce the paper: its claims, what both solvers find, and the verdicts
    #[command(after_help = OF_CLAIMS)]
    Reproduce(crate::reproduce::Reproduce),
    /// Find the hanging equilibrium of a system file by both solvers, and compare them
    ///
    /// Supported are bars, cables and struts between joints without friction, rigid or with a
    /// stiffness, in space, at rest under their weight, masses at joints and constant forces, above
    /// a flat floor without friction; not supported are friction, other contact, bending and damping. A
    /// file is a chain between two anchors, or joints by name with members between them
    /// (`funicular cases footbridge` prints one).
    ///
    /// One answer is printed whole, the other solver's compared with it. Time and memory grow with
    /// the number of bars: a chain of a million takes some 5 s, and 600 bytes each.
    #[command(after_help = OF_SEVERAL)]
    Solve(crate::solve::Solve),
    /// Find every equilibrium, stable or not, and prove that there is no other
    #[command(after_help = ALL_OR_NOTHING)]
    Census(crate::census::Census),
    /// Judge joint positions, and forces if there are some, from any program: what is broken, and
    /// how large the error is
    ///
    /// Reads answers as JSON, CSV and VTU, and systems of our own files, DXF, OBJ, MoorDyn, MAP++,
    /// OpenSees, COMPAS and the force density method.
    Judge(crate::judge::Judge),
    /// Run millions of starts through the solvers: which start leads where
    Sweep(crate::sweep::Sweep),
    /// Join the shards of a sweep, and prove that nothing is missing or double
    Merge(crate::merge::Merge),
    /// Solve a chain or a system over numbers of its file: sag, forces and angles of the hanging
    /// shape
    Study(crate::study::Arguments),
    /// Derivatives of the hanging shape: stiffness of anchors, gradients by all parameters
    Derivatives(crate::derivatives::Arguments),
    /// Follow equilibria over a parameter: load paths, branches, limit points, exchanges of stability
    Trace(crate::trace::Arguments),
    /// Write a page to look at a system: turn it, choose an equilibrium, a load case, a mode, and move
    /// along a load path
    #[command(after_help = ALL_OR_NOTHING)]
    Page(crate::page::Arguments),
    /// Change a system in the browser, its file and its shape side by side
    #[command(after_help = ALL_OR_NOTHING)]
    Serve(crate::serve::Arguments),
    /// Write the equilibrium as a file for ParaView, CAD, 3D programs, MuJoCo, MoorDyn or COMPAS, or
    /// the system as a file of ours
    #[command(after_help = ALL_OR_NOTHING)]
    Convert(crate::convert::Arguments),
    /// Draw which start leads where, by both solvers
    Basins(crate::basins::Arguments),
    /// Find the frequencies and shapes of small oscillations, and how fast unstable equilibria are
    /// left
    #[command(after_help = ALL_OR_NOTHING)]
    Modes(crate::modes::Modes),
    /// Set a system in motion: columns of places, forces and energies, and a page on which it moves
    ///
    /// Rigid bars are kept to their lengths at every step (RATTLE). Ctrl-C ends it and keeps what
    /// is stored so far.
    Simulate(crate::simulate::Simulate),
    /// Print a system file with comments, to start from (`funicular format` has every key)
    New(crate::new::New),
    /// Print the page of the file format: every key with its unit, what is allowed, and an example
    /// (`funicular help file` too)
    #[command(alias = "file")]
    Format,
    /// Print a chapter of the guide: first steps, the evidence, motion, methods, limits
    Guide(crate::guide::Guide),
    /// List the named cases, or print the system file of one (a start for a file of your own)
    Cases(crate::cases::Cases),
    /// Write the manual pages, for `man` to read
    Man(crate::man::Man),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        super::Cli::command().debug_assert();
    }
}
