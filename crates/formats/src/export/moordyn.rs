//! MoorDyn's input: what [`parse_moordyn`](crate::system::parse_moordyn) reads.

use std::fmt::Write as _;

use model::system::Kind;

use super::{ExportError, Shape, joint_loads, one_line};

/// Density of the lines' material, kg/m^3: only their volume follows from it, which weighs nothing in the file's water.
const STEEL: f64 = 7850.0;

/// Longest time step, s, and as a part of the reciprocal of the fastest frequency of a point on the lines that meet there,
/// whose damping is critical.
const STEP_S: f64 = 1e-3;
const STEP: f64 = 0.1;

/// A line of one segment for each member, in water of no density, so that masses are weights.
pub(super) fn write(shape: &Shape<'_>) -> Result<String, ExportError> {
    let refuse = |what| Err(ExportError::NoCounterpart { format: "MoorDyn", what });
    let g = shape.system.gravity_m_s2();
    let mut types = String::new();
    let mut lines = String::new();
    for (k, member) in shape.system.members().iter().enumerate() {
        let number = k + 1;
        let Some(stiffness_n) = member.stiffness_n else {
            return refuse(format!("line that does not stretch (member {number})"));
        };
        if member.kind != Kind::Cable || member.rope.is_some() {
            let what = if member.rope.is_some() { "runs over pulleys" } else { "can push" };
            return refuse(format!("line that {what} (member {number})"));
        }
        let (length_m, mass_kg) = (member.body.length_m(), member.body.mass_kg());
        if !member.loads.is_empty()
            || (member.body.centre_m() - 0.5 * length_m).abs() > 1e-12 * length_m
        {
            return refuse(format!("line loaded unevenly (member {number})"));
        }
        let per_m = mass_kg / length_m;
        let diameter_m =
            (4.0 * per_m.max(f64::MIN_POSITIVE) / (STEEL * std::f64::consts::PI)).sqrt();
        let _ = writeln!(
            types,
            "t{number}  {diameter_m:?}  {per_m:?}  {stiffness_n:?}  -1.0  0.0  1.0  1.0  0.0  0.0"
        );
        let [from, to] = [member.from + 1, member.to + 1];
        let _ = writeln!(lines, "{number}  t{number}  {from}  {to}  {length_m:?}  1  -");
    }
    let mut points = String::new();
    for (k, (joint, at_m)) in shape.system.joints().iter().zip(shape.joints_m).enumerate() {
        let [fx, fy, fz] = joint.force_n;
        if joint.support.at_m().is_some() && !joint.support.is_fixed() {
            return refuse(format!("point that slides (joint {:?})", joint.name));
        }
        if fx.abs() + fy.abs() > 0.0 {
            return refuse(format!("level force at rest (joint {:?})", joint.name));
        }
        let kind = if joint.support.is_fixed() { "Fixed" } else { "Free" };
        let [x, y, z] = at_m;
        let mass_kg = joint.mass_kg - fz / g;
        if mass_kg < 0.0 && !joint.support.is_fixed() {
            return refuse(format!("point that is lifted in air (joint {:?})", joint.name));
        }
        let _ = writeln!(points, "{}  {kind}  {x:?}  {y:?}  {z:?}  {mass_kg:?}  0  0  0", k + 1);
    }
    let floor = shape.system.floor_m().map_or(Ok(String::new()), |floor_m| {
        if floor_m < 0.0 {
            Ok(format!("{:?}  WtrDpth\n", -floor_m))
        } else {
            refuse(format!("floor at or above the water's surface (z = {floor_m} m)"))
        }
    })?;
    let name = one_line(shape.system.name());
    Ok(format!(
        "--------------------- MoorDyn Input File ---------------------\n{name}\n\
         ---------------------- LINE TYPES ----------------------------\n\
         TypeName  Diam  MassDen  EA  BA/-zeta  EI  Cd  Ca  CdAx  CaAx\n(name)  (m)  (kg/m)  (N)  (N-s/-)  (N-m^2)  (-)  (-)  (-)  (-)\n{types}\
         ---------------------- POINTS --------------------------------\n\
         ID  Type  X  Y  Z  M  V  CdA  CA\n(#)  (-)  (m)  (m)  (m)  (kg)  (m^3)  (m^2)  (-)\n{points}\
         ---------------------- LINES ---------------------------------\n\
         ID  LineType  AttachA  AttachB  UnstrLen  NumSegs  LineOutputs\n(#)  (name)  (#)  (#)  (m)  (-)  (-)\n{lines}\
         ---------------------- OPTIONS -------------------------------\n\
         {:?}  dtM\n{g:?}  g\n0.0  rhoW\n{floor}\
         ---------------------- need this line ------------------------\n",
        step_s(shape)
    ))
}

/// A time step that MoorDyn's explicit integration bears.
fn step_s(shape: &Shape<'_>) -> f64 {
    let (forces, masses) = joint_loads(shape.system);
    let g = shape.system.gravity_m_s2();
    let masses: Vec<f64> = masses.iter().zip(forces).map(|(m, force)| m - force[2] / g).collect();
    let mut stiffness = vec![0.0_f64; masses.len()];
    for member in shape.system.members() {
        let per_m = member.stiffness_n.unwrap_or_default() / member.body.length_m();
        stiffness[member.from] += per_m;
        stiffness[member.to] += per_m;
    }
    let moving = shape.system.joints().iter().zip(masses.iter().zip(&stiffness));
    let moving = moving.filter(|(joint, (mass_kg, per_m))| {
        !joint.support.is_fixed() && **mass_kg > 0.0 && **per_m > 0.0
    });
    moving.fold(STEP_S, |least, (_, (mass_kg, per_m))| least.min(STEP * (mass_kg / per_m).sqrt()))
}
