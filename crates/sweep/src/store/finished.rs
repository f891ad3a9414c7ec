//! What a finished sweep says of itself.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::record::Failure;
use crate::store::description::SCHEMA_VERSION;
use crate::store::manifest::Manifest;
use crate::summary::Summary;

/// What `summary.json` says of a part.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PartRecord {
    /// The name of its file.
    pub file: String,
    /// Its seeds.
    pub seeds: Range<u64>,
    /// Length of the file, bytes.
    pub bytes: u64,
    /// SHA-256 of the file.
    pub sha256: String,
}

/// `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoreSummary {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// What became of the seeds.
    pub outcomes: Summary,
    /// The parts, in order.
    pub parts: Vec<PartRecord>,
}

impl StoreSummary {
    /// Of parts in order.
    pub(crate) fn of(
        manifest: &Manifest,
        parts: impl Iterator<Item = (PartRecord, Summary)>,
    ) -> Self {
        let mut outcomes = manifest.summary();
        let parts = parts
            .map(|(record, summary)| {
                outcomes.merge(&summary);
                record
            })
            .collect();
        Self { schema_version: SCHEMA_VERSION, outcomes, parts }
    }

    /// Whether a check failed: a start converged to what is in no complete list, or the solvers
    /// contradict each other. Failures to converge are results, and so is what a list that is not
    /// complete lacks.
    #[must_use]
    pub fn check_failed(&self, manifest: &Manifest) -> bool {
        let wrong = self.outcomes.comparisons().any(|(comparison, count)| {
            count > 0 && comparison.should_not_be() && !manifest.explains(comparison)
        });
        let unlisted = Failure::Unlisted as i16;
        let tally = self.outcomes.tally();
        let mut outcomes = tally.solvers.iter().flat_map(|(_, solver)| solver.0.keys());
        wrong || (manifest.equilibria_complete && outcomes.any(|outcome| *outcome == unlisted))
    }
}
