//! One command of the race, and one run of it.

use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, ensure};
use wait4::Wait4;

use super::answer::Answer;
use crate::cases::map_pair::Files;

/// What keeps the usual numeric libraries to one thread.
const ONE_THREAD: [&str; 4] =
    ["RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OPENCV_FOR_THREADS_NUM"];

/// A command with places for the files of a pair.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contestant {
    pub(super) name: String,
    /// The program and its arguments, with `{a}`, `{b}`, `{a_pgm}` and `{b_pgm}` in them.
    words: Vec<String>,
}

/// One run of a command.
#[derive(Debug, Clone)]
pub(super) struct Run {
    /// `None` for an exit status other than 0 and 3, and for output that is no answer.
    pub(super) answer: Option<Answer>,
    /// What it had to say when it gave none.
    pub(super) complaint: Option<String>,
    /// User and system CPU seconds of the process and of the children it waited for, start-up
    /// included.
    pub(super) cpu_s: f64,
}

impl Contestant {
    /// `command` is split at white space, without quoting.
    pub(super) fn new(name: &str, command: &str) -> anyhow::Result<Self> {
        let words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
        ensure!(!name.trim().is_empty() && !words.is_empty(), "a command needs a name and a word");
        for (map, image) in [("{a}", "{a_pgm}"), ("{b}", "{b_pgm}")] {
            let named = words.iter().any(|word| word.contains(map) || word.contains(image));
            ensure!(named, "`{command}` does not say where {map} goes");
        }
        Ok(Self { name: name.trim().to_owned(), words })
    }

    /// Reads `NAME=COMMAND`.
    ///
    /// # Errors
    /// No name, no command, or a command that leaves out one of the maps.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let (name, command) = text.split_once('=').context("write NAME=COMMAND")?;
        Self::new(name, command)
    }

    /// Runs the command on a pair.
    ///
    /// # Errors
    /// A program that cannot be started.
    pub(super) fn run(&self, files: &Files) -> anyhow::Result<Run> {
        let words = self.words_for(files);
        let mut child = Command::new(&words[0])
            .args(&words[1..])
            .envs(ONE_THREAD.map(|variable| (variable, "1")))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .with_context(|| format!("{}: cannot start `{}`", self.name, words[0]))?;
        let (stdout, stderr) = (child.stdout.take(), child.stderr.take());
        let (output, complaint) = std::thread::scope(|scope| {
            let complaint = scope.spawn(|| text(stderr));
            (text(stdout), complaint.join().unwrap_or_default())
        });
        let used = child.wait4().with_context(|| format!("waiting for {}", self.name))?;
        let ended_well = matches!(used.status.code(), Some(0 | 3));
        let answer = Answer::parse(&output).filter(|_| ended_well);
        let complaint = answer.is_none().then(|| {
            let last = complaint.trim_end().lines().last().unwrap_or_default();
            format!("{} on {}: {} {last}", self.name, files.a.display(), used.status)
        });
        let cpu_s = (used.rusage.utime + used.rusage.stime).as_secs_f64();
        Ok(Run { answer, complaint, cpu_s })
    }

    fn words_for(&self, files: &Files) -> Vec<String> {
        let path = |path: &Path| path.display().to_string();
        let places = [
            ("{a}", path(&files.a)),
            ("{b}", path(&files.b)),
            ("{a_pgm}", path(&files.a_image)),
            ("{b_pgm}", path(&files.b_image)),
        ];
        let fill = |word: &String| {
            places.iter().fold(word.clone(), |word, (place, path)| word.replace(place, path))
        };
        self.words.iter().map(fill).collect()
    }
}

/// Everything that `pipe` gives, as far as it can be read.
fn text(pipe: Option<impl Read>) -> String {
    let mut bytes = Vec::new();
    if let Some(mut pipe) = pipe {
        // What was read before an error is judged as it is.
        let _ = pipe.read_to_end(&mut bytes);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::Contestant;
    use crate::cases::map_pair::Files;

    fn files() -> Files {
        let file = |name: &str| std::path::Path::new("some maps").join(name);
        Files {
            a: file("a.yaml"),
            b: file("b.yaml"),
            a_image: file("a.pgm"),
            b_image: file("b.pgm"),
        }
    }

    #[test]
    fn a_path_with_a_space_stays_one_argument() {
        let peer = Contestant::parse("FFT = python3 fft.py --a={a} {a_pgm} {b} {b_pgm}").unwrap();
        assert_eq!(peer.name, "FFT");
        let expected = [
            "python3",
            "fft.py",
            "--a=some maps/a.yaml",
            "some maps/a.pgm",
            "some maps/b.yaml",
            "some maps/b.pgm",
        ];
        assert_eq!(peer.words_for(&files()), expected);
    }

    #[test]
    fn a_command_that_cannot_be_meant_is_an_error() {
        for text in ["ogm align {a} {b}", "ogm=", "=ogm {a} {b}", "ogm=align {a}", "ogm=align"] {
            assert!(Contestant::parse(text).is_err(), "{text}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn only_an_answer_with_its_exit_status_counts() {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("peer.sh");
        let run = |body: &str| {
            std::fs::write(&script, body).unwrap();
            let peer = Contestant::new("peer", &format!("sh {} {{a}} {{b}}", script.display()));
            peer.unwrap().run(&files()).unwrap()
        };
        let refusal = "echo '{\"verdict\": \"no-match\", \"target_from_source\": null}'\n";
        assert!(run(refusal).answer.is_some());
        assert!(run(&format!("{refusal}exit 3")).answer.is_some());
        assert!(run(&format!("{refusal}exit 1")).answer.is_none());
        assert!(run(&format!("{refusal}kill -9 $$")).answer.is_none());
        assert!(run("echo nothing to say").answer.is_none());
        let loud = "i=0; while [ $i -lt 9999 ]; do echo 'a line of complaint' >&2; \
                    i=$((i + 1)); done\n";
        let loud = run(&format!("{loud}{refusal}"));
        assert!(loud.answer.is_some(), "a full pipe does not stop it");
        assert!(loud.cpu_s > 0.0);
    }
}
