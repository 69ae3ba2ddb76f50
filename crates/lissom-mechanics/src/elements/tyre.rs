//! A tyre on a plane road: brush model of the tread, with the deflection of carcass and tread as states.
//!
//! Legend: in axes of the road: c centre and h its height, n normal, a axis of the wheel, γ camber angle, sin γ = a·n, R free radius, δ
//! deflection, Ω = a·ω, P centre of contact, v_P velocity of the wheel there, x = a × n/cos γ direction of rolling, y = n × x; N normal force, μ
//! friction, e deflections (states), σ relaxation lengths, ε deflections over them, c stiffness per slip and normal force, τ damping time, t trail.
//!
//! ```text
//! δ = R cos γ - h,    N = max(0, k δ + d δ̇),    R_e = R - δ/3,    V = (x·v_P + Ω h/cos γ, y·v_P)
//! s = (V₁ - Ω R_e, V₂),    w⁴ = V₁⁴ + s⁴,    e' = -s - w e/σ,    ε = (e + τ e'/(1 + w/w₀))/σ
//! q = (c₁ ε₁, c₂ ε₂ - c_γ sin γ),    p = |q|/(3 μ),    F = N q (3 - 3 p + p²)/3,   beyond p = 1 μ N q/|q|
//! t = t₀ (1 - p)³/(1 - p + p²/3),    M_n = -t F₂ V₁/(V₁² + v₀²)^½,    M_a = -f N R_e tanh(Ω R_e/v₀)
//! ```
//!
//! [Pacejka 2012, chapters 3, 7 and 8]. The parabola of pressure makes the sum of forces of a brush this cubic, and the force of the tread
//! acts behind the centre of contact. In steady rolling ε₁ is the longitudinal slip and ε₂ the tangent of the slip angle. At standstill the states
//! keep the force, without creep. The longitudinal force acts at the effective radius R_e, at which the wheel rolls without it.

use lissom_motion::{Matrix6, Vector3, Vector6, lie_bracket_matrix};
use nalgebra::SMatrix;

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::rolling_contact::on_plane;
use super::{Capabilities, Element, ForceLaws, Load, Spring, Tangents, Unknowns, add_block};
use crate::dual::{Dual, Number, cross, dot, sum, times};
use crate::evaluation::switch_states::{SwitchStates, frozen_branch, is_on_upper_branch};
use crate::joints::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::{CoordinateId, Kinematics, Switch};
use crate::ports::Ports;
use crate::registry::ParameterType::{Direction, NotNegative, Positive};
use crate::registry::{ParameterError, Parameters, optional, required, unitless};
use crate::signals::measurement::Gradient;
use crate::wheels::wheel_on_rail::Pose;

/// With derivatives by the tip's variation, its twist relative to the base, and the states.
type Varied = Dual<14>;
/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "tyre",
    summary: "A tyre on a plane road: brush model with combined slip, relaxation, camber, trail and standstill without creep.",
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
        ),
        required("stiffness", Positive, "N/m", "Normal force per deflection."),
        optional("damping", NotNegative, "N s/m", "Normal force per deflection rate.").or_number(0.0),
        unitless(
            "friction_coefficient",
            Positive,
            "Coefficient of friction; that of dry asphalt is the default.",
        )
        .or_number(0.9),
        required(
            "slip_stiffness",
            Positive,
            "",
            "Longitudinal force per slip and normal force, at small slip.",
        ),
        required(
            "cornering_stiffness",
            Positive,
            "",
            "Lateral force per slip angle and normal force, at small angles.",
        ),
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
    ],
    ports: Ports::TWO_FRAMES,
    build,
};

/// A tyre.
#[derive(Clone, Debug)]
pub struct Tyre {
    frames: FramePair,
    /// Deflections of the tread along and across the rolling.
    states: [CoordinateId; 2],
    /// a, in the tip's axes.
    axis: Vector3,
    /// On which side of the road, along its normal.
    side: f64,
    law: TyreLaw,
    switch_states: SwitchStates,
}

