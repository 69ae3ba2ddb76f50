//! Words of optional features of the nonlinear solver, and of its parameters.

use lissom_core::solver_features::{DisabledFeatures, SOLVER_FEATURES};
use lissom_core::tuning::{TUNING_PARAMETERS, Tuning};

#[test]
fn words_change_what_they_name_and_nothing_else() {
    for (index, (parameter, word, value, _)) in TUNING_PARAMETERS.into_iter().enumerate() {
        assert_eq!(parameter as usize, index, "{word} stands at its place");
        let changed = Tuning::default().times([word], 2.0).expect("a word of the table");
        for (other, _, whole, _) in TUNING_PARAMETERS {
            assert_eq!(changed.of(other), if other == parameter { 2.0 * value } else { whole });
        }
    }
    assert_eq!(Tuning::default().times(["pivoting"], 2.0), None);
}

#[test]
fn words_leave_out_what_they_name_and_nothing_else() {
    for (feature, word, _) in SOLVER_FEATURES {
        let disabled = DisabledFeatures::of_words([word]).expect("a word of the table");
        for (other, ..) in SOLVER_FEATURES {
            assert_eq!(disabled.allows(other), other != feature);
        }
    }
    assert_eq!(DisabledFeatures::of_words(["pivoting"]), None);
}
