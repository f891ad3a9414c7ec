//! A sum that does not drift.

/// A compensated sum of numbers (Knuth's two-sum).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    pub(crate) fn add(&mut self, term: f64) {
        let s = self.total;
        let next = s + term;
        let back = next - s;
        self.lost += (s - (next - back)) + (term - back);
        self.total = next;
    }

    pub(crate) fn value(&self) -> f64 {
        self.total + self.lost
    }
}
