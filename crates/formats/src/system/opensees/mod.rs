//! OpenSees decks of trusses: Tcl with `node`, `fix`, `element truss`, `uniaxialMaterial Elastic`, `mass` and loads.
//!
//! A truss is an elastic bar of EA, as long as its nodes are apart; nothing weighs, as in OpenSees, where loads alone act:
//! masses are held up by forces of their weights, so that they only swing. In a deck of two dimensions Y is up. Numbers
//! are N, m and kg, since a deck has no units. Loads on nodes that are held are noted and are not in the reactions. Loads
//! act by the factors of their series at the time 1. The linear `truss` is read as the `corotTruss`, whose balance
//! is that of the displaced shape.
//!
//! Analysis and output are skipped; any other command, material or element is named and refused.
//!
//! # References
//!
//! OpenSees, <https://opensees.github.io/OpenSeesDocumentation>.

mod expr;
mod tcl;

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use model::budget::{BYTES_PER_MEMBER, Budget};
use model::system::{Joint, Member, System};
use model::{Bar, STANDARD_GRAVITY_M_S2, Vector};
use numerics::vector::{minus, norm};

use crate::error::{At, Result, Wrong, shortened};
use crate::system::drawing::support;
use crate::system::{ForeignSystem, among};
use tcl::{Command, Script, Variables};

/// Commands of analysis and output, which say nothing of the structure.
const SKIPPED: &str = "wipe wipeAnalysis constraints numberer system test algorithm integrator \
    analysis analyze recorder puts print loadConst eigen reactions setTime getTime record logFile \
    exit initialize rayleigh flush close start stop printA printB";

/// A node, m, kg, N.
struct Node {
    name: String,
    at_m: Vector,
    free: [bool; 3],
    mass_kg: f64,
    force_n: Vector,
}

/// What a deck has said so far.
#[derive(Default)]
struct Deck<'a> {
    file: &'a str,
    variables: Variables,
    /// Directions of nodes.
    dimensions: usize,
    nodes: Vec<Node>,
    numbers: HashMap<String, usize>,
    /// Young's moduli, Pa.
    materials: HashMap<String, f64>,
    /// Factors of time series at the time 1.
    series: HashMap<String, f64>,
    members: Vec<Member>,
    skipped: BTreeSet<String>,
    linear: bool,
    budget: Budget,
}

/// Read a deck.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the part that is wrong, not understood, or out of scope.
pub fn parse_opensees(text: &str, file: &str) -> Result<ForeignSystem> {
    let mut deck = Deck { file, ..Deck::default() };
    let mut script = Script::new(file, text.strip_prefix('\u{feff}').unwrap_or(text), 1);
    while let Some(command) = script.next(&mut deck.variables)? {
        deck.read(&Words { file, command: &command })?;
    }
    deck.system()
}

/// The words of a command.
struct Words<'a> {
    file: &'a str,
    command: &'a Command,
}

impl<'a> Words<'a> {
    fn at(&self) -> At<'a> {
        At::line(self.file, self.command.line)
    }

    fn get(&self, k: usize) -> Result<&'a str> {
        let words = &self.command.words;
        let wrong = Wrong::Count { wanted: k + 1, found: words.len() };
        words.get(k).map(String::as_str).ok_or_else(|| self.at().error(wrong))
    }

    fn number(&self, k: usize, what: &str) -> Result<f64> {
        self.at().number(what, self.get(k)?)
    }

    fn positive(&self, k: usize, what: &str) -> Result<f64> {
        self.at().positive(what, self.get(k)?)
    }

    /// The number behind an option, from the word `first` on.
    fn option(&self, first: usize, name: &str) -> Result<Option<f64>> {
        let place = self.command.words.iter().skip(first).position(|word| word == name);
        place.map(|k| self.number(first + k + 1, name)).transpose()
    }

    /// Refuse options other than these, each with a number.
    fn options(&self, first: usize, known: &[&str]) -> Result<()> {
        let words = self.command.words.iter().skip(first).step_by(2);
        match words.into_iter().find(|word| !known.contains(&word.as_str())) {
            Some(word) => Err(self.at().unknown(format!("the word {:?}", shortened(word)))),
            None => Ok(()),
        }
    }
}

