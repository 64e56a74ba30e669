/* people/compare_score.h - how far a curve is from a reference, and what it looks like. */
#ifndef AMBULO_PEOPLE_COMPARE_SCORE_H
#define AMBULO_PEOPLE_COMPARE_SCORE_H

#include "ambulo/tools/report.h"
#include "ambulo/tools/compare.h"
#include "people/compare_reference.h"

enum { AMBULO__FINE = 201 }; /* points of a finely sampled cycle: every half percent */

/* values[points of the curve] at its percents, fine[AMBULO__FINE] every half percent. Sets all
 * numbers of *score. */
void ambulo__score_curve(const ambulo__reference_curve *reference, const double *values,
                         const double *fine, ambulo_curve_score *score);

/* Pearson's r of two curves; NaN where one of them is constant. */
double ambulo__correlation(const double *a, const double *b, int count);

/* Landmarks of one curve, added at landmarks[*count]: at most 5 each. Knee flexion and ankle
 * dorsiflexion in deg, forces in N/kg (gravity in m/s^2 turns them into body weights). */
enum { AMBULO__MAX_LANDMARKS = 16 };
void ambulo__knee_landmarks(const double *fine, ambulo_landmark *landmarks, int *count);
void ambulo__ankle_landmarks(const double *fine, ambulo_landmark *landmarks, int *count);
void ambulo__vertical_landmarks(const double *fine, double gravity, ambulo_landmark *landmarks,
                                int *count);
void ambulo__forward_landmarks(const double *fine, ambulo_landmark *landmarks, int *count);

#endif
