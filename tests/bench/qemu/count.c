/* A plugin of QEMU's TCG: counts how often each instruction of the guest is executed between two markers.
 *
 * Arguments: from=ADDRESS and to=ADDRESS of the functions that the guest calls before and behind what is to be counted;
 * base=ADDRESS and bytes=N: where the program lies; out=FILE: lines of address and count, hexadecimal and decimal, when the guest
 * has ended.
 *
 * Debian's qemu-system exports the interface without a header. What is used of it is declared here, as QEMU's documentation of the
 * plugin interface, version 1, has it.
 */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { QEMU_PLUGIN_INLINE_ADD_U64 = 0, QEMU_PLUGIN_CB_NO_REGS = 0 };

extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *tb);
extern struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *tb, size_t index);
extern uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *insn);
extern void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, void (*on)(qemu_plugin_id_t, struct qemu_plugin_tb *));
extern void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *insn, int operation, void *to, uint64_t operand);
extern void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *insn, void (*on)(unsigned, void *), int registers,
                                                   void *context);
extern void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, void (*on)(qemu_plugin_id_t, void *), void *context);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

typedef struct counter {
    uint64_t from, to, base;
    size_t count;     /* half words of the program */
    uint64_t *now;    /* executed since the start, by half word */
    uint64_t *before; /* at the last marker `from` */
    uint64_t *sum;    /* between markers */
    const char *out;
} counter_t;

static counter_t counter;

static void on_from(unsigned vcpu, void *context) {
    (void)vcpu, (void)context;
    memcpy(counter.before, counter.now, counter.count * sizeof(uint64_t));
}

static void on_to(unsigned vcpu, void *context) {
    (void)vcpu, (void)context;
    for (size_t i = 0; i < counter.count; i++) {
        counter.sum[i] += counter.now[i] - counter.before[i];
    }
}

static void on_block(qemu_plugin_id_t id, struct qemu_plugin_tb *tb) {
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(tb); i++) {
        struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(tb, i);
        const uint64_t at = qemu_plugin_insn_vaddr(insn), slot = (at - counter.base) / 2;
        if (at == counter.from) { qemu_plugin_register_vcpu_insn_exec_cb(insn, on_from, QEMU_PLUGIN_CB_NO_REGS, NULL); }
        if (at == counter.to) { qemu_plugin_register_vcpu_insn_exec_cb(insn, on_to, QEMU_PLUGIN_CB_NO_REGS, NULL); }
        if (at < counter.base || slot >= counter.count) { continue; }
        qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64, &counter.now[slot], 1);
    }
}

static void on_end(qemu_plugin_id_t id, void *context) {
    (void)id, (void)context;
    FILE *file = fopen(counter.out, "w");
    if (file == NULL) { return; }
    for (size_t i = 0; i < counter.count; i++) {
        if (counter.sum[i]) { (void)fprintf(file, "%" PRIx64 " %" PRIu64 "\n", counter.base + 2 * i, counter.sum[i]); }
    }
    (void)fclose(file);
}

static bool option(const char *argument, const char *name, uint64_t *value) {
    const size_t length = strlen(name);
    if (strncmp(argument, name, length) != 0 || argument[length] != '=') { return false; }
    *value = strtoull(argument + length + 1, NULL, 0);
    return true;
}

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id, const void *info, int argc, char **argv) {
    uint64_t bytes = 0;
    (void)info;
    for (int i = 0; i < argc; i++) {
        if (strncmp(argv[i], "out=", 4) == 0) {
            counter.out = strdup(argv[i] + 4);
        } else if (!option(argv[i], "from", &counter.from) && !option(argv[i], "to", &counter.to) &&
                   !option(argv[i], "base", &counter.base) && !option(argv[i], "bytes", &bytes)) {
            return 1;
        }
    }
    counter.count = (size_t)(bytes + 1) / 2;
    counter.now = calloc(counter.count, sizeof(uint64_t));
    counter.before = calloc(counter.count, sizeof(uint64_t));
    counter.sum = calloc(counter.count, sizeof(uint64_t));
    if (counter.out == NULL || counter.count == 0 || !counter.now || !counter.before || !counter.sum) { return 1; }
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_block);
    qemu_plugin_register_atexit_cb(id, on_end, NULL);
    return 0;
}
