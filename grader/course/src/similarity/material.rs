//! What the files of a class are compared with: what everybody was given, what only course staff has, and what is older or public.

use super::class_file::ClassFile;
use crate::public::is_public_solution;
use crate::staffed_lab::StaffedLab;

/// Files that are not of the class, by path and bytes.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Material {
    /// What every student has: starter, brief, `lab.toml`, the reference path.
    pub given: Vec<(String, Vec<u8>)>,
    /// What only course staff has: the reference solution and the mutants. Students who solve a task well come near to it.
    pub solutions: Vec<(String, Vec<u8>)>,
    /// Last year's files, and solutions that are public.
    pub earlier: Vec<(String, Vec<u8>)>,
}

impl Material {
    /// That of a lab: its files, `handed_out` besides them, the scripts of its staff part. A reference solution that anybody can read
    /// is public as well.
    pub fn of_lab(lab: &StaffedLab, handed_out: Vec<(String, Vec<u8>)>) -> Self {
        let mut given = lab.lab_files();
        given.extend(handed_out);
        let mut solutions = lab.staff_files();
        // hidden.toml and the salt are no solutions
        solutions.retain(|(path, _)| path.ends_with(".rhai"));
        let public = solutions
            .iter()
            .filter(|(_, bytes)| is_public_solution(bytes));
        let earlier = public
            .map(|(path, bytes)| (format!("Kinemark's repository, {path}"), bytes.clone()))
            .collect();
        Self {
            given,
            solutions,
            earlier,
        }
    }

    /// Adds the reference solutions of Kinemark's own repository that somebody handed in as they are: they are known by their digests,
    /// whichever solution the course has.
    pub fn add_public(&mut self, class: &[ClassFile]) {
        for file in class {
            let is_known = self.earlier.iter().any(|(_, bytes)| *bytes == file.bytes);
            if !is_known && is_public_solution(&file.bytes) {
                let path = "Kinemark's repository, a reference solution";
                self.earlier.push((path.to_owned(), file.bytes.clone()));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::student::StudentId;

    #[test]
    fn a_public_solution_is_known_by_its_digest() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../reference/01-kinematics/solution.rhai"
        );
        let solution = std::fs::read(path).unwrap();
        let file = |student: &str, bytes: &[u8]| ClassFile {
            student: StudentId::new(student).unwrap(),
            group: String::new(),
            file: "submission.rhai".to_owned(),
            bytes: bytes.to_vec(),
            submitted_at: None,
        };
        let class = [
            file("s1", &solution),
            file("s2", b"let own = 1;"),
            file("s3", &solution),
        ];
        let mut material = Material::default();
        material.add_public(&class);
        assert_eq!(material.earlier.len(), 1);
        assert_eq!(material.earlier[0].1, solution);
    }
}
