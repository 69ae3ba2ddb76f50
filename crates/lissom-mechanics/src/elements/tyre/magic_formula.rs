//! The Magic Formula of PAC2002 and MF-Tyre 5.2 [Pacejka 2002, section 4.3], with the coefficients of a tyre property file.
//!
//! Legend: F_z normal force, F_z0 the nominal one times its scale, d = (F_z - F_z0)/F_z0; κ and α slips, γ camber, R₀ free radius; names in capitals are
//! coefficients, L… their scales; axes of ISO 8855: x forwards, y to the left, z up.
//!
//! ```text
//! m(x; B, C, E) = C arctan(B x - E (B x - arctan(B x))),    E ≤ 1
//!
//! γ_x = γ LGAX,    κ_x = κ + (PHX1 + PHX2 d) LHX,    μ_x = (PDX1 + PDX2 d)(1 - PDX3 γ_x²) LMUX
//! K_x = F_z (PKX1 + PKX2 d) exp(PKX3 d) LKX,    C = PCX1 LCX,    B = K_x/(C μ_x F_z)
//! E = (PEX1 + PEX2 d + PEX3 d²)(1 - PEX4 sgn κ_x) LEX
//! F_x0 = μ_x F_z sin m(κ_x) + F_z (PVX1 + PVX2 d) LVX LMUX
//!
//! γ_y = γ LGAY,    S_H = (PHY1 + PHY2 d) LHY + PHY3 γ_y,    α_y = α + S_H,    μ_y = (PDY1 + PDY2 d)(1 - PDY3 γ_y²) LMUY
//! K_y = PKY1 F_z0 sin(2 arctan(F_z/(PKY2 F_z0))) (1 - PKY3 |γ_y|) LKY,    C = PCY1 LCY,    B = K_y/(C μ_y F_z)
//! E = (PEY1 + PEY2 d)(1 - (PEY3 + PEY4 γ_y) sgn α_y) LEY
//! S_V = F_z ((PVY1 + PVY2 d) LVY + (PVY3 + PVY4 d) γ_y) LMUY,    F_y0 = μ_y F_z sin m(α_y) + S_V
//!
//! combined: G_x = cos m(α + RHX1)/cos m(RHX1),    B = RBX1 cos arctan(RBX2 κ) LXAL,    C = RCX1,    E = REX1 + REX2 d,    F_x = G_x F_x0
//! S = RHY1 + RHY2 d,    G_y = cos m(κ + S)/cos m(S),    B = RBY1 cos arctan(RBY2 (α - RBY3)) LYKA,    C = RCY1,    E = REY1 + REY2 d
//! S_κ = μ_y F_z (RVY1 + RVY2 d + RVY3 γ) cos arctan(RVY4 α) sin(RVY5 arctan(RVY6 κ)) LVYKA,    F_y = G_y F_y0 + S_κ
//! without RBX1 and RBY1, the ellipse: G_x = (1 + (f_x sin α_y/μ_y)²)^-½,    G_y = (1 + (f_y κ_x/μ_x)²)^-½
//!     with the secants f_x = μ_x sin m(κ_x)/κ_x,    f_y = μ_y sin m(α_y)/sin α_y
//!
//! γ_z = γ LGAZ,    α_t = α + QHZ1 + QHZ2 d + (QHZ3 + QHZ4 d) γ_z,    α_r = α + S_H + S_V/K_y
//! in cosines with combined slip arctan((tan² α + (K_x κ/K_y)²)^½)
//! B = (QBZ1 + QBZ2 d + QBZ3 d²)(1 + QBZ4 γ_z + QBZ5 |γ_z|) LKY/LMUY,    C = QCZ1
//! E = (QEZ1 + QEZ2 d + QEZ3 d²)(1 + (QEZ4 + QEZ5 γ_z) 2/π arctan(B C α_t))
//! t = F_z (QDZ1 + QDZ2 d)(1 + QDZ3 γ_z + QDZ4 γ_z²) R₀/F_z0 LTR cos m(α_t) cos α
//! D_r = F_z ((QDZ6 + QDZ7 d) LRES + (QDZ8 + QDZ9 d) γ_z) R₀ LMUY,    B_r = QBZ9 LKY/LMUY + QBZ10 B_y C_y
//! s = R₀ (SSZ1 + SSZ2 F_y/F_z0 + (SSZ3 + SSZ4 d) γ) LS
//! M_z = -t (F_y - S_κ) + D_r cos arctan(B_r α_r) cos α + s F_x
//! M_x = R₀ F_z (QSX1 LVMX - QSX2 γ + QSX3 F_y/F_z0) LMX
//! M_y = -R₀ F_z (QSY1 + QSY2 F_x/FNOMIN + QSY3 |V/LONGVL| + QSY4 (V/LONGVL)⁴) LMY
//!
//! F_z = k LCZ ρ + d ρ̇, or FNOMIN (QFZ1 ρ/R₀ + QFZ2 (ρ/R₀)²) LCZ + d ρ̇
//! R_e = R₀ - ρ₀ (DREFF arctan(BREFF ρ/ρ₀) + FREFF ρ/ρ₀),    ρ₀ = FNOMIN/(k LCZ)
//! σ_κ = F_z (PTX1 + PTX2 d) exp(PTX3 d) R₀/F_z0 LSGKP,    σ_α = PTY1 sin(2 arctan(F_z/(PTY2 F_z0)))(1 - PKY3 |γ_y|) R₀ LFZO LSGAL
//! ```
//!
//! PTX3 has the other sign in files of MF-Tyre 5.2, and a pair PDX1, PDX2 or PDY1, PDY2 of which the first is negative has the other signs: D and B
//! are then negative, which is the same force.
//!
//! d stays within the loads FZMIN to FZMAX of the measurements, and below those at which a friction or stiffness vanishes; κ stays within KPUMIN to KPUMAX.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_2_PI;

