//! What the paper prints, with the place of each claim: `validation/paper.toml`.

use serde::Serialize;
use toml::{Table, Value};
use validate::built_in::{count, key, optional, parsed, tables, text, texts};

/// Printed claims, and the reference numbers they are held against.
#[derive(Debug)]
pub struct Paper {
    /// Claims in the order of the paper (kind `paper`).
    pub claims: Vec<Printed>,
    /// The rows of the audit of equations that are expected to fail, by the number of the equation,
    /// in the order of the audit; an equation with two faults stands twice. Those that hold as
    /// corrected; those that no correction of the print would save; and of the former those with a
    /// fault of form alone.
    pub failing: [Vec<String>; 3],
    /// Numbers established elsewhere (kind `external`), by their names.
    references: Vec<(String, f64)>,
}

/// One claim as printed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Printed {
    /// Its name in this project.
    pub id: String,
    /// What is claimed, in a line.
    pub says: String,
    /// Where it stands.
    #[serde(rename = "where")]
    pub place: String,
    /// What is printed.
    pub printed: String,
    /// Unit of the number, or of the numbers that decide.
    pub unit: Option<String>,
    /// Decimals printed, if a number is.
    pub digits: Option<usize>,
    /// The verdict that this project has come to.
    pub expected: Assessment,
}

impl Printed {
    /// The printed number; NaN, which no verdict survives, if none is.
    pub fn value(&self) -> f64 {
        if self.digits.is_none() {
            return f64::NAN;
        }
        self.printed.parse().unwrap_or(f64::NAN)
    }

    /// Whether a value rounds to exactly what is printed.
    pub fn rounds_to(&self, value: f64) -> bool {
        self.digits.is_some_and(|digits| format!("{value:.digits$}") == self.printed)
    }

    /// Whether it is a number of things, an integer, and no measure.
    pub fn is_count(&self) -> bool {
        /// Units of what is measured; all others count.
        const MEASURED: [&str; 8] = ["deg", "rad", "mg", "mgl", "mgl/rad", "l", "%", "s"];
        self.digits == Some(0) && self.unit.as_deref().is_some_and(|unit| !MEASURED.contains(&unit))
    }
}

/// What the numbers say about a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Assessment {
    /// True as printed, to all printed digits.
    Confirmed,
    /// Not true as printed, and a number shows where it comes from.
    Explained,
    /// Wrong as printed; the corrected form holds.
    Corrected,
    /// False.
    Refuted,
    /// The numbers support no verdict. Never expected.
    Undecided,
}

impl Assessment {
    /// The verdict of this name, of those that can be expected.
    fn expected(name: &Value) -> Option<Self> {
        let all = [Self::Confirmed, Self::Explained, Self::Corrected, Self::Refuted];
        all.into_iter().find(|verdict| Some(verdict.to_string().as_str()) == name.as_str())
    }

    /// This verdict if the numbers bear it out, otherwise [`Assessment::Undecided`].
    #[must_use]
    pub fn if_shown(self, shown: bool) -> Self {
        if shown { self } else { Self::Undecided }
    }

    /// [`Assessment::Confirmed`] if the claim holds, otherwise this verdict.
    pub(crate) fn unless(self, holds: bool) -> Self {
        if holds { Self::Confirmed } else { self }
    }
}

impl std::fmt::Display for Assessment {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Confirmed => "confirmed",
            Self::Explained => "explained",
            Self::Corrected => "corrected",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
        })
    }
}

impl Paper {
    /// The file of this project.
    ///
    /// # Panics
    ///
    /// Never: a test reads the file that is compiled in.
    pub fn project() -> Self {
        let file = file();
        let claim = |claim: &Table| Printed {
            id: key(claim, "id", text),
            says: key(claim, "says", text),
            place: key(claim, "where", text),
            printed: key(claim, "printed", text),
            unit: optional(claim, "unit", text),
            digits: optional(claim, "digits", count),
            expected: key(claim, "expected", Assessment::expected),
        };
        let reference = |reference: &Table| {
            let digits = key(reference, "value", Value::as_str);
            (key(reference, "id", text), digits.parse().unwrap_or(f64::NAN))
        };
        let equations = key(&file, "equations", Value::as_table);
        Self {
            claims: key(&file, "claim", tables).into_iter().map(claim).collect(),
            failing: ["corrected", "refuted", "form"].map(|fault| key(equations, fault, texts)),
            references: key(&file, "reference", tables).into_iter().map(reference).collect(),
        }
    }

    /// The claim of this name.
    pub fn claim(&self, id: &str) -> Option<&Printed> {
        self.claims.iter().find(|claim| claim.id == id)
    }

    /// The reference number of this name, rounded to a double; NaN, which passes no comparison, if
    /// there is none.
    pub fn reference(&self, id: &str) -> f64 {
        let found = self.references.iter().find(|(name, _)| name == id);
        found.map_or(f64::NAN, |(_, value)| *value)
    }
}

fn file() -> Table {
    parsed(include_str!("../data/paper.toml"))
}
