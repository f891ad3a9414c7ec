//! PDF of a drawing: its shapes and rasters, letters as outlines. Behind these stand the same texts unseen, so that they are found
//! and copied.
//!
//! # References
//!
//! ISO 32000-1:2008, sections 8.4 and 8.5 (graphics), 9.3.6 (text that is not shown) and 9.10.3 (what its codes mean).

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{LineCapStyle, LineJoinStyle, SystemInfo, TextRenderingMode, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect, Ref, Str};
use resvg::tiny_skia::{PathSegment, Pixmap};
use resvg::usvg::{
    self, FillRule, Group, ImageKind, LineCap, LineJoin, Node, Paint, PaintOrder, Stroke, Tree,
};

/// Points to a pixel of the drawing: 96 px to an inch, as CSS has it.
const POINTS: f32 = 0.75;
/// Effort of the compression: that of zlib's default.
const EFFORT: u8 = 6;
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
struct Drawn {
    content: Content,
    rasters: Vec<Pixmap>,
    /// The letters that the codes of the unseen font stand for, from 1.
    letters: Vec<char>,
}

/// The file; none where a raster cannot be read.
pub(super) fn write(tree: &Tree) -> Option<Vec<u8>> {
    let [width, height] = [tree.size().width(), tree.size().height()].map(|px| POINTS * px);
    let mut drawn = Drawn { content: Content::new(), rasters: vec![], letters: vec![] };
    drawn.content.transform([POINTS, 0.0, 0.0, -POINTS, 0.0, height]);
    drawn.group(tree.root())?;
    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, width, height));
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
    for (pixmap, at) in drawn.rasters.iter().zip(RASTER..) {
        let colours: Vec<u8> =
            pixmap.pixels().iter().flat_map(|c| [c.red(), c.green(), c.blue()]).collect();
        let packed = compress_to_vec_zlib(&colours, EFFORT);
        let [across, down] = [pixmap.width(), pixmap.height()].map(|n| i32::try_from(n).ok());
        let mut raster = pdf.image_xobject(Ref::new(at), &packed);
        raster.filter(Filter::FlateDecode);
        raster.width(across?).height(down?).bits_per_component(8);
        raster.color_space().device_rgb();
    }
    font(&mut pdf, &drawn.letters);
    Some(pdf.finish())
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

impl Drawn {
    fn group(&mut self, group: &Group) -> Option<()> {
        let at = group.transform();
        self.content.save_state();
        self.content.transform([at.sx, at.ky, at.kx, at.sy, at.tx, at.ty]);
        for node in group.children() {
            match node {
                Node::Group(inner) => self.group(inner)?,
                Node::Path(path) => self.path(path),
                Node::Image(image) => self.raster(image)?,
                Node::Text(text) => {
                    self.unseen(text);
                    self.group(text.flattened())?;
                }
            }
        }
        self.content.restore_state();
        Some(())
    }

    fn path(&mut self, path: &usvg::Path) {
        let even_odd = path.fill().is_some_and(|fill| fill.rule() == FillRule::EvenOdd);
        let fill = path.fill().map(|fill| rgb(fill.paint()));
        let stroke = path.stroke();
        if let Some([r, g, b]) = fill {
            self.content.set_fill_rgb(r, g, b);
        }
        if let Some(stroke) = stroke {
            self.pen(stroke);
        }
        self.outline(path);
        match (fill, stroke, even_odd) {
            (Some(_), Some(_), _) if path.paint_order() == PaintOrder::StrokeAndFill => {
                self.content.stroke();
                self.outline(path);
                self.content.fill_nonzero()
            }
            (Some(_), Some(_), true) => self.content.fill_even_odd_and_stroke(),
            (Some(_), Some(_), false) => self.content.fill_nonzero_and_stroke(),
            (Some(_), None, true) => self.content.fill_even_odd(),
            (Some(_), None, false) => self.content.fill_nonzero(),
            (None, Some(_), _) => self.content.stroke(),
            (None, None, _) => self.content.end_path(),
        };
    }

    fn pen(&mut self, stroke: &Stroke) {
        let [r, g, b] = rgb(stroke.paint());
        self.content.set_stroke_rgb(r, g, b).set_line_width(stroke.width().get());
        self.content.set_line_cap(match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        });
        self.content.set_line_join(match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
        });
        self.content.set_miter_limit(stroke.miterlimit().get());
        let dashes = stroke.dasharray().unwrap_or_default();
        self.content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
    }

    fn outline(&mut self, path: &usvg::Path) {
        let mut last = [0.0; 2];
        for segment in path.data().segments() {
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

    fn raster(&mut self, raster: &usvg::Image) -> Option<()> {
        let ImageKind::PNG(bytes) = raster.kind() else { return None };
        let (width, height) = (raster.size().width(), raster.size().height());
        self.content.save_state().transform([width, 0.0, 0.0, -height, 0.0, height]);
        self.content.x_object(Name(image(self.rasters.len()).as_bytes())).restore_state();
        self.rasters.push(Pixmap::decode_png(bytes).ok()?);
        Some(())
    }

    /// The text within the box of its letters.
    fn unseen(&mut self, text: &usvg::Text) {
        let within = text.bounding_box();
        let letters = text.chunks().iter().flat_map(|chunk| chunk.text().chars());
        let codes: Vec<u8> = letters.filter_map(|letter| self.code(letter)).collect();
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

/// From 0 to 1; the drawings have no other paints than colours.
fn rgb(paint: &Paint) -> [f32; 3] {
    match paint {
        Paint::Color(colour) => {
            [colour.red, colour.green, colour.blue].map(|x| f32::from(x) / 255.0)
        }
        _ => [0.5; 3],
    }
}
