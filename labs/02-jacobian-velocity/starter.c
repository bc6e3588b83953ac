/* Lab 2: how do I make the hand move?
 *
 * Angles are radians, joint velocities rad/s. x is up, y is sideways. q[0] is the shoulder, q[1] the elbow; the elbow's angle is
 * relative to the upper arm, and both links point straight up at q = {0, 0}.
 * Your arm, line and speed may differ from your neighbour's, and from hidden runs: take every number from `robot` and
 * `observation->target`, and never type it in.
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *     kinemark grade
 */
#include "kinemark.h"

/* Task "jacobian". How fast does the hand move when the joints turn? Write two rows, x then y, of one number per joint, and return how
 * many rows you wrote:
 *     dx/dq1, dx/dq2,
 *     dy/dq1, dy/dq2      in m/rad
 * km_numbers(robot->dimensions, "link_lengths") are two lengths in m: upper arm, forearm. */
km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix) {
    (void)robot, (void)q;
    matrix[0] = 0.0, matrix[1] = 0.0;
    matrix[2] = 0.0, matrix[3] = 0.0;
    return 2;
}

static const km_robot *the_robot;

/* Called once before each run. What you keep outside of the functions is still there in `km_control`. */
void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
}

/* Tasks "line" and "through-the-shoulder". Called every 10 ms: write the two joint velocities in rad/s.
 *     observation->q          the joint angles now, q1 and q2 in rad
 *     observation->qd         their velocities, in rad/s
 *     observation->tcp        where the hand is now, x, y and z in m
 *     observation->time       s since the start
 *     observation->target     what is asked for: km_numbers(observation->target, "from")
 *         from, to            the two ends of the line, x, y and z in m; the hand starts at `from`
 *         speed               how fast the hand should go along it, in m/s
 *         max_rate            how fast a joint may turn, in rad/s
 *     observation->task       the name of the task
 * km_solve and km_norm are in kinemark.h. */
void km_control(const km_observation *observation, double *command) {
    (void)observation, (void)the_robot;
    command[0] = 0.0, command[1] = 0.0;
}
