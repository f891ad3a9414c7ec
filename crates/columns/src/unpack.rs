//! Pages unpacked, and never to more than there is room for.

use std::io::Read;

use ::parquet::basic::CompressionCodec;
use ::parquet::errors::ParquetError;
use flate2::read::MultiGzDecoder;
use lz4_flex::block::DecompressError;
use ruzstd::decoding::StreamingDecoder;

use crate::budget::{Share, external};

/// The compressions that [`unpacked`] knows.
pub const COMPRESSIONS: &str = "Snappy, gzip, Zstandard, LZ4 and no compression";

/// How much larger than packed a page of unknown size is expected to be.
const EXPECTED_RATIO: usize = 4;

/// The bytes of a page. What it claims is asked for before it is unpacked.
pub fn unpacked(
    codec: CompressionCodec,
    packed: &[u8],
    share: &Share,
) -> Result<Vec<u8>, ParquetError> {
    match codec {
        // A page without a value need not even say so.
        _ if packed.is_empty() => Ok(Vec::new()),
        CompressionCodec::UNCOMPRESSED => Ok(packed.to_vec()),
        CompressionCodec::SNAPPY => {
            let size = snap::raw::decompress_len(packed).map_err(external)?;
            share.fits(size as u64)?;
            snap::raw::Decoder::new().decompress_vec(packed).map_err(external)
        }
        CompressionCodec::GZIP => drained(MultiGzDecoder::new(packed), share),
        CompressionCodec::ZSTD => zstd(packed, share),
        CompressionCodec::LZ4_RAW => lz4_block(packed, share),
        // Three formats have had this name.
        CompressionCodec::LZ4 => lz4_hadoop(packed, share)
            .or_else(|_| drained(lz4_flex::frame::FrameDecoder::new(packed), share))
            .or_else(|_| lz4_block(packed, share)),
        other => Err(ParquetError::NYI(format!("{other}"))),
    }
}

fn zstd(packed: &[u8], share: &Share) -> Result<Vec<u8>, ParquetError> {
    let frame = StreamingDecoder::new(packed).map_err(external)?;
    // 0 of a frame that does not say.
    share.fits(frame.decoder.content_size())?;
    drained(frame, share)
}

/// What a stream of unknown length holds.
fn drained(stream: impl Read, share: &Share) -> Result<Vec<u8>, ParquetError> {
    let mut bytes = Vec::new();
    stream.take((share.left() as u64).saturating_add(1)).read_to_end(&mut bytes)?;
    share.fits(bytes.len() as u64)?;
    Ok(bytes)
}

fn lz4_block(packed: &[u8], share: &Share) -> Result<Vec<u8>, ParquetError> {
    let wanted = |size: usize| size.saturating_mul(EXPECTED_RATIO).min(share.left());
    let mut size = wanted(packed.len());
    loop {
        match lz4_flex::block::decompress(packed, size) {
            Err(DecompressError::OutputTooSmall { expected, .. }) => {
                size = share.fits(expected as u64)?.max(wanted(size));
            }
            result => return result.map_err(external),
        }
    }
}

/// Blocks with their two lengths before each, unpacked and packed, as Hadoop writes them.
fn lz4_hadoop(mut packed: &[u8], share: &Share) -> Result<Vec<u8>, ParquetError> {
    let short = || ParquetError::EOF("a block of LZ4 is cut off".to_owned());
    let mut bytes = Vec::new();
    while !packed.is_empty() {
        let (size, rest) = packed.split_first_chunk().ok_or_else(short)?;
        let (length, rest) = rest.split_first_chunk().ok_or_else(short)?;
        let [size, length] = [size, length].map(|number| u32::from_be_bytes(*number));
        let (block, rest) = rest.split_at_checked(length as usize).ok_or_else(short)?;
        share.fits(bytes.len() as u64 + u64::from(size))?;
        bytes.append(&mut lz4_flex::block::decompress(block, size as usize).map_err(external)?);
        packed = rest;
    }
    Ok(bytes)
}
