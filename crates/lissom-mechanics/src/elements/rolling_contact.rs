//! A wheel on a compliant plane with sliding: a one-sided normal force, and friction by a law over the sliding
//! velocity.
//!
//! Legend: as in `joints::rolling` and `contact::wheel_on_plane`; g gap between wheel and plane, δ = -g penetration, V relative
//! twist, η its variation of position, b_n = ∂g/∂η, s_k = b_k·V sliding velocities, σ = |s|, μ(σ) coefficient of friction, r_k rows of
//! the rolling rates ω_k = r_k·V: (0, a) of a wheel with the axis a, (0, T_k) of a ball; ω = |(ω_k)|, ρ lever arm and c damping per
//! normal force of rolling friction. With rollers on its rim, whose axis at the contact is inclined by γ to that of the wheel, a wheel has
//! friction along the axis of the roller alone: p = (T_k·a), β = atan2(p₁, p₀) + γ.
//!
//! ```text
//! N = max(0, k δ max(0, 1 + a δ̇) + d δ̇) for δ > 0,      ν(ω) = ρ tanh(ω/ω_s) + c ω
//! wrench on the tip  N b_n - N μ(σ) Σ s_k/σ b_k - N ν(ω) Σ ω_k/ω r_k
//! with rollers       b = cos β b₀ + sin β b₁,      s = b·V,      - N μ(|s|) s/|s| b instead
//! ```
//!
//! Friction acts in the plane, not at the lowest point of the undeformed rim below it. The normal force is that of Hunt and Crossley 1975. Without `traction` the law is μ(σ) = μ₀ tanh(σ/v_s).

use lissom_motion::{
    Matrix6, Motion, Rotation, Vector3, Vector6, lie_bracket_matrix, rotation_part, screw, skew,
};

use super::contribution::Contribution;
use super::force_law::Response;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, Energy, ForceLaws, Spring, Tangents, Unknowns};
use crate::compliance::Compliance;
use crate::evaluation::switch_states::{SwitchStates, frozen_branch, is_on_upper_branch};
use crate::joints::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::{CarriedFrame, Kinematics, Switch};
use crate::ports::Ports;
use crate::registry::ParameterType::{NotNegative, Number, Positive};
use crate::registry::{Function, ParameterError, ParameterType, Parameters, optional, required, unitless};
use crate::signals::measurement::Gradient;
use crate::wheels::wheel_on_plane::{Contact, DIRECTIONS};

/// Sliding velocities below this are those of rolling, where the law is linear [m/s].
const ROLLING_SPEED: f64 = 1e-9;
/// Rolling rates below this, relative to ω_s, are those of standstill.
const STANDSTILL: f64 = 1e-7;

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "rolling_contact",
    summary: "A wheel, disc or ball on a compliant plane with friction: it may lift off and slide.",
    sample: "normal = [0.0, 0.0, 1.0]\nwheel_axis = [0.0, 1.0, 0.0]\nradius = 0.3\nstiffness = 1e6\nfriction_coefficient = 0.8",
    parameters: &[
        required(
            "normal",
            ParameterType::Direction,
            "",
            "Normal at the start of the plane, which is fixed in the base, global axes; `at_base` is a point of the plane.",
        ),
        required(
            "wheel_axis",
            ParameterType::Direction,
            "",
            "Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre.",
        ),
        optional(
            "radius",
            NotNegative,
            "m",
            "Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for \
            a ball of radius `rim`.",
        ),
        optional("rim", NotNegative, "m", "Rounding radius of the rim.").or_number(0.0),
        required("stiffness", Positive, "N/m", "Normal force per penetration."),
        optional(
            "dissipation",
            NotNegative,
            "s/m",
            "Relative increase of the normal force per penetration velocity.",
        ).or_number(0.0),
        optional(
            "damping",
            NotNegative,
            "N s/m",
            "Normal force per penetration velocity, while in contact.",
        ).or_number(0.0),
        unitless(
            "friction_coefficient",
            NotNegative,
            "Coefficient of sliding friction.",
        ).or_number(0.0),
        optional(
            "slip_velocity",
            Positive,
            "m/s",
            "Velocity v_s of the law μ tanh(v/v_s), below which the wheel creeps.",
        ).or_number(0.01),
        unitless(
            "traction",
            ParameterType::FunctionOf("slip"),
            "Coefficient of friction over the sliding velocity `slip` [m/s], instead of the law of `friction_coefficient`.",
        ),
        optional(
            "roller_angle",
            Number,
            "rad",
            "Angle about the normal from the axis of the wheel to that of the roller in contact, for a wheel with free rollers on its rim: \
            friction acts along the axis of the roller.",
        ),
        optional(
            "rolling_friction",
            NotNegative,
            "m",
            "Moment per normal force against rolling, of a wheel about its axis, of a ball about every axis in the plane.",
        ).or_number(0.0),
        optional(
            "rolling_damping",
            NotNegative,
            "m s/rad",
            "Additional moment per normal force and rolling rate.",
        ).or_number(0.0),
        optional(
            "rolling_rate",
            Positive,
            "rad/s",
            "Rate ω_s of the law tanh(ω/ω_s) of `rolling_friction`, below which the wheel creeps.",
        ).or_number(0.01),
    ],
    ports: Ports::TWO_FRAMES,
    build,
};

