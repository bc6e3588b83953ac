/* The reference solution of lab 5 in C: closed forms, and one place of the path after the other at the speed of the drives. */
#include "kinemark.h"

typedef struct arm {
    double column, carriage, side, reach, drop, gripper;
} arm;

/* The lengths in a map, whose names begin with `robot.` in the arguments of functions of the lab's own. */
static arm of_given(const km_map *given) {
    return (arm){
        km_number(*given, "robot.column"), km_number(*given, "robot.carriage"), km_number(*given, "robot.side"),
        km_number(*given, "robot.reach"),  km_number(*given, "robot.drop"),     km_number(*given, "robot.gripper"),
    };
}

static arm of_robot(const km_robot *robot) {
    km_map map = robot->dimensions;
    return (arm){
        km_number(map, "column"), km_number(map, "carriage"), km_number(map, "side"),
        km_number(map, "reach"),  km_number(map, "drop"),     km_number(map, "gripper"),
    };
}

/* How far the TCP is ahead of the column's axis: A of the brief. */
static double ahead(const arm *l, const double *q) { return l->reach + l->gripper - q[2]; }

KM_EXPORT(km_tcp_pose) void km_tcp_pose(const km_map *given, km_answer *answer) {
    arm l = of_given(given);
    const double *q = km_numbers(*given, "q");
    double a = ahead(&l, q), c1 = cos(q[0]), s1 = sin(q[0]), c4 = cos(q[3]), s4 = sin(q[3]);
    double pose[16] = {
        -c1 * s4, -c1 * c4, -s1, l.side * c1 - a * s1,
        -s1 * s4, -s1 * c4, c1, l.side * s1 + a * c1,
        -c4, s4, 0.0, l.column + l.carriage - l.drop + q[1],
        0.0, 0.0, 0.0, 1.0,
    };
    km_answer_matrix(answer, 0, pose, 4, 4);
}

static void branch(const arm *l, const double *p, double a, double *q) {
    q[0] = atan2(p[1] * l->side - p[0] * a, p[0] * l->side + p[1] * a);
    q[1] = p[2] + l->drop - l->column - l->carriage;
    q[2] = l->reach + l->gripper - a;
}

km_u32 km_inverse_kinematics(const km_robot *robot, const double *position, double *branches, km_u32 most) {
    arm l = of_robot(robot);
    double squared = position[0] * position[0] + position[1] * position[1] - l.side * l.side;
    /* the edge of the hole is within reach; rounding may put it a little inside */
    if (squared < -1e-12 || most < 2) return 0;
    double a = sqrt(fmax(squared, 0.0));
    branch(&l, position, a, branches);
    branch(&l, position, -a, branches + 3);
    return 2;
}

KM_EXPORT(km_velocity) void km_velocity(const km_map *given, km_answer *answer) {
    arm l = of_given(given);
    const double *q = km_numbers(*given, "q"), *qd = km_numbers(*given, "qd");
    double a = ahead(&l, q), c1 = cos(q[0]), s1 = sin(q[0]);
    double v[3] = {
        -qd[0] * (a * c1 + l.side * s1) + qd[2] * s1,
        -qd[0] * (a * s1 - l.side * c1) - qd[2] * c1,
        qd[1],
    };
    km_answer_list(answer, 0, v, 3);
}

KM_EXPORT(km_acceleration) void km_acceleration(const km_map *given, km_answer *answer) {
    arm l = of_given(given);
    const double *q = km_numbers(*given, "q"), *qd = km_numbers(*given, "qd"), *qdd = km_numbers(*given, "qdd");
    double a = ahead(&l, q), c1 = cos(q[0]), s1 = sin(q[0]);
    double x = a * c1 + l.side * s1, y = a * s1 - l.side * c1;
    double result[3] = {
        -qdd[0] * x + qdd[2] * s1 + qd[0] * qd[0] * y + 2.0 * qd[0] * qd[2] * c1,
        -qdd[0] * y - qdd[2] * c1 - qd[0] * qd[0] * x + 2.0 * qd[0] * qd[2] * s1,
        qdd[1],
    };
    km_answer_list(answer, 0, result, 3);
}

KM_EXPORT(km_joint_rates) void km_joint_rates(const km_map *given, km_answer *answer) {
    arm l = of_given(given);
    const double *q = km_numbers(*given, "q"), *v = km_numbers(*given, "v");
    double a = ahead(&l, q), c1 = cos(q[0]), s1 = sin(q[0]);
    /* beside the column, turn and reach move the TCP along the same line: then the turn rests */
    double turn = fabs(a) > 1e-9 ? -(v[0] * c1 + v[1] * s1) / a : 0.0;
    km_answer_number(answer, "turn", turn);
    km_answer_number(answer, "lift", v[2]);
    km_answer_number(answer, "reach", l.side * turn + s1 * v[0] - c1 * v[1]);
}

KM_EXPORT(km_joint_accelerations) void km_joint_accelerations(const km_map *given, km_answer *answer) {
    arm l = of_given(given);
    const double *q = km_numbers(*given, "q"), *qd = km_numbers(*given, "qd"), *wanted = km_numbers(*given, "a");
    double a = ahead(&l, q), c1 = cos(q[0]), s1 = sin(q[0]), w = qd[0];
    double turn = -(wanted[0] * c1 + wanted[1] * s1 + l.side * w * w - 2.0 * w * qd[2]) / a;
    km_answer_number(answer, "turn", turn);
    km_answer_number(answer, "lift", wanted[2]);
    km_answer_number(answer, "reach", l.side * turn - a * w * w + s1 * wanted[0] - c1 * wanted[1]);
}

static const double top_speed[4] = {18.0 * KM_PI / 180.0, 0.02, 0.02, KM_PI}; /* rad/s, m/s, m/s, rad/s */
static const double gain = 10.0; /* 1/s: near a place the arm slows down with a time constant of 0.1 s */

static const km_robot *the_robot;
static int place;

void km_init(const km_robot *robot, const char *task) {
    (void)task;
    the_robot = robot;
    place = 0;
}

void km_control(const km_observation *observation, double *command) {
    double goal[6], off[4];
    if (km_inverse_kinematics(the_robot, km_numbers(observation->target, "target") + 3 * place, goal, 2) == 0) km_fail("a place is out of reach");
    goal[3] = 0.0;
    for (int i = 0; i < 4; i++) off[i] = goal[i] - observation->q[i];
    /* at its switch the lift is at its end, wherever the drawing has it */
    int is_down = km_number(observation->sensors, "lift_lower") != 0.0, is_up = km_number(observation->sensors, "lift_upper") != 0.0;
    if ((is_down && off[1] < 0.0) || (is_up && off[1] > 0.0)) off[1] = 0.0;
    if (km_norm(off, 4) < 5e-4 && place < 5) place++;
    for (int i = 0; i < 4; i++) command[i] = km_clamp(off[i] * gain, -top_speed[i], top_speed[i]);
}
