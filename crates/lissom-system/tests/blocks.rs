//! Elements eight at a time against one at a time, on every kind of vector that this processor has.

use lissom_flexible::beam::{Beam, SectionLaw};
use lissom_flexible::shell::Shell;
use lissom_flexible::shell::section::{Ply, ShellLaw};
use lissom_mechanics::elements::inertia::{Gravity, Inertia};
use lissom_mechanics::elements::{Deformable, Element, Tangents};
use lissom_mechanics::kinematics::{Kinematics, NodeId, NodeMotion, Stressed};
use lissom_motion::{Block, Matrix6, Motion, Vector3, Vector6, WIDTH};

/// Every level of vector instructions this processor has, and none.
fn processors() -> Vec<pulp::Arch> {
    let mut processors = vec![pulp::Arch::Scalar, pulp::Arch::new()];
    #[cfg(target_arch = "x86_64")]
    processors.extend(pulp::x86::V3::try_new().map(pulp::Arch::V3));
    processors
}

/// Numbers between -1 and 1 that look random [Marsaglia 2003, xorshift].
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        for shift in [13, -7, 17] {
            let shifted: u64 = if shift > 0 { self.0 << shift } else { self.0 >> -shift };
            self.0 ^= shifted;
        }
        self.0 as f64 / u64::MAX as f64 * 2.0 - 1.0
    }

    fn vector(&mut self) -> Vector6 {
        Vector6::from_fn(|_, _| self.next())
    }

    fn matrix(&mut self) -> Matrix6 {
        Matrix6::from_fn(|_, _| self.next())
    }
}

/// Nodes along a curve, next ones turned against each other by up to about `turn` rad and moving.
fn kinematics(numbers: &mut Numbers, count: usize, turn: f64) -> Kinematics {
    let mut frame = Motion::exponential(&numbers.vector());
    let nodes = (0..count)
        .map(|_| {
            let step = numbers.vector() * turn + Vector6::new(0.3, 0.0, 0.0, 0.0, 0.0, 0.0);
            frame = frame * Motion::exponential(&step);
            NodeMotion { frame, twist: numbers.vector(), acceleration: numbers.vector() }
        })
        .collect();
    Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes,
        coordinates: Vec::new(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    }
}

fn compare<E: Element>(elements: &[E], at: &Kinematics) {
    let size = elements[0].unknowns().force_count();
    let blocks = E::blocks(elements).expect("a kind that is evaluated several at a time");
    let count = elements.len().div_ceil(WIDTH);
    for processor in processors() {
        let mut seen = 0;
        blocks.forces(processor, at, 0..count, &mut |block, forces| {
            assert_eq!((block * WIDTH, forces.len()), (seen, size));
            for (lane, element) in elements[seen..].iter().take(WIDTH).enumerate() {
                let mut single = vec![0.0; size];
                element.forces(at, &mut single);
                let largest = single.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
                assert!(largest > 0.0);
                for i in 0..size {
                    let error = (forces[i][lane] - single[i]).abs();
                    let element = seen + lane;
                    assert!(
                        error < 1e-13 * largest,
                        "{processor:?}, {element}, {i}: {error:e} of {largest:e}"
                    );
                }
            }
            seen += WIDTH;
        });
        assert!(seen >= elements.len());
        // One block alone gives the same bits.
        let last = elements.len() - (count - 1) * WIDTH;
        let own = |forces: &[Block]| forces.iter().map(|force| force[..last].to_vec()).collect::<Vec<_>>();
        let (mut all, mut alone) = (Vec::new(), Vec::new());
        blocks.forces(processor, at, 0..count, &mut |_, forces| all.push(own(forces)));
        blocks.forces(processor, at, count - 1..count, &mut |_, forces| alone.push(own(forces)));
        assert_eq!(all.last(), alone.last());
    }
}

