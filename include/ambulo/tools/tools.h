/* ambulo/tools/tools.h - the engine and every tool around it.
 *
 *     common.h   what they have in common
 *     load.h     models, problems and solutions from files
 *     report.h   a result as files
 *     compare.h  motions scored against those of people
 *     inverse.h  inverse dynamics of motions in files
 *     batch.h    many problems: sweeps
 *     fit.h      weights and parameters fitted to a motion
 *     picture.h  results as pictures: SVG, PDF, PNG
 *     film.h     results as films: MP4, GIF
 *     page.h     results to watch, as one HTML file
 *     import.h   models of OpenSim, URDF and MuJoCo
 *     retarget.h a motion of one body as a task for another
 *     export.h   models and motions for OpenSim, URDF and NumPy
 *
 * The tools are outside the promise of ambulo/ambulo.h. They may change with any release.
 */
#ifndef AMBULO_TOOLS_TOOLS_H
#define AMBULO_TOOLS_TOOLS_H

#include "ambulo/ambulo.h"
#include "ambulo/tools/batch.h"
#include "ambulo/tools/compare.h"
#include "ambulo/tools/export.h"
#include "ambulo/tools/film.h"
#include "ambulo/tools/fit.h"
#include "ambulo/tools/import.h"
#include "ambulo/tools/inverse.h"
#include "ambulo/tools/load.h"
#include "ambulo/tools/muscle_analysis.h"
#include "ambulo/tools/page.h"
#include "ambulo/tools/picture.h"
#include "ambulo/tools/report.h"
#include "ambulo/tools/retarget.h"
#endif
