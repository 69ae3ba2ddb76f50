//! Co-simulation units: what is packed. What they do is tested with FMPy, in the Python package.

use std::io::Read;

use flate2::read::DeflateDecoder;

use super::support::{Folder, example, lissom};

/// The content of a file of an archive.
fn content(archive: &[u8], name: &str) -> Vec<u8> {
    let header: &[u8] = b"PK\x01\x02";
    let starts = (0..archive.len() - 4).filter(|&at| &archive[at..at + 4] == header);
    let number = |at: usize| u32::from_le_bytes(archive[at..at + 4].try_into().unwrap()) as usize;
    for entry in starts {
        if archive[entry + 46..].starts_with(name.as_bytes()) {
            let (packed, whole, local) = (number(entry + 20), number(entry + 24), number(entry + 42));
            let start =
                local + 30 + usize::from(u16::from_le_bytes([archive[local + 26], archive[local + 27]]));
            let mut text = Vec::new();
            DeflateDecoder::new(&archive[start..start + packed]).read_to_end(&mut text).unwrap();
            assert_eq!(text.len(), whole);
            return text;
        }
    }
    panic!("the archive has no {name}");
}

#[test]
fn a_unit_holds_model_files_and_library() {
    let folder = Folder::new("fmu");
    folder.write("library", "not a library");
    let model = example("turbine-rotor");
    let set = ["--set", "parameters.speed=3"];
    let arguments = ["fmu", &model, "--library", "library", "--out", "rotor.fmu", set[0], set[1]];
    let run = lissom(&arguments, folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    assert!(run.output.starts_with("rotor.fmu for "), "{}", run.output);
    let archive = std::fs::read(folder.path().join("rotor.fmu")).unwrap();
    let description = String::from_utf8(content(&archive, "modelDescription.xml")).unwrap();
    for words in [
        "fmiVersion=\"3.0\" modelName=\"turbine-rotor\"",
        "<Float64 name=\"parameters.speed\" valueReference=\"1\" causality=\"parameter\" variability=\"fixed\" initial=\"exact\" start=\"3.0\"/>",
        "<Float64 name=\"shaft.angle\"",
        "<DefaultExperiment startTime=\"0.0\" stopTime=\"3.0\" stepSize=\"0.005\"/>",
    ] {
        assert!(description.contains(words), "{words}\n{description}");
    }
    let packed = String::from_utf8(content(&archive, "resources/model.json")).unwrap();
    assert!(packed.contains("Blade of a small turbine"), "the included file is there");
    assert_eq!(content(&archive, "binaries/"), b"not a library");
}

#[test]
fn what_cannot_be_a_unit_is_refused() {
    let folder = Folder::new("fmu-bad");
    folder.write("library", "not a library");
    let model = example("pendulum");
    let run = lissom(&["fmu", &model, "--library", "nothing"], folder.path());
    assert_eq!(run.code, 2);
    assert!(run.errors.contains("nothing"), "{}", run.errors);
    let path = "analysis={ kind = \"modes\" }";
    let run = lissom(&["fmu", &model, "--library", "library", "--set", path], folder.path());
    assert_eq!(run.code, 2);
    assert!(run.errors.contains("no time steps"), "{}", run.errors);
    let run = lissom(&["fmu", &model, "--library", "library", "--out", "no/where.fmu"], folder.path());
    assert_eq!(run.code, 3, "{}", run.errors);
}

#[cfg(target_os = "linux")]
#[test]
fn an_installed_program_finds_the_library_beside_it_and_in_lib() {
    let folder = Folder::new("fmu-installed");
    let program = folder.path().join("bin/lissom");
    std::fs::create_dir_all(folder.path().join("bin")).unwrap();
    std::fs::copy(env!("CARGO_BIN_EXE_lissom"), &program).unwrap();
    let export = || {
        let mut command = std::process::Command::new(&program);
        let run = command.args(["fmu", &example("pendulum"), "-o", "unit.fmu"]).current_dir(folder.path());
        let run = run.output().unwrap();
        (run.status.code(), String::from_utf8_lossy(&run.stderr).into_owned())
    };
    let (code, errors) = export();
    assert_eq!(code, Some(2));
    assert!(
        errors.contains("cargo build --release --manifest-path crates/lissom-fmi/Cargo.toml"),
        "{errors}"
    );
    for at in ["bin", "lib", "lib/lissom"] {
        let at = folder.path().join(at);
        std::fs::create_dir_all(&at).unwrap();
        let library = at.join("liblissom_fmi.so");
        std::fs::write(&library, "the library").unwrap();
        assert_eq!(export(), (Some(0), String::new()), "{}", at.display());
        let unit = std::fs::read(folder.path().join("unit.fmu")).unwrap();
        assert_eq!(content(&unit, "binaries/"), b"the library");
        std::fs::remove_file(library).unwrap();
    }
}
