//! Polars of aerofoils in the files of AeroDyn (airfoil information, several tables over the Reynolds number) and of HAWC2 (profile
//! coefficients, sets of several tables over the relative thickness).

use std::str::FromStr;

/// Coefficients of an aerofoil over the angle of attack.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Polar {
    /// Reynolds number, or relative thickness in the unit of the file, usually percent.
    pub(crate) at: f64,
    /// Rows of the angle of attack [rad], and coefficients of lift, drag and moment.
    pub(crate) rows: Vec<[f64; 4]>,
}

/// A file that contains no polars.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum PolarError {
    /// It ends too early.
    #[error("the file ends before {0}")]
    Ends(&'static str),
    /// A line does not begin with the numbers that the format requires.
    #[error("line {line}: expected {expected}")]
    Unexpected {
        /// Line of the file, from 1.
        line: usize,
        /// The expected numbers.
        expected: &'static str,
    },
    /// There is no such set.
    #[error("there is no set {wanted}, but {count}")]
    NoSet {
        /// The request.
        wanted: usize,
        /// Number of sets.
        count: usize,
    },
}

/// The polars of a file; of one with several sets those of `set`, from 1.
pub(crate) fn polars(text: &str, set: usize) -> Result<Vec<Polar>, PolarError> {
    let lines = Lines { text: text.lines().enumerate().collect(), next: 0 };
    let is_aerodyn = text.lines().any(|line| word::<String>(line, 1).is_some_and(|own| own == "NumAlf"));
    if is_aerodyn { aerodyn(lines) } else { hawc2(lines, set) }
}

/// The lines of a file that have not been read.
struct Lines<'t> {
    text: Vec<(usize, &'t str)>,
    next: usize,
}

impl<'t> Lines<'t> {
    /// The next line that is neither empty nor a comment.
    fn next(&mut self, before: &'static str) -> Result<(usize, &'t str), PolarError> {
        loop {
            let &(index, line) = self.text.get(self.next).ok_or(PolarError::Ends(before))?;
            self.next += 1;
            let start = line.trim_start();
            if !start.is_empty() && !start.starts_with(['!', '#']) {
                return Ok((index + 1, line));
            }
        }
    }

    fn rows(&mut self, count: usize) -> Result<Vec<[f64; 4]>, PolarError> {
        let row = |lines: &mut Self| {
            let (line, text) = lines.next("its last row")?;
            let expected = "an angle of attack in degrees and the coefficients of lift and drag";
            let number = |k| word::<f64>(text, k).filter(|number| number.is_finite());
            let read = || Some([number(0)?.to_radians(), number(1)?, number(2)?, number(3).unwrap_or(0.0)]);
            read().ok_or(PolarError::Unexpected { line, expected })
        };
        (0..count).map(|_| row(self)).collect()
    }
}

/// The word with this index, if it can be read.
fn word<T: FromStr>(line: &str, index: usize) -> Option<T> {
    line.split_whitespace().nth(index)?.parse().ok()
}

/// Lines `value  name  description`; the Reynolds number is in millions.
fn aerodyn(mut lines: Lines<'_>) -> Result<Vec<Polar>, PolarError> {
    let mut polars = Vec::new();
    let mut at = 0.0;
    while let Ok((line, text)) = lines.next("") {
        match word::<String>(text, 1).as_deref() {
            Some("Re") => {
                let expected = "the Reynolds number in millions";
                let read = word::<f64>(text, 0).ok_or(PolarError::Unexpected { line, expected })?;
                at = 1e6 * read;
            }
            Some("NumAlf") => {
                let expected = "the number of rows";
                let count = word(text, 0).ok_or(PolarError::Unexpected { line, expected })?;
                polars.push(Polar { at, rows: lines.rows(count)? });
            }
            _ => {}
        }
    }
    Ok(polars)
}

/// The number of sets; for each set the number of its profiles; for each profile its number, the number of its rows and the thickness.
fn hawc2(mut lines: Lines<'_>, set: usize) -> Result<Vec<Polar>, PolarError> {
    let counted = |lines: &mut Lines<'_>, expected: &'static str| {
        let (line, text) = lines.next(expected)?;
        word::<usize>(text, 0).ok_or(PolarError::Unexpected { line, expected })
    };
    let sets = counted(&mut lines, "the number of sets")?;
    for own in 1..=sets {
        let profiles = counted(&mut lines, "the number of profiles of a set")?;
        let mut polars = Vec::new();
        for _ in 0..profiles {
            let expected = "the number of a profile, the number of its rows and its relative thickness";
            let (line, text) = lines.next(expected)?;
            let read = || Some((word::<usize>(text, 1)?, word::<f64>(text, 2)?));
            let (count, at) = read().ok_or(PolarError::Unexpected { line, expected })?;
            polars.push(Polar { at, rows: lines.rows(count)? });
        }
        if own == set {
            return Ok(polars);
        }
    }
    Err(PolarError::NoSet { wanted: set, count: sets })
}

#[cfg(test)]
#[path = "../../tests/unit/files/polar_file.rs"]
mod tests;
