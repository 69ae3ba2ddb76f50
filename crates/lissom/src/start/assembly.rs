//! Corrects approximate positions of parts until all joints close, and reports the displacements.

use lissom_core::assembly::{AssemblyError, Gap, Request, assemble};
use lissom_core::kinematics::{CoordinateId, Kinematics, NodeId, Quantity};
use lissom_core::system::System;
use lissom_motion::Motion;

use lissom_model::Problem;
use lissom_model::document::{AssemblyRequest, Document};
use lissom_model::lower::Names;

/// Displacements below this fraction of the model's size, and turns below this angle [rad], are round-off.
const NOTHING: f64 = 1e-12;

/// A part that an assembly has moved.
#[derive(Clone, Debug, PartialEq)]
pub struct MovedPart {
    /// Name of the body, point mass or beam.
    pub part: String,
    /// Displacement of its reference point, of a beam that of the node that moved most [m].
    pub distance: f64,
    /// Rotation of the part [rad].
    pub turn: f64,
}

/// A coordinate that an assembly has brought to a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Brought {
    /// Name of the coordinate, such as `crank.angle`.
    pub coordinate: String,
    /// Value of the coordinate [rad, m].
    pub value: f64,
    /// Unit of the coordinate.
    pub unit: &'static str,
}

/// Result of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// The gaps as drawn, the widest first.
    pub closed: Vec<Gap>,
    /// The parts that were moved, the farthest first.
    pub moved: Vec<MovedPart>,
    /// The coordinates that were brought to values.
    pub brought: Vec<Brought>,
    /// The largest violation that is left [m, rad].
    pub left: f64,
    /// Whether no smaller change closes the joints nearby; not looked for where coordinates were brought to values.
    pub is_least: bool,
    /// Frames of all nodes as drawn.
    pub(crate) drawn: Vec<Motion>,
}

/// Most parts that are reported in words.
const MAX_REPORTED: usize = 4;

impl Assembly {
    /// One sentence for a person.
    pub fn words(&self) -> String {
        let some = |all: Vec<String>| {
            let more = all.len().saturating_sub(MAX_REPORTED);
            let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
            all.into_iter().take(MAX_REPORTED).collect::<Vec<_>>().join(", ") + &rest
        };
        if self.moved.is_empty() {
            return "all joints close as drawn, nothing moved".to_owned();
        }
        let moved = |part: &MovedPart| {
            let MovedPart { part, distance, turn } = part;
            let (distance, turn) =
                (lissom_core::number::Written(*distance), lissom_core::number::Written(*turn));
            if *turn > NOTHING {
                format!("`{part}` by {distance:.3e} m and {turn:.3e} rad")
            } else {
                format!("`{part}` by {distance:.3e} m")
            }
        };
        let mut words = format!("moved {}", some(self.moved.iter().map(moved).collect()));
        if !self.closed.is_empty() {
            words += "; closed ";
            words += &some(self.closed.iter().map(Gap::to_string).collect());
        }
        if !self.brought.is_empty() {
            let value = |own: &Brought| format!("{} = {} {}", own.coordinate, own.value, own.unit);
            words += "; brought ";
            words += &some(self.brought.iter().map(value).collect());
        }
        words
    }
}

/// Nodes of a part.
fn nodes_of<'a>(names: &'a Names, part: &str) -> &'a [NodeId] {
    let node = names.nodes.get(part).map(std::slice::from_ref);
    let nodes = node.or(names.lines.get(part).map(|line| line.nodes.as_slice()));
    let nodes = nodes.or(names.superelements.get(part).map(Vec::as_slice));
    nodes.or(names.meshes.nodes_of(part).map(|own| own.nodes.as_slice())).unwrap_or_default()
}

/// Nodes that are to stay where they are.
pub(super) fn fixed_nodes(asked: &AssemblyRequest, names: &Names) -> Vec<NodeId> {
    asked.fixed.iter().flat_map(|(part, _)| nodes_of(names, part)).copied().collect()
}

