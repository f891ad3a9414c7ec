//! Files that are whole or not there.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, IntoInnerError, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Bytes collected before they go to the system.
const BUFFER: usize = 1 << 18;

/// Symbolic links followed before they are taken for a ring; the kernel of Linux has the same
/// number.
const MOST_LINKS: usize = 40;

/// A file that appears under its name when it is complete: until then it grows beside it, and when
/// it is dropped before it goes away. A process that is killed leaves `.NAME.RANDOM.part` behind,
/// which [`unfinished`] tells from other files; one that is asked to end leaves nothing if it ends
/// by [`abandon`]. Nothing that is there under such a name is ever opened.
///
/// Where the name is a symbolic link, the file that it leads to is replaced, and the link stays.
/// What is there and is no regular file, such as a pipe or a device, cannot be replaced by one: it
/// is written into as the bytes come. So is standard output under another name (`/dev/stdout`).
///
/// ```
/// use std::io::Write;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("answer.txt");
/// let mut file = columns::AtomicFile::create(&path)?;
/// file.write_all(b"half")?;
/// drop(file);
/// // Nothing is left of what was not finished.
/// assert_eq!(std::fs::read_dir(folder.path())?.count(), 0);
/// let mut file = columns::AtomicFile::create(&path)?;
/// file.write_all(b"whole")?;
/// file.commit()?;
/// assert_eq!(std::fs::read(&path)?, b"whole");
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct AtomicFile {
    // Before the part: closed when that goes away.
    file: BufWriter<File>,
    /// `None` for what is written straight into.
    part: Option<Part>,
}

impl AtomicFile {
    /// Begin a file. A pipe with a name waits here for its reader.
    ///
    /// # Errors
    ///
    /// Those of the file system.
    pub fn create(path: &Path) -> io::Result<Self> {
        let (file, part) = match standing(path)? {
            Standing::Stream(file) => (file, None),
            Standing::Special => (OpenOptions::new().write(true).open(path)?, None),
            Standing::Regular(about) => {
                let (part, file) = Part::file(end_of_links(path)?)?;
                // What nobody else could read stays so. Best effort: not every file system has
                // permissions.
                let _ = file.set_permissions(about.permissions());
                (file, Some(part))
            }
            Standing::Nothing => {
                let (part, file) = Part::file(end_of_links(path)?)?;
                (file, Some(part))
            }
        };
        Ok(Self { file: BufWriter::with_capacity(BUFFER, file), part })
    }

    /// See whether a file could be written, and leave everything as it is.
    ///
    /// # Errors
    ///
    /// Those that [`create`](Self::create) would meet. Pipes and devices are not opened.
    pub fn check(path: &Path) -> io::Result<()> {
        match standing(path)? {
            Standing::Stream(_) | Standing::Special => Ok(()),
            Standing::Regular(_) | Standing::Nothing => Part::file(end_of_links(path)?).map(|_| ()),
        }
    }

    /// Give the file its name; what was there under it is replaced. The bytes are on the disk
    /// before.
    ///
    /// # Errors
    ///
    /// Those of the file system.
    pub fn commit(self) -> io::Result<()> {
        let Self { file, part } = self;
        let file = file.into_inner().map_err(IntoInnerError::into_error)?;
        let Some(part) = part else { return Ok(()) };
        file.sync_data()?;
        part.name()
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// A folder of files that appears under its name when it is complete; until then, and if it is dropped before, as
/// [`AtomicFile`] says.
///
/// ```
/// let outer = tempfile::tempdir()?;
/// let path = outer.path().join("grids");
/// let folder = columns::AtomicFolder::create(&path)?;
/// folder.write("0.vtu", b"a grid")?;
/// assert!(!path.exists());
/// folder.commit()?;
/// assert_eq!(std::fs::read(path.join("0.vtu"))?, b"a grid");
/// // What is in it stays.
/// let error = columns::AtomicFolder::create(&path).unwrap_err();
/// assert!(error.to_string().ends_with("is not empty"));
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct AtomicFolder(Part);

impl AtomicFolder {
    /// Begin a folder.
    ///
    /// # Errors
    ///
    /// Those of the file system, and [`ErrorKind::AlreadyExists`] where something is there that is no empty folder.
    pub fn create(path: &Path) -> io::Result<Self> {
        let target = end_of_links(path)?;
        match fs::read_dir(&target) {
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => return Err(error),
            Ok(mut inside) => {
                if inside.next().is_some() {
                    let why = format!("the folder {} is not empty", path.display());
                    return Err(io::Error::new(ErrorKind::AlreadyExists, why));
                }
            }
        }
        let (part, ()) = Part::begin(target, |builder, folder| {
            usual_permissions(builder, 0o777);
            Ok(((), builder.tempdir_in(folder)?.keep()))
        })?;
        Ok(Self(part))
    }

    /// Write a file of it.
    ///
    /// # Errors
    ///
    /// Those of the file system.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        fs::write(self.0.path.join(name), bytes)
    }

    /// Give the folder its name.
    ///
    /// # Errors
    ///
    /// Those of the file system.
    pub fn commit(self) -> io::Result<()> {
        match fs::remove_dir(&self.0.target) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
            _ => self.0.name(),
        }
    }
}

/// What stands where a file is to be written.
enum Standing {
    Nothing,
    Regular(Metadata),
    /// Standard output.
    Stream(File),
    /// Another pipe, device or socket.
    Special,
}

