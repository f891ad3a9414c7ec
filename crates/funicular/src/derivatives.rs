//! How an equilibrium changes with the numbers of its system.

use std::io::{self, Write};
use std::sync::Arc;

use branches::{BarField, JointField, Number, Which};
use lagrange::net::{self, Gradient};
use model::Vector;
use model::budget::BYTES_PER_MEMBER;
use model::system::{System, SystemEquilibrium};
use serde::{Serialize, Serializer};
use validate::systems::Near;

use crate::csv::quoted;
use crate::equilibria::as_solved;
use crate::error::Error;
use crate::observable::Observable;
use crate::parameters::{parsed, without_value};
use crate::problem::Problem;

/// Derivatives of the hanging equilibrium of a chain or a system: stiffness matrices of its
/// anchors, gradients of one number by all parameters, changes of everything by one parameter.
///
/// They follow from one factorisation of the equations of equilibrium, by the solver `lagrange`
/// (see [`lagrange::net::Derivatives`]), and hold as long as no slack member becomes taut and
/// no taut one slack.
///
/// ```
/// use funicular::prelude::*;
/// // Two massless bars of 5 m over a span of 6 m with 8 N in the middle: depth 4 m.
/// let problem = Problem::parse(
///     "gravity_m_s2 = 10\n\
///      joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 0.8 } }\n\
///      bars = [{ from = \"A\", to = \"P\", length_m = 5, mass_kg = 0 },\n\
///              { from = \"P\", to = \"B\", length_m = 5, mass_kg = 0 }]",
///     "v.toml",
/// )?;
/// let derivatives = Derivatives::new().run(&problem)?;
/// // The pull 8/2 * a/sqrt(l² - a²) of half the span a grows by W l²/(4 h³) with the span.
/// let own = &derivatives.anchor_stiffness()?[3];
/// assert_eq!((own.of.as_str(), own.by.as_str()), ("B", "B"));
/// assert!((own.stiffness_n_m[0][0] - 8.0 * 25.0 / (4.0 * 64.0)).abs() < 1e-10);
/// // The joint is half of l/h deeper for each metre of a bar.
/// let depth = derivatives.gradient("joints.P.at_m.z")?;
/// let by = depth.by("bars.1.length_m").expect("a length");
/// assert!((by.value + 5.0 / 8.0).abs() < 1e-10);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Derivatives;

/// An equilibrium, ready to be asked for its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct DerivativesAnswer {
    system: Arc<System>,
    solution: net::Solution,
}

/// The stiffness matrix of a pair of anchors.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnchorStiffness {
    /// The anchor whose force changes.
    pub of: String,
    /// The anchor that moves.
    pub by: String,
    /// Entry (i, k) is the derivative of component i of the force of the ground on the one by
    /// coordinate k of the other, N/m.
    pub stiffness_n_m: [[f64; 3]; 3],
}

/// The derivative of a number by a parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Derivative {
    /// The parameter by its path in a system file, such as `bars.2.length_m`.
    pub parameter: String,
    /// The derivative.
    pub value: f64,
    /// Its unit.
    pub unit: String,
}

/// The derivatives of one number of the equilibrium by all parameters.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NumberGradient {
    /// The number: `joints.P.at_m.z`, or `bars.2.axial_n`.
    pub of: String,
    /// Its value, in m or N.
    pub value: f64,
    /// By lengths, masses, stiffnesses and prestresses of bars, forces on free joints and places of anchors.
    pub derivatives: Vec<Derivative>,
}

/// The derivatives of an equilibrium by one parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParameterChange {
    /// The parameter.
    pub by: String,
    /// Its unit: all below is per unit of it.
    pub unit: &'static str,
    /// Of the joints, m, by name.
    #[serde(serialize_with = "by_name")]
    pub joints_m: Vec<(String, Vector)>,
    /// Of the axial forces of the bars, N.
    pub axial_n: Vec<f64>,
    /// Of the forces of the ground at the supports, N, by name.
    #[serde(serialize_with = "by_name")]
    pub reactions_n: Vec<(String, Vector)>,
}

/// A list of vectors as an object with the names as keys.
fn by_name<S: Serializer>(list: &[(String, Vector)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(list.iter().map(|(name, vector)| (name, vector)))
}

/// Why a derivative cannot be asked for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DerivativesError {
    /// Occurs when the text names a number without derivatives.
    #[error(
        "there are no derivatives of `{0}`: they exist for `joints.NAME.x` (y, z), a coordinate of a joint that \
         moves, and for `bars.K.axial_n`, the axial force of bar K, from 1"
    )]
    NoNumber(String),
    /// Occurs when derivatives by the parameter of this text are not known.
    #[error(
        "there are no derivatives by `{0}`: they exist for `length_m`, `mass_kg`, \
         `stiffness_n` and `prestress_n` of one bar (of a rope no `mass_kg`), `mass_kg` and `force_n` of a joint, \
         `at_m` of an anchor"
    )]
    NoParameter(String),
}

impl Derivatives {
    /// By `lagrange`, with its usual settings.
    pub fn new() -> Self {
        Self
    }

