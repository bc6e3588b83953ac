//! The graders of labs are graded: starters must miss, references must pass on any salt, mutants must lose and be recognised.

use kinemark_grader::audit::{Audit, Row};
use kinemark_grader::lab::load::lab_names;
use kinemark_grader::lab::{Lab, Staff, TaskWork};
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;
use kinemark_sim::text::Source;

use crate::every_case::every_case;
use crate::testbed::{Folder, grade, lab, root, staff};

fn labs() -> Vec<Lab> {
    let names = lab_names(&Folder(root().join("labs")));
    assert!(!names.is_empty());
    names.iter().map(|name| lab(name)).collect()
}

fn read(lab: &Lab, file: &str) -> String {
    let path = root().join("labs").join(&lab.name).join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_starter_of_lab_0_earns_the_warm_up_alone() {
    let lab = lab("00-step-response");
    let staff = staff(&lab, None);
    let starter = read(&lab, "starter.rhai");
    let starter = grade(&lab, Some(&staff), "starter.rhai", &starter);
    for (i, task) in starter.grade.tasks.iter().enumerate() {
        let (verdict, points) = if i == 0 {
            (Verdict::Passed, task.max_points)
        } else {
            (Verdict::Missed, 0.0)
        };
        assert_eq!(
            (task.verdict, task.points),
            (verdict, points),
            "{}: {}",
            task.name,
            text(&starter.grade)
        );
    }
}

/// The lab with its function tasks alone, whose hidden cases are many and quick.
fn function_tasks(mut lab: Lab) -> Lab {
    lab.tasks
        .retain(|task| matches!(task.work, TaskWork::Function(..)));
    lab
}

/// The gate tries 200 students of every lab besides (`kinemark lab check --variants 200`), in the optimised build.
const STUDENTS: u32 = 4;

#[test]
fn references_lose_no_point_whatever_the_salt() {
    let mut cases = Vec::new();
    for lab in labs() {
        let functions = function_tasks(lab.clone());
        for salt in 0..40 {
            // hidden runs take long; of hidden cases many are tried
            let part = if salt < 2 {
                lab.clone()
            } else {
                functions.clone()
            };
            cases.push((
                format!("{}, salt {salt}", lab.name),
                (lab.clone(), part, salt),
            ));
        }
    }
    every_case(&cases, |(lab, part, salt)| {
        let staff = staff(lab, Some(&format!("salt {salt}")));
        let solution = staff.solution.clone();
        let graded = grade(part, Some(&staff), "solution.rhai", solution.text());
        let grade = &graded.grade;
        assert_eq!(grade.verdict, Verdict::Passed, "{}", text(grade));
        assert_eq!(grade.points, grade.max_points);
    });
}

#[test]
fn references_lose_no_point_whoever_the_student_is() {
    let labs = labs().into_iter().map(|lab| (lab.name.clone(), lab));
    every_case(&labs.collect::<Vec<_>>(), |lab| {
        let places = ["labs", "reference"].map(|folder| Folder(root().join(folder)));
        passes_variants(&places[0], &places[1], lab, STUDENTS);
    });
}

/// The reference has full marks in the variants of the first `students`, each with the hidden cases and runs of that variant.
pub(crate) fn passes_variants(labs: &Folder, reference: &Folder, lab: &Lab, students: u32) {
    if lab.variants.is_empty() {
        return;
    }
    let salt = Staff::salt(reference, &lab.name, None).expect("hidden.toml");
    let salt = salt.expect("a salt");
    for student in 0..students {
        let student = format!("s{student}");
        let variant = lab.variant_of(&salt, &student).expect("a variant");
        let load = Lab::load_variant(labs, &lab.name, Some(&variant));
        let lab = load.unwrap_or_else(|error| panic!("{student}: {error:?}"));
        let staff = Staff::load(reference, &lab, None);
        let staff = staff.unwrap_or_else(|error| panic!("{student}: {error:?}"));
        let staff = staff.expect("a reference");
        let solution = staff.solution.text();
        let graded = grade(&lab, Some(&staff), "solution.rhai", solution).grade;
        assert_eq!(graded.verdict, Verdict::Passed, "{}", text(&graded));
        assert_eq!(graded.points, graded.max_points, "{}", text(&graded));
    }
}

/// What `kinemark lab check` tries, with other salts as well.
#[test]
fn labs_have_no_problem_that_lab_check_finds() {
    let labs = labs().into_iter().map(|lab| (lab.name.clone(), lab));
    every_case(&labs.collect::<Vec<_>>(), |lab| {
        let mut audit = Audit::new(lab);
        let own = staff(lab, None);
        let starter = Source::new("starter.rhai", read(lab, "starter.rhai"));
        audit.starter(lab, &own, &starter);
        audit.mutants(lab, &own);
        let functions = function_tasks(lab.clone());
        for salt in ["another year", "a third"] {
            audit.mutants(&functions, &staff(lab, Some(salt)));
        }
        audit.reference(lab, &own, "own hidden cases");
        let problems: Vec<&Row> = audit.problems().collect();
        assert!(problems.is_empty(), "{problems:#?}");
    });
}

#[test]
fn hidden_targets_lie_inside_the_boundary() {
    use kinemark_grader::task::model::Given;
    use kinemark_reference::planar_2r::{IkSolutions, Planar2r};
    let lab = lab("01-kinematics");
    for salt in 0..20 {
        let staff: Staff = staff(&lab, Some(&format!("boundary {salt}")));
        let mut seen = 0;
        for case in staff.hidden("ik") {
            let robot = lab.robot_file.build(&case.dimensions).expect("a robot");
            let length = |joint: usize| match robot.dimensions().get("link_lengths") {
                Some(kinemark_sim::text::Dimension::List(lengths)) => lengths[joint],
                other => panic!("{other:?}"),
            };
            let base_height_m = match robot.dimensions().get("base_height") {
                Some(kinemark_sim::text::Dimension::Number(height)) => *height,
                other => panic!("{other:?}"),
            };
            let (l1_m, l2_m) = (length(0), length(1));
            let arm = Planar2r {
                base_height_m,
                l1_m,
                l2_m,
                ..Planar2r::lab_arm()
            };
            let Given::Position {
                position_m: [x, y, _],
                branches,
                ..
            } = case.given
            else {
                panic!("{case:?}");
            };
            let r = ((x - base_height_m) * (x - base_height_m) + y * y).sqrt();
            let inside = (l1_m + l2_m - r).min(r - (l1_m - l2_m).abs());
            if branches == 0 {
                assert!(inside < -0.005, "{} at {inside}", case.name);
                assert!(matches!(
                    arm.inverse_kinematics(x, y),
                    IkSolutions::Unreachable { .. }
                ));
            } else {
                assert!(inside >= 0.005, "{} at {inside}", case.name);
                assert!(matches!(
                    arm.inverse_kinematics(x, y),
                    IkSolutions::Branches { .. }
                ));
            }
            seen += 1;
        }
        assert!(seen > 30);
    }
}
