//! `kinemark robot response`: the step response of a joint, beside the linear theory, as a table, a page and pictures.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::ValueEnum;
use kinemark_course::staffed_lab::engine_id;
use kinemark_report::response_page::ResponsePage;
use kinemark_sim::control::Derivative;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::model::air::Drag;
use kinemark_toolbox::response::{
    Analysis, PidGains, ResponseError, ResponseSettings, Surroundings, Sweep, Varied, analyse,
    facts, gravity_m_s2, joint_entry, response_record, response_table, response_text, title,
};

use crate::failure::Failure;
use crate::output;
use crate::response_pictures::response_pictures;
use crate::robot_source::{self, RobotArgs};
use crate::typed_numbers::numbers;

/// Analyse the step response of a joint: rise, settling and overshoot of the run and of linear theory, and where the loop is stable
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
    kinemark robot response rrbot --joint elbow --kp 100 --ki 0.01 --kd 10\n  \
    kinemark robot response rrbot --joint elbow --kp 100 --sweep kd=2,5,10 --html response.html\n  \
    kinemark robot response rrbot --joint elbow --of velocity --kp 100 --servo-period-ms 0.1\n  \
    kinemark robot response rrbot --joint elbow --kp 100 --kd 10 --sweep gravity=earth,moon,zero\n  \
    kinemark robot response rrbot --joint elbow --kp 100 --kd 10 --wind 10 --drag 0.05,1.1\n\n\
    All joints have the same gains; the others are commanded to stay where they start, or to velocity 0. Linear theory is of the joint \
    alone, without gravity, friction, limits and sampling. See docs/robot-response.md.\n\
    Exit codes: 0 analysed, 2 usage, 3 the robot is broken or cannot run, 4 a file cannot be written.")]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// The joint that gets the step [default: the only one]
    #[arg(long, value_name = "NAME")]
    pub(crate) joint: Option<String>,
    /// Height of the step, in rad or m, with --of velocity in rad/s or m/s
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 1.0,
        allow_negative_numbers = true
    )]
    pub(crate) step: f64,
    /// The signal that is fed back and that jumps
    #[arg(long, value_enum, default_value_t = Of::Position)]
    pub(crate) of: Of,
    /// Proportional gain of every joint; needed, unless it is swept
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    pub(crate) kp: Option<f64>,
    /// Integral gain of every joint
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub(crate) ki: f64,
    /// Derivative gain of every joint
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub(crate) kd: f64,
    /// What the derivative is taken of
    #[arg(long, value_enum, default_value_t = DerivativeOf::Measurement)]
    pub(crate) derivative: DerivativeOf,
    /// Repeat with up to six values of one of kp, ki, kd, step, servo-period-ms, gravity, wind, friction
    #[arg(long, value_name = "NAME=VALUES")]
    pub(crate) sweep: Option<String>,
    /// Gravity, downwards: earth, moon, mars, zero, or a number in m/s²
    #[arg(
        long,
        value_name = "GRAVITY",
        default_value = "earth",
        allow_hyphen_values = true
    )]
    pub(crate) gravity: String,
    /// Add the effort that gravity takes to every servo
    #[arg(long)]
    pub(crate) gravity_compensation: bool,
    /// Wind in m/s: a speed along the world's x axis, or x,y,z
    #[arg(long, value_name = "WIND", allow_hyphen_values = true)]
    pub(crate) wind: Option<String>,
    /// Drag of every link that moves: its area in m², and its coefficient
    #[arg(long, value_name = "AREA,COEFFICIENT")]
    pub(crate) drag: Option<String>,
    /// Dry friction in every joint, besides the robot's own, in N m or N
    #[arg(
        long,
        value_name = "EFFORT",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub(crate) friction: f64,
    /// The greatest effort, in N m or N: one for all joints, or one per joint, separated by commas [default: the robot's limits]
    #[arg(long, value_name = "EFFORTS")]
    pub(crate) effort_limit: Option<String>,
    /// Joint positions before the step, in rad or m, separated by commas [default: the robot's home]
    #[arg(long, value_name = "Q", allow_hyphen_values = true)]
    pub(crate) start: Option<String>,
    /// Time between two samples of the servos, in ms
    #[arg(long, value_name = "MS", default_value_t = 1.0)]
    pub(crate) servo_period_ms: f64,
    /// How long the run is, in s; the final value is the mean over its last 0.2 s
    #[arg(long, value_name = "S", default_value_t = 5.0)]
    pub(crate) duration: f64,
    /// Print all numbers as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a page with curves and table; a file that is there is replaced
    #[arg(long, value_name = "FILE", value_parser = ends_in_html)]
    pub(crate) html: Option<PathBuf>,
    /// Write the curves as SVG; a file that is there is replaced
    #[arg(long, value_name = "FILE", value_parser = ends_in_svg)]
    pub(crate) svg: Option<PathBuf>,
    /// Write the curves as PNG; a file that is there is replaced
    #[arg(long, value_name = "FILE", value_parser = ends_in_png)]
    pub(crate) png: Option<PathBuf>,
}