/// The same of their derivatives with respect to positions and, where something is damped, to twists.
fn compare_derivatives<E: Deformable>(
    elements: &[E],
    (at, stressed): (&Kinematics, Stressed<'_>),
    damped: bool,
) {
    let size = elements[0].unknowns().force_count();
    let blocks = E::blocks(elements).expect("a kind that is evaluated several at a time");
    let count = elements.len().div_ceil(WIDTH);
    let single = |element: &E| {
        let mut single = Tangents::new(size);
        element.linearize_stressed(at, stressed, &mut single);
        single
    };
    let singles: Vec<Tangents> = elements.iter().map(single).collect();
    for processor in processors() {
        let (mut seen, mut are_damped) = (0, false);
        let done = blocks.linearize(processor, (at, stressed), 0..count, &mut |block, entries| {
            assert_eq!((block * WIDTH, entries[0].len()), (seen, size * size));
            assert!([0, size * size].contains(&entries[1].len()));
            are_damped |= !entries[1].is_empty();
            for (lane, single) in singles[seen..].iter().take(WIDTH).enumerate() {
                assert!(single.mass.iter().all(|&value| value == 0.0));
                let largest = single.stiffness.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                assert!(largest > 0.0);
                for (entries, single) in entries.iter().zip([&single.stiffness, &single.damping]) {
                    assert!(!entries.is_empty() || single.iter().all(|&value| value == 0.0));
                    for (i, (entry, single)) in entries.iter().zip(single).enumerate() {
                        let error = (entry[lane] - single).abs();
                        assert!(error < 1e-13 * largest, "{processor:?}, {i}: {error:e} of {largest:e}");
                    }
                }
            }
            seen += WIDTH;
        });
        assert_eq!((done, seen, are_damped), (true, count * WIDTH, damped));
    }
}

/// Whether elements carry offsets, and are damped: none, all or some.
#[derive(Clone, Copy, PartialEq)]
enum Which {
    None,
    All,
    Some,
}

fn beams<const N: usize>() {
    for which in [
        [Which::None; 2],
        [Which::All; 2],
        [Which::Some; 2],
        [Which::None, Which::Some],
        [Which::None, Which::All],
    ] {
        for turn in [0.0, 0.01, 0.1, 0.3, 1.0] {
            for count in [1, 7, 8, 21] {
                let mut numbers = Numbers(0x9E37_79B9_7F4A_7C15);
                let at = kinematics(&mut numbers, count * (N - 1) + 1, turn);
                let [damped, carried] = which
                    .map(|which| move |k: usize| which == Which::All || which == Which::Some && k % 3 == 1);
                let elements: Vec<_> = (0..count)
                    .map(|k| {
                        let nodes = std::array::from_fn(|i| NodeId::new(k * (N - 1) + i));
                        let offsets = std::array::from_fn(|i| {
                            (carried(k) && i != 1).then(|| Motion::exponential(&(numbers.vector() * 0.2)))
                        });
                        let bend = numbers.vector() * 0.2;
                        let natural = std::array::from_fn(|i| {
                            let along = Vector6::new(0.5, 0.0, 0.0, 0.0, 0.0, 0.0) + bend;
                            Motion::exponential(&(along * i as f64 / (N - 1) as f64))
                        });
                        let stiffness = numbers.matrix();
                        let damping = if damped(k) { 0.1 } else { 0.0 };
                        Beam::<N>::new(nodes, offsets, &natural, |_| SectionLaw {
                            damping,
                            ..SectionLaw::elastic(stiffness)
                        })
                    })
                    .collect();
                compare(&elements, &at);
                let stressed = kinematics(&mut numbers, count * (N - 1) + 1, turn);
                compare_derivatives(&elements, (&at, (&stressed).into()), (0..count).any(damped));
            }
        }
    }
}

#[test]
fn beams_of_two_nodes() {
    beams::<2>();
}

#[test]
fn beams_of_three_nodes() {
    beams::<3>();
}

#[test]
fn beams_of_four_nodes() {
    beams::<4>();
}

/// Stresses of the geometric stiffness are those of another configuration, or predicted from it.
#[test]
fn shells() {
    for (turn, count) in [(0.0, 1), (0.05, 7), (0.2, 8), (0.5, 21)] {
        let mut numbers = Numbers(0x9E37_79B9_7F4A_7C15);
        let mut elements = Vec::new();
        let mut at = kinematics(&mut numbers, 4 * count, turn);
        let mut stressed = at.clone();
        for k in 0..count {
            let whole = Motion::exponential(&numbers.vector());
            let corners = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [1.1, 0.9, 0.1], [0.0, 1.0, 0.0]];
            let nodes: [NodeId; 4] = std::array::from_fn(|i| NodeId::new(4 * k + i));
            let place = |corner: [f64; 3]| whole * Motion::translation(Vector3::from(corner));
            let frames = corners.map(place);
            for (node, frame) in nodes.into_iter().zip(frames) {
                at.nodes[node].frame = frame * Motion::exponential(&(turn * numbers.vector()));
                stressed.nodes[node].frame = frame * Motion::exponential(&(turn * numbers.vector()));
            }
            let normals = [whole.rotation.apply(&Vector3::z()); 4];
            let law = ShellLaw::laminate(&[Ply::isotropic(0.1, 3.0, 0.3, 1.0)], 0.0);
            elements.push(Shell::new(nodes, &frames, &normals, None, law));
        }
        if turn > 0.0 {
            compare(&elements, &at);
        }
        let predicted = Stressed { at: &at, previous: Some(&stressed) };
        for stressed in [(&stressed).into(), predicted] {
            compare_derivatives(&elements, (&at, stressed), false);
        }
    }
}

#[test]
fn inertias() {
    for count in [1, 8, 19] {
        let mut numbers = Numbers(0x2545_F491_4F6C_DD1D);
        let at = kinematics(&mut numbers, count, 1.0);
        let gravity = Gravity::constant(Vector3::new(0.5, -9.81, 2.0));
        let elements: Vec<_> =
            NodeId::first(count).map(|node| Inertia::new(node, numbers.matrix(), gravity.clone())).collect();
        compare(&elements, &at);
    }
}
