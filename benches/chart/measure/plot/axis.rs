//! A logarithmic axis of whole decades.

/// Decades beyond which not every one is named.
const NAMED: i32 = 9;

/// From powers of ten to pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Exponents of the first and the last decade's edge.
    decades: [i32; 2],
    /// Where they are, pixels.
    ends: [f64; 2],
}

impl Axis {
    /// The whole decades around some positive values, between two places; at least one decade.
    pub fn around(values: impl Iterator<Item = f64>, ends: [f64; 2]) -> Self {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = values.map(f64::log10).fold(none, |(low, high), x| (low.min(x), high.max(x)));
        let first = if low.is_finite() { low.floor() as i32 } else { 0 };
        let last = if high.is_finite() { high.ceil() as i32 } else { 0 };
        Axis { decades: [first, last.max(first + 1)], ends }
    }

    /// Where a value lies, pixels.
    pub fn place(&self, value: f64) -> f64 {
        let [first, last] = self.decades.map(f64::from);
        let [from, to] = self.ends;
        from + (to - from) * (value.log10() - first) / (last - first)
    }

    /// The edges of the decades, with their names; where there are many, every other name is empty.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let [first, last] = self.decades;
        let step = if last - first > NAMED { 2 } else { 1 };
        let name = |exponent: i32| if exponent.rem_euclid(step) == 0 { power(exponent) } else { String::new() };
        (first..=last).map(|exponent| (self.place(10f64.powi(exponent)), name(exponent))).collect()
    }
}

/// A power of ten, written out where that is short.
fn power(exponent: i32) -> String {
    match exponent {
        -3..=4 => format!("{}", 10f64.powi(exponent)),
        _ => format!("1e{exponent}"),
    }
}
