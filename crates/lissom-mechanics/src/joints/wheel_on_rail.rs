//! A wheel that rolls on a rail: it remains in contact, with creep.
//!
//! ```text
//! c = g - g_start,      ∂c/∂η = (N, p × N)
//! ```
//!
//! g gap along the common normal N, p point of contact from the tip's origin, both in the tip's axes: see [`contact`]. The
//! multiplier is the normal force, positive if it pulls. Creep forces depend on it, see `elements::creep_force`.

use lissom_motion::{Motion, Rotation, Vector3, Vector6};
use nalgebra::SVector;

use super::attached::AttachedJoint;
use super::blocks::Batches;
use super::kind::{Build, Geometry, JointKind};
use super::{
    AnyJoint, ConstraintHessian, Coordinate, Equations, Gradient, JointCoordinates, MAX_COORDINATES, Relative,
};
use crate::kinematics::Quantity;
use crate::ports::Ports;
use crate::registry::ParameterType::{NotNegative, Number, Positive};
use crate::registry::{Function, ParameterError, ParameterType, Parameters, optional, unitless};
use crate::round_off;
use crate::wheels::CreepLaw;
use crate::wheels::profile::{RailProfile, WheelProfile};
use crate::wheels::wheel_on_plane::Contact;
use crate::wheels::wheel_on_rail::{Pose, RailContact};

/// Default half width of a tread, in radii of the wheel.
const TREAD: f64 = 0.5;

/// Parameters that are used only with creep.
const OF_CREEP: [&str; 7] =
    ["shear_modulus", "poisson_number", "kalker", "ellipse", "velocity", "wheel_spin", "directions"];

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "wheel_on_rail",
    summary: "A wheel rolls on a straight rail of the base without lifting off, with creep forces if they are specified.",
    sample: "axis = [1.0, 0.0, 0.0]\nsecond_axis = [0.0, 0.0, 1.0]\nhead_radius = 0.3",
    parameters: &[
        unitless(
            "axle",
            ParameterType::Direction,
            "Axis of the wheel at the start, global axes, through the tip's position; default: `axis`.",
        ),
        optional(
            "radius",
            Positive,
            "m",
            "Radius of the wheel at its nominal circle; default: the one with which it touches the rail at the start.",
        ),
        optional(
            "offset",
            Number,
            "m",
            "Distance of the nominal circle from the tip's position along the wheel's axis, outwards positive; default: that of the \
            rail's point `at` at the start.",
        ),
        optional(
            "cone_angle",
            Number,
            "rad",
            "Cone angle of the wheel: its radius decreases outwards.",
        ).or_number(0.0),
        optional(
            "wheel_profile",
            ParameterType::FunctionOf("y"),
            "m",
            "Instead of `cone_angle`: deviation from the nominal radius over the position `y` along the axis, outwards from the nominal \
            circle; requires `tread`.",
        ),
        optional(
            "tread",
            ParameterType::Range,
            "m",
            "Range of positions `y` at which the wheel may touch the rail; a warning reports contact outside; default: half the radius \
            in both directions.",
        ),
        optional(
            "head_radius",
            Positive,
            "m",
            "Radius of the rail's head, a circle through the point `at`.",
        ),
        optional(
            "cant",
            Number,
            "rad",
            "Angle by which the head rises outwards at the point `at`; default `cone_angle`.",
        ),
        optional(
            "rail_profile",
            ParameterType::FunctionOf("y"),
            "m",
            "Instead of `head_radius`: height of the rail over the lateral position `y`, outwards from the point `at`, where it is 0.",
        ),
        unitless(
            "friction_coefficient",
            Positive,
            "Limit of the creep force over the normal force; default: no creep forces.",
        ),
        optional(
            "shear_modulus",
            Positive,
            "N/m^2",
            "Shear modulus of wheel and rail, for creep forces.",
        ),
        unitless(
            "poisson_number",
            NotNegative,
            "Poisson's ratio.",
        ).or_number(0.28),
        unitless(
            "kalker",
            ParameterType::Vector,
            "Kalker's coefficients C11, C22 and C23 of longitudinal, lateral and spin creep.",
        ),
        unitless(
            "ellipse",
            ParameterType::Numbers,
            "Elliptic integral E and ratio g of the semi-axes of the contact ellipse, from tables; default: those of Hertz for the \
            nominal curvatures.",
        ),
        optional(
            "velocity",
            ParameterType::GlobalVector,
            "m/s",
            "Velocity of the base along the rail in global axes, for models in axes that move with a vehicle.",
        ).or_number(0.0),
        optional(
            "wheel_spin",
            Number,
            "rad/s",
            "Angular velocity of the wheel relative to the tip about `axle`, for tips that do not rotate with it.",
        ).or_number(0.0),
        unitless(
            "directions",
            ParameterType::Choice(&["exact", "small_angles"]),
            "Directions of creep forces: in the tangent plane, or those of Simeon, Fuehrer and Rentrop 1991.",
        )
        .or_word("exact"),
    ],
    ports: Ports::TWO_AXES,
    build: Build::Relative(|parameters, geometry| {
        let (contact, spin_sign) = contact_of(parameters, geometry)?;
        let creep = creep_of(parameters, geometry, &contact, spin_sign)?;
        let pose = start_pose(geometry);
        let start = contact.gap(&pose);
        Ok(Box::new(WheelOnRail { contact, creep, centre: geometry.span, start }))
    }),
};

