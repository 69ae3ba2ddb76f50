//! What slides on a beam that flies and tumbles: nothing is given to both from outside.

use lissom::Record;

use super::{SCHEMES, column, run};

/// What slides: a name, its part of the model, and further keys of the slider.
type Rider = (&'static str, &'static str, &'static str);
const BEAD: Rider = ("bead", "[point_masses.bead]", "");
const TANGENT: Rider = ("car", CAR, "orientation = \"tangent\"");
const SECTION: Rider = ("car", CAR, "orientation = \"section\"");
const CAR: &str = "[bodies.car]\ninertia = [0.02, 0.03, 0.04]";

/// A line of beams over 2 m with 0.5 kg on it at 0.75 m.
fn flying(beams: &str, names: &str, (name, part, orientation): Rider) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, 0]
[sections.bar]
shape = "general"
stiffness = [1e5, 4e4, 4e4, 50, 40, 60]
mass = {{ per_length = 0.8, inertia = [2e-3, 1e-3, 1e-3] }}
{beams}
{part}
mass = 0.5
position = [0.75, 0, 0]
[joints.slide]
kind = "slider"
beams = [{names}]
tip = "{name}"
{orientation}
[initial]
velocity = [0.3, -0.2, 0.1]
angular_velocity = [0.5, 1, 3]
about = [1, 0, 0]
[outputs.slide]
kind = "relative"
of = "slide"
[outputs.momentum]
kind = "momentum"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 0.5
step = 1e-3
"#
    )
}

fn beam(name: &str, from: &str, to: &str, elements: usize) -> String {
    format!("[beams.{name}]\nsection = \"bar\"\nfrom = {from}\nto = {to}\nelements = {elements}\norder = 2\n")
}

/// Momentum and angular momentum stay within what is allowed for each component, energy within a thousandth. Where it has slid to.
fn kept(record: &Record, shown: &str, allowed: impl Fn(&str) -> f64) -> f64 {
    for component in ["p1", "p2", "p3", "l1", "l2", "l3"] {
        let values = column(record, "momentum", component);
        let most = values.iter().fold(0.0_f64, |most, value| most.max((value - values[0]).abs()));
        assert!(most < allowed(component), "{shown} {component}: {most}");
    }
    let energy = column(record, "energy", "total");
    let last = energy[energy.len() - 1];
    assert!((last / energy[0] - 1.0).abs() < 1e-3, "{shown}: {} {last}", energy[0]);
    let places = column(record, "slide", "displacement");
    places[places.len() - 1]
}

/// Beam and bead fly freely: momentum stays to the last digits, two beams in a row are one.
#[test]
fn momentum_stays_on_a_beam_that_flies() {
    let one = flying(&beam("one", "[0, 0, 0]", "[2, 0, 0]", 8), "\"one\"", BEAD);
    let halves =
        [beam("one", "[0, 0, 0]", "[1, 0, 0]", 4), beam("two", "\"one.end\"", "[2, 0, 0]", 4)].concat();
    let chain = flying(&halves, "\"one\", \"two\"", BEAD);
    for scheme in SCHEMES {
        let is_radau = scheme.starts_with("radau-iia") || scheme == "energy-decaying";
        let allowed = |component: &str| if component.starts_with('p') && is_radau { 1e-8 } else { 2e-4 };
        let set = [("analysis.scheme", scheme)];
        let ends = [&one, &chain].map(|text| kept(&run(text, &set), scheme, allowed));
        assert!((0.1..0.6).contains(&ends[0]), "it slides past nodes: {ends:?}");
        assert!((ends[0] - ends[1]).abs() < 1e-7, "{scheme}: {ends:?}");
    }
}

/// Beam and body fly and tumble, and hold each other: what one turns the other takes.
#[test]
fn momentum_stays_while_a_beam_turns_its_body() {
    for rider in [TANGENT, SECTION] {
        let text = flying(&beam("one", "[0, 0, 0]", "[2, 0, 0]", 8), "\"one\"", rider);
        for scheme in SCHEMES {
            let shown = format!("{} {scheme}", rider.2);
            let place = kept(&run(&text, &[("analysis.scheme", scheme)]), &shown, |_| 5e-4);
            assert!(place < 0.6, "{shown}: it slides past nodes");
        }
    }
}
