//! Systems of bars as structures to draw.

use model::Vector;
use model::system::{Support as Held, System};

use crate::structure::{Joint, Member, Seen, Structure, StructureError, Support};

/// Under the title of every drawing.
const NOTE: &str =
    "arrows: loads at joints and forces of the ground; weights of members are not drawn";

/// A system of bars with the places and forces of an equilibrium.
///
/// ```
/// use figures::SystemShape;
/// use model::system::{Joint, Member, System};
/// let cord = model::Bar::homogeneous(5.0, 0.0)?;
/// let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("lamp").with_mass(2.0)];
/// let system = System::new("a lamp", 10.0, joints, vec![Member::cable(0, 1, cord)])?;
/// let joints_m = [[0.0; 3], [0.0, 0.0, -5.0]];
/// let reactions_n = [[0.0, 0.0, 20.0], [0.0; 3]];
/// let shape =
///     SystemShape {
///         system: &system,
///         joints_m: &joints_m,
///         axial_n: &[20.0],
///         reactions_n: &reactions_n,
///         used: &[],
///         seen: figures::Seen::Best,
///     };
/// assert!(shape.svg()?.contains("20 N"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SystemShape<'a> {
    /// The system.
    pub system: &'a System,
    /// Places of its joints, m.
    pub joints_m: &'a [Vector],
    /// Axial forces of its members, tension positive, N.
    pub axial_n: &'a [f64],
    /// Forces of the ground on its joints, N.
    pub reactions_n: &'a [Vector],
    /// The part of its strength that each of its members uses; empty where none has a strength.
    pub used: &'a [Option<f64>],
    /// From where it is looked at.
    pub seen: Seen,
}

impl SystemShape<'_> {
    /// The drawing as an SVG file.
    ///
    /// # Errors
    /// [`StructureError`] when a place is not finite.
    pub fn svg(&self) -> Result<String, StructureError> {
        self.draw(None)
    }

    /// The drawing as an SVG element for a page in which `id` is unique. It is meant for a white
    /// ground.
    ///
    /// # Errors
    /// [`StructureError`] when a place is not finite.
    pub fn in_page(&self, id: &str) -> Result<String, StructureError> {
        self.draw(Some(id))
    }

    /// The span of a rope beside which its force stands.
    fn longest_span(&self, member: &model::system::Member) -> usize {
        let square = |[a, b]: [usize; 2]| {
            let apart = |k: usize| self.joints_m[a][k] - self.joints_m[b][k];
            (0..3).map(|k| apart(k) * apart(k)).sum::<f64>()
        };
        let spans = member.spans().map(square).enumerate();
        spans.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(n, _)| n)
    }

    fn draw(&self, id: Option<&str>) -> Result<String, StructureError> {
        let gravity = self.system.gravity_m_s2();
        let placed = self.system.joints().iter().zip(self.joints_m).zip(self.reactions_n);
        let names: Vec<_> = self.system.joints().iter().map(|joint| joint.name.text()).collect();
        let joints: Vec<Joint<'_>> = placed
            .zip(&names)
            .map(|(((joint, at_m), reaction_n), name)| {
                let [x, y, z] = joint.force_n;
                Joint {
                    name,
                    at_m: *at_m,
                    support: match joint.support {
                        Held::Free => None,
                        Held::Fixed { .. } => Some(Support::Fixed),
                        Held::Line { direction, .. } => Some(Support::Line(direction)),
                        Held::Plane { normal, .. } => Some(Support::Plane(normal)),
                    },
                    load_n: [x, y, z - joint.mass_kg * gravity],
                    reaction_n: *reaction_n,
                }
            })
            .collect();
        let members: Vec<Member> = self
            .system
            .members()
            .iter()
            .zip(self.axial_n)
            .enumerate()
            .flat_map(|(k, (member, axial))| {
                let used = self.used.get(k).copied().flatten();
                let strength = member.strength.as_deref();
                let weak = used.zip(strength).is_some_and(|(used, all)| !all.suffices(used));
                let longest = self.longest_span(member);
                member.spans().enumerate().map(move |(n, joints)| {
                    let axial_n = Some(*axial);
                    Member { joints, axial_n, used, weak, unlabelled: n != longest }
                })
            })
            .collect();
        let title = self.system.name();
        let (floor_m, seen) = (self.system.floor_m(), self.seen);
        let structure =
            Structure { title, note: NOTE, joints: &joints, members: &members, floor_m, seen };
        match id {
            None => structure.svg(),
            Some(id) => structure.in_page(id),
        }
    }
}
