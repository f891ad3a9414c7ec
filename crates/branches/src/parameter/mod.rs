//! Numbers of a system file as parameters: which, and which values.
//!
//! `anchors.end_m.z=-2.9..-0.1:500`, `bars.2.mass_kg=0.1,1,10`, `gravity_m_s2=1.62,9.80665`,
//! `bars.*.length_m=0.5..2:31`. Components may also be written as in the error messages of system
//! files, `anchors.end_m[3]`, `bars[2].mass_kg`. Systems by name have `joints.P.force_n.x`,
//! `bars.3.stiffness_n` and `floor_m` besides. `bars.1.count=2..10` is the number of bars of a row.

pub(crate) mod apply;
pub(crate) mod base;
pub(crate) mod error;
pub(crate) mod number;
mod rows;
pub(crate) mod system;
pub(crate) mod values;
