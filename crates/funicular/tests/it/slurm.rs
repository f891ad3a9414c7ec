//! The scripts for Slurm, with an `sbatch` of our own that runs the jobs of an array one after the
//! other, in the order in which they depend on each other.

#![cfg(unix)]

use crate::run::{Running, files, funicular, stderr, wait_until};
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Refuses a dependency on what is not done, runs every job of the array, prints its number.
const SBATCH: &str = r#"#!/usr/bin/env bash
set -eu
touch "$JOBS"
first=1 last=1
while [[ $1 == --* ]]; do
  case $1 in
    --array=*) range=${1#--array=}; first=${range%-*}; last=${range#*-} ;;
    --dependency=afterok:*) grep -qx "${1##*:}" "$JOBS" ;;
    --parsable | --job-name=* | --output=* | --partition=short) ;;
    *) echo "unknown: $1" >&2; exit 1 ;;
  esac
  shift
done
job=$((100 + $(wc -l < "$JOBS")))
for task in $(seq "$first" "$last"); do
  SLURM_ARRAY_JOB_ID=$job SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=2 bash "$@" >&2
done
echo "$job" >> "$JOBS"
echo "$job"
"#;

/// Remembers what it was asked.
const SCONTROL: &str = "#!/usr/bin/env bash\necho \"$@\" >> \"$JOBS\"\n";

fn folder(name: &str) -> PathBuf {
    let path = crate::run::folder(name);
    fs::create_dir_all(path.join("bin")).unwrap();
    for (tool, text) in [("sbatch", SBATCH), ("scontrol", SCONTROL)] {
        let file = path.join("bin").join(tool);
        fs::write(&file, text).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
    }
    path
}

/// One of the scripts, with our tools before those of a cluster.
fn script(folder: &Path, name: &str) -> Command {
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("../sweep/slurm");
    let path = std::env::var("PATH").unwrap();
    let mut command = Command::new("bash");
    command
        .arg(scripts.join(name))
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", folder.join("bin").display()))
        .env("JOBS", folder.join("jobs"))
        .env("FUNICULAR", crate::run::PROGRAM)
        .env("SBATCH_OPTIONS", "--partition=short");
    command
}

fn alone(arguments: &[&str]) {
    assert_eq!(funicular(arguments).status.code(), Some(0));
}

#[test]
fn an_array_of_jobs_writes_what_one_machine_writes() {
    let folder = folder("array");
    for (name, command) in [
        ("sweep", &["sweep", "--case", "three-equal-bars", "--seeds", "5e3"][..]),
        (
            "ensemble",
            &["simulate", "--case", "three-equal-bars", "--seeds", "12", "--damping", "1"],
        ),
    ] {
        let mut submit = script(&folder, "submit");
        let output = submit.args([name, "6", "3"]).args(command).output().unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
        let whole = folder.join(name).join("whole");
        let single = folder.join(format!("{name}-alone"));
        alone(&[command, &["--out", single.to_str().unwrap()]].concat());
        assert_eq!(files(&whole), files(&single), "{name}");
        assert!(folder.join(name).join("group-3").join("summary.json").exists());
    }
    // Three arrays for each.
    let jobs = fs::read_to_string(folder.join("jobs")).unwrap();
    assert_eq!(jobs, "100\n101\n102\n103\n104\n105\n");
}

#[test]
fn shards_that_make_no_groups_are_refused() {
    let folder = folder("uneven");
    for arguments in [&["out", "7", "2", "sweep"][..], &["out", "6", "0", "sweep"], &["out"]] {
        let output = script(&folder, "submit").args(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    }
    assert!(!folder.join("out").exists() && !folder.join("jobs").exists());
}

/// When the time is up the job asks to be started again, and goes on.
#[test]
fn a_job_at_the_end_of_its_time_is_started_again() {
    let folder = folder("time");
    let many = ["sweep", "--case", "three-equal-bars", "--seeds", "4e5"];
    let shard = || {
        let mut shard = script(&folder, "shard");
        shard.args(["out", "2"]).args(many);
        shard.env("SLURM_ARRAY_TASK_ID", "2").env("SLURM_ARRAY_JOB_ID", "77");
        shard.stdout(Stdio::null()).stderr(Stdio::null());
        shard
    };
    fs::create_dir(folder.join("out")).unwrap();
    let mut running = Running(shard().spawn().unwrap());
    wait_until("it does not begin", || folder.join("out/shard-2/.digests").exists());
    running.signal("TERM");
    assert_eq!(running.code(), Some(130));
    assert_eq!(fs::read_to_string(folder.join("jobs")).unwrap(), "requeue 77_2\n");
    assert!(!folder.join("out/shard-2/summary.json").exists());
    assert!(shard().status().unwrap().success());
    assert!(folder.join("out/shard-2/summary.json").exists());
}
