use std::ops::Range;
use std::str::FromStr;

use crate::parameter::error::{ParameterError, Result};
use crate::parameter::number::{Number, equals};

/// Most values of one parameter, and most points of a variation: each costs a census.
pub const MAX_POINTS: usize = 1_000_000;

/// One number of the system file and the values it takes. A range without a number of points, `0..1.2`, is for
/// paths that find their own.
///
/// ```
/// let vary: branches::Parameter = "anchors.end_m.z=-2.5..-0.5:5".parse()?;
/// assert_eq!(vary.number.to_string(), "anchors.end_m.z");
/// assert_eq!(vary.values, [-2.5, -2.0, -1.5, -1.0, -0.5]);
/// let error = "bars.2.mas_kg=1,2".parse::<branches::Parameter>().unwrap_err();
/// assert_eq!(error.to_string(), "`bars.2.mas_kg=1,2`, character 8: unknown key `mas_kg`");
/// assert!(error.help.starts_with("did you mean `mass_kg`?"));
/// # Ok::<(), branches::ParameterError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Which number.
    pub number: Number,
    /// Its values, in their order; at least one.
    pub values: Vec<f64>,
    /// Whether the values are the ends of a range without a number of points, `0..1.2`.
    pub open: bool,
    /// The text it was read from, for errors found later.
    text: String,
}

const VALUES: &str = "values are a list, `0.1,1,10`, or a range with the number of its points, \
                      `-2.9..-0.1:500`";

impl Parameter {
    /// The same; a range without its number of points is an error.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] at the end of the text.
    pub fn with_points(&self) -> Result<&Self> {
        let (text, help) = (self.text(), "write `from..to:points`, as `-2.9..-0.1:500`");
        let span = text.len()..text.len();
        let what = "the number of points is missing";
        if self.open { Err(ParameterError::new(text, span, what, help)) } else { Ok(self) }
    }

    /// The same; a range without its number of points has so many, at least both ends.
    #[must_use]
    pub fn sampled(&self, points: usize) -> Self {
        match self.values[..] {
            [from, to] if self.open => {
                Self { values: range(from, to, points.max(2)), open: false, ..self.clone() }
            }
            _ => self.clone(),
        }
    }

    /// The text it was read from.
    pub fn text(&self) -> &str {
        &self.text
    }
}

impl FromStr for Parameter {
    type Err = ParameterError;

    fn from_str(text: &str) -> Result<Self> {
        let Some(equals) = equals(text) else {
            let span = text.len()..text.len();
            return Err(ParameterError::new(text, span, "`=` and the values are missing", VALUES));
        };
        let number = Number::parse(text, equals)?;
        let (values, open) = if number.is_count() {
            (counts(text, equals + 1..text.len())?, false)
        } else {
            values(text, equals + 1..text.len())?
        };
        Ok(Self { number, values, open, text: text.to_owned() })
    }
}

/// Counts of bars: a list, or all of a range.
fn counts(text: &str, all: Range<usize>) -> Result<Vec<f64>> {
    const COUNTS: &str =
        "counts are whole numbers from 1: a list, `2,5,10`, or all of a range, `2..10`";
    let wrong = |span: Range<usize>| {
        let what = format!("`{}` is not a count", text[span.clone()].trim());
        ParameterError::new(text, span, what, COUNTS)
    };
    let one = |span: Range<usize>| {
        let count = text[span.clone()].trim().parse::<u32>().ok().filter(|count| *count > 0);
        count.ok_or_else(|| wrong(span))
    };
    let mut list = vec![];
    let mut start = all.start;
    for word in text[all.clone()].split(',') {
        let end = start + word.len();
        match word.split_once("..") {
            None => list.push(f64::from(one(start..end)?)),
            Some((from, _)) => {
                let dots = start + from.len();
                let (from, to) = (one(start..dots)?, one(dots + 2..end)?);
                if from > to || (to - from) as usize >= MAX_POINTS {
                    return Err(wrong(start..end));
                }
                list.extend((from..=to).map(f64::from));
            }
        }
        start = end + 1;
    }
    if list.len() > MAX_POINTS { Err(wrong(all)) } else { Ok(list) }
}

