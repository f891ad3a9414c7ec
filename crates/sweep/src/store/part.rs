//! One part: a file of consecutive seeds.

use std::fs::File;
use std::io::{Read as _, Write};
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use columns::{Column, Data, Format, Kind, Schema, Spread, TableWriter, read_notes, read_table};
use sha2::{Digest as _, Sha256};

use crate::identify::Member;
use crate::reached::{Reached, Renumbering};
use crate::record::{Chunk, Failure, Outcomes};
use crate::store::compute::Compute;
use crate::store::error::{Result, StoreError};
use crate::store::finished::PartRecord;
use crate::store::manifest::{Manifest, hexadecimal};
use crate::summary::Summary;

/// Rows of a row group: some megabytes of columns, held per thread until they are encoded.
const GROUP_SEEDS: u64 = 1 << 17;

const OUTCOME: &str = "the equilibrium reached, as its number in `equilibria` of the manifest and, \
    behind these, of `discovered` in the summary; or -1: the iteration limit was reached, -2: stalled, \
    -3: a number overflowed or was undefined, -4: converged to something that is in no list";

const RESTING: &str = "where it comes to rest, as its number in `equilibria` of the manifest; or -1: \
    not at rest when the time is up, -2: no step can be taken, or no position found to begin with, \
    -4: at rest where nothing is listed";

/// What the four columns of a solver say: outcome, iterations, residual, energy.
fn abouts(manifest: &Manifest) -> [String; 4] {
    let Some(release) = &manifest.release else {
        let iterations = "iterations spent".to_owned();
        let residual = "the solver's own residual where it stopped".to_owned();
        let energy = "potential energy where it stopped, above the height of joint 0".to_owned();
        return [OUTCOME.to_owned(), iterations, residual, energy];
    };
    [
        RESTING.to_owned(),
        format!("time until it was at rest, in spans of {} s", release.span_s),
        "largest acceleration of a joint at the end, in units of gravity, or largest speed in units of \
         sqrt(g L) if that is more"
            .to_owned(),
        "potential energy at the end, above the height of the first support".to_owned(),
    ]
}

/// The columns of a sweep.
pub fn schema(manifest: &Manifest) -> Schema {
    let mut columns = vec![Column::new(
        "seed",
        Kind::U64,
        Spread::Rising,
        "1",
        "number of the start, from 0; with the seed number and the source it says where it is",
    )];
    for name in &manifest.angles {
        columns.push(Column::new(name, Kind::F64, Spread::Many, "rad", "angle of the start"));
    }
    let [outcome, iterations, residual, energy] = abouts(manifest);
    for solver in &manifest.solvers {
        let mut push = |name, kind, spread, unit, about: &str| {
            columns.push(Column::new(&format!("{solver}_{name}"), kind, spread, unit, about));
        };
        push("outcome", Kind::I16, Spread::Few, "1", &outcome);
        push("iterations", Kind::U16, Spread::Few, "1", &iterations);
        push("residual", Kind::F64, Spread::Many, "1", &residual);
        push("energy_j", Kind::F64, Spread::Many, "J", &energy);
    }
    let notes = [
        ("program", manifest.program.clone()),
        ("system", manifest.system.name.clone()),
        ("system_sha256", manifest.system.sha256.clone()),
        ("seed_number", manifest.seed_number.to_string()),
        ("source", manifest.source.clone()),
    ];
    let notes = notes.into_iter().map(|(key, value)| (format!("funicular.{key}"), value)).collect();
    Schema { columns, notes }
}

pub fn format(manifest: &Manifest) -> Format {
    if manifest.format == Format::Csv.extension() { Format::Csv } else { Format::Parquet }
}

/// What whoever computes a part is told, and may tell.
pub struct Watch<'a> {
    /// Set to stop soon.
    pub stop: &'a AtomicBool,
    /// Told of seeds that are done.
    pub done: &'a (dyn Fn(u64) + Sync),
    /// Told of a list that has grown, and how many numbers it had given before.
    pub grown: &'a (dyn Fn(&Reached, usize) + Sync),
}

