/* kinemark.h - version 1 of the interface between Kinemark and a submission that is compiled to WebAssembly.
 *
 * Include it in your C file, define the functions of your lab, and build with
 *
 *     clang --target=wasm32 -O2 -Wall -mbulk-memory -nostdlib -Wl,--no-entry,--stack-first -o submission.wasm submission.c
 *
 * In C++ build with clang++ and, besides these options, -fno-exceptions -fno-rtti.
 *
 * All pointers that a function gets are valid during the call; in a motion task they stay the same from call to call. All numbers are
 * doubles in SI units (rad, m, s, N m, N). Texts are UTF-8 and end with a zero byte. Structures have the layout that a C compiler
 * gives them for wasm32: pointers and uint32_t have 4 bytes, doubles 8.
 *
 * There is no C library: no printf, no malloc, no files. What there is of math.h, string.h and assert.h is declared here, so
 * leave out their #include; <stdint.h>, <stdbool.h>, <stddef.h>, <float.h> and <limits.h> are the compiler's own and work. A call may
 * use 1,000,000 instructions, all memory 16 MiB, and the variables inside functions 64 KiB: make a large array static.
 *
 * C lets much pass: a wrong index or a null pointer reads something. To find such a mistake add
 *
 *     -fsanitize=undefined -fsanitize-trap=undefined
 *
 * With it the call ends in the function that makes the mistake.
 */
#ifndef KINEMARK_H
#define KINEMARK_H

/* Only WebAssembly has exports and imports. An editor, or a test of your own, may read this file for any other machine. */
#ifdef __wasm__
#define KM_EXPORT(name) __attribute__((export_name(#name)))
#define KM_IMPORT(module, name) __attribute__((import_module(module), import_name(name)))
/* A forgotten `return`, and a function that is declared nowhere: C only warns, and the result has no meaning. */
#pragma clang diagnostic error "-Wreturn-type"
#pragma clang diagnostic error "-Wimplicit-function-declaration"
#else
#define KM_EXPORT(name)
#define KM_IMPORT(module, name)
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef __UINT32_TYPE__ km_u32;
typedef __SIZE_TYPE__ km_size;

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
    const double *tcp_rotation; /* 9 numbers: rotation matrix of the TCP in the lab's frame, row by row; its columns are the TCP's axes */
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

/* A function of the lab's own has KM_EXPORT before it: KM_EXPORT(km_stiffness) void km_stiffness(const km_map *given, km_answer *answer).
 * Those that follow here have it already. */

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

/* ---- What there is of the C library ---- */

#ifdef __cplusplus
}
#endif

#ifdef __wasm__

/* In C the compiler knows these names, and would compute some values itself, with other bits; not so if a name is overloadable. */
#ifdef __cplusplus
#define KM_OF_MATH
#else
#define KM_OF_MATH __attribute__((overloadable))
#endif

/* Functions of math.h, with the bits that scripts get. */
#define KM_OF_ONE(name) KM_IMPORT("env", #name) KM_OF_MATH double name(double);
#define KM_OF_TWO(name) KM_IMPORT("env", #name) KM_OF_MATH double name(double, double);
KM_OF_ONE(acos) KM_OF_ONE(acosh) KM_OF_ONE(asin) KM_OF_ONE(asinh) KM_OF_ONE(atan) KM_OF_ONE(atanh) KM_OF_ONE(cbrt) KM_OF_ONE(cos)
KM_OF_ONE(cosh) KM_OF_ONE(exp) KM_OF_ONE(exp2) KM_OF_ONE(expm1) KM_OF_ONE(log) KM_OF_ONE(log10) KM_OF_ONE(log1p) KM_OF_ONE(log2)
KM_OF_ONE(round) KM_OF_ONE(sin) KM_OF_ONE(sinh) KM_OF_ONE(tan) KM_OF_ONE(tanh)
KM_OF_TWO(atan2) KM_OF_TWO(fmax) KM_OF_TWO(fmin) KM_OF_TWO(fmod) KM_OF_TWO(hypot) KM_OF_TWO(pow)

