//! The page of the file format against the parser: its blocks are read, its tables name the
//! parser's keys.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use model::system_file::{FORMAT, SystemFileError, SystemFileErrorKind as Kind, parse, read};
use toml::{Table, Value};

/// A key that no table has.
const UNKNOWN: &str = "no_such_key";

/// A block of the page.
struct Block {
    language: String,
    text: String,
}

impl Block {
    /// What its first lines say about itself: `# refused: ...`, `# help: ...`.
    fn says(&self, word: &str) -> Option<&str> {
        self.text.lines().find_map(|line| line.strip_prefix(&format!("# {word}: ")))
    }

    /// Whether it is a system whose bars or joints stand in other files.
    fn names_files(&self) -> bool {
        self.text.contains("_file = ")
    }
}

fn blocks() -> Vec<Block> {
    let mut found: Vec<Block> = vec![];
    let mut open = false;
    for line in FORMAT.lines() {
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(language) => {
                open = true;
                found.push(Block { language: language.to_owned(), text: String::new() });
            }
            None if open => {
                let text = &mut found.last_mut().unwrap().text;
                text.push_str(line);
                text.push('\n');
            }
            None => {}
        }
    }
    assert!(!open && found.len() > 10);
    found
}

/// The systems of the page that are not refused, as tables.
fn systems() -> Vec<Table> {
    let accepted = blocks().into_iter().filter(|block| block.says("refused").is_none());
    accepted
        .filter_map(|block| match block.language.as_str() {
            "toml" => Some(block.text.parse().unwrap()),
            "json" => Some(serde_json::from_str(&block.text).unwrap()),
            _ => None,
        })
        .collect()
}

/// A system of the page whose bars or joints stand in files, in a folder of its own.
struct Folder {
    path: PathBuf,
    of_system: bool,
    files: Vec<String>,
}

/// All of these, with what their files hold.
fn folders(test: &str) -> Vec<Folder> {
    let mut found: Vec<Folder> = vec![];
    for block in blocks() {
        if block.names_files() {
            let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("format").join(test);
            let path = path.join(found.len().to_string());
            std::fs::create_dir_all(&path).unwrap();
            std::fs::write(path.join("system.toml"), &block.text).unwrap();
            let of_system = !block.text.contains("anchors");
            found.push(Folder { path, of_system, files: vec![] });
        } else if let Some(name) = block.language.strip_prefix("csv ") {
            let folder = found.last_mut().unwrap();
            std::fs::write(folder.path.join(name), &block.text).unwrap();
            folder.files.push(name.to_owned());
        }
    }
    assert!(found.iter().map(|folder| folder.files.len()).sum::<usize>() >= 3);
    found
}

impl Folder {
    fn read(&self) -> Result<(), SystemFileError> {
        read(self.path.join("system.toml")).map(drop)
    }

    /// How the page calls the columns of a file.
    fn prefix(&self, file: &str) -> String {
        let key = format!("{}_file", file.strip_suffix(".csv").unwrap());
        let of_system = self.of_system && key == "bars_file";
        if of_system { format!("{key} of a system: ") } else { format!("{key}: ") }
    }

    /// The columns that the parser allows in a file, as the page calls them.
    fn columns(&self, file: &str) -> Vec<String> {
        let path = self.path.join(file);
        let text = std::fs::read_to_string(&path).unwrap();
        let wider: Vec<String> = text
            .lines()
            .enumerate()
            .map(|(k, line)| format!("{line},{}", if k == 0 { UNKNOWN } else { "1" }))
            .collect();
        std::fs::write(&path, wider.join("\n")).unwrap();
        let error = self.read().unwrap_err();
        std::fs::write(&path, text).unwrap();
        let Kind::UnknownKey { key, allowed, .. } = error.kind() else { panic!("{error}") };
        assert_eq!(key, UNKNOWN);
        allowed.iter().map(|column| self.prefix(file) + column).collect()
    }
}

#[test]
fn every_block_says_what_the_parser_says() {
    let (mut accepted, mut refused) = (0, 0);
    for block in blocks().iter().filter(|block| !block.names_files()) {
        if block.language.starts_with("csv ") {
            continue;
        }
        assert!(["toml", "json"].contains(&block.language.as_str()), "{}", block.language);
        match (parse(&block.text, "page"), block.says("refused")) {
            (Ok(_), None) => accepted += 1,
            (Err(error), Some(words)) => {
                assert!(error.to_string().contains(words), "{error}\nbut the page: {words}");
                if let Some(words) = block.says("help") {
                    assert!(error.help().unwrap().contains(words), "{:?}", error.help());
                }
                refused += 1;
            }
            (Ok(_), Some(words)) => panic!("not refused: {words}\n{}", block.text),
            (Err(error), None) => panic!("{error}\n{}", block.text),
        }
    }
    assert!(accepted >= 4 && refused >= 15, "{accepted} accepted, {refused} refused");
    for folder in folders("read") {
        folder.read().unwrap();
    }
}

/// What the parser allows where an unknown key stands: the path of the table, and its keys.
fn allowed(error: &SystemFileError) -> Option<(String, &'static [&'static str])> {
    let Kind::UnknownKey { key, allowed, .. } = error.kind() else { return None };
    assert_eq!(key, UNKNOWN);
    let path = error.key().unwrap().strip_suffix(UNKNOWN).unwrap();
    Some((general(path), allowed))
}

