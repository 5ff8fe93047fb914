//! A set of files put into a directory, each whole or not at all.

use std::{
    fs, io,
    io::Write as _,
    path::{Component, Path, PathBuf},
};
use tempfile::{Builder, NamedTempFile};

/// Asks whether [`write_files`] can put files into `directory`, before the work of making them. Nothing is left behind.
///
/// # Errors
/// [`WriteError`]: there is a file of that name or above it, or no file can be made there.
pub fn check_directory(directory: &Path) -> Result<(), WriteError> {
    let existing = directory.ancestors().find(|path| path.as_os_str().is_empty() || path.exists());
    let existing = existing.filter(|path| !path.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let tried = match existing.is_dir() {
        true => tempfile::tempfile_in(existing).map(drop),
        false => Err(io::ErrorKind::NotADirectory.into()),
    };
    tried.map_err(|cause| WriteError { path: directory.to_owned(), cause })
}

/// A file could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {cause}", path.display())]
pub struct WriteError {
    /// The file or directory concerned.
    pub path: PathBuf,
    /// What the system said; part of the message, so not a source as well.
    pub cause: io::Error,
}

/// Writes `files` (name, contents) into `directory` and returns their paths. The directory is made if it is missing; an
/// existing file of the same name is replaced.
///
/// Every file is first written in full and flushed to disk under a temporary name in the same directory; only when all
/// of them are complete are they renamed. A reader therefore never sees half a file, and an error while writing leaves
/// the directory as it was: the temporary files are removed, and so are directories that were made for them. Should a
/// rename itself fail, files renamed before it stay, each whole. A process that is killed meanwhile leaves a temporary file,
/// `.fsb-` and six characters.
///
/// # Errors
/// [`WriteError`] with the path concerned: a name that is not a plain file name, a directory that cannot be made, a
/// file that cannot be written, or a name taken by a directory.
pub fn write_files<N, C>(directory: &Path, files: &[(N, C)]) -> Result<Vec<PathBuf>, WriteError>
where
    N: AsRef<str>,
    C: AsRef<[u8]>,
{
    for (name, _) in files {
        check(directory, name.as_ref())?;
    }
    // The outermost first.
    let mut made: Vec<&Path> = directory.ancestors().filter(|p| !p.as_os_str().is_empty() && !p.exists()).collect();
    made.reverse();
    let written = fs::create_dir_all(directory)
        .map_err(|cause| WriteError { path: directory.to_owned(), cause })
        .and_then(|()| put(directory, files));
    if written.is_err() {
        for path in made.iter().rev() {
            // Fails, as it should, where someone else has put a file meanwhile.
            let _ = fs::remove_dir(path);
        }
    }
    written
}

fn check(directory: &Path, name: &str) -> Result<(), WriteError> {
    let mut parts = Path::new(name).components();
    let path = directory.join(name);
    if !matches!((parts.next(), parts.next()), (Some(Component::Normal(only)), None) if only == name) {
        let cause = io::Error::new(io::ErrorKind::InvalidInput, format!("\"{name}\" is not a plain file name"));
        return Err(WriteError { path, cause });
    }
    if path.is_dir() {
        return Err(WriteError { path, cause: io::ErrorKind::IsADirectory.into() });
    }
    Ok(())
}

fn put<N: AsRef<str>, C: AsRef<[u8]>>(directory: &Path, files: &[(N, C)]) -> Result<Vec<PathBuf>, WriteError> {
    let mut complete = Vec::with_capacity(files.len());
    for (name, contents) in files {
        let path = directory.join(name.as_ref());
        match temporary(directory, contents.as_ref()) {
            Ok(file) => complete.push((file, path)),
            Err(cause) => return Err(WriteError { path, cause }),
        }
    }
    let rename = |(file, path): (NamedTempFile, PathBuf)| match file.persist(&path) {
        Ok(_) => Ok(path),
        Err(error) => Err(WriteError { path, cause: error.error }),
    };
    complete.into_iter().map(rename).collect()
}

/// A complete file under a temporary name, removed when dropped.
fn temporary(directory: &Path, contents: &[u8]) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".fsb-");
    // A temporary file is private by default; a report is an ordinary file (the umask still applies).
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(directory)?;
    file.write_all(contents)?;
    file.as_file().sync_all()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let mut all: Vec<_> =
            fs::read_dir(directory).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        all.sort();
        all
    }

    #[test]
    fn files_arrive_whole_in_a_new_directory() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("a/b");
        let paths = write_files(&out, &[("x.svg", "one"), ("y.csv", "two")]).unwrap();
        assert_eq!(paths, [out.join("x.svg"), out.join("y.csv")]);
        write_files(&out, &[("x.svg", "three".as_bytes())]).unwrap();
        assert_eq!(names(&out), ["x.svg", "y.csv"]);
        assert_eq!(fs::read_to_string(out.join("x.svg")).unwrap(), "three");
    }

    #[cfg(unix)]
    #[test]
    fn files_have_ordinary_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("plain"), "").unwrap();
        write_files(root.path(), &[("ours", "")]).unwrap();
        let mode = |name: &str| fs::metadata(root.path().join(name)).unwrap().permissions().mode();
        assert_eq!(mode("ours"), mode("plain"));
    }

    #[test]
    fn a_bad_name_leaves_nothing_behind() {
        let root = tempfile::tempdir().unwrap();
        for bad in ["../x", "", "a/b", ".", "..", "/x", "a/"] {
            let error = write_files(&root.path().join("new/out"), &[("good", "1"), (bad, "2")]).unwrap_err();
            assert!(error.to_string().contains("plain file name"), "{error}");
            assert!(names(root.path()).is_empty(), "{bad}");
        }
    }

    #[test]
    fn a_taken_name_leaves_the_directory_as_it_was() {
        let root = tempfile::tempdir().unwrap();
        fs::create_dir(root.path().join("taken")).unwrap();
        fs::write(root.path().join("a"), "old").unwrap();
        let error = write_files(root.path(), &[("a", "new"), ("taken", "x")]).unwrap_err();
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(names(root.path()), ["a", "taken"]);
        assert_eq!(fs::read_to_string(root.path().join("a")).unwrap(), "old");
    }

    #[test]
    fn an_error_while_writing_removes_temporary_files_and_new_directories() {
        let root = tempfile::tempdir().unwrap();
        // Longer than any file system's names: found out only when the temporary file is renamed.
        let long = "n".repeat(4000);
        let error = write_files(&root.path().join("new/out"), &[(long.as_str(), "x")]).unwrap_err();
        assert_eq!(error.path, root.path().join("new/out").join(&long));
        assert!(names(root.path()).is_empty());
    }

    #[test]
    fn where_files_can_be_put_is_asked_without_a_trace() {
        let root = tempfile::tempdir().unwrap();
        check_directory(root.path()).unwrap();
        check_directory(&root.path().join("new/out")).unwrap();
        check_directory(Path::new("new-out")).unwrap();
        assert!(names(root.path()).is_empty() && !Path::new("new-out").exists());
        fs::write(root.path().join("file"), "kept").unwrap();
        for blocked in ["file", "file/out"] {
            let error = check_directory(&root.path().join(blocked)).unwrap_err();
            assert_eq!((error.path, error.cause.kind()), (root.path().join(blocked), io::ErrorKind::NotADirectory));
        }
    }

    #[test]
    fn a_file_in_place_of_the_directory_is_named() {
        let root = tempfile::tempdir().unwrap();
        let blocked = root.path().join("file");
        fs::write(&blocked, "kept").unwrap();
        let error = write_files(&blocked.join("out"), &[("a", "1")]).unwrap_err();
        assert!(error.to_string().contains("file"), "{error}");
        assert_eq!(fs::read_to_string(&blocked).unwrap(), "kept");
    }
}
