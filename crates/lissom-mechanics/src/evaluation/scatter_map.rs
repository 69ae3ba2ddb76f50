//! Positions of dense local matrices in the tangent's pattern: as segments of entries that are consecutive in a
//! column.

use lissom_solver::Pattern;

use crate::kinematics::LOCKED;

/// Entries of a local column that are consecutive in the pattern.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// Local column.
    pub column: u8,
    /// First local row.
    pub row: u8,
    /// Number of rows.
    pub length: u8,
    /// Position of the first entry in the pattern.
    position: u32,
}

impl Segment {
    /// Positions in the pattern.
    pub fn positions(self) -> std::ops::Range<usize> {
        self.position as usize..self.position as usize + usize::from(self.length)
    }

    /// Position in the pattern, local row and local column of each entry.
    pub fn entries(self) -> impl Iterator<Item = (usize, usize, usize)> {
        (0..usize::from(self.length))
            .map(move |k| (self.position as usize + k, usize::from(self.row) + k, usize::from(self.column)))
    }
}

/// Segments of several local matrices, concatenated.
#[derive(Clone, Debug, Default)]
pub struct ScatterMap {
    segments: Vec<Segment>,
    starts: Vec<u32>,
}

impl ScatterMap {
    /// An empty map.
    pub fn new() -> Self {
        Self { segments: Vec::new(), starts: vec![0] }
    }

    /// Adds the local matrix over `rows`, [`LOCKED`] for missing ones. The square of the rows from `filled` on is
    /// omitted: it is zero.
    pub fn push(&mut self, pattern: &Pattern, rows: &[u32], filled: usize) {
        for (j, &column) in rows.iter().enumerate().filter(|&(_, &column)| column != LOCKED) {
            let seen = if j < filled { rows } else { &rows[..filled] };
            self.push_column(pattern, seen, (j, column));
        }
        self.starts.push(self.segments.len() as u32);
    }

    /// Adds the first `count` rows of the local matrix over `rows`; the others are zero.
    pub fn push_rows(&mut self, pattern: &Pattern, rows: &[u32], count: usize) {
        for (j, &column) in rows.iter().enumerate().filter(|&(_, &column)| column != LOCKED) {
            self.push_column(pattern, &rows[..count], (j, column));
        }
        self.starts.push(self.segments.len() as u32);
    }

    /// Adds the entries of local column `j`, which is the unknown `column`, in these rows.
    fn push_column(&mut self, pattern: &Pattern, rows: &[u32], (j, column): (usize, u32)) {
        let mut last = LOCKED;
        for (i, &row) in rows.iter().enumerate() {
            if row == LOCKED {
                last = LOCKED;
                continue;
            }
            let position = position_of(pattern, row as usize, column as usize) as u32;
            match self.segments.last_mut() {
                Some(run) if last != LOCKED && position == last + 1 => run.length += 1,
                _ => self.segments.push(Segment { column: j as u8, row: i as u8, length: 1, position }),
            }
            last = position;
        }
    }

    /// Releases unused memory.
    pub fn shrink(&mut self) {
        self.segments.shrink_to_fit();
        self.starts.shrink_to_fit();
    }

    /// Segments of a local matrix.
    pub fn of(&self, item: usize) -> &[Segment] {
        &self.segments[self.starts[item] as usize..self.starts[item + 1] as usize]
    }
}

/// Position of an entry of the pattern.
///
/// # Panics
/// If the pattern was not built from these rows.
pub fn position_of(pattern: &Pattern, row: usize, column: usize) -> usize {
    pattern.position(row, column).expect("the pattern was made from these rows")
}

/// Rows that are not locked.
pub fn free_rows(rows: &[u32]) -> Vec<usize> {
    rows.iter().filter(|&&row| row != LOCKED).map(|&row| row as usize).collect()
}