/// Forces of a tyre over its slip.
#[derive(Clone, Copy, Debug)]
struct TyreLaw {
    radius: f64,
    /// k and d.
    normal: [f64; 2],
    /// μ, and its decrease with the normal force.
    friction: [f64; 2],
    /// c₁, c₂ and c_γ.
    slip: [f64; 3],
    /// t₀.
    trail: f64,
    /// σ.
    relaxation: [f64; 2],
    /// τ.
    damping_time: f64,
    /// f.
    resistance: f64,
    /// v₀ [m/s].
    slow: f64,
}

/// Forces and rates of a tyre.
struct Touch<T> {
    /// δ, δ̇ and N.
    normal: [T; 3],
    /// On the tip, in its axes.
    wrench: [T; 6],
    /// -e'.
    falling: [T; 2],
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (frames, axis, height) = on_plane(model, attached, parameters)?;
    let number = |key| parameters.number(key);
    let radius = parameters.number_or("radius", height.abs() / (1.0 - axis.z * axis.z).sqrt())?;
    let law = TyreLaw {
        radius,
        normal: [number("stiffness")?, number("damping")?],
        friction: [number("friction_coefficient")?, number("load_sensitivity")?],
        slip: [number("slip_stiffness")?, number("cornering_stiffness")?, number("camber_stiffness")?],
        trail: parameters.number_or("pneumatic_trail", 0.1 * radius)?,
        relaxation: [
            parameters.number_or("longitudinal_relaxation_length", 0.5 * radius)?,
            parameters.number_or("relaxation_length", radius)?,
        ],
        damping_time: number("damping_time")?,
        resistance: number("rolling_resistance")?,
        slow: 0.3,
    };
    let mut contribution = Contribution::to(model);
    let states = ["along", "across"].map(|word| {
        contribution.add_state(format!("{}, tyre {word}", model.nodes[frames[1].node].name), 0.0, 0.01)
    });
    let switch_states = SwitchStates::default();
    let frames = FramePair::new(frames);
    Ok(contribution.with(Tyre { frames, states, axis, side: height.signum(), law, switch_states }))
}

impl TyreLaw {
    /// F and M_n for these slips, normal force, camber and rolling velocity.
    fn tread<T: Number>(&self, slips: [T; 2], normal: T, lean: T, rolling: T) -> ([T; 2], T) {
        let [along, across, camber] = self.slip;
        let pull = [slips[0].scaled(along), slips[1].scaled(across) - lean.scaled(camber)];
        let size = (pull[0] * pull[0] + pull[1] * pull[1]).plus(1e-24).square_root();
        let friction = T::constant(self.friction[0]) / normal.scaled(self.friction[1]).plus(1.0);
        let part = size / friction.scaled(3.0);
        let one = T::constant(1.0);
        if part.value() >= 1.0 {
            return (pull.map(|pull| normal * friction * pull / size), T::constant(0.0));
        }
        let share = (part * part - part.scaled(3.0)).plus(3.0).scaled(1.0 / 3.0);
        let force = pull.map(|pull| normal * pull * share);
        let rest = one - part;
        let trail = (rest * rest * rest / (rest + (part * part).scaled(1.0 / 3.0))).scaled(self.trail);
        let forwards = rolling / (rolling * rolling).plus(self.slow * self.slow).square_root();
        (force, -trail * force[1] * forwards)
    }
}

