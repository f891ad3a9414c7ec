//! Weights at the joints of a chain besides those of its bars.

use numerics::{DoubleDouble, Interval};

/// What hangs at each joint, kg: none of it is negative.
#[derive(Debug, Clone, Default)]
pub(crate) struct JointLoads {
    /// By joint, 0..=n; nothing where nothing hangs.
    kg: Vec<Option<DoubleDouble>>,
}

impl JointLoads {
    /// No joint bears more than the bars leave it.
    pub(crate) const NONE: &'static Self = &Self { kg: Vec::new() };

    /// These weights at the joints 0..=n, kg.
    pub(crate) fn new(kg: Vec<Option<DoubleDouble>>) -> Self {
        Self { kg }
    }

    /// Whether nothing hangs at a joint.
    pub(crate) fn none_at(&self, joint: usize) -> bool {
        self.precisely_at(joint).is_none()
    }

    /// What hangs at a joint, kg.
    pub(crate) fn at(&self, joint: usize) -> Option<Interval> {
        self.precisely_at(joint).map(DoubleDouble::interval)
    }

    /// The same to twice the usual precision.
    pub(crate) fn precisely_at(&self, joint: usize) -> Option<DoubleDouble> {
        self.kg.get(joint).copied().flatten()
    }

    /// A weight and what hangs at a joint.
    pub(crate) fn added_to(&self, weight: Interval, joint: usize) -> Interval {
        match self.at(joint) {
            Some(load) if weight == Interval::ZERO => load,
            Some(load) => weight + load,
            None => weight,
        }
    }
}
