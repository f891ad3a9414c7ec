//! A sentence with numbers in it that are still numbers.

use std::fmt::{self, Display, Formatter};

use serde::{Serialize, Serializer};

use model::number::Number;

/// A part of a sentence.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// Words.
    Words(String),
    /// A number.
    Number(Number),
}

/// A sentence in parts. Whoever shows it decides how its numbers look: `{}` as they are, `{:#}` the
/// same on every machine. In JSON it is its text.
///
/// ```
/// use model::number::Number;
/// use paper::sentence::Sentence;
/// let spread = Number::size(2.2e-16, 0);
/// let sentence = Sentence::from(["agree to ".into(), spread.into(), " rad".into()]);
/// assert_eq!(sentence.to_string(), "agree to 2e-16 rad");
/// assert_eq!(format!("{sentence:#}"), "agree to <\u{a0}10⁻¹² rad");
/// assert_eq!(sentence.numbers().collect::<Vec<_>>(), [spread]);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sentence {
    parts: Vec<Part>,
}

impl Sentence {
    /// Words with parts in the place of each `{}`.
    pub fn filled<const N: usize>(words: &str, parts: [Part; N]) -> Self {
        let mut words = words.split("{}").map(Part::from);
        let mut all: Vec<Part> = words.next().into_iter().collect();
        all.extend(parts.into_iter().zip(words).flat_map(|(part, words)| [part, words]));
        Self { parts: all }
    }

    /// Its numbers, in order.
    pub fn numbers(&self) -> impl Iterator<Item = Number> + '_ {
        self.parts.iter().filter_map(|part| match part {
            Part::Number(number) => Some(*number),
            Part::Words(_) => None,
        })
    }

    /// The same with its words changed.
    #[must_use]
    pub fn with_words(mut self, change: impl Fn(&str) -> String) -> Self {
        for part in &mut self.parts {
            if let Part::Words(words) = part {
                *words = change(words);
            }
        }
        self
    }

    /// The same with other parts before it.
    #[must_use]
    pub fn after<const N: usize>(mut self, parts: [Part; N]) -> Self {
        self.parts.splice(0..0, parts);
        self
    }

    /// Whether there is nothing in it.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }
}

impl Display for Sentence {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        self.parts.iter().try_for_each(|part| match part {
            Part::Words(words) => f.write_str(words),
            // With the flags of the whole.
            Part::Number(number) => number.fmt(f),
        })
    }
}

impl Serialize for Sentence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

model::conversions! {
    Part:
    &str, words => Self::Words(words.to_owned());
    String, words => Self::Words(words);
    Number, number => Self::Number(number);
    usize, count => Self::Number(Number::count(count as f64));
}

impl From<&str> for Sentence {
    fn from(words: &str) -> Self {
        Self { parts: vec![words.into()] }
    }
}

impl<const N: usize> From<[Part; N]> for Sentence {
    fn from(parts: [Part; N]) -> Self {
        Self { parts: parts.into() }
    }
}
