//! From a lab and a submission to a graded run: every task in order, its checks, its diagnoses, the record.

use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::robot::Dimension;
use kinemark_sim::source::Source;
use kinemark_sim::trace::Trace;

use crate::cases::{self, CasesRun};
use crate::check::function_cases::{as_slice, written};
use crate::check::{self, Answered, CaseError, CaseFacts, Climb, Finding, MotionFacts, stay};
use crate::climb::{self, Undecided};
use crate::controller::{Controller, Granted, Opening, Stop, Value};
use crate::diagnose;
use crate::divergence;
use crate::event_words::Names;
use crate::grade::{
    CaseGrade, CheckGrade, Diagnosis, Digests, FORMAT, Grade, GradeMode, HiddenClass, LogEntry,
    Outcome, ParameterValue, Part, RungDigest, SecondDigests, Stopped, TaskGrade, TaskKind,
    VariantRecord,
};
use crate::graded::{AskedPath, Goal, GradedRun, TaskRun, TcpPath};
use crate::hidden_runs::HiddenRuns;
use crate::lab::model::{
    Band, Case, Check, CheckKind, Function, FunctionTask, Given, Lab, MotionTask, Task, TaskWork,
};
use crate::lab::{LabRobot, MeshFile, Staff, staff::Mutant, watched::PathToFollow};
use crate::motion::{self, EarlyEnd, MotionRun, Session};
use crate::quantity::{list, lists};
use crate::stopped;
use crate::submission::ScriptController;
use crate::verdict::Verdict;

/// Lines of a submission's output that the record keeps.
const MOST_LOG_LINES: usize = 200;

/// Opens a submission for a task: in this process, or in a worker.
pub trait Host {
    /// Starts the submission of `opening`.
    ///
    /// # Errors
    /// [`Stop`] if it cannot start.
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Stop>;

    /// A task begins; for whoever shows progress.
    fn begins(&mut self, _task: &str) {}
}

/// Runs submissions in this process.
#[derive(Debug, Default)]
pub struct InProcess;

impl Host for InProcess {
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Stop> {
        Ok(Box::new(ScriptController::open(opening)?))
    }
}

/// The person at the terminal asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("interrupted")]
pub struct Interrupted;

/// Grades `submission` in `lab`; with `staff`, on hidden cases too, and with diagnoses.
///
/// # Errors
/// [`Interrupted`] if the host says so; nothing else stops a grade.
pub fn grade(
    lab: &Lab,
    staff: Option<&Staff>,
    submission: &Source,
    host: &mut dyn Host,
) -> Result<GradedRun, Interrupted> {
    let mut grader = Grader {
        lab,
        staff,
        submission,
        right: Vec::new(),
    };
    let mut tasks = Vec::new();
    let mut runs = Vec::new();
    for task in &lab.tasks {
        host.begins(&task.title);
        let (grade, run) = match &task.work {
            TaskWork::Function(function) => (grader.function(task, function, host)?, None),
            TaskWork::Motion(motion) => {
                let (grade, run) = grader.motion(task, motion, host)?;
                (grade, Some(run))
            }
        };
        if run.is_none() && grade.verdict == Verdict::Passed {
            grader.right.push(task.name.clone());
        }
        tasks.push(grade);
        runs.extend(run);
    }
    let digest = |text: &str| blake3::hash(text.as_bytes()).to_hex().to_string();
    let verdicts = tasks.iter().map(|task| task.verdict);
    let grade = Grade {
        format: FORMAT.to_owned(),
        engine: engine(),
        mode: if staff.is_some() {
            GradeMode::Graded
        } else {
            GradeMode::Practice
        },
        lab: Part {
            name: lab.name.clone(),
            digest: digest(&format!(
                "{}\n{}{}",
                lab.source.text(),
                lab.reference_paths.text,
                lab.variant
                    .as_ref()
                    .map_or(String::new(), |variant| format!("\n{}", variant.numbers()))
            )),
        },
        variant: variant_record(lab),
        robot: Part {
            name: lab.robot.name().to_owned(),
            digest: LabRobot::digest(&lab.robot_file, &lab.robot_meshes)
                .to_hex()
                .to_string(),
        },
        scenes: lab
            .scenes
            .iter()
            .map(|scene| Part {
                name: scene.name.clone(),
                digest: scene.digest().to_hex().to_string(),
            })
            // one file, whatever its dimensions
            .fold(Vec::new(), |mut scenes, scene| {
                if !scenes.contains(&scene) {
                    scenes.push(scene);
                }
                scenes
            }),
        submission: Part {
            name: submission.name().to_owned(),
            digest: digest(submission.text()),
        },
        reference: staff.map(|staff| Part {
            name: lab.name.clone(),
            digest: staff.digest.to_hex().to_string(),
        }),
        verdict: verdicts.min().unwrap_or(Verdict::Passed),
        points: tasks.iter().map(|task| task.points).sum(),
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        tasks,
    };
    Ok(GradedRun { grade, runs })
}

