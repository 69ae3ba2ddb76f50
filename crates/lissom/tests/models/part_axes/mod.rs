//! A model inside a part that is rotated and translated, or placed by `in`, is the same model with its results transformed.
//! Covers every kind of the registry and every key that is expressed in model axes: kinds without a scene fail.

mod joint_axes;

use std::collections::BTreeSet;
use std::sync::Arc;

use lissom::start::{Lowered, lower};
use lissom_core::ports::Ports;
use lissom_core::registry::ParameterType;
use lissom_core::simulation::Simulation;
use lissom_model::document::OutputKind;
use lissom_model::lower::registry::registry;
use lissom_model::registry::KindEntry;
use lissom_model::{EntryAxes, Library, ModelText, model_axes};
use lissom_motion::{Matrix3, Motion, Rotation, Vector3};
use toml::{Table, Value};

/// The cheapest first.
const SCENES: [(&str, &str); 4] = [
    ("solids", include_str!("solids.toml")),
    ("elastic", include_str!("elastic.toml")),
    ("connections", include_str!("connections.toml")),
    ("every_kind", include_str!("../every_kind.toml")),
];

/// Files of the superelements: a mass of six rows and one mode, in axes of their own.
const MASS: &str = "%%MatrixMarket matrix coordinate real symmetric\n7 7 8\n1 1 1\n2 2 1\n3 3 1\n4 4 0.1\n5 5 0.2\n6 6 0.25\n\
                    7 7 1\n7 1 0.4\n";
const STIFFNESS: &str = "%%MatrixMarket matrix coordinate real symmetric\n7 7 1\n7 7 100\n";
const RECOVERY: &str = "%%MatrixMarket matrix coordinate real general\n1 7 1\n1 7 3\n";

/// Tables whose entries have the key `in`.
const PLACED: [&str; 10] = [
    "bodies",
    "point_masses",
    "beams",
    "shells",
    "solids",
    "superelements",
    "joints",
    "springs",
    "loads",
    "local_loads",
];

const GRAVITY: [f64; 3] = [0.03, -0.04, -9.7];
const POSITION: [f64; 3] = [0.7, -1.1, 0.4];
const ROTATION: [f64; 3] = [0.8, -0.5, 1.1];

const STEPS: usize = 3;

/// Motions agree to this fraction of their size.
const MOTIONS: f64 = 1e-12;
/// Forces and accelerations, in which constraints and springs multiply the round-off of positions.
const FORCES: f64 = 1e-9;

fn pose() -> Motion {
    Motion::new(Rotation::exponential(&Vector3::from(ROTATION)), Vector3::from(POSITION))
}

/// The entries of a scene, without what belongs to a whole model.
fn entries(scene: &str) -> Table {
    let mut table: Table = scene.parse().expect("a scene");
    for word in ["lissom", "gravity", "initial", "analysis"] {
        table.remove(word);
    }
    // At rest, as it is without `initial`, the direction of its creep is undetermined; `connections` has one that moves.
    if let Some(Value::Table(joints)) = table.get_mut("joints")
        && scene.contains("[joints.hoop_on_floor]")
    {
        joints.remove("tread");
    }
    table
}

fn header(gravity: Vector3) -> String {
    format!(
        "lissom = 1\ngravity = [{:?}, {:?}, {:?}]\n[analysis]\nkind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 0.006\n\
         step = 0.002\ntolerance = 1e-10\n",
        gravity.x, gravity.y, gravity.z
    )
}

fn part() -> String {
    format!("[parts.p]\nposition = {POSITION:?}\nrotation = {ROTATION:?}\n")
}

/// What a run ends with.
struct End {
    lowered: Lowered,
    point_masses: Vec<String>,
    frames: Vec<Motion>,
    velocities: Vec<[Vector3; 2]>,
    coordinates: Vec<[f64; 2]>,
    outputs: Vec<(String, OutputKind, Vec<f64>)>,
}

