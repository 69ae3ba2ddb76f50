//! A ZIP archive in memory, for co-simulation units and arrays: deflated files, without dates.

use std::io::{self, Write};

use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};

/// Date of all files: 1 January 1980, the first date of the format, so that equal contents have equal archives.
const DATE: u16 = (1 << 5) | 1;
/// Version of the format that is needed to read it: 2.0, for deflated files.
const VERSION: u16 = 20;
/// Names are UTF-8.
const FLAGS: u16 = 1 << 11;
const DEFLATED: u16 = 8;

/// Common part of local and central headers of a file, from the version on.
fn facts(name: &str, content: &[u8], packed: &[u8]) -> io::Result<Vec<u8>> {
    let mut crc = Crc::new();
    crc.update(content);
    let length = |bytes: usize| {
        u32::try_from(bytes)
            .map_err(|_| io::Error::new(io::ErrorKind::FileTooLarge, "a file is longer than 4 GB"))
    };
    let mut facts = Vec::new();
    for number in [VERSION, FLAGS, DEFLATED, 0, DATE] {
        facts.extend(number.to_le_bytes());
    }
    for number in [crc.sum(), length(packed.len())?, length(content.len())?] {
        facts.extend(number.to_le_bytes());
    }
    facts.extend(u16::try_from(name.len()).unwrap_or(u16::MAX).to_le_bytes());
    facts.extend(0u16.to_le_bytes());
    Ok(facts)
}

/// An archive of files by their names.
pub(crate) fn zip(files: &[(&str, &[u8])]) -> io::Result<Vec<u8>> {
    let (mut archive, mut central) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(content)?;
        let packed = encoder.finish()?;
        let facts = facts(name, content, &packed)?;
        let offset = offset(archive.len())?;
        archive.extend(b"PK\x03\x04");
        archive.extend(&facts);
        archive.extend(name.as_bytes());
        archive.extend(packed);
        central.extend(b"PK\x01\x02");
        central.extend(VERSION.to_le_bytes());
        central.extend(&facts);
        // Comment, disk, attributes inside and outside.
        central.extend([0; 10]);
        central.extend(offset.to_le_bytes());
        central.extend(name.as_bytes());
    }
    let (start, length) = (offset(archive.len())?, offset(central.len())?);
    archive.extend(central);
    archive.extend(b"PK\x05\x06\0\0\0\0");
    let count = u16::try_from(files.len()).unwrap_or(u16::MAX);
    archive.extend(count.to_le_bytes());
    archive.extend(count.to_le_bytes());
    archive.extend(length.to_le_bytes());
    archive.extend(start.to_le_bytes());
    archive.extend(0u16.to_le_bytes());
    Ok(archive)
}

fn offset(length: usize) -> io::Result<u32> {
    u32::try_from(length)
        .map_err(|_| io::Error::new(io::ErrorKind::FileTooLarge, "an archive is longer than 4 GB"))
}

#[cfg(test)]
#[path = "../../tests/unit/encodings/archive.rs"]
mod tests;
