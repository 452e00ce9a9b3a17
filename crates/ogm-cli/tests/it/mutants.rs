//! Command lines that nobody would write: each ends soon, without a panic, with a code that means
//! something.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::{draw, peak_memory};
use tempfile::{TempDir, tempdir};

/// A command that takes longer on two maps of a few cells hangs.
const PATIENCE: Duration = Duration::from_secs(5);

/// And one that takes more than this was talked into it, kibibytes.
const MOST_MEMORY: u64 = 1_000_000;

const GOOD: [&str; 13] = [
    "align a.yaml b.yaml --accept 0.9 --seed 3",
    "align a.yaml b.yaml --method carpin --prior 1,2,90 --prior-sigma 0.5,5 --json",
    "align a.yaml b.yaml --tags a.yaml=t.csv --tags b.yaml=t.csv --method rfid3 --quiet",
    "merge a.yaml b.yaml -o m.yaml --report r.json --overlay o.png --fusion first --force",
    "merge a.yaml a.yaml -o m.yaml --resolution 0.1 --allow-partial --repeats --force",
    "merge a.yaml b.yaml a.yaml -o m.yaml --transform b.yaml=1,0,90 --html r.html --force",
    "merge a.yaml b.yaml -o m.yaml --conflicts c.png --provenance o.png --bend report --force",
    "merge folder a.yaml b.yaml -o m.yaml --reference b.yaml --alignments folder --frames w,x,y",
    "straighten a.yaml -o n.yaml --force",
    "info a.yaml --json --max-memory 1G",
    "info p.png --input p.png=0.05,1,2,30",
    "apply a.yaml --transform 1,2,45 -o n.yaml --force",
    "view a.yaml b.yaml --transform 0.1,0,180 -o v.png --force",
];

/// Values and words that stand in another's place.
const ODD: [&str; 68] = [
    "",
    "-",
    "--",
    "=",
    ",",
    ",,",
    "a.yaml",
    "b.yaml",
    "p.png",
    "t.csv",
    "none.yaml",
    ".",
    "..",
    "/",
    "/dev/null",
    "/dev/zero",
    "/dev/full",
    "/dev/stdout",
    "pipe",
    "folder",
    "a.pgm",
    "nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "-0",
    "1e308",
    "1e-308",
    "18446744073709551616",
    "0x10",
    "1e9,1e9,1e9",
    "nan,0,0",
    "0,0,inf",
    "1,2",
    "1,2,3,4",
    "0,0",
    "-1,-1",
    "1e-12,1e-12",
    "1e300,1e300,1e300",
    "--json",
    "--quiet",
    "--force",
    "--help",
    "--version",
    "--method",
    "radon",
    "match",
    "auto",
    "--prior",
    "--accept",
    "--seed",
    "--fusion",
    "--resolution",
    "--transform",
    "-o",
    "--input",
    "--max-memory",
    "--reference",
    "--alignments",
    "--frames",
    "--bend",
    "--bend-picture",
    "--html",
    "--overlay",
    "report",
    "\u{1f5fa}",
    "a.yaml=t.csv",
];

/// The generator SplitMix64: the same command lines in every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((mixed ^ mixed >> 31) % end.max(1) as u64).unwrap()
    }

    fn one_of<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len())]
    }

    fn line(&mut self) -> Vec<String> {
        let mut words: Vec<String> =
            self.one_of(&GOOD).split_whitespace().map(str::to_owned).collect();
        for _ in 0..=self.below(3) {
            let at = self.below(words.len());
            match self.below(6) {
                0 => drop(words.remove(at)),
                1 => words.insert(at, self.one_of(&ODD).to_owned()),
                2 => words[at] = self.one_of(&ODD).to_owned(),
                3 => words.swap(at, 0),
                4 => {
                    let other = self.one_of(&GOOD).split_whitespace().last().unwrap();
                    words.push(other.to_owned());
                }
                _ => {
                    let mut letters: Vec<char> = words[at].chars().collect();
                    let place = self.below(letters.len() + 1);
                    letters.insert(place, ['-', ',', '=', '.', '9', 'e', '/'][self.below(7)]);
                    words[at] = letters.into_iter().collect();
                }
            }
            if words.is_empty() {
                break;
            }
        }
        words
    }
}

fn place() -> TempDir {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let room = ["##########", "#....?...#", "#..####..#", "#..#??#...", "##########"].join("\n");
    draw(path, "a", &room);
    draw(path, "b", &room.replace('?', "."));
    let tags = "tag_id,robot_x_m,robot_y_m,range_m\n1,0,0,1\n1,1,0,1\n2,0,1,2\n";
    fs::write(path.join("t.csv"), tags).unwrap();
    fs::copy(path.join("a.pgm"), path.join("p.png")).unwrap();
    fs::create_dir(path.join("folder")).unwrap();
    let _ = Command::new("mkfifo").arg(path.join("pipe")).status();
    folder
}

/// Runs `words` in `folder` and says what is wrong with how that ended.
fn complaint(folder: &Path, words: &[String]) -> Option<String> {
    let [out, err] = ["out", "err"].map(|name| fs::File::create(folder.join(name)).unwrap());
    let mut child = Command::new(env!("CARGO_BIN_EXE_ogm"))
        .args(words)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(out)
        .stderr(err)
        .spawn()
        .unwrap();
    let start = Instant::now();
    let status = loop {
        let memory = peak_memory(child.id());
        let excess = match child.try_wait().unwrap() {
            Some(status) => break status,
            None if memory.is_some_and(|memory| memory > MOST_MEMORY) => {
                format!("takes {} KiB", memory.unwrap_or_default())
            }
            None if start.elapsed() > PATIENCE => "hangs".to_owned(),
            None => {
                sleep(Duration::from_millis(2));
                continue;
            }
        };
        child.kill().unwrap();
        child.wait().unwrap();
        return Some(excess);
    };
    let said = String::from_utf8_lossy(&fs::read(folder.join("err")).unwrap()).into_owned();
    let is_meant = matches!(status.code(), Some(0..=3)) && !said.contains("panicked");
    (!is_meant).then(|| format!("{status}: {said}"))
}

fn run(lines: usize, seed: u64) {
    let mut dice = Dice(seed);
    let folder = place();
    for _ in 0..lines {
        let words = dice.line();
        if let Some(complaint) = complaint(folder.path(), &words) {
            panic!("ogm {words:?}: {complaint}");
        }
        for input in ["a.yaml", "a.pgm", "b.yaml", "b.pgm", "t.csv", "p.png"] {
            assert!(folder.path().join(input).is_file(), "ogm {words:?} took {input} away");
        }
    }
}

#[test]
fn mutated_command_lines_end_with_a_code() {
    run(120, 7);
}

#[test]
#[ignore = "minutes"]
fn three_thousand_mutated_command_lines_end_with_a_code() {
    run(3000, 1);
}
