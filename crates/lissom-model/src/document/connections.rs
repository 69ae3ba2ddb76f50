//! Checks across tables: positions of nodes, connectivity, and functions that fail during the analysis.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use lissom_motion::Vector3;

use super::entries::PARTS;
use super::plausibility;
use super::{
    AnalysisKind, Attachment, Beam, Body, Component, CoordinateName, Document, NodeLocation, NodeReference,
    OutputKind, OutputSource, PointMass, Subject, Superelement, interface_name,
};
use crate::line::Line;
use crate::parts::context::Context;
use crate::reading::mesh_nodes::{nodes_of, position_of};
use crate::text::report::{Located, Problem, Span};
use lissom_mesh::MeshedPart;

/// Where the nodes of the parts are.
pub(super) struct Places {
    points: BTreeMap<String, Vector3>,
    lines: BTreeMap<String, Line>,
    meshes: BTreeMap<String, Arc<MeshedPart>>,
}

pub(super) fn places(
    (beams, superelements): (&[Beam], &[Superelement]),
    meshes: BTreeMap<String, Arc<MeshedPart>>,
    bodies: &[Body],
    point_masses: &[PointMass],
) -> Places {
    let lines = beams.iter().map(|beam| (beam.name.value.clone(), beam.line.clone())).collect();
    let bodies = bodies.iter().map(|body| (body.name.value.clone(), body.position));
    let masses = point_masses.iter().map(|mass| (mass.name.value.clone(), mass.position));
    let interfaces = superelements.iter().flat_map(|element| {
        let place = |name: &str| Some((interface_name(&element.name.value, name), element.place_of(name)?));
        element.interfaces.iter().filter_map(move |interface| place(&interface.name))
    });
    Places { points: bodies.chain(masses).chain(interfaces).collect(), lines, meshes }
}

impl Places {
    /// Positions of all nodes but those of beams.
    pub(super) fn all(&self) -> impl Iterator<Item = Vector3> + '_ {
        let of_meshes = self.meshes.values().flat_map(|mesh| mesh.positions.iter().copied());
        self.points.values().copied().chain(of_meshes)
    }

    /// The position of a node, or a report of why it has none.
    pub(super) fn required(&self, context: &Context<'_>, node: &Located<NodeReference>) -> Option<Vector3> {
        if let NodeReference::Mesh { part, .. } = &node.value
            && let Err(problem) = nodes_of(self.meshes.get(part)?, node)
        {
            context.report(problem);
            return None;
        }
        self.of(&node.value)
    }

    /// Position of a node; the origin for the ground.
    pub(super) fn of(&self, node: &NodeReference) -> Option<Vector3> {
        match node {
            NodeReference::Ground => Some(Vector3::zeros()),
            NodeReference::Body(name) | NodeReference::PointMass(name) => self.points.get(name).copied(),
            NodeReference::Beam { beam, fraction } => {
                self.lines.get(beam).map(|line| line.position(*fraction))
            }
            NodeReference::Mesh { part, place } => position_of(self.meshes.get(part)?, place),
            NodeReference::Interface { superelement, interface } => {
                self.points.get(&interface_name(superelement, interface)).copied()
            }
        }
    }
}

/// Checks that require the whole model.
pub(super) fn check(context: &Context<'_>, document: &Document, places: &Places) {
    plausibility::check(context, document, places);
    free_parts(context, document);
    functions(context, document);
    unused(context, document);
    complete(context, document);
    at_rest(context, document);
    under_sliders(context, document);
    drums(context, document);
    gears(context, document);
    short_delays(context, document);
}

