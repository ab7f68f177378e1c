//! Full disks, folders that cannot be written, few file handles, little memory, wrong clocks, two runs at once, odd
//! paths.

use super::Tally;
use super::checkout::{Checkout, CommandOutput, copy, make_executable, remove};
use super::random::Random;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, SystemTime};

/// A choice with runs and maps.
const FIGURES: [&str; 4] = ["2", "4", "7", "8"];

/// Files may not grow beyond so many blocks of 512 bytes: a write ends half-way, as on a full disk.
pub fn file_sizes(checkout: &Checkout, random: &mut Random, tally: &mut Tally) {
    let (mut failed, mut count) = (0, 0);
    for exponent in 0..12 {
        checkout.forget(true);
        let blocks = (1 << exponent) + random.below(1 << exponent);
        let ended = limited(checkout, &format!("ulimit -f {blocks}"), &FIGURES);
        checkout.must_not_lie(&ended, &FIGURES, &format!("files of at most {blocks} blocks"));
        checkout.fresh_must_be_right("small files");
        failed += usize::from(ended.code != Some(0));
        checkout.must_recover(&FIGURES, &format!("files of at most {blocks} blocks"));
        count += 1;
    }
    assert!(failed > 3, "{failed} of {count} runs met the limit");
    tally.add("limits of file sizes", count, &format!("{failed} runs failed"));
}

/// A small file system that is filled up to some room.
pub fn full_disk(checkout: &Checkout, place: &Path, random: &mut Random, tally: &mut Tally) {
    let Some(mount) = Mount::tmpfs(place, "200m") else {
        return tally.skip("full disks", "no tmpfs can be mounted (needs root)");
    };
    let root = place.join("checkout");
    fs::create_dir_all(&root).expect("a folder");
    for name in ["Cargo.toml", "Cargo.lock", "rust-toolchain.toml", ".cargo", "crates", "figures", "data", "cargo"] {
        copy(&checkout.root.join(name), &root.join(name));
    }
    fs::create_dir_all(root.join("target")).expect("a folder");
    std::os::unix::fs::symlink(checkout.target.join("release"), root.join("target/release")).expect("a link");
    let small = checkout.at(&root);
    let (mut failed, mut count) = (0, 0);
    for kilobytes in [0_u64, 1, 4, 16, 64, 100, 200, 300, 400, 600, 800, 1200, 1600, 2400, 4800] {
        small.forget(true);
        let room = kilobytes + random.below(1 + kilobytes as usize / 4) as u64;
        fill(&place.join("filler"), place, room);
        let ended = small.run(&FIGURES);
        small.must_not_lie(&ended, &FIGURES, &format!("a disk with room for {room} kB"));
        small.fresh_must_be_right("a full disk");
        failed += usize::from(ended.code != Some(0));
        assert!(matches!(ended.code, Some(0 | 4)), "a disk with room for {room} kB: {:?} {}", ended.code, ended.words);
        remove(&place.join("filler"));
        small.must_recover(&FIGURES, &format!("a disk with room for {room} kB"));
        count += 1;
    }
    assert!(failed > 3 && failed < count, "{failed} of {count} runs met a full disk");
    drop(mount);
    tally.add("full disks", count, &format!("{failed} runs failed, all with code 4"));
}

/// Leaves so many kilobytes free.
fn fill(filler: &Path, place: &Path, room: u64) {
    let output = Command::new("df").args(["-k", "--output=avail"]).arg(place).output().expect("df");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let free: u64 = text.lines().last().and_then(|line| line.trim().parse().ok()).expect("kilobytes");
    let bytes = vec![0_u8; 1024 * free.saturating_sub(room) as usize];
    fs::write(filler, bytes).expect("a filler");
}

