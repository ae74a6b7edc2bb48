/* The displays on USB, for people to read. */
#ifndef SIM_DISPLAYS_USB_H
#define SIM_DISPLAYS_USB_H

/* Prints a line for each display on stdout, and why it cannot be used if so; a line that says there is none otherwise. Displays
 * that the kernel's driver or another program has are left alone. */
void displays_usb_print(void);

#endif