/// The tension of a rope acts on the drum as a moment, and on the part that has the end of the rope as a force.
fn drums(context: &Context<'_>, document: &Document) {
    for output in document.outputs.iter().filter(|output| output.kind == OutputKind::Reaction) {
        let OutputSource::Joint(joint) = &output.source else { continue };
        let winds = |spring: &&Component| {
            let Attachment { nodes, coordinates, .. } = &spring.attachment;
            // The tension acts on drums with a radius themselves.
            let is_turned = |own: &&NodeLocation| own.sheave.is_some_and(|own| own.turns.is_some());
            let with_radius = nodes.iter().filter(is_turned).count();
            let mut paying_out = coordinates.iter().skip(with_radius);
            !nodes.is_empty() && paying_out.any(|(drum, _)| drum.value == joint.value)
        };
        for rope in document.springs.iter().filter(winds) {
            let message = format!(
                "the reaction of `{0}` lacks the tension of `{1}`: the rope turns the drum, and pulls at the part on which its end is",
                joint.value, rope.name.value
            );
            let problem = Problem::warning(joint.span, message).also(rope.name.span, "the rope");
            context.report(
                problem
                    .help("add the tension, component `force` of an output of kind `spring`, in the direction of the rope"),
            );
        }
    }
}

/// Angles of wheels whose bearings turn against each other are relative to different parts: their teeth relate three angles.
fn gears(context: &Context<'_>, document: &Document) {
    let mut housings = Groups::default();
    let locks = |joint: &&Component| {
        let locked = joint.parameters.words("locked").unwrap_or_default();
        matches!(joint.kind.value.as_str(), "clamp" | "rigid_link" | "prismatic")
            || ["rx", "ry", "rz"].iter().all(|word| locked.iter().any(|own| own == word))
    };
    for joint in document.joints.iter().filter(locks) {
        if let [base, tip] = joint.attachment.nodes.as_slice() {
            housings.join(part_of(&base.node.value), part_of(&tip.node.value));
        }
    }
    for gear in document.joints.iter().filter(|joint| joint.kind.value == "gear") {
        let parts = |(name, _): &CoordinateName| {
            let joint = document.joints.iter().find(|joint| joint.name.value == name.value)?;
            let [base, tip] = joint.attachment.nodes.as_slice() else { return None };
            Some([base, tip].map(|own| part_of(&own.node.value)))
        };
        let [first, second] = gear.attachment.coordinates.as_slice() else { continue };
        let (Some(one), Some(other)) = (parts(first), parts(second)) else { continue };
        let [base, tip, other_base, other_tip] =
            [one[0], one[1], other[0], other[1]].map(|part| housings.root(part));
        let is_chain = base == other_tip || other_base == tip;
        if base != other_base && !is_chain && !gear.parameters.flag("relative").unwrap_or(true) {
            let message = format!(
                "gear `{}` relates angles relative to different parts, `{}` and `{}`, which may turn against each other",
                gear.name.value, one[0], other[0]
            );
            let help = "relate the angles of both wheels relative to one housing by an `equation`, or specify `relative = true` \
                        if this is meant";
            context.report(Problem::warning(gear.name.span, message).help(help));
        }
    }
}

/// Steps of a delay that count as too many.
const MAX_STEPS_OF_DELAY: f64 = 1e7;

/// Rejects delays that are far shorter than the analysis: a step is at most as long as a delay.
fn short_delays(context: &Context<'_>, document: &Document) {
    let duration = document.analysis.end - document.analysis.start;
    for delay in document.signals.iter().filter_map(|signal| signal.delay) {
        let steps = duration / delay.time.value;
        if steps > MAX_STEPS_OF_DELAY {
            let message = format!(
                "a delay of {:e} s requires {steps:.0e} steps, because a step is at most as long as a delay",
                delay.time.value
            );
            context.fail::<()>(
                delay.time.span,
                message,
                "remove the delay, which has no effect on longer motions",
            );
        }
    }
}

