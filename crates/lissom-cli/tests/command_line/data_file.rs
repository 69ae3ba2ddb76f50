//! Tables in files beside the model.

use crate::support::{Folder, lissom, summary};

const SLIDER: &str = r#"
lissom = 1
[bodies.block]
mass = 2
inertia = [0.1, 0.1, 0.1]
velocity = [0.5, 0, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "block"
axis = [1, 0, 0]
[springs.spring]
kind = "axial"
joint = "slide"
force = { file = "NAME", columns = ["x", "pull [N]"] }
[outputs.slide]
kind = "relative"
of = "slide"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 0.3
step = 1e-3
"#;

#[test]
fn a_law_is_read_from_a_file_beside_the_model() {
    let folder = Folder::new("force-law");
    let model = |name: &str| SLIDER.replace("NAME", name);
    std::fs::create_dir_all(folder.path().join("models/laws")).unwrap();
    folder.write("models/laws/spring.csv", "# measured\nx,speed,pull [N]\n-1,9,-300\n0,9,0\n1,9,300\n");
    folder.write("models/bad.csv", "x,pull [N]\n0,1\n1,high\n");
    folder.write("models/turned.csv", "x,pull [N]\n0,1\n0,2\n");
    folder.write("models/slider.toml", &model("laws/spring.csv"));
    let ended = lissom(&["run", "models/slider.toml", "--out", "out"], folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    assert_eq!(summary(&folder.path().join("out"))["stopped"], "end");
    let table = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let record = lissom::Record::from_csv(&table).unwrap();
    let last = *record.column("slide", "displacement").unwrap().last().unwrap();
    let rate = (300.0_f64 / 2.0).sqrt();
    assert!((last - 0.5 / rate * (0.3 * rate).sin()).abs() < 1e-6, "{last}");
    for (name, words) in [
        ("laws/sprin.csv", &["there is no such file", "did you mean `spring.csv`"][..]),
        ("bad.csv", &["`bad.csv`: line 3: `high` in column `pull [N]` is not a finite number"]),
        ("turned.csv", &["lines 2 and 3 have the same argument"]),
    ] {
        folder.write("models/slider.toml", &model(name));
        let ended = lissom(&["run", "models/slider.toml", "--out", "other"], folder.path());
        assert_eq!(ended.code, 2, "{name}");
        let reported = ended.errors.split_whitespace().collect::<Vec<_>>().join(" ");
        for words in words {
            assert!(reported.contains(words), "{reported}");
        }
    }
}
