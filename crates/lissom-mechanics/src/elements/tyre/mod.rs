//! A tyre on a road: its deflection, and the slip that carcass and tread build up, as states.
//!
//! Legend: in axes of the road: c centre, n normal of the road under the tyre and h height of c above it, a axis of the wheel, γ camber angle,
//! sin γ = a·n, R free radius, δ deflection, Ω = a·ω, P centre of contact, v_P velocity of the wheel there, x = a × n/cos γ direction of rolling,
//! y = n × x; N normal force, e deflections (states), σ relaxation lengths, ε deflections over them, τ damping time.
//!
//! ```text
//! δ = R cos γ - h,    N = max(0, k δ + d δ̇),    R_e = R - δ/3,    V = (x·v_P + Ω h/cos γ, y·v_P)
//! s = (V₁ - Ω R_e, V₂),    p = |l e/σ|,    w² = V₁² + |l s|² p⁸,    e' = -s - w e/σ
//! ε = (1 + 4 f p⁸/(1 + p⁸)) (e + τ e'/(1 + w/w₀))/σ,    l_k = f/ε_a,k + (1 - f)/3,    f = 1/(1 + (V₁² + |s|²)/w₀²)
//! ```
//!
//! [Pacejka 2012, chapters 7 and 8]. In steady rolling ε₁ is the longitudinal slip κ and -ε₂ the tangent of the slip angle, and a law gives the
//! forces of the tread over them. At standstill the states keep the force, without creep. Before it w keeps the deflections within σ ε_a, those of
//! a spring of the slip stiffness under the friction, p ≤ 1: with more, a vehicle that stops with locked wheels would be thrown back. There 3 ε_a, at
//! which a brush slides, is used as the slip, so that the force over the deflection is almost that of the spring. The longitudinal force acts at the
//! effective radius R_e, at which the wheel rolls without it.
//!
//! An uneven road is replaced by the plane that fits its heights at points of the contact best.

mod brush;
pub mod magic_formula;
mod road;
mod tread;

use lissom_motion::{Matrix3, Matrix6, Vector3, Vector6, lie_bracket_matrix};
use nalgebra::SMatrix;

use self::brush::Brush;
use self::magic_formula::MagicFormula;
use self::road::{Footing, Ground};
use self::tread::{Law, Slip};
use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::rolling_contact::on_plane;
use super::{
    Capabilities, Element, ForceLaws, Limit, LimitKind, Load, Report, Spring, Symmetric, Tangents, Unknowns,
    Validity, add_block,
};
use crate::dual::{Dual, Number, cross, dot, sum, times};
use crate::evaluation::switch_states::{SwitchStates, frozen_branch, is_on_upper_branch};
use crate::joints::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::{CoordinateId, Kinematics, NodeId, Subject, Switch, is_along};
use crate::ports::Ports;
use crate::registry::ParameterType::{
    Choice, Coefficients, Direction, DirectionOr, HeightField, NotNegative, Positive,
};
use crate::registry::{ModelAxis, ParameterError, Parameters, Usual, optional, required, unitless};
use crate::signals::SignalError;
use crate::signals::measurement::Gradient;
use crate::wheels::wheel_on_rail::Pose;

/// With derivatives by the tip's variation, its twist relative to the base, and the states.
type Varied = Dual<14>;
/// Key in the coefficients of a file: 1 for a tyre that was measured on the left, -1 on the right.
pub const SIDE: &str = "TYRESIDE";

/// What a tyre reports: its slip and the forces of the tread in axes of the contact.
pub const REPORTED: &[(&str, &str)] = &[
    ("slip", ""),
    ("slip_angle", "rad"),
    ("longitudinal", "N"),
    ("lateral", "N"),
    ("normal", "N"),
    ("aligning", "N m"),
];

