//! One rung: reached with its proof, or open with its reason.

use super::reason::Reason;

/// What is known about one rung.
#[derive(Debug, Clone, PartialEq)]
pub enum Status<P> {
    /// It was reached, and this proves it.
    Reached(P),
    /// It was not, for this reason.
    Open(Reason),
}

impl<P> Status<P> {
    /// Whether the rung was reached.
    pub fn is_reached(&self) -> bool {
        matches!(self, Self::Reached(_))
    }

    /// The proof, if the rung was reached.
    pub fn proof(&self) -> Option<&P> {
        match self {
            Self::Reached(proof) => Some(proof),
            Self::Open(_) => None,
        }
    }

    /// The reason, if it was not.
    pub fn reason(&self) -> Option<&Reason> {
        match self {
            Self::Reached(_) => None,
            Self::Open(reason) => Some(reason),
        }
    }
}

/// Nobody has tried.
impl<P> Default for Status<P> {
    fn default() -> Self {
        Self::Open(Reason::NotTried)
    }
}