use super::tread::{Slip, Tread};
use crate::dual::Number;
use crate::registry::ParameterError;

/// Key in the coefficients of a file with the signs of MF-Tyre 5.2.
pub const OF_MF_TYRE: &str = "FITTYP";

/// Coefficients of a file, by index.
macro_rules! coefficients {
    ($($name:ident)*) => {
        #[allow(clippy::upper_case_acronyms, non_camel_case_types, reason = "names of the files")]
        #[derive(Clone, Copy)]
        enum Coefficient { $($name),* }
        use Coefficient::{$($name),*};

        /// Names of the coefficients that the model of a tyre uses.
        pub const COEFFICIENTS: &[&str] = &[$(stringify!($name)),*];
    };
}

coefficients! {
    UNLOADED_RADIUS FNOMIN VERTICAL_STIFFNESS VERTICAL_DAMPING QFZ1 QFZ2 BREFF DREFF FREFF LONGVL FZMIN FZMAX KPUMIN KPUMAX
    LFZO LCZ LCX LMUX LEX LKX LHX LVX LGAX LCY LMUY LEY LKY LHY LVY LGAY LTR LRES LGAZ LXAL LYKA LVYKA LS LSGKP LSGAL LMX LVMX LMY
    PCX1 PDX1 PDX2 PDX3 PEX1 PEX2 PEX3 PEX4 PKX1 PKX2 PKX3 PHX1 PHX2 PVX1 PVX2 RBX1 RBX2 RCX1 REX1 REX2 RHX1 PTX1 PTX2 PTX3
    QSX1 QSX2 QSX3
    PCY1 PDY1 PDY2 PDY3 PEY1 PEY2 PEY3 PEY4 PKY1 PKY2 PKY3 PHY1 PHY2 PHY3 PVY1 PVY2 PVY3 PVY4
    RBY1 RBY2 RBY3 RCY1 REY1 REY2 RHY1 RHY2 RVY1 RVY2 RVY3 RVY4 RVY5 RVY6 PTY1 PTY2
    QSY1 QSY2 QSY3 QSY4
    QBZ1 QBZ2 QBZ3 QBZ4 QBZ5 QBZ9 QBZ10 QCZ1 QDZ1 QDZ2 QDZ3 QDZ4 QDZ6 QDZ7 QDZ8 QDZ9 QEZ1 QEZ2 QEZ3 QEZ4 QEZ5 QHZ1 QHZ2 QHZ3 QHZ4
    SSZ1 SSZ2 SSZ3 SSZ4
}