/// Folders that cannot be written, for root neither.
pub fn read_only(checkout: &Checkout, tally: &mut Tally) {
    let mut count = 0;
    for name in ["data", "figures", "figures/fig07-exponential-std", "target", "target/store", "target/xtask", "."] {
        let folder = checkout.root.join(name);
        for fresh in [true, false] {
            if !fresh {
                checkout.forget(true);
                fs::create_dir_all(&folder).expect("a folder");
            }
            let Some(mount) = Mount::read_only(&folder) else {
                return tally.skip("read-only folders", "no folder can be mounted read-only (needs root)");
            };
            let ended = checkout.run(&FIGURES);
            checkout.must_not_lie(&ended, &FIGURES, &format!("{name} cannot be written"));
            assert!(matches!(ended.code, Some(0 | 4)), "{name} cannot be written: {:?} {}", ended.code, ended.words);
            assert!(fresh || ended.code == Some(4), "{name} cannot be written, and yet all is well: {}", ended.words);
            drop(mount);
            checkout.must_recover(&FIGURES, &format!("{name} could not be written"));
            count += 1;
        }
    }
    tally.add("read-only folders", count, "");
}

/// 32 open files; 512 MB of address space.
pub fn resources(checkout: &Checkout, tally: &mut Tally) {
    for limit in ["ulimit -n 32", "ulimit -v 524288"] {
        checkout.forget(true);
        let ended = limited(checkout, limit, &[]);
        assert_eq!(ended.code, Some(0), "{limit}: {}", ended.words);
        checkout.must_be_right(&[], limit);
    }
    tally.add("all figures within 32 open files, and within 512 MB of address space", 2, "");
}

/// Another date, and files dated in the past and in the future.
pub fn clocks(checkout: &Checkout, tally: &mut Tally) {
    let mut count = 0;
    if has_faketime() {
        for date in ["1999-12-31 23:59:59", "2037-01-01 00:00:00", "-1d", "-1h"] {
            for forget in [true, false] {
                if forget {
                    checkout.forget(true);
                }
                let mut command = checkout.under(&["faketime", "-f", date], &[&["figures"], &FIGURES[..]].concat());
                let ended = CommandOutput::of(command.env("PATH", checkout.path_with_true_clock_for_the_compiler()));
                assert_eq!(ended.code, Some(0), "the clock at {date}: {}", ended.words);
                checkout.must_be_right(&FIGURES, date);
                checkout.must_recover(&FIGURES, &format!("the clock at {date}"));
                count += 1;
            }
        }
    } else {
        tally.skip("wrong clocks", "faketime is missing (apt-get install faketime)");
    }
    let day = Duration::from_secs(86400);
    for date in [SystemTime::UNIX_EPOCH + day, SystemTime::now() + 3650 * day] {
        for name in [
            "data/fig07/stable.csv",
            "target/xtask/state.json",
            "target/xtask/build.json",
            "figures/fig07-exponential-std/scene.toml",
        ] {
            let file = File::options().append(true).open(checkout.root.join(name)).expect("a file");
            file.set_modified(date).expect("a date");
            checkout.must_recover(&FIGURES, &format!("{name} with another date"));
            count += 1;
        }
    }
    count += old_source(checkout);
    tally.add("clocks and dates", count, "");
}

/// A source that was edited while the clock was set back is older than its program: cargo, which compares dates, would
/// leave the program as it is, and the figure of the old source would pass for one of the new.
fn old_source(checkout: &Checkout) -> usize {
    let source = checkout.root.join("figures/fig07-exponential-std/main.rs");
    let program = checkout.target.join("release/fig07-exponential-std");
    let old = fs::read(&source).expect("a source");
    checkout.builds();
    fs::write(&source, [&old[..], b"// edited\n"].concat()).expect("a source");
    let past = SystemTime::UNIX_EPOCH + Duration::from_secs(86400);
    File::options().append(true).open(&source).expect("a file").set_modified(past).expect("a date");
    checkout.run(&["7"]);
    assert_eq!(checkout.builds(), 1, "cargo is asked");
    let date = |path: &Path| path.metadata().and_then(|data| data.modified()).expect("a date");
    assert!(date(&source) > date(&program), "cargo would not see that the source has changed");
    fs::write(&source, old).expect("a source");
    checkout.must_recover(&["7"], "a source edited in the past");
    1
}