/// Parameters that are not data of a brush.
const OF_BOTH: [&str; 9] = [
    "normal",
    "wheel_axis",
    "magic_formula",
    "mounted",
    "damping_time",
    "road",
    "road_direction",
    "width",
    "contact_length",
];

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "tyre",
    summary: "A tyre on a road, plane or uneven: brush model or Magic Formula with combined slip, relaxation, camber, trail and standstill without creep.",
    sample: "normal = [0.0, 0.0, 1.0]\nwheel_axis = [0.0, 1.0, 0.0]\nradius = 0.31\nstiffness = 2e5\nfriction_coefficient = 0.9\nslip_stiffness = 20.0\n\
             cornering_stiffness = 15.0",
    parameters: &[
        required(
            "normal",
            Direction,
            "",
            "Normal of the road at the start, which is fixed in the base, global axes; `at_base` is a point of the road.",
        ),
        required(
            "wheel_axis",
            Direction,
            "",
            "Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre. The tip is the part that rotates.",
        ),
        optional(
            "radius",
            Positive,
            "m",
            "Free radius; default: the one with which it touches the road at the start.",
        )
        .usual(Usual::new(0.01, 3.0, "in millimetres or inches")),
        unitless(
            "magic_formula",
            Coefficients,
            "Coefficients of PAC2002 or MF-Tyre 5.2: a tyre property file `.tir`, or `{ file = \"…\", LMUY = 0.8 }` with other values of some. They replace the \
            other data of the tyre except for `damping_time`.",
        ),
        unitless(
            "mounted",
            Choice(&["left", "right"]),
            "Side of the vehicle, on which `wheel_axis` points to the left; offsets change their sign on the side for which the file was not measured; \
            default: the side of the file.",
        ),
        optional(
            "stiffness",
            Positive,
            "N/m",
            "Normal force per deflection; required without `magic_formula`.",
        )
        .usual(Usual::new(1e3, 1e8, "in N/mm")),
        optional(
            "damping",
            NotNegative,
            "N s/m",
            "Normal force per deflection rate, without `magic_formula`.",
        )
        .or_number(0.0),
        unitless(
            "friction_coefficient",
            Positive,
            "Coefficient of friction; that of dry asphalt is the default.",
        )
        .or_number(0.9),
        unitless(
            "slip_stiffness",
            Positive,
            "Longitudinal force per slip and normal force, at small slip; required without `magic_formula`.",
        )
        .usual(Usual::new(0.5, 200.0, "in newtons, and not over the normal force")),
        unitless(
            "cornering_stiffness",
            Positive,
            "Lateral force per slip angle and normal force, at small angles; required without `magic_formula`.",
        )
        .usual(Usual::new(0.5, 200.0, "in N/rad, and not over the normal force")),
        unitless(
            "camber_stiffness",
            NotNegative,
            "Lateral force per camber angle and normal force, towards the side to which the wheel leans.",
        )
        .or_number(0.0),
        optional(
            "pneumatic_trail",
            NotNegative,
            "m",
            "Distance of the lateral force behind the centre of contact at small angles; default a tenth of the radius.",
        ),
        optional(
            "relaxation_length",
            Positive,
            "m",
            "Distance over which a lateral force builds up; default the radius.",
        ),
        optional(
            "longitudinal_relaxation_length",
            Positive,
            "m",
            "The same for a longitudinal force; default half of the radius.",
        ),
        optional(
            "damping_time",
            NotNegative,
            "s",
            "Damping of the tread over its stiffness, which fades beyond 1 m/s.",
        )
        .or_number(0.005),
        unitless("rolling_resistance", NotNegative, "Resistance to rolling over the normal force.")
            .or_number(0.0),
        optional(
            "load_sensitivity",
            NotNegative,
            "1/N",
            "Decrease of friction with the normal force: μ/(1 + this N).",
        )
        .or_number(0.0),
        optional(
            "road",
            HeightField,
            "m",
            "Height of an uneven road above the plane, along `normal`: an expression of `x` and `y`, a table over `x`, a grid `{ file = \"…\" }`, or a \
            random profile `{ class = \"C\" }` of ISO 8608; x and y from `at_base`, in the plane.",
        ),
        unitless(
            "road_direction",
            DirectionOr(ModelAxis::X),
            "Direction of x of the road at the start, global axes; its part in the plane counts.",
        ),
        optional(
            "width",
            Positive,
            "m",
            "Width of the contact on an uneven road; default three fifths of the radius.",
        ),
        optional(
            "contact_length",
            Positive,
            "m",
            "Length of the contact on an uneven road; default two fifths of the radius.",
        ),
    ],
    ports: Ports::TWO_FRAMES,
    build,
};

