//! Checks whether the cases contain the results of independent programs: `verification/references/` writes values and errors to
//! `digits.toml`, and every entry of a case that is called independent has to be one of them.

use std::path::Path;

use serde::Deserialize;

use crate::case::{Case, CaseError};

/// Output of the programs.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Digits {
    #[serde(default)]
    row: Vec<Computed>,
}

/// The values of one row of a case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Computed {
    case: String,
    row: String,
    values: Vec<f64>,
    errors: Vec<f64>,
}

/// Messages about values of the cases that differ from the programs, and rows of the programs without a case.
pub(crate) fn differences(folder: &Path, cases: &[Case]) -> Result<Vec<String>, CaseError> {
    let path = folder.join("references/digits.toml");
    let unreadable = |reason: String| CaseError::Unreadable { path: path.display().to_string(), reason };
    let text = std::fs::read_to_string(&path).map_err(|error| unreadable(error.to_string()))?;
    let digits: Digits = toml::from_str(&text).map_err(|error| unreadable(error.to_string()))?;
    let of_case = |case: &Case| {
        digits
            .row
            .iter()
            .filter(|computed| computed.case == case.name)
            .filter_map(|computed| difference(case, computed))
            .collect::<Vec<_>>()
    };
    Ok(cases.iter().flat_map(of_case).collect())
}

/// Why a row of the case does not agree with the computed value.
fn difference(case: &Case, computed: &Computed) -> Option<String> {
    let finding = |words: String| Some(format!("{}, `{}`: {words}", case.name, computed.row));
    let Some((held, scale, uncertainty)) = held(case, &computed.row) else {
        return finding(
            "the programs in verification/references compute it, and no row is called so".to_owned(),
        );
    };
    if held.len() != computed.values.len() || held.len() != computed.errors.len() {
        return finding(format!("{} values in the case, {} computed", held.len(), computed.values.len()));
    }
    let largest = held.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let scale = scale.unwrap_or(largest);
    let triples = held.iter().zip(&computed.values).zip(&computed.errors);
    triples.enumerate().find_map(|(index, ((held, value), error))| {
        // The last digit of a double is not distinguished from its neighbour.
        let allowed = scale * (uncertainty + 1e-15) + error;
        let is_near = (held - value).abs() <= allowed;
        if is_near {
            return None;
        }
        finding(format!("entry {index} is {held:e}, computed {value:e}, allowed {allowed:.1e}"))
    })
}

/// References, scale and uncertainty of a quantity or of a refinement.
fn held(case: &Case, row: &str) -> Option<(Vec<f64>, Option<f64>, f64)> {
    let of_case = case.uncertainty.unwrap_or(0.0);
    if let Some(quantity) = case.quantity.iter().find(|quantity| quantity.name == row) {
        let single = quantity.reference.into_iter();
        let held = single.chain(quantity.entries.iter().map(|(_, _, reference)| *reference)).collect();
        return Some((held, quantity.scale, quantity.uncertainty.unwrap_or(of_case)));
    }
    let refinement = case.refinement.iter().find(|refinement| refinement.name == row)?;
    Some((refinement.reference.clone(), None, of_case))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cases() -> (std::path::PathBuf, Vec<Case>) {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("verification");
        let mut cases = Vec::new();
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.join("case.toml").is_file() {
                cases.push(Case::read(&path).unwrap());
            }
        }
        (folder, cases)
    }

    #[test]
    fn cases_hold_what_the_independent_programs_compute() {
        let (folder, cases) = cases();
        let found = differences(&folder, &cases).unwrap();
        assert!(found.is_empty(), "{}", found.join("\n"));
    }

    #[test]
    fn a_changed_digit_is_reported() {
        let (folder, mut cases) = cases();
        let case = cases.iter_mut().find(|case| case.name == "bend-45").unwrap();
        case.quantity[0].entries[4].2 += 1e-11;
        let found = differences(&folder, &cases).unwrap();
        assert!(found.len() == 1 && found[0].contains("entry 4"), "{found:?}");
    }

    #[test]
    fn every_case_with_independent_digits_has_a_program() {
        let (folder, cases) = cases();
        let text = std::fs::read_to_string(folder.join("references/digits.toml")).unwrap();
        let readme = std::fs::read_to_string(folder.join("references/README.md")).unwrap();
        for case in cases.iter().filter(|case| case.source.contains("independent")) {
            let has = text.contains(&format!("case = \"{}\"", case.name));
            // What no program computes yet is in the table of the README that says so.
            let owed = readme.split("## Not here").nth(1).unwrap_or("").contains(&format!("`{}`", case.name));
            assert!(has != owed, "{}: computed {has}, owed {owed}", case.name);
        }
    }
}
