//! A motion as columns with units.

use std::path::Path;

use columns::{Column, ColumnsError, Data, Format, Kind, Schema, Spread, TableWriter};
use model::system::System;
use motion::Snapshot;

/// Rows in a group: a few thousand compress well, and little is held in memory.
const GROUP: usize = 4096;

/// Writes stored times as rows.
pub struct Rows {
    table: TableWriter,
    held: Vec<usize>,
    has_impacts: bool,
    columns: Vec<Vec<f64>>,
}

impl Rows {
    /// Begin the table of a system.
    pub fn create(path: &Path, format: Format, system: &System) -> Result<Self, ColumnsError> {
        let joints = system.joints();
        let is_held = |k: &usize| joints[*k].support.at_m().is_some() || system.floor_m().is_some();
        let held: Vec<usize> = (0..joints.len()).filter(is_held).collect();
        let has_impacts = motion::has_impacts(system);
        let columns = describe(system, &held, has_impacts);
        let count = columns.len();
        let schema = Schema { columns, notes: Vec::new() };
        let table = TableWriter::create(path, format, &schema)?;
        Ok(Self { table, held, has_impacts, columns: vec![Vec::new(); count] })
    }

    /// Add a row.
    pub fn add(&mut self, now: &Snapshot) -> Result<(), ColumnsError> {
        let places = now.joints_m.iter().flatten();
        let speeds = now.velocities_m_s.iter().flatten();
        let reactions = self.held.iter().flat_map(|&joint| &now.reactions_n[joint]);
        let cells = [now.time_s, now.kinetic_j, now.potential_j, now.energy_j()];
        let lost = self.has_impacts.then_some(&now.lost_j);
        let cells = cells
            .iter()
            .chain(lost)
            .chain(places)
            .chain(speeds)
            .chain(&now.axial_n)
            .chain(reactions);
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            column.push(*cell);
        }
        if self.columns[0].len() >= GROUP { self.write() } else { Ok(()) }
    }

    /// Write the rest: from here on the file is there.
    pub fn finish(mut self) -> Result<(), ColumnsError> {
        self.write()?;
        self.table.finish()
    }

    fn write(&mut self) -> Result<(), ColumnsError> {
        if self.columns[0].is_empty() {
            return Ok(());
        }
        self.table.write(self.columns.iter_mut().map(|c| Data::F64(std::mem::take(c))).collect())
    }
}

/// What the columns of a joint begin with: `joint_lamp`, and `joint0` where a name begins with a
/// digit, as those of a chain do.
fn joint_column(name: &str) -> String {
    let between = if name.starts_with(|first: char| first.is_ascii_digit()) { "" } else { "_" };
    format!("joint{between}{name}")
}

/// The columns.
fn describe(system: &System, held: &[usize], has_impacts: bool) -> Vec<Column> {
    let column = |name: &str, spread, unit: &str, about: &str| {
        Column::new(name, Kind::F64, spread, unit, about)
    };
    let mut columns = vec![
        column("time_s", Spread::Rising, "s", "Time since the beginning"),
        column("kinetic_j", Spread::Many, "J", "Kinetic energy"),
        column("potential_j", Spread::Many, "J", "Potential energy above the first support"),
        column("energy_j", Spread::Many, "J", "Mechanical energy"),
    ];
    if has_impacts {
        let about = "Energy that was lost in impacts since the beginning";
        columns.push(column("lost_j", Spread::Many, "J", about));
    }
    let joints = system.joints();
    let vectors = |columns: &mut Vec<Column>,
                   kind: &str,
                   unit: &str,
                   about: &str,
                   of: &mut dyn Iterator<Item = usize>| {
        for joint in of {
            for axis in ["x", "y", "z"] {
                let unit_word = unit.replace('/', "_").to_lowercase();
                let name = format!(
                    "{}_{kind}{axis}_{unit_word}",
                    joint_column(&joints[joint].name.text())
                );
                let about = format!("{about} joint {:?} along {axis}", joints[joint].name);
                columns.push(column(&name, Spread::Many, unit, &about));
            }
        }
    };
    let all = 0..joints.len();
    vectors(&mut columns, "", "m", "Place of", &mut all.clone());
    vectors(&mut columns, "v", "m/s", "Velocity of", &mut all.clone());
    for (k, member) in system.members().iter().enumerate() {
        let about = format!(
            "Axial force of member {} from {:?} to {:?}, tension positive",
            k + 1,
            joints[member.from].name,
            joints[member.to].name
        );
        columns.push(column(&format!("bar{}_axial_n", k + 1), Spread::Many, "N", &about));
    }
    let about = "Force of the ground or floor on";
    vectors(&mut columns, "f", "N", about, &mut held.iter().copied());
    columns
}
