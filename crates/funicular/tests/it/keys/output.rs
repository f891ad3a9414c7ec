//! The output of a command as paths with their values, and what a test has asserted of it.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::path::Path;

use serde_json::Value;

use super::table;

use crate::run::run;

/// How closely a number is asserted, in units of the number or of one: some rounding errors.
const CLOSE: f64 = 1e-12;

/// Objects whose keys are names or numbers of things; these stand as `*` in a path.
const BY_NAME: [&str; 3] = ["reactions_n", "joints_m", "iterations"];

/// An output by the paths of its values: `equilibria[].axial_n[]`, arrays without their places.
pub struct Output {
    kind: String,
    test: String,
    values: BTreeMap<String, Vec<Value>>,
    asserted: BTreeSet<String>,
}

impl Output {
    /// Of text in JSON, as the named test looks at it; without a name it may look at a part.
    pub fn json(kind: &str, test: &str, text: &str) -> Self {
        Self::with(kind, test, [serde_json::from_str(text).unwrap()])
    }

    /// Of what a command says as JSON in a folder, and ends with this code.
    pub fn ended(code: i32, test: &str, folder: impl AsRef<Path>, command: &str) -> Self {
        let words: Vec<_> = command.split(' ').chain(["--json"]).collect();
        let (found, text, said) = run(folder, &words);
        assert_eq!(found, Some(code), "{command}: {text}{said}");
        Self::json(words[0], test, &text)
    }

    /// As another kind than the name of its command.
    pub fn of(mut self, kind: &str) -> Self {
        kind.clone_into(&mut self.kind);
        self
    }

    /// Of lines of JSON.
    pub fn lines(kind: &str, test: &str, text: &str) -> Self {
        Self::with(kind, test, text.lines().map(|line| serde_json::from_str(line).unwrap()))
    }

    /// Of a file of columns.
    pub fn csv(kind: &str, test: &str, text: &str) -> Self {
        let mut lines = text.lines().map(|line| line.split(','));
        let head: Vec<String> = lines.next().unwrap().map(numbered).collect();
        let mut output = Self::with(kind, test, []);
        for name in &head {
            output.values.entry(name.clone()).or_default();
        }
        for line in lines {
            let cells: Vec<&str> = line.collect();
            assert_eq!(cells.len(), head.len(), "{kind}");
            for (name, cell) in head.iter().zip(cells) {
                let value = serde_json::from_str(cell).unwrap_or_else(|_| cell.into());
                output.values.get_mut(name).unwrap().push(value);
            }
        }
        output
    }

    /// Of a file of columns that was written.
    pub fn file(kind: &str, test: &str, path: impl AsRef<Path>) -> Self {
        Self::csv(kind, test, &std::fs::read_to_string(path).unwrap())
    }

    fn with(kind: &str, test: &str, objects: impl IntoIterator<Item = Value>) -> Self {
        let mut values = BTreeMap::new();
        objects.into_iter().for_each(|object| collect(&object, String::new(), &mut values));
        let [kind, test] = [kind, test].map(str::to_owned);
        Self { kind, test, values, asserted: BTreeSet::new() }
    }

    fn found(&mut self, path: &str) -> Vec<Value> {
        self.asserted.insert(path.to_owned());
        let found = self.values.get(path);
        found.unwrap_or_else(|| panic!("{}: there is no {path}", self.kind)).clone()
    }

    /// Assert the values at a path, in their order.
    pub fn is(&mut self, path: &str, wanted: impl Into<Value>) {
        self.near(path, CLOSE, wanted);
    }

    /// Assert the values at several paths, an object of these.
    pub fn are(&mut self, wanted: Value) {
        self.are_at(str::to_owned, wanted);
    }

    /// The same by what the paths are called for short.
    pub fn are_at(&mut self, at: impl Fn(&str) -> String, wanted: Value) {
        by_path(at, wanted).for_each(|(path, wanted)| self.is(&path, wanted));
    }

