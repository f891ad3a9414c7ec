//! Errors of the library as the exceptions of the package have them: a class, a sentence, and the
//! numbers under the names that the library gives them.

use funicular::{DerivativesError, Error, PointError, SimulateError};
use model::system::{Refusal, SystemError};
use model::system_file::{SystemFileError, SystemFileErrorKind};
use model::{BarError, NoCensus};
use validate::foreign::{GivenError, ToleranceError};
use validate::systems::SystemFailure;

use crate::work::json;

/// What an exception is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// The class, in `funicular.errors`.
    pub class: &'static str,
    /// The sentence.
    pub message: String,
    /// The attributes.
    pub fields: Vec<(&'static str, Field)>,
}

/// The value of an attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum Field {
    /// A number, NaN and infinity too.
    Number(f64),
    /// A count.
    Count(u64),
    /// A text.
    Text(String),
    /// Texts.
    List(Vec<String>),
    /// An object, as JSON.
    Json(String),
    /// `None`.
    Nothing,
}

model::conversions! {
    Field:
    f64, number => Self::Number(number);
    usize, count => Self::Count(count as u64);
    u64, count => Self::Count(count);
    &str, text => Self::Text(text.to_owned());
    String, text => Self::Text(text);
    Vec<String>, list => Self::List(list);
}

impl<T> From<Option<T>> for Field
where
    Self: From<T>,
{
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Nothing, Self::from)
    }
}

/// Attributes of the names of these variables.
macro_rules! fields {
    ($($name:ident),*) => { vec![$((stringify!($name), Field::from($name.clone()))),*] };
}

impl Told {
    /// From its parts.
    pub fn new(class: &'static str, message: String, fields: Vec<(&'static str, Field)>) -> Self {
        Self { class, message, fields }
    }

    /// Of any error of the library.
    pub fn of(error: &Error) -> Self {
        let (class, mut fields) = parts(error);
        let help = error.help();
        fields.extend(fields!(help));
        Self::new(class, error.to_string(), fields)
    }
}

type Parts = (&'static str, Vec<(&'static str, Field)>);

fn parts(error: &Error) -> Parts {
    match error {
        Error::File(error) => file(error),
        Error::Bar(error) | Error::Point(PointError::Bar { error, .. }) => bar(error),
        Error::System(error) | Error::Point(PointError::System(error)) => system(error),
        Error::Refused(refusal) => refused(refusal),
        Error::UnknownCase { name, suggestion } => ("UnknownCase", fields!(name, suggestion)),
        Error::ChainsOnly(what) => ("ChainsOnly", fields!(what)),
        Error::Unsolved(answer) => ("Unsolved", failures(answer.failures())),
        Error::Given(error) => given(error),
        Error::Tolerance(ToleranceError { tolerance }) => ("SettingError", fields!(tolerance)),
        Error::Census(error) => no_census(error.reason()),
        Error::SystemCensus(because, _) => no_census(*because),
        Error::Parameter(error) => {
            let (text, column) = (&error.text, error.column());
            ("ParameterError", fields!(text, column))
        }
        Error::Point(PointError::Refused(refusal)) => refused(refusal),
        Error::Derivatives(
            DerivativesError::NoNumber(text) | DerivativesError::NoParameter(text),
        ) => ("DerivativesError", fields!(text)),
        Error::Simulate(error) => simulate(error),
        Error::Store(error) => {
            ("StoreError", vec![("may_pass", Field::Count(u64::from(error.may_pass())))])
        }
        Error::GridSeeds { seeds, bars, .. } => ("SettingError", fields!(seeds, bars)),
        Error::TooManyThreads(threads) => ("SettingError", fields!(threads)),
        Error::Motion(_) => ("MotionError", vec![]),
        Error::Sweep(_) | Error::Solvers(_) => ("SweepError", vec![]),
        Error::Continuation(_) | Error::Load(_) => ("TraceError", vec![]),
        Error::Format(error) => {
            let (file, line) = (&error.file, error.line);
            ("FileError", fields!(file, line))
        }
        Error::Export(_) => ("InputError", vec![]),
        _ => ("Error", vec![]),
    }
}

/// The attribute of an error that no solver has an answer.
pub fn failures(failures: &[SystemFailure]) -> Vec<(&'static str, Field)> {
    let failures: Vec<_> = failures.iter().map(funicular::Failure::of).collect();
    vec![("failures", Field::Json(json(&failures)))]
}

/// An error in a file or text: that of what it describes where it is one, with its place.
fn file(error: &SystemFileError) -> Parts {
    let (class, mut all) = match error.kind() {
        SystemFileErrorKind::Bar(error) => bar(error),
        SystemFileErrorKind::System(error) => system(error),
        SystemFileErrorKind::Refused(refusal) => refused(refusal),
        _ => ("FileError", vec![]),
    };
    let (file, key) = (error.file().to_owned(), error.key());
    let position = error.position();
    let line = position.map(|at| at.line);
    let column = position.map(|at| at.column);
    all.extend(fields!(file, key, line, column));
    (class, all)
}

