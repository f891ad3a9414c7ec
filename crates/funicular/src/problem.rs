//! What is asked about.

use std::cell::RefCell;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use formats::system::Source;
use model::Vector;
use model::budget::Budget;
use model::system::{Row, System};
use model::system_file::{self, Described, Rows, most_file_bytes};

use crate::error::Error;
use crate::judge::ForeignAnswer;

/// A system of bars for which the question "where does it come to rest?" has an answer: a chain
/// between two anchors, or joints with members between them.
///
/// ```
/// use funicular::prelude::*;
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
/// let chain = Chain::new("two bars", 9.81, anchors, vec![Bar::homogeneous(1.0, 2.0)?; 2])?;
/// assert_eq!(Problem::try_from(chain)?.name(), "two bars");
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Problem(pub(crate) Arc<System>);

/// A problem that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The problem.
    pub problem: Problem,
    /// All files that were read for it.
    pub files: Vec<PathBuf>,
    /// How a file of another program was read: sentences.
    pub notes: Vec<String>,
}

impl Reading {
    /// What [`Problem::read`] reads, with what there is to say about it. The bottom of the sea is a floor.
    ///
    /// # Errors
    /// As [`Problem::read`].
    pub fn of(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        if let Some((source, text)) = foreign(path) {
            let name = path.display().to_string();
            let mut read = source.parse(&text, &name)?;
            let mut notes = std::mem::take(&mut read.notes);
            let bottom =
                |floor_m: f64| format!("the bottom at {floor_m} m is a floor without friction");
            notes.extend(read.floor_m.map(bottom));
            let problem = read.above_floor(&name)?.into();
            return Ok(Self { problem, files: vec![path.to_owned()], notes });
        }
        let files = RefCell::new(vec![path.to_owned()]);
        let rows = |file: &Path, rows: &mut dyn Rows| {
            files.borrow_mut().push(file.to_owned());
            parquet_rows(file, rows)
        };
        let described = system_file::read_with(path, &rows)?;
        Ok(Self { problem: described.into(), files: files.into_inner(), notes: vec![] })
    }
}

/// The text of a file of another program; `None` of any other, and of what cannot be read, which our own reader says.
fn foreign(path: &Path) -> Option<(Source, String)> {
    let ending = path.extension()?.to_str()?;
    if !Source::may_end(ending) {
        return None;
    }
    let (most, mut bytes) = (most_file_bytes(), vec![]);
    let file = model::open_input(path).ok()?;
    file.take(most.saturating_add(1)).read_to_end(&mut bytes).ok()?;
    let text = Source::text(ending, bytes).ok()?;
    Some((Source::guess(ending, &text).filter(|_| text.len() as u64 <= most)?, text))
}

