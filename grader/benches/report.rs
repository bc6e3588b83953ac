//! How long a graded run takes to be shown: all plots and the page, and the log, of an eight second motion task.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_grader::log::{Attachment, mcap};
use kinemark_grader::report::{html::html, plot::plots};
use kinemark_grader::{grade, graded, verdict};

#[path = "../src/report/sample.rs"]
#[expect(dead_code, reason = "the tests of the renderers use more of it")]
mod sample;

fn report(criterion: &mut Criterion) {
    let graded = sample::graded();
    let run = &graded.runs[0];
    criterion.bench_function("plots of a run", |bencher| {
        bencher.iter(|| plots(black_box(run)))
    });
    let drawn = vec![plots(run)];
    criterion.bench_function("page", |bencher| {
        bencher.iter(|| html(black_box(&graded), &drawn))
    });
    let attachments = [Attachment {
        name: "rrbot.toml",
        media_type: "application/toml",
        bytes: include_bytes!("../../labs/robots/rrbot.toml"),
    }];
    criterion.bench_function("log of a run", |bencher| {
        bencher.iter(|| mcap(black_box(run), &graded.grade, &attachments));
    });
}

criterion_group!(benches, report);
criterion_main!(benches);