/// `bars[2].forces[1].` as `bars.forces.`, `joints.A.` as `joints.NAME.`.
fn general(path: &str) -> String {
    let mut parts: Vec<&str> =
        path.split('.').map(|part| part.split('[').next().unwrap()).collect();
    if parts[0] == "joints" && parts.len() > 2 {
        parts[1] = "NAME";
    }
    parts.join(".")
}

/// Every system with an unknown key in one of its tables, table after table.
fn with_unknown_keys(system: &Table) -> Vec<Table> {
    fn tables(value: &mut Value, nth: &mut usize) -> bool {
        match value {
            Value::Table(table) => {
                if *nth == 0 {
                    table.insert(UNKNOWN.to_owned(), Value::Integer(1));
                    return true;
                }
                *nth -= 1;
                table.iter_mut().any(|(_, value)| tables(value, nth))
            }
            Value::Array(items) => items.iter_mut().any(|value| tables(value, nth)),
            _ => false,
        }
    }
    let with = |mut nth: usize| {
        let mut value = Value::Table(system.clone());
        tables(&mut value, &mut nth).then(|| value.as_table().unwrap().clone())
    };
    (0..).map_while(with).collect()
}

/// The keys that the parser knows, as the page writes them: what it allows in each table of each
/// system of the page.
fn known() -> BTreeSet<String> {
    let mut known = BTreeSet::new();
    for system in systems().iter().flat_map(with_unknown_keys) {
        let error = parse(&toml::to_string(&system).unwrap(), "page").unwrap_err();
        match allowed(&error) {
            Some((path, keys)) => known.extend(keys.iter().map(|key| format!("{path}{key}"))),
            // Any key of `joints` is the name of a joint, and any of `factors` that of a load.
            None if error.key().is_some_and(|key| key.ends_with(".factors")) => {}
            None => assert_eq!(error.key(), Some(format!("joints.{UNKNOWN}").as_str()), "{error}"),
        }
    }
    for folder in folders("known") {
        known.extend(folder.files.iter().flat_map(|file| folder.columns(file)));
    }
    known
}

/// The keys of the tables of the page, with what their rows say.
fn described() -> BTreeMap<String, &'static str> {
    let mut found = BTreeMap::new();
    for row in FORMAT.lines().filter_map(|line| line.strip_prefix("| `")) {
        let (key, says) = row.split_once("` |").unwrap();
        assert_eq!(says.matches('|').count(), 4, "{row}");
        assert!(found.insert(key.to_owned(), says).is_none(), "{key} stands twice");
    }
    found
}

#[test]
fn the_page_names_the_keys_of_the_parser_and_no_others() {
    let described: BTreeSet<String> = described().into_keys().collect();
    assert_eq!(described, known());
}

#[test]
fn every_key_stands_in_an_example() {
    fn keys(path: &str, value: &Value, found: &mut BTreeSet<String>) {
        match value {
            Value::Table(table) => {
                for (key, value) in table {
                    let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                    found.insert(general(&path));
                    keys(&path, value, found);
                }
            }
            Value::Array(items) => items.iter().for_each(|item| keys(path, item, found)),
            _ => {}
        }
    }
    let mut found = BTreeSet::new();
    for system in systems() {
        keys("", &Value::Table(system), &mut found);
    }
    for folder in folders("examples") {
        for file in &folder.files {
            let text = std::fs::read_to_string(folder.path.join(file)).unwrap();
            let columns = text.lines().next().unwrap().split(',');
            found.extend(columns.map(|column| folder.prefix(file) + column));
        }
    }
    for key in described().into_keys() {
        assert!(found.contains(&key), "no example has {key}");
    }
}

/// One bar between an anchor and a free joint, with a key more.
fn hanging(extra: &str) -> Result<(), SystemFileError> {
    let text = format!(
        "joints = {{ A = {{ at_m = [0, 0, 0] }}, P = {{}} }}\n\
         bars = [{{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 1, {extra} }}]\n"
    );
    parse(&text, "page").map(drop)
}

#[test]
fn words_limits_and_what_is_not_modelled_are_those_of_the_parser() {
    let error = hanging(&format!("kind = \"{UNKNOWN}\"")).unwrap_err();
    let Kind::UnknownKind { allowed, .. } = error.kind() else { panic!("{error}") };
    let says = described()["bars.kind"];
    assert!(allowed.iter().all(|word| says.contains(&format!("`\"{word}\"`"))), "{says}");

    let beyond: Vec<&str> = FORMAT
        .split_once("what is not modelled: ")
        .and_then(|(_, rest)| rest.split_once("\n\n"))
        .map(|(words, _)| words.split('`').skip(1).step_by(2).collect())
        .unwrap();
    let named: BTreeSet<&str> = beyond.into_iter().collect();
    assert_eq!(named, model::system_file::NOT_MODELLED.iter().copied().collect());
    for key in named {
        let error = hanging(&format!("{key} = 1")).unwrap_err();
        assert!(matches!(error.kind(), Kind::OutOfScope(_)), "{error}");
    }

    let millions = model::system_file::MAX_BARS / 1_000_000;
    assert!(FORMAT.contains(&format!("{millions} million bars in all")));
    let mebibytes = model::system_file::MAX_FILE_BYTES >> 20;
    assert!(FORMAT.contains(&format!("{mebibytes} MiB at most")));
    assert!(described()["gravity_m_s2"].contains(&model::STANDARD_GRAVITY_M_S2.to_string()));
}
