//! Tests of `sweep::decode`, a module of it.

use super::*;

fn sweep(text: &str) -> SweepFile {
    let head = "lissom_sweep = 1\ncollect.a = \"max(bob.x)\"\n";
    SweepFile::parse(&format!("{head}{text}"), "s.toml").map_err(|report| report.render(false)).unwrap()
}

fn complaint(text: &str) -> String {
    SweepFile::parse(text, "s.toml").unwrap_err().render(false)
}

#[test]
fn paths_may_be_nested_or_quoted() {
    let sweep = sweep(
        "[set.analysis]\nend = 2\nscheme = \"hht\"\n[vary.bodies.\"my body\"]\nmass = [1, \"2*pi\"]\n\
             [vary]\n\"beams.b.elements\" = { values = [4, 8] }\njoints.a.kind = [\"clamp\", [0, 1]]\n",
    );
    assert_eq!(
        sweep.set,
        [("analysis.end", "2"), ("analysis.scheme", "\"hht\"")].map(|(a, b)| (a.into(), b.into()))
    );
    assert_eq!(sweep.len(), 8);
    let of_last =
        [("bodies.\"my body\".mass", "\"2*pi\""), ("beams.b.elements", "8"), ("joints.a.kind", "[0, 1]")];
    assert_eq!(sweep.overrides(7), of_last.map(|(a, b)| (a.to_owned(), b.to_owned())));
    assert_eq!(sweep.value(0, 2), SweepValue::Text("clamp".to_owned()));
}

#[test]
fn drawn_values_keep_to_their_ranges() {
    for sampling in ["latin-hypercube", "sobol", "monte-carlo"] {
        let text = format!(
            "sampling = \"{sampling}\"\nmembers = 200\nseed = 3\n[vary]\n\"a.x\" = {{ from = 2, to = 3 }}\n\
                 \"a.y\" = {{ from = 1e3, to = 1e-3, spacing = \"logarithmic\" }}\n\
                 \"a.z\" = {{ mean = 5, standard_deviation = 0.1 }}\n\"a.w\" = [\"p\", \"q\"]\n"
        );
        let sweep = sweep(&text);
        assert_eq!(sweep.len(), 200);
        let number = |member, path| match sweep.value(member, path) {
            SweepValue::Number(number) => number,
            other => panic!("{other:?}"),
        };
        let mean = |path| (0..200).map(|member| number(member, path)).sum::<f64>() / 200.0;
        assert!((0..200).all(|member| (2.0..=3.0).contains(&number(member, 0))));
        assert!((0..200).all(|member| (1e-3..=1e3).contains(&number(member, 1))));
        assert!((mean(0) - 2.5).abs() < 0.1 && (mean(2) - 5.0).abs() < 0.05, "{sampling}");
        let chosen =
            (0..200).filter(|member| sweep.value(*member, 3) == SweepValue::Text("p".into())).count();
        assert!((70..130).contains(&chosen), "{sampling}: {chosen}");
    }
}

#[test]
fn mistakes_are_named() {
    let head = "lissom_sweep = 1\ncollect.c = \"max(b.x)\"\n";
    let cases = [
        ("vary.a = 3", "must be a list of values or a table"),
        ("vary.a = []", "has no values"),
        ("vary.a = { from = 1, to = 2 }", "requires the number of values"),
        ("vary.a = { from = 1, to = 1, count = 3 }", "ends where it begins"),
        ("vary.a = { from = 0, to = 1, count = 3, spacing = \"logarithmic\" }", "greater than zero"),
        ("vary.a = { from = 1, too = 2, count = 3 }", "unknown key `too`"),
        ("sampling = \"gird\"\nvary.a = [1]", "did you mean `grid`"),
        ("sampling = \"sobol\"\nvary.a = { from = 0, to = 1 }", "requires the number of members"),
        ("sampling = \"list\"\nvary.a = [1, 2]\nvary.b = [1]", "the same number of values"),
        ("members = 4\nvary.a = [1, 2]", "has no effect"),
        ("vary.a = [1, 2]\nset.a = 1", "is set and varied"),
        ("vary.member = [1, 2]", "two columns `member`"),
        ("collect.b = \"maximum(b.x)\"\nvary.a = [1]", "is not a statistic"),
        ("collect.b = \"b.x\"\nvary.a = [1]", "cannot be read"),
        ("collect.b = \"max(b.x, afer=1)\"\nvary.a = [1]", "did you mean `after`"),
        ("collect.b = \"max(b.x, after=2, before=1)\"\nvary.a = [1]", "from 2 s to 1 s is empty"),
        ("collect.b = \"max(b.x, last=2, to=1)\"\nvary.a = [1]", "has no other limits"),
        ("collect.b = \"max(b.x, 2)\"\nvary.a = [1]", "`2` is no limit of a window"),
        ("vary.a = [1]\nworkers = 3", "unknown key `workers`"),
        ("[vary]", "varies no values"),
    ];
    for (text, words) in cases {
        let text = format!("{head}{text}\n");
        let found = complaint(&text);
        // Lines are wrapped where they are long.
        let flat = found.split_whitespace().collect::<Vec<_>>().join(" ").replace(" │ ", " ");
        assert!(flat.contains(words), "{text}\n{found}");
    }
    assert!(complaint("lissom_sweep = 2\nvary.a=[1]\ncollect.a=\"max(a)\"").contains("not supported"));
    assert!(complaint("vary.a=[1]\ncollect.a=\"max(a)\"").contains("lissom_sweep"));
}
