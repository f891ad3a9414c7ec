//! Cables and ropes alone: where one equilibrium is isolated there is no other.
//!
//! With places $x$ the energy of dead loads, supports on points, lines and planes, cables of $|d| \le l$ and ropes
//! of $\sum |d| \le l$, elastic or not, is a convex function on a convex set, so that every equilibrium $(x,
//! \lambda)$ with tensions $\lambda \ge 0$ is a least one. Let $x'$ be another. All places between $x$ and $x'$ are
//! least ones too, and satisfy the equations with the same $\lambda$: $L(x'', \lambda) = V(x'') + \lambda \cdot
//! c(x'') \le V(x'') = V(x) = \min L(\cdot, \lambda)$. Other tensions $\lambda'$ at $x$ likewise leave all between
//! them and $\lambda$. Both contradict a box around $(x, \lambda)$ that holds exactly one zero of the equations. It
//! is the only equilibrium, whatever spans have no length in others.
//!
//! R. T. Rockafellar, Convex Analysis (1970), section 28 (saddle points of the Lagrangian).

use std::time::Instant;

use model::Vector;
use model::system::{Kind, System};

use super::choice::{Choice, Measured};
use super::{PartCensus, SystemCensus, SystemPosition};
use crate::boxes::frame::Frame;
use crate::boxes::prove;

impl SystemCensus {
    /// The census of a system of cables and ropes alone, of which this is an answer (places of all joints, m,
    /// and axial forces of all members, N): proved to be an equilibrium, it is the only one.
    ///
    /// Nothing with a member that may push, above a floor, and where [`prove`] has no box that stands for one
    /// equilibrium alone.
    ///
    /// ```
    /// use census::net::SystemCensus;
    /// use model::Bar;
    /// use model::system::{Joint, Member, System};
    /// // A ring of 2 N on a rope of 10 m between anchors 6 m apart: two spans of 5 m, 3-4-5.
    /// let joints = vec![
    ///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
    ///     Joint::anchor("B", [3.0, 0.0, 0.0]),
    ///     Joint::free("ring").with_mass(0.2),
    /// ];
    /// let rope = Member::cable(0, 1, Bar::homogeneous(10.0, 0.0)?).over(vec![2]);
    /// let system = System::new("ring", 10.0, joints, vec![rope])?;
    /// let answer = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
    /// let census = SystemCensus::of_cables(&system, &answer, &[1.25]).expect("a proof");
    /// assert!(census.complete && census.equilibria.len() == 1);
    /// assert!(census.equilibria[0].axial_n[0].contains(1.25));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_cables(system: &System, joints_m: &[Vector], axial_n: &[f64]) -> Option<Self> {
        let start = Instant::now();
        let pulls = system.members().iter().all(|member| member.kind == Kind::Cable);
        let found = if pulls && system.floor_m().is_none() {
            prove(system, joints_m, axial_n).ok()?
        } else {
            return None;
        };
        // With joints that nothing holds, and with what turns, the box stands for more than one.
        if found.turns > 0 || !found.loose_joints.is_empty() {
            return None;
        }
        let frame = Frame::new(system, axial_n);
        let choice = Choice {
            places: found.joints_m.iter().map(|at_m| frame.places(*at_m)).enumerate().collect(),
            axial: found.axial_n.iter().map(|force| frame.force(*force)).enumerate().collect(),
            ..Choice::default()
        };
        let position = SystemPosition::new(Measured { system, frame: &frame }, &choice, false);
        let part = PartCensus { positions: 1, ..PartCensus::default() };
        Some(Self {
            equilibria: vec![position],
            parts: vec![part],
            complete: true,
            seconds: start.elapsed().as_secs_f64(),
        })
    }
}