fn variant_record(lab: &Lab) -> Option<VariantRecord> {
    let variant = lab.variant.as_ref()?;
    let parameters = lab.parameters.iter().map(|(name, value)| {
        let value = match value {
            Dimension::Number(number) => ParameterValue::Number(*number),
            Dimension::List(numbers) => ParameterValue::List(numbers.clone()),
        };
        (name.to_owned(), value)
    });
    Some(VariantRecord {
        student: variant.student().map(str::to_owned),
        parameters: parameters.collect(),
    })
}

/// The engine and its version, as in grade records and logs.
pub fn engine() -> String {
    format!("kinemark {}", env!("CARGO_PKG_VERSION"))
}

/// What a task grants, with what the robot's model is made from; none where it grants nothing.
pub fn granted(lab: &Lab, work: &TaskWork) -> Option<Granted> {
    let (functions, gravity_m_s2) = match work {
        TaskWork::Function(function) => (&function.grants, GRAVITY_M_S2),
        TaskWork::Motion(motion) => (&motion.grants, motion.gravity_m_s2),
    };
    let source = lab.robot_file.source();
    let mesh = |mesh: &MeshFile| {
        let name = mesh.path.strip_prefix("robots/").unwrap_or(&mesh.path);
        (name.to_owned(), mesh.bytes.clone())
    };
    (!functions.is_empty()).then(|| Granted {
        functions: functions.clone(),
        robot_path: source.name().to_owned(),
        robot_text: source.text().to_owned(),
        meshes: lab.robot_meshes.iter().map(mesh).collect(),
        frame: lab.frame.clone(),
        gravity_m_s2: gravity_m_s2.into(),
    })
}

/// What `solution` answers to `cases` of a function of the lab's own, in this process.
///
/// # Errors
/// Why it has no answer, in words.
pub fn answers(
    lab: &Lab,
    task: &Task,
    function: &Function,
    cases: &[Case],
    solution: &Source,
) -> Result<Vec<Value>, String> {
    let grader = Grader {
        lab,
        staff: None,
        submission: solution,
        right: Vec::new(),
    };
    let opening = grader.opening(task, solution);
    cases::answers(function, cases, &opening)
        .map_err(|stop| stopped::record(&stop, solution.text()).message)
}

/// What a submission is opened with for `task` of `lab`.
pub(crate) fn opening(lab: &Lab, task: &Task, submission: &Source) -> Opening {
    let (robot, target, sensors) = match &task.work {
        TaskWork::Function(_) => (
            cases::robot_facts(&lab.robot, None),
            Value::Nothing,
            Vec::new(),
        ),
        TaskWork::Motion(motion) => (
            motion::facts_of(lab, motion),
            motion::target_of(motion),
            motion::sensors_of(motion),
        ),
    };
    Opening {
        file: submission.name().to_owned(),
        source: submission.text().to_owned(),
        task: task.name.clone(),
        robot,
        target,
        sensors,
        budgets: lab.budgets.clone(),
        granted: granted(lab, &task.work),
        function: match &task.work {
            TaskWork::Function(FunctionTask {
                function: Function::Free(name),
                ..
            }) => Some(name.clone()),
            _ => None,
        },
    }
}

