//! Derivatives of an equilibrium by its parameters.
//!
//! The equations $G(x, N; \theta) = 0$ of module `newton`, balance of the joints and lengths of the
//! taut members, hold along the whole branch of equilibria over a parameter $\theta$. With the
//! symmetric $M = -\partial G/\partial(x, N)$ of one factorisation
//!
//! $$ M \frac{d(x, N)}{d\theta} = \frac{\partial G}{\partial\theta}, $$
//!
//! and the gradient of one number $J(x, N)$ by all parameters follows from one solve with its
//! derivatives on the right (the adjoint), since $M^{-T} = M^{-1}$. Slack members stay slack.
//!
//! Parameters are the numbers that were given. A member that bears $F$ at the length $d$ has, with
//! $EA = k$ and without a prestress $F = 0$, under the force $N$ the length
//!
//! $$ D = d\\,\frac{k + N}{k + F}, \qquad
//!    \frac{\partial D}{\partial d} = \frac{k + N}{k + F}, \qquad
//!    \frac{\partial D}{\partial k} = d\\,\frac{F - N}{(k + F)^2}, \qquad
//!    \frac{\partial D}{\partial F} = -d\\,\frac{k + N}{(k + F)^2} . $$
//!
//! A rope is a member whose length $D$ is the sum of its spans, each of them a link with the numbers of the
//! whole.
//!
//! There is no derivative where a motion meets no stiffness, where self-stresses leave the forces
//! open, and where a member or the floor has just no force ([`Error`]).

use model::Vector;
use model::system::{Kind, System};
use nalgebra::{Matrix3, Vector3};

use super::framework::{Framework, Units};
use super::newton::{Derivative, Step};
use super::residual::Residual;
use super::smooth;
use super::solution::Solution;
use super::state::State;
use super::stiffness::Stiffness;
use crate::error::Error;
use crate::thresholds::CLOSURE_ROUNDING;

/// The linear system is solved when this part of the right-hand side is left, or less.
const SOLVED: f64 = 1e-8;

/// A parameter of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the name of a field says what it is")]
pub enum Parameter {
    /// Length of a member as it was given, m: its unstretched length, or that under its prestress.
    /// All other numbers given stay; a centre that was not given and loads in the middle stay in
    /// the middle.
    Length { member: usize },
    /// Stiffness EA of an elastic member, N. An inextensible one has the derivative zero.
    Stiffness { member: usize },
    /// Prestress of an elastic member, N: the axial force at the length given. Without one it is 0.
    Prestress { member: usize },
    /// Mass of a member, kg. A rope, which has none, has the derivative zero.
    Mass { member: usize },
    /// Force on a joint, N: along the axis 0, 1 or 2. The derivative by its mass is -g times that
    /// along axis 2.
    Force { joint: usize, axis: usize },
    /// Place of an anchor, m.
    Anchor { joint: usize, axis: usize },
}

/// Derivatives of an answer by one parameter: each per unit of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Of the places of the joints, m.
    pub joints_m: Vec<Vector>,
    /// Of the axial forces, N.
    pub axial_n: Vec<f64>,
    /// Of the forces of the ground, N.
    pub reactions_n: Vec<Vector>,
}

/// Derivatives of one number by all parameters: in its unit per unit of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// By the lengths of the members, 1/m; see [`Parameter::Length`].
    pub by_length: Vec<f64>,
    /// By their stiffnesses EA, 1/N; zero for inextensible members.
    pub by_stiffness: Vec<f64>,
    /// By the prestress at their lengths, 1/N; zero for inextensible members.
    pub by_prestress: Vec<f64>,
    /// By their masses, 1/kg; zero for ropes.
    pub by_mass: Vec<f64>,
    /// By forces on the joints, 1/N.
    pub by_force: Vec<Vector>,
    /// By the places of anchors, 1/m; zero for other joints.
    pub by_anchor: Vec<Vector>,
}

