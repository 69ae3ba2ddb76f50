//! Results of the program for a model of `models/`.

use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::support::{Ended, Folder, lissom};

/// Path of a file in `models/`.
pub(crate) fn model(file: &str) -> String {
    format!("{}/tests/defects/models/{file}", env!("CARGO_MANIFEST_DIR"))
}

/// Names of all files in `models/`, without those of matrices.
pub(crate) fn model_files() -> Vec<String> {
    let entries = fs::read_dir(model("")).unwrap().flatten();
    entries
        .filter(|entry| entry.path().is_file())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect()
}

/// Number of folders that were made.
static FOLDERS: AtomicUsize = AtomicUsize::new(0);

/// The results of a command in a folder of its own.
pub(crate) struct Results {
    pub(crate) folder: Folder,
    pub(crate) ended: Ended,
}

impl Results {
    /// Results of `lissom COMMAND models/FILE OPTIONS… --out o`; an absolute path remains what it is.
    pub(crate) fn of(command: &str, file: &str, options: &[&str]) -> Self {
        let path = if file.starts_with('/') { file.to_owned() } else { model(file) };
        let options: Vec<&str> = [&[command, &path, "--out", "o"], options].concat();
        let folder = Folder::new(&format!("defects-{}", FOLDERS.fetch_add(1, Ordering::Relaxed)));
        let ended = lissom(&options, folder.path());
        Self { folder, ended }
    }

    /// Results of a run that must end with exit code 0 and without a warning.
    pub(crate) fn clean(file: &str, options: &[&str]) -> Self {
        let results = Self::of("run", file, &[options, &["--no-plots"]].concat());
        results.assert_done();
        results.assert_silent();
        results
    }

    pub(crate) fn assert_done(&self) {
        assert_eq!(self.ended.code, 0, "{}\n{}", self.ended.output, self.ended.errors);
    }

    pub(crate) fn assert_silent(&self) {
        assert!(!self.ended.errors.contains("warning"), "{}", self.ended.errors);
    }

    pub(crate) fn path(&self, file: &str) -> PathBuf {
        self.folder.path().join("o").join(file)
    }

    /// A table of the results: the names of its columns, and its rows.
    fn table(&self, file: &str) -> (Vec<String>, Vec<Vec<f64>>) {
        let text = fs::read_to_string(self.path(file)).unwrap();
        let mut lines = text.lines();
        let names = lines.next().unwrap().split(',').map(str::to_owned).collect();
        let numbers = |line: &str| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        (names, lines.map(numbers).collect())
    }

    /// A column of a table.
    pub(crate) fn column_of(&self, file: &str, name: &str) -> Vec<f64> {
        let (names, rows) = self.table(file);
        let index = names.iter().position(|known| known == name);
        let index = index.unwrap_or_else(|| panic!("{name} is not in {names:?}"));
        rows.iter().map(|row| row[index]).collect()
    }

    /// A column of the history.
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        self.column_of("history.csv", name)
    }

    pub(crate) fn first(&self, name: &str) -> f64 {
        self.column(name)[0]
    }

    pub(crate) fn last(&self, name: &str) -> f64 {
        *self.column(name).last().unwrap()
    }

    pub(crate) fn last_of(&self, names: &[&str]) -> Vec<f64> {
        names.iter().map(|name| self.last(name)).collect()
    }

    /// Length of the polygon through the nodes of an output `line`.
    pub(crate) fn length_of_line(&self, output: &str) -> f64 {
        let (names, rows) = self.table("history.csv");
        let last = rows.last().unwrap();
        let of = |axis: &str, k: usize| {
            let name = format!("{output}.{axis}{k}");
            Some(last[names.iter().position(|known| *known == name)?])
        };
        let node = |k: usize| Some(nalgebra::Vector3::new(of("x", k)?, of("y", k)?, of("z", k)?));
        (1..).map_while(|k| Some((node(k)? - node(k - 1)?).norm())).sum()
    }

    /// Compares components that `output` has at the end.
    pub(crate) fn assert_last(&self, output: &str, components: &[&str], expected: &[f64], tolerance: f64) {
        for (component, expected) in components.iter().zip(expected) {
            let name = format!("{output}.{component}");
            near(&name, self.last(&name), *expected, tolerance);
        }
    }
}

/// An error below the tolerance.
pub(crate) fn near(what: &str, found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{what}: {found} instead of {expected}, error {error:e}");
}

/// Largest magnitude.
pub(crate) fn largest(column: &[f64]) -> f64 {
    column.iter().fold(0.0, |most, value| f64::max(most, value.abs()))
}