struct Grader<'a> {
    lab: &'a Lab,
    staff: Option<&'a Staff>,
    submission: &'a Source,
    /// Function tasks so far whose every answer is right.
    right: Vec<String>,
}

impl Grader<'_> {
    fn opening(&self, task: &Task, submission: &Source) -> Opening {
        opening(self.lab, task, submission)
    }

    /// The known mistakes that a task may show: none that a function would show, too, which is right.
    fn mutants_of(&self, task: &Task) -> impl Iterator<Item = &Mutant> {
        let all = self.staff.map_or(&[][..], |staff| &staff.mutants);
        let name = task.name.clone();
        all.iter().filter(move |mutant| {
            let is_refuted = mutant.tasks.iter().any(|task| self.right.contains(task));
            mutant.tasks.contains(&name) && !is_refuted
        })
    }

    fn function(
        &self,
        task: &Task,
        work: &FunctionTask,
        host: &mut dyn Host,
    ) -> Result<TaskGrade, Interrupted> {
        let mut all: Vec<Case> = work.cases.clone();
        // with a staff's part that hides cases of this task
        let hiding = self
            .staff
            .filter(|staff| !staff.hidden(&task.name).is_empty());
        all.extend_from_slice(hiding.map_or(&[], |staff| staff.hidden(&task.name)));
        let opening = self.opening(task, self.submission);
        let run = cases::run(self.lab, &work.function, &all, &opening, host);
        let mut stopped_record = None;
        let mut verdict = Verdict::Passed;
        if let Some((case, stop)) = &run.stop {
            verdict = stopped::verdict(stop).ok_or(Interrupted)?;
            let mut record = stopped::record(stop, self.submission.text());
            let facts = &run.facts[*case];
            if stopped::is_of_one_call(stop) {
                record.case = Some(facts.told().to_owned());
                if !facts.is_visible() {
                    // the words of the submission could tell the numbers of a hidden case
                    record.message = "the submission failed in a hidden case".to_owned();
                    record.help = None;
                    // nor may the line that fails: a ladder of comparisons would count a number out
                    (record.line, record.column, record.source_line) = (None, None, None);
                }
            }
            stopped_record = Some(record);
        }
        let could_run = !matches!(
            run.stop,
            Some((_, Stop::Missing { .. } | Stop::DidNotBuild(_)))
        );
        let checks = judged(&task.checks, could_run && verdict.is_decided(), |check| {
            check::judge_function(check, &work.function, &run.facts)
        });
        let checks: Vec<CheckGrade> = checks.into_iter().map(|(check, _)| check).collect();
        let invalid = run.facts.iter().find_map(|facts| match &facts.answer {
            Answered::Invalid(what) if facts.is_visible() => Some((facts.told(), what.clone())),
            Answered::Invalid(_) => Some((
                facts.told(),
                "an answer of the wrong shape, or not finite, in a hidden case".to_owned(),
            )),
            Answered::Position(_)
            | Answered::Branches(_)
            | Answered::Matrix(_)
            | Answered::Entries(_)
            | Answered::Stopped => None,
        });
        let invalid = invalid.map(|(case, what)| (case.to_owned(), what));
        if let (Some((case, what)), None) = (invalid, &stopped_record) {
            verdict = verdict.min(Verdict::InvalidOutput);
            stopped_record = Some(Stopped {
                help: not_finite_help(&what),
                message: what,
                line: None,
                column: None,
                source_line: None,
                tick: None,
                time_s: None,
                case: Some(case),
            });
        }
        if checks.iter().any(|check| check.outcome != Outcome::Full) {
            verdict = verdict.min(Verdict::Missed);
        }
        let diagnoses = if verdict == Verdict::Passed || !verdict.is_decided() {
            Vec::new()
        } else {
            self.function_diagnoses(task, &work.function, &all, &run)
        };
        let explained = stopped_record.is_some() || !diagnoses.is_empty();
        let checks = without_hints(checks, explained);
        let good = good_bands(&task.checks);
        Ok(TaskGrade {
            name: task.name.clone(),
            title: task.title.clone(),
            kind: TaskKind::Function,
            verdict,
            points: checks.iter().map(|check| check.points).sum(),
            max_points: task.max_points(),
            stopped: stopped_record,
            checks,
            diagnoses,
            cases: run
                .facts
                .iter()
                .filter(|facts| facts.is_visible())
                .map(|facts| case_grade(self.lab, facts, good))
                .collect(),
            hidden: hidden_classes(&run.facts, good),
            events: Vec::new(),
            contacts: Vec::new(),
            operations: run.operations,
            log: run.log.into_iter().take(MOST_LOG_LINES).collect(),
            digests: Digests {
                all: hiding
                    .map_or(run.digest, |staff| staff.keyed(run.digest))
                    .to_hex()
                    .to_string(),
                seconds: Vec::new(),
                rungs: Vec::new(),
            },
            divergence: None,
        })
    }

    fn function_diagnoses(
        &self,
        task: &Task,
        function: &Function,
        all: &[Case],
        student: &CasesRun<'_>,
    ) -> Vec<Diagnosis> {
        let mutants = self.mutants_of(task).map(|mutant| {
            let opening = self.opening(task, &mutant.source);
            let run = cases::run(self.lab, function, all, &opening, &mut InProcess);
            (mutant, run.facts)
        });
        // mutants outlive the closure's borrow only if collected
        let answers: Vec<(&Mutant, Vec<CaseFacts<'_>>)> = mutants.collect();
        diagnose::function_task(
            &student.facts,
            answers.into_iter(),
            good_bands(&task.checks),
        )
    }

    fn motion(
        &self,
        task: &Task,
        work: &MotionTask,
        host: &mut dyn Host,
    ) -> Result<(TaskGrade, TaskRun), Interrupted> {
        let opening = self.opening(task, self.submission);
        let MotionRun {
            trace,
            ended,
            operations,
        } = motion::run(self.lab, work, &opening, host);
        let names = Names {
            robot: &self.lab.robot,
            scene: work.scene.as_ref().map(|scene| &scene.scene),
            seen_from: &self.lab.frame,
        };
        let mut verdict = Verdict::Passed;
        let mut stopped_record = None;
        if let Some((tick, why)) = &ended {
            let mut record = match why {
                EarlyEnd::Stopped(stop) => {
                    verdict = stopped::verdict(stop).ok_or(Interrupted)?;
                    stopped::record(stop, self.submission.text())
                }
                EarlyEnd::InvalidOutput(what) => {
                    verdict = Verdict::InvalidOutput;
                    said(what.clone(), not_finite_help(what))
                }
                EarlyEnd::Diverged { what, cause } => {
                    verdict = Verdict::Missed;
                    let (message, help) = names.blow_up(what, cause.as_ref(), work);
                    said(message, Some(help))
                }
            };
            let of_whole_file =
                matches!(why, EarlyEnd::Stopped(stop) if !stopped::is_of_one_call(stop));
            if !of_whole_file {
                record.tick = Some(*tick);
                record.time_s = Some(work.periods.time_s(*tick));
            }
            stopped_record = Some(record);
        }
        let band = pose_band(&task.checks);
        let reference = self.reference_path(&task.name);
        let mut facts = MotionFacts {
            robot: &self.lab.robot,
            names,
            motion: work,
            trace: &trace,
            stays: stay::best_stays(&trace, &work.goals, band),
            pose_band: band,
            reference,
            climbs: Vec::new(),
        };
        let mut can_be_judged = ended.is_none();
        if can_be_judged {
            match climb::climbs(self.lab, task, work, &opening, &facts, host) {
                Ok(climbs) => facts.climbs = climbs,
                Err(Undecided(stop)) => {
                    // a rung that this machine could not run decides nothing, nor does the grade without it
                    can_be_judged = false;
                    verdict = stopped::verdict(&stop).ok_or(Interrupted)?;
                    stopped_record = Some(stopped::record(&stop, self.submission.text()));
                }
            }
        }
        let judged = judged(&task.checks, can_be_judged, |check| {
            check::judge_motion(check, &facts)
        });
        let stays = facts.stays;
        let rungs = rung_digests(task, &facts.climbs);
        let mut checks = Vec::new();
        let mut curves = Vec::new();
        for (check, curve) in judged {
            checks.push(check);
            curves.extend(curve);
        }
        if checks.iter().any(|check| check.outcome != Outcome::Full) {
            verdict = verdict.min(Verdict::Missed);
        }
        let ran_away = matches!(ended, Some((_, EarlyEnd::Diverged { .. })));
        let compares = verdict == Verdict::Missed && (ended.is_none() || ran_away);
        let solution = compares.then(|| self.solution_run(task, work)).flatten();
        let differs = match (&solution, self.staff) {
            _ if !compares => None,
            (Some(solution), _) => {
                divergence::from_run(&trace, solution, &self.lab.robot, &work.periods)
            }
            (None, Some(_)) => None,
            (None, None) => {
                reference.and_then(|path| divergence::from_path(&trace, path, &work.periods))
            }
        };
        let diagnoses = if !compares {
            Vec::new()
        } else if work.goals.is_empty() {
            solution.as_ref().map_or_else(Vec::new, |solution| {
                let compared = diagnose::Compared {
                    student: &trace,
                    ended: ended.as_ref(),
                    reference: solution,
                    periods: work.periods,
                };
                let mutants = self.mutants_of(task).filter_map(|mutant| {
                    let opening = self.opening(task, &mutant.source);
                    let session = Session::open(self.lab, work, &opening, &mut InProcess);
                    Some((mutant, session.ok()?))
                });
                diagnose::whole_run(compared, mutants)
            })
        } else if ended.is_none() {
            let mutants = self.mutants_of(task).map(|mutant| {
                let opening = self.opening(task, &mutant.source);
                (
                    mutant,
                    motion::run(self.lab, work, &opening, &mut InProcess).trace,
                )
            });
            diagnose::motion_task(work, band, &trace, mutants)
        } else {
            Vec::new()
        };
        let explained = !diagnoses.is_empty();
        let digest = trace.digest();
        let mut all_digest = digest.all;
        let mut hidden = Vec::new();
        if ended.is_none() {
            let runs = self
                .staff
                .map_or(Vec::new(), |staff| staff.runs(&task.name));
            let seen = HiddenRuns::run(&runs, &task.name, self.submission, host)?;
            if let Some(staff) = self.staff.filter(|_| !runs.is_empty()) {
                all_digest = staff.keyed(seen.digest(all_digest));
            }
            seen.count_in(&mut checks, &task.checks);
            hidden = seen.classes();
            if checks.iter().any(|check| check.outcome != Outcome::Full) {
                verdict = verdict.min(Verdict::Missed);
            }
            if let Some((worst, record)) = seen.into_stopped() {
                verdict = verdict.min(worst);
                stopped_record = Some(record);
            }
        }
        let checks = without_hints(checks, explained);
        let grade = TaskGrade {
            name: task.name.clone(),
            title: task.title.clone(),
            kind: TaskKind::Motion,
            verdict,
            points: checks.iter().map(|check| check.points).sum(),
            max_points: task.max_points(),
            stopped: stopped_record,
            checks,
            diagnoses,
            cases: Vec::new(),
            hidden,
            events: names.events(&trace, &work.periods),
            contacts: names.contacts(&trace),
            operations,
            log: trace
                .log
                .iter()
                .take(MOST_LOG_LINES)
                .map(|line| LogEntry {
                    at: line.tick,
                    text: line.text.clone(),
                })
                .collect(),
            digests: Digests {
                all: all_digest.to_hex().to_string(),
                seconds: digest
                    .seconds
                    .iter()
                    .map(|second| {
                        let signal = |i: usize| second.signals[i].to_hex()[..16].to_owned();
                        SecondDigests {
                            q: signal(0),
                            qd: signal(1),
                            command: signal(2),
                            effort: signal(3),
                            tcp: signal(4),
                            bodies: (trace.bodies.width() > 0).then(|| signal(5)),
                            sensors: (trace.sensors.width() > 0).then(|| signal(6)),
                        }
                    })
                    .collect(),
                rungs,
            },
            divergence: differs.clone(),
        };
        let goals = work.goals.iter().enumerate().map(|(i, goal)| Goal {
            position_m: goal.position_m.into(),
            dwell_s: work.periods.time_s(goal.dwell_ticks),
            full_m: band.full,
            zero_m: band.zero,
            stay: stays
                .get(i)
                .map(|stay| (stay.first as u64, stay.last as u64)),
        });
        let run = TaskRun {
            task: task.name.clone(),
            robot: self.lab.robot.clone(),
            scene: work.scene.clone(),
            sensors: work.sensors.clone(),
            seen_from: self.lab.frame.clone(),
            mode: work.servo.mode,
            effort_limits: work.servo.gains.iter().map(|g| g.effort_limit).collect(),
            goals: goals.collect(),
            reference_tcp: reference.cloned(),
            paths: work
                .paths
                .iter()
                .map(|path| asked(path, &task.checks))
                .collect(),
            curves,
            divergence: differs,
            trace,
        };
        Ok((grade, run))
    }

    /// The reference solution's run of a task, with the staff's part and if it comes to its end.
    fn solution_run(&self, task: &Task, work: &MotionTask) -> Option<Trace> {
        let opening = self.opening(task, &self.staff?.solution);
        let run = motion::run(self.lab, work, &opening, &mut InProcess);
        run.ended.is_none().then_some(run.trace)
    }

    fn reference_path(&self, task: &str) -> Option<&TcpPath> {
        let mut paths = self.lab.reference_paths.paths.iter();
        paths.find(|(name, _)| name == task).map(|(_, path)| path)
    }
}

