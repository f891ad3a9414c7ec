//! Command lines: the program ends with a code that its help names, and says what it refuses.

use std::process::{Command, Stdio};

use super::fuzz;
use super::mutate::{PIECES, Random};

/// Words of the command line. What would write outside the folder or take long is not among them.
const WORDS: &str = "solve census sweep merge trace study basins modes simulate judge \
    derivatives cases format new completions --case two-bars lamp x-cross \
    three-equal-bars thirty-bars --json --summary --solver energy lagrange \
    both --vary anchors.end_m.z=-1.5..-0.5:3 gravity_m_s2=1,2 bars.*.mass_kg=0 \
    --seeds 10 --threads 1 --shard 1/2 --size 4 --bars 1,2 --csv --svg --out \
    out.csv out --time 0.01 --step -1 1e-3 --from rest seed:3 --help - -- bash \
    --max-bars 3 --resume --max-points 2 --version -h";

/// The arguments, one a line.
fn line(random: &mut Random) -> String {
    let known: Vec<&str> = WORDS.split(' ').collect();
    let mut words: Vec<String> = vec![random.pick(&known[..15]).to_owned()];
    for _ in 0..random.below(7) {
        let word = if random.below(6) == 0 {
            String::from_utf8_lossy(random.pick(PIECES)).replace(['\0', '\n'], " ")
        } else {
            random.pick(&known).to_owned()
        };
        words.push(word);
    }
    words.join("\n")
}

#[test]
fn command_lines() {
    let folder = tempfile::tempdir().unwrap();
    // Processes take longer than calls.
    let share = if std::env::var_os("FUZZ_SECONDS").is_some() { 1 } else { 4 };
    fuzz(
        "command-line",
        |random| if random.below(share) == 0 { line(random) } else { String::new() },
        |text| {
            if text.is_empty() {
                return;
            }
            let output = Command::new(crate::run::PROGRAM)
                .args(text.split('\n'))
                .current_dir(&folder)
                .env("NO_COLOR", "1")
                .env("RAYON_NUM_THREADS", "1")
                .stdin(Stdio::null())
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            let code = output.status.code();
            assert!(matches!(code, Some(0..=3)), "{text:?}: {code:?} {said}");
            assert!(!said.contains("panicked") && !said.contains('\u{1b}'), "{text:?}: {said}");
            assert!(code == Some(0) || !said.is_empty() || !output.stdout.is_empty(), "{text:?}");
        },
    );
}
