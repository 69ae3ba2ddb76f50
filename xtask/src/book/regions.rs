//! The regions of chapters that are generated, between `<!-- figures: NAME -->` and `<!-- end -->`, each at the start
//! of a line. Independent of their contents.

use std::path::{Path, PathBuf};

use super::BookError;
use super::fragment::Fragment;

/// Before the name.
const BEGIN: &str = "<!-- figures: ";
/// After the name.
const CLOSE: &str = " -->";
/// Line after the region.
const END: &str = "<!-- end -->";

/// Puts `fragment` into the chapter that has a region called `name`, and its drawings where the chapter looks for
/// them.
pub(super) fn write(docs: &Path, name: &'static str, fragment: &Fragment) -> Result<(), BookError> {
    for chapter in chapters(docs)? {
        let text = std::fs::read_to_string(&chapter).map_err(BookError::file(&chapter))?;
        let Some(text) = replaced(&text, name, &placed(fragment, docs, &chapter)) else { continue };
        for (path, drawing) in &fragment.drawings {
            let path = docs.join(path);
            let folder = path.parent().unwrap_or(docs);
            std::fs::create_dir_all(folder).map_err(BookError::file(folder))?;
            std::fs::write(&path, drawing).map_err(BookError::file(&path))?;
        }
        return std::fs::write(&chapter, text).map_err(BookError::file(&chapter));
    }
    Err(BookError::NoMarker(name))
}

/// Markdown files below docs/, in order.
pub(super) fn chapters(docs: &Path) -> Result<Vec<PathBuf>, BookError> {
    let mut found = Vec::new();
    let mut folders = vec![docs.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).map_err(BookError::file(&folder))? {
            let path = entry.map_err(BookError::file(&folder))?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

/// The names of a chapter's regions, or their error.
pub(super) fn names(text: &str) -> Result<Vec<&str>, String> {
    let mut names = Vec::new();
    let mut open: Option<&str> = None;
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix(BEGIN) {
            let name = rest.strip_suffix(CLOSE).ok_or_else(|| format!("`{line}` is no marker"))?;
            if let Some(open) = open {
                return Err(format!("`{name}` begins before `{open}` ends"));
            }
            open = Some(name);
        } else if line == END {
            names.push(open.take().ok_or("a region ends that has not begun")?);
        }
    }
    open.map_or(Ok(names), |name| Err(format!("`{name}` does not end")))
}

/// `text` with `inside` in its region called `name`; none if it has no such region.
fn replaced(text: &str, name: &str, inside: &str) -> Option<String> {
    let begin = format!("{BEGIN}{name}{CLOSE}\n");
    let start = if text.starts_with(&begin) { 0 } else { text.find(&format!("\n{begin}"))? + 1 };
    let (before, rest) = text.split_at(start + begin.len());
    let end = if rest.starts_with(END) { 0 } else { rest.find(&format!("\n{END}"))? + 1 };
    Some(format!("{before}\n{}\n\n{}", inside.trim_end(), &rest[end..]))
}

/// The text with its links to drawings as seen from the chapter.
fn placed(fragment: &Fragment, docs: &Path, chapter: &Path) -> String {
    let depth = chapter.strip_prefix(docs).map_or(0, |path| path.components().count().saturating_sub(1));
    let up = "../".repeat(depth);
    let link = |text: String, (path, _): &(String, String)| {
        text.replace(&format!("]({path})"), &format!("]({up}{path})"))
    };
    fragment.drawings.iter().fold(fragment.text.clone(), link)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_region_changes() {
        let text = "a\n<!-- figures: x -->\nold\n<!-- end -->\nb\n<!-- figures: y -->\n<!-- end -->\n";
        let x = replaced(text, "x", "new\n\n").unwrap();
        assert!(x.starts_with("a\n<!-- figures: x -->\n\nnew\n\n<!-- end -->\nb\n"), "{x}");
        assert_eq!(replaced(&x, "x", "new").unwrap(), x, "once more changes nothing");
        let y = replaced(&x, "y", "more").unwrap();
        assert!(y.ends_with("<!-- figures: y -->\n\nmore\n\n<!-- end -->\n"), "{y}");
        assert!(replaced(text, "z", "").is_none());
        assert_eq!(names(&y).unwrap(), ["x", "y"]);
    }

    #[test]
    fn broken_markers_are_reported() {
        for wrong in [
            "<!-- figures: x -->\n",
            "<!-- end -->\n",
            "<!-- figures: x\n<!-- end -->\n",
            "<!-- figures: x -->\n<!-- figures: y -->\n<!-- end -->\n",
        ] {
            assert!(names(wrong).is_err(), "{wrong}");
        }
        assert!(names("in a line: `<!-- figures: x -->`\n").unwrap().is_empty());
    }

    #[test]
    fn drawings_are_found_from_below() {
        let mut fragment = Fragment::default();
        fragment.drawing("generated/a.svg", "a", String::new());
        let docs = Path::new("docs");
        assert_eq!(placed(&fragment, docs, &docs.join("a.md")), "![a](generated/a.svg)\n\n");
        assert_eq!(placed(&fragment, docs, &docs.join("theory/a.md")), "![a](../generated/a.svg)\n\n");
    }
}
