# What the figures of a report share, besides style.gp: places in pixels from the top, and tics that are few enough.
AT(px) = 1 - px / (1.0 * HEIGHT)
POWER(x) = 10 ** floor(log10(x))
NICE(x) = POWER(x) * (x < 1.5 * POWER(x) ? 1 : x < 3.5 * POWER(x) ? 2 : x < 7.5 * POWER(x) ? 5 : 10)
