//! Outputs of joints in every choice of axes against the frames that docs/joints.md describes, and values at the start, for every
//! kind of joint between two nodes.

use lissom_core::kinematics::{GROUND, NodeId};
use lissom_core::ports::{PortType, Ports};
use lissom_motion::{Matrix3, Motion, Rotation, Vector3};
use toml::{Table, Value};

use crate::models::part_axes::{End, SCENES, STEPS, entries, kind_of, near, plain, registered, tables_of};

/// Kinds whose frame on the tip is at the position of the tip's node.
const SPANNING: [&str; 3] = ["rolling", "swing_arm", "wheel_on_rail"];

fn vector(entry: &Table, key: &str) -> Option<Vector3> {
    let list = entry.get(key)?.as_array()?;
    let number = |own: &Value| own.as_float().or(own.as_integer().map(|own| own as f64));
    let numbers: Vec<f64> = list.iter().filter_map(number).collect();
    Some(Vector3::from_column_slice(&numbers))
}

fn number(entry: &Table, key: &str) -> f64 {
    entry.get(key).map_or(0.0, |own| own.as_float().or(own.as_integer().map(|own| own as f64)).expect(key))
}

/// The node that a name means.
fn node(end: &End, name: &str) -> NodeId {
    let names = &end.lowered.names;
    match (name.strip_suffix(".start"), name.strip_suffix(".end")) {
        _ if name == "ground" => GROUND,
        (Some(beam), _) => names.lines[beam].nodes[0],
        (_, Some(beam)) => *names.lines[beam].nodes.last().expect("nodes"),
        // The first node of the only kinds of references to shells and solids in the scenes.
        _ if name.contains("@0,0") => {
            names.meshes.nodes_of(name.split_once('@').expect("a node").0).expect("a shell or solid").nodes[0]
        }
        _ => names.nodes[name],
    }
}

/// Axes of a joint frame at the start.
fn axes(ports: Ports, entry: &Table) -> Rotation {
    let columns =
        |a: Vector3, b: Vector3| Rotation::from_matrix(&Matrix3::from_columns(&[a, b, a.cross(&b)]));
    match (ports.directions(), vector(entry, "axis"), vector(entry, "second_axis")) {
        (1, Some(axis), _) => {
            let third = axis.normalize();
            let farthest =
                (0..3).fold(0, |best, k| if third[k].abs() < third[best].abs() { k } else { best });
            let global = Vector3::ith(farthest, 1.0);
            let first = (global - third * third.dot(&global)).normalize();
            columns(first, third.cross(&first))
        }
        (2, Some(axis), Some(second)) => {
            let first = axis.normalize();
            columns(first, (second - first * first.dot(&second)).normalize())
        }
        _ => Rotation::IDENTITY,
    }
}

/// The joint frames at the start, as the manual describes them.
fn frames(end: &End, ports: Ports, entry: &Table, spans: bool) -> [Motion; 2] {
    let start = |name: &str| {
        let key = entry[name].as_str().expect("a node");
        end.lowered.state.kinematics.nodes[node(end, key)].frame.position
    };
    let default = if entry["tip"].as_str() == Some("ground") { start("base") } else { start("tip") };
    let (at_base, at_tip) = if spans {
        let base = vector(entry, "at").or_else(|| vector(entry, "at_base"));
        (base.unwrap_or_else(|| start("base")), vector(entry, "at_tip").unwrap_or_else(|| start("tip")))
    } else {
        let at = vector(entry, "at").unwrap_or(default);
        (at, at)
    };
    let axes = axes(ports, entry);
    let third = axes.apply(&Vector3::z());
    let angle = if spans { 0.0 } else { number(entry, "angle") };
    // Along the axis at the start: the base's frame is behind the tip's.
    let along = if spans { 0.0 } else { number(entry, "displacement") }
        + number(entry, "lead") * angle / std::f64::consts::TAU;
    let mut turn = Rotation::exponential(&(angle * third));
    if let Some(tip_axis) = vector(entry, "tip_axis") {
        let across = third.cross(&tip_axis.normalize());
        turn = Rotation::exponential(&(across.normalize() * across.norm().asin()));
    }
    [Motion::new(axes, at_base - along * third), Motion::new(turn * axes, at_tip)]
}

