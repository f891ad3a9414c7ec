//! Outlines of letters in a TrueType font that is built in. Only such fonts are read here, so what is broken is simply missing.
//!
//! # References
//!
//! OpenType 1.9.1, chapters `cmap` (format 12), `glyf`, `head`, `hhea`, `hmtx` and `loca`.

use tiny_skia::{PathBuilder, Point, Transform};

/// A font, in units of which `units` are the size of its letters.
pub(super) struct Font {
    file: &'static [u8],
    pub(super) units: f32,
    /// How far lines reach above and below where their letters stand.
    pub(super) ascender: f32,
    pub(super) descender: f32,
}

impl Font {
    pub(super) fn new(file: &'static [u8]) -> Option<Self> {
        let [head, lines] = [table(file, *b"head")?, table(file, *b"hhea")?];
        let (units, [ascender, descender]) =
            (signed(head, 18)?, [signed(lines, 4)?, -signed(lines, 6)?]);
        Some(Self { file, units, ascender, descender })
    }

    /// The number of a letter; of one that is missing 0, a box.
    pub(super) fn glyph(&self, letter: char) -> usize {
        self.find(u32::from(letter)).unwrap_or_default()
    }

    fn find(&self, letter: u32) -> Option<usize> {
        let maps = table(self.file, *b"cmap")?;
        // Of Windows (3), all of Unicode (10).
        let record = maps.get(4..)?.chunks_exact(8).find(|record| record[..4] == [0, 3, 0, 10])?;
        let map = maps.get(long(record, 4)? as usize..)?;
        let ranges = map.get(16..)?.chunks_exact(12).take(long(map, 12)? as usize);
        let mut range = ranges.filter(|range| long(range, 4).is_some_and(|last| letter <= last));
        let range = range.next()?;
        Some((long(range, 8)? + letter.checked_sub(long(range, 0)?)?) as usize)
    }

    /// From where a letter stands to where the next one does.
    pub(super) fn advance(&self, glyph: usize) -> f32 {
        let widths = || {
            let wide = short(table(self.file, *b"hhea")?, 34)?;
            short(table(self.file, *b"hmtx")?, 4 * glyph.min(wide.checked_sub(1)?))
        };
        widths().unwrap_or_default() as f32
    }

    /// Add the outline of a letter to a path, y upwards before it is mapped; of a broken one what comes before the fault.
    pub(super) fn outline(
        &self,
        glyph: usize,
        at: Transform,
        path: &mut PathBuilder,
    ) -> Option<()> {
        let [places, outlines] = [table(self.file, *b"loca")?, table(self.file, *b"glyf")?];
        let place = |glyph: usize| match short(table(self.file, *b"head")?, 50)? {
            0 => Some(2 * short(places, 2 * glyph)?),
            _ => Some(long(places, 4 * glyph)? as usize),
        };
        let data =
            outlines.get(place(glyph)?..place(glyph + 1)?).filter(|data| !data.is_empty())?;
        match short(data, 0)? {
            contours if contours < 0x8000 => simple(data, contours, at, path),
            _ => self.composite(data, at, path),
        }
    }

    /// A letter of others, such as one with an accent.
    fn composite(&self, data: &[u8], at: Transform, path: &mut PathBuilder) -> Option<()> {
        const WORDS: usize = 1;
        const MORE: usize = 0x20;
        let mut from = 10;
        loop {
            let (flags, glyph) = (short(data, from)?, short(data, from + 2)?);
            from += 4;
            let moved = if flags & WORDS == 0 {
                let [x, y] = *data.get(from..)?.first_chunk::<2>()?;
                [x, y].map(|by| f32::from(by.cast_signed()))
            } else {
                [signed(data, from)?, signed(data, from + 2)?]
            };
            from += if flags & WORDS == 0 { 2 } else { 4 };
            // A factor for both directions, one for each, or a matrix; of 14 binary digits behind the point.
            let count =
                [(0x08, 1), (0x40, 2), (0x80, 4)].into_iter().find(|(flag, _)| flags & flag != 0);
            let count = count.map_or(0, |(_, count)| count);
            let factor = |k: usize| Some(signed(data, from + 2 * k)? / 16384.0);
            let [xx, xy, yx, yy] = match count {
                0 => [1.0, 0.0, 0.0, 1.0],
                1 => [factor(0)?, 0.0, 0.0, factor(0)?],
                2 => [factor(0)?, 0.0, 0.0, factor(1)?],
                _ => [factor(0)?, factor(1)?, factor(2)?, factor(3)?],
            };
            from += 2 * count;
            let own = Transform::from_row(xx, xy, yx, yy, moved[0], moved[1]);
            // One without an outline, such as a blank, does not end the others.
            let _ = self.outline(glyph, at.pre_concat(own), path);
            if flags & MORE == 0 {
                return Some(());
            }
        }
    }
}