/// The linearised equations at an equilibrium, factorised once.
///
/// ```
/// use lagrange::net::{Derivatives, Parameter, Settings, solve};
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// // A V of two massless bars of 5 m over a span of 6 m with 8 N in it: depth h = 4 m.
/// let joints = vec![
///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
///     Joint::anchor("B", [3.0, 0.0, 0.0]),
///     Joint::free("P").with_force([0.0, 0.0, -8.0]),
/// ];
/// let bar = Bar::homogeneous(5.0, 0.0)?;
/// let members = vec![Member::bar(0, 2, bar), Member::bar(1, 2, bar)];
/// let system = System::new("V", 9.80665, joints, members)?;
/// let solution = solve(&system, &Settings::default())?;
/// let mut derivatives = Derivatives::new(&system, &solution)?;
/// // W l²/(4 h³) of the ground's force on B by a move of B along X.
/// let stiffness = derivatives.anchor_stiffness(1, 1)?;
/// assert!((stiffness[0][0] - 8.0 * 25.0 / (4.0 * 64.0)).abs() < 1e-11);
/// // A longer first bar moves the joint by l/(2 a) along X and -l/(2 h) along Z.
/// let change = derivatives.change(Parameter::Length { member: 0 })?;
/// assert!((change.joints_m[2][0] - 5.0 / 6.0).abs() < 1e-11);
/// assert!((change.joints_m[2][2] + 5.0 / 8.0).abs() < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Derivatives<'a> {
    system: &'a System,
    framework: Framework,
    stiffness: Stiffness,
    derivative: Derivative,
    directions: Vec<Vector3<f64>>,
    axial: Vec<f64>,
}

impl<'a> Derivatives<'a> {
    /// At an answer of this crate for the system.
    ///
    /// # Errors
    ///
    /// [`Error::Memory`]; [`Error::NoDerivative`] when the factor is not finite;
    /// [`Error::FreeMotion`], [`Error::OpenForces`], [`Error::Jammed`], [`Error::JustTaut`] and [`Error::JustTouches`]
    /// where the equilibrium has no derivatives.
    pub fn new(system: &'a System, solution: &Solution) -> Result<Self, Error> {
        let framework = Framework::of(system, solution);
        let state = State::of(&framework, solution);
        let residual = Residual::new(&framework, &state);
        smooth::check(system, &framework, &state, &residual, solution)?;
        let mut stiffness = Stiffness::new(&framework, false)?;
        let derivative = Derivative::bordered(&framework, &mut stiffness, &state, &residual)
            .ok_or(Error::NoDerivative { left: 1.0 })?;
        let directions = residual.directions.iter().map(|(u, _)| *u).collect();
        Ok(Self { system, framework, stiffness, derivative, directions, axial: state.axial })
    }

    /// The derivatives of the answer by one parameter.
    ///
    /// # Errors
    ///
    /// [`Error::NoDerivative`] when there is none, [`Error::NotAnAnchor`] for the place of a joint
    /// that is none.
    ///
    /// # Panics
    ///
    /// When the system has no such member, joint or axis.
    pub fn change(&mut self, parameter: Parameter) -> Result<Change, Error> {
        let mut change = self.none();
        let (mut forces, _) = self.nothing();
        let mut lengths = vec![0.0; self.framework.members()];
        match parameter {
            Parameter::Length { member } => {
                let of = (member, self.axial[member]);
                let (law, [start, end]) = by_length(self.system, self.framework.units, of);
                let link = &self.framework.links[member];
                lengths[member] = law;
                (forces[link.from], forces[link.to]) = (start, end);
            }
            Parameter::Prestress { member } => lengths[member] = self.by_prestress(member),
            Parameter::Stiffness { member } => lengths[member] = self.by_stiffness(member),
            Parameter::Mass { member } => {
                let link = &self.framework.links[member];
                let [start, end] = self.by_mass(member);
                (forces[link.from].z, forces[link.to].z) = (start, end);
            }
            Parameter::Force { joint, axis } => {
                forces[joint][axis] = self.framework.units.force_n.recip();
            }
            Parameter::Anchor { joint, axis } => {
                if self.framework.nodes[joint].freedom() > 0 {
                    let joint = self.system.joints()[joint].name.to_string();
                    return Err(Error::NotAnAnchor { joint });
                }
                change.places[joint][axis] = self.framework.units.length_m.recip();
                self.stretch_held(&mut change)?;
            }
        }
        let mut lengths = self.framework.by_link(lengths);
        self.release_held(&mut change, &mut lengths);
        let loads = forces.clone();
        (forces, lengths) = self.derivative.left(&change, &self.framework, &forces, &lengths);
        let step = self.solved(&forces, &lengths)?;
        change.places.iter_mut().zip(step.places).for_each(|(place, more)| *place += more);
        change.axial.iter_mut().zip(step.axial).for_each(|(axial, more)| *axial += more);
        let left = self.derivative.left(&change, &self.framework, &loads, &self.nothing().1).0;
        let units = self.framework.units;
        let to_m = |place: &Vector3<f64>| (place * units.length_m).into();
        let nodes = self.framework.nodes.iter().zip(&left);
        change.axial.truncate(self.framework.members());
        // The ground takes what the free directions leave.
        let grounds = nodes.map(|(node, left)| node.free.part(left) - left);
        Ok(Change {
            joints_m: change.places.iter().map(to_m).collect(),
            axial_n: change.axial.iter().map(|axial| axial * units.force_n).collect(),
            reactions_n: grounds.map(|ground| (ground * units.force_n).into()).collect(),
        })
    }