/// Identities of the runs of all rungs, in the lab's order.
fn rung_digests(task: &Task, climbs: &[Climb]) -> Vec<RungDigest> {
    let mut digests = Vec::new();
    for climb in climbs {
        let check = task.checks.iter().find(|check| check.name == climb.check);
        let Some(CheckKind::Robustness(ladder)) = check.map(|check| &check.kind) else {
            continue;
        };
        for (rung, facts) in ladder.rungs.iter().zip(&climb.rungs) {
            digests.push(RungDigest {
                check: climb.check.clone(),
                rung: rung.name.clone(),
                digest: facts.digest.clone(),
            });
        }
    }
    digests
}

/// A path as the plots draw it, with the band of the first check that measures the distance from it.
fn asked(path: &PathToFollow, checks: &[Check]) -> AskedPath {
    let band = checks.iter().find_map(|check| match &check.kind {
        CheckKind::PathDeviation { path: of, band, .. } if of.name == path.name => Some(*band),
        _ => None,
    });
    AskedPath {
        name: path.name.clone(),
        points_m: path.points_m.iter().map(|p| (*p).into()).collect(),
        tube_m: band.map(|band| [band.full, band.zero]),
    }
}

/// Where a stop or a diagnosis explains the loss, a check's general hint would read as another one.
fn without_hints(mut checks: Vec<CheckGrade>, explained: bool) -> Vec<CheckGrade> {
    for check in &mut checks {
        if explained && check.outcome != Outcome::NotJudged {
            check.next_step = None;
        }
    }
    checks
}

