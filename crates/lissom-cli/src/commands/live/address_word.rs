//! The word in the address of a live page, which cannot be guessed.

use std::hash::{BuildHasher, RandomState};

/// Two values of a keyed hash whose 128-bit key the system has chosen at random. For a port other than 0 the word is
/// stored in the user's runtime folder, which only this user can read and which is empty after a restart of the machine: pages that are
/// open find the program again.
pub(super) fn word(port: u16) -> String {
    let keyed = RandomState::new();
    let fresh = format!("{:016x}{:016x}", keyed.hash_one(0_u64), keyed.hash_one(1_u64));
    if port == 0 { fresh } else { stored(port, &fresh).unwrap_or(fresh) }
}

/// The stored word, which is `fresh` for a new file; none where there is no such folder.
#[cfg(unix)]
fn stored(port: u16, fresh: &str) -> Option<String> {
    use std::io::Write;
    use std::os::unix::fs::{MetadataExt, OpenOptionsExt, PermissionsExt};

    let folder = std::path::PathBuf::from(std::env::var_os("XDG_RUNTIME_DIR")?);
    let own = std::fs::metadata(&folder).ok()?;
    // A folder that others can enter is no place for a secret.
    if own.permissions().mode() & 0o077 != 0 {
        return None;
    }
    let path = folder.join(format!("lissom-live-{port}"));
    if let Ok(mut file) = std::fs::OpenOptions::new().write(true).create_new(true).mode(0o600).open(&path) {
        file.write_all(fresh.as_bytes()).ok()?;
        return Some(fresh.to_owned());
    }
    let is_own = std::fs::symlink_metadata(&path).is_ok_and(|file| file.is_file() && file.uid() == own.uid());
    let word = if is_own { std::fs::read_to_string(&path).ok()? } else { return None };
    (word.len() == fresh.len() && word.bytes().all(|byte| byte.is_ascii_hexdigit())).then_some(word)
}

#[cfg(not(unix))]
fn stored(_: u16, _: &str) -> Option<String> {
    None
}
