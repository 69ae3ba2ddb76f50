//! Frames of scopes and bodies, and positions of points, each computed when it is first requested.

use lissom_motion::{Matrix3, Motion, Rotation, Vector3};

use super::Placement;
use super::found_frames::{Finding, Wanted};
use crate::line::are_parallel;
use crate::parts::context::Context;
use crate::text::ScopeId;
use crate::text::report::{Problem, Span};
use crate::text::{Node, Value};

impl Context<'_> {
    /// The frame in which positions of `scope` are given.
    pub(crate) fn frame(&self, scope: ScopeId) -> Option<Motion> {
        let own = &self.scopes[scope];
        let Some(parent) = own.parent else { return Some(Motion::IDENTITY) };
        if own.placements.is_empty() {
            return self.frame(parent);
        }
        self.once(Wanted::Scope(scope), own.place, || {
            let mut frame = None;
            for placement in &own.placements {
                frame = Some(self.placed(placement, parent, frame)?);
            }
            frame
        })
    }

    /// The frame of a placement in the scope `parent`; where there is a `former` one, that is turned and shifted.
    fn placed(&self, placement: &Placement, parent: ScopeId, former: Option<Motion>) -> Option<Motion> {
        let base = match &placement.part {
            None => self.frame(parent)?,
            Some(part) => self.frame_named(part)?,
        };
        let position = match &placement.position {
            None => Vector3::zeros(),
            Some(node) => match &node.value {
                Value::Text(_) => base.inverse_transform_point(&self.place(node, "`position`")?.value),
                _ => self.vector(node, "`position`")?,
            },
        };
        let rotation = match &placement.rotation {
            None => Rotation::IDENTITY,
            Some(node) => Rotation::exponential(&self.vector(node, "`rotation`")?),
        };
        let own = Motion::new(rotation, position);
        Some(match former {
            None => base * own,
            Some(former) => base * own * (base.inverse() * former),
        })
    }

    /// The frame of the body, point mass or part that `node` names.
    fn frame_named(&self, node: &Node) -> Option<Motion> {
        let what = "`in`";
        let Value::Text(text) = &node.value else {
            return self.wrong_type(node, what, "the name of a body or a part");
        };
        let text = self.written(text, (node.span, node.scope), what)?;
        let exists = |full: &str| {
            full == "ground"
                || self.instances.contains_key(full)
                || ["bodies", "point_masses"].iter().any(|table| self.has(table, full))
        };
        match self.resolve(&text, node.scope, &exists) {
            Some(full) if full == "ground" => Some(Motion::IDENTITY),
            Some(full) => match self.instances.get(&full) {
                Some(&scope) => self.frame(scope),
                None => self.body_frame(&full, node.span),
            },
            None => {
                let bodies = ["bodies", "point_masses"]
                    .iter()
                    .flat_map(|table| self.names(table))
                    .map(|(name, _)| name);
                let known = bodies.chain(self.instances.keys().map(String::as_str));
                let problem =
                    Problem::error(node.span, format!("{what} names `{text}`, which is no body and no part"));
                let help = crate::format::suggest::help(&text, known);
                self.report(
                    problem
                        .label("no such frame")
                        .help("name a body, a point mass or an entry of [parts]")
                        .maybe_help(help),
                );
                None
            }
        }
    }

    /// The frame of a body or point mass.
    fn body_frame(&self, name: &str, asked: Span) -> Option<Motion> {
        self.once(Wanted::Body(name.to_owned()), asked, || {
            let (node, is_body) = match self.entry("bodies", name) {
                Some(node) => (node, true),
                None => (self.entry("point_masses", name)?, false),
            };
            let table = node.table()?;
            let frame = self.frame(node.scope)?;
            let position = match table.get("position") {
                None => frame.position,
                Some(entry) => self.place(&entry.node, &format!("`position` of `{name}`"))?.value,
            };
            if !is_body {
                return Some(Motion::new(frame.rotation, position));
            }
            let get = |key: &str| table.get(key).map(|entry| &entry.node);
            let axes = body_axes(self, (get("rotation"), get("axes")), &format!("body `{name}`"))?;
            Some(Motion::new(frame.rotation * Rotation::from_matrix(&axes), position))
        })
    }

    /// The position of the point that is called `name` in the whole model. Nothing if there is none, or if it could not be read;
    /// then its mistake is reported.
    pub(crate) fn point(&self, name: &str) -> Option<Vector3> {
        let node = self.entry("points", name)?;
        let found = self.once(Wanted::Point(name.to_owned()), node.span, || {
            let what = format!("point `{name}`");
            let list = match &node.value {
                Value::Table(table) => {
                    if let Some((key, entry)) =
                        table.iter().find(|(key, _)| !matches!(key.as_str(), "in" | "at"))
                    {
                        let message = format!("{what} has an unknown key `{key}`");
                        return self.fail(entry.key, message, "write { in = \"part\", at = [x, y, z] }");
                    }
                    if !table.contains_key("in") {
                        return self.fail(
                            node.span,
                            format!("{what} lacks `in`"),
                            "write { in = \"part\", at = [x, y, z] }, or three numbers",
                        );
                    }
                    match table.get("at") {
                        None => return Some(Motion::translation(self.frame(node.scope)?.position)),
                        Some(entry) => &entry.node,
                    }
                }
                _ => node,
            };
            self.vector(list, &what)
                .and_then(|own| Some(Motion::translation(self.to_global(list.scope, &own)?)))
        });
        found.map(|frame| frame.position)
    }

    /// A position given in `scope`, in global axes.
    pub(crate) fn to_global(&self, scope: ScopeId, place: &Vector3) -> Option<Vector3> {
        let frame = self.frame(scope)?;
        // Values without placement are unchanged, to the last bit.
        Some(if frame == Motion::IDENTITY { *place } else { frame.transform_point(place) })
    }

    /// A direction given in `scope`, in global axes.
    pub(crate) fn turned(&self, scope: ScopeId, direction: &Vector3) -> Option<Vector3> {
        let frame = self.frame(scope)?;
        Some(if frame.rotation == Rotation::IDENTITY { *direction } else { frame.rotation.apply(direction) })
    }

    /// Computes a frame once; a frame that depends on itself is an error.
    fn once(&self, wanted: Wanted, place: Span, find: impl FnOnce() -> Option<Motion>) -> Option<Motion> {
        let known = self.frames.0.borrow().get(&wanted).copied();
        match known {
            Some(Finding::Done(found)) => found,
            Some(Finding::Begun) => {
                let what = match &wanted {
                    Wanted::Body(name) => format!("the position of `{name}`"),
                    Wanted::Point(name) => format!("the point `{name}`"),
                    Wanted::Scope(scope) => {
                        format!("the position of `{}`", self.scopes[*scope].prefix.trim_end_matches('.'))
                    }
                };
                self.fail(
                    place,
                    format!("{what} is given relative to itself, in a circle"),
                    "give one of these positions without `in`",
                )
            }
            None => {
                self.frames.0.borrow_mut().insert(wanted.clone(), Finding::Begun);
                let found = find();
                self.frames.0.borrow_mut().insert(wanted, Finding::Done(found));
                found
            }
        }
    }
}

