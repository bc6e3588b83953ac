//! A whole lab, graded with hidden cases: in this process, without files.

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_grader::judge::grade;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::submission::handed_in::Submission;
use kinemark_grader::submission::host::InProcess;
use kinemark_grader::task::files::Files;
use kinemark_sim::text::Source;

struct Folder(&'static str);

impl Files for Folder {
    fn name(&self) -> String {
        self.0.to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(std::fs::read(format!("{}/{path}", self.0)).ok())
    }

    fn list(&self, _: &str) -> Vec<String> {
        Vec::new()
    }
}

fn lab_1(c: &mut Criterion) {
    let labs = Folder(concat!(env!("CARGO_MANIFEST_DIR"), "/../labs"));
    let reference = Folder(concat!(env!("CARGO_MANIFEST_DIR"), "/../reference"));
    let lab = Lab::load(&labs, "01-kinematics").expect("lab");
    let staff = Staff::load(&reference, &lab, None).expect("reference");
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../tests/submissions/01-kinematics/good/submission.rhai"
    );
    let text = std::fs::read_to_string(path).expect("submission");
    let submission = Submission::from(Source::new("submission.rhai", text));
    let mut group = c.benchmark_group("grade");
    group.sample_size(20);
    group.bench_function("lab 1", |b| {
        b.iter(|| grade(&lab, staff.as_ref(), &submission, &mut InProcess));
    });
    group.finish();
}

criterion_group!(benches, lab_1);
criterion_main!(benches);
