//! A motion for ParaView: a grid for each stored time, and a collection that names them.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use columns::AtomicFolder;
use formats::export::{Moving, Shape, Target, collection};
use model::system::{Member, System};
use motion::Snapshot;

/// Writes a motion for ParaView: `motion.pvd`, with the grid of each stored time in the folder `motion` beside it. Both appear
/// when they are whole. A grid has the forces, the velocities of the joints (`velocity_m_s`), the part of their strength that members
/// without mass use (`utilisation`), and as fields of its time the energies, J.
///
/// ```
/// use funicular::{Frames, prelude::*};
/// let problem = Problem::case("two-bars")?;
/// let moved = Simulate::new().start(Start::Seed(1)).time_s(0.1).store_s(0.05).run(&problem)?;
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("motion.pvd");
/// let mut frames = Frames::create(&path, &moved.system).unwrap();
/// moved.stored.iter().try_for_each(|at| frames.add(at)).unwrap();
/// frames.finish().unwrap();
/// let text = std::fs::read_to_string(&path).unwrap();
/// assert!(text.contains("timestep=\"0.05\" part=\"0\" file=\"motion/000001.vtu\""));
/// assert!(folder.path().join("motion/000002.vtu").exists());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug)]
pub struct Frames<'a> {
    system: &'a System,
    path: PathBuf,
    folder: AtomicFolder,
    times_s: Vec<f64>,
}

impl<'a> Frames<'a> {
    /// Begin the files of a collection.
    ///
    /// # Errors
    /// Those of the file system, and [`ErrorKind::AlreadyExists`] where the folder is there and not empty.
    pub fn create(path: &Path, system: &'a System) -> io::Result<Self> {
        let folder = AtomicFolder::create(&path.with_extension(""))?;
        Ok(Self { system, path: path.to_owned(), folder, times_s: Vec::new() })
    }

    /// Write a time.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn add(&mut self, now: &Snapshot) -> io::Result<()> {
        let numbers = [
            ("kinetic_j", now.kinetic_j),
            ("potential_j", now.potential_j),
            ("energy_j", now.energy_j()),
            ("lost_j", now.lost_j),
        ];
        self.add_shape(&Shape {
            system: self.system,
            joints_m: &now.joints_m,
            axial_n: &now.axial_n,
            reactions_n: &now.reactions_n,
            used: &self.used(now),
            moving: Some(Moving {
                time_s: now.time_s,
                velocities_m_s: &now.velocities_m_s,
                numbers: &numbers,
            }),
        })
    }

    /// The part of its strength that each member without mass uses. In one with mass the force varies along it as it moves, and
    /// nothing is said of that.
    fn used(&self, now: &Snapshot) -> Vec<Option<f64>> {
        let one = |(member, force_n): (&Member, &f64)| {
            let strength = member.strength.as_deref()?;
            let is_even = member.body.mass_kg() <= 0.0 && member.loads.is_empty();
            is_even.then(|| strength.utilisation(*force_n, *force_n))
        };
        let members = self.system.members().iter().zip(&now.axial_n);
        if self.system.has_strengths() { members.map(one).collect() } else { vec![] }
    }

    /// Write a shape of a system with what it has while it moves.
    ///
    /// # Errors
    /// Those of the file system, and [`ErrorKind::InvalidInput`] where its lists are not those of the system, or it does not
    /// move.
    pub fn add_shape(&mut self, shape: &Shape<'_>) -> io::Result<()> {
        let invalid = |why: &dyn ToString| io::Error::new(ErrorKind::InvalidInput, why.to_string());
        let Some(moving) = shape.moving else { return Err(invalid(&"a shape without a time")) };
        let text = shape.text(Target::Vtu).map_err(|error| invalid(&error))?;
        self.folder.write(&grid(self.times_s.len()), text.as_bytes())?;
        self.times_s.push(moving.time_s);
        Ok(())
    }

    /// Give the files their names.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn finish(self) -> io::Result<()> {
        let folder = self.path.file_stem().unwrap_or_default().display();
        let grids = self.times_s.iter().enumerate();
        let grids = grids.map(|(k, time_s)| (*time_s, format!("{folder}/{}", grid(k))));
        let text = collection(grids);
        self.folder.commit()?;
        columns::write_whole(&self.path, text.as_bytes())
    }
}

/// Name of the grid of a stored time, counted from 0.
fn grid(number: usize) -> String {
    format!("{number:06}.vtu")
}
