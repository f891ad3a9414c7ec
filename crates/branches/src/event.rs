//! What happens to branches: folds, straight chains, branch points, exchanges.

use serde::Serialize;

/// A position at which branches meet or change.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Event {
    /// Its number, from 1.
    pub id: usize,
    /// What happens.
    #[serde(flatten)]
    pub kind: EventKind,
    /// Position on the path.
    pub position: f64,
    /// How far `position` may be off, an estimate.
    pub position_error: f64,
    /// The values of the parameters there.
    pub values: Vec<f64>,
    /// How far they may be off.
    pub values_error: Vec<f64>,
    /// Distance of the anchors there, m.
    pub span_m: f64,
    /// Numbers of the branches that take part: those that end or begin in it, or the one that passes.
    pub branches: Vec<usize>,
    /// Angles of the bars, rad.
    pub angles_rad: Vec<f64>,
    /// Energy, J above joint 0.
    pub energy_j: f64,
    /// Largest residual of the equations of equilibrium there, without unit.
    pub residual: f64,
    /// Smallest over largest eigenvalue of the second derivative in the plane, bordered by the
    /// closure: 0 in folds and branch points.
    pub singular: f64,
}

/// Kinds of events.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum EventKind {
    /// Two branches whose indices in the plane differ by one meet and end.
    Fold,
    /// Two branches meet where the chain lies on one line: the force along it is indeterminate or
    /// infinite.
    Straight,
    /// A branch changes its index in the plane: others branch off it.
    BranchPoint,
    /// A branch changes its index in space only: it gains or loses stability against motions out of
    /// the plane.
    SpaceExchange {
        /// Index in space before and after.
        from: usize,
        /// Index in space after.
        to: usize,
    },
    /// A bar changes between tension and compression; its number, from 1.
    Unloaded {
        /// Number of the bar, from 1.
        bar: usize,
    },
}

impl EventKind {
    /// The name of the kind, for tables.
    ///
    /// ```
    /// assert_eq!(branches::EventKind::SpaceExchange { from: 0, to: 1 }.name(), "space-exchange");
    /// ```
    pub fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Straight => "straight",
            Self::BranchPoint => "branch-point",
            Self::SpaceExchange { .. } => "space-exchange",
            Self::Unloaded { .. } => "unloaded",
        }
    }
}
