//! Orders of elimination: every group once and behind all of its hosts, little fill, little time.

use crate::samples::{Model, Random, backward_error, chain, grid, right_hand_side, tree};
use lissom_solver::{Group, Structure, kind, minimum_degree_order};
use proptest::prelude::*;

/// Each group once and behind all of its hosts.
fn is_valid(structure: &Structure, order: &[usize]) -> Result<(), String> {
    let mut places = vec![usize::MAX; structure.groups.len()];
    for (place, &group) in order.iter().enumerate() {
        if std::mem::replace(&mut places[group], place) != usize::MAX {
            return Err(format!("group {group} appears twice"));
        }
    }
    if order.len() != places.len() {
        return Err("a group is missing".into());
    }
    for (index, group) in structure.groups.iter().enumerate() {
        let Some(last) = group.hosts.iter().map(|&host| places[host]).max() else { continue };
        if places[index] <= last {
            return Err(format!("group {index} comes before one of its hosts"));
        }
    }
    Ok(())
}

/// Random groups, some of them with hosts among all earlier ones, and random couplings.
fn random_structure(groups: usize, couplings: usize, seed: u64) -> Structure {
    let mut random = Random(seed);
    let mut model = Model::default();
    for index in 0..groups {
        let count = 1 + random.below(6);
        if index > 2 && random.below(3) == 0 {
            let hosts: Vec<usize> = (0..=random.below(3)).map(|_| random.below(index)).collect();
            model.constrain(&hosts, count);
        } else {
            model.group(count, &[]);
        }
    }
    for _ in 0..couplings {
        let (a, b) = (random.below(groups), random.below(groups));
        model.element(&[a, b]);
    }
    let mut groups = model.structure().groups;
    let mut numbers: Vec<usize> = (0..groups.len()).collect();
    random.shuffle(&mut numbers);
    let mut shuffled = vec![Group::default(); groups.len()];
    for (old, group) in groups.iter_mut().enumerate() {
        group.hosts.iter_mut().for_each(|host| *host = numbers[*host]);
        shuffled[numbers[old]] = std::mem::take(group);
    }
    Structure::new(model.structure().pattern, shuffled).unwrap()
}

proptest! {
    #[test]
    fn hosts_come_first(groups in 1_usize..60, couplings in 0_usize..120, seed: u64) {
        let structure = random_structure(groups, couplings, seed);
        prop_assert_eq!(is_valid(&structure, &minimum_degree_order(&structure)), Ok(()));
        prop_assert_eq!(minimum_degree_order(&structure), minimum_degree_order(&structure));
    }
}

#[test]
fn mechanisms_are_ordered_validly() {
    for model in [chain(2000), tree(2000), grid(2000)] {
        let structure = model.structure();
        assert_eq!(is_valid(&structure, &minimum_degree_order(&structure)), Ok(()));
    }
}

#[test]
fn fill_stays_small() {
    // A grid: nested dissection stores 31/4 n log2(n) numbers per triangle in the limit; stay near it.
    let structure = grid(20_000).structure();
    let entries = (kind("sparse").unwrap().real)(&structure).factor_entries();
    assert!(entries < 4_000_000, "{entries}");
    // Chains: a few numbers more than the band.
    let structure = chain(20_000).structure();
    let entries = (kind("sparse").unwrap().real)(&structure).factor_entries();
    assert!(entries < 700_000, "{entries}");
}

/// Nodes in a cube, each coupled with those around it, some of them held; minimum degree alone stores twice as many numbers.
#[test]
fn a_lattice_is_divided() {
    const SIDE: usize = 14;
    let mut model = Model::default();
    let nodes: Vec<usize> = (0..SIDE.pow(3)).map(|_| model.group(3, &[])).collect();
    let at = |i: usize, j: usize, k: usize| nodes[(i * SIDE + j) * SIDE + k];
    for i in 0..SIDE - 1 {
        for j in 0..SIDE - 1 {
            for k in 0..SIDE - 1 {
                let corners: Vec<usize> = (0..8).map(|c| at(i + c % 2, j + c / 2 % 2, k + c / 4)).collect();
                model.element(&corners);
            }
            if i == 0 {
                model.constrain(&[at(0, j, 0)], 2);
            }
        }
    }
    let structure = model.structure();
    let values: Vec<f64> = model.values(&structure.pattern, 1, 1.0);
    let right = right_hand_side::<f64>(model.size, 2);
    let mut solver = (kind("sparse").unwrap().real)(&structure);
    assert!(solver.factor_entries() < 9_000_000, "{}", solver.factor_entries());
    solver.factor(&values).unwrap();
    let mut solution = right.clone();
    solver.solve(&mut solution);
    assert!(backward_error(&structure.pattern, &values, &solution, &right, false) < 1e-12);
}

#[test]
fn hubs_take_no_quadratic_time() {
    // One group coupled with 50 000 others, and constraints on it.
    let mut model = Model::default();
    let hub = model.group(3, &[]);
    let rim: Vec<usize> = (0..50_000).map(|_| model.group(1, &[])).collect();
    for (index, &spoke) in rim.iter().enumerate() {
        model.element(&[hub, spoke]);
        if index % 10 == 0 {
            model.constrain(&[hub, spoke], 1);
        }
    }
    let structure = model.structure();
    let begin = std::time::Instant::now();
    assert_eq!(minimum_degree_order(&structure).len(), structure.groups.len());
    assert!(begin.elapsed().as_secs_f64() < 5.0);
}
