/* A plugin of QEMU that counts instructions: from the function at `from` to the one at `to` each time, and says so on stderr,
 * "instructions N". Load it with -plugin file=libcount.so,from=ADDRESS,to=ADDRESS, without -icount.
 *
 * Debian's QEMU exports the interface for plugins but has no header for it: what is used of version 1 is declared here, as
 * QEMU 7.2's documentation of TCG plugins describes it. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORT __attribute__((visibility("default")))

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, void (*translated)(qemu_plugin_id_t id, struct qemu_plugin_tb *tb));
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *tb);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *tb, size_t at);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *insn);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *insn, enum qemu_plugin_op op, void *number,
                                                uint64_t value);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *insn, void (*executed)(unsigned cpu, void *data),
                                            enum qemu_plugin_cb_flags flags, void *data);

EXPORT int qemu_plugin_version = 1;
EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const struct qemu_info *info, int count, char **arguments);

static uint64_t from, to, executed;

static void begin(unsigned cpu, void *data) {
    (void)cpu, (void)data;
    executed = 0;
}

static void end(unsigned cpu, void *data) {
    (void)cpu, (void)data;
    (void)fprintf(stderr, "instructions %llu\n", (unsigned long long)executed);
}

/* The callback comes first, then the addition: the first instruction of `from` is counted, that of `to` is not. */
static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *tb) {
    const size_t count = qemu_plugin_tb_n_insns(tb);

    (void)id;
    for (size_t i = 0; i < count; i++) {
        struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(tb, i);
        const uint64_t address = qemu_plugin_insn_vaddr(insn);

        if (address == from || address == to) {
            qemu_plugin_register_vcpu_insn_exec_cb(insn, address == from ? begin : end, QEMU_PLUGIN_CB_NO_REGS, NULL);
        }
        qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64, &executed, 1);
    }
}

int qemu_plugin_install(qemu_plugin_id_t id, const struct qemu_info *info, int count, char **arguments) {
    (void)info;
    for (int i = 0; i < count; i++) {
        if (strncmp(arguments[i], "from=", 5) == 0) { from = strtoull(arguments[i] + 5, NULL, 0); }
        if (strncmp(arguments[i], "to=", 3) == 0) { to = strtoull(arguments[i] + 3, NULL, 0); }
    }
    if (!from || !to) { return -1; }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    return 0;
}
