//! The step response of a joint under sampled PID servos: the run in the simulator, the linear theory of the joint alone, the measures
//! of both, and the gains and periods at which the loop is stable.
//!
//! All driven joints have the same gains. One gets the step; the others are commanded to stay at the start, or at velocity zero. The
//! measures are those of the checks of a lab ([`kinemark_sim::control::step_metrics`]).

mod analysis;
mod linear_theory;
mod response_facts;
mod response_record;
mod response_run;
mod response_table;
mod settings;
mod stability_limit;
mod sweep;

pub use analysis::{Analysis, Measured, NoMeasure, Response, analyse};
pub use linear_theory::LinearTheory;
pub use response_facts::{facts, response_text, title};
pub use response_record::response_record;
pub use response_run::{Divergence, OtherJoint, RunCurves};
pub use response_table::{ResponseTable, response_table};
pub use settings::{PidGains, ResponseError, ResponseSettings, Surroundings, joint_entry};
pub use stability_limit::{GainLimit, StabilityLimit};
pub use sweep::{MOST_VALUES, Sweep, Varied, gravity_m_s2};
