//! Equilibrium paths against closed forms and independent solutions.

use crate::support::paths;
use crate::support::truss;

use lissom::Model;
use lissom::analyses::path::{PathEnd, PathSession};
use lissom_core::path::CriticalKind;
use paths::{follow, near};
use truss::truss;

/// The truss under a load of 1 N, with its energy, along its load.
fn along_load(height: f64, end: f64) -> String {
    let rest = format!("[outputs.energy]\nkind = \"energy\"\n[analysis]\nkind = \"path\"\nend = {end}\n");
    truss(height, -1, &rest)
}

#[test]
fn a_shallow_truss_snaps_through() {
    let height = 0.3_f64;
    let free = (1.0 + height * height).sqrt();
    let (record, report) = follow(&along_load(height, 60.0), &[]);
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
    let (_, report) = follow(&along_load(3.0, 1.0), &[("analysis.end", "12000"), ("analysis.step", "50")]);
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
const LEE: &str = include_str!("../../../../verification/lee-frame/limit.toml");

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

const ARCH: &str = include_str!("../../../../verification/deep-arch/model.toml");

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

/// What is left at the far end of the deep arch as a rod of the plane [shooting over x, y, tangent angle and moment]: position and
/// moment of its hinge, for force and moment at its clamp, and the position of the apex.
fn shoot_arch([horizontal, vertical, moment]: [f64; 3], load: f64) -> ([f64; 3], [f64; 2]) {
    const STEPS: usize = 400;
    let (radius, half) = (100.0, 107.5_f64.to_radians());
    let step = radius * half / STEPS as f64;
    let mut state = [-95.371_695_074_822_7, -30.070_579_950_427_312, half, moment];
    let mut apex = [0.0; 2];
    for part in 0..2 {
        let up = if part == 0 { vertical } else { vertical + load };
        let rates = |[_, _, angle, moment]: [f64; 4]| {
            let (sine, cosine) = angle.sin_cos();
            let along = 1.0 + (horizontal * cosine + up * sine) / 1e8;
            let across = (up * cosine - horizontal * sine) / 1e8;
            let (x, y) = (along * cosine - across * sine, along * sine + across * cosine);
            [x, y, moment / 1e6 - 1.0 / radius, horizontal * y - up * x]
        };
        for _ in 0..STEPS {
            let moved = |rate: [f64; 4], part: f64| std::array::from_fn(|i| state[i] + part * step * rate[i]);
            let one = rates(state);
            let two = rates(moved(one, 0.5));
            let three = rates(moved(two, 0.5));
            let four = rates(moved(three, 1.0));
            for i in 0..4 {
                state[i] += step / 6.0 * (one[i] + 2.0 * (two[i] + three[i]) + four[i]);
            }
        }
        if part == 0 {
            apex = [state[0], state[1]];
        }
    }
    ([state[0] - 95.371_695_074_822_7, state[1] + 30.070_579_950_427_312, state[3] / 1e4], apex)
}

/// Newton's method from a guess: force and moment at the clamp, scaled to be of one size, and the position of the apex.
fn solve_arch(mut guess: [f64; 3], load: f64) -> Option<[f64; 2]> {
    let scales = [1e3, 1e3, 1e5];
    for _ in 0..30 {
        let (missed, apex) = shoot_arch(guess, load);
        if missed.iter().all(|value| value.abs() < 1e-9) {
            return Some(apex);
        }
        let columns: [[f64; 3]; 3] = std::array::from_fn(|k| {
            let mut other = guess;
            other[k] += 1e-6 * scales[k];
            let (changed, _) = shoot_arch(other, load);
            std::array::from_fn(|i| (changed[i] - missed[i]) / 1e-6)
        });
        let determinant = |m: &[[f64; 3]; 3]| {
            m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
                - m[1][0] * (m[0][1] * m[2][2] - m[0][2] * m[2][1])
                + m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1])
        };
        let whole = determinant(&columns);
        for k in 0..3 {
            let mut replaced = columns;
            replaced[k] = missed;
            guess[k] -= scales[k] * determinant(&replaced) / whole;
        }
    }
    None
}