/// Forces of a tyre with the coefficients of its file.
#[derive(Clone, Debug)]
pub struct MagicFormula {
    values: Vec<f64>,
    /// F_z0.
    nominal: f64,
    /// -1 for a tyre on the other side of the vehicle than the measured one.
    side: f64,
}

/// Pure slip in one direction, and per normal force the force, its slope and the friction.
struct Pure<T> {
    slip: T,
    pull: T,
    stiffness: T,
    friction: T,
}

/// e^x.
fn exponential<T: Number>(x: T) -> T {
    let value = x.value().exp();
    x.composed(value, value)
}

/// |x|.
fn size<T: Number>(x: T) -> T {
    if x.value() < 0.0 { -x } else { x }
}

/// x, not above a bound.
fn at_most<T: Number>(x: T, bound: f64) -> T {
    if x.value() > bound { T::constant(bound) } else { x }
}

fn within<T: Number>(x: T, [low, high]: [f64; 2]) -> T {
    if x.value() < low { T::constant(low) } else { at_most(x, high) }
}

/// m(x; B, C, E).
fn bent<T: Number>(x: T, slope: T, shape: f64, curvature: T) -> T {
    let steep = x * slope;
    (steep - at_most(curvature, 1.0) * (steep - steep.arc_tangent())).arc_tangent().scaled(shape)
}

/// The angle of this sine.
fn angle_of<T: Number>(sine: T) -> T {
    (sine / (-(sine * sine)).plus(1.0).square_root()).arc_tangent()
}

fn sine<T: Number>(x: T) -> T {
    x.sine_cosine().0
}

fn cosine<T: Number>(x: T) -> T {
    x.sine_cosine().1
}

impl MagicFormula {
    /// The model with these coefficients, by name; scales that are not given are 1, others 0.
    ///
    /// # Errors
    /// If a name is unknown, or a coefficient that all tyres have is missing or impossible.
    pub fn new(given: &BTreeMap<String, f64>, is_mirrored: bool) -> Result<Self, ParameterError> {
        let wrong = |problem: String| Err(ParameterError::new("magic_formula", problem));
        let default = |name: &str| match name {
            "FZMAX" | "KPUMAX" => f64::INFINITY,
            "KPUMIN" => f64::NEG_INFINITY,
            "LONGVL" => 16.6,
            name if name.starts_with('L') => 1.0,
            _ => 0.0,
        };
        let values: Vec<f64> = COEFFICIENTS
            .iter()
            .map(|name| given.get(*name).copied().unwrap_or_else(|| default(name)))
            .collect();
        let mut law = Self {
            nominal: values[FNOMIN as usize] * values[LFZO as usize],
            values,
            side: if is_mirrored { -1.0 } else { 1.0 },
        };
        for (constant, slope) in [(PDX1, PDX2), (PDY1, PDY2)] {
            if law.of(constant) < 0.0 {
                for name in [constant, slope] {
                    law.values[name as usize] *= -1.0;
                }
            }
        }
        if given.contains_key(OF_MF_TYRE) {
            law.values[PTX3 as usize] *= -1.0;
        }
        for name in [
            UNLOADED_RADIUS,
            FNOMIN,
            LFZO,
            LCZ,
            LONGVL,
            PCX1,
            LCX,
            PDX1,
            PKX1,
            PCY1,
            LCY,
            PDY1,
            PKY2,
            LMUX,
            LMUY,
            LKX,
            LKY,
        ] {
            if law.of(name) <= 0.0 {
                return wrong(format!("needs a positive coefficient {}", COEFFICIENTS[name as usize]));
            }
        }
        if law.of(VERTICAL_STIFFNESS) <= 0.0 {
            law.values[VERTICAL_STIFFNESS as usize] = law.of(QFZ1) * law.of(FNOMIN) / law.radius();
        }
        if law.of(VERTICAL_STIFFNESS) <= 0.0 {
            return wrong("needs a positive coefficient VERTICAL_STIFFNESS".to_owned());
        }
        if law.of(PKY1) >= 0.0 {
            return wrong(
                "needs a negative coefficient PKY1: the lateral force opposes the slip angle in the axes of ISO 8855".to_owned(),
            );
        }
        law.values[FZMAX as usize] = law.usable_load();
        Ok(law)
    }

