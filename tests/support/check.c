#include "check.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

bool check_survives(void (*function)(void)) {
    int status = 0;
    fflush(NULL);
    const pid_t child = fork();
    if (child < 0) { return false; }
    if (child == 0) {
        static const int signals[] = {SIGFPE, SIGSEGV, SIGBUS, SIGILL, SIGABRT};
        for (size_t i = 0; i < CHECK_COUNT(signals); i++) {
            signal(signals[i], SIG_DFL);
        }
        function();
        _exit(0);
    }
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