/// The force of a slider acts on the six nodes around it. Within the elements of these nodes the shear force errs by up to 0.6 of the
/// slider's force, and the moment by a fraction of force times element length that depends on `order`; farther away both are
/// correct.
fn under_sliders(context: &Context<'_>, document: &Document) {
    for output in &document.outputs {
        let OutputSource::Node { node, .. } = &output.source else { continue };
        let NodeReference::Beam { beam: name, .. } = &node.value else { continue };
        let is_of_section = output.kind.subject() == Subject::Section;
        let slides_along = |joint: &&Component| joint.attachment.beams.iter().any(|beam| beam.value == *name);
        let slider = document.joints.iter().find(slides_along);
        let (Some(slider), Some(beam)) = (slider.filter(|_| is_of_section), document.beam(name)) else {
            continue;
        };
        let (reach, share) = match beam.order {
            1 => ("three", 30),
            2 => ("two", 13),
            _ => ("two", 7),
        };
        let message = format!(
            "the force of slider `{}` acts on the nodes of `{name}` around it: up to {reach} elements from it the shear force \
             errs by up to 60 % of its force, the moment by up to {share} % of its force times the length of an element",
            slider.name.value
        );
        let problem = Problem::warning(node.span, message).also(slider.name.span, "the slider");
        context.report(problem.help("evaluate them farther away, or use more elements"));
    }
}

/// Rejects states, delayed and sampled signals in statics, and loads of the local motion where loads are scaled by a factor.
fn at_rest(context: &Context<'_>, document: &Document) {
    if let Some(load) = document.local_loads.first()
        && matches!(document.analysis.kind, AnalysisKind::Path { .. } | AnalysisKind::Buckling { .. })
    {
        let message = format!("the local load `{}` cannot grow with a load factor", load.name.value);
        context.fail::<()>(load.name.span, message, "use an analysis of kind `statics` or `dynamics`");
    }
    let statics = matches!(document.analysis.kind, AnalysisKind::Statics { .. });
    let moves = matches!(document.analysis.kind, AnalysisKind::Dynamics { .. });
    if let Some(unit) = document.units.first().filter(|_| !moves || document.starts_in_equilibrium()) {
        let what = if moves { "a start from equilibrium" } else { document.analysis.kind.name() };
        let message =
            format!("{what} has no sampling times, so the unit `{}` has no outputs", unit.name.value);
        context.fail::<()>(unit.name.span, message, "remove it, or use an analysis of kind `dynamics`");
    }
    let hydraulic = context.names("hydraulics").first().copied();
    let what = match document.analysis.kind {
        AnalysisKind::Statics { .. } => "statics",
        AnalysisKind::Path { .. } => "an equilibrium path",
        _ if document.starts_in_equilibrium() => "a start from equilibrium",
        _ => return,
    };
    for (signal, delay) in document.signals.iter().filter_map(|signal| Some((signal, signal.delay?))) {
        let message =
            format!("{what} has no past, so the delayed signal `{}` has no value", signal.name.value);
        let help = "remove `delay`, or use an analysis of kind `dynamics`";
        context.fail::<()>(delay.time.span, message, help);
    }
    if !statics && !document.starts_in_equilibrium() {
        return;
    }
    if let Some((part, span)) = hydraulic {
        let message = format!("{what} has no flow rates, so the hydraulic part `{part}` has no pressures");
        context.fail::<()>(span, message, "remove [hydraulics], or use an analysis of kind `dynamics`");
    }
    for state in &document.states {
        let message = format!("{what} has no rates, so the state `{}` is undefined", state.name.value);
        context.fail::<()>(state.name.span, message, "remove it, or use an analysis of kind `dynamics`");
    }
    for signal in document.signals.iter().filter(|signal| signal.sampling.is_some()) {
        let message =
            format!("{what} has no sampling times, so the signal `{}` has no value", signal.name.value);
        context.fail::<()>(
            signal.name.span,
            message,
            "remove `sample`, or use an analysis of kind `dynamics`",
        );
    }
}

