//! Words at the top of a sheet.

use super::canvas::{Canvas, WIDTH};
use super::labels::extent;
use crate::geometry::Vec2;

/// Left edge of words at the top, pixels.
const EDGE: f64 = 40.0;
/// Height of their first line, pixels.
const FIRST_LINE: f64 = 40.0;
/// Height of every further line, pixels.
const LINE: f64 = 22.0;

/// Words at the top of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    titles: Vec<String>,
    lines: Vec<String>,
}

impl Heading {
    /// A title and what stands below it, in lines as wide as the sheet.
    pub fn new(title: &str, below: &str) -> Self {
        let lines = below.lines().flat_map(|line| broken(line, 15.0)).collect();
        Heading { titles: broken(title, 19.0), lines }
    }

    /// Where it ends, pixels.
    pub fn height(&self) -> f64 {
        FIRST_LINE + LINE * (self.titles.len() + self.lines.len()) as f64 - 8.0
    }
}

/// Words in lines that fit on the sheet with letters of this size.
fn broken(words: &str, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split_whitespace() {
        match lines.last_mut() {
            Some(line) if extent(&format!("{line} {word}"), size).x <= WIDTH - 2.0 * EDGE => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

impl Canvas {
    /// A title and lines below it, at the top of the sheet.
    pub fn heading(&mut self, heading: &Heading) {
        let (mut y, titles) = (FIRST_LINE, heading.titles.len());
        for (i, line) in heading.titles.iter().chain(&heading.lines).enumerate() {
            let class = if i < titles { "title" } else { "line" };
            self.text(class, Vec2::new(EDGE, y), line);
            y += if i + 1 == titles { LINE + 2.0 } else { LINE };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_is_broken_between_words() {
        let heading = Heading::new(&"word ".repeat(40), "short\nshort");
        assert!(heading.titles.len() > 1 && heading.titles.iter().all(|line| extent(line, 19.0).x <= WIDTH - 80.0));
        assert_eq!((heading.titles.join(" ").split(' ').count(), heading.lines.len()), (40, 2));
        assert!(heading.height() > Heading::new("word", "").height());
    }
}