fn start_pose(geometry: &Geometry) -> Pose<f64> {
    Pose::new(&Rotation::identity().matrix(), &geometry.span)
}

fn smooth(parameters: &Parameters, name: &str) -> Result<Function, ParameterError> {
    let function = parameters.function(name)?;
    match function.first_kink() {
        None => Ok(function),
        Some(kink) => {
            let at = if kink.is_nan() { String::new() } else { format!(" at y = {kink:.6}") };
            let problem = format!(
                "has a kink{at}: the normal would jump there; specify a table `interpolation = \"spline\"`, or another function"
            );
            Err(ParameterError::new(name, problem))
        }
    }
}

fn contact_of(parameters: &Parameters, geometry: &Geometry) -> Result<(RailContact, f64), ParameterError> {
    let given =
        geometry.axes.apply_inverse(&parameters.vector_or("axle", geometry.axes.apply(&Vector3::x()))?);
    let given = given.try_normalize(0.0).ok_or_else(|| ParameterError::new("axle", "has no direction"))?;
    if given.x.abs() < 0.5 {
        let problem = "must be within 60 degrees of `axis`, which is across the rail";
        return Err(ParameterError::new("axle", problem));
    }
    let outwards = given.x.signum();
    let axis = outwards * given;
    let height = geometry.span.y;
    if height == 0.0 {
        let problem = "must be above the rail, seen along `second_axis`";
        return Err(ParameterError::new("tip", problem));
    }
    let exclusive = |one: &str, other: &str| {
        if parameters.has(one) && parameters.has(other) {
            return Err(ParameterError::new(one, format!("replaces `{other}`: remove one of them")));
        }
        Ok(())
    };
    exclusive("wheel_profile", "cone_angle")?;
    exclusive("rail_profile", "head_radius")?;
    exclusive("rail_profile", "cant")?;
    let cone_angle = parameters.number("cone_angle")?;
    if cone_angle.abs() > 1.0 {
        return Err(ParameterError::new("cone_angle", "must be between -1 and 1 rad"));
    }
    let nominal = parameters.number_or("radius", height.abs())?;
    let tread = parameters.range("tread")?.unwrap_or([-TREAD * nominal, TREAD * nominal]);
    if !(tread[0].is_finite() && tread[1].is_finite() && tread[0] <= 0.0 && tread[1] >= 0.0) {
        return Err(ParameterError::new("tread", "must be finite and contain the nominal circle, y = 0"));
    }
    let wheel = if parameters.has("wheel_profile") {
        if !parameters.has("tread") {
            return Err(ParameterError::new("tread", "must be given with `wheel_profile`"));
        }
        WheelProfile::Given(smooth(parameters, "wheel_profile")?, tread[1] - tread[0])
    } else {
        WheelProfile::Cone(-cone_angle.tan())
    };
    let rail = if parameters.has("rail_profile") {
        RailProfile::Given(smooth(parameters, "rail_profile")?, tread[1] - tread[0])
    } else if parameters.has("head_radius") {
        let cant = parameters.number_or("cant", cone_angle)?;
        if cant.abs() > 1.0 {
            return Err(ParameterError::new("cant", "must be between -1 and 1 rad"));
        }
        RailProfile::Circle { radius: parameters.number("head_radius")?, cant }
    } else {
        return Err(ParameterError::new("head_radius", "or `rail_profile` must say what the rail's head is"));
    };
    let [height_at, ..] = rail.point(0.0);
    if height_at.abs() > round_off::GIVEN * nominal
        || rail.point(0.0_f64)[1].abs() > round_off::GIVEN * nominal
    {
        return Err(ParameterError::new("rail_profile", "must be 0 at y = 0, the point `at` of the rail"));
    }
    let mut contact = RailContact {
        axis,
        side: height.signum(),
        offset: parameters.number_or("offset", -geometry.span.dot(&axis))?,
        radius: nominal,
        wheel,
        rail,
        tread,
    };
    let pose = start_pose(geometry);
    if !parameters.has("radius") {
        // The gap decreases by nearly as much as the radius increases.
        for _ in 0..60 {
            contact.radius += contact.gap(&pose);
        }
    }
    let gap = contact.gap(&pose);
    if !(contact.radius > 0.0 && gap.abs() <= round_off::GIVEN * contact.radius) {
        let problem = format!(
            "says that the wheel is {gap:.9} m from the rail at the start (negative: within it): move the tip or the rail's point \
             `at`, or leave `radius` out"
        );
        return Err(ParameterError::new("radius", problem));
    }
    Ok((contact, outwards))
}

