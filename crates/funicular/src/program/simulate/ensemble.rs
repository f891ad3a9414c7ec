//! `funicular simulate --seeds`: many positions released, and where each comes to rest.

use clap::Args;
use funicular::Ensemble;

use super::{Simulate, simulate};
use crate::exit::{Exit, Failure, Result};
use crate::input::Input;
use crate::progress::Progress;
use crate::sweep::{Folder, Rows, count};

/// The columns, for the help.
pub const HELP: &str = "\
Columns of --out FILE: time_s; kinetic_j, potential_j, energy_j; joint_NAME_x_m ... the places of all joints (of a
chain joint0_x_m ...), joint_NAME_vx_m_s ... their velocities; bar1_axial_n ... the axial forces, tension positive;
joint_NAME_fx_n ... the forces of the ground on the joints that are held. Parquet holds unit and description of each.
For ParaView (.pvd): points with velocity_m_s, reaction_n, mass_kg; lines with axial_n; of each time kinetic_j,
potential_j, energy_j, and lost_j in impacts.

With --seeds the folder --out holds manifest.json, part-000000.parquet and so on, and at the end summary.json, the same to
the last byte for any number of threads and shards, interrupted or not; `funicular merge` joins shards. Columns: seed;
motion_outcome, a number in `equilibria` of the manifest, or -1 not at rest when the time is up, -2 no step possible,
-4 at rest where nothing is listed; motion_iterations, the time until rest in spans of `release.span_s` of the manifest;
motion_residual, what is left of motion; motion_energy_j.

Exit codes: 0 done; 1 positions rest where a complete list has nothing; 2 bad input; 3 not written, or a ring runs to the
end of its span, where the motion ends; 130 interrupted, and --resume goes on. How many are not at rest when the time is
up is said, and is no error. Where many end without a possible step take a shorter --step.

  funicular simulate chain.toml --seeds 1e5 --damping 2 --time 60 --step 5e-3 --out ends   which position ends where";

/// What a release of many positions asks for.
#[derive(Debug, Args)]
#[command(next_help_heading = "Many positions, with --seeds")]
pub struct Arguments {
    /// Release so many positions at random and tell where each comes to rest: 100000 or 1e5
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true,
          requires = "out", conflicts_with_all = ["from", "store", "push", "forces", "html"])]
    pub seeds: Option<u64>,
    #[command(flatten)]
    pub rows: Rows,
}

/// Release so many positions.
pub fn run(arguments: &Simulate, seeds: u64) -> Result<Exit> {
    let rows = &arguments.ensemble.rows;
    let begun = rows.begin()?;
    let Some(out) = &arguments.out else {
        return Err(Failure::bad_input("--seeds writes a folder: --out is missing"));
    };
    let Input { problem, .. } = arguments.input.read()?;
    let progress = Progress::start();
    progress.say("the equilibria");
    let prepared = Ensemble::new(simulate(arguments), seeds)
        .number(rows.seed)
        .shard(rows.shard)
        .format(rows.format)
        .prepare(&problem)?;
    drop(progress);
    let folder = Folder { manifest: prepared.manifest(), system: problem.system(), out, rows };
    folder.run(begun, &|settings| prepared.write(out, settings))
}
