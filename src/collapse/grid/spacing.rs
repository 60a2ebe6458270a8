//! Where the lines of a grid lie.

use super::{Cut, Held, ON_LINE};
use crate::collapse::Spacing;

/// How steep graded lines are towards a face, a joint, the ground, and a side next to that on the ground: with these the stress of six
/// arches is nearest to that of finite elements, in the mean over 4 x 4 to 16 x 16 subblocks.
const FACE: f64 = 1.4;
const JOINT: f64 = 1.5;
const GROUND: f64 = 2.0;
const NEXT_TO_GROUND: f64 = 1.7;
/// The same towards a force on a point, or the end of a joint within a side (2 makes no answer of five arches with a force better).
const FORCE: f64 = 1.5;

/// Places, from 0 to 1, of the ends of so many intervals either way.
///
/// Graded ones lie at u^a / (u^a + (1 - u)^b) for even shares u, with the [`steepness`] a and b of the two ends; in one of `several` parts,
/// whose other end is inside the stone, as in half of that; and where a line has to go through a place in between, on either side of that.
pub(super) fn lines(cut: Cut, counts: [usize; 2], several: bool) -> [Vec<f64>; 2] {
    [0, 1].map(|way| {
        let (count, steepness) = (counts[way], steepness(cut.held, way));
        let place = |line: usize| {
            let share = line as f64 / count as f64;
            match cut.spacing {
                Spacing::Even => share,
                Spacing::Graded if several => 2.0 * graded(0.5 * share, steepness),
                Spacing::Graded => beside(cut.pressed[way], [line, count], steepness),
            }
        };
        (0..=count).map(|line| if line == count { 1.0 } else { place(line) }).collect()
    })
}

fn graded(share: f64, [a, b]: [f64; 2]) -> f64 {
    let [near, far] = [share.powf(a), (1.0 - share).powf(b)];
    near / (near + far)
}

/// Place of a line of so many intervals of which one may have to go through a place in between.
fn beside(pressed: Option<f64>, [line, count]: [usize; 2], [a, b]: [f64; 2]) -> f64 {
    let within = |from: usize, to: usize| (line - from) as f64 / (to - from) as f64;
    match pressed.and_then(|at| Some((at, line_through(at, count)?))) {
        None => graded(within(0, count), [a, b]),
        Some((at, through)) if line < through => at * graded(within(0, through), [a, FORCE]),
        Some((at, through)) => at + (1.0 - at) * graded(within(through, count), [FORCE, b]),
    }
}

/// Number of the line that goes through this place, of so many intervals: those next to it are as long on either side, about.
/// None where two numbers do as well: a stone and its mirror image are to have the same lines.
fn line_through(place: f64, count: usize) -> Option<usize> {
    // The first of n intervals is about n^-FORCE of the way.
    let [before, after] = [place, 1.0 - place].map(|way| way.powf(1.0 / FORCE));
    let among = (count as f64 * before / (before + after)).clamp(1.0, (count as f64 - 1.0).max(1.0));
    let tells = count > 1 && (among.fract() - 0.5).abs() > ON_LINE;
    tells.then_some(among.round() as usize)
}

/// Towards either end across (0) or along (1).
fn steepness(held: Held, way: usize) -> [f64; 2] {
    let free = match way {
        _ if held[1 - way].contains(&true) => NEXT_TO_GROUND,
        0 => FACE,
        _ => JOINT,
    };
    held[way].map(|held| if held { GROUND } else { free })
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

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: Held = [[false; 2]; 2];
    const EXACT: f64 = 1e-15;

    fn graded_lines(held: Held, counts: [usize; 2], several: bool) -> [Vec<f64>; 2] {
        lines(Cut { spacing: Spacing::Graded, held, ..Cut::default() }, counts, several)
    }

    #[test]
    fn graded_lines_part_a_stone_as_the_formula_says() {
        // 0.25^1.4 / (0.25^1.4 + 0.75^1.4), by the exponential function.
        let third = (-1.4 * 3.0f64.ln()).exp();
        let [across, along] = graded_lines(FREE, [4, 2], false);
        assert!((across[1] - third / (1.0 + third)).abs() < EXACT && (along[1] - 0.5).abs() < EXACT);
        // 0.5^2 / (0.5^2 + 0.5^1.5): nearer to the ground.
        let [_, along] = graded_lines([[false; 2], [true, false]], [4, 2], false);
        assert!((along[1] - 1.0 / (1.0 + 2.0f64.sqrt())).abs() < EXACT, "{along:?}");
        // And steeper across where that ground is.
        let third = (-1.7 * 3.0f64.ln()).exp();
        let [across, _] = graded_lines([[false; 2], [true, false]], [4, 2], false);
        assert!((across[1] - third / (1.0 + third)).abs() < EXACT, "{across:?}");
    }

    #[test]
    fn lines_rise_from_end_to_end_and_a_mirrored_stone_has_mirrored_ones() {
        for sides in 0..16 {
            let on = |side: usize| sides >> side & 1 == 1;
            let [here, there] = [[[on(0), on(1)], [on(2), on(3)]], [[on(1), on(0)], [on(3), on(2)]]];
            let [here, there] = [here, there].map(|held| graded_lines(held, [7, 48], false));
            for (here, there) in here.iter().zip(&there) {
                assert!(here[0] == 0.0 && here[here.len() - 1] == 1.0 && here.windows(2).all(|two| two[0] < two[1]));
                let apart = |(x, y): (&f64, &f64)| (x + y - 1.0).abs();
                assert!(here.iter().zip(there.iter().rev()).map(apart).all(|apart| apart < EXACT));
            }
        }
    }

    #[test]
    fn a_part_of_several_is_divided_as_half_of_a_stone() {
        let [half, whole] = [([3, 3], true), ([6, 6], false)].map(|(n, several)| graded_lines(FREE, n, several));
        for (half, whole) in half.iter().zip(&whole) {
            assert!(
                half.iter().zip(whole).all(|(half, whole)| (0.5 * half - whole).abs() < EXACT),
                "{half:?} {whole:?}"
            );
        }
    }
    #[test]
    fn a_line_goes_through_a_force_and_others_are_close_to_it() {
        let along = |at: f64, count: usize| {
            let pressed = [None, Some(at)];
            lines(Cut { spacing: Spacing::Graded, pressed, ..Cut::default() }, [3, count], false)[1].clone()
        };
        // As in two stones, one on either side of the force: 0.2^(2/3) to 0.8^(2/3) is 2.8 to 7.2.
        let [few, many] = [3, 7].map(|count| graded_lines(FREE, [3, count], false)[1].clone());
        for (line, place) in along(0.2, 10).iter().enumerate() {
            let expected = if line < 3 { 0.2 * few[line] } else { 0.2 + 0.8 * many[line - 3] };
            assert!((place - expected).abs() < EXACT, "{line}: {place}");
        }
        for (at, count) in [(0.02, 2), (0.1, 3), (0.3, 7), (0.5, 4), (0.37, 48)] {
            let (here, there) = (along(at, count), along(1.0 - at, count));
            assert!(here.contains(&at) && here.windows(2).all(|two| two[0] < two[1]), "{at} {count}: {here:?}");
            assert!(here.iter().zip(there.iter().rev()).all(|(x, y)| (x + y - 1.0).abs() < EXACT), "{at} {count}");
        }
        // In the middle of three there is none, and of one none at all.
        assert_eq!(along(0.5, 3), graded_lines(FREE, [3, 3], false)[1]);
        assert_eq!(along(0.3, 1), [0.0, 1.0]);
    }
}
