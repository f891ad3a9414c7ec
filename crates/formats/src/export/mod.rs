//! Systems with their equilibrium as files for other programs.
//!
//! | [`Target`] | ending | for | what it holds |
//! |---|---|---|---|
//! | [`Vtu`](Target::Vtu) | `.vtu` | ParaView | lines with axial forces and utilisation, joints with reactions and masses |
//! | [`Dxf`](Target::Dxf) | `.dxf` | CAD | lines in a layer for each kind of member, points and names of joints; [`parse_dxf`](crate::system::parse_dxf) reads them |
//! | [`Obj`](Target::Obj), [`Gltf`](Target::Gltf) | `.obj`, `.gltf` | 3D programs | members as prisms, coloured by tension and compression |
//! | [`Mjcf`](Target::Mjcf) | `.xml` | MuJoCo | the mechanical model with masses at the joints, standing in this equilibrium |
//! | [`Urdf`](Target::Urdf) | `.urdf` | MuJoCo, Bullet | bars that hang from their anchors like trees, as links on ball joints |
//! | [`MoorDyn`](Target::MoorDyn) | `.txt`, `.dat` | MoorDyn | lines of one segment between points |
//! | [`Compas`](Target::Compas) | `.json` | COMPAS | a graph with force densities and loads |
//!
//! Lengths are in m and forces in N, tension positive; numbers have all their digits. A rope over rings and pulleys is a line
//! for each span. What a format cannot hold is refused by a sentence, never dropped.

mod compas;
mod dxf;
mod moordyn;
mod mujoco;
mod solids;
mod urdf;
mod vtu;

pub use dxf::escaped as dxf_text;
pub use vtu::collection;

use model::Vector;
use model::system::{Member, System, SystemEquilibrium};
use numerics::lever;

/// A format that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Target {
    /// VTK's XML of an unstructured grid, in ASCII.
    Vtu,
    /// Drawing interchange file of AutoCAD R12, in ASCII.
    Dxf,
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0 with its buffer inside.
    Gltf,
    /// MuJoCo's XML.
    Mjcf,
    /// Unified robot description format, with ball joints.
    Urdf,
    /// Input of MoorDyn version 2.
    MoorDyn,
    /// JSON of a COMPAS graph.
    Compas,
}

/// Why a system cannot be written in a format.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// Occurs when a part of the system has no counterpart in the format.
    #[error("{format} has no {what}")]
    NoCounterpart {
        /// Name of the format.
        format: &'static str,
        /// The part.
        what: String,
    },
    /// Occurs when the equilibrium is not one of this system.
    #[error(
        "the equilibrium has {joints} joints and {members} members, which are not those of the system"
    )]
    Sizes {
        /// Joints of the equilibrium.
        joints: usize,
        /// Its members.
        members: usize,
    },
}

impl Target {
    /// Endings of the files that are written, for help texts.
    pub const ENDINGS: [&str; 9] =
        ["vtu", "dxf", "obj", "gltf", "xml", "urdf", "txt", "dat", "json"];

    /// For which program it is, and what the file holds.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Vtu => "an unstructured grid for ParaView",
            Self::Dxf => "a drawing for CAD",
            Self::Obj | Self::Gltf => "solids for 3D programs",
            Self::Mjcf => "a model for MuJoCo",
            Self::Urdf => "a tree of links on ball joints",
            Self::MoorDyn => "an input file of MoorDyn",
            Self::Compas => "a graph for COMPAS",
        }
    }

    /// The format that the ending of a file's name stands for.
    ///
    /// ```
    /// use formats::export::Target;
    /// assert_eq!(Target::of_ending("VTU"), Some(Target::Vtu));
    /// assert_eq!(Target::of_ending("xyz"), None);
    /// assert!(Target::ENDINGS.iter().all(|ending| Target::of_ending(ending).is_some()));
    /// ```
    pub fn of_ending(ending: &str) -> Option<Self> {
        Some(match ending.to_ascii_lowercase().as_str() {
            "vtu" => Self::Vtu,
            "dxf" => Self::Dxf,
            "obj" => Self::Obj,
            "gltf" => Self::Gltf,
            "xml" => Self::Mjcf,
            "urdf" => Self::Urdf,
            "txt" | "dat" => Self::MoorDyn,
            "json" => Self::Compas,
            _ => return None,
        })
    }
}

