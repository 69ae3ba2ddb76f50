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
mod tests {
    use super::*;

    #[test]
    fn other_names_of_components_are_found() {
        let angles = ["angle1", "rate1", "angle2", "rate2"];
        assert_eq!(component_position(angles, "angle2"), Some(2));
        assert_eq!(component_position(angles, "rotation2"), Some(2));
        assert_eq!(component_position(angles, "rotation"), None);
        assert_eq!(component_position(["angle", "rate"], "rotation"), Some(0));
        // Of a spring.
        assert_eq!(component_position(["rotation", "rate", "moment"], "rotation"), Some(0));
        let former = ["moment", "force"];
        assert_eq!(component_position(former, "moment1"), Some(0));
        assert_eq!(component_position(former, "force2"), Some(1));
        assert_eq!(component_position(former, "force1"), None);
        assert_eq!(component_position(former, "force0"), None);
        let columns = ["angle", "rate"].map(|own| crate::output::Column::new("p.arm", own, "relative", ""));
        for (name, found) in [
            ("p.arm.angle", Some(0)),
            ("p.arm.rotation", Some(0)),
            ("p.arm.rate", Some(1)),
            ("arm.rate", None),
        ] {
            assert_eq!(crate::output::Column::named(&columns, name), found, "{name}");
        }
    }
}
