//! What elimination does to the dense rows of a front.

use crate::budget::{Budget, Stopped};
use crate::dda::panels::subtract_rows;
use crate::dda::tree::Run;
use pulp::{Arch, Simd, WithSimd};

/// Adds the entries of a square matrix, whose rows are `size` apart, into a front of rows that are `width` apart.
pub fn add_up(entries: &[f64], size: usize, runs: &[Run], width: usize, front: &mut [f64]) {
    for row in runs {
        for column in runs {
            let (from, into) = (&entries[row.from * size + column.from..], &mut front[row.to * width + column.to..]);
            match (row.length, column.length) {
                // Two contact points a joint: shapes known to the compiler run several times faster.
                (4, 4) => {
                    for i in 0..4 {
                        let of = (from.get(i * size..), into.get_mut(i * width..));
                        let (Some(from), Some(into)) = of else { return };
                        let of = (from.first_chunk::<4>(), into.first_chunk_mut::<4>());
                        let (Some(from), Some(into)) = of else { return };
                        (0..4).for_each(|j| into[j] += from[j]);
                    }
                }
                (rows, columns) => {
                    for i in 0..rows {
                        let (from, into) = (&from[i * size..][..columns], &mut into[i * width..][..columns]);
                        into.iter_mut().zip(from).for_each(|(sum, entry)| *sum += entry);
                    }
                }
            }
        }
    }
}

/// Copies so many entries: two contact points a joint without a call.
#[inline(always)]
pub fn copy(from: &[f64], into: &mut [f64], length: usize) {
    match length {
        4 => into[..4].copy_from_slice(&from[..4]),
        n => into[..n].copy_from_slice(&from[..n]),
    }
}

/// From rows [C | D] to C and D - C X, for what is removed and what is kept.
///
/// # Errors
/// When stopped.
pub fn reduce(
    rows: &[f64],
    x: &[f64],
    sizes: [usize; 2],
    [below, left]: [&mut [f64]; 2],
    budget: &Budget,
) -> Result<(), Stopped> {
    match sizes {
        [4, 4] => reduce_four(rows, x, below, left),
        [_, 0] => {}
        [0, _] => left.copy_from_slice(rows),
        sizes => return Arch::new().dispatch(Reduction { rows, x, sizes, into: [below, left], budget }),
    }
    Ok(())
}

/// The same where the compiler does not know the sizes, with the vector instructions that the processor has.
struct Reduction<'r> {
    rows: &'r [f64],
    x: &'r [f64],
    sizes: [usize; 2],
    into: [&'r mut [f64]; 2],
    budget: &'r Budget<'r>,
}

impl WithSimd for Reduction<'_> {
    type Output = Result<(), Stopped>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Reduction { rows, x, sizes: [removed, kept], into: [below, left], budget } = self;
        let into = below.chunks_exact_mut(removed).zip(left.chunks_exact_mut(kept));
        for (row, (below, left)) in rows.chunks_exact(removed + kept).zip(into) {
            let (c, d) = row.split_at(removed);
            below.copy_from_slice(c);
            left.copy_from_slice(d);
            subtract_rows(simd, c, x, [0, kept], left);
            budget.work(removed * kept)?;
        }
        Ok(())
    }
}

fn reduce_four(rows: &[f64], x: &[f64], below: &mut [f64], left: &mut [f64]) {
    let Some(x) = x.as_chunks::<4>().0.first_chunk::<4>() else { return };
    let into = below.as_chunks_mut::<4>().0.iter_mut().zip(left.as_chunks_mut::<4>().0);
    for (row, (below, left)) in rows.as_chunks::<8>().0.iter().zip(into) {
        below.copy_from_slice(&row[..4]);
        for j in 0..4 {
            left[j] = row[4 + j] - ((row[0] * x[0][j] + row[1] * x[1][j]) + (row[2] * x[2][j] + row[3] * x[3][j]));
        }
    }
}
