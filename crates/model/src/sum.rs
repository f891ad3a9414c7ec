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
#[must_use]
pub fn sum(terms: impl IntoIterator<Item = f64>) -> f64 {
    let (mut total, mut lost) = (0.0_f64, 0.0_f64);
    for term in terms {
        let next = total + term;
        lost +=
            if total.abs() >= term.abs() { (total - next) + term } else { (term - next) + total };
        total = next;
    }
    // An overflow leaves NaN in `lost`; the plain total then says it better.
    if lost.is_finite() { total + lost } else { total }
}
