/* The reference solution of lab 1 in C: closed forms, and quintic moves between the two places. */
#include "kinemark.h"

static const double DWELL = 0.9; /* s, more than is asked for: the arm settles while it stands */
static const double MOVE = 1.6;  /* s */

void km_forward_kinematics(const km_robot *robot, const double *q, double *position) {
    const double *l = km_numbers(robot->dimensions, "link_lengths");
    position[0] = km_number(robot->dimensions, "base_height") + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]);
    position[1] = l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]);
    position[2] = 2.0 * km_number(robot->dimensions, "link_offset");
}

static void branch(double u, double y, const double *l, double bend, double *q) {
    q[0] = atan2(y, u) - atan2(l[1] * sin(bend), l[0] + l[1] * cos(bend));
    q[1] = bend;
}

km_u32 km_inverse_kinematics(const km_robot *robot, const double *position, double *branches, km_u32 most) {
    const double *l = km_numbers(robot->dimensions, "link_lengths");
    double u = position[0] - km_number(robot->dimensions, "base_height"), y = position[1];
    double c = (u * u + y * y - l[0] * l[0] - l[1] * l[1]) / (2.0 * l[0] * l[1]);
    /* the boundary itself is in reach; what lies beyond it by more than rounding is not */
    if (fabs(c) > 1.0 + 1e-9 || most < 2) return 0;
    double bend = acos(km_clamp(c, -1.0, 1.0));
    branch(u, y, l, bend, branches);
    branch(u, y, l, -bend, branches + 2);
    return 2;
}

static const km_robot *the_robot;
static int leg;
static double from[2], goals[2][2], start;

void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
    leg = 0;
}

void km_control(const km_observation *observation, double *command) {
    if (leg == 0) {
        const double *targets = km_numbers(observation->target, "target");
        for (int i = 0; i < 2; i++) {
            double both[4];
            if (km_inverse_kinematics(the_robot, targets + 3 * i, both, 2) == 0) km_fail("a place is out of reach");
            /* the elbow bends the same way at both places */
            goals[i][0] = both[0], goals[i][1] = both[1];
            from[i] = observation->q[i];
        }
        /* the shoulder takes the short way round */
        goals[1][0] = goals[0][0] + km_wrap_pi(goals[1][0] - goals[0][0]);
        start = 0.0;
        leg = 1;
    }
    if (leg == 1 && observation->time >= start + MOVE + DWELL) {
        from[0] = goals[0][0], from[1] = goals[0][1];
        start = observation->time;
        leg = 2;
    }
    double s = km_quintic((observation->time - start) / MOVE);
    for (int i = 0; i < 2; i++) command[i] = km_lerp(from[i], goals[leg - 1][i], s);
}