/// An equilibrium as it is written.
#[derive(Debug, Clone, Copy)]
pub struct Shape<'a> {
    /// What is at rest.
    pub system: &'a System,
    /// Place of each joint, m.
    pub joints_m: &'a [Vector],
    /// Axial force of each member with its loads lumped to its joints by the lever rule, tension positive, N.
    pub axial_n: &'a [f64],
    /// Force of the ground on each joint, N.
    pub reactions_n: &'a [Vector],
    /// The part of its strength that each member uses; empty where none has a strength.
    pub used: &'a [Option<f64>],
    /// What it has besides while it moves; a grid for ParaView holds it.
    pub moving: Option<Moving<'a>>,
}

/// A time of a motion.
#[derive(Debug, Clone, Copy)]
pub struct Moving<'a> {
    /// Time since the beginning, s.
    pub time_s: f64,
    /// Velocity of each joint, m/s.
    pub velocities_m_s: &'a [Vector],
    /// Names, with their units, and values of what is one number at a time.
    pub numbers: &'a [(&'a str, f64)],
}

impl<'a> Shape<'a> {
    /// Of an equilibrium of a solver, with the [utilisations](SystemEquilibrium::utilisations) of its members.
    pub fn new(system: &'a System, found: &'a SystemEquilibrium, used: &'a [Option<f64>]) -> Self {
        let SystemEquilibrium { joints_m, axial_n, reactions_n, .. } = found;
        Self { system, joints_m, axial_n, reactions_n, used, moving: None }
    }

    /// The text of a file.
    ///
    /// # Errors
    /// [`ExportError`] for what the format cannot hold, and for lists that are not those of the system.
    pub fn text(&self, target: Target) -> Result<String, ExportError> {
        let (joints, members) = (self.joints_m.len(), self.axial_n.len());
        let sizes = [joints, self.reactions_n.len(), members];
        let speeds = self.moving.map_or(joints, |moving| moving.velocities_m_s.len());
        let [of_joints, of_members] = [self.system.joints().len(), self.system.members().len()];
        if sizes != [of_joints, of_joints, of_members]
            || speeds != joints
            || ![0, members].contains(&self.used.len())
        {
            return Err(ExportError::Sizes { joints, members });
        }
        match target {
            Target::Vtu => Ok(vtu::write(self)),
            Target::Dxf => Ok(dxf::write(self)),
            Target::Obj => Ok(solids::obj(self)),
            Target::Gltf => Ok(solids::gltf(self)),
            Target::Mjcf => Ok(mujoco::write(self)),
            Target::Urdf => urdf::write(self),
            Target::MoorDyn => moordyn::write(self),
            Target::Compas => compas::write(self),
        }
    }

    /// The lines of all members, spans of ropes one by one.
    fn lines(&self) -> impl Iterator<Item = Line<'a>> {
        let members = self.system.members().iter().zip(self.axial_n).enumerate();
        members.flat_map(|(number, (member, &axial_n))| {
            member.spans().map(move |ends| Line { number, member, ends, axial_n })
        })
    }
}

/// A straight line of a member.
struct Line<'a> {
    /// Number of the member, from 0.
    number: usize,
    member: &'a Member,
    /// Its two joints.
    ends: [usize; 2],
    /// Tension positive, N.
    axial_n: f64,
}

impl Line<'_> {
    /// 0 in tension, 1 in compression, 2 without force.
    fn look(&self) -> usize {
        if self.axial_n > 0.0 { 0 } else { 2 - usize::from(self.axial_n < 0.0) }
    }
}

fn one_line(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).collect()
}

/// Name of a kind of member.
fn kind(member: &Member) -> &'static str {
    if member.rope.is_some() { "rope" } else { member.kind.name() }
}

/// What acts on each joint when the loads of members are shared by the lever rule: forces, N, and masses, kg.
fn joint_loads(system: &System) -> (Vec<Vector>, Vec<f64>) {
    let mut forces: Vec<Vector> = system.joints().iter().map(|joint| joint.force_n).collect();
    let mut masses: Vec<f64> = system.joints().iter().map(|joint| joint.mass_kg).collect();
    for member in system.members() {
        let (length_m, ends) = (member.body.length_m(), [member.from, member.to]);
        let shares = lever(length_m, member.body.centre_m());
        for (end, share) in ends.into_iter().zip(shares) {
            masses[end] += share * member.body.mass_kg();
        }
        for load in &member.loads {
            for (end, share) in ends.into_iter().zip(lever(length_m, load.at_m)) {
                for (sum, part) in forces[end].iter_mut().zip(load.force_n) {
                    *sum += share * part;
                }
            }
        }
    }
    (forces, masses)
}

/// Numbers with all their digits and blanks between.
fn row(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(" ")
}

/// A name as the value of an attribute of XML; signs that steer a terminal or a parser are gone.
fn attribute(name: &str) -> String {
    let text = one_line(name).replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}
