/* Command line options: `--name value` or `--name=value`, numbers checked against their range. */
#ifndef SIM_OPTIONS_H
#define SIM_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct options {
    int count;
    char **arguments;
    int at;              /* of the argument that options_next returns next */
    const char *name;    /* of the current option, NULL for a plain argument */
    const char *inlined; /* value after '=' */
    char buffer[64];
    bool taken;  /* the value after '=' was asked for */
    bool failed; /* a message has been printed */
} options_t;

void options_open(options_t *options, int count, char **arguments);

/* The next option in options->name (without value), or a plain argument (options->name NULL) as return value. NULL at the end
 * and after a failure, as which counts a value after '=' that nobody asked for. For an option the return value is its name. */
const char *options_next(options_t *options);

/* The current option's value; NULL and a message when there is none. */
const char *options_value(options_t *options);

/* Numbers; false and a message when the value is no number or out of [low, high]. */
bool options_number(options_t *options, double *value, double low, double high);
bool options_integer(options_t *options, long *value, long low, long high);
/* "X,Y,Z", or any other count of numbers. */
bool options_numbers(options_t *options, double *values, size_t count, double low, double high);
/* "16K", "1M", "4096": bytes. */
bool options_size(options_t *options, size_t *bytes);
/* Index of the value among names (NULL-terminated). */
bool options_choice(options_t *options, int *index, const char *const *names);

/* "240x16": 1 ... 1024 each. */
bool options_tile(options_t *options, uint16_t *width, uint16_t *height);

/* "unknown option", as a failure. */
void options_unknown(options_t *options);

/* The values of --method, in the order of tuile_method_t. */
extern const char *const options_methods[];

#endif
