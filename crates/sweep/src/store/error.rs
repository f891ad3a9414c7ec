//! What can go wrong with a sweep on disk.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use columns::ColumnsError;

use crate::store::shard::{MOST_PARTS, MOST_SEEDS, Shard};

/// What work on a store leads to.
pub(crate) type Result<T, E = StoreError> = std::result::Result<T, E>;

/// Why a sweep cannot be written, continued or joined.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum StoreError {
    /// Occurs when the file system refuses.
    #[error("{}: {error}", path.display())]
    File { path: PathBuf, error: std::io::Error },
    /// Occurs when a part cannot be written or read.
    #[error(transparent)]
    Columns(#[from] ColumnsError),
    /// Occurs when a sweep has no seeds.
    #[error("a sweep of no seeds has no result")]
    NoSeeds,
    /// Occurs when the output folder holds a sweep, and it was not asked to go on with it.
    #[error("{} holds a sweep already", path.display())]
    Present { path: PathBuf },
    /// Occurs when the output folder holds other things.
    #[error("{} is not empty and holds no sweep: there is `{found}`", path.display())]
    NotEmpty { path: PathBuf, found: String },
    /// Occurs when a folder holds no sweep.
    #[error("{} holds no sweep: there is no {missing}", path.display())]
    NoSweep { path: PathBuf, missing: &'static str },
    /// Occurs when a sweep was not finished.
    #[error("the sweep in {} is not finished", path.display())]
    Unfinished { path: PathBuf },
    /// Occurs when another process is writing the folder.
    #[error("another process is writing {}", path.display())]
    Busy { path: PathBuf },
    /// Occurs when two sweeps that should be one are not.
    #[error("{} holds another sweep: `{key}` is {found}, not {wanted}", path.display())]
    Differs { path: PathBuf, key: String, wanted: String, found: String },
    /// Occurs when a manifest or a summary cannot be read.
    #[error("{}: {reason}", path.display())]
    Description { path: PathBuf, reason: String },
    /// Occurs when a part does not hold what it should.
    #[error("{}: {reason}", path.display())]
    Part { path: PathBuf, reason: String },
    /// Occurs when a part of a finished sweep is missing.
    #[error("{}: it is not there", path.display())]
    NoPart { path: PathBuf },
    /// Occurs when a pipe, a device or a folder stands where a file of the sweep should.
    #[error("{} is not a regular file", path.display())]
    NotRegular { path: PathBuf },
    /// Occurs when a sweep has more seeds than its summary can list parts of.
    #[error(
        "{seeds} seeds are {parts} parts, and a summary lists at most {MOST_PARTS}: {MOST_SEEDS} seeds"
    )]
    TooManySeeds { seeds: u64, parts: u64 },
    /// Occurs when shards of different cuts are joined.
    #[error("{} is shard {found}, and the others are of {wanted}", path.display())]
    OtherCut { path: PathBuf, found: Shard, wanted: u64 },
    /// Occurs when so many shards cannot be joined to shards of fewer.
    #[error("{of} shards do not make shard {wanted}: their number must be a multiple of {}", wanted.of)]
    Uneven { of: u64, wanted: Shard },
    /// Occurs when a shard is no part of the one to be made.
    #[error("{} is shard {found}, which is not part of shard {wanted}", path.display())]
    Outside { path: PathBuf, found: Shard, wanted: Shard },
    /// Occurs when a shard is given twice.
    #[error("shard {shard} is there twice: {} and {}", first.display(), second.display())]
    Double { shard: Shard, first: PathBuf, second: PathBuf },
    /// Occurs when shards are not given.
    #[error("of {of} shards these are missing: {}", list(missing))]
    Missing { missing: Vec<u64>, of: u64 },
    /// Occurs when nothing is given to join.
    #[error("there is nothing to merge")]
    Nothing,
    /// Occurs when the folder to write is one of the folders to read.
    #[error("{} is to be read and written", path.display())]
    SameFolder { path: PathBuf },
    /// Occurs when the system gives no threads.
    #[error("the threads cannot be started: {reason}")]
    Threads { reason: String },
}

/// Most numbers named one by one in an error.
pub(crate) const NAMED: usize = 10;

/// See that what stands under a name is a regular file, or nothing: a pipe would wait for somebody
/// at its other end.
pub(crate) fn regular(path: &Path) -> Result<()> {
    match std::fs::metadata(path) {
        Ok(about) if !about.is_file() => Err(StoreError::NotRegular { path: path.to_owned() }),
        Ok(_) => Ok(()),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(StoreError::file(path, error)),
    }
}

fn list(numbers: &[u64]) -> String {
    let named: Vec<_> = numbers.iter().take(NAMED).map(u64::to_string).collect();
    named.join(", ") + if numbers.len() > NAMED { ", ..." } else { "" }
}

impl StoreError {
    pub(crate) fn file(path: &Path, error: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), error }
    }

    pub(crate) fn part(path: &Path, reason: impl Into<String>) -> Self {
        Self::Part { path: path.to_owned(), reason: reason.into() }
    }

    /// Whether it is not the user's to mend: the disk is full or out of reach, the system gives no
    /// threads, or another process has the folder. The same call may succeed later. A path that
    /// leads to no place to write is bad input.
    pub fn may_pass(&self) -> bool {
        match self {
            Self::File { error, .. } | Self::Columns(ColumnsError::File { error, .. }) => {
                !matches!(
                    error.kind(),
                    ErrorKind::NotFound
                        | ErrorKind::PermissionDenied
                        | ErrorKind::AlreadyExists
                        | ErrorKind::NotADirectory
                        | ErrorKind::IsADirectory
                        | ErrorKind::InvalidFilename
                        | ErrorKind::InvalidInput
                )
            }
            Self::Threads { .. } | Self::Busy { .. } => true,
            _ => false,
        }
    }

    /// What to do about it, if that is not plain from the message.
    pub fn help(&self) -> Option<&'static str> {
        Some(match self {
            Self::Present { .. } => "--resume goes on with it; or choose another folder",
            Self::NotEmpty { .. } => "choose a folder that is empty or not there yet",
            Self::Differs { .. } => {
                "a sweep is continued or joined only with exactly the same parameters"
            }
            Self::Unfinished { .. } => "run the same sweep with --resume first",
            Self::Busy { .. } => "wait until it has finished",
            Self::File { .. } | Self::Columns(ColumnsError::File { .. }) if self.may_pass() => {
                "what is done stays; the same command goes on when there is room (sweep: with --resume)"
            }
            Self::NoPart { .. } => "run the same sweep with --resume: it computes the part again",
            Self::NotRegular { .. } => "remove it, and run the same sweep with --resume",
            Self::TooManySeeds { .. } => {
                "split them over several sweeps, each with a --seed of its own"
            }
            Self::Part { .. } => "remove the file and run the same sweep with --resume",
            _ => return None,
        })
    }
}
