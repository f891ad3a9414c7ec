//! DXF of a drawing: lines and edges of areas as polylines, in a layer for each colour, and texts as such. A unit is a pixel, y is up;
//! rasters are left out.
//!
//! # References
//!
//! AutoCAD R12 Customization Manual, "Drawing Interchange and File Formats".

use std::fmt::Write as _;

use tiny_skia::{PathSegment, Point};

use super::drawing::{Drawing, Piece, Shape, Text};

/// Straight pieces to a curve.
const PIECES: u8 = 8;
/// What closes a polyline, in its group 70.
const CLOSED: u8 = 1;

pub(super) fn write(drawing: &Drawing) -> String {
    let mut dxf = "0\nSECTION\n2\nENTITIES\n".to_owned();
    for piece in &drawing.pieces {
        match piece {
            Piece::Shape(shape) => outline(&mut dxf, shape),
            Piece::Text(text) => words(&mut dxf, text),
            Piece::Raster { .. } => {}
        }
    }
    dxf + "0\nENDSEC\n0\nEOF\n"
}

/// Every piece of a path without a gap.
fn outline(dxf: &mut String, shape: &Shape) {
    let Some([r, g, b]) = shape.pen.as_ref().map(|pen| pen.colour).or(shape.fill) else { return };
    let layer = format!("{r:02x}{g:02x}{b:02x}");
    let mut way = vec![];
    for segment in shape.path.segments() {
        match segment {
            PathSegment::MoveTo(to) => {
                polyline(dxf, &layer, &std::mem::replace(&mut way, vec![to]), 0);
            }
            PathSegment::LineTo(to) => way.push(to),
            PathSegment::QuadTo(by, to) => curve(&mut way, [by, by, to], [2.0, 0.0]),
            PathSegment::CubicTo(by, then, to) => curve(&mut way, [by, then, to], [3.0, 3.0]),
            PathSegment::Close => {
                polyline(dxf, &layer, &way, CLOSED);
                way.truncate(1);
            }
        }
    }
    polyline(dxf, &layer, &way, 0);
}

/// Points of a Bezier curve from the last point, of the second or third degree by the factors of its inner points.
fn curve(way: &mut Vec<Point>, [by, then, to]: [Point; 3], [first, second]: [f32; 2]) {
    let Some(from) = way.last().copied() else { return };
    let third = second > 0.0;
    for piece in 1..=PIECES {
        let t = f32::from(piece) / f32::from(PIECES);
        let s = 1.0 - t;
        let weights = if third {
            [s * s * s, first * s * s * t, second * s * t * t, t * t * t]
        } else {
            [s * s, first * s * t, 0.0, t * t]
        };
        let at = |of: fn(Point) -> f32| {
            [from, by, then, to].into_iter().zip(weights).map(|(p, w)| w * of(p)).sum()
        };
        way.push(Point::from_xy(at(|p| p.x), at(|p| p.y)));
    }
}

fn polyline(dxf: &mut String, layer: &str, way: &[Point], closed: u8) {
    if way.len() < 2 {
        return;
    }
    let _ =
        write!(dxf, "0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n{closed}\n10\n0.0\n20\n0.0\n30\n0.0\n");
    for point in way {
        let _ = write!(dxf, "0\nVERTEX\n8\n{layer}\n");
        place(dxf, *point);
    }
    dxf.push_str("0\nSEQEND\n");
}

fn place(dxf: &mut String, point: Point) {
    // Not the negative zero.
    let _ = write!(dxf, "10\n{:?}\n20\n{:?}\n30\n0.0\n", point.x, 0.0 - point.y);
}

/// A text from the lower left corner of its letters, as high as these.
fn words(dxf: &mut String, text: &Text) {
    let letters = formats::export::dxf_text(&text.letters);
    let mut at = Point::from_xy(text.within.left(), text.within.bottom());
    text.turn.map_point(&mut at);
    let turn = 0.0 - text.turn.ky.atan2(text.turn.sx).to_degrees();
    dxf.push_str("0\nTEXT\n8\ntexts\n");
    place(dxf, at);
    let _ = write!(dxf, "40\n{:?}\n50\n{turn:?}\n1\n{letters}\n", text.within.height());
}
