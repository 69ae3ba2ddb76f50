//! Tests of `control::planned`, a module of it.

use super::*;

#[test]
fn parts_halve_grow_back_and_meet_the_end_of_every_planned_step() {
    let mut bisection = StepBisection::whole();
    let (mut planned, mut time) = (0, 0.0);
    let mut sizes = Vec::new();
    while planned < 6 {
        let size = bisection.fraction();
        // Between 1.1 and 1.4 nothing longer than 0.1 is possible.
        if size > 0.1 && time + size > 1.1 && time < 1.4 {
            assert!(bisection.halve());
            continue;
        }
        sizes.push(size);
        time += size;
        if bisection.accept() {
            planned += 1;
            assert_eq!(time, f64::from(planned));
        }
    }
    assert_eq!(sizes.iter().copied().fold(1.0, f64::min), 0.0625);
    assert_eq!(sizes.last(), Some(&1.0), "{sizes:?}");
}

#[test]
fn twelve_halvings_are_the_end() {
    let mut bisection = StepBisection::whole();
    let halvings = (0..100).take_while(|_| bisection.halve()).count();
    assert_eq!(halvings, 12);
}