/* These are instructions of WebAssembly. */
static inline KM_OF_MATH double ceil(double x) { return __builtin_ceil(x); }
static inline KM_OF_MATH double copysign(double x, double sign) { return __builtin_copysign(x, sign); }
static inline KM_OF_MATH double fabs(double x) { return __builtin_fabs(x); }
static inline KM_OF_MATH double floor(double x) { return __builtin_floor(x); }
static inline KM_OF_MATH double sqrt(double x) { return __builtin_sqrt(x); }
static inline KM_OF_MATH double trunc(double x) { return __builtin_trunc(x); }

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif
#ifndef NAN
#define NAN __builtin_nanf("")
#define INFINITY __builtin_inff()
#define isnan(x) __builtin_isnan(x)
#define isinf(x) __builtin_isinf(x)
#define isfinite(x) __builtin_isfinite(x)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Functions of string.h; the compiler itself calls them to copy a structure, or where it sees their loop. */
#define KM_OF_STRING __attribute__((weak, no_builtin))

KM_OF_STRING void *memcpy(void *to, const void *from, km_size bytes) {
    for (km_size i = 0; i < bytes; i++) ((char *)to)[i] = ((const char *)from)[i];
    return to;
}

KM_OF_STRING void *memmove(void *to, const void *from, km_size bytes) {
    if ((km_size)to <= (km_size)from) return memcpy(to, from, bytes);
    for (km_size i = bytes; i > 0; i--) ((char *)to)[i - 1] = ((const char *)from)[i - 1];
    return to;
}

KM_OF_STRING void *memset(void *to, int value, km_size bytes) {
    for (km_size i = 0; i < bytes; i++) ((char *)to)[i] = (char)value;
    return to;
}

KM_OF_STRING int memcmp(const void *a, const void *b, km_size bytes) {
    const unsigned char *left = (const unsigned char *)a, *right = (const unsigned char *)b;
    for (km_size i = 0; i < bytes; i++)
        if (left[i] != right[i]) return left[i] - right[i];
    return 0;
}

KM_OF_STRING km_size strlen(const char *text) {
    km_size length = 0;
    while (text[length] != 0) length++;
    return length;
}

KM_OF_STRING int strcmp(const char *a, const char *b) {
    while (*a != 0 && *a == *b) a++, b++;
    return (unsigned char)*a - (unsigned char)*b;
}

int printf(const char *, ...) __attribute__((unavailable("there is no C library: km_log and km_log_number write to the log")));

#ifdef __cplusplus
}
#endif

#else
#include <assert.h>
#include <math.h>
#include <string.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Helpers: texts, maps and answers ---- */

static inline int km_is(const char *a, const char *b) { return strcmp(a, b) == 0; }

/* A line of the log. */
static inline void km_log(const char *text) { km_log_bytes(text, (km_u32)strlen(text)); }
/* A value of a signal in the report. */
static inline void km_plot(const char *name, double value) { km_plot_bytes(name, (km_u32)strlen(name), value); }

/* What can end a call becomes a part of the function that calls it, so that the message names yours. */
#define KM_HELPER static inline __attribute__((always_inline))

/* Ends the call as a crash with these words. */
KM_HELPER __attribute__((noreturn)) void km_fail(const char *text) { km_fail_bytes(text, (km_u32)strlen(text)); }

#ifdef __wasm__
#define KM_TEXT_OF(number) #number
#define KM_LINE(line) "line " KM_TEXT_OF(line)
/* Ends the call where the condition does not hold: "line 12: not true: q[0] > 0". */
#define assert(condition) ((condition) ? (void)0 : km_fail(KM_LINE(__LINE__) ": not true: " #condition))
#endif

/* A line of words that is written part by part; what has no room is left out. */
typedef struct km_words {
    char text[400];
    km_u32 length;
} km_words;

static inline void km_say(km_words *words, const char *text) {
    while (*text != 0 && words->length < sizeof words->text) words->text[words->length++] = *text++;
}

static inline void km_say_count(km_words *words, km_u32 count) {
    char digits[11];
    int at = sizeof digits;
    digits[--at] = 0;
    do digits[--at] = (char)('0' + count % 10);
    while ((count /= 10) > 0);
    km_say(words, digits + at);
}