/// Where numbers that are not finite come from.
fn not_finite_help(message: &str) -> Option<String> {
    let shown = message.contains("NaN") || message.contains("infinity");
    shown.then(|| {
        "NaN comes from `acos` or `sqrt` of a number outside their range and from 0 / 0, infinity from a division by zero".to_owned()
    })
}

fn said(message: String, help: Option<String>) -> Stopped {
    Stopped {
        message,
        help,
        line: None,
        column: None,
        source_line: None,
        tick: None,
        time_s: None,
        case: None,
    }
}

/// Judges the checks in order; one whose needs earned nothing, or of a task that cannot be judged, earns nothing itself.
pub(crate) fn judged(
    checks: &[Check],
    can_be_judged: bool,
    judge: impl Fn(&Check) -> Finding,
) -> Vec<(CheckGrade, Option<crate::graded::Curve>)> {
    let mut grades: Vec<(CheckGrade, Option<crate::graded::Curve>)> = Vec::new();
    for check in checks {
        let mut grade = CheckGrade {
            name: check.name.clone(),
            title: check.title.clone(),
            outcome: Outcome::NotJudged,
            points: 0.0,
            max_points: check.points,
            measure: None,
            evidence: Vec::new(),
            next_step: None,
        };
        let mut curve = None;
        let missing = check
            .needs
            .iter()
            .find(|&&need| grades[need].0.points <= 0.0);
        match (can_be_judged, missing) {
            (false, _) => {}
            (true, Some(&need)) => {
                grade.next_step = Some(format!(
                    "First earn something in \"{}\".",
                    checks[need].title
                ));
            }
            (true, None) => {
                let mut finding = judge(check);
                // a trace of a point would be shown as none
                if finding.score < 1e-6 {
                    finding.score = 0.0;
                }
                grade.outcome = if finding.score >= 1.0 {
                    Outcome::Full
                } else if finding.score > 0.0 {
                    Outcome::Partial
                } else {
                    Outcome::None
                };
                grade.points = check.points * finding.score.clamp(0.0, 1.0);
                grade.measure = finding.measure;
                if grade.outcome != Outcome::Full {
                    grade.evidence = finding.evidence;
                    let hint = check.hint.clone().filter(|_| !finding.insists);
                    grade.next_step = Some(hint.unwrap_or(finding.next_step));
                }
                curve = finding.curve;
            }
        }
        grades.push((grade, curve));
    }
    grades
}

