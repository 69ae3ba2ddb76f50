//! Synonyms of the words of a model file in other programs and textbooks.

/// A word of the model file, and other words for it in small letters.
const OTHERS: &[(&str, &[&str])] = &[
    ("acceleration", &["accelerometer", "imu"]),
    ("analysis", &["simulation", "settings", "solution"]),
    ("angle", &["drive", "motor", "rotation"]),
    ("angular_velocity", &["spin", "rotation_speed", "gyro", "gyroscope", "imu"]),
    ("at", &["position", "location", "point", "origin", "pos", "place"]),
    ("axial", &["linear", "translational", "tsda", "spring_damper"]),
    ("axial_friction", &["friction", "coulomb", "coulomb_friction"]),
    ("axial_stop", &["stop", "end_stop", "bump_stop", "limit"]),
    ("base", &["parent", "body1", "body_1", "body_a", "first"]),
    ("bodies", &["body", "rigid_bodies", "links", "link"]),
    ("bushing", &["bush", "mount", "elastomer", "six_dof_spring"]),
    ("cardan_angles", &["euler_angles", "roll_pitch_yaw", "rpy"]),
    ("circle", &["round", "circular", "disc", "rod"]),
    ("clamp", &["fixed", "fix", "weld", "rigid", "lock"]),
    ("damping", &["c", "damper", "viscosity"]),
    ("density", &["rho", "specific_mass"]),
    ("displacement", &["drive", "motor"]),
    ("distance", &["rod", "massless_rod"]),
    ("dynamics", &["transient", "time_integration", "motion", "time"]),
    ("E", &["youngs_modulus", "young_modulus", "young", "modulus", "elastic_modulus"]),
    ("end", &["duration", "t_end", "tend", "end_time", "stop_time", "final_time"]),
    ("G", &["shear_modulus"]),
    ("inertia", &["moment_of_inertia", "moments_of_inertia", "inertia_tensor", "j"]),
    ("initial", &["initial_conditions", "start", "ic"]),
    ("joint_force", &["actuator_force", "linear_actuator", "cylinder_force"]),
    ("joint_torque", &["joint_moment", "motor", "motor_torque", "actuator", "torque_on_joint"]),
    ("loads", &["forces", "force", "moments"]),
    ("mass", &["m", "weight"]),
    ("mean_motion", &["rbe3", "distributing_coupling", "distributed_coupling", "averaged_interface"]),
    ("modes", &["modal", "eigenvalues", "eigenmodes", "frequencies"]),
    ("nu", &["poisson", "poissons_ratio", "poisson_ratio"]),
    ("on", &["body", "node", "part", "attached_to"]),
    ("outputs", &["results", "sensors", "measures", "plots", "requests"]),
    ("point", &["spring", "point_to_point", "spring_between_points"]),
    ("position", &["at", "location", "origin", "pos", "place"]),
    ("prismatic", &["slide", "sliding", "translational", "linear", "translation"]),
    ("quaternion", &["orientation", "attitude", "euler_parameters"]),
    (
        "reaction",
        &[
            "joint_force",
            "joint_torque",
            "joint_reaction",
            "reaction_force",
            "constraint_force",
            "bearing_force",
            "force",
            "moment",
            "torque",
        ],
    ),
    ("recovered", &["stress", "stresses", "recovery"]),
    ("rectangle", &["rectangular", "box", "rect", "square"]),
    ("relative", &["joint_angle", "joint_position", "joint_coordinate", "coordinate"]),
    ("revolute", &["hinge", "pin", "rotational", "rotary", "continuous", "turning"]),
    ("rolling_contact", &["contact", "wheel"]),
    ("tyre", &["tire", "wheel", "pacejka", "magic_formula"]),
    ("rope", &["cable", "tendon", "wire", "belt", "sheave", "pulley", "drum", "winch", "hoist", "reeving"]),
    ("scheme", &["integrator", "method", "algorithm"]),
    ("sections", &["cross_sections", "cross_section", "profiles"]),
    ("section_force", &["normal_force", "axial_force", "shear_force"]),
    ("section_moment", &["bending_moment", "torsion"]),
    ("spherical", &["ball", "ball_joint", "ball_and_socket"]),
    ("spring", &["spring_force"]),
    ("statics", &["static", "equilibrium", "quasistatic"]),
    ("step", &["dt", "h", "time_step", "timestep", "step_size"]),
    ("stiffness", &["k", "spring_rate", "spring_constant"]),
    ("tip", &["child", "body2", "body_2", "body_b", "second"]),
    ("torsional", &["rotational", "rotary", "angular", "rsda"]),
    ("tube", &["pipe", "hollow_circle", "ring"]),
    ("universal", &["hooke", "cardan", "u_joint"]),
    ("vector", &["force", "moment", "torque", "value"]),
    ("velocity", &["speed", "v"]),
];

