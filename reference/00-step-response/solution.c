/* The reference solution of lab 0 in C: one PID law, one PI law, and gravity taken out of the loop where it stands in the way. */
#include "kinemark.h"

enum { JOINTS = 2 };

/* The loop J a + (b + kd) v + kp x of a joint with a PD controller: how it answers, and what a constant load leaves over. */
KM_EXPORT(km_position_loop) void km_position_loop(const km_map *given, km_answer *answer) {
    double mass = km_number(*given, "mass"), length = km_number(*given, "length"), width = km_number(*given, "width");
    double kp = km_number(*given, "kp"), kd = km_number(*given, "kd");
    /* a box that turns about one end: about its own middle, then moved by half its length */
    double half = length / 2.0;
    double inertia = mass * (length * length + width * width) / 12.0 + mass * (half * half);
    km_answer_number(answer, "damping_ratio", (km_number(*given, "damping") + kd) / (2.0 * sqrt(kp * inertia)));
    km_answer_number(answer, "inertia", inertia);
    km_answer_number(answer, "natural_frequency", sqrt(kp / inertia));
    /* an integral part, however small, leaves nothing */
    double left_over = km_number(*given, "ki") > 0.0 ? 0.0 : km_number(*given, "load_torque") / kp;
    km_answer_number(answer, "steady_state_error", left_over);
}

/* The loop J a + (b + kp) v of a joint under velocity control, and how far its gains may go at this control period. */
KM_EXPORT(km_velocity_loop) void km_velocity_loop(const km_map *given, km_answer *answer) {
    double inertia = km_number(*given, "inertia"), damping = km_number(*given, "damping"), kp = km_number(*given, "kp");
    km_answer_number(answer, "final_speed", kp / (damping + kp));
    km_answer_number(answer, "largest_kd", inertia);
    km_answer_number(answer, "largest_kp", 2.0 * inertia / km_number(*given, "period"));
    km_answer_number(answer, "time_constant", inertia / (damping + kp));
}

static double sum[JOINTS]; /* the integral of the error, by joint */

void km_init(const km_robot *robot, const char *task) {
    (void)robot, (void)task;
    for (int i = 0; i < JOINTS; i++) sum[i] = 0.0;
}

static void hold_speed(const km_observation *observation, double *command) {
    double kp = km_number(observation->target, "kp"), ki = km_number(observation->target, "ki");
    const double wanted[JOINTS] = {0.0, km_number(observation->target, "elbow_rad_s")};
    for (int i = 0; i < JOINTS; i++) {
        double error = wanted[i] - observation->qd[i];
        sum[i] += error * observation->dt;
        command[i] = kp * error + ki * sum[i];
    }
}

static void hold_angle(const km_observation *observation, double *command) {
    double kp = km_number(observation->target, "kp"), kd = km_number(observation->target, "kd");
    const double wanted[JOINTS] = {0.0, km_number(observation->target, "elbow_rad")};
    double error[JOINTS];
    for (int i = 0; i < JOINTS; i++) error[i] = wanted[i] - observation->q[i];
    km_plot("error[0]", error[0]);
    km_plot("error[1]", error[1]);

    if (km_is(observation->task, "hold")) {
        double gravity[JOINTS];
        km_gravity(observation->q, gravity);
        for (int i = 0; i < JOINTS; i++) command[i] = kp * error[i] - kd * observation->qd[i] + gravity[i];
        return;
    }
    /* the derivative is taken of the measurement: the error's jumps with the command */
    double ki = km_number(observation->target, "ki");
    for (int i = 0; i < JOINTS; i++) {
        sum[i] += error[i] * observation->dt;
        command[i] = kp * error[i] + ki * sum[i] - kd * observation->qd[i];
    }
}

void km_control(const km_observation *observation, double *command) {
    if (km_is(observation->task, "warm-up")) {
        command[0] = km_number(observation->target, "shoulder_rad");
        command[1] = 0.0;
    } else if (km_is(observation->task, "speed")) {
        hold_speed(observation, command);
    } else {
        hold_angle(observation, command);
    }
}
