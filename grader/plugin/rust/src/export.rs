//! The macro that exports a submission's functions, and what stands between an exported function and the author's.

use core::cell::{Cell, UnsafeCell};
use core::ffi::c_char;
use core::slice;

use crate::text::until_zero;
use crate::{Answer, Map, Observation, Robot, Rows, Submission, robot_model};

/// Exports the functions of a [`Submission`] under the names that Kinemark calls: `export!(Arm: forward_kinematics, control);`.
///
/// Name only what you wrote: a function that is missing is then reported as missing. What stands after `own` are functions of the
/// lab's own, methods `fn stiffness(&mut self, given: &Map, answer: &mut Answer)` of the type: `export!(Arm: control, own stiffness);`.
#[macro_export]
macro_rules! export {
    ($type:ty: $($names:tt)*) => {
        const _: () = {
            static STATE: $crate::private::State<$type> = $crate::private::State::new();

            // it may be left out in the list: one that is forgotten there would never be called, and nothing would say so
            #[unsafe(export_name = "km_init")]
            extern "C" fn init(robot: $crate::private::RobotAt, task: $crate::private::TextAt) {
                STATE.init(robot, task);
            }

            $crate::export!(@ $type, STATE, $($names)*);
        };
    };

    (@ $type:ty, $state:ident, $(,)?) => {};
    (@ $type:ty, $state:ident, own $($name:ident),+ $(,)?) => {
        $(
            const _: () = {
                #[unsafe(export_name = concat!("km_", stringify!($name)))]
                extern "C" fn own(given: $crate::private::MapAt, answer: $crate::private::AnswerAt) {
                    $state.own(given, answer, <$type>::$name);
                }
            };
        )+
    };
    (@ $type:ty, $state:ident, init $(, $($rest:tt)*)?) => {
        $crate::export!(@ $type, $state, $($($rest)*)?);
    };
    (@ $type:ty, $state:ident, control $(, $($rest:tt)*)?) => {
        #[unsafe(export_name = "km_control")]
        extern "C" fn control(
            observation: $crate::private::ObservationAt,
            command: $crate::private::NumbersAt,
        ) {
            $state.control(observation, command);
        }
        $crate::export!(@ $type, $state, $($($rest)*)?);
    };
    (@ $type:ty, $state:ident, forward_kinematics $(, $($rest:tt)*)?) => {
        #[unsafe(export_name = "km_forward_kinematics")]
        extern "C" fn forward_kinematics(
            robot: $crate::private::RobotAt,
            q: $crate::private::NumbersAt,
            position: $crate::private::NumbersAt,
        ) {
            $state.forward_kinematics(robot, q, position);
        }
        $crate::export!(@ $type, $state, $($($rest)*)?);
    };
    (@ $type:ty, $state:ident, inverse_kinematics $(, $($rest:tt)*)?) => {
        #[unsafe(export_name = "km_inverse_kinematics")]
        extern "C" fn inverse_kinematics(
            robot: $crate::private::RobotAt,
            position: $crate::private::NumbersAt,
            branches: $crate::private::NumbersAt,
            most: u32,
        ) -> u32 {
            $state.inverse_kinematics(robot, position, branches, most)
        }
        $crate::export!(@ $type, $state, $($($rest)*)?);
    };
    (@ $type:ty, $state:ident, jacobian $(, $($rest:tt)*)?) => {
        #[unsafe(export_name = "km_jacobian")]
        extern "C" fn jacobian(
            robot: $crate::private::RobotAt,
            q: $crate::private::NumbersAt,
            matrix: $crate::private::NumbersAt,
        ) -> u32 {
            $state.jacobian(robot, q, matrix)
        }
        $crate::export!(@ $type, $state, $($($rest)*)?);
    };
    (@ $type:ty, $state:ident, $name:ident $($rest:tt)*) => {
        ::core::compile_error!(concat!(
            "`", stringify!($name), "` is not one of init, control, forward_kinematics, inverse_kinematics, jacobian; ",
            "a function of the lab's own stands after `own`: export!(", stringify!($type), ": own ", stringify!($name), ")",
        ));
    };
    (@ $type:ty, $state:ident, $($rest:tt)*) => {
        ::core::compile_error!("write the type, a colon, and names with commas: export!(Arm: forward_kinematics, control)");
    };

    ($($other:tt)*) => {
        ::core::compile_error!("write the type, a colon, and names with commas: export!(Arm: forward_kinematics, control)");
    };
}

/// Addresses that Kinemark gives to exported functions. Nobody else can make one, so those functions are safe.
macro_rules! addresses {
    ($($name:ident($of:ty)),+) => {
        $(
            /// An address that Kinemark gives.
            #[repr(transparent)]
            pub struct $name($of);
        )+
    };
}

addresses!(
    RobotAt(*const Robot),
    ObservationAt(*const Observation),
    MapAt(*const Map),
    AnswerAt(*mut Answer),
    NumbersAt(*mut f64),
    TextAt(*const c_char)
);

