use super::*;
use crate::budget::Budget;
use crate::dda::elements::Pattern;
use crate::dda::tree::Elimination;
use crate::largest::largest;
use faer::linalg::solvers::Solve;
use std::ops::ControlFlow;

/// A fixed, well-spread sequence of numbers in (-1, 1).
pub(in crate::dda) fn numbers() -> impl Iterator<Item = f64> {
    (1u64..).map(|i| ((i * i) as f64 * 0.754_877_666).fract() * 2.0 - 1.0)
}

/// Faces of these sizes, tied by these elements.
fn pattern(sizes: &[usize], elements: &[&[usize]]) -> Pattern {
    let mut start = vec![0];
    sizes.iter().for_each(|n| start.push(start[start.len() - 1] + n));
    Pattern { start, faces: elements.iter().map(|faces| faces.to_vec()).collect() }
}

/// Faces in a row, each tied to the next.
fn row(sizes: &[usize]) -> Pattern {
    let elements: Vec<[usize; 2]> = (1..sizes.len()).map(|i| [i - 1, i]).collect();
    pattern(sizes, &elements.iter().map(|e| e.as_slice()).collect::<Vec<_>>())
}

/// Bodies in a row, three of which meet a fourth; loops; a part of its own; an element of one face; a face without unknowns.
fn patterns() -> Vec<Pattern> {
    let loops: [&[usize]; 8] = [&[0, 1], &[1, 2, 3], &[3, 4], &[4, 5, 0], &[5, 6], &[6, 7, 8], &[8, 2], &[7]];
    let forest: [&[usize]; 6] = [&[0, 1], &[1, 2], &[2, 3, 4], &[4, 5], &[6, 7], &[8]];
    vec![
        row(&[4, 4, 6, 2, 4, 5, 0]),
        row(&[4; 9]),
        row(&[4, 4, 4, 2, 4, 4, 4, 4]),
        pattern(&[4, 4, 2, 6, 4, 4, 3, 4, 2], &loops),
        pattern(&[4, 2, 4, 4, 0, 4, 4, 4, 2], &forest),
        pattern(&[3], &[&[0]]),
        cores(),
    ]
}

