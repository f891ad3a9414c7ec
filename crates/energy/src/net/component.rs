//! Parts of a system that hang together, and what holds them.

use model::Vector;
use model::system::System;

use crate::error::Error;
use crate::net::frame::{Frame, Spot};
use crate::thresholds::{NO_STRAIN, ZERO};
use crate::vector::{along, dot, norm, scaled, unit};

/// The representative of a joint's part.
fn root(parent: &mut [usize], mut joint: usize) -> usize {
    while parent[joint] != joint {
        parent[joint] = parent[parent[joint]];
        joint = parent[joint];
    }
    joint
}

/// For each joint the smallest number of a joint of its part.
fn parts(frame: &Frame) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..frame.spots.len()).collect();
    for rod in frame.rods.iter().filter(|rod| !rod.ground) {
        let (a, b) = (root(&mut parent, rod.from), root(&mut parent, rod.to));
        parent[a.max(b)] = a.min(b);
    }
    (0..parent.len()).map(|joint| root(&mut parent, joint)).collect()
}

/// The part of a space that a support leaves free.
fn left_free(space: Vec<Vector>, spot: &Spot) -> Vec<Vector> {
    let mut space = space;
    for k in 0..3 {
        let mut normal = [0.0; 3];
        normal[k] = 1.0;
        for axis in &spot.axes[..spot.freedom] {
            normal = along(normal, -dot(normal, *axis), *axis);
        }
        let shadow = space.iter().fold([0.0; 3], |sum, b| along(sum, dot(normal, *b), *b));
        if norm(shadow) < ZERO {
            continue;
        }
        let shadow = scaled(1.0 / norm(shadow), shadow);
        let mut rest: Vec<Vector> = Vec::new();
        for b in space {
            let mut b = along(b, -dot(b, shadow), shadow);
            for other in &rest {
                b = along(b, -dot(b, *other), *other);
            }
            if norm(b) > ZERO.sqrt()
                && let Some(b) = unit(b)
            {
                rest.push(b);
            }
        }
        space = rest;
    }
    space
}

/// Refuse a part that its supports leave free to move along its load.
pub(super) fn check_held(system: &System, frame: &Frame) -> Result<(), Error> {
    let part = parts(frame);
    let all = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut space: Vec<Option<Vec<Vector>>> = vec![None; part.len()];
    let mut load = vec![[0.0; 3]; part.len()];
    for (joint, &root) in part.iter().enumerate() {
        let here = space[root].take().unwrap_or_else(|| all.clone());
        let spot = &frame.spots[joint];
        space[root] = Some(if spot.freedom == 3 { here } else { left_free(here, spot) });
        load[root] = along(load[root], 1.0, frame.loads[joint]);
    }
    let has_floor = frame.has_floor();
    for (joint, space) in space.into_iter().enumerate() {
        let free = space.unwrap_or_default();
        let onto = |v: Vector| free.iter().fold([0.0; 3], |sum, b| along(sum, dot(v, *b), *b));
        let (mut way, down) = (onto(load[joint]), onto([0.0, 0.0, -1.0]));
        if has_floor && way[2] < 0.0 {
            // The floor ends what falls.
            way = along(way, -dot(way, down) / dot(down, down), down);
        }
        let falling = norm(way);
        if falling > NO_STRAIN {
            let joint = system.joints()[joint].name.to_string();
            return Err(Error::Falls { joint, force_n: falling * frame.force_n });
        }
    }
    Ok(())
}