fn standing(path: &Path) -> io::Result<Standing> {
    Ok(match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Standing::Nothing,
        Err(error) => return Err(error),
        Ok(about) if about.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(about) => match standard_output(&about) {
            // One file by two descriptors would be written over itself.
            Some(file) => Standing::Stream(file),
            None if about.is_file() => Standing::Regular(about),
            None => Standing::Special,
        },
    })
}

/// Standard output, if it is the file that this is about.
#[cfg(unix)]
fn standard_output(about: &Metadata) -> Option<File> {
    use std::os::fd::AsFd;
    use std::os::unix::fs::MetadataExt;

    let file = File::from(io::stdout().as_fd().try_clone_to_owned().ok()?);
    let own = file.metadata().ok()?;
    ((own.dev(), own.ino()) == (about.dev(), about.ino())).then_some(file)
}

/// Elsewhere standard output has no other name.
#[cfg(not(unix))]
fn standard_output(_: &Metadata) -> Option<File> {
    None
}

/// Where a path leads when symbolic links are followed; at the end there may be nothing yet.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(to) = fs::read_link(&path) else { return Ok(path) };
        path = path.parent().unwrap_or(Path::new("")).join(to);
    }
    Err(io::Error::other("too many symbolic links"))
}

/// The parts that grow now.
static GROWING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A list of paths is never half changed: a thread that panicked does no harm.
fn growing() -> MutexGuard<'static, Vec<PathBuf>> {
    GROWING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Remove what is not finished; best effort: there is nobody to tell.
fn remove(part: &Path) {
    let _ = if part.is_dir() { fs::remove_dir_all(part) } else { fs::remove_file(part) };
}

/// Remove all files that this process has begun, and end it: `end` should not return. Until it does
/// no file can be begun or get its name, so that nothing is left behind and nothing complete is
/// lost.
pub fn abandon<T>(end: impl FnOnce() -> T) -> T {
    let growing = growing();
    growing.iter().for_each(|part| remove(part));
    end()
}

/// The file beside the one to be written, until it is that.
#[derive(Debug)]
struct Part {
    path: PathBuf,
    target: PathBuf,
}

/// Random letters and digits in the name of an unfinished file.
const RANDOM: usize = 12;

/// What the name of an unfinished file ends in.
const UNFINISHED: &str = ".part";

impl Part {
    fn file(target: PathBuf) -> io::Result<(Self, File)> {
        Self::begin(target, |builder, folder| {
            usual_permissions(builder, 0o666);
            // `drop` and `abandon` see to its end.
            builder.tempfile_in(folder)?.keep().map_err(|error| error.error)
        })
    }

    fn begin<T>(
        target: PathBuf,
        make: impl FnOnce(&mut tempfile::Builder<'_, '_>, &Path) -> io::Result<(T, PathBuf)>,
    ) -> io::Result<(Self, T)> {
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
        let prefix = format!(".{name}.");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(UNFINISHED).rand_bytes(RANDOM);
        let mut growing = growing();
        // Without the name of the part, which nobody has asked for.
        let (made, path) = make(&mut builder, folder.unwrap_or(Path::new(".")))
            .map_err(|error| io::Error::from(error.kind()))?;
        growing.push(path.clone());
        Ok((Self { path, target }, made))
    }

    fn name(self) -> io::Result<()> {
        let mut growing = growing();
        let named = fs::rename(&self.path, &self.target);
        if named.is_ok() {
            // Nothing is left that `drop` could remove.
            growing.retain(|part| *part != self.path);
        }
        drop(growing);
        named
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        let mut growing = growing();
        let before = growing.len();
        growing.retain(|part| *part != self.path);
        if growing.len() < before {
            remove(&self.path);
        }
    }
}

/// Those that every file or folder has that a program makes, less what the user takes away; a temporary one could be read
/// by its owner alone.
#[cfg(unix)]
fn usual_permissions(builder: &mut tempfile::Builder<'_, '_>, mode: u32) {
    use std::os::unix::fs::PermissionsExt as _;
    builder.permissions(fs::Permissions::from_mode(mode));
}

#[cfg(not(unix))]
fn usual_permissions(_: &mut tempfile::Builder<'_, '_>, _: u32) {}

/// Of which file this is what a killed process left unfinished, by its name: `a.csv` for
/// `.a.csv.RANDOM.part`; none if it is no such name.
///
/// ```
/// assert_eq!(columns::unfinished(".a.csv.0123456789ab.part"), Some("a.csv"));
/// assert_eq!(columns::unfinished(".mine.part"), None);
/// ```
pub fn unfinished(name: &str) -> Option<&str> {
    let inner = name.strip_prefix('.')?.strip_suffix(UNFINISHED)?;
    let (target, random) = inner.rsplit_once('.')?;
    let ours = random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric());
    (ours && !target.is_empty()).then_some(target)
}

/// Write a whole file, so that an interruption leaves the old one or the new one.
///
/// # Errors
///
/// Those of the file system.
///
/// ```
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("page.html");
/// columns::write_whole(&path, b"<p>first</p>")?;
/// columns::write_whole(&path, b"<p>second</p>")?;
/// assert_eq!(std::fs::read_to_string(&path)?, "<p>second</p>");
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = AtomicFile::create(path)?;
    file.write_all(bytes)?;
    file.commit()
}
