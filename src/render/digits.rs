//! Numbers as a person reads them.

use std::fmt;

/// Shows a number with six significant digits and no zeros behind them: in tables and notes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Digits(pub f64);

/// Shows a number with four significant digits and no zeros behind them: in headlines and captions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounded(pub f64);

/// Shows a number with two significant digits and no zeros behind them: what follows from a stiffness that is hardly known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured(pub f64);

impl fmt::Display for Measured {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(out, self.0, 2)
    }
}

impl fmt::Display for Digits {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(out, self.0, 6)
    }
}

impl fmt::Display for Rounded {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(out, self.0, 4)
    }
}

/// Numbers from a ten millionth to ten millions are written out.
fn write(out: &mut fmt::Formatter<'_>, number: f64, significant: usize) -> fmt::Result {
    let scientific = format!("{number:.*e}", significant - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return out.write_str(&scientific) };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if number == 0.0 {
        return out.write_str("0");
    }
    if !(-5..7).contains(&exponent) {
        return write!(out, "{}e{exponent}", without_zeros(mantissa));
    }
    let (rounded, places) = (scientific.parse().unwrap_or(number), significant as i32 - 1 - exponent);
    out.write_str(without_zeros(&format!("{rounded:.*}", usize::try_from(places).unwrap_or(0))))
}

/// The number without the zeros that end its decimals.
fn without_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_count_and_no_zeros_behind_them() {
        for (value, digits, rounded) in [
            (247.1234567891, "247.123", "247.1"),
            (243.1250000001, "243.125", "243.1"),
            (0.0, "0", "0"),
            (-0.0, "0", "0"),
            (-12.0, "-12", "-12"),
            (9_999_999.6, "1e7", "1e7"),
            (1_234_567.0, "1234570", "1235000"),
            (241_236.0, "241236", "241200"),
            (9.999_999_96, "10", "10"),
            (1e9, "1e9", "1e9"),
            (3.5e-7, "3.5e-7", "3.5e-7"),
            (0.000_012_5, "0.0000125", "0.0000125"),
            (f64::INFINITY, "inf", "inf"),
        ] {
            assert_eq!(
                (Digits(value).to_string(), Rounded(value).to_string()),
                (digits.to_owned(), rounded.to_owned())
            );
        }
    }
}
