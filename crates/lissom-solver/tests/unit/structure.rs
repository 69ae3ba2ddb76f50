//! Tests of `structure`, a module of it.

use super::*;

fn group(unknowns: &[usize], hosts: &[usize]) -> Group {
    Group { unknowns: unknowns.to_vec(), hosts: hosts.to_vec() }
}

#[test]
fn faults_are_named() {
    let check = |groups: Vec<Group>| {
        Structure::new(Arc::new(Pattern::from_entries(3, [])), groups).map(|_| ()).unwrap_err()
    };
    assert_eq!(check(vec![group(&[0, 1], &[])]), StructureError::Ungrouped { unknown: 2 });
    assert_eq!(
        check(vec![group(&[0, 1], &[]), group(&[1, 2], &[])]),
        StructureError::Repeated { unknown: 1, group: 1 }
    );
    assert_eq!(
        check(vec![group(&[0, 3], &[])]),
        StructureError::UnknownOutOfRange { group: 0, unknown: 3, size: 3 }
    );
    assert_eq!(
        check(vec![group(&[0, 1], &[]), group(&[2], &[7])]),
        StructureError::HostOutOfRange { group: 1, host: 7, groups: 2 }
    );
    assert_eq!(
        check(vec![group(&[0], &[]), group(&[1], &[2]), group(&[2], &[0, 1])]),
        StructureError::CyclicHosts { group: 1 }
    );
}
