/* kinemark.h - version 1 of the interface between Kinemark and a submission that is compiled to WebAssembly.
 *
 * Include it in one C file, define the functions of your lab, and build with
 *
 *     clang --target=wasm32 -O2 -mbulk-memory -nostdlib -Wl,--no-entry,--allow-undefined -o submission.wasm submission.c
 *
 * All pointers that a function gets are valid during the call; in a motion task they stay the same from call to call. All numbers are
 * doubles in SI units (rad, m, s, N m, N). Texts are UTF-8 and end with a zero byte. Structures have the layout that a C compiler
 * gives them for wasm32: pointers and uint32_t have 4 bytes, doubles 8.
 */
#ifndef KINEMARK_H
#define KINEMARK_H

#ifdef __cplusplus
extern "C" {
#endif

typedef __UINT32_TYPE__ km_u32;

#define KM_VERSION 1
#define KM_PI 3.141592653589793

/* ---- What a function gets ---- */

/* A named value: a number, a list of numbers, a matrix row by row, or a text. */
typedef struct km_field {
    const char *name;      /* "speed"; what lies in another map is "outer.inner", what lies in a list is "list[0]" */
    const double *numbers; /* the numbers; 0 for a text. True is 1, false is 0 */
    const char *text;      /* the text; 0 for numbers */
    km_u32 count;          /* how many numbers, or how many bytes of text */
    km_u32 columns;        /* numbers in a row: 0 for a single number, `count` for a list, fewer for a matrix */
} km_field;

/* A map from names to values. */
typedef struct km_map {
    const km_field *fields;
    km_u32 count;
} km_map;

/* The robot. */
typedef struct km_robot {
    const char *name;
    km_u32 joints;                   /* how many joints move: n */
    const char *const *joint_names;  /* n texts */
    const double *lower;             /* n lower position limits; minus infinity without a limit [rad or m] */
    const double *upper;             /* n upper position limits; infinity without a limit [rad or m] */
    const double *effort;            /* n effort limits; infinity without a limit [N m or N] */
    km_map dimensions;               /* "link_lengths", "base_height", ...: the numbers of the robot file */
} km_robot;

/* What `km_control` sees. */
typedef struct km_observation {
    double tick;          /* the tick, a whole number */
    double time;          /* its time [s] */
    double dt;            /* the control period [s] */
    km_u32 joints;        /* how many joints move: n */
    const double *q;      /* n joint positions [rad or m] */
    const double *qd;     /* n joint velocities [rad/s or m/s] */
    const double *effort; /* n joint efforts of the tick before [N m or N] */
    const double *tcp;    /* 3 numbers: position of the TCP in the lab's frame [m] */
    const char *task;     /* the name of the task */
    km_map target;        /* what the task sets; a target that is no map is its only field, "target" */
    km_map sensors;       /* readings by the names of the sensors */
} km_observation;

/* Where a function of the lab's own writes its answer: with km_answer_number and km_answer_list, below. */
typedef struct km_answer {
    km_field *fields;
    km_u32 count;         /* fields that are written */
    km_u32 most_fields;
    double *numbers;
    km_u32 used;          /* numbers that are written */
    km_u32 most_numbers;
} km_answer;

/* ---- What you define: the functions that the tasks of your lab name ---- */

/* Write it before a function of the lab's own: KM_EXPORT(km_stiffness) void km_stiffness(const km_map *given, km_answer *answer). */
#define KM_EXPORT(name) __attribute__((export_name(#name)))

/* Position of the TCP at q: writes 3 numbers [m]. */
KM_EXPORT(km_forward_kinematics) void km_forward_kinematics(const km_robot *robot, const double *q, double *position);

/* The branches that reach a position: writes n numbers for each, and returns how many branches it wrote, at most `most`. */
KM_EXPORT(km_inverse_kinematics) km_u32 km_inverse_kinematics(const km_robot *robot, const double *position, double *branches, km_u32 most);

/* The Jacobian at q: writes its rows, n numbers each, and returns how many rows it wrote, at most 6. */
KM_EXPORT(km_jacobian) km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix);

/* Once before the first km_control of a run; may be left out. */
KM_EXPORT(km_init) void km_init(const km_robot *robot, const char *task);

/* Every control period: writes n numbers in the task's mode. Global variables keep their values from call to call of a run. */
KM_EXPORT(km_control) void km_control(const km_observation *observation, double *command);

/* ---- What you may call ---- */

#define KM_IMPORT(module, name) __attribute__((import_module(module), import_name(name)))

