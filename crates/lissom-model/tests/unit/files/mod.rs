//! Tests of `files`, a module of it.

use super::*;

/// A separate folder for each test, removed afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lissom-{name}-{}", std::process::id()));
        create_folder(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_similar_file_is_named() {
    let folder = Folder::new("similar");
    write(&folder.0.join("pendulum.toml"), b"lissom = 1\n").unwrap();
    let error = read_text(&folder.0.join("pendulun.toml")).unwrap_err();
    assert!(error.to_string().contains("there is no such file"), "{error}");
    assert_eq!(error.help.as_deref(), Some("did you mean `pendulum.toml`?"));
    assert_eq!(read_text(&folder.0.join("pendulum.toml")).unwrap(), "lissom = 1\n");
    let error = read_text(&folder.0.join("none/a.toml")).unwrap_err();
    assert!(error.help.unwrap().contains("does not exist either"));
}

#[test]
fn inputs_are_not_overwritten_through_any_path() {
    let folder = Folder::new("inputs");
    let (input, elsewhere) = (folder.0.join("a.toml"), folder.0.join("sub"));
    create_folder(&elsewhere).unwrap();
    write(&input, b"lissom = 1\n").unwrap();
    // Not read yet.
    write(&input, b"lissom = 1\n").unwrap();
    read_input(&input).unwrap();
    let mut names = vec![input.clone(), elsewhere.join("../a.toml"), folder.0.join("./a.toml")];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&input, folder.0.join("link.svg")).unwrap();
        fs::hard_link(&input, folder.0.join("hard.csv")).unwrap();
        names.extend([folder.0.join("link.svg"), folder.0.join("hard.csv")]);
    }
    for name in names {
        for error in [
            write(&name, b"").unwrap_err(),
            write_durably(&name, b"").unwrap_err(),
            create(&name).unwrap_err(),
            create_file(&name).unwrap_err(),
            remove(&name).unwrap_err(),
        ] {
            assert!(error.to_string().contains("which would be lost"), "{error}");
        }
    }
    assert_eq!(read_text(&input).unwrap(), "lissom = 1\n");
}

#[cfg(unix)]
#[test]
fn only_regular_files_are_opened() {
    for device in ["/dev/zero", "/dev/null", "/dev/random"] {
        let path = Path::new(device);
        assert!(read(path).is_err() && read_input(path).is_err() && read_text(path).is_err());
        assert!(write(path, b"").is_err() && create(path).is_err() && remove(path).is_err());
    }
    let folder = Folder::new("pipes");
    let pipe = folder.0.join("history.csv");
    std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    let message = read_text(&pipe).unwrap_err().to_string();
    assert!(message.contains("not a regular file"), "{message}");
    assert!(write(&pipe, b"").is_err() && create(&pipe).is_err() && remove(&pipe).is_err());
}

#[test]
fn names_that_no_file_can_have_are_not_there() {
    let folder = Folder::new("long");
    let long = folder.0.join("a".repeat(300));
    remove(&long).unwrap();
    assert!(write(&long, b"").unwrap_err().help.unwrap().contains("shorter"));
    // Nothing unfinished is left.
    assert_eq!(fs::read_dir(&folder.0).unwrap().count(), 0);
}

#[test]
fn what_is_no_text_is_refused() {
    let folder = Folder::new("binary");
    let path = folder.0.join("a.toml");
    write(&path, &[0xff, 0xfe, 0x00]).unwrap();
    assert!(read_text(&path).unwrap_err().to_string().contains("it is not a text file"));
    assert!(read_text(&folder.0).is_err());
    assert!(write(&folder.0.join("none/b.csv"), b"").unwrap_err().help.unwrap().contains("folder"));
    assert!(create_file(&folder.0.join("none/b.csv")).is_err());
}
