//! A sum that does not drift with the number of terms.

/// Sum by Neumaier's compensated algorithm: the error is a few units in the last place of the
/// result plus a second-order term, whatever the number of terms.
///
/// ```
/// assert_eq!(model::sum([1e16, 1.0, -1e16]), 1.0);
/// ```
///
/// # References
///
/// A. Neumaier, Z. Angew. Math. Mech. 54 (1974) 39-51, doi:10.1002/zamm.19740540106
pub fn sum(terms: impl IntoIterator<Item = f64>) -> f64 {
    let mut all = Sum::default();
    terms.into_iter().for_each(|term| all.add(term));
    all.value()
}

/// The same, term by term: for several sums over one list.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    /// One more term.
    #[inline]
    pub fn add(&mut self, term: f64) {
        let next = self.total + term;
        self.lost += if self.total.abs() >= term.abs() {
            (self.total - next) + term
        } else {
            (term - next) + self.total
        };
        self.total = next;
    }

    /// The sum so far.
    #[inline]
    pub fn value(self) -> f64 {
        // An overflow leaves NaN in `lost`; the plain total then says it better.
        if self.lost.is_finite() { self.total + self.lost } else { self.total }
    }
}
