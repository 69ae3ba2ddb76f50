//! Equilibrium paths against closed forms and independent solutions.

use lissom::path::{PathEnd, PathReport, PathSession};
use lissom::{Model, Record};
use lissom_core::analysis::path::CriticalKind;

fn follow(text: &str, overrides: &[(&str, &str)]) -> (Record, PathReport) {
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|&(path, value)| (path.to_owned(), value.to_owned())).collect();
    let model = Model::from_text("model.toml", text);
    PathSession::new(&model, &overrides).unwrap_or_else(|error| panic!("{error}")).record()
}

fn near(found: f64, exact: f64, tolerance: f64) {
    assert!(
        (found - exact).abs() <= tolerance * exact.abs(),
        "{found} for {exact}: {:e}",
        found / exact - 1.0
    );
}

/// Two springs of rate 1000 N/m lean on each other under a load of 1 N.
fn truss(height: f64, end: f64) -> String {
    format!(
        r#"
lissom = 1
[point_masses.top]
mass = 1.0
position = [0, {height}, 0]
plane = "xy"
[springs.left]
kind = "point"
base = "ground"
at_base = [-1, 0, 0]
tip = "top"
stiffness = 1000.0
[springs.right]
kind = "point"
base = "ground"
at_base = [1, 0, 0]
tip = "top"
stiffness = 1000.0
[loads.down]
kind = "force"
on = "top"
vector = [0, -1, 0]
[outputs.top]
kind = "position"
of = "top"
[outputs.energy]
kind = "energy"
[analysis]
kind = "path"
end = {end}
"#
    )
}

