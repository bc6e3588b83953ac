//! What this program was built from: its version, the engine that grades, the commit and the target.

use std::sync::LazyLock;

use kinemark_course::staffed_lab::engine_id;
use serde::Serialize;

/// What `kinemark version` says.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct BuildInfo {
    version: &'static str,
    /// The engine as grades and courses name it: its version, and the digest of its sources.
    engine: String,
    /// The commit that was checked out; none outside of a checkout.
    commit: Option<&'static str>,
    /// The platform that it was built for, as Rust calls it.
    target: Option<&'static str>,
}

impl BuildInfo {
    /// That of this program.
    pub(crate) fn of_this() -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION"),
            engine: engine_id(),
            commit: option_env!("KINEMARK_COMMIT"),
            target: option_env!("KINEMARK_TARGET"),
        }
    }

    /// The lines for people; the first is the engine as `course.toml` names it.
    pub(crate) fn text(&self) -> String {
        let rows = [("commit", self.commit), ("target", self.target)];
        let rows = rows
            .iter()
            .filter_map(|(name, value)| Some((name, (*value)?)));
        let rows: String = rows
            .map(|(name, value)| format!("{name}: {value}\n"))
            .collect();
        format!("{}\n{rows}", self.engine)
    }
}

/// What `--version` prints behind the program's name.
pub(crate) fn version() -> &'static str {
    static VERSION: LazyLock<String> = LazyLock::new(|| {
        let text = BuildInfo::of_this().text();
        let text = text.strip_prefix("kinemark ").unwrap_or(&text);
        text.trim_end().to_owned()
    });
    &VERSION
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_is_the_engine_and_what_is_not_known_is_left_out() {
        let mut info = BuildInfo::of_this();
        info.commit = Some("0123456789ab");
        info.target = None;
        let engine = engine_id();
        assert_eq!(info.text(), format!("{engine}\ncommit: 0123456789ab\n"));
        info.commit = None;
        assert_eq!(info.text(), format!("{engine}\n"));
    }

    /// A grade names the engine's sources, which are the same in the next commit.
    #[test]
    fn the_engine_of_a_grade_has_no_commit() {
        if let Some(commit) = BuildInfo::of_this().commit {
            assert!(!engine_id().contains(commit));
        }
    }
}