/* A number with six digits: 0.775397, -12, 1.5e-9. */
static inline void km_say_number(km_words *words, double number) {
    if (!isfinite(number)) {
        km_say(words, isnan(number) ? "NaN" : number > 0.0 ? "inf" : "-inf");
        return;
    }
    double size = fabs(number);
    if (size < 1e-300) size = 0.0; /* 10 to a smaller power is not exact */
    int tens = size > 0.0 ? (int)floor(log10(size)) : 0;
    km_u32 six = (km_u32)round(size / pow(10.0, tens - 5));
    if (six == 1000000) six = 100000, tens++;
    char digits[6];
    int last = 0;
    for (int i = 5; i >= 0; i--, six /= 10) {
        digits[i] = (char)('0' + six % 10);
        if (last == 0 && six % 10 != 0) last = i;
    }
    int has_power = tens < -5 || tens > 14, units = has_power ? 0 : tens;
    if (number < 0.0) km_say(words, "-");
    for (int i = units < 0 ? units : 0; i <= last || i <= units; i++) {
        const char digit[] = {i < 0 || i > 5 ? '0' : digits[i], i == units && i < last ? '.' : (char)0, 0};
        km_say(words, digit);
    }
    if (has_power) {
        km_say(words, tens < 0 ? "e-" : "e");
        km_say_count(words, (km_u32)(tens < 0 ? -tens : tens));
    }
}

/* A line of the log: "q = 0.5, 1.25". */
static inline void km_log_numbers(const char *name, const double *numbers, km_u32 count) {
    km_words words;
    words.length = 0;
    km_say(&words, name);
    for (km_u32 i = 0; i < count; i++) {
        km_say(&words, i == 0 ? " = " : ", ");
        km_say_number(&words, numbers[i]);
    }
    km_log_bytes(words.text, words.length);
}

static inline void km_log_number(const char *name, double number) { km_log_numbers(name, &number, 1); }

/* The field of this name; 0 if there is none. */
static inline const km_field *km_find(km_map map, const char *name) {
    for (km_u32 i = 0; i < map.count; i++)
        if (km_is(map.fields[i].name, name)) return &map.fields[i];
    return 0;
}

/* What is in a map instead of the name that is not. */
static inline const km_words *km_missing(km_map map, const char *name, const char *what) {
    static km_words words;
    words.length = 0;
    km_say(&words, "there is no ");
    km_say(&words, what);
    km_say(&words, " named `");
    km_say(&words, name);
    km_say(&words, map.count == 0 ? "`: the map is empty" : "`, there is ");
    for (km_u32 i = 0; i < map.count; i++) {
        const km_field *field = &map.fields[i];
        if (i > 0) km_say(&words, ", ");
        km_say(&words, field->name);
        if (field->text != 0) km_say(&words, " (a text)");
        if (field->columns > 0) {
            km_say(&words, " (a list of ");
            km_say_count(&words, field->count);
            km_say(&words, ")");
        }
    }
    return &words;
}

/* The field of this name, if it has numbers, or the one number that is wanted; else the end of the call, with what is there instead. */
KM_HELPER const km_field *km_found(km_map map, const char *name, int one, const char *what) {
    const km_field *field = km_find(map, name);
    if (field == 0 || field->numbers == 0 || (one && field->count != 1)) {
        const km_words *words = km_missing(map, name, what);
        km_fail_bytes(words->text, words->length);
    }
    return field;
}

/* The numbers of this name. */
KM_HELPER const double *km_numbers(km_map map, const char *name) { return km_found(map, name, 0, "number or list")->numbers; }
/* How many numbers this name has; of positions in a list, three for each. */
KM_HELPER km_u32 km_count(km_map map, const char *name) { return km_found(map, name, 0, "number or list")->count; }
/* The number of this name; a list of several is none. */
KM_HELPER double km_number(km_map map, const char *name) { return km_found(map, name, 1, "number")->numbers[0]; }

