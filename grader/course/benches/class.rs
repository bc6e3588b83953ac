//! What a class of 500 costs besides the grading: reading what an LMS exported, and the index of the book.

use std::hint::black_box;
use std::io::{Cursor, Write as _};

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_course::book::{Book, Inputs, Record};
use kinemark_course::fixes::Fixes;
use kinemark_course::history::History;
use kinemark_course::index::{INDEX_FILE, Index};
use kinemark_course::intake;
use kinemark_course::roster::Roster;
use kinemark_grader::record::sample;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

const STUDENTS: usize = 500;

fn read(criterion: &mut Criterion) {
    let bed = tempfile::tempdir().expect("a folder");
    let (mut roster, mut archive) = (
        "id,name\n".to_owned(),
        ZipWriter::new(Cursor::new(Vec::new())),
    );
    for i in 0..STUDENTS {
        roster += &format!("s{i:04},Student Number {i}\n");
        let path = format!("Student Number {i}_{i}_assignsubmission_file_/submission.rhai");
        let file = archive.start_file(path, SimpleFileOptions::default());
        file.expect("an entry");
        let text = format!("fn control(observation) {{\n    [{i}.0, 0.0]\n}}\n").repeat(40);
        archive.write_all(text.as_bytes()).expect("written");
    }
    let bytes = archive.finish().expect("an archive");
    let source = bed.path().join("lab.zip");
    std::fs::write(&source, bytes.into_inner()).expect("written");
    let roster = Roster::parse("roster.csv", roster.as_bytes()).expect("a roster");
    let book = Book::new(&bed.path().join("book"));
    let fixes = Fixes::default();
    criterion.bench_function("intake of 500 from a Moodle archive", |bencher| {
        bencher.iter(|| {
            let read = intake::read(&source, "01", &roster, &fixes, &book, &|_| None);
            assert_eq!(black_box(read).expect("read").hand_ins.len(), STUDENTS);
        });
    });
}

fn index(criterion: &mut Criterion) {
    let bed = tempfile::tempdir().expect("a folder");
    let book = Book::new(bed.path());
    for i in 0..STUDENTS {
        let digest = |what: &str| format!("{what} {i}");
        let inputs = Inputs {
            engine: "kinemark".to_owned(),
            lab_name: "01".to_owned(),
            lab: digest("lab"),
            robot: "robot".to_owned(),
            scenes: Vec::new(),
            staff: None,
            variant_of: None,
            file: "submission.rhai".to_owned(),
            submission: digest("submission"),
            sources: None,
            lab_version: "lab".to_owned(),
            staff_version: None,
        };
        let record = Record::new(inputs, sample::graded().grade);
        book.put_record(&record).expect("kept");
    }
    let history = History::default();
    let path = bed.path().join(INDEX_FILE);
    criterion.bench_function("index of 500 records, made anew", |bencher| {
        bencher.iter(|| {
            let _ = std::fs::remove_file(&path);
            black_box(Index::refresh(&book, &history, "state").expect("an index"))
        });
    });
    criterion.bench_function("index of 500 records, nothing new", |bencher| {
        bencher.iter(|| black_box(Index::refresh(&book, &history, "state").expect("an index")));
    });
}

criterion_group!(benches, read, index);
criterion_main!(benches);
