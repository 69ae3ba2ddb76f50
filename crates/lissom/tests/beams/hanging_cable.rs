//! A cable that hangs between two points at one height: equilibrium by relaxation, and its frequencies.
//!
//! Legend: l span, w = m g weight per unstretched length, H horizontal force, r = w l/H (eight times the ratio of sag to span),
//! EA stiffness, L unstretched length, λ² = r² EA l/(H L_e) with L_e = l (1 + r²/8) [Irvine and Caughey 1974].

use std::f64::consts::PI;

use lissom::analyses::modes::{ModeReport, ModeRequest, OperatingPoint, modes};
use lissom::analyses::path::{PathEnd, PathSession};
use lissom::{Model, Session};
use lissom_core::errors::Warning;
use lissom_core::linearized::Completeness;
use lissom_model::output::Summary;

const SPAN: f64 = 100.0;
const GRAVITY: f64 = 9.81;
/// Bending stiffness over H l²: it changes the n-th frequency by n²π²/2 of this part.
const BENDING: f64 = 1e-10;

/// A cable of 1 kg/m: H, EA and L.
#[derive(Clone, Copy)]
struct Cable {
    force: f64,
    stiffness: f64,
    length: f64,
}

fn bisect(mut low: f64, mut high: f64, at: impl Fn(f64) -> f64) -> f64 {
    let rises = at(high) > 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (at(middle) > 0.0) == rises { high = middle } else { low = middle }
    }
    low
}

impl Cable {
    /// From r and λ². The span of the elastic catenary is H L/EA + 2 (H/w) asinh(w L/(2H)).
    fn new(slope: f64, lambda_squared: f64) -> Self {
        let force = GRAVITY * SPAN / slope;
        let stiffness = lambda_squared * force * (1.0 + slope * slope / 8.0) / (slope * slope);
        let span = |length: f64| Self { force, stiffness, length }.span(GRAVITY);
        Self { force, stiffness, length: bisect(0.5 * SPAN, 2.0 * SPAN, |length| span(length) - SPAN) }
    }

    /// What its length spans at its force under another gravity.
    fn span(&self, gravity: f64) -> f64 {
        let Self { force, stiffness, length } = *self;
        force * length / stiffness + 2.0 * force / gravity * (gravity * length / (2.0 * force)).asinh()
    }

    /// Its force under another gravity.
    fn force_under(&self, gravity: f64) -> f64 {
        bisect(0.1 * self.force, 10.0 * self.force, |force| Self { force, ..*self }.span(gravity) - SPAN)
    }

    /// The lowest point, below the supports.
    fn sag(&self) -> f64 {
        let end = 0.5 * GRAVITY * self.length;
        let tension = self.force.hypot(end);
        0.5 * end * self.length / (2.0 * self.stiffness) + (tension - self.force) / GRAVITY
    }

    /// Laid along an arc of its unstretched length, without stress.
    fn model(&self, elements: usize, kind: &str) -> String {
        let half = bisect(1e-6, 3.0, |angle| 1.0 - angle.sin() / angle - (1.0 - SPAN / self.length));
        let low = 0.5 * SPAN * (0.5 * half).tan();
        let bending = BENDING * self.force * SPAN * SPAN;
        format!(
            r#"
lissom = 1
gravity = [0, 0, -{GRAVITY}]
[sections.cable]
shape = "general"
stiffness = [{stiffness:e}, {stiffness:e}, {stiffness:e}, {bending:e}, {bending:e}, {bending:e}]
mass = {{ per_length = 1, inertia = [2e-9, 1e-9, 1e-9] }}
[beams.cable]
section = "cable"
from = [0, 0, 0]
through = [{middle}, 0, {through:e}]
to = [{SPAN}, 0, 0]
up = [0, 1, 0]
elements = {elements}
[joints.left]
kind = "universal"
base = "ground"
tip = "cable.start"
axis = [0, 1, 0]
second_axis = [0, 0, 1]
[joints.right]
kind = "universal"
base = "ground"
tip = "cable.end"
axis = [0, 1, 0]
second_axis = [0, 0, 1]
[outputs.middle]
kind = "position"
of = "cable@0.5"
[outputs.support]
kind = "reaction"
of = "left"
[analysis]
kind = "{kind}"
"#,
            stiffness = self.stiffness,
            middle = 0.5 * SPAN,
            through = -low,
        )
    }

