//! A random law: a mass on a rail under a force with a feature that is narrow, jumps or has a kink, in time, in the motion or in
//! both, in any entry of a model that takes a law.

use std::sync::Arc;

use crate::random::draw::Draw;

/// Duration of the motion [s].
pub(super) const END: f64 = 2.0;
/// Mass of the follower of a relation [kg].
pub(super) const FOLLOWER: f64 = 0.5;
/// Time constant of the state that a law drives [s].
pub(super) const LAG: f64 = 0.05;

/// A function of one argument.
pub(super) type Shape = Arc<dyn Fn(f64) -> f64 + Send + Sync>;

/// What the law is a function of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Argument {
    Time,
    Position,
    /// x - c t.
    Both(f64),
}

/// The entry of the model that holds the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Holder {
    Load,
    Signal,
    State,
    Spring,
    Equation,
    Cam,
}

/// A random law and the model around it.
pub(super) struct Case {
    /// Kind of the law, in a word.
    pub(super) kind: &'static str,
    pub(super) holder: Holder,
    argument: Argument,
    /// The law over its argument, as an expression of `U`.
    expression: String,
    shape: Shape,
    /// First and second derivative of the expression; for relations alone.
    derivatives: Option<[Shape; 2]>,
    /// Smallest length of the case.
    pub(super) width: f64,
    /// The law is multiplied by 1 - b v.
    by_velocity: f64,
    /// Further forces: a - c v.
    base: [f64; 2],
    /// Initial velocity [m/s].
    pub(super) velocity: f64,
}

impl Case {
    /// The case of a seed and a number.
    pub(super) fn new(seed: u64, index: u64) -> Self {
        let draw = &mut Draw::new(seed ^ 0x1a75, index);
        let holder = draw.of(&[
            Holder::Load,
            Holder::Load,
            Holder::Signal,
            Holder::State,
            Holder::Spring,
            Holder::Spring,
            Holder::Equation,
            Holder::Cam,
        ]);
        let is_relation = matches!(holder, Holder::Equation | Holder::Cam);
        let argument = match holder {
            Holder::Spring | Holder::Equation | Holder::Cam => Argument::Position,
            _ => {
                let both = Argument::Both(draw.between(0.1, 0.6));
                draw.of(&[Argument::Time, Argument::Position, Argument::Position, both])
            }
        };
        let centre = draw.between(0.3, 1.2);
        let (kind, expression, shape, width) = if is_relation {
            let (width, height) = (draw.size(2e-3, 0.1), draw.between(0.2, 1.0));
            let height = height * width;
            let text = format!("{height}*exp(-((U - {centre})/{width})^2)");
            let shape: Shape = Arc::new(move |u| height * (-((u - centre) / width).powi(2)).exp());
            ("hump", text, shape, width)
        } else {
            law(draw, centre)
        };
        let derivatives = is_relation.then(|| {
            let of = Arc::clone(&shape);
            let first: Shape = Arc::new(move |u| -2.0 * (u - centre) / (width * width) * of(u));
            let of = Arc::clone(&shape);
            let second: Shape = Arc::new(move |u| {
                let square = ((u - centre) / width).powi(2);
                (4.0 * square - 2.0) / (width * width) * of(u)
            });
            [first, second]
        });
        let may_slow = !is_relation && holder != Holder::Spring;
        let by_velocity = if may_slow && draw.chance(0.4) { draw.between(0.05, 0.3) } else { 0.0 };
        let base = [draw.between(0.0, 1.0), draw.between(0.0, 0.5)];
        let velocity = draw.between(0.3, 1.5);
        Self { kind, holder, argument, expression, shape, derivatives, width, by_velocity, base, velocity }
    }

    /// The model file, with further keys of the analysis.
    pub(super) fn text(&self, analysis: &str) -> String {
        let (position, velocity) = match self.holder {
            Holder::Spring => ("elongation", "rate"),
            Holder::Cam => ("x", ""),
            _ => ("s.displacement", "s.velocity"),
        };
        let argument = match self.argument {
            Argument::Time => "t".to_owned(),
            Argument::Position => position.to_owned(),
            Argument::Both(speed) => format!("({position} - {speed}*t)"),
        };
        let mut law = self.expression.replace('U', &argument);
        if self.by_velocity != 0.0 {
            law = format!("({law})*(1 - {}*{velocity})", self.by_velocity);
        }
        let base = format!("{} - {}*s.velocity", self.base[0], self.base[1]);
        let load =
            |force: &str| format!("[loads.f]\nkind = \"joint_force\"\njoint = \"s\"\nforce = \"{force}\"\n");
        let follower = format!(
            "[bodies.b]\nmass = {FOLLOWER}\ninertia = [1, 1, 1]\n[joints.r]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"b\"\n\
             axis = [0, 1, 0]\n"
        );
        let further = match self.holder {
            Holder::Load => load(&format!("{base} + {law}")),
            Holder::Signal => format!("[signals]\nlaw = \"{law}\"\n{}", load(&format!("{base} + law"))),
            Holder::State => {
                format!(
                    "[states]\nz = {{ derivative = \"{law} - z/{LAG}\", start = 0 }}\n{}",
                    load(&format!("{base} + z"))
                )
            }
            Holder::Spring => {
                format!("[springs.k]\nkind = \"axial\"\njoint = \"s\"\nforce = \"-({law})\"\n{}", load(&base))
            }
            Holder::Equation => format!(
                "{follower}[joints.e]\nkind = \"equation\"\nequation = \"r.displacement - ({law})\"\n{}",
                load(&base)
            ),
            Holder::Cam => format!(
                "{follower}[joints.e]\nkind = \"cam\"\njoint = \"s\"\nother = \"r\"\nprofile = \"{law}\"\n{}",
                load(&base)
            ),
        };
        format!(
            "lissom = 1\ngravity = [0, 0, 0]\n[bodies.c]\nmass = 1\ninertia = [1, 1, 1]\nvelocity = [{}, 0, 0]\n[joints.s]\nkind = \
             \"prismatic\"\nbase = \"ground\"\ntip = \"c\"\naxis = [1, 0, 0]\n{further}[outputs.s]\nkind = \"relative\"\nof = \"s\"\n\
             [analysis]\nkind = \"dynamics\"\nend = {END}\n{analysis}",
            self.velocity
        )
    }

