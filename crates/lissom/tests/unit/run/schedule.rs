//! Tests of `run::schedule`, a module of it.

use super::*;

fn plan(end: f64, steps: usize) -> Plan {
    Plan { start: 0.5, end, steps, records: Records::Every(1), is_static: false, is_controlled: false }
}

fn size(schedule: &Schedule) -> f64 {
    match schedule.next() {
        Next::Planned { size, .. } => size,
        Next::Until(_) => panic!("steps are planned"),
    }
}

#[test]
fn the_last_step_is_shorter_and_the_end_exact() {
    let mut schedule = Schedule::new(plan(1.55, 11), 0.1);
    let mut sum = 0.5;
    while !schedule.is_finished() {
        sum += size(&schedule);
        schedule.accept(sum);
        assert_eq!(schedule.due(), Some(Due::End));
        assert_eq!(schedule.due(), None);
        assert!((schedule.time() - sum).abs() < 1e-14);
    }
    assert_eq!(schedule.done(), (11, 11));
    assert_eq!(schedule.time(), 1.55);
}

#[test]
fn a_whole_last_step_keeps_its_size_to_the_bit() {
    let mut schedule = Schedule::new(Plan { start: 0.0, ..plan(0.3, 3) }, 0.1);
    for _ in 0..3 {
        assert_eq!(size(&schedule), 0.1);
        schedule.accept(0.0);
    }
    assert_eq!(schedule.time(), 0.3);
}

/// What is recorded of steps of 0.1 s at most.
fn recorded(records: Records) -> Vec<Due> {
    let controlled = Plan { is_controlled: true, records, ..plan(1.6, 1) };
    let mut schedule = Schedule::new(controlled, 0.1);
    let mut met = Vec::new();
    while !schedule.is_finished() {
        let Next::Until(limit) = schedule.next() else { panic!("steps are chosen") };
        schedule.accept((schedule.time() + 0.1).min(limit));
        met.extend(std::iter::from_fn(|| schedule.due()));
    }
    met
}

#[test]
fn chosen_steps_end_at_every_record_and_the_end() {
    assert_eq!(recorded(Records::Ends(0.25)), [Due::End; 5]);
}

#[test]
fn records_at_a_distance_are_within_steps_and_at_the_end() {
    let met = recorded(Records::Within(0.25));
    assert_eq!(met, [Due::Within(0.75), Due::End, Due::Within(1.25), Due::End, Due::End]);
}

#[test]
fn steps_are_sampled_but_not_more_often_than_needed() {
    assert_eq!(recorded(Records::Resolved { per_step: 3, least: 1e-3 }).len(), 33);
    assert_eq!(recorded(Records::Resolved { per_step: 3, least: 0.06 }).len(), 16);
    assert_eq!(recorded(Records::Resolved { per_step: 1, least: 0.15 }), [Due::End; 5]);
}

#[test]
fn a_run_diverted_beyond_its_end_stands_there() {
    let mut schedule = Schedule::new(plan(1.5, 10), 0.1);
    schedule.divert(1.75);
    assert!(schedule.is_finished() && schedule.time() == 1.75);
}

#[test]
fn planned_steps_go_on_from_where_a_run_was_diverted() {
    let mut schedule = Schedule::new(plan(1.5, 10), 0.1);
    schedule.accept(0.6);
    schedule.divert(0.73);
    let mut sizes = Vec::new();
    while !schedule.is_finished() {
        sizes.push(size(&schedule));
        schedule.accept(0.0);
    }
    assert_eq!(sizes.len(), 8);
    assert!((0.73 + sizes.iter().sum::<f64>() - 1.5).abs() < 1e-14);
}
