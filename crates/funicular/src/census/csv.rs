//! The census as a table for other programs.

use std::io::{self, Write};

use super::answer::{ChainCensusAnswer, Found};

impl ChainCensusAnswer {
    /// A line per equilibrium and joint as CSV: position, force of bar k+1 on bar k (at joint 0 of
    /// the ground on bar 1, at joint n of the ground on bar n), and angle and axial force of the
    /// bar that ends there.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        write_head(&mut to)?;
        self.equilibria.iter().try_for_each(|found| write_rows(&mut to, found))
    }
}

/// The names of the columns.
pub(super) fn write_head(to: &mut impl Write) -> io::Result<()> {
    write!(to, "equilibrium,energy_j,index_in_plane,index_in_space,rung,box_width,")?;
    writeln!(to, "joint,x_m,y_m,z_m,force_x_n,force_y_n,force_z_n,angle_deg,axial_n")
}

/// The lines of one equilibrium.
pub(super) fn write_rows(to: &mut impl Write, found: &Found) -> io::Result<()> {
    let e = &found.equilibrium;
    let rung = e.evidence.rung().map_or_else(|| "none".to_owned(), |rung| rung.to_string());
    let indices = [e.stability.index_in_plane, e.stability.index_in_space];
    let joints = e.joints_m.iter().zip(&e.multipliers_n).enumerate();
    for (k, ([x, y, z], [fx, fy, fz])) in joints {
        write!(to, "{},{:?},{},{},", found.label, e.energy_j, indices[0], indices[1])?;
        write!(to, "{rung},{:?},{k},", found.box_width)?;
        write!(to, "{x:?},{y:?},{z:?},{fx:?},{fy:?},{fz:?},")?;
        let bar = k
            .checked_sub(1)
            .and_then(|bar| Some((found.angles_signed_deg.get(bar)?, e.axial_n.get(bar)?)));
        match bar {
            Some((angle, axial)) => writeln!(to, "{angle:?},{axial:?}")?,
            None => writeln!(to, ",")?,
        }
    }
    Ok(())
}
