//! From the texts of a lab to a [`Lab`]: names become indices, bands are ordered, periods divide; what cannot hold is an error
//! with its place.

use std::collections::BTreeMap;
use std::ops::Range;

use kinemark_sim::control::servo::Servo;
use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::robot::{Robot, RobotFile};
use kinemark_sim::source::{Source, TomlRefusal, suggest};
use kinemark_sim::ticks::{Periods, whole_ratio};
use nalgebra::Vector3;
use serde::de::DeserializeOwned;
use toml::Spanned;

use super::file::{
    BandM, BandS, BudgetTable, CaseTable, CheckTable, DerivativeName, FunctionName, FunctionTable,
    LabTable, ModeName, MotionTable, NumberAt, PerJoint, ServoTable, SpanName, TaskTable,
};
use super::files::Files;
use super::model::{
    Band, Case, Check, CheckKind, Function, FunctionTask, Given, Lab, MatchSpan, MotionGoal,
    MotionTask, ReferencePaths, Task, TaskWork,
};
use super::problem::{LabError, LabProblem, LoadError};
use crate::controller::Budgets;
use crate::graded::TcpPath;

/// Names of the labs in `files`: folders that hold a `lab.toml`.
pub fn lab_names(files: &dyn Files) -> Vec<String> {
    let mut names = files.list("");
    names.retain(|name| {
        matches!(
            files.read(&format!("{name}/lab.toml")),
            Ok(Some(_)) | Err(_)
        )
    });
    names
}

/// Reads a file as a [`Source`] whose name is its path.
pub(super) fn read(files: &dyn Files, path: &str) -> Result<Option<Source>, LoadError> {
    match files.read(path) {
        Ok(text) => Ok(text.map(|text| Source::new(path, text))),
        Err(why) => Err(LoadError::Unreadable {
            path: format!("{}/{path}", files.name()),
            why,
        }),
    }
}

/// Reads TOML into its tables.
pub(super) fn tables<T: DeserializeOwned>(source: &Source) -> Result<T, LabError> {
    if let Some(at) = not_finite(source.text()) {
        let report = Reporter { source };
        return report.err(
            at,
            "lab::not_finite",
            "a lab's numbers are finite".to_owned(),
            "not a finite number",
            Some("leave a limit out to have none".to_owned()),
        );
    }
    toml::from_str(source.text()).map_err(|error| {
        let TomlRefusal { message, help, at } = TomlRefusal::from_error(&error);
        let problem = LabProblem {
            message,
            code: "lab::toml",
            label: "here".to_owned(),
            help,
        };
        LabError::new(problem, source, at)
    })
}

/// Where the first `nan` or `inf` of a TOML text stands; a text that is no TOML has none, and its reader says why.
fn not_finite(text: &str) -> Option<Range<usize>> {
    use toml::de::{DeTable, DeValue};
    fn within(value: &Spanned<DeValue<'_>>) -> Option<Range<usize>> {
        match value.get_ref() {
            DeValue::Float(number) => {
                let word = number.as_str().trim_start_matches(['+', '-']);
                let parsed = word.replace('_', "").parse::<f64>();
                (!parsed.is_ok_and(f64::is_finite)).then(|| value.span())
            }
            DeValue::Array(items) => items.iter().find_map(within),
            DeValue::Table(table) => table.values().find_map(within),
            _ => None,
        }
    }
    DeTable::parse(text)
        .ok()?
        .get_ref()
        .values()
        .find_map(within)
}

/// Where problems of one text are reported.
#[derive(Clone, Copy)]
pub(super) struct Reporter<'a> {
    pub(super) source: &'a Source,
}

impl Reporter<'_> {
    pub(super) fn err<T>(
        &self,
        at: Range<usize>,
        code: &'static str,
        message: String,
        label: &str,
        help: Option<String>,
    ) -> Result<T, LabError> {
        let problem = LabProblem {
            message,
            code,
            label: label.to_owned(),
            help,
        };
        Err(LabError::new(problem, self.source, at))
    }

    pub(super) fn format(&self, format: &Spanned<i64>) -> Result<(), LabError> {
        match *format.get_ref() {
            1 => Ok(()),
            found => self.err(
                format.span(),
                "lab::unknown_format",
                format!("format {found} is not known"),
                "this version reads format 1",
                Some("write `format = 1`".to_owned()),
            ),
        }
    }
}

