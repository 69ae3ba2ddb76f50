//! Names and units of the components of outputs. One rule: a component is called by a word, by the letter of a vector with
//! the number of its axis, or by the axes x, y and z of a position; components of one output with the same word are numbered.

use lissom_core::kinematics::{CoordinateId, Quantity};
use lissom_core::signals::coordinate::Of;
use lissom_core::system::System;

use crate::channels::{Source, is_aligned};
use crate::document::{OutputComponent, OutputKind};

/// Names and units of the components of a kind of output.
pub(crate) fn components(
    kind: OutputKind,
    source: &Source,
    system: &System,
) -> (Vec<String>, Vec<&'static str>) {
    let words = |components: &[OutputComponent]| {
        components.iter().map(|&(word, unit)| (word.to_owned(), unit)).unzip()
    };
    match (kind, source) {
        (OutputKind::Reaction, Source::Slider(index)) if !is_aligned(system, *index) => {
            words(&kind.components()[..3])
        }
        (OutputKind::Reaction, Source::Drive(index)) => {
            words(&[effort(system, system.drives()[*index].prescribed.coordinate)])
        }
        (OutputKind::Reaction, Source::Coupling(index)) => {
            let coordinates = system.couplings()[*index].coordinates.iter();
            let (words, units): (Vec<&str>, Vec<&'static str>) =
                coordinates.map(|&coordinate| effort(system, coordinate)).unzip();
            (numbered(&words), units)
        }
        (OutputKind::RelativeAcceleration, Source::Accelerations(owners)) => {
            let of = |&(joint, own): &(usize, usize)| system.joints()[joint].coordinates[own];
            accelerations(owners.iter().map(of).collect(), system)
        }
        (OutputKind::RelativeAcceleration, Source::FreeAccelerations(coordinates)) => {
            accelerations(coordinates.clone(), system)
        }
        (OutputKind::Spring, Source::Spring(_, Quantity::Angle)) => {
            words(&[("rotation", "rad"), ("rate", "rad/s"), ("moment", "N m")])
        }
        (OutputKind::Recovered, Source::Recovered(_, matrix)) => {
            (1..=matrix.nrows()).map(|k| (format!("r{k}"), "")).unzip()
        }
        _ => {
            components_of_motion(kind, source, &|coordinate| system.layout().coordinate_quantity(coordinate))
        }
    }
}

/// Names and units of the components of a source that needs nothing but the motion.
pub(crate) fn components_of_motion(
    kind: OutputKind,
    source: &Source,
    quantity: &dyn Fn(CoordinateId) -> Quantity,
) -> (Vec<String>, Vec<&'static str>) {
    match source {
        Source::Coordinates(coordinates) => {
            let quantities: Vec<Quantity> = coordinates.iter().map(|&own| quantity(own)).collect();
            coordinate_components(&quantities).into_iter().map(|own| (own.name, own.unit)).unzip()
        }
        Source::Line(points) => {
            let of = |k: usize| ["x", "y", "z"].map(|axis| (format!("{axis}{k}"), "m"));
            (0..points.len()).flat_map(of).unzip()
        }
        Source::Modal(unknowns) => {
            let of = |k: usize| ["q", "v"].map(|letter| (format!("{letter}{k}"), ""));
            (1..=unknowns.coordinates().len()).flat_map(of).unzip()
        }
        _ => kind.components().iter().map(|&(word, unit)| (word.to_owned(), unit)).unzip(),
    }
}

/// What acts along a coordinate.
fn effort(system: &System, coordinate: CoordinateId) -> OutputComponent {
    match system.layout().coordinate_quantity(coordinate) {
        Quantity::Angle => ("moment", "N m"),
        Quantity::Length | Quantity::State => ("force", "N"),
    }
}

/// Components and units of accelerations of coordinates.
fn accelerations(coordinates: Vec<CoordinateId>, system: &System) -> (Vec<String>, Vec<&'static str>) {
    let unit = |coordinate| match system.layout().coordinate_quantity(coordinate) {
        Quantity::Angle => "rad/s²",
        Quantity::Length | Quantity::State => "m/s²",
    };
    (numbered(&vec!["a"; coordinates.len()]), coordinates.into_iter().map(unit).collect())
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
fn numbered(words: &[&str]) -> Vec<String> {
    let alike = |own: &[&str], word: &str| own.iter().filter(|other| **other == word).count();
    let name = |(index, word): (usize, &&str)| match alike(words, word) {
        1 => (*word).to_owned(),
        _ => format!("{word}{}", alike(&words[..=index], word)),
    };
    words.iter().enumerate().map(name).collect()
}

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
    fn components_of_one_word_are_numbered() {
        use Quantity::{Angle, Length};
        let names = |quantities: &[Quantity]| -> Vec<String> {
            coordinate_components(quantities).into_iter().map(|own| own.name).collect()
        };
        assert_eq!(names(&[Angle]), ["angle", "rate"]);
        assert_eq!(names(&[Angle, Length]), ["angle", "rate", "displacement", "velocity"]);
        assert_eq!(names(&[Angle, Angle]), ["angle1", "rate1", "angle2", "rate2"]);
        assert_eq!(numbered(&["moment", "force"]), ["moment", "force"]);
        assert_eq!(numbered(&["force", "moment", "force"]), ["force1", "moment", "force2"]);
    }

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
