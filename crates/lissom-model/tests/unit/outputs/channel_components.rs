//! Tests of `outputs::channel_components`, a module of it.

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
