//! Results as comma-separated values: a heading `time,midspan.x,…`, then one line per record.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use super::{Column, Writer};

/// Longest time that lines stay in the buffer: an interrupted run loses no more.
const PATIENCE: Duration = Duration::from_secs(1);

/// Writes comma-separated values. Numbers have the fewest digits that give them back exactly.
#[derive(Debug)]
pub struct CsvWriter<W: Write> {
    to: W,
    /// Complete lines only, so that the file never ends within one.
    lines: Vec<u8>,
    flushed: Instant,
}

impl<W: Write> CsvWriter<W> {
    /// A writer to `to`.
    pub fn new(to: W) -> Self {
        Self { to, lines: Vec::new(), flushed: Instant::now() }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.write_all(&self.lines)?;
        self.lines.clear();
        self.flushed = Instant::now();
        self.to.flush()
    }
}

impl<W: Write> Writer for CsvWriter<W> {
    fn begin(&mut self, columns: &[Column]) -> io::Result<()> {
        self.lines.extend_from_slice(b"time");
        for column in columns {
            write!(self.lines, ",{}", quoted(&column.name()))?;
        }
        self.lines.push(b'\n');
        self.flush()
    }

    fn row(&mut self, time: f64, values: &[f64]) -> io::Result<()> {
        write_number(&mut self.lines, time)?;
        for value in values {
            self.lines.push(b',');
            write_number(&mut self.lines, *value)?;
        }
        self.lines.push(b'\n');
        if self.lines.len() > 1 << 16 || self.flushed.elapsed() > PATIENCE { self.flush() } else { Ok(()) }
    }

    fn finish(&mut self) -> io::Result<()> {
        self.flush()
    }
}

/// A cell of a table, quoted where it has commas, quotes or ends of lines in it.
pub fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The shortest digits that give the number back, with an exponent where it saves zeros.
fn write_number(to: &mut Vec<u8>, value: f64) -> io::Result<()> {
    if value == 0.0 || !value.is_finite() {
        return write!(to, "{value}");
    }
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format_finite(value);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, ""));
    let is_plain = (1e-4..1e9).contains(&value.abs());
    if is_plain && exponent.is_empty() {
        to.extend_from_slice(mantissa.strip_suffix(".0").unwrap_or(mantissa).as_bytes());
        return Ok(());
    }
    if value < 0.0 {
        to.push(b'-');
    }
    let unsigned = mantissa.strip_prefix('-').unwrap_or(mantissa).as_bytes();
    let whole = unsigned.iter().position(|byte| *byte == b'.').unwrap_or(unsigned.len());
    let zeros = unsigned.iter().filter(|byte| **byte != b'.').take_while(|byte| **byte == b'0').count();
    let power = whole.cast_signed() - 1 - zeros.cast_signed() + exponent.parse::<isize>().unwrap_or(0);
    let begin = to.len();
    to.extend(unsigned.iter().filter(|byte| **byte != b'.').skip(zeros));
    while to.len() > begin + 1 && to.last() == Some(&b'0') {
        to.pop();
    }
    if to.len() > begin + 1 {
        to.insert(begin + 1, b'.');
    }
    write!(to, "e{power}")
}

#[cfg(test)]
#[path = "../../tests/unit/output/csv.rs"]
mod tests;
