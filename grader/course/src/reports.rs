//! Pages of graded hand-ins, in the book's folder: they share the viewer's code, so that a class fits on a disk.

use std::path::PathBuf;

use kinemark_grader::record::graded::GradedRun;
use kinemark_report::html::{PageExtras, ViewerCode, html_with, whole};
use kinemark_report::plot::plots;

use crate::book::{Book, BookError};
use crate::module_sources::SourceFile;

/// The folder of the pages, in the book's.
pub const REPORTS: &str = "reports";
/// How the folder of a module's sources is called, beside the page of its record.
pub const SOURCES_ENDING: &str = "-sources";

/// The address of the viewer's code, seen from a page. Another version of the viewer has another file.
fn address() -> String {
    format!("../{}", viewer_file())
}

fn viewer_file() -> String {
    let digest = blake3::hash(ViewerCode::text().as_bytes()).to_hex();
    format!("viewer-{}.js", &digest[..12])
}

/// A page of the book with the viewer's code in it, whichever version of the viewer it was written beside: what a server sends may load
/// nothing else.
pub fn with_viewer(page: &str) -> String {
    let address = page
        .rsplit_once("<script src=\"")
        .and_then(|(_, rest)| rest.split('"').next());
    match address.filter(|address| address.starts_with("../viewer-")) {
        Some(address) => whole(page, address),
        None => page.to_owned(),
    }
}

/// The page of a record, seen from the book's folder: by its key, so no name and no id is in it.
pub fn page_path(lab: &str, key: &str) -> String {
    format!("{REPORTS}/{lab}/{key}.html")
}

/// The folder of the sources of a record that is one of a module, seen from the book's folder.
pub fn sources_path(lab: &str, key: &str) -> String {
    format!("{REPORTS}/{lab}/{key}{SOURCES_ENDING}")
}

impl Book {
    fn in_root(&self, path: &str) -> PathBuf {
        self.root().join(path)
    }

    /// Writes the page of a graded run whose record has the key `key`; `script` is the submission where it is one.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_page(
        &self,
        key: &str,
        graded: &GradedRun,
        script: Option<&[u8]>,
    ) -> Result<(), BookError> {
        let drawn: Vec<_> = graded.runs.iter().map(plots).collect();
        // the sources of a module lie beside the page
        let extras = PageExtras {
            script,
            ..PageExtras::default()
        };
        let page = html_with(graded, &drawn, &extras, ViewerCode::Beside(&address()));
        let viewer = self.in_root(REPORTS).join(viewer_file());
        let path = self.in_root(&page_path(&graded.grade.lab.name, key));
        for (path, bytes) in [(viewer, ViewerCode::text()), (path, page.as_str())] {
            self.put(&path, bytes.as_bytes())
                .map_err(|error| BookError {
                    path,
                    why: error.to_string(),
                })?;
        }
        Ok(())
    }

    /// Writes the sources of a module beside the page of its record, for a person to read.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_page_sources(
        &self,
        lab: &str,
        key: &str,
        sources: &[SourceFile],
    ) -> Result<(), BookError> {
        let folder = self.in_root(&sources_path(lab, key));
        for file in sources {
            let path = folder.join(&file.path);
            self.put(&path, &file.bytes).map_err(|error| BookError {
                path,
                why: error.to_string(),
            })?;
        }
        Ok(())
    }

    /// Whether the book has the page of a record.
    pub fn has_page(&self, lab: &str, key: &str) -> bool {
        self.in_root(&page_path(lab, key)).is_file()
    }

    /// The page of a record as one file with everything in it; `None` where none was written, or one of another viewer.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn whole_page(&self, lab: &str, key: &str) -> Result<Option<String>, BookError> {
        let path = self.in_root(&page_path(lab, key));
        match std::fs::read_to_string(&path) {
            Ok(page) => {
                let page = whole(&page, &address());
                Ok((!page.contains("<script src=\"../viewer-")).then_some(page))
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(BookError {
                path,
                why: error.to_string(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use kinemark_grader::record::sample;

    use super::*;

    #[test]
    fn pages_share_the_viewer_and_become_whole() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        let graded = sample::graded();
        let lab = graded.grade.lab.name.clone();
        let (one, other) = ("00112233445566778899aabbccddeeff", "ff");
        assert_eq!(book.whole_page(&lab, one).unwrap(), None);
        book.put_page(one, &graded, None).unwrap();
        book.put_page(other, &graded, None).unwrap();
        let page = book.whole_page(&lab, one).unwrap().unwrap();
        let drawn: Vec<_> = graded.runs.iter().map(plots).collect();
        assert_eq!(
            page,
            kinemark_report::html::html(&graded, &drawn, &PageExtras::default())
        );
        let beside = std::fs::read_to_string(bed.path().join(page_path(&lab, one))).unwrap();
        assert_eq!(with_viewer(&beside), page);
        let of_another = beside.replace(&viewer_file(), "viewer-0123456789ab.js");
        assert_eq!(with_viewer(&of_another), page);
        assert_eq!(with_viewer("<p>plain</p>"), "<p>plain</p>");
        let names = std::fs::read_dir(bed.path().join(REPORTS)).unwrap();
        assert_eq!(names.count(), 2, "the viewer once, and the lab's folder");
    }
}