    /// The same of numbers that are less close.
    pub fn near(&mut self, path: &str, close: f64, wanted: impl Into<Value>) {
        let (found, wanted) = (self.found(path), leaves(&wanted.into()));
        assert_eq!(found.len(), wanted.len(), "{path}: {found:?} for {wanted:?}");
        self.compare(path, close, &found, &wanted);
    }

    /// Assert the values at a path, which repeat themselves.
    pub fn each(&mut self, path: &str, wanted: impl Into<Value>) {
        let (found, wanted) = (self.found(path), leaves(&wanted.into()));
        assert!(!found.is_empty() && found.len().is_multiple_of(wanted.len()), "{path}: {found:?}");
        let all: Vec<Value> = wanted.iter().cycle().take(found.len()).cloned().collect();
        self.compare(path, CLOSE, &found, &all);
    }

    fn compare(&self, path: &str, close: f64, found: &[Value], wanted: &[Value]) {
        for (a, b) in found.iter().zip(wanted) {
            let same = match (a.as_f64(), b.as_f64()) {
                (Some(a), Some(b)) => (a - b).abs() <= close * b.abs().max(1.0),
                _ => a == b,
            };
            assert!(same, "{} {path}: {a} for {b}\n{found:?}\n{wanted:?}", self.kind);
        }
    }

    /// Assert that all numbers at a path lie in a range: what is but bounded by theory.
    pub fn within(&mut self, path: &str, range: RangeInclusive<f64>) {
        let found = self.found(path);
        assert!(!found.is_empty(), "{path}");
        for value in found {
            assert!(range.contains(&value.as_f64().unwrap()), "{path}: {value} in {range:?}");
        }
    }

    /// Assert that the intervals at a path hold these numbers, which are known but for their own
    /// rounding, and are narrow.
    pub fn encloses(&mut self, path: &str, wanted: impl Into<Value>) {
        let (found, wanted) = (self.numbers(path), leaves(&wanted.into()));
        assert_eq!(found.len(), 2 * wanted.len(), "{path}: {found:?}");
        for (ends, wanted) in found.chunks(2).zip(&wanted) {
            let wanted = wanted.as_f64().unwrap();
            let rounding = 2.0 * f64::EPSILON * wanted.abs().max(f64::MIN_POSITIVE);
            let holds = ends[0] <= wanted + rounding && wanted - rounding <= ends[1];
            let width = ends[1] - ends[0];
            let narrow = (0.0..=CLOSE * wanted.abs().max(1.0)).contains(&width);
            assert!(holds && narrow, "{path}: {ends:?} for {wanted}");
        }
    }

    /// Assert that all texts at a path contain these words, in turn: one, or several in a list.
    pub fn says(&mut self, path: &str, wanted: Value) {
        let Value::Array(wanted) = wanted else { panic!("{path} says {wanted}") };
        let found = self.found(path);
        assert!(!found.is_empty() && found.len().is_multiple_of(wanted.len()), "{path}: {found:?}");
        for (value, words) in found.iter().zip(wanted.iter().cycle()) {
            for word in leaves(words) {
                let is_said = value.as_str().unwrap().contains(word.as_str().unwrap());
                assert!(is_said, "{path}: {value} for {word}");
            }
        }
    }

    /// Assert a line of the text: how the values at a path are, and what.
    fn line(&mut self, [path, how, what]: &[String; 3]) {
        let value = |text: &str| -> Value {
            serde_json::from_str(text)
                .unwrap_or_else(|error| panic!("{path} {how} {what}: {error}"))
        };
        let number = |text: &str| text.parse().unwrap();
        match how.as_str() {
            table::IN_RUST => {}
            "=" => self.is(path, value(what)),
            "each" => self.each(path, value(what)),
            "near" => {
                let (close, what) = what.split_once(' ').unwrap();
                self.near(path, number(close), value(what));
            }
            "in" => {
                let (low, high) = what.split_once("..").unwrap();
                self.within(path, number(low)..=number(high));
            }
            "encloses" => self.encloses(path, value(what)),
            "says" => self.says(path, value(what)),
            _ => panic!("{path} {how} {what}"),
        }
    }

