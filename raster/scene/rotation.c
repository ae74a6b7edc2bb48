#include "rotation.h"

static bool entry_fits(int64_t value) { return value <= ROTATION_ENTRY_MAX && value >= -(int64_t)ROTATION_ENTRY_MAX; }

bool rotation_is_unit(const q2_30_t rotation[3][3]) {
    for (int i = 0; i < 3; i++) {
        int64_t squares = -((int64_t)1 << 60);
        for (int j = 0; j < 3; j++) {
            if (!entry_fits(rotation[i][j])) { return false; }
            squares += (int64_t)rotation[i][j] * rotation[i][j];
        }
        if (squares > (int64_t)1 << 46 || squares < -((int64_t)1 << 46)) { return false; } /* (1 + 2^-15)^2 = 1 + 2^-14 */
    }
    return true;
}

bool rotation_multiply(q2_30_t out[3][3], const q2_30_t a[3][3], const q2_30_t b[3][3]) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            int64_t sum = (int64_t)1 << 29; /* |sum| < 3.01 * 2^60 */
            for (int k = 0; k < 3; k++) {
                sum += (int64_t)a[i][k] * b[k][j];
            }
            if (!entry_fits(sum >> 30)) { return false; }
            out[i][j] = (q2_30_t)(sum >> 30);
        }
    }
    return true;
}
