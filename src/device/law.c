/* device/law.c - the effort of a device, and its derivatives by everything (ambulo/device.h).
 *
 *     spring     E = -g w k h(x),  x = s - s0 + P / k
 *                E_s = -g w k h',  dE/dk = -g w (h - h' P / k),  dE/ds0 = g w k h',
 *                dE/dP = -g w h'
 *     damper     E = -g w c sd
 *     actuator   E = w a
 *
 * One side: h = r(x), or -r(-x). With u = x / b + 1/2, b the smoothing, between 0 and 1
 *
 *     r = b (u^3 - u^4 / 2),   r' = 3 u^2 - 2 u^3,   dr/db = r / b - (x / b) r'
 *
 * so that r = b / 2 = x at u = 1 and r'' is continuous.
 */
#include "device/devices.h"

typedef struct ramp {
  double value, slope, by_smoothing;
} ramp;

/* (D.2) r */
static ramp one_sided(double x, double smoothing) {
  double u = x / smoothing + 0.5;
  if (u <= 0.0) return (ramp){0.0, 0.0, 0.0};
  if (u >= 1.0) return (ramp){x, 1.0, 0.0};
  double value = u * u * u * (1.0 - 0.5 * u), slope = u * u * (3.0 - 2.0 * u);
  return (ramp){smoothing * value, slope, value - x / smoothing * slope};
}

static ramp stretch_of(const ambulo_device *device, double x) {
  if (device->side == AMBULO_DEVICE_BOTH) return (ramp){x, 1.0, 0.0};
  if (device->side == AMBULO_DEVICE_ABOVE) return one_sided(x, device->smoothing);
  ramp turned = one_sided(-x, device->smoothing);
  return (ramp){-turned.value, turned.slope, -turned.by_smoothing};
}

static ambulo__effort spring(const ambulo_device *device, double along, double factor) {
  double g = device->coordinate >= 0 ? 1.0 : -1.0, k = device->stiffness;
  double early = device->pretension / k;
  ramp h = stretch_of(device, along - device->rest + early);
  return (ambulo__effort){.value = -g * factor * k * h.value,
                          .by_along = -g * factor * k * h.slope,
                          .by_factor = -g * k * h.value,
                          .by_stiffness = -g * factor * (h.value - h.slope * early),
                          .by_rest = g * factor * k * h.slope,
                          .by_pretension = -g * factor * h.slope,
                          .by_smoothing = -g * factor * k * h.by_smoothing};
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
