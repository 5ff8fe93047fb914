/* Start-up for QEMU's netduinoplus2 (STM32F405): vector table, FPU, memory, semihosting, main. A flight controller has
 * its own. */
#include <stdint.h>
#include <stdlib.h>

extern uint32_t stack_top, data_load, data_start, data_end, bss_start, bss_end;

int main(void);
/* Of newlib's librdimon: opens the emulator's console as stdout. */
void initialise_monitor_handles(void);
void reset(void);

/* newlib's exit calls these; there is nothing to construct or destroy. */
void _init(void);
void _fini(void);
void _init(void) {}
void _fini(void) {}

/* An unexpected exception ends the program with status 70: the emulator would run on for ever. */
static void fault(void) { _Exit(70); }

void reset(void) {
  /* Full access to coprocessors 10 and 11, the FPU, before any code that uses it (CPACR). */
  *(volatile uint32_t *)0xe000ed88u |= 0xfu << 20;
  __asm volatile("dsb\n\tisb" ::: "memory");
  for (uint32_t *from = &data_load, *to = &data_start; to < &data_end;) *to++ = *from++;
  for (uint32_t *to = &bss_start; to < &bss_end;) *to++ = 0;
  initialise_monitor_handles();
  exit(main());
}

typedef union {
  void (*handler)(void);
  void *address;
} vector;

/* The exceptions of the core; nothing here enables an interrupt. */
__attribute__((section(".vectors"), used)) static const vector vectors[16] = {
    {.address = &stack_top}, {reset}, {fault}, {fault}, {fault}, {fault}, {fault}, {0},
    {0},                     {0},     {0},     {fault}, {fault}, {0},     {fault}, {fault},
};