/// An assembly of a model with these nodes fixed, and these values of coordinates.
pub(super) fn request<'a>(
    names: &'a Names,
    fixed: &[NodeId],
    values: &[(CoordinateId, f64)],
    tolerance: f64,
) -> Request<'a> {
    Request {
        rigid: (names.lines.values().map(|line| line.nodes.as_slice()))
            .chain(names.superelements.values().map(Vec::as_slice))
            .chain(names.meshes.all().map(|(_, own)| own.nodes.as_slice()))
            .collect(),
        fixed: fixed.to_vec(),
        values: values.to_vec(),
        tolerance,
    }
}

/// Assembles the model.
pub(super) fn assembled(
    document: &Document,
    asked: &AssemblyRequest,
    (system, names): (&System, &Names),
    values: &[(CoordinateId, f64)],
    at: &mut Kinematics,
) -> Result<Assembly, Problem> {
    let fixed = fixed_nodes(asked, names);
    let request = request(names, &fixed, values, asked.tolerance);
    let before = at.clone();
    let found = assemble(system, at, &request).map_err(|error| problem(document, asked, &error))?;
    let parts = (document.bodies.iter().map(|body| &body.name.value))
        .chain(document.point_masses.iter().map(|mass| &mass.name.value))
        .chain(document.beams.iter().map(|beam| &beam.name.value))
        .chain(document.meshes().map(|(name, _)| &name.value))
        .chain(document.superelements.iter().map(|element| &element.name.value));
    let size = before.nodes.iter().map(|node| node.frame.position.norm()).fold(0.0, f64::max);
    let moved = parts.filter_map(|part| {
        let of_nodes = nodes_of(names, part).iter().map(|node| found.moved[node.index()]);
        let (distance, turn) =
            of_nodes.fold((0.0, 0.0), |most: (f64, f64), own| (most.0.max(own.0), most.1.max(own.1)));
        let is_moved = distance > NOTHING * size || turn > NOTHING;
        is_moved.then(|| MovedPart { part: part.clone(), distance, turn })
    });
    let mut moved: Vec<MovedPart> = moved.collect();
    moved.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    let layout = system.layout();
    let changed =
        |&coordinate: &CoordinateId| at.coordinates[coordinate].value != before.coordinates[coordinate].value;
    let driven = system.drives().iter().map(|drive| drive.prescribed.coordinate);
    let mut held: Vec<CoordinateId> =
        values.iter().map(|&(coordinate, _)| coordinate).chain(driven).collect();
    held.sort_unstable();
    held.dedup();
    let brought = held.into_iter().filter(changed).map(|coordinate| Brought {
        coordinate: layout.coordinate_name(coordinate).to_owned(),
        value: at.coordinates[coordinate].value,
        unit: if layout.coordinate_quantity(coordinate) == Quantity::Angle { "rad" } else { "m" },
    });
    Ok(Assembly {
        closed: found.gaps,
        moved,
        brought: brought.collect(),
        left: found.left,
        is_least: found.is_least,
        drawn: before.nodes.iter().map(|node| node.frame).collect(),
    })
}

/// The complaint, at the joint that is open widest.
fn problem(document: &Document, asked: &AssemblyRequest, error: &AssemblyError) -> Problem {
    let joint = match error {
        AssemblyError::Open { gaps } => gaps.first().map(|gap| gap.joint.as_str()),
        AssemblyError::UpsideDown { joint } => Some(joint.as_str()),
        _ => None,
    };
    let component = document.joints.iter().find(|component| Some(component.name.value.as_str()) == joint);
    let span = component.map_or(asked.span, |component| component.name.span);
    let help = match error {
        AssemblyError::UpsideDown { .. } => {
            "place the parts closer to their final positions, or reverse the axis on base or tip"
        }
        _ => {
            "no positions close to the specified ones close them: check the lengths between these joints, their positions and \
             initial values, and `fixed`; or place the parts closer to their final positions"
        }
    };
    Problem::error(span, format!("the model cannot be assembled: {error}")).label("stays open").help(help)
}
