//! Labels that do not cover each other: what has no room is left out.

use std::collections::BTreeMap;

use crate::look::{Colour, Look};
use crate::svg::{Anchor, Svg};

/// Size of the letters, px, and their mean width.
const LETTERS: f64 = 12.0;
const LETTER: f64 = 6.7;

/// Side of the cells in which covered places are looked up, px.
const CELL: f64 = 64.0;

/// Most labels in a drawing: more are read by nobody.
const MOST: usize = 200;

/// The places that are taken.
pub(crate) struct Labels {
    size: [f64; 2],
    taken: BTreeMap<[i32; 2], Vec<[f64; 4]>>,
    written: usize,
}

impl Labels {
    pub(crate) fn within(size: [f64; 2]) -> Self {
        Self { size, taken: BTreeMap::new(), written: 0 }
    }

    /// Keep a place free of labels.
    pub(crate) fn take(&mut self, [x, y]: [f64; 2], radius: f64) {
        self.insert([x - radius, y - radius, x + radius, y + radius]);
    }

    /// Whether there is no use in trying.
    pub(crate) fn full(&self) -> bool {
        self.written >= MOST
    }

    /// Write a text at the first of these places where it covers nothing.
    pub(crate) fn write(&mut self, svg: &mut Svg, text: &str, places: &[([f64; 2], Anchor)]) {
        if text.is_empty() || self.full() {
            return;
        }
        let width = LETTER * text.chars().count() as f64;
        for ([x, y], anchor) in places {
            let left = match anchor {
                Anchor::Start => *x,
                Anchor::Middle => x - 0.5 * width,
                Anchor::End => x - width,
            };
            let covered = [left, y - 0.5 * LETTERS, left + width, y + 0.5 * LETTERS];
            if self.is_free(covered) {
                self.insert(covered);
                self.written += 1;
                let look = Look::fill(Colour::grey(0x22)).size(LETTERS);
                svg.text(look, [*x, y + 0.35 * LETTERS], *anchor, text);
                return;
            }
        }
    }

    fn is_free(&self, [left, top, right, bottom]: [f64; 4]) -> bool {
        let inside = left >= 0.0 && top >= 0.0 && right <= self.size[0] && bottom <= self.size[1];
        let apart = |other: &[f64; 4]| {
            right <= other[0] || other[2] <= left || bottom <= other[1] || other[3] <= top
        };
        inside
            && cells([left, top, right, bottom])
                .all(|cell| self.taken.get(&cell).into_iter().flatten().all(apart))
    }

    fn insert(&mut self, place: [f64; 4]) {
        for cell in cells(place) {
            self.taken.entry(cell).or_default().push(place);
        }
    }
}

fn cells([left, top, right, bottom]: [f64; 4]) -> impl Iterator<Item = [i32; 2]> {
    #[expect(clippy::cast_possible_truncation, reason = "pixels of a picture")]
    let cell = |x: f64| (x / CELL).floor() as i32;
    let columns = cell(left)..=cell(right);
    columns.flat_map(move |x| (cell(top)..=cell(bottom)).map(move |y| [x, y]))
}

/// Four digits, without an exponent where that is short.
pub(crate) fn short(x: f64) -> String {
    let text = if x.abs() >= 1e5 || (x != 0.0 && x.abs() < 1e-3) {
        format!("{x:.3e}")
    } else {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 6")]
        let digits = if x.abs() > 0.0 {
            (3.0 - x.abs().log10().floor()).clamp(0.0, 6.0) as usize
        } else {
            0
        };
        let text = format!("{x:.digits$}");
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        }
    };
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_cover_each_other_nor_leave_the_picture() {
        let mut svg = Svg::new([200.0, 100.0], "");
        let mut labels = Labels::within([200.0, 100.0]);
        labels.take([100.0, 50.0], 5.0);
        let at = |x, y| [([x, y], Anchor::Start)];
        labels.write(&mut svg, "covers a joint", &at(90.0, 50.0));
        labels.write(&mut svg, "first", &at(10.0, 20.0));
        labels.write(&mut svg, "covers the first", &at(12.0, 24.0));
        labels.write(&mut svg, "beyond the edge", &at(150.0, 20.0));
        labels.write(
            &mut svg,
            "moved",
            &[([12.0, 24.0], Anchor::Start), ([10.0, 40.0], Anchor::Start)],
        );
        let text = svg.finish();
        assert!(text.contains("first") && text.contains("moved"));
        assert!(!text.contains("covers") && !text.contains("beyond"));
    }

    #[test]
    fn numbers_are_short() {
        for (x, wanted) in [
            (5.0, "5"),
            (0.0, "0"),
            (-12.3456, "\u{2212}12.35"),
            (98_066.7, "98067"),
            (1.5e7, "1.500e7"),
            (2.5e-5, "2.500e\u{2212}5"),
        ] {
            assert_eq!(short(x), wanted);
        }
    }
}
