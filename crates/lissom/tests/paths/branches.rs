//! Branches of equilibrium paths against closed forms and independent solutions.

use crate::support::paths;
use crate::support::truss;

use lissom::Model;
use lissom::analyses::path::PathEnd;
use lissom_core::path::CriticalKind;
use paths::{follow, near};
use truss::truss;

/// A truss that buckles sideways before it snaps through.
fn high_truss() -> String {
    truss(3, -1, "[analysis]\nkind = \"path\"\nend = 400\nstep = 50\n")
}

/// Forces of the truss's springs on its top at (x, y), to the right and up.
fn truss_forces([x, y]: [f64; 2]) -> [f64; 2] {
    let free = 10.0_f64.sqrt();
    let of = |foot: f64| {
        let length = ((x - foot).powi(2) + y * y).sqrt();
        let force = -1000.0 * (length - free) / length;
        [force * (x - foot), force * y]
    };
    let ([a, b], [c, d]) = (of(-1.0), of(1.0));
    [a + c, b + d]
}

#[test]
fn a_steep_truss_goes_sideways_on_its_branch_in_either_sense() {
    let mut ends = Vec::new();
    for (branch, sense) in [("1", 1.0), ("-1", -1.0)] {
        let (record, report) = follow(&high_truss(), &[("analysis.branch", branch)]);
        assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
        assert_eq!(report.critical[0].kind, CriticalKind::Bifurcation);
        let column = |name: &str, part: &str| record.column(name, part).unwrap();
        let (factors, x, y) = (column("load_factor", ""), column("top", "x"), column("top", "y"));
        let mut aside = 0;
        for ((&factor, &x), &y) in factors.iter().zip(x).zip(y) {
            let [across, up] = truss_forces([x, y]);
            assert!(across.abs() < 1e-6, "{across} at ({x}, {y})");
            assert!((up - factor).abs() < 1e-6, "{factor} for {up}");
            aside += usize::from(x * sense > 1e-3);
            assert!(x * sense > -1e-9, "{x} is on the other side");
        }
        assert!(aside > 5, "{aside} equilibria beside the axis");
        // The load at the bifurcation is above the end, which counts on the branch.
        assert!(report.critical[0].load_factor > 400.0);
        near(*factors.last().unwrap(), 400.0, 1e-12);
        ends.push(*x.last().unwrap());
    }
    assert!(ends[0] > 0.1, "{ends:?}");
    near(ends[1], -ends[0], 1e-8);
}

/// An Euler column, a thousand times softer in bending than along itself.
const COLUMN: &str = r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e9, 1e9, 1e9, 1e4, 100, 300]
mass = [1, 1, 1, 1, 1, 1]
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = 16
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[loads.push]
kind = "force"
on = "bar.end"
vector = [-1, 0, 0]
[outputs.tip]
kind = "displacement"
of = "bar.end"
[analysis]
kind = "path"
end = 320
step = 50
branch = 1
"#;

/// Complete elliptic integrals K and E of modulus k, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> [f64; 2] {
    let (mut a, mut b, mut power, mut sum) = (1.0_f64, (1.0 - k * k).sqrt(), 0.5_f64, 0.5 * k * k);
    for _ in 0..40 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        power *= 2.0;
        sum += power * c * c;
    }
    let first = std::f64::consts::FRAC_PI_2 / a;
    [first, first * (1.0 - sum)]
}