/// A tyre.
#[derive(Clone, Debug)]
pub struct Tyre {
    frames: FramePair,
    /// Name of the wheel.
    wheel: String,
    /// Deflections of the tread along and across the rolling.
    states: [CoordinateId; 2],
    /// a, in the tip's axes.
    axis: Vector3,
    ground: Ground,
    /// R.
    radius: f64,
    law: Law,
    /// τ.
    damping_time: f64,
    switch_states: SwitchStates,
}

/// Forces and rates of a tyre.
struct Touch<T> {
    /// δ, δ̇ and N.
    normal: [T; 3],
    /// On the tip, in its axes.
    wrench: [T; 6],
    /// -e'.
    falling: [T; 2],
    /// κ, α, F₁, F₂, N and M_n.
    slip: [T; 6],
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (frames, axis, height) = on_plane(model, attached, parameters)?;
    let (radius, law) = if parameters.has("magic_formula") {
        let law = magic_formula(parameters)?;
        (law.radius(), Law::MagicFormula(Box::new(law)))
    } else {
        if parameters.has("mounted") {
            let problem = "has no effect without `magic_formula`: the brush is the same on both sides";
            return Err(ParameterError::new("mounted", problem));
        }
        let radius = if parameters.has("road") {
            parameters.number("radius")?
        } else {
            parameters.number_or("radius", height.abs() / (1.0 - axis.z * axis.z).sqrt())?
        };
        (radius, Law::Brush(Brush::new(radius, parameters)?))
    };
    let mut contribution = Contribution::to(model);
    let states = ["along", "across"].map(|word| {
        contribution.add_state(format!("{}, tyre {word}", model.nodes[frames[1].node].name), 0.0, 0.01)
    });
    Ok(contribution.with(Tyre {
        frames: FramePair::new(frames),
        wheel: model.nodes[frames[1].node].name.clone(),
        states,
        axis,
        ground: Ground::new(height.signum(), radius, parameters)?,
        radius,
        law,
        damping_time: parameters.number("damping_time")?,
        switch_states: SwitchStates::default(),
    }))
}

/// The law of a file, which replaces data of a brush.
fn magic_formula(parameters: &Parameters) -> Result<MagicFormula, ParameterError> {
    let is_of_brush = |name: &&str| !OF_BOTH.contains(name) && parameters.has(name);
    if let Some(name) = KIND.parameters.iter().map(|parameter| parameter.name).find(is_of_brush) {
        let problem = "is not used with `magic_formula`: specify the coefficient of the file there instead, as `{ file = \"…\", LMUY = 0.8 }`";
        return Err(ParameterError::new(name, problem));
    }
    let given = parameters.coefficients("magic_formula")?;
    let measured_on_the_right = given.get(SIDE).is_some_and(|side| *side < 0.0);
    let is_on_the_right = if parameters.has("mounted") {
        parameters.word("mounted")? == "right"
    } else {
        measured_on_the_right
    };
    MagicFormula::new(given, is_on_the_right != measured_on_the_right)
}

