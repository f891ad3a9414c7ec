//! How the lengths of members determine a shape and its forces.

use serde::Serialize;

/// Counts from the rank of the rigidity matrix: one row for each inextensible member that has its
/// length, the derivative of that length by the free coordinates of the joints.
///
/// `mechanisms = coordinates − rank` motions change no length to first order,
/// `self_stresses = rows − rank` sets of axial forces balance without load: with none the forces
/// follow from the shape.
///
/// J. C. Maxwell, Phil. Mag. 27 (1864) 294-299; S. Pellegrino and C. R. Calladine, Int. J. Solids
/// Struct. 22 (1986) 409-428, doi:10.1016/0020-7683(86)90014-4
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rigidity {
    /// Rank of the matrix.
    pub rank: usize,
    /// Independent motions that keep all lengths to first order.
    pub mechanisms: usize,
    /// Independent sets of forces in balance without load.
    pub self_stresses: usize,
    /// The smallest singular value that counts, and the largest that does not, over the largest
    /// one; 1 and 0 where there is none. Values near each other mean an uncertain count.
    pub gap: [f64; 2],
}