    /// What is left of small motion of the far end at the angular frequency ω, in the plane and across it:
    /// δr' = J δT, δT' = -m ω² δr, J = (1/T + 1/EA) I - t tᵀ/T, t the direction of the tension T.
    fn determinants(&self, omega: f64) -> [f64; 2] {
        const STEPS: usize = 1000;
        let step = self.length / STEPS as f64;
        let rates = |place: f64, [x, z, horizontal, vertical, y, across]: [f64; 6]| {
            let rise = GRAVITY * (0.5 * self.length - place);
            let tension = self.force.hypot(rise);
            let (cosine, sine) = (self.force / tension, rise / tension);
            let along = cosine * horizontal + sine * vertical;
            let slack = 1.0 / tension + 1.0 / self.stiffness;
            let square = omega * omega;
            [
                slack * horizontal - cosine * along / tension,
                slack * vertical - sine * along / tension,
                -square * x,
                -square * z,
                slack * across,
                -square * y,
            ]
        };
        let go = |mut state: [f64; 6]| {
            for k in 0..STEPS {
                let at = k as f64 * step;
                let moved =
                    |rate: &[f64; 6], part: f64| std::array::from_fn(|i| state[i] + part * step * rate[i]);
                let one = rates(at, state);
                let two = rates(at + 0.5 * step, moved(&one, 0.5));
                let three = rates(at + 0.5 * step, moved(&two, 0.5));
                let four = rates(at + step, moved(&three, 1.0));
                for i in 0..6 {
                    state[i] += step / 6.0 * (one[i] + 2.0 * (two[i] + three[i]) + four[i]);
                }
            }
            state
        };
        // Tensions in the size of the force give displacements in that of the span.
        let a = go([0.0, 0.0, self.force, 0.0, 0.0, self.force]);
        let b = go([0.0, 0.0, 0.0, self.force, 0.0, 0.0]);
        [a[0] * b[1] - a[1] * b[0], a[4]]
    }

    /// The frequency of a taut string of this force and span [Hz], the unit of what follows.
    fn unit(&self) -> f64 {
        0.5 * self.force.sqrt() / SPAN
    }

    /// Frequencies of the perfectly flexible cable, in those of the string.
    fn exact(&self, below: f64) -> Vec<f64> {
        let mut all = Vec::new();
        for plane in 0..2 {
            let at = |number: f64| self.determinants(2.0 * PI * number * self.unit())[plane];
            let steps = (below / 0.013) as usize;
            let grid = |k: usize| 0.5 + 0.013 * k as f64;
            for k in 0..steps {
                let (low, high) = (grid(k), grid(k + 1));
                if (at(low) > 0.0) != (at(high) > 0.0) {
                    all.push(bisect_few(low, high, &at));
                }
            }
        }
        all.retain(|&number| number < below);
        all.sort_by(f64::total_cmp);
        all
    }
}

