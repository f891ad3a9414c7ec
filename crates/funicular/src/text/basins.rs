//! Basins as text: what is no picture.

use std::fmt;

use model::SolverName;

use crate::basins::BasinsAnswer;

/// As `funicular basins` prints it below the names of its pictures.
impl fmt::Display for BasinsAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let starts = self.starts();
        for solver in [SolverName::LAGRANGE, SolverName::ENERGY] {
            match self.failed(&solver) {
                0 => writeln!(f, "{solver}: each of {starts} starts reached an equilibrium")?,
                failed => {
                    writeln!(f, "{solver}: {failed} of {starts} starts reached no equilibrium")?;
                }
            }
            let unlisted = self.unlisted(&solver);
            if unlisted > 0 {
                writeln!(
                    f,
                    "{solver}: {unlisted} of {starts} starts reached an equilibrium that is not listed"
                )?;
            }
        }
        Ok(())
    }
}
