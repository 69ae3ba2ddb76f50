//! Matrices as texts in the Matrix Market format, which SciPy, MATLAB, Julia and others read.

use std::fmt::Write;

/// A sparse matrix of `rows` by `columns`, from its entries by row and column, counted from 0; zeros are omitted.
pub fn sparse_matrix(
    comment: &str,
    [rows, columns]: [usize; 2],
    entries: impl Iterator<Item = (usize, usize, f64)>,
) -> String {
    let kept: Vec<_> = entries.filter(|&(_, _, value)| value != 0.0).collect();
    let mut text = format!("%%MatrixMarket matrix coordinate real general\n% {comment}\n");
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{rows} {columns} {}", kept.len());
    for (row, column, value) in kept {
        let _ = writeln!(text, "{} {} {value:?}", row + 1, column + 1);
    }
    text
}

/// A full matrix of `rows` by `columns`, from its entries.
pub fn full_matrix(
    comment: &str,
    [rows, columns]: [usize; 2],
    entry: impl Fn(usize, usize) -> f64,
) -> String {
    let mut text = format!("%%MatrixMarket matrix array real general\n% {comment}\n{rows} {columns}\n");
    for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row))) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:?}", entry(row, column));
    }
    text
}

#[cfg(test)]
#[path = "../../tests/unit/files/matrix_market.rs"]
mod tests;
