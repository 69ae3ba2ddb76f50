//! Tags of XML texts before they are parsed.

/// Largest number of elements that contain each other one in the other: the readers are recursive.
pub(crate) const MAX_DEPTH: usize = 300;

/// Where the first tag begins that is nested more deeply than [`MAX_DEPTH`], by a scan of the text: parsers are recursive, too.
pub(crate) fn too_deep(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    tags(text).find_map(|(at, tag)| {
        match tag.as_bytes().get(1) {
            Some(b'!' | b'?') => {}
            Some(b'/') => depth = depth.saturating_sub(1),
            _ if tag.ends_with('/') => {}
            _ => depth += 1,
        }
        (depth > MAX_DEPTH).then_some(at)
    })
}

/// Tags, comments and instructions with their positions, without the sign that ends them; what does not end is reported by the parser.
pub(crate) fn tags(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut from = 0;
    std::iter::from_fn(move || {
        let at = from + text[from..].find('<')?;
        let tag = &text[at..];
        let end = match tag {
            _ if tag.starts_with("<!--") => tag.find("-->"),
            _ if tag.starts_with("<![CDATA[") => tag.find("]]>"),
            _ => end_of_tag(tag),
        }?;
        from = at + end;
        Some((at, &tag[..end]))
    })
}

/// The text with blanks instead of the contents of comments, which often contain `--`, and of a declaration that does not begin the text:
/// parsers reject both, and other programs read them. Positions remain the same.
pub(crate) fn without_comments(mut text: String) -> String {
    let is_blank = |(at, tag): &(usize, &str)| {
        tag.starts_with("<!--")
            || *at > 0 && tag.starts_with("<?xml") && tag[5..].starts_with(char::is_whitespace)
    };
    let blanks: Vec<_> =
        tags(&text).filter(is_blank).map(|(at, tag)| (at, tag.len(), tag.starts_with("<!"))).collect();
    for (at, length, is_comment) in blanks {
        // Of `<!--`, of which the end was not found in `tag`, and `-->`; or all of a declaration.
        let range = if is_comment { at + 4..at + length.max(4) } else { at..at + length + 1 };
        let blank = text[range.clone()].bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' });
        let blank: String = blank.collect();
        text.replace_range(range, &blank);
    }
    text
}

/// Position of the end of a tag, outside of the values of its attributes.
fn end_of_tag(tag: &str) -> Option<usize> {
    let mut quote = None;
    tag.char_indices().find_map(|(at, sign)| {
        match (quote, sign) {
            (None, '>') => return Some(at),
            (None, '"' | '\'') => quote = Some(sign),
            (Some(open), _) if open == sign => quote = None,
            _ => {}
        }
        None
    })
}
