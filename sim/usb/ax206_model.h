/* A photo frame with an AX206 chip whose firmware takes pictures over USB ("dpf"): SCSI commands in bulk-only transport. */
#ifndef SIM_AX206_MODEL_H
#define SIM_AX206_MODEL_H

#include "usb_model.h"

/* Zero = default, throughout. */
typedef struct sim_ax206_config {
    uint16_t width, height; /* 0: 480 x 320 */
    const char *serial;     /* outlives the model; NULL: none */
} sim_ax206_config_t;

/* Readable: what arrived. */
typedef struct sim_ax206_counts {
    uint32_t blits, properties, size_reads;
    uint64_t pixel_bytes;
} sim_ax206_counts_t;

/* A frame that has just been plugged in, its picture noise, its brightness 7. config may be NULL. NULL and one line in error
 * without memory or for a size of 0. Freed with usb->destroy(usb). */
sim_usb_t *sim_ax206_create(const sim_ax206_config_t *config, sim_error_t *error);

sim_ax206_counts_t *sim_ax206_counts(sim_usb_t *usb);

/* 0 ... 7 */
unsigned sim_ax206_brightness(const sim_usb_t *usb);

/* For faults: the next command ends with this status byte (1 = failed); 0 ends it. */
void sim_ax206_break(sim_usb_t *usb, uint8_t status);

#endif