fn bisect_few(mut low: f64, mut high: f64, at: &impl Fn(f64) -> f64) -> f64 {
    let rises = at(high) > 0.0;
    for _ in 0..34 {
        let middle = 0.5 * (low + high);
        if (at(middle) > 0.0) == rises { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// Irvine's frequencies for small sag, in those of the string: tan(ω/2) = ω/2 - (4/λ²)(ω/2)³ of symmetric modes in the plane,
/// 2n of antisymmetric ones, n across the plane.
fn irvine(lambda_squared: f64, below: f64) -> Vec<f64> {
    let at = |number: f64| {
        let half = 0.5 * PI * number;
        half.sin() - half.cos() * (half - 4.0 / lambda_squared * half.powi(3))
    };
    let mut all: Vec<f64> = (1..=below as u32).flat_map(|n| [f64::from(n), 2.0 * f64::from(n)]).collect();
    let grid = |k: u32| 0.5 + 0.0131 * f64::from(k);
    for k in 0..(below / 0.0131) as u32 {
        if (at(grid(k)) > 0.0) != (at(grid(k + 1)) > 0.0) {
            all.push(bisect(grid(k), grid(k + 1), at));
        }
    }
    all.retain(|&number| number < below);
    all.sort_by(f64::total_cmp);
    all
}

fn found(cable: &Cable, elements: usize, count: usize) -> (Vec<f64>, ModeReport) {
    let model = Model::from_text("cable.toml", &cable.model(elements, "modes"));
    let request =
        ModeRequest { count: Some(count), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    let report = modes(&model, &request).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.completeness, Completeness::Counted);
    (report.modes.iter().map(|mode| mode.frequency / cable.unit()).collect(), report)
}

fn largest_error(found: &[f64], exact: &[f64]) -> f64 {
    found.iter().zip(exact).map(|(found, exact)| (found / exact - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn load_steps_find_the_elastic_catenary_from_a_cable_without_tension() {
    let cable = Cable::new(0.4, 500.0);
    let model = Model::from_text("cable.toml", &cable.model(24, "statics"));
    let mut session = Session::new(&model.document().unwrap()).unwrap();
    let record = session.run().unwrap();
    let last = |name: &str, part: &str| *record.column(name, part).unwrap().last().unwrap();
    let (force, sag) = (last("support", "f1").abs(), -last("middle", "z"));
    assert!((force / cable.force - 1.0).abs() < 1e-6, "{force} for {}", cable.force);
    assert!((sag / cable.sag() - 1.0).abs() < 1e-6, "{sag} for {}", cable.sag());
    let warnings = session.simulation().warnings();
    assert!(warnings.iter().any(|warning| matches!(warning, Warning::Relaxed { .. })), "{warnings:?}");
    // Weight that grows with the load parameter is accounted for as such: few steps, and nothing that looks like a jump.
    assert!(!warnings.iter().any(|warning| matches!(warning, Warning::Jump { .. })), "{warnings:?}");
    assert!(record.times.len() < 60, "{} load steps", record.times.len());
}

#[test]
fn a_given_number_of_load_steps_finds_it_too() {
    let cable = Cable::new(0.4, 500.0);
    let text = cable.model(24, "statics").replace("kind = \"statics\"", "kind = \"statics\"\nsteps = 3");
    let model = Model::from_text("cable.toml", &text);
    let mut session = Session::new(&model.document().unwrap()).unwrap();
    let record = session.run().unwrap();
    assert_eq!(record.times.len(), 4);
    let force = record.column("support", "f1").unwrap().last().unwrap().abs();
    assert!((force / cable.force - 1.0).abs() < 1e-6, "{force} for {}", cable.force);
    let warnings = session.simulation().warnings();
    assert!(warnings.iter().any(|warning| matches!(warning, Warning::Relaxed { .. })), "{warnings:?}");
}

#[test]
fn a_path_along_a_number_begins_where_relaxation_ends() {
    let cable = Cable::new(0.4, 500.0);
    let text = cable.model(24, "path").replace(
        &format!("gravity = [0, 0, -{GRAVITY}]"),
        &format!("gravity = [0, 0, \"-g\"]\n[parameters]\ng = {GRAVITY}"),
    );
    let along = format!("{text}vary = \"parameters.g\"\nend = 20\n");
    let mut session = PathSession::new(&Model::from_text("cable.toml", &along)).unwrap();
    assert!(session.warnings().iter().any(|warning| matches!(warning, Warning::Relaxed { .. })));
    let (record, report) = session.record();
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    let forces = record.column("support", "f1").unwrap();
    for (found, gravity) in [(forces[0], GRAVITY), (forces[forces.len() - 1], 20.0)] {
        let exact = cable.force_under(gravity);
        assert!((found.abs() / exact - 1.0).abs() < 1e-6, "{found} for {exact} under {gravity}");
    }
    let summary = session.summary(Summary::new(), &report);
    let reported = summary.get("warnings").unwrap().to_string();
    assert!(reported.contains("relaxed-equilibrium"), "{reported}");
    // Along the load factor there is nothing to begin with, and the message says what to do.
    let mut session = PathSession::new(&Model::from_text("cable.toml", &format!("{text}end = 1\n"))).unwrap();
    let (_, report) = session.record();
    let PathEnd::Failed(error) = report.end else { panic!("{:?}", report.end) };
    assert!(error.to_string().contains("apply tension"), "{error}");
}

#[test]
fn a_cable_has_the_frequencies_of_the_linearised_catenary() {
    // λ² on both sides of 4π² = 39.478, where the first symmetric mode crosses the first antisymmetric one; sags of 1/100 and 1/20.
    for (slope, lambda_squared) in [(0.08, 26.0), (0.08, 39.0), (0.08, 40.0), (0.08, 60.0), (0.4, 500.0)] {
        let cable = Cable::new(slope, lambda_squared);
        let exact = cable.exact(4.6);
        let (found, report) = found(&cable, 32, exact.len());
        assert!(exact.len() >= 7, "{exact:?}");
        let error = largest_error(&found, &exact);
        assert!(error < 5e-7, "{error:e}: {found:?} for {exact:?}");
        assert!(
            report.warnings.iter().any(|words| words.code() == "relaxed-equilibrium"),
            "{:?}",
            report.warnings
        );
    }
}

#[test]
fn small_sag_has_irvines_frequencies_to_the_square_of_the_sag() {
    for lambda_squared in [30.0, 4.0 * PI * PI, 120.0] {
        let theory = irvine(lambda_squared, 4.6);
        let errors = [0.16, 0.08, 0.04].map(|slope| {
            let (found, _) = found(&Cable::new(slope, lambda_squared), 20, theory.len());
            largest_error(&found, &theory)
        });
        // Sags of 1/50, 1/100 and 1/200 of the span: three to four digits, and a factor of four each time.
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((1.9..2.1).contains(&order), "λ² = {lambda_squared}: {errors:?}");
        }
        assert!(errors[2] < 3e-4, "λ² = {lambda_squared}: {errors:?}");
    }
}

#[test]
fn the_first_symmetric_mode_passes_the_antisymmetric_one_where_irvine_says() {
    // Below 4π² the lowest mode in the plane is symmetric: it moves the middle; above it is antisymmetric.
    for (lambda_squared, moves) in [(36.0, true), (43.0, false)] {
        let cable = Cable::new(0.04, lambda_squared);
        let (numbers, _) = found(&cable, 24, 4);
        assert!((numbers[0] - 1.0).abs() < 1e-3, "{numbers:?}");
        // The second one across the plane, the antisymmetric and the symmetric one: all near 2.
        assert!(numbers[1..].iter().all(|number| (number - 2.0).abs() < 0.12), "{numbers:?}");
        let symmetric =
            irvine(lambda_squared, 2.5).into_iter().find(|n| (n - n.round()).abs() > 1e-6).unwrap();
        assert_eq!(symmetric < 2.0, moves);
        let nearest = numbers[1..].iter().map(|n| (n - symmetric).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-3, "{numbers:?} for {symmetric}");
    }
}

#[test]
fn frequencies_of_a_cable_converge_by_mesh() {
    let cable = Cable::new(0.16, 60.0);
    let exact = cable.exact(4.6);
    let errors = [4, 8].map(|elements| largest_error(&found(&cable, elements, exact.len()).0, &exact));
    assert!(errors[0] / errors[1] > 16.0, "{errors:?}");
}
