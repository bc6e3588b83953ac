/* Lab 5: an industrial arm.
 *
 * Angles are radians, lengths are metres. The joints are turn, lift, reach and the turn of the gripper; q[2] counts backwards: where it
 * grows, the arm is drawn in. The lengths are column, carriage, side, reach, drop and gripper. Your arm may differ from your
 * neighbour's, and from hidden cases: take every length from the robot, and never type it in.
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *     kinemark grade
 */
#include "kinemark.h"

/* Task "fk". The pose of the TCP: the axes of the gripper and the position in the frame of the base, row by row.
 * km_number(*given, "robot.side") is a length, km_numbers(*given, "q") are the positions of the four joints. */
KM_EXPORT(km_tcp_pose) void km_tcp_pose(const km_map *given, km_answer *answer) {
    (void)given;
    double pose[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    km_answer_matrix(answer, 0, pose, 4, 4);
}

/* Task "ik". Write q1, q2 and q3 of every way to bring the TCP to position = {x, y, z}, one after the other, and return how many
 * ways there are. Here the lengths are km_number(robot->dimensions, "side") and so on. */
km_u32 km_inverse_kinematics(const km_robot *robot, const double *position, double *branches, km_u32 most) {
    (void)robot, (void)position, (void)branches, (void)most;
    return 0;
}

/* Task "velocity". vx, vy and vz of the TCP in m/s; `given` has "q" and "qd" of the four joints. */
KM_EXPORT(km_velocity) void km_velocity(const km_map *given, km_answer *answer) {
    (void)given;
    double v[3] = {0.0, 0.0, 0.0};
    km_answer_list(answer, 0, v, 3);
}

/* Task "acceleration". ax, ay and az of the TCP in m/s^2; `given` has "q", "qd" and "qdd" of the four joints. */
KM_EXPORT(km_acceleration) void km_acceleration(const km_map *given, km_answer *answer) {
    (void)given;
    double a[3] = {0.0, 0.0, 0.0};
    km_answer_list(answer, 0, a, 3);
}

/* Task "rates". The rates of the joints that give the TCP the velocity "v"; "q" has the positions of the first three joints. */
KM_EXPORT(km_joint_rates) void km_joint_rates(const km_map *given, km_answer *answer) {
    (void)given;
    km_answer_number(answer, "turn", 0.0);
    km_answer_number(answer, "lift", 0.0);
    km_answer_number(answer, "reach", 0.0);
}

/* Task "accelerations". The accelerations of the joints that give the TCP the acceleration "a", with "q" and "qd" of three joints. */
KM_EXPORT(km_joint_accelerations) void km_joint_accelerations(const km_map *given, km_answer *answer) {
    (void)given;
    km_answer_number(answer, "turn", 0.0);
    km_answer_number(answer, "lift", 0.0);
    km_answer_number(answer, "reach", 0.0);
}

static const km_robot *the_robot;

/* Called once before each run. What you keep outside of the functions is still there in `km_control`. */
void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
}

/* Task "pick". Called every 10 ms: write the rates of the four joints, rad/s, m/s, m/s and rad/s.
 *     observation->q          the joints now, in rad, m, m and rad
 *     observation->target     km_numbers(observation->target, "target") are the six places for the TCP, x, y and z of each
 *     observation->sensors    km_number(observation->sensors, "lift_lower") is 1 while the switch is pressed, and 0 otherwise
 * km_inverse_kinematics is your own function, and needs room for all branches. */
void km_control(const km_observation *observation, double *command) {
    (void)observation, (void)the_robot;
    command[0] = 0.0, command[1] = 0.0, command[2] = 0.0, command[3] = 0.0;
}
