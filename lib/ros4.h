/* ROS4, L-stable: order 4 with an embedded method of order 3, three evaluations a step. E. Hairer, G. Wanner, "Solving
 * Ordinary Differential Equations II" (1996), IV.7, in the digits of KPP (A. Sandu et al., Atmos. Environ. 31, 1997).
 * Its dense output is our own: b_i(theta) meet the conditions of order 3 but the one on f'' (f, f), which no weights
 * meet for all theta beside an embedded method of order 3; b_4 is linear in theta. Order 2, 3 for linear equations. So
 * that position and velocity tell the same event, position is taken from its velocities instead (rosenbrock.c).
 * SPDX-License-Identifier: MIT */
/* clang-format off */
#define GAMMA PNEU_C(0.57282)

enum { DENSE_STAGES = 3, ERROR_FROM = 0 };

static const pneu_real at_time[PNEU_STAGE_COUNT] = {0, PNEU_C(1.14564), PNEU_C(0.65521686381559),
                                                    PNEU_C(0.65521686381559)};

static const pneu_real of_slope[PNEU_STAGE_COUNT] = {GAMMA, PNEU_C(-1.7691938913192333), PNEU_C(0.7592633437920481),
                                                     PNEU_C(-0.1049021087100449)};

static const unsigned char point[PNEU_STAGE_COUNT + 1] = {AT_START, FROM_START, FROM_START, AS_BEFORE, FROM_START};

static const pneu_real a[] = {
    PNEU_C(2.0),
    PNEU_C(1.867943637803922), PNEU_C(0.2344449711399156),
    PNEU_C(2.255570073418735), PNEU_C(0.2870493262186792), PNEU_C(0.4353179431840180), PNEU_C(1.093502252409163)};

static const pneu_real c[] = {
    PNEU_C(-7.137615036412310),
    PNEU_C(2.580708087951457), PNEU_C(0.6515950076447975),
    PNEU_C(-2.137148994382534), PNEU_C(-0.3214669691237626), PNEU_C(-0.6949742501781779)};

static const pneu_real e[] = {
    PNEU_C(-0.2815431932141155), PNEU_C(-0.07276199124934920), PNEU_C(-0.1082196201495311), PNEU_C(-1.093502252409163)};

static const pneu_real d[PNEU_DENSE_COUNT][DENSE_STAGES] = {
    {PNEU_C(2.773458653921005), PNEU_C(0.16730670051964985), PNEU_C(-1.7025642080212695)},
    {PNEU_C(-0.21339993065052537), PNEU_C(0.230739389346159), PNEU_C(0.6986541240669655)}};
/* clang-format on */