impl Deck<'_> {
    fn read(&mut self, words: &Words<'_>) -> Result<()> {
        let name = words.get(0)?;
        if among(SKIPPED, name) {
            self.skipped.insert(name.to_owned());
            return Ok(());
        }
        if let Some(executed) = &words.command.executed {
            return Err(words.at().unknown(format!("the command [{executed}] within another")));
        }
        match name {
            "model" => self.model(words),
            "node" => self.node(words),
            "fix" => self.fix(words),
            "mass" => self.mass(words, words.get(1)?, 2),
            "uniaxialMaterial" => self.material(words),
            "element" => self.element(words),
            "timeSeries" => self.series(words),
            "pattern" => self.pattern(words),
            _ => Err(words.at().unknown(format!("the command {:?}", shortened(name)))),
        }
    }

    fn model(&mut self, words: &Words<'_>) -> Result<()> {
        words.options(2, &["-ndm", "-ndf"])?;
        let dimensions = words.option(2, "-ndm")?;
        let is = |known: f64| dimensions.is_some_and(|n| (n - known).abs() <= 0.0);
        self.dimensions = if is(2.0) { 2 } else { 3 * usize::from(is(3.0)) };
        if self.dimensions == 0 {
            return Err(words.at().unknown("a model that has not -ndm 2 or 3"));
        }
        Ok(())
    }

    /// As many numbers as there are dimensions, in the world: of two the second is up.
    fn vector(&self, words: &Words<'_>, first: usize, what: &str) -> Result<Vector> {
        let one = |k: usize| words.number(first + k, what);
        match self.dimensions {
            0 => Err(words.at().missing("model before it")),
            2 => Ok([one(0)?, 0.0, one(1)?]),
            _ => Ok([one(0)?, one(1)?, one(2)?]),
        }
    }

    /// The number of a node.
    fn known(&self, words: &Words<'_>, tag: &str) -> Result<usize> {
        let number = self.numbers.get(tag).copied();
        number.ok_or_else(|| words.at().missing(format!("node {:?}", shortened(tag))))
    }

    fn node(&mut self, words: &Words<'_>) -> Result<()> {
        let room = self.budget.fits_members(self.nodes.len() + 1, BYTES_PER_MEMBER);
        room.map_err(|error| words.at().memory(error))?;
        let (name, at_m) = (words.get(1)?.to_owned(), self.vector(words, 2, "a coordinate")?);
        if self.numbers.insert(name.clone(), self.nodes.len()).is_some() {
            return Err(words.at().repeated(format!("node {name}")));
        }
        let free = [true, self.dimensions == 3, true];
        self.nodes.push(Node { name, at_m, free, mass_kg: 0.0, force_n: [0.0; 3] });
        match words.command.words.get(2 + self.dimensions).map(String::as_str) {
            None => Ok(()),
            Some("-mass") => self.mass(words, words.get(1)?, 3 + self.dimensions),
            Some(word) => Err(words.at().unknown(format!("the word {:?}", shortened(word)))),
        }
    }

    fn fix(&mut self, words: &Words<'_>) -> Result<()> {
        let node = self.known(words, words.get(1)?)?;
        let fixed = self.vector(words, 2, "what is fixed")?;
        for (free, fixed) in self.nodes[node].free.iter_mut().zip(fixed) {
            *free &= fixed.abs() <= 0.0;
        }
        Ok(())
    }

    fn mass(&mut self, words: &Words<'_>, tag: &str, first: usize) -> Result<()> {
        let node = self.known(words, tag)?;
        let masses = self.vector(words, first, "a mass")?;
        let mass_kg = masses[0];
        let same = |(mass, free): (f64, bool)| !free || (mass - mass_kg).abs() <= 0.0;
        let free = [true, self.dimensions == 3, true];
        if mass_kg < 0.0 || !masses.into_iter().zip(free).all(same) {
            let what = "a mass that differs by direction, or a negative one,";
            return Err(words.at().out_of_scope(what));
        }
        self.nodes[node].mass_kg = mass_kg;
        Ok(())
    }

    fn material(&mut self, words: &Words<'_>) -> Result<()> {
        let kind = words.get(1)?;
        // What follows is damping, and another modulus in compression.
        if kind != "Elastic" || words.command.words.len() > 5 {
            let what = format!("the material {:?}", shortened(&words.command.words[1..].join(" ")));
            let error = words.at().unknown(what);
            return Err(error.with_help("known is: uniaxialMaterial Elastic TAG E"));
        }
        let (tag, young_pa) = (words.get(2)?.to_owned(), words.positive(3, "E")?);
        if self.materials.insert(tag.clone(), young_pa).is_some() {
            return Err(words.at().repeated(format!("material {tag}")));
        }
        Ok(())
    }

    fn element(&mut self, words: &Words<'_>) -> Result<()> {
        let kind = words.get(1)?.to_lowercase();
        if kind != "truss" && kind != "corottruss" {
            return Err(words.at().unknown(format!("the element {:?}", shortened(words.get(1)?))));
        }
        let room = self.budget.fits_members(self.members.len() + 1, BYTES_PER_MEMBER);
        room.map_err(|error| words.at().memory(error))?;
        words.options(7, &["-rho", "-cMass", "-doRayleigh"])?;
        let [a, b] = [self.known(words, words.get(3)?)?, self.known(words, words.get(4)?)?];
        let (area_m2, material) = (words.positive(5, "A")?, words.get(6)?);
        let Some(young_pa) = self.materials.get(material) else {
            return Err(words.at().missing(format!("material {:?}", shortened(material))));
        };
        if words.option(7, "-cMass")?.is_some_and(|full| full.abs() > 0.0) {
            return Err(words.at().out_of_scope("a mass that is not at the nodes (-cMass)"));
        }
        let length_m = norm(minus(self.nodes[b].at_m, self.nodes[a].at_m));
        let body = Bar::homogeneous(length_m, 0.0).map_err(|error| words.at().no_system(error))?;
        self.members.push(Member::bar(a, b, body).with_stiffness(young_pa * area_m2));
        let half_kg = 0.5 * words.option(7, "-rho")?.unwrap_or_default() * length_m;
        for node in [a, b] {
            self.nodes[node].mass_kg += half_kg;
        }
        self.linear |= kind == "truss";
        Ok(())
    }

    fn series(&mut self, words: &Words<'_>) -> Result<()> {
        let kind = words.get(1)?;
        if kind != "Linear" && kind != "Constant" {
            return Err(words.at().unknown(format!("the time series {:?}", shortened(kind))));
        }
        words.options(3, &["-factor"])?;
        let factor = words.option(3, "-factor")?.unwrap_or(1.0);
        self.series.insert(words.get(2)?.to_owned(), factor);
        Ok(())
    }

    /// Loads within braces.
    fn pattern(&mut self, words: &Words<'_>) -> Result<()> {
        let all = &words.command.words;
        let (kind, series) = (words.get(1)?, words.get(3)?);
        let (Some(line), Some(body)) = (words.command.body, all.last()) else {
            return Err(words.at().missing("body of the pattern, in braces"));
        };
        if kind != "Plain" {
            return Err(words.at().unknown(format!("the pattern {:?}", shortened(kind))));
        }
        let factor = match series {
            "Linear" | "Constant" => 1.0,
            tag => *self
                .series
                .get(tag)
                .ok_or_else(|| words.at().missing(format!("time series {:?}", shortened(tag))))?,
        };
        let factor = match &all[4..all.len() - 1] {
            [] => factor,
            [fact, by] if fact == "-fact" || fact == "-factor" => {
                factor * At::line(self.file, line).number(fact, by)?
            }
            [word, ..] => {
                return Err(words.at().unknown(format!("the word {:?}", shortened(word))));
            }
        };
        let mut script = Script::new(self.file, body, line);
        while let Some(command) = script.next(&mut self.variables)? {
            let words = Words { file: self.file, command: &command };
            if words.get(0)? != "load" || command.executed.is_some() {
                let what = format!("the load {:?}", shortened(&command.words.join(" ")));
                return Err(words.at().unknown(what));
            }
            let node = self.known(&words, words.get(1)?)?;
            let force_n = self.vector(&words, 2, "a load")?;
            for k in 2 + self.dimensions..command.words.len() {
                if words.number(k, "a moment")?.abs() > 0.0 {
                    return Err(words.at().out_of_scope("a moment"));
                }
            }
            for (sum, force_n) in self.nodes[node].force_n.iter_mut().zip(force_n) {
                *sum += factor * force_n;
            }
        }
        Ok(())
    }

    fn system(self) -> Result<ForeignSystem> {
        let missing = |what: &str| Err(At::file(self.file).missing(what.to_owned()));
        if self.members.is_empty() {
            return missing("element");
        }
        let mut notes = vec![
            "units: N, m and kg as written; a deck has none of its own".to_owned(),
            "nothing weighs: a force of its weight holds up each mass, and loads act by their factors at the time 1"
                .to_owned(),
        ];
        if self.dimensions == 2 {
            let note = "of two dimensions y is up, and nodes stay in their plane: (x, y) is (x, 0, y), of answers too";
            notes.push(note.to_owned());
        }
        if self.linear {
            let note = "truss is linear in OpenSees; here balance is in the displaced shape, as that of corotTruss";
            notes.push(note.to_owned());
        }
        if !self.skipped.is_empty() {
            let skipped: Vec<_> = self.skipped.iter().map(String::as_str).collect();
            notes.push(format!("not read: {}", skipped.join(", ")));
        }
        let held = self.nodes.iter().filter(|node| support(node.at_m, node.free).is_fixed());
        notes.extend(super::held_loads(held.map(|node| node.force_n)));
        let joints = self.nodes.into_iter().map(joint).collect();
        let name = Path::new(self.file).file_stem().unwrap_or_default().to_string_lossy();
        let system = System::new(name, STANDARD_GRAVITY_M_S2, joints, self.members);
        let system = system.map_err(|error| At::file(self.file).no_system(error))?;
        Ok(ForeignSystem { system, notes, floor_m: None })
    }
}

/// The joint of a node: what acts on an anchor goes into the ground.
fn joint(node: Node) -> Joint {
    let Node { name, at_m, free, mass_kg, mut force_n } = node;
    let support = support(at_m, free);
    if support.is_fixed() {
        return Joint::anchor(name, at_m);
    }
    force_n[2] += mass_kg * STANDARD_GRAVITY_M_S2;
    Joint::free(name).held_by(support).with_mass(mass_kg).with_force(force_n).near(at_m)
}
