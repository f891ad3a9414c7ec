//! Members as prisms: Wavefront OBJ and glTF.
//!
//! # References
//!
//! glTF 2.0 Specification, Khronos Group, <https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html>.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use base64::Engine as _;
use model::Vector;
use model::system::Kind;
use numerics::vector::{cross, minus, norm, plus, times};
use serde_json::json;

use super::dxf::extent;
use super::{Shape, one_line, row};

/// Sides of a prism.
const SIDES: usize = 12;
/// Radius as a part of the structure's extent: of what can push, and of what can only pull.
const RADII: [f64; 2] = [0.006, 0.003];
/// Tension, compression, neither: names and colours.
const LOOKS: [(&str, [f64; 3]); 3] =
    [("tension", [0.1, 0.35, 0.75]), ("compression", [0.8, 0.2, 0.1]), ("slack", [0.5, 0.5, 0.5])];

/// A prism: twice so many corners as sides, and the triangles between them and of both ends.
struct Prism {
    /// Number of the member, from 0.
    member: usize,
    look: usize,
    corners: Vec<Vector>,
    normals: Vec<Vector>,
    triangles: Vec<[usize; 3]>,
}

fn prisms(shape: &Shape<'_>) -> impl Iterator<Item = Prism> {
    let (size_m, joints_m) = (extent(shape.joints_m), shape.joints_m);
    shape.lines().filter_map(move |line| {
        let [a, b] = line.ends.map(|k| joints_m[k]);
        let along = minus(b, a);
        let length_m = norm(along);
        if length_m <= 0.0 {
            return None;
        }
        let along = times(1.0 / length_m, along);
        // The axis that is most across.
        let least = (0..3).min_by(|i, j| along[*i].abs().total_cmp(&along[*j].abs())).unwrap_or(0);
        let axis = std::array::from_fn(|k| if k == least { 1.0 } else { 0.0 });
        let across = cross(along, axis);
        let across = times(1.0 / norm(across), across);
        let other = cross(along, across);
        let pushes = line.member.kind != Kind::Cable;
        let radius_m = size_m * RADII[usize::from(!pushes)];
        let normals: Vec<Vector> = (0..SIDES)
            .map(|k| {
                let (sin, cos) = (TAU * k as f64 / SIDES as f64).sin_cos();
                plus(times(cos, across), times(sin, other))
            })
            .collect();
        let ring = |centre: Vector| normals.iter().map(move |n| plus(centre, times(radius_m, *n)));
        let corners = ring(a).chain(ring(b)).collect();
        let mut triangles = Vec::with_capacity(4 * SIDES);
        for k in 0..SIDES {
            let next = (k + 1) % SIDES;
            triangles.push([k, next, SIDES + k]);
            triangles.push([next, SIDES + next, SIDES + k]);
        }
        for k in 1..SIDES - 1 {
            triangles.push([0, k + 1, k]);
            triangles.push([SIDES, SIDES + k, SIDES + k + 1]);
        }
        let normals = normals.iter().chain(&normals).copied().collect();
        Some(Prism { member: line.number, look: line.look(), corners, normals, triangles })
    })
}

/// A group for each member, as z is up.
pub(super) fn obj(shape: &Shape<'_>) -> String {
    let mut text = format!("# {}\n", one_line(shape.system.name()));
    let mut first = 1;
    for prism in prisms(shape) {
        let look = LOOKS[prism.look].0;
        let _ = writeln!(text, "g member_{}_{look}", prism.member + 1);
        for corner in &prism.corners {
            let _ = writeln!(text, "v {}", row(corner));
        }
        for [a, b, c] in prism.triangles {
            let _ = writeln!(text, "f {} {} {}", first + a, first + b, first + c);
        }
        first += prism.corners.len();
    }
    text
}

/// One mesh of up to three parts, a colour each, with y up as the format wants it.
pub(super) fn gltf(shape: &Shape<'_>) -> String {
    let (mut bytes, mut views, mut accessors, mut parts) = (vec![], vec![], vec![], vec![]);
    let all: Vec<Prism> = prisms(shape).collect();
    let mut add = |data: Vec<u8>, target: u32, mut accessor: serde_json::Value| {
        accessor["bufferView"] = views.len().into();
        views.push(json!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": data.len(), "target": target }));
        bytes.extend(data);
        accessors.push(accessor);
        accessors.len() - 1
    };
    for look in 0..LOOKS.len() {
        let (mut corners, mut normals, mut indices) = (vec![], vec![], vec![]);
        for prism in all.iter().filter(|prism| prism.look == look) {
            let first = corners.len();
            corners.extend(prism.corners.iter().copied().map(y_up));
            normals.extend(prism.normals.iter().copied().map(y_up));
            let number = |k: &usize| u32::try_from(first + k).unwrap_or(u32::MAX);
            indices.extend(prism.triangles.as_flattened().iter().map(number));
        }
        if corners.is_empty() {
            continue;
        }
        let ends = |pick: fn(f32, f32) -> f32| -> [f32; 3] {
            std::array::from_fn(|k| corners.iter().map(|at| at[k]).reduce(pick).unwrap_or_default())
        };
        let (least, most) = (ends(f32::min), ends(f32::max));
        let floats =
            |list: &[[f32; 3]]| list.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let places = json!({ "componentType": 5126, "count": corners.len(), "type": "VEC3", "min": least, "max": most });
        let places = add(floats(&corners), 34962, places);
        let across = json!({ "componentType": 5126, "count": normals.len(), "type": "VEC3" });
        let across = add(floats(&normals), 34962, across);
        let count = indices.len();
        let numbers = indices.into_iter().flat_map(u32::to_le_bytes).collect();
        let numbers =
            add(numbers, 34963, json!({ "componentType": 5125, "count": count, "type": "SCALAR" }));
        parts.push(json!({ "attributes": { "POSITION": places, "NORMAL": across }, "indices": numbers, "material": look }));
    }
    let materials = LOOKS.map(|(name, [r, g, b])| {
        let colour = json!({ "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8 });
        json!({ "name": name, "pbrMetallicRoughness": colour })
    });
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let scene = json!({
        "asset": { "version": "2.0", "generator": "funicular" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": shape.system.name() }],
        "meshes": [{ "primitives": parts }],
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{data}") }],
    });
    format!("{scene}\n")
}

#[expect(clippy::cast_possible_truncation, reason = "glTF has single precision")]
fn y_up([x, y, z]: Vector) -> [f32; 3] {
    [x as f32, z as f32, -y as f32]
}