fn run(text: &str, part: &str, steps: usize) -> Result<End, String> {
    let files =
        [("part.toml", part), ("mass.mtx", MASS), ("stiffness.mtx", STIFFNESS), ("recovery.mtx", RECOVERY)];
    let library = Library::of_texts(files.map(|(path, text)| (path.to_owned(), text.to_owned())));
    let document = ModelText::read_with(text, "model.toml", &[], Arc::new(library))
        .and_then(|text| text.document(&registry(), &[]))
        .map_err(|report| report.render(false))?;
    let lowered = lower(&document).map_err(|report| report.render(false))?;
    let mut simulation =
        Simulation::new(Arc::clone(&lowered.system), lowered.state.clone(), lowered.settings.clone())
            .map_err(|error| error.to_string())?;
    simulation.accumulate(lowered.accumulated.clone());
    for _ in 0..steps {
        simulation.step().map_err(|error| error.to_string())?;
    }
    let state = simulation.state();
    let nodes = &state.kinematics.nodes;
    let outputs = lowered.channels.iter().map(|channel| {
        let mut values = Vec::new();
        channel.evaluate(&lowered.system, state, &mut values);
        (channel.name.trim_start_matches("p.").to_owned(), channel.kind, values)
    });
    Ok(End {
        frames: nodes.iter().map(|node| node.frame).collect(),
        velocities: nodes
            .iter()
            .map(|node| [node.velocity_at(&Vector3::zeros()), node.angular_velocity()])
            .collect(),
        // Those of joints: forces of wheels that roll are counted along axes that are not part of the model.
        coordinates: (lowered.names.coordinates.values().flatten())
            .map(|&own| [state.kinematics.coordinates[own].value, state.kinematics.coordinates[own].rate])
            .collect(),
        outputs: outputs.collect(),
        point_masses: document.point_masses.iter().map(|own| own.name.value.clone()).collect(),
        lowered,
    })
}

fn plain(entries: &Table, steps: usize) -> Result<End, String> {
    run(&format!("{}{entries}", header(Vector3::from(GRAVITY))), "", steps)
}

/// The scene as a file that is a part.
fn in_part(entries: &Table) -> Result<End, String> {
    let gravity = pose().rotation.apply(&Vector3::from(GRAVITY));
    run(&format!("{}{}include = \"part.toml\"\n", header(gravity), part()), &entries.to_string(), STEPS)
}

/// Every entry of the scene placed by `in`, relative to a part.
fn by_in(entries: &Table) -> Result<End, String> {
    let gravity = pose().rotation.apply(&Vector3::from(GRAVITY));
    let mut placed = entries.clone();
    for table in PLACED {
        let Some(Value::Table(own)) = placed.get_mut(table) else { continue };
        for entry in own.iter_mut().filter_map(|(_, entry)| entry.as_table_mut()) {
            entry.insert("in".to_owned(), Value::String("p".to_owned()));
        }
    }
    if let Some(Value::Table(points)) = placed.get_mut("points") {
        for point in points.iter_mut().map(|(_, point)| point) {
            let mut at = Table::new();
            at.insert("in".to_owned(), Value::String("p".to_owned()));
            at.insert("at".to_owned(), point.clone());
            *point = Value::Table(at);
        }
    }
    // `in` of an output has another meaning: its own points and axes are global ones here.
    if let Some(Value::Table(outputs)) = placed.get_mut("outputs") {
        outputs.retain(|_, output| {
            output
                .as_table()
                .is_some_and(|output| !output.contains_key("point") && !output.contains_key("axis"))
        });
    }
    run(&format!("{}{placed}\n{}points.o = [0, 0, 0]\n", header(gravity), part()), "", STEPS)
}

