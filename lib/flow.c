/* Mass flow through an orifice under each flow law. */
#include "internal.h"

/* A law without area and temperature: q = area p_up gain psi(r) / sqrt(T_up), r = p_down/p_up. */
typedef struct shape {
  int sloped;          /* 0: the slope is not wanted, and may be anything */
  pneu_real gain;      /* [sqrt(kg K/J)] */
  pneu_real psi, dpsi; /* value and slope in r */
  int choked;
} shape;

/* w^m of w = 1 - r; within PNEU_BLEND of equal pressures the odd polynomial w_b^m z (a + b z^2 + c z^4),
 * z = w/w_b, which meets value, slope and curvature of the power at z = 1 and is linear at 0:
 * c = (m - 1)(m - 3)/8, b = (m - 1)(5 - m)/4, a = 1 - b - c.  Out: slope in w. */
static pneu_real power(pneu_real w, pneu_real m, int sloped, pneu_real *slope)
{
  const int root = m == PNEU_C(0.5);
  const pneu_real at = w >= PNEU_BLEND ? w : PNEU_BLEND, value = root ? PNEU_M(sqrt)(at) : PNEU_M(pow)(at, m);
  pneu_real a, b, c, z, z2;
  *slope = 0;
  if (w >= PNEU_BLEND) {
    if (sloped)
      *slope = m * value / w;
    return value;
  }
  c = (m - 1) * (m - 3) / 8;
  b = (m - 1) * (5 - m) / 4;
  a = 1 - b - c;
  z = w * (1 / PNEU_BLEND);
  z2 = z * z;
  *slope = value * (a + z2 * (3 * b + z2 * 5 * c)) * (1 / PNEU_BLEND);
  return value * z * (a + z2 * (b + z2 * c));
}

/* [B, Eq. 8]: psi = sqrt(1 - r). */
static void paper(const pneu_model *model, pneu_real w, shape *s)
{
  pneu_real slope;
  s->gain = model->paper_gain;
  s->psi = power(w, PNEU_C(0.5), s->sloped, &slope);
  s->dpsi = -slope;
  s->choked = 0;
}

/* psi = sqrt(r^a - r^b), a = 2/gamma, b = (gamma+1)/gamma, held below the critical ratio. With d = 1 - 1/gamma and
 * e = r^d - 1 it is sqrt(w) G, G = r sqrt(-e/w)/(1 + e): one power, and no cancellation at r = 1. */
static void nozzle(const pneu_model *model, pneu_real w, shape *s)
{
  const pneu_real d = model->nozzle_exponent, r = 1 - w;
  pneu_real e, g, dg, s0, slope;
  s->gain = model->nozzle_gain;
  s->choked = r <= model->critical_ratio;
  if (s->choked) {
    s->gain = model->choked_gain;
    s->psi = 1;
    s->dpsi = 0;
    return;
  }
  e = PNEU_M(expm1)(d * PNEU_M(log1p)(-w));
  g = r / (1 + e) * PNEU_M(sqrt)(w > 0 ? -e / w : d);
  s0 = power(w, PNEU_C(0.5), s->sloped, &slope);
  s->psi = s0 * g;
  if (!s->sloped)
    return;
  if (w < PNEU_BLEND) /* d(G^2)/dw at w = 0 is -d (2/gamma + (d - 1)/2) */
    dg = -d * (2 - 2 * d + (d - 1) / 2) / (2 * g);
  else
    dg = -g * ((1 + d * (1 - e) / (2 * e)) / r + 1 / (2 * w));
  s->dpsi = -(s0 * dg + slope * g);
}

/* phi = (1 - ((r - b)/(1 - b))^2)^m = (w (1 + z)/(1 - b))^m, z = (r - b)/(1 - b); 1 below b. */
static void iso6358(const pneu_model *model, pneu_real w, shape *s)
{
  const pneu_real b = model->p.critical_ratio, m = model->p.subsonic_index;
  pneu_real c, cm, s0, slope;
  s->gain = model->choked_gain;
  s->choked = 1 - w <= b;
  if (s->choked) {
    s->psi = 1;
    s->dpsi = 0;
    return;
  }
  c = (2 - 2 * b - w) / ((1 - b) * (1 - b)); /* (1 + z)/(1 - b) */
  cm = m == PNEU_C(0.5) ? PNEU_M(sqrt)(c) : PNEU_M(pow)(c, m);
  s0 = power(w, m, s->sloped, &slope);
  s->psi = s0 * cm;
  s->dpsi = cm * (s0 * m / (c * (1 - b) * (1 - b)) - slope);
}

/* Flow in proportion to the pressure difference: psi = 1 - r. */
static void linear(const pneu_model *model, pneu_real w, shape *s)
{
  s->gain = model->paper_gain;
  s->psi = w;
  s->dpsi = -1;
  s->choked = 0;
}

static void linear_choked(const pneu_model *model, pneu_real w, shape *s)
{
  linear(model, w, s);
  s->choked = 1 - w <= model->critical_ratio;
  if (s->choked) {
    s->psi = 1 - model->critical_ratio;
    s->dpsi = 0;
  }
}

typedef void shape_function(const pneu_model *, pneu_real, shape *);
static shape_function *const shapes[PNEU_FLOW_COUNT] = {paper, nozzle, iso6358, linear, linear_choked};

