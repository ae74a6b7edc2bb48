#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* what: "create", "open", "write". */
static int fail(const output_t *output, const char *what, int reason, sim_error_t *error) {
    return sim_fail(error, "%s: cannot %s: %s", output->path, what, strerror(reason ? reason : EIO));
}

/* Makes the file beside the target. Its descriptor, or -1 and errno. */
static int open_beside(output_t *output, mode_t mode) {
    const int length = snprintf(output->beside, sizeof output->beside, "%s.XXXXXX", output->target);
    if (length < 0 || (size_t)length >= sizeof output->beside) {
        errno = ENAMETOOLONG;
        return -1;
    }
    const int descriptor = mkstemp(output->beside);
    if (descriptor >= 0 && fchmod(descriptor, mode) != 0) {
        const int reason = errno;
        (void)close(descriptor);
        (void)unlink(output->beside);
        errno = reason;
        return -1;
    }
    return descriptor;
}

int output_open(output_t *output, const char *path, sim_error_t *error) {
    struct stat status;
    const bool there = stat(path, &status) == 0, direct = there && !S_ISREG(status.st_mode);
    const mode_t mask = umask(0);
    (void)umask(mask);

    memset(output, 0, sizeof *output);
    if (strlen(path) >= sizeof output->path) { return sim_fail(error, "%s: the name is too long", path); }
    memcpy(output->path, path, strlen(path) + 1);
    memcpy(output->target, path, strlen(path) + 1);
    if (there && S_ISDIR(status.st_mode)) { return sim_fail(error, "%s: it is a folder; name a file in it", path); }
    int descriptor;
    if (direct) {
        descriptor = open(path, O_WRONLY | O_CLOEXEC);
    } else {
        /* Through a symbolic link, lest the rename replace the link. */
        if (there && realpath(path, output->target) == NULL) { return fail(output, "open", errno, error); }
        descriptor = open_beside(output, there ? status.st_mode & 0777 : 0666 & ~mask);
    }
    if (descriptor < 0) { return fail(output, direct ? "open" : "create", errno, error); }
    output->file = fdopen(descriptor, "wb");
    if (output->file == NULL) {
        const int reason = errno;
        (void)close(descriptor);
        if (output->beside[0]) { (void)unlink(output->beside); }
        return fail(output, "open", reason, error);
    }
    return 0;
}

int output_close(output_t *output, sim_error_t *error) {
    errno = 0;
    bool failed = fflush(output->file) != 0 || ferror(output->file) || (output->beside[0] && fsync(fileno(output->file)) != 0);
    int reason = errno;
    if (fclose(output->file) != 0 && !failed) { /* a full disk may say so only here */
        failed = true;
        reason = errno;
    }
    if (!failed && output->beside[0] && rename(output->beside, output->target) != 0) {
        failed = true;
        reason = errno;
    }
    if (failed && output->beside[0]) { (void)unlink(output->beside); }
    return failed ? fail(output, "write", reason, error) : 0;
}

void output_discard(output_t *output) {
    (void)fclose(output->file);
    if (output->beside[0]) { (void)unlink(output->beside); }
}
