use super::*;
use std::io::{ErrorKind, Write};
use std::path::Path;

fn write(path: &Path, existing: Existing, text: &str) -> std::io::Result<()> {
    publish(path, existing, |file| file.write_all(text.as_bytes()))
}

fn names(folder: &Path) -> Vec<String> {
    std::fs::read_dir(folder).expect("a folder").flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect()
}

#[test]
fn a_file_is_kept_or_replaced_and_a_failure_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    write(&path, Existing::Kept, "first").expect("written");
    assert_eq!(write(&path, Existing::Kept, "second").expect_err("kept").kind(), ErrorKind::AlreadyExists);
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), "first");
    write(&path, Existing::Replaced, "third").expect("replaced");
    let failing = publish(&path, Existing::Replaced, |file| {
        file.write_all(b"half")?;
        Err(ErrorKind::StorageFull.into())
    });
    assert_eq!(failing.expect_err("failed").kind(), ErrorKind::StorageFull);
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), "third");
    assert_eq!(names(folder.path()), ["a"]);
    let error = write(&folder.path().join("absent/a"), Existing::Kept, "").expect_err("no folder");
    assert!(error.kind() == ErrorKind::NotFound && !error.to_string().contains("part"), "{error}");
}

#[test]
fn files_are_read_up_to_their_limit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    std::fs::write(&path, "12345").expect("written");
    assert_eq!(read_text(&path, 5).expect("read"), "12345");
    let message = read_regular(&path, 4).expect_err("too long").to_string();
    assert!(message.contains("5 bytes") && message.contains('4'), "{message}");
    std::fs::write(&path, b"\xff").expect("written");
    assert_eq!(read_text(&path, 5).expect_err("no text").kind(), ErrorKind::InvalidData);
    assert!(read_regular(folder.path(), 5).expect_err("a folder").to_string().contains("a folder"));
}

#[cfg(unix)]
mod unix {
    use super::*;

    #[test]
    fn what_a_killed_run_left_is_removed_and_what_is_being_written_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join(".atrous-killed.part"), "half").expect("written");
        std::fs::write(folder.path().join("kept.part"), "whole").expect("written");
        symlink("kept.part", folder.path().join(".atrous-link.part")).expect("a link");
        publish(&folder.path().join("a"), Existing::Kept, |_| {
            remove_abandoned(folder.path());
            assert_eq!(names(folder.path()).iter().filter(|name| name.starts_with(".atrous-")).count(), 2);
            Ok(())
        })
        .expect("written");
        let mut left = names(folder.path());
        left.sort();
        assert_eq!(left, [".atrous-link.part", "a", "kept.part"]);
    }

    use std::os::unix::fs::{symlink, PermissionsExt};

    #[test]
    fn pipes_and_devices_are_refused_before_they_are_opened() {
        let folder = tempfile::tempdir().expect("a folder");
        let pipe = folder.path().join("pipe");
        rustix::fs::mkfifoat(rustix::fs::CWD, &pipe, rustix::fs::Mode::RUSR).expect("a pipe");
        let link = folder.path().join("link");
        symlink(&pipe, &link).expect("a link");
        for (path, word) in [(pipe.as_path(), "pipe"), (link.as_path(), "pipe"), (Path::new("/dev/zero"), "device")] {
            let error = open_regular(path).expect_err("refused");
            assert!(error.kind() == ErrorKind::InvalidInput && error.to_string().contains(word), "{error}");
            assert!(read_regular(path, 10).is_err());
        }
    }

    #[test]
    fn a_link_in_the_place_of_a_file_is_replaced_and_not_followed() {
        let folder = tempfile::tempdir().expect("a folder");
        let (target, path) = (folder.path().join("target"), folder.path().join("a"));
        std::fs::write(&target, "kept").expect("written");
        symlink(&target, &path).expect("a link");
        write(&path, Existing::Replaced, "new").expect("written");
        assert_eq!(std::fs::read_to_string(&target).expect("a file"), "kept");
        assert_eq!(std::fs::read_to_string(&path).expect("a file"), "new");
    }

    #[test]
    fn a_published_file_has_the_rights_of_any_other() {
        let folder = tempfile::tempdir().expect("a folder");
        let [published, created] = ["published", "created"].map(|name| folder.path().join(name));
        write(&published, Existing::Kept, "").expect("written");
        std::fs::write(&created, "").expect("written");
        let mode = |path: &Path| path.metadata().expect("a file").permissions().mode();
        assert_eq!(mode(&published), mode(&created));
    }
}
