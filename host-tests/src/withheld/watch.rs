//! Somebody who looks where nothing is to be looked at.

use std::path::PathBuf;

use rustix::fs::inotify::{self, CreateFlags, WatchFlags};
use rustix::io::Errno;

/// Folders that nobody may open while it stands.
#[derive(Debug)]
pub struct Watch {
    events: rustix::fd::OwnedFd,
    watched: Vec<(i32, PathBuf)>,
}

impl Watch {
    /// Over these folders and what lies in them, one level deep.
    ///
    /// # Errors
    /// Where the system has no room for it.
    pub fn over(folders: &[PathBuf]) -> std::io::Result<Self> {
        let events = inotify::init(CreateFlags::CLOEXEC | CreateFlags::NONBLOCK)?;
        let mut watched = Vec::with_capacity(folders.len());
        for folder in folders {
            let number = inotify::add_watch(&events, folder, WatchFlags::OPEN | WatchFlags::MODIFY)?;
            watched.push((number, folder.clone()));
        }
        Ok(Self { events, watched })
    }

    /// The first place that was opened since.
    ///
    /// # Errors
    /// Where the system does not say.
    pub fn opened(&self) -> std::io::Result<Option<PathBuf>> {
        let mut room = [std::mem::MaybeUninit::uninit(); 4096];
        let mut reader = inotify::Reader::new(&self.events, &mut room);
        match reader.next() {
            Ok(event) => Ok(Some(self.place(event.wd(), event.file_name().and_then(|name| name.to_str().ok())))),
            Err(Errno::AGAIN) => Ok(None),
            Err(why) => Err(why.into()),
        }
    }

    fn place(&self, number: i32, file: Option<&str>) -> PathBuf {
        let folder = self.watched.iter().find(|(of, _)| *of == number);
        folder.map_or_else(PathBuf::new, |(_, folder)| file.map_or(folder.clone(), |file| folder.join(file)))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn names(path: &Path) -> usize {
        std::fs::read_dir(path).expect("a folder").count()
    }

    #[test]
    fn who_opens_a_file_or_lists_a_folder_is_seen_and_who_does_not_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let (secret, open) = (folder.path().join("secret"), folder.path().join("open"));
        for place in [&secret, &open] {
            std::fs::create_dir(place).expect("room");
            std::fs::write(place.join("label.json"), "{}").expect("room");
        }
        let watch = || Watch::over(std::slice::from_ref(&secret)).expect("a watch");
        let quiet = watch();
        assert_eq!(names(&open), 1);
        assert_eq!(quiet.opened().expect("an answer"), None);
        let read = watch();
        std::fs::read(secret.join("label.json")).expect("a file");
        assert_eq!(read.opened().expect("an answer"), Some(secret.join("label.json")));
        let listed = watch();
        assert_eq!(names(&secret), 1);
        assert_eq!(listed.opened().expect("an answer"), Some(secret.clone()));
    }
}
