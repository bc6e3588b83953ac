//! The plots that a brief shows, drawn from runs of the reference solution and of mutants: `plot-PLOT.svg`, `plot-PLOT-by-MUTANT.svg`.

use kinemark_grader::judge::grade;
use kinemark_grader::lab::brief::pictures;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::submission::host::InProcess;
use kinemark_report::plot::{Plot, plots};
use kinemark_sim::text::{Source, suggest};

/// A picture that a brief shows and nobody can draw.
#[derive(Debug, thiserror::Error)]
#[error("the brief shows `{picture}`: {why}")]
pub(crate) struct NoPlot {
    picture: String,
    why: String,
    /// What there is.
    pub(crate) help: String,
}

/// The plots that `brief` shows, by the names of their files, as they are drawn now.
///
/// # Errors
/// [`NoPlot`] where a picture names a plot or a mutant that is not there.
pub(crate) fn brief_plots(
    brief: &str,
    lab: &Lab,
    staff: &Staff,
) -> Result<Vec<(String, String)>, NoPlot> {
    let mut of_reference = None;
    let mut drawn = Vec::new();
    for picture in pictures(brief) {
        let name = picture.strip_prefix("plot-");
        let Some(name) = name.and_then(|rest| rest.strip_suffix(".svg")) else {
            continue;
        };
        if drawn.iter().any(|(known, _)| known == picture) {
            continue;
        }
        let svg = match name.split_once("-by-") {
            None => {
                let drawn = of_reference.get_or_insert_with(|| plots_of(lab, &staff.solution));
                plot(drawn, name, picture)?
            }
            Some((name, mutant)) => {
                let Some(mutant) = staff.mutants.iter().find(|known| known.name == mutant) else {
                    let known = staff.mutants.iter().map(|known| known.name.as_str());
                    return Err(NoPlot {
                        picture: picture.to_owned(),
                        why: format!("no mutant is called `{mutant}`"),
                        help: suggest(mutant, "mutants", known),
                    });
                };
                plot(&plots_of(lab, &mutant.source), name, picture)?
            }
        };
        drawn.push((picture.to_owned(), svg));
    }
    Ok(drawn)
}

/// All plots of a submission of the course staff.
fn plots_of(lab: &Lab, source: &Source) -> Vec<Plot> {
    let graded = grade(lab, None, &source.into(), &mut InProcess);
    // nobody interrupts what runs in this process
    let runs = graded
        .map(|GradedRun { runs, .. }| runs)
        .unwrap_or_default();
    runs.iter().flat_map(plots).collect()
}

fn plot(all: &[Plot], name: &str, picture: &str) -> Result<String, NoPlot> {
    let Some(found) = all.iter().find(|plot| plot.name == name) else {
        let known = all.iter().map(|plot| plot.name.as_str());
        return Err(NoPlot {
            picture: picture.to_owned(),
            why: format!("no plot is called `{name}`"),
            help: suggest(name, "plots", known),
        });
    };
    Ok(found.svg.clone())
}
