//! Structurally symmetric sparse patterns in compressed columns. Positions only, no values.

use crate::scalar::Scalar;

/// Positions of the entries of a structurally symmetric matrix: compressed columns, rows sorted, the whole diagonal
/// present. Values are stored elsewhere, one per entry, in the order of [`Pattern::row_indices`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    size: usize,
    column_starts: Vec<usize>,
    row_indices: Vec<usize>,
}

impl Pattern {
    /// The pattern in which every clique couples all of its unknowns with each other.
    ///
    /// # Panics
    /// If a clique names an unknown that is not below `size`.
    pub fn from_cliques<'a>(size: usize, cliques: impl IntoIterator<Item = &'a [usize]>) -> Pattern {
        let mut members = Vec::new();
        let mut starts = vec![0];
        for clique in cliques {
            members.extend_from_slice(clique);
            starts.push(members.len());
        }
        assert!(members.iter().all(|&unknown| unknown < size), "a clique names an unknown beyond the size");
        let clique_of = |position: usize| starts.partition_point(|&start| start <= position) - 1;
        let mut memberships: Vec<Vec<usize>> = vec![Vec::new(); size];
        let mut clique = 0;
        for (position, &unknown) in members.iter().enumerate() {
            if position >= starts[clique + 1] {
                clique = clique_of(position);
            }
            if memberships[unknown].last() != Some(&clique) {
                memberships[unknown].push(clique);
            }
        }

        let mut column_starts = Vec::with_capacity(size + 1);
        column_starts.push(0);
        let mut row_indices: Vec<usize> = Vec::new();
        let mut seen = vec![usize::MAX; size];
        for column in 0..size {
            let begin = row_indices.len();
            let cliques = &memberships[column];
            // The coordinates of one node are in the same cliques: their columns are copies of each other.
            if column > 0 && !cliques.is_empty() && *cliques == memberships[column - 1] {
                row_indices.extend_from_within(column_starts[column - 1]..begin);
            } else {
                seen[column] = column;
                row_indices.push(column);
                for &clique in cliques {
                    for &row in &members[starts[clique]..starts[clique + 1]] {
                        if seen[row] != column {
                            seen[row] = column;
                            row_indices.push(row);
                        }
                    }
                }
                row_indices[begin..].sort_unstable();
            }
            column_starts.push(row_indices.len());
        }
        Pattern { size, column_starts, row_indices }
    }

    /// The smallest structurally symmetric pattern with a full diagonal that contains the given `(row, column)`
    /// positions, which may be repeated.
    ///
    /// # Panics
    /// If a position is not below `size`.
    pub fn from_entries(size: usize, entries: impl IntoIterator<Item = (usize, usize)>) -> Pattern {
        let mut columns: Vec<Vec<usize>> = (0..size).map(|unknown| vec![unknown]).collect();
        for (row, column) in entries {
            assert!(row < size && column < size, "an entry lies beyond the size");
            columns[column].push(row);
            columns[row].push(column);
        }
        let mut column_starts = Vec::with_capacity(size + 1);
        column_starts.push(0);
        let mut row_indices = Vec::new();
        for mut rows in columns {
            rows.sort_unstable();
            rows.dedup();
            row_indices.append(&mut rows);
            column_starts.push(row_indices.len());
        }
        Pattern { size, column_starts, row_indices }
    }

    /// Number of rows and of columns.
    #[inline]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Number of stored entries, zeros of a particular matrix included.
    #[inline]
    pub fn entries(&self) -> usize {
        self.row_indices.len()
    }

    /// The rows of the entries of a column, ascending.
    #[inline]
    pub fn column(&self, column: usize) -> &[usize] {
        &self.row_indices[self.column_starts[column]..self.column_starts[column + 1]]
    }

    /// Offset of each column in the values; `size + 1` numbers.
    #[inline]
    pub fn column_starts(&self) -> &[usize] {
        &self.column_starts
    }

    /// The row of every entry, column by column.
    #[inline]
    pub fn row_indices(&self) -> &[usize] {
        &self.row_indices
    }

    /// Index into the values of the entry at `(row, column)`, if it is in the pattern.
    pub fn position(&self, row: usize, column: usize) -> Option<usize> {
        if column >= self.size {
            return None;
        }
        self.column(column).binary_search(&row).ok().map(|offset| self.column_starts[column] + offset)
    }

    /// The entries below the diagonal, column by column: row, column, and the indices of the entry and of its mirror image.
    pub fn mirrors(&self) -> impl Iterator<Item = (usize, usize, [usize; 2])> + '_ {
        // Columns are visited in ascending order, in which the entries of every row above the diagonal follow each other.
        let mut next = self.column_starts[..self.size].to_vec();
        let entries = (0..self.size).flat_map(move |column| {
            let start = self.column_starts[column];
            self.column(column).iter().enumerate().map(move |(k, &row)| (row, column, start + k))
        });
        entries.filter(|&(row, column, _)| row > column).map(move |(row, column, below)| {
            let above = next[row];
            next[row] += 1;
            debug_assert_eq!(self.row_indices[above], column, "the pattern is structurally symmetric");
            (row, column, [below, above])
        })
    }

    /// `product = A x` for the matrix with these values.
    ///
    /// # Panics
    /// If a slice has the wrong length.
    pub fn multiply<S: Scalar>(&self, values: &[S], vector: &[S], product: &mut [S]) {
        assert!(values.len() == self.entries() && vector.len() == self.size && product.len() == self.size);
        product.fill(S::zero());
        for (column, &factor) in vector.iter().enumerate() {
            let range = self.column_starts[column]..self.column_starts[column + 1];
            for (&row, &value) in self.row_indices[range.clone()].iter().zip(&values[range]) {
                product[row] += value * factor;
            }
        }
    }
}

#[cfg(test)]
#[path = "../tests/unit/pattern.rs"]
mod tests;
