/* The reference solution of lab 2 in C: the Jacobian in closed form, the speed of the line fed forward, what the hand is off fed back,
 * and damped least squares so that the inverse stays finite where the arm folds. */
#include "kinemark.h"

static const double RAMP = 0.3;     /* s, from rest to full speed, within the first 5 cm */
static const double GAIN = 5.0;     /* 1/s: a hand that is off comes back with a time constant of 0.2 s */
static const double DAMPING = 0.05; /* m: far below the lengths of the links, far above what the hand is off */

km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix) {
    const double *l = km_numbers(robot->dimensions, "link_lengths");
    double s1 = l[0] * sin(q[0]), c1 = l[0] * cos(q[0]);
    double s12 = l[1] * sin(q[0] + q[1]), c12 = l[1] * cos(q[0] + q[1]);
    matrix[0] = -s1 - s12, matrix[1] = -s12;
    matrix[2] = c1 + c12, matrix[3] = c12;
    return 2;
}

/* How far along the line the hand is after t, and how fast: from rest to the speed, steady, and to rest again. */
static void progress(double length, double speed, double t, double *way, double *rate) {
    double end = length / speed + RAMP;
    if (t < RAMP) {
        *way = 0.5 * speed * t * t / RAMP;
        *rate = speed * t / RAMP;
    } else if (t < end - RAMP) {
        *way = speed * (t - 0.5 * RAMP);
        *rate = speed;
    } else {
        double left = end > t ? end - t : 0.0;
        *way = length - 0.5 * speed * left * left / RAMP;
        *rate = speed * left / RAMP;
    }
}

static const km_robot *the_robot;

void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
}

void km_control(const km_observation *observation, double *command) {
    const double *from = km_numbers(observation->target, "from"), *to = km_numbers(observation->target, "to");
    double way[3];
    for (int i = 0; i < 3; i++) way[i] = to[i] - from[i];
    double length = km_norm(way, 3);
    double done, speed;
    progress(length, km_number(observation->target, "speed"), observation->time, &done, &speed);

    double v[2]; /* only x and y: z is the arm's own */
    for (int i = 0; i < 2; i++) {
        double along = way[i] / length;
        double off = from[i] + along * done - observation->tcp[i];
        v[i] = along * speed + off * GAIN;
    }

    /* qd = J^T (J J^T + d^2)^-1 v */
    double j[4], damped[4], w[2];
    km_jacobian(the_robot, observation->q, j);
    for (int row = 0; row < 2; row++)
        for (int column = 0; column < 2; column++) {
            double product = km_dot(j + 2 * row, j + 2 * column, 2);
            damped[2 * row + column] = row == column ? product + DAMPING * DAMPING : product;
        }
    km_solve(damped, v, w, 2);
    for (int i = 0; i < 2; i++) command[i] = j[i] * w[0] + j[2 + i] * w[1];

    /* too fast for a joint: both slower by the same factor, so that the hand keeps its direction */
    double fastest = fmax(fmax(fabs(command[0]), fabs(command[1])), 1e-9);
    double share = fmin(1.0, km_number(observation->target, "max_rate") / fastest);
    for (int i = 0; i < 2; i++) command[i] *= share;
}