/// An output's values, transformed by hand.
fn transformed(kind: OutputKind, name: &str, values: &[f64]) -> Vec<f64> {
    let Motion { rotation, position } = pose();
    let turned =
        || values.chunks(3).flat_map(|own| rotation.apply(&Vector3::from_column_slice(own)).data.0[0]);
    match kind {
        // In moving axes already.
        OutputKind::Velocity if matches!(name, "seen" | "in_axes") => values.to_vec(),
        OutputKind::Reaction if matches!(name, "reaction_base" | "reaction_tip" | "reaction_guide") => {
            values.to_vec()
        }
        OutputKind::SpringForce if name.ends_with("_base") => values.to_vec(),
        OutputKind::Reaction if values.len() < 3 => values.to_vec(),
        OutputKind::Position | OutputKind::Line => values
            .chunks(3)
            .flat_map(|own| pose().transform_point(&Vector3::from_column_slice(own)).data.0[0])
            .collect(),
        OutputKind::Displacement
        | OutputKind::Rotation
        | OutputKind::Velocity
        | OutputKind::AngularVelocity
        | OutputKind::Acceleration
        | OutputKind::SpringForce
        | OutputKind::Reaction => turned().collect(),
        OutputKind::Momentum | OutputKind::LocalLoad => {
            let own: Vec<f64> = values[..6]
                .chunks(3)
                .flat_map(|own| rotation.apply(&Vector3::from_column_slice(own)).data.0[0])
                .collect();
            let (linear, angular) =
                (Vector3::from_column_slice(&own[..3]), Vector3::from_column_slice(&own[3..]));
            let about_origin = angular + position.cross(&linear);
            linear.iter().chain(about_origin.iter()).chain(&values[6..]).copied().collect()
        }
        OutputKind::Quaternion => {
            let own =
                Rotation::from_quaternion([values[0], values[1], values[2], values[3]]).expect("a rotation");
            let all = (rotation * own).quaternion();
            all.map(|part| part * all[0].signum()).to_vec()
        }
        OutputKind::CardanAngles => {
            let about = |axis: usize, angle: f64| Rotation::exponential(&(angle * Vector3::ith(axis, 1.0)));
            let own = about(0, values[0]) * about(1, values[1]) * about(2, values[2]);
            let all = (rotation * own).matrix();
            let cosine = all[(0, 0)].hypot(all[(0, 1)]);
            vec![
                (-all[(1, 2)]).atan2(all[(2, 2)]),
                all[(0, 2)].atan2(cosine),
                (-all[(0, 1)]).atan2(all[(0, 0)]),
            ]
        }
        OutputKind::Energy => vec![values[0], values[1]],
        OutputKind::ContactForce => {
            let force = rotation.apply(&Vector3::from_column_slice(&values[3..6]));
            let centre = pose().transform_point(&Vector3::from_column_slice(&values[9..12]));
            [&values[..3], force.as_slice(), &values[6..9], centre.as_slice()].concat()
        }
        OutputKind::SolidStress => {
            let [s11, s22, s33, s12, s13, s23] = std::array::from_fn(|k| values[k]);
            let own = Matrix3::new(s11, s12, s13, s12, s22, s23, s13, s23, s33);
            let all = rotation.matrix() * own * rotation.matrix().transpose();
            let components = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|entry| all[entry]);
            components.into_iter().chain([values[6], values[7]]).collect()
        }
        OutputKind::SectionForce
        | OutputKind::SectionMoment
        | OutputKind::ShellForce
        | OutputKind::ShellMoment
        | OutputKind::ShellStress
        | OutputKind::Relative
        | OutputKind::RelativeAcceleration
        | OutputKind::RelativeMotion
        | OutputKind::Contact
        | OutputKind::Spring
        | OutputKind::Tyre
        | OutputKind::Distance
        | OutputKind::Power
        | OutputKind::Work
        | OutputKind::Angle
        | OutputKind::Modal
        | OutputKind::Recovered
        | OutputKind::Signal
        | OutputKind::Expression => values.to_vec(),
    }
}

fn near(found: &[f64], wanted: &[f64], tolerance: f64, what: &str) {
    let size = wanted.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() <= tolerance * size, "{what}: {found} {wanted}, {:e}", found - wanted);
    }
}

fn agree(scene: &str, plain: &End, placed: &End) {
    let pose = pose();
    let flat = |rotation: &Rotation| rotation.matrix().as_slice().to_vec();
    assert_eq!(plain.frames.len(), placed.frames.len(), "{scene}");
    // Point masses and nodes of solids have no axes: they keep global ones.
    let names = &plain.lowered.names;
    let point_masses = plain.point_masses.iter().map(|name| names.nodes[name].index());
    let of_solids =
        names.meshes.solids.values().flat_map(|solid| solid.nodes.nodes.iter().map(|node| node.index()));
    let without_axes: BTreeSet<usize> = point_masses.chain(of_solids).collect();
    let size = 10.0;
    for node in 1..plain.frames.len() {
        let what = format!("{scene}, node {node}");
        let (own, found) = (&plain.frames[node], &placed.frames[node]);
        let wanted = pose * *own;
        near((found.position / size).as_slice(), (wanted.position / size).as_slice(), MOTIONS, &what);
        if !without_axes.contains(&node) {
            near(&flat(&found.rotation), &flat(&wanted.rotation), MOTIONS, &what);
        }
        for k in 0..2 {
            let wanted = pose.rotation.apply(&plain.velocities[node][k]);
            near(
                (placed.velocities[node][k] / size).as_slice(),
                (wanted / size).as_slice(),
                MOTIONS,
                &format!("{what}, velocity"),
            );
        }
    }
    for (k, (own, found)) in plain.coordinates.iter().zip(&placed.coordinates).enumerate() {
        near(found, own, MOTIONS, &format!("{scene}, coordinate {k}"));
    }
    for (name, kind, found) in &placed.outputs {
        let (.., own) = plain.outputs.iter().find(|(other, ..)| other == name).expect("the same output");
        near(found, &transformed(*kind, name, own), FORCES, &format!("{scene}, output {name}"));
    }
}

