//! Inverse of the rows of a basis.

/// The transposed inverse of a square matrix stored by rows, by Gauss-Jordan elimination with row exchanges. Most entries of such rows
/// are 0, and are passed over.
pub fn invert_transposed(matrix: &mut [f64], inverse: &mut [f64], n: usize) -> bool {
    // `inverse` is built by rows like the matrix and turned over at the end.
    inverse.fill(0.0);
    (0..n).for_each(|i| inverse[i * n + i] = 1.0);
    let [mut ahead, mut built] = [(); 2].map(|()| Vec::with_capacity(n));
    for k in 0..n {
        let largest = (k..n).max_by(|&a, &b| matrix[a * n + k].abs().total_cmp(&matrix[b * n + k].abs()));
        let Some(pivot) = largest.filter(|&i| matrix[i * n + k] != 0.0 && matrix[i * n + k].is_finite()) else {
            return false;
        };
        for m in [&mut *matrix, &mut *inverse] {
            (0..n).for_each(|j| m.swap(k * n + j, pivot * n + j));
        }
        let scale = 1.0 / matrix[k * n + k];
        // Columns of the matrix that are done with are not looked at again.
        scale_and_list(&mut matrix[k * n..(k + 1) * n], k + 1, scale, &mut ahead);
        scale_and_list(&mut inverse[k * n..(k + 1) * n], 0, scale, &mut built);
        for i in (0..n).filter(|&i| i != k) {
            let by = matrix[i * n + k];
            if by != 0.0 {
                ahead.iter().for_each(|&(j, x)| matrix[i * n + j] -= by * x);
                built.iter().for_each(|&(j, x)| inverse[i * n + j] -= by * x);
            }
        }
    }
    for i in 0..n {
        (0..i).for_each(|j| inverse.swap(i * n + j, j * n + i));
    }
    true
}

/// Scales the entries of a row from `first` on, and lists those that are not 0 with their columns.
fn scale_and_list(row: &mut [f64], first: usize, scale: f64, entries: &mut Vec<(usize, f64)>) {
    entries.clear();
    for (j, x) in row.iter_mut().enumerate().skip(first) {
        *x *= scale;
        entries.extend((*x != 0.0).then_some((j, *x)));
    }
}