impl Problem {
    /// The problem of a system file, or of a file of another program that
    /// [`Source`](formats::system::Source) knows. Joints and bars of a system file may be in files of their own, as CSV, or
    /// with the feature `columns` Parquet.
    ///
    /// # Errors
    /// [`Error::File`], or [`Error::Format`] of a file of another program, with the line and what is allowed there.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Reading::of(path).map(|reading| reading.problem)
    }

    /// The problem of the text of a system file; `name` stands for the file in errors.
    ///
    /// # Errors
    /// [`Error::File`], with the line and what is allowed there.
    pub fn parse(text: &str, name: &str) -> Result<Self, Error> {
        Ok(system_file::parse(text, name)?.into())
    }

    /// A named case, such as `three-equal-bars`, the example of the paper; [`model::cases`] has
    /// all.
    ///
    /// # Errors
    /// [`Error::UnknownCase`], with the name that is nearest.
    pub fn case(name: &str) -> Result<Self, Error> {
        match model::cases::exhibit(name) {
            Some(exhibit) => Ok(exhibit.system().into()),
            None => Ok(case(name)?.problem().into()),
        }
    }

    /// The system file that reads back to the same, bit for bit; a chain under its own weight is written as one.
    ///
    /// ```
    /// let problem = funicular::Problem::case("footbridge")?;
    /// assert_eq!(funicular::Problem::parse(&problem.to_toml(), "again.toml")?, problem);
    /// # Ok::<(), funicular::Error>(())
    /// ```
    pub fn to_toml(&self) -> String {
        system_file::write(&self.0)
    }

    /// The name, for people.
    pub fn name(&self) -> &str {
        self.0.name()
    }

    /// Its joints and members, which may be shared; joints of a chain are named by their numbers, from `0`.
    pub fn system(&self) -> Arc<System> {
        Arc::clone(&self.0)
    }

    /// The chain that this is, however its file is written: a row of rigid bars between two anchors,
    /// also with weights at its joints, which the bars before them carry then
    /// ([`Row`](model::system::Row)).
    #[must_use]
    pub fn row(&self) -> Option<&model::Problem> {
        self.0.as_row().map(Row::problem)
    }

    /// Whether a member has a strength that its force can be held against.
    pub fn has_strengths(&self) -> bool {
        self.0.has_strengths()
    }

    /// Refuse what would need more memory than readers may ask for, at so many bytes for each member.
    pub(crate) fn fits(&self, each: u64) -> Result<(), Error> {
        Ok(Budget::default().fits_members(self.0.members().len(), each)?)
    }

    /// The same problem with another question: the equilibrium next to this shape, a place for every
    /// joint, m. Every builder then starts there: [`Solve`](crate::Solve), `Study`,
    /// [`Modes`](crate::Modes), `Derivatives`, [`Simulate`](crate::Simulate).
    ///
    /// ```
    /// use funicular::prelude::*;
    /// // A rod of 1 m that may turn about its foot: it hangs, or stands on its head.
    /// let text = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
    ///             bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0 }]";
    /// let rod = Problem::parse(text, "rod.toml")?;
    /// let up = [[0.0; 3], [0.0, 0.0, 0.9]];
    /// let found = Solve::new().near(&rod, &up)?;
    /// let standing = &found.equilibria()[0];
    /// assert!((standing.joints_m[1][2] - 1.0).abs() < 1e-12);
    /// assert_eq!(standing.stability.index_in_space, 2);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::System`] when two joints are at one place, or a coordinate is not finite;
    /// [`Error::Given`] when there are more or fewer places than joints.
    pub fn near(&self, joints_m: &[Vector]) -> Result<Self, Error> {
        let shape = ForeignAnswer::in_order(&self.0, "a shape", joints_m.to_vec(), None)?;
        Ok(System::clone(&self.0).drawn_at(&shape.joints_m)?.into())
    }
}

/// The named case, with its system file; [`model::cases::all`] lists them.
///
/// # Errors
/// [`Error::UnknownCase`], with the name that is nearest.
pub fn case(name: &str) -> Result<&'static model::cases::Case, Error> {
    model::cases::get(name).ok_or_else(|| Error::unknown_case(name))
}

/// The system file of a named case or of a system of the gallery.
///
/// # Errors
/// [`Error::UnknownCase`], with the name that is nearest.
pub fn case_text(name: &str) -> Result<&'static str, Error> {
    match model::cases::exhibit(name) {
        Some(exhibit) => Ok(exhibit.text),
        None => Ok(case(name)?.text),
    }
}

impl From<model::Problem> for Problem {
    fn from(problem: model::Problem) -> Self {
        System::from(&problem).into()
    }
}

impl TryFrom<model::Chain> for Problem {
    type Error = Error;

    fn try_from(chain: model::Chain) -> Result<Self, Error> {
        Ok(model::Problem::new(chain)?.into())
    }
}

impl From<Described> for Problem {
    fn from(described: Described) -> Self {
        match described {
            Described::Chain(problem) => problem.into(),
            Described::System(system) => system.into(),
        }
    }
}

impl From<System> for Problem {
    fn from(system: System) -> Self {
        Self(Arc::new(system))
    }
}

/// What becomes of a file of columns.
type Read = Option<Result<(), Box<dyn std::error::Error + Send + Sync>>>;

/// The rows of a file that is named or begins like Parquet; nothing of other files.
#[cfg(feature = "columns")]
fn parquet_rows(file: &Path, rows: &mut dyn Rows) -> Read {
    is_parquet(file).then(|| columns::read_rows(file, rows).map_err(Into::into))
}

#[cfg(feature = "columns")]
fn is_parquet(file: &Path) -> bool {
    let mut magic = [0; 4];
    // What is read from a pipe is gone: only a file is tasted.
    file.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"))
        || std::fs::metadata(file).is_ok_and(|about| about.is_file())
            && std::fs::File::open(file)
                .is_ok_and(|mut file| file.read_exact(&mut magic).is_ok() && magic == *b"PAR1")
}

/// Rows are read from CSV alone.
#[cfg(not(feature = "columns"))]
fn parquet_rows(_: &Path, _: &mut dyn Rows) -> Read {
    None
}
