//! PDF of a drawing: its shapes and rasters, letters as outlines. Behind these stand the same texts unseen, so that they are found
//! and copied.
//!
//! # References
//!
//! ISO 32000-1:2008, sections 8.4 and 8.5 (graphics), 9.3.6 (text that is not shown) and 9.10.3 (what its codes mean).

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{LineJoinStyle, SystemInfo, TextRenderingMode, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Ref, Str};
use tiny_skia::{PathSegment, Rect};

use super::drawing::{Drawing, Pen, Piece, Shape, Text};
use crate::png::{EFFORT, Pixels};

/// Points to a pixel of the drawing: 96 px to an inch, as CSS has it.
const POINTS: f32 = 0.75;
/// Width of every letter of the unseen font, in thousandths of its size.
const WIDTH: f32 = 500.0;
const FONT: Name<'_> = Name(b"F");
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const LETTERS: Ref = Ref::new(5);
const MEANING: Ref = Ref::new(6);
/// The first of the rasters.
const RASTER: i32 = 7;

/// What is collected while the drawing is gone through.
struct Drawn<'a> {
    content: Content,
    rasters: Vec<&'a Pixels>,
    /// The letters that the codes of the unseen font stand for, from 1.
    letters: Vec<char>,
}

/// The file.
pub(super) fn write(drawing: &Drawing) -> Vec<u8> {
    let [width, height] = drawing.size.map(|px| POINTS * px);
    let mut drawn = Drawn { content: Content::new(), rasters: vec![], letters: vec![] };
    drawn.content.transform([POINTS, 0.0, 0.0, -POINTS, 0.0, height]);
    drawn.content.set_line_join(LineJoinStyle::RoundJoin);
    for piece in &drawing.pieces {
        match piece {
            Piece::Shape(shape) => drawn.shape(shape),
            Piece::Raster { within, pixels } => drawn.raster(*within, pixels),
            Piece::Text(text) => drawn.text(text),
        }
    }
    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.media_box(pdf_writer::Rect::new(0.0, 0.0, width, height));
    page.parent(PAGES).contents(CONTENT);
    let mut resources = page.resources();
    resources.fonts().pair(FONT, LETTERS);
    let mut images = resources.x_objects();
    for (name, at) in (0..drawn.rasters.len()).zip(RASTER..) {
        images.pair(Name(image(name).as_bytes()), Ref::new(at));
    }
    images.finish();
    resources.finish();
    page.finish();
    let packed = compress_to_vec_zlib(drawn.content.finish().as_slice(), EFFORT);
    pdf.stream(CONTENT, &packed).filter(Filter::FlateDecode);
    for (pixels, at) in drawn.rasters.iter().zip(RASTER..) {
        let packed = compress_to_vec_zlib(&pixels.rgb, EFFORT);
        let mut raster = pdf.image_xobject(Ref::new(at), &packed);
        raster.filter(Filter::FlateDecode);
        raster.width(pixels.width.cast_signed()).height(pixels.height.cast_signed());
        raster.bits_per_component(8).color_space().device_rgb();
    }
    font(&mut pdf, &drawn.letters);
    pdf.finish()
}

/// The font of the texts that are not shown, and what its codes mean.
fn font(pdf: &mut Pdf, letters: &[char]) {
    let mut meaning = UnicodeCmap::<u8>::new(
        Name(b"Letters"),
        SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"UCS"), supplement: 0 },
    );
    for (letter, code) in letters.iter().zip(1..) {
        meaning.pair(code, *letter);
    }
    pdf.cmap(MEANING, meaning.finish().as_slice());
    let mut font = pdf.type1_font(LETTERS);
    font.base_font(Name(b"Helvetica")).to_unicode(MEANING);
    font.first_char(0).last_char(u8::MAX).widths([WIDTH; 256]);
}

fn image(number: usize) -> String {
    format!("I{number}")
}

