//! Benchmarks of contacts with closed forms, compliant and rigid: discs, tops, slopes, dominoes, gears, clearance, coarse steps.

use lissom::Model;

use crate::support::runs::run;
use crate::support::series::{last, series};

/// Keys of a contact that is almost rigid, and of one that is rigid.
const LAWS: [&str; 2] = ["stiffness = 1e7\ndissipation = 1", "rigid = true"];

fn largest_gain(energy: &[f64]) -> f64 {
    energy.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

/// Euler's disc: a thin disc of radius r at the inclination α whose centre rests rotates about its own diameter through the point
/// of contact, ω = -Ω sin α e. With the moment J = m r²/4 about it, the moment m g r cos α turns J ω at Ω: Ω² = 4 g/(r sin α).
#[test]
fn a_disc_precesses_about_its_centre() {
    let (radius, tilt, length) = (0.1_f64, 0.5_f64, 0.01_f64);
    let rate = (4.0 * 9.81 / (radius * tilt.sin())).sqrt();
    let spin = rate * tilt.sin();
    // Turned about y, its lowest point is at +x; the lower rim is in the plane of the centre.
    let forward = 0.5 * length - 1e-3 * radius;
    for (law, allowed) in LAWS.into_iter().zip([3e-3, 1e-4]) {
        let depth = if law.contains("rigid") { 0.0 } else { 9.81 / 1e7 };
        let end = 5.25 * std::f64::consts::TAU / rate;
        let text = format!(
            "lissom = 1\ngravity = [0, 0, -9.81]\n[ground]\nshape = {{ kind = \"plane\" }}\n[bodies.disc]\nmass = 1\n\
             inertia = [{0}, {0}, {1}]\nshape = {{ cylinder = [{radius}, {length}], position = [0, 0, {forward}] }}\n\
             position = [0, 0, {2}]\nrotation = [0, {tilt}, 0]\nangular_velocity = [{3}, 0, 0]\n[contacts.floor]\n\
             base = \"ground\"\ntip = \"disc\"\n{law}\nfriction = 0.5\n[outputs.disc]\nkind = \"position\"\nof = \"disc\"\n\
             [outputs.spin]\nkind = \"angular_velocity\"\nof = \"disc\"\n[outputs.energy]\nkind = \"energy\"\n[analysis]\n\
             kind = \"dynamics\"\nend = {end}\n",
            0.25 * radius * radius,
            0.5 * radius * radius,
            radius * tilt.sin().hypot(1e-3) - depth,
            -spin,
        );
        let record = run(&text, &[]);
        let [x, y, z] = ["x", "y", "z"].map(|axis| last(&record, &format!("disc.{axis}")));
        assert!(x.hypot(y) < allowed * radius, "{law}: {x} {y}");
        assert!((z - radius * tilt.sin()).abs() < allowed * radius, "{law}: {z}");
        // After a quarter of a revolution ω is turned from -x to -y.
        let [w1, w2, w3] = ["w1", "w2", "w3"].map(|axis| last(&record, &format!("spin.{axis}")));
        let across = spin * tilt.cos();
        assert!(w1.abs() < 30.0 * allowed * across, "{law}: {w1} {across}");
        assert!((w2 + across).abs() < 3.0 * allowed * across, "{law}: {w2} {across}");
        assert!((w3 - spin * tilt.sin()).abs() < 3.0 * allowed * spin, "{law}: {w3}");
    }
}

/// A cylinder on its side rolls by its radius per radian, x'' = g sin/(1 + J/(m r²)) = 2/3 g sin.
#[test]
fn a_cylinder_rolls_by_its_radius() {
    let grounds = ["kind = \"plane\"", "box = [4, 4, 0.4], position = [0, 0, -0.2]"];
    let laws = LAWS.into_iter().zip([2e-4, 1e-6]);
    for (ground, (law, allowed)) in
        grounds.into_iter().flat_map(|own| laws.clone().map(move |law| (own, law)))
    {
        let text = format!(
            "lissom = 1\ngravity = [1, 0, -9.81]\n[ground]\nshape = {{ {ground} }}\n[bodies.roll]\nmass = 1\n\
             inertia = [0.006, 0.006, 0.005]\nshape = {{ cylinder = [0.1, 0.2] }}\nposition = [0, 0, 0.1]\n\
             rotation = [\"pi/2\", 0, 0]\n[contacts.floor]\nbase = \"ground\"\ntip = \"roll\"\n{law}\nfriction = 0.5\n\
             [outputs.roll]\nkind = \"position\"\nof = \"roll\"\n[outputs.spin]\nkind = \"angular_velocity\"\nof = \"roll\"\n\
             [outputs.velocity]\nkind = \"velocity\"\nof = \"roll\"\n[analysis]\nkind = \"dynamics\"\nend = 1\n"
        );
        let record = run(&text, &[]);
        let radius = last(&record, "velocity.v1") / last(&record, "spin.w2");
        assert!((radius / 0.1 - 1.0).abs() < allowed, "{ground}, {law}: {radius}");
        let found = last(&record, "roll.x");
        assert!((3.0 * found - 1.0).abs() < 5.0 * allowed, "{ground}, {law}: {found}");
    }
}

/// A tippe top: the centre of mass is below that of the sphere by a. Jellett's constant L·(a e - R z) remains whatever the friction
/// is. With friction that grows with the sliding velocity the top turns upside down, and its spin n falls to n (R - a)/(R + a) [Cohen,
/// Am. J. Phys. 45 (1977)]. Friction that sticks ends the sliding, and the top rolls on.
#[test]
fn a_tippe_top_turns_upside_down() {
    let (radius, offset, mass, spin) = (0.015_f64, 0.0015_f64, 0.015_f64, 200.0_f64);
    let inertia = 0.4 * mass * radius * radius;
    let tilt = 0.1_f64;
    let viscous = "stiffness = 1e5\ndissipation = 1\ndeflection = 1\nstribeck = 0.3";
    for (law, inverts) in
        [(viscous, true), ("stiffness = 1e5\ndissipation = 1", false), ("rigid = true", false)]
    {
        let text = format!(
            "lissom = 1\ngravity = [0, 0, -9.81]\n[ground]\nshape = {{ kind = \"plane\" }}\n[bodies.top]\nmass = {mass}\n\
             inertia = [{inertia}, {inertia}, {inertia}]\nshape = {{ sphere = {radius}, position = [0, 0, {offset}] }}\n\
             position = [0, 0, {}]\nrotation = [{tilt}, 0, 0]\nangular_velocity = [0, 0, {spin}]\n[contacts.floor]\nbase = \"ground\"\n\
             tip = \"top\"\n{law}\nfriction = 0.3\n[outputs.centre]\nkind = \"position\"\nof = \"top\"\n[outputs.sphere]\n\
             kind = \"position\"\nof = \"top\"\npoint = [0, {}, {radius}]\n[outputs.spin]\nkind = \"angular_velocity\"\nof = \"top\"\n\
             [outputs.energy]\nkind = \"energy\"\n[analysis]\nkind = \"dynamics\"\nend = 6\n",
            radius - offset * tilt.cos(),
            -offset * tilt.sin(),
        );
        let record = run(&text, &[]);
        let column = |name: &str| series(&record, name);
        let jellett: Vec<f64> = (0..record.times.len())
            .map(|row| {
                let part = |axis: usize| {
                    let letter = ["x", "y", "z"][axis];
                    let lever =
                        column(&format!("sphere.{letter}"))[row] - column(&format!("centre.{letter}"))[row];
                    let down = if axis == 2 { radius } else { 0.0 };
                    (lever - down) * inertia * column(&format!("spin.w{}", axis + 1))[row]
                };
                (0..3).map(part).sum()
            })
            .collect();
        for value in &jellett {
            assert!((value / jellett[0] - 1.0).abs() < 3e-5, "{law}: {value} {}", jellett[0]);
        }
        // What its friction stores elastically is no part of the energy.
        let energy = column("energy.total");
        assert!(largest_gain(energy) < 2e-4 * energy[0], "{law}: {}", largest_gain(energy));
        let rise = (last(&record, "centre.z") - last(&record, "sphere.z")) / offset;
        if inverts {
            let wanted = spin * (radius - offset * tilt.cos()) / (radius + offset);
            assert!(rise > 0.999, "{law}: {rise}");
            let found = last(&record, "spin.w3");
            assert!((found / wanted - 1.0).abs() < 1e-2, "{law}: {found} {wanted}");
        } else {
            assert!(rise < -0.999, "{law}: {rise}");
        }
    }
}

/// A block on a slope sticks or slides at 0.2 % below and above the angle of friction.
#[test]
fn a_block_sticks_just_below_the_angle_of_friction() {
    let friction = 0.3_f64;
    for law in LAWS {
        for share in [0.998, 1.002] {
            let (sine, cosine) = (share * friction).atan().sin_cos();
            let depth = if law.contains("rigid") { 0.0 } else { 10.0 * cosine / 4e7 };
            let text = format!(
                "lissom = 1\ngravity = [{}, 0, {}]\n[ground]\nshape = {{ kind = \"plane\" }}\n[bodies.block]\nmass = 1\n\
                 inertia = {{ box = [0.2, 0.2, 0.02] }}\nshape = {{ box = [0.2, 0.2, 0.02] }}\nposition = [0, 0, {}]\n\
                 [contacts.floor]\nbase = \"ground\"\ntip = \"block\"\n{law}\nfriction = {friction}\n[outputs.block]\n\
                 kind = \"displacement\"\nof = \"block\"\n[outputs.velocity]\nkind = \"velocity\"\nof = \"block\"\n[analysis]\n\
                 kind = \"dynamics\"\nend = 4\n",
                10.0 * sine,
                -10.0 * cosine,
                0.01 - depth
            );
            let record = run(&text, &[]);
            let (path, velocity) = (last(&record, "block.u1"), last(&record, "velocity.v1"));
            let excess = 10.0 * (sine - friction * cosine);
            // What the block gains while its friction grows over the deflection of 1e-5 m.
            let early = if law.contains("rigid") { 1e-4 } else { (10.0 * sine * 2e-5_f64).sqrt() };
            if share < 1.0 {
                assert!(path < 0.5 * early * early / -excess, "{law} {share}: {path}");
                assert!(velocity.abs() < 2e-5, "{law} {share}: {velocity}");
            } else {
                let gained = velocity - 4.0 * excess;
                assert!(gained > -1e-6 && gained < early, "{law} {share}: {velocity} {excess}");
            }
        }
    }
}

/// A drop with steps that the contact does not resolve: the restitution is right to 5 %, or the contact is reported.
#[test]
fn contacts_that_planned_steps_do_not_resolve_are_reported() {
    let drop = |stiffness: f64, restitution: f64| {
        format!(
            "lissom = 1\ngravity = [0, 0, -9.81]\n[ground]\nshape = {{ kind = \"plane\" }}\n[bodies.ball]\nmass = 1\n\
             inertia = {{ sphere = 0.1 }}\nshape = {{ sphere = 0.1 }}\nposition = [0, 0, 1.1]\n[contacts.floor]\n\
             base = \"ground\"\ntip = \"ball\"\nstiffness = {stiffness}\nexponent = 1.5\nrestitution = {restitution}\n\
             [outputs.ball]\nkind = \"velocity\"\nof = \"ball\"\n[analysis]\nkind = \"dynamics\"\nend = 0.48\n"
        )
    };
    let mut reported = 0;
    for stiffness in [1e6, 3e6, 1e7, 1e8, 1e9] {
        for restitution in [1.0, 0.7, 0.5, 0.2] {
            let text = drop(stiffness, restitution);
            let exact = last(&run(&text, &[("analysis.relative_tolerance", "1e-8")]), "ball.v3");
            for scheme in ["radau-iia", "generalized-alpha"] {
                for step in ["2e-3", "1e-3", "2e-4"] {
                    let set = [
                        ("analysis.scheme", scheme),
                        ("analysis.step", step),
                        ("analysis.energy_check", "false"),
                    ]
                    .map(|(path, value)| (path.to_owned(), value.to_owned()));
                    let mut session =
                        Model::from_text("drop.toml", &text).with_overrides(&set).session().expect("valid");
                    let record = session.run().unwrap();
                    let error = (last(&record, "ball.v3") / exact - 1.0).abs();
                    let is_reported = session.warnings().any(|warning| warning.code() == "contact-too-short");
                    reported += usize::from(is_reported);
                    assert!(
                        error < 0.05 || is_reported,
                        "{stiffness} {restitution} {scheme} {step}: {error}"
                    );
                }
            }
        }
    }
    assert!(reported > 25, "{reported}");
}

/// A row of blocks on hinges at their feet.
fn dominoes(count: usize, law: &str, end: f64) -> String {
    let (height, thickness, pitch, mass) = (0.05, 0.008, 0.025, 0.01);
    let moment = mass * (height * height + thickness * thickness) / 12.0;
    let mut text = "lissom = 1\ngravity = [0, -9.81, 0]\n[outputs.energy]\nkind = \"energy\"\n".to_owned();
    for k in 0..count {
        let x = pitch * k as f64;
        let spin = if k == 0 { 2.0 } else { 0.0 };
        text.extend([format!(
            "[bodies.d{k}]\nmass = {mass}\ninertia = [{moment}, {moment}, {moment}]\nposition = [{x}, {0}, 0]\n\
             velocity = [{1}, 0, 0]\nangular_velocity = [0, 0, {2}]\nshape = {{ kind = \"outline\", length = 0.02, \
             points = [[-{3}, -{0}], [{3}, -{0}], [{3}, {0}], [-{3}, {0}]] }}\n[joints.d{k}]\nkind = \"revolute\"\n\
             base = \"ground\"\ntip = \"d{k}\"\naxis = \"z\"\nat = [{x}, 0, 0]\n",
            0.5 * height,
            0.5 * height * spin,
            -spin,
            0.5 * thickness,
        )]);
        if let Some(before) = k.checked_sub(1) {
            text.extend([format!(
                "[contacts.c{k}]\nbase = \"d{before}\"\ntip = \"d{k}\"\n{law}\n[outputs.c{k}]\nkind = \"contact_force\"\n\
                 of = \"c{k}\"\n"
            )]);
        }
    }
    text + &format!("[analysis]\nkind = \"dynamics\"\nend = {end}\n")
}

/// Dominoes fall one after another, at intervals that approach a constant, without a gain of energy; those of compliant contacts are
/// those of rigid ones.
#[test]
fn the_wave_of_dominoes_approaches_a_constant_speed() {
    let of = |count: usize, law: &str, end: f64, depth: f64| {
        let record = run(&dominoes(count, law, end), &[]);
        let energy = series(&record, "energy.total");
        assert!(largest_gain(energy) < 1e-6 * energy[0], "{law}: {}", largest_gain(energy));
        let touched: Vec<f64> = (1..count)
            .map(|k| {
                let gaps = series(&record, &format!("c{k}.gap"));
                assert!(gaps.iter().all(|gap| *gap > -depth), "{law}: {k}");
                record.times[gaps.iter().position(|gap| *gap < 1e-7).expect("it is struck")]
            })
            .collect();
        touched.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<f64>>()
    };
    let rigid = of(12, "rigid = true", 0.395, 1e-7);
    let ratios: Vec<f64> = rigid.windows(2).map(|pair| pair[1] / pair[0]).collect();
    assert!(ratios.windows(2).all(|pair| pair[1] > pair[0]), "{ratios:?}");
    assert!(ratios.iter().all(|ratio| *ratio < 1.0) && ratios[ratios.len() - 1] > 0.98, "{ratios:?}");
    let compliant = of(4, "stiffness = 1e5\nrestitution = 0.1", 0.21, 3e-4);
    for (one, other) in compliant.iter().zip(&rigid) {
        assert!((one / other - 1.0).abs() < 5e-3, "{compliant:?} {rigid:?}");
    }
}

/// Points of a tooth with involute flanks about the direction `middle`, of a gear of module 4 mm.
fn tooth(count: u32, middle: f64) -> String {
    let pressure = 20.0_f64.to_radians();
    let pitch = 0.002 * f64::from(count);
    let base = pitch * pressure.cos();
    let involute = |angle: f64| angle.tan() - angle;
    let half = std::f64::consts::FRAC_PI_2 / f64::from(count) + involute(pressure);
    // By the angle of roll u: the radius is r √(1 + u²), and the flank is at u - arctan u from its foot.
    let top = (((pitch + 0.004) / base).powi(2) - 1.0).sqrt();
    let flank: Vec<[f64; 2]> = (0..30)
        .map(|k| {
            let roll = 0.12 + (top - 0.12) * f64::from(k) / 29.0;
            [base * 1.0_f64.hypot(roll), half - (roll - roll.atan())]
        })
        .collect();
    let other = flank.iter().rev().copied();
    let points: Vec<String> = (flank.iter().map(|&[radius, angle]| [radius, -angle]).chain(other))
        .map(|[radius, angle]| {
            let (sine, cosine) = (middle + angle).sin_cos();
            format!("[{}, {}]", radius * cosine, radius * sine)
        })
        .collect();
    points.join(", ")
}

/// Two teeth with involute flanks, of gears with 20 and 30 teeth, transmit speeds and torques by the ratio of the numbers of teeth
/// at every position.
#[test]
fn involute_teeth_transmit_by_a_constant_ratio() {
    let (speed, early, torque) = (0.4_f64, 0.08_f64, 10.0);
    let teeth = [20_u32, 30];
    let ratio = f64::from(teeth[0]) / f64::from(teeth[1]);
    let half = teeth.map(|count| std::f64::consts::FRAC_PI_2 / f64::from(count));
    let body = |name: &str, x: f64, spin: f64, points: &str| {
        format!(
            "[bodies.{name}]\nmass = 0.1\ninertia = [1e-4, 1e-4, 1e-4]\nposition = [{x}, 0, 0]\nangular_velocity = [0, 0, {spin}]\n\
             shape = {{ kind = \"outline\", smooth = true, length = 0.01, points = [{points}] }}\n[joints.{name}]\n\
             kind = \"revolute\"\nbase = \"ground\"\ntip = \"{name}\"\naxis = \"z\"\n"
        )
    };
    // At the pitch point after 0.08 rad of the pinion.
    let pinion = body("pinion", 0.0, speed, &tooth(teeth[0], -half[0] - early));
    let wheel =
        body("wheel", 0.1, -speed * ratio, &tooth(teeth[1], std::f64::consts::PI - half[1] + early * ratio));
    let text = format!(
        "lissom = 1\n{pinion}{wheel}[joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"pinion\"\n\
         rotation = \"{speed}*t\"\n[loads.brake]\nkind = \"moment\"\non = \"wheel\"\nvector = [0, 0, {torque}]\n\
         [contacts.teeth]\nbase = \"pinion\"\ntip = \"wheel\"\nstiffness = 1e8\ndissipation = 100\n[outputs.wheel]\n\
         kind = \"relative\"\nof = \"wheel\"\n[outputs.motor]\nkind = \"reaction\"\nof = \"motor\"\n[analysis]\n\
         kind = \"dynamics\"\nend = 0.35\n"
    );
    let record = run(&text, &[]);
    let rates = series(&record, "wheel.rate").iter().zip(series(&record, "motor.moment"));
    let mut checked = 0;
    // Away from the ends of the flanks, where a spline through points oscillates.
    for (time, (rate, moment)) in record.times.iter().zip(rates).filter(|(time, _)| **time > 0.12) {
        assert!((rate / (-speed * ratio) - 1.0).abs() < 2e-4, "{time}: {rate}");
        assert!((moment / (torque * ratio) - 1.0).abs() < 2e-4, "{time}: {moment}");
        checked += 1;
    }
    assert!(checked > 30, "{checked}");
}

/// A slider crank of 50 and 120 mm whose slider has a bore with clearance [Flores and others, 2006], which turns freely.
fn slider_crank(clearance: f64, drive: &str) -> String {
    format!(
        "lissom = 1\n[bodies.crank]\nmass = 0.3\ninertia = [1e-4, 1e-4, 1e-4]\nposition = [0.025, 0, 0]\n\
         angular_velocity = [0, 0, 100]\nvelocity = [0, 2.5, 0]\n[bodies.rod]\nmass = 0.21\ninertia = [2.5e-4, 2.5e-4, 2.5e-4]\n\
         position = [0.11, 0, 0]\nshape = {{ sphere = 0.0095, position = [0.06, 0, 0] }}\n\
         velocity = [0, 2.5, 0]\nangular_velocity = [0, 0, {}]\n[bodies.slider]\nmass = 0.14\n\
         inertia = [1e-4, 1e-4, 1e-4]\nposition = [0.17, 0, 0]\n\
         shape = {{ kind = \"tube\", radius = 0.02, inner_radius = {}, length = 0.02 }}\n[joints.crank]\nkind = \"revolute\"\n\
         base = \"ground\"\ntip = \"crank\"\naxis = \"z\"\nat = [0, 0, 0]\n[joints.pin]\nkind = \"revolute\"\n\
         base = \"crank\"\ntip = \"rod\"\naxis = \"z\"\nat = [0.05, 0, 0]\n[joints.guide]\nkind = \"prismatic\"\n\
         base = \"ground\"\ntip = \"slider\"\naxis = \"x\"\n[contacts.bore]\nbase = \"slider\"\ntip = \"rod\"\n\
         stiffness = 1e9\nexponent = 1.5\nrestitution = 0.9\n[outputs.bore]\nkind = \"contact_force\"\nof = \"bore\"\n\
         [outputs.slider]\nkind = \"position\"\nof = \"slider\"\n[outputs.acceleration]\nkind = \"acceleration\"\n\
         of = \"slider\"\n[outputs.crank]\nkind = \"relative\"\nof = \"crank\"\n[outputs.energy]\nkind = \"energy\"\n{drive}\
         [analysis]\nkind = \"dynamics\"\nend = 0.07\n",
        -5.0 / 0.12,
        0.0095 + clearance
    )
}

/// The slider is where an ideal one would be, to the clearance and the penetration, across the inclined rod; impacts accelerate it by
/// several times more. Without a drive the energy falls.
#[test]
fn a_slider_with_clearance_stays_within_it() {
    let motor = "[joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"crank\"\nrotation = \"100*t\"\n";
    for (clearance, drive) in [(5e-4, motor), (1e-4, motor), (5e-4, "")] {
        let record = run(&slider_crank(clearance, drive), &[("analysis.relative_tolerance", "1e-5")]);
        let deepest = series(&record, "bore.gap").iter().copied().fold(0.0, f64::min);
        let allowed = (clearance - deepest) / (1.0 - (5.0_f64 / 12.0).powi(2)).sqrt();
        let mut most = 0.0_f64;
        for (place, angle) in series(&record, "slider.x").iter().zip(series(&record, "crank.angle")) {
            let ideal = 0.05 * angle.cos() + (0.12_f64.powi(2) - (0.05 * angle.sin()).powi(2)).sqrt();
            most = most.max((place - ideal).abs());
        }
        assert!(most <= 1.01 * allowed && most > 0.9 * clearance, "{clearance}: {most} {allowed}");
        if drive.is_empty() {
            let energy = series(&record, "energy.total");
            assert!(
                largest_gain(energy) < 1e-5 * energy[0] && last(&record, "energy.total") < 0.99 * energy[0]
            );
        } else {
            let ideal = 0.05 * 1e4 * (1.0 + 5.0 / 12.0);
            let accelerations = series(&record, "acceleration.a1").iter();
            let most = accelerations.map(|of| of.abs()).fold(0.0, f64::max);
            assert!(most > 3.0 * ideal, "{clearance}: {most} {ideal}");
        }
    }
}