    /// The largest load, at most FZMAX, up to which slip stiffness and friction are positive: those of some files vanish within their range.
    fn usable_load(&self) -> f64 {
        let is_usable = |load: &f64| {
            let load = load / self.nominal - 1.0;
            [(PKX1, PKX2), (PDX1, PDX2), (PDY1, PDY2)]
                .iter()
                .all(|(first, second)| self.linear(*first, *second, load) > 0.0)
        };
        // In hundredths of five nominal loads.
        let loads = (0..=400).map(|k| self.nominal * (1.0 + 0.01 * f64::from(k)));
        let first_bad = loads.into_iter().find(|load| !is_usable(load));
        first_bad.map_or(f64::INFINITY, |load| load - 0.02 * self.nominal).min(self.of(FZMAX))
    }

    fn of(&self, name: Coefficient) -> f64 {
        self.values[name as usize]
    }

    /// Free radius [m].
    pub fn radius(&self) -> f64 {
        self.of(UNLOADED_RADIUS)
    }

    /// Nominal normal force [N].
    pub fn nominal_load(&self) -> f64 {
        self.of(FNOMIN)
    }

    /// Smallest normal force for which there are data [N].
    pub fn smallest_load(&self) -> f64 {
        self.of(FZMIN)
    }

    /// Largest normal force for which there are data [N], or infinity.
    pub fn largest_load(&self) -> f64 {
        self.of(FZMAX)
    }

    /// Velocity of the measurement [m/s].
    pub fn measured_velocity(&self) -> f64 {
        self.of(LONGVL)
    }

    /// Stiffness k, scaled.
    fn stiffness(&self) -> f64 {
        self.of(VERTICAL_STIFFNESS) * self.of(LCZ)
    }

    pub(super) fn normal<T: Number>(&self, depth: T, rate: T) -> T {
        let damped = rate.scaled(self.of(VERTICAL_DAMPING));
        let [first, second] = [self.of(QFZ1), self.of(QFZ2)];
        if first <= 0.0 {
            return depth.scaled(self.stiffness()) + damped;
        }
        let part = depth.scaled(1.0 / self.radius());
        (part.scaled(first) + (part * part).scaled(second)).scaled(self.of(FNOMIN) * self.of(LCZ)) + damped
    }

    pub(super) fn effective_radius<T: Number>(&self, depth: T) -> T {
        let [slope, peak, linear] = [BREFF, DREFF, FREFF].map(|name| self.of(name));
        if slope * peak <= 0.0 && linear <= 0.0 {
            return -depth.scaled(1.0 / 3.0).plus(-self.radius());
        }
        let reference = self.of(FNOMIN) / self.stiffness();
        let part = depth.scaled(1.0 / reference);
        let less = part.scaled(slope).arc_tangent().scaled(peak) + part.scaled(linear);
        -less.scaled(reference).plus(-self.radius())
    }

    /// Longitudinal and lateral force [N], and moments about x, y and z [N m], in steady rolling with a slip, slip angle and camber [rad], a normal
    /// force [N] and a velocity [m/s].
    pub fn forces(&self, [slip, angle, camber]: [f64; 3], normal: f64, velocity: f64) -> [f64; 5] {
        let slip = Slip {
            along: slip,
            across: angle.tan(),
            lean: camber.sin(),
            normal,
            rolling: velocity,
            forwards: velocity.signum(),
            turning: 1.0,
        };
        let tread = self.tread(&slip);
        [tread.along, tread.across, tread.overturning, tread.resisting, tread.aligning]
    }

