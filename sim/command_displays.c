/* tuile displays: what is attached that a picture could be drawn on, and why it cannot be if it cannot. */
#include "../hal/bus.h"
#include "../hal/linux/lines.h"
#include "../hal/linux/spi.h"
#include "commands.h"
#include "displays_usb.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] = "Usage: tuile displays\n"
                            "\n"
                            "Lists what is attached: SPI devices, GPIO chips with the lines that somebody has, displays on USB; "
                            "and why something cannot be\n"
                            "used. `tuile render --help` tells how they are named for --display.\n";

enum { NAMES_MOST = 64 };

static int by_version(const void *a, const void *b) { return strverscmp(*(char *const *)a, *(char *const *)b); }

/* The files in /dev whose names begin so, in order; returns how many. Each is to be freed. */
static size_t nodes(const char *begin, char *names[NAMES_MOST]) {
    DIR *folder = opendir("/dev");
    size_t count = 0;
    if (!folder) { return 0; }
    for (struct dirent *entry; count < NAMES_MOST && (entry = readdir(folder)) != NULL;) {
        if (strncmp(entry->d_name, begin, strlen(begin)) == 0 && (names[count] = strdup(entry->d_name))) { count++; }
    }
    (void)closedir(folder);
    qsort(names, count, sizeof *names, by_version);
    return count;
}

static void print_spi(void) {
    char *names[NAMES_MOST];
    const size_t count = nodes("spidev", names);
    (void)printf("SPI, transfers of up to %u bytes (bufsiz)\n", tuile_linux_spi_bufsiz());
    if (count == 0) {
        (void)printf(
            "  no SPI devices: there is no /dev/spidev*; the device tree has to ask for one (Raspberry Pi: dtparam=spi=on)\n");
    }
    for (size_t i = 0; i < count; i++) {
        tuile_linux_fault_t fault = {""};
        char path[300];
        (void)snprintf(path, sizeof path, "/dev/%s", names[i]);
        if (tuile_linux_spi_probe(path, &fault)) {
            (void)printf("  %s\n", fault.text);
        } else {
            (void)printf("  %s: ready\n", path);
        }
        free(names[i]);
    }
}

static void print_user(void *context, uint32_t offset, const char *consumer) {
    (void)context;
    (void)printf("    line %u is in use by %s\n", offset, *consumer ? consumer : "somebody without a name");
}

static void print_gpio(void) {
    char *names[NAMES_MOST];
    const size_t count = nodes("gpiochip", names);
    (void)printf("GPIO, through libgpiod %s\n", tuile_linux_gpiod_version());
    if (count == 0) { (void)printf("  no GPIO chips: there is no /dev/gpiochip*\n"); }
    for (size_t i = 0; i < count; i++) {
        tuile_linux_fault_t fault = {""};
        tuile_linux_chip_t chip;
        if (tuile_linux_chip(&chip, names[i], NULL, NULL, &fault)) {
            (void)printf("  %s\n", fault.text);
        } else {
            (void)printf("  %s: %s, %u lines\n", names[i], chip.label, chip.lines);
            (void)tuile_linux_chip(&chip, names[i], print_user, NULL, &fault);
        }
        free(names[i]);
    }
}

int command_displays(int count, char **arguments) {
    if (count == 1 && strcmp(arguments[0], "--help") == 0) {
        (void)fputs(usage, stdout);
        return command_finish();
    }
    if (count > 0) {
        (void)command_fail("displays: takes no arguments, but got %s", arguments[0]);
        return EXIT_USAGE;
    }
    print_spi();
    print_gpio();
    displays_usb_print();
    return command_finish();
}
