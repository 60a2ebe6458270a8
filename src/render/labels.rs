//! Words on a drawing, none over another: each is put where there is room, as near to what it names as it can be.

use crate::geometry::Vec2;

/// Distances from what is named at which room is looked for, pixels.
const DISTANCES: [f64; 9] = [4.0, 9.0, 16.0, 26.0, 38.0, 54.0, 74.0, 98.0, 126.0];
/// Directions in which it is looked for, from the one that is wanted, degrees.
const TURNS: [f64; 10] = [0.0, 24.0, -24.0, 48.0, -48.0, 75.0, -75.0, 110.0, -110.0, 180.0];
/// From so far off a thin line leads to what is named, pixels.
pub const NEEDS_LEADER: f64 = 30.0;
/// White space around words, pixels.
const MARGIN: f64 = 2.0;

/// A box on the sheet, pixels; y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Upper left corner.
    pub low: Vec2,
    /// Lower right corner.
    pub high: Vec2,
}

impl Frame {
    /// Around these places, with so much white space.
    pub fn around(places: &[Vec2], space: f64) -> Self {
        let none = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        let (low, high) = places.iter().fold(none, |(low, high), at| (low.inf(at), high.sup(at)));
        Frame { low: low.add_scalar(-space), high: high.add_scalar(space) }
    }

    fn meets(&self, other: &Frame) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }

    fn within(&self, other: &Frame) -> bool {
        (0..2).all(|axis| self.low[axis] >= other.low[axis] && self.high[axis] <= other.high[axis])
    }
}

/// Width and height of words of this size of letters, pixels; a little more than those of Arial and of Inter.
pub fn extent(words: &str, size: f64) -> Vec2 {
    let width = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '|' | '\'' | '!' => 0.3,
        'f' | 't' | 'r' | '(' | ')' | ' ' | '-' | '/' => 0.38,
        'm' | 'w' | 'M' | 'W' => 0.9,
        '0'..='9' | 'a'..='z' => 0.6,
        _ => 0.72,
    };
    Vec2::new(size * words.chars().map(width).sum::<f64>(), 1.15 * size)
}

/// What is taken of a sheet.
#[derive(Debug, Clone)]
pub struct Labels {
    sheet: Frame,
    taken: Vec<Frame>,
}

impl Labels {
    /// None yet, on this part of the sheet.
    pub fn new(sheet: Frame) -> Self {
        Labels { sheet, taken: Vec::new() }
    }

    /// Keeps words away from there.
    pub fn keep_free(&mut self, frame: Frame) {
        self.taken.push(frame);
    }

    /// The middle of words that name what is at a place, off it in this direction if there is room; none where there is none.
    pub fn place(&mut self, at: Vec2, direction: Vec2, size: Vec2) -> Option<Vec2> {
        let half = 0.5 * size.add_scalar(MARGIN);
        for distance in DISTANCES {
            for turn in TURNS {
                let (sin, cos) = f64::to_radians(turn).sin_cos();
                let way = Vec2::new(cos * direction.x - sin * direction.y, sin * direction.x + cos * direction.y);
                let middle = at + (distance + half.x * way.x.abs() + half.y * way.y.abs()) * way;
                let frame = Frame { low: middle - half, high: middle + half };
                if frame.within(&self.sheet) && !self.taken.iter().any(|other| other.meets(&frame)) {
                    self.taken.push(frame);
                    return Some(middle);
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Labels {
        Labels::new(Frame { low: Vec2::zeros(), high: Vec2::new(400.0, 300.0) })
    }

    #[test]
    fn words_stand_where_they_are_wanted_if_there_is_room() {
        let at = sheet().place(Vec2::new(200.0, 150.0), Vec2::new(0.0, -1.0), Vec2::new(40.0, 14.0)).unwrap();
        assert!((at - Vec2::new(200.0, 150.0 - 4.0 - 8.0)).norm() < 1e-12, "{at}");
    }

    #[test]
    fn words_about_one_place_do_not_overlap() {
        let (mut labels, size) = (sheet(), Vec2::new(40.0, 14.0));
        let places = (0..12).map(|_| labels.place(Vec2::new(200.0, 150.0), Vec2::new(1.0, 0.0), size).unwrap());
        let around = |middle: Vec2| Frame::around(&[middle - 0.5 * size, middle + 0.5 * size], 0.0);
        let frames: Vec<Frame> = places.map(around).collect();
        for (i, a) in frames.iter().enumerate() {
            assert!(a.within(&sheet().sheet) && frames[..i].iter().all(|b| !a.meets(b)), "{i}");
        }
    }

    #[test]
    fn where_there_is_no_room_there_are_no_words() {
        let mut labels = sheet();
        labels.keep_free(Frame { low: Vec2::repeat(-1e3), high: Vec2::repeat(1e3) });
        assert_eq!(labels.place(Vec2::new(200.0, 150.0), Vec2::new(1.0, 0.0), Vec2::repeat(5.0)), None);
    }

    #[test]
    fn longer_words_are_wider() {
        assert!(extent("243.1 kN/m", 14.0).x > extent("243.1 kN", 14.0).x);
    }
}
