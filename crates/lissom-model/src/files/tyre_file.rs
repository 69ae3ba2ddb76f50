//! Tyre property files `.tir`: sections of lines `NAME = value`, comments from `$` or `!`, units in the section `UNITS`.

use std::collections::BTreeMap;

use lissom_mechanics::elements::tyre::SIDE;
use lissom_mechanics::elements::tyre::magic_formula::{COEFFICIENTS, OF_MF_TYRE};

/// What a file says of a tyre.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TyreFile {
    /// Coefficients [SI], by name, with the side of the vehicle on which the tyre was measured and the convention of signs.
    pub coefficients: BTreeMap<String, f64>,
    /// Coefficients that are not zero and that the model does not use.
    pub unused: Vec<String>,
}

/// A file that is no tyre property file of the known kinds.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TyreFileError {
    /// A line is neither a section nor a value.
    #[error("line {line}: `{text}` is neither a section nor `NAME = value`")]
    Line {
        /// Line of the file, from 1.
        line: usize,
        /// Beginning of the line.
        text: String,
    },
    /// A value is no number.
    #[error("line {line}: `{value}` is not a finite number")]
    Number {
        /// Line of the file, from 1.
        line: usize,
        /// The value.
        value: String,
    },
    /// A name has two values.
    #[error("line {line}: `{name}` has another value in a line above")]
    Twice {
        /// Line of the file, from 1.
        line: usize,
        /// The name.
        name: String,
    },
    /// A unit is unknown.
    #[error("its unit of {of}, `{unit}`, is not known")]
    Unit {
        /// Length, force, angle or time.
        of: &'static str,
        /// The unit.
        unit: String,
    },
    /// It is a file of another model of tyres.
    #[error("it is a file of the model {0}")]
    Model(String),
}

/// Quantities of coefficients with units: exponents of length, force and time.
const DIMENSIONS: [(&str, [i32; 3]); 7] = [
    ("UNLOADED_RADIUS", [1, 0, 0]),
    ("FNOMIN", [0, 1, 0]),
    ("FZMIN", [0, 1, 0]),
    ("FZMAX", [0, 1, 0]),
    ("VERTICAL_STIFFNESS", [-1, 1, 0]),
    ("VERTICAL_DAMPING", [-1, 1, 1]),
    ("LONGVL", [1, 0, -1]),
];

/// Reads a file.
///
/// # Errors
/// If it is no tyre property file of PAC2002 or MF-Tyre 5.2.
pub fn tyre_file(text: &str) -> Result<TyreFile, TyreFileError> {
    let entries = entries(text)?;
    let word = |name: &str| entries.get(name).map(|(_, value)| value.as_str());
    check_model(word("PROPERTY_FILE_FORMAT"), word("FITTYP"))?;
    let scales = [
        unit(
            "length",
            word("LENGTH"),
            &[
                ("meter", 1.0),
                ("m", 1.0),
                ("mm", 1e-3),
                ("millimeter", 1e-3),
                ("cm", 1e-2),
                ("km", 1e3),
                ("inch", 0.0254),
                ("foot", 0.3048),
            ],
        )?,
        unit(
            "force",
            word("FORCE"),
            &[("newton", 1.0), ("n", 1.0), ("kilo_newton", 1e3), ("knewton", 1e3), ("kn", 1e3)],
        )?,
        unit("time", word("TIME"), &[("second", 1.0), ("sec", 1.0), ("s", 1.0), ("millisecond", 1e-3)])?,
    ];
    unit("angle", word("ANGLE"), &[("radians", 1.0), ("radian", 1.0), ("rad", 1.0)])?;
    let mut read = TyreFile::default();
    if word("TYRESIDE").is_some_and(|side| side.eq_ignore_ascii_case("right")) {
        read.coefficients.insert(SIDE.to_owned(), -1.0);
    }
    // Not `FITTYP`, which files of PAC2002 may also have.
    if word("PROPERTY_FILE_FORMAT").is_none_or(|format| !format.eq_ignore_ascii_case("PAC2002")) {
        read.coefficients.insert(OF_MF_TYRE.to_owned(), 1.0);
    }
    let pressures = [word("IP"), word("IP_NOM")].map(|word| word.and_then(number));
    let is_at_nominal_pressure = pressures[0].is_none() || pressures[0] == pressures[1];
    for (name, (line, value)) in &entries {
        if COEFFICIENTS.contains(&name.as_str()) {
            let value =
                number(value).ok_or_else(|| TyreFileError::Number { line: *line, value: value.clone() })?;
            let exponents = DIMENSIONS.iter().find(|(own, _)| own == name).map_or([0; 3], |(_, own)| *own);
            let factor: f64 = scales.iter().zip(exponents).map(|(scale, power)| scale.powi(power)).product();
            read.coefficients.insert(name.clone(), value * factor);
        } else if number(value).is_some_and(|value| value != 0.0)
            && is_of_a_formula(name)
            && !(is_at_nominal_pressure && name[1..].starts_with('P'))
        {
            read.unused.push(name.clone());
        }
    }
    Ok(read)
}

