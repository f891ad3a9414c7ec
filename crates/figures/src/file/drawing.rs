//! A drawing read back as outlines: what [`Svg`](crate::Svg) writes, which is a small part of SVG, letters as outlines too.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use roxmltree::{Document, Node};
use tiny_skia::{Path, PathBuilder, Rect, Transform};

use super::letters;
use crate::png::Pixels;

/// A drawing as what other formats are written from.
pub(super) struct Drawing {
    /// Pixels across and down.
    pub(super) size: [f32; 2],
    pub(super) pieces: Vec<Piece>,
}

/// Each in front of those before it.
pub(super) enum Piece {
    Shape(Shape),
    Raster { within: Rect, pixels: Pixels },
    Text(Text),
}

/// An outline and how it looks.
pub(super) struct Shape {
    pub(super) path: Path,
    pub(super) fill: Option<[u8; 3]>,
    pub(super) pen: Option<Pen>,
}

/// How a line looks. Corners are round, ends are not.
#[derive(Clone)]
pub(super) struct Pen {
    pub(super) colour: [u8; 3],
    pub(super) width: f32,
    pub(super) dashes: Vec<f32>,
}

/// A text: its letters, the box that they stand in before it is turned, and the outlines, turned.
pub(super) struct Text {
    pub(super) letters: String,
    pub(super) within: Rect,
    pub(super) turn: Transform,
    /// Those with an edge have it first, under their fill.
    pub(super) outlines: Vec<Shape>,
}

/// What elements take from those around them.
#[derive(Clone)]
pub(super) struct Look {
    fill: Option<[u8; 3]>,
    pub(super) pen: Option<Pen>,
    pub(super) letters_px: f32,
    pub(super) bold: bool,
    /// Of the group, in the drawing.
    pub(super) moved: [f32; 2],
}

/// Read a drawing. The error says what is no drawing of this crate.
pub(super) fn read(svg: &str) -> Result<Drawing, String> {
    let document = Document::parse(svg).map_err(|error| error.to_string())?;
    let root = document.root_element();
    let size = [number(root, "width")?, number(root, "height")?];
    let black = Look {
        fill: Some([0; 3]),
        pen: None,
        letters_px: letters::DEFAULT_PX,
        bold: false,
        moved: [0.0; 2],
    };
    let mut drawing = Drawing { size, pieces: vec![] };
    drawing.group(root, &black.within(root)?)?;
    Ok(drawing)
}

impl Drawing {
    fn group(&mut self, group: Node<'_, '_>, look: &Look) -> Result<(), String> {
        for node in group.children().filter(Node::is_element) {
            let look = look.within(node)?;
            match node.tag_name().name() {
                "g" => self.group(node, &look)?,
                "title" | "desc" => {}
                "text" => self.pieces.extend(letters::text(node, &look)?.map(Piece::Text)),
                "image" => self.pieces.push(raster(node, look.moved)?),
                _ => {
                    let [x, y] = look.moved;
                    let path = outline(node, self.size)?;
                    // Without an extent there is nothing to see.
                    let path =
                        path.and_then(|path| path.transform(Transform::from_translate(x, y)));
                    self.pieces.extend(path.map(|path| Piece::Shape(look.shape(path))));
                }
            }
        }
        Ok(())
    }
}

impl Look {
    /// The look of an element within one that looks so.
    pub(super) fn within(&self, node: Node<'_, '_>) -> Result<Self, String> {
        let mut look = self.clone();
        if let Some(fill) = node.attribute("fill") {
            look.fill = if fill == "none" { None } else { Some(colour(fill)?) };
        }
        if let Some(stroke) = node.attribute("stroke") {
            let dashes = node.attribute("stroke-dasharray").unwrap_or_default();
            look.pen = Some(Pen {
                colour: colour(stroke)?,
                width: number(node, "stroke-width")?,
                dashes: numbers(dashes)?,
            });
        }
        if node.has_attribute("font-size") {
            look.letters_px = number(node, "font-size")?;
        }
        look.bold |= node.attribute("font-weight") == Some("bold");
        if let ("g", Some(shift)) = (node.tag_name().name(), node.attribute("transform")) {
            let by = shift.strip_prefix("translate(").and_then(|rest| rest.strip_suffix(')'));
            let [x, y] = numbers(by.unwrap_or_default())?[..] else { return Err(shift.to_owned()) };
            look.moved = [look.moved[0] + x, look.moved[1] + y];
        }
        Ok(look)
    }

