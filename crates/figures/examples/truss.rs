//! Draw a truss with its forces: `cargo run -p figures --example truss > truss.svg`

use figures::{Joint, Member, Seen, Structure, StructureError, Support};

fn main() -> Result<(), StructureError> {
    let load = [0.0, 0.0, -1000.0];
    let up = [0.0, 0.0, 500.0];
    let joints = [
        Joint { support: Some(Support::Fixed), reaction_n: up, ..Joint::free("A", [0.0; 3]) },
        Joint { load_n: load, ..Joint::free("B", [2.0, 0.0, 0.0]) },
        Joint {
            support: Some(Support::Plane([0.0, 0.0, 1.0])),
            reaction_n: up,
            ..Joint::free("C", [4.0, 0.0, 0.0])
        },
        Joint::free("D", [1.0, 0.0, 1.5]),
        Joint::free("E", [3.0, 0.0, 1.5]),
    ];
    // By the method of joints.
    let slope = 1.0_f64.hypot(1.5);
    let diagonal = 500.0 * slope / 1.5;
    let chord = 500.0 / 1.5;
    let forces = [
        ([0, 1], chord),
        ([1, 2], chord),
        ([3, 4], -2.0 * chord),
        ([0, 3], -diagonal),
        ([3, 1], diagonal),
        ([1, 4], diagonal),
        ([4, 2], -diagonal),
    ];
    let members = forces.map(|(joints, axial_n)| Member {
        joints,
        axial_n: Some(axial_n),
        ..Member::default()
    });
    let note = "weights left out";
    let truss = Structure {
        title: "a truss",
        note,
        joints: &joints,
        members: &members,
        floor_m: None,
        seen: Seen::Best,
    };
    print!("{}", truss.svg()?);
    Ok(())
}