/// A wheel on a plane.
#[derive(Clone, Debug)]
pub struct RollingContact {
    frames: FramePair,
    contact: Contact,
    compliance: Compliance,
    /// Factor a and damping d.
    dissipation: [f64; 2],
    traction: Traction,
    /// γ, for a wheel with rollers [rad].
    roller_angle: Option<f64>,
    resistance: Option<RollingResistance>,
    switch_states: SwitchStates,
}

/// μ(σ).
#[derive(Clone, Debug)]
enum Traction {
    Saturated { coefficient: f64, velocity: f64 },
    Given(Function),
}

impl Traction {
    /// μ(σ)/σ, and its derivative with respect to σ, over σ.
    fn per_velocity(&self, sliding: f64) -> (f64, f64) {
        let at = sliding.max(ROLLING_SPEED);
        let (value, slope) = match self {
            Self::Saturated { coefficient, velocity } => {
                let value = (at / velocity).tanh();
                (coefficient * value, coefficient * (1.0 - value * value) / velocity)
            }
            Self::Given(function) => (function.value(at), function.first_derivative(at)),
        };
        let ratio = value / at;
        if sliding > ROLLING_SPEED { (ratio, (slope - ratio) / (at * at)) } else { (ratio, 0.0) }
    }
}

/// ν(ω).
#[derive(Clone, Copy, Debug)]
struct RollingResistance {
    /// ρ [m].
    arm: f64,
    /// c [m s/rad].
    damping: f64,
    /// ω_s [rad/s].
    rate: f64,
}

impl RollingResistance {
    /// ν(ω)/ω, and its derivative with respect to ω, over ω.
    fn per_rate(&self, rolling: f64) -> (f64, f64) {
        let least = STANDSTILL * self.rate;
        let at = rolling.max(least);
        let value = (at / self.rate).tanh();
        let (ratio, slope) = (self.arm * value / at, self.arm * (1.0 - value * value) / self.rate);
        let bend = if rolling > least { (slope - ratio) / (at * at) } else { 0.0 };
        (ratio + self.damping, bend)
    }
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (frames, axis, height) = on_plane(model, attached, parameters)?;
    let rim = parameters.number("rim")?;
    let radius = parameters.number_or("radius", (height.abs() - rim) / (1.0 - axis.z * axis.z).sqrt())?;
    if radius < 0.0 || radius + rim <= 0.0 {
        let problem = format!("is {radius} m with a rim of {rim} m: there is no wheel to roll");
        return Err(ParameterError::new("radius", problem));
    }
    let roller_angle =
        if parameters.has("roller_angle") { Some(parameters.number("roller_angle")?) } else { None };
    if roller_angle.is_some() && radius == 0.0 {
        return Err(ParameterError::new("roller_angle", "has no meaning for a ball, which has no axis"));
    }
    let contact = Contact { axis, side: height.signum(), radius, rim, friction: f64::INFINITY, creep: 0.0 };
    Ok(Contribution::of(
        model,
        RollingContact {
            frames: FramePair::new(frames),
            contact,
            compliance: Compliance { stiffness: parameters.number("stiffness")?, exponent: 1.0 },
            dissipation: [parameters.number("dissipation")?, parameters.number("damping")?],
            traction: traction(parameters)?,
            roller_angle,
            resistance: resistance(parameters)?,
            switch_states: SwitchStates::default(),
        },
    ))
}

