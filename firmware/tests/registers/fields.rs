//! Where the fields of the registers are, from RM0090, written down apart from the code that sets them.

/// A field: name, lowest bit, bits, and what its values are called.
pub type Field = (&'static str, u32, u32, &'static [(u32, &'static str)]);

pub const CHANNELS: &[(u32, &str)] = &[
    (0, "IN0"),
    (1, "IN1"),
    (2, "IN2"),
    (3, "IN3"),
    (4, "IN4"),
    (5, "IN5"),
    (6, "IN6"),
    (7, "IN7"),
    (8, "IN8"),
    (9, "IN9"),
    (10, "IN10"),
    (11, "IN11"),
    (12, "IN12"),
    (13, "IN13"),
    (14, "IN14"),
    (15, "IN15"),
];
pub const ADC_CR1: &[Field] = &[
    ("EOCIE", 5, 1, &[]),
    ("JEOCIE", 7, 1, &[(1, "interrupt at the end of the injected group")]),
    ("SCAN", 8, 1, &[(1, "all ranks of a group")]),
    ("JAUTO", 10, 1, &[]),
    ("DISCEN", 11, 1, &[]),
    ("JDISCEN", 12, 1, &[]),
    ("RES", 24, 2, &[(0, "12 bits")]),
    ("OVRIE", 26, 1, &[]),
];
pub const ADC_CR2: &[Field] = &[
    ("ADON", 0, 1, &[(1, "on")]),
    ("CONT", 1, 1, &[]),
    ("DMA", 8, 1, &[]),
    ("EOCS", 10, 1, &[]),
    ("ALIGN", 11, 1, &[(0, "right")]),
    ("JEXTSEL", 16, 4, &[(0, "TIM1_CC4"), (1, "TIM1_TRGO"), (9, "TIM4_TRGO"), (14, "TIM8_CC4")]),
    ("JEXTEN", 20, 2, &[(0, "no trigger"), (1, "rising edge"), (2, "falling edge")]),
    ("JSWSTART", 22, 1, &[]),
    ("EXTSEL", 24, 4, &[]),
    ("EXTEN", 28, 2, &[(0, "no trigger")]),
    ("SWSTART", 30, 1, &[]),
];
pub const ADC_JSQR: &[Field] = &[
    ("JSQ1", 0, 5, CHANNELS),
    ("JSQ2", 5, 5, CHANNELS),
    ("JSQ3", 10, 5, CHANNELS),
    ("JSQ4", 15, 5, CHANNELS),
    ("JL", 20, 2, &[(3, "4 ranks")]),
];
pub const ADC_SQR1: &[Field] = &[("L", 20, 4, &[(0, "1 conversion")])];
pub const ADC_SQR3: &[Field] = &[("SQ1", 0, 5, CHANNELS)];
pub const CYCLES: &[(u32, &str)] =
    &[(0, "3"), (1, "15"), (2, "28"), (3, "56"), (4, "84"), (5, "112"), (6, "144"), (7, "480")];
pub const ADC_SMPR1: &[Field] = &[
    ("SMP10", 0, 3, CYCLES),
    ("SMP11", 3, 3, CYCLES),
    ("SMP12", 6, 3, CYCLES),
    ("SMP13", 9, 3, CYCLES),
    ("SMP14", 12, 3, CYCLES),
    ("SMP15", 15, 3, CYCLES),
    ("SMP16", 18, 3, CYCLES),
    ("SMP17", 21, 3, CYCLES),
    ("SMP18", 24, 3, CYCLES),
];
pub const ADC_SMPR2: &[Field] = &[
    ("SMP0", 0, 3, CYCLES),
    ("SMP1", 3, 3, CYCLES),
    ("SMP2", 6, 3, CYCLES),
    ("SMP3", 9, 3, CYCLES),
    ("SMP4", 12, 3, CYCLES),
    ("SMP5", 15, 3, CYCLES),
    ("SMP6", 18, 3, CYCLES),
    ("SMP7", 21, 3, CYCLES),
    ("SMP8", 24, 3, CYCLES),
    ("SMP9", 27, 3, CYCLES),
];
pub const ADC_CCR: &[Field] = &[
    ("MULTI", 0, 5, &[(0b00101, "dual, injected simultaneous"), (0b10101, "triple, injected simultaneous")]),
    ("DELAY", 8, 4, &[]),
    ("DMA", 14, 2, &[]),
    ("ADCPRE", 16, 2, &[(0, "bus by 2"), (1, "bus by 4"), (2, "bus by 6"), (3, "bus by 8")]),
    ("VBATE", 22, 1, &[]),
    ("TSVREFE", 23, 1, &[]),
];
pub const ADC_SR: &[Field] = &[
    ("AWD", 0, 1, &[]),
    ("EOC", 1, 1, &[]),
    ("JEOC", 2, 1, &[]),
    ("JSTRT", 3, 1, &[]),
    ("STRT", 4, 1, &[]),
    ("OVR", 5, 1, &[]),
];
pub const TIM_CR1: &[Field] = &[
    ("CEN", 0, 1, &[(0, "stands"), (1, "runs")]),
    ("UDIS", 1, 1, &[]),
    ("URS", 2, 1, &[]),
    ("OPM", 3, 1, &[]),
    ("DIR", 4, 1, &[]),
    ("CMS", 5, 2, &[(0, "edge-aligned"), (1, "centre-aligned 1"), (2, "centre-aligned 2"), (3, "centre-aligned 3")]),
    ("ARPE", 7, 1, &[]),
    ("CKD", 8, 2, &[]),
];
pub const TIM_CR2: &[Field] = &[("MMS", 4, 3, &[(0, "reset"), (1, "enable"), (2, "update"), (7, "OC4REF is TRGO")])];
pub const TIM_SMCR: &[Field] = &[
    ("SMS", 0, 3, &[(0, "off"), (4, "reset mode"), (5, "gated mode"), (6, "trigger mode")]),
    ("TS", 4, 3, &[(0, "ITR0, which is TIM1")]),
    ("MSM", 7, 1, &[]),
];
pub const OC_MODES: &[(u32, &str)] = &[(0, "frozen"), (6, "PWM mode 1"), (7, "PWM mode 2")];
pub const TIM_CCMR1: &[Field] = &[
    ("CC1S", 0, 2, &[(0, "output")]),
    ("OC1PE", 3, 1, &[(1, "preloaded")]),
    ("OC1M", 4, 3, OC_MODES),
    ("CC2S", 8, 2, &[(0, "output")]),
    ("OC2PE", 11, 1, &[(1, "preloaded")]),
    ("OC2M", 12, 3, OC_MODES),
];
pub const TIM_CCMR2: &[Field] = &[
    ("CC3S", 0, 2, &[(0, "output")]),
    ("OC3PE", 3, 1, &[(1, "preloaded")]),
    ("OC3M", 4, 3, OC_MODES),
    ("CC4S", 8, 2, &[(0, "output")]),
    ("OC4PE", 11, 1, &[]),
    ("OC4M", 12, 3, OC_MODES),
];
pub const TIM_CCER: &[Field] = &[
    ("CC1E", 0, 1, &[]),
    ("CC1P", 1, 1, &[(0, "active high")]),
    ("CC2E", 4, 1, &[]),
    ("CC2P", 5, 1, &[(0, "active high")]),
    ("CC3E", 8, 1, &[]),
    ("CC3P", 9, 1, &[(0, "active high")]),
    ("CC4E", 12, 1, &[]),
];
pub const TIM_BDTR: &[Field] = &[
    ("DTG", 0, 8, &[]),
    ("OSSI", 10, 1, &[(1, "held at the idle level while off")]),
    ("OSSR", 11, 1, &[(1, "held inactive while not enabled")]),
    ("BKE", 12, 1, &[]),
    ("AOE", 14, 1, &[]),
    ("MOE", 15, 1, &[(0, "outputs off"), (1, "outputs on")]),
];
pub const TIM_DIER: &[Field] =
    &[("UIE", 0, 1, &[]), ("CC4IE", 4, 1, &[(1, "interrupt at compare 4")]), ("TIE", 6, 1, &[])];
pub const TIM_SR: &[Field] = &[
    ("UIF", 0, 1, &[]),
    ("CC1IF", 1, 1, &[]),
    ("CC2IF", 2, 1, &[]),
    ("CC3IF", 3, 1, &[]),
    ("CC4IF", 4, 1, &[(0, "cleared")]),
    ("COMIF", 5, 1, &[]),
    ("TIF", 6, 1, &[]),
    ("BIF", 7, 1, &[]),
    ("CC1OF", 9, 1, &[]),
    ("CC2OF", 10, 1, &[]),
    ("CC3OF", 11, 1, &[]),
    ("CC4OF", 12, 1, &[]),
];
pub const COUNT: &[Field] = &[("count", 0, 16, &[])];
pub const USART_BRR: &[Field] = &[("DIV_Fraction", 0, 4, &[]), ("DIV_Mantissa", 4, 12, &[])];
pub const USART_CR1: &[Field] = &[
    ("RE", 2, 1, &[]),
    ("TE", 3, 1, &[]),
    ("PCE", 10, 1, &[(0, "no parity")]),
    ("M", 12, 1, &[(0, "8 bits")]),
    ("UE", 13, 1, &[]),
    ("OVER8", 15, 1, &[(0, "by 16")]),
];
pub const USART_CR3: &[Field] = &[("DMAR", 6, 1, &[]), ("DMAT", 7, 1, &[]), ("RTSE", 8, 1, &[]), ("CTSE", 9, 1, &[])];
pub const DMA_CR: &[Field] = &[
    ("EN", 0, 1, &[]),
    ("TCIE", 4, 1, &[]),
    ("DIR", 6, 2, &[(0, "peripheral to memory"), (1, "memory to peripheral")]),
    ("CIRC", 8, 1, &[]),
    ("PINC", 9, 1, &[]),
    ("MINC", 10, 1, &[]),
    ("PSIZE", 11, 2, &[(0, "bytes")]),
    ("MSIZE", 13, 2, &[(0, "bytes")]),
    ("PL", 16, 2, &[(0, "low"), (1, "medium"), (2, "high")]),
    ("CHSEL", 25, 3, &[(4, "channel 4")]),
];
pub const DMA_LIFCR: &[Field] = &[
    ("CFEIF3", 22, 1, &[]),
    ("CDMEIF3", 24, 1, &[]),
    ("CTEIF3", 25, 1, &[]),
    ("CHTIF3", 26, 1, &[]),
    ("CTCIF3", 27, 1, &[]),
];
pub const SPI_CR1: &[Field] = &[
    ("CPHA", 0, 1, &[(0, "the first edge samples"), (1, "the second edge samples")]),
    ("CPOL", 1, 1, &[(0, "low when idle")]),
    ("MSTR", 2, 1, &[(1, "master")]),
    ("BR", 3, 3, &[(3, "by 16")]),
    ("SPE", 6, 1, &[(0, "off"), (1, "on")]),
    ("LSBFIRST", 7, 1, &[(0, "high bit first")]),
    ("SSI", 8, 1, &[]),
    ("SSM", 9, 1, &[(1, "selects by software")]),
    ("RXONLY", 10, 1, &[(0, "both ways")]),
    ("DFF", 11, 1, &[(0, "8 bits")]),
    ("CRCEN", 13, 1, &[]),
    ("BIDIMODE", 15, 1, &[(0, "two lines")]),
];
pub const SPI_SR: &[Field] = &[("RXNE", 0, 1, &[(1, "a byte has come")]), ("TXE", 1, 1, &[]), ("BSY", 7, 1, &[])];
pub const IWDG_PR: &[Field] = &[("PR", 0, 3, &[(0, "by 4"), (5, "by 128")])];
pub const IWDG_RLR: &[Field] = &[("RL", 0, 12, &[])];
pub const RCC_CR: &[Field] =
    &[("HSEON", 16, 1, &[]), ("CSSON", 19, 1, &[(1, "clock security system on")]), ("PLLON", 24, 1, &[])];
pub const RCC_CSR: &[Field] = &[
    ("RMVF", 24, 1, &[(1, "forget")]),
    ("PORRSTF", 27, 1, &[]),
    ("SFTRSTF", 28, 1, &[]),
    ("IWDGRSTF", 29, 1, &[(1, "reset by the independent watchdog")]),
    ("WWDGRSTF", 30, 1, &[]),
];