impl Tyre {
    fn touch<T: Number>(
        &self,
        (pose, twist): (&Pose<T>, &[T; 6]),
        states: [T; 2],
        touches: bool,
    ) -> Touch<T> {
        let [zero, one] = [0.0, 1.0].map(T::constant);
        let axis = pose.apply([0, 1, 2].map(|k| T::constant(self.axis[k])));
        let Footing { normal, height, .. } = self.ground.under(pose, axis);
        let lean = dot(axis, normal);
        let cosine = (one - lean * lean).square_root();
        let depth = cosine.scaled(self.radius) - height;
        let [vx, vy, vz, wx, wy, wz] = *twist;
        let turning = pose.apply([wx, wy, wz]);
        // From the centre to P, along the wheel's plane.
        let loaded = height / cosine;
        let upwards = times(sum(normal, times(axis, -lean)), one / cosine);
        let arm = times(upwards, -loaded);
        let velocity = sum(pose.apply([vx, vy, vz]), cross(turning, arm));
        let deepening = -dot(normal, velocity);
        let along = times(cross(axis, normal), one / cosine);
        let across = cross(normal, along);
        let spin = dot(turning, axis);
        let effective = self.law.effective_radius(self.radius, depth);
        let rolling = dot(along, velocity) + spin * loaded;
        let slides = [rolling - spin * effective, dot(across, velocity)];
        let pressed = self.law.normal(depth, deepening);
        // A height that is not a number is none of a road below the tyre: the forces are NaN, which fails.
        if !depth.value().is_nan() && (!touches || pressed.value() <= 0.0) {
            // Deflections vanish in the air within some 50 ms.
            let falling = states.map(|state| state.scaled(20.0));
            return Touch { normal: [depth, deepening, zero], wrench: [zero; 6], falling, slip: [zero; 6] };
        }
        let carried = rolling * rolling;
        let lengths = self.law.relaxation(pressed, lean);
        let limits = self.law.adhesion(pressed);
        let bent = [0, 1].map(|k| states[k] / lengths[k]);
        let [passing, stretch] = passing((carried, slides), bent, limits);
        // w₀ is 1 m/s.
        let fading = T::constant(self.damping_time) / passing.plus(1.0);
        let falling = [0, 1].map(|k| slides[k] + passing * states[k] / lengths[k]);
        let slips = [0, 1].map(|k| stretch * (states[k] - fading * falling[k]) / lengths[k]);
        // Below 0.3 m/s moments that depend on the direction of motion fade.
        let slow = 0.3;
        let slip = Slip {
            along: slips[0],
            across: -slips[1],
            lean,
            normal: pressed,
            rolling,
            forwards: rolling / carried.plus(slow * slow).square_root(),
            turning: (spin * effective).scaled(1.0 / slow).hyperbolic_tangent(),
        };
        let tread = self.law.tread(&slip);
        let force = sum(times(normal, pressed), sum(times(along, tread.along), times(across, tread.across)));
        // The longitudinal force acts at the effective radius.
        let about_axis = tread.along * (loaded - effective) + tread.resisting;
        let about = sum(times(along, tread.overturning), times(normal, tread.aligning));
        let moment = sum(cross(arm, force), sum(about, times(axis, about_axis)));
        let [force, moment] = [pose.apply_inverse(force), pose.apply_inverse(moment)];
        Touch {
            normal: [depth, deepening, pressed],
            wrench: [force[0], force[1], force[2], moment[0], moment[1], moment[2]],
            falling,
            slip: [slips[0], slip.across.arc_tangent(), tread.along, tread.across, pressed, tread.aligning],
        }
    }

    fn touches(&self, at: &Kinematics, motion: &RelativeMotion) -> bool {
        is_on_upper_branch(self.switch_states.of(at).first(), self.depth(&motion.rotation, &motion.position))
    }

    fn depth(&self, rotation: &Matrix3, position: &Vector3) -> f64 {
        let pose = Pose::new(rotation, position);
        let axis = (rotation * self.axis).into();
        let Footing { normal, height, .. } = self.ground.under(&pose, axis);
        let lean = dot(axis, normal);
        (1.0 - lean * lean).max(0.0).sqrt() * self.radius - height
    }

    fn value(&self, at: &Kinematics) -> (RelativeMotion, Touch<f64>) {
        let motion = self.frames.motion(at);
        let pose = Pose::new(&motion.rotation, &motion.position);
        let states = self.states.map(|state| at.coordinates[state].value);
        let touch = self.touch((&pose, &motion.twist.into()), states, self.touches(at, &motion));
        (motion, touch)
    }

    fn varied(&self, at: &Kinematics) -> (RelativeMotion, Touch<Varied>) {
        let motion = self.frames.motion(at);
        let pose = Pose::new(&motion.rotation, &motion.position).varied();
        let twist: [Varied; 6] = std::array::from_fn(|k| Dual::variable(motion.twist[k], 6 + k));
        let states: [Varied; 2] =
            std::array::from_fn(|k| Dual::variable(at.coordinates[self.states[k]].value, 12 + k));
        let touch = self.touch((&pose, &twist), states, self.touches(at, &motion));
        (motion, touch)
    }
}