/* As pneu_orifice; without `sloped` the slopes are 0. */
static void orifice(const pneu_model *model, int law, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                    int sloped, pneu_flow *flow)
{
  const pneu_real T = law < PNEU_FLOW_LINEAR ? T_up : model->p.ambient_temperature;
  const pneu_real r = p_down / p_up;
  pneu_real k;
  shape s;
  s.sloped = sloped;
  shapes[law](model, 1 - r, &s);
  k = area * s.gain / PNEU_M(sqrt)(T);
  flow->q = k * p_up * s.psi;
  flow->choked = s.choked;
  flow->dq_dup = flow->dq_ddown = flow->dq_dT = 0;
  if (!sloped)
    return;
  flow->dq_dup = k * (s.psi - r * s.dpsi);
  flow->dq_ddown = k * s.dpsi;
  flow->dq_dT = law < PNEU_FLOW_LINEAR ? -flow->q / (2 * T_up) : 0;
}

void pneu_orifice(const pneu_model *model, int law, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                  pneu_flow *flow)
{
  orifice(model, law, area, p_up, T_up, p_down, 1, flow);
}

pneu_real pneu_sonic_conductance(const pneu_model *model, pneu_real area)
{
  /* choked: q = C rho_0 p_up sqrt(T_0/T_up) with rho_0 = 100 kPa/(R T_0), T_0 = 293.15 K */
  return area * model->choked_gain * model->p.gas_constant * PNEU_M(sqrt)(PNEU_C(293.15)) / PNEU_C(1e5);
}

/* The declared law, mixed with the nozzle's as far as choked_flow says. */
static void mixed_flow(const pneu_terms *t, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                       int sloped, pneu_flow *flow)
{
  const pneu_real c = t->choked_share;
  pneu_flow nozzle_flow;
  orifice(t->model, t->model->law.flow, area, p_up, T_up, p_down, sloped, flow);
  if (c == 0)
    return;
  orifice(t->model, PNEU_FLOW_CHOKED, area, p_up, T_up, p_down, sloped, &nozzle_flow);
  flow->q += c * (nozzle_flow.q - flow->q);
  flow->dq_dup += c * (nozzle_flow.dq_dup - flow->dq_dup);
  flow->dq_ddown += c * (nozzle_flow.dq_ddown - flow->dq_ddown);
  flow->dq_dT += c * (nozzle_flow.dq_dT - flow->dq_dT);
  flow->choked = nozzle_flow.choked;
}

/* An orifice in series with a linear resistance, between p_up and p_down: which pressure lies between them. */
typedef struct series {
  const pneu_terms *t;
  pneu_real area, T_up, p_up, p_down, resistance;
  int before; /* the resistance lies before the orifice, else behind it */
} series;

enum { SERIES_ITERATIONS = 16 };

/* Flow of the orifice less that of the resistance, at a pressure between, and its slope. */
static pneu_real series_gap(const series *s, pneu_real p, pneu_flow *flow, pneu_real *slope)
{
  const pneu_real conductance = 1 / s->resistance;
  if (s->before) {
    mixed_flow(s->t, s->area, p, s->T_up, s->p_down, 1, flow);
    *slope = flow->dq_dup + conductance;
    return flow->q - (s->p_up - p) * conductance;
  }
  mixed_flow(s->t, s->area, s->p_up, s->T_up, p, 1, flow);
  *slope = flow->dq_ddown - conductance;
  return flow->q - (p - s->p_down) * conductance;
}

/* Newton, kept inside the bracket by bisection; a fixed number of times, so that the work is bounded. */
static void series_flow(const series *s, pneu_flow *flow)
{
  pneu_real low = s->p_down, high = s->p_up, p = s->before ? high : low, slope;
  int i;
  for (i = 0; i < SERIES_ITERATIONS; i++) {
    const pneu_real gap = series_gap(s, p, flow, &slope);
    if ((gap > 0) == (s->before != 0))
      high = p;
    else
      low = p;
    p -= gap / slope;
    if (!(p >= low && p <= high))
      p = (low + high) / 2;
  }
  series_gap(s, p, flow, &slope);
}

/* Flow from up to down, through a resistance before or behind the orifice if there is one. */
static void flow_between(const pneu_terms *t, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                         pneu_real resistance, int before, pneu_flow *flow)
{
  const series s = {t, area, T_up, p_up, p_down, resistance, before};
  if (resistance > 0 && p_up > p_down)
    series_flow(&s, flow);
  else
    mixed_flow(t, area, p_up, T_up, p_down, t->sloped, flow);
}

void pneu_exchange(pneu_terms *t, pneu_real area, pneu_real p_other, pneu_real T_other, pneu_real resistance)
{
  pneu_flow flow;
  if (area <= 0)
    return;
  if (p_other < t->p) {
    flow_between(t, area, t->p, t->T, p_other, resistance, 0, &flow);
    t->mass_out += flow.q;
    t->dout_dp += flow.dq_dup;
    t->dout_dT += flow.dq_dT;
  } else {
    flow_between(t, area, p_other, T_other, t->p, resistance, 1, &flow);
    t->mass_in += flow.q;
    t->mass_in_T += flow.q * T_other;
    t->din_dp += flow.dq_ddown;
  }
  t->choked |= flow.choked;
}