    /// Of the hanging equilibrium of a problem, or of the one next to it as it is drawn.
    ///
    /// # Errors
    /// [`Error::Refused`] when there is none, [`Error::Lagrange`] when it is not found, [`Error::Disagreed`] when the solvers
    /// disagree on it.
    pub fn run(&self, problem: &Problem) -> Result<DerivativesAnswer, Error> {
        problem.fits(BYTES_PER_MEMBER)?;
        let system = problem.system();
        system.refusal()?;
        let (solution, disagreed) = as_solved(&system);
        if disagreed {
            return Err(Error::Disagreed);
        }
        Ok(DerivativesAnswer { system, solution: solution? })
    }
}

impl DerivativesAnswer {
    /// Whether the equilibrium is the neighbour of the shape that is drawn, if one is.
    pub fn is_neighbour(&self) -> bool {
        let drawing_m = self.system.drawing();
        drawing_m.is_none_or(|at| Near::of(&self.system, &at, self.equilibrium()).is_neighbour)
    }

    /// The equilibrium.
    pub fn equilibrium(&self) -> &SystemEquilibrium {
        &self.solution.equilibrium
    }

    /// The system; a chain has joints named by their numbers, from `0`.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The stiffness matrices of all pairs of anchors.
    ///
    /// # Errors
    /// [`Error::Lagrange`] where the equilibrium has no derivatives: it is degenerate, or an anchor
    /// cannot move alone.
    pub fn anchor_stiffness(&self) -> Result<Vec<AnchorStiffness>, Error> {
        let mut derivatives = net::Derivatives::new(&self.system, &self.solution)?;
        let joints = self.system.joints();
        let anchors: Vec<usize> =
            (0..joints.len()).filter(|k| joints[*k].support.is_fixed()).collect();
        // Column by column: one solve serves the forces of all anchors.
        let mut columns = Vec::with_capacity(anchors.len());
        for joint in &anchors {
            let mut moved = Vec::with_capacity(3);
            for axis in 0..3 {
                let parameter = net::Parameter::Anchor { joint: *joint, axis };
                moved.push(derivatives.change(parameter)?.reactions_n);
            }
            columns.push(moved);
        }
        let pair = |of: usize, by: usize| AnchorStiffness {
            of: joints[anchors[of]].name.to_string(),
            by: joints[anchors[by]].name.to_string(),
            stiffness_n_m: std::array::from_fn(|i| {
                std::array::from_fn(|k| columns[by][k][anchors[of]][i])
            }),
        };
        let all = || 0..anchors.len();
        Ok(all()
            .flat_map(|of| all().map(move |by| (of, by)))
            .map(|(of, by)| pair(of, by))
            .collect())
    }

    /// The derivatives of one number by all parameters: `joints.P.at_m.z`, a coordinate of a joint,
    /// or `bars.2.axial_n`, an axial force.
    ///
    /// # Errors
    /// [`Error::Derivatives`] when the text names no such number, [`Error::Parameter`] when the
    /// joint is not there, [`Error::Lagrange`] where there are no derivatives.
    pub fn gradient(&self, of: &str) -> Result<NumberGradient, Error> {
        let found = &self.solution.equilibrium;
        let mut by_joints = vec![[0.0; 3]; self.system.joints().len()];
        let mut by_axial = vec![0.0; self.system.members().len()];
        let (value, unit) = match Observable::parse(of, &self.system)? {
            Observable::Place(joint, axis) if !self.system.joints()[joint].support.is_fixed() => {
                by_joints[joint][axis] = 1.0;
                (found.joints_m[joint][axis], "m")
            }
            Observable::Axial(member, 0) => {
                by_axial[member] = 1.0;
                (found.axial_n[member], "N")
            }
            _ => return Err(DerivativesError::NoNumber(of.to_owned()).into()),
        };
        let gradient = self.pullback(&by_joints, &by_axial)?;
        Ok(NumberGradient { of: of.to_owned(), value, derivatives: self.listed(&gradient, unit) })
    }

    /// The derivatives of any function of places and axial forces by all parameters, from those by
    /// each joint and each member: the product with the transposed Jacobian, in one solve.
    ///
    /// # Errors
    /// [`Error::Lagrange`] where the equilibrium has no derivatives.
    ///
    /// # Panics
    /// Where there are more or fewer derivatives than joints or members.
    pub fn pullback(&self, by_joints: &[Vector], by_axial: &[f64]) -> Result<Gradient, Error> {
        let mut derivatives = net::Derivatives::new(&self.system, &self.solution)?;
        Ok(derivatives.gradient(by_joints, by_axial)?)
    }

