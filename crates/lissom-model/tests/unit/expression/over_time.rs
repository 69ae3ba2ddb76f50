//! Tests of `expression::over_time`, a module of it.

use std::collections::BTreeMap;

use super::*;

fn over_time(text: &str, arguments: &[Line]) -> OverTime {
    OverTime::new(Formula::parse(text, &BTreeMap::new()).unwrap(), arguments)
}

#[test]
fn kinks_of_parts_that_depend_on_time_alone_are_known_and_no_switches() {
    let found = over_time("step(t - 2.5)*(1 - abs(rate)) + max(start, 2*t)", &[None, Some((1.0, 0.0))]);
    assert_eq!(found.breakpoints(), [0.5, 2.5]);
    let mut switches = Vec::new();
    found.switches(7.0, &[-3.0, 1.0], &[], &mut switches);
    assert_eq!(switches, [0.0, -3.0, 0.0].map(Switch::from));
    assert_eq!(found.line(), None);
}

#[test]
fn lines_go_on_through_arguments() {
    let found = over_time("2*(late - 1)", &[Some((-0.5, 1.0))]);
    assert_eq!(found.line(), Some((-3.0, 2.0)));
    assert_eq!(over_time("step(late)*rate", &[found.line(), None]).breakpoints(), [1.5]);
    assert_eq!(over_time("late*t", &[found.line()]).line(), None);
}

#[test]
fn switches_that_more_than_time_decides_stay() {
    let found = over_time("clamp(t - 1, 0, most) + step(t^2 - 2) + min(t, rate)", &[None, None]);
    assert_eq!(found.breakpoints(), [1.0]);
    let mut switches = Vec::new();
    found.switches(2.0, &[3.0, 5.0], &[], &mut switches);
    assert_eq!(switches, [1.0, -2.0, 2.0, -3.0].map(Switch::from));
}