impl Lab {
    /// Loads the lab called `name`, with its robot.
    ///
    /// # Errors
    /// [`LoadError`] if there is no such lab, or something in its files is wrong.
    pub fn load(files: &dyn Files, name: &str) -> Result<Self, LoadError> {
        let Some(source) = read(files, &format!("{name}/lab.toml"))? else {
            let known = lab_names(files);
            return Err(LoadError::UnknownLab {
                name: name.to_owned(),
                help: format!(
                    "{} (in {})",
                    suggest(name, "labs", known.iter().map(String::as_str)),
                    files.name()
                ),
            });
        };
        let lab: LabTable = tables(&source)?;
        let report = Reporter { source: &source };
        report.format(&lab.format)?;
        if lab.name.get_ref() != name {
            return Ok(report.err(
                lab.name.span(),
                "lab::name",
                format!(
                    "the lab in folder `{name}` calls itself `{}`",
                    lab.name.get_ref()
                ),
                "differs from its folder",
                Some(format!("write `name = \"{name}\"`, or rename the folder")),
            )?);
        }
        let robot_path = format!("robots/{}.toml", lab.robot.get_ref());
        let Some(robot_source) = read(files, &robot_path)? else {
            let known: Vec<String> = files
                .list("robots")
                .iter()
                .filter_map(|file| Some(file.strip_suffix(".toml")?.to_owned()))
                .collect();
            return Ok(report.err(
                lab.robot.span(),
                "lab::unknown_robot",
                format!("no robot file `{robot_path}`"),
                "not a robot of this place",
                Some(suggest(
                    lab.robot.get_ref(),
                    "robots",
                    known.iter().map(String::as_str),
                )),
            )?);
        };
        let robot_file = RobotFile::parse(robot_source)?;
        let robot = robot_file.build(&[])?;
        let frame = match &lab.frame {
            None => robot.links()[0].name.clone(),
            Some(frame) if robot.frame(frame.get_ref()).is_some() => frame.get_ref().clone(),
            Some(frame) => {
                let known = robot.frames().iter().map(|frame| frame.name.as_str());
                return Ok(report.err(
                    frame.span(),
                    "lab::unknown_frame",
                    format!(
                        "robot `{}` has no frame `{}`",
                        robot.name(),
                        frame.get_ref()
                    ),
                    "not a frame of this robot",
                    Some(suggest(frame.get_ref(), "frames", known)),
                )?);
            }
        };
        let reference_paths = reference_paths(files, name)?;
        let reader = Reader {
            report,
            robot: &robot,
            robot_file: &robot_file,
            reference_paths: &reference_paths.paths,
        };
        let tasks = reader.tasks(&lab)?;
        Ok(Self {
            name: name.to_owned(),
            title: lab.title,
            summary: lab.summary,
            budgets: reader.budgets(&lab.budgets)?,
            tasks,
            source,
            robot_file,
            robot,
            frame,
            reference_paths,
        })
    }
}

/// Reads `reference-path.json`: an object of tasks, each with `period_s` and `points_m`.
fn reference_paths(files: &dyn Files, name: &str) -> Result<ReferencePaths, LoadError> {
    #[derive(serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct PathTable {
        period_s: f64,
        points_m: Vec<[f64; 3]>,
    }
    let path = format!("{name}/reference-path.json");
    let Some(source) = read(files, &path)? else {
        return Ok(ReferencePaths::default());
    };
    let tables: BTreeMap<String, PathTable> =
        serde_json::from_str(source.text()).map_err(|error| LoadError::Unreadable {
            path: format!("{}/{path}", files.name()),
            why: error.to_string(),
        })?;
    let paths = tables.into_iter().map(|(task, table)| {
        let path = TcpPath {
            period_s: table.period_s,
            points_m: table.points_m,
        };
        (task, path)
    });
    Ok(ReferencePaths {
        paths: paths.collect(),
        text: source.text().to_owned(),
    })
}

struct Reader<'a> {
    report: Reporter<'a>,
    robot: &'a Robot,
    robot_file: &'a RobotFile,
    reference_paths: &'a [(String, TcpPath)],
}