#[test]
fn a_shallow_truss_snaps_through() {
    let height = 0.3_f64;
    let free = (1.0 + height * height).sqrt();
    let (record, report) = follow(&truss(height, 60.0), &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    let factors = record.column("load_factor", "").unwrap();
    let heights = record.column("top", "y").unwrap();
    let load = |y: f64| 2000.0 * (free / (1.0 + y * y).sqrt() - 1.0) * y;
    for (&factor, &y) in factors.iter().zip(heights) {
        assert!((factor - load(y)).abs() < 1e-8, "{factor} at {y}, not {}", load(y));
    }
    near(*factors.last().unwrap(), 60.0, 1e-12);
    assert!(*heights.last().unwrap() < -height, "beyond the snap");
    assert!(record.times.windows(2).all(|pair| pair[1] > pair[0]), "the length of the path grows");
    // Both limit points: ℓ³ = ℓ₀ b².
    let length = free.cbrt();
    let limit = 2000.0 * (free / length - 1.0) * (length * length - 1.0).sqrt();
    assert_eq!(report.critical.len(), 2, "{:?}", report.critical);
    for (point, sign) in report.critical.iter().zip([1.0, -1.0]) {
        assert_eq!(point.kind, CriticalKind::Limit);
        near(point.load_factor, sign * limit, 1e-10);
        assert!(point.is_located);
    }
    assert_eq!([report.critical[0].unstable, report.critical[1].unstable], [[0, 1], [1, 0]]);
    let unstable = record.column("unstable", "").unwrap();
    assert!(unstable.contains(&1.0) && unstable.first() == Some(&0.0) && unstable.last() == Some(&0.0));
}

#[test]
fn a_steep_truss_bifurcates_before_its_limit() {
    let free = 10.0_f64.sqrt();
    let (_, report) = follow(&truss(3.0, 1.0), &[("analysis.end", "12000"), ("analysis.step", "50")]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    // Sideways: ℓ³ - ℓ₀ ℓ² + ℓ₀ = 0, the larger root.
    let mut length = 3.0_f64;
    for _ in 0..50 {
        length -=
            (length.powi(3) - free * length.powi(2) + free) / (3.0 * length * length - 2.0 * free * length);
    }
    let y = (length * length - 1.0).sqrt();
    let first = &report.critical[0];
    assert_eq!((first.kind, first.unstable), (CriticalKind::Bifurcation, [0, 1]));
    near(first.load_factor, 2000.0 * (free / length - 1.0) * y, 1e-8);
    let limits: Vec<f64> = report
        .critical
        .iter()
        .filter(|point| point.kind == CriticalKind::Limit)
        .map(|point| point.load_factor)
        .collect();
    let length = free.cbrt();
    let limit = 2000.0 * (free / length - 1.0) * (length * length - 1.0).sqrt();
    assert_eq!(limits.len(), 2);
    near(limits[0], limit, 1e-9);
    near(limits[1], -limit, 1e-9);
}

/// Lee's frame in its plane: two beams of length 120 at a right angle, hinged at both ends.
const LEE: &str = include_str!("../../../verification/lee-frame/limit.toml");

#[test]
fn lees_frame_passes_both_limits_and_its_snap_back() {
    let text = LEE
        .replace("scale = \"limit*(1-(1-t)^2)\"\n", "")
        .replace("steps = 40\nend = 1\n", "end = 20000\nstep = 1000\n")
        .replace("kind = \"statics\"", "kind = \"path\"");
    let (record, report) = follow(&text, &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    let limits: Vec<f64> = report
        .critical
        .iter()
        .filter(|point| point.kind == CriticalKind::Limit)
        .map(|point| point.load_factor)
        .collect();
    assert_eq!(limits.len(), 2, "{:?}", report.critical);
    // Planar shooting, 1e-10.
    near(limits[0], 18_544.527_094_44, 1e-7);
    // Snap-back: the deflection under the load goes back from 61.0 to 50.7.
    let down: Vec<f64> = record.column("load", "u2").unwrap().iter().map(|value| -value).collect();
    let turn = (1..down.len()).find(|&k| down[k] < down[k - 1]).unwrap();
    assert!((60.0..61.2).contains(&down[turn - 1]), "{}", down[turn - 1]);
    let least = down[turn..].iter().copied().fold(f64::INFINITY, f64::min);
    assert!((50.6..52.0).contains(&least), "{least}");
}

#[test]
fn lees_stiff_frame_has_the_limits_of_the_inextensible_one() {
    let stiff = LEE
        .replace("scale = \"limit*(1-(1-t)^2)\"\n", "")
        .replace("steps = 40\nend = 1\n", "end = 19000\nstep = 1000\n")
        .replace("kind = \"statics\"", "kind = \"path\"")
        .replace("[43200000.0, 13846153.846153844, 13846153.846153844,", "[4.32e10, 4.32e10, 4.32e10,");
    let (_, report) = follow(&stiff, &[]);
    let limits = report.critical.iter().filter(|point| point.kind == CriticalKind::Limit);
    let limits: Vec<f64> = limits.map(|point| point.load_factor).collect();
    assert_eq!(limits.len(), 2, "{:?}", report.critical);
    // Planar shooting of the inextensible frame; the second one with four digits.
    near(limits[0], 18_558.746_539_48, 1e-6);
    near(limits[1], -9421.0, 1e-4);
}

const ARCH: &str = include_str!("../../../verification/deep-arch/model.toml");

#[test]
fn the_deep_arch_has_its_limit() {
    let text = ARCH
        .replace("scale = \"limit*(1-(1-t)^2)\"\n", "")
        .replace("steps = 120\nend = 1\n", "end = 1000\nstep = 50\nsteps = 60\n")
        .replace("kind = \"statics\"", "kind = \"path\"");
    let (_, report) = follow(&text, &[]);
    let limit = report.critical.iter().find(|point| point.kind == CriticalKind::Limit).unwrap();
    near(limit.load_factor, 897.289_133_844_385, 1e-7);
}

#[test]
fn an_euler_column_bifurcates_at_its_load() {
    let text = r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e7, 1e7, 1e7, 1e4, 100, 300]
mass = [1, 1, 1, 1, 1, 1]
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = 8
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[loads.push]
kind = "force"
on = "bar.end"
vector = [-1, 0, 0]
[analysis]
kind = "path"
end = 900
step = 50
"#;
    let (_, report) = follow(text, &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    // π² EI/(4L²), a little changed by shortening and shear.
    let exact = [100.0, 300.0].map(|bending| std::f64::consts::PI.powi(2) * bending / 4.0);
    assert_eq!(report.critical.len(), 2, "{:?}", report.critical);
    for (point, exact) in report.critical.iter().zip(exact) {
        assert_eq!(point.kind, CriticalKind::Bifurcation);
        near(point.load_factor, exact, 3e-4);
    }
}

#[test]
fn gravity_counts_as_a_load() {
    let text = truss(0.3, 60.0).replace("lissom = 1\n", "lissom = 1\ngravity = [0, -1, 0]\n");
    let start = text.find("[loads.down]").unwrap();
    let end = text.find("[outputs.top]").unwrap();
    let text = [&text[..start], &text[end..]].concat();
    let (record, report) = follow(&text, &[]);
    let length = 1.09_f64.sqrt().cbrt();
    let limit = 2000.0 * (1.09_f64.sqrt() / length - 1.0) * (length * length - 1.0).sqrt();
    near(report.critical[0].load_factor, limit, 1e-10);
    // The potential is that of the gravity in force.
    let potential = record.column("energy", "potential").unwrap();
    let (factors, heights) = (record.column("load_factor", "").unwrap(), record.column("top", "y").unwrap());
    for ((potential, factor), y) in potential.iter().zip(factors).zip(heights) {
        assert!((potential - factor * y).abs() < 1e-9);
    }
}

#[test]
fn a_path_that_cannot_be_is_refused() {
    let start = |text: &str| {
        PathSession::new(&Model::from_text("model.toml", text), &[]).map(|_| ()).unwrap_err().to_string()
    };
    let idle = truss(0.3, 1.0).replace("vector = [0, -1, 0]", "vector = [0, -1, 0]\nscale = \"t\"");
    assert!(start(&idle).contains("load factor changes nothing"));
    let (record, report) = follow(&truss(0.3, 1.0), &[("analysis.steps", "3"), ("analysis.end", "1e6")]);
    assert!(matches!(report.end, PathEnd::Failed(_)));
    assert_eq!(record.times.len(), 4);
    let wrong = Model::from_text("model.toml", &truss(0.3, 0.0)).document(&[]).unwrap_err();
    assert!(wrong.render(false).contains("load factor 0"), "{}", wrong.render(false));
}