fn bar(error: &BarError) -> Parts {
    let fields = match error {
        BarError::Length(length_m) => fields!(length_m),
        BarError::Mass(mass_kg) => fields!(mass_kg),
        BarError::Centre { centre_m, length_m } => fields!(centre_m, length_m),
        BarError::Inertia(moment_kg_m2) => fields!(moment_kg_m2),
        _ => vec![],
    };
    ("BarError", fields)
}

fn system(error: &SystemError) -> Parts {
    let fields = match error {
        SystemError::Gravity(gravity_m_s2) => fields!(gravity_m_s2),
        SystemError::DuplicateName { name, joint } => fields!(name, joint),
        SystemError::Coordinate { name, joint, coordinate_m } => fields!(name, joint, coordinate_m),
        SystemError::Direction { name, joint, length } => fields!(name, joint, length),
        SystemError::Mass { name, joint, mass_kg } => fields!(name, joint, mass_kg),
        SystemError::Force { name, joint, component_n } => fields!(name, joint, component_n),
        SystemError::NoSuchJoint { member, joint, joints } => fields!(member, joint, joints),
        SystemError::UnknownJoint { member, name } => fields!(member, name),
        SystemError::SelfLoop { member, joint } => fields!(member, joint),
        SystemError::Overflow(quantity) => fields!(quantity),
        SystemError::Underflow { quantity, total } => fields!(quantity, total),
        SystemError::MassRange { lightest_kg, heaviest_kg } => fields!(lightest_kg, heaviest_kg),
        _ => vec![],
    };
    ("SystemError", fields)
}

fn refused(refusal: &Refusal) -> Parts {
    match refusal {
        Refusal::Unconnected { name, joint } => ("Unconnected", fields!(name, joint)),
        Refusal::Falls { name, joint, joints } => ("Falls", fields!(name, joint, joints)),
        Refusal::NothingMoves => ("NothingMoves", vec![]),
        Refusal::Unresolved { coordinate_m, rounding_m, margin_m } => {
            ("Unresolved", fields!(coordinate_m, rounding_m, margin_m))
        }
        Refusal::NoLoad | Refusal::LoadsCancel => ("NoLoad", vec![]),
        Refusal::LoadOnAnchors => ("LoadOnAnchors", vec![]),
        Refusal::OutOfReach { from, to, distance_m, reach_m, .. } => {
            let (span_m, total_length_m) = (*distance_m, *reach_m);
            let (from_joint, to_joint, missing_m) = (from, to, span_m - total_length_m);
            ("OutOfReach", fields!(span_m, total_length_m, missing_m, from_joint, to_joint))
        }
        Refusal::Taut { from: from_joint, to: to_joint, distance_m, reach_m, .. } => {
            let (span_m, total_length_m) = (*distance_m, *reach_m);
            ("Taut", fields!(span_m, total_length_m, from_joint, to_joint))
        }
        Refusal::TooLong { member: bar, from: from_joint, to: to_joint, length_m, rest_m, way } => {
            ("BarTooLong", fields!(bar, length_m, rest_m, from_joint, to_joint, way))
        }
        Refusal::Folded { member: bar, from: from_joint, to: to_joint, length_m, way } => {
            ("Folded", fields!(bar, length_m, from_joint, to_joint, way))
        }
        _ => ("Refused", vec![]),
    }
}

fn given(error: &GivenError) -> Parts {
    let fields = match error {
        GivenError::UnknownJoint { name, suggestion } => fields!(name, suggestion),
        GivenError::Repeated(name) => fields!(name),
        GivenError::MissingJoints { names, count } | GivenError::MissingForces { names, count } => {
            fields!(names, count)
        }
        GivenError::NotFinite(what) => fields!(what),
        GivenError::UnknownMember { from: from_joint, to: to_joint }
        | GivenError::RepeatedMember { from: from_joint, to: to_joint } => {
            fields!(from_joint, to_joint)
        }
        GivenError::Count { of, wanted, found } => fields!(of, wanted, found),
        _ => vec![],
    };
    ("AnswerError", fields)
}

fn simulate(error: &SimulateError) -> Parts {
    let fields = match error {
        SimulateError::Time { what, value_s } => fields!(what, value_s),
        SimulateError::Steps(steps) => fields!(steps),
        SimulateError::NoSuchJoint(name) | SimulateError::PushedAnchor(name) => fields!(name),
        SimulateError::NoSuchEquilibrium { label, labels } => fields!(label, labels),
        SimulateError::AngleCount { given, bars } => fields!(given, bars),
        SimulateError::Angles { off, bar, joint } => fields!(off, bar, joint),
        _ => vec![],
    };
    ("SettingError", fields)
}

/// The reason with its numbers is the object of its JSON.
fn no_census(because: NoCensus) -> Parts {
    ("NoCensus", vec![("reason", Field::Json(json(&because)))])
}
