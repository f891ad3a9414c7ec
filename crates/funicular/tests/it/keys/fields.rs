//! Whatever can be written as JSON stands in the list: the fields and the variants of all types
//! that derive `Serialize`, as the sources have them. So a key that no run here brings forth is
//! told as well.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::table;

/// Types that no command prints as JSON, and why.
const NOT_PRINTED: [(&str, &str); 18] = [
    ("funicular::Found", "either is printed by its keys alone"),
    ("census::Face", "asserted as `chart`: some faces, by one enum"),
    ("funicular::Chart", "for the script of a page"),
    ("funicular::Curve", "for the script of a page"),
    ("funicular::Data", "for the script of a page"),
    ("funicular::Live", "the answer of `serve` to the script of its page"),
    ("funicular::ModeShown", "for the script of a page"),
    ("funicular::Shape", "for the script of a page"),
    ("funicular::Shown", "for the script of a page"),
    ("funicular::Start", "for the script of a page"),
    ("funicular::Topology", "for the script of a page"),
    ("funicular::Track", "for the script of a page"),
    ("report::Kind", "data of the figure on the report's page, looked at in a browser"),
    ("report::State", "data of the figure on the report's page, looked at in a browser"),
    ("report::View", "data of the figure on the report's page, looked at in a browser"),
    ("sweep::PartList", "the list of a part of an unfinished sweep"),
    ("sweep::Axis", "a manifest names its source `grid`"),
    ("validate::SystemFailure", "printed as the refusal itself"),
];

/// A name that JSON may have, with the type that it is of.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Named {
    of: String,
    name: String,
}

/// What the types of a file have.
#[derive(Default)]
struct Names {
    fields: BTreeSet<Named>,
    variants: BTreeSet<Named>,
}

/// The words of `#[serde(...)]` and `#[derive(...)]` before an item, a field or a variant.
fn words(attributes: &[syn::Attribute], of: &str) -> String {
    let lists = attributes.iter().filter(|attribute| attribute.path().is_ident(of));
    let texts = lists.filter_map(|list| list.meta.require_list().ok());
    texts.map(|list| list.tokens.to_string() + ",").collect()
}

fn renamed(serde: &str) -> Option<String> {
    let (_, rest) = serde.split_once("rename = \"")?;
    rest.split_once('"').map(|(name, _)| name.to_owned())
}

fn snake_case(name: &str) -> String {
    let mut text = String::new();
    for (place, letter) in name.char_indices() {
        if letter.is_uppercase() && place > 0 {
            text.push('_');
        }
        text.extend(letter.to_lowercase());
    }
    text
}

impl Names {
    fn add_fields(&mut self, of: &str, fields: &syn::Fields) {
        for field in fields {
            let serde = words(&field.attrs, "serde");
            let left_out = serde.split(',').any(|word| ["skip", "flatten"].contains(&word.trim()));
            if let (Some(name), false) = (&field.ident, left_out) {
                let name = renamed(&serde).unwrap_or_else(|| name.to_string());
                self.fields.insert(Named { of: of.to_owned(), name });
            }
        }
    }

    fn add(&mut self, name_of_crate: &str, item: &syn::Item) {
        let (attributes, name) = match item {
            syn::Item::Struct(item) => (&item.attrs, &item.ident),
            syn::Item::Enum(item) => (&item.attrs, &item.ident),
            syn::Item::Mod(module) => {
                let items = module.content.iter().flat_map(|(_, items)| items);
                return items.for_each(|item| self.add(name_of_crate, item));
            }
            _ => return,
        };
        if !words(attributes, "derive").split(',').any(|word| word.trim() == "Serialize") {
            return;
        }
        let of = format!("{name_of_crate}::{name}");
        match item {
            syn::Item::Struct(item) => self.add_fields(&of, &item.fields),
            syn::Item::Enum(item) => {
                let serde = words(attributes, "serde");
                let case = |name: String| {
                    if serde.contains("\"snake_case\"") {
                        snake_case(&name)
                    } else if serde.contains("\"kebab-case\"") {
                        snake_case(&name).replace('_', "-")
                    } else if serde.contains("\"lowercase\"") {
                        name.to_lowercase()
                    } else {
                        name
                    }
                };
                for variant in &item.variants {
                    let name = variant.ident.to_string();
                    let serde = words(&variant.attrs, "serde");
                    let name = renamed(&serde).unwrap_or_else(|| case(name));
                    self.variants.insert(Named { of: of.clone(), name });
                    self.add_fields(&of, &variant.fields);
                }
            }
            _ => {}
        }
    }
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Of all crates of the workspace, but for the tests in their sources.
fn names() -> Names {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut names = Names::default();
    for entry in std::fs::read_dir(crates).unwrap() {
        let folder = entry.unwrap().path();
        let name_of_crate = folder.file_name().unwrap().to_string_lossy().into_owned();
        if !folder.join("src").is_dir() {
            continue;
        }
        let mut files = vec![];
        sources(&folder.join("src"), &mut files);
        for file in files {
            let text = std::fs::read_to_string(&file).unwrap();
            if !text.contains("Serialize") {
                continue;
            }
            let parsed = syn::parse_file(&text).unwrap();
            parsed.items.iter().for_each(|item| names.add(&name_of_crate, item));
        }
    }
    names
}

/// Names without a check, but for those of types that are not printed.
fn unchecked(names: BTreeSet<Named>, checked: impl Fn(&str) -> bool) -> Vec<String> {
    let printed = |of: &str| NOT_PRINTED.iter().all(|(name, _)| *name != of);
    let unchecked = names.into_iter().filter(|named| printed(&named.of) && !checked(&named.name));
    unchecked.map(|named| format!("{}: {}", named.of, named.name)).collect()
}

#[test]
fn no_type_has_a_field_that_is_not_listed() {
    let lines = table::blocks().iter().flat_map(|block| &block.lines);
    let listed: BTreeSet<&str> = lines.flat_map(|[path, ..]| path.split(['.', '[', ']'])).collect();
    let names = names();
    assert!(names.fields.len() > 500, "{}", names.fields.len());
    let left = unchecked(names.fields, |name| listed.contains(name));
    assert!(left.is_empty(), "{left:#?}");
}

/// A kind, a reason or a law that can be named is asserted by name.
#[test]
fn no_type_has_a_variant_that_no_test_names() {
    let tests = table::read("rs") + &table::read("txt");
    let names = names();
    assert!(names.variants.len() > 100, "{}", names.variants.len());
    let lines = || table::blocks().iter().flat_map(|block| &block.lines);
    let is_key = |name: &str| lines().any(|[path, ..]| path.ends_with(&format!(".{name}")));
    let is_named =
        |name: &str| ['"', '.'].iter().any(|before| tests.contains(&format!("{before}{name}\"")));
    let asserted = |name: &str| is_named(name) || is_key(name);
    let left = unchecked(names.variants, asserted);
    assert!(left.is_empty(), "{left:#?}");
}

/// The types that are said not to be printed are there.
#[test]
fn types_that_are_not_printed_exist() {
    let names = names();
    let of: BTreeSet<&str> =
        names.fields.iter().chain(&names.variants).map(|named| named.of.as_str()).collect();
    for (name, why) in NOT_PRINTED {
        assert!(of.contains(name) && !why.is_empty(), "{name}");
    }
}
