//! Tests of `files::matrix_file`, a module of it.

use super::*;

#[test]
fn all_forms_are_read() {
    let wanted = DMatrix::from_row_slice(2, 2, &[1.0, 2.5, 2.5, -3.0]);
    for text in [
        "%%MatrixMarket matrix array real general\n% words\n2 2\n1\n2.5\n2.5\n-3\n",
        "%%MatrixMarket matrix array real symmetric\n2 2\n1 2.5\n-3\n",
        "%%MatrixMarket matrix coordinate real symmetric\n\n2 2 3\n1 1 1\n2 1 2.5d0\n2 2 -3e0\n",
        "%%matrixmarket MATRIX coordinate double general\n2 2 4\n1 1 1\n2 1 2.5\n1 2 2.5\n2 2 -3\n",
    ] {
        assert_eq!(matrix(text), Ok(wanted.clone()), "{text}");
    }
}

#[test]
fn what_is_written_is_read_again_to_the_last_bit() {
    let numbers = [0.1, 1.0 / 3.0, -2e-310, 6.02e23];
    let text = crate::files::matrix_market::full_matrix("", [2, 2], |row, column| numbers[2 * row + column]);
    assert_eq!(matrix(&text), Ok(DMatrix::from_row_slice(2, 2, &numbers)));
}

#[test]
fn mistakes_are_reported_with_their_line() {
    let heading = "%%MatrixMarket matrix coordinate real general\n";
    for (text, words) in [
        ("1 2 3".to_owned(), "the first line"),
        ("%%MatrixMarket matrix array complex general\n".to_owned(), "`complex`"),
        ("%%MatrixMarket matrix array real skew-symmetric\n".to_owned(), "`skew-symmetric`"),
        (format!("{heading}2 2\n"), "line 2: the numbers of rows, columns and entries"),
        (format!("{heading}2 2 1\n1 3 1.0\n"), "line 3: there is no entry (1, 3)"),
        (format!("{heading}2 2 1\n1 1 nan\n"), "line 3: `nan`"),
        (format!("{heading}2 2 2\n1 1 1.0\n"), "1 entries where 2"),
        (format!("{heading}2 2 1\n1 1\n"), "line 3: row, column and value"),
        ("%%MatrixMarket matrix array real general\n2 1\n1\n".to_owned(), "1 entries where 2"),
        ("%%MatrixMarket matrix array real general\n100000 1\n".to_owned(), "more than a model"),
    ] {
        let problem = matrix(&text).unwrap_err().to_string();
        assert!(problem.contains(words), "{text}: {problem}");
    }
}
