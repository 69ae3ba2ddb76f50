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

/// A fifth of all pairs, others every day, where `CI_SEED` is the date; all pairs without it.
fn pairs_of_the_day() -> Vec<[FormKind; 2]> {
    let day = std::env::var("CI_SEED").ok().and_then(|seed| seed.parse::<usize>().ok());
    let is_due = |index: usize| day.is_none_or(|day| (index + day).is_multiple_of(5));
    let all = all_pairs().into_iter().enumerate();
    all.filter(|(index, _)| is_due(*index)).map(|(_, pair)| pair).collect()
}

/// All pairs of forms that can be tested here, the second of which can move.
fn all_pairs() -> Vec<[FormKind; 2]> {
    let every = FormKind::ALL.iter().flat_map(|&base| FormKind::ALL.iter().map(move |&tip| [base, tip]));
    // A body is no plane or height field, and which of two is the base does not matter.
    let can_move = |kind: FormKind| !matches!(kind, FormKind::Plane | FormKind::HeightField);
    every
        .filter(|&[base, tip]| {
            can_move(tip) && !has_file(base) && !has_file(tip) && parts_between([base, tip]).is_some()
        })
        .collect()
}

/// Every pair of the table rests with its weight: all solutions report one force and one point, elements and sets one penetration, rigid
/// ones none; no energy is gained on the way. A new pair is examined as soon as it is in the table.
#[test]
fn every_pair_rests_with_every_solution() {
    let pairs = all_pairs();
    assert!(pairs.len() > 30, "{} pairs", pairs.len());
    for [base, tip] in pairs_of_the_day() {
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
        // In a set a cylinder also stands on points of its ends.
        let most = if matches!(tip, FormKind::Cylinder | FormKind::Tube) { 0.9 } else { 1e-3 };
        assert!(elements < 0.0 && (set - elements).abs() < most * elements.abs(), "{what}");
        assert!(rigid.abs() < 1e-9, "{what}");
    }
}

/// Restitution of impacts.
const RESTITUTION: f64 = 0.5;

/// Every pair rebounds with its restitution: a form on a guide flies at 1 m/s against another one, without weight. Edges are crowned, so
/// that corners and edges touch one after the other: elements then miss the restitution by 0.3 %.
#[test]
fn every_pair_rebounds_with_every_solution() {
    for [base, tip] in pairs_of_the_day() {
        for solution in [Solution::Elements, Solution::Rigid, Solution::Set] {
            let what = format!("{} on {}, {solution:?}", tip.words(), base.words());
            let text = model([base, tip], solution)
                .replace("dissipation = 5", &format!("restitution = {RESTITUTION}"))
                .replace("rigid = true", &format!("rigid = true\nrestitution = {RESTITUTION}"))
                .replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, 0]")
                .replace(
                    "axis = \"z\"\n[contacts",
                    "axis = \"z\"\nvelocity = -1\n[outputs.v]\nkind = \"velocity\"\nof = \"part\"\n[contacts",
                )
                .replace("end = 2", "end = 0.3");
            let velocity = last(&run(&text, &[]), "v.v3");
            assert!((velocity - RESTITUTION).abs() < 3e-3, "{what}: {velocity}");
        }
    }
}

/// Whether a form has a flat top.
fn is_flat(kind: FormKind) -> bool {
    matches!(
        kind,
        FormKind::Plane | FormKind::Box | FormKind::Hull | FormKind::Polygon | FormKind::HeightField
    )
}

/// Coefficient of friction.
const FRICTION: f64 = 0.3;

/// A text of a pair with friction, in which the part is lowered onto the base.
fn with_friction(pair: [FormKind; 2], solution: Solution) -> String {
    let base = if matches!(pair[0], FormKind::Plane | FormKind::HeightField) { 0.0 } else { 0.1 };
    let height = if pair[1] == FormKind::Ellipsoid {
        0.08
    } else if pair[1] == FormKind::Outline {
        0.09
    } else {
        0.1
    };
    model(pair, solution)
        .replace("position = [0, 0, 0.22]", &format!("position = [-0.02, 0, {}]", base + height))
        .replace("tip = \"part\"\nstiffness", &format!("tip = \"part\"\nfriction = {FRICTION}\nstiffness"))
        .replace("rigid = true", &format!("rigid = true\nfriction = {FRICTION}"))
        .replace("[outputs.all]", "[outputs.v]\nkind = \"velocity\"\nof = \"part\"\n[outputs.x]\nkind = \"position\"\nof = \"part\"\n[outputs.all]")
        .replace("end = 2", "end = 0.3")
}

/// Every form slides on a flat one to a stop in v²/(2 μ g), carried by a frame that does not turn.
#[test]
fn every_form_slides_to_a_stop_on_flat_ones() {
    for [base, tip] in pairs_of_the_day().into_iter().filter(|[base, _]| is_flat(*base)) {
        for (solution, allowed) in
            [(Solution::Elements, 6e-5), (Solution::Rigid, 2e-5), (Solution::Set, 4e-4)]
        {
            let what = format!("{} on {}, {solution:?}", tip.words(), base.words());
            let text = with_friction([base, tip], solution).replace(
                "[joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"",
                "[bodies.frame]\nmass = 1e-9\ninertia = [1e-9, 1e-9, 1e-9]\n\
                 [joints.along]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"frame\"\naxis = \"x\"\nvelocity = 0.3\n\
                 [joints.guide]\nkind = \"prismatic\"\nbase = \"frame\"",
            );
            let record = run(&text, &[]);
            let wanted = 0.3 * 0.3 / (2.0 * FRICTION * WEIGHT);
            let found = last(&record, "x.x") + 0.02;
            assert!((found - wanted).abs() < allowed, "{what}: {found} {wanted}");
            assert!(last(&record, "v.v1").abs() < 1e-4, "{what}");
        }
    }
}

