//! How the program ends.

use branches::{ContinuationError, ParameterError};
use funicular::{Error, LoadError};
use model::steers;

use crate::diagnostics::Diagnostic;

/// A way to end, with its exit code (0 agreed, 1 a check failed, 2 bad input, 3 undecided).
///
/// From the best to the worst.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Done, and every check agreed.
    #[default]
    Done,
    /// Not converged, or not decided.
    Undecided,
    /// Bad input or usage.
    BadInput,
    /// A check failed: the solvers disagree, a claim came out otherwise than expected.
    CheckFailed,
    /// Interrupted by Ctrl-C or SIGTERM.
    Interrupted,
}

impl Exit {
    /// Of an answer: a failed check is worse than what is missing or has not converged.
    pub fn of(failed: bool, is_decided: bool) -> Self {
        match (failed, is_decided) {
            (true, _) => Self::CheckFailed,
            (false, true) => Self::Done,
            (false, false) => Self::Undecided,
        }
    }

    /// The exit code; 128 plus the number of SIGINT for an interruption, as shells have it.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::CheckFailed => 1,
            Self::BadInput => 2,
            Self::Undecided => 3,
            Self::Interrupted => 130,
        }
    }

    /// Of two ways to end the worse: a failed check before bad input, and that before what is
    /// undecided.
    pub fn worse(self, other: Self) -> Self {
        self.max(other)
    }
}

impl From<Exit> for std::process::ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// How a command ends, or what stopped it.
pub type Result<T, E = Failure> = std::result::Result<T, E>;

/// What stopped a command, and the way to end for it.
#[derive(Debug)]
pub struct Failure {
    diagnostic: Diagnostic,
    exit: Exit,
}

impl Failure {
    /// The user's input cannot be used.
    pub fn bad_input(diagnostic: impl Into<Diagnostic>) -> Self {
        Self { diagnostic: diagnostic.into(), exit: Exit::BadInput }
    }

    /// A solver gave up.
    pub fn undecided(diagnostic: impl Into<Diagnostic>) -> Self {
        Self { diagnostic: diagnostic.into(), exit: Exit::Undecided }
    }

    /// The way to end.
    pub fn exit(&self) -> Exit {
        self.exit
    }

    /// What is wrong, and what to do about it.
    pub fn words(&self) -> (&str, Option<&str>) {
        self.diagnostic.words()
    }

    /// Print it to standard error and say how to end.
    pub fn report(self) -> Exit {
        self.diagnostic.print();
        self.exit
    }
}

/// A text in which every character that steers is replaced, and every other stays in its place.
fn in_place(text: &str) -> String {
    let shown = |c: char| if steers(c) { "?".repeat(c.len_utf8()) } else { c.to_string() };
    text.chars().map(shown).collect()
}

/// The error with the place in the text of the parameter.
fn of_parameter(error: &ParameterError) -> Diagnostic {
    let (text, what) = (in_place(&error.text), in_place(&error.what));
    let message = format!("{text}, character {}: {what}", error.column());
    let diagnostic = Diagnostic::from(message).with_help(in_place(&error.help));
    diagnostic.at(&text, error.span.clone(), what)
}

impl From<Error> for Failure {
    /// What the library refuses is bad input; what its solvers do not reach is undecided.
    fn from(error: Error) -> Self {
        let help = error.help();
        let diagnostic = match &error {
            Error::File(error) => Diagnostic::of_file(error),
            Error::Parameter(error) => of_parameter(error),
            Error::Continuation(ContinuationError::TooManyPoints { points, .. }) => {
                let help = format!("with --max-points {points} it is done all the same");
                Diagnostic::from(&error).with_help(help)
            }
            _ => Diagnostic::from(&error).with_help(help),
        };
        let exit = match error {
            Error::Disagreed => Exit::CheckFailed,
            // A disk that fails says nothing about the input, and those who run many may try again.
            Error::Store(error) if error.may_pass() => Exit::Undecided,
            Error::Unsolved(answer)
                if !answer.failures().iter().all(|one| one.is_misfit() || one.falls()) =>
            {
                Exit::Undecided
            }
            Error::Lagrange(_)
            | Error::Energy(_)
            | Error::Basins(_)
            | Error::Reproduction(_)
            | Error::Report(_)
            | Error::Load(
                LoadError::Solver(_)
                | LoadError::NotNear { .. }
                | LoadError::Start(_)
                | LoadError::Singular
                | LoadError::Jams,
            ) => Exit::Undecided,
            _ => Exit::BadInput,
        };
        Self { diagnostic, exit }
    }
}
