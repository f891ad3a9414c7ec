//! The equations of a system as others see them: residual, derivative and one-sided conditions at
//! any places and forces, for what follows equilibria over a parameter.
//!
//! The unknowns are $y = (x, N)$ in the units of one system: three coordinates of each joint, then
//! the axial force of each member: of a rope its tension, with the sum of its spans as length. With $G$ the balance of the joints along their free directions
//! and the lengths of the taut members, $J = \partial G/\partial y$ is symmetric. Of a slack member
//! and along held directions $G$ and $J$ are zero, and so is every step.

use model::Vector;
use model::system::{Kind, Member, System, SystemEquilibrium};
use nalgebra::Vector3;

use super::derivatives::by_length;
use super::floor::lift;
use super::framework::{Framework, Node, Units};
use super::newton::{Derivative, Step, with_held};
use super::residual::Residual;
use super::second_order::SecondOrder;
use super::settings::Settings;
use super::solution::{Found, NO_FORCE, Solution, limp};
use super::state::State;
use super::stiffness::Stiffness;
use crate::error::Error;
use crate::larger::larger;
use crate::thresholds::{GIVEN, ZERO};

/// A condition that holds on one side only: what it is of, and whether it is active.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// A cable or a strut, by its number: taut or slack.
    Member(usize),
    /// A joint over a floor, by its number: on the floor or above it.
    Joint(usize),
}

/// The equations at a system, with the members that are taut and the joints that lie on the floor.
///
/// ```
/// use lagrange::net::{Equations, Settings, solve};
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// // 8 N in a V of two bars of 5 m over a span of 6 m.
/// let joints = vec![
///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
///     Joint::anchor("B", [3.0, 0.0, 0.0]),
///     Joint::free("P").with_force([0.0, 0.0, -8.0]),
/// ];
/// let bar = Bar::homogeneous(5.0, 0.0)?;
/// let members = vec![Member::bar(0, 2, bar), Member::bar(1, 2, bar)];
/// let system = System::new("V", 9.80665, joints, members)?;
/// let mut equations = Equations::new(&system)?;
/// let y = equations.at(&system, &solve(&system, &Settings::default())?);
/// assert!(equations.residual(&y).1 < 1e-14);
/// // It hangs: no direction in which the energy falls.
/// assert_eq!(equations.factorise(&y), Some(0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Equations {
    units: Units,
    bare: Framework,
    /// With the joints that lie on the floor.
    framework: Framework,
    floor: Option<f64>,
    stiffness: Stiffness,
    derivative: Option<Derivative>,
    taut: Vec<bool>,
    lies: Vec<bool>,
}

impl Equations {
    /// Of a system, in its units: those of others of the same joints and members ([`set`](Self::set)) are
    /// written in these too.
    ///
    /// # Errors
    ///
    /// [`Error::Memory`] when the factor cannot be held.
    pub fn new(system: &System) -> Result<Self, Error> {
        let bare = Framework::new(system);
        Ok(Self {
            units: bare.units,
            floor: bare.floor(system),
            stiffness: Stiffness::new(&bare, false)?,
            derivative: None,
            taut: vec![true; bare.members()],
            lies: vec![false; bare.nodes.len()],
            framework: bare.clone(),
            bare,
        })
    }

    /// Take the numbers of another system of the same joints and members.
    pub fn set(&mut self, system: &System) {
        self.bare = Framework::in_units(system, Some(self.units));
        self.floor = self.bare.floor(system);
        self.lay();
    }

    /// The loads of the joints of the system that was last [`set`](Self::set), three coordinates each:
    /// those of $G$, which has no others.
    pub fn loads(&self) -> Vec<f64> {
        self.bare.nodes.iter().flat_map(|node| [node.load.x, node.load.y, node.load.z]).collect()
    }

    /// Take other loads of the joints, and all else as it was.
    pub fn set_loads(&mut self, loads: &[f64]) {
        for framework in [&mut self.bare, &mut self.framework] {
            for (node, load) in framework.nodes.iter_mut().zip(loads.chunks_exact(3)) {
                node.load = Vector3::from_column_slice(load);
            }
        }
    }

    /// What loads are of $G$.
    pub fn of_loads(&self, loads: &[f64]) -> Vec<f64> {
        let loads: Vec<_> = loads.chunks_exact(3).map(Vector3::from_column_slice).collect();
        self.flat(&loads, &vec![0.0; self.taut.len()])
    }

