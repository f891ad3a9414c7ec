//! What the paper prints, with the place of each claim: `validation/paper.toml`.

use serde::{Deserialize, Serialize};

/// Printed claims, and the reference numbers they are held against.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Paper {
    /// Claims in the order of the paper (kind `paper`).
    #[serde(rename = "claim")]
    pub claims: Vec<Printed>,
    /// Which equations are expected to fail as printed.
    pub equations: FailingEquations,
    /// Numbers established elsewhere (kind `external`).
    #[serde(rename = "reference")]
    pub references: Vec<Reference>,
}

/// One claim as printed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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
    #[serde(default)]
    pub unit: Option<String>,
    /// Decimals printed, if a number is.
    #[serde(default)]
    pub digits: Option<usize>,
    /// The verdict that this project has come to.
    pub expected: Assessment,
}

impl Printed {
    /// The printed number; NaN, which no verdict survives, if none is.
    #[must_use]
    pub fn value(&self) -> f64 {
        if self.digits.is_none() {
            return f64::NAN;
        }
        self.printed.parse().unwrap_or(f64::NAN)
    }

    /// Whether a value rounds to exactly what is printed.
    #[must_use]
    pub fn rounds_to(&self, value: f64) -> bool {
        self.digits.is_some_and(|digits| format!("{value:.digits$}") == self.printed)
    }

    /// Whether it is a number of things, an integer, and no measure.
    #[must_use]
    pub fn is_count(&self) -> bool {
        /// Units of what is measured; all others count.
        const MEASURED: [&str; 8] = ["deg", "rad", "mg", "mgl", "mgl/rad", "l", "%", "s"];
        self.digits == Some(0) && self.unit.as_deref().is_some_and(|unit| !MEASURED.contains(&unit))
    }
}

/// What the numbers say about a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
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
    /// This verdict if the numbers bear it out, otherwise [`Assessment::Undecided`].
    #[must_use]
    pub fn if_shown(self, shown: bool) -> Self {
        if shown { self } else { Self::Undecided }
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

/// The rows of the audit of equations that are expected to fail, by the number of the equation, in
/// the order of the audit; an equation with two faults stands twice.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FailingEquations {
    /// Wrong as printed; the corrected form holds.
    pub corrected: Vec<String>,
    /// False, and no correction of the print would save it.
    pub refuted: Vec<String>,
    /// Of the corrected ones those with a fault of form alone.
    pub form: Vec<String>,
}

/// One reference number.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Its name in this project.
    pub id: String,
    /// All its digits.
    pub value: String,
    /// Its unit.
    pub unit: String,
    /// How and by whom it was established.
    pub source: String,
}

impl Paper {
    /// The file of this project.
    ///
    /// # Panics
    ///
    /// Never: a test reads the file that is compiled in.
    #[must_use]
    pub fn project() -> Self {
        toml::from_str(include_str!("../data/paper.toml"))
            .expect("validation/paper.toml is read by a test")
    }

    /// The claim of this name.
    #[must_use]
    pub fn claim(&self, id: &str) -> Option<&Printed> {
        self.claims.iter().find(|claim| claim.id == id)
    }

    /// The reference number of this name, rounded to a double; NaN, which passes no comparison, if
    /// there is none.
    #[must_use]
    pub fn reference(&self, id: &str) -> f64 {
        let found = self.references.iter().find(|reference| reference.id == id);
        found.and_then(|reference| reference.value.parse().ok()).unwrap_or(f64::NAN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_its_source() {
        let paper = Paper::project();
        let mut ids = Vec::new();
        for claim in &paper.claims {
            assert!(!claim.says.is_empty() && !claim.place.is_empty() && !claim.printed.is_empty());
            assert_ne!(claim.expected, Assessment::Undecided, "{}", claim.id);
            if let Some(digits) = claim.digits {
                // The printed number has the digits that the file says it has.
                let decimals = claim.printed.split_once('.').map_or(0, |(_, tail)| tail.len());
                assert_eq!((decimals, claim.value().is_finite()), (digits, true), "{}", claim.id);
                assert!(claim.unit.is_some(), "{}", claim.id);
            }
            ids.push(format!("claim {}", claim.id));
        }
        for reference in &paper.references {
            assert!(paper.reference(&reference.id).is_finite(), "{}", reference.id);
            assert!(!reference.unit.is_empty() && !reference.source.is_empty());
            ids.push(format!("reference {}", reference.id));
        }
        ids.sort();
        assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "a name is taken twice");
        assert!(paper.reference("no such number").is_nan());
    }

    #[test]
    fn printed_digits_decide() {
        let paper = Paper::project();
        let energy = paper.claim("ix-energy").unwrap();
        assert!(energy.rounds_to(2.335_469) && energy.rounds_to(2.335_465_1));
        assert!(!energy.rounds_to(2.335_464_9) && !energy.rounds_to(f64::NAN));
    }
}
