//! Tables in memory as Parquet files: columns of numbers and texts without nulls, plain and uncompressed, which pandas, DuckDB,
//! Polars and Spark can read directly.
//!
//! The format (Apache Parquet 2.9): after the magic bytes the pages of the columns, one page per column and row group; then
//! the metadata in Thrift's compact protocol, its length and the magic bytes again.

use std::io;

/// First and last bytes of a file.
const MAGIC: &[u8; 4] = b"PAR1";
/// Rows of a group: its pages remain far below the limit of 2 GB of their headers.
const GROUP: usize = 1 << 17;

/// Values of a column.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Values {
    /// Numbers; NaN for missing ones.
    Numbers(Vec<f64>),
    /// Integers.
    Whole(Vec<i64>),
    /// Texts.
    Texts(Vec<String>),
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Whole(values) => values.len(),
            Self::Texts(values) => values.len(),
        }
    }

    /// Number of the physical type.
    fn kind(&self) -> usize {
        match self {
            Self::Numbers(_) => 5,
            Self::Whole(_) => 2,
            Self::Texts(_) => 6,
        }
    }

    /// The rows of a group in plain encoding.
    fn plain(&self, first: usize, end: usize) -> io::Result<Vec<u8>> {
        Ok(match self {
            Self::Numbers(values) => {
                values[first..end].iter().flat_map(|value| value.to_le_bytes()).collect()
            }
            Self::Whole(values) => values[first..end].iter().flat_map(|value| value.to_le_bytes()).collect(),
            Self::Texts(values) => {
                let mut bytes = Vec::new();
                for text in &values[first..end] {
                    let length = u32::try_from(text.len()).map_err(|_| too_large())?;
                    bytes.extend(length.to_le_bytes());
                    bytes.extend(text.as_bytes());
                }
                bytes
            }
        })
    }
}

fn too_large() -> io::Error {
    io::Error::new(io::ErrorKind::FileTooLarge, "a column exceeds the size that a Parquet file can store")
}

/// A table as a file; `facts` are texts of its metadata by key.
pub(crate) fn parquet(columns: &[(String, Values)], facts: &[(&str, String)]) -> io::Result<Vec<u8>> {
    let rows = columns.first().map_or(0, |(_, values)| values.len());
    let mut file = MAGIC.to_vec();
    let mut groups = Vec::new();
    for first in (0..rows).step_by(GROUP) {
        let end = (first + GROUP).min(rows);
        let mut chunks = Vec::new();
        for (name, values) in columns {
            let content = values.plain(first, end)?;
            i32::try_from(content.len()).map_err(|_| too_large())?;
            let start = file.len();
            file.extend(page_header(content.len(), end - first));
            file.extend(&content);
            chunks.push((chunk(name, values, end - first, (start, file.len())), file.len() - start));
        }
        let bytes = chunks.iter().map(|(_, size)| size).sum();
        let chunks: Vec<Vec<u8>> = chunks.into_iter().map(|(chunk, _)| chunk).collect();
        let mut group = Struct::default();
        group.structs(1, &chunks).number(2, bytes).number(3, end - first);
        groups.push(group.end());
    }
    let mut root = Struct::default();
    root.text(4, "schema").short(5, columns.len());
    let mut schema = vec![root.end()];
    schema.extend(columns.iter().map(|(name, values)| {
        let mut element = Struct::default();
        // Repetition 0: every row has a value.
        element.short(1, values.kind()).short(3, 0).text(4, name);
        if matches!(values, Values::Texts(_)) {
            // Converted type 0: the bytes are UTF-8.
            element.short(6, 0);
        }
        element.end()
    }));
    let facts: Vec<Vec<u8>> = facts
        .iter()
        .map(|(key, value)| {
            let mut pair = Struct::default();
            pair.text(1, key).text(2, value);
            pair.end()
        })
        .collect();
    let mut metadata = Struct::default();
    metadata.short(1, 1).structs(2, &schema).number(3, rows).structs(4, &groups);
    if !facts.is_empty() {
        metadata.structs(5, &facts);
    }
    metadata.text(6, concat!("lissom version ", env!("CARGO_PKG_VERSION")));
    let metadata = metadata.end();
    file.extend(&metadata);
    file.extend(u32::try_from(metadata.len()).map_err(|_| too_large())?.to_le_bytes());
    file.extend(MAGIC);
    Ok(file)
}