/* A line of the log. */
KM_IMPORT("kinemark", "log") void km_log_bytes(const char *text, km_u32 bytes);
/* A value of a signal in the report. */
KM_IMPORT("kinemark", "plot") void km_plot_bytes(const char *name, km_u32 bytes, double value);
/* Ends the call as a crash with these words. */
KM_IMPORT("kinemark", "fail") __attribute__((noreturn)) void km_fail_bytes(const char *text, km_u32 bytes);

/* Functions of the robot's model, where the task grants them. */
KM_IMPORT("kinemark", "fk") void km_fk(const double *q, double *position);                /* writes 3 numbers */
KM_IMPORT("kinemark", "jacobian") void km_jacobian_of(const double *q, double *matrix);   /* writes 3 rows of n numbers */
KM_IMPORT("kinemark", "gravity") void km_gravity(const double *q, double *effort);        /* writes n numbers */
KM_IMPORT("kinemark", "mass_matrix") void km_mass_matrix(const double *q, double *matrix); /* writes n rows of n numbers */

/* Functions of math.h, with the bits that scripts get. They are why the module is linked with --allow-undefined. */
double acos(double), acosh(double), asin(double), asinh(double), atan(double), atan2(double, double), atanh(double);
double cbrt(double), ceil(double), copysign(double, double), cos(double), cosh(double), exp(double), exp2(double);
double expm1(double), fabs(double), floor(double), fmax(double, double), fmin(double, double), fmod(double, double);
double hypot(double, double), log(double), log10(double), log1p(double), log2(double), pow(double, double), round(double);
double sin(double), sinh(double), sqrt(double), tan(double), tanh(double), trunc(double);

/* ---- Helpers ---- */

static inline km_u32 km_length(const char *text) {
    km_u32 length = 0;
    while (text[length] != 0) length++;
    return length;
}

static inline int km_is(const char *a, const char *b) {
    while (*a != 0 && *a == *b) a++, b++;
    return *a == *b;
}

static inline void km_log(const char *text) { km_log_bytes(text, km_length(text)); }
static inline void km_plot(const char *name, double value) { km_plot_bytes(name, km_length(name), value); }
static inline __attribute__((noreturn)) void km_fail(const char *text) { km_fail_bytes(text, km_length(text)); }

/* The field of this name; 0 if there is none. */
static inline const km_field *km_find(km_map map, const char *name) {
    for (km_u32 i = 0; i < map.count; i++)
        if (km_is(map.fields[i].name, name)) return &map.fields[i];
    return 0;
}

/* The numbers of this name. A name that is not there, or is of a text, ends the call and says so. */
static inline const double *km_numbers(km_map map, const char *name) {
    const km_field *field = km_find(map, name);
    if (field == 0 || field->numbers == 0) {
        char words[96] = "there are no numbers named ";
        km_u32 length = km_length(words);
        for (km_u32 i = 0; name[i] != 0 && length < sizeof words; i++) words[length++] = name[i];
        km_fail_bytes(words, length);
    }
    return field->numbers;
}

/* The number of this name. */
static inline double km_number(km_map map, const char *name) { return km_numbers(map, name)[0]; }

/* Adds a list of numbers to an answer; a name of 0 says that it is the answer itself. */
static inline void km_answer_list(km_answer *answer, const char *name, const double *numbers, km_u32 count) {
    if (answer->count >= answer->most_fields || count > answer->most_numbers - answer->used)
        km_fail("the answer has no room for so many numbers");
    km_field *field = &answer->fields[answer->count++];
    field->name = name;
    field->numbers = answer->numbers + answer->used;
    field->text = 0;
    field->count = count;
    field->columns = count;
    for (km_u32 i = 0; i < count; i++) answer->numbers[answer->used++] = numbers[i];
}

/* Adds a number to an answer; a name of 0 says that it is the answer itself. */
static inline void km_answer_number(km_answer *answer, const char *name, double number) {
    km_answer_list(answer, name, &number, 1);
    answer->fields[answer->count - 1].columns = 0;
}

/* ---- What Kinemark asks of a module; this header answers ---- */

#ifndef KM_BUFFER_BYTES
#define KM_BUFFER_BYTES 65536
#endif

__attribute__((weak, export_name("km_version"))) km_u32 km_version(void) { return KM_VERSION; }

/* Where Kinemark writes what functions get, and reads what they return: once after the module starts. 0 if there is no room. */
__attribute__((weak, export_name("km_buffer"))) void *km_buffer(km_u32 bytes) {
    static _Alignas(8) unsigned char buffer[KM_BUFFER_BYTES];
    return bytes <= sizeof buffer ? buffer : 0;
}

#ifdef __cplusplus
}
#endif

#endif
