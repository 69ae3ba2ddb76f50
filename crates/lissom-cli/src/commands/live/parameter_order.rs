//! Order and comments of the numbers in `[parameters]`, from the text of a model file.

/// Names in the order of the file, each with its comment: the one behind it, otherwise the lines directly above.
pub(super) fn parameters_of(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut is_inside = false;
    let mut above: Vec<&str> = Vec::new();
    for line in text.lines().map(str::trim) {
        if line.starts_with('[') {
            is_inside = line.split(']').next() == Some("[parameters");
            above.clear();
        } else if let Some(comment) = line.strip_prefix('#') {
            above.push(comment.trim());
        } else if let (true, Some((name, value))) = (is_inside, line.split_once('=')) {
            let behind = comment_of(value).unwrap_or_default();
            let comment = if behind.is_empty() { above.join(" ") } else { behind.to_owned() };
            found.push((name.trim().trim_matches('"').to_owned(), comment));
            above.clear();
        } else {
            above.clear();
        }
    }
    found
}

/// The comment behind a value; a number sign within quotes begins none.
fn comment_of(value: &str) -> Option<&str> {
    let mut quote = None;
    for (at, letter) in value.char_indices() {
        match (letter, quote) {
            ('"' | '\'', None) => quote = Some(letter),
            ('#', None) => return Some(value[at + 1..].trim()),
            (letter, Some(open)) if letter == open => quote = None,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
#[path = "../../../tests/unit/commands/live/parameter_order.rs"]
mod tests;
