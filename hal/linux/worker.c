#include "worker.h"

#include <signal.h>

static void *work(void *argument) {
    tuile_linux_worker_t *worker = argument;

    (void)pthread_mutex_lock(&worker->lock);
    for (;;) {
        const uint8_t *bytes;
        size_t size_bytes;
        int result;

        while (!worker->bytes && !worker->stop) {
            (void)pthread_cond_wait(&worker->changed, &worker->lock);
        }
        if (!worker->bytes) { break; }
        bytes = worker->bytes;
        size_bytes = worker->size_bytes;
        (void)pthread_mutex_unlock(&worker->lock);
        result = worker->send(worker->context, bytes, size_bytes);
        (void)pthread_mutex_lock(&worker->lock);
        worker->result = result;
        worker->bytes = NULL;
        (void)pthread_cond_broadcast(&worker->changed);
    }
    (void)pthread_mutex_unlock(&worker->lock);
    return NULL;
}

int tuile_linux_worker_start(tuile_linux_worker_t *worker, int (*send)(void *context, const uint8_t *bytes, size_t size_bytes),
                             void *context) {
    sigset_t all, before;
    int error;

    *worker = (tuile_linux_worker_t){.send = send, .context = context};
    if ((error = pthread_mutex_init(&worker->lock, NULL))) { return error; }
    if (!(error = pthread_cond_init(&worker->changed, NULL))) {
        (void)sigfillset(&all);
        (void)pthread_sigmask(SIG_SETMASK, &all, &before); /* a thread begins with the mask of its maker */
        error = pthread_create(&worker->thread, NULL, work, worker);
        (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
        worker->running = error == 0;
        if (error) { (void)pthread_cond_destroy(&worker->changed); }
    }
    if (error) { (void)pthread_mutex_destroy(&worker->lock); }
    return error;
}

void tuile_linux_worker_give(tuile_linux_worker_t *worker, const uint8_t *bytes, size_t size_bytes) {
    (void)pthread_mutex_lock(&worker->lock);
    worker->bytes = bytes;
    worker->size_bytes = size_bytes;
    (void)pthread_cond_broadcast(&worker->changed);
    (void)pthread_mutex_unlock(&worker->lock);
}

int tuile_linux_worker_wait(tuile_linux_worker_t *worker) {
    int result;

    (void)pthread_mutex_lock(&worker->lock);
    while (worker->bytes) {
        (void)pthread_cond_wait(&worker->changed, &worker->lock);
    }
    result = worker->result;
    worker->result = 0;
    (void)pthread_mutex_unlock(&worker->lock);
    return result;
}

void tuile_linux_worker_stop(tuile_linux_worker_t *worker) {
    if (!worker->running) { return; }
    (void)pthread_mutex_lock(&worker->lock);
    worker->stop = true;
    (void)pthread_cond_broadcast(&worker->changed);
    (void)pthread_mutex_unlock(&worker->lock);
    (void)pthread_join(worker->thread, NULL);
    (void)pthread_cond_destroy(&worker->changed);
    (void)pthread_mutex_destroy(&worker->lock);
    *worker = (tuile_linux_worker_t){0};
}
