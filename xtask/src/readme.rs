//! The table in README.md, between two markers. Knows nothing of what the table says.

use std::path::Path;

use crate::verify::VerifyError;

/// Line before the table.
const BEGIN: &str = "<!-- verification: begin -->";
/// Line after the table.
const END: &str = "<!-- verification: end -->";

/// Puts `table` between the markers of the file, if it has them.
pub(crate) fn rewrite(path: &Path, table: &str) -> Result<(), VerifyError> {
    let text = std::fs::read_to_string(path).map_err(VerifyError::file(path))?;
    let Some(text) = replaced(&text, table) else {
        println!("{} has no markers `{BEGIN}` and `{END}`: left as it is", path.display());
        return Ok(());
    };
    std::fs::write(path, text).map_err(VerifyError::file(path))
}

fn replaced(text: &str, table: &str) -> Option<String> {
    let (before, rest) = text.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}\n{table}{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_between_the_markers_changes() {
        let text = format!("a\n{BEGIN}\nold\n{END}\nb\n");
        assert_eq!(replaced(&text, "new\n").unwrap(), format!("a\n{BEGIN}\nnew\n{END}\nb\n"));
        assert!(replaced("a\nb\n", "new\n").is_none());
    }
}
