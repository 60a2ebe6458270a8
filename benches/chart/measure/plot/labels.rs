//! Names beside marks, where there is room.

use voussoir::geometry::Vec2;

/// Size of the letters, pixels.
const SIZE: f64 = 13.0;
/// Space between a mark and its name, pixels.
const GAP: f64 = 4.0;

/// Width of words in letters of a size, pixels: sans-serif letters are a little more than half as wide as high.
pub fn text_width(words: &str, size: f64) -> f64 {
    0.56 * size * words.chars().count() as f64
}

/// What already stands on the sheet: boxes by their upper left and lower right corners, pixels.
pub struct Labels {
    whole: [Vec2; 2],
    taken: Vec<[Vec2; 2]>,
}

impl Labels {
    /// An empty field from left to right and from top to bottom.
    pub fn new([left, right]: [f64; 2], [top, bottom]: [f64; 2]) -> Self {
        Labels { whole: [Vec2::new(left, top), Vec2::new(right, bottom)], taken: Vec::new() }
    }

    /// Keeps words off a mark, or off a line along an axis, between two ends and so far around them.
    pub fn keep_clear(&mut self, [from, to]: [Vec2; 2], radius: f64) {
        self.taken.push([from.inf(&to) - Vec2::repeat(radius), from.sup(&to) + Vec2::repeat(radius)]);
    }

    /// Where these words can start (baseline) beside a mark: right of it, left, above or below. None where all is taken.
    pub fn find_room(&mut self, mark: Vec2, radius: f64, words: &str) -> Option<Vec2> {
        let (width, off) = (text_width(words, SIZE), radius + GAP);
        let places = [
            Vec2::new(off, 0.35 * SIZE),
            Vec2::new(-off - width, 0.35 * SIZE),
            Vec2::new(-0.5 * width, -off),
            Vec2::new(-0.5 * width, off + 0.7 * SIZE),
            Vec2::new(0.5 * off, -off),
            Vec2::new(0.5 * off, off + 0.7 * SIZE),
            Vec2::new(-0.5 * off - width, -off),
            Vec2::new(-0.5 * off - width, off + 0.7 * SIZE),
        ];
        let boxed = |at: Vec2| [at - Vec2::new(0.0, 0.75 * SIZE), at + Vec2::new(width, 0.2 * SIZE)];
        let at = places.into_iter().map(|by| mark + by).find(|&at| self.is_free(boxed(at)))?;
        self.taken.push(boxed(at));
        Some(at)
    }

    fn is_free(&self, [low, high]: [Vec2; 2]) -> bool {
        let [top_left, bottom_right] = self.whole;
        let inside = low.x >= top_left.x && low.y >= top_left.y && high.x <= bottom_right.x && high.y <= bottom_right.y;
        let apart = |other: &[Vec2; 2]| {
            high.x <= other[0].x || other[1].x <= low.x || high.y <= other[0].y || other[1].y <= low.y
        };
        inside && self.taken.iter().all(apart)
    }
}
