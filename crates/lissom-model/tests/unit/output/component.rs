//! Tests of `output::component`, a module of it.

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
    for (name, found) in
        [("p.arm.angle", Some(0)), ("p.arm.rotation", Some(0)), ("p.arm.rate", Some(1)), ("arm.rate", None)]
    {
        assert_eq!(crate::output::Column::named(&columns, name), found, "{name}");
    }
}
