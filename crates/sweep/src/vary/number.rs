//! The numbers of a system file, by their paths.

use std::fmt;
use std::ops::Range;

use model::system_file::nearest;

use super::error::VaryError;

/// One number of a system file, or the same number of every bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    /// `gravity_m_s2`.
    Gravity,
    /// A coordinate of an anchor, 0 for x to 2 for z: `anchors.end_m.z`.
    Anchor(AnchorEnd, usize),
    /// A number of a bar or of all bars: `bars.2.mass_kg`, `bars.*.length_m`.
    Bar(Which, BarField),
}

/// Which anchor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnchorEnd {
    /// `anchors.start_m`.
    Start,
    /// `anchors.end_m`.
    End,
}

/// Which bars.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// The bar of this number, counted from 1 along the chain: a table with `count = 3` is three bars.
    One(usize),
    /// Every bar: `*`.
    All,
}

/// Which number of a bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BarField {
    /// `length_m`. A centre of weight in the middle, and the moments of a slender bar, go with it.
    Length,
    /// `mass_kg`. The moments of a slender bar go with it.
    Mass,
    /// `centre_m`.
    Centre,
    /// `inertia_kg_m2`, 0 for x (along the bar) to 2: no equilibrium depends on it.
    Inertia(usize),
}

const TOP: &[&str] = &["gravity_m_s2", "anchors", "bars"];
const ANCHORS: &[&str] = &["start_m", "end_m"];
const BAR: &[&str] = &["length_m", "mass_kg", "centre_m", "inertia_kg_m2"];
const AXES: [&str; 3] = ["x", "y", "z"];

impl Number {
    /// The unit of this number.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Gravity => "m/s^2",
            Self::Anchor(..) | Self::Bar(_, BarField::Length | BarField::Centre) => "m",
            Self::Bar(_, BarField::Mass) => "kg",
            Self::Bar(_, BarField::Inertia(_)) => "kg m^2",
        }
    }

    /// The number that the beginning of `text`, up to `end`, is the path of.
    pub(super) fn parse(text: &str, end: usize) -> Result<Self, VaryError> {
        let mut parts = Parts { text, rest: words(&text[..end]), end };
        let top = parts.key(TOP, "a path")?;
        let number = match top {
            "gravity_m_s2" => Self::Gravity,
            "anchors" => {
                let which = match parts.key(ANCHORS, "`anchors`")? {
                    "start_m" => AnchorEnd::Start,
                    _ => AnchorEnd::End,
                };
                Self::Anchor(which, parts.axis()?)
            }
            _ => {
                let which = parts.bar()?;
                let field = match parts.key(BAR, "a bar")? {
                    "length_m" => BarField::Length,
                    "mass_kg" => BarField::Mass,
                    "centre_m" => BarField::Centre,
                    _ => BarField::Inertia(parts.axis()?),
                };
                Self::Bar(which, field)
            }
        };
        match parts.rest.first() {
            None => Ok(number),
            Some(more) => Err(VaryError::new(
                text,
                more.clone(),
                format!("`{number}` is a number and has no parts"),
                format!("write `{number}=` and the values"),
            )),
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gravity => f.write_str("gravity_m_s2"),
            Self::Anchor(AnchorEnd::Start, axis) => write!(f, "anchors.start_m.{}", AXES[*axis]),
            Self::Anchor(AnchorEnd::End, axis) => write!(f, "anchors.end_m.{}", AXES[*axis]),
            Self::Bar(which, field) => {
                match which {
                    Which::One(bar) => write!(f, "bars.{bar}.")?,
                    Which::All => f.write_str("bars.*.")?,
                }
                match field {
                    BarField::Length => f.write_str("length_m"),
                    BarField::Mass => f.write_str("mass_kg"),
                    BarField::Centre => f.write_str("centre_m"),
                    BarField::Inertia(axis) => write!(f, "inertia_kg_m2.{}", AXES[*axis]),
                }
            }
        }
    }
}

/// The words of a path, as byte ranges: separated by dots, and by brackets around numbers.
fn words(path: &str) -> Vec<Range<usize>> {
    let mut words = vec![];
    let mut start = 0;
    for (at, c) in path.char_indices() {
        match c {
            '.' | '[' | ']' => {
                // `[2].` closes one word, not two.
                if at > start || (c == '.' && !path[..at].ends_with(']')) {
                    words.push(start..at);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
    if start < path.len() || path.ends_with('.') || path.is_empty() {
        words.push(start..path.len());
    }
    words
}

/// What is left of a path.
struct Parts<'a> {
    text: &'a str,
    rest: Vec<Range<usize>>,
    end: usize,
}

impl Parts<'_> {
    fn next(&mut self, owner: &str, allowed: &str) -> Result<(String, Range<usize>), VaryError> {
        if self.rest.is_empty() {
            let span = self.end..self.end;
            let what = format!("{owner} is not a number: a part of it is missing");
            return Err(VaryError::new(self.text, span, what, format!("allowed here: {allowed}")));
        }
        let span = self.rest.remove(0);
        Ok((self.text[span.clone()].trim().to_owned(), span))
    }

    fn key(
        &mut self,
        allowed: &'static [&'static str],
        owner: &str,
    ) -> Result<&'static str, VaryError> {
        let list = allowed.join(", ");
        let (word, span) = self.next(owner, &list)?;
        if let Some(key) = allowed.iter().find(|key| **key == word) {
            return Ok(key);
        }
        let help = match nearest(&word, allowed) {
            Some(meant) => format!("did you mean `{meant}`? allowed here: {list}"),
            None => format!("allowed here: {list}"),
        };
        Err(VaryError::new(self.text, span, format!("unknown key `{word}`"), help))
    }

    fn axis(&mut self) -> Result<usize, VaryError> {
        const ALLOWED: &str = "x, y, z (or [1], [2], [3])";
        let (word, span) = self.next("a vector", ALLOWED)?;
        let axis = AXES.iter().position(|axis| *axis == word).or_else(|| {
            word.parse::<usize>().ok().and_then(|k| k.checked_sub(1)).filter(|k| *k < AXES.len())
        });
        axis.ok_or_else(|| {
            let what = format!("unknown component `{word}`");
            VaryError::new(self.text, span, what, format!("allowed here: {ALLOWED}"))
        })
    }

    fn bar(&mut self) -> Result<Which, VaryError> {
        const ALLOWED: &str = "the number of a bar, from 1, or * for all";
        let (word, span) = self.next("`bars`", ALLOWED)?;
        match word.parse::<usize>() {
            _ if word == "*" => Ok(Which::All),
            Ok(bar) if bar > 0 => Ok(Which::One(bar)),
            _ => {
                let what = format!("`{word}` is no bar");
                Err(VaryError::new(self.text, span, what, format!("allowed here: {ALLOWED}")))
            }
        }
    }
}
