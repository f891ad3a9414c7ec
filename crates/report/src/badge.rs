//! A verdict as it is shown: a word and a tone.

use std::borrow::Cow;

use paper::equations::{EquationAudit, Fault, Validity};
use paper::printed::Assessment;

/// What a verdict means for what was judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// It stands.
    Good,
    /// It stands once mended, or is accounted for.
    Mended,
    /// Neither good nor bad.
    Neutral,
    /// It names something, and was not judged.
    Given,
    /// It falls.
    Bad,
}

/// A verdict for the eye. The tone decides colour and sign, the word says it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Badge {
    /// Colour and sign.
    pub tone: Tone,
    /// The word.
    pub word: Cow<'static, str>,
}

impl Badge {
    /// A badge.
    pub fn new(tone: Tone, word: impl Into<Cow<'static, str>>) -> Self {
        Self { tone, word: word.into() }
    }

    /// Of a claim of the paper.
    pub fn of_claim(verdict: Assessment, as_expected: bool) -> Self {
        let tone = match verdict {
            _ if !as_expected => Tone::Bad,
            Assessment::Confirmed => Tone::Good,
            Assessment::Explained | Assessment::Corrected => Tone::Mended,
            Assessment::Refuted | Assessment::Undecided => Tone::Bad,
        };
        let aside = if as_expected { "" } else { " (not expected)" };
        Self::new(tone, format!("{verdict}{aside}"))
    }

    /// Of an equation: its validity, and the kind of its fault if it has one.
    pub fn of_equation(validity: Validity, fault: Option<Fault>) -> Self {
        match (validity, fault) {
            (Validity::Holds, _) => Self::new(Tone::Good, "holds"),
            (Validity::Definition, _) => Self::new(Tone::Given, "definition"),
            (Validity::Remark, _) => Self::new(Tone::Neutral, "remark"),
            (Validity::Refuted, _) => Self::new(Tone::Bad, "refuted"),
            (Validity::Corrected, Some(Fault::Form)) => Self::new(Tone::Mended, "form corrected"),
            (Validity::Corrected, Some(Fault::Digits)) => {
                Self::new(Tone::Mended, "right to its grid")
            }
            (Validity::Corrected, _) => Self::new(Tone::Mended, "holds after correction"),
        }
    }

    /// Of a row of the audit.
    pub fn of_row(row: &EquationAudit) -> Self {
        Self::of_equation(row.verdict, row.fault)
    }

    /// Of a comparison.
    pub fn of_agreement(agreed: bool) -> Self {
        if agreed { Self::new(Tone::Good, "agreed") } else { Self::new(Tone::Bad, "disagreed") }
    }

    /// Of a rung of evidence.
    pub fn of_rung(reached: bool) -> Self {
        if reached {
            Self::new(Tone::Good, "reached")
        } else {
            Self::new(Tone::Neutral, "not reached")
        }
    }

    /// A sign for those who see no colour.
    pub fn sign(&self) -> &'static str {
        match self.tone {
            Tone::Good => "✓",
            Tone::Mended => "✎",
            Tone::Neutral => "–",
            Tone::Given => "≔",
            Tone::Bad => "✗",
        }
    }
}
