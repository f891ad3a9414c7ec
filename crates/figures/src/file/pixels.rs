//! A drawing as pixels.

use tiny_skia::{
    Color, FillRule, FilterQuality, LineJoin, Paint, Pixmap, PixmapPaint, Size, Stroke, StrokeDash,
    Transform,
};

use super::drawing::{Drawing, Pen, Piece, Shape};
use crate::png::{self, Pixels};

/// Pixels of a PNG to one of the drawing.
const SCALE: f32 = 2.0;
/// Most pixels: 256 MB in memory. Larger drawings are scaled less.
const MOST: f32 = 6.4e7;

/// The file; none where there is no room for its pixels.
pub(super) fn write(drawing: &Drawing) -> Option<Vec<u8>> {
    let [width, height] = drawing.size;
    let scale = SCALE.min((MOST / (width * height)).sqrt());
    let size = Size::from_wh(width, height)?.to_int_size().scale_by(scale)?;
    let mut pixmap = Pixmap::new(size.width(), size.height())?;
    pixmap.fill(Color::WHITE);
    let scaled = Transform::from_scale(scale, scale);
    for piece in &drawing.pieces {
        match piece {
            Piece::Shape(shape) => {
                fill(&mut pixmap, shape, scaled);
                stroke(&mut pixmap, shape, scaled);
            }
            Piece::Text(text) => {
                for letters in &text.outlines {
                    stroke(&mut pixmap, letters, scaled);
                    fill(&mut pixmap, letters, scaled);
                }
            }
            Piece::Raster { within, pixels } => {
                let own = raster(pixels)?;
                let sides =
                    [within.width() / own.width() as f32, within.height() / own.height() as f32];
                let at =
                    scaled.pre_translate(within.left(), within.top()).pre_scale(sides[0], sides[1]);
                let sharp =
                    PixmapPaint { quality: FilterQuality::Nearest, ..PixmapPaint::default() };
                pixmap.draw_pixmap(0, 0, own.as_ref(), &sharp, at, None);
            }
        }
    }
    // With their opacity, which is whole: as they lie in memory.
    Some(png::opaque([size.width(), size.height()], pixmap.data()))
}

fn fill(pixmap: &mut Pixmap, shape: &Shape, at: Transform) {
    if let Some(colour) = shape.fill {
        pixmap.fill_path(&shape.path, &paint(colour), FillRule::Winding, at, None);
    }
}

fn stroke(pixmap: &mut Pixmap, shape: &Shape, at: Transform) {
    if let Some(Pen { colour, width, dashes }) = &shape.pen {
        let dash = StrokeDash::new(dashes.clone(), 0.0);
        let pen = Stroke { width: *width, line_join: LineJoin::Round, dash, ..Stroke::default() };
        pixmap.stroke_path(&shape.path, &paint(*colour), &pen, at, None);
    }
}

fn paint([r, g, b]: [u8; 3]) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, u8::MAX);
    paint
}

fn raster(pixels: &Pixels) -> Option<Pixmap> {
    let mut pixmap = Pixmap::new(pixels.width, pixels.height)?;
    let (to, from) = (pixmap.data_mut().chunks_exact_mut(4), pixels.rgb.chunks_exact(3));
    for (to, from) in to.zip(from) {
        to[..3].copy_from_slice(from);
        to[3] = u8::MAX;
    }
    Some(pixmap)
}