/// The signal that is fed back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Of {
    Position,
    Velocity,
}

/// What the derivative term takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DerivativeOf {
    /// The difference of two errors: kicks where the command jumps
    Error,
    /// The difference of two measurements
    Measurement,
    /// The joint's own velocity; with --of position only
    Velocity,
}

/// A file name with an ending: a robot's own file is then never replaced.
fn ends_in(text: &str, ending: &str) -> Result<PathBuf, String> {
    let path = Path::new(text);
    match path.extension() {
        Some(found) if found.eq_ignore_ascii_case(ending) => Ok(path.to_owned()),
        _ => Err(format!("name a file that ends in .{ending}")),
    }
}

fn ends_in_html(text: &str) -> Result<PathBuf, String> {
    ends_in(text, "html")
}

fn ends_in_svg(text: &str) -> Result<PathBuf, String> {
    ends_in(text, "svg")
}

fn ends_in_png(text: &str) -> Result<PathBuf, String> {
    ends_in(text, "png")
}

/// Analyses, writes the files, prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    if args.png.is_some() && !cfg!(feature = "png") {
        return Err(Failure::usage(
            "--png needs a build with the feature `png`".to_owned(),
            "write an SVG with --svg, or build with `--features png`",
        ));
    }
    let loaded = robot_source::load(&args.robot)?;
    let robot = &loaded.robot;
    let sweep = args.sweep.as_deref().map(Sweep::parse);
    let sweep = sweep.transpose().map_err(refused)?;
    let joint = joint_entry(robot, args.joint.as_deref()).map_err(refused)?;
    let settings = settings(args, joint, sweep.as_ref())?;
    let analysis = analyse(robot, &settings, sweep.as_ref()).map_err(refused)?;
    write_files(args, &analysis)?;
    if args.json {
        output::print_formatted(&response_record(&analysis))?;
    } else {
        output::print_styled(&response_text(&analysis))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn refused(error: ResponseError) -> Failure {
    let help = error.help();
    match error {
        ResponseError::Run(_) => Failure::broken(error.to_string(), &help),
        other => Failure::usage(other.to_string(), &help),
    }
}

/// The settings that were typed.
fn settings(args: &Args, joint: usize, sweep: Option<&Sweep>) -> Result<ResponseSettings, Failure> {
    let is_swept = sweep.is_some_and(|sweep| sweep.varied == Varied::Kp);
    let kp = match args.kp {
        Some(kp) => kp,
        None if is_swept => 0.0,
        None => {
            return Err(Failure::usage(
                "no proportional gain was given".to_owned(),
                "add --kp, such as --kp 100, or sweep it: --sweep kp=50,100,200",
            ));
        }
    };
    let list = |typed: &Option<String>, option: &str, example: &str| match typed {
        Some(text) => numbers(text, option, example),
        None => Ok(Vec::new()),
    };
    Ok(ResponseSettings {
        joint,
        fed: match args.of {
            Of::Position => Fed::Position,
            Of::Velocity => Fed::Velocity,
        },
        step: args.step,
        gains: PidGains {
            kp,
            ki: args.ki,
            kd: args.kd,
        },
        derivative: match args.derivative {
            DerivativeOf::Error => Derivative::Error,
            DerivativeOf::Measurement => Derivative::Measurement,
            DerivativeOf::Velocity => Derivative::Velocity,
        },
        gravity_compensation: args.gravity_compensation,
        effort_limit: list(&args.effort_limit, "--effort-limit", "30,15")?,
        start: list(&args.start, "--start", "0,0.5")?,
        servo_period_s: args.servo_period_ms / 1000.0,
        duration_s: args.duration,
        surroundings: surroundings(args)?,
    })
}

fn surroundings(args: &Args) -> Result<Surroundings, Failure> {
    let Some(gravity_m_s2) = gravity_m_s2(&args.gravity) else {
        return Err(Failure::usage(
            format!("`{}` is no gravity", args.gravity),
            "give earth, moon, mars, zero, or a number in m/s²: --gravity 1.62",
        ));
    };
    let wind_m_s = match &args.wind {
        None => None,
        Some(text) => match numbers(text, "--wind", "10,0,0")?[..] {
            [speed] => Some([speed, 0.0, 0.0]),
            [x, y, z] => Some([x, y, z]),
            _ => {
                return Err(Failure::usage(
                    format!("`{text}` is no wind: it has neither one number nor three"),
                    "give a speed along x, or x,y,z, in m/s: --wind 10",
                ));
            }
        },
    };
    let drag = match &args.drag {
        None => None,
        Some(text) => match numbers(text, "--drag", "0.05,1.1")?[..] {
            [area_m2, coefficient] => Some(Drag {
                area_m2,
                coefficient,
            }),
            _ => {
                return Err(Failure::usage(
                    format!("`{text}` is no drag: it has not two numbers"),
                    "give the area in m² and the coefficient: --drag 0.05,1.1",
                ));
            }
        },
    };
    Ok(Surroundings {
        gravity_m_s2,
        wind_m_s,
        drag,
        dry_friction: args.friction,
    })
}

/// Writes the page and the pictures that were asked for.
fn write_files(args: &Args, analysis: &Analysis) -> Result<(), Failure> {
    const HELP: &str = "choose another path";
    if args.html.is_none() && args.svg.is_none() && args.png.is_none() {
        return Ok(());
    }
    let pictures = response_pictures(analysis);
    let first = pictures.first().map_or("", |picture| &picture.svg);
    if let Some(path) = &args.html {
        let table = response_table(analysis);
        let page = ResponsePage {
            engine: &engine_id(),
            title: &title(analysis),
            pictures: &pictures,
            head: &table.head,
            rows: &table.rows,
            words: table.words(),
            facts: &facts(analysis),
        };
        output::write_file(path, page.html().as_bytes(), HELP)?;
    }
    if let Some(path) = &args.svg {
        output::write_file(path, first.as_bytes(), HELP)?;
    }
    if let Some(path) = &args.png {
        output::write_file(path, &png(first)?, HELP)?;
    }
    Ok(())
}

#[cfg(feature = "png")]
fn png(svg: &str) -> Result<Vec<u8>, Failure> {
    let drawn = kinemark_report::png::png(svg);
    drawn.map_err(|error| Failure::fault(error.to_string(), "please report this"))
}

#[cfg(not(feature = "png"))]
fn png(_: &str) -> Result<Vec<u8>, Failure> {
    Err(Failure::fault(
        "this kinemark was built without PNG".to_owned(),
        "write an SVG with --svg",
    ))
}
