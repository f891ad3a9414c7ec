//! A system that is changed while it is looked at: for every change of its file a shape and a page.

mod change;

use energy::net::{Settings, minimise, minimise_near};
use model::system::{Joint, Member, System};
use model::{Bar, Vector};
use numerics::vector::norm;
use serde::{Deserialize, Serialize};
use serde_json::Value;

pub use change::Change;

use crate::error::Error;
use crate::moving_page::Data;
use crate::page::Page;
use crate::problem::Problem;
use crate::shown::{Shape, Shown, Start};

/// Members of a system that is shown while it changes, each span of a rope counted: of more an answer takes longer than
/// a hand waits. A rope has so many spans, which all of its joints share.
const MOST_MEMBERS: usize = 2000;
const MOST_SPANS: usize = 100;

/// A question of the page: a system file, what is done to it, and how much is wanted.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ask {
    /// The system file, TOML.
    pub text: String,
    /// What is changed in it first.
    #[serde(default)]
    pub change: Option<Change>,
    /// A free joint that is held by hand: the file stays as it is, and the answer is quick.
    #[serde(default)]
    pub held: Option<Held>,
    /// The shape before, a place for every joint, m: the equilibrium next to it is wanted.
    #[serde(default)]
    pub near_m: Option<Vec<Vector>>,
    /// Places and forces of one equilibrium alone, without modes, load cases and a census.
    #[serde(default)]
    pub quick: bool,
}

/// A joint that is held by hand.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Held {
    /// Its name.
    pub joint: String,
    /// Where, m.
    pub at_m: Vector,
}

/// What the page is to show.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Live {
    /// The system file, changed.
    pub text: String,
    /// What the script of the page draws; `None` where there is no equilibrium.
    pub data: Option<Value>,
    /// The answer in words and tables; empty if it was asked for quickly.
    pub words: String,
    /// Why there is none.
    pub error: Option<String>,
}

impl Ask {
    /// Of a file.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// Change the file, solve it, and say what is to be shown. What is wrong stands in
    /// [`Live::error`].
    ///
    /// ```
    /// use funicular::live::Ask;
    /// let ask = r#"{ "text": "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\nbars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0 }]",
    ///     "change": { "joint": { "name": "A", "at_m": [0, 0, 2] } }, "quick": true }"#;
    /// let live = serde_json::from_str::<Ask>(ask)?.run();
    /// assert!(live.text.contains("A = { at_m = [0.0, 0.0, 2.0] }"));
    /// let data = live.data.expect("it hangs");
    /// assert_eq!((&data["reference"][2], &data["shapes"][0]["x"][5]), (&2.0.into(), &(-1.0).into()));
    /// # Ok::<(), serde_json::Error>(())
    /// ```
    pub fn run(&self) -> Live {
        let changed = self.change.as_ref().map(|change| change.of(&self.text));
        let (text, found) = match changed {
            Some(Err(why)) => (self.text.clone(), Err(why)),
            Some(Ok(text)) => {
                let found = self.shown(&text);
                (text, found)
            }
            None => (self.text.clone(), self.shown(&self.text)),
        };
        let (data, words, error) = match found {
            Ok((data, words)) => (Some(data), words, None),
            Err(why) => (None, String::new(), Some(why)),
        };
        Live { text, data, words, error }
    }

    /// The page that begins with this. Its script asks by POST at `ask` and `page` beside it; `embedded` in
    /// another page, it asks that one by messages `{ funicular: number, path, question }`, and takes
    /// `{ funicular: number, text }` or `error` for an answer.
    pub fn page(&self, embedded: bool) -> String {
        let Live { text, data, words, error } = self.run();
        let data = data.unwrap_or_else(|| Value::Object(serde_json::Map::new()));
        let (text, words, error) = (&text, &words, error.as_deref());
        Start { text, words, error, embedded, data: &data }.html()
    }

    /// Answer what the script of the page asks at a path: `ask` or `page`. `None` at any other.
    ///
    /// # Errors
    /// Why the question is none, or its system has no page.
    pub fn answer(path: &str, question: &[u8]) -> Option<Result<String, String>> {
        let asked = || serde_json::from_slice::<Self>(question).map_err(|error| error.to_string());
        let of = |ask: &Self| serde_json::to_string(&ask.run()).map_err(|error| error.to_string());
        match path {
            "ask" => Some(asked().and_then(|ask| of(&ask))),
            "page" => {
                Some(asked().and_then(|ask| ask.keep().map_err(|error: Error| error.to_string())))
            }
            _ => None,
        }
    }

