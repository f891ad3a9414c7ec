//! Whatever the named cases bring forth is in the list.

use std::collections::BTreeSet;

use super::output::Output;

use crate::run::run;

/// Commands that take a case, with the kinds of their outputs for chains and for systems.
const COMMANDS: [(&[&str], [&str; 2]); 5] = [
    (&["solve", "--json"], ["solve", "solve"]),
    (&["census", "--json"], ["census", "census"]),
    (&["modes", "--json", "--modes", "3"], ["modes", "modes"]),
    (&["derivatives", "--json"], ["derivatives", "derivatives"]),
    (&["study", "--vary", "gravity_m_s2=9,10", "--json"], ["study", "study"]),
];

/// Seconds of a processor, and no other keys.
const SLOW: [(&str, &str); 2] = [("four-bar-linkage", "census"), ("four-bar-linkage", "modes")];

/// A key that none of the tests here has met would show itself in one of some fifty systems.
#[test]
fn no_case_has_a_key_that_is_not_listed() {
    let folder = tempfile::tempdir().unwrap();
    let chains = model::cases::all().iter().map(|case| (case.name, 0));
    let systems = model::cases::exhibits().map(|exhibit| (exhibit.name, 1));
    let mut outputs = 0;
    let mut unlisted = BTreeSet::new();
    for (name, form) in chains.chain(systems) {
        for (arguments, kinds) in COMMANDS {
            if SLOW.contains(&(name, arguments[0])) {
                continue;
            }
            let (code, text, _) = run(&folder, &[arguments, &["--case", name]].concat());
            // A case that a command does not take is refused without an object.
            if code != Some(2) && !text.is_empty() {
                let output = Output::json(kinds[form], "", &text);
                let paths = output.unlisted().into_iter();
                unlisted.extend(paths.map(|path| format!("[{}] {path} ({name})", kinds[form])));
                outputs += 1;
            }
        }
    }
    assert!(outputs > 100, "{outputs}");
    assert!(unlisted.is_empty(), "{unlisted:#?}");
}
