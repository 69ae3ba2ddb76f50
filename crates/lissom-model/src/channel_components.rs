//! Names and units of what outputs record.

use lissom_core::joints::Quantity;
use lissom_core::system::{CoordinateId, System};

use crate::channels::{Source, is_aligned};
use crate::document::OutputKind;

/// Names and units of the components of a kind of output.
pub(crate) fn components(
    kind: OutputKind,
    source: &Source,
    system: &System,
) -> (Vec<String>, Vec<&'static str>) {
    let three =
        |letter: &str, unit: &'static str| ((1..=3).map(|k| format!("{letter}{k}")).collect(), vec![unit; 3]);
    let words = |words: &[&str], units: &[&'static str]| {
        (words.iter().map(|&word| word.to_owned()).collect(), units.to_vec())
    };
    match (kind, source) {
        (OutputKind::Position, _) => words(&["x", "y", "z"], &["m"; 3]),
        (OutputKind::Displacement, _) => three("u", "m"),
        (OutputKind::Rotation, _) => three("r", "rad"),
        (OutputKind::Velocity, _) => three("v", "m/s"),
        (OutputKind::AngularVelocity, _) => three("w", "rad/s"),
        (OutputKind::Acceleration, _) => three("a", "m/s²"),
        (OutputKind::Reaction, Source::Slider(index)) if is_aligned(system, *index) => {
            words(&["f1", "f2", "f3", "m1", "m2", "m3"], &["N", "N", "N", "N m", "N m", "N m"])
        }
        (OutputKind::SectionForce, _) | (OutputKind::Reaction, Source::Slider(_)) => three("f", "N"),
        (OutputKind::SectionMoment, _) => three("m", "N m"),
        (OutputKind::Reaction, Source::Drive(index)) => {
            match system.layout().coordinate_quantity(system.drives()[*index].prescribed.coordinate) {
                Quantity::Angle => words(&["moment"], &["N m"]),
                Quantity::Length | Quantity::State => words(&["force"], &["N"]),
            }
        }
        (OutputKind::Reaction, Source::Coupling(index)) => {
            let coordinates = &system.couplings()[*index].coordinates;
            let each = coordinates.iter().enumerate().map(|(k, &coordinate)| {
                match system.layout().coordinate_quantity(coordinate) {
                    Quantity::Angle => (format!("moment{}", k + 1), "N m"),
                    Quantity::Length | Quantity::State => (format!("force{}", k + 1), "N"),
                }
            });
            each.unzip()
        }
        (OutputKind::Reaction, _) => {
            words(&["f1", "f2", "f3", "m1", "m2", "m3"], &["N", "N", "N", "N m", "N m", "N m"])
        }
        (OutputKind::RelativeMotion, _) => {
            words(&["x", "y", "z", "r1", "r2", "r3"], &["m", "m", "m", "rad", "rad", "rad"])
        }
        (OutputKind::Contact, _) => words(
            &["wheel", "rail", "shift", "normal", "along", "across", "creepage1", "creepage2", "spin"],
            &["m", "m", "rad", "N", "N", "N", "", "", "1/m"],
        ),
        (OutputKind::Relative, Source::Coordinates(coordinates)) => relative(coordinates, system),
        (OutputKind::RelativeAcceleration, Source::Accelerations(owners)) => {
            let of = |&(joint, own): &(usize, usize)| system.joints()[joint].coordinates[own];
            accelerations(owners.iter().map(of).collect(), system)
        }
        (OutputKind::RelativeAcceleration, Source::FreeAccelerations(coordinates)) => {
            accelerations(coordinates.clone(), system)
        }
        (OutputKind::Spring, Source::Spring(_, Quantity::Angle)) => {
            words(&["rotation", "rate", "moment"], &["rad", "rad/s", "N m"])
        }
        (OutputKind::Spring, _) => words(&["elongation", "rate", "force"], &["m", "m/s", "N"]),
        (OutputKind::Work, _) => words(&["work"], &["J"]),
        (OutputKind::Angle, _) => words(&["angle"], &["rad"]),
        (OutputKind::Power, _) => words(&["power"], &["W"]),
        (OutputKind::Line, Source::Line(places)) => {
            let of = |k: usize| ["x", "y", "z"].map(|axis| (format!("{axis}{k}"), "m"));
            (0..places.len()).flat_map(of).unzip()
        }
        (OutputKind::Modal, Source::Modal(unknowns)) => {
            let of = |k: usize| ["q", "v"].map(|letter| (format!("{letter}{k}"), ""));
            (1..=unknowns.coordinates().len()).flat_map(of).unzip()
        }
        (OutputKind::Recovered, Source::Recovered(_, matrix)) => {
            (1..=matrix.nrows()).map(|k| (format!("r{k}"), "")).unzip()
        }
        (
            OutputKind::Relative
            | OutputKind::RelativeAcceleration
            | OutputKind::Line
            | OutputKind::Modal
            | OutputKind::Recovered,
            _,
        ) => (Vec::new(), Vec::new()),
        (OutputKind::Momentum, _) => {
            words(&["p1", "p2", "p3", "l1", "l2", "l3"], &["N s", "N s", "N s", "N m s", "N m s", "N m s"])
        }
        (OutputKind::Signal | OutputKind::Expression, _) => words(&["value"], &[""]),
        (OutputKind::Quaternion, _) => words(&["q0", "q1", "q2", "q3"], &[""; 4]),
        (OutputKind::CardanAngles, _) => words(&["alpha", "beta", "gamma"], &["rad"; 3]),
        (OutputKind::Energy, _) => words(&["kinetic", "strain", "potential", "total"], &["J"; 4]),
    }
}

/// Components and units of accelerations of coordinates.
fn accelerations(coordinates: Vec<CoordinateId>, system: &System) -> (Vec<String>, Vec<&'static str>) {
    let count = coordinates.len();
    let number = |k: usize| if count > 1 { (k + 1).to_string() } else { String::new() };
    let each = coordinates.into_iter().enumerate().map(|(k, coordinate)| {
        let unit = match system.layout().coordinate_quantity(coordinate) {
            Quantity::Angle => "rad/s²",
            Quantity::Length | Quantity::State => "m/s²",
        };
        (format!("a{}", number(k)), unit)
    });
    each.unzip()
}

/// Components of relative coordinates, numbered where there are several of a kind.
fn relative(coordinates: &[CoordinateId], system: &System) -> (Vec<String>, Vec<&'static str>) {
    let kind = |&coordinate: &CoordinateId| system.layout().coordinate_quantity(coordinate);
    let mut components = Vec::new();
    let mut units = Vec::new();
    for (index, coordinate) in coordinates.iter().enumerate() {
        let alike =
            |others: &[CoordinateId]| others.iter().filter(|&other| kind(other) == kind(coordinate)).count();
        let number =
            if alike(coordinates) > 1 { alike(&coordinates[..=index]).to_string() } else { String::new() };
        let (words, of_words) = match kind(coordinate) {
            Quantity::Angle => (["angle", "rate"], ["rad", "rad/s"]),
            Quantity::Length => (["displacement", "velocity"], ["m", "m/s"]),
            Quantity::State => (["value", "rate"], ["", "1/s"]),
        };
        components.extend(words.map(|word| format!("{word}{number}")));
        units.extend(of_words);
    }
    (components, units)
}