impl Reader<'_> {
    fn budgets(&self, table: &BudgetTable) -> Result<Budgets, LabError> {
        let mut budgets = Budgets::default();
        for (typed, slot) in [
            (&table.operations_per_call, &mut budgets.operations_per_call),
            (&table.operations_per_task, &mut budgets.operations_per_task),
        ] {
            if let Some(value) = typed {
                // above this, one call could keep a class waiting
                let highest = 1_000_000_000;
                if !(1..=highest).contains(value.get_ref()) {
                    return self.report.err(
                        value.span(),
                        "lab::budget",
                        format!(
                            "a budget is 1 to {highest} operations, got {}",
                            value.get_ref()
                        ),
                        "out of range",
                        None,
                    );
                }
                *slot = *value.get_ref();
            }
        }
        Ok(budgets)
    }

    fn tasks(&self, lab: &LabTable) -> Result<Vec<Task>, LabError> {
        if lab.tasks.is_empty() {
            return self.report.err(
                lab.name.span(),
                "lab::no_tasks",
                "a lab needs at least one task".to_owned(),
                "no [[tasks]]",
                Some("add a [[tasks]] table".to_owned()),
            );
        }
        self.unique("task", lab.tasks.iter().map(|task| &task.name))?;
        lab.tasks.iter().map(|task| self.task(task)).collect()
    }

    /// Names are used in file names and links: letters, digits, `-`.
    fn unique<'n>(
        &self,
        what: &str,
        names: impl Iterator<Item = &'n Spanned<String>>,
    ) -> Result<(), LabError> {
        let mut seen: Vec<&str> = Vec::new();
        for at in names {
            let name = at.get_ref().as_str();
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            if name.is_empty() || !name.chars().all(plain) {
                return self.report.err(
                    at.span(),
                    "lab::bad_name",
                    format!("{what} name {name:?} cannot be used"),
                    "this name",
                    Some("use lower-case letters, digits and `-`".to_owned()),
                );
            }
            if seen.contains(&name) {
                return self.report.err(
                    at.span(),
                    "lab::duplicate",
                    format!("{what} `{name}` is there twice"),
                    "the second one",
                    Some("give each its own name".to_owned()),
                );
            }
            seen.push(name);
        }
        Ok(())
    }

    fn task(&self, table: &TaskTable) -> Result<Task, LabError> {
        let name = table.name.get_ref();
        let work = match (&table.function, &table.motion) {
            (Some(function), None) => TaskWork::Function(self.function(function)?),
            (None, Some(motion)) => TaskWork::Motion(Box::new(self.motion(motion)?)),
            _ => {
                return self.report.err(
                    table.name.span(),
                    "lab::task_kind",
                    format!("task `{name}` must have either `function` or `motion`"),
                    "this task",
                    Some("add one table: [tasks.function] or [tasks.motion]".to_owned()),
                );
            }
        };
        if table.checks.is_empty() {
            return self.report.err(
                table.name.span(),
                "lab::no_checks",
                format!("task `{name}` has no checks, so nothing in it earns a point"),
                "this task",
                Some("add a [[tasks.checks]] table".to_owned()),
            );
        }
        self.unique(
            "check",
            table.checks.iter().map(|check| &check.get_ref().name),
        )?;
        let mut checks: Vec<Check> = Vec::new();
        for check in &table.checks {
            let check = self.check(check, &checks, &work, name)?;
            checks.push(check);
        }
        Ok(Task {
            name: name.clone(),
            title: table.title.clone(),
            work,
            checks,
        })
    }

    fn positive(&self, number: &NumberAt, what: &str) -> Result<f64, LabError> {
        let value = *number.get_ref();
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        self.report.err(
            number.span(),
            "lab::out_of_range",
            format!("{what} must be positive and finite, got {value}"),
            "out of range",
            None,
        )
    }

    fn function(&self, table: &FunctionTable) -> Result<FunctionTask, LabError> {
        let function = match table.call.get_ref() {
            FunctionName::ForwardKinematics => Function::ForwardKinematics,
            FunctionName::InverseKinematics => Function::InverseKinematics,
        };
        if table.cases.is_empty() {
            return self.report.err(
                table.call.span(),
                "lab::no_cases",
                format!("`{}` has no visible cases", function.name()),
                "this function",
                Some("add [[tasks.function.cases]]: students practise on them".to_owned()),
            );
        }
        let cases: Result<Vec<Case>, LabError> = table
            .cases
            .iter()
            .map(|case| self.case(function, case))
            .collect();
        Ok(FunctionTask {
            function,
            cases: cases?,
        })
    }

    fn case(&self, function: Function, table: &Spanned<CaseTable>) -> Result<Case, LabError> {
        let case = table.get_ref();
        let name = case.name.get_ref().clone();
        let dimensions: Vec<_> = case
            .dimensions
            .iter()
            .map(|(name, value)| (name.clone(), value.clone()))
            .collect();
        if let Err(error) = self.robot_file.build(&dimensions) {
            return self.report.err(
                table.span(),
                "lab::case_dimensions",
                format!("case `{name}`: {error}"),
                "this case",
                Some(suggest(
                    "",
                    "dimensions",
                    self.robot_file.dimensions().names(),
                )),
            );
        }
        let given = match (function, &case.q_rad, case.position_m) {
            (Function::ForwardKinematics, Some(q), None) => {
                self.counted(q, "q_rad")?;
                Given::Q(q.get_ref().clone())
            }
            (Function::InverseKinematics, None, Some(position_m)) => Given::Position {
                position_m,
                branches: case.branches.as_ref().map_or(2, |branches| {
                    u32::try_from(*branches.get_ref()).unwrap_or(2)
                }),
            },
            _ => {
                let wanted = match function {
                    Function::ForwardKinematics => "`q_rad`",
                    Function::InverseKinematics => "`position_m`",
                };
                return self.report.err(
                    table.span(),
                    "lab::case_input",
                    format!(
                        "case `{name}` of `{}` is given by {wanted}",
                        function.name()
                    ),
                    "this case",
                    Some(format!("give {wanted} and nothing else")),
                );
            }
        };
        Ok(Case {
            name,
            hidden_class: None,
            dimensions,
            given,
        })
    }

    fn counted<T>(&self, list: &Spanned<Vec<T>>, what: &str) -> Result<(), LabError> {
        let (expected, found) = (self.robot.n(), list.get_ref().len());
        if expected == found {
            return Ok(());
        }
        let joints: Vec<&str> = self
            .robot
            .moving_joints()
            .map(|joint| joint.name.as_str())
            .collect();
        self.report.err(
            list.span(),
            "lab::joint_count",
            format!("`{what}` has {found} numbers for {expected} joints"),
            "one number per joint that moves",
            Some(format!(
                "joints of `{}`: {}",
                self.robot.name(),
                joints.join(", ")
            )),
        )
    }

    fn motion(&self, table: &Spanned<MotionTable>) -> Result<MotionTask, LabError> {
        let motion = table.get_ref();
        let milliseconds = |typed: &Option<NumberAt>, what, absent: f64| match typed {
            None => Ok(absent),
            Some(number) => Ok(self.positive(number, what)? / 1000.0),
        };
        let step_s = milliseconds(&motion.physics_step_ms, "the physics step", 0.001)?;
        let servo_s = milliseconds(&motion.servo_period_ms, "the servo period", 0.001)?;
        let control_s = milliseconds(&motion.control_period_ms, "the control period", 0.01)?;
        let periods = match Periods::new(step_s, servo_s, control_s) {
            Ok(periods) => periods,
            Err(error) => {
                let typed = [&motion.control_period_ms, &motion.servo_period_ms];
                let at = typed.into_iter().flatten().next();
                return self.report.err(
                    at.map_or(table.span(), Spanned::span),
                    "lab::periods",
                    error.to_string(),
                    "does not divide",
                    Some("each period is a whole number of the one before".to_owned()),
                );
            }
        };
        let duration_s = self.positive(&motion.duration_s, "the duration")?;
        let whole_ticks = |seconds: f64, at: &NumberAt, what: &str| {
            match whole_ratio(seconds, step_s) {
                // a quarter of an hour at 1 ms: more would not fit in the memory of a grade
                Some(ticks) if ticks <= 900_000 => Ok(ticks),
                _ => self.report.err(
                    at.span(),
                    "lab::periods",
                    format!("{what} of {seconds} s is not a whole, sensible number of physics steps of {step_s} s"),
                    "this time",
                    None,
                ),
            }
        };
        let ticks = whole_ticks(duration_s, &motion.duration_s, "the duration")?;
        let n = self.robot.n();
        let start_q = match &motion.start_rad {
            None => vec![0.0; n],
            Some(start) => {
                self.counted(start, "start_rad")?;
                start.get_ref().clone()
            }
        };
        let mut goals = Vec::new();
        for goal in &motion.goals {
            let dwell_s = self.positive(&goal.dwell_s, "the dwell")?;
            goals.push(MotionGoal {
                position_m: Vector3::from(goal.position_m),
                dwell_ticks: whole_ticks(dwell_s, &goal.dwell_s, "the dwell")?,
            });
        }
        let dwells: u64 = goals.iter().map(|goal| goal.dwell_ticks).sum();
        if dwells > ticks {
            return self.report.err(
                motion.duration_s.span(),
                "lab::periods",
                format!(
                    "the dwells take {} s of a run of {duration_s} s",
                    periods.time_s(dwells)
                ),
                "shorter than its dwells",
                None,
            );
        }
        let default_servo = ServoTable::default();
        let (servo_table, servo_at) = match &motion.servo {
            Some(servo) => (servo.get_ref(), servo.span()),
            None => (&default_servo, table.span()),
        };
        let servo = self.servo(motion.mode, servo_table, servo_at.clone())?;
        if let Err(error) = Servo::new(self.robot, servo.clone(), servo_s, GRAVITY_M_S2) {
            return self.report.err(
                servo_at,
                "lab::servo",
                error.to_string(),
                "this servo",
                None,
            );
        }
        Ok(MotionTask {
            periods,
            ticks,
            servo,
            gravity_m_s2: GRAVITY_M_S2,
            start_q,
            target: motion.target.clone().unwrap_or_default(),
            goals,
        })
    }

    fn servo(
        &self,
        mode: ModeName,
        table: &ServoTable,
        at: Range<usize>,
    ) -> Result<ServoSettings, LabError> {
        let n = self.robot.n();
        let spread = |typed: &Option<PerJoint>, what: &str, absent: f64, lowest: f64| {
            let values = match typed {
                None => vec![absent; n],
                Some(PerJoint::All(value)) => vec![*value; n],
                Some(PerJoint::Each(values)) if values.len() == n => values.clone(),
                Some(PerJoint::Each(values)) => {
                    return self.report.err(
                        at.clone(),
                        "lab::joint_count",
                        format!("`{what}` has {} numbers for {n} joints", values.len()),
                        "this servo",
                        Some("give one number for all joints, or one per joint".to_owned()),
                    );
                }
            };
            if let Some(bad) = values
                .iter()
                .find(|value| **value < lowest || value.is_nan())
            {
                return self.report.err(
                    at.clone(),
                    "lab::out_of_range",
                    format!(
                        "`{what}` must be {}, got {bad:e}",
                        if lowest > 0.0 {
                            "positive"
                        } else {
                            "zero or more"
                        }
                    ),
                    "this servo",
                    None,
                );
            }
            Ok(values)
        };
        let least = f64::MIN_POSITIVE; // a limit of zero would hold the arm limp
        let kp = spread(&table.kp, "kp", 0.0, 0.0)?;
        let ki = spread(&table.ki, "ki", 0.0, 0.0)?;
        let kd = spread(&table.kd, "kd", 0.0, 0.0)?;
        let effort = spread(&table.effort_limit, "effort_limit", f64::INFINITY, least)?;
        let integral = spread(
            &table.integral_limit,
            "integral_limit",
            f64::INFINITY,
            least,
        )?;
        let of_robot = |joint: usize| {
            let limit = self
                .robot
                .moving_joints()
                .nth(joint)
                .and_then(|j| j.limits.effort);
            limit.unwrap_or(f64::INFINITY)
        };
        Ok(ServoSettings {
            mode: match mode {
                ModeName::Position => Mode::Position,
                ModeName::Velocity => Mode::Velocity,
                ModeName::Effort => Mode::Effort,
            },
            derivative: match table.derivative {
                Some(DerivativeName::Error) => Derivative::Error,
                Some(DerivativeName::Velocity) => Derivative::Velocity,
                Some(DerivativeName::Measurement) | None => Derivative::Measurement,
            },
            gains: (0..n)
                .map(|i| Gains {
                    kp: kp[i],
                    ki: ki[i],
                    kd: kd[i],
                    // a lab may be stricter than the robot, never more generous
                    effort_limit: effort[i].min(of_robot(i)),
                    integral_limit: integral[i],
                })
                .collect(),
            gravity_compensation: table.gravity_compensation,
        })
    }

    fn band(&self, full: f64, zero: f64, at: Range<usize>) -> Result<Band, LabError> {
        if full.is_finite() && zero.is_finite() && full <= zero {
            return Ok(Band { full, zero });
        }
        self.report.err(
            at,
            "lab::band",
            format!("a band needs `full` at or below `zero`, got {full} and {zero}"),
            "this band",
            Some(
                "`full` is the value that earns all points, `zero` the one that earns none"
                    .to_owned(),
            ),
        )
    }

    fn check(
        &self,
        spanned: &Spanned<CheckTable>,
        earlier: &[Check],
        work: &TaskWork,
        task: &str,
    ) -> Result<Check, LabError> {
        let table = spanned.get_ref();
        let name = table.name.get_ref();
        let points = *table.points.get_ref();
        if !(points > 0.0 && points <= 1000.0) {
            return self.report.err(
                table.points.span(),
                "lab::points",
                format!(
                    "check `{name}` must be worth more than 0 and at most 1000 points, got {points}"
                ),
                "out of range",
                None,
            );
        }
        let mut needs = Vec::new();
        for needed in &table.needs {
            match earlier
                .iter()
                .position(|check| check.name == *needed.get_ref())
            {
                Some(index) => needs.push(index),
                None => {
                    let known = earlier.iter().map(|check| check.name.as_str());
                    return self.report.err(
                        needed.span(),
                        "lab::unknown_check",
                        format!(
                            "no earlier check of this task is called `{}`",
                            needed.get_ref()
                        ),
                        "must stand before this check",
                        Some(suggest(needed.get_ref(), "earlier checks", known)),
                    );
                }
            }
        }
        let mut kinds = self.kinds(table, work, task)?;
        let (Some(kind), true) = (kinds.pop(), kinds.is_empty()) else {
            return self.report.err(
                table.name.span(),
                "lab::check_kind",
                format!("check `{name}` must have exactly one kind"),
                "this check",
                Some("add one table, such as [tasks.checks.pose-reached]".to_owned()),
            );
        };
        self.fits(&kind, work, &table.name)?;
        Ok(Check {
            name: name.clone(),
            title: table.title.clone(),
            points,
            needs,
            hint: table.hint.clone(),
            kind,
        })
    }

    fn kinds(
        &self,
        table: &CheckTable,
        work: &TaskWork,
        task: &str,
    ) -> Result<Vec<CheckKind>, LabError> {
        let step_s = match work {
            TaskWork::Motion(motion) => motion.periods.step_s,
            TaskWork::Function(_) => 1.0,
        };
        let metres = |band: &Spanned<BandM>| {
            let BandM { full_m, zero_m } = *band.get_ref();
            self.band(full_m, zero_m, band.span())
        };
        let seconds = |band: &Spanned<BandS>| {
            let BandS { full_s, zero_s } = *band.get_ref();
            self.band(full_s, zero_s, band.span())
        };
        let mut kinds = Vec::new();
        if let Some(reached) = &table.joint_reached {
            let wanted = reached.joint.get_ref();
            let names: Vec<&str> = self
                .robot
                .moving_joints()
                .map(|joint| joint.name.as_str())
                .collect();
            let Some(joint) = names.iter().position(|name| name == wanted) else {
                return self.report.err(
                    reached.joint.span(),
                    "lab::unknown_joint",
                    format!(
                        "robot `{}` has no joint `{wanted}` that moves",
                        self.robot.name()
                    ),
                    "not a joint of this robot",
                    Some(suggest(wanted, "joints", names.into_iter())),
                );
            };
            let hold_s = self.positive(&reached.hold_s, "`hold_s`")?;
            let Some(hold_ticks) = whole_ratio(hold_s, step_s) else {
                return self.report.err(
                    reached.hold_s.span(),
                    "lab::periods",
                    format!("{hold_s} s is not a whole number of physics steps of {step_s} s"),
                    "does not divide",
                    None,
                );
            };
            if matches!(work, TaskWork::Motion(motion) if hold_ticks > motion.ticks) {
                return self.report.err(
                    reached.hold_s.span(),
                    "lab::periods",
                    format!("{hold_s} s is longer than the run"),
                    "longer than the run",
                    None,
                );
            }
            kinds.push(CheckKind::JointReached {
                joint,
                position: reached.position_rad,
                hold_ticks,
                band: self.band(
                    *reached.full_rad.get_ref(),
                    reached.zero_rad,
                    reached.full_rad.span(),
                )?,
            });
        }
        if let Some(band) = &table.fk_error {
            kinds.push(CheckKind::FkError(metres(band)?));
        }
        if let Some(band) = &table.ik_reach {
            kinds.push(CheckKind::IkReach(metres(band)?));
        }
        if let Some(band) = &table.ik_branches {
            kinds.push(CheckKind::IkBranches(metres(band)?));
        }
        if table.ik_unreachable.is_some() {
            kinds.push(CheckKind::IkUnreachable);
        }
        if let Some(band) = &table.pose_reached {
            kinds.push(CheckKind::PoseReached(metres(band)?));
        }
        if let Some(band) = &table.finish_time {
            kinds.push(CheckKind::FinishTime(seconds(band)?));
        }
        if let Some(band) = &table.overshoot {
            let ratio = band.get_ref();
            kinds.push(CheckKind::Overshoot(self.band(
                ratio.full,
                ratio.zero,
                band.span(),
            )?));
        }
        if let Some(band) = &table.effort_saturation {
            kinds.push(CheckKind::EffortSaturation(seconds(band)?));
        }
        if let Some(band) = &table.joint_limits {
            let b = band.get_ref();
            kinds.push(CheckKind::JointLimits(self.band(
                b.full_rad,
                b.zero_rad,
                band.span(),
            )?));
        }
        if let Some(table) = &table.trajectory_match {
            let t = table.get_ref();
            let refuse = |message: String, help: &str| {
                self.report.err(
                    table.span(),
                    "lab::trajectory_match",
                    message,
                    "this check",
                    Some(help.to_owned()),
                )
            };
            if !self.reference_paths.iter().any(|(name, _)| *name == task) {
                return refuse(
                    format!("`reference-path.json` has no path for task `{task}`"),
                    "put the reference solution's TCP path there: see docs/lab-format.md",
                );
            }
            let max_shift_s = match (t.over, t.max_shift_s) {
                (SpanName::Dwells, Some(_)) => {
                    return refuse(
                        "`max_shift_s` has no meaning over `dwells`, which are found wherever they are".to_owned(),
                        "remove it",
                    );
                }
                (_, None) => 0.0,
                (SpanName::Run, Some(shift_s)) if (0.0..=60.0).contains(&shift_s) => shift_s,
                (SpanName::Run, Some(shift_s)) => {
                    return refuse(
                        format!("`max_shift_s` must be 0 to 60 s, got {shift_s}"),
                        "change it",
                    );
                }
            };
            kinds.push(CheckKind::TrajectoryMatch {
                span: match t.over {
                    SpanName::Dwells => MatchSpan::Dwells,
                    SpanName::Run => MatchSpan::Run,
                },
                max_shift_ticks: (max_shift_s / step_s).round() as u64,
                band: self.band(t.full_m, t.zero_m, table.span())?,
            });
        }
        Ok(kinds)
    }

    /// A check must look at something its task has.
    fn fits(
        &self,
        kind: &CheckKind,
        work: &TaskWork,
        at: &Spanned<String>,
    ) -> Result<(), LabError> {
        let wanted = match (kind, work) {
            (CheckKind::FkError(_), TaskWork::Function(task))
                if task.function == Function::ForwardKinematics =>
            {
                return Ok(());
            }
            (
                CheckKind::IkReach(_) | CheckKind::IkBranches(_) | CheckKind::IkUnreachable,
                TaskWork::Function(task),
            ) if task.function == Function::InverseKinematics => return Ok(()),
            (
                CheckKind::PoseReached(_)
                | CheckKind::FinishTime(_)
                | CheckKind::Overshoot(_)
                | CheckKind::TrajectoryMatch { .. },
                TaskWork::Motion(task),
            ) => {
                if !task.goals.is_empty() {
                    return Ok(());
                }
                "`goals` in [tasks.motion]"
            }
            (
                CheckKind::JointReached { .. }
                | CheckKind::EffortSaturation(_)
                | CheckKind::JointLimits(_),
                TaskWork::Motion(_),
            ) => return Ok(()),
            (CheckKind::FkError(_), _) => "a function task of `forward_kinematics`",
            (CheckKind::IkReach(_) | CheckKind::IkBranches(_) | CheckKind::IkUnreachable, _) => {
                "a function task of `inverse_kinematics`"
            }
            (_, TaskWork::Function(_)) => "a motion task",
        };
        self.report.err(
            at.span(),
            "lab::check_kind",
            format!(
                "check `{}` of kind `{}` needs {wanted}",
                at.get_ref(),
                kind.name()
            ),
            "this check",
            None,
        )
    }
}