/// The band of distances, or of relative ones, by which a function task's single answers are called good or wrong.
fn good_bands(checks: &[Check]) -> Band {
    let found = checks.iter().find_map(|check| match &check.kind {
        CheckKind::FkError(band)
        | CheckKind::IkReach(band)
        | CheckKind::JacobianMatch(band)
        | CheckKind::FunctionCases { band, .. } => Some(*band),
        _ => None,
    });
    found.unwrap_or(Band {
        full: 1e-3,
        zero: 1e-2,
    })
}

/// The band by which stays are chosen.
pub(crate) fn pose_band(checks: &[Check]) -> Band {
    let found = checks.iter().find_map(|check| match &check.kind {
        CheckKind::PoseReached(band) => Some(*band),
        _ => None,
    });
    found.unwrap_or(Band {
        full: 0.002,
        zero: 0.02,
    })
}

fn is_good(facts: &CaseFacts<'_>, band: Band) -> bool {
    match &facts.error {
        CaseError::Position(error_m) => *error_m <= band.full,
        CaseError::Reach { branches_m, .. } => branches_m
            .first()
            .is_some_and(|error_m| *error_m <= band.full),
        CaseError::Unreachable { said_so } => *said_so,
        CaseError::Jacobian { relative, .. } => *relative <= band.full,
        CaseError::Entries(relative) => relative.iter().all(|relative| *relative <= band.full),
    }
}

