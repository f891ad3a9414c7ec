//! A system in motion.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use funicular::export::{Moving, Shape};
use funicular::prelude::{Simulate, Start, Vector};
use funicular::{Animation, ForceTable, Frames, Order};
use numpy::{PyArrayMethods as _, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{column, numbers, vectors};
use crate::problem::Problem;
use crate::raise::{bad_setting, raise};
use crate::work;

/// What is stored of a motion: an entry for each time.
#[derive(Default)]
struct Stored {
    time_s: Vec<f64>,
    joints_m: Vec<Vector>,
    velocities_m_s: Vec<Vector>,
    axial_n: Vec<f64>,
    reactions_n: Vec<Vector>,
    kinetic_j: Vec<f64>,
    potential_j: Vec<f64>,
    laws_off: Vec<f64>,
    lengths_off: Vec<f64>,
}

/// Times are in parts of the whole for whoever waits.
const PARTS: f64 = 1000.0;

/// Where a motion begins: as words, or as places of all joints.
pub fn start(word: &str, joints_m: Option<PyReadonlyArrayDyn<'_, f64>>) -> PyResult<Start> {
    if let Some(joints) = joints_m {
        return Ok(Start::Joints(vectors(&joints)?));
    }
    word.parse().map_err(|why: String| bad_setting("start", word, &why))
}

/// 2, 4 or 8.
fn order(order: usize) -> PyResult<Order> {
    match order {
        2 => Ok(Order::Second),
        4 => Ok(Order::Fourth),
        8 => Ok(Order::Eighth),
        _ => {
            let why = format!("2, 4 or 8 is required, got {order}");
            Err(bad_setting("order", &order.to_string(), &why))
        }
    }
}

/// Arrays over the stored times, and an animation as a page.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one for each setting")]
pub fn simulate<'py>(
    py: Python<'py>,
    problem: &Problem,
    start_word: &str,
    start_joints_m: Option<PyReadonlyArrayDyn<'py, f64>>,
    time_s: f64,
    step_s: f64,
    store_s: Option<f64>,
    order: usize,
    damping_1_s: f64,
    friction_n_m_s: f64,
    pushes: Vec<(String, Vector)>,
    forces: Option<String>,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, String)> {
    let mut simulate = Simulate::new()
        .start(start(start_word, start_joints_m)?)
        .time_s(time_s)
        .step_s(step_s)
        .damping_1_s(damping_1_s)
        .friction_n_m_s(friction_n_m_s)
        .order(self::order(order)?);
    if let Some(text) = forces {
        let table = ForceTable::parse(&text, "forces").map_err(|error| raise(&error.into()))?;
        simulate = simulate.forces(table);
    }
    if let Some(store_s) = store_s {
        simulate = simulate.store_s(store_s);
    }
    for (joint, impulse) in pushes {
        simulate = simulate.push(joint, impulse);
    }
    let of = Arc::clone(&problem.of);
    let system = problem.system();
    let (joints, members) = (system.joints().len(), system.members().len());
    let (stored, page) = work::answer(py, threads, progress, move |watch| {
        let mut stored = Stored::default();
        let mut animation = Animation::new(&system);
        let moved = simulate.run_watched(&of, &mut |now| {
            stored.add(
                now.time_s,
                now.kinetic_j,
                now.potential_j,
                [now.laws.largest(), now.lengths_off],
            );
            stored.joints_m.extend_from_slice(&now.joints_m);
            stored.velocities_m_s.extend_from_slice(&now.velocities_m_s);
            stored.axial_n.extend_from_slice(&now.axial_n);
            stored.reactions_n.extend_from_slice(&now.reactions_n);
            animation.add(now);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "it saturates"
            )]
            let done = (now.time_s / time_s * PARTS) as u64;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1000")]
            watch.tell("thousandths of the time", done, PARTS as u64);
            if watch.stop().load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        moved.map(|_| (stored, animation.page()))
    })?;
    Ok((stored.dict(py, joints, members)?, page))
}

