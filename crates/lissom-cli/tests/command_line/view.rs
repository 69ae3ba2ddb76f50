//! `lissom view` as browsers see it: one page that asks nothing of anybody and holds the motion of the run.

use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;
use lissom::Record;
use lissom::motion::Motion;
use serde_json::{Value, json};

use crate::support::{CANTILEVER, Folder, SPARE_SECTION, example, lissom};

/// The results in a page.
pub(crate) fn results(page: &str) -> Value {
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"result\">").unwrap();
    let (text, _) = rest.split_once("</script>").unwrap();
    serde_json::from_str(text).unwrap()
}

fn inflated(text: &str) -> Vec<u8> {
    let packed = decoded(text);
    let mut bytes = Vec::new();
    ZlibDecoder::new(&*packed).read_to_end(&mut bytes).unwrap();
    bytes
}

/// Bytes from letters.
pub(crate) fn decoded(text: &str) -> Vec<u8> {
    const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let (mut bits, mut count, mut packed) = (0_u32, 0, Vec::new());
    for letter in text.trim_end_matches('=').chars() {
        bits = bits << 6 | LETTERS.find(letter).unwrap() as u32;
        count += 6;
        if count >= 8 {
            count -= 8;
            packed.push((bits >> count) as u8);
            bits &= (1 << count) - 1;
        }
    }
    packed
}

/// Reads a packed motion as the page does.
pub(crate) struct Packed(Vec<u8>, usize);

impl Packed {
    pub(crate) fn of(results: &Value) -> Self {
        Self(inflated(results["motion"]["packed"].as_str().unwrap()), 0)
    }

    pub(crate) fn is_read(&self) -> bool {
        self.1 == self.0.len()
    }

    pub(crate) fn double(&mut self) -> f64 {
        self.1 += 8;
        f64::from_le_bytes(self.0[self.1 - 8..self.1].try_into().unwrap())
    }

    fn integer(&mut self) -> i64 {
        let (mut value, mut shift) = (0_u64, 0);
        loop {
            let byte = self.0[self.1];
            self.1 += 1;
            value |= u64::from(byte & 127) << shift;
            shift += 7;
            if byte < 128 {
                return (value >> 1).cast_signed() ^ -(value & 1).cast_signed();
            }
        }
    }

    /// A number over all frames.
    pub(crate) fn channel(&mut self, frames: usize) -> (Vec<f64>, f64) {
        let (start, quantum) = (self.double(), self.double());
        let (mut value, mut slope) = (0, 0);
        let mut next = || {
            if quantum != 0.0 {
                slope += self.integer();
                value += slope;
            }
            start + quantum * value as f64
        };
        ((0..frames).map(|_| next()).collect(), quantum)
    }
}

/// Compares the motion in a page with that of the file, number by number.
fn compare(results: &Value, file: &Path) {
    let motion = Motion::from_bytes(&fs::read(file).unwrap()).unwrap();
    let frames = motion.times().len();
    assert_eq!(results["motion"]["frames"], frames);
    assert_eq!(results["motion"]["nodes"].as_array().unwrap().len(), motion.reference().len());
    let mut packed = Packed::of(results);
    let times: Vec<f64> = (0..frames).map(|_| packed.double()).collect();
    assert_eq!(times, motion.times());
    for pose in motion.reference() {
        let found: Vec<f64> = (0..7).map(|_| packed.double()).collect();
        assert_eq!(&found[..3], pose.position.as_slice());
    }
    for number in 0..motion.frame(0).len() {
        let wanted: Vec<f64> = (0..frames).map(|frame| f64::from(motion.frame(frame)[number])).collect();
        let [low, high] = wanted
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(*x), high.max(*x)]);
        let (found, quantum) = packed.channel(frames);
        assert!(quantum <= (high - low).max(1e-30) / 4000.0 || quantum < 1e-5, "{number}: {quantum}");
        for (found, wanted) in found.iter().zip(&wanted) {
            assert!((found - wanted).abs() <= 0.51 * quantum + 1e-300, "{number}: {found} for {wanted}");
        }
    }
    assert!(packed.is_read());
}

