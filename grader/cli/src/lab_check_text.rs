//! What `lab check` tried, as a text for a terminal.

use std::fmt::Write as _;

use kinemark_grader::audit::{Audit, BandValues, Reached, Row, Tried};
use kinemark_grader::record::quantity::{points, with_unit};
use owo_colors::OwoColorize as _;

/// A line for everything tried, with what is wrong below it.
pub(crate) fn text(audit: &Audit) -> String {
    let mut out = format!(
        "{}  {} points\n\n",
        audit.lab.bold(),
        points(audit.max_points)
    );
    let rows = &audit.rows;
    let is_known = |i: usize| {
        let is_same =
            |known: &Row| known.tried == rows[i].tried && known.problem == rows[i].problem;
        rows[i].problem.is_some() && rows[..i].iter().any(is_same)
    };
    for (i, row) in rows.iter().enumerate() {
        push(&mut out, row, is_known(i));
        // of problems that are mended together it is said once, after the last, what to do
        let goes_on = rows.get(i + 1).is_some_and(|next| {
            let is_mended_together = (row.tried, &row.name, &row.task, &row.help)
                == (next.tried, &next.name, &next.task, &next.help);
            is_mended_together && !is_known(i + 1)
        });
        if let Some(help) = row.help.as_ref().filter(|_| !is_known(i) && !goes_on) {
            let _ = writeln!(out, "    {} {help}", "next:".cyan());
        }
    }
    push_bands(&mut out, audit);
    push_difficulty(&mut out, audit);
    push_relative(&mut out, audit);
    if !audit.left_out.is_empty() {
        let _ = writeln!(
            out,
            "\nnot looked at (--quick): {}",
            audit.left_out.join("; ")
        );
    }
    let problems = audit.problems().count();
    let conclusion = match problems {
        0 => "nothing is wrong".green().to_string(),
        1 => "1 problem".red().to_string(),
        _ => format!("{problems} problems").red().to_string(),
    };
    let _ = writeln!(out, "\n{} tried, {conclusion}", audit.rows.len());
    out
}

/// Beside each band what the reference solution and the mutants reach in it.
fn push_bands(out: &mut String, audit: &Audit) {
    if audit.bands.is_empty() {
        return;
    }
    let variants = audit
        .difficulty
        .as_ref()
        .map_or(0, |all| all.variants.len());
    let _ = writeln!(
        out,
        "\nbands: all points up to, none from; the worst value of the reference solution over the lab's own numbers and {variants} variants; \
         the mutant whose value loses here with the least loss (margins: 0 % at the edge of full marks, 100 % a band's width inside, -100 % where \
         nothing is earned)"
    );
    for band in &audit.bands {
        let name = format!("{}/{}", band.task, band.check);
        let edges = [band.full, band.zero].map(|end| with_unit(end, &band.unit));
        let _ = writeln!(out, "  {name:<32} {:<22} {}", edges.join(", "), band.title);
        if let Some(worst) = band.worst() {
            let whose = match &worst.of[..] {
                "" => "the lab's own numbers".to_owned(),
                student => format!("variant of `{student}`"),
            };
            let spread = match band.reference.len() {
                0 | 1 => String::new(),
                _ => format!(", {:.1} % apart over all", 100.0 * band.spread()),
            };
            let _ = writeln!(
                out,
                "      reference  {}  {whose}{spread}",
                reached(band, worst)
            );
        }
        match band.nearest_mutant() {
            Some(nearest) => {
                let losing = band.mutants.iter().filter(|mutant| mutant.loses).count();
                let _ = writeln!(
                    out,
                    "      mutant     {}  `{}`, of {losing} that lose here",
                    reached(band, nearest),
                    nearest.of
                );
            }
            None => {
                let _ = writeln!(out, "      mutant     no value loses here");
            }
        }
    }
}

/// A value with its margin.
fn reached(band: &BandValues, reached: &Reached) -> String {
    let value = with_unit(reached.value, &band.unit);
    format!("{value:<14} {:>8.1} %", 100.0 * reached.margin)
}

/// Below this share of a band nobody calls one variant harder than another.
const ALIKE: f64 = 0.0005;

/// How much the difficulty differs between variants.
fn push_difficulty(out: &mut String, audit: &Audit) {
    let Some(difficulty) = &audit.difficulty else {
        return;
    };
    if difficulty.spread < ALIKE {
        let count = difficulty.variants.len();
        let _ = writeln!(out, "\n{count} variants are as hard as each other");
        return;
    }
    let _ = writeln!(
        out,
        "\ndifficulty of {} variants, by the margins of the reference solution\n  differs most in {}/{}: {:.1} % of the band's width between \
         `{}` (least) and `{}`",
        difficulty.variants.len(),
        difficulty.task,
        difficulty.check,
        100.0 * difficulty.spread,
        difficulty.hardest_there,
        difficulty.easiest_there
    );
    for (word, variant) in [
        ("hardest", difficulty.hardest()),
        ("easiest", difficulty.easiest()),
    ] {
        let Some(variant) = variant else { continue };
        let _ = writeln!(
            out,
            "  {word}: `{}` ({}), {:+.1} % of a band on the mean, {:+.1} % in {}",
            variant.student,
            variant.numbers,
            100.0 * variant.harder,
            100.0 * variant.most,
            variant.most_in
        );
    }
}

/// The bands that depend on the reference, as the numbers that they are in the variants.
fn push_relative(out: &mut String, audit: &Audit) {
    let relative = audit.rooms.iter();
    let mut relative = relative
        .filter_map(|room| Some((room, room.relative.as_ref()?)))
        .peekable();
    if relative.peek().is_none() {
        return;
    }
    let _ = writeln!(
        out,
        "\nbands that depend on the reference, over the variants (what it reaches; all points up to; none from)"
    );
    for (room, band) in relative {
        let name = format!("{}: {}", room.task, room.check);
        let range = |[low, high]: [f64; 2]| {
            let [low, high] = [low, high].map(|end| with_unit(end, &band.unit));
            if low == high {
                low
            } else {
                format!("{low} to {high}")
            }
        };
        let _ = writeln!(
            out,
            "  {name:<32} {:<22} {:<22} {}",
            range(band.reference),
            range(band.full),
            range(band.zero)
        );
    }
}

/// `is_known`: a row before has the same problem, which is not said again.
fn push(out: &mut String, row: &Row, is_known: bool) {
    let mark = if row.problem.is_some() {
        "-".red().to_string()
    } else {
        "+".green().to_string()
    };
    let earned = match (row.points, row.max_points) {
        (Some(earned), Some(of)) => format!("{}/{}", points(earned), points(of)),
        _ => String::new(),
    };
    let task = row.task.as_deref().unwrap_or_default();
    let right = match row.tried {
        Tried::Brief => "can be handed out",
        Tried::Starter if row.name.is_empty() => "misses",
        Tried::Starter => "defines what its tasks call",
        Tried::Reference => "full marks",
        Tried::Practice => "is what the reference solution gives",
        Tried::Mutants => "enough of them",
        Tried::Mutant => "is caught",
        Tried::Rubric => Audit::rule_in_words(&row.name),
    };
    let comment = match row.problem {
        None => right,
        Some(_) if is_known => "as above",
        Some(_) => "",
    };
    let line = format!(
        "{mark} {:<14} {:<26} {task:<12} {earned:>9}  {comment}",
        row.tried.name(),
        row.name
    );
    let _ = writeln!(out, "{}", line.trim_end());
    if is_known {
        return;
    }
    if let Some(problem) = &row.problem {
        let _ = writeln!(out, "    {problem}");
    }
}
