//! Tests of `files::polar_file`, a module of it.

use super::*;

const AERODYN: &str = "! AirfoilInfo\n\"DEFAULT\"  InterpOrd ! order\n  2  NumTabs\n! table 1\n 0.75  Re ! millions\n 0 Ctrl\n\
        ! coefficients\n 2 NumAlf\n! Alpha Cl Cd Cm\n -180 0 0.02 0.1\n 180.0 1e-1 0.02 0.2\n 3 Re\n 1 NumAlf\n 0.0 0.5 0.01\n";
const HAWC2: &str = "2 two sets\n1 of the first\n1 1 24.1 first\n0 0.1 0.2 0.3\n2 of the second\n1 2 18 thin\n-90 1 2 3\n\
        90 4 5 6\n2 1 100 cylinder\n0 0 1.2 0 comment\n";

#[test]
fn both_formats_are_read() {
    let read = polars(AERODYN, 1).unwrap();
    assert_eq!(read.iter().map(|own| own.at).collect::<Vec<_>>(), [0.75e6, 3e6]);
    assert_eq!(read[0].rows[1], [std::f64::consts::PI, 0.1, 0.02, 0.2]);
    assert_eq!(read[1].rows, [[0.0, 0.5, 0.01, 0.0]]);
    let read = polars(HAWC2, 2).unwrap();
    assert_eq!(read.iter().map(|own| own.at).collect::<Vec<_>>(), [18.0, 100.0]);
    assert_eq!(read[0].rows[1], [std::f64::consts::FRAC_PI_2, 4.0, 5.0, 6.0]);
    assert_eq!(polars(HAWC2, 1).unwrap()[0].rows, [[0.0, 0.1, 0.2, 0.3]]);
}

#[test]
fn mistakes_are_reported_with_their_line() {
    for (text, set, words) in [
        (HAWC2, 3, "there is no set 3, but 2"),
        ("x\n", 1, "line 1: expected the number of sets"),
        ("1\n1\n1 2 18\n0 0 1 0\n", 1, "ends before its last row"),
        ("1\n1\n1 1 18\n0 zero 1 0\n", 1, "line 4: expected an angle"),
        ("many NumAlf\n", 1, "line 1: expected the number of rows"),
        ("", 1, "ends before the number of sets"),
    ] {
        let problem = polars(text, set).unwrap_err().to_string();
        assert!(problem.contains(words), "{text}: {problem}");
    }
}
