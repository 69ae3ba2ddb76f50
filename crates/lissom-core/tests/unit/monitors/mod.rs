//! Tests of `monitors`, a module of it.

use super::*;
use crate::bytes::{from_bytes, to_bytes};

/// Counts steps.
struct Count(u32);

impl Monitor for Count {
    fn accept(&mut self, _: &mut Accepted<'_>, _: &mut Vec<Warning>) {
        self.0 += 1;
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&self.0)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        from_bytes(saved, &mut self.0)
    }
}

fn monitors(counts: &[(&'static str, u32)]) -> Monitors {
    let monitor = |&(name, count): &(&'static str, u32)| (name, Box::new(Count(count)) as Box<dyn Monitor>);
    Monitors { monitors: counts.iter().map(monitor).collect() }
}

#[test]
fn monitors_come_and_go_between_a_snapshot_and_its_restoration() {
    let saved = monitors(&[("removed", 3), ("kept", 5)]).save();
    let mut restored = monitors(&[("new", 1), ("kept", 0)]);
    assert!(restored.restore(&saved));
    assert_eq!(restored.save(), monitors(&[("new", 1), ("kept", 5)]).save());
    assert!(!restored.restore(&[("kept".to_owned(), vec![0x80])]), "a number that does not end");
}

#[test]
fn names_of_monitors_differ() {
    let names: std::collections::BTreeSet<&str> = KINDS.iter().map(|kind| kind.name).collect();
    assert_eq!(names.len(), KINDS.len());
}