/// Body axes as columns in the axes around the body, from a rotation vector or from the first two axes.
pub(crate) fn body_axes(
    context: &Context<'_>,
    (rotation, axes): (Option<&Node>, Option<&Node>),
    what: &str,
) -> Option<Matrix3> {
    let Some(node) = axes else {
        let rotation = rotation.map(|node| context.vector(node, &format!("`rotation` of {what}")));
        let rotation = rotation.map_or(Some(Vector3::zeros()), |vector| vector);
        return Some(Rotation::exponential(&rotation?).matrix());
    };
    if rotation.is_some() {
        let message = format!("{what} has both `rotation` and `axes`");
        return context.fail(node.span, message, "remove one of them");
    }
    let what = format!("`axes` of {what}");
    let list = context.list(node, 2, &what)?;
    let first = context.own_direction(&list[0], &format!("the first of {what}"));
    let second = context.own_direction(&list[1], &format!("the second of {what}"));
    let (first, second) = (first?, second?);
    if are_parallel(&first, &second) {
        return context.fail(node.span, format!("{what} are parallel"), "specify two different directions");
    }
    let one = first.normalize();
    let three = one.cross(&second).normalize();
    let exact = one.dot(&second.normalize()).abs() < 1e-6;
    if !exact {
        let message = format!("{what} must be perpendicular to each other");
        return context.fail(node.span, message, "specify the first and the second axis of the body");
    }
    Some(Matrix3::from_columns(&[one, three.cross(&one), three]))
}
