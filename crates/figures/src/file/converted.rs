//! A drawing as shapes, with the outlines of its letters, and as pixels.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};

use super::{FormatError, dxf, pdf};

/// Pixels of a PNG to one of the drawing.
const SCALE: f32 = 2.0;
/// Most pixels: 256 MB in memory. Larger drawings are scaled less.
const MOST: f32 = 6.4e7;

/// Letters as wide as those that the drawings are laid out for.
static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    for font in [dejavu::sans_condensed::regular(), dejavu::sans_condensed::bold()] {
        fonts.load_font_data(font.to_vec());
    }
    let family = fonts.faces().find_map(|face| Some(face.families.first()?.0.clone()));
    fonts.set_sans_serif_family(family.unwrap_or_default());
    Arc::new(fonts)
});

#[expect(clippy::needless_pass_by_value, reason = "what errors are mapped by")]
fn failed(why: impl ToString) -> FormatError {
    FormatError::NotConverted(why.to_string())
}

fn tree(svg: &str) -> Result<Tree, FormatError> {
    let options = Options { fontdb: Arc::clone(&FONTS), ..Options::default() };
    Tree::from_str(svg, &options).map_err(failed)
}

pub(super) fn png(svg: &str) -> Result<Vec<u8>, FormatError> {
    let tree = tree(svg)?;
    let size = tree.size();
    let scale = SCALE.min((MOST / (size.width() * size.height())).sqrt());
    let pixels = size.to_int_size().scale_by(scale).ok_or_else(|| failed("no pixels"))?;
    let mut pixmap =
        Pixmap::new(pixels.width(), pixels.height()).ok_or_else(|| failed("too large"))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(failed)
}

pub(super) fn pdf(svg: &str) -> Result<Vec<u8>, FormatError> {
    pdf::write(&tree(svg)?).ok_or_else(|| failed("a raster cannot be read"))
}

pub(super) fn dxf(svg: &str) -> Result<Vec<u8>, FormatError> {
    Ok(dxf::write(&tree(svg)?).into_bytes())
}
