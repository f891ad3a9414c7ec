//! Rasters as PNG.
//!
//! # References
//!
//! PNG specification, third edition (W3C 2025), sections 5, 10 and 11.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;

use crate::look::Colour;

/// A raster of indices into a palette of at most 256 colours, rows from the top.
#[derive(Debug, Clone, Copy)]
pub struct Raster<'a> {
    /// Pixels along the upper edge.
    pub width: u32,
    /// Pixels along the left edge.
    pub height: u32,
    /// For each pixel, row by row, the number of its colour.
    pub pixels: &'a [u8],
    /// The colours.
    pub palette: &'a [Colour],
}

/// Effort of the compression, from 0 to 10: that of zlib's default.
pub(crate) const EFFORT: u8 = 6;

/// Colours of pixels, rows from the top: red, green, blue.
#[cfg(feature = "png-pdf")]
pub(crate) struct Pixels {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) rgb: Vec<u8>,
}

/// Pixels by numbers of a palette, in the header of a file.
const PALETTE: u8 = 3;

impl Raster<'_> {
    /// The file.
    pub fn png(&self) -> Vec<u8> {
        let palette: Vec<u8> = self.palette.iter().flat_map(|colour| colour.0).collect();
        let rows = self.pixels.chunks(self.width.max(1) as usize);
        file([self.width, self.height], PALETTE, &palette, rows)
    }

    /// The file as text.
    pub(crate) fn base64(&self) -> String {
        BASE64_STANDARD.encode(self.png())
    }
}

#[cfg(feature = "png-pdf")]
impl Pixels {
    /// Read what [`Raster::png`] writes; none of other files.
    pub(crate) fn read(file: &[u8]) -> Option<Self> {
        let mut rest = file.strip_prefix(SIGNATURE)?;
        let (mut head, mut palette, mut packed) = (vec![], vec![], vec![]);
        while let Some((length, tail)) = rest.split_first_chunk() {
            let (name, tail) = tail.split_first_chunk()?;
            let (data, tail) = tail.split_at_checked(u32::from_be_bytes(*length) as usize)?;
            match name {
                b"IHDR" => head = data.to_vec(),
                b"PLTE" => palette = data.to_vec(),
                b"IDAT" => packed = data.to_vec(),
                _ => {}
            }
            // Behind its sum.
            rest = tail.get(4..)?;
        }
        let (width, tail) = head.split_first_chunk()?;
        let (height, tail) = tail.split_first_chunk()?;
        let [width, height] = [width, height].map(|side| u32::from_be_bytes(*side));
        let rows = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).ok()?;
        let row = width as usize + 1;
        if tail != [8, PALETTE, 0, 0, 0] || width == 0 || rows.len() != row * height as usize {
            return None;
        }
        let mut rgb = Vec::with_capacity(3 * rows.len());
        for number in rows.chunks(row).flat_map(|row| &row[1..]) {
            rgb.extend(palette.get(3 * usize::from(*number)..)?.first_chunk::<3>()?);
        }
        Some(Self { width, height, rgb })
    }
}

/// The file of pixels with red, green, blue and opacity, rows from the top.
#[cfg(feature = "png-pdf")]
pub(crate) fn opaque(size: [u32; 2], pixels: &[u8]) -> Vec<u8> {
    /// Colours with opacity, in the header of a file.
    const COLOURS: u8 = 6;
    file(size, COLOURS, &[], pixels.chunks(4 * size[0].max(1) as usize))
}

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

fn file<'a>(
    [width, height]: [u32; 2],
    colours: u8,
    palette: &[u8],
    rows: impl Iterator<Item = &'a [u8]>,
) -> Vec<u8> {
    let mut file = SIGNATURE.to_vec();
    let mut head = vec![];
    head.extend(width.to_be_bytes());
    head.extend(height.to_be_bytes());
    // Depth 8, the kind of colours, and the only compression, filter and order there are.
    head.extend([8, colours, 0, 0, 0]);
    chunk(&mut file, *b"IHDR", &head);
    if !palette.is_empty() {
        chunk(&mut file, *b"PLTE", palette);
    }
    let mut raw = vec![];
    for row in rows {
        // Each row begins with the number of its filter: none.
        raw.push(0);
        raw.extend(row);
    }
    chunk(&mut file, *b"IDAT", &compress_to_vec_zlib(&raw, EFFORT));
    chunk(&mut file, *b"IEND", &[]);
    file
}

fn chunk(file: &mut Vec<u8>, name: [u8; 4], data: &[u8]) {
    // A chunk of this module is far smaller than 2^31 bytes.
    let length = u32::try_from(data.len()).unwrap_or(u32::MAX);
    file.extend(length.to_be_bytes());
    let start = file.len();
    file.extend(name);
    file.extend(data);
    let sum = crc32(&file[start..]);
    file.extend(sum.to_be_bytes());
}

fn crc32(bytes: &[u8]) -> u32 {
    /// The polynomial of ISO 3309, reversed.
    const POLYNOMIAL: u32 = 0xedb8_8320;
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ if crc & 1 == 1 { POLYNOMIAL } else { 0 }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_the_published_ones() {
        // The check value of CRC-32/ISO-HDLC, and the sum of every last chunk of a PNG.
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32(b"IEND"), 0xae42_6082);
    }

    #[test]
    fn a_raster_is_read_back() {
        let pixels: Vec<u8> = (0..70 * 30).map(|k| u8::try_from(k % 3).unwrap()).collect();
        let palette = [Colour::BLACK, Colour::WHITE, Colour([1, 2, 3])];
        let file = Raster { width: 70, height: 30, pixels: &pixels, palette: &palette }.png();
        assert_eq!(file[16..24], [0, 0, 0, 70, 0, 0, 0, 30]);
        let at = file.windows(4).position(|name| name == b"IDAT").unwrap();
        let length = u32::from_be_bytes(file[at - 4..at].try_into().unwrap()) as usize;
        let data = &file[at + 4..at + 4 + length];
        let raw = miniz_oxide::inflate::decompress_to_vec_zlib(data).unwrap();
        assert_eq!(raw.len(), 71 * 30);
        let rows = raw.chunks(71).zip(pixels.chunks(70));
        assert!(rows.into_iter().all(|(row, wanted)| row[0] == 0 && &row[1..] == wanted));
        assert!(length < pixels.len() / 4, "{length} bytes");
    }
}
