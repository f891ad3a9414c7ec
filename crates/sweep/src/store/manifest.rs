//! What a folder of a sweep says about itself.

use std::ops::Range;
use std::path::Path;

use model::system_file::Described;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::identify::Member;
use crate::reached::Reached;
use crate::store::description::{MANIFEST, read_json};
use crate::store::shard::{Shard, part_seeds};

use crate::store::error::{Result, StoreError};
use crate::summary::{Comparison, Summary};

/// Everything that the rows of a sweep depend on, and which of them are here: `manifest.json`.
///
/// Two sweeps with the same manifest have the same rows to the last bit, on whatever machine: the
/// solvers take their sines from their own kernels. (Of the system's library they use `hypot`
/// alone, once, for the level distance of the anchors.)
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// [`SCHEMA_VERSION`](crate::SCHEMA_VERSION).
    pub schema_version: u32,
    /// The program and its version: another version may take other steps.
    pub program: String,
    /// The system.
    pub system: SystemText,
    /// How many seeds the whole sweep has.
    pub seeds: u64,
    /// The number that all of them come from.
    pub seed_number: u64,
    /// How they are spread: `uniform`, `sobol` or `grid`; `places` where the joints of a system start
    /// at random in space, `released` where it is let go from positions at random.
    pub source: String,
    /// Who was asked: `lagrange`, `energy`, or both in this order; `motion` of what is released.
    pub solvers: Vec<String>,
    /// How what is released moves; nothing where no motion is followed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub release: Option<Release>,
    /// Names of the columns of starting values, if they are written.
    pub angles: Vec<String>,
    /// The equilibria that outcomes 0, 1, 2, ... stand for; of a sweep, the proven ones. Where the
    /// census has not proved that there are no others, those that are reached are in
    /// [`StoreSummary::discovered`](crate::StoreSummary::discovered).
    pub equilibria: Vec<Member>,
    /// Whether the census has proved that there are no others.
    pub equilibria_complete: bool,
    /// `parquet` or `csv`.
    pub format: String,
    /// Seeds of a part file; the last one may have fewer.
    pub part_seeds: u64,
    /// Which shard is here.
    pub shard: Shard,
    /// The seeds of this shard.
    pub range: Range<u64>,
}

/// How systems move that are let go from positions at random, until they are at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Release {
    /// Longest time followed, s.
    pub time_s: f64,
    /// Length of a step, s.
    pub step_s: f64,
    /// Time between two looks at whether it is at rest, s.
    pub span_s: f64,
    /// Drag of a medium, 1/s.
    pub damping_1_s: f64,
    /// Friction in the joints, N m s.
    pub friction_n_m_s: f64,
    /// Order of the steps: 2, 4 or 8.
    pub order: u8,
    /// At rest are joints that are slower than this times `sqrt(g L)` and gain less speed than this
    /// times `g`.
    pub rest: f64,
}

/// A system as text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SystemText {
    /// Its name.
    pub name: String,
    /// Its system file, as the program writes it: comments and order of the user's file do not
    /// matter.
    pub text: String,
    /// SHA-256 of the text.
    pub sha256: String,
    /// What energies are compared in: total weight times total length, J.
    pub unit_j: f64,
}

impl From<&model::system::System> for SystemText {
    fn from(system: &model::system::System) -> Self {
        let text = model::system_file::write(system);
        let weight_n = system.total_mass_kg() * system.gravity_m_s2();
        Self {
            name: system.name().to_owned(),
            sha256: digest(text.as_bytes()),
            text,
            unit_j: weight_n * system.total_length_m(),
        }
    }
}

/// SHA-256 in hexadecimal digits, as `sha256sum` prints it.
pub(crate) fn digest(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    let digit = |nibble: u8| char::from_digit(nibble.into(), 16).unwrap_or('0');
    bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
}

/// Bytes of a row of one solver, as the named cases have them: the fewest and the most.
const ROW_BYTES: [u64; 2] = [6, 20];

impl Manifest {
    /// The [`source`](Self::source) of starts that are places of joints in space.
    pub const PLACES: &'static str = "places";