    /// Relaxation lengths along and across [m], for a normal force and the sine of the camber.
    pub fn relaxation<T: Number>(&self, normal: T, lean: T) -> [T; 2] {
        let radius = self.radius();
        let load = self.load(normal);
        let along = normal * self.linear(PTX1, PTX2, load) * exponential(load.scaled(self.of(PTX3)));
        let along = along.scaled(radius / self.nominal * self.of(LSGKP));
        let across = self.over_load(normal, PTY2)
            * size(angle_of(lean)).scaled(-self.of(PKY3) * self.of(LGAY)).plus(1.0);
        let across = across.scaled(self.of(PTY1) * radius * self.of(LFZO) * self.of(LSGAL));
        let given = [(along, PTX1, 0.5 * radius), (across, PTY1, radius)];
        given.map(|(length, name, default)| {
            if self.of(name) <= 0.0 {
                T::constant(default)
            } else if length.value() < 0.05 * radius {
                // With a small load the lengths vanish.
                T::constant(0.05 * radius)
            } else {
                length
            }
        })
    }

    pub(super) fn adhesion<T: Number>(&self, normal: T) -> [T; 2] {
        let load = self.load(normal);
        let [along, across] = self.stiffnesses(normal, load);
        let friction = [(PDX1, PDX2, LMUX), (PDY1, PDY2, LMUY)]
            .map(|(constant, slope, scale)| self.linear(constant, slope, load).scaled(self.of(scale)));
        [friction[0] / along, -(friction[1] / across)]
    }

    /// K_x and K_y without camber, per normal force.
    fn stiffnesses<T: Number>(&self, normal: T, load: T) -> [T; 2] {
        let along = self.linear(PKX1, PKX2, load) * exponential(load.scaled(self.of(PKX3)));
        let across =
            self.over_load(normal, PKY2).scaled(self.of(PKY1) * self.nominal * self.of(LKY)) / normal;
        [along.scaled(self.of(LKX)), across]
    }

    /// d, within the measured loads.
    fn load<T: Number>(&self, normal: T) -> T {
        within(normal, [self.of(FZMIN), self.of(FZMAX)]).scaled(1.0 / self.nominal).plus(-1.0)
    }

    fn linear<T: Number>(&self, constant: Coefficient, slope: Coefficient, x: T) -> T {
        x.scaled(self.of(slope)).plus(self.of(constant))
    }

    fn quadratic<T: Number>(&self, names: [Coefficient; 3], x: T) -> T {
        self.linear(names[0], names[1], x) + (x * x).scaled(self.of(names[2]))
    }

    /// sin(2 arctan(F_z/(p F_z0))).
    fn over_load<T: Number>(&self, normal: T, place: Coefficient) -> T {
        sine(normal.scaled(1.0 / (self.of(place) * self.nominal)).arc_tangent().scaled(2.0))
    }

    pub(super) fn tread<T: Number>(&self, slip: &Slip<T>) -> Tread<T> {
        let tread = self.measured(&Slip {
            across: slip.across.scaled(self.side),
            lean: slip.lean.scaled(self.side),
            ..*slip
        });
        Tread {
            across: tread.across.scaled(self.side),
            overturning: tread.overturning.scaled(self.side),
            aligning: tread.aligning.scaled(self.side),
            ..tread
        }
    }

