/* model/query.c - read access to a model. A NULL model has nothing in it. */
#include <math.h>
#include <string.h>

#include "model/model.h"

const char *ambulo_model_name(const ambulo_model *model) {
  return model ? model->name : NULL;
}

int ambulo_model_link_count(const ambulo_model *model) {
  return model ? model->link_count : 0;
}

int ambulo_model_coordinate_count(const ambulo_model *model) {
  return model ? model->coordinate_count : 0;
}

int ambulo_model_point_count(const ambulo_model *model) {
  return model ? model->point_count : 0;
}

int ambulo_model_foot_count(const ambulo_model *model) {
  return model ? model->foot_count : 0;
}

int ambulo_model_patch_count(const ambulo_model *model) {
  return model ? model->patch_count : 0;
}

int ambulo_model_capsule_count(const ambulo_model *model) {
  return model ? model->capsule_count : 0;
}

const ambulo_link *ambulo_model_link(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->link_count ? &model->links[index] : NULL;
}

const ambulo_coordinate *ambulo_model_coordinate(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->coordinate_count ? &model->coordinates[index] : NULL;
}

const ambulo_point *ambulo_model_point(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->point_count ? &model->points[index] : NULL;
}

const ambulo_foot *ambulo_model_foot(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->foot_count ? &model->feet[index] : NULL;
}

const ambulo_patch *ambulo_model_patch(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->patch_count ? &model->patches[index] : NULL;
}

const ambulo_capsule *ambulo_model_capsule(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->capsule_count ? &model->capsules[index] : NULL;
}

int ambulo_model_find_link(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->link_count; i++) {
    if (strcmp(model->links[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo_model_find_coordinate(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->coordinate_count; i++) {
    if (strcmp(model->coordinates[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo_model_find_point(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->point_count; i++) {
    if (strcmp(model->points[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo_model_find_foot(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->foot_count; i++) {
    if (strcmp(model->feet[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo__find_patch(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->patch_count; i++) {
    if (strcmp(model->patches[i].name, name) == 0) return i;
  }
  return -1;
}

double ambulo_model_mass(const ambulo_model *model) {
  return model ? model->mass : 0;
}

double ambulo__model_weight(const ambulo_model *model) {
  const double *g = model->gravity;
  return model->mass * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

double ambulo__model_size(const ambulo_model *model) {
  return model->stature > 0.0 ? model->stature / 1.75 : 1.0;
}

double ambulo_model_stature(const ambulo_model *model) {
  return model ? model->stature : 0;
}

const double *ambulo_model_gravity(const ambulo_model *model) {
  return model ? model->gravity : NULL;
}

const double *ambulo_model_up(const ambulo_model *model) {
  return model ? model->up : NULL;
}

const double *ambulo_model_forward(const ambulo_model *model) {
  return model ? model->forward : NULL;
}

const double *ambulo_model_left(const ambulo_model *model) {
  return model ? model->left : NULL;
}