fn values(text: &str, all: Range<usize>) -> Result<(Vec<f64>, bool)> {
    let part = &text[all.clone()];
    if let Some(dots) = part.find("..") {
        let from = number(text, all.start..all.start + dots)?;
        let rest = all.start + dots + 2;
        let Some(colon) = text[rest..].find(':').map(|at| rest + at) else {
            let from_to = vec![from, number(text, rest..all.end)?];
            return Ok((from_to, true));
        };
        let to = number(text, rest..colon)?;
        let points = points(text, colon + 1..text.len())?;
        return Ok((range(from, to, points), false));
    }
    let mut list = vec![];
    let mut start = all.start;
    for word in part.split(',') {
        list.push(number(text, start..start + word.len())?);
        start += word.len() + 1;
    }
    if list.len() > MAX_POINTS {
        let what = format!("{} values are too many", list.len());
        return Err(ParameterError::new(
            text,
            all,
            what,
            format!("at most {MAX_POINTS} are allowed"),
        ));
    }
    Ok((list, false))
}

/// Equidistant values with both ends; the ends are exact.
fn range(from: f64, to: f64, points: usize) -> Vec<f64> {
    let last = points - 1;
    (0..points)
        .map(|k| match k {
            0 => from,
            _ if k == last => to,
            _ => {
                let part = k as f64 / last as f64;
                let value = from * (1.0 - part) + to * part;
                // What differs from zero by rounding only is zero: there, anchors stand on one
                // vertical.
                let rounding = 4.0 * f64::EPSILON * from.abs().max(to.abs());
                if value.abs() <= rounding { 0.0 } else { value }
            }
        })
        .collect()
}

fn number(text: &str, span: Range<usize>) -> Result<f64> {
    let word = text[span.clone()].trim();
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(ParameterError::new(text, span, format!("`{word}` is not finite"), VALUES)),
        Err(_) if word.is_empty() => {
            Err(ParameterError::new(text, span, "a number is missing here", VALUES))
        }
        Err(_) => Err(ParameterError::new(text, span, format!("`{word}` is not a number"), VALUES)),
    }
}

fn points(text: &str, span: Range<usize>) -> Result<usize> {
    let word = text[span.clone()].trim();
    match word.parse::<usize>() {
        Ok(points) if (2..=MAX_POINTS).contains(&points) => Ok(points),
        _ => Err(ParameterError::new(
            text,
            span,
            format!("`{word}` is not a number of points"),
            format!("a whole number from 2 to {MAX_POINTS} is allowed"),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lists, ranges with both ends, and both; what is none is told with its place.
    #[test]
    fn counts_are_lists_and_ranges() {
        let values = |text: &str| text.parse::<Parameter>().map(|found| found.values);
        assert_eq!(values("bars.1.count=12, 2 , 5..7").unwrap(), [12.0, 2.0, 5.0, 6.0, 7.0]);
        assert_eq!(values("bars.1.count=3..3,1").unwrap(), [3.0, 1.0]);
        for (text, wrong) in [
            ("bars.1.count=2,0,4", "character 16: `0`"),
            ("bars.1.count=2,3..x", "character 19: `x`"),
            ("bars.1.count=2,7..5", "character 16: `7..5`"),
            ("bars.1.count=1..1000001", "character 14: `1..1000001`"),
            ("bars.1.count=1..1000000,1", "character 14: `1..1000000,1`"),
        ] {
            let error = values(text).unwrap_err().to_string();
            assert!(error.contains(wrong), "{error}");
        }
        assert_eq!(values("bars.1.count=1..1000000").unwrap().len(), MAX_POINTS);
    }
}