    fn lay(&mut self) {
        self.framework = match self.floor {
            Some(floor) if self.lies.contains(&true) => self.bare.with_laid(floor, &self.lies),
            _ => self.bare.clone(),
        };
    }

    /// The unknowns of an answer for the system that was last [`set`](Self::set); its members that are slack and its joints on the floor are those
    /// of the equations from now on.
    pub fn at(&mut self, system: &System, solution: &Solution) -> Vec<f64> {
        let answer = &solution.equilibrium;
        self.taut = vec![true; self.bare.members()];
        for &member in &solution.slack {
            self.taut[member] = false;
        }
        self.lies = vec![false; self.bare.nodes.len()];
        for lying in Framework::of(system, solution).lying {
            self.lies[lying.joint] = true;
        }
        self.lay();
        self.unknowns(answer)
    }

    /// The unknowns of a drawing: its places, m, with what elastic members bear at their lengths;
    /// cables and struts that bear nothing there are slack from now on.
    pub fn drawn(&mut self, joints_m: &[Vector]) -> Vec<f64> {
        let places: Vec<_> = joints_m.iter().map(|at_m| self.units.place(*at_m)).collect();
        let mut y: Vec<f64> = places.iter().flat_map(|place| [place.x, place.y, place.z]).collect();
        let links = &self.framework.links;
        for (k, link) in links.iter().enumerate().take(self.taut.len()) {
            let long = self.framework.whole(k, |span| links[span].span(&places).norm());
            let longer = long - link.length;
            let just = longer.abs() <= GIVEN * link.length;
            self.taut[k] = just || link.bears(longer);
            let elastic = link.compliance > 0.0 && self.taut[k];
            y.push(if elastic { longer / link.compliance } else { 0.0 });
        }
        y
    }

    /// The cables and struts that have just their length and bear nothing at these unknowns.
    pub fn just_taut(&self, y: &[f64]) -> Vec<usize> {
        // Without loads all forces may be rounding: the unit is that of loads elsewhere.
        let mut state = self.state(y);
        for axial in &mut state.axial {
            *axial = if axial.abs() <= NO_FORCE { 0.0 } else { *axial };
        }
        let limp =
            limp(&self.framework, &state, &state.directions(&self.framework)).collect::<Vec<_>>();
        limp.into_iter().filter(|k| self.framework.links[*k].kind != Kind::Bar).collect()
    }

    /// Of these members those are taut from now on that are not slack in a solution, nor, if `all` are to bear something,
    /// limp there.
    pub fn taut_as_in(&mut self, members: &[usize], solution: &Solution, all: bool) {
        for member in members {
            let idle = solution.slack.contains(member) || all && solution.limp.contains(member);
            self.taut[*member] = !idle;
        }
    }

    fn state(&self, y: &[f64]) -> State {
        let (places, axial) = y.split_at(3 * self.framework.nodes.len());
        let onto = |(node, at): (&Node, &[f64])| {
            node.base + node.free.part(&(Vector3::from_column_slice(at) - node.base))
        };
        let places = self.framework.nodes.iter().zip(places.chunks_exact(3)).map(onto).collect();
        let (axial, taut) = (axial.to_vec(), self.taut.clone());
        State::new(places, self.framework.by_link(axial), self.framework.by_link(taut))
    }

    /// Places moved onto their supports, slack members without force.
    pub fn onto(&self, y: &[f64]) -> Vec<f64> {
        let state = with_held(&self.framework, self.state(y));
        let members = state.axial.iter().zip(&state.taut).take(self.taut.len());
        let axial = members.map(|(n, taut)| if *taut { *n } else { 0.0 });
        state.places.iter().flat_map(|place| [place.x, place.y, place.z]).chain(axial).collect()
    }

    /// $G(y)$, and its largest entry: forces over the largest force or the unit, lengths over
    /// themselves.
    pub fn residual(&self, y: &[f64]) -> (Vec<f64>, f64) {
        let residual = Residual::new(&self.framework, &self.state(y));
        let rows = self.flat(&residual.forces, &residual.lengths);
        let forces = &rows[..3 * self.framework.nodes.len()];
        let unit = residual.unit.max(1.0);
        let size = forces.iter().map(|force| force.abs() / unit).fold(residual.length.0, larger);
        (rows, size)
    }

