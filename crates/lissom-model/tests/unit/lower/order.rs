//! Tests of `lower::order`, a module of it.

use super::*;

#[test]
fn names_are_compared_as_people_count() {
    let names = ["leg10.rod", "a", "leg2.rod", "leg2", "B", "leg02", "leg1.rod"];
    let sorted = by_name(&names, |name| name);
    assert_eq!(sorted, [&"B", &"a", &"leg1.rod", &"leg02", &"leg2", &"leg2.rod", &"leg10.rod"]);
}