/// w, and ε over that at a high velocity; from V₁² and s, e/σ and ε_a.
fn passing<T: Number>((carried, slides): (T, [T; 2]), bent: [T; 2], adhesion: [T; 2]) -> [T; 2] {
    let one = T::constant(1.0);
    let fast = carried + slides[0] * slides[0] + slides[1] * slides[1];
    let slow = one / fast.plus(1.0);
    let limits = adhesion.map(|limit| slow / limit + (one - slow).scaled(1.0 / 3.0));
    let square = |of: [T; 2]| {
        let [first, second] = [0, 1].map(|k| limits[k] * of[k]);
        first * first + second * second
    };
    let near = square(bent);
    let near = near * near * (near * near);
    let passing = (carried + square(slides) * near).plus(f64::MIN_POSITIVE).square_root();
    [passing, (slow * near / near.plus(1.0)).scaled(4.0).plus(1.0)]
}

/// Derivatives of a number with respect to η, at fixed twists of the nodes, and η̇. Changes of the relative twist: δη̇ = -ad(A V_base) η.
fn of_motion(value: &Varied, motion: &RelativeMotion) -> [Vector6; 2] {
    let [place, rate] = [0, 6].map(|first| Vector6::from_column_slice(&value.by[first..first + 6]));
    [place - lie_bracket_matrix(&motion.carried).tr_mul(&rate), rate]
}

/// Derivatives of a number with respect to the motion of both nodes and the states.
fn gradient(value: &Varied, motion: &RelativeMotion, columns: &[Matrix6; 2]) -> Gradient {
    let mut gradient = Gradient::zero();
    let [place, by_rate] = of_motion(value, motion);
    for (j, columns) in columns.iter().enumerate() {
        let slots = 6 * j..6 * j + 6;
        gradient.by_place[slots.clone()].copy_from_slice(columns.tr_mul(&place).as_slice());
        gradient.by_rate[slots].copy_from_slice(columns.tr_mul(&by_rate).as_slice());
    }
    gradient.by_place[12..14].copy_from_slice(&value.by[12..]);
    gradient
}

impl Symmetric for Tyre {
    fn is_symmetric_about(&self, node: NodeId, axis: &Vector3) -> bool {
        let [base, tip] = self.frames.frames;
        tip.node == node
            && base.node != node
            && is_along(&tip.offset.position, axis)
            && is_along(&tip.offset.rotation.apply(&self.axis), axis)
    }
}

impl Element for Tyre {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.frames.nodes, coordinates: &self.states, ..Unknowns::default() }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let (motion, touch) = self.value(at);
        self.frames.add_wrench(&motion, &-Vector6::from_column_slice(&touch.wrench), out);
        for (k, falling) in touch.falling.iter().enumerate() {
            out[12 + k] += at.coordinates[self.states[k]].rate + falling;
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let (motion, touch) = self.varied(at);
        let size = out.size();
        let derivatives = touch.wrench.map(|value| of_motion(&-value, &motion));
        let by_place = Matrix6::from_fn(|i, j| derivatives[i][0][j]);
        let by_rate = Matrix6::from_fn(|i, j| derivatives[i][1][j]);
        let values = Vector6::from_fn(|i, _| -touch.wrench[i].value);
        self.frames.add_stiffness(&motion, (&values, &by_place), (size, &mut out.stiffness));
        self.frames.add_damping(&motion, &by_rate, (size, &mut out.damping));
        let columns = self.frames.columns(&motion);
        for k in 0..2 {
            let mut column = [0.0; 12];
            let by_state = Vector6::from_fn(|i, _| -touch.wrench[i].by[12 + k]);
            self.frames.add_wrench(&motion, &by_state, &mut column);
            for (row, value) in column.iter().enumerate() {
                out.stiffness[row * size + 12 + k] += value;
            }
            let [place, rate] = of_motion(&touch.falling[k], &motion);
            for (j, own) in columns.iter().enumerate() {
                let block = |row: &Vector6| -> SMatrix<f64, 1, 6> { row.transpose() * own };
                add_block(&mut out.stiffness, size, (12 + k, 6 * j), &block(&place));
                add_block(&mut out.damping, size, (12 + k, 6 * j), &block(&rate));
            }
            for l in 0..2 {
                out.stiffness[(12 + k) * size + 12 + l] += touch.falling[k].by[12 + l];
            }
            out.damping[(12 + k) * size + 12 + k] += 1.0;
        }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities {
            load: Some(self),
            spring: Some(self),
            report: Some(self),
            validity: Some(self),
            laws: Some(self),
            frames: Some(self.frames.frames),
            symmetry: Some(self),
            ..Capabilities::default()
        }
    }
}