/// The author's value: the state of a run.
pub struct State<T> {
    value: UnsafeCell<Option<T>>,
    is_lent: Cell<bool>,
}

// SAFETY: only exported functions reach it, which Kinemark calls one after the other in the only thread of a module
unsafe impl<T> Sync for State<T> {}

impl<T: Submission> State<T> {
    /// The state before the first call.
    #[expect(clippy::new_without_default, reason = "made in a static")]
    pub const fn new() -> Self {
        Self {
            value: UnsafeCell::new(None),
            is_lent: Cell::new(false),
        }
    }

    /// Lends the value to a call, made anew if it is the first.
    fn lend<R>(&self, call: impl FnOnce(&mut T) -> R) -> R {
        // what a call that panicked has left half done is not used again
        assert!(!self.is_lent.replace(true), "the call before did not end");
        // SAFETY: `is_lent` says that nobody else has it
        let value = unsafe { &mut *self.value.get() };
        let result = call(value.get_or_insert_default());
        self.is_lent.set(false);
        result
    }

    /// `km_init`.
    pub fn init(&self, robot: RobotAt, task: TextAt) {
        let robot = robot.lent();
        // SAFETY: Kinemark gives the address of a text
        let task = unsafe { until_zero(task.0) };
        self.lend(|submission| submission.init(robot, task));
    }

    /// `km_control`.
    pub fn control(&self, observation: ObservationAt, command: NumbersAt) {
        // SAFETY: Kinemark gives the address of an observation, which stays as it is during the call
        let observation = unsafe { &*observation.0 };
        robot_model::set_joints(observation.joints());
        // SAFETY: there is room for a number per joint, apart from the observation
        let command = unsafe { command.written(observation.joints()) };
        self.lend(|submission| submission.control(observation, command));
    }

    /// `km_forward_kinematics`.
    pub fn forward_kinematics(&self, robot: RobotAt, q: NumbersAt, position: NumbersAt) {
        let robot = robot.lent();
        // SAFETY: Kinemark gives the addresses of a number per joint, and of room for 3 numbers apart from it
        let (q, position) = unsafe { (q.given(robot.joints()), position.written(3)) };
        let reached = self.lend(|submission| submission.forward_kinematics(robot, q));
        position.copy_from_slice(&reached);
    }

    /// `km_inverse_kinematics`.
    pub fn inverse_kinematics(
        &self,
        robot: RobotAt,
        position: NumbersAt,
        branches: NumbersAt,
        most: u32,
    ) -> u32 {
        let robot = robot.lent();
        // SAFETY: Kinemark gives the addresses of 3 numbers, and of room for so many branches apart from them
        let (position, room) = unsafe {
            let room = branches.written(robot.joints() * most as usize);
            (&*position.0.cast::<[f64; 3]>(), room)
        };
        let mut branches = Rows::new(room, robot.joints());
        self.lend(|submission| submission.inverse_kinematics(robot, *position, &mut branches));
        branches.len() as u32
    }

    /// `km_jacobian`.
    pub fn jacobian(&self, robot: RobotAt, q: NumbersAt, matrix: NumbersAt) -> u32 {
        let robot = robot.lent();
        // SAFETY: Kinemark gives the addresses of a number per joint, and of room for 6 rows apart from it
        let (q, room) = unsafe { (q.given(robot.joints()), matrix.written(6 * robot.joints())) };
        let mut rows = Rows::new(room, robot.joints());
        self.lend(|submission| submission.jacobian(robot, q, &mut rows));
        rows.len() as u32
    }

    /// A function of the lab's own.
    pub fn own(&self, given: MapAt, answer: AnswerAt, function: fn(&mut T, &Map, &mut Answer)) {
        // SAFETY: Kinemark gives the addresses of a map, which stays as it is during the call, and of an answer apart from it
        let (given, answer) = unsafe { (&*given.0, &mut *answer.0) };
        self.lend(|submission| function(submission, given, answer));
    }
}

impl RobotAt {
    /// The robot of a call.
    fn lent<'a>(self) -> &'a Robot {
        // SAFETY: Kinemark gives the address of a robot, which stays as it is during the call
        let robot = unsafe { &*self.0 };
        robot_model::set_joints(robot.joints());
        robot
    }
}

impl NumbersAt {
    /// # Safety
    /// There must be so many numbers, which stay as they are for `'a`.
    unsafe fn given<'a>(self, count: usize) -> &'a [f64] {
        // SAFETY: as the caller says
        unsafe { slice::from_raw_parts(self.0, count) }
    }

    /// # Safety
    /// There must be room for so many numbers, which nobody else uses for `'a`.
    unsafe fn written<'a>(self, count: usize) -> &'a mut [f64] {
        // SAFETY: as the caller says
        unsafe { slice::from_raw_parts_mut(self.0, count) }
    }
}