/// Frames in axes of the plane, the axis of the wheel in them, and the height of its centre.
pub(super) fn on_plane(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<([CarriedFrame; 2], Vector3, f64), ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let normal = parameters.vector("normal")?;
    let ahead = parameters.vector("road_direction").ok();
    let axes = axes_of(&normal, ahead).ok_or_else(|| ParameterError::new("normal", "has no direction"))?;
    let frames = [0, 1].map(|side| {
        let node = model.frame(nodes[side]);
        let place = Motion::new(axes, node.transform_point(&points[side]));
        CarriedFrame { node: nodes[side], offset: place.relative_to(&node) }
    });
    let [plane, centre] = [0, 1].map(|side| model.frame(nodes[side]).transform_point(&points[side]));
    let height = axes.apply_inverse(&(centre - plane)).z;
    if height.abs() <= 0.0 {
        return Err(ParameterError::new("at_tip", "is in the plane: it must be the centre of the wheel"));
    }
    let axis = axes.apply_inverse(&parameters.vector("wheel_axis")?);
    let axis =
        axis.try_normalize(0.0).ok_or_else(|| ParameterError::new("wheel_axis", "has no direction"))?;
    if axis.z.abs() > 1.0 - 1e-6 {
        let problem = "is perpendicular to the plane: the wheel is flat on it and cannot roll";
        return Err(ParameterError::new("wheel_axis", problem));
    }
    Ok((frames, axis, height))
}

/// Axes with the third along a direction, and the first as close to another one as possible, if it has a part across it.
fn axes_of(normal: &Vector3, ahead: Option<Vector3>) -> Option<Rotation> {
    let third = normal.try_normalize(0.0)?;
    let across = |direction: Vector3| direction - third * third.dot(&direction);
    let mut other = Vector3::zeros();
    other[third.iamin()] = 1.0;
    let first = ahead.and_then(|ahead| across(ahead.normalize()).try_normalize(1e-6));
    let first = first.unwrap_or_else(|| across(other).normalize());
    Rotation::from_columns(&first, &third.cross(&first), &third)
}

fn traction(parameters: &Parameters) -> Result<Traction, ParameterError> {
    let wrong = |problem: String| Err(ParameterError::new("traction", problem));
    if !parameters.has("traction") {
        return Ok(Traction::Saturated {
            coefficient: parameters.number("friction_coefficient")?,
            velocity: parameters.number("slip_velocity")?,
        });
    }
    for other in ["friction_coefficient", "slip_velocity"] {
        if parameters.has(other) {
            return wrong(format!("replaces the law with `{other}`: remove one of them"));
        }
    }
    let function = parameters.function("traction")?;
    let at_rest = function.value(0.0);
    if at_rest.is_nan() || at_rest.abs() > 1e-12 {
        return wrong(format!("is {at_rest} without sliding: it must be zero there"));
    }
    for exponent in -30..=20 {
        let slip = 10.0_f64.powf(0.1 * f64::from(exponent));
        let value = function.value(slip);
        if value.is_nan() || value < 0.0 {
            return wrong(format!("is {value} at a slip of {slip:.3} m/s: negative friction would drive"));
        }
    }
    Ok(Traction::Given(function))
}

