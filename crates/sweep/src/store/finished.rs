//! What a finished sweep says of itself.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::identify::Member;
use crate::reached::Discovered;
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
    /// What the seeds reached beside the list of the manifest, where that is not complete: its
    /// numbers follow those.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub discovered: Option<Discovered>,
    /// The parts, in order.
    pub parts: Vec<PartRecord>,
}

impl StoreSummary {
    /// Of parts in order.
    pub(crate) fn of(
        manifest: &Manifest,
        discovered: Option<Discovered>,
        parts: impl Iterator<Item = (PartRecord, Summary)>,
    ) -> Self {
        let list = discovered.as_ref().map_or(&[][..], |discovered| &discovered.equilibria);
        let mut outcomes = manifest.summary(list);
        let parts = parts
            .map(|(record, summary)| {
                outcomes.merge(&summary);
                record
            })
            .collect();
        if discovered.is_some() {
            outcomes.leave_out_unlisted();
        }
        Self { schema_version: SCHEMA_VERSION, outcomes, discovered, parts }
    }

    /// The equilibria that outcomes 0, 1, 2, ... stand for: those of the manifest, then what was
    /// discovered.
    pub fn equilibria<'a>(&'a self, manifest: &'a Manifest) -> impl Iterator<Item = &'a Member> {
        let discovered = self.discovered.iter().flat_map(|discovered| &discovered.equilibria);
        manifest.equilibria.iter().chain(discovered)
    }

    /// The equilibrium that an outcome stands for; none of a failure.
    pub fn equilibrium<'a>(&'a self, manifest: &'a Manifest, outcome: i16) -> Option<&'a Member> {
        self.equilibria(manifest).nth(usize::try_from(outcome).ok()?)
    }

    /// Energy, J, from which on equilibria that were reached are in no list; none where all are.
    pub fn listed_below_j(&self) -> Option<f64> {
        self.discovered.as_ref().and_then(|discovered| discovered.below_j)
    }

    /// Whether a check failed: a start converged to what is in no complete list, or the solvers
    /// contradict each other. Failures to converge are results, and so is what a list that is not
    /// complete lacks.
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