    /// G_x, G_y and S_κ per normal force, for κ, α, γ and d.
    fn combined<T: Number>(&self, [kappa, alpha, gamma, load]: [T; 4], x: &Pure<T>, y: &Pure<T>) -> [T; 3] {
        let of = |name| self.of(name);
        if of(RBX1) > 0.0 && of(RBY1) > 0.0 {
            let curvature = self.linear(REX1, REX2, load);
            let slope = cosine(kappa.scaled(of(RBX2)).arc_tangent()).scaled(of(RBX1) * of(LXAL));
            let part = |at| cosine(bent(at, slope, of(RCX1), curvature));
            let reduction_x = part(alpha.plus(of(RHX1))) / part(T::constant(of(RHX1)));
            let curvature = self.linear(REY1, REY2, load);
            let slope =
                cosine(alpha.plus(-of(RBY3)).scaled(of(RBY2)).arc_tangent()).scaled(of(RBY1) * of(LYKA));
            let shift = self.linear(RHY1, RHY2, load);
            let part = |at| cosine(bent(at, slope, of(RCY1), curvature));
            let reduction_y = part(kappa + shift) / part(shift);
            let size = y.friction * (self.linear(RVY1, RVY2, load) + gamma.scaled(of(RVY3)));
            let fading = cosine(alpha.scaled(of(RVY4)).arc_tangent());
            let wave = sine(kappa.scaled(of(RVY6)).arc_tangent().scaled(of(RVY5)));
            return [reduction_x, reduction_y, size * fading * wave.scaled(of(LVYKA))];
        }
        let one = T::constant(1.0);
        let across = sine(y.slip);
        let ellipse = |own: &Pure<T>, slip: T, other: T, friction: T| {
            let secant = if slip.value().abs() < 1e-9 { own.stiffness } else { own.pull / slip };
            let part = secant * other / friction;
            one / (part * part).plus(1.0).square_root()
        };
        [ellipse(x, x.slip, across, y.friction), ellipse(y, across, x.slip, x.friction), T::constant(0.0)]
    }

