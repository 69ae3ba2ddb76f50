use super::*;

const UNITS: &str =
    "[UNITS]\nLENGTH = 'mm'\nFORCE = 'newton'\nANGLE = 'radians'\nMASS = 'kg'\nTIME = 'second'\n";

fn read(text: &str) -> Result<TyreFile, TyreFileError> {
    tyre_file(&format!("$---- a tyre\n[MODEL]\nPROPERTY_FILE_FORMAT = 'PAC2002'\n{text}"))
}

#[test]
fn numbers_have_the_units_of_their_file() {
    let text = format!(
        "{UNITS}[DIMENSION]\nUNLOADED_RADIUS = 344  $ free radius\nunknown = 'text'\n[SHAPE]\n{{radial width}}\n 1.0 0.0\n[VERTICAL]\n\
         VERTICAL_STIFFNESS=2.8D2\nVERTICAL_DAMPING = 2\nFNOMIN = 4850\n[MODEL]\nLONGVL = 16600\nTYRESIDE = 'RIGHT'\n! PCX1 = 3\nPCX1 = 1.6\n"
    );
    let read = read(&text).expect("a tyre property file");
    let expected = [
        ("UNLOADED_RADIUS", 0.344),
        ("VERTICAL_STIFFNESS", 2.8e5),
        ("VERTICAL_DAMPING", 2e3),
        ("FNOMIN", 4850.0),
        ("LONGVL", 16.6),
        ("PCX1", 1.6),
        (SIDE, -1.0),
    ];
    assert_eq!(read.coefficients.len(), expected.len());
    for (name, value) in expected {
        assert!((read.coefficients[name] - value).abs() <= 1e-12 * value.abs(), "{name}");
    }
}

#[test]
fn coefficients_that_are_not_used_are_named() {
    let names = |text: &str| read(text).expect("a tyre property file").unused;
    assert_eq!(names("QSX4 = 0.1\nQTZ1 = 0.2\nPPX1 = 0.3\nPDY9 = 0\nSSZ1 = 1\n"), ["QSX4"]);
    // Pressures differ.
    assert_eq!(names("IP = 2\nIP_NOM = 3\nPPX1 = 0.3\n"), ["PPX1"]);
}

#[test]
fn other_files_are_errors() {
    let error = |text: &str| read(text).expect_err("an error").to_string();
    assert_eq!(error("PCX1 = many\n"), "line 4: `many` is not a finite number");
    assert_eq!(error("PCX1\n"), "line 4: `PCX1` is neither a section nor `NAME = value`");
    assert_eq!(error("PCX1 = 1\nPCX1 = 2\n"), "line 5: `PCX1` has another value in a line above");
    assert_eq!(error("ANGLE = 'degree'\n"), "its unit of angle, `degree`, is not known");
    let model = |text: &str| tyre_file(text).expect_err("an error").to_string();
    assert_eq!(
        model("FITTYP = 61\nPROPERTY_FILE_FORMAT = 'USER'"),
        "it is a file of the model USER, FITTYP 61"
    );
    assert_eq!(model("PCX1 = 1"), "it is a file of the model without PROPERTY_FILE_FORMAT");
    assert!(tyre_file("FITTYP = 52\nPROPERTY_FILE_FORMAT = 'MF_05'").is_ok());
}