#[test]
fn the_deep_arch_goes_on_beyond_its_limit() {
    let text = ARCH
        .replace("scale = \"limit*(1-(1-t)^2)\"\n", "")
        .replace("steps = 120\nend = 1\n", "end = 1000\nstep = 50\nsteps = 150\n")
        .replace("kind = \"statics\"", "kind = \"path\"")
        .replace("[analysis]", "[outputs.clamp]\nkind = \"reaction\"\nof = \"left\"\n\n[analysis]");
    let (record, report) = follow(&text, &[]);
    let factors = record.column("load_factor", "").unwrap();
    let column = |name: &str, part: &str| record.column(name, part).unwrap();
    let (x, y) = (column("apex", "u1"), column("apex", "u2"));
    let reaction = ["f1", "f2", "m3"].map(|part| column("clamp", part));
    let top = (0..factors.len()).max_by(|&a, &b| factors[a].total_cmp(&factors[b])).unwrap();
    let mut beyond = 0;
    for row in (1..factors.len()).filter(|&row| row + 5 > top && row % 3 == 0) {
        let found = [1.0, -1.0].iter().find_map(|sign| {
            let guess = reaction.map(|values| sign * values[row]);
            let apex = solve_arch(guess, factors[row])?;
            let missed = (apex[0] - x[row]).hypot(apex[1] - 100.0 - y[row]);
            (missed < 1.0).then_some(missed)
        });
        // Near limit points the load says little of the position, elsewhere seven digits.
        let near_limit = report.critical.iter().any(|point| (point.load_factor - factors[row]).abs() < 2.0);
        let missed = found.unwrap_or_else(|| panic!("no equilibrium at {} ({row})", factors[row]));
        assert!(missed < if near_limit { 1e-2 } else { 1e-4 }, "{missed:e} m at {} ({row})", factors[row]);
        beyond += usize::from(row > top);
    }
    assert!(beyond > 10, "{beyond} equilibria beyond the limit");
    let least = factors[top..].iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least < 500.0, "down to {least}");
}

const BEND: &str = include_str!("../../../../verification/bend-45/model.toml");

/// Shooting of the rod in space, 17 digits, as in the verification of the same bend by load steps.
#[test]
fn the_bend_of_45_degrees_has_its_tip_along_the_path() {
    let text = BEND
        .replace("vector = [0, 0, 600.0]\nscale = \"t\"\n", "vector = [0, 0, 1]\n")
        .replace("steps = 24\nend = 1\n", "end = 600\nstep = 50\n")
        .replace("kind = \"statics\"", "kind = \"path\"");
    for (end, exact) in [
        ("300", [58.778_897_329_974_77, 22.244_679_426_675_795, 40.192_392_332_295_25]),
        ("450", [52.238_261_846_722_55, 18.508_064_875_592_15, 48.503_491_531_814]),
        ("600", [47.150_096_240_342_04, 15.684_689_478_979_672, 53.475_477_998_225_045]),
    ] {
        let (record, report) = follow(&text, &[("analysis.end", end)]);
        assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
        assert!(report.critical.is_empty(), "{:?}", report.critical);
        for (part, exact) in ["x", "y", "z"].into_iter().zip(exact) {
            let found = *record.column("tip", part).unwrap().last().unwrap();
            assert!((found - exact).abs() < 1e-6, "{part} at {end} N: {found} for {exact}");
        }
    }
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
    let text = along_load(0.3, 60.0).replace("lissom = 1\n", "lissom = 1\ngravity = [0, -1, 0]\n");
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
        PathSession::new(&Model::from_text("model.toml", text)).map(|_| ()).unwrap_err().to_string()
    };
    let idle = along_load(0.3, 1.0).replace("vector = [0, -1, 0]", "vector = [0, -1, 0]\nscale = \"t - 1\"");
    assert!(start(&idle).contains("load factor has no effect"));
    let (record, report) = follow(&along_load(0.3, 1.0), &[("analysis.steps", "3"), ("analysis.end", "1e6")]);
    assert!(matches!(report.end, PathEnd::Failed(_)));
    assert_eq!(record.times.len(), 4);
    let wrong = Model::from_text("model.toml", &along_load(0.3, 0.0)).document().unwrap_err();
    assert!(wrong.render(false).contains("load factor 0"), "{}", wrong.render(false));
}
