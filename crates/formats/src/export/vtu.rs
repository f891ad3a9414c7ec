//! VTK's unstructured grid in ASCII: a line for each member, a point for each joint, both in their order.

use std::fmt::Write as _;

use model::system::Kind;

use super::{Shape, attribute, row};

/// Cell of two points.
const LINE: &str = "3";

pub(super) fn write(shape: &Shape<'_>) -> String {
    let lines: Vec<_> = shape.lines().collect();
    let mut text = head("UnstructuredGrid");
    if let Some(moving) = shape.moving {
        // The name by which VTK knows a time.
        let numbers = [("TimeValue", moving.time_s)];
        text.push_str("<FieldData>\n");
        for (name, number) in numbers.iter().chain(moving.numbers) {
            let _ = writeln!(
                text,
                "<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">\n{number:?}\n</DataArray>",
                attribute(name)
            );
        }
        text.push_str("</FieldData>\n");
    }
    let _ = writeln!(
        text,
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>",
        shape.joints_m.len(),
        lines.len()
    );
    let of_joints = |value: &dyn Fn(usize) -> String| -> Vec<String> {
        (0..shape.system.joints().len()).map(value).collect()
    };
    let of_lines =
        |value: &dyn Fn(usize) -> String| -> Vec<String> { (0..lines.len()).map(value).collect() };
    array(&mut text, "Float64", "joints_m", 3, &of_joints(&|k| row(&shape.joints_m[k])));
    text.push_str("</Points>\n<Cells>\n");
    let ends = of_lines(&|k| format!("{} {}", lines[k].ends[0], lines[k].ends[1]));
    array(&mut text, "Int64", "connectivity", 1, &ends);
    array(&mut text, "Int64", "offsets", 1, &of_lines(&|k| (2 * (k + 1)).to_string()));
    array(&mut text, "UInt8", "types", 1, &of_lines(&|_| LINE.to_owned()));
    text.push_str("</Cells>\n<PointData>\n");
    array(&mut text, "Float64", "reaction_n", 3, &of_joints(&|k| row(&shape.reactions_n[k])));
    if let Some(moving) = shape.moving {
        let speeds = of_joints(&|k| row(&moving.velocities_m_s[k]));
        array(&mut text, "Float64", "velocity_m_s", 3, &speeds);
    }
    let joints = shape.system.joints();
    array(&mut text, "Float64", "mass_kg", 1, &of_joints(&|k| row(&[joints[k].mass_kg])));
    array(&mut text, "Float64", "force_n", 3, &of_joints(&|k| row(&joints[k].force_n)));
    let held = of_joints(&|k| u8::from(joints[k].support.at_m().is_some()).to_string());
    array(&mut text, "UInt8", "held", 1, &held);
    text.push_str("</PointData>\n<CellData>\n");
    array(&mut text, "Float64", "axial_n", 1, &of_lines(&|k| row(&[lines[k].axial_n])));
    array(&mut text, "Int64", "member", 1, &of_lines(&|k| (lines[k].number + 1).to_string()));
    let kinds = of_lines(&|k| {
        let number = match lines[k].member.kind {
            Kind::Bar => 0,
            Kind::Cable => 1,
            Kind::Strut => 2,
        };
        number.to_string()
    });
    array(&mut text, "UInt8", "kind", 1, &kinds);
    let length = |k: usize| row(&[lines[k].member.body.length_m()]);
    array(&mut text, "Float64", "unstretched_m", 1, &of_lines(&length));
    if !shape.used.is_empty() {
        let part =
            |k: usize| shape.used[lines[k].number].map_or("nan".to_owned(), |part| row(&[part]));
        array(&mut text, "Float64", "utilisation", 1, &of_lines(&part));
    }
    text.push_str("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

/// The collection that names a grid for each of rising times, s.
pub fn collection(grids: impl IntoIterator<Item = (f64, String)>) -> String {
    let mut text = head("Collection");
    for (time_s, file) in grids {
        let file = attribute(&file);
        let _ = writeln!(text, "<DataSet timestep=\"{time_s:?}\" part=\"0\" file=\"{file}\"/>");
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}

fn head(kind: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"0.1\" byte_order=\"LittleEndian\">\n<{kind}>\n"
    )
}

fn array(text: &mut String, kind: &str, name: &str, components: usize, rows: &[String]) {
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">\n{}\n</DataArray>",
        rows.join("\n")
    );
}