/// Compute a part and write it to a file; `None` if it was stopped before the end, and then nothing
/// is left of it. What is reached beside the proven list is numbered in `reached`, if there is one,
/// and nothing is counted then: the numbers are not the last.
pub fn write(
    path: &Path,
    manifest: &Manifest,
    part: u64,
    compute: &impl Compute,
    mut reached: Option<&mut Reached>,
    watch: &Watch<'_>,
) -> Result<Option<Summary>> {
    let seeds = manifest.seeds_of(part);
    let mut summary = manifest.summary(&[]);
    let mut table = TableWriter::create(path, format(manifest), &schema(manifest))?;
    for group in steps(&seeds, GROUP_SEEDS) {
        let mut rows: Vec<Data> = Vec::new();
        for range in steps(&group, compute.chunk_seeds().max(1)) {
            if watch.stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let count = range.end - range.start;
            let chunk = match reached.as_deref_mut() {
                None => compute.chunk(range.clone()),
                Some(reached) => {
                    let before = reached.given();
                    let chunk = compute.chunk_reaching(range.clone(), reached);
                    (watch.grown)(reached, before);
                    chunk
                }
            };
            // Bugs of the solvers' side, reported instead of written.
            if !fits(&chunk, &range, manifest) {
                return Err(StoreError::part(path, "a run of seeds came back incomplete"));
            }
            let codes = reached.as_deref().map_or(manifest.equilibria.len(), Reached::codes);
            if let Some(outcome) = unknown_outcome(&chunk, codes) {
                return Err(StoreError::part(path, format!("there is no outcome {outcome}")));
            }
            if reached.is_none() {
                summary.add(&chunk);
            }
            let angles =
                if manifest.angles.is_empty() { Vec::new() } else { compute.angles(range) };
            append(&mut rows, columns_of(chunk, angles));
            (watch.done)(count);
        }
        table.write(rows)?;
    }
    table.finish()?;
    Ok(Some(summary))
}

/// Put rows behind others.
fn append(rows: &mut Vec<Data>, mut more: Vec<Data>) {
    if rows.is_empty() {
        *rows = more;
    } else {
        for (column, more) in rows.iter_mut().zip(&mut more) {
            column.append(more);
        }
    }
}

/// Write the rows of a file into another one, with other numbers and in the groups in which they
/// were computed.
pub fn renumber(
    from: &Path,
    to: &Path,
    manifest: &Manifest,
    renumbering: &Renumbering,
) -> Result<()> {
    let (format, schema) = (format(manifest), schema(manifest));
    let mut table = TableWriter::create(to, format, &schema)?;
    let mut rows: Vec<Data> = Vec::new();
    let mut written = Ok(());
    read_table(from, format, &schema, &mut |columns| {
        if written.is_err() {
            return;
        }
        let mut columns = columns.to_vec();
        for column in &mut columns {
            if let Data::I16(codes) = column {
                for code in codes {
                    *code = renumbering.apply(*code);
                }
            }
        }
        append(&mut rows, columns);
        // Groups are read in equal parts.
        if rows.first().map_or(0, Data::len) as u64 >= GROUP_SEEDS {
            written = table.write(std::mem::take(&mut rows));
        }
    })?;
    written?;
    if !rows.is_empty() {
        table.write(rows)?;
    }
    Ok(table.finish()?)
}

/// A range in steps; the last one may be shorter.
fn steps(range: &Range<u64>, step: u64) -> impl Iterator<Item = Range<u64>> + use<> {
    let end = range.end;
    (range.start..end)
        .step_by(usize::try_from(step).unwrap_or(usize::MAX))
        .map(move |start| start..end.min(start.saturating_add(step)))
}

/// Whether a chunk has all rows of all solvers that were asked.
fn fits(chunk: &Chunk, range: &Range<u64>, manifest: &Manifest) -> bool {
    let rows = range.end - range.start;
    let whole = |o: &Outcomes| {
        let lengths = [o.outcome.len(), o.iterations.len(), o.residual.len(), o.energy_j.len()];
        lengths.iter().all(|length| *length as u64 == rows)
    };
    let names = chunk.outcomes.iter().map(|outcomes| &outcomes.solver);
    chunk.seeds == *range && names.eq(&manifest.solvers) && chunk.outcomes.iter().all(whole)
}

/// An outcome that is none of so many entries and no [`Failure`].
fn unknown_outcome(chunk: &Chunk, entries: usize) -> Option<i16> {
    let known = |outcome: i16| match usize::try_from(outcome) {
        Ok(entry) => entry < entries,
        Err(_) => outcome >= Failure::Unlisted as i16,
    };
    let mut outcomes = chunk.outcomes.iter().flat_map(|o| &o.outcome).copied();
    outcomes.find(|outcome| !known(*outcome))
}

