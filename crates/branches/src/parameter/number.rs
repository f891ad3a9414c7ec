use std::fmt;
use std::ops::Range;

use model::system_file::nearest;

use crate::parameter::error::{ParameterError, Result};

/// One number of a system file, or the same number of every bar.
///
/// ```
/// use branches::{BarField, Number, Parameter, Which};
/// let vary: Parameter = "bars.*.length_m=0.5,1".parse()?;
/// assert_eq!(vary.number, Number::Bar(Which::All, BarField::Length));
/// assert_eq!((vary.number.to_string().as_str(), vary.number.unit()), ("bars.*.length_m", "m"));
/// # Ok::<(), branches::ParameterError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Number {
    /// `loads`, of a system: a factor of all its forces and masses.
    Loads,
    /// `lengths`, of a system: a factor of the lengths of all its bars, as all of them are heated; centres of weight
    /// and forces on them move along.
    Lengths,
    /// `gravity_m_s2`.
    Gravity,
    /// `floor_m`, of a system.
    Floor,
    /// A coordinate of an anchor, 0 for x to 2 for z: `anchors.end_m.z`.
    Anchor(AnchorEnd, usize),
    /// A number of a bar or of all bars: `bars.2.mass_kg`, `bars.*.length_m`.
    Bar(Which, BarField),
    /// A number of the bars of a row of a system, by the names of its ends: `bars.A-P.*.mass_kg`. A name with
    /// dots or brackets stands in quotes: `bars."A-P#2".*.mass_kg`.
    Row(String, BarField),
    /// A number of a joint of a system, by its name: `joints.P.mass_kg`. A name with dots or
    /// brackets stands in quotes: `joints."A-P.1".force_n.x`.
    Joint(String, JointField),
}

/// Which number of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointField {
    /// `at_m` of a joint that is held, 0 for x to 2 for z.
    Place(usize),
    /// `mass_kg`.
    Mass,
    /// `force_n`, 0 for x to 2 for z.
    Force(usize),
    /// `share`, of a joint between two rows of one rope: the part of its length that is on the first side.
    Share,
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
    /// The bar of this number, counted from 1: a table with `count = 3` is three
    /// bars.
    One(usize),
    /// From one bar to another, both of them: `1-20`.
    Range(usize, usize),
    /// Every bar: `*`.
    All,
}

/// Which number of a bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BarField {
    /// `length_m`. A centre of weight and moments of inertia that are not given go with it.
    Length,
    /// `mass_kg`. Moments of inertia that are not given go with it.
    Mass,
    /// `centre_m`.
    Centre,
    /// `inertia_kg_m2`, 0 for x (along the bar) to 2: no equilibrium depends on it.
    Inertia(usize),
    /// `stiffness_n`, of a system.
    Stiffness,
    /// `prestress_n`, of a system.
    Prestress,
    /// `length_tolerance_m`, of a system.
    LengthTolerance,
    /// `count`: how many equal bars make the row that a bar is of, with the length, mass and loads of all of
    /// them as they are.
    Count,
}

const TOP: &[&str] = &["loads", "lengths", "gravity_m_s2", "floor_m", "anchors", "joints", "bars"];
const ANCHORS: &[&str] = &["start_m", "end_m"];
const JOINT: &[&str] = &["at_m", "mass_kg", "force_n", "share"];
const BAR: &[&str] = &[
    "length_m", "mass_kg", "centre_m", "inertia_kg_m2", "stiffness_n", "prestress_n",
    "length_tolerance_m", "count",
];
const AXES: [&str; 3] = ["x", "y", "z"];

impl Which {
    /// Whether it names the bar of this number, from 1.
    pub fn has(self, bar: usize) -> bool {
        let (first, last) = self.ends();
        (first..=last).contains(&bar)
    }

    /// The first bar and the last.
    pub(super) fn ends(self) -> (usize, usize) {
        match self {
            Self::One(bar) => (bar, bar),
            Self::Range(first, last) => (first, last),
            Self::All => (1, usize::MAX),
        }
    }

