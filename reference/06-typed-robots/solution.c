/* The reference solution of lab 6 in C: one walk along the row, from joint to joint, gives the poses; the axes and places of the joints
 * that it passes give the Jacobian. */
#include "kinemark.h"

#define MOST_JOINTS 12

static const double GAIN = 5.0; /* 1/s: a tip that is off comes back with a time constant of 0.2 s */

/* A pose: 4 x 4 numbers, row by row. */
typedef struct pose {
    double h[4][4];
} pose;

static pose product(const pose *a, const pose *b) {
    pose all;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++) sum += a->h[row][k] * b->h[k][column];
            all.h[row][column] = sum;
        }
    return all;
}

static pose shift(double x, double y, double z) {
    pose all = {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}}};
    return all;
}

/* A turn takes the axis after its own towards the one after that: about x it takes y to z, about y z to x, about z x to y. */
static pose turn(int axis, double angle) {
    int next = (axis + 1) % 3, last = (axis + 2) % 3;
    pose all = shift(0.0, 0.0, 0.0);
    all.h[next][next] = cos(angle);
    all.h[last][last] = cos(angle);
    all.h[last][next] = sin(angle);
    all.h[next][last] = -sin(angle);
    return all;
}

/* The axis of joint i: 0, 1 or 2 for x, y or z. */
static int axis(const char *row, km_u32 i) { return row[2 * i + 1] - 'x'; }

static int turns(const char *row, km_u32 i) { return row[2 * i] == 'R'; }

/* What joint i does when it moves by q. */
static pose motion(const char *row, km_u32 i, double q) {
    if (turns(row, i)) return turn(axis(row, i), q);
    double way[3] = {0.0, 0.0, 0.0};
    way[axis(row, i)] = q;
    return shift(way[0], way[1], way[2]);
}

/* The frames in which the n joints move, one for each, then the last joint after its motion, then the tip. `prefix` is what the names of
 * the dimensions begin with. Returns n. */
static km_u32 frames(const char *row, km_map of, const char *prefix, const double *q, pose *all) {
    char name[32];
    km_u32 start = (km_u32)strlen(prefix), n = (km_u32)strlen(row) / 2;
    if (n > MOST_JOINTS) km_fail("a row has at most 12 joints here");
    memcpy(name, prefix, start);
    memcpy(name + start, "base_height", 12);
    pose h = shift(0.0, 0.0, km_number(of, name));
    for (km_u32 i = 0; i < n; i++) {
        all[i] = h;
        pose move = motion(row, i, q[i]);
        all[n] = product(&h, &move);
        memcpy(name + start, "link", 4);
        km_u32 at = start + 4;
        if (i >= 9) name[at++] = (char)('0' + (i + 1) / 10);
        name[at++] = (char)('0' + (i + 1) % 10);
        name[at] = 0;
        const double *l = km_numbers(of, name);
        pose link = shift(l[0], l[1], l[2]);
        h = product(&all[n], &link);
    }
    all[n + 1] = h;
    return n;
}

/* The pose that lies `beyond` the last joint: 0 for itself, 1 for the tip. */
static void answer_pose(const km_map *given, km_answer *answer, km_u32 beyond) {
    pose all[MOST_JOINTS + 2];
    const char *row = km_find(*given, "robot.name")->text;
    km_u32 n = frames(row, *given, "robot.", km_numbers(*given, "q"), all);
    km_answer_matrix(answer, 0, &all[n + beyond].h[0][0], 4, 4);
}

KM_EXPORT(km_last_joint) void km_last_joint(const km_map *given, km_answer *answer) { answer_pose(given, answer, 0); }

KM_EXPORT(km_tip) void km_tip(const km_map *given, km_answer *answer) { answer_pose(given, answer, 1); }

km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix) {
    pose all[MOST_JOINTS + 2];
    const char *row = robot->name;
    km_u32 n = frames(row, robot->dimensions, "", q, all);
    for (km_u32 i = 0; i < n; i++) {
        double a[3], lever[3];
        for (int k = 0; k < 3; k++) {
            a[k] = all[i].h[k][axis(row, i)];
            lever[k] = all[n + 1].h[k][3] - all[i].h[k][3];
        }
        for (int k = 0; k < 3; k++) {
            int next = (k + 1) % 3, last = (k + 2) % 3;
            int turned = turns(row, i);
            double linear = turned ? a[next] * lever[last] - a[last] * lever[next] : a[k];
            matrix[n * (km_u32)k + i] = linear + 0.0; /* a zero has no sign in the script, which gives the same bits */
            matrix[n * (km_u32)(k + 3) + i] = turned ? a[k] : 0.0;
        }
    }
    return 6;
}

static const km_robot *the_robot;

void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
}

void km_control(const km_observation *observation, double *command) {
    const double *from = km_numbers(observation->target, "from"), *to = km_numbers(observation->target, "to");
    double speed = km_number(observation->target, "speed");
    double line[3], v[3], j[6 * MOST_JOINTS];
    for (int k = 0; k < 3; k++) line[k] = to[k] - from[k];
    double length = km_norm(line, 3);
    double done = fmin(speed * observation->time, length);
    for (int k = 0; k < 3; k++) {
        double along = line[k] / length;
        v[k] = (from[k] + along * done - observation->tcp[k]) * GAIN;
        if (done < length) v[k] += along * speed;
    }
    km_jacobian(the_robot, observation->q, j); /* three joints: its first nine numbers are the rows of the position */
    km_solve(j, v, command, 3);
}