    /// A gradient with the names of the parameters.
    fn listed(&self, gradient: &Gradient, unit: &str) -> Vec<Derivative> {
        let mut list = Vec::new();
        let mut add = |number: Number, value: f64| {
            let unit = format!("{unit}/{}", number.unit());
            list.push(Derivative { parameter: number.to_string(), value, unit });
        };
        let bar = |k: usize, field| Number::Bar(Which::One(k + 1), field);
        // What the file has acts by so much.
        let acts = self.system.permanent_factor();
        for (k, member) in self.system.members().iter().enumerate() {
            add(bar(k, BarField::Length), gradient.by_length[k]);
            if member.rope.is_none() {
                add(bar(k, BarField::Mass), acts * gradient.by_mass[k]);
            }
            if member.stiffness_n.is_some() {
                add(bar(k, BarField::Stiffness), gradient.by_stiffness[k]);
            }
            if member.prestress.is_some() {
                add(bar(k, BarField::Prestress), gradient.by_prestress[k]);
            }
        }
        // The plane that all joints are kept to moves with none of them.
        let across = self.system.across();
        for (k, joint) in self.system.joints().iter().enumerate() {
            let number = |field| Number::Joint(joint.name.to_string(), field);
            if joint.support.is_fixed() {
                for axis in (0..3).filter(|axis| across != Some(*axis)) {
                    add(number(JointField::Place(axis)), gradient.by_anchor[k][axis]);
                }
                continue;
            }
            let weight = -acts * self.system.gravity_m_s2() * gradient.by_force[k][2];
            add(number(JointField::Mass), weight);
            for axis in 0..3 {
                add(number(JointField::Force(axis)), acts * gradient.by_force[k][axis]);
            }
        }
        list
    }

    /// The derivatives of joints and forces by one parameter, such as `bars.2.length_m`.
    ///
    /// A parameter is the number of the system file: `length_m` of a prestressed bar is its length
    /// under the prestress. All others stay; a centre that is left out and forces in the middle
    /// stay in the middle.
    ///
    /// # Errors
    /// [`Error::Parameter`] when the system has no such number, [`Error::Derivatives`] when there
    /// are no derivatives by it, [`Error::Lagrange`] where the equilibrium has none.
    pub fn change(&self, by: &str) -> Result<ParameterChange, Error> {
        let (number, parameter, scale) = self.parameter(by)?;
        let mut derivatives = net::Derivatives::new(&self.system, &self.solution)?;
        let change = derivatives.change(parameter)?;
        let joints = self.system.joints();
        let scaled = |v: Vector| v.map(|x| scale * x);
        let named = |k: usize, v: Vector| (joints[k].name.to_string(), scaled(v));
        let held = (0..joints.len()).filter(|k| joints[*k].support.at_m().is_some());
        Ok(ParameterChange {
            by: number.to_string(),
            unit: number.unit(),
            joints_m: change.joints_m.iter().enumerate().map(|(k, v)| named(k, *v)).collect(),
            axial_n: change.axial_n.iter().map(|n| scale * n).collect(),
            reactions_n: held.map(|k| named(k, change.reactions_n[k])).collect(),
        })
    }

    /// A parameter as the solver has it, and what its derivatives are multiplied by.
    fn parameter(&self, text: &str) -> Result<(Number, net::Parameter, f64), Error> {
        let number = self.checked(text)?;
        let acts = self.system.permanent_factor();
        let is_rope = |member: usize| self.system.members()[member].rope.is_some();
        let of_bar = |member: usize, field| match field {
            BarField::Length => Some((net::Parameter::Length { member }, 1.0)),
            BarField::Mass if !is_rope(member) => Some((net::Parameter::Mass { member }, acts)),
            BarField::Prestress => Some((net::Parameter::Prestress { member }, 1.0)),
            BarField::Stiffness => Some((net::Parameter::Stiffness { member }, 1.0)),
            _ => None,
        };
        let weight = -acts * self.system.gravity_m_s2();
        let of_joint = |joint: usize, field| match field {
            JointField::Place(axis) => Some((net::Parameter::Anchor { joint, axis }, 1.0)),
            JointField::Force(axis) => Some((net::Parameter::Force { joint, axis }, acts)),
            JointField::Mass => Some((net::Parameter::Force { joint, axis: 2 }, weight)),
            JointField::Share => None,
        };
        let found = match branches::resolved(&self.system, &number) {
            Number::Bar(Which::One(bar), field) => of_bar(bar - 1, field),
            Number::Joint(name, field) => {
                self.system.joint(&name).and_then(|joint| of_joint(joint, field))
            }
            _ => None,
        };
        let none = || DerivativesError::NoParameter(text.to_owned());
        let (parameter, scale) = found.ok_or_else(none)?;
        Ok((number, parameter, scale))
    }

    /// The number of the system that a path names.
    fn checked(&self, path: &str) -> Result<Number, Error> {
        let parameter = parsed(path)?;
        branches::check(&self.system, &parameter).map_err(|error| without_value(error, path))?;
        Ok(parameter.number)
    }
}

impl NumberGradient {
    /// The derivative by the parameter of this path.
    pub fn by(&self, parameter: &str) -> Option<&Derivative> {
        self.derivatives.iter().find(|derivative| derivative.parameter == parameter)
    }

    /// A line per parameter as CSV.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        writeln!(to, "parameter,derivative,unit")?;
        for Derivative { parameter, value, unit } in &self.derivatives {
            writeln!(to, "{},{value:?},{unit}", quoted(parameter))?;
        }
        Ok(())
    }
}