    fn overlaps(self, other: Self) -> bool {
        let ((a, b), (c, d)) = (self.ends(), other.ends());
        a <= d && c <= b
    }
}

impl BarField {
    fn unit(self) -> &'static str {
        match self {
            Self::Length | Self::Centre | Self::LengthTolerance => "m",
            Self::Mass => "kg",
            Self::Inertia(_) => "kg m^2",
            Self::Stiffness | Self::Prestress => "N",
            Self::Count => "bars",
        }
    }
}

impl fmt::Display for BarField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length => f.write_str("length_m"),
            Self::Mass => f.write_str("mass_kg"),
            Self::Centre => f.write_str("centre_m"),
            Self::Inertia(axis) => write!(f, "inertia_kg_m2.{}", AXES[*axis]),
            Self::Stiffness => f.write_str("stiffness_n"),
            Self::Prestress => f.write_str("prestress_n"),
            Self::LengthTolerance => f.write_str("length_tolerance_m"),
            Self::Count => f.write_str("count"),
        }
    }
}

impl Number {
    /// The unit of this number.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Gravity => "m/s^2",
            Self::Floor | Self::Anchor(..) | Self::Joint(_, JointField::Place(_)) => "m",
            Self::Bar(_, field) | Self::Row(_, field) => field.unit(),
            Self::Joint(_, JointField::Mass) => "kg",
            Self::Joint(_, JointField::Force(_)) => "N",
            Self::Loads | Self::Lengths | Self::Joint(_, JointField::Share) => "1",
        }
    }

    /// Whether it counts bars: its values are whole numbers, and nothing is followed over it.
    pub fn is_count(&self) -> bool {
        matches!(self, Self::Bar(_, BarField::Count) | Self::Row(_, BarField::Count))
    }

    /// Whether a row of rigid bars under upright loads is one whatever the value.
    pub fn keeps_rows(&self) -> bool {
        let of_bar = |field: &BarField| {
            !matches!(field, BarField::Stiffness | BarField::Prestress | BarField::LengthTolerance)
        };
        match self {
            Self::Bar(_, field) | Self::Row(_, field) => of_bar(field),
            Self::Joint(_, field) => !matches!(field, JointField::Force(0 | 1)),
            Self::Floor => false,
            Self::Loads | Self::Lengths | Self::Gravity | Self::Anchor(..) => true,
        }
    }

    /// Whether both set one number of a system file: `bars.1.length_m` and `bars.*.length_m` do.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Bar(one, field), Self::Bar(two, same)) => field == same && one.overlaps(*two),
            _ => self == other,
        }
    }

    /// The number that the beginning of `text`, up to `end`, is the path of.
    pub(super) fn parse(text: &str, end: usize) -> Result<Self> {
        let mut parts = Parts { text, rest: words(text, end)?, end };
        let top = parts.key(TOP, "a path")?;
        let number = match top {
            "loads" => Self::Loads,
            "lengths" => Self::Lengths,
            "gravity_m_s2" => Self::Gravity,
            "floor_m" => Self::Floor,
            "joints" => {
                let joint = parts.joint()?;
                let field = match parts.key(JOINT, "a joint")? {
                    "at_m" => JointField::Place(parts.axis()?),
                    "mass_kg" => JointField::Mass,
                    "share" => JointField::Share,
                    _ => JointField::Force(parts.axis()?),
                };
                Self::Joint(joint, field)
            }
            "anchors" => {
                let which = match parts.key(ANCHORS, "`anchors`")? {
                    "start_m" => AnchorEnd::Start,
                    _ => AnchorEnd::End,
                };
                Self::Anchor(which, parts.axis()?)
            }
            _ => {
                let bars = parts.bars()?;
                let field = match parts.key(BAR, "a bar")? {
                    "length_m" => BarField::Length,
                    "mass_kg" => BarField::Mass,
                    "centre_m" => BarField::Centre,
                    "stiffness_n" => BarField::Stiffness,
                    "prestress_n" => BarField::Prestress,
                    "length_tolerance_m" => BarField::LengthTolerance,
                    "count" => BarField::Count,
                    _ => BarField::Inertia(parts.axis()?),
                };
                match bars {
                    Bars::Numbered(which) => Self::Bar(which, field),
                    Bars::Row(name) => Self::Row(name, field),
                }
            }
        };
        match parts.rest.first() {
            None => Ok(number),
            Some(more) => Err(ParameterError::new(
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
            Self::Loads => f.write_str("loads"),
            Self::Lengths => f.write_str("lengths"),
            Self::Gravity => f.write_str("gravity_m_s2"),
            Self::Floor => f.write_str("floor_m"),
            Self::Anchor(AnchorEnd::Start, axis) => write!(f, "anchors.start_m.{}", AXES[*axis]),
            Self::Anchor(AnchorEnd::End, axis) => write!(f, "anchors.end_m.{}", AXES[*axis]),
            Self::Bar(which, field) => match which {
                Which::One(bar) => write!(f, "bars.{bar}.{field}"),
                Which::Range(first, last) => write!(f, "bars.{first}-{last}.{field}"),
                Which::All => write!(f, "bars.*.{field}"),
            },
            Self::Row(row, field) => {
                let row = quoted(row);
                let all = if *field == BarField::Count { "" } else { ".*" };
                write!(f, "bars.{row}{all}.{field}")
            }
            Self::Joint(joint, field) => {
                write!(f, "joints.{}.", quoted(joint))?;
                match field {
                    JointField::Place(axis) => write!(f, "at_m.{}", AXES[*axis]),
                    JointField::Mass => f.write_str("mass_kg"),
                    JointField::Share => f.write_str("share"),
                    JointField::Force(axis) => write!(f, "force_n.{}", AXES[*axis]),
                }
            }
        }
    }
}

/// A name, in quotes where it would be taken for a path.
fn quoted(name: &str) -> String {
    if name.contains(['.', '[', ']', '=', ',']) { format!("\"{name}\"") } else { name.to_owned() }
}

/// Where the first `=` outside quotes is; of all where a quote is not closed.
pub(super) fn equals(text: &str) -> Option<usize> {
    let mut quoted = false;
    let mut characters = text.char_indices();
    let found = characters.find(|(_, c)| {
        quoted ^= *c == '"';
        *c == '=' && !quoted
    });
    match found {
        Some((at, _)) => Some(at),
        None if quoted => text.find('='),
        None => None,
    }
}

/// The words of the path up to `end`, as byte ranges: separated by dots, and by brackets around
/// numbers. What stands in quotes is one word.
fn words(text: &str, end: usize) -> Result<Vec<Range<usize>>> {
    const HELP: &str = "brackets enclose one number, as in `bars[2].mass_kg`";
    let mut words = vec![];
    let mut start = 0;
    // Where the open bracket is, and whether one was closed just before.
    let (mut open, mut closed) = (None, false);
    let mut quote = None;
    for (at, c) in text[..end].char_indices() {
        if c == '"' {
            quote = if quote.is_some() { None } else { Some(at) };
        }
        if quote.is_some() {
            continue;
        }
        let wrong = match (c, open) {
            ('.' | '[', Some(bracket)) => Some((bracket, "this bracket is not closed")),
            (']', None) => Some((at, "this bracket is not opened")),
            ('.' | '[' | ']', _) => None,
            _ if closed => Some((at, "a dot is missing here")),
            _ => None,
        };
        if let Some((at, what)) = wrong {
            let width = text[at..].chars().next().map_or(0, char::len_utf8);
            return Err(ParameterError::new(text, at..at + width, what, HELP));
        }
        if matches!(c, '.' | '[' | ']') {
            // `[2].` closes one word, not two.
            if at > start || !(closed || c == '[') {
                words.push(start..at);
            }
            start = at + 1;
            open = (c == '[').then_some(at);
            closed = c == ']';
        }
    }
    if let Some(at) = quote {
        let what = "this quotation mark is not closed";
        let help = "a name with dots stands in quotes, as in `joints.\"A-P.1\".mass_kg`";
        return Err(ParameterError::new(text, at..at + 1, what, help));
    }
    if let Some(at) = open {
        let what = "this bracket is not closed";
        return Err(ParameterError::new(text, at..at + 1, what, HELP));
    }
    if !closed {
        words.push(start..end);
    }
    Ok(words)
}

/// Bars as a path names them.
enum Bars {
    Numbered(Which),
    Row(String),
}

/// What is left of a path.
struct Parts<'a> {
    text: &'a str,
    rest: Vec<Range<usize>>,
    end: usize,
}

