/* contact/device_law.c - the effort of a device, and its derivatives by everything
 * (ambulo/device.h).
 *
 *     spring     E = -g w H,  H = k h(x + P / k),  x = s - s0
 *                H_s = k h',  dH/dk = h - h' P / k,  dH/ds0 = -k h',  dH/dP = h'
 *     damper     E = -g w c sd
 *     actuator   E = w a
 *
 * One side: h = r(y), or -r(-y). With u = y / b + 1/2, b the smoothing, between 0 and 1
 *
 *     r = b (u^3 - u^4 / 2),   r' = 3 u^2 - 2 u^3,   dr/db = r / b - (y / b) r'
 *
 * so that r = b / 2 = y at u = 1 and r'' is continuous. Where h is straight
 *
 *     H = k x + P,   dH/dk = x
 *
 * without a division: so, too, H is what it tends to as k goes to 0. No pretension leaves no force
 * there, and dH/dk = h(x); a pretension is a constant force, but 0 on the side where a spring of
 * one side has none, since y = P / k is then far on one side of u.
 */
#include "contact/devices.h"

#include <math.h>

/* H and its derivatives */
typedef struct pull {
  double value, slope, by_stiffness, by_pretension, by_smoothing;
} pull;

static pull straight(double stiffness, double x, double pretension) {
  return (pull){stiffness * x + pretension, stiffness, x, 1.0, 0.0};
}

/* (D.2) */
static pull one_sided(double k, double x, double pretension, double smoothing) {
  double early = 0.0; /* P / k */
  if (pretension != 0.0) early = k > 0.0 ? pretension / k : copysign(HUGE_VAL, pretension);
  double u = (x + early) / smoothing + 0.5;
  if (u <= 0.0) return (pull){0.0, 0.0, 0.0, 0.0, 0.0};
  if (u >= 1.0) return straight(k, x, pretension);
  double value = u * u * u * (1.0 - 0.5 * u), slope = u * u * (3.0 - 2.0 * u);
  return (pull){k * smoothing * value, k * slope, smoothing * value - slope * early, slope,
                k * (value - (u - 0.5) * slope)};
}

static pull pull_of(const ambulo_device *device, double x) {
  double k = device->stiffness, pretension = device->pretension;
  if (device->side == AMBULO_DEVICE_BOTH) return straight(k, x, pretension);
  if (device->side == AMBULO_DEVICE_ABOVE) return one_sided(k, x, pretension, device->smoothing);
  pull turned = one_sided(k, -x, -pretension, device->smoothing);
  return (pull){-turned.value, turned.slope, -turned.by_stiffness, turned.by_pretension,
                -turned.by_smoothing};
}

static ambulo__effort spring(const ambulo_device *device, double along, double factor) {
  double g = device->coordinate >= 0 ? 1.0 : -1.0;
  pull h = pull_of(device, along - device->rest);
  return (ambulo__effort){.value = -g * factor * h.value,
                          .by_along = -g * factor * h.slope,
                          .by_factor = -g * h.value,
                          .by_stiffness = -g * factor * h.by_stiffness,
                          .by_rest = g * factor * h.slope,
                          .by_pretension = -g * factor * h.by_pretension,
                          .by_smoothing = -g * factor * h.by_smoothing};
}

/* (D.1) E */
ambulo__effort ambulo__effort_of(const ambulo_device *device, double along, double rate,
                                 double factor) {
  double g = device->coordinate >= 0 ? 1.0 : -1.0;
  switch (device->kind) {
  case AMBULO_DEVICE_SPRING:
    return spring(device, along, factor);
  case AMBULO_DEVICE_DAMPER:
    return (ambulo__effort){.value = -g * factor * device->damping * rate,
                            .by_rate = -g * factor * device->damping,
                            .by_factor = -g * device->damping * rate,
                            .by_damping = -g * factor * rate};
  case AMBULO_DEVICE_KIND_NOT_SET:
  case AMBULO_DEVICE_ACTUATOR:
    break;
  }
  return (ambulo__effort){
      .value = factor * device->amount, .by_factor = device->amount, .by_amount = factor};
}
