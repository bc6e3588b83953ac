//! Folders that JPlag and Dolos read, for those who want their kind of similarity: structure without names. Both run elsewhere; ids are
//! in the folders, names are not.

use super::class_file::ClassFile;
use super::material::Material;

/// Files of a folder, by path and bytes.
pub type FolderFiles = Vec<(String, Vec<u8>)>;

/// A folder for JPlag: a directory a submission, and the base code apart. JPlag knows no Rhai, so the files are named as text.
pub fn jplag(files: &[ClassFile], material: &Material) -> FolderFiles {
    let mut folder: FolderFiles = scripts(files)
        .map(|(file, name)| {
            let path = format!("submissions/{}/{name}.txt", file.student.folder());
            (path, file.bytes.clone())
        })
        .collect();
    for (path, bytes) in starters(material) {
        folder.push((format!("base/{path}.txt"), bytes.clone()));
    }
    let base = if starters(material).next().is_some() {
        " -bc base"
    } else {
        ""
    };
    let readme = format!(
        "Run JPlag on this folder:\n\n    java -jar jplag.jar -l text{base} submissions\n\n\
         JPlag's text mode compares words in a row. It knows no Rhai, so it does not see through renamed variables.\n"
    );
    folder.push(("README.txt".to_owned(), readme.into_bytes()));
    folder
}

/// A folder for Dolos: every file at the top, and `info.csv` that says whose it is. The label is the group; the name is the id.
pub fn dolos(files: &[ClassFile], material: &Material) -> FolderFiles {
    let mut folder: FolderFiles = Vec::new();
    let mut rows = csv::Writer::from_writer(Vec::new());
    // into memory: nothing can fail
    let _ = rows.write_record(["filename", "label", "created_at", "full_name"]);
    for (file, _) in scripts(files) {
        let name = format!("{}.rhai", file.student.folder());
        let created = file
            .submitted_at
            .map(|at| at.to_string())
            .unwrap_or_default();
        let (label, id) = (plain(&file.group), plain(file.student.as_str()));
        let _ = rows.write_record([name.as_str(), &label, &created, &id]);
        folder.push((name, file.bytes.clone()));
    }
    let mut ignore = String::new();
    for (path, bytes) in starters(material).take(1) {
        ignore = format!(" -i base/{path}");
        folder.push((format!("base/{path}"), bytes.clone()));
    }
    folder.push(("info.csv".to_owned(), rows.into_inner().unwrap_or_default()));
    let readme = format!(
        "Run Dolos in this folder:\n\n    dolos run -f web -l javascript{ignore} info.csv\n\n\
         Dolos knows no Rhai. Its JavaScript parser reads most of it, and goes on behind what it does not know.\n"
    );
    folder.push(("README.txt".to_owned(), readme.into_bytes()));
    folder
}

/// Submissions that are text, with the last part of their names.
fn scripts(files: &[ClassFile]) -> impl Iterator<Item = (&ClassFile, &'static str)> {
    files
        .iter()
        .filter(|file| file.text().is_some())
        .map(|file| (file, "submission.rhai"))
}

/// The scripts that everybody was given, by the last part of their paths.
fn starters(material: &Material) -> impl Iterator<Item = (&str, &Vec<u8>)> {
    let given = material.given.iter();
    given
        .map(|(path, bytes)| (path.rsplit('/').next().unwrap_or(path), bytes))
        .filter(|(path, _)| path.ends_with(".rhai"))
}

/// Text that a spreadsheet takes for text.
fn plain(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        format!("'{text}")
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::student::StudentId;

    fn files() -> Vec<ClassFile> {
        let file = |student: &str, bytes: &[u8], at: Option<i64>| ClassFile {
            student: StudentId::new(student).unwrap(),
            group: "=g".to_owned(),
            file: "x.rhai".to_owned(),
            bytes: bytes.to_vec(),
            submitted_at: at.map(|at| jiff::Timestamp::from_second(at).unwrap()),
        };
        vec![
            file("s1", b"let a = 1;", Some(0)),
            file("../é, x", b"let b = 2;", None),
            file("s3", b"\0asm", None),
        ]
    }

    fn material() -> Material {
        Material {
            given: vec![
                ("01/starter.rhai".to_owned(), b"fn f() {}".to_vec()),
                ("01/brief.md".to_owned(), b"# Lab".to_vec()),
            ],
            ..Material::default()
        }
    }

    fn paths(folder: &FolderFiles) -> Vec<&str> {
        folder.iter().map(|(path, _)| path.as_str()).collect()
    }

    fn text<'f>(folder: &'f FolderFiles, path: &str) -> &'f str {
        let (_, bytes) = folder.iter().find(|(known, _)| known == path).unwrap();
        std::str::from_utf8(bytes).unwrap()
    }

    #[test]
    fn jplag_gets_a_directory_a_submission() {
        let folder = jplag(&files(), &material());
        assert_eq!(
            paths(&folder),
            [
                "submissions/s1/submission.rhai.txt",
                "submissions/~2e~.~2f~~e9~~2c~~20~x/submission.rhai.txt",
                "base/starter.rhai.txt",
                "README.txt"
            ]
        );
        assert!(text(&folder, "README.txt").contains("-l text -bc base submissions"));
        assert!(!text(&jplag(&files(), &Material::default()), "README.txt").contains("-bc"));
    }

    #[test]
    fn dolos_gets_a_table_of_files() {
        let folder = dolos(&files(), &material());
        assert_eq!(
            text(&folder, "info.csv"),
            "filename,label,created_at,full_name\n\
             s1.rhai,'=g,1970-01-01T00:00:00Z,s1\n\
             ~2e~.~2f~~e9~~2c~~20~x.rhai,'=g,,\"../é, x\"\n"
        );
        let table = text(&folder, "info.csv");
        for row in table.lines().skip(1) {
            let name = row.split(',').next().unwrap();
            assert!(
                paths(&folder).contains(&name),
                "{name} is not in the folder"
            );
        }
        assert!(text(&folder, "README.txt").contains("-i base/starter.rhai info.csv"));
    }
}
