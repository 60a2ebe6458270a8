//! A file of the jobs that are owed: accepted, and their answers not read yet. A store in memory that is opened with it runs them
//! again under their old names. Every line is handed to the system at once, and so outlives the process, whatever ends it. It does
//! not outlive a loss of power.

use super::job::JobId;
use super::store::Submission;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs::{self, File, TryLockError};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Bytes after which the file is written anew, without what is over; more where more is owed.
const LONG: usize = 1 << 24;

/// A line of the file.
#[derive(Debug, Serialize, Deserialize)]
enum Line<'a> {
    Accepted {
        id: JobId,
        client: Cow<'a, str>,
        name: Option<Cow<'a, str>>,
        key: Option<Cow<'a, str>>,
        memory: usize,
        request: Cow<'a, str>,
    },
    Over(JobId),
}

/// The file, open for writing.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    /// Held as long as this process has the journal open.
    _lock: File,
    /// Lines of the jobs that are owed.
    owed: BTreeMap<JobId, String>,
    /// Bytes written, and how many of them are owed.
    written: usize,
    of_owed: usize,
}

impl Journal {
    /// Opens a journal, with the jobs that it owes. A last line that was not written to its end was not promised.
    pub(super) fn open(path: &Path) -> io::Result<(Self, Vec<(JobId, Submission)>)> {
        let lock = lock(path)?;
        let text = if path.exists() { fs::read_to_string(path)? } else { String::new() };
        let mut owed = BTreeMap::new();
        for (number, line) in text.split_inclusive('\n').enumerate() {
            match serde_json::from_str(line) {
                Ok(Line::Accepted { id, .. }) => _ = owed.insert(id, line.to_owned()),
                Ok(Line::Over(id)) => _ = owed.remove(&id),
                Err(_) if !line.ends_with('\n') => {}
                Err(error) => return Err(io::Error::other(format!("line {}: {error}", number + 1))),
            }
        }
        let submissions = owed.values().filter_map(|line| submission(line)).collect();
        let (file, written) = write(path, &owed)?;
        Ok((Journal { path: path.to_owned(), file, _lock: lock, owed, written, of_owed: written }, submissions))
    }

    /// A job is owed from here on.
    pub(super) fn accepted(&mut self, id: JobId, submission: &Submission) -> io::Result<()> {
        let request = String::from_utf8_lossy(&submission.request);
        let (name, key) = (submission.name.as_deref().map(Cow::from), submission.key.as_deref().map(Cow::from));
        let line = line(&Line::Accepted {
            id,
            client: Cow::from(&*submission.client),
            name,
            key,
            memory: submission.memory,
            request,
        })?;
        self.append(&line)?;
        self.of_owed += line.len();
        self.owed.insert(id, line);
        Ok(())
    }

    /// A job is owed no more.
    pub(super) fn over(&mut self, id: JobId) -> io::Result<()> {
        let Some(owed) = self.owed.remove(&id) else { return Ok(()) };
        self.of_owed -= owed.len();
        let line = line(&Line::Over(id))?;
        self.append(&line)?;
        if self.written > LONG.max(2 * self.of_owed) {
            (self.file, self.written) = write(&self.path, &self.owed)?;
        }
        Ok(())
    }

    fn append(&mut self, line: &str) -> io::Result<()> {
        if let Err(error) = self.file.write_all(line.as_bytes()) {
            self.cut_back()?;
            return Err(error);
        }
        self.written += line.len();
        Ok(())
    }

    /// Takes back what was written of a line whose end found no room: the next one would be taken for that.
    fn cut_back(&mut self) -> io::Result<()> {
        self.file.set_len(self.written as u64)?;
        self.file.seek(SeekFrom::End(0)).map(drop)
    }
}

fn line(line: &Line) -> io::Result<String> {
    Ok(serde_json::to_string(line)? + "\n")
}

fn submission(line: &str) -> Option<(JobId, Submission)> {
    let Ok(Line::Accepted { id, client, name, key, memory, request }) = serde_json::from_str(line) else { return None };
    let (name, key) = (name.map(Cow::into_owned), key.map(Cow::into_owned));
    Some((id, Submission { request: request.into_owned().into(), name, client: client.into(), memory, key }))
}

/// Keeps other processes from the journal: each would write over what the other owes. Where files cannot be locked nothing does.
fn lock(path: &Path) -> io::Result<File> {
    let lock = File::create(path.with_extension("lock"))?;
    match lock.try_lock() {
        Err(TryLockError::WouldBlock) => Err(io::Error::other("another process has it open: give each its own")),
        Ok(()) | Err(TryLockError::Error(_)) => Ok(lock),
    }
}

/// Writes the file anew beside the old one, and puts it in its place.
fn write(path: &Path, owed: &BTreeMap<JobId, String>) -> io::Result<(File, usize)> {
    let beside = path.with_extension("new");
    let mut file = File::create(&beside)?;
    let text = owed.values().map(String::as_str).collect::<String>();
    file.write_all(text.as_bytes())?;
    fs::rename(&beside, path)?;
    Ok((file, text.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_owed_comes_back_and_nothing_else() {
        let folder = std::env::temp_dir().join(format!("voussoir-journal-{}", JobId::now_v7()));
        fs::create_dir(&folder).unwrap();
        let path = folder.join("journal");
        let submission = |request: &str| Submission {
            request: request.to_owned().into(),
            name: Some("a \"name\"\n".to_owned()),
            client: "me".into(),
            memory: 1,
            key: None,
        };
        let ids: Vec<_> = (1..=3).map(JobId::from_u128).collect();
        let (mut journal, none) = Journal::open(&path).unwrap();
        assert!(none.is_empty());
        for id in &ids {
            journal.accepted(*id, &submission(&format!("{{\"of\": \"{id}\"}}\n"))).unwrap();
        }
        journal.over(ids[1]).unwrap();
        drop(journal);
        // The process ended in the middle of a line.
        let mut text = fs::read_to_string(&path).unwrap();
        text.push_str("{\"Accepted\":{\"id\":");
        fs::write(&path, text).unwrap();
        let (mut journal, owed) = Journal::open(&path).unwrap();
        assert_eq!(owed.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [ids[0], ids[2]]);
        assert_eq!(owed[1].1.request, submission(&format!("{{\"of\": \"{}\"}}\n", ids[2])).request);
        assert_eq!(owed[1].1.name, submission("").name);
        assert!(Journal::open(&path).unwrap_err().to_string().contains("another process"));
        // A line that found no room on the disk, and one that did.
        journal.file.write_all(b"{\"Accepted\":{\"id\":").unwrap();
        journal.cut_back().unwrap();
        journal.over(ids[0]).unwrap();
        journal.over(ids[2]).unwrap();
        drop(journal);
        assert!(Journal::open(&path).unwrap().1.is_empty());
        fs::write(&path, "nonsense\n").unwrap();
        assert!(Journal::open(&path).unwrap_err().to_string().contains("line 1"));
        fs::remove_dir_all(&folder).unwrap();
    }
}
