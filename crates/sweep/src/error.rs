/// Why a sweep cannot be made. Numbers count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum SweepError {
    /// Occurs when Sobol's sequence is asked for more bars than the table of direction numbers has.
    #[error(
        "Sobol's sequence is tabulated for up to {most} bars, the chain has {bars}: take uniform seeds"
    )]
    SobolDimensions { bars: usize, most: usize },
    /// Occurs when a grid has not one axis for each bar.
    #[error("a grid needs one axis for each of the {bars} bars, got {axes}")]
    GridAxes { bars: usize, axes: usize },
    /// Occurs when an axis of a grid has no point, or an end that is no finite number.
    #[error(
        "axis {axis} of the grid, {points} points from {from_rad} to {to_rad} rad, has no finite points"
    )]
    GridAxis { axis: usize, points: u64, from_rad: f64, to_rad: f64 },
    /// Occurs when a grid has more points than can be counted.
    #[error("the grid has more points than 2^64")]
    GridSize,
    /// Occurs when the chunks are empty or too long.
    #[error("a chunk must have from 1 to {most} seeds, got {seeds}")]
    Chunk { seeds: u64, most: u64 },
    /// Occurs when the chain has more equilibria than the columns can number.
    #[error("{members} equilibria are more than the columns can number ({most})")]
    TooManyEquilibria { members: usize, most: usize },
    /// Occurs when no solver is asked.
    #[error("a sweep needs a solver")]
    NoSolver,
    /// Occurs when the name of a solver cannot be that of columns.
    #[error("`{name}` cannot be the name of columns: letters, digits and underscores are allowed")]
    SolverName { name: String },
    /// Occurs when two solvers have one name.
    #[error("two solvers are called `{name}`")]
    SolverTwice { name: String },
    /// Occurs when no census can be taken and nothing can be discovered either.
    #[error("census: {0}")]
    Census(#[from] census::CensusError),
    /// Occurs when the threads cannot be started.
    #[error("cannot start {threads} threads: {reason}")]
    Threads { threads: usize, reason: String },
}
