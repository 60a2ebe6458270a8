//! Where the lines of a grid lie.

use crate::collapse::Spacing;
use std::f64::consts::{FRAC_PI_2, PI};

/// Places, from 0 to 1, of the ends of so many intervals either way. Graded ones lie close together towards both ends; in one of `several`
/// parts, whose other end is inside the stone, towards 0 alone.
pub(super) fn lines(spacing: Spacing, counts: [usize; 2], several: bool) -> [Vec<f64>; 2] {
    let place = |share: f64| match spacing {
        Spacing::Even => share,
        Spacing::Graded if several => 1.0 - (FRAC_PI_2 * share).cos(),
        Spacing::Graded => 0.5 - 0.5 * (PI * share).cos(),
    };
    counts.map(|count| (0..=count).map(|i| if i == count { 1.0 } else { place(i as f64 / count as f64) }).collect())
}

/// Number of the interval between lines in which a place lies: one, or the two beside a line, with the same share each.
pub(super) fn shares(place: f64, lines: &[f64], near: f64) -> [(usize, f64); 2] {
    let last = lines.len() - 2;
    let above = lines[1..=last].partition_point(|line| *line <= place);
    let on = |line: usize| {
        let width = (lines[line] - lines[line - 1]).min(lines[line + 1] - lines[line]);
        (1..=last).contains(&line) && (place - lines[line]).abs() < near * width
    };
    match [above, above + 1].into_iter().find(|&line| line > 0 && line <= last && on(line)) {
        Some(line) => [(line - 1, 0.5), (line, 0.5)],
        None => [(above, 1.0), (0, 0.0)],
    }
}
