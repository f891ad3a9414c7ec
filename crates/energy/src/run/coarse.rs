//! From few bars to many.

use model::Vector;

use crate::run::scaled_chain::ScaledChain;

/// Bars per group.
const GROUP: usize = 8;

/// A chain of at most this many bars is minimised from the arc at once.
const FEW: usize = 24;

/// No group of several bars may be longer than this part of the chain: the chain of groups must be
/// able to take the shape of the chain roughly, and must be able to close.
const LONGEST_GROUP: f64 = 0.125;

/// The restriction of the problem to chains whose groups of neighbouring bars are straight.
#[derive(Debug)]
pub(crate) struct Grouped {
    pub(crate) links: ScaledChain,
    /// Bars in each group.
    pub(crate) sizes: Vec<usize>,
}

impl ScaledChain {
    /// The chain with neighbouring bars held parallel; `None` if it is short already.
    ///
    /// The energy and the closure are linear in the directions, so the restricted problem is again
    /// a chain: lengths add, and `l h` adds. A closed chain of groups is a closed chain of bars.
    pub(crate) fn grouped(&self) -> Option<Grouped> {
        if self.bars() <= FEW {
            return None;
        }
        let (mut length, mut carried, mut sizes) = (Vec::new(), Vec::new(), Vec::new());
        let (mut l, mut lh, mut size) = (0.0, 0.0, 0_usize);
        for (&next, &h) in self.length.iter().zip(&self.carried) {
            if size > 0 && (size == GROUP || l + next > LONGEST_GROUP) {
                length.push(l);
                carried.push(lh / l);
                sizes.push(size);
                (l, lh, size) = (0.0, 0.0, 0);
            }
            l += next;
            lh += next * h;
            size += 1;
        }
        length.push(l);
        carried.push(lh / l);
        sizes.push(size);
        // Few long bars between many short ones may leave little to group.
        if 2 * length.len() > self.bars() {
            return None;
        }
        let links = Self { length, carried, ..*self };
        Some(Grouped { links, sizes })
    }
}

impl Grouped {
    /// The directions of the bars when every group is straight.
    pub(crate) fn spread(&self, u: &[Vector]) -> Vec<Vector> {
        self.sizes.iter().zip(u).flat_map(|(&size, &u)| std::iter::repeat_n(u, size)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::settings::Motion;

    #[test]
    fn a_chain_of_straight_groups_has_the_energy_and_the_closure_of_the_bars() {
        let n = 100;
        let length: Vec<f64> = (0..n).map(|i| (1.0 + (i % 7) as f64) / 396.0).collect();
        let carried = (0..n).map(|i| 0.5 - i as f64 / n as f64).collect();
        let links = ScaledChain {
            length,
            carried,
            span: [[0.6, 0.0, 0.1], [0.0; 3]],
            up: [0.0, 0.0, 1.0],
            vertical: false,
            motion: Motion::Space,
        };
        let grouped = links.grouped().unwrap();
        assert!(grouped.links.bars() <= n / 8 + 9);
        let u = grouped.links.arc();
        let fine = grouped.spread(&u);
        assert_eq!(fine.len(), n);
        let (coarse, fine) = (grouped.links.measure(&u), links.measure(&fine));
        assert!((coarse.value - fine.value).abs() < 1e-15);
        for k in 0..3 {
            assert!((coarse.gap[k] - fine.gap[k]).abs() < 1e-15);
        }
    }
}
