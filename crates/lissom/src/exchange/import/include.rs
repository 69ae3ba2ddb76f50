//! Files that an MJCF includes: the content of their root takes the place of the `<include>`, in any section.
//!
//! Names are relative to the folder of the robot's file, or else to that of the file with the `<include>`. No file is included twice,
//! as in MuJoCo.

use std::path::{Path, PathBuf};

use lissom_model::files;

use super::ImportError;
use super::xml::{self, SOURCE, location};

/// Largest number of files that include each other one in the other.
const MAX_INCLUDED: usize = 50;

/// The text of a description with all included files in it. Processing instructions [`SOURCE`] state where each begins and ends.
///
/// # Errors
/// If a file cannot be read, is no XML text, is included twice, or files include each other too deeply.
pub(super) fn with_included(path: &Path) -> Result<String, ImportError> {
    let text = read(path)?;
    if xml::root_tag(&text)? != "mujoco" {
        return Ok(text);
    }
    let main = path.parent().unwrap_or(Path::new(""));
    let mut read_files = vec![path.canonicalize().unwrap_or_else(|_| path.to_owned())];
    expanded(&text, ("", 0), [main, main], &mut read_files)
}

fn read(path: &Path) -> Result<String, ImportError> {
    let text = files::read_input_text(path).map_err(|error| ImportError::new(error.to_string()))?;
    let text = xml::without_comments(text);
    if xml::too_deep(&text).is_some() { Ok(text) } else { Ok(xml::with_prefixes(text)) }
}

/// The text of the file `name` with what it includes; so many files include it one in the other.
fn expanded(
    text: &str,
    (name, depth): (&str, usize),
    [main, own]: [&Path; 2],
    read_files: &mut Vec<PathBuf>,
) -> Result<String, ImportError> {
    let document = xml::parse(text).map_err(|error| match name {
        "" => error,
        name => ImportError::new(format!("{name}: {}", error.message)),
    })?;
    let marker = |at: usize, name: &str, text: &str| {
        let line = 1 + text[..at].matches('\n').count();
        format!("<?{SOURCE} {line} {}?>", name.replace('?', "_"))
    };
    let (mut whole, mut from) = (String::new(), 0);
    for node in document.descendants().filter(|node| node.has_tag_name("include")) {
        let of = if name.is_empty() { String::new() } else { format!(" of {name}") };
        let fault =
            |message: String| ImportError::new(format!("{}{of}: <include>: {message}", location(node)));
        if node.has_children() {
            let message = "it has content, which would be lost: move the content behind it";
            return Err(fault(message.to_owned()));
        }
        if depth >= MAX_INCLUDED {
            return Err(fault(format!(
                "{depth} files include each other one in the other: include them side by side"
            )));
        }
        let file = node.attribute("file").ok_or_else(|| fault("it has no `file`".to_owned()))?;
        let path = [main, own].map(|folder| folder.join(file)).into_iter().find(|path| path.is_file());
        let path = path.ok_or_else(|| {
            fault(format!("the file `{file}` is not there: put it in the folder of the robot's file"))
        })?;
        let known = path.canonicalize().unwrap_or_else(|_| path.clone());
        if read_files.contains(&known) {
            return Err(fault(format!("the file `{file}` is included twice: each may be included once")));
        }
        read_files.push(known);
        let folder = path.parent().unwrap_or(main);
        let inner = expanded(
            &read(&path).map_err(|error| fault(error.message))?,
            (file, depth + 1),
            [main, folder],
            read_files,
        )?;
        let included = xml::parse(&inner)?;
        let root = included.root_element();
        whole.push_str(&text[from..node.range().start]);
        if let (Some(first), Some(last)) = (root.first_child(), root.last_child()) {
            let content = first.range().start..last.range().end;
            whole.push_str(&marker(content.start, file, &inner));
            whole.push_str(&inner[content]);
        }
        from = node.range().end;
        whole.push_str(&marker(from, name, text));
    }
    whole.push_str(&text[from..]);
    Ok(whole)
}