/// What would fetch something or send it somewhere, and the rule that forbids what is overlooked here.
fn asks_nobody(page: &str) {
    assert!(page.starts_with("<!doctype html>") && page.trim_end().ends_with("</html>"));
    assert!(page.contains("default-src 'none'") && page.contains("connect-src 'none'"));
    for needle in
        ["src=\"http", "src='http", "href=\"http", "url(http", "url(\"http", "@import", "<link", "<iframe"]
    {
        assert!(!page.contains(needle), "{needle}");
    }
}

#[test]
fn a_folder_of_results_becomes_a_page() {
    let folder = Folder::new("view-folder");
    let run = lissom(
        &["run", &example("four-bar"), "--set", "analysis.end=2", "--out", "out", "-q"],
        folder.path(),
    );
    assert_eq!(run.code, 0, "{}", run.errors);
    let view = lissom(&["view", "out"], folder.path());
    assert_eq!((view.code, view.output.trim()), (0, "out/view.html"), "{}", view.errors);
    let page = fs::read_to_string(folder.path().join("out/view.html")).unwrap();
    asks_nobody(&page);
    let results = results(&page);
    assert_eq!(results["title"], "Flexible four-bar with a misaligned joint");
    assert_eq!(results["notices"].as_array().unwrap().len(), 0);
    assert_eq!(results["scene"]["beams"].as_array().unwrap().len(), 3);
    assert_eq!(results["scene"]["joints"].as_array().unwrap().len(), 5);
    compare(&results, &folder.path().join("out/motion.bin"));
    let table = String::from_utf8(inflated(results["history"].as_str().unwrap())).unwrap();
    assert_eq!(table, fs::read_to_string(folder.path().join("out/history.csv")).unwrap());
    assert_eq!(results["columns"].as_array().unwrap().len(), Record::from_csv(&table).unwrap().columns.len());
}

#[test]
fn a_model_of_statics_is_simulated_and_shown() {
    let folder = Folder::new("view-statics");
    // A title that would end the page if it were put there as it is.
    folder
        .write("bar.toml", &CANTILEVER.replace("lissom = 1", "lissom = 1\ntitle = \"</script><b> & more\""));
    let view = lissom(&["view", "bar.toml", "--html", "bar.html"], folder.path());
    assert_eq!(view.code, 0, "{}", view.errors);
    let page = fs::read_to_string(folder.path().join("bar.html")).unwrap();
    asks_nobody(&page);
    assert!(page.contains("<title>&lt;/script&gt;&lt;b&gt; &amp; more</title>"));
    let results = results(&page);
    assert_eq!(results["title"], "</script><b> & more");
    assert_eq!(results["scene"]["is_static"], true);
    assert_eq!(results["motion"]["frames"], 5);
    compare(&results, &folder.path().join("out/bar/motion.bin"));
}

#[test]
fn a_model_at_the_start_is_shown_without_being_simulated() {
    let folder = Folder::new("view-initial");
    folder.write("bar.toml", CANTILEVER);
    let view = lissom(&["view", "bar.toml", "--initial"], folder.path());
    assert_eq!((view.code, view.output.trim()), (0, "out/bar/initial.html"), "{}", view.errors);
    let page = fs::read_to_string(folder.path().join("out/bar/initial.html")).unwrap();
    asks_nobody(&page);
    let results = results(&page);
    assert_eq!(results["motion"]["frames"], 1);
    assert_eq!(results["history"], Value::Null);
    assert!(!folder.path().join("out/bar/history.csv").exists());
}

