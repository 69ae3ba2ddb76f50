//! The copy that is broken: what git knows of the project, as it lies in the folder, with the mutants in it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::MutantsError;

/// Makes `tree` equal to `root` except for the files of `changed`, which are new or have another text. Files that are equal
/// are left alone, so that nothing is built anew for them.
///
/// # Errors
/// If git cannot be run, or a file not be read or written.
pub(super) fn bring_up_to_date(
    root: &Path,
    tree: &Path,
    changed: &BTreeMap<PathBuf, String>,
) -> Result<(), MutantsError> {
    let mut list = Command::new("git");
    list.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]).current_dir(root);
    let listed = list.output().map_err(MutantsError::about("git ls-files"))?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let files: BTreeSet<PathBuf> =
        listed.split('\0').filter(|name| !name.is_empty()).map(PathBuf::from).collect();
    let is_there = |file: &Path| changed.contains_key(file) || root.join(file).is_file();
    for file in files.iter().map(PathBuf::as_path).chain(changed.keys().map(PathBuf::as_path)) {
        if !is_there(file) {
            continue;
        }
        let (from, to) = (root.join(file), tree.join(file));
        let wanted = match changed.get(file) {
            Some(text) => text.clone().into_bytes(),
            None => fs::read(&from).map_err(MutantsError::about(from.display()))?,
        };
        if fs::read(&to).is_ok_and(|found| found == wanted) {
            continue;
        }
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder).map_err(MutantsError::about(folder.display()))?;
        }
        // Times are those of now, so that cargo sees the change.
        fs::write(&to, wanted).map_err(MutantsError::about(to.display()))?;
        if let Ok(found) = fs::metadata(&from) {
            fs::set_permissions(&to, found.permissions()).map_err(MutantsError::about(to.display()))?;
        }
    }
    remove_others(tree, Path::new(""), &|file| {
        (files.contains(file) || changed.contains_key(file)) && is_there(file)
    })
}

/// Removes files of `tree` that are not wanted, by their path within it.
fn remove_others(tree: &Path, below: &Path, is_wanted: &impl Fn(&Path) -> bool) -> Result<(), MutantsError> {
    let folder = tree.join(below);
    for entry in fs::read_dir(&folder).map_err(MutantsError::about(folder.display()))? {
        let entry = entry.map_err(MutantsError::about(folder.display()))?;
        let path = below.join(entry.file_name());
        if entry.path().is_dir() {
            remove_others(tree, &path, is_wanted)?;
        } else if !is_wanted(&path) {
            fs::remove_file(entry.path()).map_err(MutantsError::about(entry.path().display()))?;
        }
    }
    Ok(())
}