impl Load for Tyre {
    fn depends_on_motion(&self) -> bool {
        true
    }

    fn check(&self, at: &Kinematics) -> Result<(), SignalError> {
        let relative = self.frames.relative(at);
        let depth = self.depth(&relative.rotation.matrix(), &relative.position);
        if depth.is_finite() {
            return Ok(());
        }
        let signal = Subject::new("node", &self.wheel).called(format!("`road` under `{}`", self.wheel));
        Err(SignalError { signal, value: depth, time: at.time })
    }
}

impl Spring for Tyre {
    fn dissipates(&self) -> bool {
        true
    }

    /// Deflection, its rate and the normal force, which opposes it.
    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let [depth, rate, force] = self.value(at).1.normal;
        [-depth, -rate, force]
    }

    fn spring_gradients(&self, at: &Kinematics) -> Option<[Gradient; 3]> {
        let (motion, touch) = self.varied(at);
        let columns = self.frames.columns(&motion);
        let [depth, rate, force] = touch.normal;
        Some([-depth, -rate, force].map(|value| gradient(&value, &motion, &columns)))
    }
}

impl Report for Tyre {
    fn words(&self) -> &'static [(&'static str, &'static str)] {
        REPORTED
    }

    fn numbers(&self, at: &Kinematics) -> [f64; 6] {
        self.value(at).1.slip
    }

    fn gradients(&self, at: &Kinematics) -> [Gradient; 6] {
        let (motion, touch) = self.varied(at);
        let columns = self.frames.columns(&motion);
        touch.slip.map(|value| gradient(&value, &motion, &columns))
    }
}

impl Validity for Tyre {
    fn limits(&self) -> &'static [LimitKind] {
        &[LimitKind::TyreLoad, LimitKind::TyreRoad, LimitKind::TyreDeflection, LimitKind::TyreDirection]
    }

    fn limit(&self, kind: LimitKind, [_, at]: [&Kinematics; 2]) -> Option<Limit<'_>> {
        let (motion, touch) = self.value(at);
        let load = touch.normal[2];
        let footing = || {
            let pose = Pose::new(&motion.rotation, &motion.position);
            self.ground.under(&pose, (motion.rotation * self.axis).into())
        };
        match (kind, &self.law) {
            (LimitKind::TyreLoad, Law::MagicFormula(law)) => {
                Some(Limit::of_element(load, law.largest_load()))
            }
            (LimitKind::TyreRoad, _) if load > 0.0 => {
                Some(Limit::of_element(footing().bumps, 0.03 * self.radius))
            }
            (LimitKind::TyreDeflection, _) => Some(Limit::of_element(touch.normal[0], 0.25 * self.radius)),
            (LimitKind::TyreDirection, Law::MagicFormula(_)) => {
                let along = (motion.rotation * self.axis).cross(&Vector3::from(footing().normal));
                let velocity: Vector3 = motion.twist.fixed_rows::<3>(0).into();
                Some(Limit::of_element(-along.dot(&(motion.rotation * velocity)), 1.0))
            }
            _ => None,
        }
    }
}

impl ForceLaws for Tyre {
    fn switch_count(&self) -> usize {
        1
    }

    fn is_idle(&self, at: &Kinematics) -> bool {
        frozen_branch(self.switch_states.of(at).first()) == Some(false)
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let relative = self.frames.relative(at);
        out.push(self.depth(&relative.rotation.matrix(), &relative.position).into());
    }
}