#[test]
fn a_column_follows_the_elastica_beyond_its_load() {
    let (record, report) = follow(COLUMN, &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    let bending = 100.0;
    near(report.critical[0].load_factor, std::f64::consts::PI.powi(2) * bending / 4.0, 1e-5);
    // P L²/EI = K(k)², tip at x = (2E/K - 1) L and y = 2 (k/K) L [Euler 1744; Love].
    let (mut low, mut high) = (0.0_f64, 0.99_f64);
    for _ in 0..80 {
        let k = 0.5 * (low + high);
        if elliptic(k)[0].powi(2) * bending < 320.0 { low = k } else { high = k }
    }
    let [first, second] = elliptic(low);
    let last = |part: &str| *record.column("tip", part).unwrap().last().unwrap();
    near(last("u1"), 2.0 * second / first - 2.0, 1e-5);
    let aside = last("u2").hypot(last("u3"));
    near(aside, 2.0 * low / first, 1e-5);
    // About the softer axis, and stable.
    assert!(last("u2").abs() < 1e-6 * aside, "{}", last("u2"));
    assert_eq!(*record.column("unstable", "").unwrap().last().unwrap(), 0.0);
}

/// A circular arch of radius 100 m over 40 degrees, hinged at both ends, under a force at its crown.
const SHALLOW_ARCH: &str = r#"
lissom = 1
[sections.arch]
shape = "general"
stiffness = [1e8, 1e8, 1e8, 1e10, 1e10, 1e6]
mass = [1, 1, 1, 1, 1, 1]
[beams.arch]
section = "arch"
from = [-34.20201433256687, 0, 0]
through = [0, 6.030737921409168, 0]
to = [34.20201433256687, 0, 0]
elements = 32
up = [0, 0, 1]
[joints.left]
kind = "revolute"
base = "ground"
tip = "arch.start"
axis = [0, 0, 1]
[joints.right]
kind = "revolute"
base = "ground"
tip = "arch.end"
axis = [0, 0, 1]
[loads.crown]
kind = "force"
on = "arch@0.5"
vector = [0, -1, 0]
[outputs.crown]
kind = "displacement"
of = "arch@0.5"
[analysis]
kind = "path"
end = 3242.463348
step = 190
branch = 1
"#;

/// Shooting of the planar rod's equations: the antisymmetric branch begins at 3358.7618972 and descends; at 3242.463348
/// the crown has moved by (∓0.28567050, -1.66785991).
#[test]
fn a_hinged_shallow_arch_sways_on_its_branch() {
    let (record, report) = follow(SHALLOW_ARCH, &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    assert_eq!(report.critical[0].kind, CriticalKind::Bifurcation);
    near(report.critical[0].load_factor, 3_358.761_897_2, 2e-8);
    let last = |part: &str| *record.column("crown", part).unwrap().last().unwrap();
    near(last("u1").abs(), 0.285_670_50, 1e-5);
    near(last("u2"), -1.667_859_91, 1e-5);
}

const FRAME: &str = include_str!("../../../../verification/right-angle-frame/model.toml");

/// Shooting of the rod's equations in space: at a load of 1.16772834 the tip has moved by (16.6370672, 12.71709085, ±40).
#[test]
fn a_right_angle_frame_goes_over_to_its_lateral_branch() {
    let side = FRAME.find("[loads.side]").unwrap();
    let outputs = FRAME.find("[outputs.tip]").unwrap();
    let text = [&FRAME[..side], &FRAME[outputs..]]
        .concat()
        .replace("scale = \"t\"\n", "")
        .replace("kind = \"statics\"", "kind = \"path\"")
        .replace("steps = 200\nend = 1\n", "end = 1.16772834\nstep = 0.2\nbranch = 1\n");
    let (record, report) = follow(&text, &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    assert_eq!(report.critical[0].kind, CriticalKind::Bifurcation);
    near(report.critical[0].load_factor, 1.087_517_840_840_841, 1e-6);
    let last = |part: &str| *record.column("tip", part).unwrap().last().unwrap();
    near(last("u3").abs(), 40.0, 1e-4);
    near(last("u1"), 16.637_067_2, 1e-4);
    near(last("u2"), 12.717_090_85, 1e-4);
}

#[test]
fn a_branch_that_is_not_there_is_refused() {
    let (_, report) = follow(&high_truss(), &[("analysis.branch", "9"), ("analysis.steps", "400")]);
    let PathEnd::Failed(error) = &report.end else { panic!("{:?}", report.end) };
    let words = error.to_string();
    assert!(words.contains("bifurcation(s), not the 9"), "{words}");
    let half = Model::from_text("model.toml", &high_truss())
        .with_overrides(&[("analysis.branch".into(), "0.5".into())])
        .document();
    assert!(half.unwrap_err().render(false).contains("whole number"), "refused");
}