/// A part that is omitted without a message would change the model, so it is always reported.
fn complete(context: &Context<'_>, document: &Document) {
    let read = [
        ("materials", document.materials.len()),
        ("sections", document.sections.len()),
        ("points", document.points.len()),
        ("beams", document.beams.len()),
        ("shells", document.shells.len()),
        ("solids", document.elastic_solids.len()),
        ("bodies", document.bodies.len()),
        ("point_masses", document.point_masses.len()),
        ("superelements", document.superelements.len()),
        ("joints", document.joints.len()),
        ("springs", document.springs.len()),
        ("loads", document.loads.len()),
        ("local_loads", document.local_loads.len()),
        ("contacts", document.contacts.len()),
        ("outputs", document.outputs.len()),
        ("inputs", document.inputs.len()),
        ("signals", document.signals.len()),
        ("states", document.states.len()),
        ("events", document.events.len()),
        ("units", document.units.len()),
    ];
    for (table, count) in read {
        let names = context.names(table);
        if let Some((_, span)) = names.first().filter(|_| names.len() != count) {
            unread(context, &format!("an entry of [{table}]"), *span);
        }
    }
}

/// Reports what could not be read without any other error.
pub(super) fn unread(context: &Context<'_>, what: &str, span: Span) {
    if !context.has_errors() {
        let message = format!("{what} could not be read");
        context.fail::<()>(span, message, "please report this: the mistake in it is not recognised");
    }
}

/// Groups of connected parts; the ground is a part.
#[derive(Default)]
struct Groups<'d> {
    numbers: HashMap<&'d str, usize>,
    parents: Vec<usize>,
}

impl<'d> Groups<'d> {
    fn number(&mut self, part: &'d str) -> usize {
        let next = self.parents.len();
        let number = *self.numbers.entry(part).or_insert(next);
        if number == next {
            self.parents.push(next);
        }
        number
    }

    /// Number that represents a part's group. Halves the path to it for later queries.
    fn root(&mut self, part: &'d str) -> usize {
        let mut number = self.number(part);
        while self.parents[number] != number {
            self.parents[number] = self.parents[self.parents[number]];
            number = self.parents[number];
        }
        number
    }

    fn join(&mut self, a: &'d str, b: &'d str) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a] = b;
    }
}

const GROUND: &str = "ground";

pub(super) fn part_of(node: &NodeReference) -> &str {
    match node {
        NodeReference::Ground => GROUND,
        NodeReference::Body(name) | NodeReference::PointMass(name) => name,
        NodeReference::Beam { beam, .. } => beam,
        NodeReference::Mesh { part, .. } => part,
        NodeReference::Interface { superelement, .. } => superelement,
    }
}

impl Document {
    /// Parts that nothing connects to the ground.
    fn free_parts(&self) -> Vec<&Located<String>> {
        let mut groups = groups(self);
        let ground = groups.root(GROUND);
        self.parts().into_iter().filter(|part| groups.root(&part.value) != ground).collect()
    }

    /// A part that nothing connects to the ground, and what accelerates such parts, in words.
    pub fn accelerated_part(&self) -> Option<(&str, String)> {
        let free: BTreeSet<&str> = self.free_parts().iter().map(|part| part.value.as_str()).collect();
        let load = self.loads.iter().find_map(|load| {
            let mut parts = load.attachment.nodes.iter().map(|own| part_of(&own.node.value));
            Some((*parts.find_map(|part| free.get(part))?, &load.name.value))
        });
        if let Some((part, load)) = load {
            return Some((part, format!("`{load}`")));
        }
        if self.gravity.norm() > 0.0 {
            return free.first().map(|part| (*part, "gravity".to_owned()));
        }
        let beams = self.beams.iter().filter(|own| !own.distributed.is_empty()).map(|own| &own.name);
        let shells = self.shells.iter().filter(|own| !own.loads.is_empty()).map(|own| &own.name);
        let solids = self.elastic_solids.iter().filter(|own| !own.pressures.is_empty()).map(|own| &own.name);
        let mut spread = beams.chain(shells).chain(solids).filter(|name| free.contains(name.value.as_str()));
        spread.next().map(|name| (name.value.as_str(), "its distributed loads".to_owned()))
    }

    fn parts(&self) -> Vec<&Located<String>> {
        (self.beams.iter().map(|beam| &beam.name))
            .chain(self.meshes().map(|(name, _)| name))
            .chain(self.bodies.iter().map(|body| &body.name))
            .chain(self.point_masses.iter().map(|mass| &mass.name))
            .chain(self.superelements.iter().map(|element| &element.name))
            .collect()
    }
}

