//! What stands in a cell of a table: data, which each renderer writes in its own way.

use model::number::Number;
use paper::sentence::Sentence;

use crate::badge::Badge;

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// There is nothing to say: a dash.
    Nothing,
    /// Words, with the few marks of a [`Block`](crate::block::Block).
    Text(String),
    /// A number, and what comes after it: a unit, or nothing.
    Number(Number, &'static str),
    /// Numbers in a row.
    Numbers(Vec<Number>),
    /// A sentence with numbers in it.
    Sentence(Sentence),
    /// A verdict.
    Badge(Badge),
}

impl Cell {
    /// A number in the unit of its column.
    pub fn number(number: Number) -> Self {
        Self::Number(number, "")
    }

    /// A count.
    pub fn count(count: usize) -> Self {
        Self::number(Number::count(count as f64))
    }

    /// Whether a column of such cells stands right.
    pub fn is_number(&self) -> bool {
        matches!(self, Self::Nothing | Self::Number(..))
    }

    /// The text, the same in every renderer but for marks, signs and spaces.
    pub fn text(&self) -> String {
        match self {
            Self::Nothing => "-".to_owned(),
            Self::Text(text) => text.clone(),
            Self::Number(number, "") => format!("{number:#}"),
            Self::Number(number, unit) => format!("{number:#} {unit}"),
            Self::Numbers(numbers) => {
                let numbers: Vec<_> = numbers.iter().map(|number| format!("{number:#}")).collect();
                numbers.join(", ")
            }
            Self::Sentence(sentence) => format!("{sentence:#}"),
            Self::Badge(badge) => badge.word.clone().into_owned(),
        }
    }
}

model::conversions! {
    Cell:
    &str, text => Self::Text(text.to_owned());
    String, text => Self::Text(text);
    Number, number => Self::number(number);
    Badge, badge => Self::Badge(badge);
    Sentence, sentence => Self::Sentence(sentence);
}

/// A dash for nothing.
impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Nothing, Into::into)
    }
}