/// Write the stored times of a motion for ParaView: a collection, and a grid of each in the folder beside it.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "arrays, one for each quantity")]
pub fn save_motion(
    py: Python<'_>,
    problem: &Problem,
    path: PathBuf,
    time_s: PyReadonlyArrayDyn<'_, f64>,
    joints_m: PyReadonlyArrayDyn<'_, f64>,
    velocities_m_s: PyReadonlyArrayDyn<'_, f64>,
    axial_n: PyReadonlyArrayDyn<'_, f64>,
    reactions_n: PyReadonlyArrayDyn<'_, f64>,
    kinetic_j: PyReadonlyArrayDyn<'_, f64>,
    potential_j: PyReadonlyArrayDyn<'_, f64>,
) -> PyResult<()> {
    let system = problem.system();
    let (joints, members) = (system.joints().len(), system.members().len());
    let (places, speeds, grounds) =
        (vectors(&joints_m)?, vectors(&velocities_m_s)?, vectors(&reactions_n)?);
    let [time_s, axial_n, kinetic_j, potential_j] =
        [numbers(&time_s)?, numbers(&axial_n)?, numbers(&kinetic_j)?, numbers(&potential_j)?];
    let write = || -> std::io::Result<()> {
        let mut frames = Frames::create(&path, &system)?;
        for (k, time_s) in time_s.into_iter().enumerate() {
            let at = |all: &[Vector]| all.iter().copied().skip(k * joints).take(joints).collect();
            let [joints_m, velocities_m_s, reactions_n]: [Vec<Vector>; 3] =
                [at(&places), at(&speeds), at(&grounds)];
            let axial_n: Vec<f64> =
                axial_n.iter().copied().skip(k * members).take(members).collect();
            let [kinetic_j, potential_j] =
                [&kinetic_j, &potential_j].map(|all| all.get(k).copied().unwrap_or(f64::NAN));
            let numbers = [
                ("kinetic_j", kinetic_j),
                ("potential_j", potential_j),
                ("energy_j", kinetic_j + potential_j),
            ];
            let moving = Moving { time_s, velocities_m_s: &velocities_m_s, numbers: &numbers };
            frames.add_shape(&Shape {
                system: &system,
                joints_m: &joints_m,
                axial_n: &axial_n,
                reactions_n: &reactions_n,
                used: &[],
                moving: Some(moving),
            })?;
        }
        frames.finish()
    };
    Ok(py.detach(write)?)
}

impl Stored {
    fn add(&mut self, time_s: f64, kinetic_j: f64, potential_j: f64, off: [f64; 2]) {
        self.time_s.push(time_s);
        self.kinetic_j.push(kinetic_j);
        self.potential_j.push(potential_j);
        self.laws_off.push(off[0]);
        self.lengths_off.push(off[1]);
    }

    fn dict(self, py: Python<'_>, joints: usize, members: usize) -> PyResult<Bound<'_, PyDict>> {
        let times = self.time_s.len();
        let cube =
            |vectors: Vec<Vector>| column(py, vectors.into_flattened()).reshape([times, joints, 3]);
        let dict = PyDict::new(py);
        dict.set_item("time_s", column(py, self.time_s))?;
        dict.set_item("joints_m", cube(self.joints_m)?)?;
        dict.set_item("velocities_m_s", cube(self.velocities_m_s)?)?;
        dict.set_item("reactions_n", cube(self.reactions_n)?)?;
        dict.set_item("axial_n", column(py, self.axial_n).reshape([times, members])?)?;
        dict.set_item("kinetic_j", column(py, self.kinetic_j))?;
        dict.set_item("potential_j", column(py, self.potential_j))?;
        dict.set_item("laws_off", column(py, self.laws_off))?;
        dict.set_item("lengths_off", column(py, self.lengths_off))?;
        Ok(dict)
    }
}
