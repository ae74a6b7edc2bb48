/* One-line errors for people: what was wrong, where, and what to do. */
#ifndef SIM_ERROR_H
#define SIM_ERROR_H

typedef struct sim_error {
    char text[512]; /* no trailing newline; empty when there was no error */
} sim_error_t;

/* Fills error->text (error may be NULL) and returns -1, so that a function can `return sim_fail(error, ...)`. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
int sim_fail(sim_error_t *error, const char *format, ...);

#endif