impl<'a> Drawn<'a> {
    fn shape(&mut self, shape: &Shape) {
        self.looks(shape);
        self.outline(shape);
        match (shape.fill, &shape.pen) {
            (Some(_), Some(_)) => self.content.fill_nonzero_and_stroke(),
            (Some(_), None) => self.content.fill_nonzero(),
            (None, Some(_)) => self.content.stroke(),
            (None, None) => self.content.end_path(),
        };
    }

    fn looks(&mut self, shape: &Shape) {
        if let Some([r, g, b]) = shape.fill.map(rgb) {
            self.content.set_fill_rgb(r, g, b);
        }
        if let Some(Pen { colour, width, dashes }) = &shape.pen {
            let [r, g, b] = rgb(*colour);
            self.content.set_stroke_rgb(r, g, b).set_line_width(*width);
            self.content.set_dash_pattern(dashes.iter().copied(), 0.0);
        }
    }

    fn outline(&mut self, shape: &Shape) {
        let mut last = [0.0; 2];
        for segment in shape.path.segments() {
            let to = match segment {
                PathSegment::MoveTo(p) => {
                    self.content.move_to(p.x, p.y);
                    p
                }
                PathSegment::LineTo(p) => {
                    self.content.line_to(p.x, p.y);
                    p
                }
                PathSegment::QuadTo(c, p) => {
                    // The same curve as one of the third degree.
                    let two_thirds = |a: f32, b: f32| a + 2.0 / 3.0 * (b - a);
                    let (x1, y1) = (two_thirds(last[0], c.x), two_thirds(last[1], c.y));
                    let (x2, y2) = (two_thirds(p.x, c.x), two_thirds(p.y, c.y));
                    self.content.cubic_to(x1, y1, x2, y2, p.x, p.y);
                    p
                }
                PathSegment::CubicTo(c, d, p) => {
                    self.content.cubic_to(c.x, c.y, d.x, d.y, p.x, p.y);
                    p
                }
                PathSegment::Close => {
                    self.content.close_path();
                    continue;
                }
            };
            last = [to.x, to.y];
        }
    }

    fn raster(&mut self, within: Rect, pixels: &'a Pixels) {
        let to = [within.width(), 0.0, 0.0, -within.height(), within.left(), within.bottom()];
        self.content.save_state().transform(to);
        self.content.x_object(Name(image(self.rasters.len()).as_bytes())).restore_state();
        self.rasters.push(pixels);
    }

    /// The outlines of the letters, edges first, and the text unseen within its box.
    fn text(&mut self, text: &Text) {
        let turn = text.turn;
        self.content.save_state();
        self.content.transform([turn.sx, turn.ky, turn.kx, turn.sy, turn.tx, turn.ty]);
        self.unseen(text);
        self.content.restore_state();
        for letters in &text.outlines {
            self.looks(letters);
            if letters.pen.is_some() {
                self.outline(letters);
                self.content.stroke();
            }
            self.outline(letters);
            self.content.fill_nonzero();
        }
    }

    fn unseen(&mut self, Text { letters, within, .. }: &Text) {
        let codes: Vec<u8> = letters.chars().filter_map(|letter| self.code(letter)).collect();
        let natural = WIDTH / 1000.0 * within.height() * codes.len() as f32;
        if codes.is_empty() || natural <= 0.0 {
            return;
        }
        self.content.begin_text().set_text_rendering_mode(TextRenderingMode::Invisible);
        self.content.set_font(FONT, within.height());
        self.content.set_horizontal_scaling(100.0 * within.width() / natural);
        self.content.set_text_matrix([1.0, 0.0, 0.0, -1.0, within.left(), within.bottom()]);
        self.content.show(Str(&codes)).end_text();
    }

    /// The code of a letter; none of the 256th and later ones.
    fn code(&mut self, letter: char) -> Option<u8> {
        let known = self.letters.iter().position(|known| *known == letter);
        let at = known.unwrap_or_else(|| {
            self.letters.push(letter);
            self.letters.len() - 1
        });
        u8::try_from(at + 1).ok()
    }
}

/// From 0 to 1.
fn rgb(colour: [u8; 3]) -> [f32; 3] {
    colour.map(|x| f32::from(x) / 255.0)
}
