//! Chains whose longest bar is nearly as long as the others and the span together.

use model::Vector;

use crate::run::closure::Shape;
use crate::run::regime::Reach;
use crate::run::scaled_chain::ScaledChain;
use crate::vector::{along, dot, unit};

impl ScaledChain {
    /// Bring the directions of a nearly folded chain near to a closed shape; those of other chains
    /// are left as they are.
    ///
    /// A nearly folded chain closes only with its longest bar nearly along the span and the others
    /// nearly drawn out along the way back. The corrections of the closure would have to turn it as
    /// a whole, which they do only in steps as small as what it has to spare. So the chain is
    /// turned first, and the other bars are closed on the way back, where they are a nearly taut
    /// chain.
    pub(crate) fn unfolded(&self, u: Vec<Vector>) -> Vec<Vector> {
        if !Reach::of_links(self).starts_unfolded() {
            return u;
        }
        let Some((k, longest)) =
            self.length.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
        else {
            return u;
        };
        let (Some(to), Some(&from)) = (unit(self.span[0]), u.get(k)) else { return u };
        let Some(half) = unit(along(from, 1.0, to)) else { return u };
        // Two reflections are a turn: the first takes `from` to `-from`, the second that to `to`.
        let reflected = |v: Vector, w: Vector| along(v, -2.0 * dot(v, w), w);
        let mut turned: Vec<Vector> =
            u.into_iter().map(|v| reflected(reflected(v, from), half)).collect();

        let [span, rest] = self.span;
        let mut others = Self { span: [along(span, -longest, to), rest], ..self.clone() };
        others.length.remove(k);
        others.carried.remove(k);
        let mut rest = turned.clone();
        rest.remove(k);
        let moments = others.measure(&rest);
        // If they do not close, the turned chain is as good a start as any.
        if let Ok(closed) = others.close(Shape { u: rest, moments }, CORRECTIONS) {
            rest = closed.u;
            rest.insert(k, to);
            turned = rest;
        }
        turned
    }
}

/// Corrections of the closure of the other bars.
const CORRECTIONS: usize = 100;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::norm;

    #[test]
    fn a_nearly_folded_chain_comes_closed_with_its_longest_bar_along_the_span() {
        let links = ScaledChain {
            length: vec![0.2, 0.6, 0.2],
            carried: vec![0.3, 0.0, -0.3],
            span: [[0.21, 0.0, 0.0], [0.0; 3]],
            up: [0.0, 0.0, 1.0],
            vertical: false,
            motion: crate::run::settings::Motion::Space,
        };
        let u = vec![[0.0, 0.6, 0.8], [0.0, 0.8, -0.6], [1.0, 0.0, 0.0]];
        let turned = links.unfolded(u.clone());
        assert!((turned[1][0] - 1.0).abs() < 1e-15);
        let gap = links.measure(&turned).gap;
        assert!(norm(gap) < 1e-14);
        // A chain with more to spare stays.
        let slack = ScaledChain { span: [[0.4, 0.0, 0.0], [0.0; 3]], ..links };
        assert_eq!(slack.unfolded(u.clone()), u);
    }
}
