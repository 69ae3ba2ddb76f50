//! Checks of the book: broken links, markers without a generator,
//! generators without a position. Reads files, runs nothing.

use std::path::{Component, Path};

use super::generators::GENERATORS;
use super::{BookError, regions};

/// Errors of links and markers.
pub(super) fn complaints(root: &Path) -> Result<Vec<String>, BookError> {
    let docs = root.join("docs");
    let mut complaints = Vec::new();
    let mut filled: Vec<String> = Vec::new();
    let summary = docs.join("SUMMARY.md");
    let listed = links(&std::fs::read_to_string(&summary).map_err(BookError::file(&summary))?);
    for chapter in regions::chapters(&docs)? {
        let own = chapter.strip_prefix(&docs).unwrap_or(&chapter);
        if chapter != summary && !listed.iter().any(|known| Path::new(known) == own) {
            complaints.push(format!("docs/{} is not in SUMMARY.md", own.display()));
        }
        let text = std::fs::read_to_string(&chapter).map_err(BookError::file(&chapter))?;
        let shown = chapter.strip_prefix(root).unwrap_or(&chapter).display();
        for target in links(&text) {
            if let Some(wrong) = wrong_link(&docs, &chapter, &target) {
                complaints.push(format!("{shown}: the link `{target}` {wrong}"));
            }
        }
        match regions::names(&text) {
            Ok(names) => filled.extend(names.into_iter().map(str::to_owned)),
            Err(wrong) => complaints.push(format!("{shown}: {wrong}")),
        }
    }
    for name in &filled {
        if !GENERATORS.iter().any(|generator| generator.name == name) {
            complaints.push(format!("nothing makes the figure `{name}`"));
        }
    }
    for generator in GENERATORS {
        match filled.iter().filter(|name| *name == generator.name).count() {
            1 => {}
            count => complaints.push(format!("{count} chapters have the marker of `{}`", generator.name)),
        }
    }
    Ok(complaints)
}

/// Error of a link, if there is one.
fn wrong_link(docs: &Path, chapter: &Path, target: &str) -> Option<&'static str> {
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    if path.contains("://") || path.starts_with("mailto:") {
        return None;
    }
    if path.is_empty() {
        return (!has_heading(chapter, anchor)).then_some("names no heading of this chapter");
    }
    let mut place = chapter.parent().unwrap_or(docs).to_owned();
    for part in Path::new(path).components() {
        match part {
            Component::ParentDir => {
                place.pop();
            }
            Component::CurDir => {}
            other => place.push(other),
        }
    }
    if !place.starts_with(docs) {
        Some("leaves docs/, where the book cannot follow")
    } else if !place.is_file() {
        Some("points nowhere")
    } else {
        (!anchor.is_empty() && !has_heading(&place, anchor)).then_some("names no heading of that chapter")
    }
}

/// Whether a chapter has a heading that the link `#anchor` leads to.
fn has_heading(chapter: &Path, anchor: &str) -> bool {
    std::fs::read_to_string(chapter).is_ok_and(|text| anchors(&text).iter().any(|own| own == anchor))
}

/// Names of the headings of a chapter as mdBook makes them of their words: small letters, digits, `-` and `_`; a heading that
/// repeats another gets a number.
fn anchors(text: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut fenced = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        }
        if fenced || !line.starts_with('#') {
            continue;
        }
        let words = line.trim_start_matches('#').trim().chars();
        let name: String = words
            .filter(|letter| {
                letter.is_alphanumeric() || *letter == '-' || *letter == '_' || letter.is_whitespace()
            })
            .map(|letter| if letter.is_whitespace() { '-' } else { letter })
            .flat_map(char::to_lowercase)
            .collect();
        let repeated = (1..).map(|count| format!("{name}-{count}"));
        let free = std::iter::once(name.clone()).chain(repeated).find(|name| !names.contains(name));
        names.extend(free);
    }
    names
}

/// Targets of the links of a chapter, code omitted.
fn links(text: &str) -> Vec<String> {
    let mut targets = Vec::new();
    let mut fenced = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        }
        if fenced {
            continue;
        }
        // Every second piece is code.
        let prose: String = line.split('`').step_by(2).collect::<Vec<_>>().join("`");
        let mut rest = prose.as_str();
        while let Some((_, after)) = rest.split_once("](") {
            let Some((target, next)) = after.split_once(')') else { break };
            targets.push(target.split_whitespace().next().unwrap_or_default().to_owned());
            rest = next;
        }
    }
    targets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::root;

    #[test]
    fn the_book_holds_together() {
        let complaints = complaints(&root()).unwrap();
        assert!(complaints.is_empty(), "{complaints:#?}");
    }

    #[test]
    fn links_are_found_and_code_is_not() {
        let text = "a [b](c.md#d) `[x](y)` ![e `f`](g.svg)\n```\n[h](i)\n```\n[j](http://k)\n";
        assert_eq!(links(text), ["c.md#d", "g.svg", "http://k"]);
    }

    #[test]
    fn headings_are_named_as_the_book_names_them() {
        let text = "# A `b_c`: d, e-f\n```\n# no heading\n```\n## Twice\n### Twice\n";
        assert_eq!(anchors(text), ["a-b_c-d-e-f", "twice", "twice-1"]);
    }

    #[test]
    fn wrong_links_are_reported() {
        let docs = root().join("docs");
        let chapter = docs.join("theory/energy-decaying.md");
        let wrong = |target| wrong_link(&docs, &chapter, target).is_some();
        assert!(wrong("nowhere.md") && wrong("../../README.md") && wrong("../theory"));
        assert!(
            wrong("#here") && wrong("../theory/energy-decaying.md#x") && wrong("../path.md#Along-a-number")
        );
        assert!(!wrong("https://example.org/a.md#b") && !wrong("../path.md#along-a-number"));
    }
}