/* Adds a list of numbers to an answer. The name is not copied: write it between quotes. A name of 0 says that it is the answer itself. */
KM_HELPER void km_answer_list(km_answer *answer, const char *name, const double *numbers, km_u32 count) {
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

/* Adds a matrix to an answer: its numbers row by row, so many in a row. */
KM_HELPER void km_answer_matrix(km_answer *answer, const char *name, const double *numbers, km_u32 rows, km_u32 columns) {
    km_answer_list(answer, name, numbers, rows * columns);
    answer->fields[answer->count - 1].columns = columns;
}

/* Adds a number to an answer. */
KM_HELPER void km_answer_number(km_answer *answer, const char *name, double number) {
    km_answer_list(answer, name, &number, 1);
    answer->fields[answer->count - 1].columns = 0;
}

/* ---- Helpers: what scripts have, with the same bits ---- */

static inline double km_clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

/* The way from a to b, of which s goes from 0 to 1. */
static inline double km_lerp(double a, double b, double s) { return a + (b - a) * s; }

/* From 0 to 1 as s does, at rest at both ends with no acceleration; constant outside. */
static inline double km_quintic(double s) {
    s = km_clamp(s, 0.0, 1.0);
    return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

/* The angle in (-pi, pi] that differs by full turns. */
static inline double km_wrap_pi(double angle) {
    double rest = angle > -KM_PI && angle <= KM_PI ? angle : fmod(angle, 2.0 * KM_PI);
    return rest > KM_PI ? rest - 2.0 * KM_PI : rest <= -KM_PI ? rest + 2.0 * KM_PI : rest;
}

static inline double km_dot(const double *a, const double *b, km_u32 n) {
    double sum = 0.0;
    for (km_u32 i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static inline double km_norm(const double *a, km_u32 n) { return sqrt(km_dot(a, a, n)); }

#define KM_MOST_UNKNOWNS 12

/* Solves matrix x = right for n unknowns, the matrix row by row. One that is singular to working precision ends the call. */
static inline void km_solve(const double *matrix, const double *right, double *x, km_u32 n) {
    double a[KM_MOST_UNKNOWNS][KM_MOST_UNKNOWNS + 1]; /* the right side is the last column */
    double largest = 0.0;
    if (n > KM_MOST_UNKNOWNS) km_fail("km_solve has room for 12 unknowns");
    for (km_u32 i = 0; i < n; i++) {
        for (km_u32 j = 0; j < n; j++) {
            a[i][j] = matrix[n * i + j];
            if (fabs(a[i][j]) > largest) largest = fabs(a[i][j]);
        }
        a[i][n] = right[i];
    }
    for (km_u32 k = 0; k < n; k++) {
        km_u32 pivot = k;
        for (km_u32 i = k + 1; i < n; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
        double size = fabs(a[pivot][k]);
        if (!(isfinite(size) && size > largest * n * 2.220446049250313e-16)) km_fail("the matrix is singular: it has no inverse");
        for (km_u32 j = k; j <= n; j++) {
            double upper = a[pivot][j];
            a[pivot][j] = a[k][j];
            a[k][j] = upper;
        }
        for (km_u32 i = k + 1; i < n; i++) {
            double factor = a[i][k] / a[k][k];
            for (km_u32 j = k; j <= n; j++) a[i][j] -= factor * a[k][j];
        }
    }
    for (km_u32 i = n; i-- > 0;) {
        double known = 0.0;
        for (km_u32 k = i + 1; k < n; k++) known += a[i][k] * x[k];
        x[i] = (a[i][n] - known) / a[i][i];
    }
}

/* ---- What Kinemark asks of a module; this header answers ---- */

#ifndef KM_BUFFER_BYTES
#define KM_BUFFER_BYTES 65536
#endif

KM_EXPORT(km_version) __attribute__((weak)) km_u32 km_version(void) { return KM_VERSION; }

/* Where Kinemark writes what functions get, and reads what they return: once after the module starts. 0 if there is no room. */
KM_EXPORT(km_buffer) __attribute__((weak)) void *km_buffer(km_u32 bytes) {
    static __attribute__((aligned(8))) unsigned char buffer[KM_BUFFER_BYTES];
    return bytes <= sizeof buffer ? buffer : 0;
}

#ifdef __wasm__
/* What Kinemark calls first: the constructors of global variables in C++. Where nothing calls them the linker does, before every call of
 * an export, and a run would begin anew each time. */
void __wasm_call_ctors(void);
KM_EXPORT(_initialize) __attribute__((weak)) void _initialize(void) { __wasm_call_ctors(); }

#ifdef __cplusplus
/* A module does not end, so nothing is destructed. */
__attribute__((weak)) int __cxa_atexit(void (*)(void *), void *, void *) { return 0; }
__attribute__((weak)) void __cxa_pure_virtual(void) { km_fail("a pure virtual function is called"); }
#endif
#endif

#ifdef __cplusplus
}
#endif

#endif
