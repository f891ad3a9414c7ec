//! Names of joints.

use std::borrow::Cow;
use std::fmt;
use std::num::NonZeroU32;
use std::sync::{Arc, LazyLock};

use serde::{Serialize, Serializer};

/// The name of a joint: a text, or one that many joints share with a number behind it, which is put
/// together when it is asked for.
///
/// ```
/// use model::system::Name;
/// let stem = "A-B.".into();
/// let name = Name::numbered(&stem, 12);
/// assert_eq!((name.text(), name.to_string()), ("A-B.12".into(), "A-B.12".to_owned()));
/// assert_eq!(name, Name::from("A-B.12"));
/// assert!(name != Name::from("A-B.1") && name != Name::numbered(&stem, 2));
/// ```
#[derive(Clone)]
pub struct Name {
    stem: Arc<str>,
    /// One more than the number behind it.
    number: Option<NonZeroU32>,
}

static NOTHING: LazyLock<Arc<str>> = LazyLock::new(|| Arc::from(""));

impl Name {
    /// A text with a number behind it.
    ///
    /// ```
    /// use model::system::Name;
    /// assert_eq!(Name::numbered(&"".into(), 0).text(), "0");
    /// ```
    pub fn numbered(stem: &Arc<str>, number: usize) -> Self {
        match u32::try_from(number + 1) {
            Ok(above) => Self { stem: Arc::clone(stem), number: NonZeroU32::new(above) },
            Err(_) => format!("{stem}{number}").into(),
        }
    }

    /// A number alone.
    pub fn number(number: usize) -> Self {
        Self::numbered(&NOTHING, number)
    }

    /// The name in full.
    pub fn text(&self) -> Cow<'_, str> {
        match self.number {
            None => Cow::Borrowed(&self.stem),
            Some(_) => Cow::Owned(self.to_string()),
        }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.stem)?;
        self.number.map_or(Ok(()), |above| write!(f, "{}", above.get() - 1))
    }
}

impl fmt::Debug for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&*self.text(), f)
    }
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        if Arc::ptr_eq(&self.stem, &other.stem) {
            return self.number == other.number;
        }
        self.text() == other.text()
    }
}

impl Eq for Name {}

impl<T: AsRef<str>> PartialEq<T> for Name {
    fn eq(&self, text: &T) -> bool {
        let rest = text.as_ref().strip_prefix(&*self.stem);
        rest.is_some_and(|rest| match self.number {
            None => rest.is_empty(),
            Some(above) => (above.get() - 1).to_string() == rest,
        })
    }
}

impl Serialize for Name {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<T: AsRef<str>> From<T> for Name {
    fn from(text: T) -> Self {
        Self { stem: text.as_ref().into(), number: None }
    }
}