fn columns_of(chunk: Chunk, angles: Vec<Vec<f64>>) -> Vec<Data> {
    let mut columns = vec![Data::U64(chunk.seeds.collect())];
    columns.extend(angles.into_iter().map(Data::F64));
    for outcomes in chunk.outcomes {
        columns.push(Data::I16(outcomes.outcome));
        columns.push(Data::U16(outcomes.iterations));
        columns.push(Data::F64(outcomes.residual));
        columns.push(Data::F64(outcomes.energy_j));
    }
    columns
}

/// Read a part back, and prove that it is of this sweep and holds exactly its seeds, each once and
/// in order. Its numbers are those of the manifest and, behind them, of what was discovered.
pub fn read(
    folder: &Path,
    manifest: &Manifest,
    discovered: &[Member],
    part: u64,
) -> Result<(PartRecord, Summary)> {
    let path = folder.join(manifest.file_of(part));
    let wanted = manifest.seeds_of(part);
    let entries = manifest.equilibria.len() + discovered.len();
    let mut summary = manifest.summary(discovered);
    let mut next = wanted.start;
    let mut gap = None;
    let mut unknown = None;
    read_table(&path, format(manifest), &schema(manifest), &mut |columns| {
        let Some(Data::U64(seeds)) = columns.first() else { return };
        let first = next;
        for seed in seeds {
            if *seed != next {
                gap.get_or_insert((next, *seed));
            }
            next = next.wrapping_add(1);
        }
        let chunk = chunk_of(columns, first, manifest);
        match unknown_outcome(&chunk, entries) {
            Some(outcome) => unknown = Some(outcome),
            None => summary.add(&chunk),
        }
    })?;
    if let Some(outcome) = unknown {
        return Err(StoreError::part(&path, format!("there is no outcome {outcome}")));
    }
    if let Some((wanted, found)) = gap {
        return Err(StoreError::part(&path, format!("seed {found} stands where {wanted} should")));
    }
    if next != wanted.end {
        let (rows, all) = (next - wanted.start, wanted.end - wanted.start);
        return Err(StoreError::part(&path, format!("there are {rows} seeds of {all}")));
    }
    if format(manifest) == Format::Parquet {
        let notes = read_notes(&path)?;
        for (key, wanted) in schema(manifest).notes {
            let found = notes.iter().find(|note| note.0 == key).map(|note| &note.1);
            if found != Some(&wanted) {
                let found = found.map_or("missing", String::as_str);
                let reason = format!("`{key}` at its end is {found}, not {wanted}");
                return Err(StoreError::part(&path, reason));
            }
        }
    }
    Ok((record(&path, manifest.file_of(part), wanted)?, summary))
}

/// Rows read back, as they were computed. The schema was checked: every column is there.
fn chunk_of(columns: &[Data], seed: u64, manifest: &Manifest) -> Chunk {
    let seeds = seed..seed + columns[0].len() as u64;
    let mut outcomes = vec![];
    let before = 1 + manifest.angles.len();
    for (solver, columns) in manifest.solvers.iter().zip(columns[before..].chunks_exact(4)) {
        if let [
            Data::I16(outcome),
            Data::U16(iterations),
            Data::F64(residual),
            Data::F64(energy_j),
        ] = columns
        {
            outcomes.push(Outcomes {
                solver: solver.clone(),
                outcome: outcome.clone(),
                iterations: iterations.clone(),
                residual: residual.clone(),
                energy_j: energy_j.clone(),
            });
        }
    }
    Chunk { seeds, outcomes }
}

/// Length and digest of a file, of these seeds.
pub fn record(path: &Path, file: String, seeds: Range<u64>) -> Result<PartRecord> {
    let (bytes, sha256) =
        copied(path, &mut std::io::sink(), |error| StoreError::file(path, error))?;
    Ok(PartRecord { file, seeds, bytes, sha256 })
}

/// Copy a file; its length and digest.
pub fn copied(
    from: &Path,
    to: &mut impl Write,
    unwritten: impl Fn(std::io::Error) -> StoreError,
) -> Result<(u64, String)> {
    let unread = |error| StoreError::file(from, error);
    let mut reader = File::open(from).map_err(unread)?;
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 17];
    let mut bytes = 0;
    loop {
        let read = reader.read(&mut buffer).map_err(unread)?;
        if read == 0 {
            return Ok((bytes, hexadecimal(&hasher.finalize())));
        }
        hasher.update(&buffer[..read]);
        to.write_all(&buffer[..read]).map_err(&unwritten)?;
        bytes += read as u64;
    }
}
