//! What a system file may describe.

use super::{write_network, write_system};
use crate::Problem;
use crate::system::System;

/// An equilibrium problem as a system file describes it.
#[derive(Debug, Clone, PartialEq)]
pub enum Described {
    /// A chain of bars between two anchors, under its own weight.
    Chain(Problem),
    /// Any other system: joints by name, or a chain with loads at its joints.
    System(System),
}

/// The system file that reads back to the same system, bit for bit: of a chain under its own weight as
/// [`write_system`] has it, of any other as [`write_network`].
///
/// ```
/// use model::system_file::{Described, parse, write};
/// let chain = model::cases::paper();
/// assert_eq!(parse(&write(&(&chain).into()), "paper.toml")?, Described::Chain(chain));
/// # Ok::<(), model::system_file::SystemFileError>(())
/// ```
pub fn write(system: &System) -> String {
    let chain = system.as_row().map(|row| row.problem().chain());
    match chain.filter(|chain| System::from(*chain) == *system) {
        Some(chain) => write_system(chain),
        None => write_network(system),
    }
}
