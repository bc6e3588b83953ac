/* The reference solution of lab 4 in C: the hand goes along each line at the speed asked for and is steered back to the line beside it;
 * the inverse of the Jacobian turns the hand's velocity into those of the joints. */
#include "kinemark.h"

static const double BACK = 6.0; /* 1/s: how quickly the hand goes back to the line */

/* Rows x and y of the hand's velocity by the speeds of the two joints. */
km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix) {
    const double *l = km_numbers(robot->dimensions, "link_lengths");
    double s1 = l[0] * sin(q[0]), c1 = l[0] * cos(q[0]);
    double s12 = l[1] * sin(q[0] + q[1]), c12 = l[1] * cos(q[0] + q[1]);
    matrix[0] = -s1 - s12, matrix[1] = -s12;
    matrix[2] = c1 + c12, matrix[3] = c12;
    return 2;
}

static const km_robot *the_robot;
static km_u32 segment; /* which line the hand is on */

void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
    segment = 0;
}

void km_control(const km_observation *observation, double *command) {
    const double *points = km_numbers(observation->target, "points");
    km_u32 last = km_count(observation->target, "points") / 3 - 2;
    const double *from = points + 3 * segment, *to = from + 3;
    double line[2] = {to[0] - from[0], to[1] - from[1]};
    double length = km_norm(line, 2);
    double along[2] = {line[0] / length, line[1] / length};

    double ahead[2] = {to[0] - observation->tcp[0], to[1] - observation->tcp[1]};
    double left = km_dot(ahead, along, 2); /* how much of the line lies ahead */
    if (left <= 0.0 && segment < last) segment++;

    /* at the very end the hand comes to rest on the last point */
    double speed = km_number(observation->target, "speed");
    if (segment == last) speed = fmin(speed, BACK * left);

    double v[2], j[4];
    for (int i = 0; i < 2; i++) {
        double beside = ahead[i] - left * along[i]; /* from the hand to the line, straight across */
        v[i] = speed * along[i] + BACK * beside;
    }
    km_jacobian(the_robot, observation->q, j);
    km_solve(j, v, command, 2);
}