#[test]
fn a_model_in_a_part_is_the_model_transformed() {
    for (name, scene) in SCENES {
        let entries = entries(scene);
        let own = plain(&entries, STEPS).unwrap_or_else(|text| panic!("{name}: {text}"));
        let placed = in_part(&entries).unwrap_or_else(|text| panic!("{name}, in a part: {text}"));
        agree(&format!("{name}, in a part"), &own, &placed);
        let placed = by_in(&entries).unwrap_or_else(|text| panic!("{name}, by `in`: {text}"));
        agree(&format!("{name}, by `in`"), &own, &placed);
    }
}

/// The kind of an entry: its `kind` or `shape`.
fn kind_of(entry: &Table) -> &str {
    ["kind", "shape"].iter().find_map(|key| entry.get(*key)?.as_str()).unwrap_or_default()
}

/// Entries of a table of a scene, as far as they are tables.
fn tables_of<'t>(scene: &'t Table, table: &str) -> Vec<(&'t String, &'t Table)> {
    let own = scene.get(table).and_then(Value::as_table);
    own.into_iter().flatten().filter_map(|(name, entry)| Some((name, entry.as_table()?))).collect()
}

/// Every innermost list of three, in another order: directions and positions become others, frames stay frames.
fn permuted(value: &Value) -> Value {
    match value {
        Value::Array(list) if list.len() == 3 && !list.iter().any(|own| own.is_array() || own.is_table()) => {
            Value::Array(vec![list[2].clone(), list[0].clone(), list[1].clone()])
        }
        Value::Array(list) => Value::Array(list.iter().map(permuted).collect()),
        Value::Table(table) => {
            Value::Table(table.iter().map(|(key, own)| (key.clone(), permuted(own))).collect())
        }
        other => other.clone(),
    }
}

/// What kinds of joints, springs and loads are attached to, and their own parameters.
fn registered(table: &str, kind: &str) -> Option<KindEntry> {
    let registry = registry();
    let kinds = match table {
        "joints" => registry.joints,
        "springs" => registry.springs,
        "loads" => registry.loads,
        _ => return None,
    };
    kinds.into_iter().find(|own| own.name == kind)
}

fn differ(one: &End, other: &End) -> bool {
    let far = |a: f64, b: f64| (a - b).abs() > 1e-9 * (1.0 + a.abs());
    let moved = one.frames.iter().zip(&other.frames).any(|(a, b)| {
        (a.position - b.position).norm() > 1e-9 || (a.rotation.matrix() - b.rotation.matrix()).norm() > 1e-9
    });
    let values =
        |end: &End| -> Vec<f64> { end.outputs.iter().flat_map(|(.., values)| values.clone()).collect() };
    moved || values(one).iter().zip(values(other)).any(|(&a, b)| far(a, b))
}

