//! The README of a pack: what lies where, and the command that works.

use kinemark_grader::lab::{Lab, Variant};
use kinemark_grader::record::quantity::points;

use crate::staffed_lab::engine_id;

/// Its name.
pub(super) const NAME: &str = "README.md";

/// For a student, who has unpacked it and opened a terminal in the folder.
pub(super) fn for_students(lab: &Lab, has_solution: bool) -> String {
    let name = &lab.name;
    let variant = match lab.variant.as_ref().and_then(Variant::student) {
        Some(student) => format!(
            "- `variant.toml` holds the numbers of `{student}`. Leave it beside `submission.rhai`.\n"
        ),
        None => String::new(),
    };
    let solution = if has_solution {
        format!(
            "- `solution` holds the reference solution. `kinemark grade {name} solution/solution.rhai` shows what it does.\n"
        )
    } else {
        String::new()
    };
    format!(
        "# {}\n\n\
        Open a terminal in this folder and run:\n\n\
        ```\nkinemark grade {name} submission.rhai\n```\n\n\
        Read `brief.html` in a browser, edit `submission.rhai`, and run the command again. The report `out/report.html` says what\n\
        lost points and why.\n\n\
        {variant}{solution}\
        - The folder `labs` is the lab itself. Leave it here: kinemark finds it from this folder.\n\
        - To hand in, run `kinemark submit {name} submission.rhai` and upload the one file that it writes.\n\n\
        The course uses {}. `kinemark --version` prints yours.\n",
        lab.title,
        engine_id()
    )
}

/// For course staff.
pub(super) fn for_staff(lab: &Lab, has_salt: bool) -> String {
    let name = &lab.name;
    let (salt, option) = if has_salt {
        (
            "- `salt` holds the course's salt, which the command above needs.\n",
            " --salt \"$(cat salt)\"",
        )
    } else {
        ("", "")
    };
    format!(
        "# {}: for course staff\n\n\
        The folder `reference` holds the solution, the hidden cases and the salt. Do not give it to students:\n\
        `kinemark lab pack {name} --for students` makes what they get.\n\n\
        Open a terminal in this folder and run:\n\n\
        ```\nkinemark lab check {name}{option}\nkinemark grade {name} reference/{name}/solution.rhai{option}\n```\n\n\
        - `labs` holds the lab, its robot and its scenes.\n\
        - `reference` holds the course staff's part, which `kinemark grade` finds beside `labs`.\n\
        {salt}\n\
        Packed with {}.\n",
        lab.title,
        engine_id()
    )
}

/// For whoever opens the archive that Gradescope takes.
pub(super) fn for_gradescope(lab: &Lab, hidden_at_upload: bool, has_roster: bool) -> String {
    let shown = if hidden_at_upload {
        "At an upload students see all points, those of hidden cases among them. Whoever uploads often can find out what is hidden."
    } else {
        "At an upload students see how they did in the visible cases. Points, which hidden cases are part of, show when the grades are\n\
        published."
    };
    let variants = if has_roster {
        "Each student has a variant of their own. `roster.csv` maps the e-mail addresses of Gradescope to the course's ids."
    } else {
        "Everybody has the default numbers of the lab."
    };
    format!(
        "# {}: autograder for Gradescope\n\n\
        Upload this archive as it is to the programming assignment, under Configure Autograder. Set the assignment's points to {}.\n\n\
        {shown}\n\n\
        {variants}\n\n\
        The folder `reference` holds the solution and the salt. Do not give this archive to students.\n\n\
        Packed with {}.\n",
        lab.title,
        points(lab.tasks.iter().map(|task| task.max_points()).sum()),
        engine_id()
    )
}
