//! The largest of what is measured, for what is held below a bound.

/// The larger number. What is no number is larger than any, so that it fails the bound; `f64::max` would drop it. Not for
/// the size by which something is divided.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// The largest of all, 0 unless one is larger.
pub fn largest(all: impl IntoIterator<Item = f64>) -> f64 {
    all.into_iter().fold(0.0, larger)
}

#[test]
fn what_is_no_number_is_the_largest() {
    assert!(largest([1.0, f64::NAN, 2.0]) == f64::INFINITY && largest([f64::NAN]) == f64::INFINITY);
    assert!(largest([-1.0, 3.0, 2.0]) == 3.0 && largest([-1.0]) == 0.0 && larger(-2.0, -1.0) == -1.0);
}
