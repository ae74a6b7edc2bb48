#include "output.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int output_open(output_t *output, const char *path, sim_error_t *error) {
    struct stat status;
    const bool direct = stat(path, &status) == 0 && !S_ISREG(status.st_mode);
    memset(output, 0, sizeof *output);
    if (strlen(path) >= sizeof output->path) { return sim_fail(error, "%s: the name is too long", path); }
    (void)snprintf(output->path, sizeof output->path, "%s", path);
    if (!direct) { (void)snprintf(output->beside, sizeof output->beside, "%s.part%ld", path, (long)getpid()); }
    output->file = fopen(direct ? path : output->beside, "w");
    if (!output->file) { return sim_fail(error, "%s: cannot be written: %s", path, strerror(errno)); }
    return 0;
}

int output_close(output_t *output, sim_error_t *error) {
    errno = 0;
    bool failed = fflush(output->file) != 0 || ferror(output->file);
    int reason = errno;
    if (fclose(output->file) != 0 && !failed) {
        failed = true;
        reason = errno;
    }
    if (!failed && output->beside[0] && rename(output->beside, output->path) != 0) {
        failed = true;
        reason = errno;
    }
    if (failed && output->beside[0]) { (void)unlink(output->beside); }
    return failed ? sim_fail(error, "%s: cannot be written: %s", output->path, strerror(reason)) : 0;
}

void output_discard(output_t *output) {
    (void)fclose(output->file);
    if (output->beside[0]) { (void)unlink(output->beside); }
}
