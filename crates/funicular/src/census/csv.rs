//! The census as a table for other programs.

use std::borrow::Borrow;
use std::io::{self, Write};

use census::Interval;
use census::net::ChainCensus;

use super::answer::{CensusAnswer, Enclosures, Found, InRow};
use crate::csv::{Numbers, quoted};
use crate::text::tables::rung;

impl CensusAnswer {
    /// Joints as CSV, a line per equilibrium and joint: its place, and the force of the ground on it. What is zero
    /// but for rounding is written as 0. Of a row of bars also the force on the bar that ends at the joint, at joint
    /// 0 of the ground on bar 1, and angle and axial force of that bar.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        self.write_list(&self.equilibria, &mut to)
    }

    /// The same of this list.
    pub(super) fn write_list(
        &self,
        list: impl IntoIterator<Item = impl Borrow<Found>>,
        to: &mut impl Write,
    ) -> io::Result<()> {
        let chain = self.row();
        write!(
            to,
            "equilibrium,energy_j,index_in_space,joint,x_m,y_m,z_m,reaction_x_n,reaction_y_n,"
        )?;
        write!(to, "reaction_z_n,rung,box_width")?;
        let of_row = ",index_in_plane,force_x_n,force_y_n,force_z_n,angle_deg,axial_n";
        writeln!(to, "{}", chain.map_or("", |_| of_row))?;
        list.into_iter()
            .enumerate()
            .try_for_each(|(k, found)| self.write_joints(k, found.borrow(), chain, to))
    }

    fn write_joints(
        &self,
        number: usize,
        found: &Found,
        chain: Option<&ChainCensus>,
        to: &mut impl Write,
    ) -> io::Result<()> {
        let e = &found.equilibrium;
        let places = Numbers::of(e.joints_m.as_flattened());
        let forces = Numbers::of(e.reactions_n.as_flattened().iter().chain(&e.axial_n));
        let (label, energy_j, index) =
            (found.label(number), e.energy_j, e.stability.index_in_space);
        let (rung, width) = (rung(&e.evidence), found.box_width());
        for (k, joint) in self.system.joints().iter().enumerate() {
            let (name, place) = (quoted(&joint.name), places.cells(e.joints_m[k]));
            let force = forces.cells(e.reactions_n[k]);
            write!(to, "{label},{energy_j:?},{index},{name},{place},{force},{rung},{width:?}")?;
            if let Some((in_row, chain)) = found.in_row.as_ref().zip(chain) {
                let at = chain.joints.iter().position(|joint| *joint == k).unwrap_or_default();
                write!(to, ",{},", e.stability.index_in_plane.unwrap_or_default())?;
                in_row.write_at(at, forces, to)?;
            }
            writeln!(to)?;
        }
        Ok(())
    }
}

impl InRow {
    /// Force, angle and axial force of the bar that ends at a joint of the row.
    fn write_at(&self, joint: usize, forces: Numbers, to: &mut impl Write) -> io::Result<()> {
        let Enclosures { multipliers_n, axial_n, .. } = &self.enclosures;
        write!(to, "{},", forces.cells(multipliers_n[joint].map(Interval::mid)))?;
        match joint.checked_sub(1) {
            Some(bar) => write!(to, "{:?},{:?}", self.angles_signed_deg[bar], axial_n[bar].mid()),
            None => write!(to, ","),
        }
    }
}