    /// The stiffness matrix of a pair of anchors, N/m: entry (i, k) is the derivative of component
    /// i of the force of the ground on joint `of` by coordinate k of joint `by`. It is symmetric
    /// together with that of the exchanged pair.
    ///
    /// # Errors
    ///
    /// As for [`change`](Self::change).
    ///
    /// # Panics
    ///
    /// When the system has no such joint.
    pub fn anchor_stiffness(&mut self, of: usize, by: usize) -> Result<[[f64; 3]; 3], Error> {
        let mut columns = Matrix3::zeros();
        for axis in 0..3 {
            let change = self.change(Parameter::Anchor { joint: by, axis })?;
            columns.set_column(axis, &Vector3::from(change.reactions_n[of]));
        }
        Ok(columns.transpose().into())
    }

    /// The gradient of a number J by all parameters, from its derivatives by the places of the
    /// joints (per m) and by the axial forces (per N): one solve.
    ///
    /// # Errors
    ///
    /// [`Error::NoDerivative`] when there is none.
    ///
    /// # Panics
    ///
    /// When there is not one derivative for each joint and each member.
    pub fn gradient(&mut self, by_joints: &[Vector], by_axial: &[f64]) -> Result<Gradient, Error> {
        let units = self.framework.units;
        assert_eq!(by_joints.len(), self.framework.nodes.len(), "one derivative for each joint");
        assert_eq!(by_axial.len(), self.framework.members(), "one derivative for each member");
        let places: Vec<_> =
            by_joints.iter().map(|by| Vector3::from(*by) * units.length_m).collect();
        let axial = by_axial.iter().map(|by| by * units.force_n).collect();
        let axial = self.framework.by_link(axial);
        let mut adjoint = self.solved(&places, &axial)?;
        for (k, link) in self.framework.links.iter().enumerate() {
            if self.held(k) {
                adjoint.axial[k] = -axial[k] / link.compliance;
            }
        }
        let members = 0..self.framework.members();
        let nodes = self.framework.nodes.iter().zip(&adjoint.places);
        let by_force = nodes.map(|(_, place)| (place / units.force_n).into()).collect();
        let left = self.derivative.left(&adjoint, &self.framework, &places, &axial).0;
        let anchors = self.framework.nodes.iter().zip(&left);
        let by_anchor = anchors.map(|(node, left)| {
            let moves = if node.freedom() == 0 { *left } else { Vector3::zeros() };
            (moves / units.length_m).into()
        });
        let by_anchor = by_anchor.collect();
        Ok(Gradient {
            by_length: members
                .clone()
                .map(|k| {
                    let link = &self.framework.links[k];
                    let of = (k, self.axial[k]);
                    let (law, [start, end]) = by_length(self.system, units, of);
                    adjoint.axial[k] * law
                        + adjoint.places[link.from].dot(&start)
                        + adjoint.places[link.to].dot(&end)
                })
                .collect(),
            by_prestress: members
                .clone()
                .map(|k| adjoint.axial[k] * self.by_prestress(k))
                .collect(),
            by_stiffness: members
                .clone()
                .map(|k| adjoint.axial[k] * self.by_stiffness(k))
                .collect(),
            by_mass: members
                .map(|k| {
                    let link = &self.framework.links[k];
                    let [start, end] = self.by_mass(k);
                    adjoint.places[link.from].z * start + adjoint.places[link.to].z * end
                })
                .collect(),
            by_force,
            by_anchor,
        })
    }

    fn solved(&mut self, forces: &[Vector3<f64>], lengths: &[f64]) -> Result<Step, Error> {
        let lengths: Vec<f64> = self.derivative.of_taut(lengths);
        let free = self.framework.nodes.iter().zip(forces);
        let nothing = free.map(|(node, f)| node.free.components(f).amax()).all(|f| f == 0.0)
            && lengths.iter().all(|l| *l == 0.0);
        if nothing {
            return Ok(self.none());
        }
        let sides = (forces, lengths.as_slice());
        let solved = self
            .derivative
            .solve(&self.framework, &mut self.stiffness, sides, CLOSURE_ROUNDING, None);
        match solved {
            Some((step, left)) if left <= SOLVED => Ok(step),
            Some((_, left)) => Err(Error::NoDerivative { left }),
            None => Err(Error::NoDerivative { left: 1.0 }),
        }
    }

