//! How long a graded run takes to be shown: its plots, its replay, the page, the log, and all of it, of a ten second motion task;
//! then a PNG and the storyboard of an eight second one.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_grader::record::sample;
use kinemark_report::log::{Attachment, mcap};
use kinemark_report::log_request::LogRequest;
use kinemark_report::{
    html::{PageExtras, html},
    plot::plots,
    png::png,
    replay::Replay,
    storyboard::storyboard,
};

fn report(criterion: &mut Criterion) {
    let mut graded = sample::graded();
    graded.runs = vec![sample::task_run_of(10)];
    let run = &graded.runs[0];
    criterion.bench_function("plots of a run", |bencher| {
        bencher.iter(|| plots(black_box(run)))
    });
    criterion.bench_function("replay of a run", |bencher| {
        bencher.iter(|| Replay::of(black_box(run), graded.grade.tasks.last()).json())
    });
    let many = sample::chain(25, 10_001, |tick, joint| {
        libm::sin(0.001 * (tick * (1 + joint as u64)) as f64)
    });
    criterion.bench_function("replay of 25 joints", |bencher| {
        bencher.iter(|| Replay::of(black_box(&many), None).json())
    });
    let drawn = vec![plots(run)];
    criterion.bench_function("page", |bencher| {
        bencher.iter(|| html(black_box(&graded), &drawn, &PageExtras::default()))
    });
    // the first picture reads the font
    criterion.bench_function("png", |bencher| {
        bencher.iter(|| png(black_box(&drawn[0][0].svg)))
    });
    let grade = graded.grade.tasks.iter().find(|task| task.name == run.task);
    let grade = grade.expect("the task of the run");
    criterion.bench_function("storyboard", |bencher| {
        bencher.iter(|| png(&storyboard(black_box(run), grade)));
    });
    let attachments = [Attachment {
        name: "rrbot.toml",
        media_type: "application/toml",
        bytes: include_bytes!("../../../labs/robots/rrbot.toml"),
    }];
    criterion.bench_function("log of a run", |bencher| {
        bencher.iter(|| {
            mcap(
                black_box(run),
                &graded.grade,
                &attachments,
                LogRequest::default(),
            )
        });
    });
    criterion.bench_function("plots, page and log of a run", |bencher| {
        bencher.iter(|| {
            let drawn = vec![plots(black_box(run))];
            let page = html(&graded, &drawn, &PageExtras::default());
            (
                page,
                mcap(run, &graded.grade, &attachments, LogRequest::default()),
            )
        });
    });
}

criterion_group!(benches, report);
criterion_main!(benches);
