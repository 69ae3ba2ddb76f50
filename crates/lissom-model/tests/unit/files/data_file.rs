//! Tests of `files::data_file`, a module of it.

use super::*;

#[test]
fn columns_are_found_by_name() {
    let text = "# measured\n\"speed\", torque [N m] ,loss\n\n0, 3 ,1e-3\n# gap\n1.5,2,0\n";
    let wanted = Rows { values: vec![(0.0, 3.0), (1.5, 2.0)], lines: vec![4, 6] };
    let one = |row| Rows { values: vec![row], lines: vec![2] };
    assert_eq!(two_columns(text, Some(["speed", "torque [N m]"])), Ok(wanted.clone()));
    assert_eq!(two_columns(text, None), Ok(wanted));
    assert_eq!(two_columns("a;b\n1;2\n", Some(["b", "a"])), Ok(one((2.0, 1.0))));
    assert_eq!(two_columns("a\tb\r\n1\t2\r\n", None), Ok(one((1.0, 2.0))));
}

#[test]
fn mistakes_are_reported_with_their_line() {
    for (text, names, words) in [
        ("a,b\n1,2\n3,x\n", None, "line 3: `x` in column `b`"),
        ("a,b\n1\n", None, "line 2: `` in column `b`"),
        ("a;b\n1,5;2\n", None, "line 2: `1,5` in column `a`"),
        ("a,b\n1,nan\n", None, "line 2: `nan`"),
        ("a,b\n1,2\n", Some(["a", "c"]), "no column `c` in the heading of line 1"),
        ("a,a\n1,2\n", Some(["a", "a"]), "two columns are called `a`"),
        ("1,2\n3,4\n", None, "must name the columns"),
        ("a\n1\n", None, "two columns are needed"),
        ("\n# nothing\n", None, "no heading"),
    ] {
        let problem = two_columns(text, names).unwrap_err().to_string();
        assert!(problem.contains(words), "{text}: {problem}");
    }
}

#[test]
fn a_grid_has_the_values_of_y_in_its_heading() {
    let (across, rows) = grid("x,-1,1\n0,2,3\n4,5,6\n").expect("a grid");
    assert_eq!((across, rows), (vec![-1.0, 1.0], vec![vec![0.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]]));
    let error = grid("x,left,1\n0,2,3\n").expect_err("an error").to_string();
    assert_eq!(error, "line 1: `left` is no value of y");
}
