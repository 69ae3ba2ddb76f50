//! All kinds of outputs, from the table: each has a scene, its derivatives are those of differences, and a signal has the value
//! that is recorded.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use lissom_mechanics::kinematics::{DiscreteValueId, LOCKED, NodeMotion};
use lissom_motion::{Motion, Vector6};
use lissom_system::OutputDerivatives;
use lissom_system::{State, System};

use crate::lower::registry::registry;
use crate::lower::{Built, Observed, build};
use crate::outputs::Evaluation;
use crate::outputs::channels::{Channel, signal_value};
use crate::outputs::kinds::{Feature, Feeds, OutputKind};
use crate::{Library, ModelText, Report};

const MODEL: &str = include_str!("../../every_output.toml");
const MASS: &str = "%%MatrixMarket matrix coordinate real symmetric\n7 7 8\n1 1 1\n2 2 1\n3 3 1\n4 4 0.1\n5 5 0.2\n6 6 0.25\n\
                    7 7 0.5\n7 1 0.1\n";
const STIFFNESS: &str = "%%MatrixMarket matrix coordinate real symmetric\n7 7 1\n7 7 100\n";
const RECOVERY: &str = "%%MatrixMarket matrix coordinate real general\n1 7 1\n1 7 3\n";

/// Outputs of kinds that feed signals at all times, but of a reaction, a drive and a load that a signal scales.
const AT_SAMPLES_ALONE: [&str; 3] = ["mixed", "drive_power", "scaled_power"];

