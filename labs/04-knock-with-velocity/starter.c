/* Lab 4: two straight lines.
 *
 * Angles are radians, lengths metres. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the elbow,
 * relative to the upper arm.
 *
 * The lengths of the arm, the points and the speed may differ from student to student, and the course's hidden run has another
 * line and another speed: take them from `robot` and `observation->target`, never type them in.
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *     kinemark grade
 */
#include "kinemark.h"

static const km_robot *the_robot;
static int segment; /* which line the hand is on: 0 or 1 */

/* Called once before the run. What you keep outside of the functions is still there in `km_control`. */
void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot; /* km_numbers(robot->dimensions, "link_lengths"): upper arm and forearm */
    segment = 0;
}

/* Task "jacobian": how fast does the hand move when the joints turn? Rows x and y, one column per joint, in m/rad:
 *     dx/dq1, dx/dq2,
 *     dy/dq1, dy/dq2
 * Return how many rows you wrote. Bring your answer from lab 2. It is judged for arms of other lengths too, and `km_control` below
 * uses it. */
km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix) {
    (void)robot, (void)q;
    matrix[0] = 1.0, matrix[1] = 0.0;
    matrix[2] = 0.0, matrix[3] = 1.0;
    return 2;
}

/* Task "knock". Called every 10 ms. Write the two speeds, rad/s, that the joints should have.
 * observation->time (s), q, qd (rad, rad/s), tcp (the hand: x, y and z in m), target:
 *   points    three positions, x, y and z of each: go straight from the first to the second, and straight on to the third
 *   speed     how fast, m/s
 *   can       the middle of the can
 *   shelf_top the height of the shelf
 * km_numbers(observation->target, "points") are nine numbers, km_number(observation->target, "speed") is one. */
void km_control(const km_observation *observation, double *command) {
    /* First: the velocity {vx, vy} that takes the hand along the line it is on. A direction is a difference of two points divided
     * by its `km_norm`. */
    double v[2] = {0.0, 0.0};

    /* Then: steer back to the line, and go over to the second line when the first is done. */

    double j[4];
    km_jacobian(the_robot, observation->q, j);
    km_solve(j, v, command, 2);
}