/// Header of a page with these numbers of bytes and values.
fn page_header(size: usize, count: usize) -> Vec<u8> {
    let mut page = Struct::default();
    // Encoding 0 is plain; levels would be encoding 3, and there are none.
    page.short(1, count).short(2, 0).short(3, 3).short(4, 3);
    let mut header = Struct::default();
    header.short(1, 0).short(2, size).short(3, size).nested(5, &page.end());
    header.end()
}

/// Metadata of a column within a group.
fn chunk(name: &str, values: &Values, count: usize, (start, end): (usize, usize)) -> Vec<u8> {
    let size = end - start;
    let mut of = Struct::default();
    of.short(1, values.kind()).shorts(2, &[0]).texts(3, &[name]).short(4, 0);
    of.number(5, count).number(6, size).number(7, size).number(9, start);
    let mut chunk = Struct::default();
    chunk.number(2, start).nested(3, &of.end());
    chunk.end()
}

/// A structure in Thrift's compact protocol, its fields in ascending order.
#[derive(Default)]
struct Struct {
    bytes: Vec<u8>,
    last: u8,
}

impl Struct {
    fn field(&mut self, number: u8, kind: u8) -> &mut Vec<u8> {
        self.bytes.push(((number - self.last) << 4) | kind);
        self.last = number;
        &mut self.bytes
    }

    /// A 32-bit integer.
    fn short(&mut self, number: u8, value: usize) -> &mut Self {
        zigzag(self.field(number, 5), value);
        self
    }

    /// A 64-bit integer.
    fn number(&mut self, number: u8, value: usize) -> &mut Self {
        zigzag(self.field(number, 6), value);
        self
    }

    fn text(&mut self, number: u8, text: &str) -> &mut Self {
        binary(self.field(number, 8), text);
        self
    }

    fn nested(&mut self, number: u8, value: &[u8]) -> &mut Self {
        self.field(number, 12).extend(value);
        self
    }

    fn structs(&mut self, number: u8, values: &[Vec<u8>]) -> &mut Self {
        let bytes = self.field(number, 9);
        list(bytes, values.len(), 12);
        for value in values {
            bytes.extend(value);
        }
        self
    }

    fn texts(&mut self, number: u8, values: &[&str]) -> &mut Self {
        let bytes = self.field(number, 9);
        list(bytes, values.len(), 8);
        for value in values {
            binary(bytes, value);
        }
        self
    }

    fn shorts(&mut self, number: u8, values: &[usize]) -> &mut Self {
        let bytes = self.field(number, 9);
        list(bytes, values.len(), 5);
        for value in values {
            zigzag(bytes, *value);
        }
        self
    }

    fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }
}

fn list(bytes: &mut Vec<u8>, count: usize, kind: u8) {
    if count < 15 {
        bytes.push(((count as u8) << 4) | kind);
    } else {
        bytes.push(0xf0 | kind);
        unsigned(bytes, count as u64);
    }
}

fn binary(bytes: &mut Vec<u8>, text: &str) {
    unsigned(bytes, text.len() as u64);
    bytes.extend(text.as_bytes());
}

/// A signed number in the protocol's zigzag encoding: doubled, because there are no negative ones here.
fn zigzag(bytes: &mut Vec<u8>, value: usize) {
    unsigned(bytes, (value as u64) << 1);
}

fn unsigned(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push((value as u8 & 0x7f) | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

#[cfg(test)]
#[path = "../../tests/unit/encodings/parquet.rs"]
mod tests;
