//! Tests of `geometry::surfaces`, a module of it.

use super::*;
use crate::forms::FormKind;
use crate::forms::samples::sample;

/// Normals and curvatures are the derivatives of distances, and the foot of every point outside is on the surface.
#[test]
fn normals_and_curvatures_are_derivatives_of_distances() {
    let step = 1e-6;
    for &kind in FormKind::ALL {
        let Ok(Some(surface)) = sample(kind).surface(0.0) else { continue };
        for k in 0..400 {
            let share = |factor: f64| (f64::from(k) * factor).fract() * 2.4 - 1.2;
            let y = Vector3::new(share(0.754_877), share(0.569_840), share(0.430_159));
            let at = surface.distance(&y);
            for axis in 0..3 {
                let mut aside = [y, y];
                aside[0][axis] -= step;
                aside[1][axis] += step;
                let [before, after] = aside.map(|y| surface.distance(&y));
                // At the edges between two regions the curvature jumps, within a solid also the normal.
                if (before.curvature - after.curvature).norm() > 0.1
                    || (before.normal - after.normal).norm() > 0.01
                {
                    continue;
                }
                let allowed = 1e-8 * (1.0 + at.curvature.norm_squared());
                let slope = (after.value - before.value) / (2.0 * step);
                assert!((slope - at.normal[axis]).abs() < allowed, "{kind:?} {y:?} {slope} {at:?}");
                let turn = (after.normal - before.normal) / (2.0 * step);
                assert!(
                    (turn - at.curvature.column(axis)).norm() < 100.0 * allowed,
                    "{kind:?} {y:?} {turn} {at:?}"
                );
            }
            assert!((at.normal.norm() - 1.0).abs() < 1e-12, "{kind:?} {at:?}");
            if at.value > 0.0 {
                let foot = surface.distance(&(y - at.value * at.normal));
                assert!(foot.value.abs() < 1e-12, "{kind:?} {y:?} {foot:?}");
            }
        }
    }
}

#[test]
fn a_point_in_the_bore_of_a_ring_is_outside() {
    let ring = Ring { radii: [0.3, 0.6], half_length: 0.4 };
    let at = ring.distance(&Vector3::new(0.2, 0.0, 0.1));
    assert!((at.value - 0.1).abs() < 1e-15 && (at.normal + Vector3::x()).norm() < 1e-15);
    assert!(ring.distance(&Vector3::new(0.0, 0.45, 0.0)).value < 0.0);
    let solid = Ring { radii: [0.0, 0.6], half_length: 0.4 };
    assert!((solid.distance(&Vector3::new(0.1, 0.0, 0.0)).value + 0.4).abs() < 1e-15);
}
