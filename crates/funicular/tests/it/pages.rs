//! README and CONTRIBUTING against the files that they name.

use std::path::{Path, PathBuf};

/// The folder of the workspace.
fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The pages, with their texts. (The licences, the changelog and the citation name no files.)
fn pages() -> Vec<(String, String)> {
    let guide = std::fs::read_dir(top().join(GUIDE)).unwrap();
    let chapters = guide.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let chapters = chapters.filter(|name| Path::new(name).extension().is_some_and(|e| e == "md"));
    let pages = chapters.map(|name| format!("{GUIDE}/{name}"));
    let pages = pages.chain(["README.md", "CONTRIBUTING.md"].map(str::to_owned));
    pages.map(|page| (page.clone(), std::fs::read_to_string(top().join(page)).unwrap())).collect()
}

/// The chapters of the guide.
const GUIDE: &str = "crates/funicular/guide";

/// What stands between single backticks, and between the fences of blocks line by line.
fn code(page: &str) -> Vec<String> {
    let mut found = vec![];
    let mut fenced = false;
    let mut prose = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        } else if fenced {
            found.push(line.to_owned());
        } else {
            prose.push_str(line);
            prose.push(' ');
        }
    }
    found.extend(prose.split('`').skip(1).step_by(2).map(str::to_owned));
    found
}

/// Whether a word is meant as a path from the top of the workspace.
fn is_path(word: &str) -> bool {
    let tops = ["crates/", "validation/", "benches/", "notebooks/", ".ci/"];
    tops.iter().any(|top| word.starts_with(top))
}

#[test]
fn every_path_exists() {
    let mut paths = 0;
    for (page, text) in pages() {
        let code = code(&text);
        // Links are from where the page stands, paths in code from the top.
        let beside = top().join(&page);
        let beside = beside.parent().unwrap();
        let words = code.iter().flat_map(|code| code.split([' ', ',', ';', '"', '\'']));
        let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let links = links.filter(|link| !link.contains("://") && !link.starts_with('#'));
        let words = words.filter(|word| is_path(word)).map(|path| top().join(path));
        for path in words.chain(links.map(|link| beside.join(link))) {
            assert!(path.exists(), "{page} names {}, which does not exist", path.display());
            paths += 1;
        }
    }
    assert!(paths > 30, "{paths} paths");
}

/// The word behind an option of a command.
fn after<'a>(words: &[&'a str], option: &str) -> Option<&'a str> {
    let at = words.iter().position(|word| *word == option)?;
    words.get(at + 1).copied()
}

#[test]
fn every_command_names_packages_tests_and_examples_that_exist() {
    let mut commands = 0;
    for (page, text) in pages() {
        for code in code(&text).iter().filter(|code| code.contains("cargo ")) {
            let words: Vec<&str> = code.split_whitespace().collect();
            let package = after(&words, "-p");
            let folder = match package {
                Some("benches") => top().join("benches"),
                Some(name) => top().join("crates").join(name),
                None => continue,
            };
            assert!(folder.is_dir(), "{page}: {code}");
            let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap();
            if let Some(example) = after(&words, "--example") {
                let file = folder.join("examples").join(example).with_extension("rs");
                let named = manifest.contains(&format!("[[example]]\nname = \"{example}\""));
                assert!(file.is_file() || named, "{page}: {code}");
            }
            if let Some(bench) = after(&words, "--bench") {
                let named = manifest.contains(&format!("[[bench]]\nname = \"{bench}\""));
                assert!(named, "{page}: {code}");
            }
            if let Some(program) = after(&words, "--test") {
                assert_eq!(program, "it", "{page}: {code}");
                let filter = after(&words, "it").and_then(|filter| filter.strip_suffix("::"));
                let file = folder.join("tests/it").join(filter.unwrap()).with_extension("rs");
                assert!(file.is_file(), "{page}: {code}");
            }
            commands += 1;
        }
    }
    assert!(commands > 10, "{commands} commands");
}

/// One program of tests for each crate.
#[test]
fn every_crate_has_one_program_of_tests() {
    for entry in std::fs::read_dir(top().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        // Tests beside a pyproject.toml are in Python.
        if folder.join("pyproject.toml").is_file() {
            continue;
        }
        let tests = folder.join("tests");
        let Ok(entries) = std::fs::read_dir(&tests) else { continue };
        for entry in entries {
            let path = entry.unwrap().path();
            assert!(path.extension().is_none_or(|e| e != "rs"), "{}", path.display());
        }
        assert!(tests.join("it/main.rs").is_file(), "{}", tests.display());
    }
}

/// The citation, the report's entry for it and the article have one title, and what the article cites
/// and shows is there.
#[test]
fn the_software_has_one_title() {
    let read = |path: &str| std::fs::read_to_string(top().join(path)).unwrap();
    let citation = read("CITATION.cff");
    let title = citation.split("title: \"").nth(1).unwrap().split('"').next().unwrap();
    let article = read("validation/joss/paper.md");
    assert!(article.contains(&format!("title: \"{title}\"")), "{title}");
    assert!(read("validation/REPORT.md").contains(&format!("title   = {{{title}}}")), "{title}");
    let references = read("validation/joss/paper.bib");
    let listed: Vec<&str> = references
        .split("@article{")
        .skip(1)
        .map(|entry| entry.split(',').next().unwrap())
        .collect();
    let cited: Vec<&str> =
        article.split("[@").skip(1).map(|rest| rest.split(']').next().unwrap()).collect();
    assert!(listed.iter().all(|key| cited.contains(key)), "{listed:?} {cited:?}");
    assert!(cited.iter().all(|key| listed.contains(key)), "{listed:?} {cited:?}");
    let picture = article.split("](").nth(1).unwrap().split(')').next().unwrap();
    assert!(top().join("validation/joss").join(picture).exists(), "{picture}");
    // Two pages.
    assert!((250..=1000).contains(&article.split_whitespace().count()));
}
