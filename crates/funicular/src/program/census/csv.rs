//! The census as a table for other programs.

use std::fmt::Write;

use funicular::CensusAnswer;

use crate::tables::rung;

/// A line per equilibrium and joint: position, force of bar k+1 on bar k (at joint 0 of the ground
/// on bar 1, at joint n of the ground on bar n), and angle and axial force of the bar that ends
/// there.
pub fn joints(answer: &CensusAnswer) -> String {
    let mut text =
        "equilibrium,energy_j,index_in_plane,index_in_space,rung,box_width,joint,x_m,y_m,z_m,\
                    force_x_n,force_y_n,force_z_n,angle_deg,axial_n\n"
            .to_owned();
    for found in &answer.equilibria {
        let e = &found.equilibrium;
        for (k, ([x, y, z], [fx, fy, fz])) in e.joints_m.iter().zip(&e.multipliers_n).enumerate() {
            // Writing to a String cannot fail.
            let _ = write!(
                text,
                "{},{:?},{},{},{},{:?},{k},{x:?},{y:?},{z:?},{fx:?},{fy:?},{fz:?},",
                found.label,
                e.energy_j,
                e.stability.index_in_plane,
                e.stability.index_in_space,
                rung(&e.evidence),
                found.box_width,
            );
            let bar = k
                .checked_sub(1)
                .and_then(|bar| Some((found.angles_signed_deg.get(bar)?, e.axial_n.get(bar)?)));
            let _ = match bar {
                Some((angle, axial)) => writeln!(text, "{angle:?},{axial:?}"),
                None => writeln!(text, ","),
            };
        }
    }
    text
}
