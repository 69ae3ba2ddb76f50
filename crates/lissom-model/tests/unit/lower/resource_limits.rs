//! Tests of `lower::resource_limits`, a module of it.

use super::*;
use crate::lower::registry::registry;

fn problems(elements: &str, further: &str, available: f64) -> Vec<String> {
    let text = format!(
        "lissom = 1\n[sections.s]\nshape = \"general\"\nstiffness = [1, 1, 1, 1, 1, 1]\nmass = {{ per_length = 1, inertia = [1, 1, 1] }}\n\
             [beams.b]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = {elements}\norder = 2\n\
             [outputs.o]\nkind = \"position\"\nof = \"b.end\"\n[analysis]\nkind = \"dynamics\"\n{further}\n"
    );
    let document = Document::parse(&text, "a.toml", &registry()).expect("it can be read");
    let mut problems = Vec::new();
    super::elements(&document, || available, &mut problems);
    steps(&document, &mut problems);
    problems.into_iter().map(|problem| problem.message).collect()
}

#[test]
fn too_many_elements_are_reported_with_what_they_need() {
    assert_eq!(problems("1000", "end = 1\nstep = 1e-3", 1e9), Vec::<String>::new());
    let words = problems("100000", "end = 1\nstep = 1e-3", 1e9).join("\n");
    assert!(words.contains("10.0 GB") && words.contains("beam `b`") && words.contains("1.0 GB"), "{words}");
}

#[test]
fn too_many_steps_or_rows_are_reported() {
    let words = problems("10", "end = 1e3\nstep = 1e-8", 1e9).join("\n");
    assert!(words.contains("1.0e11 steps") && words.contains("take 278 hours"), "{words}");
    let words = problems("10", "end = 10\nstep = 1e-8", 1e9).join("\n");
    assert!(words.contains("1.0e9 rows") && words.contains("80.0 GB"), "{words}");
    assert_eq!(problems("10", "end = 10\nstep = 1e-8\noutput_every = 1000", 1e9), Vec::<String>::new());
    assert_eq!(problems("10", "end = 10", 1e9), Vec::<String>::new());
}

#[test]
fn bytes_are_reported_in_the_unit_that_leaves_few_digits() {
    let sizes = [(2.4e6, "2 MB"), (9.99e8, "999 MB"), (1e9, "1.0 GB"), (2.5e11, "250.0 GB")];
    for (bytes, words) in sizes.into_iter().chain([(1e12, "1.0 TB"), (3.2e15, "3200.0 TB")]) {
        assert_eq!(size(bytes), words);
    }
}
