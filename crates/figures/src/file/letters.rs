//! Texts as outlines, in letters as wide as those that the drawings are laid out for: a machine may have none.

use std::sync::LazyLock;

use roxmltree::Node;
use tiny_skia::{PathBuilder, Rect, Transform};

use super::drawing::{Look, Shape, Text, number};
use super::font::Font;

/// Size of letters where nothing else is said, px.
pub(super) const DEFAULT_PX: f32 = 16.0;

/// DejaVu Sans Condensed, plain and bold.
static FONTS: LazyLock<[Option<Font>; 2]> = LazyLock::new(|| {
    [dejavu::sans_condensed::regular(), dejavu::sans_condensed::bold()].map(Font::new)
});

/// A text; none without a letter.
pub(super) fn text(node: Node<'_, '_>, look: &Look) -> Result<Option<Text>, String> {
    let [plain, bold] = &*FONTS;
    let [Some(plain), Some(bold)] = [plain, bold] else {
        return Err("its letters cannot be read".into());
    };
    let at = [number(node, "x")? + look.moved[0], number(node, "y")? + look.moved[1]];
    let mut line =
        Line { pen: at, outlines: vec![], letters: String::new(), top: 0.0, bottom: 0.0 };
    for piece in node.children() {
        if piece.is_text() {
            line.write([plain, bold], piece.text().unwrap_or_default(), look);
        } else {
            let shift =
                |name| if piece.has_attribute(name) { number(piece, name) } else { Ok(0.0) };
            line.pen = [line.pen[0] + shift("dx")?, line.pen[1] + shift("dy")?];
            line.write([plain, bold], piece.text().unwrap_or_default(), &look.within(piece)?);
        }
    }
    let width = line.pen[0] - at[0];
    let left = match node.attribute("text-anchor") {
        Some("middle") => -width / 2.0,
        Some("end") => -width,
        _ => 0.0,
    };
    let upwards = node.attribute("transform").is_some_and(|turn| turn.starts_with("rotate(-90 "));
    let turn = if upwards {
        Transform::from_rotate_at(-90.0, at[0], at[1])
    } else {
        Transform::identity()
    };
    let anchored = turn.pre_translate(left, 0.0);
    for shape in &mut line.outlines {
        if let Some(path) = shape.path.clone().transform(anchored) {
            shape.path = path;
        }
    }
    let within =
        Rect::from_ltrb(at[0] + left, at[1] - line.top, at[0] + left + width, at[1] + line.bottom);
    let Line { outlines, letters, .. } = line;
    Ok(within.map(|within| Text { letters, within, turn, outlines }))
}

/// A line of letters, from the left.
struct Line {
    /// Where the next letter stands.
    pen: [f32; 2],
    outlines: Vec<Shape>,
    letters: String,
    /// How far it reaches above and below where its letters stand.
    top: f32,
    bottom: f32,
}

impl Line {
    fn write(&mut self, [plain, bold]: [&Font; 2], letters: &str, look: &Look) {
        let font = if look.bold { bold } else { plain };
        let scale = look.letters_px / font.units;
        let mut path = PathBuilder::new();
        for letter in letters.chars() {
            let glyph = font.glyph(letter);
            let [x, y] = self.pen;
            let at = Transform::from_row(scale, 0.0, 0.0, -scale, x, y);
            // A blank has no outline.
            let _ = font.outline(glyph, at, &mut path);
            self.pen[0] += scale * font.advance(glyph);
        }
        self.outlines.extend(path.finish().map(|path| look.shape(path)));
        self.letters.push_str(letters);
        self.top = self.top.max(scale * font.ascender);
        self.bottom = self.bottom.max(scale * font.descender);
    }
}
