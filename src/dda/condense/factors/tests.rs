use super::*;
use crate::budget::Budget;
use crate::dda::block::M6;
use faer::sparse::Triplet;

/// A block of numbers, symmetric where asked.
fn block(seed: usize) -> M6 {
    M6::from_fn(|a, b| ((seed * 31 + a * 17 + b * 5) as f64 * 0.754_877_666).fract() - 0.5)
}

#[test]
fn blocks_of_one_place_are_added_up_as_the_solver_would() {
    let blocks = 50;
    // Many to a place, in no order, each with its mirror image.
    let pairs: Vec<(usize, usize, M6)> = (0..2000).map(|s| (s * 7 % blocks, s * s % 11, block(s))).collect();
    let all = |add: &mut Add| {
        for (i, j, block) in &pairs {
            add(*i, *j, block.as_slice());
            add(*j, *i, block.transpose().as_slice());
        }
    };
    let mut triplets = Vec::new();
    all(&mut |i, j, block| {
        if i >= j {
            let entries = (0..36).map(|e| (e / 6, e % 6));
            triplets.extend(entries.map(|(a, b)| Triplet::new(6 * i + a, 6 * j + b, block[6 * b + a])));
        }
    });
    let ours = assemble([blocks, 6], all, &Budget::unlimited()).unwrap();
    let theirs = SparseColMat::try_new_from_triplets(6 * blocks, 6 * blocks, &triplets).unwrap();
    assert_eq!(ours.col_ptr(), theirs.col_ptr());
    assert_eq!(ours.row_idx(), theirs.row_idx());
    assert!(ours.val().iter().zip(theirs.val()).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn a_single_subblock_is_solved_for_one_load() {
    let stiffness = block(3) * block(3).transpose() + M6::identity();
    let factors = Factors::Dense(Mat::from_fn(6, 6, |i, j| stiffness[(i, j)]).llt(Side::Lower).unwrap());
    let load = DVector::from_fn(6, |i, _| (i as f64 - 2.3).sin());
    assert!((stiffness * factors.solve_one(&load) - load).norm() < 1e-14);
}
