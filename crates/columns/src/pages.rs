//! The pages of a column, with all that they claim asked for before it is made.

use std::fs::File;
use std::sync::Arc;

use ::parquet::basic::{Compression, CompressionCodec, Encoding, Type};
use ::parquet::column::page::{Page, PageMetadata, PageReader};
use ::parquet::data_type::ByteArray;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::ColumnChunkMetaData;
use ::parquet::file::serialized_reader::SerializedPageReader;
use bytes::Bytes;

use crate::budget::{Budget, Share};
use crate::unpack::unpacked;

/// The pages of one column of a row group. The `parquet` crate takes them from the file, and is
/// left to believe that they are not packed: it would make room for whatever a page claims.
pub struct Pages {
    packed: SerializedPageReader<File>,
    codec: CompressionCodec,
    /// Whether text may share its beginning with the text before, as the footer has it.
    shared: bool,
    nullable: bool,
    /// Memory of a value, bytes.
    value: u64,
    /// What the dictionary takes beside its bytes, and what the page at hand takes.
    dictionary: Share,
    page: Share,
}

/// The bytes of a page, which text that was read of it holds on to.
struct Held {
    bytes: Bytes,
    _share: Share,
}

impl AsRef<[u8]> for Held {
    fn as_ref(&self) -> &[u8] {
        &self.bytes
    }
}

impl Pages {
    pub fn new(
        file: Arc<File>,
        chunk: &ColumnChunkMetaData,
        rows: usize,
        budget: &Arc<Budget>,
    ) -> Result<Self, ParquetError> {
        let plain = chunk.clone().into_builder().set_compression(Compression::UNCOMPRESSED);
        let share = || Share::new(budget, &chunk.column_path().string());
        Ok(Self {
            packed: SerializedPageReader::new(file, &plain.build()?, rows, None)?,
            codec: chunk.compression_codec(),
            shared: shared(chunk),
            nullable: chunk.column_descr().max_def_level() > 0,
            value: match chunk.column_type() {
                Type::BYTE_ARRAY => size_of::<ByteArray>() as u64,
                _ => size_of::<f64>() as u64,
            },
            dictionary: share(),
            page: share(),
        })
    }

    fn unpacked(&mut self, mut page: Page) -> Result<Page, ParquetError> {
        let (levels, packed) = match &page {
            Page::DataPageV2 { is_compressed, .. } => (levels(&page)?, *is_compressed),
            _ => (0, true),
        };
        let bytes = if packed && self.codec != CompressionCodec::UNCOMPRESSED {
            let (levels, values) = page.buffer().split_at_checked(levels).ok_or_else(cut_off)?;
            let mut values = unpacked(self.codec, values, &self.page)?;
            values.splice(..0, levels.iter().copied());
            values.shrink_to_fit();
            values.into()
        } else {
            page.buffer().clone()
        };
        let mut share = self.page.empty();
        share.take(bytes.len() as u64)?;
        *buffer(&mut page) = Bytes::from_owner(Held { bytes, _share: share });
        let mut claimed = self.page.empty();
        claimed.take(self.claimed(&page)?)?;
        *(if page.is_dictionary_page() { &mut self.dictionary } else { &mut self.page }) = claimed;
        Ok(page)
    }

    /// What a page makes its reader hold beside its bytes, bytes.
    fn claimed(&self, page: &Page) -> Result<u64, ParquetError> {
        let length = size_of::<i32>() as u64;
        match (page, page.encoding()) {
            (Page::DictionaryPage { num_values, .. }, _) => Ok(u64::from(*num_values) * self.value),
            // Whoever reads it asks for each text, if the footer says so.
            (_, Encoding::DELTA_BYTE_ARRAY) if !self.shared => {
                let reason = "the footer does not list the encoding of a page";
                Err(ParquetError::General(reason.to_owned()))
            }
            (_, Encoding::DELTA_LENGTH_BYTE_ARRAY) => {
                Ok(deltas(self.values(page)?).ok_or_else(cut_off)?.0.saturating_mul(length))
            }
            (_, Encoding::DELTA_BYTE_ARRAY) => {
                let (prefixes, suffixes) = deltas(self.values(page)?).ok_or_else(cut_off)?;
                let (suffixes, _) = deltas(suffixes).ok_or_else(cut_off)?;
                Ok(prefixes.saturating_add(suffixes).saturating_mul(length))
            }
            _ => Ok(0),
        }
    }

    /// The values of a data page, behind what says which of them are there.
    fn values<'p>(&self, page: &'p Page) -> Result<&'p [u8], ParquetError> {
        let bytes = page.buffer().as_ref();
        let skipped = match page {
            Page::DataPage { .. } if !self.nullable => 0,
            Page::DataPage { .. } => {
                let length = bytes.first_chunk().ok_or_else(cut_off)?;
                u32::from_le_bytes(*length) as usize + length.len()
            }
            _ => levels(page)?,
        };
        bytes.get(skipped..).ok_or_else(cut_off)
    }
}

/// Whether text of this column may share its beginning with the text before.
pub fn shared(chunk: &ColumnChunkMetaData) -> bool {
    chunk.encodings().any(|encoding| encoding == Encoding::DELTA_BYTE_ARRAY)
}

fn cut_off() -> ParquetError {
    ParquetError::EOF("a page is cut off".to_owned())
}

fn buffer(page: &mut Page) -> &mut Bytes {
    match page {
        Page::DataPage { buf, .. }
        | Page::DataPageV2 { buf, .. }
        | Page::DictionaryPage { buf, .. } => buf,
    }
}

/// Bytes before the values of a page of the second kind, which are never packed.
fn levels(page: &Page) -> Result<usize, ParquetError> {
    let Page::DataPageV2 { def_levels_byte_len, rep_levels_byte_len, .. } = page else {
        return Ok(0);
    };
    let length = def_levels_byte_len.checked_add(*rep_levels_byte_len).ok_or_else(cut_off)?;
    Ok(length as usize)
}

impl Iterator for Pages {
    type Item = Result<Page, ParquetError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for Pages {
    fn get_next_page(&mut self) -> Result<Option<Page>, ParquetError> {
        self.packed.get_next_page()?.map(|page| self.unpacked(page)).transpose()
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>, ParquetError> {
        self.packed.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<(), ParquetError> {
        self.packed.skip_next_page()
    }
}

/// How many numbers a run of DELTA_BINARY_PACKED claims, and what is behind it.
fn deltas(mut bytes: &[u8]) -> Option<(u64, &[u8])> {
    let [block, parts, count, _first] = [(); 4].map(|()| number(&mut bytes));
    let (parts, count) = (usize::try_from(parts?).ok()?, count?);
    let in_part = block?.checked_div(parts as u64)?;
    let mut left = count.saturating_sub(1);
    while left > 0 {
        number(&mut bytes)?;
        let (widths, mut rest) = bytes.split_at_checked(parts)?;
        for width in widths {
            // The widths of parts behind the last number mean nothing.
            if left == 0 {
                break;
            }
            let length = in_part.checked_mul(u64::from(*width))? / 8;
            rest = rest.get(usize::try_from(length).ok()?..)?;
            left = left.saturating_sub(in_part);
        }
        bytes = rest;
    }
    Some((count, bytes))
}

/// A whole number in groups of seven bits, the lowest first.
fn number(bytes: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for shift in (0..u64::BITS).step_by(7) {
        let (group, rest) = bytes.split_first()?;
        *bytes = rest;
        number |= u64::from(group & 0x7f) << shift;
        if group & 0x80 == 0 {
            return Some(number);
        }
    }
    None
}