    /// Derivatives of position, velocity and state.
    pub(super) fn rates(&self, time: f64, [x, v, z]: [f64; 3]) -> [f64; 3] {
        let argument = match self.argument {
            Argument::Time => time,
            Argument::Position => x,
            Argument::Both(speed) => x - speed * time,
        };
        let law = (self.shape)(argument) * (1.0 - self.by_velocity * v);
        let base = self.base[0] - self.base[1] * v;
        match self.holder {
            Holder::State => [v, base + z, law - z / LAG],
            Holder::Equation | Holder::Cam => {
                let [slope, curvature] =
                    self.derivatives.as_ref().map_or([0.0; 2], |of| [of[0](argument), of[1](argument)]);
                let force = base - FOLLOWER * slope * curvature * v * v;
                [v, force / (1.0 + FOLLOWER * slope * slope), 0.0]
            }
            Holder::Load | Holder::Signal | Holder::Spring => [v, base + law, 0.0],
        }
    }
}

/// A law of a force with a feature near `centre`: kind, expression, function and smallest length.
fn law(draw: &mut Draw, centre: f64) -> (&'static str, String, Shape, f64) {
    match draw.below(8) {
        0 => {
            let stiffness = draw.size(1e2, 1e6);
            let text = format!("-{stiffness}*max(0, U - {centre})");
            ("stop", text, Arc::new(move |u: f64| -stiffness * (u - centre).max(0.0)), 0.1)
        }
        1 => {
            let (width, size) = (draw.size(1e-3, 0.2), draw.between(0.2, 2.0));
            let text = format!("{size}*sin(2*pi*U/{width})");
            let shape = move |u: f64| size * (std::f64::consts::TAU * u / width).sin();
            ("detent", text, Arc::new(shape), 0.2 * width)
        }
        2 => {
            let (width, impulse) = (draw.size(1e-4, 0.05), draw.between(-0.3, 0.6));
            let size = (impulse / width * 100.0).round() / 100.0;
            let text = format!("{size}*exp(-((U - {centre})/{width})^2)");
            ("peak", text, Arc::new(move |u: f64| size * (-((u - centre) / width).powi(2)).exp()), width)
        }
        3 => {
            let (width, impulse) = (draw.size(1e-4, 0.05), draw.between(-0.3, 0.6));
            let (size, end) = ((impulse / width * 100.0).round() / 100.0, centre + width);
            let text = format!("{size}*(U > {centre})*(U < {end})");
            ("pulse", text, Arc::new(move |u: f64| if u > centre && u < end { size } else { 0.0 }), width)
        }
        4 => {
            let (period, size) = (draw.size(3e-3, 0.2), draw.between(0.5, 4.0));
            let on = period * draw.between(0.1, 0.9);
            let text = format!("{size}*(mod(U, {period}) < {on})");
            let shape = move |u: f64| if u.rem_euclid(period) < on { size } else { 0.0 };
            ("pulse train", text, Arc::new(shape), 0.1 * period)
        }
        5 => {
            let (unit, stiffness) = (draw.size(0.02, 0.3), draw.between(0.5, 5.0));
            let function = draw.of(&["floor", "round", "ceil"]);
            let text = format!("-{stiffness}*{unit}*{function}(U/{unit})");
            let shape = move |u: f64| {
                let level = match function {
                    "floor" => (u / unit).floor(),
                    "round" => (u / unit + 0.5).floor(),
                    _ => (u / unit).ceil(),
                };
                -stiffness * unit * level
            };
            ("quantiser", text, Arc::new(shape), unit)
        }
        6 => {
            let (width, size) = (draw.size(1e-3, 0.1), draw.between(0.5, 3.0));
            let text = format!("{size}*tanh((U - {centre})/{width}) - {size}*abs(U - {centre})");
            let shape = move |u: f64| size * ((u - centre) / width).tanh() - size * (u - centre).abs();
            ("kink", text, Arc::new(shape), width)
        }
        _ => {
            let (width, size) = (draw.size(1e-3, 0.1), draw.between(0.5, 4.0));
            let text = format!("{size}*sign(sin(2*pi*U/{width}))");
            let shape = move |u: f64| {
                let wave = (std::f64::consts::TAU * u / width).sin();
                if wave == 0.0 { 0.0 } else { size * wave.signum() }
            };
            ("square wave", text, Arc::new(shape), 0.5 * width)
        }
    }
}