impl Tyre {
    fn touch<T: Number>(
        &self,
        (pose, twist): (&Pose<T>, &[T; 6]),
        states: [T; 2],
        touches: bool,
    ) -> Touch<T> {
        let zero = T::constant(0.0);
        let normal = [0.0, 0.0, self.side].map(T::constant);
        let axis = pose.apply([0, 1, 2].map(|k| T::constant(self.axis[k])));
        let height = pose.position[2].scaled(self.side);
        let lean = dot(axis, normal);
        let cosine = (T::constant(1.0) - lean * lean).square_root();
        let depth = cosine.scaled(self.law.radius) - height;
        let [vx, vy, vz, wx, wy, wz] = *twist;
        let turning = pose.apply([wx, wy, wz]);
        // From the centre to P, along the wheel's plane.
        let loaded = height / cosine;
        let upwards = times(sum(normal, times(axis, -lean)), T::constant(1.0) / cosine);
        let arm = times(upwards, -loaded);
        let velocity = sum(pose.apply([vx, vy, vz]), cross(turning, arm));
        let deepening = -dot(normal, velocity);
        let along = times(cross(axis, normal), T::constant(1.0) / cosine);
        let across = cross(normal, along);
        let spin = dot(turning, axis);
        let effective = T::constant(self.law.radius) - depth.scaled(1.0 / 3.0);
        let rolling = dot(along, velocity) + spin * loaded;
        let slides = [rolling - spin * effective, dot(across, velocity)];
        let [stiffness, damping] = self.law.normal;
        let pressed = depth.scaled(stiffness) + deepening.scaled(damping);
        if !touches || pressed.value() <= 0.0 {
            // Deflections vanish in the air within some 50 ms.
            let falling = states.map(|state| state.scaled(20.0));
            return Touch { normal: [depth, deepening, zero], wrench: [zero; 6], falling };
        }
        let square = slides[0] * slides[0] + slides[1] * slides[1];
        let carried = rolling * rolling;
        let passing = (carried * carried + square * square).plus(f64::MIN_POSITIVE).power(0.25);
        // w₀ is 1 m/s.
        let fading = T::constant(self.law.damping_time) / passing.plus(1.0);
        let falling = [0, 1].map(|k| slides[k] + passing * states[k].scaled(1.0 / self.law.relaxation[k]));
        let slips = [0, 1].map(|k| (states[k] - fading * falling[k]).scaled(1.0 / self.law.relaxation[k]));
        let ([pull, side_force], aligning) = self.law.tread(slips, pressed, lean, rolling);
        let resisting = (spin * effective).scaled(1.0 / self.law.slow).hyperbolic_tangent();
        let resisting = (pressed * effective * resisting).scaled(-self.law.resistance);
        let force = sum(times(normal, pressed), sum(times(along, pull), times(across, side_force)));
        // The longitudinal force acts at the effective radius.
        let about_axis = pull * (loaded - effective) + resisting;
        let moment = sum(cross(arm, force), sum(times(normal, aligning), times(axis, about_axis)));
        let [force, moment] = [pose.apply_inverse(force), pose.apply_inverse(moment)];
        let wrench = [force[0], force[1], force[2], moment[0], moment[1], moment[2]];
        Touch { normal: [depth, deepening, pressed], wrench, falling }
    }

    fn touches(&self, at: &Kinematics, motion: &RelativeMotion) -> bool {
        is_on_upper_branch(self.switch_states.of(at).first(), self.depth(&motion.rotation, &motion.position))
    }

    fn depth(&self, rotation: &lissom_motion::Matrix3, position: &Vector3) -> f64 {
        let lean = (rotation * self.axis).z;
        (1.0 - lean * lean).max(0.0).sqrt() * self.law.radius - self.side * position.z
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

/// Derivatives of a number with respect to η, at fixed twists of the nodes, and η̇. Changes of the relative twist: δη̇ = -ad(A V_base) η.
fn of_motion(value: &Varied, motion: &RelativeMotion) -> [Vector6; 2] {
    let [place, rate] = [0, 6].map(|first| Vector6::from_column_slice(&value.by[first..first + 6]));
    [place - lie_bracket_matrix(&motion.carried).tr_mul(&rate), rate]
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
            laws: Some(self),
            frames: Some(self.frames.frames),
            ..Capabilities::default()
        }
    }
}

impl Load for Tyre {
    fn depends_on_motion(&self) -> bool {
        true
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

    fn spring_gradients(&self, at: &Kinematics) -> [Gradient; 3] {
        let (motion, touch) = self.varied(at);
        let columns = self.frames.columns(&motion);
        let [depth, rate, force] = touch.normal;
        [-depth, -rate, force].map(|value| {
            let mut gradient = Gradient::zero();
            let [place, by_rate] = of_motion(&value, &motion);
            for (j, columns) in columns.iter().enumerate() {
                let slots = 6 * j..6 * j + 6;
                gradient.by_place[slots.clone()].copy_from_slice(columns.tr_mul(&place).as_slice());
                gradient.by_rate[slots].copy_from_slice(columns.tr_mul(&by_rate).as_slice());
            }
            gradient
        })
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
