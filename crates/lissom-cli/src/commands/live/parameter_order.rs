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
mod tests {
    use super::*;

    #[test]
    fn parameters_have_the_order_and_the_comments_of_the_file() {
        let text = "title = \"a = b\"\n[parameters]\n# Speed of the vehicle, m/s\nspeed = 12\n\nb = \"a # b\"  # [kg]\na = 2\n# of none\n\n\
                    c = 3\n[bodies.d]\nmass = 1 # x\n";
        let found = parameters_of(text);
        let expected = [("speed", "Speed of the vehicle, m/s"), ("b", "[kg]"), ("a", ""), ("c", "")];
        assert_eq!(found, expected.map(|(name, comment)| (name.to_owned(), comment.to_owned())));
    }
}
