//! What is asked about, held for Python.

use std::path::PathBuf;
use std::sync::Arc;

use funicular::prelude::{Anchors, Bar, Chain, Joint, Kind, Member, Support, System, Vector};
use numpy::{PyArray1, PyArray2, PyReadonlyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{column, numbers, rows, vectors};
use crate::nets;
use crate::raise::{internal, raise};

/// A chain between two anchors or a system of joints and members, which has an answer.
#[pyclass(frozen, module = "funicular._native")]
pub struct Problem {
    /// The problem; shared with the work on it.
    pub of: Arc<funicular::Problem>,
    /// How a file of another program was read.
    #[pyo3(get)]
    notes: Vec<String>,
}

impl Problem {
    fn new(of: funicular::Problem) -> Self {
        Self { of: Arc::new(of), notes: vec![] }
    }

    fn made(of: Result<funicular::Problem, funicular::Error>) -> PyResult<Self> {
        of.map(Self::new).map_err(|error| raise(&error))
    }
}

/// Bars of these lengths, masses, and where given centres of weight and moments of inertia.
fn bars(
    lengths: &[f64],
    masses: &[f64],
    centres: Option<&[f64]>,
    inertias: Option<&[Vector]>,
) -> Result<Vec<Bar>, funicular::Error> {
    let bar = |k: usize| {
        let centre_m = centres.map(|centres| centres[k]);
        let inertia = inertias.map(|inertias| inertias[k]);
        Ok(Bar::given(lengths[k], masses[k], centre_m, inertia)?)
    };
    (0..lengths.len()).map(bar).collect()
}

/// A list that is as long as another.
fn same(length: usize, others: &[(&str, usize)]) -> PyResult<()> {
    match others.iter().find(|(_, other)| *other != length) {
        Some((name, other)) => {
            Err(PyValueError::new_err(format!("{name}: {length} entries wanted, got {other}")))
        }
        None => Ok(()),
    }
}

type Doubles<'py> = PyReadonlyArrayDyn<'py, f64>;

#[pymethods]
impl Problem {
    /// A chain of bars between two anchors.
    #[staticmethod]
    #[expect(clippy::too_many_arguments, reason = "arrays, one for each quantity")]
    fn chain(
        name: &str,
        gravity_m_s2: f64,
        start_m: Vector,
        end_m: Vector,
        lengths_m: Doubles<'_>,
        masses_kg: Doubles<'_>,
        centres_m: Option<Doubles<'_>>,
        inertias_kg_m2: Option<Doubles<'_>>,
    ) -> PyResult<Self> {
        let (lengths, masses) = (numbers(&lengths_m)?, numbers(&masses_kg)?);
        let centres = centres_m.as_ref().map(numbers).transpose()?;
        let inertias = inertias_kg_m2.as_ref().map(vectors).transpose()?;
        let count = |length: Option<usize>| length.unwrap_or(lengths.len());
        let others = [
            ("masses", masses.len()),
            ("centres", count(centres.as_ref().map(Vec::len))),
            ("inertias", count(inertias.as_ref().map(Vec::len))),
        ];
        same(lengths.len(), &others)?;
        let build = || {
            let bars = bars(&lengths, &masses, centres.as_deref(), inertias.as_deref())?;
            let chain = Chain::new(name, gravity_m_s2, Anchors { start_m, end_m }, bars)?;
            funicular::Problem::try_from(chain)
        };
        Self::made(build())
    }

    /// Joints and members. `supports` has 0 for a free joint, 1 for an anchor, 2 for one that
    /// slides on a line, 3 in a plane; `kinds` 0 for a bar, 1 for a cable, 2 for a strut.
    #[staticmethod]
    #[expect(clippy::too_many_arguments, reason = "arrays, one for each quantity")]
    fn network(
        py: Python<'_>,
        name: &str,
        gravity_m_s2: f64,
        names: Vec<String>,
        supports: Vec<u8>,
        at_m: Doubles<'_>,
        directions: Doubles<'_>,
        joint_masses_kg: Doubles<'_>,
        forces_n: Doubles<'_>,
        from: Vec<usize>,
        to: Vec<usize>,
        kinds: Vec<u8>,
        lengths_m: Doubles<'_>,
        masses_kg: Doubles<'_>,
        centres_m: Option<Doubles<'_>>,
        stiffnesses_n: Option<Doubles<'_>>,
    ) -> PyResult<Self> {
        let (at_m, directions) = (vectors(&at_m)?, vectors(&directions)?);
        let (joint_masses, forces) = (numbers(&joint_masses_kg)?, vectors(&forces_n)?);
        let others = [
            ("supports", supports.len()),
            ("places", at_m.len()),
            ("directions", directions.len()),
            ("masses of joints", joint_masses.len()),
            ("forces", forces.len()),
        ];
        same(names.len(), &others)?;
        let (lengths, masses) = (numbers(&lengths_m)?, numbers(&masses_kg)?);
        let centres = centres_m.as_ref().map(numbers).transpose()?;
        let stiffnesses = stiffnesses_n.as_ref().map(numbers).transpose()?;
        let count = |list: &Option<Vec<f64>>| list.as_ref().map_or(lengths.len(), Vec::len);
        let others = [
            ("masses", masses.len()),
            ("first joints", from.len()),
            ("second joints", to.len()),
            ("kinds", kinds.len()),
            ("centres", count(&centres)),
            ("stiffnesses", count(&stiffnesses)),
        ];
        same(lengths.len(), &others)?;
        let build = || {
            let joints = names.into_iter().enumerate().map(|(k, name)| {
                Joint::free(name)
                    .held_by(support(supports[k], at_m[k], directions[k]))
                    .with_mass(joint_masses[k])
                    .with_force(forces[k])
            });
            let joints = joints.collect();
            let bodies = bars(&lengths, &masses, centres.as_deref(), None)?;
            let members = bodies.into_iter().enumerate().map(|(k, body)| {
                Member::bar(from[k], to[k], body)
                    .of_kind(kind(kinds[k]))
                    .with_stiffness(stiffnesses.as_ref().map(|all| all[k]).filter(|x| !x.is_nan()))
            });
            let system = System::new(name, gravity_m_s2, joints, members.collect())?;
            system.refusal()?;
            Ok(funicular::Problem::from(system))
        };
        Self::made(py.detach(build))
    }

    /// The text of a system file.
    #[staticmethod]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        Self::made(py.detach(|| funicular::Problem::parse(text, name)))
    }

    /// A system file, or one of another program.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read = py.detach(|| funicular::Reading::of(path)).map_err(|error| raise(&error))?;
        Ok(Self { notes: read.notes, ..Self::new(read.problem) })
    }

    /// A named case.
    #[staticmethod]
    fn case(name: &str) -> PyResult<Self> {
        Self::made(funicular::Problem::case(name))
    }

    /// The names of all cases.
    #[staticmethod]
    fn cases() -> Vec<&'static str> {
        model::cases::named().map(|(name, _)| name).collect()
    }

    /// The same with another question: the equilibrium next to this shape.
    fn near(&self, py: Python<'_>, joints_m: Doubles<'_>) -> PyResult<Self> {
        let joints = vectors(&joints_m)?;
        Self::made(py.detach(|| self.of.near(&joints)))
    }

    /// The same in one of its load cases.
    fn in_case(&self, name: &str) -> PyResult<Self> {
        Self::made(self.of.in_case(name))
    }

    /// The numbers under the name of an array of [`with_numbers`](Self::with_numbers), NaN where there
    /// are none.
    fn numbers<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let values = nets::values(&self.system(), name);
        values.map(|values| column(py, values)).ok_or_else(|| internal(name))
    }

    /// The same with other numbers; NaN leaves one as it is.
    fn with_numbers(&self, py: Python<'_>, arrays: Vec<(String, Doubles<'_>)>) -> PyResult<Self> {
        nets::with_numbers(py, self, arrays).map(Self::new)
    }

    /// The name.
    #[getter]
    fn name(&self) -> &str {
        self.of.name()
    }

    /// Whether it is a row of rigid bars between two anchors.
    #[getter]
    fn is_chain(&self) -> bool {
        self.of.row().is_some()
    }

    /// Gravity along -Z, m/s².
    #[getter]
    fn gravity_m_s2(&self) -> f64 {
        self.system().gravity_m_s2()
    }

    /// The system file that reads back to the same, bit for bit.
    fn toml(&self) -> String {
        self.of.to_toml()
    }

    /// Names of the joints; those of a chain are `0`, `1`, ...
    fn joint_names(&self) -> Vec<String> {
        self.system().joints().iter().map(|joint| joint.name.to_string()).collect()
    }

    /// Points of the supports, shape (joints, 3), NaN for free joints, m.
    fn supports_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let joints = self.system();
        let at = joints.joints().iter().map(|joint| joint.support.at_m());
        rows(py, at.map(|at| at.unwrap_or([f64::NAN; 3])).collect())
    }

    /// The joints where each member begins and ends, from 0.
    fn member_joints(&self) -> Vec<(usize, usize)> {
        self.system().members().iter().map(|member| (member.from, member.to)).collect()
    }

    /// The joints that each member runs over between these, from 0: rings and pulleys of a rope.
    fn member_via(&self) -> Vec<Vec<usize>> {
        self.system().members().iter().map(|member| member.via().to_vec()).collect()
    }

    /// The kind of each member.
    fn member_kinds(&self) -> Vec<&'static str> {
        self.system().members().iter().map(|member| member.kind.name()).collect()
    }
}

impl Problem {
    /// As joints and members.
    pub fn system(&self) -> Arc<System> {
        self.of.system()
    }
}

fn support(word: u8, at_m: Vector, direction: Vector) -> Support {
    match word {
        1 => Support::Fixed { at_m },
        2 => Support::Line { at_m, direction },
        3 => Support::Plane { at_m, normal: direction },
        _ => Support::Free,
    }
}

fn kind(word: u8) -> Kind {
    match word {
        1 => Kind::Cable,
        2 => Kind::Strut,
        _ => Kind::Bar,
    }
}