impl Parts<'_> {
    fn wrong(&self, span: Range<usize>, what: String, allowed: &str) -> ParameterError {
        ParameterError::new(self.text, span, what, format!("allowed here: {allowed}"))
    }

    fn next(&mut self, owner: &str, allowed: &str) -> Result<(String, Range<usize>)> {
        if self.rest.is_empty() {
            let span = self.end..self.end;
            let what = format!("{owner} is not a number: a part of it is missing");
            return Err(self.wrong(span, what, allowed));
        }
        let span = self.rest.remove(0);
        Ok((self.text[span.clone()].trim().to_owned(), span))
    }

    fn key(&mut self, allowed: &'static [&'static str], owner: &str) -> Result<&'static str> {
        let list = allowed.join(", ");
        let (word, span) = self.next(owner, &list)?;
        if let Some(key) = allowed.iter().find(|key| **key == word) {
            return Ok(key);
        }
        let help = match nearest(&word, allowed) {
            Some(meant) => format!("did you mean `{meant}`? allowed here: {list}"),
            None => format!("allowed here: {list}"),
        };
        Err(ParameterError::new(self.text, span, format!("unknown key `{word}`"), help))
    }

    fn axis(&mut self) -> Result<usize> {
        const ALLOWED: &str = "x, y, z (or [1], [2], [3])";
        let (word, span) = self.next("a vector", ALLOWED)?;
        let axis = AXES.iter().position(|axis| *axis == word).or_else(|| {
            word.parse::<usize>().ok().and_then(|k| k.checked_sub(1)).filter(|k| *k < AXES.len())
        });
        axis.ok_or_else(|| self.wrong(span, format!("unknown component `{word}`"), ALLOWED))
    }

    fn joint(&mut self) -> Result<String> {
        const ALLOWED: &str = "the name of a joint, with dots in quotes";
        let (word, span) = self.next("`joints`", ALLOWED)?;
        let quoted = word.strip_prefix('"').and_then(|word| word.strip_suffix('"'));
        let name = quoted.unwrap_or(&word);
        if name.is_empty() {
            return Err(self.wrong(span, "the name of a joint is missing".to_owned(), ALLOWED));
        }
        Ok(name.to_owned())
    }

    fn bars(&mut self) -> Result<Bars> {
        const ALLOWED: &str =
            "the number of a bar, from 1, a range 1-20, a row FROM-TO.*, or * for all";
        let (word, span) = self.next("`bars`", ALLOWED)?;
        let number = |word: &str| word.parse::<usize>().ok().filter(|bar| *bar > 0);
        let range = word.split_once('-').and_then(|(a, b)| Some((number(a)?, number(b)?)));
        match (number(&word), range) {
            _ if word == "*" => Ok(Bars::Numbered(Which::All)),
            (Some(bar), _) => Ok(Bars::Numbered(Which::One(bar))),
            (None, Some((first, last))) if first <= last => {
                Ok(Bars::Numbered(Which::Range(first, last)))
            }
            (None, None)
                if word.contains('-') && number(word.trim_start_matches('-')).is_none() =>
            {
                // The star behind a row may be left out.
                if self.rest.first().is_some_and(|next| &self.text[next.clone()] == "*") {
                    self.rest.remove(0);
                }
                Ok(Bars::Row(word.trim_matches('"').to_owned()))
            }
            _ => Err(self.wrong(span, format!("`{word}` is not a bar"), ALLOWED)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_are_closed_and_enclose_one_word() {
        for (text, column, what) in [
            ("bars[2.mass_kg=1", 5, "not closed"),
            ("bars.2]mass_kg=1", 7, "not opened"),
            ("bars[2=1", 5, "not closed"),
            ("bars[[2]].mass_kg=1", 5, "not closed"),
            ("bars[2]mass_kg=1", 8, "a dot is missing"),
            ("anchors.end_m[3]]=1", 17, "not opened"),
            ("bars[2]..mass_kg=1", 9, "unknown key ``"),
            ("joints..mass_kg", 8, "name of a joint is missing"),
        ] {
            let end = text.find('=').unwrap_or(text.len());
            let error = Number::parse(text, end).unwrap_err();
            assert!(error.what.contains(what), "{text}: {error}");
            assert_eq!(error.column(), column, "{text}: {error}");
        }
        for (text, wanted) in [
            ("bars[2].inertia_kg_m2[3]", "bars.2.inertia_kg_m2.z"),
            ("bars[*].mass_kg", "bars.*.mass_kg"),
            ("anchors.start_m[1]", "anchors.start_m.x"),
            ("joints.P.force_n[2]", "joints.P.force_n.y"),
            ("joints.\"A-P.1\".mass_kg", "joints.\"A-P.1\".mass_kg"),
            ("joints.\"P\".at_m.z", "joints.P.at_m.z"),
            ("bars.1.stiffness_n", "bars.1.stiffness_n"),
            ("bars.2-5.mass_kg", "bars.2-5.mass_kg"),
            ("bars.A-P.*.mass_kg", "bars.A-P.*.mass_kg"),
            ("bars.A-P.*.count", "bars.A-P.count"),
            ("bars.A-P.inertia_kg_m2.z", "bars.A-P.*.inertia_kg_m2.z"),
            ("bars.\"A.1-P\".*.mass_kg", "bars.\"A.1-P\".*.mass_kg"),
        ] {
            assert_eq!(Number::parse(text, text.len()).unwrap().to_string(), wanted);
        }
    }

    #[test]
    fn all_bars_overlap_each() {
        let number = |text: &str| Number::parse(text, text.len()).unwrap();
        let all = number("bars.*.length_m");
        let first = number("bars.1.length_m");
        assert!(all.overlaps(&first) && first.overlaps(&all));
        assert!(!all.overlaps(&number("bars.1.mass_kg")) && !all.overlaps(&number("gravity_m_s2")));
        assert!(!number("bars.2.length_m").overlaps(&first));
        assert!(number("bars.1-3.length_m").overlaps(&number("bars.3-4.length_m")));
        assert!(!number("bars.1-3.length_m").overlaps(&number("bars.4.length_m")));
        assert!(number("gravity_m_s2").overlaps(&number("gravity_m_s2")));
    }

    /// Stretching bars, loads aside and floors make other systems of rows.
    #[test]
    fn rows_are_kept_by_what_stays_rigid_and_upright() {
        for (text, keeps) in [
            ("bars.1.length_m", true),
            ("bars.*.mass_kg", true),
            ("bars.A-P.count", true),
            ("bars.1.stiffness_n", false),
            ("bars.A-P.*.prestress_n", false),
            ("bars.2.length_tolerance_m", false),
            ("joints.P.mass_kg", true),
            ("joints.P.force_n.x", false),
            ("joints.P.force_n.y", false),
            ("joints.P.force_n.z", true),
            ("joints.P.at_m.x", true),
            ("floor_m", false),
            ("gravity_m_s2", true),
            ("anchors.end_m.z", true),
        ] {
            let number = Number::parse(text, text.len()).unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!(number.keeps_rows(), keeps, "{text}");
        }
    }
}