    /// An outline that looks so.
    pub(super) fn shape(&self, path: Path) -> Shape {
        Shape { path, fill: self.fill, pen: self.pen.clone() }
    }
}

fn outline(node: Node<'_, '_>, size: [f32; 2]) -> Result<Option<Path>, String> {
    let of = |name| number(node, name);
    let mut path = PathBuilder::new();
    match node.tag_name().name() {
        "line" => {
            path.move_to(of("x1")?, of("y1")?);
            path.line_to(of("x2")?, of("y2")?);
        }
        "polyline" => points(&mut path, node)?,
        "polygon" => {
            points(&mut path, node)?;
            path.close();
        }
        "path" => commands(&mut path, node.attribute("d").unwrap_or_default())?,
        // The ground of all.
        "rect" if node.attribute("width") == Some("100%") => {
            path.push_rect(rectangle([0.0; 2], size)?);
        }
        "rect" => {
            path.push_rect(rectangle([of("x")?, of("y")?], [of("width")?, of("height")?])?);
        }
        "circle" => path.push_circle(of("cx")?, of("cy")?, of("r")?),
        other => return Err(format!("an element <{other}>")),
    }
    Ok(path.finish())
}

fn rectangle([x, y]: [f32; 2], [width, height]: [f32; 2]) -> Result<Rect, String> {
    Rect::from_xywh(x, y, width, height).ok_or_else(|| format!("a box of {width} by {height}"))
}

fn points(path: &mut PathBuilder, node: Node<'_, '_>) -> Result<(), String> {
    for (number, at) in
        numbers(node.attribute("points").unwrap_or_default())?.chunks_exact(2).enumerate()
    {
        if number == 0 {
            path.move_to(at[0], at[1]);
        } else {
            path.line_to(at[0], at[1]);
        }
    }
    Ok(())
}

/// `M`, `L`, `H`, `V` and `z`, each with its numbers.
fn commands(path: &mut PathBuilder, text: &str) -> Result<(), String> {
    let mut rest = text;
    while let Some(command) = rest.chars().next() {
        let tail = &rest[command.len_utf8()..];
        let (own, next) = tail.split_at(tail.find(char::is_alphabetic).unwrap_or(tail.len()));
        let last = path.last_point().unwrap_or_default();
        match (command, &numbers(own)?[..]) {
            ('M', &[x, y]) => path.move_to(x, y),
            ('L', &[x, y]) => path.line_to(x, y),
            ('H', &[x]) => path.line_to(x, last.y),
            ('V', &[y]) => path.line_to(last.x, y),
            ('z', []) => path.close(),
            _ => return Err(format!("a path with {command}{own}")),
        }
        rest = next;
    }
    Ok(())
}

fn raster(node: Node<'_, '_>, [x, y]: [f32; 2]) -> Result<Piece, String> {
    let of = |name| number(node, name);
    let within = rectangle([of("x")? + x, of("y")? + y], [of("width")?, of("height")?])?;
    let coded = node.attribute("href").and_then(|href| href.strip_prefix("data:image/png;base64,"));
    let file = BASE64_STANDARD.decode(coded.unwrap_or_default()).map_err(|error| error.to_string());
    let pixels = Pixels::read(&file?).ok_or("a raster that this crate did not write")?;
    Ok(Piece::Raster { within, pixels })
}

pub(super) fn number(node: Node<'_, '_>, name: &str) -> Result<f32, String> {
    let text = node.attribute(name).unwrap_or_default();
    text.parse().map_err(|_| format!("{name}=\"{text}\" of <{}>", node.tag_name().name()))
}

fn numbers(text: &str) -> Result<Vec<f32>, String> {
    let words = text.split([' ', ',']).filter(|word| !word.is_empty());
    words
        .map(|word| word.parse().map_err(|_| format!("{word:?} in the place of a number")))
        .collect()
}

/// Three pairs of hexadecimal digits.
fn colour(text: &str) -> Result<[u8; 3], String> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
    let number = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    let [_, r, g, b] = number.ok_or_else(|| format!("the colour {text:?}"))?.to_be_bytes();
    Ok([r, g, b])
}
