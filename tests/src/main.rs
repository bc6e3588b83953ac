//! The whole system: labs through the library, and the binary as a user runs it.

#![expect(
    clippy::float_cmp,
    reason = "points and exact answers are compared exactly"
)]

mod architecture;
mod authoring_slips;
mod bad_briefs;
mod bad_poses;
mod bad_rubrics;
mod book_robustness;
mod case_evidence;
mod class_page;
mod commands;
mod compare;
mod compiled_solutions;
mod course;
mod course_class;
mod course_explain;
mod course_release;
mod determinism;
mod docs;
mod doctor;
mod doubted_bands;
mod downloads;
mod drawn_cases;
mod errors;
mod eval;
mod eval_golden;
mod eval_operations;
mod eval_refusals;
mod eval_trajectories;
mod event_checks;
mod every_case;
mod exact;
mod explained;
mod export;
mod filled_labs;
mod foreign_text;
mod free_function_task;
mod function_length;
mod golden;
mod grade;
mod graded_rubrics;
mod gradescope;
mod grants;
mod handed_in;
mod hidden_runs;
mod hints;
mod hostile;
mod instructor_guide;
mod jacobian_task;
mod lab_audit;
mod lab_check_options;
mod lab_truths;
mod linkage_lab;
mod logged;
mod mesh_labs;
mod module_order;
mod module_reports;
mod module_sources;
mod moments;
mod mutant_words;
mod mutations;
mod named_submissions;
mod new_lab;
mod own_lab;
mod own_robots;
mod pack;
mod path_checks;
mod pictures;
mod prescribed_lab;
mod projects;
mod python;
mod reference_bands;
mod report;
mod report_links;
mod robot_docs;
mod robot_files;
mod robot_functions;
mod robot_response;
mod robustness_levels;
mod rppr_lab;
mod run_diagnoses;
mod scene_check;
mod scene_checks;
mod scene_labs;
mod schemas;
mod sensor_labs;
mod slips;
mod slurm;
mod staff_files;
mod step_checks;
mod stopped_runs;
mod submissions;
mod submit;
mod tampered_reports;
mod targets;
mod testbed;
mod typed_robots_lab;
mod unnamed_mutants;
mod unresolved_runs;
mod urdf_labs;
mod variant_choices;
mod variant_mistakes;
mod variants;
mod verify;
mod view;
mod wasm;
mod watch;
mod working_folder;

/// A file that no `mod` names would be a test that never runs.
#[test]
fn every_file_of_this_folder_is_part_of_the_tests() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src");
    let main = std::fs::read_to_string(format!("{folder}/main.rs")).expect("main.rs");
    for entry in std::fs::read_dir(folder).expect("src") {
        let entry = entry.expect("entry");
        if entry.path().is_dir() {
            continue;
        }
        let name = entry.file_name().into_string().expect("UTF-8");
        let module = name.trim_end_matches(".rs");
        assert!(
            module == "main" || main.contains(&format!("mod {module};")),
            "{name} is not named in main.rs"
        );
    }
}
