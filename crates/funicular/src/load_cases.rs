//! A system in each of its load cases.

use std::sync::Arc;

use model::system::{System, SystemEquilibrium};
use numerics::vector::norm;
use rayon::prelude::*;
use serde::Serialize;
use validate::UseCensus;

use crate::error::Error;
use crate::object::{either, head};
use crate::problem::Problem;
use crate::settled::{Outcome, Settled, Unsettled, settle};
use crate::solve::Solve;
use crate::weakest::from_one;

/// What a system does in one of its load cases.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaseAnswer {
    /// The name of the case.
    pub name: String,
    /// What it comes to rest in, or why it does not. How far joints move is from the first case of the file that has an answer.
    #[serde(flatten, serialize_with = "either")]
    pub settled: Result<Settled, Unsettled>,
}

/// A number with the case that it comes from.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Governing {
    /// The number.
    pub value: f64,
    /// The name of the case.
    pub case: String,
}

/// What a member bears over all cases.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BarEnvelope {
    /// The member, from 0; in JSON from 1.
    #[serde(serialize_with = "from_one")]
    pub bar: usize,
    /// Names of its joints.
    pub ends: [String; 2],
    /// Its smallest axial force anywhere along it, tension positive, N.
    pub least_n: Governing,
    /// Its largest.
    pub most_n: Governing,
    /// The largest part of its strength that it uses, if it has one; infinite (in JSON `null`) where balance
    /// leaves its force without a bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub utilisation: Option<Governing>,
}

/// What the ground bears at a support over all cases.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SupportEnvelope {
    /// Name of the joint.
    pub joint: String,
    /// The largest size of the force of the ground on it, N.
    pub most_n: Governing,
}

/// What a system does in each of its load cases, and the envelope over them; it serialises to what
/// `funicular solve --load-case each --json` prints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadCasesAnswer {
    #[serde(flatten, serialize_with = "head")]
    system: Arc<System>,
    cases: Vec<CaseAnswer>,
    bars: Vec<BarEnvelope>,
    supports: Vec<SupportEnvelope>,
}

impl Problem {
    /// The problem in the load case of this name, of the `[[cases]]` of its file.
    ///
    /// # Errors
    /// [`Error::System`] when there is no such case, or its factors bring a number out of range;
    /// [`Error::Refused`] when what acts then has no equilibrium.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// let text = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
    ///             bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 0 }]\n\
    ///             loads = [{ name = 'snow', joint = 'P', mass_kg = 4 }]\n\
    ///             cases = [{ name = 'summer', factors = {} }, { name = 'winter', factors = { snow = 1.5 } }]";
    /// let pole = Problem::parse(text, "pole.toml")?;
    /// let pull = |problem: &Problem| Solve::new().run(problem).map(|found| found.equilibria()[0].axial_n[0]);
    /// let [all, summer, winter] = [pull(&pole)?, pull(&pole.in_case("summer")?)?, pull(&pole.in_case("winter")?)?];
    /// assert!((all / summer - 5.0).abs() < 1e-9 && (winter / summer - 7.0).abs() < 1e-9);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn in_case(&self, name: &str) -> Result<Self, Error> {
        let system = self.system().in_case(name)?;
        system.refusal()?;
        Ok(system.into())
    }

    /// The names of the load cases, in the order of the file.
    pub fn load_cases(&self) -> Vec<&str> {
        self.0.load_cases().iter().map(|case| case.name.as_str()).collect()
    }
}