/// The model with more signals.
fn lowered(signals: &str) -> (Built, Observed) {
    attempt(signals).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

/// The model with more signals, or why there is none.
fn attempt(signals: &str) -> Result<(Built, Observed), Report> {
    let files = [("mass.mtx", MASS), ("stiffness.mtx", STIFFNESS), ("recovery.mtx", RECOVERY)];
    let library = Library::of_texts(files.map(|(path, text)| (path.to_owned(), text.to_owned())));
    let text = MODEL.replacen("[signals]\n", &format!("[signals]\n{signals}"), 1);
    let text = ModelText::read_with(&text, "every_output.toml", &[], Arc::new(library))
        .unwrap_or_else(|report| panic!("{}", report.render(false)));
    let document =
        text.document(&registry(), &[]).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let mut built = build(&document, &[])?;
    let drawn = built.state.clone();
    built.set_velocities(&document);
    let undeformed = built.state.clone();
    let observed = built.observe(&document, [&drawn, &undeformed], Vec::new())?;
    Ok((built, observed))
}

fn waves(seed: f64) -> Vector6 {
    Vector6::from_fn(|k, _| (seed + 1.7 * k as f64).sin())
}

/// Without rotation.
fn translation_of(mut screw: Vector6) -> Vector6 {
    screw.fixed_rows_mut::<3>(3).fill(0.0);
    screw
}

/// The start of the model, with everything in motion.
fn in_motion((Built { system, state, .. }, Observed { accumulated, .. }): &(Built, Observed)) -> State {
    let mut state = state.clone();
    for (index, node) in state.kinematics.nodes.iter_mut().enumerate().skip(1) {
        let seed = 2.3 * index as f64;
        // Point masses and nodes of solids have no rotation.
        let is_point =
            system.layout().node_rows[index][3] == LOCKED && system.layout().node_rows[index][0] != LOCKED;
        let own = |seed: f64| if is_point { translation_of(waves(seed)) } else { waves(seed) };
        let frame = node.frame * Motion::exponential(&(0.05 * own(seed)));
        *node = NodeMotion { frame, twist: own(seed + 0.4), acceleration: own(seed + 0.9) };
    }
    for (index, own) in state.kinematics.coordinates.iter_mut().enumerate() {
        let seed = 1.3 * index as f64;
        own.value += 0.1 * seed.sin();
        own.rate = (seed + 0.3).sin();
        own.acceleration = (seed + 0.8).sin();
    }
    for (index, own) in state.multipliers.iter_mut().enumerate() {
        *own = 3.0 * (0.7 * index as f64 + 0.2).sin();
    }
    state.accumulated = (0..accumulated.len()).map(|index| 0.3 + index as f64).collect();
    state
}

fn values(channel: &Channel, system: &System, state: &State) -> Vec<f64> {
    let mut values = Vec::new();
    channel.evaluate(system, state, &mut values);
    assert_eq!(values.len(), channel.components.len(), "{}", channel.name);
    values
}

#[test]
fn every_kind_has_a_scene() {
    let (_, model) = lowered("");
    for kind in OutputKind::all() {
        assert!(model.channels.iter().any(|channel| channel.kind == kind), "no scene of {}", kind.name());
    }
}

/// Continuous signals of kinds that feed them at all times, sampled ones of all kinds.
#[test]
fn signals_have_the_values_that_are_recorded() {
    let (_, plain) = lowered("");
    let mut signals = String::new();
    for channel in &plain.channels {
        for component in &channel.components {
            let name = format!("{}_{component}", channel.name);
            let of = format!("{}.{component}", channel.name);
            // Writing to a string cannot fail.
            let _ = writeln!(signals, "sampled_{name} = {{ value = \"{of}\", sample = 1 }}");
            if channel.kind.feeds() == Feeds::Signals && !AT_SAMPLES_ALONE.contains(&&*channel.name) {
                let _ = writeln!(signals, "at_all_times_{name} = \"{of}\"");
            }
        }
    }
    let model = lowered(&signals);
    let (built, observed) = &model;
    let system = &built.system;
    let mut state = in_motion(&model);
    let readings: Vec<_> = system.take_readings(&state).collect();
    for (held, value) in readings {
        state.kinematics.held[held.index()] = value;
    }
    system.signals().begin(&mut state.kinematics).expect("finite");
    let mut compared = BTreeMap::new();
    for channel in &observed.channels {
        for (component, recorded) in channel.components.iter().zip(values(channel, system, &state)) {
            for kind in ["sampled", "at_all_times"] {
                let name = format!("{kind}_{}_{component}", channel.name);
                let Some(&signal) = built.names.signals.get(&name) else { continue };
                let value = signal_value(system, &state.kinematics, signal);
                assert!(value.to_bits() == recorded.to_bits(), "{name}: {value} but recorded {recorded}");
                *compared.entry((channel.kind.name(), kind)).or_insert(0) += 1;
            }
        }
    }
    for kind in OutputKind::all() {
        assert!(compared.contains_key(&(kind.name(), "sampled")), "{}", kind.name());
        let feeds = kind.feeds() == Feeds::Signals;
        assert_eq!(compared.contains_key(&(kind.name(), "at_all_times")), feeds, "{}", kind.name());
    }
}

#[test]
fn powers_of_drives_and_scaled_loads_are_available_at_samples_alone() {
    for name in ["drive_power", "scaled_power"] {
        let refused = attempt(&format!("at_all_times = \"{name}.power\"\n")).err();
        let report = refused.expect("there is no gradient").render(false);
        assert!(report.contains("add `sample`"), "{report}");
    }
}

#[test]
fn the_manual_states_when_kinds_feed_signals() {
    const MANUAL: &str = include_str!("../../../../../docs/signals.md");
    for kind in OutputKind::all() {
        let when = match kind.feeds() {
            Feeds::Signals => "at all times".to_owned(),
            Feeds::Samples(reason) => format!("at samples: {reason}"),
        };
        let row = format!("| `{}` | {when}", kind.name());
        assert!(MANUAL.contains(&row), "docs/signals.md lacks: {row}");
    }
}

/// A way to change a state, and the derivative by it.
type Direction<'d> = (String, Box<dyn Fn(&mut State, f64) + 'd>, Box<dyn Fn(&OutputDerivatives) -> f64 + 'd>);

/// All ways to change a state of a system.
fn directions<'d>(system: &'d System, state: &'d State) -> Vec<Direction<'d>> {
    let layout = system.layout();
    let at = |of: &BTreeMap<usize, f64>, row: usize| of.get(&row).copied().unwrap_or(0.0);
    let mut all: Vec<Direction<'d>> = Vec::new();
    for node in layout.nodes() {
        for (k, &row) in layout.rows_of_node(node).iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            let (row, along) = (row as usize, Vector6::ith(k, 1.0));
            let name = layout.name_of(row).clone();
            all.push((
                format!("position {name}"),
                Box::new(move |state, change| {
                    let frame = &mut state.kinematics.nodes[node].frame;
                    *frame = *frame * Motion::exponential(&(change * along));
                }),
                Box::new(move |of| at(&of.by_place, row)),
            ));
            all.push((
                format!("twist {name}"),
                Box::new(move |state, change| state.kinematics.nodes[node].twist += change * along),
                Box::new(move |of| at(&of.by_rate, row)),
            ));
            all.push((
                format!("acceleration {name}"),
                Box::new(move |state, change| state.kinematics.nodes[node].acceleration += change * along),
                Box::new(move |of| at(&of.by_acceleration, row)),
            ));
        }
    }
    for own in layout.coordinates() {
        let row = layout.row_of_coordinate(own);
        let name = layout.name_of(row).clone();
        all.push((
            format!("value {name}"),
            Box::new(move |state, change| state.kinematics.coordinates[own].value += change),
            Box::new(move |of| at(&of.by_place, row)),
        ));
        all.push((
            format!("rate {name}"),
            Box::new(move |state, change| state.kinematics.coordinates[own].rate += change),
            Box::new(move |of| at(&of.by_rate, row)),
        ));
        all.push((
            format!("acceleration {name}"),
            Box::new(move |state, change| state.kinematics.coordinates[own].acceleration += change),
            Box::new(move |of| at(&of.by_acceleration, row)),
        ));
    }
    for own in 0..state.multipliers.len() {
        let row = layout.coordinate_count() + own;
        all.push((
            format!("multiplier {own}"),
            Box::new(move |state, change| state.multipliers[own] += change),
            Box::new(move |of| at(&of.by_multiplier, row)),
        ));
    }
    // The sides of switches follow, which do not vary.
    for own in 0..system.signals().first_side() {
        all.push((
            format!("held value {own}"),
            Box::new(move |state, change| state.kinematics.held[own] += change),
            Box::new(move |of| of.by_held.get(&DiscreteValueId::new(own)).copied().unwrap_or(0.0)),
        ));
    }
    all
}

