/* Lab 1: where is the hand, and how do I get it there?
 *
 * Angles are radians. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the elbow; the elbow's angle
 * is relative to the upper arm, and both links point straight up at q = {0, 0}.
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *     kinemark grade
 */
#include "kinemark.h"

/* Where is the hand? Write x, y and z in metres.
 * km_number(robot->dimensions, "base_height") and "link_offset" are numbers, km_numbers(robot->dimensions, "link_lengths") are two. */
void km_forward_kinematics(const km_robot *robot, const double *q, double *position) {
    (void)robot, (void)q;
    position[0] = 0.0, position[1] = 0.0, position[2] = 0.0;
}

/* Which angles bring the hand to position = {x, y, z}? Write every way to get there, q1 and q2 of the first, then those of the next,
 * and return how many ways there are: 0 where there is none. */
km_u32 km_inverse_kinematics(const km_robot *robot, const double *position, double *branches, km_u32 most) {
    (void)robot, (void)position, (void)branches, (void)most;
    return 0;
}

/* Task "move", called every 10 ms: write the two joint angles that the motors should go to. */
void km_control(const km_observation *observation, double *command) {
    /* km_numbers(observation->target, "target") are the two places to go to, x, y and z of each; observation->time is the time in
     * seconds. What you keep outside of the functions is still there at the next call; `km_init` gets the robot before the first. */
    command[0] = observation->q[0], command[1] = observation->q[1];
}
