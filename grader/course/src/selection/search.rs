//! The search, level by level: a folder and an archive are each one level.

use std::collections::BTreeSet;

use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::submission::handed_in::Submission;

use super::outcome::{Found, MOST_HAND_IN_BYTES, MOST_SUBMISSION_BYTES, Unselected};
use super::what_is_there::in_words;
use crate::layout::PersonFiles;
use crate::module_sources::{SourceFile, project_folder, sources};
use crate::submission_name::NameKind;
use crate::tree::{Entry, EntryProblem, Tree, file_kind};

/// Where `kinemark grade` writes its report.
const REPORT_FOLDER: &str = "out";

/// Files that only a report has, both of them in one folder.
const REPORT_FILES: [&str; 2] = ["grade.json", "report.json"];

/// What may be the submission on a level, the first kind that is there. Text called `submission` may be notes beside a script.
const KINDS: [&[NameKind]; 3] = [
    &[NameKind::HandIn],
    &[NameKind::Submission],
    &[NameKind::SubmissionText, NameKind::Script],
];

/// So many files to choose from are read; nobody chooses among more.
const MOST_CHOICES: usize = 20;

/// A variant is a few lines.
const MOST_VARIANT_BYTES: u64 = 64 << 10;

/// What a file is that cannot be read as text or module.
const A_SCRIPT: &str = "a script";

/// Finds the submission of a person. `is_hand_in` says of a file called `*.kinemark` whether it is a hand-in file, of this lab.
///
/// # Errors
/// What only a person can decide.
pub fn select(
    tree: &Tree,
    person: &PersonFiles,
    is_hand_in: &dyn Fn(&[u8]) -> bool,
) -> Result<Found, Unselected> {
    Search::new(tree, person, is_hand_in).run()
}

/// A file on the way.
#[derive(Debug, Clone)]
pub(super) struct Node {
    /// The tree it is in: the source, or an archive that was opened.
    tree: usize,
    /// Its number among the entries of that tree; `None` where its name gives it no place.
    entry: Option<usize>,
    /// Its path inside its tree, as the person arranged it.
    inside: String,
    /// Its path in the source, through archives.
    pub(super) shown: String,
    /// Its name as the person gave it.
    name: String,
    /// How many folders and archives it is in.
    level: usize,
    /// What its name says.
    pub(super) kind: NameKind,
    /// What is wrong with it.
    pub(super) problem: Option<EntryProblem>,
    /// Whether it is inside a report.
    pub(super) in_report: bool,
}

/// The search for one person's submission.
struct Search<'s> {
    source: &'s Tree,
    opened: Vec<Tree>,
    nodes: Vec<Node>,
    is_hand_in: &'s dyn Fn(&[u8]) -> bool,
    /// Archives that could not be opened, each with its level.
    closed: Vec<(usize, String, EntryProblem)>,
    /// What may still be read for this person [bytes].
    left: u64,
    /// How many files of archives may still be listed for this person.
    entries_left: usize,
}

impl<'s> Search<'s> {
    fn new(source: &'s Tree, person: &PersonFiles, is_hand_in: &'s dyn Fn(&[u8]) -> bool) -> Self {
        let entries = source.entries();
        let files = person.files.iter().map(|file| {
            let entry = &entries[file.entry];
            (
                file.path.as_str(),
                Some(file.entry),
                entry.path.as_str(),
                entry.problem.clone(),
            )
        });
        let nodes = nodes(0, 0, &files.collect::<Vec<_>>());
        Self {
            source,
            opened: Vec::new(),
            nodes,
            is_hand_in,
            closed: Vec::new(),
            left: source.limits().person_bytes,
            entries_left: source.limits().entries,
        }
    }

    fn run(mut self) -> Result<Found, Unselected> {
        let mut level = 0;
        while level <= self.nodes.iter().map(|node| node.level).max().unwrap_or(0) {
            if let Some(decided) = self.decide(level) {
                return decided;
            }
            self.open_archives(level);
            level += 1;
        }
        if let Some((_, path, problem)) = self.closed.first().cloned() {
            return Err(Unselected::Unusable { path, problem });
        }
        self.nothing_found()
    }

    fn tree(&self, number: usize) -> &Tree {
        match number {
            0 => self.source,
            number => &self.opened[number - 1],
        }
    }

    fn entry(&self, node: &Node) -> Option<&Entry> {
        Some(&self.tree(node.tree).entries()[node.entry?])
    }

    /// The bytes of a file, counted.
    fn bytes(&mut self, node: &Node, most: u64) -> Result<Vec<u8>, EntryProblem> {
        if let Some(problem) = &node.problem {
            return Err(problem.clone());
        }
        let Some(entry) = self.entry(node) else {
            return Err(EntryProblem::NoName);
        };
        let bytes = self.tree(node.tree).bytes(entry, most.min(self.left));
        let spent = match &bytes {
            Ok(bytes) => bytes.len() as u64,
            Err(_) => most.min(self.left),
        };
        let limit = most.min(self.left);
        self.left -= spent;
        bytes.map_err(|problem| match problem {
            // it ended at this person's share, and not at its own limit
            EntryProblem::TooLarge { .. } if limit < most => EntryProblem::Budget {
                most: self.source.limits().person_bytes,
            },
            problem => problem,
        })
    }

