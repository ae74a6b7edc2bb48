/* The clocks that the port of RP2040 makes of those that a panel asks for: by the divisors that it writes, against the data
 * sheet's. */
#include "support/check.h"

static volatile uint32_t *register_at(uintptr_t address);

#define REGISTER(address) (*register_at(address))
#include "../firmware/rp2/port.c"

#include "../sim/mcu.h"

void clocks_reset(uint32_t subsystems) { (void)subsystems; }
void clocks_delay_ms(uint32_t delay_ms) { (void)delay_ms; }
void clocks_enable_irq(uint32_t irq) { (void)irq; }
void clocks_hold_irqs(void) {}
void clocks_release_irqs(void) {}
void clocks_sleep_until(const volatile uint32_t *flag) { (void)flag; }
void clocks_wake(volatile uint32_t *flag) { *flag = 1; }

static struct {
    uintptr_t address;
    volatile uint32_t value;
} registers[64];

static volatile uint32_t *register_at(uintptr_t address) {
    for (size_t i = 0; i < CHECK_COUNT(registers); i++) {
        if (registers[i].address == 0) { registers[i].address = address; }
        if (registers[i].address == address) { return &registers[i].value; }
    }
    abort();
}

/* Of SPI0, as it is set: clk_peri / (CPSDVSR * (1 + SCR)) (RP2040 data sheet, 4.4.3.4), rounded down. */
static uint32_t clock_set(void) {
    const uint32_t prescaler = SPI0_CPSR;

    assert_true(prescaler >= 2 && prescaler <= 254 && prescaler % 2 == 0);
    assert_int_equal(SPI0_CR0 & 0xffu, 0xc7); /* 8 bits, idle high, the second edge */
    return 125000000u / (prescaler * (1u + (SPI0_CR0 >> 8)));
}

static tuile_bus_t opened(void) {
    tuile_bus_t bus;

    port_open(&bus);
    SPI0_SR = SPI_SR_TNF;
    return bus;
}

static uint32_t command_clock(const tuile_bus_t *bus, uint32_t asked_hz) {
    const uint8_t byte = 0;

    assert_int_equal(bus->clocks(NULL, asked_hz, 62500000), 0);
    assert_int_equal(bus->command(NULL, &byte, 1, 1), 0);
    return clock_set();
}

static void test_the_clock_is_the_fastest_that_is_not_above(void **state) {
    const tuile_bus_t bus = opened();
    const sim_mcu_t *mcu = sim_mcu_find("rp2040");
    (void)state;
    for (uint32_t asked = 250000; asked < 70000000; asked += asked / 300) {
        assert_int_equal(command_clock(&bus, asked), sim_mcu_clock(mcu, asked));
    }
    assert_int_equal(command_clock(&bus, 62500000), 62500000);
    assert_int_equal(command_clock(&bus, 62499999), 31250000);
    assert_int_equal(command_clock(&bus, UINT32_MAX), 62500000);
}

/* 125 MHz / (254 * 256) = 1922.37 Hz. */
static void test_a_clock_below_the_slowest_is_refused(void **state) {
    const tuile_bus_t bus = opened();
    (void)state;
    assert_int_equal(command_clock(&bus, 1923), 1922);
    assert_int_equal(bus.clocks(NULL, 1922, 62500000), TUILE_HAL_ARGUMENT);
    assert_int_equal(bus.clocks(NULL, 10000000, 1922), TUILE_HAL_ARGUMENT);
    assert_int_equal(bus.clocks(NULL, 0, 62500000), TUILE_HAL_ARGUMENT);
}

static void test_commands_and_pixels_have_clocks_of_their_own(void **state) {
    const tuile_bus_t bus = opened();
    static const uint8_t bytes[2] = {0};
    (void)state;
    assert_int_equal(bus.clocks(NULL, 10000000, 40000000), 0);
    for (unsigned round = 0; round < 2; round++) {
        assert_int_equal(bus.command(NULL, bytes, 1, 2), 0);
        assert_int_equal(clock_set(), 8928571); /* / 14 */
        assert_int_equal(bus.data(NULL, bytes, 2), 0);
        assert_int_equal(clock_set(), 31250000); /* / 4 */
        assert_int_equal(bus.wait(NULL), 0);
    }
    assert_int_equal(bus.clocks(NULL, 10000000, 70000000), 0); /* told anew */
    assert_int_equal(bus.data(NULL, bytes, 2), 0);
    assert_int_equal(clock_set(), 62500000);
    assert_int_equal(bus.wait(NULL), 0);
}

static uint32_t low(const void *bytes) { return (uint32_t)(uintptr_t)bytes; }

/* The channel has what it has until its interrupt; then it has what waits, if anything does. */
static void test_the_interrupt_begins_what_waits(void **state) {
    const tuile_bus_t bus = opened();
    static const uint8_t a[10], b[20], c[30];
    (void)state;
    assert_int_equal(bus.clocks(NULL, 10000000, 40000000), 0);
    for (unsigned round = 0; round < 2; round++) {
        assert_int_equal(bus.data(NULL, a, sizeof a), 0);
        assert_int_equal(DMA_READ_ADDR(0), low(a));
        assert_int_equal(DMA_COUNT(0), 10);
        assert_true(one_left && !sent);
        assert_int_equal(bus.data(NULL, b, sizeof b), 0);
        assert_int_equal(DMA_READ_ADDR(0), low(a));
        assert_true(!one_left && !sent); /* wait_one sleeps, and so does wait */
        DMA_CTRL_TRIGGER(0) = 0;
        rp2_dma_0();
        assert_int_equal(DMA_READ_ADDR(0), low(b));
        assert_int_equal(DMA_COUNT(0), 20);
        assert_true(DMA_CTRL_TRIGGER(0) & DMA_CTRL_ENABLE);
        assert_true(one_left && !sent);
        assert_int_equal(bus.wait_one(NULL), 0);
        assert_int_equal(bus.data(NULL, c, sizeof c), 0);
        rp2_dma_0();
        assert_int_equal(DMA_READ_ADDR(0), low(c));
        assert_int_equal(DMA_COUNT(0), 30);
        rp2_dma_0();
        assert_int_equal(DMA_READ_ADDR(0), low(c));
        assert_true(one_left && sent);
        /* All has gone out, and nobody has waited: the next begins at once. */
        assert_int_equal(bus.data(NULL, a, sizeof a), 0);
        assert_int_equal(DMA_READ_ADDR(0), low(a));
        assert_true(one_left && !sent);
        rp2_dma_0();
        assert_true(sent);
        SIO_OUT_SET = 0;
        assert_int_equal(bus.wait(NULL), 0);
        assert_int_equal(SIO_OUT_SET, 1u << PORT_PIN_SELECT);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_clock_is_the_fastest_that_is_not_above),
        cmocka_unit_test(test_a_clock_below_the_slowest_is_refused),
        cmocka_unit_test(test_commands_and_pixels_have_clocks_of_their_own),
        cmocka_unit_test(test_the_interrupt_begins_what_waits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
