/* Registers of the STM32F411 that this board uses. Numbers in brackets are sections of its reference manual, RM0383. */
#ifndef TUILE_FIRMWARE_STM32F411_H
#define TUILE_FIRMWARE_STM32F411_H

#include <stdint.h>

#define REGISTER(address) (*(volatile uint32_t *)(address))

/* Reset and clock control (6.3). */
#define RCC_CR REGISTER(0x40023800u)
#define RCC_PLLCFGR REGISTER(0x40023804u)
#define RCC_CFGR REGISTER(0x40023808u)
#define RCC_AHB1ENR REGISTER(0x40023830u) /* bit 0 port A, bit 22 DMA2 */
#define RCC_APB1ENR REGISTER(0x40023840u) /* bit 3 TIM5, bit 28 PWR */
#define RCC_APB2ENR REGISTER(0x40023844u) /* bit 4 USART1, bit 12 SPI1 */
#define RCC_CR_HSEON (1u << 16)
#define RCC_CR_HSERDY (1u << 17)
#define RCC_CR_PLLON (1u << 24)
#define RCC_CR_PLLRDY (1u << 25)
#define RCC_CFGR_SW_PLL 2u
#define RCC_CFGR_SWS (3u << 2)
#define RCC_CFGR_SWS_PLL (2u << 2)
#define RCC_CFGR_APB1_HALF (4u << 10) /* at most 50 MHz */

/* 25 MHz / 25 * 200 / 2 = 100 MHz (6.3.2); / 4 for USB, which is not used. */
#define PLL_FROM_HSE (25u | 200u << 6 | 0u << 16 | 1u << 22 | 4u << 24)
#define CORE_HZ 100000000u

#define PWR_CR REGISTER(0x40007000u) /* (5.4.1) */
#define PWR_CR_VOS_SCALE_1 (3u << 14)

#define FLASH_ACR REGISTER(0x40023c00u)                       /* (3.8.1) */
#define FLASH_ACR_3_WAITS (3u | 1u << 8 | 1u << 9 | 1u << 10) /* for 90 to 100 MHz (3.4.1), with prefetch and caches */

/* Port A (8.4). */
#define GPIOA_MODER REGISTER(0x40020000u)
#define GPIOA_OSPEEDR REGISTER(0x40020008u)
#define GPIOA_PUPDR REGISTER(0x4002000cu)
#define GPIOA_IDR REGISTER(0x40020010u)
#define GPIOA_BSRR REGISTER(0x40020018u) /* low half sets, high half clears */
#define GPIOA_AFRL REGISTER(0x40020020u)
#define GPIOA_AFRH REGISTER(0x40020024u)
#define MODE_OUTPUT 1u
#define MODE_FUNCTION 2u
#define SPEED_HIGH 3u
#define PULL_UP 1u
#define FUNCTION_SPI1 5u
#define FUNCTION_USART1 7u

/* SPI1 (20.5), on APB2. */
#define SPI1_CR1 REGISTER(0x40013000u)
#define SPI1_CR2 REGISTER(0x40013004u)
#define SPI1_SR REGISTER(0x40013008u)
#define SPI1_DR REGISTER(0x4001300cu)
#define SPI_CR1_MODE_3 3u
#define SPI_CR1_MASTER (1u << 2)
#define SPI_CR1_RATE(n) ((uint32_t)(n) << 3) /* APB2 / 2^(n + 1) */
#define SPI_CR1_ENABLE (1u << 6)
#define SPI_CR1_SELECT_BY_SOFTWARE (3u << 8)
#define SPI_CR1_TRANSMIT_ONLY (3u << 14) /* one line, and it is an output: nothing is received */
#define SPI_CR2_TX_DMA (1u << 1)
#define SPI_SR_TXE (1u << 1)
#define SPI_SR_BSY (1u << 7)

/* DMA2, stream 3, of whose channels the third is SPI1's transmitter (9.3.3, 9.5). */
#define DMA2_LIFCR REGISTER(0x40026408u)
#define DMA2_S3CR REGISTER(0x40026458u)
#define DMA2_S3NDTR REGISTER(0x4002645cu)
#define DMA2_S3PAR REGISTER(0x40026460u)
#define DMA2_S3M0AR REGISTER(0x40026464u)
#define DMA_STREAM_3_FLAGS 0x0f400000u
#define DMA_CR_ENABLE 1u
#define DMA_CR_INTERRUPT_AT_END (1u << 4)
#define DMA_CR_TO_PERIPHERAL (1u << 6)
#define DMA_CR_MEMORY_INCREMENTS (1u << 10)
#define DMA_CR_CHANNEL_3 (3u << 25)
#define DMA_MOST_BYTES 65534u /* the counter has 16 bits; even */

/* USART1 (19.6), on APB2. */
#define USART1_SR REGISTER(0x40011000u)
#define USART1_DR REGISTER(0x40011004u)
#define USART1_BRR REGISTER(0x40011008u)
#define USART1_CR1 REGISTER(0x4001100cu)
#define USART_SR_TXE (1u << 7)
#define USART_CR1_TRANSMIT (1u << 13 | 1u << 3)

/* TIM5, of 32 bits (13.4), on APB1: its clock is twice that bus's, as the bus is divided (6.2). */
#define TIM5_CR1 REGISTER(0x40000c00u)
#define TIM5_EGR REGISTER(0x40000c14u)
#define TIM5_CNT REGISTER(0x40000c24u)
#define TIM5_PSC REGISTER(0x40000c28u)
#define TIM_CR1_ENABLE 1u
#define TIM_EGR_UPDATE 1u /* takes the prescaler over */

/* Of the core (DDI 0403, B3.3 and B3.4). */
#define SYST_CSR REGISTER(0xe000e010u)
#define SYST_RVR REGISTER(0xe000e014u)
#define SYST_CVR REGISTER(0xe000e018u)
#define SYST_CSR_COUNTFLAG 0x10000u
#define NVIC_ISER1 REGISTER(0xe000e104u)

#define IRQ_DMA2_STREAM_3 59u /* (10.2) */
#define IRQ_COUNT 86u

#endif
