//! Pictures as files: SVG as it is drawn, PNG, PDF and DXF of that.

#[cfg(feature = "png-pdf")]
mod drawing;
#[cfg(feature = "png-pdf")]
mod dxf;
#[cfg(feature = "png-pdf")]
mod font;
#[cfg(feature = "png-pdf")]
mod letters;
#[cfg(feature = "png-pdf")]
mod pdf;
#[cfg(feature = "png-pdf")]
mod pixels;

/// What a picture is written as.
///
/// ```
/// use figures::{Format, Svg};
/// let svg = Svg::new([200.0, 100.0], "white").finish();
/// assert_eq!(Format::of_ending("SVG"), Some(Format::Svg));
/// assert_eq!(Format::Svg.file(&svg).unwrap(), svg.as_bytes());
/// match Format::Png.file(&svg) {
///     Ok(png) => assert!(png.starts_with(b"\x89PNG")),
///     Err(error) => assert!(error.to_string().contains("feature `png-pdf`")),
/// }
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// The drawing itself.
    Svg,
    /// Two pixels to a side of each of the drawing's, on white.
    Png,
    /// A page as large as the drawing, 96 px to an inch; its texts can be searched.
    Pdf,
    /// Lines and texts for CAD, in a layer for each colour; a unit is a pixel. Rasters are left out.
    Dxf,
}

/// Why a picture is not written in a format.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// Occurs when the crate is built without its feature `png-pdf`.
    #[error("PNG, PDF and DXF of pictures are not in this build: it lacks the feature `png-pdf`")]
    NotBuilt,
    /// Occurs when the drawing cannot be converted: it is too large, or no drawing of this crate.
    #[error("the picture cannot be converted: {0}")]
    NotConverted(String),
}

impl Format {
    /// Endings of the files, for help texts.
    pub const ENDINGS: [&str; 4] = ["svg", "png", "pdf", "dxf"];

    /// The format that the ending of a file's name stands for.
    pub fn of_ending(ending: &str) -> Option<Self> {
        let number = Self::ENDINGS.iter().position(|known| ending.eq_ignore_ascii_case(known))?;
        [Self::Svg, Self::Png, Self::Pdf, Self::Dxf].get(number).copied()
    }

    /// The bytes of a file with this drawing, one that [`Svg`](crate::Svg) has written. PNG and PDF have the letters of
    /// `DejaVu Sans Condensed`, whatever the machine has, one after the other; characters that it lacks are shown as boxes.
    ///
    /// # Errors
    /// [`FormatError`] of all but SVG.
    pub fn file(self, svg: &str) -> Result<Vec<u8>, FormatError> {
        if self == Self::Svg {
            return Ok(svg.as_bytes().to_vec());
        }
        #[cfg(not(feature = "png-pdf"))]
        return Err(FormatError::NotBuilt);
        #[cfg(feature = "png-pdf")]
        self.converted(svg).map_err(FormatError::NotConverted)
    }