    /// What the files of one level decide; `None` where they are none of those looked for.
    fn decide(&mut self, level: usize) -> Option<Result<Found, Unselected>> {
        let at_level: Vec<Node> = self
            .nodes
            .iter()
            .filter(|node| node.level == level && !node.in_report)
            .cloned()
            .collect();
        for kinds in KINDS {
            let of_kind = at_level.iter().filter(|node| kinds.contains(&node.kind));
            let mut found: Vec<Found> = Vec::new();
            for node in of_kind {
                match self.read(node) {
                    Ok(Some(file)) if found.iter().all(|known| known.bytes != file.bytes) => {
                        found.push(file);
                    }
                    // the same bytes again, or no hand-in file
                    Ok(_) => {}
                    Err(problem) => {
                        let path = node.shown.clone();
                        return Some(Err(Unselected::Unusable { path, problem }));
                    }
                }
                if found.len() == MOST_CHOICES {
                    break;
                }
            }
            if found.is_empty() {
                continue;
            }
            // an archive further up may hold the submission, and nobody could look
            if let Some((_, path, problem)) = self.closed.first().cloned() {
                return Some(Err(Unselected::Unusable { path, problem }));
            }
            for found in &mut found {
                found.sources = self.sources_of(found);
            }
            return Some(match found.len() {
                1 => Ok(found.swap_remove(0)),
                _ => Err(Unselected::Ambiguous(found)),
            });
        }
        None
    }

    /// Reads a file as what its name says; `None` where it is no hand-in file.
    fn read(&mut self, node: &Node) -> Result<Option<Found>, EntryProblem> {
        let is_hand_in = node.kind == NameKind::HandIn;
        let most = match is_hand_in {
            true => MOST_HAND_IN_BYTES,
            false => MOST_SUBMISSION_BYTES,
        };
        let bytes = self.bytes(node, most)?;
        if is_hand_in && !(self.is_hand_in)(&bytes) {
            return Ok(None);
        }
        if !is_hand_in {
            refuse_other_kinds(&node.name, &bytes)?;
        }
        Ok(Some(Found {
            path: node.shown.clone(),
            name: node.name.clone(),
            variant: self.variant_beside(node),
            bytes,
            is_hand_in,
            sources: Vec::new(),
        }))
    }

    /// The sources in the folder of a module; a script is its own, and a hand-in file has them inside.
    fn sources_of(&mut self, found: &Found) -> Vec<SourceFile> {
        if found.is_hand_in || !found.bytes.starts_with(Submission::MODULE_MAGIC) {
            return Vec::new();
        }
        let Some(module) = self
            .nodes
            .iter()
            .find(|node| node.shown == found.path)
            .cloned()
        else {
            return Vec::new();
        };
        let folder = project_folder(&module.inside).to_owned();
        let beside = self
            .nodes
            .iter()
            .filter(|node| node.tree == module.tree && !node.in_report);
        let beside: Vec<(String, Node)> = beside
            .filter_map(|node| {
                let inside = node.inside.strip_prefix(folder.as_str())?;
                node.entry.map(|_| (inside.to_owned(), node.clone()))
            })
            .collect();
        sources(beside, |node, most| self.bytes(node, most).ok())
    }

    /// The `variant.toml` in the folder of a file.
    fn variant_beside(&mut self, node: &Node) -> Option<Vec<u8>> {
        let folder = node.shown.strip_suffix(node.name.as_str())?;
        let path = format!("{folder}{VARIANT_FILE}");
        let variant = self.nodes.iter().find(|other| other.shown == path).cloned();
        self.bytes(&variant?, MOST_VARIANT_BYTES).ok()
    }

    /// Opens the archives of one level; their files are on the next.
    fn open_archives(&mut self, level: usize) {
        let is_archive = |node: &Node| node.level == level && node.kind == NameKind::Archive;
        let archives: Vec<Node> = self
            .nodes
            .iter()
            .filter(|node| is_archive(node) && !node.in_report)
            .cloned()
            .collect();
        for node in archives {
            match self.opened(&node) {
                Ok(tree) => {
                    self.opened.push(tree);
                    let added = self.nodes_of_opened(level + 1, &node.shown);
                    self.nodes.extend(added);
                }
                Err(problem) => self.closed.push((level, node.shown, problem)),
            }
        }
    }

