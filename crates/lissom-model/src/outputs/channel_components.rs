//! Names and units of the components of outputs. One rule: a component is called by a word, by the letter of a vector with
//! the number of its axis, or by the axes x, y and z of a position; components of one output with the same word are numbered.

use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_mechanics::signals::coordinate::Of;

use crate::outputs::OutputQuantity;
use crate::outputs::kinds::OutputKind;

/// Names and units of the components of a quantity of a kind; `quantity_of` is that of a coordinate.
pub(crate) fn components(
    kind: OutputKind,
    quantity: &dyn OutputQuantity,
    quantity_of: &dyn Fn(CoordinateId) -> Quantity,
) -> (Vec<String>, Vec<&'static str>) {
    let of_kind = || kind.components().iter().map(|&(word, unit)| (word.to_owned(), unit)).collect();
    quantity.components(quantity_of).unwrap_or_else(of_kind).into_iter().unzip()
}

/// A value or a rate of a joint's coordinates, with the name that outputs, expressions and equations have for it.
pub(crate) struct CoordinateComponent {
    pub(crate) name: String,
    pub(crate) unit: &'static str,
    /// Position of the coordinate among those of the joint.
    pub(crate) coordinate: usize,
    pub(crate) of: Of,
}

/// Value and rate of each of a joint's coordinates.
pub(crate) fn coordinate_components(quantities: &[Quantity]) -> Vec<CoordinateComponent> {
    let parts = |quantity: &Quantity| match quantity {
        Quantity::Angle => [("angle", "rad", Of::Value), ("rate", "rad/s", Of::Rate)],
        Quantity::Length => [("displacement", "m", Of::Value), ("velocity", "m/s", Of::Rate)],
        Quantity::State => [("value", "", Of::Value), ("rate", "1/s", Of::Rate)],
    };
    let all: Vec<_> = quantities.iter().flat_map(parts).collect();
    let words: Vec<&str> = all.iter().map(|(word, ..)| *word).collect();
    let component = |(index, (name, (_, unit, of))): (usize, (String, (&str, &'static str, Of)))| {
        CoordinateComponent { name, unit, coordinate: index / 2, of }
    };
    numbered(&words).into_iter().zip(all).enumerate().map(component).collect()
}

/// Names of components: a word, and a number from 1 where several components of an output have the same word.
pub(crate) fn numbered(words: &[&str]) -> Vec<String> {
    let alike = |own: &[&str], word: &str| own.iter().filter(|other| **other == word).count();
    let name = |(index, word): (usize, &&str)| match alike(words, word) {
        1 => (*word).to_owned(),
        _ => format!("{word}{}", alike(&words[..=index], word)),
    };
    words.iter().enumerate().map(name).collect()
}

#[cfg(test)]
#[path = "../../tests/unit/outputs/channel_components.rs"]
mod tests;
