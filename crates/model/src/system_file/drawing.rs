//! What a file says with a drawing: the plane of its joints, and the lengths of members.

use super::kind::SystemFileErrorKind as Kind;
use crate::system::{Joint, Name, Support};
use crate::{Anchors, Vector};

/// What `plane` may be, with the coordinate that is the same for all joints.
const PLANES: [(&str, usize); 3] = [("yz", 0), ("xz", 1), ("xy", 2)];
const AXES: [char; 3] = ['x', 'y', 'z'];

/// Keep every joint to the plane: one that is free slides in it, one that slides along a line or in
/// another plane must not leave it. Else the number of the joint that is wrong, where it is one.
pub(super) fn keep_to_plane(joints: &mut [Joint], word: &str) -> Result<(), (Option<usize>, Kind)> {
    let known = PLANES.iter().find(|(plane, _)| *plane == word);
    let Some(&(plane, axis)) = known else {
        let found = format!("{word:?}");
        let wanted = "\"xy\", \"xz\" or \"yz\"";
        return Err((None, Kind::OutOfRange { found, wanted }));
    };
    let through = joints.iter().find_map(Joint::drawn_m).map_or(0.0, |place_m| place_m[axis]);
    let normal: Vector = std::array::from_fn(|k| if k == axis { 1.0 } else { 0.0 });
    for (number, joint) in joints.iter_mut().enumerate() {
        if let Some(place_m) = joint.drawn_m()
            && (place_m[axis] - through).abs() > 0.0
        {
            let (axis, at_m) = (AXES[axis], place_m[axis]);
            let kind = Kind::OffPlane {
                joint: joint.name.to_string(),
                plane,
                axis,
                at_m,
                plane_m: through,
            };
            return Err((Some(number), kind));
        }
        let at_m = joint.near_m.unwrap_or_else(|| normal.map(|part| part * through));
        joint.support = match joint.support {
            Support::Free => Support::Plane { at_m, normal },
            support @ Support::Fixed { .. } => support,
            support @ Support::Line { direction, .. } if direction[axis].abs() <= 0.0 => support,
            support @ Support::Plane { normal: n, .. } if (n[axis].abs() - 1.0).abs() <= 0.0 => {
                support
            }
            Support::Plane { at_m, normal: n } if n[axis].abs() <= 0.0 => {
                // Across both normals.
                let [k, j] = [(axis + 1) % 3, (axis + 2) % 3];
                let mut direction = [0.0; 3];
                (direction[k], direction[j]) = (-n[j], n[k]);
                Support::Line { at_m, direction }
            }
            _ => {
                return Err((
                    Some(number),
                    Kind::LeavesPlane { joint: joint.name.to_string(), plane },
                ));
            }
        };
    }
    Ok(())
}

/// The length of one of `count` equal members in a row between two joints as they are drawn, m.
pub(super) fn length_m(from: &Joint, to: &Joint, count: usize) -> Result<Option<f64>, Kind> {
    let Some([start_m, end_m]) = ends_m(from, to) else { return Ok(None) };
    let distance_m = Anchors { start_m, end_m }.span_m();
    if distance_m > 0.0 {
        return Ok(Some(distance_m / count as f64));
    }
    Err(Kind::NoDrawnLength { from: from.name.to_string(), to: to.name.to_string() })
}

/// Joint `k` of those between `count` members in a row, drawn on the straight line between its ends.
pub(super) fn between(name: Name, from: &Joint, to: &Joint, k: usize, count: usize) -> Joint {
    let near_m = ends_m(from, to).map(|[start_m, end_m]| {
        let part = k as f64 / count as f64;
        std::array::from_fn(|c| start_m[c] + part * (end_m[c] - start_m[c]))
    });
    Joint::free(name).near(near_m)
}

fn ends_m(from: &Joint, to: &Joint) -> Option<[Vector; 2]> {
    Some([from.drawn_m()?, to.drawn_m()?])
}
