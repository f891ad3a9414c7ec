//! What becomes of an equilibrium within the tolerances of its numbers.

use std::io::{self, Write};

use census::boxes::{Depth, NoRanges, Range, ToleranceRanges, prove_ranges};
use model::InSpace;
use model::system::{MemberTolerances, Strength, System, Uncertain, UncertainNumber};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use crate::csv::{Numbers, or_empty, quoted};
use crate::draws::{Distribution, Draws};
use crate::error::Error;
use crate::problem::Problem;
use crate::sag::Sag;
use crate::solve::{Lists, Solve, SolveAnswer};

/// The coordinates as numbers of files name them.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Memory that a number of a draw takes, of each member's force and of its joint, bytes.
const BYTES_PER_DRAW: u64 = 32;

/// An equilibrium, and its ranges over the tolerances of the system's numbers.
#[derive(Debug, Clone)]
pub struct TolerancesAnswer {
    answer: SolveAnswer,
    sag: Option<Sag>,
    ranges: Result<ToleranceRanges, NoRanges>,
    draws: Option<Draws>,
}

impl Solve {
    /// Bound places, forces and reactions for all values of the numbers within their tolerances
    /// (`length_tolerance_m` and the like), in interval arithmetic: exactly one equilibrium is next to that of the
    /// numbers given for all of them, no cable changes between slack and taut, and no value is outside of
    /// the ranges. What is not proved says why.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// // 30 kg on two ropes of 5 m between anchors 8 m apart: 250 N each, on a triangle 3, 4, 5.
    /// let text = "gravity_m_s2 = 10\n\
    ///             tolerances = { length_tolerance_m = 0.01 }\n\
    ///             joints = { A = { at_m = [-4, 0, 0] }, B = { at_m = [4, 0, 0] }, P = { mass_kg = 30 } }\n\
    ///             bars = [{ from = 'A', to = 'P', length_m = 5, mass_kg = 0 },\n\
    ///                     { from = 'B', to = 'P', length_m = 5, mass_kg = 0 }]";
    /// let found = Solve::new().tolerances(&Problem::parse(text, "ropes.toml")?)?;
    /// let ranges = found.ranges().expect("a proof");
    /// // Both a centimetre longer: P hangs at sqrt(5.01² - 4²), and each bears 300/2 · 5.01 over that.
    /// let depth = (5.01_f64.powi(2) - 16.0).sqrt();
    /// assert!((ranges.joints_m[2][2].guaranteed[0] + depth).abs() < 1e-9);
    /// assert!(ranges.axial_n[0].contains(150.0 * 5.01 / depth) && ranges.axial_n[0].is_hull);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn tolerances(&self, problem: &Problem) -> Result<TolerancesAnswer, Error> {
        self.tolerances_drawn(problem, 0, 0, Distribution::default())
    }

    /// The same, and what becomes of so many random values from a seed, within the tolerances, each solved
    /// next to that of the numbers given.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn tolerances_drawn(
        &self,
        problem: &Problem,
        draws: usize,
        seed: u64,
        distribution: Distribution,
    ) -> Result<TolerancesAnswer, Error> {
        let answer = self.run(problem)?;
        let (system, found) = (answer.system(), &answer.equilibria()[0]);
        let sag = Sag::largest(system, &found.joints_m).filter(|sag| sag.depth_m >= 0.0);
        let depth = sag.map(|Sag { joint, ends, .. }| Depth { joint, ends });
        let prove = || prove_ranges(system, &found.joints_m, &found.axial_n, depth.as_slice());
        let ranges = self.on_threads(prove)?;
        let draw = || Draws::new(self, (system, found), &ranges, (draws, seed, distribution));
        problem.fits((draws as u64).saturating_mul(BYTES_PER_DRAW))?;
        let draws = if draws > 0 { Some(self.on_threads(draw)?) } else { None };
        Ok(TolerancesAnswer { answer, sag, ranges, draws })
    }
}

impl TolerancesAnswer {
    /// The equilibrium of the numbers given.
    pub fn answer(&self) -> &SolveAnswer {
        &self.answer
    }

    /// The ranges over all tolerances.
    ///
    /// # Errors
    /// [`NoRanges`], why nothing is proved.
    pub fn ranges(&self) -> Result<&ToleranceRanges, &NoRanges> {
        self.ranges.as_ref()
    }

    /// The largest sag of the numbers given, and the range of how deep that joint is below that line, m.
    pub fn sag(&self) -> Option<(Sag, &Range)> {
        Some((self.sag?, self.ranges.as_ref().ok()?.depths_m.first()?))
    }

    /// What became of the draws.
    pub fn draws(&self) -> Option<&Draws> {
        self.draws.as_ref()
    }

    /// Whether the equilibrium is stable for all values, as it is for the numbers given: its derivative is
    /// regular for all, so that no stable one becomes unstable. `None` where nothing is proved.
    pub fn is_stable(&self) -> Option<bool> {
        let stability = self.answer.equilibria()[0].stability;
        self.ranges.as_ref().ok().map(|_| stability.in_space == InSpace::Stable)
    }

