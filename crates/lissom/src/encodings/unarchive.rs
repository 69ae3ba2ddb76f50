//! Reads ZIP archives of others: names that lead outside, links, and files that are larger than expected are rejected before anything
//! is unpacked.

use std::collections::BTreeMap;
use std::io::Read;

use flate2::Crc;
use flate2::read::DeflateDecoder;

/// Files of an archive, which is kept in memory.
pub(crate) struct Unarchived<'a> {
    bytes: &'a [u8],
    files: Vec<File>,
}

/// A file in the directory of an archive.
struct File {
    name: String,
    is_deflated: bool,
    crc: u32,
    packed: usize,
    size: usize,
    header: usize,
}

/// A number of `count` bytes at a position.
fn number(bytes: &[u8], at: usize, count: usize) -> Result<usize, String> {
    let slice = at.checked_add(count).and_then(|end| bytes.get(at..end)).ok_or("it is incomplete")?;
    Ok(slice.iter().rev().fold(0, |number, &byte| number << 8 | usize::from(byte)))
}

/// Whether a name stays within the folder to which the archive is unpacked, on all systems.
fn is_inside(name: &str) -> bool {
    !name.contains(['\\', ':', '\0']) && name.split('/').all(|part| !matches!(part, "" | "." | ".."))
}

impl<'a> Unarchived<'a> {
    /// Reads the directory of an archive.
    ///
    /// # Errors
    /// If it is no archive, or contains what is not unpacked.
    pub(crate) fn of(bytes: &'a [u8]) -> Result<Self, String> {
        // The directory's end is followed by a comment of at most 65535 bytes.
        let tail = bytes.len().saturating_sub(22 + 65_535);
        let end = bytes[tail..].windows(4).rposition(|four| four == b"PK\x05\x06");
        let end = tail + end.ok_or("it is no ZIP archive")?;
        let count = number(bytes, end + 10, 2)?;
        let mut at = number(bytes, end + 16, 4)?;
        let (mut files, mut names, mut total) = (Vec::new(), BTreeMap::new(), 0_usize);
        for _ in 0..count {
            if bytes.get(at..at + 4) != Some(b"PK\x01\x02") {
                return Err("its directory is damaged, or it is larger than 4 GB".to_owned());
            }
            let lengths = [28, 30, 32].map(|offset| number(bytes, at + offset, 2));
            let [name_length, extra, comment] = lengths;
            let (name_length, next) = (name_length?, extra? + comment?);
            let name = bytes.get(at + 46..at + 46 + name_length).ok_or("it is incomplete")?;
            let name = String::from_utf8_lossy(name).into_owned();
            let shown = name.escape_debug().to_string();
            let (flags, method, size) =
                (number(bytes, at + 8, 2)?, number(bytes, at + 10, 2)?, number(bytes, at + 24, 4)?);
            // The upper half of the attributes is the mode of a file on Unix.
            let mode = number(bytes, at + 40, 2)?;
            if !is_inside(name.strip_suffix('/').unwrap_or(&name)) {
                return Err(format!(
                    "its file `{shown}` would be outside of the folder to which it is unpacked"
                ));
            }
            if mode & 0o170_000 == 0o120_000 {
                return Err(format!("its file `{shown}` is a link"));
            }
            if flags & 1 != 0 || !matches!(method, 0 | 8) {
                return Err(format!(
                    "its file `{shown}` is encrypted, or compressed by another method than Deflate"
                ));
            }
            let content = [number(bytes, at + 16, 4)?, size];
            // Folders, and files with the same content, count once.
            if let Some(other) = names.insert(name.to_lowercase(), (name.clone(), content)) {
                if other == (name, content) {
                    at += 46 + name_length + next;
                    continue;
                }
                return Err(format!("it contains `{shown}` twice"));
            }
            total = total.saturating_add(size);
            // Units with their run-time libraries have some hundred megabytes.
            if total > 2 << 30 {
                return Err("its files have more than 2 GB".to_owned());
            }
            files.push(File {
                is_deflated: method == 8,
                crc: content[0] as u32,
                packed: number(bytes, at + 20, 4)?,
                size,
                header: number(bytes, at + 42, 4)?,
                name,
            });
            at += 46 + name_length + next;
        }
        Ok(Self { bytes, files })
    }

    /// Names of all files, without folders.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|file| file.name.as_str()).filter(|name| !name.ends_with('/'))
    }

    /// The contents of a file; none if there is none of this name.
    ///
    /// # Errors
    /// If they are damaged.
    pub(crate) fn contents(&self, name: &str) -> Result<Option<Vec<u8>>, String> {
        let Some(file) = self.files.iter().find(|file| file.name == name) else { return Ok(None) };
        let damaged = || format!("its file `{}` is damaged", name.escape_debug());
        let header = file.header;
        let start = header + 30 + number(self.bytes, header + 26, 2)? + number(self.bytes, header + 28, 2)?;
        let packed =
            start.checked_add(file.packed).and_then(|end| self.bytes.get(start..end)).ok_or_else(damaged)?;
        let mut contents = Vec::new();
        // One byte more than declared shows that the declared size is wrong, without unpacking more.
        let limit = file.size as u64 + 1;
        if file.is_deflated {
            DeflateDecoder::new(packed).take(limit).read_to_end(&mut contents).map_err(|_| damaged())?;
        } else {
            contents.extend_from_slice(packed);
        }
        let mut crc = Crc::new();
        crc.update(&contents);
        if contents.len() != file.size || crc.sum() != file.crc { Err(damaged()) } else { Ok(Some(contents)) }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/encodings/unarchive.rs"]
mod tests;