/// A scene with outputs of one joint added in all axes.
fn with_outputs(scene: &Table, joint: &str) -> Table {
    let mut scene = scene.clone();
    let outputs = scene["outputs"].as_table_mut().expect("outputs");
    for (name, kind, axes) in [
        ("seen_ground", "reaction", "ground"),
        ("seen_base", "reaction", "base"),
        ("seen_tip", "reaction", "tip"),
        ("seen_motion", "relative_motion", ""),
    ] {
        let mut output = Table::new();
        output.insert("kind".to_owned(), kind.into());
        output.insert("of".to_owned(), joint.into());
        if !axes.is_empty() {
            output.insert("axes".to_owned(), axes.into());
        }
        outputs.insert(name.to_owned(), Value::Table(output));
    }
    scene
}

fn output<'e>(end: &'e End, name: &str) -> &'e [f64] {
    &end.outputs.iter().find(|(own, ..)| own == name).expect(name).2
}

/// Whether a joint has frames on two nodes: a set of nodes has none.
fn has_frames(ports: Ports) -> bool {
    ports.connect_two_nodes() && ports.0.iter().all(|port| port.holds != PortType::Set)
}

#[test]
fn outputs_of_joints_are_expressed_in_the_axes_of_the_manual() {
    let mut covered = Vec::new();
    for (scene_name, scene) in SCENES {
        let scene = entries(scene);
        for (name, entry) in tables_of(&scene, "joints") {
            let kind = kind_of(entry);
            let ports = registered("joints", kind).expect("a kind").ports;
            if !has_frames(ports) {
                continue;
            }
            let spans = SPANNING.contains(&kind) || !ports.have_one_location();
            covered.push(kind.to_owned());
            let end =
                plain(&with_outputs(&scene, name), STEPS).unwrap_or_else(|text| panic!("{name}: {text}"));
            let what = format!("{scene_name}, {kind} `{name}`");
            let nodes = ["base", "tip"].map(|key| node(&end, entry[key].as_str().expect("a node")));
            let start = frames(&end, ports, entry, spans);
            let now = [0, 1].map(|side| {
                let first = end.lowered.state.kinematics.nodes[nodes[side]].frame;
                end.frames[nodes[side]] * (first.inverse() * start[side])
            });
            let motion = now[1].relative_to(&now[0]);
            let wanted: Vec<f64> =
                motion.position.iter().chain(motion.rotation.logarithm().iter()).copied().collect();
            near(output(&end, "seen_motion"), &wanted, 1e-11, &format!("relative motion of {what}"));
            let ground = output(&end, "seen_ground").to_vec();
            for (axes, frame) in [("seen_base", &now[0]), ("seen_tip", &now[1])] {
                let turned: Vec<f64> = ground
                    .chunks(3)
                    .flat_map(|own| frame.rotation.apply_inverse(&Vector3::from_column_slice(own)).data.0[0])
                    .collect();
                near(output(&end, axes), &turned, 1e-11, &format!("{axes} of {what}"));
            }
        }
    }
    for kind in lissom_model::lower::registry::registry().joints {
        assert!(
            !has_frames(kind.ports) || covered.iter().any(|own| own == kind.name),
            "no scene has a {}",
            kind.name
        );
    }
}

