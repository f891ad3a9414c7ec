use serde::Serialize;

/// A branch: one equilibrium followed over the parameter, as far as it goes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// Its number, from 1.
    pub id: usize,
    /// Its points, by rising position.
    pub points: Vec<BranchPoint>,
    /// Where it begins.
    pub start: BranchEnd,
    /// Where it ends.
    pub end: BranchEnd,
}

/// Where a branch begins or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BranchEnd {
    /// At an end of the path.
    Path,
    /// In the event of this number, from 1.
    Event(usize),
    /// Next to a point that is refused or undecided, at an end of the path.
    Border,
    /// It could not be followed on.
    Lost,
}

/// One equilibrium of a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchPoint {
    /// Position on the path.
    pub position: f64,
    /// The values of the parameters.
    pub values: Vec<f64>,
    /// Distance of the anchors, m.
    pub span_m: f64,
    /// Number of the point on the grid, from 1; none between its points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<usize>,
    /// Whether a census proves it (the middles of its enclosures are shown); else it comes from the
    /// curve.
    pub proved: bool,
    /// Number of the event that happens here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub event: Option<usize>,
    /// Pull of the chain on the first anchor along the plane's horizontal direction and along Z, N;
    /// none where it is infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pull_n: Option<[f64; 2]>,
    /// Angle of each bar from the descending vertical, towards the plane's horizontal direction,
    /// rad.
    pub angles_rad: Vec<f64>,
    /// Energy above joint 0, J.
    pub energy_j: f64,
    /// Axial force of each bar, tension positive, N; empty where it is infinite.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub axial_n: Vec<f64>,
    /// Number of directions in the plane in which the energy falls; in an event, of the branch next
    /// to it.
    pub index_in_plane: usize,
    /// Number of directions in space in which the energy falls; in an event, of the branch next to
    /// it.
    pub index_in_space: usize,
}

impl Branch {
    /// Whether the branch has a point at this position.
    pub fn covers(&self, position: f64) -> bool {
        match (self.points.first(), self.points.last()) {
            (Some(first), Some(last)) => first.position <= position && position <= last.position,
            _ => false,
        }
    }

    /// The last point at or before this position.
    pub fn before(&self, position: f64) -> Option<&BranchPoint> {
        let after = self.points.partition_point(|point| point.position <= position);
        after.checked_sub(1).map(|k| &self.points[k])
    }
}
