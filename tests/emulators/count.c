/* A plugin of QEMU that counts instructions from the function at `from` to the one at `to`, each time that the guest calls the two.
 * Load it with -plugin file=libcount.so,from=ADDRESS,to=ADDRESS, without -icount: it says "instructions N" on stderr each time.
 *
 * With base=ADDRESS,bytes=N,out=FILE it counts each instruction of a program that lies there instead, and over all times: lines of
 * address and count, hexadecimal and decimal, in FILE when the guest has ended.
 *
 * Debian's QEMU exports the interface for plugins but has no header for it: what is used of version 1 is declared here, as
 * QEMU 7.2's documentation of TCG plugins describes it. */
#include <inttypes.h>
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
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, void (*ended)(qemu_plugin_id_t id, void *data), void *data);

EXPORT int qemu_plugin_version = 1;
EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const struct qemu_info *info, int count, char **arguments);

static uint64_t from, to, executed;

/* By address: each half word of the program, since the start, at the last `from`, and between the two. */
static struct {
    uint64_t base, bytes;
    const char *out; /* NULL: not by address */
    size_t count;
    uint64_t *now, *before, *sum;
} each;

static void begin(unsigned cpu, void *data) {
    (void)cpu, (void)data;
    executed = 0;
    if (each.out) { memcpy(each.before, each.now, each.count * sizeof(uint64_t)); }
}

static void end(unsigned cpu, void *data) {
    (void)cpu, (void)data;
    if (!each.out) { (void)fprintf(stderr, "instructions %" PRIu64 "\n", executed); }
    for (size_t i = 0; i < each.count; i++) {
        each.sum[i] += each.now[i] - each.before[i];
    }
}

/* The callback comes first, then the addition: the first instruction of `from` is counted, that of `to` is not. */
static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *tb) {
    const size_t count = qemu_plugin_tb_n_insns(tb);

    (void)id;
    for (size_t i = 0; i < count; i++) {
        struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(tb, i);
        const uint64_t address = qemu_plugin_insn_vaddr(insn), slot = (address - each.base) / 2;
        uint64_t *number = &executed;

        if (address == from || address == to) {
            qemu_plugin_register_vcpu_insn_exec_cb(insn, address == from ? begin : end, QEMU_PLUGIN_CB_NO_REGS, NULL);
        }
        if (each.out) { number = address >= each.base && slot < each.count ? &each.now[slot] : NULL; }
        if (number) { qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64, number, 1); }
    }
}

static void ended(qemu_plugin_id_t id, void *data) {
    FILE *file = fopen(each.out, "w");

    (void)id, (void)data;
    for (size_t i = 0; file && i < each.count; i++) {
        if (each.sum[i]) { (void)fprintf(file, "%" PRIx64 " %" PRIu64 "\n", each.base + 2 * i, each.sum[i]); }
    }
    if (!file || fclose(file)) { (void)fprintf(stderr, "%s cannot be written\n", each.out); }
}

int qemu_plugin_install(qemu_plugin_id_t id, const struct qemu_info *info, int count, char **arguments) {
    const struct {
        const char *name;
        uint64_t *value;
    } numbers[] = {{"from=", &from}, {"to=", &to}, {"base=", &each.base}, {"bytes=", &each.bytes}};

    (void)info;
    for (int i = 0; i < count; i++) {
        for (size_t j = 0; j < sizeof numbers / sizeof numbers[0]; j++) {
            const size_t length = strlen(numbers[j].name);
            if (strncmp(arguments[i], numbers[j].name, length) == 0) {
                *numbers[j].value = strtoull(arguments[i] + length, NULL, 0);
            }
        }
        if (strncmp(arguments[i], "out=", 4) == 0) { each.out = strdup(arguments[i] + 4); }
    }
    if (!from || !to) { return -1; }
    if (each.out) {
        each.count = (size_t)(each.bytes + 1) / 2;
        each.now = calloc(each.count, sizeof(uint64_t));
        each.before = calloc(each.count, sizeof(uint64_t));
        each.sum = calloc(each.count, sizeof(uint64_t));
        if (each.count == 0 || !each.now || !each.before || !each.sum) { return -1; }
        qemu_plugin_register_atexit_cb(id, ended, NULL);
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    return 0;
}
