//! Numbers of twice the digits, as the unevaluated sum of two (Dekker, Numer. Math. 18, 1971; Knuth, The Art of Computer
//! Programming 2, 4.2.2).
//!
//! A closed joint of stiff stone is pressed together by a billionth of what an arch moves by. The difference of two plain
//! numbers would leave seven digits of its force.

/// `high + low`, with `low` below the last digit of `high`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Twofold {
    /// The number, rounded.
    pub high: f64,
    /// What rounding took off.
    pub low: f64,
}

impl Twofold {
    /// a + b.
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let back = high - a;
        Twofold { high, low: (a - (high - back)) + (b - back) }
    }

    /// a b.
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Twofold { high, low: a.mul_add(b, -high) }
    }

    /// This and `other`.
    pub fn plus(self, other: Twofold) -> Self {
        let Twofold { high, low } = Twofold::sum(self.high, other.high);
        Twofold::sum(high, low + (self.low + other.low))
    }

    /// So many times.
    pub fn times(self, factor: f64) -> Self {
        let Twofold { high, low } = Twofold::product(self.high, factor);
        Twofold::sum(high, low + self.low * factor)
    }

    /// The n-th part.
    pub fn over(self, n: f64) -> Self {
        let high = self.high / n;
        Twofold::sum(high, (high.mul_add(-n, self.high) + self.low) / n)
    }

    /// As one number.
    pub fn value(self) -> f64 {
        self.high + self.low
    }
}

/// a . b of two pairs.
pub fn dot(a: [f64; 2], b: [Twofold; 2]) -> Twofold {
    b[0].times(a[0]).plus(b[1].times(a[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounding_takes_off_is_kept() {
        let (large, small) = (1.0 + f64::EPSILON, 2f64.powi(-60));
        let sum = Twofold::sum(large, small);
        assert_eq!((sum.high, sum.low), (large, small));
        // (1 + e)^2 = 1 + 2 e + e^2.
        let square = Twofold::product(large, large);
        assert_eq!((square.high, square.low), (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON));
        let third = sum.over(3.0);
        assert!(third.times(3.0).plus(Twofold::sum(-large, -small)).value().abs() < 1e-32);
        let back = dot([0.6, 0.8], [sum, sum]).plus(sum.times(-0.6)).plus(sum.times(-0.8));
        assert!(back.value().abs() < 1e-31, "{back:?}");
    }
}