/// The first known word that others call `word`.
pub(crate) fn known_for<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    all_known_for(word, known).first().copied()
}

/// The known words that others call `word`.
pub(crate) fn all_known_for<'a>(word: &str, known: &[&'a str]) -> Vec<&'a str> {
    let small = word.to_lowercase();
    OTHERS
        .iter()
        .filter(|(_, others)| others.contains(&small.as_str()))
        .filter_map(|(own, _)| known.iter().find(|known| *known == own).copied())
        .collect()
}

/// Replacement of a word without a single synonym.
pub(crate) fn remedy(word: &str, known: &[&str]) -> Option<String> {
    let is_known = |name: &str| known.contains(&name);
    match word.to_lowercase().as_str() {
        "velocity" | "angular_velocity" if is_known("section") || is_known("interfaces") => Some(
            "velocities of flexible parts are those of `[initial]`, or of an entry such as `[initial.motion]` that names them in \
             `parts`"
                .to_owned(),
        ),
        "diameter" if is_known("radius") => Some("write `radius`, half of the diameter".to_owned()),
        "gravity" | "weight" if is_known("joint_torque") => {
            Some("weight is no load: write `gravity = [0, 0, -9.81]` at the top of the file".to_owned())
        }
        "equilibrium" | "steady_rotation" if is_known("scheme") => Some("it is a key of `[initial]`".to_owned()),
        "connect" | "connects" | "between" | "nodes" if is_known("base") && is_known("tip") => {
            Some("write its two ends as `base` and `tip`".to_owned())
        }
        "drives" | "drive" | "motors" | "motor" | "actuators" if is_known("lissom") => Some(
            "a prescribed motion is an entry of `[joints]` with `kind = \"prescribed_rotation\"` and the `joint` that it moves; a torque or \
             a force is one of `[loads]`, such as `kind = \"joint_torque\"`"
                .to_owned(),
        ),
        "capsule" if is_known("sides") => {
            Some("write `kind = \"capsule\"`, with a `radius` and a `length`".to_owned())
        }
        "t" | "time" if is_known("pi") && !is_known("t") => Some(
            "this number is constant: what changes with time is another key, such as `scale` of a load".to_owned(),
        ),
        "unit" if is_known("lissom") => Some(
            "units cannot be specified: remove it, and write lengths in m, masses in kg, times in s, forces in N and angles \
             in rad"
                .to_owned(),
        ),
        _ => None,
    }
}

/// Replacement of a unit in an expression.
pub(crate) fn instead_of_unit(word: &str) -> Option<&'static str> {
    Some(match word {
        "deg" | "degree" | "degrees" => "angles are in radians: write `30*pi/180` for 30 degrees",
        "rpm" => "angular velocities are in rad/s: write `40*2*pi/60` for 40 turns per minute",
        "rad" => "angles are in radians: remove the unit",
        "kg" | "g" | "m" | "cm" | "mm" | "km" | "s" | "ms" | "N" | "kN" | "Nm" | "Pa" | "kPa" | "MPa"
        | "GPa" | "Hz" | "lb" | "ft" => {
            "numbers have no units in words: write them in kg, m, s, N and rad, such as `210e9` for 210 GPa"
        }
        _ => return None,
    })
}

#[cfg(test)]
#[path = "../../tests/unit/format/synonyms.rs"]
mod tests;
