//! Bytes of what a report keeps, `grade.json` or `report.json`: never a panic, and a record that can be read is shown and compared.
#![no_main]

use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::{sums, visible_part};
use kinemark_report::moment::look_first;
use kinemark_report::output::Manifest;
use kinemark_report::short_text::short_text;
use kinemark_report::text::text;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(manifest) = Manifest::parse(bytes) {
        manifest.lists("grade.json");
        manifest.lists_below("plots");
    }
    let Ok(grade) = serde_json::from_slice::<Grade>(bytes) else {
        return;
    };
    sums::contradictions(&grade);
    visible_part::contradictions(&grade, &grade);
    text(&grade);
    short_text(&grade, "submission.rhai");
    if let Some(loss) = look_first(&grade) {
        loss.fragment();
    }
    let written = serde_json::to_string(&grade).expect("JSON");
    let read: Grade = serde_json::from_str(&written).expect("what was written is read");
    assert_eq!(serde_json::to_string(&read).expect("JSON"), written);
});
