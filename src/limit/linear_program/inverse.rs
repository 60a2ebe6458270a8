//! Inverse of the rows of a basis.

/// The transposed inverse of a square matrix stored by rows, by Gauss-Jordan elimination with row exchanges.
pub fn invert_transposed(matrix: &mut [f64], inverse: &mut [f64], n: usize) -> bool {
    // `inverse` is built by rows like the matrix and turned over at the end.
    inverse.fill(0.0);
    (0..n).for_each(|i| inverse[i * n + i] = 1.0);
    for k in 0..n {
        let largest = (k..n).max_by(|&a, &b| matrix[a * n + k].abs().total_cmp(&matrix[b * n + k].abs()));
        let Some(pivot) = largest.filter(|&i| matrix[i * n + k] != 0.0 && matrix[i * n + k].is_finite()) else {
            return false;
        };
        for m in [&mut *matrix, &mut *inverse] {
            (0..n).for_each(|j| m.swap(k * n + j, pivot * n + j));
        }
        let scale = 1.0 / matrix[k * n + k];
        for m in [&mut *matrix, &mut *inverse] {
            m[k * n..(k + 1) * n].iter_mut().for_each(|x| *x *= scale);
        }
        for i in (0..n).filter(|&i| i != k) {
            let by = matrix[i * n + k];
            if by == 0.0 {
                continue;
            }
            for m in [&mut *matrix, &mut *inverse] {
                for j in 0..n {
                    m[i * n + j] -= by * m[k * n + j];
                }
            }
        }
    }
    for i in 0..n {
        (0..i).for_each(|j| inverse.swap(i * n + j, j * n + i));
    }
    true
}