/// A round form that slides begins to roll with v = v₀/(1 + J/(m R²)), here v₀/2.
#[test]
fn every_round_form_begins_to_roll_on_flat_ones() {
    let round = [FormKind::Sphere, FormKind::Capsule, FormKind::Cylinder, FormKind::Tube];
    for [base, tip] in
        pairs_of_the_day().into_iter().filter(|[base, tip]| is_flat(*base) && round.contains(tip))
    {
        for (solution, allowed) in
            [(Solution::Elements, 1e-4), (Solution::Rigid, 2e-4), (Solution::Set, 2e-3)]
        {
            let what = format!("{} on {}, {solution:?}", tip.words(), base.words());
            let text = with_friction([base, tip], solution)
                .replace(
                    "[joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"part\"\naxis = \"z\"\n",
                    "",
                )
                .replace("shape = ", "velocity = [0.2, 0, 0]\nshape = ")
                .replace("[ground]\nvelocity = [0.2, 0, 0]\n", "[ground]\n");
            let found = last(&run(&text, &[]), "v.v1");
            assert!((found - 0.1).abs() < allowed, "{what}: {found}");
        }
    }
}

/// Two moving forms exchange the momentum that their masses and the restitution determine.
#[test]
fn every_pair_of_moving_forms_exchanges_momentum() {
    let moves = |kind: FormKind| !matches!(kind, FormKind::Plane | FormKind::HeightField);
    for [base, tip] in pairs_of_the_day().into_iter().filter(|[base, _]| moves(*base)) {
        for (mass, solution) in [0.1, 10.0]
            .into_iter()
            .flat_map(|mass| [Solution::Elements, Solution::Rigid, Solution::Set].map(|own| (mass, own)))
        {
            let what = format!("{} on {} of {mass} kg, {solution:?}", tip.words(), base.words());
            let moving = format!(
                "[bodies.base]\nmass = {mass}\ninertia = [0.01, 0.01, 0.01]\nshape = {}\n[joints.rail]\nkind = \"prismatic\"\nbase = \"ground\"\n\
                 tip = \"base\"\naxis = \"z\"\n",
                shape(base)
            );
            let text = model([base, tip], solution)
                .replace(&format!("[ground]\nshape = {}\n", shape(base)), &moving)
                .replace("[contacts.all]\nbase = \"ground\"", "[contacts.all]\nbase = \"base\"")
                .replace("dissipation = 5", &format!("restitution = {RESTITUTION}"))
                .replace("rigid = true", &format!("rigid = true\nrestitution = {RESTITUTION}"))
                .replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, 0]")
                .replace(
                    "axis = \"z\"\n[contacts",
                    "axis = \"z\"\nvelocity = -1\n[outputs.v]\nkind = \"velocity\"\nof = \"part\"\n\
                     [outputs.u]\nkind = \"velocity\"\nof = \"base\"\n[contacts",
                )
                .replace("end = 2", "end = 0.1");
            let record = run(&text, &[]);
            let (own, other) = (last(&record, "v.v3"), last(&record, "u.v3"));
            assert!((own + mass * other + 1.0).abs() < 1e-6, "{what}: {own} {other}");
            assert!((own - other - RESTITUTION).abs() < 1e-2, "{what}: {own} {other}");
        }
    }
}

/// Three equal forms on each other carry three, two and one weight.
#[test]
fn every_form_on_itself_stands_in_stacks_of_three() {
    for [_, kind] in all_pairs().into_iter().filter(|[base, tip]| base == tip) {
        if parts_between([FormKind::Plane, kind]).is_none() {
            continue;
        }
        for solution in [Solution::Elements, Solution::Rigid, Solution::Set] {
            let what = format!("{}, {solution:?}", kind.words());
            let text = model([FormKind::Plane, kind], solution);
            let (head, tail) = text.split_once("[bodies.part]").expect("it has a part");
            let height = if kind == FormKind::Outline { 0.09 } else { 0.1 };
            let law = text.split_once("tip = \"part\"\nrigid").map_or_else(
                || format!("stiffness = {STIFFNESS}\ndissipation = 5"),
                |_| "rigid = true".to_owned(),
            );
            let mut stack = head.to_owned();
            for level in 0..3 {
                let below = if level == 0 { "ground".to_owned() } else { format!("b{}", level - 1) };
                let z = height * f64::from(2 * level + 1) + 1e-3 * f64::from(level + 1);
                let own = format!(
                    "[bodies.b{level}]\nmass = 1\ninertia = [0.01, 0.01, 0.01]\nshape = {}\nposition = [0, 0, {z}]\n\
                     [joints.g{level}]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"b{level}\"\naxis = \"z\"\n\
                     [contacts.c{level}]\nbase = \"{below}\"\ntip = \"b{level}\"\n{law}\n\
                     [outputs.c{level}]\nkind = \"contact_force\"\nof = \"c{level}\"\n",
                    shape(kind)
                );
                stack += &own;
            }
            stack += tail
                .split_once("[analysis]")
                .map(|(_, rest)| format!("[analysis]{rest}"))
                .expect("an analysis")
                .as_str();
            let record = run(&stack, &[]);
            for level in 0..3 {
                let force = last(&record, &format!("c{level}.f3"));
                let wanted = WEIGHT * f64::from(3 - level);
                assert!((force / wanted - 1.0).abs() < 1e-3, "{what}: {force} {wanted}");
            }
        }
    }
}
