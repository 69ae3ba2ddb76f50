//! `lissom sweep`, as scripts see it.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use lissom::Record;

use crate::support::{Ended, Folder, Run, example, lissom, wait_for};

/// A sweep over the pendulum.
fn sweep_file(folder: &Folder, rest: &str) {
    let text = format!("lissom_sweep = 1\nmodel = \"{}\"\n{rest}", example("pendulum"));
    folder.write("sweep.toml", &text);
}

fn sweep(folder: &Folder, out: &str, more: &[&str]) -> Ended {
    let mut args = vec!["sweep", "sweep.toml", "--out", out];
    args.extend(more);
    lissom(&args, folder.path())
}

fn table(folder: &Folder, out: &str) -> String {
    fs::read_to_string(folder.path().join(out).join("sweep.csv")).unwrap()
}

fn facts(folder: &Folder, out: &str) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(folder.path().join(out).join("sweep.json")).unwrap()).unwrap()
}

const GRID: &str = r#"
set.analysis.end = 0.2
[vary]
"point_masses.bob.mass" = [1, 2.5]
"springs.spring.stiffness" = { from = 1, to = 100, count = 3, spacing = "logarithmic" }
[collect]
high = "max(bob.y)"
low = "min(bob.y)"
end = "final(force.f1)"
rms = "rms(energy.kinetic)"
"#;

#[test]
fn every_row_is_what_a_single_run_gives() {
    let folder = Folder::new("sweep-rows");
    sweep_file(&folder, GRID);
    let ended = sweep(&folder, "out", &[]);
    assert_eq!((ended.code, ended.errors.as_str()), (0, ""));
    assert!(
        ended.output.contains("6 by grid, 6 solved") && ended.output.contains("out/sweep.csv"),
        "{}",
        ended.output
    );
    let table = table(&folder, "out");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(
        lines[0],
        "member,point_masses.bob.mass,springs.spring.stiffness,high,low,end,rms,state,time,steps,\
         max_constraint_violation,diagnosis"
    );
    assert_eq!(lines.len(), 7);
    for (index, line) in lines[1..].iter().enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(
            (cells[0], cells[7], cells[8], cells[9]),
            (index.to_string().as_str(), "solved", "0.2", "20")
        );
        let (mass, stiffness) =
            (format!("point_masses.bob.mass={}", cells[1]), format!("springs.spring.stiffness={}", cells[2]));
        let model = example("pendulum");
        let mut args = vec!["run", &model, "--no-plots", "--out", "one", "--set", "analysis.end=0.2"];
        args.extend(["--set", &mass, "--set", &stiffness]);
        assert_eq!(lissom(&args, folder.path()).code, 0);
        let text = fs::read_to_string(folder.path().join("one/history.csv")).unwrap();
        let record = Record::from_csv(&text).unwrap();
        let y = record.column("bob", "y").unwrap();
        let number = |cell: usize| cells[cell].parse::<f64>().unwrap();
        assert_eq!(number(3), y.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        assert_eq!(number(4), y.iter().copied().fold(f64::INFINITY, f64::min));
        assert_eq!(Some(&number(5)), record.column("force", "f1").unwrap().last());
        let energy = record.column("energy", "kinetic").unwrap();
        let parts = record.times.windows(2).zip(energy.windows(2));
        let integral: f64 = parts.map(|(t, e)| 0.5 * (t[1] - t[0]) * (e[0] * e[0] + e[1] * e[1])).sum();
        assert!((number(6) - (integral / 0.2).sqrt()).abs() < 1e-13 * number(6));
    }
    assert!(lines[1].starts_with("0,1,1,") && lines[6].starts_with("5,2.5,100,"), "{table}");
    let facts = facts(&folder, "out");
    assert_eq!((&facts["members"], &facts["solved"], &facts["failed"]), (&6.into(), &6.into(), &0.into()));
}