#[test]
fn what_is_missing_or_went_wrong_is_reported_in_the_page() {
    let folder = Folder::new("view-failed");
    folder.write("bar.toml", CANTILEVER);
    let notices =
        |page: &str| results(&fs::read_to_string(folder.path().join(page)).unwrap())["notices"].clone();
    // No step of a load that is far too large has a solution: what exists is shown, and the exit code reports the failure.
    let args =
        ["view", "bar.toml", "--set", "loads.tip.scale=1e9*t", "--set", "analysis.max_iterations=3", "-q"];
    let view = lissom(&args, folder.path());
    assert_eq!(view.code, 3, "{}", view.errors);
    let reported = notices("out/bar/view.html");
    assert_eq!(reported[0]["kind"], "error");
    assert!(reported[0]["text"].as_str().unwrap().contains("failed"), "{reported}");
    assert_eq!(reported[0]["code"], "not-converged", "{reported}");
    assert!(reported[0]["remedy"].is_string() && reported[0]["part"].is_string(), "{reported}");
    // Without motion the plots are left.
    let run = lissom(&["run", "bar.toml", "--no-plots", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(!folder.path().join("out/bar/view.html").exists(), "a page of a former run would lie");
    fs::remove_file(folder.path().join("out/bar/motion.bin")).unwrap();
    assert_eq!(lissom(&["view", "out/bar", "-q"], folder.path()).code, 0);
    let reported = notices("out/bar/view.html");
    assert!(reported[0]["text"].as_str().unwrap().contains("run the model again"), "{reported}");
    let buckling = CANTILEVER.replace("kind = \"statics\"\nsteps = 4", "kind = \"buckling\"");
    folder.write("buckling.toml", &buckling.replace("scale = \"3*t\"\n", ""));
    for (args, words) in [
        (vec!["view", "nowhere"], "there is no such file"),
        (vec!["view", "out"], "specify one of them, such as `out/bar`"),
        (vec!["view", "buckling.toml"], "computes no motion"),
        (vec!["view", "out/bar", "--initial"], "folder of results"),
    ] {
        let view = lissom(&args, folder.path());
        assert_eq!(view.code, 2, "{args:?}");
        assert!(view.errors.contains(words), "{}", view.errors);
    }
    folder.write("out/bar/motion.bin", "something else");
    let view = lissom(&["view", "out/bar"], folder.path());
    assert_eq!(view.code, 2);
    assert!(view.errors.contains("not a motion file"), "{}", view.errors);
}

#[test]
fn warnings_are_in_the_page_with_code_part_time_and_remedy() {
    let folder = Folder::new("view-warnings");
    assert_eq!(lissom(&["new", "press"], folder.path()).code, 0);
    let text = fs::read_to_string(folder.path().join("press.toml")).unwrap();
    // From a straight rod, whose vibration the long steps do not resolve.
    let text = text.replace("equilibrium = true", "");
    folder.write("press.toml", &format!("{text}{SPARE_SECTION}"));
    let notices =
        |page: &str| results(&fs::read_to_string(folder.path().join(page)).unwrap())["notices"].clone();
    let long = ["--set", "analysis.step=0.01", "--set", "analysis.end=1", "-q"];
    let view = lissom(&[&["view", "press.toml"], &long[..]].concat(), folder.path());
    assert_eq!(view.code, 0, "{}", view.errors);
    let found = notices("out/press/view.html");
    let of_model = |found: &Value| {
        assert_eq!(
            (&found["kind"], &found["code"], &found["part"]),
            (&json!("warning"), &json!("model"), &json!("spare"))
        );
        assert!(found["text"].as_str().unwrap().contains("no beam has the section"), "{found}");
    };
    of_model(&found[0]);
    let of_run = found.as_array().unwrap().iter().find(|notice| notice["code"] == "unresolved-motion");
    let of_run = of_run.unwrap_or_else(|| panic!("{found}"));
    assert!(
        !of_run["part"].as_str().unwrap().is_empty() && of_run["time"].as_f64().unwrap() > 0.0,
        "{found}"
    );
    let [text, remedy] = ["text", "remedy"].map(|name| of_run[name].as_str().unwrap());
    assert!(remedy.contains("relative_tolerance") && !text.contains(remedy), "{found}");
    let initial = lissom(&["view", "press.toml", "--initial", "-q"], folder.path());
    assert_eq!(initial.code, 0, "{}", initial.errors);
    of_model(&notices("out/press/initial.html")[0]);
    // The results of an earlier version have texts alone.
    let path = folder.path().join("out/press/summary.json");
    let mut facts: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    facts.as_object_mut().unwrap().remove("diagnostics");
    fs::write(&path, facts.to_string()).unwrap();
    assert_eq!(lissom(&["view", "out/press", "-q"], folder.path()).code, 0);
    let earlier = notices("out/press/view.html");
    assert_eq!(earlier.as_array().unwrap().len(), found.as_array().unwrap().len());
    assert_eq!((&earlier[0]["text"], &earlier[0]["code"]), (&found[0]["text"], &Value::Null));
}

#[test]
fn modes_are_shown_about_their_state() {
    let folder = Folder::new("view-modes");
    folder.write("bar.toml", CANTILEVER);
    let modes = lissom(&["modes", "bar.toml", "--out", "out", "--count", "6", "-q"], folder.path());
    assert_eq!(modes.code, 0, "{}", modes.errors);
    let view = lissom(&["view", "out"], folder.path());
    assert_eq!((view.code, view.output.trim()), (0, "out/view.html"), "{}", view.errors);
    let results = results(&fs::read_to_string(folder.path().join("out/view.html")).unwrap());
    let shown = results["modes"].as_array().unwrap();
    assert_eq!((shown.len(), &results["motion"]["frames"]), (6, &Value::from(1)));
    let nodes = results["motion"]["nodes"].as_array().unwrap().len();
    let summary = fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    for (mode, listed) in shown.iter().zip(summary["modes"].as_array().unwrap()) {
        assert_eq!(mode["real"].as_array().unwrap().len(), 6 * (nodes - 1));
        assert_eq!(mode["name"], listed["name"]);
    }
    assert!(
        shown[0]["name"].as_str().unwrap().starts_with("1st bending of `bar` along "),
        "{}",
        shown[0]["name"]
    );
    // The state is the bar under its load: bent by F L³/(3 EI) = 3/600 m, up to shear and to what is beyond linear.
    let motion = Motion::from_bytes(&fs::read(folder.path().join("out/motion.bin")).unwrap()).unwrap();
    let tip = motion.node("bar.end").unwrap();
    assert!((motion.pose(0, tip).position.z - 5e-3).abs() < 5e-5, "{}", motion.pose(0, tip).position);
    // Complex shapes of nodes whose names have commas.
    let shapes = folder.path().join("out/shapes.csv");
    let text = fs::read_to_string(&shapes).unwrap();
    let complex = |(line, row): (usize, &str)| match line {
        0 => format!("{row},u1_im,u2_im,u3_im,r1_im,r2_im,r3_im\n"),
        _ => format!("{},1,2,3,4,5,5e-1\n", row.replace("bar.end", "\"bar, end\"")),
    };
    fs::write(&shapes, text.lines().enumerate().map(complex).collect::<String>()).unwrap();
    assert_eq!(lissom(&["view", "out", "-q"], folder.path()).code, 0);
    let page = fs::read_to_string(folder.path().join("out/view.html")).unwrap();
    let second = &self::results(&page)["modes"][1];
    assert_eq!(second["real"], shown[1]["real"]);
    assert_eq!(second["imaginary"].as_array().unwrap()[6..12], [1.0, 2.0, 3.0, 4.0, 5.0, 0.5]);
    // Shapes of another model, and a run in the same folder: nothing is mixed up.
    fs::write(&shapes, &text[..text.len() / 2]).unwrap();
    let view = lissom(&["view", "out"], folder.path());
    assert!(view.code == 2 && view.errors.contains("shapes.csv"), "{}", view.errors);
    let run = lissom(&["view", "bar.toml", "--out", "out", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(!folder.path().join("out/modes.csv").exists());
}

/// Runs `lissom` with a launcher of the desktop that ends with `code`.
#[cfg(target_os = "linux")]
fn with_launcher(folder: &Folder, code: i32, arguments: &[&str]) -> std::process::Output {
    use std::os::unix::fs::PermissionsExt;
    let launcher = folder.path().join("xdg-open");
    fs::write(&launcher, format!("#!/bin/sh\nexit {code}\n")).unwrap();
    fs::set_permissions(&launcher, fs::Permissions::from_mode(0o755)).unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lissom"));
    command.args(arguments).current_dir(folder.path()).env("PATH", folder.path()).output().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn a_launcher_without_a_browser_is_reported() {
    let folder = Folder::new("view-open");
    folder.write("bar.toml", CANTILEVER);
    let arguments = ["view", "bar.toml", "--initial", "--html", "bar.html", "--open"];
    let opened = with_launcher(&folder, 0, &arguments);
    assert_eq!(opened.status.code(), Some(0), "{}", String::from_utf8_lossy(&opened.stderr));
    // As `xdg-open` ends where it finds no program.
    let failed = with_launcher(&folder, 3, &arguments);
    let errors = String::from_utf8_lossy(&failed.stderr);
    assert_eq!(failed.status.code(), Some(3), "{errors}");
    assert!(errors.contains("no-browser") && errors.contains("bar.html"), "{errors}");
}

#[test]
fn folders_of_results_in_a_folder_are_named() {
    let folder = Folder::new("view-several");
    folder.write("bar.toml", CANTILEVER);
    for name in ["out/first", "out/second"] {
        let run = lissom(&["run", "bar.toml", "--out", name, "--quiet", "--no-plots"], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
    }
    for command in ["view", "plot", "snapshot"] {
        let run = lissom(&[command, "out"], folder.path());
        assert_eq!(run.code, 2, "{command}: {}", run.errors);
        assert!(run.errors.contains("`first`, `second`"), "{command}: {}", run.errors);
    }
}

/// What has modes is written, and the command fails because of the rest.
#[test]
fn a_campbell_diagram_is_written_as_far_as_there_are_modes() {
    let folder = Folder::new("campbell-partly");
    // Blades on a support that yields one way have no constant coefficients as soon as they turn.
    let text = "lissom = 1\n[parameters]\nspeed = 1.0\n[bodies.support]\nmass = 2\ninertia = [1, 1, 1]\n\
                [joints.slide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"support\"\naxis = \"y\"\n\
                [springs.support]\nkind = \"axial\"\njoint = \"slide\"\nstiffness = 1e5\n\
                [bodies.hub]\nmass = 1\ninertia = [1, 1, 1]\ncenter_of_mass = [0, 0, 0]\n\
                [joints.shaft]\nkind = \"revolute\"\nbase = \"support\"\ntip = \"hub\"\naxis = \"x\"\n\
                [bodies.blade]\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nposition = [0, 0, 1]\n\
                [joints.flap]\nkind = \"revolute\"\nbase = \"hub\"\ntip = \"blade\"\naxis = \"y\"\nat = [0, 0, 0]\n\
                [springs.flap]\nkind = \"torsional\"\njoint = \"flap\"\nstiffness = 1e3\n\
                [initial.rotor]\nparts = [\"hub\", \"blade\"]\nangular_velocity = [\"speed\", 0, 0]\n\
                [analysis]\nkind = \"dynamics\"\nend = 1\n";
    fs::write(folder.path().join("rotor.toml"), text).unwrap();
    let run = lissom(
        &["campbell", "rotor.toml", "--vary", "parameters.speed=0:100:3", "--out", "rotor"],
        folder.path(),
    );
    assert_eq!(run.code, 3, "{}", run.errors);
    assert!(run.errors.contains("1 other value"), "{}", run.errors);
    let table = fs::read_to_string(folder.path().join("rotor/campbell.csv")).unwrap();
    assert!(
        table.lines().count() > 1 && table.lines().skip(1).all(|line| line.starts_with("0.0,")),
        "{table}"
    );
    let summary = fs::read_to_string(folder.path().join("rotor/summary.json")).unwrap();
    assert!(summary.contains("\"stopped\": \"failed\"") && summary.contains("\"failure\""), "{summary}");
}

#[test]
fn a_campbell_diagram_is_a_page_with_its_lines_and_crossings() {
    let folder = Folder::new("view-campbell");
    let model = "../../verification/rotor-whirl/model.toml";
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join(model).display().to_string();
    let varied = ["campbell", &model, "--vary", "parameters.Omega=0:1000:6", "--out", "rotor"];
    let run = lissom(&varied, folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains(" rpm, ") && run.output.contains("whirl backward"), "{}", run.output);
    let view = lissom(&["view", "rotor", "-q"], folder.path());
    assert_eq!(view.code, 0, "{}", view.errors);
    let page = fs::read_to_string(folder.path().join("rotor/view.html")).unwrap();
    let found = results(&page);
    let lines = found["campbell"]["lines"].as_array().unwrap();
    assert_eq!((lines.len(), &found["campbell"]["multiples"]), (8, &json!([1, 2, 3])));
    // Each line goes on over all values, with one sense of whirl.
    for line in lines {
        assert_eq!(line["frequencies"].as_array().map(Vec::len), Some(6), "{line}");
        assert_ne!(line["whirl"], "changes", "{line}");
    }
    let summary = fs::read_to_string(folder.path().join("rotor/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(found["campbell"]["crossings"], summary["critical_speeds"]);
    let diagram = fs::read_to_string(folder.path().join("rotor/campbell.svg")).unwrap();
    for words in ["crossing", "rotation 0 to 9549 rpm"] {
        assert!(diagram.contains(words), "{words}");
    }
    // Without rotation lines 2 and 3 are one, and their order is arbitrary.
    let lines = [["2 backward", "3 forward"], ["2 forward", "3 backward"]];
    assert!(lines.iter().any(|words| words.iter().all(|words| diagram.contains(words))));
    let snapshot = lissom(&["snapshot", "rotor"], folder.path());
    assert!(
        snapshot.code == 2 && snapshot.errors.contains("show it by `lissom view`"),
        "{}",
        snapshot.errors
    );
    // The page has what is in the table, and none of a damaged one.
    let shown = |table: &str| {
        fs::write(folder.path().join("rotor/campbell.csv"), table).unwrap();
        let view = lissom(&["view", "rotor", "-q"], folder.path());
        (view.code == 0).then(|| results(&fs::read_to_string(folder.path().join("rotor/view.html")).unwrap()))
    };
    let table = "value,rotation,line,frequency,damping,kind,whirl,frequency_at_rest,likeness\n\
                 0.0,0.0,1,5.0,0.0,oscillation,none,5.0,\n\
                 0.0,0.0,2,5.0,0.0,oscillation,none,5.0,\n\
                 10.0,1.5,2,3.0,0.02,oscillation,forward,4.5,0.5\n\
                 10.0,1.5,1,7.0,0.01,oscillation,mixed,,0.5\n";
    let found = shown(table).unwrap();
    assert_eq!(found["facts"], "2 lines over 2 values of parameters.Omega");
    let [first, second] = [0, 1].map(|line| &found["campbell"]["lines"][line]);
    assert_eq!((&first["whirl"], &second["whirl"]), (&json!("mixed"), &json!("forward")));
    assert_eq!((&first["frequencies"], &second["frequencies"]), (&json!([5.0, 7.0]), &json!([5.0, 4.5])));
    assert_eq!((&second["damping"], &second["rotations"]), (&json!([0.0, 0.02]), &json!([0.0, 1.5])));
    for damaged in ["value\n1\n", "", &table.replace("3.0", "x"), &table.replace(",2,5.0", ",0,5.0")] {
        assert!(shown(damaged).is_none(), "{damaged}");
    }
}
