//! Another library with the same names is found, whether it is linked or loaded.

#![cfg(all(target_os = "linux", not(miri)))]

use std::path::PathBuf;
use std::process::Command;

/// What a child of this test prints of what it found.
const MARK: &str = "the other library is ";

/// Not a test of its own: what the child of the next test runs.
#[test]
fn a_child_says_what_it_finds() {
    println!("{MARK}{:?}", dense_lapack::other_library());
}

#[test]
fn a_library_with_the_same_names_is_named() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    for symbol in ["dgemm_", "dgesdd_"] {
        let source = folder.join(format!("{symbol}.c"));
        let library = folder.join(format!("lib{symbol}another.so"));
        std::fs::write(&source, format!("void {symbol}(void) {{}}\n")).unwrap();
        let compiler = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
        let mut compile = Command::new(compiler);
        compile.args(["-shared", "-fPIC", "-o"]).arg(&library).arg(&source);
        assert!(compile.status().unwrap().success());
        let mut child = Command::new(std::env::current_exe().unwrap());
        child.args(["a_child_says_what_it_finds", "--nocapture"]).env("LD_PRELOAD", &library);
        let output = child.output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout);
        let expected = format!("{MARK}Some({:?})", library.display().to_string());
        assert!(output.status.success() && said.contains(&expected), "{said}");
    }
}
