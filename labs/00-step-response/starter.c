/* Lab 0: what does a motor do when the command jumps?
 *
 * Angles are radians: x is up, y is sideways, and both links point straight up at q = {0, 0}. A positive torque turns a joint
 * the way its angle grows.
 *
 * Your neighbour's arm may have other lengths, steps and gains. Read yours from `robot` and `observation->target`; do not type
 * them in. km_number(observation->target, "kp") is a number of the target; kinemark.h says what else there is.
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *     kinemark grade
 */
#include "kinemark.h"

/* Task 2, "position-loop". `given` has
 *     mass (kg), length, width (m)   of the forearm, a box that turns about one of its ends
 *     damping (N m s/rad)            of the joint
 *     kp, ki, kd                     the gains, in N m/rad, N m/(rad s), N m s/rad
 *     load_torque (N m)              a constant load at the joint
 * km_number(*given, "mass") is the first of them. Replace each -1. */
KM_EXPORT(km_position_loop) void km_position_loop(const km_map *given, km_answer *answer) {
    (void)given;
    km_answer_number(answer, "inertia", -1.0);           /* about the joint, kg m^2 */
    km_answer_number(answer, "natural_frequency", -1.0); /* rad/s */
    km_answer_number(answer, "damping_ratio", -1.0);
    km_answer_number(answer, "steady_state_error", -1.0); /* what the load leaves at rest, rad */
}

/* Task 4, "velocity-loop". `given` has inertia (kg m^2), damping (N m s/rad), kp (N m s/rad), period (s). */
KM_EXPORT(km_velocity_loop) void km_velocity_loop(const km_map *given, km_answer *answer) {
    (void)given;
    km_answer_number(answer, "final_speed", -1.0);   /* with kp alone, as a share of the setpoint */
    km_answer_number(answer, "time_constant", -1.0); /* with kp alone, s */
    km_answer_number(answer, "largest_kp", -1.0);    /* above it the sampled loop diverges, N m s/rad */
    km_answer_number(answer, "largest_kd", -1.0);    /* above it a derivative in this loop diverges, kg m^2 */
}

static double sum[2]; /* room for the integrals of two errors */

/* Called once before each run. What you keep outside of the functions is still there in `km_control`. */
void km_init(const km_robot *robot, const char *task) {
    (void)robot, (void)task;
    sum[0] = sum[1] = 0.0;
}

/* observation->q and observation->qd are the angles and speeds of both joints, observation->dt is the time between two calls,
 * observation->target what the task wants. */
void km_control(const km_observation *observation, double *command) {
    if (km_is(observation->task, "warm-up")) {
        /* Task 1: a servo turns the joints to the angles that you write, {shoulder, elbow} in rad */
        command[0] = 0.5, command[1] = 0.0;
        return;
    }
    /* From here on there is no servo: you write the motors' torques, {shoulder, elbow} in N m, every millisecond */
    if (km_is(observation->task, "pid")) {
        /* Task 3: the elbow to the target's elbow_rad, the shoulder at 0, with its kp, ki, kd */
        command[0] = 0.0, command[1] = 0.0;
        return;
    }
    if (km_is(observation->task, "speed")) {
        /* Task 5: the elbow at the target's elbow_rad_s, the shoulder held, with its kp and ki */
        command[0] = 0.0, command[1] = 0.0;
        return;
    }
    /* Task 6, "hold": the elbow to the target's elbow_rad exactly. Here km_gravity(q, torques) writes the torques that hold the arm
     * still. */
    command[0] = 0.0, command[1] = 0.0;
}