fn resistance(parameters: &Parameters) -> Result<Option<RollingResistance>, ParameterError> {
    let [arm, damping] = [parameters.number("rolling_friction")?, parameters.number("rolling_damping")?];
    if parameters.has("rolling_rate") && arm == 0.0 {
        return Err(ParameterError::new("rolling_rate", "has no meaning without `rolling_friction`"));
    }
    let rate = parameters.number("rolling_rate")?;
    Ok((arm > 0.0 || damping > 0.0).then_some(RollingResistance { arm, damping, rate }))
}

/// Forces between wheel and plane.
struct Touch {
    motion: RelativeMotion,
    /// b_n.
    normal_row: Vector6,
    rows: [Vector6; DIRECTIONS],
    gap: f64,
    gap_rate: f64,
    /// Components along both directions, with rollers along their axis.
    sliding: [f64; DIRECTIONS],
    rollers: Option<Rollers>,
    /// N with its derivatives by gap and rate.
    normal: [f64; 3],
    /// μ/σ, and its derivative with respect to σ, over σ.
    traction: (f64, f64),
    /// Without rolling friction none.
    rolling: Option<Rolling>,
    /// On the left-hand side, on the tip's frame.
    wrench: Vector6,
}

/// Rollers in contact.
struct Rollers {
    /// cos β, sin β.
    along: [f64; DIRECTIONS],
    /// Sliding velocity across their axis.
    across: f64,
    /// ∂β/∂η.
    turning: Vector6,
}

/// Rolling friction.
struct Rolling {
    /// r_k.
    rows: [Vector6; DIRECTIONS],
    /// ω_k.
    rates: [f64; DIRECTIONS],
    /// ν/ω, and its derivative with respect to ω, over ω.
    resistance: (f64, f64),
}

impl Rolling {
    /// Σ ν/ω ω_k r_k.
    fn direction(&self) -> Vector6 {
        self.resistance.0 * (self.rates[0] * self.rows[0] + self.rates[1] * self.rows[1])
    }
}

impl RollingContact {
    fn touch(&self, at: &Kinematics) -> Touch {
        let motion = self.frames.motion(at);
        let (gap, normal_row) = self.contact.gap(&motion.rotation, &motion.position);
        let rows = self.contact.rows(&motion.rotation, gap);
        let gap_rate = normal_row.dot(&motion.twist);
        let mut sliding = rows.map(|row| row.dot(&motion.twist));
        let rollers = self.roller_angle.map(|angle| self.rollers(angle, &motion, sliding));
        if let Some(Rollers { along, .. }) = &rollers {
            let speed = sliding[0] * along[0] + sliding[1] * along[1];
            sliding = along.map(|own| speed * own);
        }
        let normal = if is_on_upper_branch(self.switch_states.of(at).first(), -gap) {
            let [force, by_depth, by_closing] =
                self.compliance.damped_force(-gap, -gap_rate, self.dissipation);
            [force, -by_depth, -by_closing]
        } else {
            [0.0; 3]
        };
        let traction = self.traction.per_velocity(sliding[0].hypot(sliding[1]));
        let friction = normal[0] * traction.0;
        let mut wrench =
            -normal[0] * normal_row + friction * sliding[0] * rows[0] + friction * sliding[1] * rows[1];
        let rolling = self.resistance.as_ref().map(|resistance| self.rolling(resistance, &motion));
        if let Some(rolling) = &rolling {
            wrench += normal[0] * rolling.direction();
        }
        Touch { motion, normal_row, rows, gap, gap_rate, sliding, rollers, normal, traction, rolling, wrench }
    }