    /// Forces along the free directions, then lengths of the members.
    fn flat(&self, forces: &[Vector3<f64>], lengths: &[f64]) -> Vec<f64> {
        let nodes = self.framework.nodes.iter().zip(forces).map(|(node, f)| node.free.part(f));
        let lengths = lengths.iter().copied().take(self.taut.len());
        nodes.flat_map(|f| [f.x, f.y, f.z]).chain(lengths).collect()
    }

    fn step(&self, y: &[f64]) -> Step {
        let (places, axial) = y.split_at(3 * self.framework.nodes.len());
        let places = places.chunks_exact(3).map(Vector3::from_column_slice).collect();
        Step { places, axial: self.framework.by_link(axial.to_vec()) }
    }

    /// Factorise $J$ at these unknowns, with springs of a large stiffness in the place of lengths:
    /// the number of directions in which the energy falls, by the signs of its pivots. Where no member
    /// pushes the energy is convex, and there are none, whatever rounding leaves of pivots that vanish. Nothing where
    /// the factor is not finite.
    pub fn factorise(&mut self, y: &[f64]) -> Option<usize> {
        let state = self.state(y);
        let residual = Residual::new(&self.framework, &state);
        self.derivative =
            Derivative::bordered(&self.framework, &mut self.stiffness, &state, &residual);
        let pushes = (self.framework.links.iter().zip(&state.axial).zip(&state.taut))
            .any(|((link, axial), taut)| *taut && link.kind != Kind::Cable && *axial < 0.0);
        let index = if pushes { self.stiffness.negative_pivots() } else { 0 };
        self.derivative.as_ref().map(|_| index)
    }

    /// The solution of $J y = r$ by the last factor: exact for elastic members, a preconditioner
    /// where lengths are kept.
    pub fn solve(&mut self, right: &[f64]) -> Vec<f64> {
        let none = Step {
            places: vec![Vector3::zeros(); self.framework.nodes.len()],
            axial: vec![0.0; self.framework.links.len()],
        };
        let Some(derivative) = &self.derivative else { return vec![0.0; right.len()] };
        let Step { places, axial } = self.step(right);
        let forces: Vec<_> = places.iter().map(|force| -force).collect();
        let lengths = derivative.of_taut(&axial).iter().map(|length| -length).collect::<Vec<_>>();
        let step =
            derivative.refined(&none, &self.framework, &mut self.stiffness, &forces, &lengths);
        let axial = step.axial.into_iter().take(self.taut.len());
        step.places.iter().flat_map(|at| [at.x, at.y, at.z]).chain(axial).collect()
    }

    /// What $G$ changes by when the length given of a member becomes longer, along $\phi$: $\phi \cdot \partial G/\partial l$
    /// for each member of the system that was last [`set`](Self::set), in units of $\phi$ a unit of length.
    pub fn by_length(&self, system: &System, y: &[f64], phi: &[f64]) -> Vec<f64> {
        let state = self.state(y);
        let (places, along) = phi.split_at(3 * self.framework.nodes.len());
        let phi = |joint: usize| Vector3::from_column_slice(&places[3 * joint..3 * joint + 3]);
        let of = |(k, member): (usize, &Member)| {
            let (law, [start, end]) = by_length(system, self.units, (k, state.axial[k]));
            let by_loads = phi(member.from).dot(&start) + phi(member.to).dot(&end);
            (along[k] * law + by_loads) * self.units.length_m
        };
        system.members().iter().enumerate().map(of).collect()
    }

    /// The same when the place of a support moves: three numbers for each joint, 0 for free ones and
    /// along free directions.
    pub fn by_place(&self, y: &[f64], phi: &[f64]) -> Vec<Vector3<f64>> {
        let state = self.state(y);
        let (places, along) = phi.split_at(3 * self.framework.nodes.len());
        let along = self.framework.by_link(along.to_vec());
        let phi = |joint: usize| Vector3::from_column_slice(&places[3 * joint..3 * joint + 3]);
        let mut all = vec![Vector3::zeros(); self.framework.nodes.len()];
        let directions = state.directions(&self.framework);
        for (k, (link, (u, length))) in self.framework.links.iter().zip(&directions).enumerate() {
            // The pull on `from` is N u, and u turns with the span; the length row has -|span|.
            let apart = phi(link.from) - phi(link.to);
            let across = (apart - u * u.dot(&apart)) * (state.axial[k] / length);
            let by_span = across - u * along[k];
            all[link.to] += by_span;
            all[link.from] -= by_span;
        }
        for (node, by) in self.framework.nodes.iter().zip(&mut all) {
            *by -= node.free.part(by);
        }
        all
    }

