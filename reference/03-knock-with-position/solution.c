/* The reference solution of lab 3 in C: straight lines from point to point, and at each moment the command that makes the arm stand
 * where it is meant to stand. */
#include "kinemark.h"

static const double KP = 100.0;  /* N m/rad: the servo's stiffness */
static const double SPEED = 0.4; /* m/s, on the average of a line */
static const double BRISK = 1.0; /* m/s: the same in task "hold", where nothing is in the way */
static const double DWELL = 2.0; /* s: for the stays of task "hold", so that the arm comes to rest */

/* The angles that bring the hand to `position`, with the elbow bent as it is at the start. */
static void inverse_kinematics(const km_robot *robot, const double *position, double *q) {
    const double *l = km_numbers(robot->dimensions, "link_lengths");
    double u = position[0] - km_number(robot->dimensions, "base_height"), y = position[1];
    double c = (u * u + y * y - l[0] * l[0] - l[1] * l[1]) / (2.0 * l[0] * l[1]);
    double bend = acos(km_clamp(c, -1.0, 1.0));
    q[0] = atan2(y, u) - atan2(l[1] * sin(bend), l[0] + l[1] * cos(bend));
    q[1] = bend;
}

static const km_robot *the_robot;
static double start[3], began;
static km_u32 leg; /* 0 before the first call; leg 1 leads from the start to the first point */

void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
    leg = 0;
    began = 0.0;
}

void km_control(const km_observation *observation, double *command) {
    int hold = km_is(observation->task, "hold");
    const char *name = hold ? "target" : "points";
    const double *points = km_numbers(observation->target, name);
    km_u32 legs = km_count(observation->target, name) / 3;
    if (leg == 0) {
        for (int i = 0; i < 3; i++) start[i] = observation->tcp[i];
        leg = 1;
    }
    const double *to = points + 3 * (leg - 1), *from = leg == 1 ? start : to - 3;
    double way[3];
    for (int i = 0; i < 3; i++) way[i] = to[i] - from[i];
    double duration = km_norm(way, 3) / (hold ? BRISK : SPEED);
    double since = observation->time - began;
    if (since >= duration + (hold ? DWELL : 0.0) && leg < legs) {
        leg++;
        began = observation->time;
    }
    double s = km_quintic(since / duration);
    double position[3], q[2], gravity[2];
    for (int i = 0; i < 3; i++) position[i] = km_lerp(from[i], to[i], s);
    inverse_kinematics(the_robot, position, q);
    /* at rest the servo gives KP (command - q), and the arm needs gravity(q) */
    km_gravity(q, gravity);
    for (int i = 0; i < 2; i++) command[i] = q[i] + gravity[i] / KP;
}