    fn rollers(&self, angle: f64, motion: &RelativeMotion, sliding: [f64; DIRECTIONS]) -> Rollers {
        let axis = motion.rotation * self.contact.axis;
        let (sine, cosine) = (axis.y.atan2(axis.x) + angle).sin_cos();
        // δ(R a) = -R a~ η_θ
        let turned = -motion.rotation * skew(&self.contact.axis);
        let row = (axis.x * turned.row(1) - axis.y * turned.row(0)) / (axis.x * axis.x + axis.y * axis.y);
        Rollers {
            along: [cosine, sine],
            across: cosine * sliding[1] - sine * sliding[0],
            turning: screw(&Vector3::zeros(), &row.transpose()),
        }
    }

    fn is_ball(&self) -> bool {
        self.contact.radius == 0.0
    }

    fn rolling(&self, resistance: &RollingResistance, motion: &RelativeMotion) -> Rolling {
        let about = |axis: &Vector3| screw(&Vector3::zeros(), axis);
        let rows = if self.is_ball() {
            [0, 1].map(|k| about(&motion.rotation.row(k).transpose()))
        } else {
            [about(&self.contact.axis), Vector6::zeros()]
        };
        let rates = rows.map(|row| row.dot(&motion.twist));
        Rolling { rows, rates, resistance: resistance.per_rate(rates[0].hypot(rates[1])) }
    }

    /// ∂(N Σ ν/ω ω_k r_k)/∂η at a constant N, and with respect to η̇.
    fn rolling_by(&self, touch: &Touch, rolling: &Rolling) -> [Matrix6; 2] {
        let Rolling { rows, rates, resistance: (ratio, bend) } = rolling;
        let (force, motion) = (touch.normal[0], &touch.motion);
        let (mut by_place, mut by_rate) = (Matrix6::zeros(), Matrix6::zeros());
        let bracket = lie_bracket_matrix(&motion.carried);
        // T_k is fixed in the base, a in the tip: ∂T_k/∂η_θ = T̃_k.
        let turned = |row: &Vector6| {
            let mut of = Matrix6::zeros();
            if self.is_ball() {
                of.fixed_view_mut::<3, 3>(3, 3).copy_from(&skew(&rotation_part(row)));
            }
            of
        };
        let rates_by = rows.map(|row| turned(&row).tr_mul(&motion.twist) - bracket.tr_mul(&row));
        for k in 0..DIRECTIONS {
            by_place += force * ratio * rates[k] * turned(&rows[k]);
            for l in 0..DIRECTIONS {
                let same = if k == l { *ratio } else { 0.0 };
                let slope = force * (same + bend * rates[k] * rates[l]);
                by_place += slope * rows[k] * rates_by[l].transpose();
                by_rate += slope * rows[k] * rows[l].transpose();
            }
        }
        [by_place, by_rate]
    }

    /// Derivative of the gap's rate with respect to η at fixed twists of the nodes: δη̇ = -ad(A V_base) η.
    fn closing(&self, Touch { motion, normal_row, .. }: &Touch) -> Vector6 {
        let hessian = self.contact.gap_hessian(&motion.rotation);
        hessian.tr_mul(&motion.twist) - lie_bracket_matrix(&motion.carried).tr_mul(normal_row)
    }
}

