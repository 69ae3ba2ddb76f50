//! Columns of numbers in a text file: one heading with the names of the columns, then one line per row, with commas,
//! semicolons or tabs between. Empty lines and lines that begin with `#` are passed over.

/// A file that is no table of numbers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum DataError {
    /// There is no heading.
    #[error("the file has no heading with the names of its columns")]
    Empty,
    /// The first line contains numbers.
    #[error("line {0}: the first line must name the columns, but holds numbers")]
    NoHeading(usize),
    /// A column is not there.
    #[error("there is no column `{name}` in the heading of line {line}")]
    NoColumn {
        /// The request.
        name: String,
        /// Line of the heading.
        line: usize,
        /// Names that are there.
        known: Vec<String>,
    },
    /// Two columns have the name.
    #[error("line {line}: two columns are called `{name}`")]
    Twice {
        /// The name.
        name: String,
        /// Line of the heading.
        line: usize,
    },
    /// A column of a grid is named by no number.
    #[error("line {line}: `{cell}` is no value of y")]
    NoValue {
        /// Line of the heading.
        line: usize,
        /// The name.
        cell: String,
    },
    /// There are fewer than two columns.
    #[error("line {0}: two columns are needed")]
    OneColumn(usize),
    /// A cell is missing or no number.
    #[error("line {line}: `{cell}` in column `{column}` is not a finite number")]
    NotANumber {
        /// Line of the file, from 1.
        line: usize,
        /// The actual value.
        cell: String,
        /// Name of the column.
        column: String,
    },
}

/// Rows of two columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rows {
    /// The rows.
    pub(crate) values: Vec<(f64, f64)>,
    /// The line of each row, from 1.
    pub(crate) lines: Vec<usize>,
}

/// The two columns called `names`, or the first two.
pub(crate) fn two_columns(text: &str, names: Option<[&str; 2]>) -> Result<Rows, DataError> {
    let columns = columns(text, |heading, line| match names {
        Some(names) => Ok(vec![column(heading, names[0], line)?, column(heading, names[1], line)?]),
        None if heading.len() < 2 => Err(DataError::OneColumn(line)),
        None => Ok(vec![0, 1]),
    })?;
    let values = columns.rows.iter().map(|row| (row[0], row[1])).collect();
    Ok(Rows { values, lines: columns.lines })
}

/// Values of y, and rows of x and the values at these y, of a file whose heading is a name and the values of y.
pub(crate) fn grid(text: &str) -> Result<(Vec<f64>, Vec<Vec<f64>>), DataError> {
    let columns = columns(text, |heading, line| {
        if heading.len() < 2 { Err(DataError::OneColumn(line)) } else { Ok((0..heading.len()).collect()) }
    })?;
    let across = columns.heading[1..].iter().map(|cell| {
        let problem = || DataError::NoValue { line: columns.heading_line, cell: cell.clone() };
        cell.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(problem)
    });
    Ok((across.collect::<Result<_, _>>()?, columns.rows))
}

/// Columns of a file.
struct Columns {
    heading: Vec<String>,
    heading_line: usize,
    rows: Vec<Vec<f64>>,
    lines: Vec<usize>,
}

/// The columns that `choose` takes of the heading with its line.
fn columns(
    text: &str,
    choose: impl Fn(&[String], usize) -> Result<Vec<usize>, DataError>,
) -> Result<Columns, DataError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = (text.lines().enumerate())
        .map(|(index, line)| (index + 1, line.trim_end()))
        .filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let (line, heading) = lines.next().ok_or(DataError::Empty)?;
    let separator =
        [';', '\t', ','].into_iter().find(|separator| heading.contains(*separator)).unwrap_or(',');
    let cells = |line: &str| -> Vec<String> {
        line.split(separator).map(|cell| cell.trim().trim_matches('"').trim().to_owned()).collect()
    };
    let heading = cells(heading);
    if heading.iter().all(|cell| cell.parse::<f64>().is_ok()) {
        return Err(DataError::NoHeading(line));
    }
    let chosen = choose(&heading, line)?;
    let mut columns = Columns { heading, heading_line: line, rows: Vec::new(), lines: Vec::new() };
    for (line, text) in lines {
        let row = cells(text);
        let number = |column: usize| {
            let cell = row.get(column).map_or("", String::as_str);
            cell.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| DataError::NotANumber {
                line,
                cell: cell.to_owned(),
                column: columns.heading[column].clone(),
            })
        };
        let numbers = chosen.iter().map(|column| number(*column)).collect::<Result<_, _>>()?;
        columns.rows.push(numbers);
        columns.lines.push(line);
    }
    Ok(columns)
}

fn column(heading: &[String], name: &str, line: usize) -> Result<usize, DataError> {
    let mut found = heading.iter().enumerate().filter(|(_, known)| *known == name);
    match (found.next(), found.next()) {
        (Some((index, _)), None) => Ok(index),
        (Some(_), Some(_)) => Err(DataError::Twice { name: name.to_owned(), line }),
        _ => Err(DataError::NoColumn { name: name.to_owned(), line, known: heading.to_vec() }),
    }
}

#[cfg(test)]
#[path = "../../tests/unit/files/data_file.rs"]
mod tests;
