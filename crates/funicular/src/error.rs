//! What can go wrong.

use validate::foreign::GivenError;

use crate::solve::SolveAnswer;
use crate::threads::MOST_THREADS;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Occurs when a system file cannot be read, or describes no problem.
    #[error(transparent)]
    File(#[from] model::system_file::SystemFileError),
    /// Occurs when more memory is needed than there may be: see
    /// [`limit_memory`](model::system_file::limit_memory).
    #[error(transparent)]
    Memory(#[from] model::budget::OutOfMemory),
    /// Occurs when a number of a bar is out of range.
    #[error(transparent)]
    Bar(#[from] model::BarError),
    /// Occurs when a number of a system is out of range, or a member names a joint that is not
    /// there.
    #[error(transparent)]
    System(#[from] model::system::SystemError),
    /// Occurs when there is no case of this name.
    #[error("there is no case named `{name}`")]
    UnknownCase {
        /// The name as given.
        name: String,
        /// The name that is nearest, if one is near.
        suggestion: Option<&'static str>,
    },
    /// Occurs when a page is to show shapes over parameters, and nothing hangs at any of their values: why there is no load path.
    #[cfg(feature = "branches")]
    #[error("nothing hangs at any of the values; no load path: {0}")]
    NoShapes(String),
    /// Occurs when a file format has no counterpart of a part of the system.
    #[error(transparent)]
    Export(#[from] formats::export::ExportError),
    /// Occurs when load cases are asked for, and the file of the system has none.
    #[error(
        "this system has no load cases: tables [[cases]] with a name, and factors of its [[loads]]"
    )]
    NoCases,
    /// Occurs when this, which was asked for, is possible for chains between two anchors alone, and the
    /// problem is another system.
    #[error("{0} is for chains between two anchors")]
    ChainsOnly(&'static str),
    /// Occurs when so many answers, fewer than two, are to be compared.
    #[error("a comparison needs at least two answers, got {0}")]
    NothingToCompare(usize),
    /// Occurs when every solver that was asked gave up: the answer has no equilibrium, and says
    /// why.
    #[error("{}", reasons(.0.failures()))]
    Unsolved(Box<SolveAnswer>),
    /// Occurs when the solvers disagree where one equilibrium is needed to go on.
    #[error(
        "the solvers disagree on this equilibrium: `funicular solve` shows the answers of both"
    )]
    Disagreed,
    /// Occurs when a system is no equilibrium problem: out of reach, straight, without load, a part falls.
    #[error(transparent)]
    Refused(#[from] model::system::Refusal),
    /// Occurs when a file of another program cannot be used.
    #[error(transparent)]
    Format(#[from] formats::FormatError),
    /// Occurs when an answer from elsewhere does not fit the system.
    #[error(transparent)]
    Given(#[from] GivenError),
    /// Occurs when the tolerance of an answer from elsewhere is out of range.
    #[error(transparent)]
    Tolerance(#[from] validate::foreign::ToleranceError),
    /// Occurs when `lagrange`, asked alone, has no answer, or no derivatives of it.
    #[error(transparent)]
    Lagrange(#[from] lagrange::Error),
    /// Occurs when `energy`, asked alone, has no answer.
    #[error(transparent)]
    Energy(#[from] energy::Error),
    /// Occurs when a census is not taken: the chain is too long.
    #[error(transparent)]
    Census(#[from] census::CensusError),
    /// Occurs when a system has no census: see [`model::NoCensus`]; with the names of the joints that it is about.
    #[error("{0}{1}")]
    SystemCensus(model::NoCensus, String),
    /// Occurs when a solver cannot be made ready for a sweep.
    #[cfg(feature = "sweep")]
    #[error(transparent)]
    Solvers(#[from] crate::starts::SolversError),
    /// Occurs when a sweep cannot be prepared.
    #[cfg(feature = "sweep")]
    #[error(transparent)]
    Sweep(#[from] sweep::SweepError),
    /// Occurs when the folder of a sweep cannot be read or written, or holds something else.
    #[cfg(feature = "sweep")]
    #[error(transparent)]
    Store(#[from] sweep::StoreError),
    /// Occurs when a regular grid over the angles of the bars cannot have so many points.
    #[cfg(feature = "sweep")]
    #[error(
        "a regular grid over the angles of {bars} bars has as many points on each: it cannot have {seeds}"
    )]
    GridSeeds {
        /// The number as given.
        seeds: u64,
        /// Number of bars.
        bars: usize,
        /// Points on each angle and in all of the nearest grids.
        nearest: Vec<(u64, u64)>,
    },
    /// Occurs when the axes of a picture of basins are not two bars of the chain.
    #[cfg(feature = "sweep")]
    #[error("axes {},{}: two different bars are needed, and the chain has bars 1 to {bars}", axes[0], axes[1])]
    BasinsBars {
        /// The bars as given, from 1.
        axes: [usize; 2],
        /// Number of bars.
        bars: usize,
    },
    /// Occurs when the joint of this name, whose start is to vary, is none that can move.
    #[cfg(feature = "sweep")]
    #[error("{0:?} is not a joint that can move")]
    BasinsJoint(String),
    /// Occurs when the starting angle of the bars that are no axis, in degrees, is infinite or not a number.
    #[cfg(feature = "sweep")]
    #[error("the starting angle of the other bars must be finite, got {0} degrees")]
    BasinsAngle(f64),
    /// Occurs when a picture of basins cannot be drawn.
    #[cfg(feature = "sweep")]
    #[error(transparent)]
    Basins(#[from] sweep::BasinsError),
    /// Occurs when a parameter is written wrongly, or does not fit the chain.
    #[cfg(feature = "branches")]
    #[error(transparent)]
    Parameter(#[from] branches::ParameterError),
    /// Occurs when numbers put in the place of those of a problem describe none.
    #[cfg(feature = "branches")]
    #[error(transparent)]
    Point(#[from] branches::PointError),
    /// Occurs when derivatives are asked for of or by what has none.
    #[cfg(feature = "branches")]
    #[error(transparent)]
    Derivatives(#[from] crate::derivatives::DerivativesError),
    /// Occurs when no equilibrium can be followed.
    #[cfg(feature = "branches")]
    #[error(transparent)]
    Continuation(#[from] branches::ContinuationError),
    /// Occurs when there is no load path.
    #[cfg(feature = "branches")]
    #[error(transparent)]
    Load(#[from] crate::trace::load::LoadError),
    /// Occurs when a solver has no answer to the paper's example.
    #[cfg(feature = "paper")]
    #[error(transparent)]
    Reproduction(#[from] paper::example::ExampleError),
    /// Occurs when the report of the paper cannot be written.
    #[cfg(feature = "paper")]
    #[error(transparent)]
    Report(#[from] report::document::ReportError),
    /// Occurs when a system cannot be set in motion, or a step cannot be taken.
    #[error(transparent)]
    Motion(#[from] motion::MotionError),
    /// Occurs when a simulation does not begin: a time out of range, no such start.
    #[error(transparent)]
    Simulate(#[from] crate::simulate::SimulateError),
    /// Occurs when so many threads are asked for, which is more than make sense.
    #[error("{0} threads are too many: at most {MOST_THREADS}")]
    TooManyThreads(usize),
    /// Occurs when the system does not start the threads.
    #[error("{threads} threads cannot be started: {reason}")]
    Threads {
        /// The number as given.
        threads: usize,
        /// What the system says.
        reason: String,
    },
}

impl Error {
    /// What is allowed, what is near to what was given, or what to do about it.
    ///
    /// ```
    /// let error = funicular::Problem::case("three-equal-bar").unwrap_err();
    /// assert!(error.help().unwrap().starts_with("did you mean `three-equal-bars`?"));
    /// ```
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::File(error) => return error.help(),
            Self::UnknownCase { suggestion, .. } => {
                let names: Vec<_> = model::cases::named().map(|(name, _)| name).collect();
                let near = suggestion.map(|name| format!("did you mean `{name}`? "));
                format!("{}the cases are: {}", near.unwrap_or_default(), names.join(", "))
            }
            Self::Given(GivenError::UnknownJoint { suggestion: Some(near), .. }) => {
                format!("did you mean {near:?}?")
            }
            Self::Format(error) => return error.help.clone(),
            #[cfg(feature = "sweep")]
            Self::Store(error) => error.help()?.into(),
            #[cfg(feature = "sweep")]
            Self::GridSeeds { nearest, bars, .. } => {
                let near = nearest.iter().map(|(side, all)| format!("{all} = {side}^{bars}"));
                format!("the nearest are {}", near.collect::<Vec<_>>().join(" and "))
            }
            #[cfg(feature = "branches")]
            Self::Parameter(error) => error.help.clone(),
            _ => return None,
        })
    }

    pub(crate) fn unknown_case(name: &str) -> Self {
        let names: Vec<_> = model::cases::named().map(|(name, _)| name).collect();
        let suggestion = model::system_file::nearest(name, &names);
        Self::UnknownCase { name: name.to_owned(), suggestion }
    }
}

fn reasons(failures: &[impl ToString]) -> String {
    failures.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}
