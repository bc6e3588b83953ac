//! The search over a class: files prepared once, then each kind of finding, in the order in which a person reads them.

use std::collections::BTreeMap;

use super::class_file::{ClassFile, text};
use super::coverage::{Known, Stream, reading_of};
use super::earlier::{EarlierFile, earlier};
use super::finding::Finding;
use super::foreign_numbers::foreign_numbers;
use super::material::Material;
use super::passages::{same_files, shared_passages};
use crate::student::StudentId;

/// What is shared by more than this part of the class is a common way to write it.
const RARE_SHARE: f64 = 0.05;
/// In a small class this many may share it.
const FEWEST_RARE: usize = 3;

/// A class and what it is compared with.
#[derive(Debug, Clone, Copy)]
pub struct Class<'a> {
    /// The file of each student that counts.
    pub files: &'a [ClassFile],
    /// The numbers of each student's variant, by name; empty where there are no variants.
    pub variants: &'a BTreeMap<StudentId, Vec<(String, Vec<f64>)>>,
    /// The numbers of the default variant.
    pub default: &'a [(String, Vec<f64>)],
    /// What is not of the class.
    pub material: &'a Material,
}

/// A file, ready to compare.
pub(super) struct Prepared<'a> {
    pub(super) file: &'a ClassFile,
    /// None of a compiled one.
    pub(super) stream: Option<Stream<'a>>,
}

impl Prepared<'_> {
    /// Whoever stands behind the file: the group, or the student.
    pub(super) fn hand(&self) -> &str {
        match self.file.group.as_str() {
            "" => self.file.student.as_str(),
            group => group,
        }
    }
}

/// How many students may share what is rare, in a class of so many.
pub(super) fn rare(students: usize) -> usize {
    ((RARE_SHARE * students as f64).ceil() as usize).max(FEWEST_RARE)
}

/// How many students may share a passage with comments, in a class of so many: what more than half of it has is everybody's.
pub(super) fn common(students: usize) -> usize {
    students / 2
}

/// Everything in a class that is worth a conversation: by kind, then what is longest. The same class gives the same findings, in
/// whichever order its files come.
pub fn findings(class: &Class<'_>) -> Vec<Finding> {
    let mut files: Vec<&ClassFile> = class.files.iter().collect();
    files.sort_by(|a, b| a.student.cmp(&b.student));
    let material = class.material;
    let given = Known::of(texts(&material.given));
    let known = Known::of(texts(&material.given).chain(texts(&material.solutions)));
    let prepared = prepare(&files, &known);
    let mut findings = same_files(&prepared);
    findings.extend(foreign_numbers(class, &prepared));
    findings.extend(shared_passages(&prepared));
    if !material.earlier.is_empty() {
        let earlier_files: Vec<EarlierFile<'_>> = material
            .earlier
            .iter()
            .map(|(path, bytes)| EarlierFile {
                path,
                bytes,
                stream: text(bytes).map(|text| Stream::of(text, &given)),
            })
            .collect();
        findings.extend(earlier(&prepare(&files, &given), &earlier_files));
    }
    findings.sort_by(|a, b| {
        let order = |finding: &Finding| (finding.kind, std::cmp::Reverse(finding.size));
        let students = |finding: &Finding| finding.students().cloned().collect::<Vec<_>>();
        order(a)
            .cmp(&order(b))
            .then_with(|| students(a).cmp(&students(b)))
    });
    findings
}

fn texts(files: &[(String, Vec<u8>)]) -> impl Iterator<Item = (&str, super::token::Reading)> {
    let files = files.iter();
    files.filter_map(|(path, bytes)| Some((text(bytes)?, reading_of(path))))
}

