//! Matrices in texts of the Matrix Market format [Boisvert, Pozo and Remington 1996]: full or by entries, real or integer,
//! general or symmetric.

use nalgebra::DMatrix;

/// Rows or columns that no matrix of a model has.
const MAX_ROWS: usize = 10_000;

/// A text that is no matrix.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum MatrixError {
    /// The first line is another.
    #[error("the first line must be `%%MatrixMarket matrix …`")]
    NoHeading,
    /// A word of the first line means something that is not read.
    #[error(
        "matrices that are `{0}` are not read; write it `coordinate` or `array`, `real`, `general` or `symmetric`"
    )]
    Unknown(String),
    /// The sizes are missing.
    #[error("line {line}: {wanted} must be here")]
    Sizes {
        /// Line from 1.
        line: usize,
        /// The required type.
        wanted: &'static str,
    },
    /// Something is no number.
    #[error("line {line}: `{word}` is not a finite number")]
    NotANumber {
        /// Line from 1.
        line: usize,
        /// The actual value.
        word: String,
    },
    /// An entry is outside.
    #[error("line {line}: there is no entry ({row}, {column}) in a matrix of {rows} by {columns}")]
    Outside {
        /// Line from 1.
        line: usize,
        /// Row from 1.
        row: usize,
        /// Column from 1.
        column: usize,
        /// Rows.
        rows: usize,
        /// Columns.
        columns: usize,
    },
    /// There are more or fewer entries than announced.
    #[error("there are {found} entries where {wanted} are announced")]
    Count {
        /// How many there are.
        found: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// It is too large.
    #[error("{0} rows or columns are more than a model can hold")]
    TooLarge(usize),
}

/// The matrix of a text.
pub(crate) fn matrix(text: &str) -> Result<DMatrix<f64>, MatrixError> {
    let mut lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    let heading = lines.next().ok_or(MatrixError::NoHeading)?.1.to_lowercase();
    let mut words = heading.split_whitespace();
    if words.next() != Some("%%matrixmarket") || words.next() != Some("matrix") {
        return Err(MatrixError::NoHeading);
    }
    let mut word = |known: &[&str]| match words.next() {
        Some(word) if known.contains(&word) => Ok(word.to_owned()),
        word => Err(MatrixError::Unknown(word.unwrap_or("").to_owned())),
    };
    let is_full = word(&["coordinate", "array"])? == "array";
    word(&["real", "double", "integer"])?;
    let is_symmetric = word(&["general", "symmetric"])? == "symmetric";
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('%'));
    let wanted =
        if is_full { "the numbers of rows and columns" } else { "the numbers of rows, columns and entries" };
    let (line, sizes) = lines.next().ok_or(MatrixError::Sizes { line: 2, wanted })?;
    let sizes: Vec<usize> =
        sizes.split_whitespace().map(str::parse).collect::<Result<_, _>>().unwrap_or_default();
    let (rows, columns, count) = match (sizes.as_slice(), is_full) {
        ([rows, columns], true) => (*rows, *columns, None),
        ([rows, columns, count], false) => (*rows, *columns, Some(*count)),
        _ => return Err(MatrixError::Sizes { line, wanted }),
    };
    if rows.max(columns) > MAX_ROWS {
        return Err(MatrixError::TooLarge(rows.max(columns)));
    }
    if is_symmetric && rows != columns {
        return Err(MatrixError::Unknown(format!("symmetric with {rows} rows and {columns} columns")));
    }
    let mut matrix = DMatrix::zeros(rows, columns);
    let mut set = |row: usize, column: usize, value: f64| {
        // Entries that occur twice add up, as those of elements do.
        matrix[(row, column)] += value;
        if is_symmetric && row != column {
            matrix[(column, row)] += value;
        }
    };
    let number = |line: usize, word: &str| {
        let value = word.replace(['d', 'D'], "e").parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| MatrixError::NotANumber { line, word: word.to_owned() })
    };
    let mut found = 0;
    if let Some(wanted) = count {
        for (line, text) in lines {
            let words: Vec<&str> = text.split_whitespace().collect();
            let &[row, column, value] = words.as_slice() else {
                return Err(MatrixError::Sizes { line, wanted: "row, column and value" });
            };
            let index = |word: &str| {
                word.parse::<usize>().map_err(|_| MatrixError::NotANumber { line, word: word.to_owned() })
            };
            let (row, column, value) = (index(row)?, index(column)?, number(line, value)?);
            if !(1..=rows).contains(&row) || !(1..=columns).contains(&column) {
                return Err(MatrixError::Outside { line, row, column, rows, columns });
            }
            set(row - 1, column - 1, value);
            found += 1;
        }
        return if found == wanted { Ok(matrix) } else { Err(MatrixError::Count { found, wanted }) };
    }
    // Column by column; of symmetric ones the lower half.
    let mut places = (0..columns)
        .flat_map(|column| (if is_symmetric { column } else { 0 }..rows).map(move |row| (row, column)));
    let wanted = if is_symmetric { rows * (rows + 1) / 2 } else { rows * columns };
    for (line, text) in lines {
        for word in text.split_whitespace() {
            let value = number(line, word)?;
            found += 1;
            if let Some((row, column)) = places.next() {
                set(row, column, value);
            }
        }
    }
    if found == wanted { Ok(matrix) } else { Err(MatrixError::Count { found, wanted }) }
}

#[cfg(test)]
#[path = "../../tests/unit/files/matrix_file.rs"]
mod tests;
