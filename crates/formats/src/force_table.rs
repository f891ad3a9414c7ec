//! Forces at joints as functions of time, from a table.

use std::collections::HashMap;

use model::name_of_cell;

use crate::error::{Result, Wrong};
use crate::sheet::Sheet;

const COLUMNS: &[&str] = &["time_s", "joint", "x_n", "y_n", "z_n"];

/// Forces at joints over time: what the table says at its times, linear between them, zero before
/// the first and after the last.
///
/// ```
/// use formats::ForceTable;
/// let text = "time_s,joint,x_n,y_n,z_n\n0,P,0,0,0\n2,P,10,0,0\n";
/// let table = ForceTable::parse(text, "wind.csv")?;
/// let (joint, forces) = &table.joints()[0];
/// assert_eq!((joint.as_str(), forces.at(0.5), forces.at(2.5)), ("P", [2.5, 0.0, 0.0], [0.0; 3]));
/// # Ok::<(), formats::FormatError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ForceTable {
    joints: Vec<(String, ForceOverTime)>,
}

/// A force over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ForceOverTime {
    /// Rising times, s, with the force at each, world frame, N.
    points: Vec<(f64, [f64; 3])>,
}

impl ForceTable {
    /// The table of a CSV text: a line per time and joint, columns `time_s`, `joint`, `x_n`, `y_n`,
    /// `z_n`. The times of each joint rise.
    ///
    /// # Errors
    /// [`FormatError`](crate::FormatError) with the line and the reason.
    pub fn parse(text: &str, file: &str) -> Result<Self> {
        let sheet = Sheet::parse(file, text, COLUMNS, &[])?;
        COLUMNS.iter().try_for_each(|name| sheet.need(name))?;
        let (mut table, mut numbers) = (Self::default(), HashMap::new());
        for row in sheet.rows() {
            let time_s = row.number("time_s")?;
            let force_n = [row.number("x_n")?, row.number("y_n")?, row.number("z_n")?];
            let joint = name_of_cell(row.text("joint"));
            let number = *numbers.entry(joint.to_owned()).or_insert_with(|| {
                table.joints.push((joint.to_owned(), ForceOverTime::default()));
                table.joints.len() - 1
            });
            let points = &mut table.joints[number].1.points;
            if points.last().is_some_and(|(before_s, _)| *before_s >= time_s) {
                return Err(row.at().error(Wrong::Value {
                    what: "time_s".to_owned(),
                    wanted: "later than the time before of the same joint",
                    found: row.text("time_s").to_owned(),
                }));
            }
            points.push((time_s, force_n));
        }
        Ok(table)
    }

    /// The joints by name with their forces.
    pub fn joints(&self) -> &[(String, ForceOverTime)] {
        &self.joints
    }
}

impl ForceOverTime {
    /// The force at a time, N.
    pub fn at(&self, time_s: f64) -> [f64; 3] {
        let after = self.points.partition_point(|(t, _)| *t <= time_s);
        match (after.checked_sub(1).map(|k| self.points[k]), self.points.get(after)) {
            (Some((from_s, from)), Some((to_s, to))) => {
                let part = (time_s - from_s) / (to_s - from_s);
                std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
            }
            // Exactly at the last time.
            (Some((last_s, last)), None) if last_s >= time_s => last,
            _ => [0.0; 3],
        }
    }
}
