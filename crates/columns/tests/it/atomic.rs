//! Files that are whole or not there, and names that are no files.

use std::fs;
use std::io::Write as _;
use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _, symlink};
use std::path::Path;
use std::process::Command;

use columns::{AtomicFile, write_whole};

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_pipe_is_written_into() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // A link to a pipe is that pipe.
    let link = folder.path().join("link");
    symlink("pipe", &link).unwrap();
    for path in [&pipe, &link] {
        AtomicFile::check(path).unwrap();
        let (heard, said) = std::sync::mpsc::channel();
        let reader = pipe.clone();
        // Not joined: a pipe that nobody writes into would be read for ever.
        std::thread::spawn(move || heard.send(fs::read(reader).unwrap()));
        write_whole(path, b"1,2\n").unwrap();
        assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo(), "the pipe was replaced");
        let text = said.recv_timeout(std::time::Duration::from_secs(10)).unwrap();
        assert_eq!(text, b"1,2\n");
        assert_eq!(names(folder.path()), ["link", "pipe"]);
    }
}

#[test]
fn a_link_stays_and_what_it_leads_to_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let [near, far] = ["near", "far"].map(|name| folder.path().join(name));
    fs::create_dir(&near).unwrap();
    fs::create_dir(&far).unwrap();
    symlink("../far/link", near.join("link")).unwrap();
    symlink("file", far.join("link")).unwrap();
    let link = near.join("link");
    // First there is nothing at the end of the links, then an old file.
    for text in ["first", "second"] {
        let mut file = AtomicFile::create(&link).unwrap();
        file.write_all(text.as_bytes()).unwrap();
        assert_eq!(names(&near), ["link"], "the part stands beside the file");
        assert!(names(&far).iter().any(|name| name.starts_with(".file.")));
        file.commit().unwrap();
        assert_eq!(fs::read_to_string(far.join("file")).unwrap(), text);
        assert_eq!(names(&far), ["file", "link"]);
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert!(fs::symlink_metadata(far.join("link")).unwrap().is_symlink());
    }
    symlink("ring", near.join("ring")).unwrap();
    assert!(AtomicFile::create(&near.join("ring")).is_err());
}

#[test]
fn a_private_file_stays_private() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    fs::write(&path, "old").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
    write_whole(&path, b"new").unwrap();
    assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
    assert_eq!(fs::read(&path).unwrap(), b"new");
}

#[test]
fn a_check_leaves_everything_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    AtomicFile::check(&path).unwrap();
    assert!(names(folder.path()).is_empty());
    fs::write(&path, "old").unwrap();
    AtomicFile::check(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["file"]);
    assert!(AtomicFile::check(folder.path()).is_err(), "a folder");
    assert!(AtomicFile::check(&folder.path().join("none").join("file")).is_err());
}

/// Somebody else may make links in the folder, but cannot know the name of the temporary file.
#[test]
fn nothing_is_written_through_a_link_with_a_temporary_name() {
    let folder = tempfile::tempdir().unwrap();
    let victim = folder.path().join("victim");
    fs::write(&victim, "precious").unwrap();
    let process = std::process::id();
    symlink("victim", folder.path().join(format!(".file.{process}.part"))).unwrap();
    let path = folder.path().join("file");
    write_whole(&path, b"new").unwrap();
    assert_eq!(fs::read(&victim).unwrap(), b"precious");
    assert_eq!(fs::read(&path).unwrap(), b"new");
    // What is written is readable to whom the user allows it, and no link.
    let about = fs::symlink_metadata(&path).unwrap();
    let usual = fs::metadata(&victim).unwrap().permissions().mode();
    assert!(about.is_file() && about.permissions().mode() == usual);
}