fn prepare<'a>(files: &[&'a ClassFile], known: &Known) -> Vec<Prepared<'a>> {
    let files = files.iter();
    files
        .map(|file| Prepared {
            file,
            stream: file.text().map(|text| Stream::of(text, known)),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::similarity::{Kind, Whose};

    /// Sixty tokens and more, with a comment.
    const PASSAGE: &str = "
// The elbow is found with the law of cosines, and then the shoulder from what is left of the triangle.
fn triangle(long, short, far) {
    let cosine = (far * far - long * long - short * short) / (2.0 * long * short);
    let bend = acos(clamp(cosine, -1.0, 1.0));
    let lean = atan2(short * sin(bend), long + short * cos(bend));
    [lean, bend]
}
";

    /// A file that nobody else would write: names and numbers are its author's.
    fn own_file(author: usize) -> String {
        let lines = (0..30).map(|line| {
            let number = (author * 7919 + line * 104_729) % 10_007;
            format!("let a{author}_{line} = b{number} * {number}.5 + c{line}_{author};\n")
        });
        lines.collect()
    }

    fn file(student: &str, text: String) -> ClassFile {
        ClassFile {
            student: StudentId::new(student).unwrap(),
            group: String::new(),
            file: "submission.rhai".to_owned(),
            bytes: text.into_bytes(),
            submitted_at: None,
        }
    }

    /// Forty students, of whom those of `with` have the passage in the middle of their own.
    fn class(with: std::ops::Range<usize>) -> Vec<ClassFile> {
        (0..40)
            .map(|author| {
                let own = own_file(author);
                let (begin, end) = own.split_at(own.len() / 2);
                let passage = if with.contains(&author) { PASSAGE } else { "" };
                file(&format!("s{author:02}"), format!("{begin}\n{passage}{end}"))
            })
            .collect()
    }

    fn found_with(files: &[ClassFile], material: &Material) -> Vec<Finding> {
        findings(&Class {
            files,
            variants: &BTreeMap::new(),
            default: &[],
            material,
        })
    }

    fn found(files: &[ClassFile]) -> Vec<Finding> {
        found_with(files, &Material::default())
    }

    fn ids(finding: &Finding) -> Vec<&str> {
        finding.students().map(StudentId::as_str).collect()
    }

    fn named(name: &str, text: &str) -> (String, Vec<u8>) {
        (name.to_owned(), text.as_bytes().to_vec())
    }

    #[test]
    fn independent_files_have_nothing_in_common() {
        assert_eq!(found(&class(0..0)), []);
        assert_eq!(found(&class(3..4)), []);
    }

    #[test]
    fn a_planted_passage_is_found_with_its_lines_and_base_rate() {
        let files = class(3..5);
        let [finding] = &found(&files)[..] else {
            panic!("{:?}", found(&files))
        };
        assert_eq!(
            (finding.kind, ids(finding)),
            (Kind::Passage, vec!["s03", "s04"])
        );
        assert_eq!(finding.base_rate(), "2 of 40");
        for place in &finding.files {
            let student: usize = match &place.whose {
                Whose::Student(student) => student.as_str()[1..].parse().unwrap(),
                Whose::Earlier(_) => panic!("{place:?}"),
            };
            let text = std::str::from_utf8(&files[student].bytes).unwrap();
            let first = 1 + text
                .lines()
                .position(|line| line.starts_with("// The elbow"))
                .unwrap();
            let [(from, to)] = place.lines[..] else {
                panic!("{place:?}")
            };
            // a word after the passage may be the same by chance
            assert!(
                from == first && (first + 6..=first + 7).contains(&to),
                "{place:?}"
            );
        }
        assert!(
            finding.says.contains("words of comments"),
            "{}",
            finding.says
        );
        assert!(finding.excerpt.starts_with("// The elbow is found with"));
    }

    #[test]
    fn white_space_hides_nothing_and_the_order_of_files_does_not_matter() {
        let mut files = class(3..5);
        let text = String::from_utf8(files[4].bytes.clone()).unwrap();
        files[4].bytes = text
            .replace(" = ", "=")
            .replace('\n', "\n\n\t")
            .into_bytes();
        let one = found(&files);
        assert_eq!(one.len(), 1);
        files.reverse();
        assert_eq!(found(&files), one);
    }

    /// The same files without the words of their comments.
    fn without_comments(mut files: Vec<ClassFile>) -> Vec<ClassFile> {
        for file in &mut files {
            let text = std::str::from_utf8(&file.bytes).unwrap();
            let code: Vec<&str> = text
                .lines()
                .filter(|line| !line.starts_with("//"))
                .collect();
            file.bytes = code.join("\n").into_bytes();
        }
        files
    }

    #[test]
    fn what_many_share_is_a_common_way_to_write_it() {
        // one in twenty of 40 is 2; a small class allows 3
        let few = found(&without_comments(class(0..3)));
        assert_eq!(
            (few[0].kind, few[0].base_rate()),
            (Kind::Passage, "3 of 40".to_owned())
        );
        assert_eq!(found(&without_comments(class(0..4))), []);
    }

    #[test]
    fn comments_that_many_share_are_shown_once_with_their_base_rate() {
        let mut files = class(0..20);
        let findings = found(&files);
        let [finding] = &findings[..] else {
            panic!("{findings:?}")
        };
        assert_eq!(
            (finding.kind, finding.base_rate()),
            (Kind::CommonPassage, "20 of 40".to_owned())
        );
        // some who changed a word at its end are no further findings
        for file in &mut files[5..10] {
            let text = String::from_utf8(file.bytes.clone()).unwrap();
            file.bytes = text.replace("[lean, bend]", "[bend, lean]").into_bytes();
        }
        let findings = found(&files);
        assert_eq!(findings.len(), 1, "{findings:?}");
        // half of the class is everybody
        assert_eq!(found(&class(0..21)), []);
    }

    #[test]
    fn what_was_given_and_the_reference_solution_are_taken_out() {
        let files = class(3..5);
        let given = Material {
            given: vec![named("starter.rhai", PASSAGE)],
            ..Material::default()
        };
        assert_eq!(found_with(&files, &given), []);
        let brief = format!("# Lab\n\nDon't panic. Begin with\n\n```\n{PASSAGE}\n```\n");
        let given = Material {
            given: vec![named("brief.md", &brief)],
            ..Material::default()
        };
        assert_eq!(found_with(&files, &given), []);
        let solutions = Material {
            solutions: vec![named("solution.rhai", PASSAGE)],
            ..Material::default()
        };
        assert_eq!(found_with(&files, &solutions), []);
    }

    #[test]
    fn earlier_and_public_files_are_found_with_any_base_rate() {
        let files = class(0..15);
        let public = named(
            "public/solution.rhai",
            &format!("let other = 1;\n{PASSAGE}"),
        );
        let mut material = Material {
            // the reference solution is public
            solutions: vec![public.clone()],
            earlier: vec![named("2024/s9.rhai", &own_file(99)), public],
            ..Material::default()
        };
        let findings = found_with(&files, &material);
        let [finding] = &findings[..] else {
            panic!("{findings:?}")
        };
        assert_eq!(
            (finding.kind, finding.base_rate()),
            (Kind::EarlierPassage, "15 of 40".to_owned())
        );
        let last = finding.files.last().unwrap();
        assert_eq!(
            last.whose,
            Whose::Earlier("public/solution.rhai".to_owned())
        );
        assert_eq!(last.lines, [(3, 9)]);
        // one who hands in last year's file as it was
        material
            .earlier
            .push(named("2024/s10.rhai", &own_file(7).replace(" * ", "*")));
        let findings = found_with(&files, &material);
        let whole = findings
            .iter()
            .find(|finding| finding.kind == Kind::EarlierFile);
        assert!(whole.is_none(), "s07 has the passage, too");
        let plain = class(0..0);
        let findings = found_with(&plain, &material);
        assert_eq!(
            (findings[0].kind, ids(&findings[0])),
            (Kind::EarlierFile, vec!["s07"])
        );
        assert_eq!(
            findings[0].says,
            "The files are the same, but for white space."
        );
        // what nearly everybody has is the course's own
        assert_eq!(
            found_with(
                &class(0..39),
                &Material {
                    earlier: material.earlier[1..2].to_vec(),
                    ..Material::default()
                }
            ),
            []
        );
    }

    #[test]
    fn equal_files_are_found_and_those_of_a_group_are_not() {
        let mut files = class(0..0);
        files[8].bytes = files[3].bytes.clone();
        let findings = found(&files);
        assert_eq!((findings.len(), findings[0].kind), (1, Kind::SameFile));
        assert_eq!(findings[0].says, "The files are the same, byte for byte.");
        assert_eq!(ids(&findings[0]), ["s03", "s08"]);
        for i in [3, 8] {
            files[i].group = "g1".to_owned();
        }
        assert_eq!(found(&files), []);
        // the starter, handed in as it is
        let starter = named("starter.rhai", &own_file(3));
        let given = Material {
            given: vec![starter],
            ..Material::default()
        };
        files[8].group = String::new();
        assert_eq!(found_with(&files, &given), []);
    }

    #[test]
    fn compiled_and_broken_files_are_compared_as_bytes() {
        let mut files = class(0..0);
        files[1].bytes = vec![0, 0x61, 0x73, 0x6d, 0xff];
        files[2].bytes = vec![0, 0x61, 0x73, 0x6d, 0xff];
        files[5].bytes = Vec::new();
        files[6].bytes = Vec::new();
        files[7].bytes = b"/* \"".to_vec();
        let findings = found(&files);
        assert_eq!((findings.len(), ids(&findings[0])), (1, vec!["s01", "s02"]));
    }

    type Variants = BTreeMap<StudentId, Vec<(String, Vec<f64>)>>;

    /// Everybody's own four numbers.
    fn variants() -> Variants {
        let number = |base: f64, i: usize| (base * 1000.0 + i as f64).round() / 1000.0;
        let of = |i: usize| {
            vec![
                ("right".to_owned(), vec![number(1.9, i), number(1.25, i)]),
                ("left".to_owned(), vec![number(2.1, i), -number(1.55, i)]),
            ]
        };
        let students = (0..40).map(|i| (StudentId::new(&format!("s{i:02}")).unwrap(), of(i)));
        students.collect()
    }

    fn with_numbers(numbers: &str, default: &[(String, Vec<f64>)], given: &str) -> Vec<Finding> {
        let mut files = class(0..0);
        files[2].bytes.extend_from_slice(numbers.as_bytes());
        let material = Material {
            given: vec![named("lab.toml", given)],
            ..Material::default()
        };
        findings(&Class {
            files: &files,
            variants: &variants(),
            default,
            material: &material,
        })
    }

    #[test]
    fn numbers_of_another_variant_are_found_whoever_owns_them() {
        let numbers = "let goals = [[1.907, 1.257],\n    [2.1070, -1.557]];\n";
        let [finding] = &with_numbers(numbers, &[], "")[..] else {
            panic!("{:?}", with_numbers(numbers, &[], ""))
        };
        assert_eq!(
            (finding.kind, ids(finding)),
            (Kind::ForeignNumbers, vec!["s02", "s07"])
        );
        assert_eq!(finding.size, 4);
        assert_eq!(finding.base_rate(), "1 of 40");
        assert_eq!(
            finding.says,
            "Numbers of the variant of s07: right[0] = 1.907, right[1] = 1.257, left[0] = 2.107, left[1] = -1.557."
        );
        assert_eq!(
            finding.excerpt,
            "let goals = [[1.907, 1.257],\n    [2.1070, -1.557]];"
        );
        // one of four may be missing, two may not
        assert_eq!(
            with_numbers("let g = [1.907, 1.257, 2.107];", &[], "")[0].size,
            3
        );
        assert_eq!(with_numbers("let g = [1.907, 1.257];", &[], ""), []);
    }

    #[test]
    fn ones_own_numbers_and_those_that_were_given_are_nobodys() {
        let own = "let goals = [[1.902, 1.252], [2.102, -1.552]];";
        assert_eq!(with_numbers(own, &[], ""), []);
        let numbers = "let goals = [[1.907, 1.257], [2.107, -1.557]];";
        let default = [
            ("x".to_owned(), vec![1.907, 1.257]),
            ("y".to_owned(), vec![2.107, -1.557]),
        ];
        assert_eq!(with_numbers(numbers, &default, ""), []);
        assert_eq!(
            with_numbers(numbers, &[], "x = [1.907, 1.257, 2.107, 1.557]"),
            []
        );
        // numbers in comments count: that is where a copied header has them
        assert_eq!(with_numbers(&format!("// {numbers}"), &[], "").len(), 1);
    }

    #[test]
    fn a_table_of_all_numbers_names_nobody() {
        let all: Vec<String> = variants()
            .values()
            .flatten()
            .flat_map(|(_, values)| values)
            .map(f64::to_string)
            .collect();
        assert_eq!(
            with_numbers(&format!("let all = [{}];", all.join(", ")), &[], "").len(),
            1
        );
    }
}
