//! The copy that is broken: what git knows of the project, as it lies in the folder.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::MutantsError;

/// Makes `tree` equal to `root`. Files that are equal are left alone, so that nothing is built anew for them.
///
/// # Errors
/// If git cannot be run, or a file not be read or written.
pub(super) fn bring_up_to_date(root: &Path, tree: &Path) -> Result<(), MutantsError> {
    let mut list = Command::new("git");
    list.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]).current_dir(root);
    let listed = list.output().map_err(MutantsError::about("git ls-files"))?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let files: BTreeSet<PathBuf> =
        listed.split('\0').filter(|name| !name.is_empty()).map(PathBuf::from).collect();
    for file in files.iter().filter(|file| root.join(file).is_file()) {
        let (from, to) = (root.join(file), tree.join(file));
        let wanted = fs::read(&from).map_err(MutantsError::about(from.display()))?;
        if fs::read(&to).is_ok_and(|found| found == wanted) {
            continue;
        }
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder).map_err(MutantsError::about(folder.display()))?;
        }
        // Times are those of now: what was built of a broken file is older.
        fs::write(&to, wanted).map_err(MutantsError::about(to.display()))?;
        let rights = fs::metadata(&from).map_err(MutantsError::about(from.display()))?.permissions();
        fs::set_permissions(&to, rights).map_err(MutantsError::about(to.display()))?;
    }
    remove_others(tree, Path::new(""), &|file| files.contains(file) && root.join(file).is_file())
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
