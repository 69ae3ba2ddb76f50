//! The report of the verification as a chapter of the book: the same text, with the plots it shows beside it, because
//! a book cannot show files outside of its folder.

use std::path::{Path, PathBuf};

use super::{BookError, check};

/// Folder of the plots below docs/.
const PLOTS: &str = "generated/verification";

/// Copies report and plots.
pub(crate) fn renew(root: &Path) -> Result<(), BookError> {
    let (chapter, text) = (chapter(root), copied(root)?);
    let folder = root.join("docs").join(PLOTS);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(BookError::file(&folder))?;
    }
    std::fs::create_dir_all(&folder).map_err(BookError::file(&folder))?;
    for plot in check::drawings(&text).iter().filter_map(|plot| plot.file_name()) {
        let from = root.join("verification/plots").join(plot);
        std::fs::copy(&from, folder.join(plot)).map_err(BookError::file(&from))?;
    }
    std::fs::write(&chapter, text).map_err(BookError::file(&chapter))
}

/// Whether the chapter agrees with the report.
pub(super) fn is_fresh(root: &Path) -> Result<bool, BookError> {
    let chapter = chapter(root);
    let text = std::fs::read_to_string(&chapter).map_err(BookError::file(&chapter))?;
    Ok(text == copied(root)?)
}

fn chapter(root: &Path) -> PathBuf {
    root.join("docs/verification.md")
}

fn copied(root: &Path) -> Result<String, BookError> {
    let path = root.join("verification/REPORT.md");
    let text = std::fs::read_to_string(&path).map_err(BookError::file(&path))?;
    Ok(text.replace("](plots/", &format!("]({PLOTS}/")))
}