fn creep_of(
    parameters: &Parameters,
    geometry: &Geometry,
    contact: &RailContact,
    outwards: f64,
) -> Result<Option<CreepLaw>, ParameterError> {
    if !parameters.has("friction_coefficient") {
        return match OF_CREEP.into_iter().find(|name| parameters.has(name)) {
            Some(name) => {
                Err(ParameterError::new(name, "is one of creep forces, which need `friction_coefficient`"))
            }
            None => Ok(None),
        };
    }
    let kalker = parameters.vector("kalker")?;
    if kalker.iter().any(|value| *value < 0.0) {
        return Err(ParameterError::new("kalker", "must not be negative"));
    }
    let poisson = parameters.number("poisson_number")?;
    if poisson > 0.5 {
        return Err(ParameterError::new("poisson_number", "must not be larger than 0.5"));
    }
    let ellipse = if parameters.has("ellipse") {
        match parameters.numbers("ellipse")? {
            &[integral, ratio] if integral > 0.0 && ratio > 0.0 => [integral, ratio],
            _ => return Err(ParameterError::new("ellipse", "must be two positive numbers, E and g")),
        }
    } else {
        contact.hertz_ellipse(&start_pose(geometry))
    };
    let velocity = geometry.axes.apply_inverse(&parameters.vector_or("velocity", Vector3::zeros())?);
    if velocity.xy().norm() > 1e-9 * velocity.norm() {
        let problem = "must go along the rail, across `axis` and `second_axis`";
        return Err(ParameterError::new("velocity", problem));
    }
    Ok(Some(CreepLaw {
        shear_modulus: parameters.number("shear_modulus")?,
        poisson,
        friction: parameters.number("friction_coefficient")?,
        kalker: kalker.into(),
        ellipse,
        velocity: velocity.z,
        spin: outwards * parameters.number("wheel_spin")?,
        small_angles: parameters.word("directions")? == "small_angles",
    }))
}

/// The gap between a wheel and a rail.
#[derive(Clone, Debug)]
pub struct WheelOnRail {
    contact: RailContact,
    creep: Option<CreepLaw>,
    /// The tip at the start, in the base's axes [m].
    centre: Vector3,
    /// The gap at the start, round-off of the given positions [m].
    start: f64,
}

fn pose_of(relative: &Relative) -> Pose<f64> {
    Pose::new(&relative.rotation, &relative.position)
}

impl AnyJoint for WheelOnRail {
    fn equations(&self) -> &'static [&'static str] {
        &["distance from the rail"]
    }

    fn equation_quantity(&self, _: usize) -> Quantity {
        Quantity::Length
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        &[]
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        ([0.0; MAX_COORDINATES], Motion::new(Rotation::identity(), self.centre))
    }

    fn contact(&self) -> Option<Contact> {
        None
    }

    fn rail_contact(&self) -> Option<&RailContact> {
        Some(&self.contact)
    }

    fn creep(&self) -> Option<&CreepLaw> {
        self.creep.as_ref()
    }

    fn violation(&self, relative: &Relative, _: &JointCoordinates) -> Equations {
        let mut out = Equations::default();
        out[0] = self.contact.gap(&pose_of(relative)) - self.start;
        out
    }

    fn violation_change(&self, relative: &Relative, _: &JointCoordinates) -> Equations {
        let before = Pose::new(&relative.start_rotation(), &(relative.position - relative.position_change));
        let mut out = Equations::default();
        out[0] = self.contact.gap(&pose_of(relative)) - self.contact.gap(&before);
        out
    }

    fn wrench(
        &self,
        relative: &Relative,
        _: &JointCoordinates,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MAX_COORDINATES>) {
        let pose = pose_of(relative);
        let row = self.contact.row(&pose, &self.contact.place(&pose).place);
        (mu[0] * Vector6::from(row), SVector::zeros())
    }

    fn gradient(&self, relative: &Relative, _: &JointCoordinates, out: &mut Gradient) {
        let pose = pose_of(relative);
        let row = self.contact.row(&pose, &self.contact.place(&pose).place);
        for (k, value) in row.into_iter().enumerate() {
            out.relative[(0, k)] = value;
        }
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        _: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        let pose = pose_of(relative);
        let varied = pose.varied::<6>();
        let row = self.contact.row(&varied, &self.contact.varied_place(&pose, &varied));
        for (i, value) in row.iter().enumerate() {
            for (j, by) in value.by.iter().enumerate() {
                out[(i, j)] += mu[0] * by;
            }
        }
    }

    fn enter(&self, index: usize, attached: &AttachedJoint, batches: &mut Batches) {
        batches.enter_scalar(index, attached.with_joint(Box::new(self.clone())));
    }
}