impl Solve {
    /// Where a system comes to rest in each of its load cases, and over all of them the least and the largest
    /// force of each member and support. Each by both solvers and the judge, without a census.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// // A lamp of 100 N between two ropes of 5 m, 3-4-5, and 40 N of wind along them.
    /// let text = "gravity_m_s2 = 10\n\
    ///             joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, lamp = { mass_kg = 10 } }\n\
    ///             bars = [{ from = 'A', to = 'lamp', length_m = 5, mass_kg = 0 },\n\
    ///                     { from = 'B', to = 'lamp', length_m = 5, mass_kg = 0 }]\n\
    ///             loads = [{ name = 'wind', joint = 'lamp', force_n = [30, 0, 0] }]\n\
    ///             cases = [{ name = 'east', factors = { wind = 1 } }, { name = 'west', factors = { wind = -1 } }]";
    /// let found = Solve::new().load_cases(&Problem::parse(text, "lamp.toml")?)?;
    /// // Each rope takes 62.5 N of the weight and 25 N of the wind, or is relieved of them.
    /// let rope = &found.bars()[0];
    /// assert!((rope.most_n.value - 87.5).abs() < 1e-9 && rope.most_n.case == "east");
    /// assert!((rope.least_n.value - 37.5).abs() < 1e-9 && rope.least_n.case == "west");
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoCases`] when the problem has none. What has no answer in a case is no error: it says why.
    pub fn load_cases(&self, problem: &Problem) -> Result<LoadCasesAnswer, Error> {
        self.load_cases_watched(problem, &|| {})
    }

    /// The same, with `watch` called after each case.
    ///
    /// # Errors
    /// As [`load_cases`](Self::load_cases).
    pub fn load_cases_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn() + Sync),
    ) -> Result<LoadCasesAnswer, Error> {
        let system = problem.system();
        if system.load_cases().is_empty() {
            return Err(Error::NoCases);
        }
        let solve = self.census(UseCensus::Never);
        let answer = |name: &str, before_m: &[_]| {
            let changed = system.in_case(name).map_err(|error| Unsettled {
                outcome: Outcome::Unknown,
                reason: error.to_string(),
            });
            let settled = changed.and_then(|changed| settle(&solve, changed, before_m));
            watch();
            settled
        };
        let (mut all, mut places) = (vec![], vec![]);
        let mut cases = system.load_cases().iter();
        for case in cases.by_ref() {
            let one = answer(&case.name, &[]);
            places = one.as_ref().map_or_else(|_| vec![], |(.., found)| found.joints_m.clone());
            all.push(one);
            if !places.is_empty() {
                break;
            }
        }
        let rest = || cases.as_slice().par_iter().map(|case| answer(&case.name, &places));
        all.extend(solve.on_threads(|| rest().collect::<Vec<_>>())?);
        Ok(LoadCasesAnswer::new(&system, &all))
    }
}

/// A case that has an answer: the system under its loads.
type InCase = (Settled, Arc<System>, SystemEquilibrium);

/// The cases that have an answer, by their names.
struct Answered<'a> {
    system: &'a System,
    cases: Vec<(&'a str, &'a InCase)>,
}

impl Answered<'_> {
    fn largest(
        &self,
        number: impl Fn(&System, &SystemEquilibrium) -> Option<f64>,
    ) -> Option<Governing> {
        let numbers = self.cases.iter().filter_map(|(case, (_, system, found))| {
            let number = number(system, found)?;
            Some((number, case))
        });
        // Of equal ones the first.
        let (value, case) =
            numbers.reduce(|most, next| if next.0 > most.0 { next } else { most })?;
        Some(Governing { value, case: (*case).to_owned() })
    }

    fn bar(&self, bar: usize) -> Option<BarEnvelope> {
        // What acts between its ends is that of the case.
        let least = self.largest(|system, found| Some(-found.axial_force(system, bar).least_n))?;
        let member = &self.system.members()[bar];
        Some(BarEnvelope {
            bar,
            ends: [member.from, member.to].map(|end| self.system.joints()[end].name.to_string()),
            least_n: Governing { value: -least.value, ..least },
            most_n: self.largest(|system, found| Some(found.axial_force(system, bar).most_n))?,
            utilisation: self.largest(|system, found| found.utilisation(system, bar)),
        })
    }

    /// What a support bears, or the floor under a joint.
    fn support(&self, joint: usize) -> Option<SupportEnvelope> {
        let (held, has_floor) = (&self.system.joints()[joint], self.system.floor_m().is_some());
        let most_n = self.largest(|_, found| Some(norm(found.reactions_n[joint])))?;
        let is_support = held.support.at_m().is_some() || has_floor && most_n.value > 0.0;
        is_support.then(|| SupportEnvelope { joint: held.name.to_string(), most_n })
    }
}

impl LoadCasesAnswer {
    fn new(system: &Arc<System>, found: &[Result<InCase, Unsettled>]) -> Self {
        let all = || system.load_cases().iter().map(|case| case.name.as_str()).zip(found);
        let cases = all().filter_map(|(name, one)| Some((name, one.as_ref().ok()?))).collect();
        let answered = Answered { system, cases };
        let case = |(name, one): (&str, &Result<InCase, Unsettled>)| CaseAnswer {
            name: name.to_owned(),
            settled: one.as_ref().map(|(settled, ..)| settled.clone()).map_err(Clone::clone),
        };
        Self {
            bars: (0..system.members().len()).filter_map(|bar| answered.bar(bar)).collect(),
            supports: (0..system.joints().len()).filter_map(|k| answered.support(k)).collect(),
            cases: all().map(case).collect(),
            system: Arc::clone(system),
        }
    }

    /// The system, all its loads acting.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The cases, in the order of the file.
    pub fn cases(&self) -> &[CaseAnswer] {
        &self.cases
    }

    /// The members over all cases that have an answer.
    pub fn bars(&self) -> &[BarEnvelope] {
        &self.bars
    }

    /// The supports, and the joints that stand on the floor, over all cases that have an answer.
    pub fn supports(&self) -> &[SupportEnvelope] {
        &self.supports
    }

    /// Whether a check of a solver's answer has failed.
    pub fn check_failed(&self) -> bool {
        self.settled().any(|settled| settled.check_failed)
    }

    /// Whether each case has an answer that converged.
    pub fn is_decided(&self) -> bool {
        self.settled().filter(|settled| settled.is_decided).count() == self.cases.len()
    }

    /// Whether the system hangs in each case as strong as is required; no value where no member has a strength.
    pub fn is_strong(&self) -> Option<bool> {
        let strong = self.settled().filter(|settled| settled.is_strong() == Some(true));
        self.system.has_strengths().then(|| strong.count() == self.cases.len())
    }

    fn settled(&self) -> impl Iterator<Item = &Settled> {
        self.cases.iter().filter_map(|case| case.settled.as_ref().ok())
    }
}