/// A window in a sweep, and the same one in the statistics of a run.
#[test]
fn windows_restrict_statistics() {
    let folder = Folder::new("sweep-windows");
    let varied = "set.analysis.end = 1\nset.analysis.step = 0.1\nvary.\"point_masses.bob.mass\" = [1]\n";
    let collect = |item: &str| format!("{varied}collect.late = \"{item}\"\n");
    sweep_file(&folder, &collect("time_of_max(bob.x, after=0.55)"));
    assert_eq!(sweep(&folder, "out", &[]).code, 0);
    let late: f64 = table(&folder, "out").lines().nth(1).unwrap().split(',').nth(2).unwrap().parse().unwrap();
    assert!((0.55..=1.0).contains(&late), "{late}");

    let model = example("pendulum");
    let mut args = vec!["run", &model, "--no-plots", "--out", "one", "--set", "analysis.end=1"];
    args.extend(["--set", "analysis.step=0.1", "--set", "point_masses.bob.mass=1"]);
    args.extend(["--set", "analysis.statistics_window='after=0.55'"]);
    assert_eq!(lissom(&args, folder.path()).code, 0);
    let text = fs::read_to_string(folder.path().join("one/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(summary["statistics"]["bob.x"]["time_of_max"].as_f64(), Some(late));

    sweep_file(&folder, &collect("max(bob.x, after=2)"));
    let ended = sweep(&folder, "out", &["--restart"]);
    assert_eq!(ended.code, 2);
    assert!(
        ended.errors.contains("(sweep.toml:6) cannot be used: the window begins at 2 s"),
        "{}",
        ended.errors
    );
}

#[test]
fn tables_do_not_depend_on_the_number_of_workers() {
    let folder = Folder::new("sweep-workers");
    let drawn = "sampling = \"sobol\"\nmembers = 40\nseed = 5\nset.analysis.end = 0.1\n[vary]\n\
                 \"point_masses.bob.mass\" = { from = 1, to = 3 }\n\
                 \"springs.spring.stiffness\" = { mean = 10, standard_deviation = 1 }\n[collect]\nx = \"rms(bob.x)\"\n";
    sweep_file(&folder, drawn);
    for workers in ["1", "2", "7"] {
        assert_eq!(sweep(&folder, workers, &["--workers", workers, "--quiet"]).code, 0);
    }
    assert!(table(&folder, "1") == table(&folder, "2") && table(&folder, "1") == table(&folder, "7"));
    let rows: std::collections::BTreeSet<String> =
        table(&folder, "1").lines().map(|line| line.split_once(',').unwrap().1.to_owned()).collect();
    assert_eq!(rows.len(), 41, "all members differ");
    sweep_file(&folder, &drawn.replace("seed = 5", "seed = 6"));
    assert_eq!(sweep(&folder, "other", &["--quiet"]).code, 0);
    assert_ne!(table(&folder, "1"), table(&folder, "other"));
}

/// Members whose values are wrong, and members without a solution, have their rows; the exit code reports them.
#[test]
fn members_that_fail_are_reported_and_the_others_are_there() {
    let folder = Folder::new("sweep-fail");
    sweep_file(
        &folder,
        "set.analysis.end = 0.05\n[vary]\n\"point_masses.bob.mass\" = [-1, 1]\n\"analysis.max_iterations\" = [1, 40]\n\
         [collect]\nx = \"final(bob.x)\"\n",
    );
    let ended = sweep(&folder, "out", &[]);
    assert_eq!(ended.code, 3, "{}", ended.errors);
    assert!(ended.errors.contains("3 of 4 members have no solution"), "{}", ended.errors);
    let table = table(&folder, "out");
    let lines: Vec<&str> = table.lines().collect();
    assert!(
        lines[1].starts_with("0,-1,1,,wrong_model,,0,,") && lines[1].contains("greater than zero"),
        "{table}"
    );
    assert!(lines[2].starts_with("1,-1,40,,wrong_model"), "{table}");
    assert!(lines[3].starts_with("2,1,1,,failed,0,0,") && lines[3].contains("did not converge"), "{table}");
    assert!(lines[4].starts_with("3,1,40,0.0") && lines[4].contains(",solved,0.05,5,"), "{table}");
    // Nothing is solved again, and the exit code is the same.
    let again = sweep(&folder, "out", &[]);
    assert_eq!(again.code, 3);
    assert!(again.output.contains("4 of them by an earlier run"), "{}", again.output);
    assert_eq!(self::table(&folder, "out"), table);
}

#[test]
fn a_sweep_that_was_killed_goes_on_to_the_same_table() {
    let folder = Folder::new("sweep-kill");
    // Few milliseconds per member.
    let text = "sampling = \"monte-carlo\"\nmembers = 120\nset.analysis.step = 2e-4\n[vary]\n\
                \"point_masses.bob.mass\" = { from = 1, to = 3 }\n[collect]\nx = \"max(bob.x)\"\n";
    sweep_file(&folder, text);
    assert_eq!(sweep(&folder, "whole", &["--quiet"]).code, 0);
    let record = folder.path().join("cut/members.jsonl");
    let lines = || fs::read_to_string(&record).map_or(0, |text| text.lines().count());
    let mut kills = 0;
    loop {
        let before = lines();
        let mut command = Command::new(env!("CARGO_BIN_EXE_lissom"));
        command.args(["sweep", "sweep.toml", "--out", "cut", "--quiet"]).current_dir(folder.path());
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        // Killed after a few members, wherever the next one is.
        let ended = || record.with_file_name("sweep.csv").is_file();
        wait_for(|| lines() > before + 15 || ended());
        sleep(Duration::from_micros(300 * kills));
        let _ = child.kill();
        child.wait().unwrap();
        if ended() {
            break;
        }
        kills += 1;
    }
    assert!(kills >= 3, "killed {kills} times only");
    // A line that was cut off is computed again.
    let text = fs::read_to_string(&record).unwrap();
    fs::write(&record, &text[..text.len() - 7]).unwrap();
    assert_eq!(sweep(&folder, "cut", &["--quiet"]).code, 0);
    assert_eq!(table(&folder, "cut"), table(&folder, "whole"));
    let mut members: Vec<&str> = text.lines().skip(1).collect();
    members.sort_unstable();
    members.dedup();
    assert_eq!(members.len(), 120, "each once");
}

#[test]
fn an_interrupted_sweep_keeps_its_members_and_writes_no_table() {
    let folder = Folder::new("sweep-interrupt");
    sweep_file(
        &folder,
        "sampling = \"monte-carlo\"\nmembers = 100000\n[vary]\n\"point_masses.bob.mass\" = { from = 1, to = 3 }\n\
         [collect]\nx = \"max(bob.x)\"\n",
    );
    let record = folder.path().join("out/members.jsonl");
    let mut run = Run::start(&["sweep", "sweep.toml", "--out", "out"], folder.path());
    wait_for(|| fs::metadata(&record).is_ok_and(|found| found.len() > 5000));
    run.interrupt();
    let ended = run.finish();
    assert_eq!(ended.code, 130);
    assert!(ended.errors.contains("of 100000 members are in `out`"), "{}", ended.errors);
    assert!(!folder.path().join("out/sweep.csv").exists());
}

/// Pictures of the table, histories, times of events.
#[test]
fn pictures_histories_and_times_of_events_are_there() {
    let folder = Folder::new("sweep-more");
    folder.write(
        "stone.toml",
        "lissom = 1\n[point_masses.stone]\nmass = 1\nvelocity = [2, 0, 0]\n[parameters]\nplace = 0.5\n\
         [outputs.stone]\nkind = \"position\"\nof = \"stone\"\n[events.far]\nzero_of = \"stone.x - place\"\nstop = true\n\
         [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n",
    );
    let file = |places: &str| {
        let text = format!(
            "lissom_sweep = 1\nmodel = \"stone.toml\"\nhistories = [\"stone.x\"]\n[vary]\n\"parameters.place\" = {places}\n\
             [collect]\narrival = \"time_of_event(far)\"\nend = \"final(stone.x)\"\n"
        );
        folder.write("sweep.toml", &text);
    };
    file("[0.45, 1.1, 1.5]");
    assert_eq!(sweep(&folder, "out", &["--quiet"]).code, 0);
    for (line, place) in table(&folder, "out").lines().skip(1).zip([0.45, 1.1, 1.5]) {
        let cells: Vec<f64> = line.split(',').take(4).map(|cell| cell.parse().unwrap()).collect();
        assert!((cells[2] - place / 2.0).abs() < 1e-12 && (cells[3] - place).abs() < 1e-12, "{line}");
    }
    let read = |name: &str| fs::read(folder.path().join("out").join(name)).unwrap();
    let svg = String::from_utf8(read("responses.svg")).unwrap();
    assert_eq!(svg.matches("<circle").count(), 6, "three members in two panels");
    for words in ["parameters.place", "arrival", "3 members"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(String::from_utf8(read("parallel-coordinates.svg")).unwrap().contains("arrival"));
    for name in ["responses.png", "parallel-coordinates.png"] {
        assert!(read(name).starts_with(b"\x89PNG"), "{name}");
    }
    for name in ["sweep.parquet", "histories/member-00000002.parquet"] {
        assert!(read(name).starts_with(b"PAR1") && read(name).ends_with(b"PAR1"), "{name}");
    }
    // An event that is not reached is a failure, never a number; histories are there up to the end.
    file("[0.5, 3]");
    let ended = sweep(&folder, "never", &["--no-plots"]);
    assert_eq!(ended.code, 3);
    assert!(ended.errors.contains("member 1: event `far` has not happened"), "{}", ended.errors);
    assert!(!folder.path().join("never/responses.svg").exists());
    assert!(folder.path().join("never/histories/member-00000001.parquet").exists());
    // Another sweep in its place leaves nothing of it.
    file("[0.25]");
    assert_eq!(sweep(&folder, "never", &["--restart", "--quiet"]).code, 0);
    assert!(!folder.path().join("never/histories/member-00000001.parquet").exists());
    folder.write("sweep.toml", "lissom_sweep = 1\nmodel = \"stone.toml\"\nhistories = [\"stone.w\"]\n[vary]\n\"parameters.place\" = [1]\n[collect]\nx = \"time_of_event(near)\"\n");
    let wrong = sweep(&folder, "bad", &[]);
    assert!(wrong.code == 2 && wrong.errors.contains("its events are far"), "{}", wrong.errors);
    folder.write("sweep.toml", "lissom_sweep = 1\nmodel = \"stone.toml\"\nhistories = [\"stone.w\"]\n[vary]\n\"parameters.place\" = [1]\n[collect]\nx = \"max(stone.x)\"\n");
    let wrong = sweep(&folder, "bad", &[]);
    assert!(wrong.code == 2 && wrong.errors.contains("`stone.w`"), "{}", wrong.errors);
}

#[test]
fn wrong_sweeps_end_with_2() {
    let folder = Folder::new("sweep-bad");
    let ends_with_2 = |rest: &str, more: &[&str], words: &str| {
        sweep_file(&folder, rest);
        let ended = sweep(&folder, "bad", more);
        assert_eq!(ended.code, 2, "{rest}: {}", ended.errors);
        assert!(ended.errors.contains(words), "{rest}: {}", ended.errors);
    };
    let good = "[vary]\n\"point_masses.bob.mass\" = [1, 2]\n[collect]\nx = \"max(bob.x)\"\n";
    ends_with_2("", &[], "lacks `vary`");
    ends_with_2(&good.replace("bob.mass", "bob.mas"), &[], "did you mean `mass`");
    ends_with_2(&good.replace("bob.mass", "bub.mass"), &[], "did you mean `bob`");
    ends_with_2(&good.replace("bob.x", "bob.z1"), &[], "bob.x");
    ends_with_2(good, &["--set", "analysis.stepp=1"], "stepp");
    ends_with_2(good, &["--workers", "0"], "workers");
    let modes = "[vary]\n\"analysis.kind\" = [\"modes\"]\n[collect]\nx = \"max(bob.x)\"\n";
    let text = std::fs::read_to_string(example("pendulum")).unwrap();
    let text = text.split("[analysis]").next().unwrap();
    folder.write("modes.toml", &format!("{text}[analysis]\nkind = \"statics\"\n"));
    folder.write("sweep.toml", &format!("lissom_sweep = 1\nmodel = \"modes.toml\"\n{modes}"));
    let ended = sweep(&folder, "bad", &[]);
    assert!(ended.code == 2 && ended.errors.contains("has no history"), "{}", ended.errors);
    assert!(!folder.path().join("bad").exists(), "a wrong sweep leaves no results");
    folder.write("sweep.toml", &format!("lissom_sweep = 1\n{good}"));
    assert!(sweep(&folder, "bad", &[]).errors.contains("specifies no model"));
    folder.write("sweep.toml", &format!("lissom_sweep = 1\nmodel = \"none.toml\"\n{good}"));
    assert_eq!(sweep(&folder, "bad", &[]).code, 2);

    // Members of another sweep are never mixed with this one's.
    sweep_file(&folder, good);
    assert_eq!(sweep(&folder, "out", &["--quiet"]).code, 0);
    let before = table(&folder, "out");
    for (file, more) in
        [(good.replace("[1, 2]", "[1, 3]"), None), (good.to_owned(), Some("analysis.end=0.5"))]
    {
        sweep_file(&folder, &file);
        let set: Vec<&str> = more.iter().flat_map(|set| ["--set", *set]).collect();
        let ended = sweep(&folder, "out", &set);
        assert_eq!(ended.code, 2, "{}", ended.errors);
        assert!(
            ended.errors.contains("another sweep") && ended.errors.contains("--restart"),
            "{}",
            ended.errors
        );
        assert_eq!(table(&folder, "out"), before, "what is there stays");
    }
    // Comments change nothing.
    sweep_file(&folder, &format!("# the same\n{good}"));
    assert_eq!(sweep(&folder, "out", &["--quiet"]).code, 0);
    sweep_file(&folder, &good.replace("[1, 2]", "[1, 3]"));
    assert_eq!(sweep(&folder, "out", &["--restart", "--quiet"]).code, 0);
    assert_ne!(table(&folder, "out"), before);

    let record = folder.path().join("out/members.jsonl");
    let damaged = fs::read_to_string(&record).unwrap().replace("\"solved\"", "\"so\"");
    fs::write(&record, damaged).unwrap();
    assert!(sweep(&folder, "out", &[]).errors.contains("line 2"));
    assert!(Path::new(&record).is_file());
}
