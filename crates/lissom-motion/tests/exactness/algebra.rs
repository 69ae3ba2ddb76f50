//! Skew matrices, twists, wrenches and the Lie bracket.

use lissom_motion::{
    Vector3, axial, coadjoint_matrix, coadjoint_times, lie_bracket, lie_bracket_matrix, rotation_part, screw,
    skew, translation_part,
};
use nalgebra::Matrix3;
use proptest::prelude::*;

use crate::arguments::plain_vector;
use crate::errors::error;

#[test]
fn parts_stand_where_they_should() {
    let v = screw(&Vector3::new(1.0, 2.0, 3.0), &Vector3::new(4.0, 5.0, 6.0));
    assert_eq!(v.as_slice(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(screw(&translation_part(&v), &rotation_part(&v)), v);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

    #[test]
    fn skew_and_axial(a in plain_vector(), b in plain_vector()) {
        let (v, w) = (translation_part(&a), translation_part(&b));
        prop_assert_eq!(skew(&v) * w, v.cross(&w));
        prop_assert_eq!(axial(&skew(&v)), v);
        let symmetric = Matrix3::from_diagonal(&w) + v * v.transpose();
        prop_assert!((axial(&(skew(&w) + symmetric)) - w).norm() < 1e-15);
    }

    #[test]
    fn bracket_is_written_out(v in plain_vector(), w in plain_vector()) {
        let (u, theta) = (skew(&translation_part(&v)), skew(&rotation_part(&v)));
        let matrix = lie_bracket_matrix(&v);
        prop_assert_eq!(matrix.fixed_view::<3, 3>(0, 0).into_owned(), theta);
        prop_assert_eq!(matrix.fixed_view::<3, 3>(0, 3).into_owned(), u);
        prop_assert_eq!(matrix.fixed_view::<3, 3>(3, 0).into_owned(), Matrix3::zeros());
        prop_assert_eq!(matrix.fixed_view::<3, 3>(3, 3).into_owned(), theta);
        prop_assert!(error(&lie_bracket(&v, &w), &(matrix * w), 1.0) < 1e-15);
        prop_assert!(error(&coadjoint_times(&v, &w), &(matrix.transpose() * w), 1.0) < 1e-15);
        prop_assert!(error(&(coadjoint_matrix(&w) * v), &(matrix.transpose() * w), 1.0) < 1e-15);
        prop_assert!(error(&lie_bracket(&w, &v), &(-lie_bracket(&v, &w)), 1.0) < 1e-15);
    }

    #[test]
    fn bracket_obeys_jacobi(a in plain_vector(), b in plain_vector(), c in plain_vector()) {
        let sum = lie_bracket(&a, &lie_bracket(&b, &c))
            + lie_bracket(&b, &lie_bracket(&c, &a))
            + lie_bracket(&c, &lie_bracket(&a, &b));
        prop_assert!(sum.amax() < 4e-15);
    }
}