    /// The unknowns of an equilibrium.
    pub fn unknowns(&self, equilibrium: &SystemEquilibrium) -> Vec<f64> {
        let units = self.units;
        let places = equilibrium.joints_m.iter().map(|at_m| units.place(*at_m));
        let places = places.flat_map(|at| [at.x, at.y, at.z]);
        places.chain(equilibrium.axial_n.iter().map(|n| n / units.force_n)).collect()
    }

    /// $J y$ where it was last factorised.
    pub fn apply(&self, y: &[f64]) -> Vec<f64> {
        let Some(derivative) = &self.derivative else { return vec![0.0; y.len()] };
        let zero = (vec![Vector3::zeros(); self.lies.len()], vec![0.0; self.framework.links.len()]);
        let (forces, lengths) = derivative.left(&self.step(y), &self.framework, &zero.0, &zero.1);
        self.flat(&forces, &lengths)
    }

    /// All one-sided conditions with their values, which are not negative as long as a member stays
    /// taut or slack, and a joint on the floor or above it: forces in the unit of forces, lengths
    /// and heights in that of lengths.
    pub fn sides(&self, y: &[f64]) -> Vec<(Side, f64)> {
        let state = self.state(y);
        let directions = state.directions(&self.framework);
        let links = self.framework.links.iter().enumerate().take(self.taut.len());
        let members = links.filter_map(|(k, link)| {
            let sign = match link.kind {
                Kind::Bar => return None,
                Kind::Cable => 1.0,
                Kind::Strut => -1.0,
            };
            if !self.framework.moves(link) {
                return None;
            }
            let length = || self.framework.whole(k, |span| directions[span].1);
            let value = if self.taut[k] { state.axial[k] } else { link.length - length() };
            Some((Side::Member(k), sign * value))
        });
        let mut sides: Vec<_> = members.collect();
        let Some(floor) = self.floor else { return sides };
        let pushes = self.framework.pushes(&directions, &state.axial);
        let lying = self.framework.lying.iter().zip(pushes);
        sides.extend(lying.map(|(lying, push)| (Side::Joint(lying.joint), push)));
        let above = self.bare.nodes.iter().enumerate();
        let above = above.filter(|(joint, node)| !self.lies[*joint] && lift(node).is_some());
        sides.extend(above.map(|(k, _)| (Side::Joint(k), state.places[k].z - floor)));
        sides
    }

    /// From taut to slack, from the floor to above it, or back: whether it is taut or lies now.
    ///
    /// # Errors
    ///
    /// [`Error::Memory`] when the factor cannot be held.
    pub fn switch(&mut self, side: Side) -> Result<bool, Error> {
        match side {
            Side::Member(member) => {
                self.taut[member] = !self.taut[member];
                Ok(self.taut[member])
            }
            Side::Joint(joint) => {
                self.lies[joint] = !self.lies[joint];
                self.lay();
                self.stiffness = Stiffness::new(&self.framework, false)?;
                Ok(self.lies[joint])
            }
        }
    }

    /// The unknowns as an answer for the system that was last [`set`](Self::set), with the number of
    /// directions in which the energy falls.
    pub fn solution(&self, system: &System, y: &[f64], index: usize) -> Solution {
        let mut state = with_held(&self.framework, self.state(y));
        // Where it becomes slack a member bears nothing, whatever rounding leaves.
        for (k, link) in self.framework.links.iter().enumerate() {
            if !link.bears(state.axial[k]) && state.axial[k].abs() <= ZERO {
                (state.axial[k], state.taut[k]) = (0.0, false);
            }
        }
        let residual = Residual::new(&self.framework, &state);
        let second_order = SecondOrder { index, ..SecondOrder::default() };
        let tolerance = Settings::default().tolerance;
        let found = Found {
            state,
            residual,
            tolerance,
            factorisations: 0,
            second_order,
            least: false,
            solve_s: 0.0,
        };
        Solution::new(system, &self.framework, found)
    }

    /// The unit of length, m, and of force, N.
    pub fn units(&self) -> [f64; 2] {
        [self.units.length_m, self.units.force_n]
    }
}
