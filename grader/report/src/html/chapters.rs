//! The storyboard of a task as chapters of its replay: each panel leads to its moment; in print they stand in its place.

use maud::{Markup, PreEscaped, html};

use super::prose;
use super::viewer::seek_with;
use crate::storyboard::chapters as panels;
use crate::visible::shortened_in_words;
use kinemark_grader::record::grade::TaskGrade;
use kinemark_grader::record::graded::TaskRun;
use kinemark_sim::text::number::seconds;

/// Sentences of a chapter, and characters of each, that are shown: the checks say the rest.
const MOST_WORDS: usize = 2;
const MOST_CHARACTERS: usize = 120;

/// The chapters of the task of this index; nothing of a run that has no moment.
pub(super) fn chapters(index: usize, run: &TaskRun, task: &TaskGrade) -> Markup {
    let chapters = panels(run, task, &format!("task-{}-", index + 1));
    html! {
        @if !chapters.is_empty() {
            ol class="chapters" aria-label={ "Moments of " (task.name) } {
                @for (i, chapter) in chapters.iter().enumerate() {
                    li class=[chapter.is_bad.then_some("bad")] {
                        (seek_with(&task.name, chapter.time_s, &html! {
                            (PreEscaped(&chapter.svg))
                            span class="badge" { (i + 1) } " " (seconds(chapter.time_s).replace(' ', "\u{a0}"))
                        }))
                        @for words in chapter.words.iter().take(MOST_WORDS) { p { (prose(&shortened_in_words(words, MOST_CHARACTERS))) } }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;

    #[test]
    fn every_panel_leads_to_its_moment_and_has_names_of_its_own() {
        let graded = sample::graded();
        let task = &graded.grade.tasks[3];
        let [one, other] = [3, 4].map(|i| chapters(i, &graded.runs[0], task).into_string());
        assert_eq!(one.matches("<li").count(), 6);
        assert_eq!(one.matches("<svg").count(), 6);
        assert!(one.contains("href=\"#task=move&amp;t=8\""), "{one}");
        assert!(one.contains("Goal 1 reached"), "its captions");
        let names = |shown: &str| -> Vec<String> {
            let parts = shown.split("<clipPath id=\"").skip(1);
            parts
                .map(|part| part.split('"').next().unwrap().to_owned())
                .collect()
        };
        let (one, other) = (names(&one), names(&other));
        assert!(one.len() == 6 && one.iter().all(|name| !other.contains(name)));
    }

    #[test]
    fn a_run_without_a_tick_has_none() {
        let graded = sample::graded();
        let run = sample::chain(2, 0, |_, _| 0.0);
        assert!(
            chapters(3, &run, &graded.grade.tasks[3])
                .into_string()
                .is_empty()
        );
    }
}
