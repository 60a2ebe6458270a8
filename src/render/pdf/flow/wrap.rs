//! Lines of text that are no wider than they may be.

use crate::render::pdf::letters::Style;

/// Text broken between words, and where it has breaks of its own; words that are too wide by themselves are broken, too.
pub(super) fn wrapped(text: &str, style: Style, width: f32) -> Vec<String> {
    let mut lines = Vec::new();
    for given in text.lines() {
        let mut line = String::new();
        for word in given.split_whitespace().flat_map(|word| broken(word, style, width)) {
            let longer = if line.is_empty() { word.clone() } else { format!("{line} {word}") };
            if line.is_empty() || style.width(&longer) <= width {
                line = longer;
            } else {
                lines.push(std::mem::replace(&mut line, word));
            }
        }
        lines.push(line);
    }
    lines
}

/// Text broken wherever it is full.
pub(super) fn broken(text: &str, style: Style, width: f32) -> Vec<String> {
    let (mut lines, mut line, mut room) = (Vec::new(), String::new(), width);
    for letter in text.chars() {
        let wide = style.width(letter.encode_utf8(&mut [0; 4]));
        if wide > room && !line.is_empty() {
            lines.push(std::mem::take(&mut line));
            room = width;
        }
        room -= wide;
        line.push(letter);
    }
    lines.push(line);
    lines
}