/// Whether a name is that of a coefficient such as `PDY1`, apart from those of gyroscopic moments and of damping at low speed.
fn is_of_a_formula(name: &str) -> bool {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    name.starts_with(['P', 'Q', 'R', 'S'])
        && (2..=3).contains(&letters.len())
        && letters.len() < name.len()
        && !["QTZ1", "PTX4", "PTY3"].contains(&name)
}

/// Lines and values by name, in capitals.
fn entries(text: &str) -> Result<BTreeMap<String, (usize, String)>, TyreFileError> {
    let mut entries = BTreeMap::new();
    let mut is_table = false;
    for (index, line) in text.lines().enumerate() {
        let line_number = index + 1;
        let content = line.split(['$', '!']).next().unwrap_or_default().trim();
        if content.is_empty() {
            continue;
        }
        if content.starts_with('[') {
            // The shape of the section is a table, in some files without a heading.
            is_table = content.to_ascii_uppercase().starts_with("[SHAPE]");
            continue;
        }
        // Tables begin with their columns in braces and end with the section.
        is_table |= content.starts_with('{');
        let Some((name, value)) = content.split_once('=') else {
            if is_table {
                continue;
            }
            let text = content.chars().filter(|c| !c.is_control()).take(40).collect();
            return Err(TyreFileError::Line { line: line_number, text });
        };
        let name = name.trim().to_ascii_uppercase();
        let value = value.trim().trim_matches(['\'', '"']).trim().to_owned();
        if let Some((_, other)) = entries.insert(name.clone(), (line_number, value.clone()))
            && other != value
            && COEFFICIENTS.contains(&name.as_str())
        {
            return Err(TyreFileError::Twice { line: line_number, name });
        }
    }
    Ok(entries)
}

/// A finite number, also with the exponents of Fortran.
fn number(text: &str) -> Option<f64> {
    let value: f64 = text.replace(['d', 'D'], "e").parse().ok()?;
    value.is_finite().then_some(value)
}

fn unit(of: &'static str, given: Option<&str>, known: &[(&str, f64)]) -> Result<f64, TyreFileError> {
    let Some(given) = given else { return Ok(1.0) };
    let found = known.iter().find(|(name, _)| name.eq_ignore_ascii_case(given));
    found.map(|(_, scale)| *scale).ok_or_else(|| TyreFileError::Unit { of, unit: given.to_owned() })
}

/// Rejects files of other models, whose coefficients have other meanings.
fn check_model(format: Option<&str>, version: Option<&str>) -> Result<(), TyreFileError> {
    let version = version.map(str::trim);
    let is_known_version = version.is_some_and(|version| ["5", "6", "21", "51", "52"].contains(&version));
    match format.map(str::to_ascii_uppercase).as_deref() {
        Some("PAC2002") => Ok(()),
        Some("MF_05" | "MF-TYRE" | "MFTYRE" | "MF_TYRE" | "USER") | None if is_known_version => Ok(()),
        Some("MF_05") if version.is_none() => Ok(()),
        format => {
            let version = version.map_or(String::new(), |version| format!(", FITTYP {version}"));
            let words = format!("{}{version}", format.unwrap_or("without PROPERTY_FILE_FORMAT"));
            Err(TyreFileError::Model(words.chars().filter(|c| !c.is_control()).take(60).collect()))
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/files/tyre_file.rs"]
mod tests;