/// Closed curves of the second degree: points on them, and those beside them that bend them.
fn simple(data: &[u8], contours: usize, at: Transform, path: &mut PathBuilder) -> Option<()> {
    const ON: u8 = 1;
    const REPEATED: u8 = 8;
    let ends = (0..contours).map(|k| short(data, 10 + 2 * k)).collect::<Option<Vec<_>>>()?;
    let count = ends.last()? + 1;
    let mut from = 12 + 2 * contours + short(data, 10 + 2 * contours)?;
    let mut flags = vec![];
    while flags.len() < count {
        let flag = *data.get(from)?;
        let times = if flag & REPEATED == 0 { 0 } else { *data.get(from + 1)? };
        flags.extend(std::iter::repeat_n(flag, 1 + usize::from(times)));
        from += if flag & REPEATED == 0 { 1 } else { 2 };
    }
    // Along either axis: one byte with its sign, or two unless nothing changes.
    let mut along = |byte: u8, same: u8| {
        let mut x = 0.0;
        let mut next = |flag: &u8| {
            let (change, length) = match (flag & byte != 0, flag & same != 0) {
                (true, positive) => {
                    let size = f32::from(*data.get(from)?);
                    (if positive { size } else { -size }, 1)
                }
                (false, true) => (0.0, 0),
                (false, false) => (signed(data, from)?, 2),
            };
            (x, from) = (x + change, from + length);
            Some(x)
        };
        flags[..count].iter().map(&mut next).collect::<Option<Vec<f32>>>()
    };
    let (xs, ys) = (along(2, 16)?, along(4, 32)?);
    let mut first = 0;
    for end in ends {
        let point = |k: usize| {
            let mut point = Point::from_xy(xs[k], ys[k]);
            at.map_point(&mut point);
            (flags[k] & ON != 0, point)
        };
        contour(&(first..=end).map(point).collect::<Vec<_>>(), path);
        first = end + 1;
    }
    Some(())
}

/// Between two points beside the curve lies one on it, in their middle.
fn contour(points: &[(bool, Point)], path: &mut PathBuilder) {
    let middle = |a: Point, b: Point| Point::from_xy(0.5 * (a.x + b.x), 0.5 * (a.y + b.y));
    let (Some((_, first)), Some((_, last))) = (points.first(), points.last()) else { return };
    let begin = points.iter().position(|(on, _)| *on);
    let start = begin.map_or(middle(*first, *last), |k| points[k].1);
    path.move_to(start.x, start.y);
    let skipped = begin.map_or(0, |k| k + 1);
    let round = points.iter().cycle().skip(skipped).take(points.len()).copied();
    let mut bend: Option<Point> = None;
    for (on, point) in round.chain(begin.is_none().then_some((true, start))) {
        match (bend, on) {
            (None, true) => path.line_to(point.x, point.y),
            (Some(by), true) => path.quad_to(by.x, by.y, point.x, point.y),
            (Some(by), false) => {
                let to = middle(by, point);
                path.quad_to(by.x, by.y, to.x, to.y);
            }
            (None, false) => {}
        }
        bend = (!on).then_some(point);
    }
    path.close();
}

fn table(file: &'static [u8], name: [u8; 4]) -> Option<&'static [u8]> {
    let records = file.get(12..)?.chunks_exact(16).take(short(file, 4)?);
    let record = records.into_iter().find(|record| record[..4] == name)?;
    let (from, length) = (long(record, 8)? as usize, long(record, 12)? as usize);
    file.get(from..from + length)
}

fn short(data: &[u8], at: usize) -> Option<usize> {
    Some(usize::from(u16::from_be_bytes(*data.get(at..)?.first_chunk()?)))
}

fn signed(data: &[u8], at: usize) -> Option<f32> {
    Some(f32::from(i16::from_be_bytes(*data.get(at..)?.first_chunk()?)))
}

fn long(data: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_be_bytes(*data.get(at..)?.first_chunk()?))
}