#[test]
fn derivatives_are_those_of_differences() {
    let model = lowered("");
    let (built, observed) = &model;
    let system = &built.system;
    let state = in_motion(&model);
    let directions = directions(system, &state);
    for channel in &observed.channels {
        let Some(found) = channel.derivatives_at(system, &state, 1.0) else {
            assert!(channel.kind.has(Feature::Accumulated), "{} has no derivatives", channel.name);
            continue;
        };
        if channel.kind.feeds() == Feeds::Signals {
            let at = Evaluation { system, state: &state };
            assert!(channel.quantity.derivatives(&at, 1.0).is_some(), "{}", channel.name);
        }
        for (name, change, derivative) in &directions {
            let step = 1e-3;
            let moved = |count: f64| {
                let mut moved = state.clone();
                change(&mut moved, count * step);
                values(channel, system, &moved)
            };
            let [a, b, c, d, e, f] = [1.0, -1.0, 2.0, -2.0, 3.0, -3.0].map(moved);
            for (k, component) in channel.components.iter().enumerate() {
                let by_differences =
                    (0.75 * (a[k] - b[k]) - 0.15 * (c[k] - d[k]) + (e[k] - f[k]) / 60.0) / step;
                let scale = 1.0 + by_differences.abs() + a[k].abs();
                let exact = derivative(&found[k]);
                assert!(
                    (exact - by_differences).abs() < 1e-7 * scale,
                    "{}.{component} by {name}: {exact} but difference {by_differences}",
                    channel.name
                );
            }
        }
    }
}