    /// Forces of the tyre on the side on which it was measured.
    fn measured<T: Number>(&self, slip: &Slip<T>) -> Tread<T> {
        let one = T::constant(1.0);
        let of = |name| self.of(name);
        let normal = slip.normal;
        let load = self.load(normal);
        let kappa = within(slip.along, [of(KPUMIN), of(KPUMAX)]);
        let alpha = slip.across.arc_tangent();
        let gamma = angle_of(slip.lean);

        // Longitudinal force.
        let gamma_x = gamma.scaled(of(LGAX));
        let kappa_x = kappa + self.linear(PHX1, PHX2, load).scaled(of(LHX));
        let mu_x = self.linear(PDX1, PDX2, load) * (one - (gamma_x * gamma_x).scaled(of(PDX3)));
        let mu_x = mu_x.scaled(of(LMUX));
        let [stiffness_x, stiffness_y] = self.stiffnesses(normal, load);
        let shape_x = of(PCX1) * of(LCX);
        let curvature_x = self.quadratic([PEX1, PEX2, PEX3], load);
        let curvature_x = curvature_x.scaled((1.0 - of(PEX4) * kappa_x.value().signum()) * of(LEX));
        let slope_x = stiffness_x / mu_x.scaled(shape_x);
        let pull_x = mu_x * sine(bent(kappa_x, slope_x, shape_x, curvature_x));
        let shift_x = self.linear(PVX1, PVX2, load).scaled(of(LVX) * of(LMUX));

        // Lateral force.
        let gamma_y = gamma.scaled(of(LGAY));
        let shift_h = self.linear(PHY1, PHY2, load).scaled(of(LHY)) + gamma_y.scaled(of(PHY3));
        let alpha_y = alpha + shift_h;
        let mu_y = self.linear(PDY1, PDY2, load) * (one - (gamma_y * gamma_y).scaled(of(PDY3)));
        let mu_y = mu_y.scaled(of(LMUY));
        let stiffness_y = stiffness_y * (one - size(gamma_y).scaled(of(PKY3)));
        let shape_y = of(PCY1) * of(LCY);
        let uneven = self.linear(PEY3, PEY4, gamma_y).scaled(-alpha_y.value().signum()).plus(1.0);
        let curvature_y = (self.linear(PEY1, PEY2, load) * uneven).scaled(of(LEY));
        let slope_y = stiffness_y / mu_y.scaled(shape_y);
        let pull_y = mu_y * sine(bent(alpha_y, slope_y, shape_y, curvature_y));
        let shift_y = self.linear(PVY1, PVY2, load).scaled(of(LVY)) + self.linear(PVY3, PVY4, load) * gamma_y;
        let shift_y = shift_y.scaled(of(LMUY));

        let x = Pure { slip: kappa_x, pull: pull_x, stiffness: stiffness_x, friction: mu_x };
        let y = Pure { slip: alpha_y, pull: pull_y, stiffness: stiffness_y, friction: mu_y };
        let [reduction_x, reduction_y, shift_k] = self.combined([kappa, alpha, gamma, load], &x, &y);
        let along = normal * (pull_x + shift_x) * reduction_x;
        let free = normal * (pull_y + shift_y) * reduction_y;
        let across = free + normal * shift_k;

        // Moments.
        let (radius, part_y) = (self.radius(), across.scaled(1.0 / self.nominal));
        let gamma_z = gamma.scaled(of(LGAZ));
        let driven = stiffness_x * kappa / stiffness_y;
        let combined = |angle: T| {
            let (sine, cosine) = angle.sine_cosine();
            let tangent = sine / cosine;
            (tangent * tangent + driven * driven).plus(1e-24).square_root().arc_tangent()
        };
        let alpha_t = alpha + self.linear(QHZ1, QHZ2, load) + self.linear(QHZ3, QHZ4, load) * gamma_z;
        let alpha_r = alpha + shift_h + shift_y / stiffness_y;
        let ratio = of(LKY) / of(LMUY);
        let leaning = (gamma_z.scaled(of(QBZ4)) + size(gamma_z).scaled(of(QBZ5))).plus(1.0);
        let slope = (self.quadratic([QBZ1, QBZ2, QBZ3], load) * leaning).scaled(ratio);
        let turn = (slope * alpha_t).scaled(of(QCZ1)).arc_tangent().scaled(FRAC_2_PI);
        let uneven = (self.linear(QEZ4, QEZ5, gamma_z) * turn).plus(1.0);
        let curvature = self.quadratic([QEZ1, QEZ2, QEZ3], load) * uneven;
        let leaning = (gamma_z.scaled(of(QDZ3)) + (gamma_z * gamma_z).scaled(of(QDZ4))).plus(1.0);
        let peak = normal * self.linear(QDZ1, QDZ2, load) * leaning;
        let peak = peak.scaled(radius / self.nominal * of(LTR));
        let cosine_alpha = cosine(alpha);
        let trail = peak * cosine(bent(combined(alpha_t), slope, of(QCZ1), curvature)) * cosine_alpha;
        let residual =
            self.linear(QDZ6, QDZ7, load).scaled(of(LRES)) + self.linear(QDZ8, QDZ9, load) * gamma_z;
        let slope_r = slope_y.scaled(of(QBZ10) * shape_y).plus(of(QBZ9) * ratio);
        let residual = normal * residual.scaled(radius * of(LMUY));
        let residual = residual * cosine((slope_r * combined(alpha_r)).arc_tangent()) * cosine_alpha;
        let arm = part_y.scaled(of(SSZ2)).plus(of(SSZ1)) + self.linear(SSZ3, SSZ4, load) * gamma;
        let arm = arm.scaled(radius * of(LS));
        let overturning = part_y.scaled(of(QSX3)).plus(of(QSX1) * of(LVMX)) - gamma.scaled(of(QSX2));
        let speed = size(slip.rolling).scaled(1.0 / of(LONGVL));
        let square = speed * speed;
        let resisting =
            along.scaled(of(QSY2) / of(FNOMIN)) + speed.scaled(of(QSY3)) + (square * square).scaled(of(QSY4));
        let resisting = normal * resisting.plus(of(QSY1)) * slip.turning;
        Tread {
            along,
            across,
            overturning: normal * overturning.scaled(radius * of(LMX)),
            resisting: resisting.scaled(-radius * of(LMY)),
            aligning: (residual - trail * free) * slip.forwards + arm * along,
        }
    }
}
