//! Whether answers are one, and how that is written.

use model::Disagreement;
use serde::{Serialize, Serializer};

/// Whether answers are one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// All differences are within their budgets, and all answers in balance.
    #[default]
    Agreed,
    /// Something is not.
    Disagreed,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if *self == Self::Agreed { "agreed" } else { "disagreed" })
    }
}

/// The key `reasons` with the words, and the numbers beside it.
pub(crate) fn with_sentences<S: Serializer>(
    disagreement: &Disagreement,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Keys<'a> {
        reasons: Vec<String>,
        #[serde(flatten)]
        numbers: &'a Disagreement,
    }
    Keys { reasons: disagreement.sentences(), numbers: disagreement }.serialize(serializer)
}
