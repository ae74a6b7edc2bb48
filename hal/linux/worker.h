/* A thread that sends one buffer at a time, so that the wire is busy while its caller draws. */
#ifndef TUILE_HAL_LINUX_WORKER_H
#define TUILE_HAL_LINUX_WORKER_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct tuile_linux_worker {
    int (*send)(void *context, const uint8_t *bytes, size_t size_bytes);
    void *context;
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    const uint8_t *bytes; /* the buffer it has; NULL: none */
    size_t size_bytes;
    int result; /* of the last one, until it is asked for */
    bool running, stop;
} tuile_linux_worker_t;

/* Starts the thread, which calls send(context, ...) for each buffer and takes no signals: those stay with the other threads. The
 * worker must not be moved while it runs. 0, or an errno. */
int tuile_linux_worker_start(tuile_linux_worker_t *worker, int (*send)(void *context, const uint8_t *bytes, size_t size_bytes),
                             void *context);

/* Hands a buffer over and returns at once. Only while it has none. size_bytes > 0. */
void tuile_linux_worker_give(tuile_linux_worker_t *worker, const uint8_t *bytes, size_t size_bytes);

/* Returns when it has no buffer, with what the last one came to; told once. */
int tuile_linux_worker_wait(tuile_linux_worker_t *worker);

/* Lets it finish its buffer and ends the thread. Does nothing where none was started. */
void tuile_linux_worker_stop(tuile_linux_worker_t *worker);

#endif
