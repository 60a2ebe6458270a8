//! Rotations of the plane, and what is done with lists of pairs.

use super::twofold::{self, Twofold};

/// A rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// Cosine of its angle.
    pub cos: f64,
    /// Sine of its angle.
    pub sin: f64,
}

impl Turn {
    /// None at all.
    pub const NONE: Turn = Turn { cos: 1.0, sin: 0.0 };

    /// The rotation that takes the first axis onto the direction of (x, y), which must not vanish.
    pub fn onto(x: f64, y: f64) -> Self {
        let length = x.hypot(y);
        Turn { cos: x / length, sin: y / length }
    }

    /// The rotation by an angle, rad.
    pub fn by(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Turn { cos, sin }
    }

    /// The opposite rotation.
    pub fn back(self) -> Self {
        Turn { sin: -self.sin, ..self }
    }

    /// Its angle, rad.
    pub fn angle(self) -> f64 {
        self.sin.atan2(self.cos)
    }

    /// A pair, rotated.
    pub fn pair(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }

    /// A pair of twice the digits, rotated.
    pub fn twofold(self, pair: [Twofold; 2]) -> [Twofold; 2] {
        [twofold::dot([self.cos, -self.sin], pair), twofold::dot([self.sin, self.cos], pair)]
    }

    /// What the rotation moves a pair by, without cancellation where it is small.
    pub fn shift(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let less = if self.cos > 0.0 { -self.sin * self.sin / (1.0 + self.cos) } else { self.cos - 1.0 };
        [less * x - self.sin * y, self.sin * x + less * y]
    }
}

/// A pair turned by +90 degrees.
pub fn quarter_of([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

/// Every pair turned by +90 degrees.
pub fn quarter(x: &[f64]) -> impl Iterator<Item = f64> {
    x.chunks_exact(2).flat_map(|pair| quarter_of([pair[0], pair[1]]))
}

/// Sum of the products.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Sum of the cross products of pairs.
pub fn cross(a: &[f64], b: &[f64]) -> f64 {
    a.chunks_exact(2).zip(b.chunks_exact(2)).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}
