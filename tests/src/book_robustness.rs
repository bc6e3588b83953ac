//! What a book survives: a process that is killed or interrupted, a full disk, two people at once, and a file system without locks or
//! with copies of its own. Each ends with the grades and the records of one undisturbed run.
#![cfg(unix)]

use std::fs;
use std::os::unix::process::CommandExt as _;
use std::process::{Child, Command, Stdio};

use kinemark_course::book::Book;

use crate::course_class::{
    LAB, Stands, class, grade, has_graded, large_class_in, records, standings,
};
use crate::testbed::{CommandResult, TestBed, binary, files_below, names_below, until};

type Graded = (Vec<Stands>, Vec<(String, Vec<u8>)>);

/// What the book says in the end.
fn graded(bed: &TestBed) -> Graded {
    (standings(bed), records(bed))
}

/// How far a book is: its files and the lines of its journal.
fn steps(bed: &TestBed) -> usize {
    let journal = fs::read_dir(bed.path("book/journal")).into_iter().flatten();
    let lines = journal.flatten().map(|entry| {
        let bytes = fs::read(entry.path()).unwrap_or_default();
        bytes.iter().filter(|byte| **byte == b'\n').count()
    });
    names_below(&bed.path("book")).len() + lines.sum::<usize>()
}

/// Starts to grade, in a process group of its own with its workers.
fn start(bed: &TestBed, more: &[&str]) -> Child {
    let mut command = bed.command(&[&["course", "grade", "in", LAB], more].concat());
    command.process_group(0);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the binary runs")
}

/// Waits until the book is that far, or the process has ended by itself.
fn wait_for(bed: &TestBed, child: &mut Child, far: usize) {
    until(|| steps(bed) >= far || child.try_wait().expect("a state").is_some());
}

/// Sends a signal to a process and its workers, as a terminal does.
fn signal(child: &Child, signal: &str) {
    let group = format!("-{}", child.id());
    // it may have ended by itself
    let _ = Command::new("kill").args([signal, "--", &group]).status();
}

/// Every record and every submission is whole, and so is every line of the journal but a last one.
fn assert_whole(bed: &TestBed) {
    let book = Book::new(&bed.path("book"));
    for key in book.record_keys().expect("records") {
        assert!(
            book.record(&key).expect("a file").is_some(),
            "{key} is damaged"
        );
    }
    for name in names_below(&bed.path("book/submissions")) {
        if !name.starts_with(".new-") {
            book.submission(&name).expect("a whole submission");
        }
    }
    book.journal().entries().expect("a journal");
}

/// Killed with its workers at twenty moments: four books, each resumed five times.
#[test]
fn a_book_survives_kill_9() {
    let one = class();
    grade(&one, &[]);
    let (expected, all) = (graded(&one), steps(&one));
    for seed in 0..4 {
        let bed = class();
        let mut random = seed * 7919 + 17;
        let mut moments: Vec<usize> = (0..5)
            .map(|_| {
                random = (random * 1_103_515_245 + 12345) % (1 << 31);
                1 + (random >> 8) % all
            })
            .collect();
        moments.sort_unstable();
        for far in &moments {
            let mut child = start(&bed, &[]);
            wait_for(&bed, &mut child, *far);
            signal(&child, "-KILL");
            child.wait().expect("it ends");
            assert_whole(&bed);
        }
        grade(&bed, &[]);
        assert_eq!(graded(&bed), expected, "killed at {moments:?} of {all}");
    }
}