/// All kinds are in a scene, with every key that is expressed in model axes, and each key matters there.
#[test]
fn scenes_cover_every_key_that_is_expressed_in_model_axes() {
    let scenes: Vec<Table> = SCENES.iter().map(|(_, scene)| entries(scene)).collect();
    let ends: Vec<End> = scenes.iter().map(|scene| plain(scene, 1).expect("a scene")).collect();
    let mut checked = BTreeSet::new();
    for EntryAxes { table, kind, keys } in model_axes(&registry()) {
        let own = registered(table, kind);
        let must_be_there = own.is_some() || table == "outputs" || !keys.is_empty();
        let is_there = scenes.iter().any(|scene| match kind {
            "" => scene.contains_key(table),
            _ => tables_of(scene, table).iter().any(|(_, entry)| kind_of(entry) == kind),
        });
        assert!(is_there || !must_be_there, "add an entry of [{table}] of the kind `{kind}` to a scene");
        for key in keys {
            // Where joints lie on tips that are placed approximately needs [assembly]: see the test below.
            // A moment is the same at every location.
            let is_moment = own.is_some_and(|own| own.ports == Ports::ONE_FRAME);
            if key.is_empty()
                || (is_moment && key == "at")
                || key.ends_with("_at_tip")
                || (table == "joints"
                    && key == "at_tip"
                    && own.is_some_and(|own| own.ports.have_one_location()))
            {
                continue;
            }
            let is_common =
                own.is_some_and(|own| own.parameters.iter().all(|parameter| parameter.name != key));
            if is_common && !checked.insert(format!("{table}, {key}, {:?}", own.map(|own| own.ports))) {
                continue;
            }
            // Keys that an attachment brings are read in one place for all kinds that have it.
            let alike = |other: &str| match own {
                Some(own) if is_common => {
                    registered(table, other).is_some_and(|other| other.ports == own.ports)
                }
                _ => other == kind,
            };
            let mut found = false;
            let matters = scenes.iter().zip(&ends).any(|(scene, end)| {
                tables_of(scene, table).into_iter().any(|(name, entry)| {
                    let Some(value) = entry.get(key).filter(|_| alike(kind_of(entry))) else { return false };
                    found = true;
                    let mut other = scene.clone();
                    other[table][name]
                        .as_table_mut()
                        .expect("an entry")
                        .insert(key.to_owned(), permuted(value));
                    plain(&other, 1).map_or(permuted(value) != *value, |other| differ(end, &other))
                })
            });
            assert!(found, "give `{key}` to an entry of [{table}] of the kind `{kind}` in a scene");
            assert!(
                matters,
                "`{key}` of [{table}] of the kind `{kind}` changes nothing in its scene: give another value"
            );
        }
    }
}

/// Where joints lie on tips that are placed approximately, in a part and by `in`.
#[test]
fn positions_on_tips_are_transformed_once() {
    let bodies = "[bodies.own]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0.1, 0.2, 0.3]\n";
    let joint = "kind = \"universal\"\nbase = \"ground\"\ntip = \"own\"\nat = [0.3, 0.1, 0]\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]\n\
                 at_tip = [0.3, 0.12, 0.01]\naxis_at_tip = [1, 0.1, 0.2]\nsecond_axis_at_tip = [0, 1, 0.1]\n";
    let ending = "[assembly]\n";
    let in_part = format!("{}{}include = \"part.toml\"\n{ending}", header(Vector3::zeros()), part());
    let by_in = format!(
        "{}{}points.o = [0, 0, 0]\n{bodies}in = \"p\"\n[joints.j]\nin = \"p\"\n{joint}{ending}",
        header(Vector3::zeros()),
        part()
    );
    let part = format!("{bodies}[joints.j]\n{joint}");
    for text in [in_part, by_in] {
        let library = Library::of_texts([("part.toml".to_owned(), part.clone())]);
        let document = ModelText::read_with(&text, "model.toml", &[], Arc::new(library))
            .and_then(|text| text.document(&registry(), &[]))
            .unwrap_or_else(|report| panic!("{}", report.render(false)));
        let on_tip = document.joints[0].on_tip.as_ref().expect("given").value;
        let turned = |own: [f64; 3]| pose().rotation.apply(&Vector3::from(own));
        let at = pose().transform_point(&Vector3::new(0.3, 0.12, 0.01));
        for (found, wanted) in [
            (Some(on_tip.at), at),
            (on_tip.axis, turned([1.0, 0.1, 0.2])),
            (on_tip.second_axis, turned([0.0, 1.0, 0.1])),
        ] {
            assert!((found.expect("given") - wanted).norm() < MOTIONS, "{found:?} {wanted}");
        }
    }
}

/// Descriptions say which axes are meant, and types must agree.
#[test]
fn descriptions_of_parameters_agree_with_their_axes() {
    let registry = registry();
    for kind in registry.joints.iter().chain(&registry.springs).chain(&registry.loads) {
        for parameter in kind.parameters {
            let says_global = parameter.summary.contains("global axes");
            let what = format!("{}.{}", kind.name, parameter.name);
            if parameter.holds == ParameterType::Vector || parameter.holds.is_in_model_axes() {
                assert_eq!(says_global, parameter.holds.is_in_model_axes(), "{what}");
            }
        }
    }
}
