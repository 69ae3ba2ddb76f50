//! Every two forms that can touch, with every solution of contacts: a form on a guide rests on another one.

use lissom::core::contact::forms::{FormKind, parts_between};

use crate::support::runs::run;
use crate::support::series::{last, series};

/// Weight of the form [N].
const WEIGHT: f64 = 9.81;
/// Stiffness at a point [N/m].
const STIFFNESS: f64 = 1e6;

/// A shape of a kind, about as large as 0.2 m, with its axis along y, as a prism lies; no symmetry rotates it on its guide.
fn shape(kind: FormKind) -> String {
    let own = match kind {
        FormKind::Plane => "kind = \"plane\"",
        FormKind::Sphere => "sphere = 0.1",
        FormKind::Capsule => "kind = \"capsule\", radius = 0.1, length = 0.2, axis = \"y\"",
        FormKind::Cylinder => "kind = \"cylinder\", radius = 0.1, length = 0.2, axis = \"y\"",
        FormKind::Tube => "kind = \"tube\", radius = 0.1, inner_radius = 0.05, length = 0.2, axis = \"y\"",
        FormKind::Box => "box = [0.2, 0.2, 0.2]",
        FormKind::Ellipsoid => "kind = \"ellipsoid\", semi_axes = [0.1, 0.15, 0.08]",
        FormKind::Hull => {
            "kind = \"hull\", points = [[0.1, 0.1, -0.1], [-0.1, 0.1, -0.1], [-0.1, -0.1, -0.1], [0.1, -0.1, -0.1], [0.06, 0.06, 0.1], \
             [-0.06, 0.06, 0.1], [-0.06, -0.06, 0.1], [0.06, -0.06, 0.1]]"
        }
        FormKind::Polygon => {
            "kind = \"outline\", points = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]], length = 0.2, axis = \"y\""
        }
        FormKind::Outline => {
            "kind = \"outline\", smooth = true, points = [[0.1, 0], [0.08, 0.06], [0, 0.09], [-0.08, 0.06], [-0.1, 0], [-0.08, -0.06], \
             [0, -0.09], [0.08, -0.06]], length = 0.2, axis = \"y\""
        }
        FormKind::Mesh => "kind = \"mesh\", file = \"block.obj\"",
        FormKind::HeightField => {
            "kind = \"height_field\", extent = [0.4, 0.4], heights = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]"
        }
    };
    format!("{{ {own} }}")
}

/// One way to solve contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Solution {
    Elements,
    Rigid,
    Set,
}

fn model([base, tip]: [FormKind; 2], solution: Solution) -> String {
    let law = match solution {
        Solution::Rigid => "rigid = true".to_owned(),
        _ => format!("stiffness = {STIFFNESS}\ndissipation = 5"),
    };
    let steps = if solution == Solution::Set { "scheme = \"backward-euler\"\nstep = 1e-3\n" } else { "" };
    format!(
        "lissom = 1\ngravity = [0, 0, -{WEIGHT}]\n[ground]\nshape = {}\n[bodies.part]\nmass = 1\ninertia = [0.01, 0.01, 0.01]\nshape = {}\n\
         position = [0, 0, 0.22]\n[joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"part\"\naxis = \"z\"\n\
         [contacts.all]\nbase = \"ground\"\ntip = \"part\"\n{law}\n[outputs.all]\nkind = \"contact_force\"\nof = \"all\"\n\
         [outputs.energy]\nkind = \"energy\"\n[analysis]\nkind = \"dynamics\"\nend = 2\n{steps}",
        shape(base),
        shape(tip)
    )
}

/// Forms whose shape needs a file, and are tested in `shapes`.
fn has_file(kind: FormKind) -> bool {
    kind == FormKind::Mesh
}

/// Every pair of the table rests with its weight: all solutions report one force and one point, elements and sets one penetration, rigid
/// ones none; no energy is gained on the way. A new pair is examined as soon as it is in the table.
#[test]
fn every_pair_rests_with_every_solution() {
    let mut pairs = 0;
    for &base in FormKind::ALL {
        for &tip in FormKind::ALL {
            // A body is no plane or height field, and which of two is the base does not matter.
            let can_move = !matches!(tip, FormKind::Plane | FormKind::HeightField);
            if !can_move || has_file(base) || has_file(tip) || parts_between([base, tip]).is_none() {
                continue;
            }
            pairs += 1;
            let mut gaps = Vec::new();
            for solution in [Solution::Elements, Solution::Rigid, Solution::Set] {
                let what = format!("{} on {}, {solution:?}", tip.words(), base.words());
                let record = run(&model([base, tip], solution), &[]);
                let normal = last(&record, "all.normal");
                let force = ["f1", "f2", "f3"].map(|axis| last(&record, &format!("all.{axis}")));
                assert!((force[2] - WEIGHT).abs() < 1e-4 * WEIGHT, "{what}: {force:?}");
                assert!(normal > (1.0 - 1e-4) * WEIGHT, "{what}: {normal}");
                let energy = series(&record, "energy.total");
                let rise = energy.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::NEG_INFINITY, f64::max);
                assert!(rise < 1e-6 * energy[0], "{what}: {rise:e}");
                gaps.push(last(&record, "all.gap"));
            }
            let [elements, rigid, set] = gaps[..] else { unreachable!("three solutions") };
            let what = format!("{} on {}: {gaps:?}", tip.words(), base.words());
            assert!(elements < 0.0 && (set - elements).abs() < 1e-3 * elements.abs(), "{what}");
            assert!(rigid.abs() < 1e-9, "{what}");
        }
    }
    assert!(pairs > 30, "{pairs} pairs");
}

/// Restitution of impacts.
const RESTITUTION: f64 = 0.5;

/// Every pair rebounds with its restitution: a form on a guide flies at 1 m/s against another one, without weight. Edges are crowned, so
/// that corners and edges touch one after the other: elements then miss the restitution by 0.3 %.
#[test]
fn every_pair_rebounds_with_every_solution() {
    for &base in FormKind::ALL {
        for &tip in FormKind::ALL {
            let can_move = !matches!(tip, FormKind::Plane | FormKind::HeightField);
            if !can_move || has_file(base) || has_file(tip) || parts_between([base, tip]).is_none() {
                continue;
            }
            for solution in [Solution::Elements, Solution::Rigid, Solution::Set] {
                let what = format!("{} on {}, {solution:?}", tip.words(), base.words());
                let text = model([base, tip], solution)
                    .replace("dissipation = 5", &format!("restitution = {RESTITUTION}"))
                    .replace("rigid = true", &format!("rigid = true\nrestitution = {RESTITUTION}"))
                    .replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, 0]")
                    .replace("axis = \"z\"\n[contacts", "axis = \"z\"\nvelocity = -1\n[outputs.v]\nkind = \"velocity\"\nof = \"part\"\n[contacts")
                    .replace("end = 2", "end = 0.3");
                let velocity = last(&run(&text, &[]), "v.v3");
                assert!((velocity - RESTITUTION).abs() < 3e-3, "{what}: {velocity}");
            }
        }
    }
}