    fn opened(&mut self, node: &Node) -> Result<Tree, EntryProblem> {
        if let Some(problem) = &node.problem {
            return Err(problem.clone());
        }
        let Some(entry) = self.entry(node) else {
            return Err(EntryProblem::NoName);
        };
        // the archive is held in memory: the part of the share that is left is what it may take
        let limit = self.source.limits().nested_bytes.min(self.left);
        if entry.declared_size.is_some_and(|size| size > limit) {
            return Err(EntryProblem::TooLarge { most: limit });
        }
        let size = entry.declared_size.unwrap_or(limit);
        let tree = self.tree(node.tree).nested(entry, self.entries_left);
        self.left -= size.min(self.left);
        if let Ok(tree) = &tree {
            self.entries_left -= tree.entries().len().min(self.entries_left);
        }
        tree
    }

    /// The files of the archive that was opened last.
    fn nodes_of_opened(&self, level: usize, shown: &str) -> Vec<Node> {
        let number = self.opened.len();
        let tree = self.tree(number);
        let paths: Vec<String> = tree
            .entries()
            .iter()
            .map(|entry| format!("{shown}/{}", entry.path))
            .collect();
        let entries = tree.entries().iter().zip(&paths).enumerate();
        let files = entries.map(|(i, (entry, shown))| {
            (
                entry.path.as_str(),
                Some(i),
                shown.as_str(),
                entry.problem.clone(),
            )
        });
        let mut nodes = nodes(number, level, &files.collect::<Vec<_>>());
        // a name without a place is met first, so that nothing further down is taken in its stead
        for entry in tree.misnamed() {
            nodes.push(Node {
                tree: number,
                entry: None,
                inside: String::new(),
                shown: format!("{shown}/{}", entry.original),
                name: entry.name().to_owned(),
                level,
                kind: NameKind::of(entry.name()),
                problem: Some(entry.problem.clone()),
                in_report: false,
            });
        }
        nodes
    }

    /// What is there in place of a submission.
    fn nothing_found(mut self) -> Result<Found, Unselected> {
        let mut possible = Vec::new();
        for node in self.nodes.clone() {
            let is_starter = node.kind == NameKind::Starter && !node.in_report;
            let is_reported = node.kind == NameKind::Submission && node.in_report;
            if (is_starter || is_reported) && possible.len() < MOST_CHOICES {
                possible.extend(self.read(&node).ok().flatten());
            }
        }
        let kind = |node: &Node| {
            let entry = self.entry(node)?;
            self.tree(node.tree).kind(entry)
        };
        let instead = in_words(&self.nodes, kind);
        Err(Unselected::NothingFound { instead, possible })
    }
}

/// The files of one tree as nodes; `files` has their paths inside, their numbers, their paths in the source and their problems.
fn nodes(
    tree: usize,
    level: usize,
    files: &[(&str, Option<usize>, &str, Option<EntryProblem>)],
) -> Vec<Node> {
    let reports = report_folders(files.iter().map(|(path, ..)| *path));
    let nodes = files.iter().map(|(path, entry, shown, problem)| {
        let (folders, name) = path.rsplit_once('/').unwrap_or(("", path));
        Node {
            tree,
            entry: *entry,
            inside: (*path).to_owned(),
            shown: (*shown).to_owned(),
            name: name.to_owned(),
            level: level + path.matches('/').count(),
            kind: NameKind::of(name),
            problem: problem.clone(),
            in_report: is_in_report(folders, &reports),
        }
    });
    nodes.collect()
}

/// Folders with the files that only a report has; the top is what was handed in, and looked into in any case.
fn report_folders<'p>(paths: impl Iterator<Item = &'p str>) -> BTreeSet<String> {
    let mut found: [BTreeSet<String>; 2] = Default::default();
    for path in paths {
        let Some((folder, name)) = path.rsplit_once('/') else {
            continue;
        };
        for (folders, file) in found.iter_mut().zip(REPORT_FILES) {
            if name == file {
                folders.insert(folder.to_owned());
            }
        }
    }
    let [grades, reports] = found;
    grades.intersection(&reports).cloned().collect()
}

/// Whether a folder is `out` or a report, or inside one.
fn is_in_report(folder: &str, reports: &BTreeSet<String>) -> bool {
    let mut folder = folder;
    while !folder.is_empty() {
        let (above, name) = folder.rsplit_once('/').unwrap_or(("", folder));
        if name == REPORT_FOLDER || reports.contains(folder) {
            return true;
        }
        folder = above;
    }
    false
}

/// Refuses what is called a script and is something else.
fn refuse_other_kinds(name: &str, bytes: &[u8]) -> Result<(), EntryProblem> {
    let is_module = name.to_lowercase().ends_with(".wasm");
    match file_kind(bytes) {
        Some("a WebAssembly module") if is_module => Ok(()),
        Some(found) => Err(EntryProblem::OtherKind {
            found,
            expected: match is_module {
                true => "a WebAssembly module",
                false => A_SCRIPT,
            },
        }),
        None => Ok(()),
    }
}
