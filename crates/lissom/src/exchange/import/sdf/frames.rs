//! Named frames of SDF: poses relative to each other, and the link to which each is attached.

use std::collections::BTreeMap;

use lissom_motion::Motion;

use super::super::ImportError;
use super::element::Element;

/// Index of the frame of the world.
pub(super) const WORLD: usize = 0;

/// What moves with a frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Carrier {
    World,
    /// The link with this index.
    Link(usize),
    /// Another frame, by its name in the scope of the frame.
    Named(String),
    /// Another frame, by its index.
    Frame(usize),
}

/// A frame whose name is known in its scope.
pub(super) struct Frame {
    /// Name with those of the models around it, as `arm::hand::palm`.
    pub(super) name: String,
    /// Scope of the names that it refers to.
    pub(super) scope: usize,
    pose: Motion,
    /// Frame to which the pose is relative: by name in the scope, or an index.
    base: Result<String, usize>,
    pub(super) carrier: Carrier,
    /// The element, in words of an error.
    source: String,
}

/// A model or the world, in which names are looked up.
pub(super) struct Scope {
    /// What precedes names in it.
    pub(super) prefix: String,
    /// Index of its own frame.
    pub(super) own: usize,
}

/// All frames of a description; the first is the world.
pub(super) struct Frames {
    pub(super) all: Vec<Frame>,
    pub(super) scopes: Vec<Scope>,
    names: BTreeMap<String, usize>,
    /// Frames within models that the pose of the model places: indices of model and scope, and the name.
    placed: Vec<(usize, usize, String)>,
}

impl Frames {
    pub(super) fn new() -> Self {
        let world = Frame {
            name: "world".to_owned(),
            scope: 0,
            pose: Motion::identity(),
            base: Err(WORLD),
            carrier: Carrier::World,
            source: String::new(),
        };
        let scopes = vec![Scope { prefix: String::new(), own: WORLD }];
        Self { all: vec![world], scopes, names: BTreeMap::new(), placed: Vec::new() }
    }

    /// Adds the frame of an element in a scope, called `name` there; without `relative_to` its pose is relative to `base`.
    pub(super) fn add(
        &mut self,
        element: &Element,
        scope: usize,
        name: &str,
        (base, carrier): (Result<String, usize>, Carrier),
    ) -> Result<usize, ImportError> {
        let (pose, named) = element.pose()?;
        let name = format!("{}{name}", self.scopes[scope].prefix);
        let index = self.all.len();
        if self.names.contains_key(&name) {
            return Err(element.fault(format!("another element has the same name, `{name}`")));
        }
        self.names.insert(name.clone(), index);
        let base = named.map_or(base, |named| Ok(named.to_owned()));
        self.all.push(Frame { name, scope, pose, base, carrier, source: element.words() });
        Ok(index)
    }

    /// The frame that the pose of a model places, by its name in the scope of the model.
    pub(super) fn place(&mut self, model: usize, scope: usize, name: &str) {
        self.placed.push((model, scope, name.to_owned()));
    }

    /// Index of the frame called `name` in a scope.
    pub(super) fn find(&self, scope: usize, name: &str) -> Option<usize> {
        let Scope { prefix, own } = &self.scopes[scope];
        match name {
            "world" | "__root__" => Some(WORLD),
            "__model__" => Some(*own),
            _ => {
                let known = |name: &str| self.names.get(&format!("{prefix}{name}")).copied();
                known(name).or_else(|| known(name.strip_suffix("::__model__")?))
            }
        }
    }

    /// Like [`Self::find`], with an error about `element`.
    pub(super) fn required(&self, scope: usize, name: &str, element: &Element) -> Result<usize, ImportError> {
        self.find(scope, name).ok_or_else(|| element.fault(format!("there is no frame `{name}`")))
    }

    /// The link to which a frame is attached; none for the world.
    pub(super) fn link(&self, frame: usize) -> Result<Option<usize>, ImportError> {
        let mut at = frame;
        for _ in 0..=self.all.len() {
            let own = &self.all[at];
            at = match &own.carrier {
                Carrier::World => return Ok(None),
                Carrier::Link(link) => return Ok(Some(*link)),
                Carrier::Frame(next) => *next,
                Carrier::Named(name) => self
                    .find(own.scope, name)
                    .ok_or_else(|| ImportError::new(format!("{}: there is no frame `{name}`", own.source)))?,
            };
        }
        Err(ImportError::new(format!(
            "{}: it is attached to itself, through other frames",
            self.all[frame].source
        )))
    }

    /// Poses of all frames in the world's, and faults of those that are relative to none or to themselves.
    pub(super) fn poses(&self) -> (Vec<Motion>, Vec<String>) {
        let mut faults = Vec::new();
        let base = |frame: &Frame| match &frame.base {
            Err(index) => Ok(*index),
            Ok(name) => self
                .find(frame.scope, name)
                .ok_or_else(|| format!("{}: there is no frame `{name}`", frame.source)),
        };
        let mut bases = Vec::new();
        for frame in &self.all {
            bases.push(base(frame).unwrap_or_else(|fault| {
                faults.push(fault);
                WORLD
            }));
        }
        let mut own: Vec<Motion> = self.all.iter().map(|frame| frame.pose).collect();
        // Models within others are behind them.
        for (model, scope, name) in self.placed.iter().rev() {
            let (mut at, mut inner) = (self.find(*scope, name), Motion::identity());
            for _ in 0..self.all.len() {
                let Some(frame) = at.filter(|frame| frame != model && *frame != WORLD) else { break };
                inner = own[frame] * inner;
                at = Some(bases[frame]);
            }
            if at == Some(*model) {
                own[*model] = own[*model] * inner.inverse();
            } else {
                let source = &self.all[*model].source;
                faults.push(format!("{source}: its pose places the frame `{name}`, which is no frame of it"));
            }
        }
        let mut found: Vec<Option<Motion>> = vec![None; self.all.len()];
        found[WORLD] = Some(Motion::identity());
        for start in 0..self.all.len() {
            let (mut path, mut at) = (Vec::new(), start);
            while found[at].is_none() && path.len() <= self.all.len() {
                path.push(at);
                at = bases[at];
            }
            let around = found[at].unwrap_or_else(|| {
                faults.push(format!(
                    "{}: its pose is relative to itself, through other frames",
                    self.all[at].source
                ));
                Motion::identity()
            });
            path.into_iter().rev().fold(around, |around, frame| *found[frame].insert(around * own[frame]));
        }
        (found.into_iter().map(Option::unwrap_or_default).collect(), faults)
    }
}