fn case_grade(lab: &Lab, facts: &CaseFacts<'_>, band: Band) -> CaseGrade {
    let (given, expected) = match &facts.case.given {
        Given::Q(q) => {
            let truth = match &facts.error {
                CaseError::Jacobian { truth, .. } => Some(lists(truth)),
                _ => cases::tcp_in_lab(lab, &facts.robot, q)
                    .map(|p| format!("{} m", list(p.as_slice()))),
            };
            (format!("q = {} rad", list(q)), truth)
        }
        Given::Position {
            position_m,
            branches,
        } => (
            format!("position = {} m", list(position_m)),
            // the angles would be the answer of the task itself
            (*branches == 0).then(|| "[] (out of reach)".to_owned()),
        ),
        Given::Values { given, expected } => (entries(given), Some(entries(expected))),
    };
    let changed = facts.case.dimensions.iter().map(|(name, dimension)| {
        let value = match dimension {
            kinemark_sim::robot::Dimension::Number(number) => crate::quantity::trimmed(*number, 4),
            kinemark_sim::robot::Dimension::List(numbers) => list(numbers),
        };
        format!(", {name} = {value}")
    });
    let error_m = match &facts.error {
        CaseError::Position(error_m) => Some(*error_m),
        CaseError::Reach { branches_m, .. } => branches_m.first().copied(),
        CaseError::Unreachable { .. } | CaseError::Jacobian { .. } | CaseError::Entries(_) => None,
    };
    let relative_error = match &facts.error {
        CaseError::Jacobian { relative, .. } => Some(*relative),
        CaseError::Entries(relative) => relative.iter().copied().max_by(f64::total_cmp),
        _ => None,
    };
    CaseGrade {
        name: facts.case.name.clone(),
        given: given + changed.collect::<String>().as_str(),
        answer: match &facts.answer {
            Answered::Position(p) => format!("{} m", list(p.as_slice())),
            Answered::Branches(rows) | Answered::Matrix(rows) => lists(rows),
            Answered::Entries(answer) => match &facts.case.given {
                Given::Values { expected, .. } => named(
                    expected
                        .iter()
                        .zip(answer)
                        .map(|((name, _), numbers)| (name.as_str(), numbers.as_slice())),
                ),
                _ => lists(answer),
            },
            Answered::Invalid(what) => what.clone(),
            Answered::Stopped => "no answer".to_owned(),
        },
        expected,
        error_m: error_m.filter(|error_m| error_m.is_finite()),
        relative_error: relative_error.filter(|relative| relative.is_finite()),
        good: is_good(facts, band),
    }
}

/// Entries as people read them: `kp = 100, inertia = 0.1668`.
fn entries(entries: &[(String, kinemark_sim::robot::Dimension)]) -> String {
    named(
        entries
            .iter()
            .map(|(name, value)| (name.as_str(), as_slice(value))),
    )
}

fn named<'e>(entries: impl Iterator<Item = (&'e str, &'e [f64])>) -> String {
    let texts: Vec<String> = entries
        .map(|(name, numbers)| match name {
            "" => written(numbers, 6),
            name => format!("{name} = {}", written(numbers, 6)),
        })
        .collect();
    texts.join(", ")
}

fn hidden_classes(facts: &[CaseFacts<'_>], band: Band) -> Vec<HiddenClass> {
    let mut classes: Vec<HiddenClass> = Vec::new();
    for facts in facts {
        let Some(class) = &facts.case.hidden_class else {
            continue;
        };
        let good = u32::from(is_good(facts, band));
        match classes.iter_mut().find(|known| known.class == *class) {
            Some(known) => {
                known.good += good;
                known.total += 1;
            }
            None => classes.push(HiddenClass {
                class: class.clone(),
                good,
                total: 1,
            }),
        }
    }
    classes
}
