//! Components by the names that users write.

/// Position of the component that `asked` names among those of one output. Also accepts former and other names: `rotation`
/// for `angle`, and a number that counts all components, such as `force2` for the only `force` if it is the second.
pub fn component_position<'c>(known: impl IntoIterator<Item = &'c str>, asked: &str) -> Option<usize> {
    let known: Vec<&str> = known.into_iter().collect();
    let split = |name: &'_ str| -> (String, Option<usize>) {
        let word = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
        (word.to_owned(), name[word.len()..].parse().ok())
    };
    let exact = |name: &str| known.iter().position(|own| *own == name);
    let (word, number) = split(asked);
    let word = if word == "rotation" && exact(asked).is_none() { "angle".to_owned() } else { word };
    let same = match number {
        None => exact(&word),
        Some(number) => exact(&format!("{word}{number}")),
    };
    let counted = || {
        let index = number?.checked_sub(1)?;
        known.get(index).filter(|own| **own == word).map(|_| index)
    };
    exact(asked).or(same).or_else(counted)
}

#[cfg(test)]
#[path = "../../tests/unit/output/component.rs"]
mod tests;
