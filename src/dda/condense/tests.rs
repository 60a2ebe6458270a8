use super::*;

/// A diagonally dominant matrix of `blocks` blocks of six unknowns, each tied to the next and to one some way off, and a
/// right-hand side.
fn system(blocks: usize, columns: usize) -> (Vec<Triplet<usize, usize, f64>>, DMatrix<f64>) {
    let number = |i: usize, j: usize| ((i * 31 + j * 17) as f64 * 0.754_877_666).fract() - 0.5;
    let far = (blocks as f64).sqrt() as usize;
    let mut triplets = Vec::new();
    for (b, c) in (0..blocks).flat_map(|b| [(b, b), (b, b + 1), (b, b + far)]).filter(|&(_, c)| c < blocks) {
        for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (6 * b + i, 6 * c + j))).filter(|(i, j)| i < j) {
            triplets.extend([Triplet::new(i, j, number(i, j)), Triplet::new(j, i, number(i, j))]);
        }
    }
    triplets.extend((0..6 * blocks).map(|i| Triplet::new(i, i, 30.0)));
    let right = |i: usize, j: usize| if (7 * i + 13 * j) % 97 < 3 { number(j, i) } else { 0.0 };
    (triplets, DMatrix::from_fn(6 * blocks, columns, right))
}

#[test]
fn entries_of_one_place_are_added_up_as_the_solver_would() {
    let (mut triplets, _) = system(100, 1);
    // Many to a place, in no order.
    let more = |i: usize| Triplet::new(i * 7 % 600, i * i % 11, (i as f64 * 0.754_877_666).fract());
    triplets.extend((0..5000).map(more));
    let ours = assemble(600, &triplets, &Heart::unwatched()).unwrap();
    let theirs = SparseColMat::try_new_from_triplets(600, 600, &triplets).unwrap();
    assert_eq!(ours.col_ptr(), theirs.col_ptr());
    assert_eq!(ours.row_idx(), theirs.row_idx());
    assert!(ours.val().iter().zip(theirs.val()).all(|(a, b)| a.to_bits() == b.to_bits()));
}

#[test]
fn a_part_of_the_columns_at_a_time_gives_the_same_to_the_last_bit() {
    let heart = Heart::unwatched();
    let bits = |m: &DMatrix<f64>| m.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    for (blocks, columns) in [(1, 16), (1, 31), (1, 100), (16, 32), (100, 63), (400, 47), (400, 100), (576, 200)] {
        let (triplets, right) = system(blocks, columns);
        let n = 6 * blocks;
        let sparse = assemble(n, &triplets, &heart).unwrap();
        let factors = match blocks {
            1 => Factors::Dense(sparse.to_dense().llt(Side::Lower).unwrap()),
            _ => Factors::Sparse(sparse.sp_cholesky(Side::Lower).unwrap()),
        };
        let whole = solve_some(&factors, &Mat::from_fn(n, columns, |i, j| right[(i, j)]));
        let whole = DMatrix::from_fn(n, columns, |i, j| whole[(i, j)]);
        let parts = solve(&factors, &right, &heart).unwrap();
        assert!(bits(&parts) == bits(&whole), "{blocks} blocks, {columns} columns");
        let transposed = right.transpose();
        let product = product(&transposed, &parts, &heart).unwrap();
        assert!(bits(&product) == bits(&(transposed * parts)), "{blocks} blocks, {columns} columns");
    }
}
