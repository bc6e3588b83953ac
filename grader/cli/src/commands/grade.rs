//! `kinemark grade`: one submission, graded and reported.

use std::path::Path;
use std::process::ExitCode;

use kinemark_grader::audit;
use kinemark_grader::judge;
use kinemark_grader::judge::reference_run;
use kinemark_grader::lab::{Files, Lab, Staff};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::record::verdict::Verdict;
use kinemark_grader::submission::host::{Host, InProcess};

use kinemark_sim::source::Source;

use crate::args::GradeArgs;
use crate::failure::{self, FAULT, Failure, LOST};
use crate::report_folder::Pictures;
use crate::variants::{self, Chosen};
use crate::worker::WorkerHost;
use crate::{disk, interrupt, output, places, report_folder};

/// A submission larger than this is not read; its own budget, which is counted, is far below.
const MOST_SUBMISSION_BYTES: u64 = 1 << 20;

/// A submission, graded.
pub(crate) struct Work {
    lab: Lab,
    submission: Source,
    pub(crate) graded: GradedRun,
    /// What was taken that nobody named.
    pub(crate) note: Option<String>,
}

/// Grades, writes the folder, prints.
pub(crate) fn run(args: &GradeArgs) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let work = work(args)?;
    let grade = &work.graded.grade;
    // the grade is told before anything is written: a full disk must not lose it
    if args.json {
        output::print_json(grade)?;
    } else {
        if let Some(note) = &work.note {
            output::print(&format!("{note}\n"))?;
        }
        output::print(&kinemark_report::text::text(grade))?;
    }
    write(args, &work)?;
    if !args.json {
        let report = output::path(&args.out.join("report.html"));
        output::print(&format!("report: {report}\n"))?;
        if let Some(loss) = kinemark_report::moment::first_loss(grade) {
            let place = loss.fragment();
            output::print(&format!("first lost point: {report}{place}\n"))?;
        }
        if args.storyboard {
            output::print(&storyboards(&args.out, &work.graded))?;
        }
    }
    Ok(exit_code(grade.verdict))
}

/// Writes the folder.
pub(crate) fn write(args: &GradeArgs, work: &Work) -> Result<(), Failure> {
    let pictures = Pictures {
        png: args.png,
        storyboard: args.storyboard,
    };
    report_folder::write(
        &args.out,
        &work.lab,
        &work.submission,
        &work.graded,
        pictures,
    )
}

/// Reads what was named, and grades.
pub(crate) fn work(args: &GradeArgs) -> Result<Work, Failure> {
    let (files, labs_folder) = places::labs(&args.places)?;
    let reference = places::reference(&args.staff, labs_folder.as_deref())?;
    let Chosen { lab, mut note } = variants::choose(
        &args.lab,
        files.as_ref(),
        reference.as_ref(),
        &args.variant,
        &args.staff,
        Some(&args.submission),
    )?;
    let staff = match &reference {
        Some(reference) => staff_of(reference, &lab, args)?,
        None => None,
    };
    if args.ghost && staff.is_none() {
        return Err(Failure::usage(
            format!(
                "--ghost shows the reference solution, and none of lab `{}` is here",
                lab.name
            ),
            "name the staff's folder with --reference DIR, or leave --ghost out",
        ));
    }
    if staff.is_some() && lab.variant.is_none() && !lab.variants.is_empty() {
        note = Some("no variant: everybody's numbers of lab.toml".to_owned());
    }
    disk::refuse_link(&args.submission)?;
    let submission = disk::read(&args.submission, "a submission", MOST_SUBMISSION_BYTES)?;
    report_folder::refuse_foreign(&args.out)?;

    let mut in_process = InProcess;
    let mut workers = WorkerHost::new((!args.in_process).then(|| progress(lab.tasks.len())));
    let host: &mut dyn Host = if args.in_process {
        &mut in_process
    } else {
        &mut workers
    };
    let graded = judge::grade(&lab, staff.as_ref(), &submission, host);
    workers.finish();
    // a worker's processor is for workers alone
    drop(workers);
    let mut graded = graded.map_err(|_| Failure::interrupted())?;
    for fault in &graded.staff_faults {
        failure::warn(
            "the points stand, but this file of the staff told nothing of the submission",
            fault.as_ref(),
        );
    }
    if let Some(staff) = staff.as_ref().filter(|_| args.ghost) {
        reference_run::show_reference(&lab, staff, &mut graded);
    }
    Ok(Work {
        lab,
        submission,
        graded,
        note,
    })
}

/// Where the storyboards are, a line each.
fn storyboards(out: &Path, graded: &GradedRun) -> String {
    if graded.runs.is_empty() {
        return "storyboard: none, because no motion task ran\n".to_owned();
    }
    let lines = graded.runs.iter().map(|run| {
        let path = out.join(&run.task).join(report_folder::STORYBOARD);
        format!("storyboard: {}\n", output::path(&path))
    });
    lines.collect()
}

fn staff_of(reference: &dyn Files, lab: &Lab, args: &GradeArgs) -> Result<Option<Staff>, Failure> {
    let staff = Staff::load(reference, lab, args.staff.salt.as_deref())?;
    if let Some(staff) = &staff {
        audit::staff_code(lab, staff)?;
    }
    if staff.is_none() && args.staff.reference.is_some() {
        return Err(Failure::usage(
            format!(
                "{} has no solution for lab `{}`",
                reference.name(),
                lab.name
            ),
            "check the folder, or leave --reference out to practise",
        ));
    }
    Ok(staff)
}

fn progress(tasks: usize) -> indicatif::ProgressBar {
    let bar = indicatif::ProgressBar::new(tasks as u64);
    if let Ok(style) = indicatif::ProgressStyle::with_template("{pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar
}

fn exit_code(verdict: Verdict) -> ExitCode {
    match verdict {
        Verdict::Passed => ExitCode::SUCCESS,
        Verdict::GraderFault | Verdict::HostLimit => ExitCode::from(FAULT),
        Verdict::DidNotBuild
        | Verdict::Crashed
        | Verdict::OverBudget
        | Verdict::InvalidOutput
        | Verdict::Missed => ExitCode::from(LOST),
    }
}