/// With another value at the start the motion and the reaction are the same, and the coordinate is counted from elsewhere.
#[test]
fn values_at_the_start_move_nothing() {
    let mut count = 0;
    for kind in lissom_model::lower::registry::registry().joints {
        if !kind.ports.have_one_location() {
            continue;
        }
        let axes = match kind.ports.directions() {
            1 => "axis = [0.3, 0.2, 1]\n",
            _ => "axis = [0.6, 0.8, 0]\nsecond_axis = [0, 0, 1]\n",
        };
        for key in ["angle", "displacement"] {
            if !kind.parameters.iter().any(|parameter| parameter.name == key) {
                continue;
            }
            count += 1;
            let at = if kind.ports.have_one_location() { "at" } else { "at_base" };
            let text = |value: f64| {
                let own = kind
                    .sample
                    .lines()
                    .filter(|line| !line.starts_with("axis") && !line.starts_with("second_axis"));
                let own: Vec<&str> = own.collect();
                format!(
                    "[bodies.carrier]\nmass = 2\ninertia = [0.1, 0.2, 0.15]\nposition = [-0.1, 0.2, 0.1]\n\
                     [joints.own]\nkind = \"{}\"\nbase = \"carrier\"\ntip = \"own\"\n{at} = [0.1, 0.05, -0.1]\n{axes}{}\n{key} = {value:?}\n\
                     [bodies.own]\nmass = 1.3\ninertia = [0.02, 0.03, 0.04]\nposition = [0.4, -0.2, 0.3]\nrotation = [0.1, 0.2, 0.3]\n\
                     [joints.carrier]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"carrier\"\nat = [-0.3, 0, 0]\naxis = [1, 0.1, 0.2]\n\
                     [outputs.relative]\nkind = \"relative\"\nof = \"own\"\n",
                    kind.name,
                    own.join("\n"),
                )
            };
            let what = format!("{} with `{key}`", kind.name);
            let end = |value: f64| {
                let scene: Table = text(value).parse().expect("a scene");
                plain(&with_outputs(&scene, "own"), STEPS).unwrap_or_else(|text| panic!("{what}: {text}"))
            };
            let (zero, other) = (end(0.0), end(0.3));
            for (a, b) in zero.frames.iter().zip(&other.frames) {
                near(b.position.as_slice(), a.position.as_slice(), 1e-11, &what);
                near(b.rotation.matrix().as_slice(), a.rotation.matrix().as_slice(), 1e-11, &what);
            }
            near(output(&other, "seen_ground"), output(&zero, "seen_ground"), 1e-8, &what);
            let shift: Vec<f64> = output(&other, "relative")
                .iter()
                .zip(output(&zero, "relative"))
                .map(|(a, b)| a - b)
                .collect();
            let of_key = if kind.name == "cylindrical" && key == "displacement" { 2 } else { 0 };
            let wanted: Vec<f64> = (0..shift.len()).map(|k| if k == of_key { 0.3 } else { 0.0 }).collect();
            near(&shift, &wanted, 1e-11, &what);
        }
    }
    assert!(count >= 9, "{count} kinds have values at the start");
}

/// Vectors of motions and momenta `in` the axes of a body are those in global axes, transformed by hand.
#[test]
fn outputs_in_axes_of_a_body_are_those_in_global_axes_transformed() {
    let mut scene = entries(include_str!("connections.toml"));
    let outputs = scene["outputs"].as_table_mut().expect("outputs");
    let kinds =
        ["position", "displacement", "velocity", "acceleration", "rotation", "angular_velocity", "momentum"];
    for kind in kinds {
        for (name, axes) in [("global", None), ("own", Some("block")), ("fixed", Some("ground"))] {
            let mut output = Table::new();
            output.insert("kind".to_owned(), kind.into());
            if kind != "momentum" {
                output.insert("of".to_owned(), "plate".into());
            }
            if let Some(axes) = axes {
                output.insert("in".to_owned(), axes.into());
            }
            outputs.insert(format!("{name}_{kind}"), Value::Table(output));
        }
    }
    let end = plain(&scene, STEPS).unwrap_or_else(|text| panic!("{text}"));
    let block = end.frames[node(&end, "block")].rotation;
    for kind in kinds {
        let global = output(&end, &format!("global_{kind}"));
        let turned: Vec<f64> = global
            .chunks(3)
            .flat_map(|own| block.apply_inverse(&Vector3::from_column_slice(own)).data.0[0])
            .collect();
        near(output(&end, &format!("own_{kind}")), &turned, 1e-12, kind);
        near(output(&end, &format!("fixed_{kind}")), global, 1e-14, kind);
    }
}

/// The manual's example: a table that is prescribed relative to the ground.
#[test]
fn a_prescribed_motion_is_reported_between_its_base_and_tip() {
    let scene: Table =
        "[bodies.b]\nmass = 2\ninertia = [0.02, 0.03, 0.04]\ncenter_of_mass = [0.1, 0.2, 0.3]\n\
        [joints.table]\nkind = \"prescribed_motion\"\nbase = \"ground\"\ntip = \"b\"\n\
        x = \"0.5*(t/0.006)^2\"\ny = \"0.3*(t/0.006)^2\"\nry = \"0.4*(t/0.006)^2\"\n[outputs]\n"
            .parse()
            .expect("a scene");
    let end = plain(&with_outputs(&scene, "table"), STEPS).unwrap_or_else(|text| panic!("{text}"));
    near(output(&end, "seen_motion"), &[0.5, 0.3, 0.0, 0.0, 0.4, 0.0], 1e-10, "relative motion");
    near(output(&end, "seen_base"), output(&end, "seen_ground"), 1e-12, "the base is the ground");
}
