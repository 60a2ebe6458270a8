//! Numbers as a person reads them.

use std::fmt;

/// Significant digits shown: no more than the path and the limit window agree on.
const SIGNIFICANT: i32 = 7;

/// Shows a number with seven significant digits and no zeros behind them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Digits(pub f64);

impl fmt::Display for Digits {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scientific = format!("{:.*e}", SIGNIFICANT as usize - 1, self.0);
        let Some((mantissa, exponent)) = scientific.split_once('e') else { return out.write_str(&scientific) };
        let exponent: i32 = exponent.parse().unwrap_or(0);
        if self.0 == 0.0 {
            return out.write_str("0");
        }
        if !(-5..SIGNIFICANT).contains(&exponent) {
            return write!(out, "{}e{exponent}", without_zeros(mantissa));
        }
        let decimals = usize::try_from(SIGNIFICANT - 1 - exponent).unwrap_or(0);
        out.write_str(without_zeros(&format!("{:.decimals$}", self.0)))
    }
}

/// The number without the zeros that end its decimals.
fn without_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seven_digits_and_no_zeros_behind_them() {
        for (value, expected) in [
            (247.1234567891, "247.1235"),
            (243.1250000001, "243.125"),
            (0.0, "0"),
            (-0.0, "0"),
            (-12.0, "-12"),
            (9_999_999.6, "1e7"),
            (1_000_000.0, "1000000"),
            (9.999_999_96, "10"),
            (1e9, "1e9"),
            (3.5e-7, "3.5e-7"),
            (0.000_012_5, "0.0000125"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(Digits(value).to_string(), expected);
        }
    }
}