/// Several runs at once, by force and not, from nothing; a lock that a dead process has left.
pub fn together(checkout: &Checkout, tally: &mut Tally) {
    let mut count = 0;
    for force in [false, true, false] {
        checkout.forget(true);
        let all: Vec<_> = (0..3)
            .map(|index| {
                let mut arguments = FIGURES.to_vec();
                arguments.extend((force && index > 0).then_some("--force"));
                checkout.command(&arguments).spawn().expect("the runner starts")
            })
            .collect();
        for child in all {
            let ended = CommandOutput::from(&child.wait_with_output().expect("a child"));
            assert_eq!(ended.code, Some(0), "three runs at once: {}", ended.words);
            count += 1;
        }
        checkout.must_recover(&FIGURES, "three runs at once");
    }
    fs::write(checkout.target.join("xtask/lock"), "4194303\n").expect("a lock");
    checkout.forget(true);
    checkout.must_recover(&FIGURES, "the lock of a dead process");
    orphan(checkout);
    tally.add("runs at once, a stale lock, a program that outlives its runner", count + 2, "");
}

/// A program that goes on when its runner is killed: the next run waits for it.
fn orphan(checkout: &Checkout) {
    let program = checkout.target.join("release/simulate");
    let kept = checkout.target.join("release/simulate.kept");
    fs::rename(&program, &kept).expect("a rename");
    fs::write(&program, "#!/bin/sh\necho >\"$0.started\"\nsleep 2\nexec \"$0.kept\" \"$@\"\n").expect("a script");
    make_executable(&program);
    checkout.forget(true);
    let mut child = checkout.command(&["7"]).spawn().expect("the runner");
    let started = checkout.target.join("release/simulate.started");
    while !started.exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().and_then(|()| child.wait()).expect("a child");
    // an undisturbed program again, for the next run
    fs::rename(&kept, &program).expect("a rename");
    std::os::unix::fs::symlink(&program, &kept).expect("a link for the one that sleeps");
    let ended = checkout.run(&["7"]);
    assert!(ended.words.contains("waiting for another"), "{}", ended.words);
    checkout.must_recover(&["7"], "a program that outlived its runner");
    remove(&kept);
    remove(&started);
}

/// Blanks, quotes and letters beyond ASCII.
pub fn paths(checkout: &Checkout, place: &Path, tally: &mut Tally) {
    let root = place.join("a place/größer als 1 Å – «時間» 'x' \"y\" $HOME #1");
    let checkout = checkout.twin(&root);
    checkout.must_recover(&[], "an odd path");
    checkout.forget(true);
    checkout.must_recover(&[], "an odd path, from nothing");
    tally.add("paths with blanks, quotes and letters beyond ASCII", 3, "runs of all figures");
}

fn limited(checkout: &Checkout, limit: &str, figures: &[&str]) -> CommandOutput {
    let shell = ["sh", "-c", &format!("{limit} && exec \"$0\" \"$@\"")];
    CommandOutput::of(&mut checkout.under(&shell, &[&["figures"], figures].concat()))
}

/// Installs it where that is possible.
fn has_faketime() -> bool {
    let works = || Command::new("faketime").args(["-f", "-1d", "true"]).status().is_ok_and(|status| status.success());
    let install = "[ \"$(id -u)\" = 0 ] && [ -e /etc/debian_version ] && { apt-get update && \
        apt-get install -y --no-install-recommends faketime; } >/dev/null 2>&1";
    works() || (Command::new("sh").args(["-c", install]).status().is_ok_and(|status| status.success()) && works())
}

/// A file system that is taken away again, whatever happens.
struct Mount(PathBuf);

impl Mount {
    fn tmpfs(place: &Path, size: &str) -> Option<Mount> {
        fs::create_dir_all(place).ok()?;
        let size = format!("size={size}");
        mount(&["-t", "tmpfs", "-o", &size, "none"], place).then(|| Mount(place.to_owned()))
    }

    fn read_only(folder: &Path) -> Option<Mount> {
        let folder = folder.canonicalize().ok()?;
        if !mount(&["--bind", &folder.to_string_lossy()], &folder) {
            return None;
        }
        let made = Mount(folder.clone());
        mount(&["-o", "remount,ro,bind"], &folder).then_some(made)
    }
}

impl Drop for Mount {
    fn drop(&mut self) {
        // lazily: a program that was just killed may still stand in it
        let _ = Command::new("umount").arg("-l").arg(&self.0).status();
    }
}

fn mount(arguments: &[&str], place: &Path) -> bool {
    let output = Command::new("mount").args(arguments).arg(place).output();
    output.is_ok_and(|output| output.status.success())
}