    /// The members between anchors take the moves of these; an inextensible one cannot.
    fn stretch_held(&self, change: &mut Step) -> Result<(), Error> {
        for (k, link) in self.framework.links.iter().enumerate() {
            let stretch = self.framework.whole(k, |span| {
                self.directions[span].dot(&self.framework.links[span].span(&change.places))
            });
            if self.framework.moves(link) || stretch == 0.0 {
                continue;
            }
            if self.held(k) {
                change.axial[k] = stretch / link.compliance;
            } else if link.compliance <= 0.0 && link.kind == Kind::Bar {
                return Err(Error::NoDerivative { left: 1.0 });
            }
        }
        Ok(())
    }

    /// Their forces follow from their own laws.
    fn release_held(&self, change: &mut Step, lengths: &mut [f64]) {
        for (k, link) in self.framework.links.iter().enumerate() {
            if self.held(k) {
                change.axial[k] -= std::mem::take(&mut lengths[k]) / link.compliance;
            }
        }
    }

    /// Whether a member is elastic, bears a force, and both its ends are anchors.
    fn held(&self, member: usize) -> bool {
        let link = &self.framework.links[member];
        !self.framework.moves(link) && link.compliance > 0.0 && self.axial[member] != 0.0
    }

    fn none(&self) -> Step {
        let (places, axial) = self.nothing();
        Step { places, axial }
    }

    fn nothing(&self) -> (Vec<Vector3<f64>>, Vec<f64>) {
        (vec![Vector3::zeros(); self.framework.nodes.len()], vec![0.0; self.framework.links.len()])
    }

    /// Stiffness and axial force of an elastic member, and the prestress at its length, N.
    fn elastic(&self, member: usize) -> Option<[f64; 3]> {
        let given = &self.system.members()[member];
        let axial_n = self.axial[member] * self.framework.units.force_n;
        Some([given.stiffness_n?, axial_n, given.prestress_n().unwrap_or(0.0)])
    }

    /// What the law of a member gains with the stiffness.
    fn by_stiffness(&self, member: usize) -> f64 {
        self.elastic(member)
            .map_or(0.0, |[k, n, f]| self.given_length(member) * (f - n) / (k + f) / (k + f))
    }

    /// What it gains with the prestress.
    fn by_prestress(&self, member: usize) -> f64 {
        self.elastic(member)
            .map_or(0.0, |[k, n, f]| -self.given_length(member) * (k + n) / (k + f) / (k + f))
    }

    /// The length given, in units of the solver.
    fn given_length(&self, member: usize) -> f64 {
        self.system.members()[member].given_body().length_m() / self.framework.units.length_m
    }

    /// Vertical forces at its two joints from a unit of mass.
    fn by_mass(&self, member: usize) -> [f64; 2] {
        if self.framework.links[member].rope.is_some() {
            return [0.0; 2];
        }
        let body = self.system.members()[member].given_body();
        let weight = -self.system.gravity_m_s2() / self.framework.units.force_n;
        let fraction = body.centre_m() / body.length_m();
        [weight * (1.0 - fraction), weight * fraction]
    }
}

/// What the law of a member and the forces at its two joints gain with the length that is given of it, in units of the solver
/// a metre: with the prestress $F$ the unstretched length is $d\\,EA/(EA + F)$, and loads at places that are given in metres
/// come nearer to the beginning, relative to the length.
pub(super) fn by_length(
    system: &System,
    Units { length_m: unit_m, force_n, .. }: Units,
    (member, axial): (usize, f64),
) -> (f64, [Vector3<f64>; 2]) {
    let member = &system.members()[member];
    let prestress_n = member.prestress_n().unwrap_or(0.0);
    let law = member.stiffness_n.map_or(1.0, |ea| (ea + axial * force_n) / (ea + prestress_n));
    let body = member.given_body();
    let length_m = body.length_m();
    let weight = -Vector3::z() * (body.mass_kg() * system.gravity_m_s2());
    let centre = body.given_centre_m().map(|centre_m| (centre_m, weight));
    let loads = member.given_loads().iter();
    // A load in the middle stays there, whether or not its place was given.
    let loads = loads.filter(|load| load.at_m.to_bits() != (0.5 * length_m).to_bits());
    let loads = loads.map(|load| (load.at_m, Vector3::from(load.force_n)));
    let shift: Vector3<f64> =
        loads.chain(centre).map(|(at_m, force)| force * (at_m / length_m / length_m)).sum();
    let shift = shift / force_n;
    (law / unit_m, [shift, -shift])
}