/// Parts that joints, springs, contacts and loads between them connect.
fn groups(document: &Document) -> Groups<'_> {
    let mut groups = Groups::default();
    for component in document.joints.iter().chain(&document.springs).chain(&document.loads) {
        let Attachment { nodes, beams, .. } = &component.attachment;
        for pair in nodes.windows(2) {
            groups.join(part_of(&pair[0].node.value), part_of(&pair[1].node.value));
        }
        for (beam, own) in beams.iter().zip(nodes.iter().cycle()) {
            groups.join(&beam.value, part_of(&own.node.value));
        }
    }
    for contact in &document.contacts {
        for [base, tip] in contact.pairs() {
            groups.join(part_of(&base.value), part_of(&tip.value));
        }
    }
    for beam in &document.beams {
        for shared in beam.shared_start.iter().chain(&beam.shared_end) {
            groups.join(&beam.name.value, part_of(&shared.value));
        }
    }
    groups
}

/// A part without any connection moves freely: possible in dynamics, but seldom meant; singular in statics.
fn free_parts(context: &Context<'_>, document: &Document) {
    let mut groups = groups(document);
    let parts = document.parts();
    let statics = matches!(
        document.analysis.kind,
        AnalysisKind::Statics { .. } | AnalysisKind::Path { .. } | AnalysisKind::Buckling { .. }
    ) || document.starts_in_equilibrium();
    let named: usize = PARTS.iter().map(|table| context.names(table).len()).sum();
    let read = |table, read: &[Component]| context.names(table).len() == read.len();
    // With a part or joint that could not be read, connections are missing that were meant.
    if parts.len() != named
        || !read("joints", &document.joints)
        || !read("springs", &document.springs)
        || !read("loads", &document.loads)
    {
        return;
    }
    let mut sizes: HashMap<usize, usize> = HashMap::new();
    for part in &parts {
        *sizes.entry(groups.root(&part.value)).or_default() += 1;
    }
    let ground = groups.root(GROUND);
    for part in &parts {
        let root = groups.root(&part.value);
        let free = root != ground;
        if free && statics {
            let message = format!("`{}` is not connected to the ground: it has no equilibrium", part.value);
            let help = "add a joint or spring that connects it to \"ground\"; a clamp of one node carries only what the loads on it lack in balance; `lissom reduce` and `modes` take parts that are free with `--unset analysis --set analysis.kind=modes`";
            context.fail::<()>(part.span, message, help);
        } else if free && sizes.get(&root) == Some(&1) && parts.len() > 1 {
            let problem =
                Problem::warning(part.span, format!("`{}` is not connected to anything", part.value));
            context.report(
                problem.label("moves freely").help("add a joint, or ignore this if it is meant to fly"),
            );
        }
    }
}

/// Tries every function of time during the analysis.
fn functions(context: &Context<'_>, document: &Document) {
    let (start, end) = (document.analysis.start, document.analysis.end);
    for (function, span, what) in context.functions.borrow().iter() {
        let times = (0..=64).map(|i| start + (end - start) * f64::from(i) / 64.0);
        if let Some(time) = times.into_iter().find(|time| !function.value(*time).is_finite()) {
            let message = format!("{what} is not a finite number at t = {time}");
            context.fail::<()>(*span, message, format!("the analysis runs from {start} to {end} s"));
        }
    }
}

/// Sections that no beam has are probably slips.
fn unused(context: &Context<'_>, document: &Document) {
    if document.beams.len() != context.names("beams").len() {
        return;
    }
    let stations = document.beams.iter().flat_map(|beam| &beam.stations);
    let used: BTreeSet<&str> = stations.map(|station| station.section.value.as_str()).collect();
    for name in document.sections.iter().map(|section| &section.name) {
        if !used.contains(name.value.as_str()) {
            let problem = Problem::warning(name.span, format!("no beam has the section `{}`", name.value));
            context.report(problem.label("not used").help("name it in a beam, or remove it"));
        }
    }
}
