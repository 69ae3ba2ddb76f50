//! Tests of `scene::shapes`, a module of it.

use super::*;

#[test]
fn a_box_comes_back_from_its_inertia() {
    let (a, b, c, mass) = (0.1_f64, 0.3_f64, 0.7_f64, 2.5);
    let moments = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (mass / 12.0);
    let turn = Rotation::exponential(&Vector3::new(0.3, -0.2, 0.9)).matrix();
    for axes in [Matrix3::identity(), turn] {
        let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
        let found = InertiaBox::of(mass, &inertia, &Vector3::x());
        let mut sides = found.sides;
        sides.sort_by(f64::total_cmp);
        for (side, wanted) in sides.iter().zip([a, b, c]) {
            assert!((side - wanted).abs() < 1e-12, "{found:?}");
        }
        // The longest side is along the third axis.
        let longest = found.sides.iter().position(|side| (side - c).abs() < 1e-12).unwrap();
        let principal = Rotation::from_quaternion(found.quaternion).unwrap().matrix();
        assert!((principal.column(longest).dot(&axes.column(2)).abs() - 1.0).abs() < 1e-12);
    }
}