/// Four bodies of six unknowns, each tied to every other by two faces of four.
fn cores() -> Pattern {
    let pairs = (0..4).flat_map(|a| (a + 1..4).map(move |b| [a, b]));
    let of_pair = |(k, [a, b]): (usize, [usize; 2])| {
        let [before, after] = [4 + 2 * k, 5 + 2 * k];
        [vec![a, before], vec![before, after], vec![after, b]]
    };
    let elements: Vec<Vec<usize>> = pairs.enumerate().flat_map(of_pair).chain((0..4).map(|core| vec![core])).collect();
    let sizes: Vec<usize> = (0..16).map(|face| if face < 4 { 6 } else { 4 }).collect();
    pattern(&sizes, &elements.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

#[test]
fn the_two_faces_of_an_interface_between_cores_are_eliminated_together() {
    let tree = Tree::new(&cores(), |_| true, &Budget::unlimited()).unwrap();
    assert!(tree.fronts[..tree.directed()].iter().any(|front| front.sizes == [8, 12]));
    // Each of six interfaces saves one of 16, so at most 10; two more are pinned.
    assert_eq!(tree.into.len(), 8, "cliques of 16 faces and cores");
}

fn matrix(pattern: &Pattern) -> Elements {
    let (mut k, mut source) = (Elements::zeros(pattern), numbers());
    for element in 0..pattern.faces.len() {
        let n = pattern.size(element);
        k.get_mut(element).iter_mut().for_each(|x| *x = source.next().unwrap());
        (0..n).for_each(|j| k.get_mut(element)[j * (n + 1)] += 9.0);
    }
    k
}

/// Worst difference from faer's dense LU with partial pivoting over the whole matrix.
fn error(pattern: &Pattern, k: &Elements, b: &[f64], x: &[f64]) -> f64 {
    let mut dense = faer::Mat::<f64>::zeros(b.len(), b.len());
    for (element, faces) in pattern.faces.iter().enumerate() {
        let places: Vec<usize> = faces.iter().flat_map(|&face| pattern.range(face)).collect();
        for (at, value) in k.get(element).iter().enumerate() {
            dense[(places[at / places.len()], places[at % places.len()])] += *value;
        }
    }
    let rhs = faer::Mat::from_fn(b.len(), 1, |i, _| b[i]);
    let expected = dense.partial_piv_lu().solve(&rhs);
    largest((0..b.len()).map(|i| (x[i] - expected[(i, 0)]).abs()))
}

#[test]
fn factors_that_carry_no_right_hand_side_solve_for_any() {
    for pattern in patterns() {
        let (mut k, tree) = (matrix(&pattern), Tree::new(&pattern, |_| true, &Budget::unlimited()).unwrap());
        let b: Vec<f64> = numbers().take(pattern.unknowns()).collect();
        let (mut factor, mut x) = (Factor::new(&tree), vec![0.0; b.len()]);
        for change in [0, pattern.faces.len() - 1] {
            k.get_mut(change)[0] += 1.0;
            factor.invalidate(change);
            factor.refactor(&k, change, &Budget::unlimited()).unwrap();
            factor.solve(&b, &mut x, &Budget::unlimited()).unwrap();
            assert!(error(&pattern, &k, &b, &x) < 1e-13);
        }
    }
}

#[test]
fn agrees_with_a_dense_solver_wherever_the_change_is() {
    for pattern in patterns() {
        let (mut k, tree) = (matrix(&pattern), Tree::new(&pattern, |_| true, &Budget::unlimited()).unwrap());
        let mut factor = Factor::new(&tree);
        let n = pattern.unknowns();
        let mut source = numbers().skip(5000);
        let mut vector = || -> Vec<f64> { source.by_ref().take(n).collect() };
        let (mut b, other, mut x) = (vector(), vector(), vec![0.0; n]);
        for change in [3, 4, 0, 6, 5, 1, 1, 7, 2].map(|element| element % pattern.faces.len()) {
            if pattern.size(change) > 0 {
                k.get_mut(change)[pattern.size(change) - 1] += 1.5;
                let face = pattern.faces[change].iter().find(|&&face| !pattern.range(face).is_empty());
                b[pattern.start[*face.unwrap()]] -= 0.3;
            }
            factor.invalidate(change);
            factor.update(&k, &b, &mut x, change, &Budget::unlimited()).unwrap();
            assert!(error(&pattern, &k, &b, &x) < 1e-13);
            factor.solve(&other, &mut x, &Budget::unlimited()).unwrap();
            assert!(error(&pattern, &k, &other, &x) < 1e-13);
            assert!(factor.pivot_ratio() > 1e-3);
        }
    }
}

#[test]
fn until_the_next_update_the_factors_are_those_of_the_last() {
    for pattern in &patterns()[1..4] {
        until_the_next_update(pattern);
    }
}

fn until_the_next_update(pattern: &Pattern) {
    let (mut k, tree) = (matrix(pattern), Tree::new(pattern, |_| true, &Budget::unlimited()).unwrap());
    let (before, b, mut x) = (k.clone(), vec![1.0; pattern.unknowns()], vec![0.0; pattern.unknowns()]);
    let mut factor = Factor::new(&tree);
    factor.update(&k, &b, &mut x, 2, &Budget::unlimited()).unwrap();
    k.get_mut(5)[0] += 2.0;
    factor.invalidate(5);
    factor.solve(&b, &mut x, &Budget::unlimited()).unwrap();
    assert!(error(pattern, &before, &b, &x) < 1e-13);
    assert!(error(pattern, &k, &b, &x) > 1e-3);
}

#[test]
fn all_fronts_of_bodies_in_a_row_with_two_points_a_joint_are_links() {
    for (size, links) in [(4, 14), (6, 0)] {
        let tree = Tree::new(&row(&[size; 9]), |_| true, &Budget::unlimited()).unwrap();
        assert_eq!((tree.links.iter().flatten().count(), tree.directed()), (links, 14), "{size}");
    }
}

#[test]
fn a_change_costs_the_rows_between_it_and_the_last() {
    let pattern = row(&[4; 100]);
    let (k, tree) = (matrix(&pattern), Tree::new(&pattern, |_| true, &Budget::unlimited()).unwrap());
    let mut factor = Factor::new(&tree);
    let (b, mut x) = (vec![0.0; 400], vec![0.0; 400]);
    let mut cost = |element: usize| {
        let before = factor.eliminated();
        factor.invalidate(element);
        factor.update(&k, &b, &mut x, element, &Budget::unlimited()).unwrap();
        factor.eliminated() - before
    };
    // The two faces of the element last, and one for every element on the way.
    assert_eq!([cost(50), cost(53), cost(53), cost(43), cost(98)], [100, 5, 2, 12, 57]);
}

#[test]
fn arches_on_piers_tie_nothing_that_was_not() {
    // Two arches of ten stones on a pier of five, a skewback of three faces between them.
    let (mut sizes, mut elements) = (vec![4; 3], vec![vec![0, 1, 2]]);
    for (face, stones) in [(0, 10), (1, 10), (2, 5)] {
        let mut last = face;
        for _ in 0..stones {
            let n = sizes.len();
            sizes.extend([4, 4]);
            elements.extend([vec![last, n], vec![n, n + 1]]);
            last = n + 1;
        }
        elements.push(vec![last]);
    }
    let pattern = pattern(&sizes, &elements.iter().map(|e| e.as_slice()).collect::<Vec<_>>());
    let tree = Tree::new(&pattern, |_| true, &Budget::unlimited()).unwrap();
    let largest = tree.fronts.iter().map(|front| front.sizes[0] + front.sizes[1]).max();
    assert_eq!(largest, Some(12));
}

#[test]
fn a_singular_block_shows_in_the_pivot_ratio() {
    let pattern = pattern(&[4], &[&[0]]);
    let tree = Tree::new(&pattern, |_| true, &Budget::unlimited()).unwrap();
    let mut k = Elements::zeros(&pattern);
    k.get_mut(0).copy_from_slice(&[1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0.]);
    let mut factor = Factor::new(&tree);
    factor.update(&k, &[0.0; 4], &mut [0.0; 4], 0, &Budget::unlimited()).unwrap();
    assert!(factor.pivot_ratio() < 1e-14);
}

#[test]
fn what_eliminating_takes_is_counted_before_as_it_is_built() {
    for pattern in patterns() {
        let tree = Tree::new(&pattern, |_| true, &Budget::unlimited()).unwrap();
        let counted = Elimination::new(&pattern, |_| true, &Budget::unlimited()).unwrap();
        let (mut entries, mut largest) = ([0; 3], 0);
        for (number, front) in tree.fronts.iter().enumerate() {
            let [removed, kept] = front.sizes;
            let way = if number < tree.directed() { number % 2 } else { 2 };
            entries[way] += removed * removed + 2 * removed * kept + kept * kept;
            largest = largest.max((removed + kept).pow(2));
        }
        assert_eq!((counted.entries, counted.largest), (entries, largest));
    }
}

#[test]
fn a_large_front_is_not_eliminated_without_asking() {
    let pattern = row(&[300, 300, 300]);
    let (mut k, tree) = (Elements::zeros(&pattern), Tree::new(&pattern, |_| true, &Budget::unlimited()).unwrap());
    for element in 0..2 {
        k.get_mut(element).fill(1e-3);
        (0..600).for_each(|j| k.get_mut(element)[j * 601] += 9.0);
    }
    let asked = std::cell::Cell::new(0);
    let stops_at = |most: usize| {
        asked.set(0);
        let ask = |_| {
            asked.set(asked.get() + 1);
            if asked.get() < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        Factor::new(&tree).update(&k, &[1.0; 900], &mut [0.0; 900], 0, &Budget::new(&ask)).is_err()
    };
    assert!(!stops_at(usize::MAX));
    // Two fronts, of 300 and 600 unknowns: 1.4e8 multiplications, and a question every 4e6.
    let all = asked.get();
    assert!(all > 20, "{all}");
    for most in [1, all / 2, all] {
        assert!(stops_at(most) && asked.get() == most, "{} of {most}", asked.get());
    }
}
