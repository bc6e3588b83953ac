/* Lab 6: one program for every robot.
 *
 * A robot is typed as a row such as "RzTxRy": two letters for a joint. R turns (q in rad), T and P slide (q in m); then the axis. Its
 * dimensions are base_height, the height of the first joint in m, and link1, link2 and on: 3 numbers in m from a joint to the next, and
 * from the last one to the tip. All frames are aligned with the base at q = 0: x forward, y to the left, z up. Rows, sizes and the number
 * of joints differ from case to case: take all of them from the robot.
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *     kinemark grade
 */
#include "kinemark.h"

static const double HOME[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* Task "last-joint". The pose of the last joint: after its own motion, before the last link. Answer 4 rows of 4 numbers.
 *     km_find(*given, "robot.name")->text                 the row; strlen of it is twice the number of joints
 *     km_numbers(*given, "q")                             the joints, in rad or m
 *     km_number(*given, "robot.base_height")              m
 *     km_numbers(*given, "robot.link1")                   3 numbers in m */
KM_EXPORT(km_last_joint) void km_last_joint(const km_map *given, km_answer *answer) {
    (void)given;
    km_answer_matrix(answer, 0, HOME, 4, 4);
}

/* Task "tip". The pose of the tip, where the last link ends. Answer 4 rows of 4 numbers. It is given the same. */
KM_EXPORT(km_tip) void km_tip(const km_map *given, km_answer *answer) {
    (void)given;
    km_answer_matrix(answer, 0, HOME, 4, 4);
}

/* Task "jacobian". How does the tip move when the joints do? Write 6 rows of one number per joint, the velocity x, y, z of the tip, then its
 * angular velocity about x, y, z, and return how many rows you wrote.
 *     robot->name, robot->joints                          the row, and how many joints it has
 *     km_number(robot->dimensions, "base_height")         m; here the names have no "robot." before them
 *     km_numbers(robot->dimensions, "link1")              3 numbers in m */
km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix) {
    (void)q;
    for (km_u32 i = 0; i < 6 * robot->joints; i++) matrix[i] = 0.0;
    return 6;
}

static const km_robot *the_robot;

/* Called once before each run. What you keep outside of the functions is still there in `km_control`. */
void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
}

/* Task "move". Called every 10 ms: write the velocities of the three joints, in rad/s, or in m/s where a joint slides.
 *     observation->q          the joints now, in rad or m
 *     observation->tcp        where the tip is now, x, y and z in m
 *     observation->time       s since the start
 *     observation->target     what is asked for: km_numbers(observation->target, "from")
 *         from, to            the two ends of the line, x, y and z in m; the tip starts at `from`
 *         speed               how fast the tip should go along it, in m/s
 * km_solve and km_norm are in kinemark.h. */
void km_control(const km_observation *observation, double *command) {
    (void)observation, (void)the_robot;
    command[0] = 0.0, command[1] = 0.0, command[2] = 0.0;
}