    #[cfg(feature = "png-pdf")]
    fn converted(self, svg: &str) -> Result<Vec<u8>, String> {
        let drawing = drawing::read(svg)?;
        match self {
            Self::Svg | Self::Png => pixels::write(&drawing).ok_or("it is too large".into()),
            Self::Pdf => Ok(pdf::write(&drawing)),
            Self::Dxf => Ok(dxf::write(&drawing).into_bytes()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Anchor, Colour, Look, Raster, Svg};

    fn drawing() -> String {
        let mut svg = Svg::new([200.0, 100.0], "a");
        svg.rectangle(Look::fill(Colour([200, 0, 0])), [10.0, 10.0], [40.0, 20.0]);
        svg.text(Look::fill(Colour::BLACK), [150.0, 60.0], Anchor::Middle, "\u{2212}25 °C <Grüße>");
        let palette = [Colour([0, 0, 250]), Colour([0, 120, 0])];
        let raster = Raster { width: 2, height: 1, pixels: &[0, 1], palette: &palette };
        svg.raster([10.0, 50.0], [40.0, 40.0], &raster);
        svg.finish()
    }

    #[test]
    fn what_is_not_built_is_refused() {
        let built = cfg!(feature = "png-pdf");
        for format in [Format::Png, Format::Pdf, Format::Dxf] {
            assert_eq!(format.file(&drawing()).is_ok(), built);
        }
        for broken in ["<svg", "<svg/>", "<svg width=\"9\" height=\"9\"><ellipse/></svg>"] {
            let said = Format::Png.file(broken).unwrap_err().to_string();
            assert!(said.contains(if built { "cannot be converted" } else { "not in this build" }));
        }
    }

    /// Colours of a PNG without filters, red, green and blue, rows from the top; all of them opaque.
    #[cfg(feature = "png-pdf")]
    fn decoded(png: &[u8]) -> ([u32; 2], Vec<[u8; 3]>) {
        let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
        let [width, height] = [side(16), side(20)];
        let at = png.windows(4).position(|name| name == b"IDAT").unwrap();
        let packed = &png[at + 4..at + 4 + side(at - 4) as usize];
        let rows = miniz_oxide::inflate::decompress_to_vec_zlib(packed).unwrap();
        let rows = rows.chunks(4 * width as usize + 1);
        assert!(rows.clone().all(|row| row[0] == 0));
        let colours = rows.flat_map(|row| row[1..].as_chunks().0).map(|&[r, g, b, opacity]| {
            assert_eq!(opacity, 255);
            [r, g, b]
        });
        ([width, height], colours.collect())
    }

    #[cfg(feature = "png-pdf")]
    #[test]
    fn pixels_are_those_of_the_drawing() {
        let png = Format::Png.file(&drawing()).unwrap();
        let ([width, height], colours) = decoded(&png);
        assert_eq!((width, height), (400, 200));
        let at = |x: usize, y: usize| colours[400 * y + x];
        assert_eq!((at(0, 0), at(60, 40)), ([255; 3], [200, 0, 0]));
        // Both pixels of the raster, sharp at their edge.
        assert_eq!((at(58, 140), at(62, 140)), ([0, 0, 250], [0, 120, 0]));
        let dark = |x: std::ops::Range<usize>| {
            let within = x.flat_map(|x| (100..124).map(move |y| (x, y)));
            within.filter(|(x, y)| at(*x, *y)[0] < 100).count()
        };
        // The text is centred on x = 300, some 100 px of letters to each side, of strokes 2 px wide.
        assert!(
            dark(200..300) > 300 && dark(300..400) > 300,
            "{} {}",
            dark(200..300),
            dark(300..400)
        );
        assert_eq!(dark(110..180), 0);
    }

    /// A letter of its own, one that is put together from two, one beyond the first 65,536, and one that is missing, from the left:
    /// rows of pixels above the first are of the second alone.
    #[cfg(feature = "png-pdf")]
    #[test]
    fn letters_are_those_of_the_font() {
        let mut svg = Svg::new([160.0, 40.0], "");
        for (x, letter) in [(0.0, "A"), (40.0, "\u{c4}"), (80.0, "\u{1d7d9}"), (120.0, "\u{4e2d}")]
        {
            svg.text(Look::fill(Colour::BLACK).size(30.0), [x, 36.0], Anchor::Start, letter);
        }
        let (_, colours) = decoded(&Format::Png.file(&svg.finish()).unwrap());
        let dark = |k: usize, rows: std::ops::Range<usize>| {
            let within = rows.flat_map(|y| (80 * k..80 * k + 80).map(move |x| (x, y)));
            within.filter(|(x, y)| colours[320 * y + x][0] < 100).count()
        };
        assert_eq!(
            (0..4).map(|k| dark(k, 0..25) > 0).collect::<Vec<_>>(),
            [false, true, false, false]
        );
        assert!(dark(1, 0..25) > 20 && dark(1, 30..80) == dark(0, 30..80));
        // A box is as good as empty inside.
        assert!(dark(2, 25..80) > 200 && dark(3, 40..60) < dark(3, 25..80) / 3);
    }

    #[cfg(feature = "png-pdf")]
    #[test]
    fn a_page_has_the_size_of_the_drawing() {
        let pdf = Format::Pdf.file(&drawing()).unwrap();
        assert_eq!(pdf, Format::Pdf.file(&drawing()).unwrap());
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.starts_with("%PDF-") && text.contains("/MediaBox [0 0 150 75]"));
        assert!(text.contains("/Width 2") && text.trim_end().ends_with("%%EOF"));
        // The minus is among the letters of the texts.
        assert!(text.contains("<2212>"));
    }

    /// A rectangle of 40 by 20 px, 10 px from the left and from the top.
    #[cfg(feature = "png-pdf")]
    #[test]
    fn a_drawing_for_cad_has_lines_and_texts() {
        let dxf = String::from_utf8(Format::Dxf.file(&drawing()).unwrap()).unwrap();
        let corner =
            |x: &str, y: &str| format!("0\nVERTEX\n8\nc80000\n10\n{x}\n20\n{y}\n30\n0.0\n");
        for (x, y) in [("10.0", "-10.0"), ("50.0", "-10.0"), ("50.0", "-30.0"), ("10.0", "-30.0")] {
            assert!(dxf.contains(&corner(x, y)), "{dxf}");
        }
        assert!(
            dxf.contains("8\ntexts\n")
                && dxf.contains("1\n\\U+221225 \\U+00B0C <Gr\\U+00FC\\U+00DFe>\n"),
            "{dxf}"
        );
        assert!(dxf.ends_with("0\nEOF\n"));
    }
}
