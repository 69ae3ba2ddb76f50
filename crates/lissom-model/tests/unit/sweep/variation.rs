//! Tests of `sweep::variation`, a module of it.

use super::*;

#[test]
fn ends_of_a_range_are_met_exactly() {
    for logarithmic in [false, true] {
        let range = Variation::Range { from: 0.1, to: 0.7, count: Some(4), logarithmic };
        assert_eq!((range.at_index(0), range.at_index(3)), (0.1, 0.7));
        assert!(range.at_index(1) > 0.1 && range.at_index(2) < 0.7);
    }
    let ratios = Variation::Range { from: 1.0, to: 1e4, count: Some(5), logarithmic: true };
    assert!((ratios.at_index(1) - 10.0).abs() < 1e-12);
}

#[test]
fn values_are_written_as_a_model_file_takes_them() {
    let texts = [
        SweepValue::Number(1e-7),
        SweepValue::Number(0.1),
        SweepValue::Text("hht".to_owned()),
        SweepValue::Toml("[0, 1]".to_owned()),
    ];
    assert_eq!(texts.each_ref().map(SweepValue::to_toml), ["1e-7", "0.1", "\"hht\"", "[0, 1]"]);
    assert_eq!(texts.each_ref().map(SweepValue::to_cell), ["1e-7", "0.1", "hht", "[0, 1]"]);
}
