//! Solids of symbols, and their placement: the axes of a joint in the frame of its node.
//!
//! Lengths are multiples of the radius at which a symbol is drawn, which depends on the size of the picture.

use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

/// Form of a solid, with the meaning of its three sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// About its axis: radius, length.
    Cylinder,
    /// About its axis, with its tip forwards: radius, length.
    Cone,
    /// Radius.
    Ball,
    /// Width, length along its axis, depth.
    Block,
    /// About its axis: radius of the middle line, radius of the tube.
    Ring,
    /// Radius.
    Octahedron,
}

/// Role of a solid, which determines its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tone {
    /// The body of a joint.
    Light,
    /// A pin or shaft of a joint.
    Dark,
    /// Prescribed motion.
    Drive,
    /// A spring.
    Spring,
    /// A stop or a brake.
    Stop,
    /// A force.
    Load,
    /// A moment.
    Moment,
}

/// A solid of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solid {
    /// Form of the solid.
    pub form: Form,
    /// Sizes of the solid, in the order of the form.
    pub size: [f64; 3],
    /// Centre of the solid, from the position of the symbol, in the frame of the node.
    pub place: [f64; 3],
    /// Axis of the solid in the frame of the node, of length one. It leads there from the solid's second axis by the shortest turn.
    pub axis: [f64; 3],
    /// Direction of the first side of a block, of length one and perpendicular to the axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side: Option<[f64; 3]>,
    /// Role of the solid, for its colour.
    pub tone: Tone,
}

/// Three perpendicular directions of length one in the frame of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axes(pub(super) [Vector3; 3]);

impl Axes {
    /// From a first direction and, if there is one, a second that is not parallel to it.
    pub(super) fn of(first: &Vector3, second: Option<&Vector3>) -> Self {
        let first = first.try_normalize(0.0).unwrap_or_else(Vector3::x);
        let across = |direction: &Vector3| (direction - first * first.dot(direction)).try_normalize(1e-6);
        let least = Vector3::ith(first.iamin(), 1.0);
        let second = second.and_then(across).or_else(|| across(&least)).unwrap_or_else(Vector3::y);
        Self([first, second, first.cross(&second)])
    }

    /// A solid about the axis `along`, at `place` in these axes.
    pub(super) fn solid(
        &self,
        form: Form,
        size: [f64; 3],
        (along, place): (usize, [f64; 3]),
        tone: Tone,
    ) -> Solid {
        let place: Vector3 = (0..3).map(|k| self.0[k] * place[k]).sum();
        let side = (form == Form::Block).then(|| self.0[(along + 1) % 3].into());
        Solid { form, size, place: place.into(), axis: self.0[along].into(), side, tone }
    }

    /// A cylinder about the axis `along` through the position of the symbol.
    pub(super) fn cylinder(&self, along: usize, radius: f64, length: f64, tone: Tone) -> Solid {
        self.solid(Form::Cylinder, [radius, length, 0.0], (along, [0.0; 3]), tone)
    }

    /// A block whose second side is along the first axis, the first one along the second.
    pub(super) fn block(&self, size: [f64; 3], place: [f64; 3], tone: Tone) -> Solid {
        self.solid(Form::Block, size, (0, place), tone)
    }

    /// A ball.
    pub(super) fn ball(&self, radius: f64, place: [f64; 3], tone: Tone) -> Solid {
        self.solid(Form::Ball, [radius, 0.0, 0.0], (0, place), tone)
    }

    /// A ring about the first axis, so far along it.
    pub(super) fn ring(&self, radius: f64, tube: f64, along: f64, tone: Tone) -> Solid {
        self.solid(Form::Ring, [radius, tube, 0.0], (0, [along, 0.0, 0.0]), tone)
    }

    /// An arrow along the first axis.
    pub(super) fn arrow(&self, tone: Tone) -> Vec<Solid> {
        let head = self.solid(Form::Cone, [0.5, 1.2, 0.0], (0, [2.4, 0.0, 0.0]), tone);
        vec![self.cylinder(0, 0.18, 4.0, tone), head]
    }

    /// An arrow round the first axis.
    pub(super) fn turn(&self, tone: Tone) -> Vec<Solid> {
        let head = self.solid(Form::Cone, [0.45, 1.1, 0.0], (2, [0.0, 2.0, 0.3]), tone);
        vec![self.ring(2.0, 0.16, 0.0, tone), head]
    }
}