    /// Whether a check has failed: of the answer, or of a draw against the ranges.
    pub fn check_failed(&self) -> bool {
        self.answer.check_failed() || self.draws.as_ref().is_some_and(|draws| draws.outside > 0)
    }

    /// Whether the solvers have decided, and the ranges are proved.
    pub fn is_decided(&self) -> bool {
        self.answer.is_decided() && self.ranges.is_ok()
    }

    /// The least and the largest part of its strength that a member, from 0, uses; `None` without a
    /// strength or a proof. Its own weight and loads are counted as if they all added to its force.
    pub fn utilisation(&self, member: usize) -> Option<[f64; 2]> {
        let (system, ranges) = (self.answer.system(), self.ranges.as_ref().ok()?);
        let strength: &Strength = system.members().get(member)?.strength.as_deref()?;
        let [least_n, most_n] = ranges.axial_n[member].guaranteed;
        let more_n = own_load_n(system, member);
        // Of the force that is nearest to none.
        let smallest_n = 0.0_f64.clamp(least_n, most_n);
        let [least_n, most_n] = [(least_n - more_n).next_down(), (most_n + more_n).next_up()];
        let least = strength.utilisation(smallest_n, smallest_n).next_down().max(0.0);
        Some([least, strength.utilisation(least_n, most_n).next_up()])
    }

    /// As a number of the file is named: `bars.2.length_m`.
    pub fn number_name(&self, number: usize) -> Option<String> {
        let numbers = &self.ranges.as_ref().ok()?.numbers;
        Some(name(self.answer.system(), numbers.get(number)?.number))
    }
}

/// All loads of a member at their largest, N, from above.
fn own_load_n(system: &System, member: usize) -> f64 {
    let of = &system.members()[member];
    let within_kg = of.tolerances.as_deref().map_or(0.0, MemberTolerances::mass_kg);
    let mass_kg = (of.body.mass_kg() + within_kg).next_up();
    let weight_n = (mass_kg * system.gravity_m_s2()).next_up();
    let weight_n = if of.body.mass_kg() > 0.0 { weight_n } else { 0.0 };
    let sizes = of.loads.iter().flat_map(|load| load.force_n).map(f64::abs);
    sizes.filter(|size| *size > 0.0).fold(weight_n, |all, size| (all + size).next_up())
}

/// As `study --vary` and `derivatives` name it.
fn name(system: &System, number: UncertainNumber) -> String {
    let bar = |k: usize, key: &str| format!("bars.{}.{key}", k + 1);
    let joint = |k: usize, key: &str| format!("joints.{}.{key}", system.joints()[k].name);
    match number {
        UncertainNumber::Length(k) => bar(k, "length_m"),
        UncertainNumber::Stiffness(k) => bar(k, "stiffness_n"),
        UncertainNumber::Mass(k) => bar(k, "mass_kg"),
        UncertainNumber::JointMass(k) => joint(k, "mass_kg"),
        UncertainNumber::At(k, axis) => joint(k, &format!("at_m.{}", AXES[axis])),
        UncertainNumber::Force(k, axis) => joint(k, &format!("force_n.{}", AXES[axis])),
    }
}

impl TolerancesAnswer {
    /// The ranges of joints as CSV, a line per joint: least and largest value of each coordinate and of each
    /// component of the force of the ground, empty where there is none; only the heads without a proof.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        let mut columns = vec!["joint".to_owned()];
        for (what, unit) in [("", "m"), ("reaction_", "n")] {
            let ends = |axis| ["least", "most"].map(|end| format!("{what}{axis}_{end}_{unit}"));
            columns.extend(AXES.into_iter().flat_map(ends));
        }
        writeln!(to, "{}", columns.join(","))?;
        let Ok(ranges) = &self.ranges else { return Ok(()) };
        let all = |all: &[[Range; 3]]| -> Vec<f64> { all.iter().flat_map(ends).collect() };
        let forces: Vec<_> = ranges.reactions_n.iter().flatten().copied().collect();
        let (at, pulls) = (Numbers::of(&all(&ranges.joints_m)), Numbers::of(&all(&forces)));
        let joints = self.answer.system().joints().iter().zip(&ranges.joints_m);
        for ((joint, at_m), force_n) in joints.zip(&ranges.reactions_n) {
            let mut cells = vec![quoted(&joint.name)];
            cells.extend(ends(at_m).map(|x| at.cell(x)));
            let pulled = force_n.iter().flat_map(ends);
            cells.extend(pulled.map(|x| pulls.cell(x)));
            cells.resize(columns.len(), String::new());
            writeln!(to, "{}", cells.join(","))?;
        }
        Ok(())
    }

    /// The ranges of members as CSV, a line per member: its joints, the least and the largest axial force, how far both
    /// are reached, whether that is the hull, and the number on which it depends most; the least and largest part of its
    /// strength that is used, empty without one; only the heads without a proof.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_bars_csv(&self, mut to: impl Write) -> io::Result<()> {
        writeln!(
            to,
            "bar,from,to,least_n,most_n,least_reached_n,most_reached_n,is_hull,most_by,most_change_n,least_utilisation,most_utilisation"
        )?;
        let Ok(ranges) = &self.ranges else { return Ok(()) };
        let all = ranges.axial_n.iter().flat_map(|range| range.guaranteed);
        let (numbers, system) = (Numbers::of(&all.collect::<Vec<_>>()), self.answer.system());
        for (k, (member, range)) in system.members().iter().zip(&ranges.axial_n).enumerate() {
            let [from, end] =
                [member.from, member.to].map(|joint| quoted(&system.joints()[joint].name));
            let forces = [range.guaranteed, range.reached];
            let forces = forces.as_flattened().iter().map(|x| numbers.cell(*x));
            let forces = forces.collect::<Vec<_>>().join(",");
            let (number, by) = range.most_by.unzip();
            let name = number.and_then(|number| self.number_name(number)).unwrap_or_default();
            let by = or_empty(by);
            let used =
                self.utilisation(k).map_or_else(|| ",".to_owned(), |[a, b]| format!("{a:?},{b:?}"));
            let (bar, is_hull, name) = (k + 1, range.is_hull, quoted(&name));
            writeln!(to, "{bar},{from},{end},{forces},{is_hull},{name},{by},{used}")?;
        }
        Ok(())
    }
}