    /// Whether a comparison says something of the list of equilibria rather than of the solvers: an
    /// equilibrium that a list lacks which is not complete.
    pub fn explains(&self, comparison: Comparison) -> bool {
        comparison == Comparison::NotListed && !self.equilibria_complete
    }

    /// Bytes of all files of this shard, the fewest and the most to be expected.
    pub fn expected_bytes(&self) -> [u64; 2] {
        let rows = (self.range.end - self.range.start) * self.solvers.len() as u64;
        ROW_BYTES.map(|bytes| rows.saturating_mul(bytes))
    }

    /// Read the manifest of a folder.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if there is none, or none that this program understands.
    pub fn read(folder: &Path) -> Result<Self> {
        let path = folder.join(MANIFEST);
        if !path.exists() {
            return Err(StoreError::NoSweep { path: folder.to_owned(), missing: MANIFEST });
        }
        read_json(&path)
    }

    /// How many parts the whole sweep has.
    pub fn parts(&self) -> u64 {
        self.seeds.div_ceil(self.part_seeds.max(1))
    }

    /// The seeds of a part.
    pub fn seeds_of(&self, part: u64) -> Range<u64> {
        let at = |part: u64| part.saturating_mul(self.part_seeds).min(self.seeds);
        at(part)..at(part + 1)
    }

    /// The name of the file of a part.
    pub fn file_of(&self, part: u64) -> String {
        format!("part-{part:06}.{}", self.format)
    }

    /// The same sweep, another shard of it.
    #[must_use]
    pub fn with_shard(mut self, shard: Shard) -> Self {
        self.part_seeds = part_seeds(self.seeds);
        let parts = shard.parts(self.parts());
        self.range = self.seeds_of(parts.start).start..self.seeds_of(parts.end).start;
        self.shard = shard;
        self
    }

    /// Nothing counted yet, by this list and what was discovered.
    pub(crate) fn summary(&self, discovered: &[Member]) -> Summary {
        Summary::new(self.equilibria.iter().chain(discovered), self.system.unit_j)
    }

    /// Nothing reached yet, of a sweep with a list that grows; none of others.
    pub(crate) fn nothing_reached(&self) -> Result<Option<Reached>> {
        // Of starts in space the list is whole before the first is followed.
        let in_space = self.release.is_some() || self.source == Self::PLACES;
        if self.equilibria_complete || in_space {
            return Ok(None);
        }
        let unusable = |reason: String| StoreError::Description { path: MANIFEST.into(), reason };
        let described = model::system_file::parse(&self.system.text, "system.text");
        let problem = match described.map_err(|error| unusable(error.to_string()))? {
            Described::Chain(problem) => problem,
            Described::System(system) => {
                let row = system
                    .as_row()
                    .ok_or_else(|| unusable("system.text is not a row".to_owned()))?;
                row.problem().clone()
            }
        };
        Ok(Some(Reached::new(&problem, self.equilibria.len())))
    }

    /// As it stands in the file.
    pub(crate) fn json(&self) -> String {
        // Strings for keys, and no number that JSON does not have: it cannot fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// The first thing in which another manifest differs: its key, what stands here, and what
    /// there.
    pub(crate) fn difference(&self, other: &Self) -> Option<(String, String, String)> {
        // Both through the same reader of numbers.
        let value = |m: &Self| serde_json::from_str::<Value>(&m.json()).unwrap_or_default();
        difference("", &value(self), &value(other))
    }
}

fn difference(key: &str, a: &Value, b: &Value) -> Option<(String, String, String)> {
    if let (Value::Object(a), Value::Object(b)) = (a, b) {
        let keys: std::collections::BTreeSet<_> = a.keys().chain(b.keys()).collect();
        return keys.into_iter().find_map(|name| {
            let path = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
            let of = |map: &serde_json::Map<_, _>| map.get(name).cloned().unwrap_or_default();
            difference(&path, &of(a), &of(b))
        });
    }
    (a != b).then(|| (key.to_owned(), short(a), short(b)))
}

/// Longest value shown in an error, characters.
const SHOWN: usize = 80;

fn short(value: &Value) -> String {
    let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    match text.char_indices().nth(SHOWN) {
        Some((at, _)) => format!("{}...", &text[..at]),
        None => text,
    }
}