impl Element for RollingContact {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.frames.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let touch = self.touch(at);
        self.frames.add_wrench(&touch.motion, &touch.wrench, out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let touch = self.touch(at);
        let Touch { motion, normal_row, rows, sliding, normal, .. } = &touch;
        let ([force, by_gap, by_gap_rate], (ratio, bend)) = (*normal, touch.traction);
        let frictions = sliding.map(|own| force * ratio * own);
        let (mut by_place, turns) =
            self.contact.derivatives(&motion.rotation, (touch.gap, normal_row), &frictions, &motion.twist);
        let hessian = self.contact.gap_hessian(&motion.rotation);
        by_place -= force * hessian;
        // Changes of rates at fixed twists of the nodes: δη̇ = -ad(A V_base) η.
        let bracket = lie_bracket_matrix(&motion.carried);
        let mut slides = [0, 1].map(|k| turns[k] - bracket.tr_mul(&rows[k]));
        let mut rows = *rows;
        let mut sliding = *sliding;
        if let Some(Rollers { along, across, turning }) = &touch.rollers {
            // In the axes of the rollers there is one direction.
            let speed = sliding[0] * along[0] + sliding[1] * along[1];
            let [first, second] = rows;
            rows = [along[0] * first + along[1] * second, Vector6::zeros()];
            let sideways = along[0] * second - along[1] * first;
            by_place += force * ratio * speed * sideways * turning.transpose();
            slides = [along[0] * slides[0] + along[1] * slides[1] + *across * turning, Vector6::zeros()];
            sliding = [speed, 0.0];
        }
        let closing = self.closing(&touch);
        let force_by_place = by_gap * normal_row + by_gap_rate * closing;
        let force_by_rate = by_gap_rate * normal_row;
        let mut direction = -normal_row + ratio * (sliding[0] * rows[0] + sliding[1] * rows[1]);
        if let Some(rolling) = &touch.rolling {
            direction += rolling.direction();
        }
        by_place += direction * force_by_place.transpose();
        let mut by_rate: Matrix6 = direction * force_by_rate.transpose();
        for k in 0..DIRECTIONS {
            for l in 0..DIRECTIONS {
                let same = if k == l { ratio } else { 0.0 };
                let slope = force * (same + bend * sliding[k] * sliding[l]);
                by_place += slope * rows[k] * slides[l].transpose();
                by_rate += slope * rows[k] * rows[l].transpose();
            }
        }
        if let Some(rolling) = &touch.rolling {
            let [more_by_place, more_by_rate] = self.rolling_by(&touch, rolling);
            by_place += more_by_place;
            by_rate += more_by_rate;
        }
        let size = out.size();
        self.frames.add_stiffness(motion, (&touch.wrench, &by_place), (size, &mut out.stiffness));
        self.frames.add_damping(motion, &by_rate, (size, &mut out.damping));
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let touch = self.touch(at);
        let depth = if touch.normal[0] > 0.0 || touch.gap < 0.0 { touch.gap } else { 0.0 };
        Energy { strain: self.compliance.energy(-depth), ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        let frames = Some(self.frames.frames);
        Capabilities { spring: Some(self), frames, laws: Some(self), ..Capabilities::default() }
    }
}

impl Spring for RollingContact {
    fn dissipates(&self) -> bool {
        true
    }

    /// Gap, its rate and the normal force.
    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let touch = self.touch(at);
        [touch.gap, touch.gap_rate, touch.normal[0]]
    }

    fn spring_gradients(&self, at: &Kinematics) -> Option<[Gradient; 3]> {
        let touch = self.touch(at);
        let closing = self.closing(&touch);
        let (mut gap, mut rate) = (Gradient::zero(), Gradient::zero());
        for (j, columns) in self.frames.columns(&touch.motion).iter().enumerate() {
            let slots = 6 * j..6 * j + 6;
            gap.by_place[slots.clone()].copy_from_slice(columns.tr_mul(&touch.normal_row).as_slice());
            rate.by_place[slots].copy_from_slice(columns.tr_mul(&closing).as_slice());
        }
        rate.by_rate = gap.by_place;
        let [force, stiffness, damping] = touch.normal;
        Some(Response { force, stiffness, damping }.gradients([gap, rate]))
    }
}

impl ForceLaws for RollingContact {
    fn switch_count(&self) -> usize {
        1
    }

    fn is_idle(&self, at: &Kinematics) -> bool {
        frozen_branch(self.switch_states.of(at).first()) == Some(false)
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let relative = self.frames.relative(at);
        let (gap, _) = self.contact.gap(&relative.rotation.matrix(), &relative.position);
        out.push((-gap).into());
    }
}