    /// The numbers at a path, which the test asserts itself.
    pub fn numbers(&mut self, path: &str) -> Vec<f64> {
        self.found(path).iter().map(|value| value.as_f64().unwrap()).collect()
    }

    /// The values at a path, which the test asserts itself.
    pub fn values(&mut self, path: &str) -> Vec<Value> {
        self.found(path)
    }

    /// The paths that no block has.
    pub fn unlisted(&self) -> Vec<String> {
        let listed = table::of(&self.kind);
        self.values.keys().filter(|path| !listed.contains(path.as_str())).cloned().collect()
    }
}

impl Drop for Output {
    /// Assert what is written for the named test, that it asserts the rest, and that there is nothing besides.
    fn drop(&mut self) {
        if self.test.is_empty() || std::thread::panicking() {
            return;
        }
        let lines = table::blocks().iter().find(|b| b.kind == self.kind && b.test == self.test);
        let lines = lines.map_or(&[][..], |block| &block.lines);
        let of_text = lines.iter().filter(|[_, how, _]| how != table::IN_RUST);
        of_text.for_each(|line| self.line(line));
        let named: BTreeSet<String> = lines.iter().map(|[path, ..]| path.clone()).collect();
        let list = |paths: Vec<&str>| paths.join("\n");
        let more = list(self.asserted.difference(&named).map(String::as_str).collect());
        let less = list(named.difference(&self.asserted).map(String::as_str).collect());
        assert!(
            more.is_empty() && less.is_empty(),
            "[{}] {}\nnot in the text:\n{more}\nin the text, and not asserted:\n{less}",
            self.kind,
            self.test
        );
        let unlisted = self.unlisted();
        assert!(unlisted.is_empty(), "[{}]\nasserted nowhere:\n{}", self.kind, unlisted.join("\n"));
    }
}

fn by_path(at: impl Fn(&str) -> String, wanted: Value) -> impl Iterator<Item = (String, Value)> {
    let Value::Object(wanted) = wanted else { panic!("{wanted} for paths") };
    wanted.into_iter().map(move |(key, wanted)| (at(&key), wanted))
}

/// A column's name with `#` for the numbers of joints, bars and anchors in it, and for the name of a
/// joint.
fn numbered(name: &str) -> String {
    let mut parts: Vec<String> = name.split('_').map(str::to_owned).collect();
    if parts[0] == "joint" && parts.len() > 2 {
        parts[0].push('#');
        parts.remove(1);
    }
    for part in &mut parts {
        let word = part.trim_end_matches(|c: char| c.is_ascii_digit());
        let alone = word.is_empty() || ["joint", "bar"].contains(&word);
        if alone && word.len() < part.len() {
            *part = format!("{word}#");
        }
    }
    parts.join("_")
}

fn collect(value: &Value, path: String, values: &mut BTreeMap<String, Vec<Value>>) {
    match value {
        Value::Object(map) => {
            let parent = path.rsplit('.').next().unwrap();
            let named = BY_NAME.contains(&parent) && !map.contains_key("max");
            for (key, item) in map {
                let number = key.parse::<i64>().is_ok();
                let key = if named || number { "*" } else { key };
                let dot = if path.is_empty() { "" } else { "." };
                collect(item, format!("{path}{dot}{key}"), values);
            }
        }
        Value::Array(items) if items.is_empty() => {
            values.entry(path + "[]").or_default();
        }
        Value::Array(items) => {
            for item in items {
                collect(item, format!("{path}[]"), values);
            }
        }
        leaf => values.entry(path).or_default().push(leaf.clone()),
    }
}

fn leaves(value: &Value) -> Vec<Value> {
    match value {
        Value::Array(items) => items.iter().flat_map(leaves).collect(),
        leaf => vec![leaf.clone()],
    }
}