/// Ctrl-C reaches the process and its workers at once, or the process alone.
#[test]
fn a_book_survives_ctrl_c() {
    let one = large_class_in(TestBed::new(), 24);
    grade(&one, &["--no-reports"]);
    let expected = graded(&one);
    for whom in ["-", ""] {
        let bed = large_class_in(TestBed::new(), 24);
        let mut child = start(&bed, &["--no-reports", "--jobs", "1"]);
        until(|| has_graded(&bed));
        let id = format!("{whom}{}", child.id());
        let sent = Command::new("kill").args(["-INT", "--", &id]).status();
        assert!(sent.expect("kill runs").success());
        child.wait().expect("it ends");
        let ran: CommandResult = child.wait_with_output().expect("its output").into();
        assert_eq!(ran.code, Some(130), "{ran:?}");
        assert!(
            ran.stderr.contains("what was graded so far stands"),
            "{ran:?}"
        );
        assert_whole(&bed);
        let ran = grade(&bed, &["--no-reports"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert_eq!(graded(&bed), expected);
    }
}

/// No file may be larger than a limit, as on a disk with so much space left: at each limit the command ends at another place.
#[test]
fn a_book_survives_files_that_cannot_be_written_whole() {
    let one = class();
    grade(&one, &["--no-reports"]);
    let expected = graded(&one);
    let bed = class();
    // of all that is kept, the files of the lab are the largest: with them there, smaller limits reach the others
    for folder in ["labs", "staff"] {
        for (path, bytes) in files_below(&one.path("book").join(folder)) {
            bed.write(&format!("book/{folder}/{path}"), bytes);
        }
    }
    let mut places = std::collections::BTreeSet::new();
    // blocks of 512 bytes, or 1,024
    for blocks in [0, 1, 2, 3, 4, 6, 8, 12, 16, 32, 64, 256, 1024] {
        let script = format!(
            "trap '' XFSZ; ulimit -f {blocks}; exec '{}' course grade in {LAB} --no-reports --jobs 2 2>&1 | cat",
            binary().display()
        );
        let mut limited = Command::new("bash");
        limited.args(["-o", "pipefail", "-c", &script]);
        limited.current_dir(bed.path("."));
        let ran: CommandResult = limited.output().expect("bash runs").into();
        assert_whole(&bed);
        if ran.code == Some(1) {
            assert!(blocks > 4, "{blocks}: {ran:?}");
            continue;
        }
        assert_eq!(ran.code, Some(4), "{blocks}: {ran:?}");
        assert!(ran.stdout.contains("space"), "it says what to do: {ran:?}");
        let place = [
            "book/submissions",
            "journal",
            "book/records",
            "course.sqlite",
        ];
        places.extend(place.into_iter().find(|place| ran.stdout.contains(place)));
    }
    assert!(places.len() > 2, "only {places:?} were written");
    let ran = grade(&bed, &["--no-reports"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert_eq!(graded(&bed), expected);
}

/// A disk that is really full, where this machine lets a user mount one.
#[test]
fn a_book_survives_a_full_disk() {
    let mut may = Command::new("unshare");
    may.args(["-rm", "mount", "-t", "tmpfs", "none", "/mnt"]);
    if !may.output().is_ok_and(|ran| ran.status.success()) {
        println!("NOT RUN: a user may mount nothing here (unshare -rm mount)");
        return;
    }
    let one = class();
    grade(&one, &[]);
    let expected = graded(&one);
    let bed = class();
    let script = format!(
        "mkdir full; rm -rf book; mount -t tmpfs -o size=128k none full; ln -s full book\n\
         for size in 256 512 768 1024 1536 2048 3072; do\n\
           '{0}' course grade in {LAB} --jobs 2; echo \"$size ends: $?\"\n\
           mount -o remount,size=${{size}}k none full\n\
         done >ends 2>says\n\
         mount -o remount,size=64m none full; rm book; cp -r full book; umount full",
        binary().display()
    );
    let mut full = Command::new("unshare");
    full.args(["-rm", "sh", "-c", &script])
        .current_dir(bed.path("."));
    let ran: CommandResult = full.output().expect("unshare runs").into();
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let read = |name: &str| fs::read_to_string(bed.path(name)).expect("a file");
    let (ends, says) = (read("ends"), read("says"));
    let codes: Vec<&str> = ends
        .lines()
        .filter_map(|line| Some(line.split_once(" ends: ")?.1))
        .collect();
    assert!(codes.len() == 7 && codes[0] == "4", "{ends}");
    assert!(codes.iter().all(|code| ["4", "1"].contains(code)), "{ends}");
    assert!(
        says.contains("No space left") && says.contains("help"),
        "{says}"
    );
    assert_whole(&bed);
    grade(&bed, &[]);
    assert_eq!(graded(&bed), expected);
}

/// Two people grade and a third looks on, in one folder at one time.
#[test]
fn two_people_grade_in_one_folder() {
    let one = class();
    grade(&one, &["--no-reports"]);
    let expected = graded(&one);
    for _ in 0..3 {
        let bed = class();
        let mut both = [
            start(&bed, &["--no-reports"]),
            start(&bed, &["--no-reports"]),
        ];
        while both
            .iter_mut()
            .any(|child| child.try_wait().expect("a state").is_none())
        {
            let ran = bed.run(&["course", "status"]);
            assert_eq!(ran.code, Some(0), "{ran:?}");
        }
        for child in both {
            let ran: CommandResult = child.wait_with_output().expect("its output").into();
            assert_eq!(ran.code, Some(1), "{ran:?}");
        }
        assert_whole(&bed);
        assert_eq!(graded(&bed), expected);
    }
}

/// What synchronised folders, network file systems and desktops put beside the files of a book.
#[test]
fn copies_of_a_conflict_change_nothing() {
    let bed = class();
    grade(&bed, &["--no-reports"]);
    let expected = graded(&bed);
    let status = bed.run(&["course", "status"]).stdout;
    let copies = |name: &str| -> Vec<String> {
        let (stem, ending) = name.rsplit_once('.').unwrap_or((name, ""));
        [
            format!("{stem} (Anna's conflicted copy 2026-11-27).{ending}"),
            format!("{stem}.sync-conflict-20261127-101112-ABCDEFG.{ending}"),
            format!("{name}.sync-conflict"),
            ".nfs00000000004c5c0000000a".to_owned(),
            ".DS_Store".to_owned(),
            format!("~${name}"),
        ]
        .into()
    };
    let mut waiting = vec![bed.path("book")];
    while let Some(folder) = waiting.pop() {
        let there: Vec<_> = fs::read_dir(&folder).expect("folder").flatten().collect();
        for entry in there {
            if entry.path().is_dir() {
                waiting.push(entry.path());
                continue;
            }
            let bytes = fs::read(entry.path()).expect("file");
            for copy in copies(&entry.file_name().to_string_lossy()) {
                // as they are when somebody's disk is slow: cut off
                fs::write(folder.join(copy), &bytes[..bytes.len() * 2 / 3]).expect("copy");
            }
        }
    }
    assert_eq!(standings(&bed), expected.0);
    assert_eq!(bed.run(&["course", "status"]).stdout, status);
    // nothing to do: the index is not written again
    let written = || {
        bed.path("book/course.sqlite")
            .metadata()
            .expect("index")
            .modified()
            .expect("time")
    };
    let before = written();
    assert_eq!(standings(&bed), expected.0);
    assert_eq!(written(), before);
    grade(&bed, &["--no-reports"]);
    assert_eq!(standings(&bed), expected.0);
}

/// A file that a loss of power has cut short is made again.
#[test]
fn what_a_disk_has_damaged_is_made_again() {
    let bed = class();
    grade(&bed, &["--no-reports"]);
    let expected = graded(&bed);
    for folder in ["records", "submissions"] {
        for (at, (name, bytes)) in files_below(&bed.path("book").join(folder))
            .into_iter()
            .enumerate()
        {
            let left = if at % 2 == 0 { 0 } else { bytes.len() / 2 };
            fs::write(bed.path("book").join(folder).join(name), &bytes[..left]).expect("file");
        }
    }
    fs::write(bed.path("book/course.sqlite"), "").expect("index");
    let ran = bed.run(&["course", "grade", LAB]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(
        ran.stderr
            .contains("reading what the LMS exported once more"),
        "{ran:?}"
    );
    let ran = grade(&bed, &["--no-reports"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert_eq!(graded(&bed), expected);
}

/// No command of a course asks for a lock or a hard link: not every file system has them.
#[test]
fn no_lock_is_asked_for() {
    let there = Command::new("strace").arg("-V").output();
    if !there.is_ok_and(|ran| ran.status.success()) {
        println!("NOT RUN: strace is not installed");
        return;
    }
    let bed = class();
    let source = ["course", "grade", "in", LAB, "--no-reports"];
    for args in [
        &source[..],
        &["course", "status"],
        &["course", "regrade", LAB],
    ] {
        let mut traced = Command::new("strace");
        traced.args([
            "-f",
            "-qq",
            "-o",
            "calls",
            "-e",
            "trace=flock,fcntl,link,linkat,rename,renameat,renameat2",
        ]);
        traced.arg(binary()).args(args).current_dir(bed.path("."));
        let ran: CommandResult = traced.output().expect("strace runs").into();
        assert!(ran.code.is_some_and(|code| code < 2), "{ran:?}");
        let calls = fs::read_to_string(bed.path("calls")).expect("calls");
        for call in calls.lines() {
            let is_lock = [
                "flock(",
                "F_SETLK",
                "F_OFD_SETLK",
                "link(",
                "linkat(",
                "RENAME_",
            ]
            .iter()
            .any(|name| call.contains(name));
            assert!(!is_lock, "{args:?}: {call}");
        }
        assert!(
            args[1] != "grade" || calls.contains("rename"),
            "nothing was traced"
        );
    }
}