/// Least and largest of each.
fn ends(of: &[Range; 3]) -> [f64; 6] {
    let [[a, b], [c, d], [e, f]] = of.map(|range| range.guaranteed);
    [a, b, c, d, e, f]
}

impl TolerancesAnswer {
    /// As JSON has it under `tolerances`.
    fn object(&self) -> Value {
        let mut object = match &self.ranges {
            Ok(ranges) => self.proof(ranges),
            Err(reason) => refusal(reason),
        };
        if let Some(draws) = &self.draws {
            object["draws"] = json!(draws);
        }
        object
    }

    fn proof(&self, ranges: &ToleranceRanges) -> Value {
        let system = self.answer.system();
        let numbers = ranges.numbers.iter().map(|uncertain| {
            let Uncertain { number, given, within } = *uncertain;
            json!({ "name": name(system, number), "given": given, "within": within })
        });
        let joints = system.joints().iter().enumerate().map(|(k, joint)| {
            let [at_m, reaction_n] = [Some(ranges.joints_m[k]), ranges.reactions_n[k]]
                .map(|all| all.map(|all| all.map(|range| self.range(range))));
            let mut object = json!({ "name": joint.name, "at_m": at_m, "reaction_n": reaction_n });
            if let Some(draws) = &self.draws {
                object["drawn_m"] = json!(draws.joints_m[k]);
            }
            object
        });
        let bars = ranges.axial_n.iter().enumerate().map(|(k, range)| {
            let mut object = json!({ "bar": k + 1, "axial_n": self.range(*range) });
            if let Some(used) = self.utilisation(k) {
                object["utilisation"] = json!(used);
            }
            if let Some(draws) = &self.draws {
                object["drawn_n"] = json!(draws.axial_n[k]);
            }
            object
        });
        let sag = self.sag().map(|(sag, depth_m)| {
            let [from, to] = sag.ends.map(|end| &system.joints()[end].name);
            let joint = &system.joints()[sag.joint].name;
            json!({ "joint": joint, "from": from, "to": to, "depth_m": self.range(*depth_m) })
        });
        json!({
            "is_proved": true,
            "boxes": ranges.boxes,
            "free_turns": ranges.free_turns,
            "is_stable": self.is_stable(),
            "numbers": numbers.collect::<Vec<_>>(),
            "joints": joints.collect::<Vec<_>>(),
            "bars": bars.collect::<Vec<_>>(),
            "sag": sag,
        })
    }

    fn range(&self, range: Range) -> Value {
        let ([least, most], [least_reached, most_reached]) = (range.guaranteed, range.reached);
        let (most_by, most_change) = range.most_by.unzip();
        json!({
            "least": least,
            "most": most,
            "least_reached": least_reached,
            "most_reached": most_reached,
            "is_hull": range.is_hull,
            "most_by": most_by.and_then(|number| self.number_name(number)),
            "most_change": most_change,
        })
    }
}

/// Why nothing is proved, with its numbers.
fn refusal(reason: &NoRanges) -> Value {
    let mut object = json!({ "is_proved": false, "reason": reason.to_string() });
    match reason {
        NoRanges::MayChange { members } => {
            object["may_change"] = members.iter().map(|k| k + 1).collect();
        }
        NoRanges::NoBox { part: Some(part), .. } => object["part"] = json!(part),
        _ => {}
    }
    object
}

/// As `funicular solve --tolerances --json` prints it: the answer, and under `tolerances` the ranges.
impl Serialize for TolerancesAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Both<A: Serialize> {
            #[serde(flatten)]
            answer: A,
            tolerances: Value,
        }
        let answer = self.answer.json(Lists::Objects);
        Both { answer, tolerances: self.object() }.serialize(serializer)
    }
}