    /// A page of the system as it is, that needs nothing else, as [`Page`] makes it.
    fn keep(&self) -> Result<String, Error> {
        Ok(Page::new().run(&Problem::parse(&self.text, NAME)?)?.html().to_owned())
    }

    fn shown(&self, text: &str) -> Result<(Value, String), String> {
        let said = |error: Error| error.to_string();
        let problem = Problem::parse(text, NAME).map_err(said)?;
        let system = problem.system();
        let spans = system.members().iter().map(|member| member.spans().count());
        let (members, most) = (spans.clone().sum::<usize>(), spans.max().unwrap_or(0));
        if members > MOST_MEMBERS || most > MOST_SPANS {
            return Err(format!(
                "{members} members, {most} spans in one: up to {MOST_MEMBERS} and {MOST_SPANS} are shown while they change; \
                 `funicular page` shows more"
            ));
        }
        let (shown, words) = if self.quick || self.held.is_some() {
            (self.moved(&system)?, String::new())
        } else {
            let shown = Page::new().of(&problem).map_err(said)?;
            let words = shown.words.clone();
            (shown, words)
        };
        let data = serde_json::to_value(Data::new(&system, &shown));
        Ok((data.map_err(|error| error.to_string())?, words))
    }
}

/// What the file is called in errors.
const NAME: &str = "the file";

impl Ask {
    /// The shape alone.
    fn moved(&self, system: &System) -> Result<Shown, String> {
        // The other solver, what is counted, checks and proofs follow when the hand rests.
        let settings = Settings { dense: 0, ..Settings::default() };
        let held = self.held.as_ref().map(|held| held.of(system)).transpose()?;
        let all = held.as_ref().unwrap_or(system);
        all.refusal().map_err(|error| error.to_string())?;
        let found = match &self.near_m {
            Some(near_m) => {
                let hand = self.held.iter().map(|held| held.at_m);
                let near_m: Vec<_> = near_m.iter().copied().chain(hand).collect();
                minimise_near(all, &near_m, &settings)
            }
            None => match all.drawing() {
                Some(drawing_m) => minimise_near(all, &drawing_m, &settings),
                None => minimise(all, &settings),
            },
        };
        let mut first = found.map_err(|error| error.to_string())?.equilibrium;
        // Without the hand.
        first.joints_m.truncate(system.joints().len());
        first.axial_n.truncate(system.members().len());
        let shape = Shape {
            axial: Some(first.axial_n),
            ..Shape::bare(system, "Equilibria", "moved", first.joints_m.into_iter())
        };
        Ok(Shown { shapes: vec![shape], ..Shown::default() })
    }
}

impl Held {
    /// The system with a spring from the joint to the hand, so stiff that all of the weight pulls it out by a
    /// thousandth of all lengths: the hand may be where the joint cannot go.
    fn of(&self, system: &System) -> Result<System, String> {
        const PART: f64 = 1e-3;
        let joint =
            system.joint(&self.joint).ok_or_else(|| format!("no joint {:?}", self.joint))?;
        let said = |error: &dyn std::fmt::Display| error.to_string();
        let mut joints = system.joints().to_vec();
        let mut members = system.members().to_vec();
        let longest = joints.iter().map(|joint| joint.name.text().len()).max().unwrap_or(0);
        joints.push(Joint::anchor("h".repeat(longest + 1), self.at_m));
        let length_m = PART * system.total_length_m();
        let forces_n = system.joints().iter().map(|joint| norm(joint.force_n));
        let weight_n = system.total_mass_kg() * system.gravity_m_s2() + forces_n.sum::<f64>();
        let weight_n = if weight_n > 0.0 { weight_n } else { 1.0 };
        let body = Bar::homogeneous(length_m, 0.0).map_err(|error| said(&error))?;
        let spring = Member::cable(joints.len() - 1, joint, body).with_stiffness(weight_n);
        members.push(spring);
        let held = System::new(system.name(), system.gravity_m_s2(), joints, members);
        let held = held.and_then(|held| held.with_floor(system.floor_m()));
        held.map_err(|error| said(&error))
    }
}
